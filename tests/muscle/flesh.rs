//! Bellies beside bones: on every demo, at every moment and over the joint's range, flesh lies outside of bone, and its volume is kept.

use std::path::Path;

use glam::{DVec3, Vec3};
use sinew::document::{Document, PoseBuffers, PoseState};
use sinew::formats::SCENE_READERS;
use sinew::progress::Progress;
use sinew::scene::{Frame, Surface, SurfaceGeometry};

pub(crate) fn demo(name: &str) -> Document {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("configs").join(name);
    Document::open(&[file], SCENE_READERS, &Progress::default()).unwrap()
}

pub(crate) fn positions(surface: &Surface) -> Vec<DVec3> {
    match &surface.geometry {
        SurfaceGeometry::Deformed { positions, .. } => positions.iter().map(|position: &Vec3| position.as_dvec3()).collect(),
        SurfaceGeometry::Rigid(matrix) => {
            surface.mesh.positions.iter().map(|position| matrix.transform_point3(*position).as_dvec3()).collect()
        }
    }
}

/// A closed surface that tells what is inside of it: how often a ray along x comes out of it more than it goes in.
pub(crate) struct Solid {
    triangles: Vec<[DVec3; 3]>,
}

impl Solid {
    pub(crate) fn of(surface: &Surface) -> Self {
        let corners = positions(surface);
        Self { triangles: surface.mesh.triangles.iter().map(|triangle| triangle.map(|corner| corners[corner as usize])).collect() }
    }

    pub(crate) fn contains(&self, point: DVec3) -> bool {
        // A direction along which no edge lies.
        let along = DVec3::new(1.0, 1.3e-4, -2.7e-4);
        let crossings = self.triangles.iter().filter_map(|[a, b, c]| {
            let (e, f) = (*b - *a, *c - *a);
            let p = along.cross(f);
            let determinant = e.dot(p);
            let t = point - *a;
            let u = t.dot(p) / determinant;
            let q = t.cross(e);
            let v = along.dot(q) / determinant;
            let at = f.dot(q) / determinant;
            (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && at > 0.0).then(|| -determinant.signum() as i32)
        });
        crossings.sum::<i32>() != 0
    }
}

/// The share of a belly's vertices, a tenth of it at either end left out, that lie in bone.
fn share_in_bone(bones: &Solid, belly: &Surface) -> f64 {
    let all = positions(belly);
    let part = &belly.mesh.parts[0].triangles;
    let mut used: Vec<u32> = belly.mesh.triangles[part.start as usize..part.end as usize].iter().flatten().copied().collect();
    used.sort_unstable();
    used.dedup();
    let along = |vertex: u32| belly.mesh.uv_sets[0][vertex as usize].y;
    used.retain(|vertex| (0.1..=0.9).contains(&along(*vertex)));
    used.iter().filter(|vertex| bones.contains(all[**vertex as usize])).count() as f64 / used.len() as f64
}

/// Volume of the belly of a posed muscle.
fn volume(belly: &Surface) -> f64 {
    let all = positions(belly);
    let part = &belly.mesh.parts[0].triangles;
    let triangles = &belly.mesh.triangles[part.start as usize..part.end as usize];
    let middle = all[triangles[0][0] as usize];
    let corner = |vertex: u32| all[vertex as usize] - middle;
    triangles.iter().map(|&[a, b, c]| corner(a).dot(corner(b).cross(corner(c))) / 6.0).sum()
}

/// The moments of the clip, and the angles of the joint.
fn states(document: &Document) -> Vec<PoseState> {
    let start = document.start_state();
    let clip = &document.clips[0];
    let times = (0..=20).map(|step| start.at_time(clip.start + (clip.end - clip.start) * f64::from(step) / 20.0));
    let joint = document.joint().unwrap();
    let angles = (0..=28).map(|step| joint.range[0] + (joint.range[1] - joint.range[0]) * f64::from(step) / 28.0);
    times.chain(angles.map(|angle| start.with_rotation(Some(joint.absolute(angle))))).collect()
}

#[test]
fn no_belly_of_the_arm_with_bones_lies_in_them() {
    let document = demo("atlas-muscles.yaml");
    let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
    let mut seen = 0;
    for state in states(&document) {
        document.pose(&state, &mut buffers, &mut frame);
        let bones = frame.surfaces.iter().find(|surface| surface.mesh.name.contains("bones")).unwrap();
        let bones = Solid::of(bones);
        // The middle of the upper arm's bone is inside.
        let joint = |id: &str| frame.world[document.scene.graph.find(id).unwrap().index()].w_axis.truncate();
        assert!(bones.contains(0.5 * (joint("upper_arm") + joint("forearm"))));
        for belly in frame.surfaces.iter().filter(|surface| surface.muscle.is_some()) {
            let share = share_in_bone(&bones, belly);
            assert!(share < 0.01, "{} has {:.1} % in bone at {state:?}", belly.mesh.name, 100.0 * share);
            seen += 1;
        }
    }
    assert_eq!(seen, 100);
}

#[test]
fn the_volume_of_flesh_beside_bones_is_that_of_the_table() {
    for name in ["atlas-muscles.yaml", "curl-muscles.yaml"] {
        let document = demo(name);
        let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
        let mut at_rest: Option<Vec<f64>> = None;
        for state in states(&document) {
            document.pose(&state, &mut buffers, &mut frame);
            let volumes: Vec<f64> = frame.surfaces.iter().filter(|surface| surface.muscle.is_some()).map(volume).collect();
            for (number, solved) in buffers.solved().iter().enumerate() {
                assert!(solved.volume_error.abs() < 1e-12, "{name}: {}", solved.volume_error);
                // Thirty-six corners have 0.5 % less than a circle; round ends come on top.
                let first = at_rest.as_ref().map_or(volumes[number], |first| first[number]);
                assert!((volumes[number] / first - 1.0).abs() < 0.02, "{name}, muscle {number}: {} {first} at {state:?}", volumes[number]);
            }
            at_rest.get_or_insert(volumes);
        }
    }
}

#[test]
fn flesh_moves_without_a_jump_as_the_joint_turns() {
    for name in ["atlas-muscles.yaml", "curl-muscles.yaml"] {
        let document = demo(name);
        let joint = document.joint().unwrap();
        let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
        let mut rows: Vec<Vec<Vec<DVec3>>> = Vec::new();
        const STEP: f64 = 0.25;
        for step in 0..=((joint.range[1] - joint.range[0]) / STEP) as u32 {
            let state = document.start_state().with_rotation(Some(joint.absolute(joint.range[0] + STEP * f64::from(step))));
            document.pose(&state, &mut buffers, &mut frame);
            rows.push(frame.surfaces.iter().filter(|surface| surface.muscle.is_some()).map(positions).collect());
        }
        // What a vertex moves by in a step is nearly what it moved by in the step before.
        for (step, three) in rows.windows(3).enumerate() {
            for (muscle, ((a, b), c)) in three[0].iter().zip(&three[1]).zip(&three[2]).enumerate() {
                let bend = a.iter().zip(b).zip(c).map(|((a, b), c)| (*a - 2.0 * *b + *c).length()).fold(0.0, f64::max);
                assert!(bend < 4e-4, "{name}, muscle {muscle} at {}°: {} mm", STEP * step as f64, 1e3 * bend);
            }
        }
    }
}

//! Solid surfaces: that what is called so is closed and turned outward, and that the picture is the same as if their far sides were drawn.

use std::collections::HashMap;

use crate::render_support::plain;
use glam::{DMat4, DVec3, Quat, Vec3};
use sinew::document::{Document, PoseBuffers, PoseState};
use sinew::formats::SCENE_READERS;
use sinew::render::{Background, Display, RenderJob, Renderer, Samples};
use sinew::scene::{Camera, Frame, Projection, Surface};

const SIZE: [u32; 2] = [320, 240];

/// A document and a moment of it.
struct WorldMesh {
    document: Document,
    frame: Frame,
}

fn posed(document: Document, flexion: f64, contraction: f64, model: DMat4) -> WorldMesh {
    let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
    let mut state = PoseState { model, ..document.start_state() };
    (state.joints.drive.flexion, state.joints.drive.contraction) = (flexion, contraction);
    document.pose(&state, &mut buffers, &mut frame);
    WorldMesh { document, frame }
}

fn documents() -> Vec<Document> {
    let named = ["biceps.yaml", "biceps-human.yaml", "biceps-human-wrapped.yaml", "curl-muscles.yaml", "example.yaml"];
    let open = |name: &str| {
        let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("configs").join(name);
        Document::open(&[path], SCENE_READERS, &Default::default()).expect("a demo opens")
    };
    std::iter::once(Document::built_in()).chain(named.into_iter().map(open)).collect()
}

/// Edges of a surface, each from one point to another, with how often it is walked that way less how often the other way; and six times its volume.
fn edges_and_volume(surface: &Surface) -> (HashMap<[[i64; 3]; 2], i32>, f64) {
    let (mut edges, mut volume) = (HashMap::new(), 0.0);
    for corners in &surface.mesh.triangles {
        let at: [DVec3; 3] = corners.map(|v| surface.position(v).as_dvec3());
        let point = at.map(|p| (p * 1e7).round().as_i64vec3().to_array());
        for k in 0..3 {
            let (a, b) = (point[k], point[(k + 1) % 3]);
            if a < b {
                *edges.entry([a, b]).or_default() += 1;
            } else if b < a {
                *edges.entry([b, a]).or_default() -= 1;
            }
        }
        volume += at[0].dot(at[1].cross(at[2]));
    }
    (edges, volume)
}

#[test]
fn what_is_called_solid_is_closed_and_its_outside_is_outward() {
    let mut solids = 0;
    for document in documents() {
        for mirror in [1.0, -1.0] {
            let model = DMat4::from_scale(DVec3::new(mirror, 1.0, 1.0));
            let WorldMesh { frame, document } = posed(document.clone(), 70.0, 60.0, model);
            for surface in &frame.surfaces {
                let Some(bounds) = surface.solid else { continue };
                let name = &document.scene.graph.node(surface.node).name;
                let (edges, volume) = edges_and_volume(surface);
                let open = edges.values().filter(|walked| **walked != 0).count();
                assert!(open == 0 && edges.len() > 12, "{name}: {open} of {} edges are open", edges.len());
                assert!(volume * mirror > 0.0 && surface.mirrored == (mirror < 0.0), "{name}");
                let outside = (0..surface.mesh.positions.len() as u32)
                    .map(|v| surface.position(v))
                    .filter(|p| p.cmplt(bounds.min).any() || p.cmpgt(bounds.max).any());
                assert_eq!(outside.count(), 0, "{name}");
                solids += 1;
            }
        }
    }
    assert!(solids >= 40, "rods, balls and muscles of six documents, as they are and mirrored: {solids}");
}

fn camera(frame: &Frame, yaw: f32, pitch: f32, distance: f32) -> Camera {
    let rotation = Quat::from_rotation_y(yaw) * Quat::from_rotation_x(pitch);
    let span = frame.bounds.diagonal();
    Camera {
        eye: frame.bounds.center() + rotation * Vec3::Z * (span * distance),
        rotation,
        projection: Projection::Perspective { fov_y: 40f32.to_radians() },
        near: span * 0.01,
        far: span * 20.0,
    }
}

/// Draws as it is, and with nothing known to be solid.
fn both(renderer: &mut Renderer, posed: &WorldMesh, camera: &Camera, display: &Display) -> [Vec<u32>; 2] {
    let mut open = posed.frame.clone();
    open.surfaces.iter_mut().for_each(|surface| surface.solid = None);
    let job = |frame| RenderJob { scene: &posed.document.scene, frame, camera, display, width: SIZE[0], height: SIZE[1] };
    [&posed.frame, &open].map(|frame| renderer.draw(&job(frame)).expect("there is memory for the picture").pixels.clone())
}

#[test]
fn far_sides_that_are_not_drawn_are_not_missed() {
    let mut renderer = Renderer::new(Some(2));
    for document in documents() {
        for (flexion, contraction, yaw, pitch, mirror) in
            [(20.0, 10.0, 0.0, 0.0, 1.0), (90.0, 80.0, 0.9, -0.4, 1.0), (120.0, 100.0, 2.2, 0.7, -1.0), (60.0, 40.0, 4.0, -1.2, 1.0)]
        {
            let posed = posed(document.clone(), flexion, contraction, DMat4::from_scale(DVec3::new(mirror, 1.0, 1.0)));
            for samples in [Samples::One, Samples::Four] {
                let display = Display { background: Background::Transparent, samples, ..plain() };
                let [solid, open] = both(&mut renderer, &posed, &camera(&posed.frame, yaw, pitch, 1.2), &display);
                let lit = open.iter().filter(|pixel| **pixel != 0).count();
                assert!(lit > 500, "something is seen");
                // Nothing comes or goes; at the rim, where both sides are equally near, rounding may choose the other side.
                assert!(solid.iter().zip(&open).all(|(a, b)| a >> 24 == b >> 24), "{flexion}");
                let other = solid.iter().zip(&open).filter(|(a, b)| a != b).count();
                assert!(other * 200 <= lit, "{other} of {lit} pixels at {flexion}");
            }
        }
    }
}

#[test]
fn who_is_within_sees_the_inside() {
    let mut renderer = Renderer::new(Some(1));
    let posed = posed(Document::built_in(), 45.0, 50.0, DMat4::IDENTITY);
    let display = plain();
    for surface in posed.frame.surfaces.iter().filter_map(|surface| surface.solid) {
        let span = posed.frame.bounds.diagonal();
        // In its middle, and so close that the near plane cuts it open.
        for (eye, near) in [(surface.center(), span * 1e-4), (surface.center() + Vec3::Z * span * 0.3, span * 0.3)] {
            let projection = Projection::Perspective { fov_y: 1.0 };
            let camera = Camera { eye, rotation: Quat::IDENTITY, projection, near, far: span * 10.0 };
            let alone = WorldMesh {
                document: posed.document.clone(),
                frame: Frame {
                    surfaces: posed.frame.surfaces.iter().filter(|other| other.solid == Some(surface)).cloned().collect(),
                    ..posed.frame.clone()
                },
            };
            let [solid, open] = both(&mut renderer, &alone, &camera, &display);
            assert_eq!(solid, open);
            assert!(open.iter().any(|pixel| pixel & 0xFF_FFFF != 0), "the inside is seen");
        }
    }
}

#[test]
fn without_a_depth_test_far_sides_are_drawn() {
    let mut renderer = Renderer::new(Some(1));
    let posed = posed(Document::built_in(), 45.0, 50.0, DMat4::IDENTITY);
    let display = Display { depth_test: false, ..plain() };
    let [solid, open] = both(&mut renderer, &posed, &camera(&posed.frame, 0.5, 0.2, 1.2), &display);
    assert_eq!(solid, open);
}

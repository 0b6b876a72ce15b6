//! Fibres that stand at an angle: the angle as it is drawn, from the texture coordinates and the surface.

use std::f64::consts::TAU;

use glam::{DMat4, DVec3, Vec2, Vec3};
use sinew::animation::Pose;
use sinew::document::{Document, PoseBuffers, PoseState};
use sinew::formats::SCENE_READERS;
use sinew::muscle::config::ConfigErrorKind;
use sinew::muscle::edit::{Edit, EditError};
use sinew::muscle::{MuscleFile, MuscleRig, SolvedMuscle};
use sinew::progress::Progress;
use sinew::scene::{Frame, MuscleId, Scene};

/// Corners of a ring with the seam, which stands twice.
const RING: usize = 37;
/// Rings of a hemisphere at either end of the belly.
const CAP: usize = 6;

const SHAPE: &str =
    "length: 267.0, radii: [4.0, 8.0, 14.0, 18.0, 18.0, 17.0, 12.0, 7.0, 3.5], growth: [0.0, 0.6, 1.4, 2.0, 2.0, 1.6, 1.0, 0.5, 0.0]";

fn file(more: &str) -> MuscleFile {
    MuscleFile::parse(&format!("muscles: [{{{SHAPE}{more}}}]")).unwrap()
}

struct Drawn {
    solved: SolvedMuscle,
    positions: Vec<Vec3>,
    coordinates: Vec<Vec2>,
}

/// A muscle that lies on its own, at a contraction.
fn drawn(file: &MuscleFile, contraction: f64) -> Drawn {
    let mut scene = Scene::default();
    let rig = MuscleRig::build(file, "stage", &mut scene, MuscleId(0));
    let (mut local, mut world): (Vec<DMat4>, Vec<DMat4>) = (Vec::new(), Vec::new());
    Pose::rest(&scene).locals(&mut local);
    scene.graph.world_from_local(&local, &mut world);
    let solved = rig.solve(0, rig.at_contraction(contraction), &world);
    let (mut positions, mut normals, mut coordinates) = (Vec::new(), Vec::new(), vec![Vec2::ONE; 3]);
    rig.deform(0, &solved, &world, &mut positions, &mut normals);
    rig.fiber_coordinates(0, &solved, &mut coordinates);
    Drawn { solved, positions, coordinates }
}

/// The rings of the belly without its hemispheres: centre, radius, and the texture coordinates of their corners.
fn rings(drawn: &Drawn) -> Vec<(DVec3, f64, Vec<Vec2>)> {
    let all = drawn.positions.chunks(RING).zip(drawn.coordinates.chunks(RING));
    let of = |(positions, coordinates): (&[Vec3], &[Vec2])| {
        let centre = positions[1..].iter().map(|position| position.as_dvec3()).sum::<DVec3>() / (RING - 1) as f64;
        (centre, positions[0].as_dvec3().distance(centre), coordinates.to_vec())
    };
    let rings: Vec<_> = all.map(of).collect();
    rings[CAP..rings.len() - CAP].to_vec()
}

#[test]
fn fibres_are_drawn_at_the_angle_that_keeps_the_thickness_of_their_sheet() {
    let (alpha, optimal) = (20_f64.to_radians(), 267.0);
    let file = file(", pennation: 20");
    let mut lengths = Vec::new();
    for contraction in [0.0, 25.0, 50.0, 75.0, 100.0] {
        let drawn = drawn(&file, contraction);
        let expected = (optimal * alpha.sin() / drawn.solved.shape.length).asin();
        let rings = rings(&drawn);
        // A fibre lies where u is constant: where it leans to the seam at u = 0, w falls by as much as T grows. It stands at the angle whose tangent is what it
        // goes round the section, 2π r Δw, for Δs along the line; over a cone the mean of 1 / r is ln(r₂ / r₁) / (r₂ − r₁).
        let (mut round, mut along) = (0.0, 0.0);
        for pair in rings.windows(2) {
            let [(from, first, uvs), (to, last, next)] = pair else { unreachable!() };
            let width = last - first;
            let over_radius = if width.abs() < 1e-9 { 1.0 / first } else { (last / first).ln() / width };
            let turned = f64::from(uvs[0].x) - f64::from(next[0].x);
            round += TAU * turned;
            along += from.distance(*to) * over_radius;
            let here = (TAU * turned).atan2(from.distance(*to) * over_radius);
            assert!((here - expected).abs() < 3e-5, "{contraction} %: {} instead of {}", here.to_degrees(), expected.to_degrees());
            // All corners of a ring have turned alike, and v stays.
            for corner in 0..RING {
                let w = corner.min(RING - 1 - corner) as f32 / (RING - 1) as f32;
                assert!((uvs[corner].x - uvs[0].x - w).abs() < 1e-6 && uvs[corner].y == uvs[0].y);
            }
        }
        let angle = round.atan2(along);
        assert!((angle - expected).abs() < 1e-6, "{contraction} %: {angle} instead of {expected}");
        assert!((angle.sin() * drawn.solved.shape.length - optimal * alpha.sin()).abs() < 3e-4);
        lengths.push(drawn.solved.shape.length);
    }
    assert!(lengths.windows(2).all(|pair| pair[1] < pair[0] - 10.0), "{lengths:?}");
}

#[test]
fn pennation_is_a_look_alone() {
    let (plain, pennate) = (file(""), file(", pennation: 35"));
    for contraction in [0.0, 60.0] {
        let (without, with) = (drawn(&plain, contraction), drawn(&pennate, contraction));
        assert_eq!(without.positions, with.positions);
        assert_eq!(without.solved.shape, with.solved.shape);
        assert!(without.coordinates.is_empty() && with.coordinates.len() == with.positions.len());
        assert!(with.coordinates.iter().all(|uv| uv.is_finite()));
    }
}

#[test]
fn a_frame_has_the_coordinates_of_pennate_muscles_alone() {
    let yaml = format!("arm: {{upper: 330, forearm: 260, thickness: 8}}\nmuscles: [{{{SHAPE}}}, {{{SHAPE}, pennation: 25}}]");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("stage.yaml");
    std::fs::write(&path, yaml).unwrap();
    let document = Document::open(&[path], SCENE_READERS, &Progress::default()).unwrap();
    let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
    document.pose(&PoseState::default(), &mut buffers, &mut frame);
    let muscles: Vec<_> = frame.surfaces.iter().filter(|surface| surface.muscle.is_some()).collect();
    assert_eq!(muscles.len(), 2);
    assert!(muscles[0].coordinates.is_empty() && muscles[0].texture_coordinates(0) == muscles[0].mesh.uv_sets[0]);
    assert_eq!(muscles[1].texture_coordinates(0).len(), muscles[1].mesh.positions.len());
    assert_ne!(muscles[1].texture_coordinates(0), muscles[1].mesh.uv_sets[0]);
    assert!(muscles[1].texture_coordinates(1).is_empty());
}

#[test]
fn the_angle_is_read_written_and_refused_in_place() {
    let pennate = file(", pennation: 12.5");
    assert_eq!(pennate.muscles[0].pennation, 12.5);
    assert_eq!(MuscleFile::parse(&pennate.to_yaml()).unwrap(), pennate);
    assert!(!file("").to_yaml().contains("pennation"));
    let text = "muscles:\n  - length: 30 # a\n    radii: [1, 2, 1]\n    growth: [0, 1, 0]\n    pennation: 10 # b\n";
    let read = MuscleFile::parse(text).unwrap();
    let turned = read.edited(0, &Edit::Pennation(15.0)).unwrap().to_yaml_keeping(text);
    assert_eq!((turned.text, turned.comments_lost), (text.replace("10 # b", "15.0 # b"), false));
    let gone = read.edited(0, &Edit::Pennation(0.0)).unwrap().to_yaml_keeping(text).text;
    assert!(gone.contains("# a") && !gone.contains("pennation"), "{gone}");
    for wrong in [60.0, 90.0, -0.5] {
        let error = MuscleFile::parse(&text.replace("10 # b", &format!("{wrong:?}"))).unwrap_err();
        assert_eq!((error.line, error.column, error.kind), (Some(5), Some(16), ConfigErrorKind::BadPennation(wrong)));
        assert_eq!(read.edited(0, &Edit::Pennation(wrong)).unwrap_err(), EditError::Pennation);
    }
    assert_eq!(read.edited(0, &Edit::Pennation(f64::NAN)).unwrap_err(), EditError::Pennation);
}

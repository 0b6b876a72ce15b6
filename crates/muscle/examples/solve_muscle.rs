//! Bends the elbow of a ready arm and solves its biceps: the length changes, the volume does not.

use sinew_muscle::presets::Preset;
use sinew_muscle::{MuscleRig, SolvedMuscle};
use sinew_scene::animation::Pose;
use sinew_scene::{MuscleId, Scene};

/// The first muscle of a preset's arm at each of these elbow angles, degrees.
pub(crate) fn solve(preset: &str, angles: &[f64]) -> Option<Vec<SolvedMuscle>> {
    let file = Preset::by_id(preset)?.file();
    // The arm's rods and elbow become nodes of a scene; so would those of a clip.
    let mut scene = Scene::default();
    let rig = MuscleRig::build(&file, preset, &mut scene, MuscleId(0));
    let (mut local, mut world) = (Vec::new(), Vec::new());
    let at = |angle: &f64| {
        let state = rig.at_flexion(*angle);
        let mut pose = Pose::rest(&scene);
        rig.apply(state, &mut pose);
        pose.locals(&mut local);
        scene.graph.world_from_local(&local, &mut world);
        rig.solve(0, state, &world)
    };
    Some(angles.iter().map(at).collect())
}

fn main() {
    let angles = [0.0, 45.0, 90.0, 130.0];
    for (angle, solved) in angles.iter().zip(solve("report", &angles).unwrap_or_default()) {
        let thickest = solved.radii.iter().copied().fold(0.0, f64::max);
        println!("{angle:>5}°: length {:.1}, largest radius {thickest:.2}, volume {:.1}", solved.length, solved.volume);
    }
}

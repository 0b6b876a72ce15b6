//! Any text at all is a muscle file or is refused; what was read is written and read back the same, and can be solved at any angle.
#![no_main]

use libfuzzer_sys::fuzz_target;
use sinew::muscle::{MuscleFile, MuscleRig};
use sinew::scene::{MuscleId, Scene};

fuzz_target!(|text: &str| {
    let Ok(file) = MuscleFile::parse(text) else { return };
    let written = file.to_yaml();
    let again = MuscleFile::parse(&written).unwrap_or_else(|error| panic!("what was written is refused: {error}\n{written}"));
    assert_eq!(again, file, "written:\n{written}");
    // A long file costs time and finds nothing that a short one doesn't.
    if file.muscles.len() > 8 || file.muscles.iter().any(|muscle| muscle.profile.radii().len() > 64) {
        return;
    }
    let mut scene = Scene::default();
    let mut rig = MuscleRig::build(&file, "fuzz", &mut scene, MuscleId(0));
    let _ = rig.attach(&scene);
    let (mut local, mut world) = (Vec::new(), Vec::new());
    let (mut positions, mut normals) = (Vec::new(), Vec::new());
    for part in [0.0, 37.0, 100.0, f64::NAN, -1e300] {
        let drive = if part == 37.0 { rig.at_contraction(part) } else { rig.at_flexion(part) };
        let mut pose = sinew::animation::Pose::rest(&scene);
        rig.apply(drive, &mut pose);
        pose.locals(&mut local);
        scene.graph.world_from_local(&local, &mut world);
        for index in 0..rig.len() {
            let solved = rig.solve(index, drive, &world);
            rig.deform(index, &solved, &world, &mut positions, &mut normals);
            let _ = rig.measure(index, &[part]);
        }
    }
});

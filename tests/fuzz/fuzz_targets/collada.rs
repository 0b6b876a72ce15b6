//! Any bytes at all are read or refused, and what was read can be posed.
#![no_main]

use libfuzzer_sys::fuzz_target;
use sinew::progress::Progress;
use sinew::animation::Pose;
use sinew::collada::read;

fuzz_target!(|bytes: &[u8]| {
    let Ok(loaded) = read(bytes, "fuzz.dae", &Progress::default()) else { return };
    let (mut local, mut world) = (Vec::new(), Vec::new());
    for clip in &loaded.clips {
        let mut pose = Pose::rest(&loaded.scene);
        for time in [clip.start, (clip.start + clip.end) / 2.0, clip.end] {
            clip.sample(time, &mut pose);
            pose.locals(&mut local);
            loaded.scene.graph.world_from_local(&local, &mut world);
        }
        let _ = clip.key_times(None);
    }
    for mesh in &loaded.scene.meshes {
        let count = mesh.positions.len();
        assert!(mesh.normals.len() == count && mesh.source_vertex.len() == count);
        assert!(mesh.triangles.iter().flatten().chain(mesh.lines.iter().flatten()).all(|vertex| (*vertex as usize) < count));
        assert!(mesh.source_vertex.iter().all(|point| *point < mesh.source_count));
    }
});

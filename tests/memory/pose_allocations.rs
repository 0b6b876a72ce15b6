//! A pose allocates nothing after the first: counted, not believed.

use std::path::Path;

use crate::counting::allocations;
use sinew::document::{Document, PoseBuffers, PoseState, Skinning};
use sinew::formats::SCENE_READERS;
use sinew::progress::Progress;
use sinew::scene::Frame;

pub(crate) fn posing_again_allocates_nothing() {
    let configs = Path::new(env!("CARGO_MANIFEST_DIR")).join("configs");
    for name in ["curl.dae", "walker.dae", "lamp.dae", "biceps.yaml", "atlas-muscles.yaml"] {
        let document = Document::open(&[configs.join(name)], SCENE_READERS, &Progress::default()).expect(name);
        let (mut buffers, mut frame, start) = (PoseBuffers::default(), Frame::default(), document.start_state());
        let duration = document.clips.first().map_or(0.0, |clip| clip.duration());
        let moment = |step: u32, skinning| {
            let share = f64::from(step) / 16.0;
            let drive = document.driven_rig().map_or(start.joints.drive, |rig| rig.at_contraction(100.0 * share));
            PoseState { skinning, ..start.at_time(start.time + share * duration).with_drive(drive) }
        };
        for skinning in [Skinning::Linear, Skinning::DualQuaternion] {
            document.pose(&moment(0, skinning), &mut buffers, &mut frame);
            document.pose(&moment(1, skinning), &mut buffers, &mut frame);
            let before = allocations();
            for step in 0..16 {
                document.pose(&moment(step, skinning), &mut buffers, &mut frame);
            }
            assert_eq!(allocations() - before, 0, "{name}, {skinning:?}");
        }
    }
}

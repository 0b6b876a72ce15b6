//! Placement of arms that come with muscles: their files have no position, so each stands beside what is there already, clear of it.

use glam::DVec3;

use sinew_muscle::{Arm, MuscleFile};
use sinew_scene::Bounds;

/// Room between an arm and what it stands beside, of the straight arm's length.
const GAP: f64 = 0.15;

/// The place that is free on the right of a scene, metres.
#[derive(Debug, Clone, Copy)]
pub(super) struct ArmPlacer {
    /// How far the scene reaches to +X; `None` while there is nothing.
    right: Option<f64>,
    /// Its middle along Z.
    depth: f64,
}

impl ArmPlacer {
    /// Beside the box round a scene.
    pub(super) fn new(bounds: &Bounds) -> Self {
        let is_occupied = !bounds.is_empty() && bounds.min.is_finite() && bounds.max.is_finite();
        let right = is_occupied.then_some(f64::from(bounds.max.x));
        Self { right, depth: if is_occupied { f64::from(bounds.center().z) } else { 0.0 } }
    }

    /// Takes the place for an arm, with room for its forearm when it bends; `None` where it can stay where it is, because there is nothing else.
    pub(super) fn place(&mut self, arm: &Arm, file: &MuscleFile) -> Option<DVec3> {
        let unit = file.unit_metres;
        let thickest = file.muscles.iter().flat_map(|muscle| muscle.profile.radii()).copied().fold(arm.thickness, f64::max);
        // Muscles lie before and behind the rods and bulge.
        let half = (arm.thickness + 3.0 * thickest) * unit;
        let gap = GAP * (arm.upper + arm.lower) * unit;
        let place = self.right.map(|right| DVec3::new(right + gap + half, 0.0, self.depth)).filter(|place| place.is_finite());
        let at = place.map_or(0.0, |place| place.x);
        self.right = Some(at + (arm.lower * unit).max(half));
        place
    }
}

#[cfg(test)]
mod tests {
    use crate::document::{Document, PoseBuffers, SceneReaders};
    use sinew_muscle::MuscleState;
    use sinew_scene::progress::Progress;
    use sinew_scene::{Bounds, Content, Frame, NodeId};

    /// The boxes round what each file shows, with the elbow bent by this many degrees.
    fn boxes(document: &Document, flexion: f64) -> Vec<Bounds> {
        let drive = document.driven_rig().map_or_else(MuscleState::default, |rig| rig.at_flexion(flexion));
        let state = document.start_state().with_drive(drive);
        let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
        document.pose(&state, &mut buffers, &mut frame);
        let roots: Vec<NodeId> = document.sources.iter().filter_map(|source| source.root).collect();
        let graph = &document.scene.graph;
        let of = |root: &NodeId| {
            let below = graph.subtree(*root);
            let mut bounds = Bounds::EMPTY;
            for surface in frame.surfaces.iter().filter(|surface| below.contains(&surface.node)) {
                (0..surface.mesh.positions.len() as u32).for_each(|vertex| bounds.add(surface.position(vertex)));
            }
            bounds
        };
        assert!(graph.iter().any(|(_, node)| node.contents.iter().any(|content| matches!(content, Content::Muscle(_)))));
        roots.iter().map(of).collect()
    }

    #[test]
    fn files_side_by_side_do_not_touch_each_other() {
        let open = |names: &[&str]| {
            let files: Vec<String> = names.iter().map(|name| format!("{}/../../configs/{name}", env!("CARGO_MANIFEST_DIR"))).collect();
            Document::open(&files, SceneReaders::TESTED, &Progress::default()).unwrap()
        };
        for names in [
            &["walker.dae", "biceps.yaml"][..],
            &["biceps.yaml", "example.yaml"],
            &["example.yaml", "curl.dae", "biceps-human-wrapped.yaml"],
        ] {
            let mut document = open(names);
            for flexion in [0.0, 45.0, 90.0, 130.0] {
                let boxes = boxes(&document, flexion);
                assert_eq!(boxes.len(), names.len());
                for (index, a) in boxes.iter().enumerate() {
                    for b in boxes.iter().skip(index + 1) {
                        let apart = a.max.x.min(b.max.x) < a.min.x.max(b.min.x);
                        assert!(!a.is_empty() && !b.is_empty() && apart, "{names:?} {flexion}: {a:?} {b:?}");
                    }
                }
            }
            // An edit leaves them where they are.
            let before = boxes(&document, 90.0);
            let files: Vec<_> = document.muscle_files().cloned().collect();
            document.set_muscle_files(&files);
            assert_eq!(boxes(&document, 90.0), before);
        }
        let alone = open(&["biceps.yaml"]);
        let built_in = Document::built_in();
        for document in [&alone, &built_in] {
            let first = boxes(document, 0.0)[0];
            assert!(
                first.min.x < 0.0 && first.max.x > 0.0 && first.center().z.abs() < 1e-6,
                "the first one stands in the middle: {first:?}"
            );
        }
    }
}

//! Attaches the muscles of a file to the bones of a clip instead of the arm that they came with, as one undo step.

use super::{Session, UndoStep};
use sinew_muscle::{Form, JointDof, MuscleFile, MuscleSpec};
use sinew_scene::message;
use sinew_scene::message::Value;

/// Muscles that a clip carries now.
#[derive(Debug, Clone, PartialEq)]
pub struct AttachResult {
    /// How many.
    pub muscles: usize,
    /// What the bone whose joint they cross is called.
    pub joint: Value,
}

impl Session {
    /// The joint of a clip that the muscles of file `place` can be hung on: that of the selected bone, else the elbow that is found. `None` where they are
    /// on no arm of their own, or there is no such joint. Looks at the whole scene: ask when something was opened, selected or edited.
    pub fn joint_to_attach_to(&self, place: usize) -> Option<JointDof> {
        self.document.muscle_files().nth(place).filter(|file| file.arm.is_some())?;
        let bones = self.turnable();
        let scene = &self.document.scene;
        let selected = self.selected().filter(|node| bones.contains(node));
        let joint = match selected {
            Some(node) => JointDof::at_node(scene, &self.document.clips, node)?,
            None => self.found_elbow()?,
        };
        let two_limbs = JointDof::limbs(scene, joint.node).is_some();
        (two_limbs && !self.twists(&joint)).then_some(joint)
    }

    /// The number of the muscle file that the muscle shown is in.
    pub fn shown_file(&self) -> Option<usize> {
        Some(self.document.file_of_muscle(self.shown_muscle)?.0)
    }

    /// Hangs the muscles of file `place` on [`Session::joint_to_attach_to`], as long and as thick as its bones are beside those of their arm, which goes.
    /// `None` where that cannot be; nothing is changed then.
    pub fn attach_to_skeleton(&mut self, place: usize) -> Option<AttachResult> {
        let joint = self.joint_to_attach_to(place)?;
        let before = self.files_now();
        let on_arm = before.get(place)?.clone();
        let muscles = on_arm.muscles.len();
        let loose = on_arm.muscles.iter().map(|muscle| MuscleSpec {
            origin: None,
            insertion: None,
            via: Vec::new(),
            wraps: Vec::new(),
            ..muscle.clone()
        });
        let scale = self.bones_scale(&joint);
        let loose = MuscleFile { form: Form::Rich, arm: None, scale, muscles: loose.collect(), ..on_arm.clone() };
        // Only a file that is in the scene without its arm has axes to lay a muscle in; its intermediate state is not drawn.
        let mut files = before.clone();
        files[place] = loose;
        let (drive, selected) = (self.state.joints.drive, self.view.display.highlight.selected);
        self.put_muscle_files(&files);
        let hung: Option<Vec<MuscleSpec>> =
            on_arm.muscles.iter().map(|muscle| self.attached_muscle(place, muscle, &on_arm, &joint)).collect();
        self.put_muscle_files(&before);
        (self.state.joints.drive, self.view.display.highlight.selected) = (drive, selected);
        files[place].muscles = hung?;
        let joint = Value::from(self.document.scene.graph.label(joint.node));
        self.change_files(&files, message!("muscle-edit-hang", joint = joint.clone()), UndoStep::New);
        let shown = self.node_of_muscle(self.shown_muscle);
        self.select(shown);
        Some(AttachResult { muscles, joint })
    }

    fn attached_muscle(&self, place: usize, muscle: &MuscleSpec, on_arm: &MuscleFile, joint: &JointDof) -> Option<MuscleSpec> {
        if muscle.origin.is_none() {
            return Some(muscle.clone());
        }
        let (rig, _) = self.document.rigs().nth(place)?;
        rig.fitted(muscle, on_arm, joint, &self.document.scene, &self.straight(joint).world)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::{Document, SceneReaders};
    use crate::session::tests::ends;
    use sinew_scene::progress::Progress;
    use sinew_scene::{MuscleId, NodeId, NodeKind};

    fn both(clip: &str, muscles: &str) -> Session {
        let config = |name: &str| format!("{}/../../configs/{name}", env!("CARGO_MANIFEST_DIR"));
        Session::new(Document::open(&[config(clip), config(muscles)], SceneReaders::TESTED, &Progress::default()).unwrap())
    }

    #[test]
    fn muscles_leave_their_arm_for_the_elbow_of_a_clip_and_come_back() {
        let mut session = both("curl.dae", "example.yaml");
        let (before, nodes) = (session.files_now(), session.document().scene.graph.len());
        let hung = session.attach_to_skeleton(0).unwrap();
        assert_eq!(hung, AttachResult { muscles: 2, joint: "forearm".into() });
        assert!(session.is_unsaved());
        for id in [MuscleId(0), MuscleId(1)] {
            let names = ends(&session, id).map(|node| session.document().scene.graph.node(node.unwrap()).name.clone());
            assert_eq!(names, ["upper_arm", "forearm"]);
        }
        // The biceps shortens and the triceps lengthens when the clip's elbow bends, as on the arm.
        let length = |session: &mut Session, id: MuscleId, degrees: f64| {
            session.set_flexion(degrees);
            session.frame();
            let (rig, index) = session.document().muscle(id).unwrap();
            rig.solve(index, session.drive(), &session.posed().world).path_length
        };
        for (id, sign) in [(MuscleId(0), -1.0), (MuscleId(1), 1.0)] {
            assert!((length(&mut session, id, 100.0) - length(&mut session, id, 10.0)) * sign > 5.0, "{id:?}");
        }
        assert_eq!(session.attach_to_skeleton(0), None, "they hang there already");
        session.undo();
        assert_eq!((session.files_now(), session.document().scene.graph.len(), session.is_unsaved()), (before, nodes, false));
    }

    #[test]
    fn what_cannot_be_hung_stays_on_its_arm() {
        let mut session = both("lamp.dae", "biceps.yaml");
        let before = session.files_now();
        assert_eq!((session.joint_to_attach_to(0), session.attach_to_skeleton(0)), (None, None), "a lamp has no elbow");
        assert_eq!(session.joint_to_attach_to(7), None);
        assert!(session.files_now() == before && !session.is_unsaved() && session.undo_names().0.is_none());
        let mut alone = Session::new(Document::built_in());
        assert_eq!(alone.attach_to_skeleton(0), None);
    }

    #[test]
    fn bones_that_no_file_can_name_leave_everything_as_it_was() {
        let named = both("curl.dae", "biceps.yaml");
        let elbow = named.joint_to_attach_to(0).unwrap().node;
        let mut document = named.document().clone();
        for bone in 0..document.scene.graph.len() as u32 {
            let node = document.scene.graph.node_mut(NodeId(bone));
            if node.kind == NodeKind::Joint && node.id != "elbow" && node.id != "upper arm" {
                // The elbow goes by that already.
                (node.name, node.id, node.sid) = ("elbow".into(), String::new(), String::new());
            }
        }
        let mut session = Session::new(document);
        session.set_flexion(40.0);
        session.select(Some(elbow));
        let look = |session: &Session| (session.files_now(), session.drive(), session.selected(), session.is_unsaved());
        let before = look(&session);
        assert_eq!(session.joint_to_attach_to(0).map(|joint| joint.node), Some(elbow));
        assert_eq!(session.attach_to_skeleton(0), None);
        assert_eq!(look(&session), before);
    }

    #[test]
    fn the_selected_bone_says_which_joint() {
        let mut session = both("walker.dae", "biceps.yaml");
        let found = session.joint_to_attach_to(0).unwrap().node;
        let other = ["shin.L", "shin.R"].map(|name| {
            let graph = &session.document().scene.graph;
            let (id, _) = graph.iter().find(|(_, node)| node.name == name).unwrap();
            id
        });
        for bone in other {
            session.select(Some(bone));
            assert!(bone != found && session.joint_to_attach_to(0).unwrap().node == bone);
        }
        let hung = session.attach_to_skeleton(0).unwrap();
        assert_eq!(hung.joint, "shin.R".into());
        assert_eq!(ends(&session, MuscleId(0))[1], Some(other[1]));
    }
}

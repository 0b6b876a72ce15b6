//! Whole sets of muscles on the figure of a clip, and muscles of one side on the other; each is one undo step.

use super::muscle_commands::{id_of, unused_name};
use super::{ChangeSet, Session, UndoStep};
use sinew_muscle::sets::{self, MuscleSet, SetError, Sides};
use sinew_muscle::{EditError, MuscleFile, MuscleSpec};
use sinew_scene::message;
use sinew_scene::message::{Message, ToMessage};
use sinew_scene::{MuscleId, NodeId};

/// Why muscles were not attached.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{}", self.message())]
pub enum AttachSetError {
    /// The figure cannot carry them.
    Set(#[from] SetError),
    /// The session cannot hold them.
    Edit(#[from] EditError),
}

impl ToMessage for AttachSetError {
    fn message(&self) -> Message {
        match self {
            Self::Set(error) => error.message(),
            Self::Edit(error) => error.message(),
        }
    }
}

impl Session {
    /// Adds a set of muscles on the first figure of the scene as a file of its own that is not saved yet, shows the first of them, and says how many there are.
    ///
    /// # Errors
    /// [`AttachSetError`] where there is no figure, it lacks joints, or there would be too many muscles; nothing is changed then.
    pub fn attach_set(&mut self, set: MuscleSet, sides: Sides) -> Result<usize, AttachSetError> {
        let attached = self.document.attach_set(set, sides)?;
        let mut files = self.files_now();
        let count = attached.file.muscles.len();
        files.push(attached.file);
        if !MuscleFile::can_be_drawn(&files) {
            return Err(EditError::TooMuchSurface.into());
        }
        let place = files.len() - 1;
        let first = id_of(&files, place, 0);
        self.change_files(&files, message!("muscle-edit-set"), UndoStep::New);
        self.show_new(first);
        Ok(count)
    }

    /// Adds muscle `id` a second time, on the other side of its figure, and shows that one.
    ///
    /// # Errors
    /// [`AttachSetError`] where there is no such muscle or figure, or a bone has no counterpart; nothing is changed then.
    pub fn mirror_muscle(&mut self, id: MuscleId) -> Result<(), AttachSetError> {
        let (place, index) = self.document.file_of_muscle(id).ok_or(EditError::NoMuscle(id.index()))?;
        let mut files = self.files_now();
        let file = files.get_mut(place).ok_or(EditError::NoMuscle(index))?;
        let spec = file.muscles.get(index).ok_or(EditError::NoMuscle(index))?;
        let own: Vec<NodeId> = self.document.rigs().filter_map(|(rig, _)| rig.root).collect();
        let (other, joints) = sets::mirrored(file, spec, &self.document.scene, &own)?;
        let name = unused_name(file, &other.name);
        file.joints.extend(joints);
        *file = file.with_muscle(MuscleSpec { name, ..other })?;
        let last = id_of(&files, place, usize::MAX);
        self.change_files(&files, message!("muscle-edit-mirror"), UndoStep::New);
        self.show_new(last);
        Ok(())
    }

    fn show_new(&mut self, id: MuscleId) {
        self.shown_muscle = id;
        self.select(self.node_of_muscle(id));
        self.changed(ChangeSet::MUSCLE);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::{Document, SceneReaders};
    use sinew_muscle::BodySide;
    use sinew_scene::progress::Progress;

    fn open(files: &[&str]) -> Session {
        let paths: Vec<String> = files.iter().map(|name| format!("{}/../../configs/{name}", env!("CARGO_MANIFEST_DIR"))).collect();
        Session::new(Document::open(&paths, SceneReaders::TESTED, &Progress::default()).unwrap())
    }

    #[test]
    fn a_set_is_attached_and_taken_back() {
        let mut session = open(&["walker.dae"]);
        let nodes = session.document().scene.graph.len();
        for (set, count) in [(MuscleSet::Arm, 12), (MuscleSet::Leg, 64), (MuscleSet::Body, 76)] {
            assert_eq!(session.attach_set(set, Sides::Both), Ok(count));
            assert_eq!((session.document().muscle_count(), session.document().muscle_files().count()), (count, 1));
            assert!(session.is_unsaved());
            assert!(session.document().rigs().all(|(rig, _)| (0..rig.len()).all(|index| rig.is_attached(index))));
            assert!(session.selected().is_some());
            session.undo();
            assert_eq!((session.document().muscle_count(), session.document().scene.graph.len()), (0, nodes));
            assert!(!session.is_unsaved());
        }
        session.redo();
        assert_eq!(session.document().muscle_count(), 76);
        // What is there already is no part of the figure.
        assert_eq!(session.attach_set(MuscleSet::Arm, Sides::One(BodySide::Left)), Ok(6));
    }

    #[test]
    fn what_cannot_be_attached_changes_nothing() {
        let mut session = open(&["lamp.dae"]);
        assert_eq!(session.attach_set(MuscleSet::Body, Sides::Both), Err(SetError::NoFigure.into()));
        let mut arm = open(&["curl.dae"]);
        assert!(matches!(arm.attach_set(MuscleSet::Leg, Sides::Both), Err(AttachSetError::Set(SetError::MissingJoints(_)))));
        assert_eq!(arm.mirror_muscle(MuscleId(0)), Err(EditError::NoMuscle(0).into()));
        assert!(!session.is_unsaved() && !arm.is_unsaved());
        // An arm without a side has muscles without one, and no other side.
        assert_eq!(arm.attach_set(MuscleSet::Arm, Sides::Both), Ok(6));
        assert!(arm.document().muscle_files().flat_map(|file| &file.muscles).all(|muscle| !muscle.name.contains('_')));
        assert!(matches!(arm.mirror_muscle(MuscleId(0)), Err(AttachSetError::Set(_))));
        assert_eq!(arm.document().muscle_count(), 6);
    }

    #[test]
    fn a_mirrored_muscle_is_that_of_the_other_side() {
        let mut session = open(&["walker.dae"]);
        session.attach_set(MuscleSet::Body, Sides::Both).unwrap();
        let whole = session.files_now().remove(0);
        session.undo();
        session.attach_set(MuscleSet::Body, Sides::One(BodySide::Right)).unwrap();
        let count = session.document().muscle_count();
        for index in 0..count {
            session.mirror_muscle(MuscleId(index as u32)).unwrap();
        }
        let mirrored = session.files_now().remove(0);
        assert_eq!(mirrored.muscles.len(), 2 * count);
        for (right, left) in mirrored.muscles.iter().zip(mirrored.muscles.iter().skip(count)) {
            let name = format!("{}_l", right.name.strip_suffix("_r").unwrap());
            assert_eq!(left.name, name);
            let made = whole.muscles.iter().find(|muscle| muscle.name == name).unwrap();
            for (a, b) in [(&left.origin, &made.origin), (&left.insertion, &made.insertion)] {
                let (a, b) = (a.as_ref().unwrap(), b.as_ref().unwrap());
                assert!(a.bone == b.bone && a.offset.distance(b.offset) < 1e-2, "{name}: {a:?} {b:?}");
            }
            for (a, b) in left.via.iter().zip(&made.via) {
                let joint = |via: &sinew_muscle::ViaPoint| via.active.as_ref().map(|active| active.joint.clone());
                assert!(a.place.offset.distance(b.place.offset) < 1e-2 && joint(a) == joint(b), "{name}: {a:?} {b:?}");
            }
            for (a, b) in left.wraps.iter().zip(&made.wraps) {
                assert!(a.center.bone == b.center.bone && a.center.offset.distance(b.center.offset) < 1e-2, "{name}");
            }
        }
        // Both sides have one length in every pose that is the same on both sides.
        session.frame();
        let length = |session: &Session, index: usize| {
            let (rig, own) = session.document().muscle(MuscleId(index as u32)).unwrap();
            let mut rest = Vec::new();
            let graph = &session.document().scene.graph;
            graph.world_from_local(&graph.rest_locals(), &mut rest);
            rig.solve(own, session.drive(), &rest).path_length
        };
        for index in 0..count {
            let (right, left) = (length(&session, index), length(&session, count + index));
            assert!((right - left).abs() < 1e-2, "{}: {right} {left}", mirrored.muscles[index].name);
        }
        session.undo();
        assert_eq!(session.document().muscle_count(), 2 * count - 1);
    }
}

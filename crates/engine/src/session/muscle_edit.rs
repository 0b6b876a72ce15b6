//! Edits of muscles: each is checked, can be undone, and stays unsaved until it is written.

use std::path::{Path, PathBuf};

use super::{ChangeSet, Session, UndoStep};
use crate::input;
use sinew_muscle::presets::Preset;
use sinew_muscle::{Edit, EditError, MuscleFile};
use sinew_scene::MuscleId;
use sinew_scene::limits;
use sinew_scene::message;
use sinew_scene::message::{Message, ToMessage};

impl Session {
    /// Changes muscle `id`.
    ///
    /// # Errors
    /// [`EditError`] where the change would make no muscle; nothing is changed then.
    pub fn edit_muscle(&mut self, id: MuscleId, edit: &Edit, step: UndoStep) -> Result<(), EditError> {
        let Some((place, index)) = self.document.file_of_muscle(id) else { return Err(EditError::NoMuscle(id.index())) };
        let mut files: Vec<MuscleFile> = self.document.muscle_files().cloned().collect();
        let Some(file) = files.get_mut(place) else { return Ok(()) };
        let mut edited = file.edited(index, edit)?;
        // The first muscle of a file that comes onto bones grows and shrinks with them from now on.
        if let Edit::Ends(Some([origin, _])) = edit
            && edited.arm.is_none()
            && file.muscles.iter().all(|muscle| muscle.origin.is_none())
        {
            let bone = self.bones_for(id).into_iter().find(|(_, name)| *name == origin.bone);
            edited.scale = edited.scale.or_else(|| self.scale_of_bone(bone?.0));
        }
        if edited != *file {
            *file = edited;
            self.change_files(&files, edit.message(), step);
        }
        Ok(())
    }

    /// Puts a ready muscle in place of muscle `id`: with its arm where the muscle lies on one or on nothing, else its shape alone.
    ///
    /// # Errors
    /// [`EditError`] where it cannot be; nothing is changed then.
    pub fn apply_preset(&mut self, id: MuscleId, preset: Preset) -> Result<(), EditError> {
        let Some((place, index)) = self.document.file_of_muscle(id) else { return Err(EditError::NoMuscle(id.index())) };
        let mut files: Vec<MuscleFile> = self.document.muscle_files().cloned().collect();
        let Some(file) = files.get_mut(place) else { return Ok(()) };
        let ready = preset.file();
        let whole = file.muscles.len() == 1 && (file.arm.is_some() || file.muscles.iter().all(|muscle| muscle.origin.is_none()));
        if whole {
            *file = ready;
        } else if let Some(muscle) = ready.muscles.first() {
            let scale = ready.unit_metres / file.unit_metres;
            let radii: Vec<f64> = muscle.profile.radii().iter().map(|radius| radius * scale).collect();
            // The length of the bones stays: it is they that the muscle must fit.
            *file = file.edited(index, &Edit::Nodes(radii, muscle.profile.growth().to_vec()))?;
        }
        self.change_files(&files, preset.name(), UndoStep::New);
        Ok(())
    }

    /// Puts muscle files that were kept aside back into the scene: as a change that is not saved and can be undone. Kept files that are fewer than those
    /// of the scene do not belong to it and change nothing.
    pub fn set_carried_files(&mut self, files: Vec<MuscleFile>) {
        if files.len() >= self.document.muscle_files().count() && !self.document.muscle_files().eq(&files) {
            self.change_files(&files, message!("app-edit-carried"), UndoStep::New);
        }
    }

    /// Whether a muscle file on the disk no longer says what it did when it was read or saved last. One that cannot be read says something else.
    pub fn is_changed_outside(&self) -> bool {
        let mut saved = self.saved_files.iter().enumerate();
        saved.any(|(index, saved)| {
            let path = self.document.muscle_file_path(index);
            path.is_some_and(|path| {
                input::read_text(path, limits::YAML_BYTES).ok().and_then(|text| MuscleFile::parse(&text).ok()).as_ref() != Some(saved)
            })
        })
    }

    /// Goes back to what was read or saved last; undo takes that back.
    pub fn revert(&mut self) {
        if self.is_unsaved() {
            let files = self.saved_files.clone();
            self.change_files(&files, message!("app-do-revert"), UndoStep::New);
        }
    }

    pub(super) fn change_files(&mut self, files: &[MuscleFile], label: Message, step: UndoStep) {
        self.undoable(label, step, |session| session.put_muscle_files(files));
    }

    /// Puts other muscle files in place, keeping the pose.
    pub(super) fn put_muscle_files(&mut self, files: &[MuscleFile]) {
        if self.document.muscle_files().eq(files) {
            return;
        }
        let before = (self.document.scene.graph.len(), self.document.muscle_count());
        self.document.set_muscle_files(files);
        // A file that is not kept anywhere yet was empty before.
        self.saved_files.resize(files.len(), MuscleFile::default());
        self.joint.muscles_changed();
        if let Some(rig) = self.document.driven_rig() {
            let drive = self.state.joints.drive;
            self.state.joints.drive =
                if rig.flexion_range().is_some() { rig.at_flexion(drive.flexion) } else { rig.at_contraction(drive.contraction) };
        }
        let count = self.document.scene.graph.len();
        for marked in [&mut self.view.display.highlight.selected, &mut self.view.display.highlight.hovered] {
            *marked = marked.filter(|node| node.index() < count);
        }
        self.shown_muscle.0 = self.shown_muscle.0.min((self.document.muscle_count() as u32).saturating_sub(1));
        self.changed(ChangeSet::EDIT | ChangeSet::DRIVE | ChangeSet::MUSCLE | ChangeSet::HISTORY);
        if before != (count, self.document.muscle_count()) {
            self.changed(ChangeSet::DOCUMENT | ChangeSet::TREE);
        }
    }

    /// Whether something of the muscles is not saved.
    pub fn is_unsaved(&self) -> bool {
        !self.document.muscle_files().eq(&self.saved_files)
    }

    /// The numbers of the muscle files that are not saved.
    pub fn unsaved_files(&self) -> Vec<usize> {
        let pairs = self.document.muscle_files().zip(&self.saved_files).enumerate();
        pairs.filter(|(_, (now, saved))| now != saved).map(|(index, _)| index).collect()
    }

    /// Muscle file `index` as it is to be written to `target`: a clip that it names is named from there.
    pub fn file_for(&self, index: usize, target: &Path) -> Option<MuscleFile> {
        let file = self.document.muscle_files().nth(index)?;
        Some(self.document.muscle_file_for(index, file, target))
    }

    /// Says that muscle file `index` was written to `path` as `file`.
    pub fn mark_saved(&mut self, index: usize, path: PathBuf, file: MuscleFile) {
        let mut files: Vec<MuscleFile> = self.document.muscle_files().cloned().collect();
        let before = files.clone();
        if let (Some(now), Some(saved)) = (files.get_mut(index), self.saved_files.get_mut(index)) {
            saved.clone_from(&file);
            *now = file;
        }
        self.document.set_muscle_file_path(index, path);
        if files != before {
            self.put_muscle_files(&files);
        }
        self.changed(ChangeSet::EDIT | ChangeSet::HISTORY | ChangeSet::PLAYBACK);
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use proptest::prelude::*;

    use super::*;
    use crate::document::{Document, PoseBuffers};
    use crate::session::tests::{biceps, clip};
    use sinew_muscle::{SkinSpec, Tendon};
    use sinew_scene::{Frame, Mesh};

    /// The surfaces of the muscles of a session, in the memory where they stand.
    fn meshes(session: &mut Session) -> Vec<*const Mesh> {
        session.frame().surfaces.iter().filter(|surface| surface.muscle.is_some()).map(|surface| Arc::as_ptr(&surface.mesh)).collect()
    }

    fn edit() -> impl Strategy<Value = Edit> {
        prop_oneof![
            (0..5_usize, 2.0..60.0).prop_map(|(node, radius)| Edit::Radius(node, radius)),
            (1..4_usize, 0.1..2.0).prop_map(|(node, growth)| Edit::Growth(node, growth)),
            (50.0..400.0).prop_map(Edit::RestLength),
            (0..2_usize, 0.0..60.0, 0.5..4.0).prop_map(|(end, length, radius)| Edit::Tendon(end, Tendon { length, radius })),
            (0..4_usize).prop_map(Edit::AddNode),
            (0.0..59.0).prop_map(Edit::Pennation),
            (0.0..9.0, 0.0..60.0, 0.0..1.0).prop_map(|(fat, reach, elasticity)| Edit::Skin(Some(SkinSpec { fat, reach, elasticity }))),
            Just(Edit::Name("same".into())),
        ]
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn a_muscle_that_is_reshaped_is_the_one_that_is_built_anew(edits in prop::collection::vec((0..2_u32, edit()), 1..6), time in 0.0..2.0) {
            let mut session = clip();
            session.new_muscle(biceps()).expect("a muscle");
            session.new_muscle(biceps()).expect("another");
            session.frame();
            for (muscle, edit) in edits {
                // A change that would make no muscle is refused.
                let _ = session.edit_muscle(MuscleId(muscle), &edit, UndoStep::New);
                session.frame();
            }
            session.time(|cursor| cursor.seek(time));
            let files: Vec<MuscleFile> = session.document().muscle_files().cloned().collect();
            // A file without muscles is no reshaping, so those that come back are built anew.
            let mut anew = session.document().clone();
            anew.set_muscle_files(&vec![MuscleFile::default(); files.len()]);
            anew.set_muscle_files(&files);
            let mut frame = Frame::default();
            anew.pose(&session.state(), &mut PoseBuffers::default(), &mut frame);
            let found = |document: &Document| {
                let mut found: Vec<String> = document.diagnostics.iter().map(|found| format!("{found:?}")).collect();
                found.sort();
                found
            };
            prop_assert_eq!(found(session.document()), found(&anew));
            let shown = session.frame();
            prop_assert_eq!(shown.surfaces.len(), frame.surfaces.len());
            for (ours, theirs) in shown.surfaces.iter().zip(&frame.surfaces) {
                let count = ours.mesh.positions.len() as u32;
                prop_assert_eq!((count, ours.node, ours.muscle, ours.skin), (theirs.mesh.positions.len() as u32, theirs.node, theirs.muscle, theirs.skin));
                prop_assert!((0..count).all(|vertex| ours.position(vertex) == theirs.position(vertex)));
            }
            prop_assert_eq!((&shown.joints.len(), &shown.world), (&frame.joints.len(), &frame.world));
        }
    }

    #[test]
    fn a_radius_on_a_clip_builds_no_muscle_anew() {
        let mut session = clip();
        session.new_muscle(biceps()).unwrap();
        session.new_muscle(biceps()).unwrap();
        let before = meshes(&mut session);
        let belly = |session: &mut Session| -> Vec<_> {
            let surface = session.frame().surfaces.iter().find(|surface| surface.muscle.is_some()).unwrap();
            (0..surface.mesh.positions.len() as u32).map(|vertex| surface.position(vertex)).collect()
        };
        let place = belly(&mut session);
        session.edit_muscle(MuscleId(0), &Edit::Radius(1, 9.0), UndoStep::New).unwrap();
        assert_eq!(meshes(&mut session), before);
        assert_ne!(belly(&mut session), place);
        session.edit_muscle(MuscleId(1), &Edit::AddNode(1), UndoStep::New).unwrap();
        let with_node = meshes(&mut session);
        assert!(with_node.len() == 2 && with_node[1] != before[1]);
        session.undo();
        session.undo();
        assert_eq!(belly(&mut session), place);
    }

    #[test]
    fn an_edit_is_unsaved_until_it_is_undone() {
        let mut session = Session::new(Document::built_in());
        let radius = |session: &Session| session.document().muscle_files().next().map(|file| file.muscles[0].profile.radii()[2]);
        let before = radius(&session);
        session.edit_muscle(MuscleId(0), &Edit::Radius(2, 33.0), UndoStep::New).unwrap();
        session.edit_muscle(MuscleId(0), &Edit::Radius(2, 34.0), UndoStep::Same).unwrap();
        assert!(session.is_unsaved() && radius(&session) == Some(34.0));
        assert_eq!(session.undo_names().0, Some(&Edit::Radius(2, 0.0).message()));
        let refused = session.edit_muscle(MuscleId(0), &Edit::Radius(2, -1.0), UndoStep::New);
        assert!(refused.is_err() && radius(&session) == Some(34.0));
        session.undo();
        assert!(!session.is_unsaved() && radius(&session) == before);
        session.redo();
        assert_eq!(radius(&session), Some(34.0));
        session.revert();
        assert_eq!((session.is_unsaved(), radius(&session)), (false, before));
    }

    #[test]
    fn a_thicker_layer_moves_the_skin_until_it_is_undone() {
        let mut session = clip();
        session.new_muscle(biceps()).unwrap();
        session.set_flexion(70.0);
        let skin = |session: &mut Session| -> Vec<_> {
            let surfaces = session.frame().surfaces.iter().filter(|surface| surface.skin);
            surfaces.flat_map(|surface| (0..surface.mesh.positions.len() as u32).map(|vertex| surface.position(vertex))).collect()
        };
        let usual = skin(&mut session);
        let unit = session.document().muscle_files().next().unwrap().unit_metres;
        let layer = |fat: f64| Edit::Skin(Some(SkinSpec { fat: fat / unit, ..SkinSpec::in_unit(unit) }));
        session.edit_muscle(MuscleId(0), &layer(0.012), UndoStep::New).unwrap();
        let thick = skin(&mut session);
        let farthest = usual.iter().zip(&thick).map(|(usual, thick)| usual.distance(*thick)).fold(0.0, f32::max);
        assert!((0.001..0.02).contains(&farthest), "{farthest} m");
        assert_eq!(session.undo_names().0, Some(&layer(0.0).message()));
        assert!(session.edit_muscle(MuscleId(0), &layer(-0.001), UndoStep::New).is_err());
        assert!(skin(&mut session) == thick);
        session.undo();
        assert!(skin(&mut session) == usual);
    }

    #[test]
    fn nodes_come_and_go_while_the_scene_stays() {
        let mut session = Session::new(Document::built_in());
        let nodes = session.document().scene.graph.len();
        session.set_flexion(60.0);
        session.edit_muscle(MuscleId(0), &Edit::AddNode(1), UndoStep::New).unwrap();
        assert_eq!((session.document().scene.graph.len(), session.drive().flexion), (nodes, 60.0));
        assert!(!session.frame().bounds.is_empty());
        for preset in sinew_muscle::presets::PRESETS {
            session.apply_preset(MuscleId(0), preset).unwrap();
            assert!(!session.frame().bounds.is_empty(), "{}", preset.id);
        }
    }
}

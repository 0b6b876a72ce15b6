//! Adding, copying and deleting muscles on the arm or on the bones of a clip; each is one undo step.

use super::joint_control::bones;
use super::{ChangeSet, Session, UndoStep};
use crate::document::{PoseBuffers, PoseState};
use sinew_i18n::Sentence;
use sinew_muscle::presets::Preset;
use sinew_muscle::{Anchor, Edit, EditError, Form, JointDof, MuscleFile, MuscleSpec, ViaPoint, Wrap, bone_scale};
use sinew_scene::message;
use sinew_scene::message::Message;
use sinew_scene::{Content, Frame, MuscleId, NodeId};

impl Session {
    /// The muscle that panels and handles show.
    pub fn shown_muscle(&self) -> MuscleId {
        self.shown_muscle
    }

    /// Shows another muscle.
    pub fn show_muscle(&mut self, id: MuscleId) {
        if id != self.shown_muscle && id.index() < self.document.muscle_count() {
            self.shown_muscle = id;
            self.changed(ChangeSet::MUSCLE);
        }
    }

    /// Adds a ready muscle: on the arm of the muscle shown, else on the two bones that meet in the selected joint or in the elbow. Where there are none it
    /// lies on its own. It is shown and selected.
    ///
    /// # Errors
    /// [`EditError`] where there are too many; nothing is changed then.
    pub fn new_muscle(&mut self, preset: Preset) -> Result<(), EditError> {
        let ready = preset.file();
        let Some(model) = ready.muscles.first() else { return Ok(()) };
        let mut files = self.files_now();
        let joint = self.joint_for_new();
        let place = match self.document.file_of_muscle(self.shown_muscle) {
            Some((place, _)) if joint.is_none() || files.get(place).is_some_and(|file| file.arm.is_none()) => place,
            _ => files.iter().position(|file| file.arm.is_none()).unwrap_or(files.len()),
        };
        if place == files.len() {
            files.push(MuscleFile { form: Form::Rich, scale: joint.and_then(|joint| self.bones_scale(&joint)), ..MuscleFile::default() });
        }
        let Some(file) = files.get_mut(place) else { return Ok(()) };
        let scale = ready.unit_metres / file.unit_metres;
        let mut spec = model.scaled(scale, model.profile.rest_length() * scale)?;
        spec.name = unused_name(file, &preset.muscle_name().sentence());
        if let (Some(arm), Some(of)) = (file.arm, ready.arm) {
            spec = MuscleSpec { name: spec.name, ..on_arm(model, arm.upper / of.upper)? };
        }
        *file = file.with_muscle(spec)?;
        let id = id_of(&files, place, usize::MAX);
        self.change_files(&files, message!("muscle-edit-new"), UndoStep::New);
        // Only now that its file is in the scene has the muscle axes to be laid in.
        let fitted = joint.and_then(|joint| self.fitted(id, model, &ready, &joint));
        if fitted.is_none() {
            self.joint.twisted = joint.filter(|joint| self.twists(joint)).map(|joint| (id, joint.node));
        }
        if let Some(fitted) = fitted {
            let name = files.get(place).and_then(|file| file.muscles.last()).map(|muscle| muscle.name.clone()).unwrap_or_default();
            if let Some(slot) = files.get_mut(place).and_then(|file| file.muscles.last_mut()) {
                *slot = MuscleSpec { name, ..fitted };
            }
            self.put_muscle_files(&files);
        }
        self.shown_muscle = id;
        self.select(self.node_of_muscle(id));
        self.changed(ChangeSet::MUSCLE);
        Ok(())
    }

    /// The scale of the bones that muscles on the two limbs of a joint are fitted to: they grow and shrink with them.
    pub(super) fn bones_scale(&self, joint: &JointDof) -> Option<f64> {
        let [above, ..] = JointDof::limbs(&self.document.scene, joint.node)?;
        self.scale_of_bone(above)
    }

    /// The scale of a bone at rest.
    pub(super) fn scale_of_bone(&self, bone: NodeId) -> Option<f64> {
        let (graph, mut world) = (&self.document.scene.graph, Vec::new());
        graph.world_from_local(&graph.rest_locals(), &mut world);
        Some(bone_scale(graph, &world, bone)).filter(|scale| *scale > 0.0 && scale.is_finite())
    }

    /// The joint whose limbs a new muscle joins: the selected bone, else the one that the slider bends. `None` where the muscle shown is on an arm and no
    /// bone of a clip is selected.
    fn joint_for_new(&self) -> Option<JointDof> {
        let selected = self.selected().filter(|node| bones(&self.document).contains(node));
        let scene = &self.document.scene;
        match selected {
            Some(node) => JointDof::at_node(scene, &self.document.clips, node).or_else(|| self.joint()),
            None if self.bends_arm() => None,
            None => self.joint(),
        }
    }

    pub(super) fn twists(&self, joint: &JointDof) -> bool {
        joint.twists(&self.document.scene, &self.straight(joint).world)
    }

    /// Why the muscle that is shown lies on its own although there are bones that could carry it; `None` where it does not.
    pub fn standalone_reason(&self) -> Option<Message> {
        let (rig, index) = self.document.muscle(self.shown_muscle)?;
        let alone = !rig.is_attached(index) && rig.flexion_range().is_none() && !bones(&self.document).is_empty();
        let twisted = self.joint.twisted.filter(|(id, _)| *id == self.shown_muscle);
        let graph = &self.document.scene.graph;
        alone.then(|| match twisted.filter(|(_, node)| node.index() < graph.len()) {
            Some((_, node)) => message!("app-not-attached-twist", joint = graph.label(node)),
            None => message!("app-not-attached"),
        })
    }

    fn fitted(&self, id: MuscleId, model: &MuscleSpec, ready: &MuscleFile, joint: &JointDof) -> Option<MuscleSpec> {
        let (rig, _) = self.document.muscle(id)?;
        rig.fitted(model, ready, joint, &self.document.scene, &self.straight(joint).world)
    }

    /// The nodes of the scene with a joint straight.
    pub(super) fn straight(&self, joint: &JointDof) -> Frame {
        let straight = PoseState::default().with_rotation(Some(joint.absolute(0.0)));
        let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
        self.document.pose_nodes(&straight, &mut buffers, &mut frame);
        frame
    }

    /// Adds a copy of muscle `id` and shows it.
    ///
    /// # Errors
    /// [`EditError`] where there are too many, or no such muscle; nothing is changed then.
    pub fn duplicate_muscle(&mut self, id: MuscleId) -> Result<(), EditError> {
        let Some((place, index)) = self.document.file_of_muscle(id) else { return Err(EditError::NoMuscle(id.index())) };
        let mut files = self.files_now();
        let Some(file) = files.get_mut(place) else { return Ok(()) };
        let Some(mut copy) = file.muscles.get(index).cloned() else { return Err(EditError::NoMuscle(index)) };
        let name = self.document.muscle(id).map(|(rig, index)| sinew_i18n::label(rig.label(index)).into_owned()).unwrap_or_default();
        copy.name = unused_name(file, &name);
        file.form = Form::Rich;
        *file = file.with_muscle(copy)?;
        let copied = id_of(&files, place, usize::MAX);
        self.change_files(&files, message!("muscle-edit-duplicate"), UndoStep::New);
        self.shown_muscle = copied;
        self.select(self.node_of_muscle(copied));
        self.changed(ChangeSet::MUSCLE);
        Ok(())
    }

    /// Takes muscle `id` away. The last one of a file that was never saved takes the file with it.
    ///
    /// # Errors
    /// [`EditError`] where it is the last one of a file that is kept somewhere, or of the only scene there is; nothing is changed then.
    pub fn delete_muscle(&mut self, id: MuscleId) -> Result<(), EditError> {
        let Some((place, index)) = self.document.file_of_muscle(id) else { return Err(EditError::NoMuscle(id.index())) };
        let mut files = self.files_now();
        let last = place + 1 == files.len();
        let Some(file) = files.get_mut(place) else { return Ok(()) };
        let passing = self.document.muscle_file_path(place).is_none() && self.document.sources.len() > 1;
        // Only the last file can go: the others are told apart by their order.
        if file.muscles.len() == 1 && passing && last {
            files.pop();
        } else {
            *file = file.without_muscle(index)?;
        }
        self.change_files(&files, message!("muscle-edit-delete"), UndoStep::New);
        let count = self.document.muscle_count() as u32;
        self.shown_muscle = MuscleId(self.shown_muscle.0.min(count.saturating_sub(1)));
        self.select(None);
        self.changed(ChangeSet::MUSCLE);
        Ok(())
    }

    /// The node that carries muscle `id`.
    pub fn node_of_muscle(&self, id: MuscleId) -> Option<NodeId> {
        let carries = |contents: &[Content]| contents.iter().any(|content| matches!(content, Content::Muscle(muscle) if *muscle == id));
        self.document.scene.graph.iter().find(|(_, node)| carries(&node.contents)).map(|(id, _)| id)
    }

    /// The bones that muscle `id` can be attached to, with what its file calls each.
    pub fn bones_for(&self, id: MuscleId) -> Vec<(NodeId, String)> {
        let Some((rig, _)) = self.document.muscle(id) else { return Vec::new() };
        let graph = &self.document.scene.graph;
        let nodes = rig.arm_bones().map_or_else(|| bones(&self.document), |bones| bones.to_vec());
        nodes.into_iter().filter_map(|node| Some((node, rig.bone_name(graph, node)?))).collect()
    }

    /// The present length of muscle `id` becomes its rest length, its thickness stays.
    ///
    /// # Errors
    /// [`EditError`] where no bones hold it apart.
    pub fn fit_length(&mut self, id: MuscleId, step: UndoStep) -> Result<(), EditError> {
        self.frame();
        let Some((rig, index)) = self.document.muscle(id) else { return Err(EditError::NoMuscle(id.index())) };
        let solved = rig.solve(index, self.state.joints.drive, &self.frame.world);
        let tendons = rig.spec(index).map_or(0.0, MuscleSpec::tendon_length);
        let length = (1e3 * (solved.path_length / rig.scale(index) - tendons)).round() / 1e3;
        self.edit_muscle(id, &Edit::RestLength(length), step)
    }

    pub(super) fn files_now(&self) -> Vec<MuscleFile> {
        self.document.muscle_files().cloned().collect()
    }
}

/// A ready muscle on an arm whose upper rod has `scale` times the length, in numbers, of the one that it was made for.
fn on_arm(model: &MuscleSpec, scale: f64) -> Result<MuscleSpec, EditError> {
    let anchor = |anchor: &Anchor| Anchor { bone: anchor.bone.clone(), offset: (anchor.offset * scale * 1e3).round() / 1e3 };
    let mut spec = model.scaled(scale, model.profile.rest_length() * scale)?;
    (spec.origin, spec.insertion) = (model.origin.as_ref().map(anchor), model.insertion.as_ref().map(anchor));
    spec.via = model.via.iter().map(|via| ViaPoint { place: anchor(&via.place), ..via.clone() }).collect();
    spec.wraps =
        model.wraps.iter().map(|wrap| Wrap { center: anchor(&wrap.center), shape: wrap.shape.scaled(scale), ..wrap.clone() }).collect();
    Ok(spec)
}

/// The number of a muscle among all: the last one of its file for an index past the end.
pub(super) fn id_of(files: &[MuscleFile], place: usize, index: usize) -> MuscleId {
    let before: usize = files.iter().take(place).map(|file| file.muscles.len()).sum();
    let own = files.get(place).map_or(0, |file| file.muscles.len().saturating_sub(1));
    MuscleId((before + index.min(own)) as u32)
}

/// The name, with the next free number where it is taken.
pub(super) fn unused_name(file: &MuscleFile, name: &str) -> String {
    let taken = |name: &str| file.muscles.iter().any(|muscle| muscle.name == name);
    let numbered = (2..).map(|number| format!("{name} {number}"));
    std::iter::once(name.to_owned()).chain(numbered).find(|name| !taken(name)).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::Document;
    use crate::session::JointAxis;
    use crate::session::tests::{biceps, clip, ends};
    use sinew_muscle::presets::PRESETS;

    #[test]
    fn a_new_muscle_joins_the_bones_of_the_elbow_and_goes_again() {
        let mut session = clip();
        let nodes = session.document().scene.graph.len();
        for (number, preset) in PRESETS.into_iter().enumerate() {
            session.new_muscle(preset).unwrap();
            let id = session.shown_muscle();
            assert_eq!((id.index(), session.document().muscle_count()), (number, number + 1));
            let names = ends(&session, id).map(|node| session.document().scene.graph.node(node.unwrap()).name.clone());
            assert_eq!(names, ["upper_arm", "forearm"], "{}", preset.id);
            let (rig, index) = session.document().muscle(id).unwrap();
            let (index, rest) = (index, rig.spec(index).unwrap().profile.rest_length());
            session.set_flexion(0.0);
            session.frame();
            let (rig, _) = session.document().muscle(id).unwrap();
            let straight = rig.solve(index, session.drive(), &session.posed().world).length;
            assert!((straight / rest - 1.0).abs() < 1e-3, "{}: {straight} {rest}", preset.id);
        }
        assert_eq!(session.document().muscle_files().count(), 1);
        for _ in PRESETS {
            session.undo();
        }
        assert_eq!((session.document().muscle_count(), session.document().scene.graph.len()), (0, nodes));
        assert!(!session.is_unsaved());
        session.redo();
        assert!(session.is_unsaved() && session.document().muscle_count() == 1);
    }

    #[test]
    fn a_muscle_on_its_own_says_why() {
        let mut session = clip();
        let node = session.joint().unwrap().node;
        let mut twisted = 0;
        for axis in 0..3 {
            session.choose_joint(Some((node, JointAxis::Own(axis))));
            session.new_muscle(biceps()).unwrap();
            let (rig, index) = session.document().muscle(session.shown_muscle()).unwrap();
            let attached = rig.is_attached(index);
            let why = session.standalone_reason();
            assert_eq!(why.is_none(), attached, "{axis}");
            twisted += usize::from(
                why.is_some_and(|why| why.key == "app-not-attached-twist" && why.parameter("joint") == Some(&"forearm".into())),
            );
            session.undo();
        }
        assert_eq!(twisted, 1, "one of a bone's own axes runs along it");
        session.choose_joint(None);
        session.new_muscle(biceps()).unwrap();
        assert_eq!(session.standalone_reason(), None);
        assert_eq!(Session::new(Document::built_in()).standalone_reason(), None, "an arm carries it");
    }

    #[test]
    fn a_flexor_shortens_and_an_extensor_lengthens() {
        for (id, sign) in [("biceps", -1.0), ("brachialis", -1.0), ("triceps", 1.0)] {
            let mut session = clip();
            session.new_muscle(Preset::by_id(id).unwrap()).unwrap();
            let mut length = |degrees: f64| {
                session.set_flexion(degrees);
                session.frame();
                let (rig, index) = session.document().muscle(session.shown_muscle()).unwrap();
                rig.solve(index, session.drive(), &session.posed().world).path_length
            };
            assert!((length(100.0) - length(10.0)) * sign > 5.0, "{id}");
        }
    }

    #[test]
    fn a_preset_on_a_clip_keeps_the_sign_of_its_moment_arm_and_scales_with_the_bones() {
        for (id, sign) in [("biceps", 1.0), ("brachialis", 1.0), ("triceps", -1.0)] {
            let mut session = clip();
            session.new_muscle(Preset::by_id(id).unwrap()).unwrap();
            assert_eq!(session.document().muscle_files().map(|file| file.scale).collect::<Vec<_>>(), [Some(1.0)]);
            let found: Vec<&str> = session.document().diagnostics.iter().map(|finding| finding.code()).collect();
            let wrong = ["muscle-wrap-inert", "moment-arm-changes-sign", "muscle-path-jumps", "muscle-too-short"];
            assert!(!found.iter().any(|code| wrong.contains(code)), "{id}: {found:?}");
            let joint = session.joint().unwrap();
            for degrees in 0..=150 {
                session.set_flexion(f64::from(degrees).min(joint.range[1]));
                session.frame();
                let (rig, index) = session.document().muscle(session.shown_muscle()).unwrap();
                let arm = rig.moment_arm(index, &session.document().scene, &session.posed().world).unwrap();
                assert!(arm * sign > 5.0, "{id}: {arm} at {degrees}°");
            }
        }
    }

    #[test]
    fn a_dragged_end_follows_the_pointer_on_its_bone() {
        let mut session = clip();
        session.new_muscle(biceps()).unwrap();
        let (id, size) = (session.shown_muscle(), glam::DVec2::new(900.0, 600.0));
        session.set_flexion(70.0);
        for grip in session.attachment_handles(size) {
            let drag = super::super::AttachmentDrag { muscle: id, handle: grip, from: grip.screen_position };
            let to = grip.screen_position + glam::DVec2::new(23.0, -11.0);
            session.drag_attachment(&drag, to, size, UndoStep::New).unwrap();
            let moved = session.attachment_handles(size).into_iter().find(|moved| moved.attachment == grip.attachment).unwrap();
            assert!(moved.screen_position.distance(to) < 0.5, "{:?}: {} {to}", grip.attachment, moved.screen_position);
            session.undo();
            let back = session.attachment_handles(size).into_iter().find(|back| back.attachment == grip.attachment).unwrap();
            assert!(back.screen_position.distance(grip.screen_position) < 1e-6);
        }
        assert_eq!(session.attachment_handle_at(glam::DVec2::new(-50.0, -50.0), size), None);
    }

    #[test]
    fn copies_get_names_of_their_own_and_the_last_muscle_of_a_kept_file_stays() {
        let mut session = clip();
        session.new_muscle(biceps()).unwrap();
        session.duplicate_muscle(session.shown_muscle()).unwrap();
        let names: Vec<String> =
            session.document().muscle_files().flat_map(|file| &file.muscles).map(|muscle| muscle.name.clone()).collect();
        assert!(names.len() == 2 && names[0] != names[1] && names[1].starts_with(&names[0]), "{names:?}");
        session.delete_muscle(MuscleId(0)).unwrap();
        session.delete_muscle(MuscleId(0)).unwrap();
        assert_eq!(session.document().muscle_files().count(), 0);

        let mut arm = Session::new(Document::built_in());
        arm.new_muscle(biceps()).unwrap();
        assert_eq!(arm.document().muscle_files().next().map(|file| file.muscles.len()), Some(2));
        arm.delete_muscle(MuscleId(1)).unwrap();
        assert_eq!(arm.delete_muscle(MuscleId(0)), Err(EditError::Count));
    }
}

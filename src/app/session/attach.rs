//! Muscles come, go and are attached: new ones on the arm or on the bones of a clip, ends picked and dragged. Each is one step of undo.

use glam::DVec3;

use super::joint::bones;
use super::workshop::Step;
use super::{Changes, Session};
use crate::document::{PoseBuffers, PoseState};
use crate::muscle::presets::Preset;
use crate::muscle::{Anchor, Edit, EditError, Form, Handhold, Joint, MuscleFile, MuscleSpec, Wrap};
use crate::render::Pick;
use crate::scene::{Content, Frame, MuscleId, NodeId};
use crate::tr;

/// Share of a bone's length from its beginning at which a bone chosen by name is held.
const ALONG: f64 = 0.15;
/// A point picked on the skin lies this share of the way from the bone to the skin.
const UNDER_SKIN: f64 = 0.4;

/// An end of a muscle that the next click gives a place.
#[derive(Debug, Clone, PartialEq)]
pub struct Picking {
    /// The muscle.
    pub muscle: MuscleId,
    /// Origin (0) or insertion (1).
    pub end: usize,
    /// The origin, of a muscle that had none, while its insertion is still to be picked.
    first: Option<Anchor>,
    /// How bones were shown before: bones, and through surfaces.
    bones: [bool; 2],
}

impl Session {
    /// The muscle that panels and handles show.
    pub fn shown_muscle(&self) -> MuscleId {
        self.shown_muscle
    }

    /// Shows another muscle.
    pub fn show_muscle(&mut self, id: MuscleId) {
        if id != self.shown_muscle && id.index() < self.document.muscle_count() {
            self.shown_muscle = id;
            self.changed(Changes::MUSCLE);
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
            files.push(MuscleFile { form: Form::Rich, ..MuscleFile::default() });
        }
        let Some(file) = files.get_mut(place) else { return Ok(()) };
        let scale = ready.unit_metres / file.unit_metres;
        let mut spec = model.scaled(scale, model.profile.rest_length() * scale)?;
        spec.name = unused_name(file, &preset.muscle_name());
        if let (Some(arm), Some(of)) = (file.arm, ready.arm) {
            spec = MuscleSpec { name: spec.name, ..on_arm(model, arm.upper / of.upper)? };
        }
        *file = file.with_muscle(spec)?;
        let id = id_of(&files, place, usize::MAX);
        self.change_files(&files, tr!("muscle-edit-new"), Step::New);
        // Only now that its file is in the scene has the muscle axes to be laid in.
        if let Some(fitted) = joint.and_then(|joint| self.fitted(id, model, &ready, &joint)) {
            let name = files.get(place).and_then(|file| file.muscles.last()).map(|muscle| muscle.name.clone()).unwrap_or_default();
            if let Some(slot) = files.get_mut(place).and_then(|file| file.muscles.last_mut()) {
                *slot = MuscleSpec { name, ..fitted };
            }
            self.put_muscle_files(&files);
        }
        self.shown_muscle = id;
        self.select(self.node_of_muscle(id));
        self.changed(Changes::MUSCLE);
        Ok(())
    }

    /// The joint whose limbs a new muscle joins: the selected bone, else the one that the slider bends. `None` where the muscle shown is on an arm and no
    /// bone of a clip is selected.
    fn joint_for_new(&self) -> Option<Joint> {
        let selected = self.selected().filter(|node| bones(&self.document).contains(node));
        let scene = &self.document.scene;
        match selected {
            Some(node) => Joint::at_node(scene, &self.document.clips, node).or_else(|| self.joint()),
            None if self.bends_arm() => None,
            None => self.joint(),
        }
    }

    fn fitted(&self, id: MuscleId, model: &MuscleSpec, ready: &MuscleFile, joint: &Joint) -> Option<MuscleSpec> {
        let (rig, _) = self.document.muscle(id)?;
        let straight = PoseState { turn: Some(joint.at(0.0)), ..PoseState::default() };
        let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
        self.document.pose_nodes(&straight, &mut buffers, &mut frame);
        rig.fitted(model, ready, joint, &self.document.scene, &frame.world)
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
        let name = self.document.muscle(id).map(|(rig, index)| rig.name(index).to_owned()).unwrap_or_default();
        copy.name = unused_name(file, &name);
        file.form = Form::Rich;
        *file = file.with_muscle(copy)?;
        let copied = id_of(&files, place, usize::MAX);
        self.change_files(&files, tr!("muscle-edit-duplicate"), Step::New);
        self.shown_muscle = copied;
        self.select(self.node_of_muscle(copied));
        self.changed(Changes::MUSCLE);
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
        self.change_files(&files, tr!("muscle-edit-delete"), Step::New);
        let count = self.document.muscle_count() as u32;
        self.shown_muscle = MuscleId(self.shown_muscle.0.min(count.saturating_sub(1)));
        self.select(None);
        self.changed(Changes::MUSCLE);
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

    /// Begins to pick the bone of an end: origin (0) or insertion (1). Bones show through everything meanwhile.
    pub fn start_picking(&mut self, muscle: MuscleId, end: usize) {
        self.stop_picking();
        let Some((rig, index)) = self.document.muscle(muscle) else { return };
        // A muscle that lies on its own needs both, its origin first.
        let end = if rig.is_attached(index) { end } else { 0 };
        self.picking = Some(Picking { muscle, end, first: None, bones: [self.display.bones, self.display.xray] });
        (self.display.bones, self.display.xray) = (true, true);
        self.changed(Changes::PICKING | Changes::DISPLAY);
    }

    /// Leaves picking; whether there was any.
    pub fn stop_picking(&mut self) -> bool {
        let Some(picking) = self.picking.take() else { return false };
        [self.display.bones, self.display.xray] = picking.bones;
        self.changed(Changes::PICKING | Changes::DISPLAY);
        true
    }

    /// What is being picked.
    pub fn picking(&self) -> Option<&Picking> {
        self.picking.as_ref()
    }

    /// A click in the picture while an end is picked. A click beside everything changes nothing.
    ///
    /// # Errors
    /// [`EditError`] where the end cannot be there.
    pub fn pick_at(&mut self, pick: Option<Pick>) -> Result<(), EditError> {
        let Some(pick) = pick else { return Ok(()) };
        self.frame();
        let Some((node, place)) = self.bone_under(&pick) else { return Ok(()) };
        self.pick_place(node, place)
    }

    /// A bone chosen by name while an end is picked.
    ///
    /// # Errors
    /// [`EditError`] where the end cannot be there.
    pub fn pick_bone(&mut self, node: NodeId) -> Result<(), EditError> {
        self.frame();
        let place = self.place_along(node);
        self.pick_place(node, place)
    }

    fn pick_place(&mut self, node: NodeId, place: DVec3) -> Result<(), EditError> {
        let Some(Picking { muscle, end, first, .. }) = self.picking.clone() else { return Ok(()) };
        let Some((rig, index)) = self.document.muscle(muscle) else { return Ok(()) };
        let Some(anchor) = rig.anchor_at(&self.document.scene.graph, node, place, &self.frame.world) else { return Err(EditError::NoName) };
        if rig.is_attached(index) {
            self.stop_picking();
            return self.edit_muscle(muscle, &Edit::End(end, anchor), Step::New);
        }
        match first {
            None => {
                if let Some(picking) = &mut self.picking {
                    (picking.first, picking.end) = (Some(anchor), 1);
                }
                self.changed(Changes::PICKING);
                Ok(())
            }
            Some(origin) => {
                self.edit_muscle(muscle, &Edit::Ends(Some([origin, anchor])), Step::New)?;
                self.stop_picking();
                self.fit_length(muscle, Step::Same)
            }
        }
    }

    /// The present length of muscle `id` becomes its rest length, its thickness stays.
    ///
    /// # Errors
    /// [`EditError`] where no bones hold it apart.
    pub fn fit_length(&mut self, id: MuscleId, step: Step) -> Result<(), EditError> {
        self.frame();
        let Some((rig, index)) = self.document.muscle(id) else { return Err(EditError::NoMuscle(id.index())) };
        let solved = rig.solve(index, self.state.drive, &self.frame.world);
        let tendons = rig.spec(index).map_or(0.0, MuscleSpec::tendon_length);
        let length = (1e3 * (solved.path_length - tendons)).round() / 1e3;
        self.edit_muscle(id, &Edit::RestLength(length), step)
    }

    /// Puts an end on another bone, or takes the muscle off all bones (`None`).
    ///
    /// # Errors
    /// [`EditError`] where the end cannot be there.
    pub fn attach_to(&mut self, id: MuscleId, end: usize, node: Option<NodeId>) -> Result<(), EditError> {
        let Some((rig, index)) = self.document.muscle(id) else { return Err(EditError::NoMuscle(id.index())) };
        let attached = rig.is_attached(index);
        let Some(node) = node else { return self.edit_muscle(id, &Edit::Ends(None), Step::New) };
        if attached && rig.hold_bone(index, Handhold::End(end)) == Some(node) {
            return Ok(());
        }
        let mut picking = self.picking.clone();
        if !picking.as_ref().is_some_and(|picking| picking.muscle == id && picking.end == end) {
            self.start_picking(id, end);
            picking = self.picking.clone();
        }
        match picking {
            Some(picking) if picking.end == end => self.pick_bone(node),
            _ => Ok(()),
        }
    }

    /// The bone that a picked point belongs to, and where on it an end goes: a bone itself, the arm's rods, or the joint that a skin follows most there.
    fn bone_under(&self, pick: &Pick) -> Option<(NodeId, DVec3)> {
        let point = pick.point.as_dvec3();
        let (Some(index), Some(muscle)) = (pick.surface, self.picking.as_ref().map(|picking| picking.muscle)) else {
            return Some((pick.node, point));
        };
        let (rig, _) = self.document.muscle(muscle)?;
        if rig.arm_bones().is_some() {
            return rig.bone_name(&self.document.scene.graph, pick.node).map(|_| (pick.node, point));
        }
        let surface = self.frame.surfaces.get(index as usize).filter(|surface| surface.muscle.is_none())?;
        let node = self.strongest_joint(index as usize, &surface.mesh.triangles, pick).unwrap_or(pick.node);
        let begin = self.frame.position(node).as_dvec3();
        let along = self.way_along(node);
        let on_bone = begin + along * ((point - begin).dot(along) / along.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        Some((node, on_bone + (point - on_bone) * UNDER_SKIN))
    }

    /// The joint that the corner nearest to a picked point follows most.
    fn strongest_joint(&self, surface: usize, triangles: &[[u32; 3]], pick: &Pick) -> Option<NodeId> {
        let shares = pick.barycentric.to_array();
        let corners = triangles.get(pick.triangle as usize)?.iter().zip(shares);
        let (vertex, _) = corners.max_by(|a, b| a.1.total_cmp(&b.1))?;
        let explained = self.document.explain(&self.buffers, &self.frame, surface, *vertex)?;
        explained.shares.iter().max_by(|a, b| a.weight.total_cmp(&b.weight))?.node
    }

    /// From where a bone begins to where the farthest bone on it does, metres; nothing for a last bone.
    fn way_along(&self, node: NodeId) -> DVec3 {
        let begin = self.frame.position(node);
        let children = self.document.scene.graph.node(node).children();
        let ways = children.iter().map(|child| self.frame.position(*child) - begin).filter(|way| way.is_finite());
        ways.max_by(|a, b| a.length_squared().total_cmp(&b.length_squared())).unwrap_or_default().as_dvec3()
    }

    fn place_along(&self, node: NodeId) -> DVec3 {
        self.frame.position(node).as_dvec3() + self.way_along(node) * ALONG
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
    spec.via = model.via.iter().map(anchor).collect();
    spec.wrap = model.wrap.as_ref().map(|wrap| {
        let radius = (wrap.radius * scale * 1e3).round() / 1e3;
        Wrap { center: anchor(&wrap.center), radius, side: wrap.side }
    });
    Ok(spec)
}

/// The number of a muscle among all: the last one of its file for an index past the end.
fn id_of(files: &[MuscleFile], place: usize, index: usize) -> MuscleId {
    let before: usize = files.iter().take(place).map(|file| file.muscles.len()).sum();
    let own = files.get(place).map_or(0, |file| file.muscles.len().saturating_sub(1));
    MuscleId((before + index.min(own)) as u32)
}

/// The name, with the next free number where it is taken.
fn unused_name(file: &MuscleFile, name: &str) -> String {
    let taken = |name: &str| file.muscles.iter().any(|muscle| muscle.name == name);
    let numbered = (2..).map(|number| format!("{name} {number}"));
    std::iter::once(name.to_owned()).chain(numbered).find(|name| !taken(name)).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collada::Progress;
    use crate::document::Document;
    use crate::muscle::presets::PRESETS;

    /// The demo's arm, whose elbow is the joint `forearm`.
    fn clip() -> Session {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/configs/curl.dae");
        Session::new(Document::open(&[path], &Progress::default()).unwrap())
    }

    fn biceps() -> Preset {
        Preset::by_id("biceps").unwrap()
    }

    fn ends(session: &Session, id: MuscleId) -> [Option<NodeId>; 2] {
        let (rig, index) = session.document().muscle(id).unwrap();
        [0, 1].map(|end| rig.hold_bone(index, Handhold::End(end)))
    }

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
    fn contraction_and_the_joint_of_a_clip_are_one_state() {
        let mut session = clip();
        assert_eq!((session.contraction(), session.bend().map(|bend| bend.range)), (None, Some(0.0..=150.0)));
        session.new_muscle(biceps()).unwrap();
        for (on_top, time) in [(false, 0.0), (true, 0.0), (true, 1.3)] {
            session.set_on_top(on_top);
            session.time(|cursor| cursor.seek(time));
            session.set_contraction(60.0);
            let (angle, contraction) = (session.joint_angle().unwrap(), session.contraction().unwrap());
            assert!((contraction - 60.0).abs() < 1e-6, "{contraction}");
            session.set_contraction(10.0);
            let bend = session.bend().unwrap().value + angle - session.joint_angle().unwrap();
            session.set_flexion(bend);
            assert!((session.contraction().unwrap() - 60.0).abs() < 1e-6);
        }
        let turned = session.joint_angle();
        session.set_on_top(false);
        assert!((session.joint_angle().unwrap() - turned.unwrap()).abs() < 1e-6, "the pose stays");
        session.release_joint();
        assert_eq!(session.state().turn, None);
    }

    #[test]
    fn the_slider_does_what_the_command_line_does() {
        let mut session = clip();
        let joint = session.document().joint().unwrap();
        session.set_flexion(75.0);
        assert_eq!(session.state().turn, Some(joint.at(75.0)));
        session.set_on_top(true);
        session.set_flexion(-20.0);
        assert_eq!(session.state().turn, Some(joint.by(-20.0)));
    }

    #[test]
    fn another_joint_turns_about_its_own_axis() {
        let mut session = clip();
        let hand = session.document().scene.graph.find("hand").unwrap();
        session.choose_joint(Some((hand, super::super::JointAxis::Own(0))));
        session.set_flexion(40.0);
        assert!((session.joint_angle().unwrap() - 40.0).abs() < 1e-9);
        assert_eq!(session.bend().unwrap().range, -150.0..=150.0);
        session.choose_joint(None);
        assert_eq!((session.state().turn, session.chosen_joint()), (None, None));
    }

    #[test]
    fn ends_are_picked_one_after_the_other() {
        let mut session = clip();
        session.new_muscle(biceps()).unwrap();
        let id = session.shown_muscle();
        session.edit_muscle(id, &Edit::Ends(None), Step::New).unwrap();
        let bones = session.display().bones;
        let find = |session: &Session, name: &str| session.document().scene.graph.find(name).unwrap();
        session.start_picking(id, 1);
        assert_eq!(session.picking().map(|picking| picking.end), Some(0), "a muscle on its own needs an origin first");
        session.pick_bone(find(&session, "upper_arm")).unwrap();
        assert_eq!(session.picking().map(|picking| picking.end), Some(1));
        session.pick_bone(find(&session, "hand")).unwrap();
        assert!(session.picking().is_none() && session.display().bones == bones);
        assert_eq!(ends(&session, id), [Some(find(&session, "upper_arm")), Some(find(&session, "hand"))]);
        session.undo();
        assert_eq!(ends(&session, id), [None, None]);
        session.start_picking(id, 0);
        assert!(session.stop_picking() && !session.stop_picking());
    }

    #[test]
    fn a_dragged_end_follows_the_pointer_on_its_bone() {
        let mut session = clip();
        session.new_muscle(biceps()).unwrap();
        let (id, size) = (session.shown_muscle(), glam::DVec2::new(900.0, 600.0));
        session.set_flexion(70.0);
        for grip in session.grips(size) {
            let drag = super::super::GripDrag { muscle: id, grip, from: grip.place };
            let to = grip.place + glam::DVec2::new(23.0, -11.0);
            session.drag_grip(&drag, to, size, Step::New).unwrap();
            let moved = session.grips(size).into_iter().find(|moved| moved.hold == grip.hold).unwrap();
            assert!(moved.place.distance(to) < 0.5, "{:?}: {} {to}", grip.hold, moved.place);
            session.undo();
            let back = session.grips(size).into_iter().find(|back| back.hold == grip.hold).unwrap();
            assert!(back.place.distance(grip.place) < 1e-6);
        }
        assert_eq!(session.grip_at(glam::DVec2::new(-50.0, -50.0), size), None);
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

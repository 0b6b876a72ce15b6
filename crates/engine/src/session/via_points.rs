//! The path of a muscle between its attachments: via points and wrap surfaces.

use super::{Session, UndoStep};
use sinew_muscle::{ActiveRange, AttachmentPoint, Edit, EditError};
use sinew_scene::{MuscleId, NodeId};

/// Farthest angle that the range of a via point may end at, degrees: what a muscle file may say.
const FARTHEST: f64 = 360.0;
/// A range of angles ends this much later, degrees, as for the line of action.
const TOLERANCE: f64 = 1e-5 * 180.0 / std::f64::consts::PI;

impl Session {
    /// Adds a via point where it changes the way the least: half-way along the longest stretch of the drawn line.
    ///
    /// # Errors
    /// [`EditError`] where nothing holds the muscle, or it has as many as it can have; nothing is changed then.
    pub fn add_via(&mut self, id: MuscleId) -> Result<(), EditError> {
        self.frame();
        let Some((rig, index)) = self.document.muscle(id) else { return Err(EditError::NoMuscle(id.index())) };
        let (number, node, place) = rig.via_half_way(index, self.state.joints.drive, &self.frame.world).ok_or(EditError::NoEnds)?;
        let anchor = rig.anchor_at(&self.document.scene.graph, node, place, &self.frame.world).ok_or(EditError::NoName)?;
        self.edit_muscle(id, &Edit::AddVia(number, anchor), UndoStep::New)
    }

    /// The joints that via points of a muscle can depend on, each with its range of angles, degrees: those that its file names, and the elbow of its arm.
    pub fn joints_for_via(&self, id: MuscleId) -> Vec<ActiveRange> {
        let Some((rig, _)) = self.document.muscle(id) else { return Vec::new() };
        let named = |(joint, (name, _)): (usize, (&str, _))| {
            let range = rig.range_of(joint).filter(|_| !name.is_empty())?;
            Some(ActiveRange { joint: name.to_owned(), range: [*range.start(), *range.end()] })
        };
        rig.joints().enumerate().filter_map(named).collect()
    }

    /// Lets a muscle pass via point `number` in a range of a joint's angle alone; `None` = always.
    ///
    /// # Errors
    /// [`EditError`] where there is no such point, or a file could not say the range; nothing is changed then.
    pub fn set_via_range(&mut self, id: MuscleId, number: usize, range: Option<ActiveRange>) -> Result<(), EditError> {
        let Some((rig, index)) = self.document.muscle(id) else { return Err(EditError::NoMuscle(id.index())) };
        let via = rig.spec(index).and_then(|spec| spec.via.get(number)).ok_or(EditError::NoVia(number))?;
        if via.active == range {
            return Ok(());
        }
        let is_known = |range: &ActiveRange| rig.joints().any(|(name, _)| !name.is_empty() && name == range.joint);
        let fits = |range: &ActiveRange| range.range.iter().all(|angle| angle.abs() <= FARTHEST);
        if range.as_ref().is_some_and(|range| !is_known(range) || !fits(range)) {
            return Err(EditError::ViaRange);
        }
        self.edit_muscle(id, &Edit::ViaRange(number, range), UndoStep::New)
    }

    /// Whether a muscle passes via point `number` in the present pose: always, but for a point with a range that the joint's angle lies outside of.
    pub fn passes_via(&self, id: MuscleId, number: usize) -> bool {
        let Some((rig, index)) = self.document.muscle(id) else { return false };
        let Some(active) = rig.spec(index).and_then(|spec| spec.via.get(number)).and_then(|via| via.active.as_ref()) else { return true };
        let joint = rig.joints().find(|(name, _)| *name == active.joint);
        let [low, high] = active.range;
        // A joint that has no angle excludes nothing.
        joint
            .and_then(|(_, joint)| joint.angle(&self.document.scene, &self.frame.world))
            .is_none_or(|angle| !(angle < low - TOLERANCE || angle > high + TOLERANCE))
    }

    /// Puts a via point on another bone: it stays where it is and moves with that bone from now on.
    pub(super) fn put_via_on(&mut self, id: MuscleId, hold: AttachmentPoint, node: NodeId) -> Result<(), EditError> {
        self.frame();
        let Some((rig, index)) = self.document.muscle(id) else { return Err(EditError::NoMuscle(id.index())) };
        let world = &self.frame.world;
        // Of a muscle that lies on its own, because its file names a bone that is not there, no point is anywhere yet.
        let place = rig.hold(index, hold, world).unwrap_or_else(|| self.place_along(node));
        let anchor = rig.anchor_at(&self.document.scene.graph, node, place, world).ok_or(EditError::NoName)?;
        let Some(edit) = rig.spec(index).and_then(|spec| Edit::place(spec, hold, anchor)) else { return Ok(()) };
        self.edit_muscle(id, &edit, UndoStep::New)
    }

    /// Puts wrap surface `number` of a muscle into the joint by which the muscle leaves the bone `node`; a new one where the muscle has not so many.
    pub(super) fn wrap_round(&mut self, id: MuscleId, number: usize, node: NodeId) -> Result<(), EditError> {
        self.frame();
        let Some((rig, index)) = self.document.muscle(id) else { return Err(EditError::NoMuscle(id.index())) };
        if !rig.is_attached(index) {
            return Err(EditError::NoEnds);
        }
        let drive = self.state.joints.drive;
        let wrap = rig.wrap_on(index, number, node, &self.document.scene, drive, &self.frame.world).ok_or(EditError::NoName)?;
        let is_new = rig.spec(index).is_none_or(|spec| number >= spec.wraps.len());
        let edit = if is_new { Edit::AddWrap(wrap) } else { Edit::Wrap(number, wrap) };
        self.edit_muscle(id, &edit, UndoStep::New)
    }

    /// Adds a sphere to go round, in the joint that turns the muscle, on the side on which the muscle passes.
    ///
    /// # Errors
    /// [`EditError`] where nothing holds the muscle, or it goes round as many surfaces as it can; nothing is changed then.
    pub fn add_wrap(&mut self, id: MuscleId) -> Result<(), EditError> {
        let Some((rig, index)) = self.document.muscle(id) else { return Err(EditError::NoMuscle(id.index())) };
        let insertion = rig.hold_bone(index, AttachmentPoint::End(1));
        let node = rig.joint().map(|joint| joint.node).or(insertion).ok_or(EditError::NoEnds)?;
        let count = rig.spec(index).map_or(0, |spec| spec.wraps.len());
        self.wrap_round(id, count, node)
    }

    /// Gives wrap surface `number` another shape of about the same size: sphere (0), cylinder (1), ellipsoid (2) or torus (3).
    ///
    /// # Errors
    /// [`EditError`] where there is no such muscle.
    pub fn set_wrap_shape(&mut self, id: MuscleId, number: usize, shape: usize) -> Result<(), EditError> {
        self.frame();
        let Some((rig, index)) = self.document.muscle(id) else { return Err(EditError::NoMuscle(id.index())) };
        let joint = rig.joint();
        let Some(wrap) = rig.wrap_shaped(index, number, shape, joint.as_ref(), &self.document.scene, &self.frame.world) else {
            return Ok(());
        };
        self.edit_muscle(id, &Edit::Wrap(number, wrap), UndoStep::New)
    }

    /// Holds a muscle on the side of wrap surface `number` on which it passes now, or lets it take the shorter way.
    ///
    /// # Errors
    /// [`EditError`] where there is no such muscle.
    pub fn set_wrap_sided(&mut self, id: MuscleId, number: usize, sided: bool) -> Result<(), EditError> {
        self.frame();
        let Some((rig, index)) = self.document.muscle(id) else { return Err(EditError::NoMuscle(id.index())) };
        let Some(wrap) = rig.spec(index).and_then(|spec| spec.wraps.get(number)).filter(|wrap| wrap.side.is_some() != sided) else {
            return Ok(());
        };
        let side = if sided { Some(rig.passing_side(index, number, &self.frame.world)) } else { None };
        let edit = Edit::Wrap(number, sinew_muscle::Wrap { side, ..wrap.clone() });
        self.edit_muscle(id, &edit, UndoStep::New)
    }

    /// Lets a muscle pass wrap surface `number` on the other side; one that it passes on the shorter way gets the side on which it passes now.
    ///
    /// # Errors
    /// [`EditError`] where there is no such muscle.
    pub fn flip_wrap(&mut self, id: MuscleId, number: usize) -> Result<(), EditError> {
        let Some((rig, index)) = self.document.muscle(id) else { return Err(EditError::NoMuscle(id.index())) };
        let Some(mut wrap) = rig.spec(index).and_then(|spec| spec.wraps.get(number).cloned()) else { return Ok(()) };
        // Adding nothing keeps a zero from becoming −0.
        wrap.side = wrap.side.map(|side| -side + glam::DVec3::ZERO);
        self.edit_muscle(id, &Edit::Wrap(number, wrap), UndoStep::New)
    }
}

#[cfg(test)]
mod tests {
    use glam::{DVec2, DVec3};

    use super::*;
    use crate::document::Document;
    use crate::session::tests::{biceps, clip};
    use crate::session::{AttachmentDrag, PickTarget};
    use sinew_muscle::{Anchor, MuscleFile, MuscleSpec, Wrap, WrapShape};
    use sinew_render::PickHit;
    use sinew_scene::message::ToMessage;

    /// The demo's clip with a ready muscle that goes round nothing.
    fn attached() -> (Session, MuscleId) {
        let mut session = clip();
        session.new_muscle(biceps()).unwrap();
        let id = session.shown_muscle();
        session.attach_to(id, AttachmentPoint::Wrap(0), None).unwrap();
        session.set_flexion(60.0);
        (session, id)
    }

    fn spec(session: &Session, id: MuscleId) -> MuscleSpec {
        let (rig, index) = session.document().muscle(id).unwrap();
        rig.spec(index).unwrap().clone()
    }

    fn length(session: &mut Session, id: MuscleId) -> f64 {
        session.frame();
        let (rig, index) = session.document().muscle(id).unwrap();
        rig.solve(index, session.drive(), &session.posed().world).path_length
    }

    fn place(session: &mut Session, id: MuscleId, hold: AttachmentPoint) -> DVec3 {
        session.frame();
        let (rig, index) = session.document().muscle(id).unwrap();
        rig.hold(index, hold, &session.posed().world).unwrap()
    }

    fn find(session: &Session, name: &str) -> NodeId {
        session.document().scene.graph.find(name).unwrap()
    }

    #[test]
    fn a_new_via_point_changes_the_way_by_nothing_to_speak_of() {
        // On the arm what is drawn is an arch over the line that is measured; the first point stands on the arch.
        for (mut session, share) in [(attached().0, 0.02), (Session::new(Document::built_in()), 0.04)] {
            let id = session.shown_muscle();
            for number in 0..sinew_muscle::edit::VIA {
                let before = length(&mut session, id);
                session.add_via(id).unwrap();
                assert_eq!(spec(&session, id).via.len(), number + 1);
                let after = length(&mut session, id);
                assert!((after / before - 1.0).abs() < share, "point {number}: {before} {after}");
            }
            let full = spec(&session, id);
            assert!(matches!(session.add_via(id), Err(EditError::TooManyVia(_))));
            assert_eq!(spec(&session, id), full, "what is refused changes nothing");
            for _ in 0..sinew_muscle::edit::VIA {
                session.undo();
            }
            assert!(spec(&session, id).via.is_empty());
        }
    }

    #[test]
    fn a_via_point_on_another_bone_stays_where_it_is_and_follows_that_bone() {
        let (mut session, id) = attached();
        session.add_via(id).unwrap();
        let (hold, before) = (AttachmentPoint::Via(0), place(&mut session, id, AttachmentPoint::Via(0)));
        assert_eq!(spec(&session, id).via[0].place.bone, "upper_arm");
        session.attach_to(id, hold, Some(find(&session, "forearm"))).unwrap();
        assert_eq!(spec(&session, id).via[0].place.bone, "forearm");
        let after = place(&mut session, id, hold);
        assert!(before.distance(after) < 2e-5, "{before} {after}");
        session.set_flexion(100.0);
        assert!(place(&mut session, id, hold).distance(after) > 0.01, "it moves with the forearm");
        let steps = session.undo_names().0.cloned();
        session.attach_to(id, hold, Some(find(&session, "forearm"))).unwrap();
        session.attach_to(id, hold, None).unwrap();
        assert_eq!(session.undo_names().0.cloned(), steps, "the bone that it is on is no change");
        session.undo();
        assert_eq!(spec(&session, id).via[0].place.bone, "upper_arm");
    }

    #[test]
    fn picked_via_points_go_into_the_stretch_that_passes_nearest() {
        let (mut session, id) = attached();
        session.add_via(id).unwrap();
        let first = spec(&session, id).via[0].clone();
        for (bone, number) in [("upper_arm", 0), ("hand", 2)] {
            session.start_picking(id, PickTarget::NewVia);
            session.pick_bone(find(&session, bone)).unwrap();
            assert!(session.picking().is_none());
            let via = spec(&session, id).via;
            assert_eq!(via[number].place.bone, bone, "{via:?}");
        }
        assert_eq!(spec(&session, id).via[1], first);
        session.start_picking(id, PickTarget::Point(AttachmentPoint::Via(1)));
        session.pick_bone(find(&session, "forearm")).unwrap();
        assert_eq!(spec(&session, id).via[1].place.bone, "forearm");
    }

    #[test]
    fn via_points_are_dragged_ordered_and_deleted_each_under_its_own_name() {
        let (mut session, id) = attached();
        session.add_via(id).unwrap();
        session.add_via(id).unwrap();
        let (two, size) = (spec(&session, id).via, DVec2::new(900.0, 600.0));
        session.edit_muscle(id, &Edit::SwapVia(0), UndoStep::New).unwrap();
        assert_eq!(spec(&session, id).via, [two[1].clone(), two[0].clone()]);
        assert_eq!(session.undo_names().0, Some(&Edit::SwapVia(0).message()));
        session.undo();
        let grip = session.attachment_handles(size).into_iter().find(|grip| grip.attachment == AttachmentPoint::Via(1)).unwrap();
        let drag = AttachmentDrag { muscle: id, handle: grip, from: grip.screen_position };
        session.drag_attachment(&drag, grip.screen_position + DVec2::new(12.0, 9.0), size, UndoStep::New).unwrap();
        let dragged = spec(&session, id).via;
        assert!(dragged[0] == two[0] && dragged[1].place.offset != two[1].place.offset && dragged[1].place.bone == two[1].place.bone);
        assert_eq!(session.undo_names().0, Some(&Edit::Via(1, two[1].place.clone()).message()));
        session.edit_muscle(id, &Edit::DeleteVia(0), UndoStep::New).unwrap();
        assert_eq!(spec(&session, id).via, dragged[1..]);
        for refused in [Edit::DeleteVia(1), Edit::SwapVia(0), Edit::Via(1, two[0].place.clone())] {
            assert!(matches!(session.edit_muscle(id, &refused, UndoStep::New), Err(EditError::NoVia(_))), "{refused:?}");
        }
        let nowhere = Anchor { bone: two[0].place.bone.clone(), offset: DVec3::NAN };
        assert_eq!(session.edit_muscle(id, &Edit::Via(0, nowhere), UndoStep::New), Err(EditError::Offset));
        assert_eq!(spec(&session, id).via, dragged[1..]);
    }

    #[test]
    fn a_ball_goes_into_the_joint_on_the_side_of_the_muscle() {
        let (mut session, id) = attached();
        let elbow = session.document().scene.graph.find("forearm").unwrap();
        for bone in ["upper_arm", "forearm"] {
            session.attach_to(id, AttachmentPoint::Wrap(0), Some(find(&session, bone))).unwrap();
            session.frame();
            let wrap = spec(&session, id).wraps[0].clone();
            assert_eq!(wrap.center.bone, bone);
            let joint = session.posed().world[elbow.index()].w_axis.truncate();
            let (rig, index) = session.document().muscle(id).unwrap();
            let ball = rig.wrap_placement(index, 0, &session.posed().world).unwrap();
            assert!(ball.center.distance(joint) < 2e-5, "{bone}: {} {joint}", ball.center);
            // The ends of a bent biceps lie on that side of the elbow too.
            let middle = 0.5 * (place(&mut session, id, AttachmentPoint::End(0)) + place(&mut session, id, AttachmentPoint::End(1)));
            assert!((middle - joint).dot(ball.side.unwrap()) > 0.0, "{bone}");
        }
        // Straight, the muscle lies on it and is longer for it; on the other side it is longer still or as long.
        session.set_flexion(0.0);
        let wrapped = length(&mut session, id);
        let mut wrap = spec(&session, id).wraps[0].clone();
        wrap.shape = wrap.shape.scaled(2.0);
        session.edit_muscle(id, &Edit::Wrap(0, wrap.clone()), UndoStep::New).unwrap();
        assert!(length(&mut session, id) > wrapped);
        session.flip_wrap(id, 0).unwrap();
        assert_eq!(spec(&session, id).wraps[0].side, wrap.side.map(|side| -side));
        for radius in [0.0, -1.0, f64::NAN] {
            let bad = Edit::Wrap(0, Wrap { shape: WrapShape::Sphere { radius }, ..wrap.clone() });
            assert_eq!(session.edit_muscle(id, &bad, UndoStep::New), Err(EditError::Wrap));
        }
        session.attach_to(id, AttachmentPoint::Wrap(0), None).unwrap();
        assert_eq!(spec(&session, id).wraps, []);
        session.undo();
        assert_eq!(spec(&session, id).wraps[0].side, wrap.side.map(|side| -side));
    }

    #[test]
    fn the_ring_of_a_ball_stands_where_its_dot_does() {
        let (mut session, id) = attached();
        let size = DVec2::new(900.0, 600.0);
        assert_eq!(session.wrap_outlines(size), []);
        session.attach_to(id, AttachmentPoint::Wrap(0), Some(find(&session, "forearm"))).unwrap();
        let (rings, handles) = (session.wrap_outlines(size), session.attachment_handles(size));
        let dot = handles.iter().find(|grip| grip.attachment == AttachmentPoint::Wrap(0)).unwrap();
        let [ring] = rings.as_slice() else { panic!("{rings:?}") };
        let [middle, top] = ring.side.unwrap();
        assert!(dot.screen_position.distance(middle) < 1e-9 && top.distance(middle) > 1.0);
        // Each of the three circles goes round the centre.
        assert_eq!(ring.lines.len(), 3);
        for line in &ring.lines {
            let mean = line.iter().skip(1).sum::<DVec2>() / (line.len() - 1) as f64;
            assert!(mean.distance(middle) < 0.1 * top.distance(middle).max(1.0), "{mean} {middle}");
        }
        let drag = AttachmentDrag { muscle: id, handle: *dot, from: dot.screen_position };
        let before = spec(&session, id).wraps[0].clone();
        session.drag_attachment(&drag, dot.screen_position + DVec2::new(15.0, 0.0), size, UndoStep::New).unwrap();
        let after = spec(&session, id).wraps[0].clone();
        assert!(after.center.offset != before.center.offset && (after.shape, after.side) == (before.shape, before.side));
    }

    #[test]
    fn a_click_on_the_muscle_itself_puts_a_via_point_inside_it() {
        let (mut session, id) = attached();
        let before = length(&mut session, id);
        let surface = session.posed().surfaces.iter().position(|surface| surface.muscle == Some(id)).unwrap();
        let (mut skin, mut normals) = (Vec::new(), Vec::new());
        let (rig, index) = session.document().muscle(id).unwrap();
        let world = &session.posed().world;
        rig.deform(index, &rig.solve(index, session.drive(), world), world, &mut skin, &mut normals);
        let point = skin[skin.len() / 2];
        let node = session.node_of_muscle(id).unwrap();
        let pick = PickHit { node, surface: Some(surface as u32), triangle: 0, barycentric: glam::Vec3::X, point };
        session.start_picking(id, PickTarget::Point(AttachmentPoint::Wrap(0)));
        session.pick_at(Some(pick)).unwrap();
        assert!(session.picking().is_some() && spec(&session, id).wraps.is_empty(), "no joint is there");
        session.start_picking(id, PickTarget::NewVia);
        session.pick_at(Some(pick)).unwrap();
        let inside = place(&mut session, id, AttachmentPoint::Via(0));
        let thickest = spec(&session, id).profile.radii().iter().copied().fold(0.0, f64::max) * 1e-3;
        let away = inside.distance(point.as_dvec3());
        assert!(away > 0.1 * thickest && away < 2.0 * thickest, "{away} {thickest}");
        assert!((length(&mut session, id) / before - 1.0).abs() < 0.01);
    }

    #[test]
    fn a_via_point_is_passed_in_its_range_alone() {
        let mut session = Session::new(Document::built_in());
        let id = session.shown_muscle();
        session.add_via(id).unwrap();
        let joints = session.joints_for_via(id);
        let [elbow] = joints.as_slice() else { panic!("{joints:?}") };
        assert_eq!(elbow.joint, "elbow");
        let place = spec(&session, id).via[0].place.clone();
        let aside = Anchor { offset: place.offset + DVec3::new(25.0, 0.0, 0.0), ..place };
        session.edit_muscle(id, &Edit::Via(0, aside), UndoStep::New).unwrap();
        let range = ActiveRange { range: [20.0, 60.0], ..elbow.clone() };
        session.set_via_range(id, 0, Some(range.clone())).unwrap();
        assert_eq!(session.undo_names().0, Some(&Edit::ViaRange(0, None).message()));
        for (angle, passed) in [(10.0, false), (20.0, true), (40.0, true), (60.0, true), (61.0, false)] {
            session.set_flexion(angle);
            let dots = session.attachment_handles(DVec2::new(900.0, 600.0));
            let dot = dots.iter().find(|dot| dot.attachment == AttachmentPoint::Via(0)).unwrap();
            assert_eq!((session.passes_via(id, 0), dot.passed), (passed, passed), "{angle}");
            // The muscle is as long as with a point that is always passed, or not.
            let now = length(&mut session, id);
            session.set_via_range(id, 0, None).unwrap();
            let always = length(&mut session, id);
            session.undo();
            assert_eq!((now - always).abs() < 1e-9, passed, "{angle}: {now} {always}");
        }
        let steps = session.undo_names().0.cloned();
        session.set_via_range(id, 0, Some(range.clone())).unwrap();
        for (joint, range) in [("elbow", [60.0, 20.0]), ("elbow", [f64::NAN, 20.0]), ("elbow", [0.0, 400.0]), ("knee", [0.0, 20.0])] {
            let bad = ActiveRange { joint: joint.to_owned(), range };
            assert_eq!(session.set_via_range(id, 0, Some(bad)), Err(EditError::ViaRange), "{joint} {range:?}");
        }
        assert_eq!((spec(&session, id).via[0].active.as_ref(), session.undo_names().0.cloned()), (Some(&range), steps));
        session.set_via_range(id, 0, None).unwrap();
        assert!(session.passes_via(id, 0));
        // A joint that was found and not named in the file has no name to refer to.
        let (session, id) = attached();
        assert!(session.document().muscle(id).unwrap().0.joint().is_some());
        assert_eq!(session.joints_for_via(id), []);
    }

    #[test]
    fn a_muscle_on_its_own_has_no_way_to_change() {
        let (mut session, id) = attached();
        session.edit_muscle(id, &Edit::Ends(None), UndoStep::New).unwrap();
        assert_eq!(session.add_via(id), Err(EditError::NoEnds));
        assert_eq!(session.attach_to(id, AttachmentPoint::Wrap(0), Some(find(&session, "forearm"))), Err(EditError::NoEnds));
    }

    #[test]
    fn a_via_point_on_a_bone_that_is_not_there_can_be_put_on_one_that_is() {
        let (mut session, id) = attached();
        session.add_via(id).unwrap();
        let mut files: Vec<MuscleFile> = session.document().muscle_files().cloned().collect();
        files[0].muscles[0].via[0].place.bone = "tail".to_owned();
        session.put_muscle_files(&files);
        assert!(!session.document().muscle(id).unwrap().0.is_attached(0));
        session.attach_to(id, AttachmentPoint::Via(0), Some(find(&session, "forearm"))).unwrap();
        assert!(session.document().muscle(id).unwrap().0.is_attached(0));
    }
}

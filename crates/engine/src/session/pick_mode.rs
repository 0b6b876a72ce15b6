//! Placing the points of a muscle on bones: picked in the viewport or chosen by name.

use glam::DVec3;

use super::{ChangeSet, Session, UndoStep};
use sinew_muscle::{Anchor, AttachmentPoint, Edit, EditError};
use sinew_render::PickHit;
use sinew_scene::message::ToMessage;
use sinew_scene::{MuscleId, NodeId};

/// Share of a bone's length from its beginning at which a bone chosen by name is held.
const ALONG: f64 = 0.15;
const ORIGIN: PickTarget = PickTarget::Point(AttachmentPoint::End(0));
const INSERTION: PickTarget = PickTarget::Point(AttachmentPoint::End(1));
/// A point picked on the skin lies this share of the way from the bone to the skin.
const UNDER_SKIN: f64 = 0.4;

/// What the next click gives a place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PickTarget {
    /// A point that the muscle has; the [`AttachmentPoint::Wrap`] behind its last one adds a surface.
    Point(AttachmentPoint),
    /// A via point that it gets.
    NewVia,
}

/// A point of a muscle that the next click gives a place.
#[derive(Debug, Clone, PartialEq)]
pub struct PickMode {
    /// The muscle.
    pub muscle: MuscleId,
    /// What is picked.
    pub target: PickTarget,
    /// The origin, of a muscle that had none, while its insertion is still to be picked.
    first: Option<Anchor>,
    /// How bones were shown before: bones, and through surfaces.
    bones: [bool; 2],
}

impl Session {
    /// Begins to pick the bone of a point. Bones show through everything meanwhile.
    pub fn start_picking(&mut self, muscle: MuscleId, what: PickTarget) {
        self.stop_picking();
        let Some((rig, index)) = self.document.muscle(muscle) else { return };
        // A muscle that lies on its own needs both ends first, of these the origin.
        let what = if rig.is_attached(index) { what } else { ORIGIN };
        self.picking = Some(PickMode { muscle, target: what, first: None, bones: [self.view.display.bones, self.view.display.xray] });
        (self.view.display.bones, self.view.display.xray) = (true, true);
        self.changed(ChangeSet::PICKING | ChangeSet::DISPLAY);
    }

    /// Leaves picking; whether there was any.
    pub fn stop_picking(&mut self) -> bool {
        let Some(picking) = self.picking.take() else { return false };
        [self.view.display.bones, self.view.display.xray] = picking.bones;
        self.changed(ChangeSet::PICKING | ChangeSet::DISPLAY);
        true
    }

    /// What is being picked.
    pub fn picking(&self) -> Option<&PickMode> {
        self.picking.as_ref()
    }

    /// A click in the picture while a point is picked. A click beside everything changes nothing.
    ///
    /// # Errors
    /// [`EditError`] where the point cannot be there.
    pub fn pick_at(&mut self, pick: Option<PickHit>) -> Result<(), EditError> {
        let Some(pick) = pick else { return Ok(()) };
        self.frame();
        let Some((node, place)) = self.bone_under(&pick) else { return Ok(()) };
        self.pick_place(node, place)
    }

    /// A bone chosen by name while a point is picked.
    ///
    /// # Errors
    /// [`EditError`] where the point cannot be there.
    pub fn pick_bone(&mut self, node: NodeId) -> Result<(), EditError> {
        self.frame();
        let place = self.place_along(node);
        self.pick_place(node, place)
    }

    fn pick_place(&mut self, node: NodeId, place: DVec3) -> Result<(), EditError> {
        let Some(PickMode { muscle, target: what, first, .. }) = self.picking.clone() else { return Ok(()) };
        let Some((rig, index)) = self.document.muscle(muscle) else { return Ok(()) };
        let Some(anchor) = rig.anchor_at(&self.document.scene.graph, node, place, &self.frame.world) else { return Err(EditError::NoName) };
        if rig.is_attached(index) {
            let edit = match what {
                // A ball goes into a joint, wherever on the bone was clicked.
                PickTarget::Point(AttachmentPoint::Wrap(_)) => None,
                PickTarget::Point(hold) => rig.spec(index).and_then(|spec| Edit::place(spec, hold, anchor)),
                PickTarget::NewVia => rig.via_number_at(index, place, &self.frame.world).map(|number| Edit::AddVia(number, anchor)),
            };
            self.stop_picking();
            return match edit {
                Some(edit) => self.edit_muscle(muscle, &edit, UndoStep::New),
                None => match what {
                    PickTarget::Point(AttachmentPoint::Wrap(number)) => self.wrap_round(muscle, number, node),
                    _ => Ok(()),
                },
            };
        }
        match first {
            None => {
                if let Some(picking) = &mut self.picking {
                    (picking.first, picking.target) = (Some(anchor), INSERTION);
                }
                self.changed(ChangeSet::PICKING);
                Ok(())
            }
            Some(origin) => {
                let ends = Edit::Ends(Some([origin, anchor]));
                self.undoable(ends.message(), UndoStep::New, |session| {
                    session.edit_muscle(muscle, &ends, UndoStep::New)?;
                    session.stop_picking();
                    session.fit_length(muscle, UndoStep::New)
                })
            }
        }
    }

    /// Puts a point on another bone. `None` takes the muscle off all bones where the point is an end, and deletes a wrap surface.
    ///
    /// # Errors
    /// [`EditError`] where the point cannot be there.
    pub fn attach_to(&mut self, id: MuscleId, hold: AttachmentPoint, node: Option<NodeId>) -> Result<(), EditError> {
        let Some((rig, index)) = self.document.muscle(id) else { return Err(EditError::NoMuscle(id.index())) };
        let there = rig.is_attached(index).then(|| rig.hold_bone(index, hold)).flatten();
        let Some(node) = node else {
            return match hold {
                AttachmentPoint::End(_) => self.edit_muscle(id, &Edit::Ends(None), UndoStep::New),
                AttachmentPoint::Via(_) => Ok(()),
                AttachmentPoint::Wrap(number) => self.edit_muscle(id, &Edit::DeleteWrap(number), UndoStep::New),
            };
        };
        if there == Some(node) {
            return Ok(());
        }
        match hold {
            AttachmentPoint::End(_) => self.attach_end_to(id, hold, node),
            AttachmentPoint::Via(_) => {
                self.stop_picking();
                self.put_via_on(id, hold, node)
            }
            AttachmentPoint::Wrap(number) => {
                self.stop_picking();
                self.wrap_round(id, number, node)
            }
        }
    }

    fn attach_end_to(&mut self, id: MuscleId, hold: AttachmentPoint, node: NodeId) -> Result<(), EditError> {
        let what = PickTarget::Point(hold);
        let mut picking = self.picking.clone();
        if !picking.as_ref().is_some_and(|picking| picking.muscle == id && picking.target == what) {
            self.start_picking(id, what);
            picking = self.picking.clone();
        }
        match picking {
            Some(picking) if picking.target == what => self.pick_bone(node),
            _ => Ok(()),
        }
    }

    /// Whether what is picked is a point on the way, which may be picked on the muscle itself.
    fn picks_via(&self) -> bool {
        self.picking
            .as_ref()
            .is_some_and(|picking| matches!(picking.target, PickTarget::NewVia | PickTarget::Point(AttachmentPoint::Via(_))))
    }

    /// The bone that a picked point belongs to, and where on it the muscle's point goes: a bone itself, the arm's rods, or the joint that a skin follows
    /// most there; a point on the way goes where the muscle runs already, where the muscle itself was clicked.
    fn bone_under(&self, pick: &PickHit) -> Option<(NodeId, DVec3)> {
        let point = pick.point.as_dvec3();
        let (Some(index), Some(muscle)) = (pick.surface, self.picking.as_ref().map(|picking| picking.muscle)) else {
            return Some((pick.node, point));
        };
        let (rig, own) = self.document.muscle(muscle)?;
        let surface = self.frame.surfaces.get(index as usize)?;
        if surface.muscle == Some(muscle) && self.picks_via() {
            return rig.via_inside(own, point, self.state.joints.drive, &self.frame.world);
        }
        if rig.arm_bones().is_some() {
            return rig.bone_name(&self.document.scene.graph, pick.node).map(|_| (pick.node, point));
        }
        if surface.muscle.is_some() {
            return None;
        }
        let node = self.strongest_joint(index as usize, &surface.mesh.triangles, pick).unwrap_or(pick.node);
        let begin = self.frame.position(node).as_dvec3();
        let along = self.direction_along(node);
        let on_bone = begin + along * ((point - begin).dot(along) / along.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        Some((node, on_bone + (point - on_bone) * UNDER_SKIN))
    }

    /// The joint that the corner nearest to a picked point follows most.
    fn strongest_joint(&self, surface: usize, triangles: &[[u32; 3]], pick: &PickHit) -> Option<NodeId> {
        let shares = pick.barycentric.to_array();
        let corners = triangles.get(pick.triangle as usize)?.iter().zip(shares);
        let (vertex, _) = corners.max_by(|a, b| a.1.total_cmp(&b.1))?;
        let explained = self.document.vertex_influences(&self.buffers, &self.frame, surface, *vertex)?;
        explained.influences.iter().max_by(|a, b| a.weight.total_cmp(&b.weight))?.node
    }

    /// From where a bone begins to where the farthest bone on it does, metres; nothing for a last bone.
    fn direction_along(&self, node: NodeId) -> DVec3 {
        let begin = self.frame.position(node);
        let children = self.document.scene.graph.node(node).children();
        let ways = children.iter().map(|child| self.frame.position(*child) - begin).filter(|direction| direction.is_finite());
        ways.max_by(|a, b| a.length_squared().total_cmp(&b.length_squared())).unwrap_or_default().as_dvec3()
    }

    pub(super) fn place_along(&self, node: NodeId) -> DVec3 {
        self.frame.position(node).as_dvec3() + self.direction_along(node) * ALONG
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::session::tests::{biceps, clip, ends};

    #[test]
    fn ends_are_picked_one_after_the_other() {
        let mut session = clip();
        session.new_muscle(biceps()).unwrap();
        let id = session.shown_muscle();
        session.edit_muscle(id, &Edit::Ends(None), UndoStep::New).unwrap();
        let bones = session.display().bones;
        let find = |session: &Session, name: &str| session.document().scene.graph.find(name).unwrap();
        session.start_picking(id, INSERTION);
        assert_eq!(session.picking().map(|picking| picking.target), Some(ORIGIN), "a muscle on its own needs an origin first");
        session.pick_bone(find(&session, "upper_arm")).unwrap();
        assert_eq!(session.picking().map(|picking| picking.target), Some(INSERTION));
        session.pick_bone(find(&session, "hand")).unwrap();
        assert!(session.picking().is_none() && session.display().bones == bones);
        assert_eq!(ends(&session, id), [Some(find(&session, "upper_arm")), Some(find(&session, "hand"))]);
        session.undo();
        assert_eq!(ends(&session, id), [None, None]);
        session.start_picking(id, ORIGIN);
        assert!(session.stop_picking() && !session.stop_picking());
    }
}

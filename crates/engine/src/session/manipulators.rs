//! Draggable points of a muscle in the viewport: attachments, via points and wrap surfaces.

use glam::{DVec2, DVec3, Vec2};

use super::{Session, UndoStep};
use sinew_muscle::{AttachmentPoint, Edit, EditError};
use sinew_scene::{Camera, MuscleId};

/// How near to a dot the pointer takes it, logical pixels.
const HIT_DISTANCE: f64 = 11.0;

/// A dot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AttachmentHandle {
    /// The point of the muscle.
    pub attachment: AttachmentPoint,
    /// Where it falls, logical pixels.
    pub screen_position: DVec2,
    /// Where it is, world, metres.
    pub position: DVec3,
    /// Whether the muscle goes there in the present pose: a via point with a range of angles may be left out.
    pub passed: bool,
}

/// A drag of a dot: how things were when it began.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AttachmentDrag {
    /// The muscle.
    pub muscle: MuscleId,
    /// The dot.
    pub handle: AttachmentHandle,
    /// The pointer, logical pixels.
    pub from: DVec2,
}

/// A surface that a muscle goes round, as it is painted; logical pixels.
#[derive(Debug, Clone, PartialEq)]
pub struct WrapOutline {
    /// Its number among those of the muscle.
    pub number: usize,
    /// Its outline, in closed or open lines.
    pub lines: Vec<Vec<DVec2>>,
    /// From its centre towards the side on which the muscle passes; `None` where it passes on the shorter way.
    pub side: Option<[DVec2; 2]>,
}

impl Session {
    /// The dots of the muscle that is shown, in a picture of this size (logical pixels); none where muscles are hidden.
    pub fn attachment_handles(&mut self, size: DVec2) -> Vec<AttachmentHandle> {
        self.frame();
        let camera = self.view.camera.camera(&self.document.scene, &self.frame);
        let Some((rig, index)) = self.document.muscle(self.shown_muscle).filter(|_| self.view.display.muscle) else { return Vec::new() };
        let place = |point: DVec3| camera.project(point.as_vec3(), size.as_vec2()).map(|place| place.truncate().as_dvec2());
        let grip = |hold: AttachmentPoint| {
            let point = rig.hold(index, hold, &self.frame.world)?;
            let passed = !matches!(hold, AttachmentPoint::Via(number) if !self.passes_via(self.shown_muscle, number));
            let screen_position = place(point).filter(|place| place.is_finite())?;
            Some(AttachmentHandle { attachment: hold, screen_position, position: point, passed })
        };
        rig.holds(index).filter_map(grip).collect()
    }

    /// The dot under a place of the picture.
    pub fn attachment_handle_at(&mut self, place: DVec2, size: DVec2) -> Option<AttachmentHandle> {
        let near = |grip: &AttachmentHandle| grip.screen_position.distance(place);
        self.attachment_handles(size).into_iter().filter(|grip| near(grip) <= HIT_DISTANCE).min_by(|a, b| near(a).total_cmp(&near(b)))
    }

    /// A dragged dot comes to `to`: it stays as far from the eye as it was, and on its bone.
    ///
    /// # Errors
    /// [`EditError`] where the point cannot be there; nothing is changed then.
    pub fn drag_attachment(&mut self, drag: &AttachmentDrag, to: DVec2, size: DVec2, step: UndoStep) -> Result<(), EditError> {
        self.frame();
        let camera = self.view.camera.camera(&self.document.scene, &self.frame);
        let moved = on_level(&camera, drag.handle.position, to, size) - on_level(&camera, drag.handle.position, drag.from, size);
        let Some((rig, index)) = self.document.muscle(drag.muscle) else { return Ok(()) };
        let Some(node) = rig.hold_bone(index, drag.handle.attachment) else { return Ok(()) };
        let graph = &self.document.scene.graph;
        let Some(anchor) = rig.anchor_at(graph, node, drag.handle.position + moved, &self.frame.world) else {
            return Err(EditError::NoName);
        };
        let Some(edit) = rig.spec(index).and_then(|spec| Edit::place(spec, drag.handle.attachment, anchor)) else { return Ok(()) };
        self.edit_muscle(drag.muscle, &edit, step)
    }

    /// The outlines of the surfaces that the muscle shown goes round, in a picture of this size (logical pixels); none where muscles are hidden.
    pub fn wrap_outlines(&mut self, size: DVec2) -> Vec<WrapOutline> {
        self.frame();
        let camera = self.view.camera.camera(&self.document.scene, &self.frame);
        let Some((rig, index)) = self.document.muscle(self.shown_muscle).filter(|_| self.view.display.muscle) else { return Vec::new() };
        let place = |point: DVec3| {
            let place = camera.project(point.as_vec3(), size.as_vec2())?.truncate().as_dvec2();
            place.is_finite().then_some(place)
        };
        let outline = |number: usize| {
            let surface = rig.wrap_placement(index, number, &self.frame.world)?;
            // A line with a point behind the eye is not drawn.
            let lines = surface.outline().into_iter().filter_map(|line| line.into_iter().map(place).collect()).collect();
            let side = surface.top().and_then(|top| Some([place(surface.center)?, place(top)?]));
            Some(WrapOutline { number, lines, side })
        };
        (0..rig.spec(index).map_or(0, |spec| spec.wraps.len())).filter_map(outline).collect()
    }
}

/// The point under a place of the picture that is as far before the eye as `level`.
fn on_level(camera: &Camera, level: DVec3, place: DVec2, size: DVec2) -> DVec3 {
    let (pixel, size): (Vec2, Vec2) = (place.as_vec2(), size.as_vec2());
    let near = camera.unproject(pixel, 0.0, size).as_dvec3();
    let far = camera.unproject(pixel, 0.5, size).as_dvec3();
    let (offset, forward) = (far - near, camera.forward().as_dvec3());
    let depth = (level - near).dot(forward) / offset.dot(forward);
    if depth.is_finite() { near + offset * depth } else { level }
}

//! The handles of the tools in the picture: axes to move along, rings to turn about, boxes to scale by. Where they stand, which one lies under the
//! pointer, and what a drag of one does; painting them is the viewport's.

use glam::{DVec2, DVec3, Vec2};

use super::tool::Tool;
use crate::view::ModelTransform;
use sinew_scene::Camera;

/// Length of an axis and radius of a ring, logical pixels.
const AXIS_LENGTH: f64 = 84.0;
/// Where the square between two axes starts and ends, in parts of their length.
const PLANE_HANDLE_RANGE: [f64; 2] = [0.3, 0.52];
/// How near to a handle the pointer takes it, logical pixels.
const HIT_DISTANCE: f64 = 8.0;
/// Pieces of a ring.
const RING_SEGMENTS: usize = 64;
/// Steps that turning and scaling snap to.
const SNAP_DEGREES: f64 = 15.0;
const SNAP_SCALE: f64 = 0.1;

/// The parts of a gizmo that can be dragged.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GizmoHandle {
    /// The axis, ring or box of X, Y or Z.
    Axis(usize),
    /// The square between the other two axes: the model moves across X, Y or Z.
    Plane(usize),
    /// Everywhere else: the model follows the pointer freely.
    Free,
}

/// The handles of a tool about the model's middle, in a picture of a size in logical pixels.
#[derive(Debug, Clone, Copy)]
pub struct Gizmo<'a> {
    /// The tool in hand.
    pub tool: Tool,
    /// The eye.
    pub camera: &'a Camera,
    /// Width and height.
    pub size: DVec2,
    /// The model's middle where it is now, world, metres.
    pub middle: DVec3,
}

/// A drag of a handle: how things were when it began.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ModelDrag {
    /// The handle.
    pub handle: GizmoHandle,
    /// The model.
    pub start: ModelTransform,
    /// The pointer, logical pixels.
    pub from: DVec2,
}

/// The directions of the handles.
pub(super) const AXES: [DVec3; 3] = [DVec3::X, DVec3::Y, DVec3::Z];

impl Gizmo<'_> {
    /// Where a point of the world falls, logical pixels; `None` behind the eye.
    pub fn project(&self, point: DVec3) -> Option<DVec2> {
        let size = Vec2::new(self.size.x as f32, self.size.y as f32);
        self.camera.project(point.as_vec3(), size).map(|place| place.truncate().as_dvec2()).filter(|place| place.is_finite())
    }

    /// Metres that a handle is long, so that it has the same size in every picture.
    pub fn axis_length(&self) -> f64 {
        f64::from(self.camera.height_at(self.middle.as_vec3())) * AXIS_LENGTH / self.size.y.max(1.0)
    }

    /// The tip of an axis, logical pixels.
    pub fn tip(&self, axis: usize) -> Option<DVec2> {
        self.project(self.middle + AXES[axis] * self.axis_length())
    }

    /// The half of a ring that faces the eye, as a line of places; the whole ring where it faces the eye flatly.
    pub fn ring(&self, axis: usize) -> Vec<DVec2> {
        let (normal, reach) = (AXES[axis], self.axis_length());
        let (one, other) = (AXES[(axis + 1) % 3], AXES[(axis + 2) % 3]);
        let towards = self.towards();
        let flat = normal.dot(towards).abs() > 0.98;
        let step = |piece: usize| {
            let (sin, cos) = (piece as f64 / RING_SEGMENTS as f64 * std::f64::consts::TAU).sin_cos();
            one * cos + other * sin
        };
        // It starts behind the eye's plane, so that the half before it is one line.
        let first = (0..RING_SEGMENTS).min_by(|a, b| step(*a).dot(towards).total_cmp(&step(*b).dot(towards))).unwrap_or(0);
        let pieces = (first..=first + RING_SEGMENTS).map(step).filter(|out| flat || out.dot(towards) >= -0.02);
        pieces.filter_map(|out| self.project(self.middle + out * reach)).collect()
    }

    /// The corners of the square across an axis, logical pixels; `None` where it is seen from its edge.
    pub fn square(&self, axis: usize) -> Option<[DVec2; 4]> {
        if self.tool != Tool::Move || AXES[axis].dot(self.towards()).abs() < 0.2 {
            return None;
        }
        let (one, other) = (AXES[(axis + 1) % 3], AXES[(axis + 2) % 3]);
        let [near, far] = PLANE_HANDLE_RANGE.map(|part| part * self.axis_length());
        let corner = |a: f64, b: f64| self.project(self.middle + one * a + other * b);
        Some([corner(near, near)?, corner(far, near)?, corner(far, far)?, corner(near, far)?])
    }

    /// From the middle to the eye.
    fn towards(&self) -> DVec3 {
        match self.camera.projection {
            sinew_scene::Projection::Perspective { .. } => (self.camera.eye.as_dvec3() - self.middle).normalize_or(DVec3::Z),
            sinew_scene::Projection::Orthographic { .. } => -self.camera.forward().as_dvec3(),
        }
    }

    /// The handle under the pointer, logical pixels.
    pub fn handle_at(&self, pointer: DVec2) -> Option<GizmoHandle> {
        let middle = self.project(self.middle)?;
        let distance = |axis: usize| match self.tool {
            Tool::Navigate => f64::INFINITY,
            Tool::Rotate => to_line(pointer, &self.ring(axis)),
            Tool::Move | Tool::Scale => match self.tip(axis) {
                // An axis that points at the eye is a dot in the middle, which no hand could tell from the others.
                Some(tip) if (tip - middle).length() > 2.0 * HIT_DISTANCE => to_line(pointer, &[middle + (tip - middle) * 0.2, tip]),
                _ => f64::INFINITY,
            },
        };
        // The square that is nearer to the eye lies over the others.
        let over = (0..3).filter(|axis| self.square(*axis).is_some_and(|corners| is_inside(pointer, &corners)));
        let facing = |axis: &usize| AXES[*axis].dot(self.towards()).abs();
        if let Some(axis) = over.max_by(|a, b| facing(a).total_cmp(&facing(b))) {
            return Some(GizmoHandle::Plane(axis));
        }
        let nearest = (0..3).map(|axis| (axis, distance(axis))).min_by(|a, b| a.1.total_cmp(&b.1));
        nearest.filter(|(_, distance)| *distance <= HIT_DISTANCE).map(|(axis, _)| GizmoHandle::Axis(axis))
    }

    /// The model after a drag to `to`, logical pixels. With `snap` it moves by whole parts of the grid, turns by 15° and scales by tenths.
    pub fn dragged(&self, drag: &ModelDrag, to: DVec2, snap: bool) -> ModelTransform {
        let mut model = drag.start;
        match drag.handle {
            GizmoHandle::Axis(axis) => match self.tool {
                Tool::Navigate => {}
                Tool::Move => model.translate(AXES[axis] * self.along(axis, drag.from, to)),
                Tool::Rotate => {
                    let angle = self.about(axis, drag.from, to);
                    let step = SNAP_DEGREES.to_radians();
                    model.rotate(AXES[axis], if snap { (angle / step).round() * step } else { angle });
                }
                Tool::Scale => {
                    if let (Some(middle), Some(tip)) = (self.project(self.middle), self.tip(axis)) {
                        let along = (tip - middle).normalize_or(DVec2::X);
                        model.scale_by(1.0 + ((to - drag.from).dot(along) / AXIS_LENGTH).max(-0.99));
                    }
                }
            },
            GizmoHandle::Plane(axis) => model.translate(self.across(axis, drag.from, to)),
            GizmoHandle::Free => {
                let part = (to - drag.from) / self.size.y.max(1.0);
                let step = SNAP_DEGREES / 180.0;
                let part = if snap && self.tool == Tool::Rotate { (part / step).round() * step } else { part };
                self.tool.drag(&mut model, self.camera, part.x, part.y);
            }
        }
        if snap && self.tool == Tool::Move {
            let step = self.step();
            model.translation = (model.translation / step).round() * step;
        }
        if snap && self.tool == Tool::Scale {
            model.set_scale((model.scale / SNAP_SCALE).round().max(1.0) * SNAP_SCALE);
        }
        model
    }

    /// The length that moving snaps to, metres: a power of ten that is a few pixels wide.
    pub fn step(&self) -> f64 {
        10f64.powf((self.axis_length() / 3.0).max(1e-9).log10().floor())
    }

    /// A line of sight: where it starts and where it goes.
    fn ray(&self, pointer: DVec2) -> (DVec3, DVec3) {
        let (pixel, size) = (pointer.as_vec2(), self.size.as_vec2());
        let near = self.camera.unproject(pixel, 0.0, size).as_dvec3();
        let far = self.camera.unproject(pixel, 0.5, size).as_dvec3();
        (near, (far - near).normalize_or(self.camera.forward().as_dvec3()))
    }

    /// Metres along an axis through the middle from the point nearest to one line of sight to that of another.
    fn along(&self, axis: usize, from: DVec2, to: DVec2) -> f64 {
        let axis = AXES[axis];
        let nearest = |pointer: DVec2| {
            let (origin, offset) = self.ray(pointer);
            let (across, between) = (axis.dot(offset), self.middle - origin);
            let flat = 1.0 - across * across;
            // Along the line of sight there is no telling how far.
            (flat > 1e-4).then(|| (across * offset.dot(between) - axis.dot(between)) / flat)
        };
        let offset = nearest(to).zip(nearest(from)).map_or(0.0, |(to, from)| to - from);
        if offset.is_finite() { offset.clamp(-1e6, 1e6) } else { 0.0 }
    }

    /// Metres across an axis, in the plane through the middle, from one line of sight to another.
    fn across(&self, axis: usize, from: DVec2, to: DVec2) -> DVec3 {
        let hit = |pointer: DVec2| {
            let (origin, offset) = self.ray(pointer);
            let facing = offset.dot(AXES[axis]);
            // Beyond the horizon of the plane there is no place.
            let depth = (self.middle - origin).dot(AXES[axis]) / facing;
            (facing.abs() > 1e-2 && depth > 0.0).then(|| origin + offset * depth)
        };
        let offset = hit(to).zip(hit(from)).map_or(DVec3::ZERO, |(to, from)| to - from);
        let offset = offset - AXES[axis] * offset.dot(AXES[axis]);
        if offset.is_finite() { offset.clamp_length_max(1e6) } else { DVec3::ZERO }
    }

    /// Radians about an axis that a drag over its ring turns: as the ring's own tangent goes under the pointer.
    fn about(&self, axis: usize, from: DVec2, to: DVec2) -> f64 {
        let Some(middle) = self.project(self.middle) else { return 0.0 };
        let facing = AXES[axis].dot(self.towards());
        if facing.abs() > 0.35 {
            // Round the middle, as one would turn a wheel that faces the eye.
            let hit = |pointer: DVec2| {
                let (origin, offset) = self.ray(pointer);
                let depth = (self.middle - origin).dot(AXES[axis]) / offset.dot(AXES[axis]);
                let out = origin + offset * depth - self.middle;
                let (one, other) = (AXES[(axis + 1) % 3], AXES[(axis + 2) % 3]);
                (depth.is_finite() && out.length() > 1e-12).then(|| out.dot(other).atan2(out.dot(one)))
            };
            let turn = hit(to).zip(hit(from)).map_or(0.0, |(to, from)| to - from);
            return (turn + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU) - std::f64::consts::PI;
        }
        // Seen from its edge, a ring is a wheel that rolls along its line.
        let up = self.project(self.middle + AXES[axis] * self.axis_length()).map_or(DVec2::Y, |tip| (tip - middle).normalize_or(DVec2::Y));
        let rolling = DVec2::new(-up.y, up.x);
        (to - from).dot(rolling) / AXIS_LENGTH
    }
}

/// Whether a point lies in a convex shape, whichever way round.
fn is_inside(point: DVec2, corners: &[DVec2; 4]) -> bool {
    let side = |i: usize| (corners[(i + 1) % 4] - corners[i]).perp_dot(point - corners[i]);
    let sides = [side(0), side(1), side(2), side(3)];
    sides.iter().all(|side| *side >= 0.0) || sides.iter().all(|side| *side <= 0.0)
}

/// How far a point is from a line of places.
fn to_line(point: DVec2, line: &[DVec2]) -> f64 {
    let pieces = line.iter().zip(line.iter().skip(1));
    pieces
        .map(|(a, b)| {
            let along = *b - *a;
            let part = ((point - *a).dot(along) / along.length_squared().max(1e-12)).clamp(0.0, 1.0);
            (point - *a - along * part).length()
        })
        .fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use sinew_scene::{OrbitCamera, ViewDirection};

    const SIZE: DVec2 = DVec2::new(900.0, 600.0);

    fn camera(view: ViewDirection, orthographic: bool) -> Camera {
        let mut orbit = OrbitCamera { orthographic, ..OrbitCamera::default() };
        orbit.look_from(view);
        orbit.camera()
    }

    fn handles<'a>(tool: Tool, camera: &'a Camera, model: &ModelTransform) -> Gizmo<'a> {
        Gizmo { tool, camera, size: SIZE, middle: model.pivot + model.translation }
    }

    fn model() -> ModelTransform {
        ModelTransform { pivot: DVec3::new(0.2, -0.1, 0.3), ..ModelTransform::default() }
    }

    #[test]
    fn an_axis_is_found_at_its_tip_and_follows_the_pointer() {
        for orthographic in [false, true] {
            let camera = camera(ViewDirection::Iso, orthographic);
            let start = model();
            let handles = handles(Tool::Move, &camera, &start);
            for (axis, direction) in AXES.into_iter().enumerate() {
                let tip = handles.tip(axis).expect("before the eye");
                assert_eq!(handles.handle_at(tip), Some(GizmoHandle::Axis(axis)));
                let middle = handles.project(handles.middle).expect("before the eye");
                let to = tip + (tip - middle).normalize() * 40.0;
                let drag = ModelDrag { handle: GizmoHandle::Axis(axis), start, from: tip };
                let moved = handles.dragged(&drag, to, false).translation;
                let across = moved - direction * moved.dot(direction);
                assert!(across.length() < 1e-9 && moved.dot(direction) > 0.0, "{moved}");
                // What was under the pointer still is.
                let place = handles.project(handles.middle + direction * handles.axis_length() + moved).expect("before the eye");
                assert!((place - to).length() < 1.0, "{place} {to}");
            }
        }
    }

    #[test]
    fn a_square_moves_across_its_axis_and_follows_the_pointer() {
        for orthographic in [false, true] {
            let camera = camera(ViewDirection::Iso, orthographic);
            let start = model();
            let handles = handles(Tool::Move, &camera, &start);
            for (axis, normal) in AXES.into_iter().enumerate() {
                let corners = handles.square(axis).expect("it faces the eye");
                let from = corners.iter().sum::<DVec2>() / 4.0;
                assert_eq!(handles.handle_at(from), Some(GizmoHandle::Plane(axis)));
                let to = from + DVec2::new(37.0, -21.0);
                let drag = ModelDrag { handle: GizmoHandle::Plane(axis), start, from };
                let moved = handles.dragged(&drag, to, false).translation;
                assert!(moved.dot(normal).abs() < 1e-9 && moved.length() > 0.0, "{moved}");
                let centre = |part: f64| handles.middle + (AXES[(axis + 1) % 3] + AXES[(axis + 2) % 3]) * part * handles.axis_length();
                let place = handles.project(centre(0.41) + moved).expect("before the eye");
                assert!((place - to).length() < 2.0, "{place} {to}");
                let stepped = handles.dragged(&drag, to, true).translation / handles.step();
                assert!((stepped - stepped.round()).length() < 1e-9, "{stepped}");
            }
        }
        // From the front one square is seen, the others only from their edges; other tools have none.
        let camera = camera(ViewDirection::Front, false);
        let front = handles(Tool::Move, &camera, &model());
        assert_eq!([0, 1, 2].map(|axis| front.square(axis).is_some()), [false, false, true]);
        assert!(handles(Tool::Scale, &camera, &model()).square(2).is_none());
    }

    #[test]
    fn a_ring_turns_with_the_pointer() {
        let camera = camera(ViewDirection::Front, false);
        let start = model();
        let handles = handles(Tool::Rotate, &camera, &start);
        let middle = handles.project(handles.middle).expect("before the eye");
        let from = middle + DVec2::new(0.8, -0.6) * AXIS_LENGTH;
        assert_eq!(handles.handle_at(from), Some(GizmoHandle::Axis(2)));
        // A quarter against the clock, as seen from the front, is a quarter about +Z.
        let drag = ModelDrag { handle: GizmoHandle::Axis(2), start, from };
        let turned = handles.dragged(&drag, middle + DVec2::new(-0.6, -0.8) * AXIS_LENGTH, false).degrees();
        assert!((turned - DVec3::new(0.0, 0.0, 90.0)).length() < 1.0, "{turned}");
        let snapped = handles.dragged(&drag, middle + DVec2::new(0.34, -0.94) * AXIS_LENGTH, true).degrees();
        assert!((snapped - DVec3::new(0.0, 0.0, 30.0)).length() < 1e-6, "{snapped}");
    }

    #[test]
    fn a_ring_from_its_edge_rolls() {
        let camera = camera(ViewDirection::Front, true);
        let start = model();
        let handles = handles(Tool::Rotate, &camera, &start);
        let middle = handles.project(handles.middle).expect("before the eye");
        // The ring about Y is a level line from here; what is near the eye goes right where the turn is about +Y.
        let drag = ModelDrag { handle: GizmoHandle::Axis(1), start, from: middle };
        let turned = handles.dragged(&drag, middle + DVec2::new(20.0, 0.0), false).degrees();
        assert!(turned.y > 5.0 && turned.x.abs() < 1e-6 && turned.z.abs() < 1e-6, "{turned}");
    }

    #[test]
    fn snapping_rounds_what_is_moved_and_scaled() {
        let camera = camera(ViewDirection::Iso, false);
        let start = model();
        let moving = handles(Tool::Move, &camera, &start);
        let tip = moving.tip(0).expect("before the eye");
        let drag = ModelDrag { handle: GizmoHandle::Axis(0), start, from: tip };
        let moved = moving.dragged(&drag, tip + DVec2::new(57.0, 31.0), true).translation / moving.step();
        assert!((moved - moved.round()).length() < 1e-9 && moved != DVec3::ZERO, "{moved}");
        let scaling = handles(Tool::Scale, &camera, &start);
        let tip = scaling.tip(1).expect("before the eye");
        assert_eq!(scaling.handle_at(tip), Some(GizmoHandle::Axis(1)));
        let drag = ModelDrag { handle: GizmoHandle::Axis(1), start, from: tip };
        let scale = scaling.dragged(&drag, tip - DVec2::new(0.0, 45.0), true).scale;
        assert!((scale - 1.5).abs() < 1e-9, "{scale}");
    }

    #[test]
    fn an_axis_that_points_at_the_eye_is_not_taken() {
        let camera = camera(ViewDirection::Front, true);
        let start = model();
        let handles = handles(Tool::Move, &camera, &start);
        let middle = handles.project(handles.middle).expect("before the eye");
        assert_ne!(handles.handle_at(middle), Some(GizmoHandle::Axis(2)));
        let drag = ModelDrag { handle: GizmoHandle::Axis(2), start, from: middle };
        assert_eq!(handles.dragged(&drag, middle + DVec2::splat(30.0), false).translation, DVec3::ZERO);
        assert_eq!(handles.handle_at(DVec2::splat(-1e9)), None);
    }
}

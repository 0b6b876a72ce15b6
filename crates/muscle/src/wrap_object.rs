//! A wrap surface on a bone: where it is in a pose, and how fast it moves there.

use std::ops::Range;

use glam::{DMat3, DMat4, DQuat, DVec3, EulerRot};

use super::config::{Wrap, WrapShape};
use super::line_of_action::Point;
use super::wrapping::{Side, Surface, WrapSurface};

/// A wrap surface on a bone.
///
/// A surface is rigid. On a bone whose axes are skewed or mirrored its frame keeps the directions that matter: the axis of a cylinder, a torus or an ellipsoid
/// and its x axis beside it; the side of a sphere.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct WrapObject {
    /// Its centre.
    pub center: Point,
    /// Its shape; lengths are in the unit of the frames.
    pub shape: WrapShape,
    /// In the bone's axes: the direction that is kept, which is the surface's z axis, and the direction that x lies towards, of length 1.
    axes: [DVec3; 2],
    /// The third direction there.
    third: DVec3,
    /// The side in the surface's frame.
    side: Option<DVec3>,
    /// The stretches of the way that it acts on, all points of the muscle counted.
    pub stretches: Range<usize>,
}

impl WrapObject {
    /// The surface of a file, its centre on a bone of the rig.
    pub(super) fn new(wrap: &Wrap, center: Point, stretches: Range<usize>) -> Self {
        let frame = turned(wrap.rotation);
        let (frame, side) = match (wrap.shape, wrap.side.and_then(DVec3::try_normalize)) {
            // A sphere has no axes; its side takes their place.
            (WrapShape::Sphere { .. }, Some(side)) => {
                let kept = frame * side;
                let (x, y) = kept.any_orthonormal_pair();
                (DMat3::from_cols(x, y, kept), Some(DVec3::Z))
            }
            (_, side) => (frame, side),
        };
        Self { center, shape: wrap.shape, axes: [frame.z_axis, frame.x_axis], third: frame.y_axis, side, stretches }
    }

    /// The surface with its lengths multiplied.
    pub(super) fn rescale(&mut self, scale: f64) {
        self.shape = self.shape.scaled(scale);
    }

    /// Whether the path may pass it on either side.
    pub(super) fn has_ways(&self) -> bool {
        self.side.is_none() && !matches!(self.shape, WrapShape::Torus { .. })
    }

    /// Whether it is more than a sphere with a side at the joint.
    pub(super) fn is_shaped(&self) -> bool {
        !matches!(self.shape, WrapShape::Sphere { .. })
    }

    /// The surface in a pose that puts its bone into this frame; it acts on these stretches of the points that are passed.
    pub(super) fn placed(&self, frame: &DMat4, body: usize, stretches: Range<usize>) -> WrapSurface {
        let [z, x] = self.axes.map(|axis| frame.transform_vector3(axis));
        let rotation = orthonormal(z, x).unwrap_or(DMat3::IDENTITY);
        let mirrored = rotation.y_axis.dot(frame.transform_vector3(self.third)) < 0.0;
        let side = match self.side {
            None => Side::Either,
            Some(side) => Side::Toward(if mirrored { side * DVec3::new(1.0, -1.0, 1.0) } else { side }),
        };
        let surface = match self.shape {
            WrapShape::Sphere { radius } => Surface::Sphere { radius },
            WrapShape::Cylinder { radius, length } => Surface::Cylinder { radius, length },
            WrapShape::Ellipsoid { radii } => Surface::Ellipsoid { radii },
            WrapShape::Torus { radius, tube } => Surface::Torus { major: radius, minor: tube },
        };
        let center = frame.transform_point3(self.center.local);
        WrapSurface { surface, body, rotation: DQuat::from_mat3(&rotation), center, side, stretches }
    }

    /// How it moves where its bone's frame changes at this rate (a matrix whose last row is zero).
    pub(super) fn motion(&self, frame: &DMat4, rate: &DMat4) -> RigidMotion {
        let center = frame.transform_point3(self.center.local);
        let velocity = (*rate * self.center.local.extend(1.0)).truncate();
        let [a, b] = self.axes.map(|axis| frame.transform_vector3(axis));
        let [da, db] = self.axes.map(|axis| (*rate * axis.extend(0.0)).truncate());
        let still = RigidMotion { center, velocity, turning: DVec3::ZERO };
        let Some(axes) = orthonormal(a, b) else { return still };
        // The rates of what `orthonormal` computes.
        let (x, y, z) = (axes.x_axis, axes.y_axis, axes.z_axis);
        let dz = (da - z * z.dot(da)) / a.length();
        let beside = b - z * z.dot(b);
        let dbeside = db - dz * z.dot(b) - z * (dz.dot(b) + z.dot(db));
        let dx = (dbeside - x * x.dot(dbeside)) / beside.length();
        let dy = dz.cross(x) + z.cross(dx);
        RigidMotion { turning: 0.5 * (x.cross(dx) + y.cross(dy) + z.cross(dz)), ..still }
    }
}

/// How a rigid body moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct RigidMotion {
    center: DVec3,
    velocity: DVec3,
    /// Radians along each axis for one of what changes.
    turning: DVec3,
}

impl RigidMotion {
    /// The velocity of the body's point that is at a place.
    pub(super) fn at(&self, place: DVec3) -> DVec3 {
        self.velocity + self.turning.cross(place - self.center)
    }
}

/// The frame that is turned by these angles, degrees: about x, then about y and about z as the turns before have left them.
pub(super) fn turned(rotation: DVec3) -> DMat3 {
    let [x, y, z] = rotation.to_array().map(f64::to_radians);
    DMat3::from_quat(DQuat::from_euler(EulerRot::XYZ, x, y, z))
}

/// The angles of the frame with this z axis and an x axis near this one, degrees.
pub(super) fn euler_angles(x: DVec3, z: DVec3) -> DVec3 {
    let Some(frame) = orthonormal(z, x) else { return DVec3::ZERO };
    let (x, y, z) = DQuat::from_mat3(&frame).to_euler(EulerRot::XYZ);
    DVec3::new(x, y, z).map(f64::to_degrees)
}

/// [`euler_angles`] in hundredths of a degree.
pub(super) fn angles_of(x: DVec3, z: DVec3) -> DVec3 {
    (euler_angles(x, z) * 100.0).round() / 100.0 + DVec3::ZERO
}

/// The frame whose z axis is along `z` and whose x axis is as near `x` as that allows; `None` where they tell none.
fn orthonormal(z: DVec3, x: DVec3) -> Option<DMat3> {
    let z = z.try_normalize()?;
    let x = (x - z * z.dot(x)).try_normalize()?;
    Some(DMat3::from_cols(x, z.cross(x), z))
}

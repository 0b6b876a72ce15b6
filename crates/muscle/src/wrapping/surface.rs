//! Wrap surfaces as a caller gives them: shape, place, side and range.

use std::ops::Range;

use glam::{DQuat, DVec3};

/// The shape of a wrap surface in its own frame, centred at the frame's origin. Lengths are in the caller's unit, the same for all.
///
/// A radius that is not finite, not positive, or beyond 10⁵⁰ either way makes the surface inert: it never acts.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Surface {
    /// A sphere.
    Sphere {
        /// Its radius.
        radius: f64,
    },
    /// A cylinder about the frame's z axis.
    ///
    /// The path is that of the endless cylinder, as in OpenSim's `Scholz2015GeometryPath`: a cylinder that stops acting where a path comes to its end would
    /// make the length jump, as OpenSim's older `WrapCylinder` does. [`Arc::beyond_end`](super::Arc::beyond_end) tells that an arc has left its length.
    Cylinder {
        /// Its radius.
        radius: f64,
        /// Its length, half of it on either side of the origin.
        length: f64,
    },
    /// An ellipsoid whose axes are those of the frame.
    Ellipsoid {
        /// Half its length along x, y and z.
        radii: DVec3,
    },
    /// A torus about the frame's z axis. The path goes through its hole and is held there by the inner side of the tube, as in OpenSim.
    ///
    /// It acts on a stretch whose ends lie on both sides of the plane z = 0, and touches the tube in one arc at most. One without a hole (`minor` ≥ `major`)
    /// is inert.
    Torus {
        /// From the centre to the middle of the tube.
        major: f64,
        /// Radius of the tube.
        minor: f64,
    },
}

/// The side of a wrap surface that the path passes on: a half axis of the surface's frame (OpenSim's quadrant), or any direction in it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Side {
    /// The nearer one: the path is the shortest.
    #[default]
    Either,
    /// That of positive x.
    PlusX,
    /// That of negative x.
    MinusX,
    /// That of positive y.
    PlusY,
    /// That of negative y.
    MinusY,
    /// That of positive z. Along the axis of a cylinder it means [`Side::Either`].
    PlusZ,
    /// That of negative z. Along the axis of a cylinder it means [`Side::Either`].
    MinusZ,
    /// That of a direction, of any length but 0. Of a cylinder the part along its axis does not count.
    Toward(DVec3),
}

impl Side {
    /// The direction in the surface's frame, of length 1; `None` for [`Side::Either`].
    #[must_use]
    pub fn direction(self) -> Option<DVec3> {
        match self {
            Side::Either => None,
            Side::PlusX => Some(DVec3::X),
            Side::MinusX => Some(DVec3::NEG_X),
            Side::PlusY => Some(DVec3::Y),
            Side::MinusY => Some(DVec3::NEG_Y),
            Side::PlusZ => Some(DVec3::Z),
            Side::MinusZ => Some(DVec3::NEG_Z),
            Side::Toward(direction) => direction.try_normalize(),
        }
    }
}

/// A wrap surface at one moment, in world coordinates.
#[derive(Debug, Clone, PartialEq)]
pub struct WrapSurface {
    /// Its shape.
    pub surface: Surface,
    /// Index of the body that it moves with.
    pub body: usize,
    /// Turns directions of its frame into those of the world. It is normalised; one that cannot be makes the surface inert.
    pub rotation: DQuat,
    /// Its centre.
    pub center: DVec3,
    /// The side that the path passes on. A torus has none.
    pub side: Side,
    /// The stretches of the path that it may act on: stretch `i` lies between point `i` and point `i + 1`.
    pub stretches: Range<usize>,
}

/// A point that the path goes through at one moment: its origin, a via point or its insertion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathPoint {
    /// Index of the body that it moves with.
    pub body: usize,
    /// Where it is in the world.
    pub position: DVec3,
}

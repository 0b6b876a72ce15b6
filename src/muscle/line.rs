//! A muscle's line of action: from its origin over via points and round a joint to its insertion, and the centre line that is drawn for it.
//!
//! On the two-rod arm the line of action runs between points on the rods' axes, so a belly drawn along it would swallow the rods. What is drawn is
//! an arch ([`Path::arch`]) of *exactly the same length*, whose ends lie on the rods' surfaces on the muscle's side, slid a few millimetres towards
//! the elbow to give the arch its height ([`super::clearance`]). So the volume on the screen is the volume of the ledger, and length and moment
//! arm stay those of the law of cosines.

use glam::{DMat4, DVec3};

use super::path::Path;

/// A point that moves with a bone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// Index of the bone in the rig's list.
    pub bone: usize,
    /// Place in the bone's axes, in the file's unit.
    pub local: DVec3,
}

/// Frames of the rig's bones in the space of its root: positions in the file's unit, axes of length 1.
pub trait Frames {
    /// The frame of bone `index`.
    fn frame(&self, index: usize) -> DMat4;

    /// Where a point is.
    fn place(&self, point: Point) -> DVec3 {
        self.frame(point.bone).transform_point3(point.local)
    }
}

impl Frames for [DMat4] {
    fn frame(&self, index: usize) -> DMat4 {
        self.get(index).copied().unwrap_or(DMat4::IDENTITY)
    }
}

impl Frames for [DMat4; 2] {
    fn frame(&self, index: usize) -> DMat4 {
        self.as_slice().frame(index)
    }
}

/// A line of action.
#[derive(Debug, Clone, PartialEq)]
pub struct Line {
    /// Where it begins.
    pub origin: Point,
    /// Where it ends.
    pub insertion: Point,
    /// The ends of the centre line that is drawn, where they differ.
    pub drawn: Option<Drawn>,
}

/// How the drawn centre line differs from the line of action.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drawn {
    /// Ends on the bones' surfaces.
    pub ends: [Point; 2],
    /// Side that the arch bulges to: a direction in the axes of the origin's bone and one in those of the insertion's.
    pub side: DVec3,
}

/// Share of the length in each shoulder of the arch: steep at the ends and flat along the belly.
pub const SHOULDER: f64 = 0.36;

impl Line {
    /// Length of the line of action.
    pub fn length(&self, frames: &(impl Frames + ?Sized)) -> f64 {
        frames.place(self.origin).distance(frames.place(self.insertion))
    }

    /// The centre line that is drawn; `length` is that of the line of action or, where the muscle is held at a limit, another.
    pub fn lay(&self, frames: &(impl Frames + ?Sized), length: f64) -> Path {
        match self.drawn {
            Some(drawn) => {
                let [start, end] = drawn.ends.map(|point| frames.place(point));
                let side = drawn.ends.map(|point| frames.frame(point.bone).transform_vector3(drawn.side));
                Path::arch(start, end, length, SHOULDER, side[0] + side[1])
            }
            None => Path::arch(frames.place(self.origin), frames.place(self.insertion), length, SHOULDER, DVec3::X),
        }
    }
}

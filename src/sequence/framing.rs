//! Camera placement: far enough that the whole movement is in the picture.
//!
//! The distance follows from everything that the clip covers, or the arm's whole swing, not from one moment: so a single picture is framed as
//! the same frame of an animation is, and two pictures of one file can be laid over each other.

use crate::document::{Document, PoseBuffers, PoseState};
use crate::scene::{Bounds, Camera, Frame, OrbitCamera};

/// Directions in which a turntable is looked at: every five degrees.
const TURNS: u16 = 72;

/// A direction to look in, fitted to what is shown.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Direction {
    /// Degrees round +Y.
    pub yaw: f32,
    /// Degrees above the horizon.
    pub pitch: f32,
    /// Parallel rays.
    pub parallel: bool,
    /// How many times nearer than the fit.
    pub zoom: f32,
}

/// A fitted camera that can be turned.
#[derive(Debug, Clone, Copy)]
pub struct FittedOrbit {
    orbit: OrbitCamera,
}

impl FittedOrbit {
    /// Fits `bounds` into a picture of `aspect` = width / height; with `turning`, from all sides at one distance.
    pub fn fit(direction: Direction, bounds: &Bounds, aspect: f32, turning: bool) -> Self {
        let fitted = |yaw: f32| {
            let mut orbit = OrbitCamera { yaw, pitch: direction.pitch, orthographic: direction.parallel, ..OrbitCamera::default() };
            orbit.fit(bounds, aspect);
            orbit
        };
        let mut orbit = fitted(direction.yaw);
        if turning {
            let steps = (0..TURNS).map(|i| direction.yaw + f32::from(i) * 360.0 / f32::from(TURNS));
            orbit.distance = steps.map(|yaw| fitted(yaw).distance).fold(orbit.distance, f32::max);
        }
        orbit.zoom(direction.zoom);
        Self { orbit }
    }

    /// The camera, turned by `turn` degrees to the right round the model.
    pub fn camera(&self, turn: f32) -> Camera {
        OrbitCamera { yaw: self.orbit.yaw + turn, ..self.orbit }.camera()
    }
}

/// The box round everything at one moment.
pub fn posed_bounds(document: &Document, state: &PoseState) -> Bounds {
    let mut frame = Frame::default();
    document.pose(state, &mut PoseBuffers::default(), &mut frame);
    frame.bounds
}

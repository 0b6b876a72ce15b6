//! Camera placement: far enough away that the whole movement is in the picture.
//!
//! The distance follows from everything that the clip covers, or the arm's whole swing, not from one moment: so a single picture is framed as
//! the same frame of an animation is, and two pictures of one file can be laid over each other.

use sinew_engine::document::{Document, PoseBuffers, PoseState};
use sinew_scene::{Bounds, Frame, OrbitCamera};

/// Number of directions for which a turntable is fitted: every five degrees.
const TURNTABLE_STEPS: u16 = 72;

/// View direction of a fitted camera.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Direction {
    /// Degrees round +Y.
    pub yaw: f32,
    /// Degrees above the horizon.
    pub pitch: f32,
    /// Whether the projection is orthographic.
    pub parallel: bool,
    /// Magnification relative to the fit.
    pub zoom: f32,
}

/// A fitted orbit camera, with a turntable.
#[derive(Debug, Clone, Copy)]
pub struct FittedOrbit {
    orbit: OrbitCamera,
}

impl FittedOrbit {
    /// Fits `bounds` into a picture of `aspect` = width / height; with `turntable`, at one distance from all sides.
    pub fn fit(direction: Direction, bounds: &Bounds, aspect: f32, turntable: bool) -> Self {
        let fitted = |yaw: f32| {
            let mut orbit = OrbitCamera { yaw, pitch: direction.pitch, orthographic: direction.parallel, ..OrbitCamera::default() };
            orbit.fit(bounds, aspect);
            orbit
        };
        let mut orbit = fitted(direction.yaw);
        if turntable {
            let steps = (0..TURNTABLE_STEPS).map(|i| direction.yaw + f32::from(i) * 360.0 / f32::from(TURNTABLE_STEPS));
            orbit.distance = steps.map(|yaw| fitted(yaw).distance).fold(orbit.distance, f32::max);
        }
        orbit.zoom(direction.zoom);
        Self { orbit }
    }

    /// The orbit.
    pub fn orbit(&self) -> OrbitCamera {
        self.orbit
    }
}

/// Bounding box of the posed document.
pub fn posed_bounds(document: &Document, state: &PoseState) -> Bounds {
    let mut frame = Frame::default();
    document.pose(state, &mut PoseBuffers::default(), &mut frame);
    frame.bounds
}

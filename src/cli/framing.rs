//! Where the eye stands: far enough that all of the movement is in the picture.
//!
//! The distance follows from everything that the clip covers, or the arm's whole swing, not from one moment: so a single picture is framed as
//! the same frame of an animation is, and two pictures of one file can be laid over each other.

use clap::ArgMatches;

use super::value;
use crate::document::{Document, PoseBuffers, PoseState};
use crate::scene::{Bounds, Camera, Frame, OrbitCamera, View};

/// Directions in which a turntable is looked at: every five degrees.
const TURNS: u16 = 72;

/// The direction that the options name.
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

impl Direction {
    /// Takes `--camera`, `--yaw`, `--pitch` and `--zoom`. The named cameras but `orbit` have parallel rays; yaw and pitch replace their angles.
    pub fn given(given: &ArgMatches) -> Self {
        let (view, parallel) = match value::<String>(given, "camera").as_deref() {
            Some("front") => (View::Front, true),
            Some("right") => (View::Right, true),
            Some("top") => (View::Top, true),
            Some("iso") => (View::Iso, true),
            _ => (View::Start, false),
        };
        let (yaw, pitch) = view.angles();
        Self {
            // Whole turns go first: in `f32` a large angle would have no degrees left.
            yaw: value::<f64>(given, "yaw").map_or(yaw, |yaw| (yaw % 360.0) as f32),
            pitch: value::<f64>(given, "pitch").map_or(pitch, |pitch| pitch as f32),
            parallel,
            zoom: value::<f64>(given, "zoom").map_or(1.0, |zoom| zoom as f32),
        }
    }
}

/// A fitted camera that can be turned.
#[derive(Debug, Clone, Copy)]
pub struct Eye {
    orbit: OrbitCamera,
}

impl Eye {
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

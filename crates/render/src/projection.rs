//! From the world to the fixed-point picture plane.

use glam::{Mat4, Vec3, Vec4};

use sinew_scene::{Camera, Projection};

/// Sub-pixels a pixel: vertices are snapped to 24.8 fixed point.
pub(super) const SUB: i64 = 256;

/// Half the side of the guard band, in pixels from the middle of the picture. Inside it all edge steps fit in 32 bits
/// (see `setup`), and it reaches beyond the largest picture that [`sinew_scene::limits::PICTURE_SIDE`] allows.
pub(super) const GUARD: f32 = 10_240.0;

/// A vertex on the picture plane.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct ScreenVertex {
    /// Sub-pixels from the left edge.
    pub x: i32,
    /// Sub-pixels from the top edge, downward.
    pub y: i32,
    /// Nearness: 1 / distance in perspective, a falling linear function of the distance otherwise. Either way it is linear on the picture,
    /// larger is nearer, and in perspective floats are fine just where it matters.
    pub q: f32,
    /// Why it cannot be used as it is: a set of [`NEAR`], …; 0 = it can.
    pub code: u32,
}

/// In front of the near plane.
pub(super) const NEAR: u32 = 1;
/// Beyond the guard band on the left, right, top, bottom.
pub(super) const SIDES: [u32; 4] = [2, 4, 8, 16];
/// Not a number.
pub(super) const BAD: u32 = 32;

/// The camera, prepared for one picture size.
#[derive(Debug, Clone, Copy)]
pub(super) struct ViewTransform {
    /// Rows of the matrix world → clip: x, y, and w (the distance in perspective, 1 otherwise).
    pub x: Vec4,
    pub y: Vec4,
    pub w: Vec4,
    /// Distance from the camera plane.
    pub distance: Vec4,
    /// For a parallel camera: nearness.
    pub nearness: Vec4,
    /// Whether things shrink with distance.
    pub perspective: bool,
    /// Near plane, metres.
    pub near: f32,
    /// Half the picture's size in pixels.
    pub half: [f32; 2],
    /// Picture size in pixels.
    pub size: [u32; 2],
    /// Position of the camera.
    pub eye: Vec3,
    /// From the scene to the viewer, for a parallel camera.
    pub back: Vec3,
    /// Directions of the picture.
    pub right: Vec3,
    pub up: Vec3,
    /// Metres a pixel at distance 1 (perspective) or anywhere (parallel).
    pub metres_per_pixel: f32,
}

impl ViewTransform {
    /// `None` where the camera has no usable numbers.
    pub(super) fn new(camera: &Camera, width: u32, height: u32) -> Option<Self> {
        let (w, h) = (width as f32, height as f32);
        let view = camera.view();
        let matrix: Mat4 = camera.projection_matrix(w / h) * view;
        let distance = -view.row(2);
        let perspective = matches!(camera.projection, Projection::Perspective { .. });
        let span = (camera.far - camera.near).max(1e-6);
        let near = if perspective { camera.near.max(1e-9) } else { camera.near };
        let metres_per_pixel = match camera.projection {
            Projection::Perspective { fov_y } => 2.0 * (fov_y * 0.5).tan() / h,
            Projection::Orthographic { height } => height / h,
        };
        let this = Self {
            x: matrix.row(0),
            y: matrix.row(1),
            w: if perspective { distance } else { Vec4::W },
            distance,
            nearness: (Vec4::W * camera.far - distance) / span,
            perspective,
            near,
            half: [w * 0.5, h * 0.5],
            size: [width, height],
            eye: camera.eye,
            back: -camera.forward(),
            right: camera.right(),
            up: camera.up(),
            metres_per_pixel,
        };
        let numbers = [this.x, this.y, this.w, this.distance, this.nearness];
        (numbers.iter().all(|row| row.is_finite()) && near.is_finite() && metres_per_pixel > 0.0 && metres_per_pixel.is_finite())
            .then_some(this)
    }

    /// Whether a world point is beyond the near plane, by more than what rounding may do.
    pub(super) fn reaches(&self, p: Vec3) -> bool {
        let [_, _, _, distance, _] = self.clip(p);
        distance > f64::from(self.near) * 1.001 + 1e-6 * f64::from(self.distance.truncate().abs().dot(p.abs()) + self.distance.w.abs())
    }

    /// Clip coordinates of a world point: x, y, w, distance, nearness (the last only for a parallel camera).
    pub(super) fn clip(&self, p: Vec3) -> [f64; 5] {
        let point = p.extend(1.0).as_dvec4();
        [self.x, self.y, self.w, self.distance, self.nearness].map(|row| row.as_dvec4().dot(point))
    }

    /// Pixel coordinates and nearness of clip coordinates that are in front of the camera.
    pub(super) fn project(&self, clip: [f64; 5]) -> [f64; 3] {
        let [x, y, w, _, nearness] = clip;
        let inverse = 1.0 / w;
        let [half_x, half_y] = self.half.map(f64::from);
        [(x * inverse + 1.0) * half_x, (1.0 - y * inverse) * half_y, if self.perspective { inverse } else { nearness }]
    }

    /// The same, snapped; `None` outside the guard band.
    pub(super) fn snap(&self, clip: [f64; 5]) -> Option<ScreenVertex> {
        let [x, y, q] = self.project(clip);
        let guard = f64::from(GUARD) + 1.0;
        let inside = (x - f64::from(self.half[0])).abs() <= guard && (y - f64::from(self.half[1])).abs() <= guard && q.is_finite();
        inside.then(|| ScreenVertex { x: (x * 256.0 + 0.5).floor() as i32, y: (y * 256.0 + 0.5).floor() as i32, q: q as f32, code: 0 })
    }

    /// Guard band in units of w.
    pub(super) fn guard(&self) -> [f32; 2] {
        self.half.map(|half| GUARD / half)
    }

    /// What to do to a nearness to bring something `by` steps forward: factor and summand. A step is a thousandth of the distance, or of the scene.
    pub(super) fn depth_bias(&self, by: f32) -> [f32; 2] {
        if self.perspective { [1.0 + by * 1e-3, 0.0] } else { [1.0, by * 1.5e-4] }
    }

    /// Metres that a pixel spans at `p`, at least as much as at the near plane.
    pub(super) fn pixel_at(&self, p: Vec3) -> f32 {
        if self.perspective { self.metres_per_pixel * self.distance.dot(p.extend(1.0)).max(self.near) } else { self.metres_per_pixel }
    }
}

impl ViewTransform {
    /// Whether anything can be seen in it.
    pub(super) fn is_somewhere(&self) -> bool {
        self.distance != Vec4::ZERO
    }

    /// A view in which nothing is seen, for a camera without numbers.
    pub(super) fn degenerate() -> Self {
        Self {
            x: Vec4::ZERO,
            y: Vec4::ZERO,
            w: Vec4::W,
            distance: Vec4::ZERO,
            nearness: Vec4::ZERO,
            perspective: false,
            near: 1.0,
            half: [1.0; 2],
            size: [1; 2],
            eye: Vec3::ZERO,
            back: Vec3::Z,
            right: Vec3::X,
            up: Vec3::Y,
            metres_per_pixel: 1.0,
        }
    }
}

//! Geodesics as an initial value problem, with the Jacobi fields that tell how their end moves when their start does.
//!
//! A geodesic x(s) bends along the normal alone: x″ = −(x′·S x′) n with the shape operator S. A geodesic beside it keeps a distance y b to it that obeys
//! Jacobi's equation y″ + K y = 0 with Gauss' curvature K. Two of its solutions give all neighbours: that which starts with y = 1, y′ = 0 (the start shifted
//! sideways) and that with y = 0, y′ = 1 (the direction turned). Together with moving along the geodesic at either end they are the *natural geodesic
//! variations* of Scholz et al. (2016).

use glam::DVec3;

/// Where a geodesic starts, and how far it runs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct GeodesicStart {
    /// A point of the surface, in its frame.
    pub point: DVec3,
    /// Direction, of length 1.
    pub tangent: DVec3,
    /// Length; negative runs backwards.
    pub length: f64,
}

/// Where a geodesic ends, and the Jacobi fields there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct GeodesicEnd {
    /// The point.
    pub point: DVec3,
    /// Direction, of length 1.
    pub tangent: DVec3,
    /// How far the end moves along the binormal when the start moves by 1 along its own.
    pub shift: f64,
    /// Derivative of `shift` by the length.
    pub shift_rate: f64,
    /// How far the end moves along the binormal when the start turns by 1 radian from tangent to binormal.
    pub turn: f64,
    /// Derivative of `turn` by the length.
    pub turn_rate: f64,
}

/// What the integrator needs of a surface at a point and a direction.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bend {
    /// x″.
    pub acceleration: DVec3,
    /// Gauss' curvature.
    pub gauss: f64,
}

/// How far a step may leave the surface, turn out of it, or change the Wronskian of the Jacobi fields, as shares.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Accuracy {
    /// To rounding: lengths and moment arms come from it.
    Exact,
    /// To 10⁻⁹: what is only drawn.
    Drawn,
}

impl Accuracy {
    fn tolerance(self) -> f64 {
        match self {
            Accuracy::Exact => 3e-14,
            Accuracy::Drawn => 1e-9,
        }
    }

    /// The first step that is tried, in radians that the sharpest curvature near it turns: long enough for most, and so short that few are tried again.
    fn first(self) -> f64 {
        match self {
            Accuracy::Exact => 0.08,
            Accuracy::Drawn => STEP,
        }
    }
}

/// Longest step, in radians that the sharpest curvature near it turns.
const STEP: f64 = 0.3;
/// A step that goes wrong is made no shorter than the length over this.
const STEPS: f64 = 400.0;
/// Most steps tried, those that go wrong among them.
const TRIES: usize = 800;

/// Point, tangent, and both Jacobi fields with their derivatives: x, x′, (shift, turn), (shift′, turn′). One list, so that a step is a few instructions for
/// each of its weights.
#[derive(Debug, Clone, Copy)]
struct State([f64; 10]);

impl State {
    fn new(point: DVec3, tangent: DVec3, fields: [f64; 4]) -> Self {
        let [a, b, c, d] = fields;
        Self([point.x, point.y, point.z, tangent.x, tangent.y, tangent.z, a, b, c, d])
    }

    fn point(&self) -> DVec3 {
        let [x, y, z, ..] = self.0;
        DVec3::new(x, y, z)
    }

    fn tangent(&self) -> DVec3 {
        let [_, _, _, x, y, z, ..] = self.0;
        DVec3::new(x, y, z)
    }

    /// Shift, turn, and their derivatives.
    fn fields(&self) -> [f64; 4] {
        let [.., a, b, c, d] = self.0;
        [a, b, c, d]
    }

    /// This state moved by `step` times the weighted sum of derivatives.
    #[inline(always)]
    fn moved<const N: usize>(&self, step: f64, weights: [f64; N], rates: [&State; N]) -> State {
        let mut moved = self.0;
        for (weight, rate) in weights.into_iter().zip(rates) {
            let factor = step * weight;
            for (value, rate) in moved.iter_mut().zip(rate.0) {
                *value += rate * factor;
            }
        }
        State(moved)
    }
}

/// Integrates a geodesic with the method of order 8 in 11 stages by Cooper and Verner (1972), and puts it back on the surface after each step.
///
/// `bend` gives x″ and K, `sharpness` the reciprocal of the length in which the surface changes, `project` the nearest point of the surface, `normal` a vector
/// along the normal.
pub(super) fn integrate(
    start: &GeodesicStart,
    accuracy: Accuracy,
    bend: impl Fn(DVec3, DVec3) -> Bend,
    sharpness: impl Fn(DVec3, DVec3) -> f64,
    project: impl Fn(DVec3) -> DVec3,
    normal: impl Fn(DVec3) -> DVec3,
) -> GeodesicEnd {
    let rate = |state: &State| {
        let Bend { acceleration, gauss } = bend(state.point(), state.tangent());
        let [shift, turn, shift_rate, turn_rate] = state.fields();
        State::new(state.tangent(), acceleration, [shift_rate, turn_rate, -gauss * shift, -gauss * turn])
    };
    let tolerance = accuracy.tolerance();
    let mut state = State::new(start.point, start.tangent, [1.0, 0.0, 0.0, 1.0]);
    let mut left = start.length.abs();
    let shortest = left / STEPS;
    let mut proven = f64::INFINITY;
    let mut drift = 0.0;
    for _ in 0..TRIES {
        if left <= 0.0 {
            break;
        }
        let sharpness = sharpness(state.point(), state.tangent());
        let longest = if proven.is_finite() { proven.min(STEP / sharpness) } else { accuracy.first() / sharpness };
        let wanted = longest.max(shortest);
        // Of what is left, two even steps are better than a long and a tiny one.
        let size = if left <= wanted {
            left
        } else if left < 2.0 * wanted {
            0.5 * left
        } else {
            wanted
        };
        let moved = step(&state, size.copysign(start.length), &rate);
        let tangent = moved.tangent();
        let point = project(moved.point());
        let normal = normal(point).normalize_or(DVec3::X);
        // All of these are 0 on a geodesic, and about as large as the error of the step.
        let fields = moved.fields();
        let [shift, turn, shift_rate, turn_rate] = fields;
        let wronskian = (shift * turn_rate - turn * shift_rate - 1.0) / (1.0 + (shift * turn_rate).abs());
        let error = (moved.point().distance(point) * sharpness)
            .max((tangent.length_squared() - 1.0).abs())
            .max(tangent.dot(normal).abs())
            .max((wronskian - drift).abs());
        let fails = error > tolerance && size > shortest;
        if fails || left > size {
            proven = size * (0.9 * (tolerance / error.max(1e-18)).powf(1.0 / 9.0)).clamp(0.1, 2.0);
        }
        if fails {
            continue;
        }
        left -= size;
        drift = wronskian;
        state = State::new(point, tangent.reject_from_normalized(normal).normalize_or(state.tangent()), fields);
    }
    let [shift, turn, shift_rate, turn_rate] = state.fields();
    GeodesicEnd { point: state.point(), tangent: state.tangent(), shift, shift_rate, turn, turn_rate }
}

/// One step of Cooper and Verner's method; `S` is √21.
fn step(y: &State, h: f64, rate: &impl Fn(&State) -> State) -> State {
    const S: f64 = 4.582_575_694_955_84;
    let k1 = &rate(y);
    let k2 = &rate(&y.moved(h, [1.0 / 2.0], [k1]));
    let k3 = &rate(&y.moved(h, [1.0 / 4.0, 1.0 / 4.0], [k1, k2]));
    let k4 = &rate(&y.moved(h, [1.0 / 7.0, (-7.0 - 3.0 * S) / 98.0, (21.0 + 5.0 * S) / 49.0], [k1, k2, k3]));
    let k5 = &rate(&y.moved(h, [(11.0 + S) / 84.0, (18.0 + 4.0 * S) / 63.0, (21.0 - S) / 252.0], [k1, k3, k4]));
    let k6 =
        &rate(&y.moved(h, [(5.0 + S) / 48.0, (9.0 + S) / 36.0, (-231.0 + 14.0 * S) / 360.0, (63.0 - 7.0 * S) / 80.0], [k1, k3, k4, k5]));
    let k7 = &rate(&y.moved(
        h,
        [(10.0 - S) / 42.0, (-432.0 + 92.0 * S) / 315.0, (633.0 - 145.0 * S) / 90.0, (-504.0 + 115.0 * S) / 70.0, (63.0 - 13.0 * S) / 35.0],
        [k1, k3, k4, k5, k6],
    ));
    let k8 = &rate(&y.moved(h, [1.0 / 14.0, (14.0 - 3.0 * S) / 126.0, (13.0 - 3.0 * S) / 63.0, 1.0 / 9.0], [k1, k5, k6, k7]));
    let k9 = &rate(&y.moved(
        h,
        [1.0 / 32.0, (91.0 - 21.0 * S) / 576.0, 11.0 / 72.0, (-385.0 - 75.0 * S) / 1152.0, (63.0 + 13.0 * S) / 128.0],
        [k1, k5, k6, k7, k8],
    ));
    let k10 = &rate(&y.moved(
        h,
        [
            1.0 / 14.0,
            1.0 / 9.0,
            (-733.0 - 147.0 * S) / 2205.0,
            (515.0 + 111.0 * S) / 504.0,
            (-51.0 - 11.0 * S) / 56.0,
            (132.0 + 28.0 * S) / 245.0,
        ],
        [k1, k5, k6, k7, k8, k9],
    ));
    let k11 = &rate(&y.moved(
        h,
        [
            (-42.0 + 7.0 * S) / 18.0,
            (-18.0 + 28.0 * S) / 45.0,
            (-273.0 - 53.0 * S) / 72.0,
            (301.0 + 53.0 * S) / 72.0,
            (28.0 - 28.0 * S) / 45.0,
            (49.0 - 7.0 * S) / 18.0,
        ],
        [k5, k6, k7, k8, k9, k10],
    ));
    y.moved(h, [1.0 / 20.0, 49.0 / 180.0, 16.0 / 45.0, 49.0 / 180.0, 1.0 / 20.0], [k1, k8, k9, k10, k11])
}

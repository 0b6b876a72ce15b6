//! Curves: values over time.
//!
//! Everything that a segment needs is worked out when the curve is made (cubic control points, decomposed matrices, the plane of each turn), so that
//! a sample is one binary search and a few multiplications, and depends on the time alone, never on what was asked before.

use glam::{DMat3, DMat4, DQuat, DVec3};

use crate::affine;

/// How the values go from one key to the next. A segment uses the mode of its first key.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Interpolation {
    /// Straight; whole matrices are decomposed and their rotations follow the shortest arc.
    #[default]
    Linear,
    /// The value of the first key until the next.
    Step,
    /// A cubic through control points given as (time, value).
    Bezier,
    /// A cubic with tangent vectors.
    Hermite,
}

/// Control points of one number over one segment: times as parts of the segment, values as they are.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Cubic {
    x: [f64; 2],
    y: [f64; 2],
}

/// Interpolation of a matrix from one key to the next.
#[derive(Debug, Clone, Copy, PartialEq)]
enum MatrixSegment {
    /// Translation and scale straight, rotation along the arc from this key's rotation through `across`, `angle` radians in quaternion space
    /// (half the turn); an angle of 0 means that the turn is too small for an arc and `across` is the difference.
    Arc { across: DQuat, angle: f64 },
    /// Element by element: the keys shear or are flat, so that they have no rotation.
    Elements,
}

/// Rotation and scale of a matrix key.
#[derive(Debug, Clone, Copy, PartialEq)]
struct RotationScale {
    rotation: DQuat,
    scale: DVec3,
}

/// Tangents of keys, as a file gives them.
#[derive(Debug, Clone, Default)]
pub struct Tangents {
    /// Numbers a key: the dimension (values alone), the dimension + 1 (one time for all), or twice the dimension (time and value each).
    pub stride: usize,
    /// `keys · stride` numbers.
    pub values: Vec<f64>,
}

impl Tangents {
    /// Time (where there is one) and value for `component` of `key`.
    fn get(&self, key: usize, component: usize, dimension: usize) -> Option<(Option<f64>, f64)> {
        let row = self.values.get(key.checked_mul(self.stride)?..)?.get(..self.stride)?;
        let (time, value) = if self.stride == dimension {
            (None, row.get(component)?)
        } else if self.stride == 2 * dimension {
            (row.get(2 * component), row.get(2 * component + 1)?)
        } else if self.stride == dimension + 1 {
            (row.first(), row.get(component + 1)?)
        } else {
            return None;
        };
        (value.is_finite() && time.is_none_or(|time| time.is_finite())).then_some((time.copied(), *value))
    }
}

/// The keys that a curve is made of. They may stand in any order; a key that isn't finite is left out.
#[derive(Debug, Clone, Default)]
pub struct Keys {
    /// Times, seconds.
    pub times: Vec<f64>,
    /// Numbers a key; 16 with `matrix`.
    pub dimension: usize,
    /// `times.len() · dimension` numbers; matrices column by column.
    pub values: Vec<f64>,
    /// One mode a key; missing ones are linear.
    pub modes: Vec<Interpolation>,
    /// Tangents that arrive at each key.
    pub in_tangents: Tangents,
    /// Tangents that leave each key.
    pub out_tangents: Tangents,
    /// Whether the numbers are whole transform matrices.
    pub matrix: bool,
}

/// Keys of one animated value of `dimension` numbers. Make one with [`Curve::new`].
///
/// ```
/// use sinew_scene::animation::{Curve, Interpolation, Keys};
///
/// let modes = vec![Interpolation::Linear, Interpolation::Step, Interpolation::Linear];
/// let curve = Curve::new(Keys { times: vec![0.0, 1.0, 2.0], dimension: 1, values: vec![0.0, 10.0, 20.0], modes, ..Keys::default() });
/// assert_eq!(curve.value(0.25, 0), 2.5);
/// // A segment uses the mode of its first key.
/// assert_eq!(curve.value(1.9, 0), 10.0);
/// ```
#[derive(Debug, Clone, Default)]
pub struct Curve {
    /// Key times, seconds, ascending.
    pub times: Vec<f64>,
    /// Numbers a key.
    pub dimension: usize,
    /// `times.len() · dimension` numbers; matrices column by column.
    pub values: Vec<f64>,
    /// One mode a key.
    pub modes: Vec<Interpolation>,
    /// `dimension` cubics for each segment that has them.
    cubics: Vec<Cubic>,
    /// Where a segment's cubics start; `NO_CUBIC` where it has none. Empty where no segment has any.
    cubic_starts: Vec<u32>,
    rotation_scales: Vec<RotationScale>,
    matrix_segments: Vec<MatrixSegment>,
    sheared: bool,
}

const NO_CUBIC: u32 = u32::MAX;

/// How far from square the axes of a matrix may be before it counts as sheared (cosine of the angle between them).
const SHEAR_TOLERANCE: f64 = 1e-3;

impl Curve {
    /// Makes a curve.
    pub fn new(keys: Keys) -> Self {
        let keys = sorted(keys);
        let Keys { times, dimension, values, mut modes, in_tangents, out_tangents, matrix } = keys;
        modes.resize(times.len(), Interpolation::Linear);
        let mut curve = Self { times, dimension, values, modes, ..Self::default() };
        curve.make_cubics(&in_tangents, &out_tangents);
        if matrix && dimension == 16 {
            curve.make_matrix_segments();
        }
        curve
    }

    /// Whether matrix keys shear, so that they go element by element.
    pub fn is_sheared(&self) -> bool {
        self.sheared
    }

    /// First and last key time; `None` without keys.
    pub fn time_range(&self) -> Option<(f64, f64)> {
        Some((*self.times.first()?, *self.times.last()?))
    }

    fn make_cubics(&mut self, in_tangents: &Tangents, out_tangents: &Tangents) {
        let segments = self.times.len().saturating_sub(1);
        if !self.modes.iter().any(|mode| matches!(mode, Interpolation::Bezier | Interpolation::Hermite)) {
            return;
        }
        self.cubic_starts = vec![NO_CUBIC; segments];
        for segment in 0..segments {
            let start = self.cubics.len();
            let whole = (0..self.dimension).all(|component| {
                let cubic = self.cubic(segment, component, in_tangents, out_tangents);
                self.cubics.extend(cubic);
                cubic.is_some()
            });
            match self.cubic_starts.get_mut(segment) {
                Some(slot) if whole => *slot = u32::try_from(start).unwrap_or(NO_CUBIC),
                _ => self.cubics.truncate(start),
            }
        }
    }

    fn cubic(&self, segment: usize, component: usize, in_tangents: &Tangents, out_tangents: &Tangents) -> Option<Cubic> {
        let (t0, t1) = (*self.times.get(segment)?, *self.times.get(segment + 1)?);
        let (v0, v1) = (self.key(segment, component), self.key(segment + 1, component));
        let (x_out, y_out) = out_tangents.get(segment, component, self.dimension)?;
        let (x_in, y_in) = in_tangents.get(segment + 1, component, self.dimension)?;
        // Without times the control points stand at thirds of the segment.
        let thirds = [t0 + (t1 - t0) / 3.0, t1 - (t1 - t0) / 3.0];
        let (x, y) = match self.modes.get(segment)? {
            Interpolation::Bezier => ([x_out.unwrap_or(thirds[0]), x_in.unwrap_or(thirds[1])], [y_out, y_in]),
            // Tangent vectors: a third of each from its key.
            Interpolation::Hermite => {
                ([x_out.map_or(thirds[0], |x| t0 + x / 3.0), x_in.map_or(thirds[1], |x| t1 - x / 3.0)], [v0 + y_out / 3.0, v1 - y_in / 3.0])
            }
            Interpolation::Linear | Interpolation::Step => return None,
        };
        // Inside the segment the time never runs backwards, so that each moment has one value.
        let length = t1 - t0;
        let part = |x: f64| if length > 0.0 { ((x - t0) / length).clamp(0.0, 1.0) } else { 0.0 };
        Some(Cubic { x: x.map(part), y })
    }

    fn make_matrix_segments(&mut self) {
        let decomposed: Vec<Option<RotationScale>> =
            (0..self.times.len()).map(|key| decompose(&self.matrix_key(key), &mut self.sheared)).collect();
        self.matrix_segments = decomposed
            .iter()
            .zip(decomposed.iter().skip(1))
            .map(|(from, to)| match (from, to) {
                (Some(from), Some(to)) => arc(from.rotation, to.rotation),
                _ => MatrixSegment::Elements,
            })
            .collect();
        let flat = RotationScale { rotation: DQuat::IDENTITY, scale: DVec3::ONE };
        self.rotation_scales = decomposed.into_iter().map(|key| key.unwrap_or(flat)).collect();
    }

    fn key(&self, key: usize, component: usize) -> f64 {
        self.values.get(key * self.dimension + component).copied().unwrap_or(0.0)
    }

    fn matrix_key(&self, key: usize) -> DMat4 {
        let values = self.values.get(key * 16..).and_then(|values| values.first_chunk::<16>());
        affine(values.map_or(DMat4::IDENTITY, DMat4::from_cols_array))
    }

    /// The segment that `time` falls into and how far along it is; the second is 0 on a key and outside of the keys.
    fn place(&self, time: f64) -> (usize, f64) {
        let after = self.times.partition_point(|key| *key <= time);
        let Some(before) = after.checked_sub(1) else { return (0, 0.0) };
        match (self.times.get(before), self.times.get(after)) {
            (Some(t0), Some(t1)) => (before, (time - t0) / (t1 - t0)),
            _ => (before, 0.0),
        }
    }

    /// One number at `time`; 0 without keys.
    pub fn value(&self, time: f64, component: usize) -> f64 {
        let (segment, part) = self.place(time);
        self.blend(segment, part, component)
    }

    /// The first numbers at `time`, as many as `values` holds and the curve has.
    pub fn sample(&self, time: f64, values: &mut [f64]) {
        let (segment, part) = self.place(time);
        for (component, value) in values.iter_mut().enumerate().take(self.dimension) {
            *value = self.blend(segment, part, component);
        }
    }

    fn blend(&self, segment: usize, part: f64, component: usize) -> f64 {
        let from = self.key(segment, component);
        if part == 0.0 {
            return from;
        }
        let to = self.key(segment + 1, component);
        match self.modes.get(segment) {
            Some(Interpolation::Step) => from,
            Some(Interpolation::Bezier | Interpolation::Hermite) => match self.cubic_at(segment, component) {
                Some(cubic) => cubic.value(from, to, part),
                None => from + (to - from) * part,
            },
            _ => from + (to - from) * part,
        }
    }

    fn cubic_at(&self, segment: usize, component: usize) -> Option<&Cubic> {
        let start = *self.cubic_starts.get(segment)?;
        if start == NO_CUBIC { None } else { self.cubics.get(start as usize + component) }
    }

    /// The two inner control points, as (time, value), of one number between key `segment` and the next; `None` where it goes straight or by steps.
    pub fn control_points(&self, segment: usize, component: usize) -> Option<[(f64, f64); 2]> {
        let (t0, t1) = (*self.times.get(segment)?, *self.times.get(segment + 1)?);
        let cubic = self.cubic_at(segment, component)?;
        Some([0, 1].map(|end| (t0 + (t1 - t0) * cubic.x[end], cubic.y[end])))
    }

    /// The whole matrix at `time`, with a bottom row of 0 0 0 1; the identity where the curve holds no matrices.
    pub fn matrix(&self, time: f64) -> DMat4 {
        let (segment, part) = self.place(time);
        if part == 0.0 || self.modes.get(segment) == Some(&Interpolation::Step) {
            return self.matrix_key(segment);
        }
        let smooth = self.cubic_at(segment, 0).is_some();
        if let (Some(MatrixSegment::Arc { across, angle }), Some(from), Some(to)) =
            (self.matrix_segments.get(segment), self.rotation_scales.get(segment), self.rotation_scales.get(segment + 1))
            && !smooth
        {
            let rotation = if *angle > 0.0 {
                let (sin, cos) = (angle * part).sin_cos();
                from.rotation * cos + *across * sin
            } else {
                (from.rotation + *across * part).normalize()
            };
            let (a, b) = (self.translation_key(segment), self.translation_key(segment + 1));
            return DMat4::from_scale_rotation_translation(from.scale + (to.scale - from.scale) * part, rotation, a + (b - a) * part);
        }
        let mut values = [0.0; 16];
        for (component, value) in values.iter_mut().enumerate() {
            *value = self.blend(segment, part, component);
        }
        affine(DMat4::from_cols_array(&values))
    }

    fn translation_key(&self, key: usize) -> DVec3 {
        self.values.get(key * 16 + 12..).and_then(|values| values.first_chunk::<3>()).map_or(DVec3::ZERO, |v| DVec3::from_array(*v))
    }

    /// The slopes with which one number leaves a segment's first key and arrives at the next, per length of the segment; `None` where the way is no cubic of
    /// time: a step, or Bézier control points that do not stand at thirds.
    pub fn tangents_at_thirds(&self, segment: usize, component: usize) -> Option<[f64; 2]> {
        let (from, to) = (self.key(segment, component), self.key(segment + 1, component));
        match self.modes.get(segment)? {
            Interpolation::Step => None,
            Interpolation::Linear => Some([to - from; 2]),
            Interpolation::Bezier | Interpolation::Hermite => match self.cubic_at(segment, component) {
                None => Some([to - from; 2]),
                Some(Cubic { x, y }) => {
                    let at_thirds = (x[0] - 1.0 / 3.0).abs() < 1e-6 && (x[1] - 2.0 / 3.0).abs() < 1e-6;
                    at_thirds.then_some([3.0 * (y[0] - from), 3.0 * (to - y[1])])
                }
            },
        }
    }

    /// The same curve with another value for every value of a key or control point.
    #[must_use]
    pub fn mapped(&self, change: impl Fn(f64) -> f64) -> Self {
        let mut curve = self.clone();
        for value in &mut curve.values {
            *value = change(*value);
        }
        for cubic in &mut curve.cubics {
            cubic.y = cubic.y.map(&change);
        }
        curve
    }

    /// The curve of one component alone.
    #[must_use]
    pub fn component(&self, component: usize) -> Self {
        let mut curve = Self { times: self.times.clone(), dimension: 1, modes: self.modes.clone(), ..Self::default() };
        curve.values = (0..self.times.len()).map(|key| self.key(key, component)).collect();
        for segment in 0..self.cubic_starts.len() {
            let start = curve.cubics.len() as u32;
            let cubic = self.cubic_at(segment, component).copied();
            curve.cubics.extend(cubic);
            curve.cubic_starts.push(if cubic.is_some() { start } else { NO_CUBIC });
        }
        curve
    }
}

impl Cubic {
    /// The value where the time has come `part` of the way: solves x(s) = part for s, then takes y(s).
    fn value(&self, from: f64, to: f64, part: f64) -> f64 {
        let [x1, x2] = self.x;
        let s = if x1 == 1.0 / 3.0 && x2 == 2.0 / 3.0 { part } else { solve(x1, x2, part) };
        let r = 1.0 - s;
        r * r * r * from + 3.0 * r * s * (r * self.y[0] + s * self.y[1]) + s * s * s * to
    }
}

/// Solves `3(1−s)²s·x1 + 3(1−s)s²·x2 + s³ = x` for s in 0..1 by Newton steps that may not leave the bracket; where one would, the bracket is halved.
/// With x1 and x2 in 0..1 the left side never falls, so there is one root.
fn solve(x1: f64, x2: f64, x: f64) -> f64 {
    let (a, b, c) = (3.0 * x1, 3.0 * (x2 - 2.0 * x1), 1.0 + 3.0 * (x1 - x2));
    let (mut low, mut high) = (0.0, 1.0);
    let mut s = x;
    for _ in 0..64 {
        let error = ((c * s + b) * s + a) * s - x;
        if error.abs() < 1e-15 {
            break;
        }
        if error > 0.0 {
            high = s;
        } else {
            low = s;
        }
        let slope = (3.0 * c * s + 2.0 * b) * s + a;
        let next = s - error / slope;
        s = if next > low && next < high { next } else { (low + high) / 2.0 };
        if high - low < 1e-16 {
            break;
        }
    }
    s
}

/// Rotation and scale of a matrix; `None` where it shears (which sets `sheared`) or has an axis without length. A mirror goes into the x scale.
fn decompose(matrix: &DMat4, sheared: &mut bool) -> Option<RotationScale> {
    let axes = DMat3::from_mat4(*matrix);
    let mut scale = DVec3::new(axes.x_axis.length(), axes.y_axis.length(), axes.z_axis.length());
    let longest = scale.max_element();
    if !(longest.is_finite() && scale.min_element() > longest * 1e-9) {
        return None;
    }
    let (x, y, z) = (axes.x_axis / scale.x, axes.y_axis / scale.y, axes.z_axis / scale.z);
    if x.dot(y).abs().max(y.dot(z).abs()).max(z.dot(x).abs()) > SHEAR_TOLERANCE {
        *sheared = true;
        return None;
    }
    let mirror = x.cross(y).dot(z).signum();
    scale.x *= mirror;
    let rotation = DQuat::from_mat3(&DMat3::from_cols(x * mirror, y, z)).normalize();
    rotation.is_finite().then_some(RotationScale { rotation, scale })
}

/// The shorter arc from one rotation to another (K. Shoemake, "Animating rotation with quaternion curves", 1985): `from·cos φ + across·sin φ`, with `across`
/// the unit quaternion a quarter of a circle on.
fn arc(from: DQuat, to: DQuat) -> MatrixSegment {
    let mut cos = from.dot(to);
    let mut to = to;
    if cos < 0.0 {
        to = -to;
        cos = -cos;
    }
    let across = to + from * -cos;
    let sin = across.length();
    if sin < 1e-7 {
        return MatrixSegment::Arc { across: to + -from, angle: 0.0 };
    }
    MatrixSegment::Arc { across: across * (1.0 / sin), angle: sin.atan2(cos) }
}

/// Keys in order of time, those with the same time in file order; ones that aren't finite are left out.
fn sorted(mut keys: Keys) -> Keys {
    let dimension = keys.dimension.max(1);
    let count = keys.times.len().min(keys.values.len() / dimension);
    let row = |key: usize| keys.values.get(key * dimension..).and_then(|values| values.get(..dimension)).unwrap_or_default();
    let is_good = |key: usize| keys.times.get(key).is_some_and(|time| time.is_finite()) && row(key).iter().all(|value| value.is_finite());
    let in_order = keys.times.iter().zip(keys.times.iter().skip(1)).all(|(a, b)| a <= b);
    keys.dimension = dimension;
    if in_order && count == keys.times.len() && (0..count).all(is_good) {
        keys.values.truncate(count * dimension);
        return keys;
    }
    let mut order: Vec<usize> = (0..count).filter(|key| is_good(*key)).collect();
    order.sort_by(|a, b| keys.times.get(*a).unwrap_or(&0.0).total_cmp(keys.times.get(*b).unwrap_or(&0.0)));
    let pick = |values: &[f64], stride: usize| -> Vec<f64> {
        order.iter().flat_map(|key| (0..stride).map(move |i| values.get(key * stride + i).copied().unwrap_or(f64::NAN))).collect()
    };
    let tangents = |tangents: &Tangents| Tangents { stride: tangents.stride, values: pick(&tangents.values, tangents.stride) };
    Keys {
        times: pick(&keys.times, 1),
        dimension,
        values: pick(&keys.values, dimension),
        modes: order.iter().map(|key| keys.modes.get(*key).copied().unwrap_or_default()).collect(),
        in_tangents: tangents(&keys.in_tangents),
        out_tangents: tangents(&keys.out_tangents),
        matrix: keys.matrix,
    }
}

#[cfg(test)]
mod tests;

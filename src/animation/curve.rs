//! Curves: values over time.

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

/// Keys of one animated value of `dimension` numbers.
#[derive(Debug, Clone, Default)]
pub struct Curve {
    /// Key times, seconds, ascending.
    pub times: Vec<f64>,
    /// Numbers a key.
    pub dimension: usize,
    /// `times.len() · dimension` numbers.
    pub values: Vec<f64>,
    /// One mode a key, or one for all.
    pub modes: Vec<Interpolation>,
}

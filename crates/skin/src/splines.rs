//! Cubic B-splines along a bone that all vanish, with slope and curvature, at both of its ends.

/// Number of splines along a bone.
pub(crate) const SPLINES: usize = 8;
/// Each spline covers four of these intervals.
const INTERVALS: f64 = (SPLINES + 3) as f64;

/// The values of the splines at a share `u` of the bone's length, 0 to 1; all are 0 outside.
pub(crate) fn splines_at(u: f64) -> [f64; SPLINES] {
    let place = u * INTERVALS;
    std::array::from_fn(|index| cubic(place - index as f64))
}

/// The uniform cubic B-spline over 0 to 4.
fn cubic(x: f64) -> f64 {
    let x = if x > 2.0 { 4.0 - x } else { x };
    if x <= 0.0 || x.is_nan() {
        0.0
    } else if x < 1.0 {
        x * x * x / 6.0
    } else {
        (x * (x * (12.0 - 3.0 * x) - 12.0) + 4.0) / 6.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn splines_add_up_to_one_away_from_the_ends_and_vanish_at_them() {
        for step in 0..=200 {
            let u = f64::from(step) / 200.0;
            let sum: f64 = splines_at(u).iter().sum();
            let inside = (3.0 / INTERVALS..=1.0 - 3.0 / INTERVALS).contains(&u);
            assert!(!inside || (sum - 1.0).abs() < 1e-12, "{u}: {sum}");
            assert!((0.0..=1.0 + 1e-12).contains(&sum));
        }
        assert_eq!((splines_at(0.0), splines_at(1.0)), ([0.0; SPLINES], [0.0; SPLINES]));
        assert_eq!((splines_at(-3.0), splines_at(f64::NAN)), ([0.0; SPLINES], [0.0; SPLINES]));
    }
}

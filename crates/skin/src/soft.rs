//! Functions that pass from one straight line to another without a jump in the slope.

/// The positive part of `x`, rounded: 0 below 0, `x²/2w` up to `w`, then `x − w/2`.
pub(crate) fn positive_part(x: f32, w: f32) -> f32 {
    if x <= 0.0 {
        0.0
    } else if x < w {
        x * x / (2.0 * w)
    } else {
        x - 0.5 * w
    }
}

/// [`positive_part`] in double precision.
pub(crate) fn positive_part_f64(x: f64, w: f64) -> f64 {
    if x <= 0.0 {
        0.0
    } else if x < w {
        x * x / (2.0 * w)
    } else {
        x - 0.5 * w
    }
}

/// `t` held between 0 and 1, rounded over a width of `w` at both limits, symmetric about ½.
pub(crate) fn held_within_unit(t: f64, w: f64) -> f64 {
    positive_part_f64(t + 0.5 * w, w) - positive_part_f64(t - 1.0 + 0.5 * w, w)
}

/// 0 below 0, 1 above 1, `3x² − 2x³` between.
pub(crate) fn smooth_step(x: f32) -> f32 {
    let x = x.clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}

/// `x` that approaches `limit` from below: `x (1 + (x/limit)⁴)^(−1/4)`.
pub(crate) fn saturated(x: f32, limit: f32) -> f32 {
    let square = (x / limit) * (x / limit);
    x / (1.0 + square * square).sqrt().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slopes_have_no_jump() {
        type Function = fn(f64) -> f64;
        let functions: [(&str, Function); 4] = [
            ("positive part", |x| f64::from(positive_part(x as f32, 0.5))),
            ("positive part in f64", |x| positive_part_f64(x, 0.5)),
            ("held", |x| held_within_unit(x, 0.2)),
            ("step", |x| f64::from(smooth_step(x as f32))),
        ];
        for (name, function) in functions {
            let h = 1e-2;
            for step in -200..300 {
                let x = f64::from(step) * h;
                let bend = function(x + h) - 2.0 * function(x) + function(x - h);
                assert!(bend.abs() < 12.0 * h * h, "{name} at {x}: {bend}");
            }
        }
    }

    #[test]
    fn limits_are_reached_and_kept() {
        assert_eq!((positive_part(-1.0, 0.5), positive_part(2.0, 0.5)), (0.0, 1.75));
        assert_eq!((held_within_unit(-3.0, 0.2), held_within_unit(0.5, 0.2)), (0.0, 0.5));
        assert!((held_within_unit(4.0, 0.2) - 1.0).abs() < 1e-12);
        assert!(saturated(1e9, 0.08) <= 0.08 && (saturated(0.02, 0.08) - 0.02).abs() < 3e-5 && saturated(0.0, 0.08) == 0.0);
    }
}

//! Pennation: the angle at which the fibres of a belly stand to the line of action, and the texture coordinates that draw them at it.
//!
//! The thickness of the sheet that the fibres span between their aponeuroses stays the same, so that L_m sin α = L_opt sin α₀ with the belly's length L_m, and
//! α₀ at the length L_opt [Zajac 1989, Muscle and tendon: properties, models, scaling, and application to biomechanics and motor control]. L_opt is the belly's
//! length at rest.
//!
//! A fibre at the angle α goes round the belly by dθ/ds = tan α / r for each unit of length s along the line of action, r being the radius of the round
//! cross-section. So the fibres, which the texture draws at constant u, are drawn at u = w − T(s) with T = ∫ tan α / (2π r) ds. w is how far round the belly
//! a place is from the seam, on either side of it: fibres lean to it from both sides, as those of a feather do, and the pattern closes.

use std::f64::consts::TAU;

/// Degrees that α₀ must stay below.
pub const LIMIT: f64 = 60.0;
/// The least cosine of α, as in OpenSim's `MuscleFixedWidthPennationModel`: a belly so short that its fibres would stand more across stays at it.
const LEAST_COSINE: f64 = 0.1;
/// Where a belly is thinner than this share of its largest radius, fibres turn round it as if it were as thick: at its very tips they would turn without end.
const THINNEST: f64 = 0.1;

/// Whether an angle may be a muscle's pennation, degrees: a belly of fibres along it has 0.
#[must_use]
pub fn is_pennation(degrees: f64) -> bool {
    (0.0..LIMIT).contains(&degrees)
}

/// The pennation angle α, radians, of a belly of this length whose fibres stand at `degrees` where it is `optimal_length` long: α = asin(L_opt sin α₀ / L_m).
///
/// No more than acos 0.1; 0 where an argument is not what a muscle has.
#[must_use]
pub fn angle(degrees: f64, optimal_length: f64, length: f64) -> f64 {
    let most = (1.0 - LEAST_COSINE * LEAST_COSINE).sqrt();
    let sine = optimal_length * degrees.to_radians().sin() / length;
    if sine > 0.0 { sine.min(most).asin() } else { 0.0 }
}

/// Radii of a belly's round cross-sections, between even nodes a straight line.
#[derive(Clone, Copy)]
pub(super) struct BellyTurns<'a> {
    radii: &'a [f64],
    /// Length between two nodes.
    spacing: f64,
    slope: f64,
    floor: f64,
}

impl<'a> BellyTurns<'a> {
    /// For a belly with these radii whose fibres stand at `angle`, radians.
    pub(super) fn new(radii: &'a [f64], length: f64, angle: f64) -> Self {
        let largest = radii.iter().copied().fold(0.0, f64::max);
        let spacing = length / radii.len().saturating_sub(1).max(1) as f64;
        Self { radii, spacing, slope: angle.tan() / TAU, floor: (THINNEST * largest).max(f64::MIN_POSITIVE) }
    }

    /// How many turns a fibre goes round the belly from node `span` on, over this share of the way to the next node.
    pub(super) fn over(&self, span: usize, share: f64) -> f64 {
        let radius = |node: usize| self.radii.get(node).copied().unwrap_or(0.0);
        let (from, to) = (radius(span), radius(span + 1));
        self.slope * self.spacing * share * mean_of_reciprocals(from, from + (to - from) * share, self.floor)
    }
}

/// The mean of 1 / max(r, `floor`) where r goes evenly from one radius to another.
fn mean_of_reciprocals(from: f64, to: f64, floor: f64) -> f64 {
    let (low, high) = (from.min(to), from.max(to));
    if high <= floor {
        return floor.recip();
    }
    let below = ((floor - low) / (high - low)).max(0.0);
    let low = low.max(floor);
    let rise = (high - low) / low;
    // ln(1 + x) / x, which is 1 where the radius stays.
    let logarithmic = if rise > 0.0 { rise.ln_1p() / rise } else { 1.0 };
    below / floor + (1.0 - below) * logarithmic / low
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_thickness_of_the_sheet_of_fibres_stays() {
        for length in [300.0, 267.0, 240.0, 200.0, 150.0] {
            assert!((angle(20.0, 267.0, length).sin() * length - 267.0 * 20_f64.to_radians().sin()).abs() < 1e-12);
        }
        assert!((angle(50.0, 267.0, 100.0).cos() - LEAST_COSINE).abs() < 1e-12);
        for (degrees, optimal, length) in
            [(0.0, 1.0, 1.0), (f64::NAN, 1.0, 1.0), (20.0, 1.0, -1.0), (20.0, 1.0, f64::NAN), (-5.0, 1.0, 1.0)]
        {
            assert_eq!(angle(degrees, optimal, length), 0.0);
        }
        assert!(is_pennation(0.0) && is_pennation(59.9) && !is_pennation(60.0) && !is_pennation(-0.1) && !is_pennation(f64::NAN));
    }

    #[test]
    fn the_mean_of_reciprocals_is_that_of_a_fine_sum() {
        const STEPS: u32 = 200_000;
        for (from, to) in [(4.0, 18.0), (18.0, 4.0), (7.0, 7.0), (7.0, 7.0 + 1e-12), (0.0, 9.0), (1.0, 0.2), (0.0, 0.0)] {
            let at = |step: u32| from + (to - from) * (f64::from(step) + 0.5) / f64::from(STEPS);
            let sum = (0..STEPS).map(|step| at(step).max(0.5).recip()).sum::<f64>() / f64::from(STEPS);
            let found = mean_of_reciprocals(from, to, 0.5);
            assert!((found / sum - 1.0).abs() < 1e-8, "{from} to {to}: {found} instead of {sum}");
        }
    }
}

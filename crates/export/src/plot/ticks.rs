//! Round numbers along an axis, and how they are written.

use sinew_i18n::quantity::{number, significant};

/// Round numbers within a range, about `count` of them.
pub(super) fn ticks(from: f64, to: f64, count: u32) -> Vec<f64> {
    let rough = (to - from) / f64::from(count.max(1));
    if !(rough.is_finite() && rough > 0.0) {
        return Vec::new();
    }
    let power = 10f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 3.0, 5.0, 10.0].map(|factor| factor * power).into_iter().find(|step| *step >= rough).unwrap_or(power * 10.0);
    let first = (from / step - 1e-9).ceil();
    (0..20).map(|index| (first + f64::from(index)) * step).take_while(|tick| *tick <= to + step * 1e-9).collect()
}

/// Distance of neighbouring ticks.
fn step_of(ticks: &[f64]) -> f64 {
    match ticks {
        [a, b, ..] => b - a,
        _ => 0.01,
    }
}

/// Whether numbers that far apart are written as powers of ten.
fn is_tiny_or_huge(step: f64) -> bool {
    !(1e-4..1e6).contains(&step)
}

/// Decimals that tell ticks apart.
fn digits_of(ticks: &[f64]) -> usize {
    (-step_of(ticks).log10().floor()).clamp(0.0, 9.0) as usize
}

/// A tick as text.
pub(super) fn label(tick: f64, ticks: &[f64]) -> String {
    let step = step_of(ticks);
    if !is_tiny_or_huge(step) {
        return number(tick, digits_of(ticks));
    }
    // A multiple of the step that ought to be zero may be off by a rounding.
    if tick.abs() < step * 1e-6 {
        return "0".into();
    }
    let text = significant(tick, 2);
    text.replace(".0·", "·").replace(",0·", "·")
}

/// A value between ticks as text: one digit more than they have.
pub(super) fn value(value: f64, ticks: &[f64]) -> String {
    if is_tiny_or_huge(step_of(ticks)) { significant(value, 2) } else { number(value, digits_of(ticks) + 1) }
}

/// A value of an axis with the unit that stands behind the axis' name.
pub(super) fn with_unit_of(axis: &str, value: f64) -> String {
    let unit = axis.rsplit_once(", ").map_or("", |(_, unit)| unit);
    let (digits, gap) = if unit == "°" { (1, "") } else { (2, "\u{2009}") };
    format!("{}{gap}{unit}", number(value, digits))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_few() {
        assert_eq!(ticks(0.0, 150.0, 5), [0.0, 30.0, 60.0, 90.0, 120.0, 150.0]);
        for (from, to) in [(-3.2, 7.9), (1e-6, 3e-6), (199.0, 201.0)] {
            let found = ticks(from, to, 4);
            assert!((2..=6).contains(&found.len()), "{found:?}");
            assert!(found.iter().all(|tick| *tick >= from - 1e-9 && *tick <= to + 1e-9));
        }
        assert!(ticks(1.0, 1.0, 4).is_empty() && ticks(f64::NAN, 1.0, 4).is_empty());
        assert_eq!((digits_of(&[0.0, 0.5]), digits_of(&[0.0, 30.0])), (1, 0));
    }

    #[test]
    fn tiny_ticks_are_powers_of_ten() {
        let found = ticks(-1e-12, 1e-12, 4);
        let labels: Vec<String> = found.iter().map(|tick| label(*tick, &found)).collect();
        assert_eq!(labels, ["−1·10⁻¹²", "−5·10⁻¹³", "0", "5·10⁻¹³", "1·10⁻¹²"]);
    }

    #[test]
    fn the_unit_of_an_axis_follows_its_values() {
        assert_eq!(with_unit_of("Elbow angle, °", 30.0), "30.0°");
        assert_eq!(with_unit_of("Time, s", 1.5), "1.50\u{2009}s");
    }
}

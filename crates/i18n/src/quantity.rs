//! Localised numbers with units.

use crate::decimal;

/// A thin space, between a number and its unit.
pub const THIN: char = '\u{2009}';
/// A minus that is as wide as a plus.
const MINUS: char = '\u{2212}';

/// `value` with `digits` decimals, a true minus and no negative zero; a dash where it is no number.
pub fn number(value: f64, digits: usize) -> String {
    if !value.is_finite() {
        return "–".into();
    }
    let text = decimal(value.abs(), digits);
    let zero = text.chars().all(|c| matches!(c, '0' | '.' | ','));
    if value < 0.0 && !zero { format!("{MINUS}{text}") } else { text }
}

/// Parses a number with a decimal point or comma and any minus sign; `None` where the text is no number.
pub fn parse_number(text: &str) -> Option<f64> {
    let plain: String = text
        .chars()
        .filter(|c| !c.is_whitespace())
        .map(|c| {
            if c == ',' {
                '.'
            } else if c == MINUS {
                '-'
            } else {
                c
            }
        })
        .collect();
    plain.parse().ok().filter(|value: &f64| value.is_finite())
}

/// A number with a unit after a thin space.
pub fn with_unit(value: f64, digits: usize, unit: &str) -> String {
    format!("{}{THIN}{unit}", number(value, digits))
}

/// A number in `digits` significant digits; very large and very small ones as a power of ten.
pub fn significant(value: f64, digits: usize) -> String {
    if value == 0.0 {
        return "0".into();
    }
    if !value.is_finite() {
        return "–".into();
    }
    let power = value.abs().log10().floor() as i32;
    if (-4..7).contains(&power) {
        number(value, (digits as i32 - 1 - power).clamp(0, 12) as usize)
    } else {
        format!("{}·10{}", number(value / 10f64.powi(power), digits - 1), superscript(power))
    }
}

/// As [`significant`], without trailing zeros: `0.01`, not `0.01000`.
pub fn trim_trailing_zeros(value: f64, digits: usize) -> String {
    let text = significant(value, digits);
    if text.contains('·') || !text.contains([',', '.']) {
        return text;
    }
    text.trim_end_matches('0').trim_end_matches([',', '.']).to_owned()
}

/// A count with a thin space between groups of three digits.
pub fn group_digits(value: u64) -> String {
    let digits = value.to_string();
    let mut text = String::with_capacity(digits.len() + digits.len() / 3);
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) && digits.len() > 4 {
            text.push(THIN);
        }
        text.push(digit);
    }
    text
}

fn superscript(power: i32) -> String {
    power
        .to_string()
        .chars()
        .map(|c| match c {
            '-' => '⁻',
            '1' => '¹',
            '2' => '²',
            '3' => '³',
            digit => digit.to_digit(10).and_then(|d| char::from_u32(0x2070 + d)).unwrap_or(digit),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn typed_numbers_are_read() {
        assert_eq!((parse_number("1,5"), parse_number(" −2.25 "), parse_number("1e3")), (Some(1.5), Some(-2.25), Some(1000.0)));
        assert_eq!((parse_number("x"), parse_number(""), parse_number("inf"), parse_number("1.2.3")), (None, None, None, None));
    }

    #[test]
    fn numbers_read_well() {
        assert_eq!(number(-1.25, 1), "−1.2");
        assert_eq!(number(-0.001, 2), "0.00");
        assert_eq!(number(f64::NAN, 2), "–");
        assert_eq!(with_unit(45.0, 0, "%"), "45\u{2009}%");
        assert_eq!(significant(1234.567, 6), "1234.57");
        assert_eq!(significant(-3.25e-13, 3), "−3.25·10⁻¹³");
        assert_eq!(significant(12_345_678.0, 3), "1.23·10⁷");
        assert_eq!(
            (trim_trailing_zeros(0.01, 4), trim_trailing_zeros(0.0254, 4), trim_trailing_zeros(1.0, 4)),
            ("0.01".into(), "0.0254".into(), "1".into())
        );
        assert_eq!(
            (trim_trailing_zeros(100.0, 2), trim_trailing_zeros(1e-9, 2), trim_trailing_zeros(0.0, 4)),
            ("100".into(), "1.0·10⁻⁹".into(), "0".into())
        );
        assert_eq!(
            (group_digits(999), group_digits(9999), group_digits(15_600), group_digits(1_234_567)),
            ("999".into(), "9999".into(), "15\u{2009}600".into(), "1\u{2009}234\u{2009}567".into())
        );
    }
}

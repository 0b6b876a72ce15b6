//! What an unquoted word of YAML means: the core schema.

/// What a word without quotes is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Scalar {
    /// Nothing, `~` or `null`.
    Null,
    /// `true` or `false`.
    Bool(bool),
    /// A number; whole ones beyond 2⁵³ are the nearest that there is.
    Number(f64),
    /// Anything else.
    Text,
}

impl Scalar {
    /// The meaning of `word`.
    pub fn of(word: &str) -> Self {
        match word {
            "" | "~" | "null" | "Null" | "NULL" => Self::Null,
            "true" | "True" | "TRUE" => Self::Bool(true),
            "false" | "False" | "FALSE" => Self::Bool(false),
            _ => number(word).map_or(Self::Text, Self::Number),
        }
    }
}

fn number(word: &str) -> Option<f64> {
    let unsigned = word.strip_prefix(['+', '-']).unwrap_or(word);
    if !unsigned.starts_with(|first: char| first.is_ascii_digit() || first == '.') {
        return None;
    }
    let sign = if word.starts_with('-') { -1.0 } else { 1.0 };
    match unsigned {
        ".inf" | ".Inf" | ".INF" => return Some(sign * f64::INFINITY),
        ".nan" | ".NaN" | ".NAN" if unsigned == word => return Some(f64::NAN),
        _ => {}
    }
    for (prefix, radix) in [("0x", 16), ("0o", 8), ("0b", 2)] {
        if let Some(digits) = unsigned.strip_prefix(prefix) {
            let value = (!digits.starts_with('+')).then(|| u64::from_str_radix(digits, radix).ok())?;
            return value.map(|value| sign * value as f64);
        }
    }
    // A zero in front makes a name of digits, such as a number of a part.
    let leading_zero = unsigned.len() > 1 && unsigned.starts_with('0') && unsigned.bytes().all(|byte| byte.is_ascii_digit());
    if leading_zero {
        return None;
    }
    word.parse::<f64>().ok().filter(|value| value.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_mean_what_the_core_schema_says() {
        let numbers = [("0", 0.0), ("-12", -12.0), ("+1.5e3", 1500.0), (".5", 0.5), ("5.", 5.0), ("0x1F", 31.0), ("-0b11", -3.0)];
        for (word, value) in numbers {
            assert_eq!(Scalar::of(word), Scalar::Number(value), "{word}");
        }
        assert_eq!(Scalar::of("-.inf"), Scalar::Number(f64::NEG_INFINITY));
        assert!(matches!(Scalar::of(".nan"), Scalar::Number(value) if value.is_nan()));
        for word in ["007", "1e999", "inf", "nan", "infinity", "1_000", "0x", "0x+1", "--1", "1,5", "yes", "e5", "-", ".", "12 "] {
            assert_eq!(Scalar::of(word), Scalar::Text, "{word}");
        }
        assert_eq!((Scalar::of("~"), Scalar::of("True")), (Scalar::Null, Scalar::Bool(true)));
    }
}

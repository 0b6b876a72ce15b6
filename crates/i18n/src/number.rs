//! Numbers as a person reads them. Files and JSON always keep the point.

use super::{Language, language};

/// `value` with `digits` decimals and the decimal mark of the present language.
pub fn decimal(value: f64, digits: usize) -> String {
    let text = format!("{value:.digits$}");
    // What rounds to zero has no sign.
    let unsigned = text.strip_prefix('-').filter(|rest| rest.bytes().all(|byte| matches!(byte, b'0' | b'.')));
    localise_decimal_mark(unsigned.unwrap_or(&text))
}

/// Replaces the decimal point of a formatted number by the present language's mark.
pub fn localise_decimal_mark(text: &str) -> String {
    match language() {
        Language::English => text.to_owned(),
        Language::Russian => text.replace('.', ","),
    }
}

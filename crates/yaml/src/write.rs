//! Values as YAML that [`super::read`] understands.

use std::fmt::Write as _;

use serde::Serialize;

use super::{YamlError, YamlErrorKind};
use sinew_scene::visible::{is_unsafe, json as visible_json};

/// A value as YAML with a line end.
///
/// The block style of `serde_yaml`, which leaves some letters as they are that end lines for others, such as U+2028, and those that turn the reading
/// order. A value with such a letter is written as JSON, which is YAML too and can escape them.
///
/// # Errors
/// [`YamlError`] for what has no form in YAML, such as paths that are no Unicode.
pub fn to_text(value: &impl Serialize) -> Result<String, YamlError> {
    let text = serde_yaml::to_string(value).map_err(|error| foreign(error.to_string()))?;
    if !text.chars().any(|letter| is_unsafe(letter) && letter != '\n') {
        return Ok(text);
    }
    let text = serde_json::to_string_pretty(value).map_err(|error| foreign(error.to_string()))?;
    Ok(visible_json(&text).into_owned() + "\n")
}

/// What a library of serialization says.
fn foreign(words: String) -> YamlError {
    YamlError::whole(YamlErrorKind::Foreign(words))
}

/// Text in double quotes, with everything escaped that YAML does not take as it is, or that would act on the terminal or editor that shows the file.
pub fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for letter in text.chars() {
        match letter {
            '"' | '\\' => out.extend(['\\', letter]),
            '\n' => out.push_str("\\n"),
            '\t' => out.push_str("\\t"),
            ' '..='~' => out.push(letter),
            '\u{a0}'..='\u{d7ff}' | '\u{e000}'..='\u{fffd}' if !is_unsafe(letter) => out.push(letter),
            other => {
                // Writing to a string cannot fail.
                let _ = write!(out, "\\U{:08X}", u32::from(other));
            }
        }
    }
    out.push('"');
    out
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use proptest::prelude::*;

    use super::*;
    use crate::from_text;

    #[test]
    fn words_that_other_readers_take_for_values_stay_texts() {
        let words =
            ["arm", "12", "yes", "null", "~", "1e5", ".5", "0x1F", "0o7", ".nan", "a: b", "", " ", "- a", "#", "&a", "*a", "<<", "NaN"];
        let value: BTreeMap<String, Vec<String>> =
            words.iter().map(|word| ((*word).to_owned(), words.map(str::to_owned).to_vec())).collect();
        assert_eq!(from_text::<BTreeMap<String, Vec<String>>>(&to_text(&value).unwrap(), 1 << 20).unwrap(), value);
    }

    proptest! {
        #[test]
        fn any_text_reads_back(texts in proptest::collection::vec(any::<String>(), 0..6), keys in proptest::collection::vec(any::<String>(), 0..4)) {
            let value: BTreeMap<String, Vec<String>> = keys.into_iter().map(|key| (key, texts.clone())).collect();
            let text = to_text(&value).unwrap();
            prop_assert!(!text.chars().any(|letter| is_unsafe(letter) && letter != '\n'), "{text:?}");
            prop_assert_eq!(from_text::<BTreeMap<String, Vec<String>>>(&text, 1 << 20).unwrap(), value);
        }

        #[test]
        fn any_number_reads_back(bits: u64, small: u32) {
            let (value, single) = (f64::from_bits(bits), f32::from_bits(small));
            let (back, back_single): (f64, f32) = from_text(&to_text(&(value, single)).unwrap(), 1000).unwrap();
            prop_assert!(back == value || (back.is_nan() && value.is_nan()));
            prop_assert!(back_single == single || (back_single.is_nan() && single.is_nan()));
        }
    }
}

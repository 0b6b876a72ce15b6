//! Makes text of files safe to show: removes control characters, terminal escapes and changes of the reading order.

use std::borrow::Cow;
use std::fmt::Write;

/// Whether a letter does something instead of being one: control characters (C0, DEL, C1), those that end lines, and those that turn the direction of
/// what follows. Letters that are written from right to left and the joiners between them are none of these.
pub fn is_unsafe(letter: char) -> bool {
    letter.is_control()
        || matches!(letter, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}' | '\u{feff}' | '\u{fff9}'..='\u{fffb}')
}

/// The text on one line: blanks for what breaks a line or stands for one, and a sign for each other letter that is not shown as it is.
pub fn shown(text: &str) -> Cow<'_, str> {
    clean(text, |_| false)
}

/// The same for text of several lines, whose ends and tabs stay.
pub fn shown_lines(text: &str) -> Cow<'_, str> {
    clean(text, |letter| matches!(letter, '\n' | '\t'))
}

fn clean(text: &str, stays: impl Fn(char) -> bool) -> Cow<'_, str> {
    let bad = |letter: char| is_unsafe(letter) && !stays(letter);
    // Most text has none, and is not copied.
    if !text.chars().any(bad) {
        return Cow::Borrowed(text);
    }
    let instead = |letter: char| match letter {
        letter if !bad(letter) => letter,
        '\t'..='\r' | '\u{85}' | '\u{2028}' | '\u{2029}' => ' ',
        _ => '\u{fffd}',
    };
    Cow::Owned(text.chars().map(instead).collect())
}

/// JSON whose strings say the same with nothing in them that a terminal would obey; only strings can hold such letters.
pub fn json(text: &str) -> Cow<'_, str> {
    let bad = |letter: char| is_unsafe(letter) && letter != '\n';
    if !text.chars().any(bad) {
        return Cow::Borrowed(text);
    }
    let mut out = String::with_capacity(text.len() + 64);
    for letter in text.chars() {
        if bad(letter) {
            // None of them lies beyond 16 bits. Writing to a string cannot fail.
            let _ = write!(out, "\\u{:04x}", u32::from(letter));
        } else {
            out.push(letter);
        }
    }
    Cow::Owned(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_that_acts_is_left_and_letters_stay() {
        assert_eq!(shown("a\u{1b}[31m\u{7}\n\u{85}\u{202e}b\u{9b}\u{7f}\u{2028}c"), "a\u{fffd}[31m\u{fffd}  \u{fffd}b\u{fffd}\u{fffd} c");
        assert_eq!(shown_lines("a\nb\tc\r\n"), "a\nb\tc \n");
        // Arabic with a joiner, Hebrew, an emoji of several, combined letters.
        for text in ["عضلة\u{200c}ها", "שריר", "👩\u{200d}🔬", "e\u{301}", "Двуглавая", ""] {
            assert!(matches!(shown(text), Cow::Borrowed(same) if same == text));
        }
        for code in 0..=0x10ffff_u32 {
            let Some(letter) = char::from_u32(code) else { continue };
            let text = letter.to_string();
            assert!(!shown(&text).chars().any(is_unsafe) && !json(&text).chars().any(|letter| is_unsafe(letter) && letter != '\n'));
        }
    }

    #[test]
    fn json_keeps_the_value() {
        let value = serde_json::json!({"name": "a\u{1b}\u{9b}\u{202e}\u{2028}\u{7f}b", "\u{85}": [1]});
        let text = serde_json::to_string_pretty(&value).unwrap();
        let safe = json(&text);
        assert!(!safe.chars().any(|letter| is_unsafe(letter) && letter != '\n'));
        assert_eq!(serde_json::from_str::<serde_json::Value>(&safe).unwrap(), value);
    }
}

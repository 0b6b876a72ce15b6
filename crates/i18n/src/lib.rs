//! The translation catalogue: English and Russian, in `resources/locales/<language>/*.ftl` (Project Fluent).
//!
//! Everything a person reads goes through [`tr!`](crate::tr). A message that a catalogue lacks falls back to English, then to its own
//! name, so a slip is seen but never stops the program; a test holds the two catalogues and the sources against each other.

mod catalogue;
mod labels;
mod number;
pub mod quantity;
mod sentence;

pub use catalogue::{Language, language, message, set_language};
/// The value type of a message argument.
pub use fluent_bundle::FluentValue;
pub use labels::label;
pub use number::{decimal, localise_decimal_mark};
pub use sentence::{Sentence, finding, finding_line, sentence, source_name};
pub use sinew_scene::visible::{is_unsafe, json as visible_json, shown, shown_lines};

/// Looks a message up in the catalogue: `tr!("open-failed", file = name, line = 3)`.
///
/// Arguments are strings or numbers; numbers choose plural forms. Strings often come from a file: in the message they are [`shown`].
#[macro_export]
macro_rules! tr {
    ($key:expr) => { $crate::message($key, &[]) };
    ($key:expr, $($name:ident = $value:expr),+ $(,)?) => {
        $crate::message($key, &[$((stringify!($name), $crate::FluentValue::from($value))),+])
    };
}

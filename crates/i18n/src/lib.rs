//! The translation catalogue: English and Russian, in `locales/<language>/*.ftl` (Project Fluent).
//!
//! # How something comes to be said
//!
//! Libraries report enums. [`ToMessage`](sinew_scene::message::ToMessage) gives their key and parameters, [`Sentence::sentence`] looks the key up in the
//! language of the process, and numbers choose plural forms:
//!
//! ```
//! use sinew_i18n::{Language, Sentence, set_language};
//! use sinew_scene::message;
//!
//! set_language(Language::English);
//! assert_eq!(message!("io-full").sentence(), "the disk is full");
//! ```
//!
//! The program itself says things with [`tr!`](crate::tr). A message that a catalogue lacks falls back to English, then to its own name, so a slip is seen
//! but never stops the program; a test holds the two catalogues and the sources against each other.
//!
//! What comes from a file may hold anything: [`shown`] makes characters visible that would act on a terminal, and [`tr!`](crate::tr) does that by itself.

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

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

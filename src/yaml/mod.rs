//! The one reader of YAML, and the writer that it understands: muscle files, sessions, settings and what is kept for recovery all come through [`read`].
//!
//! It follows the parser event by event and stops at the first one that is too much, so that neither brackets, nor indentation, nor aliases of any
//! shape make it slow or large: time and memory grow with the text, up to the bounds of [`crate::limits`]. Aliases share what they stand for; values,
//! text and depth are counted as if it stood there each time, since that is what whoever walks the tree will meet.
//!
//! The tree knows where each value stands. [`from_text`] makes any type of it that `serde` can make, [`Node`] is for whoever looks at values by hand.

mod de;
mod reasons;
mod scalar;
mod tree;
mod write;

pub use scalar::Scalar;
pub use tree::{Node, Place, Value, read};
pub use write::{quoted, to_text};

use crate::message::{Message, ToMessage};
use crate::tr;

/// Why a text cannot be used, and where.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{}", self.message())]
pub struct YamlError {
    /// Where; `None` for the text as a whole.
    pub place: Option<Place>,
    /// What is wrong.
    pub kind: YamlErrorKind,
}

/// What is wrong with a YAML text.
#[derive(Debug, Clone, PartialEq)]
pub enum YamlErrorKind {
    /// In words.
    Words(String),
}

impl YamlError {
    fn at(place: Option<Place>, message: String) -> Self {
        Self { place, kind: YamlErrorKind::Words(message) }
    }
}

impl ToMessage for YamlError {
    fn message(&self) -> Message {
        self.kind.message()
    }
}

impl ToMessage for YamlErrorKind {
    fn message(&self) -> Message {
        match self {
            Self::Words(words) => Message::verbatim(words),
        }
    }
}

/// Makes a value of a text of at most `bytes` bytes. An empty text is an empty mapping.
///
/// # Errors
/// [`YamlError`].
pub fn from_text<T: serde::de::DeserializeOwned>(text: &str, bytes: u64) -> Result<T, YamlError> {
    T::deserialize(&read(text, bytes)?)
}

/// A text that is larger than `bytes`.
fn too_large(bytes: u64) -> YamlError {
    YamlError::at(None, tr!("document-too-large", limit = bytes >> 20))
}

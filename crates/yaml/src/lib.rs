//! The one reader of YAML, and the writer that it understands: muscle files, sessions, settings and what is kept for recovery all come through [`read`].
//!
//! It follows the parser event by event and stops at the first one that is too much, so that neither brackets, nor indentation, nor aliases of any
//! shape make it slow or large: time and memory grow with the text, up to the bounds of [`sinew_scene::limits`]. Aliases share what they stand for; values,
//! text and depth are counted as if it stood there each time, since a walk of the tree meets it so often.
//!
//! The tree knows where each value stands. [`from_text`] makes any type of it that `serde` can make, [`Node`] is for code that looks at single values.

mod de;
mod error;
mod reasons;
mod scalar;
mod tree;
mod write;

pub use error::{SyntaxReason, ValueKind, YamlError, YamlErrorKind};
pub use scalar::Scalar;
pub use tree::{Node, Place, Value, read};
pub use write::{quoted, to_text};

/// Makes a value of a text of at most `bytes` bytes. An empty text is an empty mapping.
///
/// # Errors
/// [`YamlError`].
pub fn from_text<T: serde::de::DeserializeOwned>(text: &str, bytes: u64) -> Result<T, YamlError> {
    T::deserialize(&read(text, bytes)?)
}

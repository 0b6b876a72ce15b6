//! A YAML reader with bounds on time and memory that knows where each value stands, and a writer that it understands.
//!
//! # How a text is read
//!
//! [`read`] follows the parser event by event and stops at the first one that is too much, so that neither brackets, nor indentation, nor aliases of any
//! shape make it slow or large: time and memory grow with the text, up to the bounds of [`sinew_scene::limits`]. Aliases share what they stand for; values,
//! text and depth are counted as if it stood there each time, since a walk of the tree meets it so often.
//!
//! The tree knows where each value stands. [`from_text`] makes any type of it that `serde` can make, and an error about a value has its place; [`Node`] is for
//! code that looks at single values:
//!
//! ```
//! use sinew_yaml::{Value, read};
//!
//! let tree = read("arm:\n  length: 230.0", 1024)?;
//! let Value::Map(pairs) = &tree.value else { panic!("a mapping stands there") };
//! assert_eq!((pairs.len(), pairs[0].1.place.line), (1, 2));
//! # Ok::<(), sinew_yaml::YamlError>(())
//! ```
//!
//! # Why not another reader
//!
//! A reader that makes a tree of the whole text first has spent the memory before anybody can refuse it; one that makes types directly has lost the places by
//! the time a value turns out not to fit.

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
/// ```
/// let radii: Vec<f64> = sinew_yaml::from_text("[5, 18, 5]", 1024)?;
/// assert_eq!(radii, [5.0, 18.0, 5.0]);
/// # Ok::<(), sinew_yaml::YamlError>(())
/// ```
///
/// # Errors
/// [`YamlError`].
pub fn from_text<T: serde::de::DeserializeOwned>(text: &str, bytes: u64) -> Result<T, YamlError> {
    T::deserialize(&read(text, bytes)?)
}

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

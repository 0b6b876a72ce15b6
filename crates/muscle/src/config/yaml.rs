//! A muscle file's YAML as plain values, and the way back from a place in the tree to a line and column of the text.
//!
//! The tree is decoded by hand ([`super::decode`]), so that each complaint can be worded for the value it speaks of.

use super::ConfigError;
use sinew_scene::limits;
use sinew_yaml::{Node, Scalar, Value};

/// A value of the file.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Yaml {
    /// Nothing, `~` or `null`.
    Null,
    /// `true` or `false`.
    Bool,
    /// A number.
    Number(f64),
    /// Text.
    Text(String),
    /// A list.
    List(Vec<Yaml>),
    /// Keys and values in the order of the file. A key that is not text is `None`.
    Map(Vec<(Option<String>, Yaml)>),
    /// A value with a `!tag`.
    Tagged,
}

/// A step down the tree.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Step {
    /// The value of entry `n` of a mapping.
    Value(usize),
    /// The key of entry `n` of a mapping; always last.
    Key(usize),
    /// Item `n` of a list.
    Item(usize),
}

/// Reads the one document of `text`.
pub(super) fn read(text: &str) -> Result<Yaml, ConfigError> {
    Ok(plain(&sinew_yaml::read(text, limits::YAML_BYTES)?))
}

fn plain(node: &Node) -> Yaml {
    match &node.value {
        Value::Plain(word) => match Scalar::of(word) {
            Scalar::Null => Yaml::Null,
            Scalar::Bool(_) => Yaml::Bool,
            Scalar::Number(number) => Yaml::Number(number),
            Scalar::Text => Yaml::Text(word.to_string()),
        },
        Value::Text(text) => Yaml::Text(text.to_string()),
        Value::List(items) => Yaml::List(items.iter().map(plain).collect()),
        Value::Map(entries) => {
            let entry = |(key, value): &(Node, Node)| match plain(key) {
                Yaml::Text(key) => (Some(key), plain(value)),
                _ => (None, plain(value)),
            };
            Yaml::Map(entries.iter().map(entry).collect())
        }
        Value::Tagged => Yaml::Tagged,
    }
}

/// Line and column, both from 1, of the value or key at `path`.
pub(super) fn locate(text: &str, path: &[Step]) -> Option<(usize, usize)> {
    let mut node = sinew_yaml::read(text, limits::YAML_BYTES).ok()?;
    for step in path {
        node = match (&node.value, *step) {
            (Value::List(items), Step::Item(index)) => items.get(index)?.clone(),
            (Value::Map(entries), Step::Value(index)) => entries.get(index)?.1.clone(),
            (Value::Map(entries), Step::Key(index)) => entries.get(index)?.0.clone(),
            _ => return None,
        };
    }
    Some((node.place.line as usize, node.place.column as usize))
}

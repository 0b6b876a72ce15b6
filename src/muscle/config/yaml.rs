//! YAML as a plain tree, and the way back from a place in the tree to a line and column of the text.
//!
//! The tree is decoded by hand ([`super::decode`]), so that each complaint can be worded for the value it speaks of. The parser knows positions
//! only while it reads; so a complaint carries a path, and [`locate`] reads the text once more and stops at that path.

use std::cell::Cell;
use std::fmt;

use serde::de::{DeserializeSeed, Deserializer, EnumAccess, Error, IgnoredAny, MapAccess, SeqAccess, VariantAccess, Visitor};

use super::ConfigError;
use crate::tr;

/// Most values of one file, aliases counted as often as they are used.
const VALUES: usize = 1_000_000;

/// Deepest nesting.
const DEPTH: usize = 100;

/// Where brackets, or list marks on one line, nest deeper than [`DEPTH`]: the parser's time grows with the square of the depth, so it must not see
/// such a text. Brackets in quotes and comments count too; no real file has so many unclosed ones.
fn too_deep(text: &str) -> Option<(usize, usize)> {
    let mut open = 0_usize;
    for (line, content) in text.lines().enumerate() {
        let mut marks = 0_usize;
        for (column, byte) in content.bytes().enumerate() {
            match byte {
                b'[' | b'{' => open += 1,
                b']' | b'}' => open = open.saturating_sub(1),
                b'-' | b'?' | b':' if open == 0 => {
                    marks += usize::from(matches!(content.as_bytes().get(column + 1), None | Some(b' ' | b'\t')))
                }
                _ => {}
            }
            if open > DEPTH || marks > DEPTH {
                return Some((line + 1, column + 1));
            }
        }
    }
    None
}

/// A value of the file.
#[derive(Debug, Clone, PartialEq)]
pub enum Yaml {
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
pub enum Step {
    /// The value of entry `n` of a mapping.
    Value(usize),
    /// The key of entry `n` of a mapping; always last.
    Key(usize),
    /// Item `n` of a list.
    Item(usize),
}

/// Reads the one document of `text`.
pub fn read(text: &str) -> Result<Yaml, ConfigError> {
    if let Some(place) = too_deep(text) {
        return Err(ConfigError::at(Some(place), tr!("muscle-yaml-too-deep", limit = DEPTH)));
    }
    let budget = Cell::new(VALUES);
    let mut found = None;
    for (index, document) in serde_yaml::Deserializer::from_str(text).enumerate() {
        if index > 0 {
            let place = serde_yaml::Deserializer::from_str(text).nth(1).and_then(|document| stop_in(document, &[]));
            return Err(ConfigError::at(place, tr!("muscle-yaml-several-documents")));
        }
        found = Some(TreeSeed(&budget).deserialize(document).map_err(|error| broken(&error, budget.get() == 0))?);
    }
    Ok(found.unwrap_or(Yaml::Null))
}

fn broken(error: &serde_yaml::Error, too_many: bool) -> ConfigError {
    let place = error.location().map(|location| (location.line(), location.column()));
    if too_many {
        return ConfigError::at(place, tr!("muscle-yaml-too-many-values", limit = VALUES));
    }
    // The parser ends its sentence with the place, which the error carries already.
    let text = error.to_string();
    let reason = text.split(" at line ").next().unwrap_or(&text);
    let known = REASONS.iter().find(|(theirs, _)| *theirs == reason);
    ConfigError::at(place, tr!("muscle-yaml-syntax", reason = known.map_or_else(|| reason.to_owned(), |(_, key)| tr!(key))))
}

/// What the parser says of the slips that hands make, and the key of how a person would say it.
const REASONS: [(&str, &str); 11] = [
    ("mapping values are not allowed in this context", "muscle-yaml-reason-colon"),
    ("could not find expected ':'", "muscle-yaml-reason-no-colon"),
    ("did not find expected key", "muscle-yaml-reason-key"),
    ("did not find expected ',' or ']'", "muscle-yaml-reason-list"),
    ("did not find expected ',' or '}'", "muscle-yaml-reason-map"),
    ("did not find expected '-' indicator", "muscle-yaml-reason-dash"),
    ("block sequence entries are not allowed in this context", "muscle-yaml-reason-dash-here"),
    ("found character that cannot start any token", "muscle-yaml-reason-character"),
    ("found unexpected end of stream", "muscle-yaml-reason-end"),
    ("control characters are not allowed", "muscle-yaml-reason-control"),
    ("did not find expected node content", "muscle-yaml-reason-content"),
];

/// Line and column, both from 1, of the value or key at `path` in the first document.
pub fn locate(text: &str, path: &[Step]) -> Option<(usize, usize)> {
    serde_yaml::Deserializer::from_str(text).next().and_then(|document| stop_in(document, path))
}

fn stop_in<'de, D: Deserializer<'de, Error = serde_yaml::Error>>(document: D, path: &[Step]) -> Option<(usize, usize)> {
    let error = StopSeed(path).deserialize(document).err()?;
    error.location().map(|location| (location.line(), location.column()))
}

#[derive(Clone, Copy)]
struct TreeSeed<'a>(&'a Cell<usize>);

impl<'de> DeserializeSeed<'de> for TreeSeed<'_> {
    type Value = Yaml;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Yaml, D::Error> {
        let Some(left) = self.0.get().checked_sub(1).filter(|left| *left > 0) else {
            self.0.set(0);
            return Err(D::Error::custom("too many values"));
        };
        self.0.set(left);
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for TreeSeed<'_> {
    type Value = Yaml;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a value")
    }

    fn visit_unit<E>(self) -> Result<Yaml, E> {
        Ok(Yaml::Null)
    }

    /// An empty document.
    fn visit_none<E>(self) -> Result<Yaml, E> {
        Ok(Yaml::Null)
    }

    fn visit_bool<E>(self, _: bool) -> Result<Yaml, E> {
        Ok(Yaml::Bool)
    }

    fn visit_i64<E>(self, value: i64) -> Result<Yaml, E> {
        Ok(Yaml::Number(value as f64))
    }

    fn visit_u64<E>(self, value: u64) -> Result<Yaml, E> {
        Ok(Yaml::Number(value as f64))
    }

    fn visit_i128<E>(self, value: i128) -> Result<Yaml, E> {
        Ok(Yaml::Number(value as f64))
    }

    fn visit_u128<E>(self, value: u128) -> Result<Yaml, E> {
        Ok(Yaml::Number(value as f64))
    }

    fn visit_f64<E>(self, value: f64) -> Result<Yaml, E> {
        Ok(Yaml::Number(value))
    }

    fn visit_str<E>(self, value: &str) -> Result<Yaml, E> {
        Ok(Yaml::Text(value.to_owned()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Yaml, A::Error> {
        let mut list = Vec::new();
        while let Some(item) = items.next_element_seed(self)? {
            list.push(item);
        }
        Ok(Yaml::List(list))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<Yaml, A::Error> {
        let mut map = Vec::new();
        while let Some(key) = entries.next_key_seed(self)? {
            let key = match key {
                Yaml::Text(key) => Some(key),
                _ => None,
            };
            map.push((key, entries.next_value_seed(self)?));
        }
        Ok(Yaml::Map(map))
    }

    fn visit_enum<A: EnumAccess<'de>>(self, data: A) -> Result<Yaml, A::Error> {
        let (_, variant) = data.variant::<IgnoredAny>()?;
        variant.newtype_variant_seed(self)?;
        Ok(Yaml::Tagged)
    }
}

/// Goes down a path and fails on purpose where it ends, since a failure is given its place.
struct StopSeed<'a>(&'a [Step]);

impl<'de> DeserializeSeed<'de> for StopSeed<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl StopSeed<'_> {
    fn here<E: Error>(&self) -> Result<(), E> {
        Err(E::custom("here"))
    }
}

impl<'de> Visitor<'de> for StopSeed<'_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a value")
    }

    fn visit_unit<E: Error>(self) -> Result<(), E> {
        self.here()
    }

    fn visit_none<E: Error>(self) -> Result<(), E> {
        self.here()
    }

    fn visit_bool<E: Error>(self, _: bool) -> Result<(), E> {
        self.here()
    }

    fn visit_i64<E: Error>(self, _: i64) -> Result<(), E> {
        self.here()
    }

    fn visit_u64<E: Error>(self, _: u64) -> Result<(), E> {
        self.here()
    }

    fn visit_f64<E: Error>(self, _: f64) -> Result<(), E> {
        self.here()
    }

    fn visit_str<E: Error>(self, _: &str) -> Result<(), E> {
        self.here()
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<(), A::Error> {
        let Some((Step::Item(index), rest)) = self.0.split_first() else { return self.here() };
        for _ in 0..*index {
            items.next_element::<IgnoredAny>()?;
        }
        items.next_element_seed(StopSeed(rest))?;
        Ok(())
    }

    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<(), A::Error> {
        let Some((step, rest)) = self.0.split_first() else { return self.here() };
        let (Step::Value(index) | Step::Key(index)) = *step else { return self.here() };
        for _ in 0..index {
            entries.next_entry::<IgnoredAny, IgnoredAny>()?;
        }
        if matches!(step, Step::Key(_)) {
            entries.next_key_seed(StopSeed(&[]))?;
        } else {
            entries.next_key::<IgnoredAny>()?;
            entries.next_value_seed(StopSeed(rest))?;
        }
        Ok(())
    }

    fn visit_enum<A: EnumAccess<'de>>(self, _: A) -> Result<(), A::Error> {
        self.here()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_of_the_hand_are_told_in_the_users_language() {
        for (text, key) in [
            ("a: b: c", "muscle-yaml-reason-colon"),
            ("a: 1\nb\nc: 2", "muscle-yaml-reason-no-colon"),
            ("a: 1\n b: 2\n  - c", "muscle-yaml-reason-colon"),
            ("a:\n  - 1\n  b: 2", "muscle-yaml-reason-dash"),
            ("a: [1, 2\nb: 3", "muscle-yaml-reason-list"),
            ("a: {b: 1\nc: [", "muscle-yaml-reason-map"),
            ("a: - 1", "muscle-yaml-reason-dash-here"),
            ("a:\n\t- 1", "muscle-yaml-reason-character"),
            ("a: \"b", "muscle-yaml-reason-end"),
            ("a: 1\n- c", "muscle-yaml-reason-key"),
            ("a: [", "muscle-yaml-reason-content"),
        ] {
            let error = read(text).expect_err(text);
            assert!(error.to_string().contains(&tr!(key)), "{text:?}: {error}");
        }
    }
}

//! From the tree to any type that `serde` makes, with the place and the key of whatever does not fit.

use std::fmt::Display;

use serde::de::value::StrDeserializer;
use serde::de::{self, DeserializeSeed, Deserializer, Expected, IntoDeserializer, MapAccess, SeqAccess, Unexpected, Visitor};
use serde::forward_to_deserialize_any;

use super::{Node, Scalar, Value, ValueKind, YamlError, YamlErrorKind};
use sinew_scene::message::shortened;

/// Largest whole number below which every one is exact.
const EXACT: f64 = 9_007_199_254_740_992.0;

impl de::Error for YamlError {
    fn custom<T: Display>(message: T) -> Self {
        Self::whole(YamlErrorKind::Foreign(message.to_string()))
    }

    fn invalid_type(found: Unexpected<'_>, _: &dyn Expected) -> Self {
        Self::whole(YamlErrorKind::Unfitting(kind_of(found)))
    }

    fn invalid_value(found: Unexpected<'_>, _: &dyn Expected) -> Self {
        Self::whole(YamlErrorKind::Unfitting(kind_of(found)))
    }

    fn invalid_length(count: usize, _: &dyn Expected) -> Self {
        Self::whole(YamlErrorKind::WrongCount(count))
    }

    fn unknown_variant(variant: &str, known: &'static [&'static str]) -> Self {
        Self::whole(YamlErrorKind::UnknownWord { word: shortened(variant), known })
    }

    fn missing_field(field: &'static str) -> Self {
        Self::whole(YamlErrorKind::MissingKey(field))
    }

    fn duplicate_field(field: &'static str) -> Self {
        Self::whole(YamlErrorKind::RepeatedKey(field))
    }
}

/// What `serde` found, as errors call it.
fn kind_of(found: Unexpected<'_>) -> ValueKind {
    match found {
        Unexpected::Bool(_) => ValueKind::Bool,
        Unexpected::Unsigned(_) | Unexpected::Signed(_) | Unexpected::Float(_) => ValueKind::Number,
        Unexpected::Char(_) | Unexpected::Str(_) | Unexpected::Bytes(_) => ValueKind::Text,
        Unexpected::Unit | Unexpected::Option => ValueKind::Null,
        Unexpected::Seq => ValueKind::List,
        Unexpected::Map | Unexpected::StructVariant => ValueKind::Map,
        _ => ValueKind::Tagged,
    }
}

impl Node {
    /// An error without a place is about this value.
    fn place<T>(&self, result: Result<T, YamlError>) -> Result<T, YamlError> {
        result.map_err(|error| YamlError { place: error.place.or(Some(self.place)), ..error })
    }

    fn visit<'de, V: Visitor<'de>>(&self, visitor: V) -> Result<V::Value, YamlError> {
        match &self.value {
            Value::Plain(word) => match Scalar::of(word) {
                Scalar::Null => visitor.visit_unit(),
                Scalar::Bool(value) => visitor.visit_bool(value),
                Scalar::Number(value) if value.fract() == 0.0 && value.abs() < EXACT => {
                    if value < 0.0 {
                        visitor.visit_i64(value as i64)
                    } else {
                        visitor.visit_u64(value as u64)
                    }
                }
                Scalar::Number(value) => visitor.visit_f64(value),
                Scalar::Text => visitor.visit_str(word),
            },
            Value::Text(text) => visitor.visit_str(text),
            Value::List(items) => {
                let mut list = Items { items: items.iter() };
                let made = visitor.visit_seq(&mut list)?;
                if list.items.len() == 0 { Ok(made) } else { Err(de::Error::invalid_length(items.len(), &"fewer")) }
            }
            Value::Map(entries) => visitor.visit_map(Entries { entries: entries.iter(), value: None }),
            Value::Tagged => Err(de::Error::invalid_type(Unexpected::Other("tag"), &visitor)),
        }
    }
}

impl<'de> Deserializer<'de> for &Node {
    type Error = YamlError;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, YamlError> {
        self.place(self.visit(visitor))
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, YamlError> {
        if self.is_null() { visitor.visit_none() } else { visitor.visit_some(self) }
    }

    /// A word that looks like a number is as good a name as any.
    fn deserialize_str<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, YamlError> {
        match &self.value {
            Value::Plain(word) if Scalar::of(word) != Scalar::Null => self.place(visitor.visit_str(word)),
            _ => self.deserialize_any(visitor),
        }
    }

    fn deserialize_string<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, YamlError> {
        self.deserialize_str(visitor)
    }

    fn deserialize_identifier<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, YamlError> {
        self.deserialize_str(visitor)
    }

    fn deserialize_enum<V: Visitor<'de>>(self, _: &'static str, _: &'static [&'static str], visitor: V) -> Result<V::Value, YamlError> {
        match &self.value {
            Value::Plain(word) | Value::Text(word) => {
                let word: StrDeserializer<'_, YamlError> = (**word).into_deserializer();
                self.place(visitor.visit_enum(word))
            }
            _ => self.deserialize_any(visitor),
        }
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(self, _: &'static str, visitor: V) -> Result<V::Value, YamlError> {
        visitor.visit_newtype_struct(self)
    }

    /// Nothing below is looked at: what nobody knows costs nothing.
    fn deserialize_ignored_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, YamlError> {
        visitor.visit_unit()
    }

    /// Of an empty text every key is left out. Values without keys are none of a struct.
    fn deserialize_struct<V: Visitor<'de>>(self, _: &'static str, _: &'static [&'static str], visitor: V) -> Result<V::Value, YamlError> {
        self.place(match &self.value {
            _ if self.is_null() => visitor.visit_map(Entries { entries: [].iter(), value: None }),
            Value::List(_) => Err(de::Error::invalid_type(Unexpected::Seq, &visitor)),
            _ => self.visit(visitor),
        })
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char bytes byte_buf unit unit_struct seq tuple tuple_struct map
    }
}

struct Items<'a> {
    items: std::slice::Iter<'a, Node>,
}

impl<'de> SeqAccess<'de> for Items<'_> {
    type Error = YamlError;

    fn next_element_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<Option<T::Value>, YamlError> {
        self.items.next().map(|item| seed.deserialize(item)).transpose()
    }

    fn size_hint(&self) -> Option<usize> {
        Some(self.items.len())
    }
}

struct Entries<'a> {
    entries: std::slice::Iter<'a, (Node, Node)>,
    value: Option<&'a Node>,
}

impl<'de> MapAccess<'de> for Entries<'_> {
    type Error = YamlError;

    fn next_key_seed<K: DeserializeSeed<'de>>(&mut self, seed: K) -> Result<Option<K::Value>, YamlError> {
        let Some((key, value)) = self.entries.next() else { return Ok(None) };
        self.value = Some(value);
        seed.deserialize(key).map(Some)
    }

    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value, YamlError> {
        match self.value.take() {
            Some(value) => seed.deserialize(value),
            None => Err(de::Error::custom("a value without a key")),
        }
    }

    fn size_hint(&self) -> Option<usize> {
        Some(self.entries.len())
    }
}

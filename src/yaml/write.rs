//! Values as YAML, in the words that [`super::read`] understands: what is written reads back the same, whatever letters are in it.

use std::fmt::{Display, Write as _};

use serde::ser::{self, Impossible, Serialize, SerializeMap, SerializeSeq, SerializeStruct, Serializer};

use super::{Scalar, YamlError};
use crate::i18n::is_unsafe;

/// A value as YAML in block style, with a line end.
///
/// # Errors
/// [`YamlError`] for what has no form here: enums with values, bytes, keys that are no text, paths that are no Unicode.
pub fn to_text(value: &impl Serialize) -> Result<String, YamlError> {
    let mut text = String::new();
    match value.serialize(Builder)? {
        Written::Word(word) => text.push_str(&word),
        Written::List(items) if items.is_empty() => text.push_str("[]"),
        Written::Map(entries) if entries.is_empty() => text.push_str("{}"),
        Written::List(items) => list(&mut text, &items, 0),
        Written::Map(entries) => map(&mut text, &entries, 0),
    }
    if !text.ends_with('\n') {
        text.push('\n');
    }
    Ok(text)
}

/// Text in double quotes, with everything escaped that YAML does not take as it is, or that would act on whoever looks at the file.
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

/// Text without quotes where nobody could take it for anything else.
fn text(text: &str) -> String {
    // Other readers of YAML take these for true and false.
    const SWITCHES: [&str; 6] = ["y", "n", "yes", "no", "on", "off"];
    let first = text.chars().next().is_some_and(|first| first.is_alphanumeric() || matches!(first, '/' | '_' | '.'));
    let rest = text.chars().all(|letter| letter.is_alphanumeric() || matches!(letter, '/' | '_' | '.' | '-' | ' ' | '+'));
    let word = first && rest && text.chars().any(char::is_alphanumeric) && !text.ends_with(' ') && Scalar::of(text) == Scalar::Text;
    let switch = SWITCHES.iter().any(|switch| text.eq_ignore_ascii_case(switch));
    // Digits with signs among them may be a date or a time elsewhere.
    if word && !switch && !text.starts_with(|first: char| first.is_ascii_digit()) { text.to_owned() } else { quoted(text) }
}

fn list(into: &mut String, items: &[Written], indent: usize) {
    for item in items {
        let _ = write!(into, "{:indent$}-", "");
        put(into, item, indent + 2, true);
    }
}

fn map(into: &mut String, entries: &[(String, Written)], indent: usize) {
    for (key, value) in entries {
        let _ = write!(into, "{:indent$}{key}:", "");
        put(into, value, indent + 2, false);
    }
}

/// What follows a mark or a key. The first line of what stands below a mark may begin beside it.
fn put(into: &mut String, value: &Written, indent: usize, beside: bool) {
    let below = |into: &mut String, inner: String| {
        if beside {
            into.push(' ');
            into.push_str(inner.trim_start_matches(' '));
        } else {
            into.push('\n');
            into.push_str(&inner);
        }
    };
    let mut inner = String::new();
    match value {
        Written::Word(word) => {
            let _ = writeln!(into, " {word}");
        }
        Written::List(items) if items.is_empty() => into.push_str(" []\n"),
        Written::Map(entries) if entries.is_empty() => into.push_str(" {}\n"),
        Written::List(items) => {
            list(&mut inner, items, indent);
            below(into, inner);
        }
        Written::Map(entries) => {
            map(&mut inner, entries, indent);
            below(into, inner);
        }
    }
}

/// A value on its way to text.
enum Written {
    Word(String),
    List(Vec<Self>),
    Map(Vec<(String, Self)>),
}

impl ser::Error for YamlError {
    fn custom<T: Display>(message: T) -> Self {
        Self::at(None, message.to_string())
    }
}

fn float(value: impl std::fmt::Debug, number: f64) -> Written {
    let word = if number.is_nan() {
        ".nan".to_owned()
    } else if number.is_infinite() {
        if number > 0.0 { ".inf".to_owned() } else { "-.inf".to_owned() }
    } else {
        format!("{value:?}")
    };
    Written::Word(word)
}

fn nowhere<T>(what: &str) -> Result<T, YamlError> {
    Err(ser::Error::custom(format_args!("{what} has no form in YAML here")))
}

struct Builder;

macro_rules! words {
    ($($name:ident: $kind:ty),*) => {
        $(fn $name(self, value: $kind) -> Result<Written, YamlError> {
            Ok(Written::Word(value.to_string()))
        })*
    };
}

impl Serializer for Builder {
    type Ok = Written;
    type Error = YamlError;
    type SerializeSeq = Items;
    type SerializeTuple = Items;
    type SerializeTupleStruct = Items;
    type SerializeTupleVariant = Impossible<Written, YamlError>;
    type SerializeMap = Entries;
    type SerializeStruct = Entries;
    type SerializeStructVariant = Impossible<Written, YamlError>;

    words!(serialize_bool: bool, serialize_i8: i8, serialize_i16: i16, serialize_i32: i32, serialize_i64: i64);
    words!(serialize_u8: u8, serialize_u16: u16, serialize_u32: u32, serialize_u64: u64);

    fn serialize_f32(self, value: f32) -> Result<Written, YamlError> {
        Ok(float(value, value.into()))
    }

    fn serialize_f64(self, value: f64) -> Result<Written, YamlError> {
        Ok(float(value, value))
    }

    fn serialize_char(self, value: char) -> Result<Written, YamlError> {
        self.serialize_str(value.encode_utf8(&mut [0; 4]))
    }

    fn serialize_str(self, value: &str) -> Result<Written, YamlError> {
        Ok(Written::Word(text(value)))
    }

    fn serialize_bytes(self, _: &[u8]) -> Result<Written, YamlError> {
        nowhere("a row of bytes")
    }

    fn serialize_none(self) -> Result<Written, YamlError> {
        self.serialize_unit()
    }

    fn serialize_some<T: Serialize + ?Sized>(self, value: &T) -> Result<Written, YamlError> {
        value.serialize(self)
    }

    fn serialize_unit(self) -> Result<Written, YamlError> {
        Ok(Written::Word("null".to_owned()))
    }

    fn serialize_unit_struct(self, _: &'static str) -> Result<Written, YamlError> {
        self.serialize_unit()
    }

    fn serialize_unit_variant(self, _: &'static str, _: u32, variant: &'static str) -> Result<Written, YamlError> {
        self.serialize_str(variant)
    }

    fn serialize_newtype_struct<T: Serialize + ?Sized>(self, _: &'static str, value: &T) -> Result<Written, YamlError> {
        value.serialize(self)
    }

    fn serialize_newtype_variant<T: Serialize + ?Sized>(
        self,
        _: &'static str,
        _: u32,
        variant: &'static str,
        _: &T,
    ) -> Result<Written, YamlError> {
        nowhere(variant)
    }

    fn serialize_seq(self, _: Option<usize>) -> Result<Items, YamlError> {
        Ok(Items(Vec::new()))
    }

    fn serialize_tuple(self, _: usize) -> Result<Items, YamlError> {
        Ok(Items(Vec::new()))
    }

    fn serialize_tuple_struct(self, _: &'static str, _: usize) -> Result<Items, YamlError> {
        Ok(Items(Vec::new()))
    }

    fn serialize_tuple_variant(
        self,
        _: &'static str,
        _: u32,
        variant: &'static str,
        _: usize,
    ) -> Result<Impossible<Written, YamlError>, YamlError> {
        nowhere(variant)
    }

    fn serialize_map(self, _: Option<usize>) -> Result<Entries, YamlError> {
        Ok(Entries(Vec::new(), String::new()))
    }

    fn serialize_struct(self, _: &'static str, _: usize) -> Result<Entries, YamlError> {
        Ok(Entries(Vec::new(), String::new()))
    }

    fn serialize_struct_variant(
        self,
        _: &'static str,
        _: u32,
        variant: &'static str,
        _: usize,
    ) -> Result<Impossible<Written, YamlError>, YamlError> {
        nowhere(variant)
    }
}

struct Items(Vec<Written>);

impl SerializeSeq for Items {
    type Ok = Written;
    type Error = YamlError;

    fn serialize_element<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), YamlError> {
        self.0.push(value.serialize(Builder)?);
        Ok(())
    }

    fn end(self) -> Result<Written, YamlError> {
        Ok(Written::List(self.0))
    }
}

impl ser::SerializeTuple for Items {
    type Ok = Written;
    type Error = YamlError;

    fn serialize_element<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), YamlError> {
        SerializeSeq::serialize_element(self, value)
    }

    fn end(self) -> Result<Written, YamlError> {
        SerializeSeq::end(self)
    }
}

impl ser::SerializeTupleStruct for Items {
    type Ok = Written;
    type Error = YamlError;

    fn serialize_field<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), YamlError> {
        SerializeSeq::serialize_element(self, value)
    }

    fn end(self) -> Result<Written, YamlError> {
        SerializeSeq::end(self)
    }
}

/// Entries, and the key of the one that comes.
struct Entries(Vec<(String, Written)>, String);

impl SerializeMap for Entries {
    type Ok = Written;
    type Error = YamlError;

    fn serialize_key<T: Serialize + ?Sized>(&mut self, key: &T) -> Result<(), YamlError> {
        match key.serialize(Builder)? {
            Written::Word(word) => self.1 = word,
            Written::List(_) | Written::Map(_) => return nowhere("a key that is no text"),
        }
        Ok(())
    }

    fn serialize_value<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), YamlError> {
        let value = value.serialize(Builder)?;
        self.0.push((std::mem::take(&mut self.1), value));
        Ok(())
    }

    fn end(self) -> Result<Written, YamlError> {
        Ok(Written::Map(self.0))
    }
}

impl SerializeStruct for Entries {
    type Ok = Written;
    type Error = YamlError;

    fn serialize_field<T: Serialize + ?Sized>(&mut self, key: &'static str, value: &T) -> Result<(), YamlError> {
        self.0.push((text(key), value.serialize(Builder)?));
        Ok(())
    }

    fn end(self) -> Result<Written, YamlError> {
        Ok(Written::Map(self.0))
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use proptest::prelude::*;

    use super::*;
    use crate::yaml::from_text;

    #[test]
    fn layout_is_plain() {
        #[derive(Serialize)]
        struct Inner {
            x: f32,
            names: Vec<&'static str>,
        }
        #[derive(Serialize)]
        struct Outer {
            none: Option<u8>,
            empty: Vec<u8>,
            list: Vec<Inner>,
            nested: [[f64; 2]; 1],
        }
        let inner = Inner { x: 0.3, names: vec!["arm", "12", "yes", "a: b", ""] };
        let value = Outer { none: None, empty: Vec::new(), list: vec![inner], nested: [[1.0, f64::NAN]] };
        let wanted = "none: null\nempty: []\nlist:\n  - x: 0.3\n    names:\n      - arm\n      - \"12\"\n      - \"yes\"\n      - \"a: b\"\n      \
                      - \"\"\nnested:\n  - - 1.0\n    - .nan\n";
        assert_eq!(to_text(&value).unwrap(), wanted);
        assert_eq!(to_text(&0.5).unwrap(), "0.5\n");
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

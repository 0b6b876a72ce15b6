//! What the libraries tell people, without a language: a key of the catalogue, its parameters and a place in a file.
//!
//! Errors and findings are enums, so that a program can match on them; [`ToMessage`] gives their key and parameters, and `sinew_i18n::sentence`
//! makes the sentence in the user's language. Where an error is shown as text without a catalogue, as in a log, it is the key with its parameters.

use std::fmt;
use std::path::{Path, PathBuf};

/// A parameter of a message.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// A text that stays as it is in every language, such as a name from a file.
    Text(String),
    /// A number, which chooses plural forms.
    Number(f64),
    /// A number with so many decimals and the decimal mark of the language.
    Decimal {
        /// The number.
        value: f64,
        /// How many decimals.
        digits: usize,
    },
    /// The same with a true minus, as wide as a plus, for what stands in the window.
    Signed {
        /// The number.
        value: f64,
        /// How many decimals.
        digits: usize,
    },
    /// A message of its own, such as the reason of an error.
    Message(Box<Message>),
}

/// What something was read from.
#[derive(Debug, Clone, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum SourceName {
    /// It is not known.
    #[default]
    Unknown,
    /// A file by its path as the user gave it, or by its path in an archive.
    Path(String),
    /// Standard input.
    StandardInput,
    /// The scene of a start without files.
    BuiltIn,
    /// Muscles that were never saved, counted from 0.
    New(usize),
}

/// A place in a file. Displays as `file:line:column`, without what is not known.
#[derive(Debug, Clone, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Location {
    /// The file.
    pub file: SourceName,
    /// Line from 1.
    pub line: Option<u32>,
    /// Column from 1, in characters.
    pub column: Option<u32>,
}

/// A sentence without a language: a key of the catalogue with its parameters, and the place that it speaks of.
///
/// ```
/// use sinew_scene::message;
/// use sinew_scene::message::Location;
///
/// let message = message!("collada-count-mismatch", said = 12_u32, found = 9_u32).at(Location::file("arm.dae"));
/// // Its text without a catalogue, as a log has it.
/// assert_eq!(message.to_string(), "arm.dae: collada-count-mismatch (said: 12, found: 9)");
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Message {
    /// The key in the catalogue.
    pub key: &'static str,
    /// The parameters by their names in the catalogue.
    pub parameters: Vec<(&'static str, Value)>,
    /// Where; it stands before the sentence.
    pub location: Location,
}

/// What can be said to people.
pub trait ToMessage {
    /// Its key and parameters.
    fn message(&self) -> Message;
}

impl SourceName {
    /// The name of a path of the command line, where `-` is standard input.
    pub fn of_argument(path: &Path) -> Self {
        if path.as_os_str() == "-" { Self::StandardInput } else { Self::Path(path.display().to_string()) }
    }

    /// The path as the user gave it, where there is one.
    pub fn path(&self) -> Option<&str> {
        if let Self::Path(path) = self { Some(path) } else { None }
    }
}

impl Location {
    /// A file as a whole.
    pub fn file(file: impl Into<SourceName>) -> Self {
        Self { file: file.into(), line: None, column: None }
    }

    /// Whether nothing is known.
    pub fn is_empty(&self) -> bool {
        self.file == SourceName::Unknown && self.line.is_none()
    }
}

impl Message {
    /// A message with these parameters. Prefer the macro [`message!`](crate::message!).
    pub fn new(key: &'static str, parameters: Vec<(&'static str, Value)>) -> Self {
        Self { key, parameters, location: Location::default() }
    }

    /// The words of a library or of the operating system, which have no translation.
    pub fn verbatim(words: impl Into<String>) -> Self {
        Self::new("message-verbatim", vec![("words", Value::Text(words.into()))])
    }

    /// The same about a place in a file.
    pub fn at(self, location: Location) -> Self {
        Self { location, ..self }
    }

    /// The parameter of that name.
    pub fn parameter(&self, name: &str) -> Option<&Value> {
        self.parameters.iter().find(|(own, _)| *own == name).map(|(_, value)| value)
    }
}

/// The number with `digits` decimals and the decimal mark of the language.
pub fn decimal(value: f64, digits: usize) -> Value {
    Value::Decimal { value, digits }
}

/// A text from a file as a message quotes it: its first 79 letters where it has more than 80.
pub fn shortened(text: &str) -> String {
    if text.chars().count() <= 80 { text.to_owned() } else { text.chars().take(79).chain(['…']).collect() }
}

/// The number with `digits` decimals, the decimal mark of the language and a true minus.
pub fn signed(value: f64, digits: usize) -> Value {
    Value::Signed { value, digits }
}

/// A message of the catalogue: `message!("collada-count-mismatch", said = said, found = found)`.
///
/// Values are texts, numbers, paths or messages.
#[macro_export]
macro_rules! message {
    ($key:expr) => { $crate::message::Message::new($key, Vec::new()) };
    ($key:expr, $($name:ident = $value:expr),+ $(,)?) => {
        $crate::message::Message::new($key, vec![$((stringify!($name), $crate::message::Value::from($value))),+])
    };
}

impl ToMessage for Message {
    fn message(&self) -> Message {
        self.clone()
    }
}

impl From<Message> for Value {
    fn from(message: Message) -> Self {
        Self::Message(Box::new(message))
    }
}

macro_rules! texts {
    ($($type:ty => $text:expr),+ $(,)?) => {
        $(impl From<$type> for Value {
            fn from(value: $type) -> Self {
                let text: fn($type) -> String = $text;
                Self::Text(text(value))
            }
        })+
    };
}

texts! {
    &str => |text| text.to_owned(),
    &String => Clone::clone,
    String => |text| text,
    &Path => |path| path.display().to_string(),
    &PathBuf => |path| path.display().to_string(),
    char => |letter| letter.to_string(),
}

macro_rules! numbers {
    ($($type:ty),+) => {
        $(impl From<$type> for Value {
            fn from(value: $type) -> Self {
                // Counts beyond 2^53 do not occur, and would be shown rounded.
                Self::Number(value as f64)
            }
        }

        impl From<&$type> for Value {
            fn from(value: &$type) -> Self {
                Self::from(*value)
            }
        })+
    };
}

numbers!(u8, u16, u32, u64, usize, i32, i64, f64);

impl<T: Into<String>> From<T> for SourceName {
    fn from(path: T) -> Self {
        let path = path.into();
        if path.is_empty() { Self::Unknown } else { Self::Path(path) }
    }
}

impl fmt::Display for SourceName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unknown => Ok(()),
            Self::Path(path) => f.write_str(path),
            Self::StandardInput => f.write_str("-"),
            Self::BuiltIn => f.write_str("built-in"),
            Self::New(number) => write!(f, "new-{number}"),
        }
    }
}

impl fmt::Display for Location {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.file)?;
        for number in [self.line, self.column].into_iter().flatten() {
            write!(f, ":{number}")?;
        }
        Ok(())
    }
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Text(text) => write!(f, "{text:?}"),
            Self::Number(number) => write!(f, "{number}"),
            Self::Decimal { value, digits } | Self::Signed { value, digits } => write!(f, "{value:.digits$}"),
            Self::Message(message) => write!(f, "{message}"),
        }
    }
}

impl fmt::Display for Message {
    /// `file:line:column: key (name: value, …)`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.location.is_empty() {
            write!(f, "{}: ", self.location)?;
        }
        f.write_str(self.key)?;
        for (number, (name, value)) in self.parameters.iter().enumerate() {
            write!(f, "{}{name}: {value}", if number == 0 { " (" } else { ", " })?;
        }
        if self.parameters.is_empty() { Ok(()) } else { f.write_str(")") }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_message_without_a_catalogue_is_its_key_with_its_parameters() {
        let reason = message!("io-denied");
        let error = message!("open-failed", file = "a \"b\"", count = 3usize, angle = decimal(1.256, 1), reason = reason);
        assert_eq!(error.to_string(), r#"open-failed (file: "a \"b\"", count: 3, angle: 1.3, reason: io-denied)"#);
        assert_eq!(error.parameter("count"), Some(&Value::Number(3.0)));
        let located = message!("document-empty").at(Location { file: "arm.yaml".into(), line: Some(3), column: Some(7) });
        assert_eq!(located.to_string(), "arm.yaml:3:7: document-empty");
    }
}

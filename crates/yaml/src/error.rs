//! Why a YAML text cannot be used, and where.

use super::Place;
use sinew_scene::limits;
use sinew_scene::message;
use sinew_scene::message::{Message, ToMessage};

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
    /// It has more than so many bytes, the limit of its kind of file.
    TooLarge(u64),
    /// It is not YAML.
    Syntax(SyntaxReason),
    /// A second document begins.
    SeveralDocuments,
    /// There are more values than [`limits::YAML_VALUES`], those behind aliases counted each time.
    TooManyValues,
    /// There is more text than [`limits::YAML_TEXT`], that behind aliases counted each time.
    TooMuchText,
    /// Lists and mappings nest deeper than [`limits::YAML_DEPTH`].
    TooDeep,
    /// An alias stands inside the value that it stands for.
    AliasInItself,
    /// A value of this kind does not belong here.
    Unfitting(ValueKind),
    /// A list has so many values, which is the wrong number.
    WrongCount(usize),
    /// A word is none of those that may stand here.
    UnknownWord {
        /// The word, shortened where it is long.
        word: String,
        /// Those that may stand here.
        known: &'static [&'static str],
    },
    /// A key is missing.
    MissingKey(&'static str),
    /// A key stands twice in one mapping.
    RepeatedKey(&'static str),
    /// What `serde` or the type that was to be made says, in English.
    Foreign(String),
}

/// What a value is, as errors call it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ValueKind {
    /// Nothing.
    Null,
    /// `true` or `false`.
    Bool,
    /// A number.
    Number,
    /// Text.
    Text,
    /// A list.
    List,
    /// A mapping.
    Map,
    /// A value with a tag of its own.
    Tagged,
}

/// What makes a text no YAML.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SyntaxReason {
    /// A colon stands where no key can be.
    Colon,
    /// A key has no colon.
    NoColon,
    /// A key was expected.
    Key,
    /// A list in brackets is not closed, or a comma is missing.
    List,
    /// A mapping in braces is not closed, or a comma is missing.
    Map,
    /// A bracket is closed that was not opened.
    Bracket,
    /// A dash was expected.
    NoDash,
    /// A dash stands where no list can begin.
    Dash,
    /// A character cannot stand here, such as a tab that indents.
    Character,
    /// An invisible control character.
    Control,
    /// The text ends in the middle of something quoted.
    End,
    /// An unknown escape in a text in quotes.
    Escape,
    /// An alias without its anchor.
    UnknownAnchor,
    /// An anchor or alias stands where none can be.
    Anchor,
    /// The indentation is wrong.
    Indentation,
    /// A directive is wrong, or there are too many.
    Directive,
    /// A tag is wrong.
    Tag,
    /// Something stands after the end of the document.
    AfterEnd,
    /// A value was expected.
    Value,
}

impl YamlError {
    /// An error about a place.
    pub(super) fn at(place: Place, kind: YamlErrorKind) -> Self {
        Self { place: Some(place), kind }
    }

    /// An error about the text as a whole, or about a place that the caller adds.
    pub(super) fn whole(kind: YamlErrorKind) -> Self {
        Self { place: None, kind }
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
            Self::TooLarge(limit) => message!("document-too-large", limit = limit >> 20),
            Self::Syntax(reason) => message!("document-yaml-syntax", reason = reason.message()),
            Self::SeveralDocuments => message!("document-yaml-several-documents"),
            Self::TooManyValues => message!("document-yaml-too-many-values", limit = limits::YAML_VALUES),
            Self::TooMuchText => message!("document-yaml-too-much-text", limit = limits::YAML_TEXT >> 20),
            Self::TooDeep => message!("document-yaml-too-deep", limit = limits::YAML_DEPTH),
            Self::AliasInItself => message!("document-yaml-alias-in-itself"),
            Self::Unfitting(found) => message!("document-yaml-unfitting", found = found.message()),
            Self::WrongCount(count) => message!("document-yaml-wrong-count", count = count),
            Self::UnknownWord { word, known } => message!("document-yaml-unknown-word", word = word, known = known.join(", ")),
            Self::MissingKey(key) => message!("document-yaml-missing-key", key = *key),
            Self::RepeatedKey(key) => message!("document-yaml-repeated-key", key = *key),
            Self::Foreign(words) => Message::verbatim(words),
        }
    }
}

impl ToMessage for ValueKind {
    fn message(&self) -> Message {
        match self {
            Self::Null => message!("document-yaml-found-nothing"),
            Self::Bool => message!("document-yaml-found-bool"),
            Self::Number => message!("document-yaml-found-number"),
            Self::Text => message!("document-yaml-found-text"),
            Self::List => message!("document-yaml-found-list"),
            Self::Map => message!("document-yaml-found-map"),
            Self::Tagged => message!("document-yaml-found-tag"),
        }
    }
}

impl ToMessage for SyntaxReason {
    fn message(&self) -> Message {
        match self {
            Self::Colon => message!("document-yaml-reason-colon"),
            Self::NoColon => message!("document-yaml-reason-no-colon"),
            Self::Key => message!("document-yaml-reason-key"),
            Self::List => message!("document-yaml-reason-list"),
            Self::Map => message!("document-yaml-reason-map"),
            Self::Bracket => message!("document-yaml-reason-bracket"),
            Self::NoDash => message!("document-yaml-reason-dash"),
            Self::Dash => message!("document-yaml-reason-dash-here"),
            Self::Character => message!("document-yaml-reason-character"),
            Self::Control => message!("document-yaml-reason-control"),
            Self::End => message!("document-yaml-reason-end"),
            Self::Escape => message!("document-yaml-reason-escape"),
            Self::UnknownAnchor => message!("document-yaml-reason-anchor"),
            Self::Anchor => message!("document-yaml-reason-anchor-here"),
            Self::Indentation => message!("document-yaml-reason-indentation"),
            Self::Directive => message!("document-yaml-reason-directive"),
            Self::Tag => message!("document-yaml-reason-tag"),
            Self::AfterEnd => message!("document-yaml-reason-after"),
            Self::Value => message!("document-yaml-reason-content"),
        }
    }
}

//! Why a document could not be read.

use sinew_scene::limits;
use sinew_scene::message;
use sinew_scene::message::{Message, ToMessage};

/// Why a file could not be read at all.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{}", self.message())]
pub struct ReadError {
    /// Line from 1, where one can be named.
    pub line: Option<u32>,
    /// What is wrong.
    pub kind: ReadErrorKind,
}

/// What is wrong with a document that could not be read.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum ReadErrorKind {
    /// It is larger than [`limits::FILE_BYTES`].
    TooLarge,
    /// Reading was cancelled.
    Cancelled,
    /// It is no XML at all.
    NotXml,
    /// Its root is this element instead of `COLLADA`.
    NotCollada(String),
    /// It has so many elements, too many for its size; 0 where the parser gave up before they were counted.
    TooManyElements(usize),
    /// Elements are nested more than [`limits::DEPTH`] levels deep.
    TooDeep,
    /// An element has more than [`limits::XML_ATTRIBUTES`] attributes.
    TooManyAttributes,
    /// It declares more than [`limits::XML_PREFIXES`] namespace prefixes.
    TooManyPrefixes,
    /// Its entities would expand to more than [`limits::ENTITY_BYTES`].
    EntitiesTooLarge,
    /// Commas separate the numbers of a list.
    CommaSeparated {
        /// The element that holds the list, such as `<p> in <geometry> "Body"`.
        element: String,
        /// The first entry with a comma.
        entry: String,
    },
    /// It is not well-formed at this column, from 1, in characters.
    Xml(u32),
    /// An element is closed by the tag of another one.
    WrongCloseTag {
        /// The element that is open.
        expected: String,
        /// The one that the tag closes.
        actual: String,
    },
    /// It ends before its root element does.
    CutShort,
    /// It uses this entity, which it does not declare.
    UnknownEntity(String),
    /// Its entities refer to each other without an end.
    EntityLoop,
    /// It uses this namespace prefix, which it does not declare.
    UnknownPrefix(String),
    /// An element has this attribute twice.
    RepeatedAttribute(String),
    /// The archive is damaged and cannot be unpacked.
    ArchiveBroken,
    /// The archive holds more than [`limits::ARCHIVE_FILES`] files.
    ArchiveFiles,
    /// The archive unpacks to more than reading it may take: [`limits::ARCHIVE_BYTES_PER_BYTE`] times its size and [`limits::ARCHIVE_BYTES`].
    ArchiveTooLarge,
    /// The archive holds no document.
    ArchiveEmpty,
    /// The manifest of the archive names this document, which is not in it.
    ArchiveRootMissing(String),
    /// A further document of an archive declares entities of its own, which would be lost where it is put behind the first one.
    PartWithEntities,
}

impl ReadError {
    /// An error in this line, from 1.
    pub(super) fn in_line(line: u32, kind: ReadErrorKind) -> Self {
        Self { line: Some(line), kind }
    }
}

/// An error about the file as a whole.
impl From<ReadErrorKind> for ReadError {
    fn from(kind: ReadErrorKind) -> Self {
        Self { line: None, kind }
    }
}

impl ToMessage for ReadError {
    /// What is wrong, without the line: who opened the file knows its name and puts both before the sentence.
    fn message(&self) -> Message {
        self.kind.message()
    }
}

impl ToMessage for ReadErrorKind {
    fn message(&self) -> Message {
        match self {
            Self::TooLarge => message!("collada-too-large", limit = limits::FILE_BYTES >> 20),
            Self::Cancelled => message!("collada-cancelled"),
            Self::NotXml => message!("collada-not-xml"),
            Self::NotCollada(element) => message!("collada-not-collada", element = element),
            Self::TooManyElements(count) => message!("collada-too-many-elements", count = count),
            Self::TooDeep => message!("collada-too-deep", limit = limits::DEPTH),
            Self::TooManyAttributes => message!("collada-too-many-attributes", limit = limits::XML_ATTRIBUTES),
            Self::TooManyPrefixes => message!("collada-too-many-prefixes", limit = limits::XML_PREFIXES),
            Self::EntitiesTooLarge => message!("collada-entities", limit = limits::ENTITY_BYTES >> 20),
            Self::CommaSeparated { element, entry } => message!("collada-comma", element = element, entry = entry),
            Self::Xml(column) => message!("collada-xml", column = column),
            Self::WrongCloseTag { expected, actual } => message!("collada-xml-close-tag", expected = expected, actual = actual),
            Self::CutShort => message!("collada-xml-cut-short"),
            Self::UnknownEntity(name) => message!("collada-xml-unknown-entity", name = name),
            Self::EntityLoop => message!("collada-xml-entity-loop"),
            Self::UnknownPrefix(prefix) => message!("collada-xml-unknown-prefix", prefix = prefix),
            Self::RepeatedAttribute(name) => message!("collada-xml-repeated-attribute", name = name),
            Self::ArchiveBroken => message!("collada-archive-broken"),
            Self::ArchiveFiles => message!("collada-archive-files", limit = limits::ARCHIVE_FILES),
            Self::ArchiveTooLarge => message!("collada-archive-large", limit = limits::ARCHIVE_BYTES_PER_BYTE),
            Self::ArchiveEmpty => message!("collada-archive-empty"),
            Self::ArchiveRootMissing(path) => message!("collada-archive-root", path = path),
            Self::PartWithEntities => message!("collada-part-entities"),
        }
    }
}

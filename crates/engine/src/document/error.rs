//! Why a file could not be opened.

use super::foreign::UnsupportedFormat;
use crate::input::Refused;
use sinew_muscle::config::ConfigErrorKind;
use sinew_scene::import::ImportError;
use sinew_scene::limits;
use sinew_scene::message;
use sinew_scene::message::{Location, Message, SourceName, ToMessage};
use sinew_yaml::YamlErrorKind;

/// Why a file could not be used, and where in it.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{}", self.message())]
pub struct OpenError {
    /// The place in the file.
    pub location: Location,
    /// What is wrong.
    pub kind: OpenErrorKind,
}

/// What is wrong with a file that could not be used.
#[derive(Debug, Clone, PartialEq)]
pub enum OpenErrorKind {
    /// It could not be read.
    Refused(Box<Refused>),
    /// It has more than so many bytes, the limit of its format.
    TooLarge(u64),
    /// It is empty.
    Empty,
    /// It is of another format.
    UnsupportedFormat(UnsupportedFormat),
    /// It is not UTF-8 text.
    NotText,
    /// Its reader could not use it.
    Reader(ImportError),
    /// It is no muscle file that can be used.
    Muscles(Box<ConfigErrorKind>),
    /// It is no session that can be used.
    Session(Box<YamlErrorKind>),
    /// The session names so many files, more than [`limits::SESSION_FILES`].
    TooManyFiles(usize),
    /// With its muscles the surfaces would have more vertices than [`limits::MUSCLE_VERTICES`].
    TooMuchSurface,
    /// Opening was cancelled.
    Cancelled,
    /// The reader stopped at an error of its own.
    ReaderFailed,
}

impl OpenError {
    /// An error about the file as a whole.
    pub fn whole(file: &SourceName, kind: OpenErrorKind) -> Self {
        Self { location: Location::file(file.clone()), kind }
    }
}

impl ToMessage for OpenError {
    fn message(&self) -> Message {
        self.kind.message().at(self.location.clone())
    }
}

impl ToMessage for OpenErrorKind {
    fn message(&self) -> Message {
        match self {
            Self::Refused(refused) => refused.message(),
            Self::TooLarge(limit) => message!("document-too-large", limit = limit >> 20),
            Self::Empty => message!("document-empty"),
            Self::UnsupportedFormat(foreign) => foreign.message(),
            Self::NotText => message!("document-not-text"),
            Self::Reader(error) => error.message(),
            Self::Muscles(error) => error.message(),
            Self::Session(error) => error.message(),
            Self::TooManyFiles(count) => message!("document-too-many-files", count = count, limit = limits::SESSION_FILES),
            Self::TooMuchSurface => message!("document-too-much-surface", limit = limits::MUSCLE_VERTICES),
            Self::Cancelled => message!("document-cancelled"),
            Self::ReaderFailed => message!("app-reader-broke"),
        }
    }
}

//! Why a file could not be written.

use std::io;
use std::path::{Path, PathBuf};

use crate::system::{Doing, reason};
use sinew_scene::message;
use sinew_scene::message::{Location, Message, ToMessage};

/// Why a file could not be written.
#[derive(Debug, thiserror::Error)]
#[error("{}", self.message())]
pub enum OutputError {
    /// The folder, the disk or the file system refused.
    Io {
        /// The file that was to be written.
        file: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The target is there and is no ordinary file.
    NotAFile {
        /// The target.
        file: PathBuf,
    },
    /// The target is one of the files that are open or that the result is made from.
    Held {
        /// The target.
        file: PathBuf,
    },
    /// Writing was cancelled.
    Cancelled,
}

impl OutputError {
    /// What the system said about `file`; an error of this type that was wrapped into one of the system's comes out again.
    pub fn io(file: &Path, source: io::Error) -> Self {
        // One of ours that had to pass through a closure that knows only the system's errors.
        match source.downcast::<Self>() {
            Ok(own) => own,
            Err(source) => Self::Io { file: file.to_owned(), source },
        }
    }
}

impl ToMessage for OutputError {
    fn message(&self) -> Message {
        let about = |file: &Path, message: Message| message.at(Location::file(file.display().to_string()));
        match self {
            Self::Io { file, source } => about(file, message!("export-not-written", reason = reason(source, Doing::Writing))),
            Self::NotAFile { file } => about(file, message!("export-not-a-file")),
            Self::Held { file } => about(file, message!("export-held")),
            Self::Cancelled => message!("export-cancelled"),
        }
    }
}

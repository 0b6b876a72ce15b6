//! Exported files: pictures, videos, posed surfaces, glTF, tables.
//!
//! Every file is written beside its final place under a temporary name and renamed when it is complete, so a failed save leaves what was
//! there. No result replaces a file that it is made from or that is open: what writes takes an [`guard::Output`], which only a [`guard::OverwriteGuard`]
//! gives out.

pub mod apng;
pub mod atomic_file;
pub mod color_quantizer;
pub mod file_extension;
pub mod gif;
pub mod gltf;
pub mod guard;
pub mod mtl;
pub mod obj;
pub mod pipeline;
pub mod ply;
pub mod png;
pub mod stl;
pub mod surface;
pub mod tables;
mod temporary;
pub mod video;

use std::io;
use std::path::{Path, PathBuf};

use crate::plot::PlotError;
use crate::system::{Doing, reason};
use sinew_scene::limits;
use sinew_scene::message;
use sinew_scene::message::{Location, Message, ToMessage};

/// Why a file could not be written.
#[derive(Debug, thiserror::Error)]
#[error("{}", self.message())]
pub enum ExportError {
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
    /// The picture does not fit the format.
    TooLarge {
        /// The file that was to be written.
        file: PathBuf,
        /// The longest side that the format can hold, pixels.
        limit: u32,
    },
    /// Converting the document would take more memory than [`limits::CONVERTED_BYTES`].
    TooMuch {
        /// The file that was to be written.
        file: PathBuf,
    },
    /// The export was cancelled.
    Cancelled,
    /// The program that makes films is not installed.
    NoEncoder {
        /// The file that was to be written.
        file: PathBuf,
    },
    /// The program that makes films has nothing for this kind of film.
    NoCodec {
        /// The file that was to be written.
        file: PathBuf,
        /// The encoders that would have done.
        names: String,
    },
    /// A plot could not be drawn.
    Plot {
        /// The file that was to be written.
        file: PathBuf,
        /// Why not.
        why: PlotError,
    },
    /// The program that makes films gave up.
    EncoderFailed {
        /// The file that was to be written.
        file: PathBuf,
        /// Its last words, or what the system said.
        reason: Message,
    },
}

impl ExportError {
    /// What the system said about `file`; an error of this type that was wrapped into one of the system's comes out again.
    pub fn io(file: &Path, source: io::Error) -> Self {
        // One of ours that had to pass through a closure that knows only the system's errors.
        match source.downcast::<Self>() {
            Ok(own) => own,
            Err(source) => Self::Io { file: file.to_owned(), source },
        }
    }
}

impl ToMessage for ExportError {
    fn message(&self) -> Message {
        let about = |file: &Path, message: Message| message.at(Location::file(file.display().to_string()));
        match self {
            Self::Io { file, source } => about(file, message!("export-not-written", reason = reason(source, Doing::Writing))),
            Self::NotAFile { file } => about(file, message!("export-not-a-file")),
            Self::Held { file } => about(file, message!("export-held")),
            Self::TooLarge { file, limit } => about(file, message!("export-too-large", limit = limit)),
            Self::TooMuch { file } => about(file, message!("export-too-much", limit = limits::CONVERTED_BYTES >> 20)),
            Self::Cancelled => message!("export-cancelled"),
            Self::NoEncoder { file } => about(file, message!("export-no-ffmpeg")),
            Self::NoCodec { file, names } => about(file, message!("export-no-codec", names = names)),
            Self::Plot { file, why } => about(file, why.message()),
            Self::EncoderFailed { file, reason } => about(file, message!("export-encoder-failed", reason = reason.clone())),
        }
    }
}

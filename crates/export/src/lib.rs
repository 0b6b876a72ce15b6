//! What documents become: pictures, animations, videos, posed surfaces, glTF, tables and plots.
//!
//! Every writer takes an [`Output`](sinew_engine::output::Output), so no result replaces a file that it is made from or that is open.
//!
//! | module | what it writes |
//! |---|---|
//! | [`sequence`] | frames one after the other, and the files that they become |
//! | [`png`], [`apng`], [`gif`], [`video`] | pictures, animations, and videos by an installed `ffmpeg`; [`pipeline`] draws, converts and writes at the same time |
//! | [`surface`] with [`obj`], [`mtl`], [`ply`], [`stl`], from [`world_mesh`] | the surfaces of a pose |
//! | [`gltf`] | nodes, skins, morph targets, muscles and animations |
//! | [`tables`], [`plot`] | what muscles and joints do over an angle or a time |

pub mod apng;
pub mod color_quantizer;
pub mod file_extension;
pub mod gif;
pub mod gltf;
pub mod mtl;
pub mod obj;
pub mod pipeline;
pub mod plot;
pub mod ply;
pub mod png;
pub mod sequence;
pub mod stl;
pub mod surface;
pub mod tables;
pub mod video;
pub mod world_mesh;

use std::io;
use std::path::{Path, PathBuf};

use plot::PlotError;
use sinew_engine::output::OutputError;
use sinew_scene::limits;
use sinew_scene::message;
use sinew_scene::message::{Location, Message, ToMessage};

/// Why a file could not be written.
#[derive(Debug, thiserror::Error)]
#[error("{}", self.message())]
pub enum ExportError {
    /// The system or the guard refused, or writing was cancelled.
    Output(OutputError),
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
    /// The program that makes videos is not installed.
    NoEncoder {
        /// The file that was to be written.
        file: PathBuf,
    },
    /// The program that makes videos has no encoder for this kind.
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
    /// The program that makes videos gave up.
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
        OutputError::io(file, source).into()
    }

    /// The export was cancelled.
    pub const CANCELLED: Self = Self::Output(OutputError::Cancelled);

    /// Whether it was the person who ended it.
    pub fn is_cancelled(&self) -> bool {
        matches!(self, Self::Output(OutputError::Cancelled))
    }
}

impl From<OutputError> for ExportError {
    fn from(error: OutputError) -> Self {
        match error {
            // One of ours that had to pass through a closure that knows only the system's errors.
            OutputError::Io { file, source } => match source.downcast::<Self>() {
                Ok(own) => own,
                Err(source) => Self::Output(OutputError::Io { file, source }),
            },
            other => Self::Output(other),
        }
    }
}

impl ToMessage for ExportError {
    fn message(&self) -> Message {
        let about = |file: &Path, message: Message| message.at(Location::file(file.display().to_string()));
        match self {
            Self::Output(error) => error.message(),
            Self::TooLarge { file, limit } => about(file, message!("export-too-large", limit = limit)),
            Self::TooMuch { file } => about(file, message!("export-too-much", limit = limits::CONVERTED_BYTES >> 20)),
            Self::NoEncoder { file } => about(file, message!("export-no-ffmpeg")),
            Self::NoCodec { file, names } => about(file, message!("export-no-codec", names = names)),
            Self::Plot { file, why } => about(file, why.message()),
            Self::EncoderFailed { file, reason } => about(file, message!("export-encoder-failed", reason = reason.clone())),
        }
    }
}

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

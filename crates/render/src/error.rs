//! Why a picture could not be drawn.

use std::io;

use sinew_scene::message;
use sinew_scene::message::{Message, ToMessage};

/// Why a picture could not be drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("{}", self.message())]
pub enum RenderError {
    /// The system gives no memory for the picture, or for what it is made from. The renderer has let go of all its buffers and can be used again.
    OutOfMemory,
}

impl ToMessage for RenderError {
    fn message(&self) -> Message {
        match self {
            Self::OutOfMemory => message!("render-memory"),
        }
    }
}

impl From<RenderError> for io::Error {
    /// [`io::ErrorKind::OutOfMemory`], which says the same.
    fn from(error: RenderError) -> Self {
        match error {
            RenderError::OutOfMemory => io::ErrorKind::OutOfMemory.into(),
        }
    }
}

//! Writing of the files that the program keeps for itself: settings, and muscles for recovery.

use std::io::Write;
use std::path::Path;

use crate::output::Output;
use crate::output::OutputError;
use crate::output::write_atomic;
use sinew_scene::message::{Message, ToMessage};
use sinew_yaml::YamlError;

/// Why a file that the program keeps for itself could not be written.
#[derive(Debug, thiserror::Error)]
#[error("{}", self.message())]
pub enum SaveError {
    /// It cannot be expressed in YAML.
    Yaml(#[from] YamlError),
    /// The folder or the file could not be written.
    File(#[from] OutputError),
}

impl ToMessage for SaveError {
    fn message(&self) -> Message {
        match self {
            Self::Yaml(error) => error.message(),
            Self::File(error) => error.message(),
        }
    }
}

/// Writes a text to a file of the program's own, by way of a temporary one, into a folder that is made where it is missing.
pub(super) fn write(path: &Path, text: &str) -> Result<(), SaveError> {
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).map_err(|error| OutputError::io(path, error))?;
    }
    Ok(write_atomic(&Output::of_program(path), |file| file.write_all(text.as_bytes()))?)
}

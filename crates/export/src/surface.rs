//! The file formats of posed surfaces.

use std::path::Path;

use super::{ExportError, obj, ply, stl};
use sinew_engine::output::Output;
use sinew_scene::{Frame, Scene};

/// The file formats of a posed surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SurfaceFormat {
    /// Wavefront OBJ with its MTL.
    Obj,
    /// Binary PLY.
    Ply,
    /// Binary STL.
    Stl,
}

impl SurfaceFormat {
    /// The format that a file name asks for by its ending.
    pub fn of(file: &Path) -> Option<Self> {
        match file.extension()?.to_string_lossy().to_lowercase().as_str() {
            "obj" => Some(Self::Obj),
            "ply" => Some(Self::Ply),
            "stl" => Some(Self::Stl),
            _ => None,
        }
    }

    /// Writes the visible surfaces of `frame`, a pose of `scene`.
    ///
    /// # Errors
    /// [`ExportError`] where a file cannot be written.
    pub fn save(self, file: &Output, scene: &Scene, frame: &Frame) -> Result<(), ExportError> {
        match self {
            Self::Obj => obj::save(file, scene, frame),
            Self::Ply => ply::save(file, frame),
            Self::Stl => stl::save(file, frame),
        }
    }
}

//! What was found in the files of a document, whichever part of the program found it.

use super::OpenError;
use super::image_finding::ImageFinding;
use sinew_muscle as muscle;
use sinew_scene::diagnostics::{DiagnosticKind, Severity};
use sinew_scene::import::AnyFinding;
use sinew_scene::message;
use sinew_scene::message::{Message, ToMessage};

/// What was found in a file of a document.
#[derive(Debug, Clone, PartialEq)]
pub enum Finding {
    /// By the reader of a scene format.
    Reader(AnyFinding),
    /// About a muscle.
    Muscle(muscle::Finding),
    /// A muscle on the bones of a skin lies outside of that skin, which does not follow it then.
    MuscleOutsideSkin,
    /// About an image.
    Image(ImageFinding),
    /// The clip that a muscle file names could not be opened; the muscles are shown without it.
    ClipNotOpened(Box<OpenError>),
}

impl ToMessage for Finding {
    fn message(&self) -> Message {
        match self {
            Self::Reader(finding) => finding.message(),
            Self::Muscle(finding) => finding.message(),
            Self::MuscleOutsideSkin => message!("document-muscle-outside-skin"),
            Self::Image(finding) => finding.message(),
            Self::ClipNotOpened(error) => message!("document-clip-not-opened", error = error.message()),
        }
    }
}

impl DiagnosticKind for Finding {
    fn code(&self) -> &'static str {
        match self {
            Self::Reader(finding) => finding.code(),
            Self::Muscle(finding) => finding.code(),
            Self::MuscleOutsideSkin => "muscle-outside-skin",
            Self::Image(finding) => finding.code(),
            Self::ClipNotOpened(_) => "clip-not-opened",
        }
    }

    fn severity(&self) -> Severity {
        match self {
            Self::Reader(finding) => finding.severity(),
            Self::Muscle(finding) => finding.severity(),
            Self::MuscleOutsideSkin => Severity::Info,
            Self::Image(finding) => finding.severity(),
            Self::ClipNotOpened(_) => Severity::Warning,
        }
    }
}

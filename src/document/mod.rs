//! Any file to a document, and a document to a frame.

use std::path::{Path, PathBuf};

use crate::animation::Clip;
use crate::collada::{Asset, Progress};
use crate::health::Finding;
use crate::muscle::{Drive, MuscleFile, Rig};
use crate::scene::{Frame, MuscleId, NodeId, Scene};

/// Where a document's parts came from.
#[derive(Debug, Clone)]
pub struct Source {
    /// The name that messages use: the path as the user gave it.
    pub name: String,
    /// The file; `None` for standard input and the built-in scene.
    pub path: Option<PathBuf>,
    /// The root of its nodes.
    pub root: Option<NodeId>,
    /// What kind of file, with what only that kind has.
    pub kind: SourceKind,
}

/// What kind of file a source is.
#[derive(Debug, Clone)]
pub enum SourceKind {
    /// COLLADA.
    Collada(Asset),
    /// Muscles: what the file said, and where it stands in the scene.
    Muscles(Box<MuscleFile>, Rig),
}

/// What stands in the way of a moving picture, told plainly in the window.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Missing {
    /// No mesh.
    Mesh,
    /// No skeleton.
    Skeleton,
    /// No animation.
    Animation,
}

/// One open scene: files side by side in one graph.
#[derive(Debug, Clone, Default)]
pub struct Document {
    /// The scene at rest.
    pub scene: Scene,
    /// The files it was made from.
    pub sources: Vec<Source>,
    /// All clips.
    pub clips: Vec<Clip>,
    /// All findings, by file and line.
    pub health: Vec<Finding>,
}

/// The values that choose a moment.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PoseState {
    /// Index in [`Document::clips`]; `None` = rest pose.
    pub clip: Option<usize>,
    /// Seconds on the file's own time axis.
    pub time: f64,
    /// Elbow angle and contraction.
    pub drive: Drive,
}

/// Buffers that posing uses again and again.
#[derive(Debug, Clone, Default)]
pub struct PoseBuffers {}

/// Why a file could not be used. Displays as one line: `file:line:column: what`.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{}", self.sentence())]
pub struct OpenError {
    /// The file, as the user named it.
    pub file: String,
    /// Line from 1.
    pub line: Option<u32>,
    /// Column from 1.
    pub column: Option<u32>,
    /// What is wrong and what would be right.
    pub message: String,
}

impl OpenError {
    fn sentence(&self) -> String {
        use std::fmt::Write;
        let mut text = self.file.clone();
        for number in [self.line, self.column].into_iter().flatten() {
            // Writing to a string cannot fail.
            let _ = write!(text, ":{number}");
        }
        let _ = write!(text, ": {}", self.message);
        text
    }
}

impl Document {
    /// Opens files into one document: `.dae`, `.zae`, `.yaml`, `.yml`; told apart by content where the ending says nothing. `-` is standard input.
    ///
    /// # Errors
    /// [`OpenError`] for the first file that cannot be used.
    pub fn open<P: AsRef<Path>>(files: &[P], progress: &Progress) -> Result<Self, OpenError> {
        let _ = (files, progress);
        Ok(Self::default())
    }

    /// The scene that is shown when no file is given.
    pub fn built_in() -> Self {
        Self::default()
    }

    /// Poses the document: fills `frame` for the moment that `state` names. Never fails: what is out of range is held at the limit.
    pub fn pose(&self, state: &PoseState, buffers: &mut PoseBuffers, frame: &mut Frame) {
        let _ = (state, buffers, frame);
    }

    /// What stands in the way of a moving picture; empty where something moves or a muscle can be driven.
    pub fn missing(&self) -> Vec<Missing> {
        Vec::new()
    }

    /// The state to start with: first clip at its start, straight arm.
    pub fn start_state(&self) -> PoseState {
        PoseState::default()
    }

    /// The rigs with their first muscle's id.
    pub fn rigs(&self) -> impl Iterator<Item = (&Rig, MuscleId)> {
        let mut first = 0;
        self.sources.iter().filter_map(move |source| match &source.kind {
            SourceKind::Muscles(_, rig) => {
                let id = MuscleId(first);
                first += rig.len() as u32;
                Some((rig, id))
            }
            SourceKind::Collada(_) => None,
        })
    }

    /// The rig that the sliders drive: the first one.
    pub fn driven_rig(&self) -> Option<&Rig> {
        self.rigs().next().map(|(rig, _)| rig)
    }
}

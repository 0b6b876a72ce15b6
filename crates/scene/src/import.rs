//! What every reader of scene files gives, so that a program knows a format by one line.

use std::fmt;
use std::path::PathBuf;
use std::sync::Arc;

use crate::Scene;
use crate::animation::Clip;
use crate::diagnostics::{Diagnostic, DiagnosticKind, Severity};
use crate::limits;
use crate::message::{Message, ToMessage};
use crate::progress::Progress;

/// What a file says of itself.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Asset {
    /// The name of the format: `COLLADA`.
    pub format: &'static str,
    /// Its version: `1.4.1`.
    pub version: String,
    /// The tool that wrote it; empty where the file is silent.
    pub authoring_tool: String,
    /// `X_UP`, `Y_UP` or `Z_UP`.
    pub up_axis: String,
    /// Metres a unit.
    pub unit_metres: f64,
}

/// Everything read from one file, with the findings `F` of its reader. Its graph has one root, the asset node.
#[derive(Debug, Clone)]
pub struct ImportedScene<F> {
    /// What the file says of itself.
    pub asset: Asset,
    /// The scene; images have no pixels yet.
    pub scene: Scene,
    /// The clips, at least one where anything moves.
    pub clips: Vec<Clip>,
    /// Oddities, in file order.
    pub findings: Vec<Diagnostic<F>>,
    /// Image files that are in the file itself, by the path that the scene names them by.
    pub archived: Vec<(PathBuf, Vec<u8>)>,
}

/// A finding of any reader.
#[derive(Clone)]
pub struct AnyFinding(Arc<dyn DiagnosticKind + Send + Sync>);

/// Why a reader of any format could not use a file at all, and where in it.
#[derive(Clone)]
pub struct ImportError {
    /// Line from 1, where one can be named.
    pub line: Option<u32>,
    reason: Arc<dyn ToMessage + Send + Sync>,
}

/// A reader of one format of scene files.
pub trait SceneReader: Sync {
    /// The name of the format: `COLLADA`.
    fn format(&self) -> &'static str;

    /// The endings of its files, in small letters, without the dot.
    fn extensions(&self) -> &'static [&'static str];

    /// Whether a file begins as files of the format do, for those whose ending says nothing.
    fn sniff(&self, bytes: &[u8]) -> bool;

    /// Largest file that is read, bytes.
    fn limit(&self) -> u64 {
        limits::FILE_BYTES
    }

    /// Reads a file. `name` is that of the file: it stands on the root node, and tells references to the file itself from those to others.
    ///
    /// # Errors
    /// [`ImportError`] where nothing of the file can be shown.
    fn read(&self, bytes: &[u8], name: &str, progress: &Progress) -> Result<ImportedScene<AnyFinding>, ImportError>;
}

/// Whether a file begins as XML does, in UTF-8 or UTF-16: what readers of formats in XML have in common.
pub fn starts_as_xml(bytes: &[u8]) -> bool {
    let start = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    let is_utf16 = [&b"\xFF\xFE"[..], b"\xFE\xFF", b"\0<", b"<\0"].iter().any(|mark| bytes.starts_with(mark));
    start.iter().find(|byte| !byte.is_ascii_whitespace()) == Some(&b'<') || is_utf16
}

impl<F: DiagnosticKind + Send + Sync + 'static> ImportedScene<F> {
    /// The same with findings whose reader is forgotten.
    pub fn with_any_finding(self) -> ImportedScene<AnyFinding> {
        let Self { asset, scene, clips, findings, archived } = self;
        let findings = findings.into_iter().map(|found| found.map(|finding| AnyFinding(Arc::new(finding)))).collect();
        ImportedScene { asset, scene, clips, findings, archived }
    }
}

impl ToMessage for AnyFinding {
    fn message(&self) -> Message {
        self.0.message()
    }
}

impl DiagnosticKind for AnyFinding {
    fn code(&self) -> &'static str {
        self.0.code()
    }

    fn severity(&self) -> Severity {
        self.0.severity()
    }
}

/// Findings of the same code that say the same are the same.
impl PartialEq for AnyFinding {
    fn eq(&self, other: &Self) -> bool {
        self.code() == other.code() && self.message() == other.message()
    }
}

impl fmt::Debug for AnyFinding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.code(), self.message())
    }
}

impl ImportError {
    /// An error for this reason, in a line that can be named or not.
    pub fn new(line: Option<u32>, reason: impl ToMessage + Send + Sync + 'static) -> Self {
        Self { line, reason: Arc::new(reason) }
    }
}

impl ToMessage for ImportError {
    fn message(&self) -> Message {
        self.reason.message()
    }
}

impl PartialEq for ImportError {
    fn eq(&self, other: &Self) -> bool {
        self.line == other.line && self.message() == other.message()
    }
}

impl fmt::Debug for ImportError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {:?}: {}", self.line, self.message())
    }
}

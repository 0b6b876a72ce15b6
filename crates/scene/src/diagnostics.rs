//! What readers report: findings add up instead of stopping the reading.

use crate::OwnedLabel;
use crate::message::{Message, SourceName, ToMessage};

/// How much a finding matters to the person who looks at the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// Something is not supported or was repaired; the picture is as the file means it.
    Info,
    /// The picture may differ from what the author meant.
    Warning,
}

/// A kind of finding with its parameters: the enum of a reader.
pub trait DiagnosticKind: ToMessage {
    /// Stable, kebab-case, documented in the README: `index-out-of-range`.
    fn code(&self) -> &'static str;

    /// How much it matters.
    fn severity(&self) -> Severity;
}

/// A finding `F` in a file: what, where, and how often.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagnostic<F> {
    /// What was seen and what was done about it.
    pub finding: F,
    /// The file it was found in; unknown until the document knows.
    pub file: SourceName,
    /// Line in that file, from 1; `None` where no line can be named.
    pub line: Option<u32>,
    /// The element it speaks of, such as `<skin> "Body-skin"`; empty where none fits.
    pub element: OwnedLabel,
    /// In how many more places of the file the same was found.
    pub more_places: usize,
}

impl<F> Diagnostic<F> {
    /// A finding in a file whose name the document adds.
    pub fn new(finding: F, line: Option<u32>, element: impl Into<OwnedLabel>) -> Self {
        Self { finding, file: SourceName::Unknown, line, element: element.into(), more_places: 0 }
    }

    /// The same in a file.
    pub fn in_file(self, file: impl Into<SourceName>) -> Self {
        Self { file: file.into(), ..self }
    }

    /// The same with another type of finding, such as one that holds those of several readers.
    pub fn map<G>(self, into: impl FnOnce(F) -> G) -> Diagnostic<G> {
        let Self { finding, file, line, element, more_places } = self;
        Diagnostic { finding: into(finding), file, line, element, more_places }
    }
}

impl<F: DiagnosticKind> Diagnostic<F> {
    /// The stable code of the finding.
    pub fn code(&self) -> &'static str {
        self.finding.code()
    }

    /// How much it matters.
    pub fn severity(&self) -> Severity {
        self.finding.severity()
    }

    /// What was seen and done, without the place.
    pub fn message(&self) -> Message {
        self.finding.message()
    }
}

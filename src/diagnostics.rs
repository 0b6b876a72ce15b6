//! What readers report: findings add up instead of stopping the reading.

use std::fmt;

/// How much a finding matters to the person who looks at the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// Something is not supported or was repaired; the picture is as the file means it.
    Note,
    /// The picture may differ from what the author meant.
    Warning,
}

/// One oddity in a file: what, where, and what was done about it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Diagnostic {
    /// Stable, kebab-case, documented in the README: `index-out-of-range`.
    pub code: &'static str,
    /// How much it matters.
    pub severity: Severity,
    /// The file it was found in, as the user named it; empty until the document knows.
    pub file: String,
    /// Line in that file, from 1; `None` where no line can be named.
    pub line: Option<u32>,
    /// The element it speaks of, such as `<skin> "Body-skin"`; empty where none fits.
    pub element: String,
    /// What was seen and what was done, one sentence in the user's language.
    pub message: String,
}

impl Diagnostic {
    /// A finding of severity [`Severity::Warning`] without a file name, which the document adds.
    pub fn warning(code: &'static str, line: Option<u32>, element: impl Into<String>, message: impl Into<String>) -> Self {
        Self { code, severity: Severity::Warning, file: String::new(), line, element: element.into(), message: message.into() }
    }

    /// The same with severity [`Severity::Note`].
    pub fn note(code: &'static str, line: Option<u32>, element: impl Into<String>, message: impl Into<String>) -> Self {
        Self { severity: Severity::Note, ..Self::warning(code, line, element, message) }
    }
}

impl fmt::Display for Diagnostic {
    /// `file:line: element: message [code]`, leaving out what is not known.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.file.is_empty() {
            write!(f, "{}", self.file)?;
            if let Some(line) = self.line {
                write!(f, ":{line}")?;
            }
            write!(f, ": ")?;
        }
        if !self.element.is_empty() {
            write!(f, "{}: ", self.element)?;
        }
        write!(f, "{} [{}]", self.message, self.code)
    }
}

//! Collects findings and knows the line of every byte.

use std::cell::OnceCell;

use memchr::memchr_iter;
use roxmltree::NodeId as ElementId;
use rustc_hash::FxHashSet;

use super::lists::Shortened;
use super::{El, codes};
use crate::health::{Finding, Severity};
use crate::{limits, tr};

/// Findings about one document, with their lines.
pub struct Report<'a> {
    document: &'a Shortened<'a>,
    lines_before: u32,
    /// Where each line ends; made when the first line is asked for.
    line_ends: OnceCell<Vec<u32>>,
    findings: Vec<Finding>,
    /// What was said of which element, so that nothing is said twice of what is read twice.
    said: FxHashSet<(ElementId, &'static str, String)>,
    dropped: usize,
}

impl<'a> Report<'a> {
    /// An empty report about `document`, which `lines_before` blank lines precede in the file.
    pub fn new(document: &'a Shortened<'a>, lines_before: u32) -> Self {
        Self { document, lines_before, line_ends: OnceCell::new(), findings: Vec::new(), said: FxHashSet::default(), dropped: 0 }
    }

    /// The line of an element, from 1.
    pub fn line(&self, element: El<'_>) -> u32 {
        self.line_of(self.document.place(element.range().start))
    }

    /// The line of a byte of the whole document, from 1.
    pub fn line_of(&self, at: usize) -> u32 {
        let ends = self.line_ends.get_or_init(|| memchr_iter(b'\n', self.document.whole().as_bytes()).map(|at| at as u32).collect());
        ends.partition_point(|end| (*end as usize) < at) as u32 + 1 + self.lines_before
    }

    /// Something that may make the picture differ from what the author meant.
    pub fn warn(&mut self, element: El<'_>, code: &'static str, message: String) {
        self.add(Some(element), code, Severity::Warning, message);
    }

    /// Something that was put right.
    pub fn note(&mut self, element: El<'_>, code: &'static str, message: String) {
        self.add(Some(element), code, Severity::Note, message);
    }

    /// Something that was put right at a byte of the whole document.
    pub fn note_at(&mut self, at: usize, code: &'static str, message: String) {
        self.findings.push(Finding {
            code,
            severity: Severity::Note,
            file: String::new(),
            line: Some(self.line_of(at)),
            element: String::new(),
            message,
        });
    }

    /// A warning about the file as a whole.
    pub fn warn_file(&mut self, code: &'static str, message: String) {
        self.add(None, code, Severity::Warning, message);
    }

    fn add(&mut self, element: Option<El<'_>>, code: &'static str, severity: Severity, message: String) {
        if self.findings.len() >= limits::FINDINGS {
            self.dropped += 1;
            return;
        }
        if let Some(element) = element
            && !self.said.insert((element.id(), code, message.clone()))
        {
            return;
        }
        let line = element.map(|element| self.line(element));
        let element = element.map_or_else(String::new, describe);
        self.findings.push(Finding { code, severity, file: String::new(), line, element, message });
    }

    /// All findings, in file order.
    pub fn finish(&mut self) -> Vec<Finding> {
        if self.dropped > 0 {
            let message = tr!("collada-more-findings", count = self.dropped, limit = limits::FINDINGS);
            self.dropped = 0;
            self.findings.push(Finding::note(codes::MORE_FINDINGS, None, "", message));
        }
        self.findings.sort_by_key(|finding| finding.line.unwrap_or(u32::MAX));
        std::mem::take(&mut self.findings)
    }
}

/// An element as messages name it: `<skin> "Body"`, by its id, name or sid or those of the nearest element above that has one.
pub fn describe(element: El<'_>) -> String {
    let own = element.tag_name().name();
    for above in element.ancestors().filter(El::is_element) {
        if let Some(name) = ["id", "name", "sid"].iter().find_map(|key| above.attribute(*key)).filter(|name| !name.is_empty()) {
            let name: String = name.chars().take(80).collect();
            return if above == element {
                format!("<{own}> \"{name}\"")
            } else {
                format!("<{own}> in <{}> \"{name}\"", above.tag_name().name())
            };
        }
    }
    format!("<{own}>")
}

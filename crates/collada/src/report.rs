//! Collects findings and knows the line of every byte.

use std::cell::OnceCell;

use memchr::memchr_iter;
use roxmltree::NodeId as ElementId;
use rustc_hash::{FxHashMap, FxHashSet};

use super::bundle::DocumentSpan;
use super::list_extraction::Shortened;
use super::{El, Finding, diagnostic_codes};
use sinew_scene::diagnostics::{Diagnostic, DiagnosticKind};
use sinew_scene::limits;
use sinew_scene::message::ToMessage;

/// Findings that have one cause however many elements they are met at, as long as they say the same: they are told once, with how often.
const ONCE: [&str; 13] = [
    diagnostic_codes::REPEATED_ID,
    diagnostic_codes::BROKEN_REFERENCE,
    diagnostic_codes::EXTERNAL_REFERENCE,
    diagnostic_codes::UNSUPPORTED_GEOMETRY,
    diagnostic_codes::JOINT_NOT_FOUND,
    diagnostic_codes::BIND_POSE_MISMATCH,
    diagnostic_codes::UNBOUND_MATERIAL,
    diagnostic_codes::TEXTURE_NOT_FOUND,
    diagnostic_codes::NO_COMMON_PROFILE,
    diagnostic_codes::TRANSPARENCY_INVERTED,
    diagnostic_codes::UNSUPPORTED_INTERPOLATION,
    diagnostic_codes::MISSING_TANGENTS,
    diagnostic_codes::SHEARED_KEYS,
];

/// Findings about one document, with their lines.
pub(super) struct Report<'a> {
    document: &'a Shortened<'a>,
    lines_before: u32,
    /// The documents behind the first one, in their order.
    parts: Vec<DocumentSpan>,
    /// Where each line ends; made when the first line is asked for.
    line_ends: OnceCell<Vec<u32>>,
    findings: Vec<Diagnostic<Finding>>,
    /// What was said of which element, so that nothing is said twice of what is read twice.
    said: FxHashSet<(ElementId, String)>,
    /// Where in `findings` what is told once a file stands, and how often it was met since.
    once: FxHashMap<String, (usize, usize)>,
    /// The entries of the libraries of which a wrong count was told.
    counts: FxHashSet<ElementId>,
    dropped: usize,
}

impl<'a> Report<'a> {
    /// An empty report about `document`, which `lines_before` blank lines precede in the file.
    pub(super) fn new(document: &'a Shortened<'a>, lines_before: u32, parts: Vec<DocumentSpan>) -> Self {
        Self {
            document,
            lines_before,
            parts,
            line_ends: OnceCell::new(),
            findings: Vec::new(),
            said: FxHashSet::default(),
            once: FxHashMap::default(),
            counts: FxHashSet::default(),
            dropped: 0,
        }
    }

    /// The line of an element, from 1.
    pub(super) fn line(&self, element: El<'_>) -> u32 {
        self.line_of(self.document.place(element.range().start))
    }

    /// The line of a byte of the whole document, from 1.
    pub(super) fn line_of(&self, at: usize) -> u32 {
        let ends = self.line_ends.get_or_init(|| memchr_iter(b'\n', self.document.whole().as_bytes()).map(|at| at as u32).collect());
        let line = ends.partition_point(|end| (*end as usize) < at) as u32 + 1 + self.lines_before;
        let later = self.part(at).map_or(0, |part| part.lines);
        u32::try_from(i64::from(line) - later).unwrap_or(line)
    }

    /// The document behind the first one that a byte of the whole belongs to, if it does.
    fn part(&self, at: usize) -> Option<&DocumentSpan> {
        self.parts.get(..self.parts.partition_point(|part| part.start <= at))?.last()
    }

    /// Takes in what was found before there was a document.
    pub(super) fn bring(&mut self, findings: Vec<Diagnostic<Finding>>) {
        self.findings.extend(findings);
    }

    /// Something about an element.
    pub(super) fn report(&mut self, element: El<'_>, finding: Finding) {
        self.add(Some(element), finding);
    }

    /// Something about the file as a whole.
    pub(super) fn report_file(&mut self, finding: Finding) {
        self.add(None, finding);
    }

    /// Something at a byte of the whole document, however often the same was reported.
    pub(super) fn report_at(&mut self, at: usize, finding: Finding) {
        let file = self.part(at).map_or_else(String::new, |part| part.path.clone());
        self.findings.push(Diagnostic::new(finding, Some(self.line_of(at)), "").in_file(file));
    }

    /// A `count` that says another number than the data hold; told once for all lists of a mesh, a controller or an animation.
    pub(super) fn wrong_count(&mut self, element: El<'_>, said: usize, found: usize) {
        let in_library = |above: &El<'_>| above.parent().is_some_and(|parent| parent.tag_name().name().starts_with("library_"));
        let entry = element.ancestors().find(in_library).unwrap_or(element);
        if self.counts.insert(entry.id()) {
            self.report(element, Finding::CountMismatch { said, found });
        }
    }

    fn add(&mut self, element: Option<El<'_>>, finding: Finding) {
        // Two findings say the same where their messages are equal, with numbers as they are shown.
        let message = finding.message().to_string();
        if let Some(element) = element
            && self.findings.len() < limits::FINDINGS
            && !self.said.insert((element.id(), message.clone()))
        {
            return;
        }
        if let Some(told) = self.once.get_mut(&message) {
            told.1 += 1;
            return;
        }
        if self.findings.len() >= limits::FINDINGS {
            self.dropped += 1;
            return;
        }
        if ONCE.contains(&finding.code()) {
            self.once.insert(message, (self.findings.len(), 0));
        }
        let line = element.map(|element| self.line(element));
        let part = element.and_then(|element| self.part(self.document.place(element.range().start)));
        let file = part.map_or_else(String::new, |part| part.path.clone());
        let element = element.map_or_else(String::new, describe);
        self.findings.push(Diagnostic::new(finding, line, element).in_file(file));
    }

    /// All findings, in file order.
    pub(super) fn finish(&mut self) -> Vec<Diagnostic<Finding>> {
        for (at, more) in std::mem::take(&mut self.once).into_values().filter(|(_, more)| *more > 0) {
            if let Some(finding) = self.findings.get_mut(at) {
                finding.more_places = more;
            }
        }
        if self.dropped > 0 {
            let finding = Finding::More(std::mem::take(&mut self.dropped));
            self.findings.push(Diagnostic::new(finding, None, ""));
        }
        self.findings.sort_by(|a, b| (&a.file, a.line.unwrap_or(u32::MAX)).cmp(&(&b.file, b.line.unwrap_or(u32::MAX))));
        std::mem::take(&mut self.findings)
    }
}

/// An element as messages name it: `<skin> "Body"`, by its id, name or sid or those of the nearest element above that has one.
pub(super) fn describe(element: El<'_>) -> String {
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

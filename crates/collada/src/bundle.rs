//! Documents of one archive that refer to each other, put together as one text.
//!
//! Each further document stands as it is, from its root element on, at the end of the first one's root element. So there is one tree, and an element
//! belongs to the document of the `COLLADA` element around it: ids, references, unit and axes are looked up there (see [`super::lookup`]).

use std::collections::{BTreeMap, BTreeSet, HashMap};

use super::image::plain_uri;
use super::lookup::last_segment;
use super::{Finding, ReadError, ReadErrorKind, decode_text, xml};
use sinew_scene::diagnostics::Diagnostic;

/// Longest text or attribute that is looked at for a reference, bytes.
const LONGEST: usize = 4096;

/// A further document.
#[derive(Debug)]
pub(super) struct BundledDocument {
    /// Its path in the archive.
    pub path: String,
    /// From its root element on.
    text: String,
    /// Lines of the file before that.
    lines_before: u32,
}

/// Where a document stands in the whole.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct DocumentSpan {
    /// Its first byte.
    pub start: usize,
    /// Its path in the archive.
    pub path: String,
    /// How many lines it comes later than in its own file.
    pub lines: i64,
}

/// What a document is read from.
#[derive(Debug, Default)]
pub(super) struct Bundle {
    /// The path of the first document: its file name, or its path in the archive.
    pub path: String,
    /// The documents behind it.
    pub parts: Vec<BundledDocument>,
    /// All files of the archive by their path; empty for a plain document.
    pub files: BTreeMap<String, usize>,
    /// What was wrong with documents that are not among `parts`.
    pub findings: Vec<Diagnostic<Finding>>,
}

impl Bundle {
    /// A document that comes alone.
    pub(super) fn alone(file_name: &str) -> Self {
        Self { path: file_name.to_owned(), ..Self::default() }
    }

    /// Takes in what `first` refers to, and what that refers to. `unpack` gives the bytes of a file of the archive; `room` is what reading may take.
    ///
    /// # Errors
    /// What `unpack` returns.
    pub(super) fn gather(
        &mut self,
        first: &str,
        room: usize,
        mut unpack: impl FnMut(usize) -> Result<Vec<u8>, ReadError>,
    ) -> Result<(), ReadError> {
        let files = Paths::new(self.files.iter().map(|(path, index)| (path.clone(), *index)));
        let Ok(mut wanted) = references(&files, first, &self.path, room) else {
            // The reader tells it better.
            return Ok(());
        };
        let mut known = BTreeSet::from([self.path.clone()]);
        while let Some((path, index)) = wanted.pop() {
            if !known.insert(path.clone()) {
                continue;
            }
            let bytes = unpack(index)?;
            let decoded = decode_text::decode(&bytes);
            let read = references(&files, &decoded.text, &path, room).and_then(|more| Ok((more, root(&decoded.text, room)?)));
            match read {
                Ok((more, start)) => {
                    let whole = decoded.text.as_ref();
                    let (head, body) = whole.split_at_checked(start).unwrap_or((whole, ""));
                    let lines_before = decoded.lines_before + head.bytes().filter(|byte| *byte == b'\n').count() as u32;
                    self.parts.push(BundledDocument { path, text: body.to_owned(), lines_before });
                    wanted.extend(more);
                }
                Err(error) => {
                    let line = error.line.map(|line| line + decoded.lines_before);
                    self.findings.push(Diagnostic::new(Finding::BrokenPart(error.kind), line, "").in_file(path));
                }
            }
        }
        Ok(())
    }

    /// The text of all documents and where each further one stands in it; `None` where there is only `first`.
    pub(super) fn compose(&mut self, first: &str, lines_before: u32) -> Option<(String, Vec<DocumentSpan>)> {
        if self.parts.is_empty() {
            return None;
        }
        let close = first.rfind("</")?;
        let mut text = String::with_capacity(first.len() + self.parts.iter().map(|part| part.text.len() + 1).sum::<usize>());
        text.push_str(first.get(..close)?);
        let mut stretches = Vec::new();
        let mut lines = first.get(..close)?.bytes().filter(|byte| *byte == b'\n').count() as i64 + i64::from(lines_before);
        for part in self.parts.drain(..) {
            text.push('\n');
            lines += 1;
            stretches.push(DocumentSpan { start: text.len(), path: part.path, lines: lines - i64::from(part.lines_before) });
            text.push_str(&part.text);
            lines += part.text.bytes().filter(|byte| *byte == b'\n').count() as i64;
        }
        text.push_str(first.get(close..)?);
        Some((text, stretches))
    }
}

/// The other documents that `text`, the document at `path`, names among `files`: with their index in the archive.
fn references(files: &Paths, text: &str, path: &str, room: usize) -> Result<Vec<(String, usize)>, ReadError> {
    let surveyed = xml::look_at(text, Some(room))?;
    let parsed = xml::parse(&surveyed)?;
    let mut found = BTreeMap::new();
    for node in parsed.document.descendants() {
        let texts = node.text().filter(|_| node.is_text()).into_iter();
        for value in node.attributes().map(|attribute| attribute.value()).chain(texts).filter(|value| value.len() <= LONGEST) {
            for word in value.split_whitespace() {
                let (file, fragment) = word.split_once('#').map_or((word, false), |(file, _)| (file, true));
                let names_document = fragment || file.to_ascii_lowercase().ends_with(".dae");
                if names_document
                    && !file.is_empty()
                    && let Some((entry, index)) = files.find(path, file)
                {
                    found.insert(entry.clone(), index);
                }
            }
        }
    }
    Ok(found.into_iter().collect())
}

/// Where the root element of a document begins that can stand in another one.
fn root(text: &str, room: usize) -> Result<usize, ReadError> {
    let surveyed = xml::look_at(text, Some(room))?;
    let parsed = xml::parse(&surveyed)?;
    let root = parsed.document.root_element();
    if root.tag_name().name() != "COLLADA" {
        return Err(ReadErrorKind::NotCollada(super::context::shortened(root.tag_name().name())).into());
    }
    let start = parsed.lists.place(root.range().start);
    // Entities are declared before the root, and would be lost.
    if text.get(..start).is_some_and(|head| head.contains("<!ENTITY")) {
        return Err(ReadErrorKind::PartWithEntities.into());
    }
    Ok(start)
}

/// Files by their path, and by their name where only one has it.
#[derive(Debug, Default)]
pub(super) struct Paths {
    by_path: BTreeMap<String, usize>,
    by_name: HashMap<String, Option<String>>,
}

impl Paths {
    /// An index of these paths, each with its number.
    pub(super) fn new(all: impl IntoIterator<Item = (String, usize)>) -> Self {
        let mut paths = Self::default();
        for (path, number) in all {
            let only = paths.by_name.entry(last_segment(&path).to_owned()).and_modify(|only| *only = None);
            only.or_insert_with(|| Some(path.clone()));
            paths.by_path.insert(path, number);
        }
        paths
    }

    /// The file that the document at `from` means by `reference`: relative to it, from the top of the archive, or the only file of that name.
    pub(super) fn find(&self, from: &str, reference: &str) -> Option<(&String, usize)> {
        let plain = plain_uri(reference);
        let folder = from.rsplit_once('/').map_or("", |(folder, _)| folder);
        let exact = |wanted: &str| self.by_path.get_key_value(wanted).map(|(path, number)| (path, *number));
        let only = || exact(self.by_name.get(last_segment(&plain))?.as_ref()?);
        exact(&normal(&format!("{folder}/{plain}"))).or_else(|| exact(&normal(&plain))).or_else(only)
    }
}

/// A path with slashes and without `.` and `..`.
pub(super) fn normal(path: &str) -> String {
    let mut parts: Vec<&str> = Vec::new();
    for part in path.split(['/', '\\']) {
        match part {
            "" | "." => {}
            ".." => {
                parts.pop();
            }
            part => parts.push(part),
        }
    }
    parts.join("/")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_made_plain() {
        assert_eq!(normal("./models/../images\\a.png"), "images/a.png");
        assert_eq!(normal("/../../a.dae"), "a.dae");
    }

    #[test]
    fn a_reference_means_the_file_beside_it_first_then_that_from_the_top_then_the_only_one_of_its_name() {
        let paths = Paths::new(["a.dae", "sub/a.dae", "sub/deep/b.dae", "sub/c.dae"].map(|path| (path.to_owned(), 0)));
        let means = |from, reference| paths.find(from, reference).map(|(path, _)| path.as_str());
        assert_eq!(means("sub/c.dae", "a.dae"), Some("sub/a.dae"));
        assert_eq!(means("c.dae", "./a.dae"), Some("a.dae"));
        assert_eq!(means("sub/c.dae", "sub/deep/b.dae"), Some("sub/deep/b.dae"));
        assert_eq!(means("a.dae", "file:///C:/work/b.dae"), Some("sub/deep/b.dae"));
        assert_eq!(means("a.dae", "elsewhere/a.dae"), None);
        assert_eq!(means("sub/deep/b.dae", "../c%2Edae"), Some("sub/c.dae"));
    }

    #[test]
    fn documents_follow_each_other_inside_the_root_and_know_their_lines() {
        let part = BundledDocument { path: "b.dae".into(), text: "<COLLADA>\n</COLLADA>\n".into(), lines_before: 3 };
        let mut bundle = Bundle { parts: vec![part], ..Bundle::alone("a.dae") };
        let (text, stretches) = bundle.compose("<COLLADA>\n<scene/>\n</COLLADA>\n", 1).unwrap_or_default();
        assert_eq!(text, "<COLLADA>\n<scene/>\n\n<COLLADA>\n</COLLADA>\n</COLLADA>\n");
        // The part begins in line 5 of the whole, with the blank line before, and in line 4 of its file.
        assert_eq!(stretches, [DocumentSpan { start: 20, path: "b.dae".into(), lines: 1 }]);
        assert!(bundle.compose("<COLLADA></COLLADA>", 0).is_none());
    }
}

//! What every part of the reader carries along: the document, its index, the findings, the budget.

use std::borrow::Cow;
use std::collections::BTreeMap;

use glam::{DMat4, DVec3};
use roxmltree::NodeId;
use rustc_hash::FxHashMap;

use super::bundle::normal;
use super::list_extraction::Shortened;
use super::lookup::{Lookup, Url};
use super::numbers::{Comma, ParsedNumbers, Real, attribute_number, integers, reals};
use super::parallel_lists::Ahead;
use super::report::{Report, describe};
use super::xml::ParsedDocument;
use super::{El, Finding, ReadError, ReadErrorKind};
use sinew_scene::affine;
pub(super) use sinew_scene::message::shortened;
use sinew_scene::progress::Progress;

/// The result of a step that may end the reading.
pub(super) type ReadResult<T> = Result<T, ReadError>;

/// The document with everything that reading it needs.
pub(super) struct Context<'a> {
    /// The root element.
    pub root: El<'a>,
    /// Ids and scoped ids.
    pub lookup: Lookup<'a>,
    /// The findings.
    pub report: Report<'a>,
    /// The files of the archive, by path.
    files: &'a BTreeMap<String, usize>,
    lists: &'a Shortened<'a>,
    ahead: &'a Ahead<'a>,
    progress: &'a Progress,
    /// Bytes that may still be made out of references, which cost the file little.
    budget: usize,
    said_budget: bool,
    said_comma: bool,
    said_drawn: bool,
    /// The `asset` of elements that were asked for theirs.
    assets: FxHashMap<NodeId, Option<NodeId>>,
}

impl<'a> Context<'a> {
    /// A context for a document that was parsed and of which some lists may be read `ahead`.
    /// `paths` are those of the document and of the ones behind it, `files` all of the archive.
    pub(super) fn new(
        parsed: &'a ParsedDocument<'a>,
        ahead: &'a Ahead<'a>,
        report: Report<'a>,
        paths: Vec<String>,
        files: &'a BTreeMap<String, usize>,
        progress: &'a Progress,
    ) -> Self {
        let document = &parsed.document;
        Self {
            root: document.root_element(),
            lookup: Lookup::new(document, paths),
            report,
            files,
            lists: parsed.lists,
            ahead,
            progress,
            budget: parsed.budget,
            said_budget: false,
            said_comma: false,
            said_drawn: false,
            assets: FxHashMap::default(),
        }
    }

    /// Says how far the reading is.
    ///
    /// # Errors
    /// [`ReadErrorKind::Cancelled`] where reading was cancelled.
    pub(super) fn advance(&self, part: f32) -> ReadResult<()> {
        self.progress.set_share(part);
        self.check_cancelled()
    }

    /// # Errors
    /// [`ReadErrorKind::Cancelled`] where reading was cancelled.
    pub(super) fn check_cancelled(&self) -> ReadResult<()> {
        if self.progress.is_cancelled() {
            return Err(ReadErrorKind::Cancelled.into());
        }
        Ok(())
    }

    /// Takes `bytes` from what references may make; `false`, with one finding for the file, where too little is left.
    pub(super) fn spend(&mut self, element: El<'_>, bytes: usize) -> bool {
        if let Some(left) = self.budget.checked_sub(bytes) {
            self.budget = left;
            return true;
        }
        if !self.said_budget {
            self.said_budget = true;
            self.report.report(element, Finding::SceneTooLarge);
        }
        false
    }

    /// Whether references may make no more, since [`Context::spend`] once found too little left.
    pub(super) fn is_spent(&self) -> bool {
        self.said_budget
    }

    /// Says once that instances are left out because drawing them would take too much.
    pub(super) fn say_once_drawn(&mut self, element: El<'_>) {
        if !std::mem::replace(&mut self.said_drawn, true) {
            self.report.report(element, Finding::InstancesTooLarge);
        }
    }

    /// The `asset` right below an element. A library or node may have many thousands of children and is asked for each of them, so it is remembered.
    pub(super) fn asset_of(&mut self, element: El<'a>) -> Option<El<'a>> {
        let found = *self.assets.entry(element.id()).or_insert_with(|| child(element, "asset").map(|asset| asset.id()));
        found.and_then(|id| element.document().get_node(id))
    }

    /// The element that `url` names, if its tag is one of `tags`; what doesn't lead there is reported at `from`.
    pub(super) fn resolve(&mut self, from: El<'a>, url: &str, tags: &[&str]) -> Option<El<'a>> {
        match self.lookup.url(from, url) {
            Url::Here { document, id } => {
                let found = self.lookup.in_document(from, document, &id, tags);
                if found.is_none() {
                    let finding = match self.lookup.in_document(from, document, &id, &[]) {
                        Some(other) => Finding::WrongReference { target: shortened(url), tag: other.tag_name().name().to_owned() },
                        None => Finding::BrokenReference(shortened(url)),
                    };
                    self.report.report(from, finding);
                }
                found
            }
            Url::External(file) => {
                self.report.report(from, Finding::ExternalReference(shortened(&file)));
                None
            }
        }
    }

    /// All libraries of a kind, those of the documents behind the first one last.
    pub(super) fn libraries(&self, tag: &str) -> Vec<El<'a>> {
        let roots = self.lookup.roots().iter().copied();
        roots.flat_map(|root| root.children().filter(move |library| library.tag_name().name() == tag)).collect()
    }

    /// The path in the archive of the file that `element` names by `uri`; `uri` where there is none.
    pub(super) fn in_archive(&self, element: El<'a>, uri: String) -> String {
        let folder = self.lookup.path(element).rsplit_once('/').map_or("", |(folder, _)| folder);
        let inside = normal(&format!("{folder}/{uri}"));
        if self.files.contains_key(&inside) { inside } else { uri }
    }

    /// [`Context::resolve`] with the url in attribute `key`; `None` without a finding where there is none.
    pub(super) fn follow(&mut self, from: El<'a>, key: &str, tags: &[&str]) -> Option<El<'a>> {
        let url = from.attribute(key)?;
        self.resolve(from, url, tags)
    }

    /// [`text_of`] an element that may hold a long list.
    pub(super) fn list_of(&self, element: El<'a>) -> Cow<'a, str> {
        match element.first_child().and_then(|text| self.lists.list_at(text.range().start)) {
            Some(list) => Cow::Borrowed(list),
            None => text_of(element),
        }
    }

    /// The numbers in an element's text; `expected` of them, if that is true.
    ///
    /// # Errors
    /// Where commas separate the numbers of the list.
    pub(super) fn reals<T: Real>(&mut self, element: El<'a>, expected: usize) -> ReadResult<Vec<T>> {
        let parsed = match self.ahead.take(element.id()) {
            Some(list) => list.map(ParsedNumbers::into_reals),
            None => reals(&self.list_of(element), expected),
        };
        self.checked(element, parsed)
    }

    /// The whole numbers in an element's text.
    ///
    /// # Errors
    /// Where commas stand in the list.
    pub(super) fn integers(&mut self, element: El<'a>) -> ReadResult<Vec<i32>> {
        let text = self.list_of(element);
        let parsed = integers(&text, text.len() / 4);
        self.checked(element, parsed)
    }

    fn checked<T>(&mut self, element: El<'a>, parsed: Result<ParsedNumbers<T>, Comma>) -> ReadResult<Vec<T>> {
        match parsed {
            Ok(parsed) => {
                if let Some(entry) = parsed.decimal_comma {
                    self.decimal_comma(element, &entry);
                }
                if let Some(first) = parsed.first_bad {
                    self.report.report(element, Finding::BadNumbers { count: parsed.bad, first });
                }
                Ok(parsed.values)
            }
            Err(comma) => {
                let start = element.first_child().map_or(element.range().start, |text| text.range().start);
                let line = self.report.line_of(self.lists.place(start) + comma.at);
                Err(ReadError::in_line(line, ReadErrorKind::CommaSeparated { element: describe(element), entry: comma.entry }))
            }
        }
    }

    /// Tells that numbers have decimal commas, once a file.
    pub(super) fn decimal_comma(&mut self, element: El<'_>, entry: &str) {
        if !std::mem::replace(&mut self.said_comma, true) {
            self.report.report(element, Finding::DecimalComma(shortened(entry)));
        }
    }

    /// The number in attribute `key`; `None` where it is missing or no finite number.
    pub(super) fn attribute(&mut self, element: El<'_>, key: &str) -> Option<f64> {
        let text = element.attribute(key)?;
        let (value, comma) = attribute_number(text)?;
        if comma {
            self.decimal_comma(element, text.trim());
        }
        Some(value)
    }

    /// Exactly `N` finite numbers in an element's text; reported and `None` where it is otherwise.
    ///
    /// # Errors
    /// Where commas separate the numbers of the list.
    pub(super) fn exactly<const N: usize>(&mut self, element: El<'a>) -> ReadResult<Option<[f64; N]>> {
        let values: Vec<f64> = self.reals(element, N)?;
        let Ok(values) = <[f64; N]>::try_from(values.as_slice()) else {
            self.report.report(element, Finding::BadTransform { wanted: N, found: values.len() });
            return Ok(None);
        };
        if !values.iter().all(|value| value.is_finite()) {
            self.report.report(element, Finding::NotFinite);
            return Ok(None);
        }
        Ok(Some(values))
    }

    /// The matrix in an element's text, which goes row by row; reported and `None` where it is none.
    ///
    /// # Errors
    /// Where commas separate the numbers of the list.
    pub(super) fn matrix(&mut self, element: El<'a>) -> ReadResult<Option<DMat4>> {
        let Some(rows) = self.exactly::<16>(element)? else { return Ok(None) };
        if !ends_upright(&rows) {
            self.report.report(element, Finding::BottomRow);
        }
        Ok(Some(from_rows(&rows)))
    }

    /// Whether a value is `finite`; tells where it is not.
    pub(super) fn finite(&mut self, element: El<'a>, finite: bool) -> bool {
        if !finite {
            self.report.report(element, Finding::NotFinite);
        }
        finite
    }

    /// The first finite number in the text of a child of `parent`; `None` where there is none.
    ///
    /// # Errors
    /// Where commas separate the numbers of the list.
    pub(super) fn number(&mut self, parent: El<'a>, tag: &str) -> ReadResult<Option<f64>> {
        match child(parent, tag) {
            Some(element) => {
                let value = self.reals::<f64>(element, 1)?.first().copied();
                Ok(value.filter(|value| self.finite(element, value.is_finite())))
            }
            None => Ok(None),
        }
    }
}

/// Numbers that go row by row as a matrix that places something in space: with a bottom row of 0 0 0 1.
pub(super) fn from_rows(rows: &[f64; 16]) -> DMat4 {
    affine(DMat4::from_cols_array(rows).transpose())
}

/// Whether the bottom row of a matrix that goes row by row is 0 0 0 1, but for what printing costs.
pub(super) fn ends_upright(rows: &[f64; 16]) -> bool {
    let [.., x, y, z, w] = rows;
    [x, y, z, &(w - 1.0)].iter().all(|value| value.abs() < 1e-4)
}

/// Three numbers as a vector.
pub(super) fn vector(values: [f64; 3]) -> DVec3 {
    DVec3::from_array(values)
}

/// The first child with this tag.
pub(super) fn child<'a>(parent: El<'a>, tag: &str) -> Option<El<'a>> {
    parent.children().find(|element| element.tag_name().name() == tag)
}

/// All children with this tag.
pub(super) fn children<'a>(parent: El<'a>, tag: &'static str) -> impl Iterator<Item = El<'a>> {
    parent.children().filter(move |element| element.tag_name().name() == tag)
}

/// An element's text; comments in it cut it into pieces, which are put together.
pub(super) fn text_of(element: El<'_>) -> Cow<'_, str> {
    let mut pieces = element.children().filter(El::is_text).filter_map(|node| node.text());
    let Some(first) = pieces.next() else { return Cow::Borrowed("") };
    match pieces.next() {
        None => Cow::Borrowed(first),
        Some(second) => {
            let mut text = format!("{first} {second}");
            for piece in pieces {
                text.push(' ');
                text.push_str(piece);
            }
            Cow::Owned(text)
        }
    }
}

/// What a file calls an element: its name, else its id or scoped id; empty where it has none of them.
pub(super) fn name_of(element: El<'_>) -> String {
    let name = ["name", "id", "sid"].iter().find_map(|key| element.attribute(*key).filter(|name| !name.trim().is_empty()));
    name.unwrap_or_default().to_owned()
}

/// The id of an element; empty where it has none.
pub(super) fn id_of(element: El<'_>) -> String {
    element.attribute("id").unwrap_or_default().to_owned()
}

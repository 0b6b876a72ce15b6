//! Finds elements by id and by scoped id, and takes urls apart.

use std::borrow::Cow;
use std::cell::RefCell;
use std::collections::hash_map::Entry;
use std::collections::{HashMap, HashSet};

use roxmltree::NodeId;

use super::El;
use super::bundle::Paths;

/// So many elements of one scoped id are looked at for the one that lies nearest; all but the strangest files have a handful.
const NEAREST_OF: usize = 4_096;

/// What a url names.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Url<'a> {
    /// An id in one of the documents at hand, by its number.
    Here {
        /// 0 is the first document.
        document: u32,
        /// The id.
        id: Cow<'a, str>,
    },
    /// Another document.
    External(Cow<'a, str>),
}

/// The ids and scoped ids of a document, and of those that stand in it (see [`super::bundle`]).
pub(super) struct Lookup<'a> {
    document: &'a roxmltree::Document<'a>,
    /// The root of each document.
    roots: Vec<El<'a>>,
    /// The path of each.
    paths: Vec<String>,
    /// The numbers of the documents by their paths.
    known: Paths,
    ids: HashMap<Id<'a>, NodeId>,
    /// Ids that several elements have.
    several: HashSet<Id<'a>>,
    /// Where a reference had to choose between several: the first element of each such id.
    met: RefCell<HashSet<NodeId>>,
    /// All elements of one tag with an id that several elements have, in document order.
    repeats: HashMap<(Id<'a>, &'a str), Vec<NodeId>>,
    /// The first child of an element with a scoped id.
    children: HashMap<(NodeId, &'a str), NodeId>,
    /// Elements by scoped id, in document order.
    sids: HashMap<&'a str, Vec<NodeId>>,
    found: HashMap<(NodeId, String), Option<NodeId>>,
}

/// An id with the number of its document.
type Id<'a> = (u32, &'a str);

impl<'a> Lookup<'a> {
    /// Indexes `document`; `paths` are those of the first document and of the ones that stand at its end.
    pub(super) fn new(document: &'a roxmltree::Document<'a>, paths: Vec<String>) -> Self {
        let first = document.root_element();
        let nested: Vec<El<'a>> = first.children().filter(|child| child.tag_name().name() == "COLLADA").collect();
        let parts = nested.len().saturating_sub(paths.len().saturating_sub(1));
        let mut lookup = Self {
            document,
            roots: std::iter::once(first).chain(nested.into_iter().skip(parts)).collect(),
            known: Paths::new(paths.iter().cloned().zip(0..)),
            paths,
            met: RefCell::default(),
            ids: HashMap::new(),
            several: HashSet::new(),
            repeats: HashMap::new(),
            children: HashMap::new(),
            sids: HashMap::new(),
            found: HashMap::new(),
        };
        // What stands under `extra` belongs to one program and must not hide the document's own ids.
        let mut extra_end = 0;
        let mut later = Vec::new();
        for element in document.descendants().filter(El::is_element) {
            let range = element.range();
            if range.start >= extra_end && element.tag_name().name() == "extra" {
                extra_end = range.end;
            }
            for attribute in element.attributes() {
                match attribute.name() {
                    "id" if range.start < extra_end => later.push(((lookup.document_of(element), attribute.value()), element.id())),
                    "id" => lookup.add((lookup.document_of(element), attribute.value()), element),
                    "sid" => {
                        lookup.sids.entry(attribute.value()).or_default().push(element.id());
                        if let Some(parent) = element.parent() {
                            lookup.children.entry((parent.id(), attribute.value())).or_insert(element.id());
                        }
                    }
                    _ => {}
                }
            }
        }
        for (id, element) in later {
            lookup.ids.entry(id).or_insert(element);
        }
        lookup
    }

    /// The root of each document.
    pub(super) fn roots(&self) -> &[El<'a>] {
        &self.roots
    }

    /// The path of the document of an element.
    pub(super) fn path(&self, element: El<'a>) -> &str {
        self.paths.get(self.document_of(element) as usize).map_or("", String::as_str)
    }

    /// The number of the document of an element. The further ones stand one after the other at the end.
    fn document_of(&self, element: El<'a>) -> u32 {
        let parts = self.roots.get(1..).unwrap_or_default();
        parts.partition_point(|part| part.range().start <= element.range().start) as u32
    }

    fn add(&mut self, id: Id<'a>, element: El<'a>) {
        match self.ids.entry(id) {
            Entry::Vacant(free) => {
                free.insert(element.id());
            }
            Entry::Occupied(first) => {
                let first = *first.get();
                if self.several.insert(id)
                    && let Some(first) = self.document.get_node(first)
                {
                    self.repeats.entry((id, first.tag_name().name())).or_default().push(first.id());
                }
                self.repeats.entry((id, element.tag_name().name())).or_default().push(element.id());
            }
        }
    }

    /// Elements whose id was taken already, where a reference had to choose between them and others.
    pub(super) fn repeated(&self) -> Vec<El<'a>> {
        let met = self.met.borrow();
        let later = |((id, _), all): (&(Id<'a>, &'a str), &Vec<NodeId>)| {
            let first = self.ids.get(id).copied();
            all.iter().copied().filter(move |element| Some(*element) != first).collect::<Vec<_>>()
        };
        let mut repeated: Vec<NodeId> =
            self.repeats.iter().filter(|((id, _), _)| self.ids.get(id).is_some_and(|first| met.contains(first))).flat_map(later).collect();
        repeated.sort_unstable_by_key(|id| id.get());
        repeated.into_iter().filter_map(|id| self.document.get_node(id)).collect()
    }

    /// The first element with this id in the document of `from` whose tag is one of `tags`; with no tags, the first at all. Tried as written, then
    /// percent-decoded.
    pub(super) fn by_id(&self, from: El<'a>, id: &str, tags: &[&str]) -> Option<El<'a>> {
        let document = self.document_of(from);
        decoded(id, |id| {
            self.note_choice((document, id), tags);
            self.by_exact_id((document, id), tags)
        })
    }

    /// [`Lookup::by_id`] as `from` means it: where several elements have the id, the one that shares the innermost element with `from`, the first
    /// among equals. Files put together from others repeat the ids of sources; each mesh and each sampler means its own.
    pub(super) fn by_id_near(&self, from: El<'a>, id: &str, tags: &[&str]) -> Option<El<'a>> {
        self.in_document(from, self.document_of(from), id, tags)
    }

    /// [`Lookup::by_id_near`] in a document of this number.
    pub(super) fn in_document(&self, from: El<'a>, document: u32, id: &str, tags: &[&str]) -> Option<El<'a>> {
        decoded(id, |id| {
            let id = (document, id);
            if !self.several.contains(&id) {
                return self.by_exact_id(id, tags);
            }
            let near = || {
                let inside =
                    |around: El<'a>| tags.iter().find_map(|tag| Some((around, self.within(around, self.repeats.get(&(id, *tag))?)?)));
                from.ancestors().find_map(inside)
            };
            match near() {
                // Alone in the innermost element around both: nobody could mean another.
                Some((around, found)) if self.is_alone(around, id, tags) => Some(found),
                found => {
                    self.note_choice(id, tags);
                    found.map(|(_, found)| found).or_else(|| self.by_exact_id(id, tags))
                }
            }
        })
    }

    /// Whether `around` is less than the document and holds one element with this id and one of these tags.
    fn is_alone(&self, around: El<'a>, id: (u32, &str), tags: &[&str]) -> bool {
        let range = around.range();
        let inside = |all: &Vec<NodeId>| {
            let from = all.partition_point(|id| self.start(*id) <= range.start);
            all.get(from..).unwrap_or_default().iter().take(2).filter(|id| self.start(**id) < range.end).count()
        };
        !self.roots.contains(&around) && tags.iter().filter_map(|tag| self.repeats.get(&(id, *tag))).map(inside).sum::<usize>() == 1
    }

    /// Notes an id of which there are several of the right kind.
    fn note_choice(&self, id: (u32, &str), tags: &[&str]) {
        let fitting = |tag: &&str| self.repeats.get(&(id, *tag)).map_or(0, Vec::len);
        if self.several.contains(&id) && tags.iter().map(fitting).sum::<usize>() > 1 {
            self.met.borrow_mut().extend(self.ids.get(&id));
        }
    }

    fn by_exact_id(&self, id: (u32, &str), tags: &[&str]) -> Option<El<'a>> {
        let first = self.ids.get(&id).and_then(|id| self.document.get_node(*id))?;
        if tags.is_empty() || tags.contains(&first.tag_name().name()) {
            return Some(first);
        }
        let firsts = tags.iter().filter_map(|tag| self.repeats.get(&(id, *tag))?.first().copied());
        firsts.min_by_key(|id| id.get()).and_then(|id| self.document.get_node(id))
    }

    /// The first of `all`, which are in document order, that is inside `around`.
    fn within(&self, around: El<'a>, all: &[NodeId]) -> Option<El<'a>> {
        let from = all.partition_point(|id| self.start(*id) <= around.range().start);
        let found = all.get(from).filter(|id| self.start(**id) < around.range().end)?;
        self.document.get_node(*found)
    }

    /// Where an element begins.
    fn start(&self, id: NodeId) -> usize {
        self.document.get_node(id).map_or(usize::MAX, |node| node.range().start)
    }

    /// Takes a url in `from` apart. A url that names a document at hand leads there; one without `#` that is an id here is taken for one.
    pub(super) fn url<'u>(&self, from: El<'a>, url: &'u str) -> Url<'u> {
        let url = url.trim();
        let here = |id: &'u str| Url::Here { document: self.document_of(from), id: Cow::Borrowed(id) };
        match url.split_once('#') {
            Some(("", id)) => here(id),
            Some((file, id)) => match self.document_named(from, file) {
                Some(document) => Url::Here { document, id: Cow::Borrowed(id) },
                None => Url::External(Cow::Borrowed(file)),
            },
            None if url.to_ascii_lowercase().ends_with(".dae") && self.by_id(from, url, &[]).is_none() => Url::External(Cow::Borrowed(url)),
            None => here(url),
        }
    }

    /// The document at hand that `from` means by a file; a plain document is known by its name alone.
    fn document_named(&self, from: El<'a>, file: &str) -> Option<u32> {
        if let [path] = self.paths.as_slice() {
            let name = last_segment(path);
            return (last_segment(&percent_decoded(file)) == name && !name.is_empty()).then_some(0);
        }
        self.known.find(self.path(from), file).map(|(_, document)| document as u32)
    }

    /// The element with scoped id `sid` that lies nearest below `element`, the first in document order among equals.
    pub(super) fn by_sid(&mut self, element: El<'a>, sid: &str) -> Option<El<'a>> {
        let key: (NodeId, &str) = (element.id(), sid);
        if let Some(child) = self.children.get(&key) {
            return self.document.get_node(*child);
        }
        let key = (element.id(), sid.to_owned());
        if let Some(found) = self.found.get(&key) {
            return found.and_then(|id| self.document.get_node(id));
        }
        let range = element.range();
        let all = self.sids.get(sid).map_or(&[][..], Vec::as_slice);
        let from = all.partition_point(|id| self.start(*id) <= range.start);
        let below = all.get(from..).unwrap_or_default().iter().take(NEAREST_OF).take_while(|id| self.start(**id) < range.end);
        let nearest = below
            .filter_map(|id| self.document.get_node(*id))
            .min_by_key(|found| found.ancestors().take_while(|above| *above != element).count())
            .map(|found| found.id());
        self.found.insert(key, nearest);
        nearest.and_then(|id| self.document.get_node(id))
    }
}

/// What `find` says to an id as written, else percent-decoded.
fn decoded<R>(id: &str, find: impl Fn(&str) -> Option<R>) -> Option<R> {
    find(id).or_else(|| match percent_decoded(id) {
        Cow::Owned(decoded) => find(&decoded),
        Cow::Borrowed(_) => None,
    })
}

/// What stands after the last slash or backslash.
pub(super) fn last_segment(path: &str) -> &str {
    path.rsplit(['/', '\\']).next().unwrap_or(path)
}

/// Percent escapes resolved; bytes that make no UTF-8 stay escaped.
pub(super) fn percent_decoded(text: &str) -> Cow<'_, str> {
    if !text.contains('%') {
        return Cow::Borrowed(text);
    }
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.as_bytes();
    let mut changed = false;
    loop {
        rest = match rest {
            [b'%', high, low, tail @ ..] if high.is_ascii_hexdigit() && low.is_ascii_hexdigit() => {
                let digit = |b: u8| char::from(b).to_digit(16).unwrap_or(0) as u8;
                bytes.push(digit(*high) * 16 + digit(*low));
                changed = true;
                tail
            }
            [byte, tail @ ..] => {
                bytes.push(*byte);
                tail
            }
            [] => break,
        };
    }
    match String::from_utf8(bytes) {
        Ok(decoded) if changed => Cow::Owned(decoded),
        _ => Cow::Borrowed(text),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "<COLLADA><extra><node id='a'/></extra><geometry id='a'/><node id='a'><node sid='deep'><node sid='x' name='far'/></node>\
                        <matrix sid='x' name='near'/></node><node id='b c'/></COLLADA>";

    fn with<R>(check: impl for<'l> FnOnce(&mut Lookup<'l>, El<'l>) -> R) -> R {
        let document = roxmltree::Document::parse(TEXT).unwrap_or_else(|error| unreachable!("{error}"));
        check(&mut Lookup::new(&document, vec!["/some/where/this file.dae".into()]), document.root_element())
    }

    #[test]
    fn ids_are_found_by_kind_and_outside_of_extra_first() {
        with(|lookup, root| {
            assert_eq!(lookup.by_id(root, "a", &[]).map(|e| e.tag_name().name()), Some("geometry"));
            assert_eq!(lookup.by_id(root, "a", &["node"]).and_then(|e| e.parent()).map(|e| e.tag_name().name()), Some("COLLADA"));
            assert_eq!(lookup.by_id(root, "b%20c", &[]).map(|e| e.tag_name().name()), Some("node"));
            // There is one of each kind: nothing had to be chosen.
            assert_eq!(lookup.repeated().len(), 0);
        });
    }

    #[test]
    fn urls_are_local_or_name_another_file() {
        with(|lookup, root| {
            assert_eq!(lookup.url(root, "#a"), Url::Here { document: 0, id: "a".into() });
            assert_eq!(lookup.url(root, "./this%20file.dae#a"), Url::Here { document: 0, id: "a".into() });
            assert_eq!(lookup.url(root, "file:///C:/some/this%20file.dae#a"), Url::Here { document: 0, id: "a".into() });
            assert_eq!(lookup.url(root, "other.dae#a"), Url::External("other.dae".into()));
            assert_eq!(lookup.url(root, "other.dae"), Url::External("other.dae".into()));
            assert_eq!(lookup.url(root, "a"), Url::Here { document: 0, id: "a".into() });
        });
    }

    #[test]
    fn the_nearest_scoped_id_is_meant() {
        with(|lookup, root| {
            let node = lookup.by_id(root, "a", &["node"]).unwrap_or_else(|| unreachable!("it is there"));
            assert_eq!(lookup.by_sid(node, "x").and_then(|e| e.attribute("name")), Some("near"));
            assert_eq!(
                lookup.by_sid(node, "deep").and_then(|deep| lookup.by_sid(deep, "x")).and_then(|e| e.attribute("name")),
                Some("far")
            );
            assert!(lookup.by_sid(node, "y").is_none());
        });
    }

    #[test]
    fn percent_escapes_are_resolved_where_they_make_text() {
        assert_eq!(percent_decoded("a%20b%C3%A9"), "a bé");
        assert_eq!(percent_decoded("100%"), "100%");
        assert_eq!(percent_decoded("%FF"), "%FF");
    }
}

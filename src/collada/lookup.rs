//! Finds elements by id and by scoped id, and takes urls apart.

use std::borrow::Cow;
use std::collections::hash_map::Entry;
use std::collections::{HashMap, HashSet};

use roxmltree::NodeId;

use super::El;

/// What a url names.
#[derive(Debug, PartialEq, Eq)]
pub enum Url<'a> {
    /// An id in this document.
    Local(Cow<'a, str>),
    /// Another document.
    External(Cow<'a, str>),
}

/// The ids and scoped ids of a document.
pub struct Lookup<'a> {
    document: &'a roxmltree::Document<'a>,
    ids: HashMap<&'a str, NodeId>,
    /// Ids that several elements have.
    several: HashSet<&'a str>,
    /// All elements of one tag with an id that several elements have, in document order.
    repeats: HashMap<(&'a str, &'a str), Vec<NodeId>>,
    /// Elements by scoped id, in document order.
    sids: HashMap<&'a str, Vec<NodeId>>,
    found: HashMap<(NodeId, String), Option<NodeId>>,
    file_name: String,
}

impl<'a> Lookup<'a> {
    /// Indexes `document`, which lies in the file `file_name`.
    pub fn new(document: &'a roxmltree::Document<'a>, file_name: &str) -> Self {
        let mut lookup = Self {
            document,
            ids: HashMap::new(),
            several: HashSet::new(),
            repeats: HashMap::new(),
            sids: HashMap::new(),
            found: HashMap::new(),
            file_name: last_segment(file_name).to_owned(),
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
                    "id" if range.start < extra_end => later.push((attribute.value(), element.id())),
                    "id" => lookup.add(attribute.value(), element),
                    "sid" => lookup.sids.entry(attribute.value()).or_default().push(element.id()),
                    _ => {}
                }
            }
        }
        for (id, element) in later {
            lookup.ids.entry(id).or_insert(element);
        }
        lookup
    }

    fn add(&mut self, id: &'a str, element: El<'a>) {
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

    /// Elements whose id was taken already.
    pub fn repeated(&self) -> Vec<El<'a>> {
        let later = |((id, _), all): (&(&'a str, &'a str), &Vec<NodeId>)| {
            let first = self.ids.get(id).copied();
            all.iter().copied().filter(move |element| Some(*element) != first).collect::<Vec<_>>()
        };
        let mut repeated: Vec<NodeId> = self.repeats.iter().flat_map(later).collect();
        repeated.sort_unstable_by_key(|id| id.get());
        repeated.into_iter().filter_map(|id| self.document.get_node(id)).collect()
    }

    /// The first element with this id whose tag is one of `tags`; with no tags, the first at all. Tried as written, then percent-decoded.
    pub fn by_id(&self, id: &str, tags: &[&str]) -> Option<El<'a>> {
        self.decoded(id, |id| self.by_exact_id(id, tags))
    }

    /// [`Lookup::by_id`] as `from` means it: where several elements have the id, the one that shares the innermost element with `from`, the first
    /// among equals. Files put together from others repeat the ids of sources; each mesh and each sampler means its own.
    pub fn by_id_near(&self, from: El<'a>, id: &str, tags: &[&str]) -> Option<El<'a>> {
        self.decoded(id, |id| {
            let near =
                || from.ancestors().find_map(|around| tags.iter().find_map(|tag| self.within(around, self.repeats.get(&(id, *tag))?)));
            if self.several.contains(id) { near() } else { None }.or_else(|| self.by_exact_id(id, tags))
        })
    }

    /// What `find` says to an id as written, else percent-decoded.
    fn decoded(&self, id: &str, find: impl Fn(&str) -> Option<El<'a>>) -> Option<El<'a>> {
        find(id).or_else(|| match percent_decoded(id) {
            Cow::Owned(decoded) => find(&decoded),
            Cow::Borrowed(_) => None,
        })
    }

    fn by_exact_id(&self, id: &str, tags: &[&str]) -> Option<El<'a>> {
        let first = self.ids.get(id).and_then(|id| self.document.get_node(*id))?;
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

    /// Takes a url apart. A url that names this very file is local; one without `#` that is an id here is taken for one.
    pub fn url<'u>(&self, url: &'u str) -> Url<'u> {
        let url = url.trim();
        match url.split_once('#') {
            Some(("", id)) => Url::Local(Cow::Borrowed(id)),
            Some((file, id)) => {
                if last_segment(&percent_decoded(file)) == self.file_name && !self.file_name.is_empty() {
                    Url::Local(Cow::Borrowed(id))
                } else {
                    Url::External(Cow::Borrowed(file))
                }
            }
            None if self.by_id(url, &[]).is_none() && url.to_ascii_lowercase().ends_with(".dae") => Url::External(Cow::Borrowed(url)),
            None => Url::Local(Cow::Borrowed(url)),
        }
    }

    /// The element with scoped id `sid` that lies nearest below `element`, the first in document order among equals.
    pub fn by_sid(&mut self, element: El<'a>, sid: &str) -> Option<El<'a>> {
        if let Some(child) = element.children().find(|child| child.attribute("sid") == Some(sid)) {
            return Some(child);
        }
        let key = (element.id(), sid.to_owned());
        if let Some(found) = self.found.get(&key) {
            return found.and_then(|id| self.document.get_node(id));
        }
        let range = element.range();
        let all = self.sids.get(sid).map_or(&[][..], Vec::as_slice);
        let from = all.partition_point(|id| self.start(*id) <= range.start);
        let below = all.get(from..).unwrap_or_default().iter().take_while(|id| self.start(**id) < range.end);
        let nearest = below
            .filter_map(|id| self.document.get_node(*id))
            .min_by_key(|found| found.ancestors().take_while(|above| *above != element).count())
            .map(|found| found.id());
        self.found.insert(key, nearest);
        nearest.and_then(|id| self.document.get_node(id))
    }
}

/// What stands after the last slash or backslash.
pub fn last_segment(path: &str) -> &str {
    path.rsplit(['/', '\\']).next().unwrap_or(path)
}

/// Percent escapes resolved; bytes that make no UTF-8 stay escaped.
pub fn percent_decoded(text: &str) -> Cow<'_, str> {
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

    fn with<R>(check: impl FnOnce(&mut Lookup<'_>) -> R) -> R {
        let document = roxmltree::Document::parse(TEXT).unwrap_or_else(|error| unreachable!("{error}"));
        check(&mut Lookup::new(&document, "/some/where/this file.dae"))
    }

    #[test]
    fn ids_are_found_by_kind_and_outside_of_extra_first() {
        with(|lookup| {
            assert_eq!(lookup.by_id("a", &[]).map(|e| e.tag_name().name()), Some("geometry"));
            assert_eq!(lookup.by_id("a", &["node"]).and_then(|e| e.parent()).map(|e| e.tag_name().name()), Some("COLLADA"));
            assert_eq!(lookup.by_id("b%20c", &[]).map(|e| e.tag_name().name()), Some("node"));
            assert_eq!(lookup.repeated().len(), 1);
        });
    }

    #[test]
    fn urls_are_local_or_name_another_file() {
        with(|lookup| {
            assert_eq!(lookup.url("#a"), Url::Local("a".into()));
            assert_eq!(lookup.url("./this%20file.dae#a"), Url::Local("a".into()));
            assert_eq!(lookup.url("file:///C:/some/this%20file.dae#a"), Url::Local("a".into()));
            assert_eq!(lookup.url("other.dae#a"), Url::External("other.dae".into()));
            assert_eq!(lookup.url("other.dae"), Url::External("other.dae".into()));
            assert_eq!(lookup.url("a"), Url::Local("a".into()));
        });
    }

    #[test]
    fn the_nearest_scoped_id_is_meant() {
        with(|lookup| {
            let node = lookup.by_id("a", &["node"]).unwrap_or_else(|| unreachable!("it is there"));
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

//! What a document asks of the XML parser, looked at before the parser runs: depth, number of nodes, namespaces, entities.
//!
//! The parser builds its whole tree at once. One pass over the tags, which skips text at memory speed, tells how much that tree will take,
//! so that a document of nothing but tags is refused before it fills the memory.

use std::ops::Range;

use memchr::{memchr, memchr_iter, memchr3, memmem};

use super::list_extraction::{LONG, Shortened, holds_list, is_plain};
use super::undeclared_prefixes::{self, Undeclared};
use super::{ReadError, ReadErrorKind};
use sinew_scene::limits;

/// What the tree takes per node and per attribute, bytes: sizes in roxmltree 0.21, rounded up.
const NODE_BYTES: usize = 80;
const ATTRIBUTE_BYTES: usize = 80;

/// What one pass over the tags found.
#[derive(Debug, Default, PartialEq, Eq)]
struct Survey {
    nodes: usize,
    attributes: usize,
    /// `<` in comments and the like, which open nothing.
    idle_tags: usize,
    prefixes: Vec<String>,
    /// Length of the document type definition, where it declares entities.
    entities: usize,
    nested_entities: bool,
    /// Where long lists stand.
    lists: Vec<Range<usize>>,
}

/// A document that was looked at and may be parsed.
pub(super) struct Surveyed<'a> {
    /// The document without its long lists.
    pub shortened: Shortened<'a>,
    /// Prefixes that were taken out because nobody declares them.
    pub undeclared: Vec<Undeclared>,
    /// What tree and scene may take together, bytes, and what of it the tree takes.
    budget: usize,
    tree: usize,
}

/// A document and what is left for the scene that is made from it.
pub(super) struct ParsedDocument<'a> {
    /// The tree.
    pub document: roxmltree::Document<'a>,
    /// The lists that were set aside.
    pub lists: &'a Shortened<'a>,
    /// Bytes that references may still make.
    pub budget: usize,
}

impl Survey {
    /// Counts what a comment or the like holds, up to its end.
    fn idle(&mut self, end: Option<usize>, body: &[u8]) -> Option<usize> {
        self.idle_tags += memchr_iter(b'<', body.get(..end?).unwrap_or_default()).count();
        end
    }
}

/// Looks at what `text` asks of the parser, and sets its long lists aside. `room`: what tree, scene and numbers may take together, bytes, where that
/// does not follow from the size of the text.
///
/// # Errors
/// [`ReadError`] where it asks for more than the limits allow.
pub(super) fn look_at(text: &str, room: Option<usize>) -> Result<Surveyed<'_>, ReadError> {
    let mut survey = survey(text)?;
    let mut budget = text.len().saturating_mul(limits::READ_BYTES_PER_BYTE) + limits::READ_BYTES;
    if let Some(room) = room {
        let left = room.checked_sub(numbers_in(text) * limits::BYTES_PER_NUMBER).ok_or(ReadErrorKind::ArchiveTooLarge)?;
        budget = budget.min(left);
    }
    let tree = survey.nodes * NODE_BYTES + survey.attributes * ATTRIBUTE_BYTES;
    // The parser reserves by counting `<` and `=`, wherever they stand. In a small document that is little, whatever it holds.
    let signs = if text.len() < 16 << 20 { 0 } else { memchr_iter(b'=', text.as_bytes()).count().saturating_sub(survey.attributes) };
    let reserved = survey.idle_tags * NODE_BYTES + signs * ATTRIBUTE_BYTES;
    if tree > budget || reserved > 3 * budget {
        return Err(ReadErrorKind::TooManyElements(survey.nodes).into());
    }
    if survey.entities > 0 {
        let uses = memchr_iter(b'&', text.as_bytes()).count();
        // The parser lets one use lead to 255 others.
        let grown = survey.entities.saturating_mul(uses).saturating_mul(if survey.nested_entities { 256 } else { 1 });
        if grown > limits::ENTITY_BYTES {
            return Err(ReadErrorKind::EntitiesTooLarge.into());
        }
    }
    // An entity could stand for the end of a list.
    let lists = if survey.entities > 0 { Vec::new() } else { std::mem::take(&mut survey.lists) };
    let mut shortened = Shortened::new(text, lists);
    let mut undeclared = Vec::new();
    // Nor is the text of an entity looked at.
    if survey.entities == 0
        && let Some((mended, found)) = undeclared_prefixes::without(shortened.text(), &survey.prefixes, limits::XML_PREFIXES)
    {
        shortened.reword(mended);
        undeclared = found;
    }
    Ok(Surveyed { shortened, undeclared, budget, tree })
}

/// How many numbers a text holds at most: words that blanks stand before.
fn numbers_in(text: &str) -> usize {
    let bytes = text.as_bytes();
    bytes.iter().zip(bytes.get(1..).unwrap_or_default()).filter(|(before, here)| **before <= b' ' && **here > b' ').count()
}

/// Parses a document that was looked at.
///
/// # Errors
/// [`ReadError`] with the line where it is not well-formed XML.
pub(super) fn parse<'a>(surveyed: &'a Surveyed<'a>) -> Result<ParsedDocument<'a>, ReadError> {
    let nodes_limit = u32::try_from(surveyed.budget / NODE_BYTES).unwrap_or(u32::MAX);
    let options = || roxmltree::ParsingOptions { allow_dtd: true, nodes_limit, entity_resolver: None };
    let (short, whole) = (surveyed.shortened.text(), surveyed.shortened.whole());
    let document = roxmltree::Document::parse_with_options(short, options()).map_err(|error| {
        // The whole document has the same fault, or that of a prefix, at the place where the user will find it.
        refused(&roxmltree::Document::parse_with_options(whole, options()).err().unwrap_or(error), whole)
    })?;
    Ok(ParsedDocument { document, lists: &surveyed.shortened, budget: surveyed.budget - surveyed.tree })
}

/// The parser's error, with the place where the user will look for it.
fn refused(error: &roxmltree::Error, text: &str) -> ReadError {
    use roxmltree::Error;
    let position = error.pos();
    let kind = match error {
        Error::UnexpectedCloseTag(expected, actual, _) => {
            ReadErrorKind::WrongCloseTag { expected: expected.clone(), actual: actual.clone() }
        }
        Error::UnclosedRootNode | Error::UnexpectedEndOfStream => {
            // Cut short is seen at the end, and the last line with anything on it is where to look.
            let end = text.trim_end().len();
            return ReadError::in_line(line_at(text.as_bytes(), end), ReadErrorKind::CutShort);
        }
        Error::NoRootNode => return ReadErrorKind::NotXml.into(),
        Error::NodesLimitReached => return ReadErrorKind::TooManyElements(0).into(),
        Error::UnknownEntityReference(name, _) => ReadErrorKind::UnknownEntity(name.clone()),
        Error::EntityReferenceLoop(_) => ReadErrorKind::EntityLoop,
        Error::UnknownNamespace(prefix, _) => ReadErrorKind::UnknownPrefix(prefix.clone()),
        Error::DuplicatedAttribute(name, _) => ReadErrorKind::RepeatedAttribute(name.clone()),
        _ if position.row == 1 && position.col == 1 => ReadErrorKind::NotXml,
        _ => ReadErrorKind::Xml(position.col),
    };
    ReadError::in_line(position.row, kind)
}

/// One pass over the tags. Where the document is not well-formed it stops, and the parser says what is wrong.
fn survey(text: &str) -> Result<Survey, ReadError> {
    let bytes = text.as_bytes();
    let mut survey = Survey { nodes: 2, ..Survey::default() };
    let (mut at, mut depth) = (0, 0usize);
    // Whether the last tag opened an element that holds a list.
    let mut in_list = false;
    while let Some(found) = bytes.get(at..).and_then(|rest| memchr(b'<', rest)) {
        survey.nodes += usize::from(found > 0);
        let text = at..at + found;
        at += found;
        let Some(rest) = bytes.get(at..) else { break };
        if std::mem::take(&mut in_list) && found >= LONG && rest.starts_with(b"</") && bytes.get(text.clone()).is_some_and(is_plain) {
            survey.lists.push(text);
        }
        let skipped = match rest {
            [b'<', b'!', b'-', b'-', body @ ..] => {
                survey.nodes += 1;
                survey.idle(memmem::find(body, b"-->"), body).map(|end| end + 7)
            }
            [b'<', b'!', b'[', body @ ..] => {
                survey.nodes += 1;
                survey.idle(memmem::find(body, b"]]>"), body).map(|end| end + 6)
            }
            [b'<', b'!', ..] => doctype(rest, &mut survey),
            [b'<', b'?', body @ ..] => {
                survey.nodes += 1;
                survey.idle(memmem::find(body, b"?>"), body).map(|end| end + 4)
            }
            [b'<', b'/', body @ ..] => {
                depth = depth.saturating_sub(1);
                memchr(b'>', body).map(|end| end + 3)
            }
            _ => {
                survey.nodes += 1;
                match tag(rest, &mut survey) {
                    Ok(Some((length, empty))) => {
                        depth += usize::from(!empty);
                        in_list = !empty && opens_list(rest);
                        Some(length)
                    }
                    Ok(None) => None,
                    Err(kind) => return Err(ReadError::in_line(line_at(bytes, at), kind)),
                }
            }
        };
        if depth > limits::DEPTH {
            return Err(ReadError::in_line(line_at(bytes, at), ReadErrorKind::TooDeep));
        }
        match skipped {
            Some(length) => at += length,
            None => break,
        }
    }
    Ok(survey)
}

/// A start tag: its length and whether it closes itself; `None` where it doesn't end.
fn tag(rest: &[u8], survey: &mut Survey) -> Result<Option<(usize, bool)>, ReadErrorKind> {
    let mut at = 0;
    let mut attributes = 0;
    loop {
        let Some(found) = rest.get(at..).and_then(|tail| memchr3(b'"', b'\'', b'>', tail)) else { return Ok(None) };
        let start = at;
        at += found;
        let Some(&mark) = rest.get(at) else { return Ok(None) };
        if mark == b'>' {
            survey.attributes += attributes;
            return Ok(Some((at + 1, at > 0 && rest.get(at - 1) == Some(&b'/'))));
        }
        attributes += 1;
        if attributes > limits::XML_ATTRIBUTES {
            return Err(ReadErrorKind::TooManyAttributes);
        }
        if let Some(name) = rest.get(start..at).and_then(declared_prefix)
            && !survey.prefixes.contains(&name)
        {
            if survey.prefixes.len() >= limits::XML_PREFIXES {
                return Err(ReadErrorKind::TooManyPrefixes);
            }
            survey.prefixes.push(name);
        }
        let Some(length) = rest.get(at + 1..).and_then(|value| memchr(mark, value)) else { return Ok(None) };
        at += length + 2;
    }
}

/// Whether a start tag is that of a list.
fn opens_list(rest: &[u8]) -> bool {
    let name = rest.get(1..).unwrap_or_default();
    let end = name.iter().position(|byte| *byte == b'>' || *byte == b'/' || byte.is_ascii_whitespace()).unwrap_or(name.len());
    name.get(..end).is_some_and(holds_list)
}

/// The prefix that an attribute declares, given what stands before its value.
fn declared_prefix(before: &[u8]) -> Option<String> {
    let at = memmem::find(before, b"xmlns:")?;
    let name = before.get(at + 6..)?;
    let end = name.iter().position(|b| *b == b'=' || b.is_ascii_whitespace()).unwrap_or(name.len());
    name.get(..end).map(|name| String::from_utf8_lossy(name).into_owned())
}

/// A document type declaration with its internal subset: its length.
fn doctype(rest: &[u8], survey: &mut Survey) -> Option<usize> {
    let end = memchr(b'>', rest)? + 1;
    let Some(open) = rest.get(..end).and_then(|head| memchr(b'[', head)) else { return Some(end) };
    let subset = rest.get(open..)?;
    let close = memchr(b']', subset)?;
    // A `]` inside a quoted value ends the subset too early here; what follows is then looked at as tags, which only makes the survey stricter.
    let body = subset.get(..close)?;
    if memmem::find(body, b"<!ENTITY").is_some() {
        survey.entities += body.len();
        survey.nested_entities |= memchr(b'&', body).is_some() || memchr(b'<', body.get(9..).unwrap_or_default()).is_some();
    }
    let tail = memchr(b'>', subset.get(close..)?)?;
    Some(open + close + tail + 1)
}

/// The line of a byte, from 1.
fn line_at(bytes: &[u8], at: usize) -> u32 {
    bytes.get(..at).map_or(1, |before| memchr_iter(b'\n', before).count() as u32 + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Number of nodes, or why it was refused.
    fn parse(text: &str) -> Result<usize, ReadError> {
        super::parse(&look_at(text, None)?).map(|parsed| parsed.document.descendants().count())
    }

    #[test]
    fn the_survey_counts_what_the_parser_makes() {
        let text = "<?xml version='1.0'?><!DOCTYPE a><a x='1>' y=\"2\"> t <b/><!-- <c> --><![CDATA[<d>]]></a>";
        let survey = survey(text).unwrap_or_default();
        assert!(parse(text).is_ok_and(|nodes| survey.nodes >= nodes));
        // The declaration's own attribute counts as none.
        assert_eq!(survey.attributes, 2);
    }

    #[test]
    fn a_million_levels_are_refused_by_their_line() {
        let text = format!("<a>\n{}", "<b>".repeat(1_000_000));
        let error = parse(&text).err();
        assert_eq!(error.as_ref().and_then(|error| error.line), Some(2));
        assert!(error.is_some_and(|error| {
            let said = sinew_i18n::Sentence::sentence(&error);
            said.contains("1000") || said.contains("1,000")
        }));
    }

    #[test]
    fn bombs_of_entities_tags_attributes_and_namespaces_are_refused() {
        let laughs =
            "<!DOCTYPE a [<!ENTITY a 'ha'><!ENTITY b '&a;&a;&a;&a;&a;&a;&a;&a;'><!ENTITY c '&b;&b;&b;&b;&b;&b;&b;&b;'>]><a>&c;</a>";
        assert!(parse(laughs).is_ok(), "a small joke is harmless");
        let mut nested = String::from("<!DOCTYPE a [<!ENTITY x0 'ha'>");
        for i in 1..20 {
            nested.push_str(&format!("<!ENTITY x{i} '&x{0};&x{0};&x{0};&x{0};'>", i - 1));
        }
        assert!(parse(&format!("{nested}]><a>{}</a>", "&x19;".repeat(1000))).is_err());
        let quadratic = format!("<!DOCTYPE a [<!ENTITY x '{}'>]><a>{}</a>", "h".repeat(100_000), "&x;".repeat(100_000));
        assert!(parse(&quadratic).is_err());
        assert!(parse(&format!("<a>{}</a>", "<b/>".repeat(3_000_000))).is_err());
        let attributes: String = (0..1000).map(|i| format!(" a{i}=''")).collect();
        assert!(parse(&format!("<a{attributes}/>")).is_err());
        let prefixes: String = (0..100).map(|i| format!("<a xmlns:p{i}='u'/>")).collect();
        assert!(parse(&format!("<a>{prefixes}</a>")).is_err());
    }

    #[test]
    fn broken_documents_name_their_line() {
        for (text, line) in [("<a>\n<b>\n</a>", Some(3)), ("<a>\n<b", Some(2)), ("<a>\n<b c=1/></a>", Some(2)), ("hello", Some(1))] {
            assert_eq!(parse(text).err().map(|error| error.line), Some(line), "{text}");
        }
    }

    #[test]
    fn faults_behind_long_lists_are_named_by_the_line_of_the_file() {
        let list = "1 2\n".repeat(1000);
        let text = format!("<a>\n<p>{list}</p>\n<b c=1/></a>");
        assert_eq!(look_at(&text, None).map(|surveyed| surveyed.shortened.text().len()).ok(), Some("<a>\n<p>0</p>\n<b c=1/></a>".len()));
        assert_eq!(parse(&text).err().and_then(|error| error.line), Some(1003));
    }
}

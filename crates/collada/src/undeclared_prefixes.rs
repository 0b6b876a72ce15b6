//! Namespace prefixes that nobody declared: the parser refuses them, and some exporters forget to declare `xsi`.
//!
//! The names of elements and attributes are written anew without such a prefix, each in the space it had, so that every byte behind keeps its place.

use memchr::{memchr, memchr_iter, memmem};

/// Prefixes that need no declaration.
const BUILT_IN: [&[u8]; 2] = [b"xml", b"xmlns"];

/// A prefix that nobody declared.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Undeclared {
    /// The prefix.
    pub prefix: String,
    /// Where it is used first.
    pub at: usize,
}

/// `text` without the prefixes that are not among `declared`, and which they were; `None` where all are declared, or more than `most` are not.
pub(super) fn without(text: &str, declared: &[String], most: usize) -> Option<(String, Vec<Undeclared>)> {
    if !is_suspect(text.as_bytes(), declared) {
        return None;
    }
    let mut mended = text.as_bytes().to_vec();
    let mut found = Vec::new();
    let mut at = 0;
    while let Some(next) = mended.get(at..).and_then(|rest| memchr(b'<', rest)) {
        at += next;
        let rest = mended.get(at..)?;
        at += match rest {
            [b'<', b'!', b'-', b'-', ..] => memmem::find(rest, b"-->")? + 3,
            [b'<', b'!', b'[', ..] => memmem::find(rest, b"]]>")? + 3,
            [b'<', b'!', ..] => memchr(b'>', rest)? + 1,
            [b'<', b'?', ..] => memmem::find(rest, b"?>")? + 2,
            _ => {
                let length = tag_length(rest)?;
                mend_tag(mended.get_mut(at..at + length)?, at, declared, &mut found);
                length
            }
        };
        if found.len() > most {
            return None;
        }
    }
    let mended = String::from_utf8(mended).ok()?;
    (!found.is_empty()).then_some((mended, found))
}

/// Whether something looks like a name with a prefix that is not declared. Text may look so, too; tags are told from it later.
fn is_suspect(text: &[u8], declared: &[String]) -> bool {
    memchr_iter(b':', text).any(|colon| {
        let before = text.get(..colon).unwrap_or_default();
        let start = before.iter().rposition(|byte| !is_name(*byte)).map_or(0, |at| at + 1);
        let opens =
            before.get(..start).and_then(<[u8]>::last).is_some_and(|byte| matches!(byte, b'<' | b'/') || byte.is_ascii_whitespace());
        opens && before.get(start..).is_some_and(|prefix| is_undeclared(prefix, declared))
    })
}

fn is_name(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b'-' | b'.') || !byte.is_ascii()
}

fn is_undeclared(prefix: &[u8], declared: &[String]) -> bool {
    !prefix.is_empty() && !BUILT_IN.contains(&prefix) && !declared.iter().any(|known| known.as_bytes() == prefix)
}

/// Bytes from `<` to `>`, quoted values passed over.
fn tag_length(tag: &[u8]) -> Option<usize> {
    let mut quote = None;
    let end = tag.iter().position(|byte| match (quote, *byte) {
        (None, b'>') => true,
        (None, mark @ (b'"' | b'\'')) => {
            quote = Some(mark);
            false
        }
        (Some(mark), byte) if mark == byte => {
            quote = None;
            false
        }
        _ => false,
    })?;
    Some(end + 1)
}

/// Takes undeclared prefixes from the names in a tag that begins at `at`.
fn mend_tag(tag: &mut [u8], at: usize, declared: &[String], found: &mut Vec<Undeclared>) {
    let start = if tag.get(1) == Some(&b'/') { 2 } else { 1 };
    let end = tag.iter().skip(start).position(|byte| !is_name(*byte) && *byte != b':').map_or(tag.len(), |length| start + length);
    if let Some(name) = tag.get_mut(start..end)
        && let Some(colon) = prefix_of(name, declared)
    {
        note(name, colon, at + start, found);
        // The name moves to the front; blanks may stand behind it.
        name.rotate_left(colon + 1);
        let blank = name.len() - colon - 1;
        name.iter_mut().skip(blank).for_each(|byte| *byte = b' ');
    }
    let (mut place, mut quote) = (end, None);
    while let Some(&byte) = tag.get(place) {
        match quote {
            Some(mark) => {
                if byte == mark {
                    quote = None;
                }
                place += 1;
            }
            None if is_name(byte) => {
                let length = tag.iter().skip(place).take_while(|byte| is_name(**byte) || **byte == b':').count();
                if let Some(name) = tag.get_mut(place..place + length)
                    && let Some(colon) = prefix_of(name, declared)
                {
                    note(name, colon, at + place, found);
                    // Another name than that without a prefix, which the element may have as well.
                    name.iter_mut().skip(colon).take(1).for_each(|byte| *byte = b'_');
                }
                place += length;
            }
            None => {
                if matches!(byte, b'"' | b'\'') {
                    quote = Some(byte);
                }
                place += 1;
            }
        }
    }
}

/// Where the colon behind an undeclared prefix is in a name.
fn prefix_of(name: &[u8], declared: &[String]) -> Option<usize> {
    let colon = memchr(b':', name)?;
    is_undeclared(name.get(..colon)?, declared).then_some(colon)
}

fn note(name: &[u8], colon: usize, at: usize, found: &mut Vec<Undeclared>) {
    let prefix = String::from_utf8_lossy(name.get(..colon).unwrap_or_default()).into_owned();
    if !found.iter().any(|known| known.prefix == prefix) {
        found.push(Undeclared { prefix, at });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn undeclared_prefixes_are_taken_from_names_and_nothing_moves() {
        let text = "<c:a xmlns:c='u' c:x='1' xsi:schemaLocation='x:y b:c>'><m:b m:k=\"c:d\"/> t:u <!-- <n:o> --><m:e>x</m:e ></c:a>";
        let (mended, found) = without(text, &["c".to_owned()], 8).unwrap_or_default();
        let wanted = "<c:a xmlns:c='u' c:x='1' xsi_schemaLocation='x:y b:c>'><b   m_k=\"c:d\"/> t:u <!-- <n:o> --><e  >x</e   ></c:a>";
        assert_eq!(mended, wanted);
        let places: Vec<(&str, Option<usize>)> = found.iter().map(|one| (one.prefix.as_str(), Some(one.at))).collect();
        assert_eq!(places, [("xsi", text.find("xsi:")), ("m", text.find("m:b"))]);
        assert!(roxmltree::Document::parse(text).is_err());
        assert!(roxmltree::Document::parse(&mended).is_ok());
    }

    #[test]
    fn what_is_declared_or_no_name_is_left_alone() {
        for text in ["<a xmlns:m='u'><m:b/> x:y</a>", "<a t='12:30'>a:b : c</a>", "<a", "<a b='<", "", ":", "<:a :b=''>"] {
            assert_eq!(without(text, &["m".to_owned()], 8), None, "{text}");
        }
        let many: String = (0..9).map(|i| format!("<p{i}:a/>")).collect();
        assert_eq!(without(&many, &[], 8), None);
        assert!(without(&many, &[], 9).is_some());
    }
}

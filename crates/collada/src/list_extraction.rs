//! Sets long lists aside before the XML parser runs.
//!
//! Nearly all of a document is lists of numbers, which the parser would go through character by character only to hand them on as they are. So the
//! parser gets the document with a stand-in for each long list, and a list is read from the document itself. Positions are
//! translated back, so that lines stay those of the file.

use std::borrow::Cow;
use std::ops::Range;

/// What stands where a list was.
const STAND_IN: char = '0';
/// Shorter lists stay where they are.
pub(super) const LONG: usize = 512;

/// Whether an element of this name holds a list that only the readers of lists look at.
pub(super) fn holds_list(name: &[u8]) -> bool {
    let local = name.iter().rposition(|byte| *byte == b':').and_then(|at| name.get(at + 1..)).unwrap_or(name);
    matches!(local, b"p" | b"v" | b"vcount" | b"h" | b"float_array" | b"int_array" | b"Name_array" | b"IDREF_array" | b"SIDREF_array")
}

/// Whether text means itself: no markup, no references, nothing that XML forbids. Looks at blocks, so that the compiler can take many bytes at once.
pub(super) fn is_plain(text: &[u8]) -> bool {
    let odd = |byte: u8| !(matches!(byte, b'\t' | b'\n') || (b' '..=b'~').contains(&byte)) || byte == b'&' || byte == b'>';
    text.chunks(256).all(|block| !block.iter().fold(false, |found, byte| found | odd(*byte)))
}

/// A list that was set aside.
#[derive(Debug, PartialEq, Eq)]
struct ExtractedList {
    /// Where its stand-in is in the short text.
    at: usize,
    /// Where it is in the whole text.
    range: Range<usize>,
}

/// A document without its long lists.
#[derive(Debug)]
pub(super) struct Shortened<'a> {
    whole: &'a str,
    text: Cow<'a, str>,
    lists: Vec<ExtractedList>,
}

impl<'a> Shortened<'a> {
    /// Sets aside what stands at `lists` in `whole`, ascending ranges of [plain](is_plain) text; all of it stays where it is if that gains little.
    pub(super) fn new(whole: &'a str, lists: Vec<Range<usize>>) -> Self {
        let length: usize = lists.iter().map(Range::len).sum();
        if length < whole.len() / 2 {
            return Self { whole, text: Cow::Borrowed(whole), lists: Vec::new() };
        }
        let mut text = String::with_capacity(whole.len() - length + lists.len());
        let (mut aside, mut done) = (Vec::with_capacity(lists.len()), 0);
        for range in lists {
            text.push_str(whole.get(done..range.start).unwrap_or_default());
            done = range.end;
            aside.push(ExtractedList { at: text.len(), range });
            text.push(STAND_IN);
        }
        text.push_str(whole.get(done..).unwrap_or_default());
        Self { whole, text: Cow::Owned(text), lists: aside }
    }

    /// The whole document.
    pub(super) fn whole(&self) -> &'a str {
        self.whole
    }

    /// What the parser reads.
    pub(super) fn text(&self) -> &str {
        &self.text
    }

    /// Has the parser read `text` instead, in which every byte has the place it had.
    pub(super) fn reword(&mut self, text: String) {
        debug_assert_eq!(text.len(), self.text.len());
        self.text = Cow::Owned(text);
    }

    /// The list whose stand-in is at `at` in the short text.
    pub(super) fn list_at(&self, at: usize) -> Option<&'a str> {
        let found = self.lists.binary_search_by_key(&at, |list| list.at).ok()?;
        self.whole.get(self.lists.get(found)?.range.clone())
    }

    /// The place in the whole document of a place in the short text.
    pub(super) fn place(&self, at: usize) -> usize {
        let before = self.lists.partition_point(|list| list.at < at);
        match before.checked_sub(1).and_then(|last| self.lists.get(last)) {
            Some(last) => at - last.at - STAND_IN.len_utf8() + last.range.end,
            None => at,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_are_found_by_their_stand_ins_and_places_are_translated_back() {
        let whole = "<a><p>11 12\n13</p>\n<q/><v>2 2 2 2</v></a>";
        let range = |text: &str| whole.find(text).map_or(0..0, |at| at..at + text.len());
        let short = Shortened::new(whole, vec![range("11 12\n13"), range("2 2 2 2")]);
        // Too little to be worth it.
        assert_eq!(short.text(), whole);
        let whole = "<p>11 12 14 15 16 17\n13</p>\n<q/><v>2 2 2 2</v>";
        let range = |text: &str| whole.find(text).map_or(0..0, |at| at..at + text.len());
        let short = Shortened::new(whole, vec![range("11 12 14 15 16 17\n13"), range("2 2 2 2")]);
        assert_eq!(short.text(), "<p>0</p>\n<q/><v>0</v>");
        for (needle, list) in [("0</p>", Some("11 12 14 15 16 17\n13")), ("0</v>", Some("2 2 2 2")), ("<q/>", None)] {
            assert_eq!(short.list_at(short.text().find(needle).unwrap_or(0)), list, "{needle}");
        }
        for tag in ["<p>", "</p>", "<q/>", "<v>", "</v>"] {
            assert_eq!(short.text().find(tag).map(|at| short.place(at)), whole.find(tag), "{tag}");
        }
    }

    #[test]
    fn only_text_that_means_itself_is_plain() {
        let long = "1.5e-3 -2\t+7\n".repeat(100);
        assert!(is_plain(long.as_bytes()));
        for odd in ["&amp;", "]]>", "\u{1}", "é", "\u{7f}"] {
            assert!(!is_plain(format!("{long}{odd}{long}").as_bytes()), "{odd:?}");
        }
        assert!(holds_list(b"p") && holds_list(b"c:float_array") && !holds_list(b"pp") && !holds_list(b"init_from"));
    }
}

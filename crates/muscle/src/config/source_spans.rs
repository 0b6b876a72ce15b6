//! Where values stand in a YAML text: from the place that the parser gives for a value's beginning to its end.
//!
//! Knows the styles that muscle files are written in: block and flow collections, plain and quoted scalars, block scalars. For all else it answers
//! `None`, and so it does where it is in doubt; after a change the text is read again anyway.

use super::yaml::{Step, Yaml, locate};

/// A text and the beginnings of its lines.
pub(super) struct SourceSpans<'a> {
    /// The text.
    pub text: &'a str,
    lines: Vec<usize>,
}

impl<'a> SourceSpans<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        let lines = std::iter::once(0).chain(text.match_indices('\n').map(|(at, _)| at + 1)).collect();
        Self { text, lines }
    }

    /// Byte at which the value or key at `path` begins.
    fn start(&self, path: &[Step]) -> Option<usize> {
        let (line, column) = locate(self.text, path)?;
        let start = *self.lines.get(line.checked_sub(1)?)?;
        let rest = self.text.get(start..)?;
        let within = rest.char_indices().map(|(at, _)| at).chain([rest.len()]).nth(column.checked_sub(1)?)?;
        Some(start + within)
    }

    /// First and last byte (exclusive) of the value at `path`, which is `value`.
    pub(super) fn span(&self, path: &[Step], value: &Yaml) -> Option<(usize, usize)> {
        let start = self.start(path)?;
        let end = match self.text.as_bytes().get(start)? {
            b'[' | b'{' => self.bracket(start)?,
            quote @ (b'"' | b'\'') => self.quoted(start, *quote)?,
            b'|' | b'>' => self.block_scalar(start, path)?,
            b'&' | b'*' | b'!' => return None,
            _ => match value {
                Yaml::List(items) => {
                    let last = items.len().checked_sub(1)?;
                    self.span(&below(path, Step::Item(last)), items.get(last)?)?.1
                }
                Yaml::Map(entries) => {
                    let last = entries.len().checked_sub(1)?;
                    self.span(&below(path, Step::Value(last)), &entries.get(last)?.1)?.1
                }
                Yaml::Null => return None,
                _ => self.plain(start, path)?,
            },
        };
        Some((start, end))
    }

    /// Where a new entry of the mapping at `path` goes, and what stands before and after it.
    pub(super) fn end_of_map(&self, path: &[Step], entries: &[(Option<String>, Yaml)]) -> Option<(usize, String, &'static str)> {
        let last = entries.len().checked_sub(1)?;
        let (_, end) = self.span(&below(path, Step::Value(last)), &entries.get(last)?.1)?;
        if self.in_flow(&below(path, Step::Item(0))) {
            return Some((end, ", ".to_owned(), ""));
        }
        let first = self.start(&below(path, Step::Key(0)))?;
        let (line, column) = self.column(first)?;
        // What stands before the first key of a list's item is the item's mark.
        let indent = self.text.get(line..first)?.chars().count();
        debug_assert!(indent >= column);
        let at = self.line_end(end);
        Some((at, format!("{}{:indent$}", self.newline(), ""), ""))
    }

    /// All that goes when entry `index` of the mapping at `path` does.
    pub(super) fn entry(&self, path: &[Step], entries: &[(Option<String>, Yaml)], index: usize, value: &Yaml) -> Option<(usize, usize)> {
        let start = self.start(&below(path, Step::Key(index)))?;
        let (_, end) = self.span(&below(path, Step::Value(index)), value)?;
        let next = (index + 1 < entries.len()).then(|| self.start(&below(path, Step::Key(index + 1)))).flatten();
        let (line, _) = self.column(start)?;
        let alone = self.text.get(line..start)?.trim().is_empty();
        if self.in_flow(&below(path, Step::Item(0))) {
            return match (next, index.checked_sub(1)) {
                (Some(next), _) => Some((start, next)),
                (None, Some(before)) => Some((self.span(&below(path, Step::Value(before)), &entries.get(before)?.1)?.1, end)),
                (None, None) => Some((start, end)),
            };
        }
        if alone { Some((line, self.next_line(end))) } else { next.map(|next| (start, next)) }
    }

    /// All that goes when the item at `path` of a block list does: its lines, and none of its neighbours'.
    pub(super) fn item(&self, path: &[Step], value: &Yaml) -> Option<(usize, usize)> {
        if self.in_flow(path) {
            return None;
        }
        let (start, end) = self.span(path, value)?;
        let dash = self.text.get(..start)?.rfind('-')?;
        let line = self.column(dash)?.0;
        Some((line, self.next_line(end)))
    }

    /// Where a new item of the block list at `path` goes, the column of its mark, and the text's line end.
    pub(super) fn end_of_list(&self, path: &[Step], items: &[Yaml]) -> Option<(usize, usize, &'static str)> {
        let last = items.len().checked_sub(1)?;
        let path = below(path, Step::Item(last));
        if self.in_flow(&path) {
            return None;
        }
        let (start, end) = self.span(&path, items.get(last)?)?;
        let dash = self.text.get(..start)?.rfind('-')?;
        Some((self.line_end(end), dash - self.column(dash)?.0, self.newline()))
    }

    /// Whether a collection above the value at `path` is written in brackets.
    fn in_flow(&self, path: &[Step]) -> bool {
        (0..path.len()).any(|depth| {
            let above = path.get(..depth).and_then(|above| self.start(above));
            above.is_some_and(|start| matches!(self.text.as_bytes().get(start), Some(b'[' | b'{')))
        })
    }

    /// Beginning of the line that `at` lies in, and the column of its first letter.
    fn column(&self, at: usize) -> Option<(usize, usize)> {
        let line = self.lines.partition_point(|start| *start <= at).checked_sub(1)?;
        let start = *self.lines.get(line)?;
        let content = self.text.get(start..)?;
        Some((start, content.len() - content.trim_start_matches(' ').len()))
    }

    /// End of the line that `at` lies in, its line mark left out.
    fn line_end(&self, at: usize) -> usize {
        let rest = self.text.get(at..).unwrap_or_default();
        let end = rest.find('\n').unwrap_or(rest.len());
        at + rest.get(..end).unwrap_or_default().trim_end_matches('\r').len()
    }

    /// Beginning of the line after the one that `at` lies in.
    fn next_line(&self, at: usize) -> usize {
        self.text.get(at..).and_then(|rest| rest.find('\n')).map_or(self.text.len(), |end| at + end + 1)
    }

    fn newline(&self) -> &'static str {
        if self.text.contains("\r\n") { "\r\n" } else { "\n" }
    }

    fn plain(&self, start: usize, path: &[Step]) -> Option<usize> {
        let rest = self.text.get(start..)?;
        let line = rest.get(..rest.find('\n').unwrap_or(rest.len()))?;
        let mut end = line.find(" #").unwrap_or(line.len());
        if self.in_flow(path) {
            end = end.min(line.find([',', ']', '}']).unwrap_or(line.len()));
        }
        Some(start + line.get(..end)?.trim_end().len())
    }

    fn quoted(&self, start: usize, quote: u8) -> Option<usize> {
        let bytes = self.text.as_bytes();
        let mut at = start + 1;
        while let Some(byte) = bytes.get(at) {
            if *byte == b'\\' && quote == b'"' {
                at += 1;
            } else if *byte == quote {
                // In single quotes a doubled one is a letter.
                if quote == b'"' || bytes.get(at + 1) != Some(&quote) {
                    return Some(at + 1);
                }
                at += 1;
            }
            at += 1;
        }
        None
    }

    fn bracket(&self, start: usize) -> Option<usize> {
        let bytes = self.text.as_bytes();
        let (mut at, mut open) = (start, 0_usize);
        while let Some(byte) = bytes.get(at) {
            let before = at.checked_sub(1).and_then(|before| bytes.get(before)).copied().unwrap_or(b' ');
            match byte {
                b'[' | b'{' => open += 1,
                b']' | b'}' => {
                    open -= 1;
                    if open == 0 {
                        return Some(at + 1);
                    }
                }
                b'#' if before.is_ascii_whitespace() => at = self.line_end(at),
                b'"' | b'\'' if matches!(before, b' ' | b'[' | b'{' | b',' | b':' | b'\n') => {
                    at = self.quoted(at, *byte)?;
                    continue;
                }
                _ => {}
            }
            at += 1;
        }
        None
    }

    /// A block scalar goes on as long as lines are empty or deeper than the key that it belongs to.
    fn block_scalar(&self, start: usize, path: &[Step]) -> Option<usize> {
        let (Step::Value(index), above) = path.split_last()? else { return None };
        let key = self.start(&below(above, Step::Key(*index)))?;
        let indent = key - self.column(key)?.0;
        let mut end = self.line_end(start);
        let mut line = self.next_line(start);
        while line < self.text.len() {
            let content = self.text.get(line..self.line_end(line))?;
            let depth = content.len() - content.trim_start_matches(' ').len();
            if !content.trim().is_empty() {
                if depth <= indent {
                    break;
                }
                end = line + content.len();
            }
            line = self.next_line(line);
        }
        Some(end)
    }
}

fn below(path: &[Step], step: Step) -> Vec<Step> {
    path.iter().copied().chain([step]).collect()
}

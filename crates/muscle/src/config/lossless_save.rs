//! Saving over a text written in an editor: only what changed is changed, so that comments, order and layout stay.
//!
//! Old and new file are both written in the canonical form and compared; each difference is then made in the text, at the place that the parser
//! gives for it. The result is read again, and where it does not say exactly what it should (aliases, a style that is not known here), the file
//! is written anew instead, and [`SaveResult::comments_lost`] says what that cost.

use super::source_spans::SourceSpans;
use super::spec::MuscleFile;
use super::write::{flow, muscle_lines};
use super::yaml::{Step, Yaml, read};

/// A file's text, and what was lost on the way.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SaveResult {
    /// YAML that reads back as exactly the file.
    pub text: String,
    /// Whether comments of the original text are not in the new one.
    pub comments_lost: bool,
}

impl MuscleFile {
    /// The file as YAML, made from the text that it was read from: comments, order and layout stay where they can. Reading the result gives an equal
    /// file, whatever the original was.
    pub fn to_yaml_keeping(&self, original: &str) -> SaveResult {
        let anew = || SaveResult { text: self.to_yaml(), comments_lost: has_comment(original) };
        let (mark, body) = original.strip_prefix('\u{feff}').map_or(("", original), |body| ("\u{feff}", body));
        let Ok(old) = Self::parse(body) else { return anew() };
        if equal_but_for_format(&old, self) {
            return SaveResult { text: original.to_owned(), comments_lost: false };
        }
        let Some((text, comments_lost)) = patch(body, &old, self) else { return anew() };
        match Self::parse(&text) {
            Ok(read) if equal_but_for_format(&read, self) => SaveResult { text: format!("{mark}{text}"), comments_lost },
            _ => anew(),
        }
    }
}

/// Whether two files say the same, whatever the form they are written in.
fn equal_but_for_format(a: &MuscleFile, b: &MuscleFile) -> bool {
    *a == MuscleFile { form: a.form, ..b.clone() }
}

/// Whether a line has a `#` that begins a comment, near enough: one in quotes counts too.
fn has_comment(text: &str) -> bool {
    text.lines().any(|line| line.trim_start().starts_with('#') || line.contains(" #"))
}

/// The body with the differences of the two files made in it, and whether a comment went; `None` where that cannot be done.
fn patch(body: &str, old: &MuscleFile, new: &MuscleFile) -> Option<(String, bool)> {
    let canonical = |file: &MuscleFile| read(&MuscleFile { form: old.form, ..file.clone() }.to_yaml()).ok();
    let (before, after, tree) = (canonical(old)?, canonical(new)?, read(body).ok()?);
    let mut patch = Patch { places: SourceSpans::new(body), edits: Vec::new(), lost: false, new };
    patch.change(&mut Vec::new(), &tree, &before, &after)?;
    let mut edits = patch.edits;
    edits.sort_by_key(|(start, ..)| *start);
    let mut text = String::with_capacity(body.len() + 256);
    let mut done = 0;
    for (start, end, with) in edits {
        // Overlapping edits would mean two changes of one value.
        text.push_str(body.get(done..start)?);
        text.push_str(&with);
        done = end;
    }
    text.push_str(body.get(done..)?);
    Some((text, patch.lost))
}

struct Patch<'a> {
    places: SourceSpans<'a>,
    /// Start, end and new text, in bytes of the body.
    edits: Vec<(usize, usize, String)>,
    lost: bool,
    new: &'a MuscleFile,
}

impl Patch<'_> {
    /// Makes the value at `path` of the text, which is `here`, change as `before` did to become `after`.
    fn change(&mut self, path: &mut Vec<Step>, here: &Yaml, before: &Yaml, after: &Yaml) -> Option<()> {
        match (here, before, after) {
            _ if before == after => Some(()),
            (Yaml::Map(here), Yaml::Map(before), Yaml::Map(after)) => self.change_map(path, here, before, after),
            (Yaml::List(here), Yaml::List(before), Yaml::List(after)) if here.len() == before.len() && before.len() == after.len() => {
                for (index, here) in here.iter().enumerate() {
                    path.push(Step::Item(index));
                    self.change(path, here, before.get(index)?, after.get(index)?)?;
                    path.pop();
                }
                Some(())
            }
            (Yaml::List(items), Yaml::List(before), Yaml::List(list)) if before.iter().all(|item| matches!(item, Yaml::Map(_))) => {
                let (edits, lost) = (self.edits.len(), self.lost);
                self.change_items(&mut path.clone(), items, before, list).or_else(|| {
                    self.lost = lost;
                    self.edits.truncate(edits);
                    // What is in a muscle fits on a line; a list of muscles does not.
                    if path.len() > 1 { self.replace(path, here, &flow(after)) } else { None }
                })
            }
            _ => self.replace(path, here, &flow(after)),
        }
    }

    fn replace(&mut self, path: &[Step], here: &Yaml, with: &str) -> Option<()> {
        let (start, end) = self.places.span(path, here)?;
        self.lost |= has_comment(self.places.text.get(start..end)?);
        self.edits.push((start, end, with.to_owned()));
        Some(())
    }

    fn change_map(&mut self, path: &mut Vec<Step>, here: &Entries, before: &Entries, after: &Entries) -> Option<()> {
        for (key, value) in after {
            let old = find(before, key.as_deref()?).map(|(_, value)| value);
            if old == Some(value) {
                continue;
            }
            match find(here, key.as_deref()?).filter(|(_, there)| **there != Yaml::Null) {
                Some((index, there)) => {
                    path.push(Step::Value(index));
                    self.change(path, there, old.unwrap_or(&Yaml::Null), value)?;
                    path.pop();
                }
                None => {
                    let (at, before, after) = self.places.end_of_map(path, here)?;
                    self.edits.push((at, at, format!("{before}{}: {}{after}", key.as_deref()?, flow(value))));
                }
            }
        }
        for (key, _) in before {
            let key = key.as_deref()?;
            if let (None, Some((index, value))) = (find(after, key), find(here, key)) {
                let (start, end) = self.places.entry(path, here, index, value)?;
                self.edits.push((start, end, String::new()));
            }
        }
        Some(())
    }

    /// Items added and removed: those that stay are known by their name, or by being equal.
    fn change_items(&mut self, path: &mut Vec<Step>, here: &[Yaml], before: &[Yaml], after: &[Yaml]) -> Option<()> {
        if here.len() != before.len() {
            return None;
        }
        let are_muscles = matches!(path.as_slice(), [Step::Value(_)]);
        let same = |a: &Yaml, b: &Yaml| a == b || matches!((name(a), name(b)), (Some(a), Some(b)) if a == b);
        let mut next = 0;
        let mut stays = vec![None; after.len()];
        for (index, item) in before.iter().enumerate() {
            let found = after.iter().enumerate().skip(next).find(|(_, other)| same(item, other)).map(|(at, _)| at);
            path.push(Step::Item(index));
            match found.and_then(|at| stays.get_mut(at).zip(after.get(at)).map(|(slot, new)| (at, slot, new))) {
                Some((at, slot, new)) => {
                    *slot = Some(index);
                    next = at + 1;
                    self.change(path, here.get(index)?, item, new)?;
                }
                None => {
                    let (start, end) = self.places.item(path, here.get(index)?)?;
                    self.edits.push((start, end, String::new()));
                }
            }
            path.pop();
        }
        let (last, indent, line_end) = self.places.end_of_list(path, here)?;
        for (index, stays_as) in stays.iter().enumerate() {
            if stays_as.is_some() {
                continue;
            }
            // Only the end of the list takes new ones: that is where the window adds them.
            if stays.iter().skip(index).any(Option::is_some) {
                return None;
            }
            let lines = if are_muscles { muscle_lines(self.new.muscles.get(index)?, indent + 2) } else { flow(after.get(index)?) };
            let body = lines.trim_start().trim_end().replace('\n', line_end);
            self.edits.push((last, last, format!("{line_end}{:indent$}- {body}", "")));
        }
        Some(())
    }
}

type Entries = [(Option<String>, Yaml)];

fn find<'a>(entries: &'a Entries, key: &str) -> Option<(usize, &'a Yaml)> {
    entries.iter().enumerate().find(|(_, (name, _))| name.as_deref() == Some(key)).map(|(index, (_, value))| (index, value))
}

fn name(item: &Yaml) -> Option<&str> {
    let Yaml::Map(entries) = item else { return None };
    match find(entries, "name")?.1 {
        Yaml::Text(name) => Some(name),
        _ => None,
    }
}

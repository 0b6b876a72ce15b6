//! Suggestions for mistyped commands.

use std::ffi::OsString;
use std::path::Path;

use clap::Command;

use crate::tr;

/// `sinew rendr walk.dae -o walk.png`: a first argument that is neither a command nor a file, and has neither an ending nor a folder as a file would.
/// Says so, and which command is like it.
pub(super) fn first_word(arguments: &[OsString], all: &Command) -> Option<String> {
    let word = arguments.get(1)?.to_str()?;
    if word.is_empty() || word.starts_with('-') || word.contains(['.', '/', '\\']) || Path::new(word).exists() {
        return None;
    }
    if all.get_subcommands().any(|command| command.get_name() == word) {
        return None;
    }
    Some(match like(word, all) {
        Some(name) => tr!("cli-command-mistyped", word = word, name = name),
        None => tr!("cli-command-unknown", word = word),
    })
}

/// The command that a word is nearest to, if it is near to one: it begins like it, or a third of its letters is wrong at most.
pub(super) fn like<'a>(word: &str, all: &'a Command) -> Option<&'a str> {
    let word = word.to_lowercase();
    let names = || all.get_subcommands().map(Command::get_name);
    let near = |name: &&str| edits(&word, name);
    let nearest = names().min_by_key(near).filter(|name| near(name) <= (name.chars().count() / 3).max(1));
    nearest.or_else(|| names().find(|name| word.chars().count() >= 3 && (name.starts_with(&word) || word.starts_with(name))))
}

/// How many letters must be put in, taken out, replaced or exchanged with their neighbour to get from one word to the other.
fn edits(from: &str, to: &str) -> usize {
    let (from, to): (Vec<char>, Vec<char>) = (from.chars().collect(), to.chars().collect());
    // The rows of the table of distances between the words' beginnings: of the letter before the last, the last, and this one.
    let (mut before, mut last): (Vec<usize>, Vec<usize>) = (Vec::new(), (0..=to.len()).collect());
    for (i, a) in from.iter().enumerate() {
        let mut row = vec![i + 1];
        for (j, b) in to.iter().enumerate() {
            let at = |row: &[usize], place: usize| row.get(place).copied().unwrap_or(usize::MAX - 1);
            let mut least = (at(&last, j) + usize::from(a != b)).min(at(&last, j + 1) + 1).min(at(&row, j) + 1);
            let exchanged = i > 0 && j > 0 && from.get(i - 1) == Some(b) && to.get(j - 1) == Some(a);
            if exchanged {
                least = least.min(at(&before, j - 1) + 1);
            }
            row.push(least);
        }
        before = std::mem::replace(&mut last, row);
    }
    last.last().copied().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::command;

    #[test]
    fn edits_are_counted() {
        for (from, to, count) in [
            ("render", "render", 0),
            ("rendr", "render", 1),
            ("inof", "info", 1),
            ("redner", "render", 1),
            ("", "help", 4),
            ("help", "", 4),
            ("kitten", "sitting", 3),
        ] {
            assert_eq!(edits(from, to), count, "{from} {to}");
        }
    }

    #[test]
    fn near_words_are_found_and_far_ones_are_not() {
        let all = command();
        for (word, name) in [
            ("rendr", Some("render")),
            ("Render", Some("render")),
            ("rendering", Some("render")),
            ("inof", Some("info")),
            ("messure", Some("measure")),
            ("comp", Some("completions")),
            ("conver", Some("convert")),
            ("fi", Some("fit")),
            ("chekc", Some("check")),
            ("foo", None),
            ("walk", None),
            ("x", None),
        ] {
            assert_eq!(like(word, &all), name, "{word}");
        }
    }
}

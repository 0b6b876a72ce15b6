//! `sinew [FILE…]`: the window, or a sentence that says what to do without one.

use std::path::PathBuf;
use std::process::ExitCode;

use super::failure::Failure;
use crate::tr;

/// Opens the window with these files.
pub fn open(files: Vec<PathBuf>) -> ExitCode {
    if let Some(meant) = mistyped_command(&files) {
        return Failure::usage(meant).report();
    }
    start(files)
}

#[cfg(feature = "gui")]
fn start(files: Vec<PathBuf>) -> ExitCode {
    if has_display() {
        return crate::app::run(files);
    }
    Failure::Files(vec![tr!("cli-no-display")]).report()
}

#[cfg(not(feature = "gui"))]
fn start(_files: Vec<PathBuf>) -> ExitCode {
    Failure::Files(vec![tr!("cli-no-window")]).report()
}

/// Whether there is a screen to open a window on. GTK would say so too, but in words that help nobody.
#[cfg(feature = "gui")]
fn has_display() -> bool {
    !cfg!(all(unix, not(target_os = "macos")))
        || ["WAYLAND_DISPLAY", "DISPLAY"].iter().any(|name| std::env::var_os(name).is_some_and(|value| !value.is_empty()))
}

/// `sinew rendr walk.dae`: a first argument that is no file but nearly a command.
fn mistyped_command(files: &[PathBuf]) -> Option<String> {
    let first = files.first()?;
    let word = first.to_str()?;
    if first.exists() || word.contains(['.', '/', '\\']) {
        return None;
    }
    ["info", "check", "render", "export", "measure", "bench", "help"]
        .into_iter()
        .find(|name| edits(word, name) <= 2)
        .map(|name| tr!("cli-command-mistyped", word = word, name = name))
}

/// How many letters must be put in, taken out or replaced to get from one word to the other (Levenshtein's distance).
fn edits(from: &str, to: &str) -> usize {
    let to: Vec<char> = to.chars().collect();
    let mut row: Vec<usize> = (0..=to.len()).collect();
    for (i, a) in from.chars().enumerate() {
        let mut diagonal = i;
        let mut left = i + 1;
        for (cell, b) in row.iter_mut().skip(1).zip(&to) {
            let above = *cell;
            left = (diagonal + usize::from(a != *b)).min(above + 1).min(left + 1);
            diagonal = above;
            *cell = left;
        }
        if let Some(first) = row.first_mut() {
            *first = i + 1;
        }
    }
    row.last().copied().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edits_are_counted() {
        for (from, to, count) in
            [("render", "render", 0), ("rendr", "render", 1), ("inof", "info", 2), ("", "help", 4), ("kitten", "sitting", 3)]
        {
            assert_eq!(edits(from, to), count, "{from} {to}");
        }
    }
}

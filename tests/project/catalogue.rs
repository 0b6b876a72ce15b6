//! The translation catalogue against the sources: nothing missing, nothing left over, the same arguments in both languages.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// All files below `folder` with this ending.
fn files(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        if path.is_dir() {
            found.extend(files(&path, ending));
        } else if path.extension().is_some_and(|e| e == ending) {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// Messages of a language with their text, continuation lines included.
fn messages(language: &str) -> BTreeMap<String, String> {
    let mut all: BTreeMap<String, String> = BTreeMap::new();
    for file in files(&root().join("resources/locales").join(language), "ftl") {
        let mut key = None;
        for line in fs::read_to_string(&file).expect("readable").lines() {
            match line.split_once(" =") {
                Some((name, text)) if name.starts_with(|c: char| c.is_ascii_lowercase()) => {
                    key = Some(name.to_owned());
                    assert!(all.insert(name.to_owned(), text.to_owned()).is_none(), "{name} stands twice in {language}");
                }
                _ if line.starts_with([' ', '\t']) => {
                    if let Some(text) = key.as_ref().and_then(|key| all.get_mut(key)) {
                        text.push_str(line);
                    }
                }
                _ => key = None,
            }
        }
    }
    assert!(!all.is_empty(), "no catalogue for {language}");
    all
}

/// Names of the arguments in a message.
fn arguments(text: &str) -> BTreeSet<&str> {
    let end = |rest: &str| rest.find(|c: char| !(c.is_alphanumeric() || c == '_' || c == '-')).unwrap_or(rest.len());
    text.split('$').skip(1).map(|rest| &rest[..end(rest)]).collect()
}

/// The sources of the program and of its libraries.
fn rust_sources() -> Vec<PathBuf> {
    ["src", "crates"].into_iter().flat_map(|folder| files(&root().join(folder), "rs")).collect()
}

/// Every string literal and `tr:` placeholder of the sources that looks like the name of a message.
fn names_in_sources() -> BTreeSet<String> {
    let mut sources = rust_sources();
    sources.extend(files(&root().join("src"), "ui"));
    let mut names = BTreeSet::new();
    for file in sources {
        let text = fs::read_to_string(&file).expect("readable");
        // A piece with a brace behind it, as in `app-do-{name}`, stands for all messages that begin so, and keeps its last hyphen.
        for piece in text.split(|c: char| !(c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-')) {
            if piece.contains('-') {
                names.insert(piece.to_owned());
            }
        }
    }
    names
}

#[test]
fn every_message_takes_the_same_arguments_in_both_languages() {
    let (english, russian) = (messages("en"), messages("ru"));
    assert_eq!(english.keys().collect::<Vec<_>>(), russian.keys().collect::<Vec<_>>());
    for (key, text) in &english {
        assert_eq!(arguments(text), arguments(&russian[key]), "arguments of {key}");
    }
}

/// The messages that a source looks up by their names, each with what stands behind its name in the call.
fn looked_up(source: &str) -> impl Iterator<Item = (&str, &str)> {
    ["tr!(", "message!("].into_iter().flat_map(|call| source.split(call).skip(1)).filter_map(|rest| {
        let (key, rest) = rest.trim_start().strip_prefix('"')?.split_once('"')?;
        let mut depth = 1_usize;
        let mut in_text = false;
        let end = rest.char_indices().find(|(_, letter)| {
            match letter {
                '"' => in_text = !in_text,
                '(' | '[' | '{' if !in_text => depth += 1,
                ')' | ']' | '}' if !in_text => depth -= 1,
                _ => {}
            }
            depth == 0
        });
        Some((key, &rest[..end?.0]))
    })
}

#[test]
fn every_argument_of_a_message_is_given() {
    let catalogue = messages("en");
    let mut missing = BTreeSet::new();
    for file in rust_sources() {
        let text = fs::read_to_string(&file).expect("readable");
        for (key, given) in looked_up(&text) {
            let Some(message) = catalogue.get(key) else { continue };
            let is_given = |name: &&str| given.contains(&format!("{name} = "));
            missing.extend(
                arguments(message).into_iter().filter(|name| !is_given(name)).map(|name| format!("{name} of {key} in {}", file.display())),
            );
        }
    }
    assert!(missing.is_empty(), "not given: {missing:#?}");
}

#[test]
fn every_name_that_the_sources_look_up_is_in_the_catalogue() {
    let catalogue = messages("en");
    let mut missing = BTreeSet::new();
    for file in rust_sources() {
        let text = fs::read_to_string(&file).expect("readable");
        let text = text.replace("include_str!(", "");
        missing.extend(
            looked_up(&text)
                .filter(|(key, _)| !catalogue.contains_key(*key) && *key != "key")
                .map(|(key, _)| format!("{key} in {}", file.display())),
        );
    }
    for file in files(&root().join("src"), "ui") {
        let text = fs::read_to_string(&file).expect("readable");
        let end = |rest: &str| rest.find(|c: char| !(c.is_ascii_alphanumeric() || c == '-')).unwrap_or(rest.len());
        let placeholders = text.split("tr:").skip(1).map(|rest| rest[..end(rest)].to_owned());
        missing.extend(placeholders.filter(|key| !catalogue.contains_key(key)).map(|key| format!("{key} in {}", file.display())));
    }
    // The documentation of the macro itself shows a name that isn't there.
    missing.retain(|entry| !entry.starts_with("open-failed in "));
    assert!(missing.is_empty(), "not in the catalogue: {missing:#?}");
}

#[test]
fn every_message_is_used_somewhere() {
    let names = names_in_sources();
    let is_used = |key: &String| names.contains(key) || key.match_indices('-').any(|(at, _)| names.contains(&key[..=at]));
    let unused: Vec<_> = messages("en").into_keys().filter(|key| !is_used(key)).collect();
    assert!(unused.is_empty(), "in the catalogue and used nowhere: {unused:#?}");
}

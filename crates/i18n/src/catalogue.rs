//! Loads the catalogue that is compiled in and looks messages up.

use std::borrow::Cow;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU8, Ordering};

use fluent_bundle::concurrent::FluentBundle;
use fluent_bundle::{FluentArgs, FluentResource, FluentValue};
use unic_langid::LanguageIdentifier;

/// A language that the interface speaks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Language {
    /// English, which every other language falls back to.
    English,
    /// Russian.
    Russian,
}

impl Language {
    /// All languages, English first.
    pub const ALL: [Self; 2] = [Self::English, Self::Russian];

    /// The language that a locale name such as `ru_RU.UTF-8` or `en-GB` asks for; English for any other.
    pub fn from_locale(name: &str) -> Self {
        if name.to_ascii_lowercase().starts_with("ru") { Self::Russian } else { Self::English }
    }

    fn id(self) -> LanguageIdentifier {
        match self {
            Self::English => "en".parse().unwrap_or_default(),
            Self::Russian => "ru".parse().unwrap_or_default(),
        }
    }

    /// The files of the catalogue: what they are called and what is in them.
    fn files(self) -> &'static [(&'static str, &'static str); FILES] {
        macro_rules! files {
            ($language:literal: $($name:literal),*) => {
                &[$(($name, include_str!(concat!("../locales/", $language, "/", $name, ".ftl")))),*]
            };
        }
        match self {
            Self::English => files!("en": "cli", "render", "document", "collada", "muscle", "app"),
            Self::Russian => files!("ru": "cli", "render", "document", "collada", "muscle", "app"),
        }
    }
}

/// Number of files in the catalogue.
const FILES: usize = 6;

type MessageBundle = FluentBundle<FluentResource>;

/// 0 = not chosen yet, 1 = English, 2 = Russian.
static CHOSEN: AtomicU8 = AtomicU8::new(0);

/// The present language: the one set, else the one that the environment asks for.
pub fn language() -> Language {
    match CHOSEN.load(Ordering::Relaxed) {
        1 => Language::English,
        2 => Language::Russian,
        _ => {
            let found = from_environment();
            set_language(found);
            found
        }
    }
}

/// Chooses the language for everything that is said from now on.
pub fn set_language(language: Language) {
    let code = match language {
        Language::English => 1,
        Language::Russian => 2,
    };
    CHOSEN.store(code, Ordering::Relaxed);
}

/// POSIX order: `LC_ALL`, `LC_MESSAGES`, `LANG`; then what the system says.
fn from_environment() -> Language {
    ["LC_ALL", "LC_MESSAGES", "LANG"]
        .iter()
        .filter_map(|name| std::env::var(name).ok())
        .find(|value| !value.is_empty())
        .or_else(sys_locale::get_locale)
        .map_or(Language::English, |name| Language::from_locale(&name))
}

/// One file of the catalogue, parsed when it is first asked for: a command needs few of them, and all together would take a good part of its start.
fn bundle(language: Language, file: usize) -> Option<&'static MessageBundle> {
    static ENGLISH: [OnceLock<MessageBundle>; FILES] = [const { OnceLock::new() }; FILES];
    static RUSSIAN: [OnceLock<MessageBundle>; FILES] = [const { OnceLock::new() }; FILES];
    let slots = match language {
        Language::English => &ENGLISH,
        Language::Russian => &RUSSIAN,
    };
    let (slot, (_, text)) = (slots.get(file)?, language.files().get(file)?);
    Some(slot.get_or_init(|| {
        let mut bundle = MessageBundle::new_concurrent(vec![language.id()]);
        // Isolation marks are for mixed-direction text; on a terminal they are noise.
        bundle.set_use_isolating(false);
        // The function NUMBER; to add it fails only where it is there already.
        let _ = bundle.add_builtins();
        // A syntax slip loses its message only; the catalogue test refuses it.
        let resource = FluentResource::try_new((*text).to_owned()).unwrap_or_else(|(partial, _)| partial);
        bundle.add_resource_overriding(resource);
        bundle
    }))
}

/// The files in which `key` may stand: first the one that its first word names.
fn files_for(key: &str) -> impl Iterator<Item = usize> {
    let word = key.split('-').next().unwrap_or_default();
    let named = Language::English.files().iter().position(|(name, _)| *name == word);
    named.into_iter().chain((0..FILES).filter(move |file| Some(*file) != named))
}

/// The message `key` in the present language with `arguments` filled in. Prefer the macro [`tr!`](crate::tr).
pub fn message(key: &str, arguments: &[(&str, FluentValue<'_>)]) -> String {
    message_in(language(), key, arguments)
}

/// The same in another language.
pub(super) fn message_in(language: Language, key: &str, arguments: &[(&str, FluentValue<'_>)]) -> String {
    lookup(language, key, arguments).or_else(|| lookup(Language::English, key, arguments)).unwrap_or_else(|| key.to_owned())
}

fn lookup(language: Language, key: &str, arguments: &[(&str, FluentValue<'_>)]) -> Option<String> {
    let (bundle, pattern) = files_for(key).find_map(|file| {
        let bundle = bundle(language, file)?;
        Some((bundle, bundle.get_message(key)?.value()?))
    })?;
    let mut given = FluentArgs::with_capacity(arguments.len());
    for (name, value) in arguments {
        given.set(*name, safe(value));
    }
    let mut errors = Vec::new();
    Some(bundle.format_pattern(pattern, Some(&given), &mut errors).into_owned())
}

/// An argument as it may be shown.
fn safe<'a>(value: &FluentValue<'a>) -> FluentValue<'a> {
    match value {
        FluentValue::String(text) => FluentValue::String(match text {
            Cow::Borrowed(text) => super::shown(text),
            Cow::Owned(text) => Cow::Owned(super::shown(text).into_owned()),
        }),
        other => other.clone(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    fn keys(language: Language) -> BTreeSet<String> {
        let mut keys = BTreeSet::new();
        for (_, text) in language.files() {
            assert!(FluentResource::try_new((*text).to_owned()).is_ok(), "a catalogue file of {language:?} has a syntax error");
            for line in text.lines() {
                if let Some((key, _)) = line.split_once(" =")
                    && key.chars().next().is_some_and(|c| c.is_ascii_lowercase())
                {
                    assert!(keys.insert(key.to_owned()), "{key} stands twice in the catalogue of {language:?}");
                }
            }
        }
        keys
    }

    #[test]
    fn both_languages_have_the_same_messages() {
        let (english, russian) = (keys(Language::English), keys(Language::Russian));
        assert_eq!(english.difference(&russian).collect::<Vec<_>>(), Vec::<&String>::new(), "missing in Russian");
        assert_eq!(russian.difference(&english).collect::<Vec<_>>(), Vec::<&String>::new(), "missing in English");
    }

    #[test]
    fn every_message_is_found_wherever_it_stands() {
        for language in Language::ALL {
            for key in keys(language) {
                assert!(lookup(language, &key, &[]).is_some(), "{key}");
            }
        }
        assert_eq!(lookup(Language::English, "nobody-says-this", &[]), None);
    }

    #[test]
    fn locale_names_choose_a_language() {
        assert_eq!(Language::from_locale("ru_RU.UTF-8"), Language::Russian);
        assert_eq!(Language::from_locale("C.UTF-8"), Language::English);
        assert_eq!(Language::from_locale("de_DE"), Language::English);
    }
}

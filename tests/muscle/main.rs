//! Muscles: the profile, the line of action, the surface, the YAML and its editing.

#[path = "../support/mod.rs"]
mod support;

mod attach;
mod config;
mod demo_arm;
mod edit;
mod experiment;
mod flesh;
mod geometry;
mod joint;
mod line;
mod pappus;
mod paths;
mod pennation;
mod profile;
mod save;
mod schema;
mod sets;
mod skin_layer;

use std::sync::{Mutex, PoisonError};

use sinew::i18n::{Language, set_language};

/// Runs what looks at sentences with each language in turn, which all tests of this program share.
fn in_each_language(mut check: impl FnMut(Language)) {
    static LANGUAGE: Mutex<()> = Mutex::new(());
    let _alone = LANGUAGE.lock().unwrap_or_else(PoisonError::into_inner);
    for language in Language::ALL {
        set_language(language);
        check(language);
    }
}

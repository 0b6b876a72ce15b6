//! What a library reports, said in both languages.

use sinew_i18n::{Language, Sentence, set_language};
use sinew_scene::message;
use sinew_scene::message::{Location, Message};

/// A finding of the muscle reader in a file: a profile with one node only.
pub(crate) fn finding() -> Message {
    let location = Location { file: "arm.yaml".into(), line: Some(3), column: Some(7) };
    message!("muscle-too-few-nodes", count = 1_u32).at(location)
}

/// The sentence in a language.
pub(crate) fn said_in(language: Language, message: &Message) -> String {
    set_language(language);
    message.sentence()
}

fn main() {
    let finding = finding();
    println!("in a log: {finding}");
    for language in Language::ALL {
        println!("{language:?}: {}", said_in(language, &finding));
    }
}

//! What was wrong with a call, said in one sentence of the catalogue instead of clap's own words.

use clap::error::{ContextKind, ContextValue, ErrorKind};

use crate::tr;

/// The sentence for an error of the argument parser.
pub(super) fn sentence(error: &clap::Error) -> String {
    let option = text(error, ContextKind::InvalidArg);
    let given = text(error, ContextKind::InvalidValue);
    match error.kind() {
        ErrorKind::UnknownArgument | ErrorKind::InvalidSubcommand => unknown(error, &option),
        ErrorKind::InvalidValue if given.is_empty() && !option.starts_with('-') => tr!("cli-argument-empty", what = bare(&option)),
        ErrorKind::InvalidValue if given.is_empty() => tr!("cli-value-missing", option = bare(&option)),
        ErrorKind::InvalidValue => {
            tr!("cli-value-not-one-of", option = bare(&option), value = given, choices = list(error, ContextKind::ValidValue))
        }
        ErrorKind::ValueValidation => {
            let why = std::error::Error::source(error).map(ToString::to_string).unwrap_or_default();
            tr!("cli-value-wrong", option = bare(&option), value = given, why = why)
        }
        ErrorKind::NoEquals | ErrorKind::TooFewValues | ErrorKind::WrongNumberOfValues => tr!("cli-value-missing", option = bare(&option)),
        ErrorKind::TooManyValues => tr!("cli-value-not-taken", option = bare(&option), value = given),
        ErrorKind::ArgumentConflict => conflict(error, &option),
        ErrorKind::MissingRequiredArgument => tr!("cli-argument-missing", what = list(error, ContextKind::InvalidArg)),
        ErrorKind::InvalidUtf8 => tr!("cli-value-not-text"),
        _ => tr!("cli-usage-error"),
    }
}

fn unknown(error: &clap::Error, option: &str) -> String {
    let option = if option.is_empty() { text(error, ContextKind::InvalidSubcommand) } else { option.to_owned() };
    let suggestion = [ContextKind::SuggestedArg, ContextKind::SuggestedSubcommand].map(|kind| list(error, kind)).concat();
    match (option.starts_with('-'), suggestion.is_empty()) {
        (true, false) => tr!("cli-option-unknown-similar", option = option, similar = bare(&suggestion)),
        (true, true) => tr!("cli-option-unknown", option = option),
        (false, _) => tr!("cli-argument-too-many", argument = option),
    }
}

fn conflict(error: &clap::Error, option: &str) -> String {
    let prior = list(error, ContextKind::PriorArg);
    if prior.is_empty() || bare(&prior) == bare(option) {
        tr!("cli-option-twice", option = bare(option))
    } else {
        tr!("cli-options-contradict", one = bare(option), other = prior)
    }
}

/// `--size <WxH>` without the value's name, `<--times <T>|--joints>` as `--times|--joints`.
fn bare(option: &str) -> String {
    if let Some(group) = option.strip_prefix('<').and_then(|group| group.strip_suffix('>')).filter(|group| group.starts_with("--")) {
        return group.split('|').map(bare).collect::<Vec<_>>().join("|");
    }
    option.split([' ', '=']).next().unwrap_or(option).trim_end_matches("...").trim_matches(['<', '>', '[', ']']).to_owned()
}

fn text(error: &clap::Error, kind: ContextKind) -> String {
    match error.get(kind) {
        Some(ContextValue::String(text)) => text.clone(),
        Some(ContextValue::Strings(texts)) => texts.first().cloned().unwrap_or_default(),
        _ => String::new(),
    }
}

fn list(error: &clap::Error, kind: ContextKind) -> String {
    match error.get(kind) {
        Some(ContextValue::String(text)) => bare(text),
        Some(ContextValue::Strings(texts)) => texts.iter().map(|text| bare(text)).collect::<Vec<_>>().join(", "),
        _ => String::new(),
    }
}

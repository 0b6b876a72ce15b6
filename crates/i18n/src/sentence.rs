//! Sentences in the user's language of what the libraries report.

use super::{FluentValue, catalogue, decimal, label, quantity, shown};
use crate::tr;
use sinew_scene::diagnostics::{Diagnostic, DiagnosticKind};
use sinew_scene::message::{Location, Message, SourceName, ToMessage, Value};

/// The sentence of a message, behind the place that it speaks of: `file:line:column: what`.
pub fn sentence(message: &Message) -> String {
    let what = what(message);
    if message.location.is_empty() { what } else { format!("{}: {what}", location(&message.location)) }
}

/// What something was read from: a path as it is, in words what has none.
pub fn source_name(name: &SourceName) -> String {
    match name {
        SourceName::Unknown => String::new(),
        SourceName::Path(path) => path.clone(),
        SourceName::StandardInput => tr!("document-standard-input"),
        SourceName::BuiltIn => tr!("document-built-in"),
        SourceName::New(0) => tr!("document-new-muscles"),
        SourceName::New(number) => tr!("document-new-muscles-number", number = number + 1),
    }
}

/// `file:line:column`, without what is not known.
fn location(location: &Location) -> String {
    let mut text = shown(&source_name(&location.file)).into_owned();
    for number in [location.line, location.column].into_iter().flatten() {
        text.push_str(&format!(":{number}"));
    }
    text
}

/// The sentence without the place.
fn what(message: &Message) -> String {
    let arguments: Vec<(&str, FluentValue<'_>)> = message.parameters.iter().map(|(name, value)| (*name, argument(value))).collect();
    catalogue::message(message.key, &arguments)
}

fn argument(value: &Value) -> FluentValue<'_> {
    match value {
        Value::Text(text) => FluentValue::from(text.as_str()),
        Value::Number(number) => FluentValue::from(*number),
        Value::Decimal { value, digits } => FluentValue::from(decimal(*value, *digits)),
        Value::Signed { value, digits } => FluentValue::from(quantity::number(*value, *digits)),
        Value::Message(message) => FluentValue::from(sentence(message)),
    }
}

/// What can be said in the user's language.
pub trait Sentence {
    /// The sentence, behind the place that it speaks of.
    fn sentence(&self) -> String;
}

impl<T: ToMessage + ?Sized> Sentence for T {
    fn sentence(&self) -> String {
        sentence(&self.message())
    }
}

/// What was found and in how many more places, without where.
pub fn finding<F: DiagnosticKind>(diagnostic: &Diagnostic<F>) -> String {
    let mut text = what(&diagnostic.message());
    if diagnostic.more_places > 0 {
        text.push(' ');
        text.push_str(&tr!("finding-more-places", count = diagnostic.more_places));
    }
    text
}

/// A finding on one line, without what is not known: `file:line: element: message [code]`.
pub fn finding_line<F: DiagnosticKind>(diagnostic: &Diagnostic<F>) -> String {
    let mut text = source_name(&diagnostic.file);
    if !text.is_empty() {
        if let Some(line) = diagnostic.line {
            text.push_str(&format!(":{line}"));
        }
        text.push_str(": ");
    }
    if !diagnostic.element.is_empty() {
        text.push_str(&format!("{}: ", label(diagnostic.element.as_label())));
    }
    format!("{text}{} [{}]", finding(diagnostic), diagnostic.code())
}

#[cfg(test)]
mod tests {
    use super::*;
    use sinew_scene::message;

    #[test]
    fn a_place_stands_before_the_sentence() {
        let error = Message::verbatim("Too short.").at(Location { file: "arm.yaml".into(), line: Some(3), column: Some(7) });
        assert_eq!(error.sentence(), "arm.yaml:3:7: Too short.");
        assert_eq!(Message::verbatim("Empty.").at(Location::file("a.dae")).sentence(), "a.dae: Empty.");
        assert_eq!(message!("message-verbatim", words = error).sentence(), "arm.yaml:3:7: Too short.");
    }
}

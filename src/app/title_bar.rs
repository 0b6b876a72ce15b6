//! Contents of the header bar and the status line.

use gtk::prelude::*;
use gtk4 as gtk;

use super::commands::Command;
use super::ui::object;
use super::{format, memory_usage};
use crate::document::{Document, Missing, Source, SourceKind};
use crate::i18n::{self, Sentence, shown, shown_lines};
use crate::session::Session;
use crate::tr;

/// Names what is open in the header bar and in the title of the window, with what it lacks.
pub(super) fn name(builder: &gtk::Builder, window: &gtk::ApplicationWindow, session: &Session) {
    let names = names(session.document());
    let mut title = title_of(&names).unwrap_or_else(|| tr!("app-name"));
    if let Some(clip) = session.clip().filter(|_| !session.is_empty()) {
        title = format!("{title} / {}", i18n::label(clip.label()));
    }
    if session.is_unsaved() {
        title = format!("• {title}");
    }
    let title = shown(&title);
    let missing = session.document().missing();
    let lacks = |what| missing.contains(&what);
    let subtitle = if session.is_empty() || missing.is_empty() {
        String::new()
    } else {
        let words = [
            (Missing::Mesh, "app-missing-mesh"),
            (Missing::Skeleton, "app-missing-skeleton"),
            (Missing::Animation, "app-missing-animation"),
        ];
        let what = words.iter().filter(|(what, _)| lacks(*what)).map(|(_, key)| tr!(key)).collect::<Vec<_>>().join(", ");
        if lacks(Missing::Animation) { tr!("app-missing-still", what = what) } else { tr!("app-missing", what = what) }
    };
    let heading = object::<gtk::Label>(builder, "title");
    heading.set_text(&title);
    heading.set_tooltip_text(Some(&*shown_lines(&names.join("\n"))).filter(|_| names.len() > 1));
    window.set_title(Some(&title));
    let label = object::<gtk::Label>(builder, "subtitle");
    label.set_text(&subtitle);
    label.set_tooltip_text(Some(&subtitle));
    label.set_visible(!subtitle.is_empty());
}

/// The open files, the one that the others belong to first: clips before muscles, else as they were named.
pub(super) fn sources(document: &Document) -> Vec<&Source> {
    let mut sources: Vec<&Source> = document.sources.iter().collect();
    sources.sort_by_key(|source| !matches!(source.kind, SourceKind::Collada(_)));
    sources
}

/// Their names.
fn names(document: &Document) -> Vec<String> {
    let name = |source: &Source| match &source.path {
        Some(path) => path.file_name().map_or_else(|| i18n::source_name(&source.name), |name| name.to_string_lossy().into_owned()),
        None => i18n::source_name(&source.name),
    };
    sources(document).into_iter().map(name).collect()
}

/// One or two files by name, more as the first one and their number; `None` without any.
fn title_of(names: &[String]) -> Option<String> {
    match names {
        [] => None,
        [only] => Some(only.clone()),
        [one, other] => Some(format!("{one} + {other}")),
        [first, others @ ..] => Some(tr!("app-title-more", file = first.clone(), count = others.len())),
    }
}

/// Says at the buttons what undo and redo would do.
pub(super) fn name_steps(builder: &gtk::Builder, session: &Session) {
    let (back, forward) = session.undo_names();
    for (id, command, step) in [("undo", Command::Undo, back), ("redo", Command::Redo, forward)] {
        let text = match step {
            Some(step) => tr!("app-step", what = command.label(), step = step.sentence(), key = command.key_label()),
            None => command.tooltip(),
        };
        object::<gtk::Button>(builder, id).set_tooltip_text(Some(&text));
    }
}

/// Says in the status line how many triangles are drawn and how much memory the program takes.
pub(super) fn tell_size(builder: &gtk::Builder, triangles: u64) {
    let text = tr!("app-status-triangles", count = triangles, shown = format::group_digits(triangles));
    object::<gtk::Label>(builder, "status_triangles").set_text(&text);
    if let Some(megabytes) = memory_usage::resident() {
        object::<gtk::Label>(builder, "status_memory").set_text(&tr!("app-status-memory", size = format::number(megabytes, 0)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::progress::Progress;

    #[test]
    fn the_title_names_the_clip_first_and_counts_the_rest() {
        let file = |name: &str| format!("{}/configs/{name}", env!("CARGO_MANIFEST_DIR"));
        let document = Document::open(&[file("biceps.yaml"), file("curl.dae")], &Progress::default()).expect("both open");
        assert_eq!(title_of(&names(&document)).as_deref(), Some("curl.dae + biceps.yaml"));
        let names = ["a.dae", "b.yaml", "c.yaml"].map(str::to_owned);
        assert_eq!(title_of(&names), Some(tr!("app-title-more", file = "a.dae", count = 2)));
        assert_eq!((title_of(&names[..1]).as_deref(), title_of(&[])), (Some("a.dae"), None));
    }
}

//! Contents of the header bar.

use gtk::prelude::*;
use gtk4 as gtk;

use super::menus;
use crate::app::commands::Command;
use crate::app::loading::named_sources::sources;
use crate::app::widgets::ui;
use crate::document::{Document, Missing, Source};
use crate::i18n::{self, Sentence, shown, shown_lines};
use crate::session::{ChangeSet, Session};
use crate::tr;

ui::widgets! {
    /// The widgets of the header bar.
    struct TitleWidgets in "main_window.ui" {
        title: gtk::Label,
        subtitle: gtk::Label,
        undo: gtk::Button,
        redo: gtk::Button,
        camera_menu: gtk::MenuButton,
    }
}

/// What the header bar shows of the session.
pub(crate) struct TitleBar {
    widgets: TitleWidgets,
    window: gtk::ApplicationWindow,
}

impl TitleBar {
    /// That of a window.
    pub(crate) fn new(builder: &gtk::Builder, window: &gtk::ApplicationWindow) -> Self {
        Self { window: window.clone(), widgets: TitleWidgets::of(builder) }
    }

    /// Shows what changed.
    pub(crate) fn refresh(&self, session: &Session, changes: ChangeSet) {
        if changes.any(ChangeSet::DOCUMENT) {
            menus::list_cameras(&self.widgets.camera_menu, session);
        }
        if changes.any(ChangeSet::DOCUMENT | ChangeSet::PLAYBACK | ChangeSet::EDIT) {
            self.name(session);
        }
        if changes.any(ChangeSet::HISTORY | ChangeSet::DOCUMENT) {
            self.name_steps(session);
        }
    }

    /// Names what is open, here and in the title of the window, with what it lacks.
    fn name(&self, session: &Session) {
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
        self.widgets.title.set_text(&title);
        self.widgets.title.set_tooltip_text(Some(&*shown_lines(&names.join("\n"))).filter(|_| names.len() > 1));
        self.window.set_title(Some(&title));
        self.widgets.subtitle.set_text(&subtitle);
        self.widgets.subtitle.set_tooltip_text(Some(&subtitle));
        self.widgets.subtitle.set_visible(!subtitle.is_empty());
    }

    /// Says at the buttons what undo and redo would do.
    fn name_steps(&self, session: &Session) {
        let (back, forward) = session.undo_names();
        for (button, command, step) in [(&self.widgets.undo, Command::Undo, back), (&self.widgets.redo, Command::Redo, forward)] {
            let text = match step {
                Some(step) => tr!("app-step", what = command.label(), step = step.sentence(), key = command.key_label()),
                None => command.tooltip(),
            };
            button.set_tooltip_text(Some(&text));
        }
    }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formats::SCENE_READERS;
    use crate::progress::Progress;

    #[test]
    fn the_title_names_the_clip_first_and_counts_the_rest() {
        let file = |name: &str| format!("{}/configs/{name}", env!("CARGO_MANIFEST_DIR"));
        let document = Document::open(&[file("biceps.yaml"), file("curl.dae")], SCENE_READERS, &Progress::default()).expect("both open");
        assert_eq!(title_of(&names(&document)).as_deref(), Some("curl.dae + biceps.yaml"));
        let names = ["a.dae", "b.yaml", "c.yaml"].map(str::to_owned);
        assert_eq!(title_of(&names), Some(tr!("app-title-more", file = "a.dae", count = 2)));
        assert_eq!((title_of(&names[..1]).as_deref(), title_of(&[])), (Some("a.dae"), None));
    }
}

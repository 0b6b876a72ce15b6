//! The status line: what is selected, where the pointer is, how two scenes differ, how much is drawn.

use gtk4 as gtk;

use super::memory_usage;
use crate::app::format;
use crate::app::panels::onion_skin_panel;
use crate::app::widgets::ui;
use crate::i18n;
use crate::session::{ChangeSet, Session};
use crate::tr;

ui::widgets! {
    /// The labels of the line.
    struct StatusWidgets in "main_window.ui" {
        status_position: gtk::Label,
        status_compared: gtk::Label,
        status_selection: gtk::Label,
        status_triangles: gtk::Label,
        status_memory: gtk::Label,
    }
}

/// The line.
#[derive(Clone)]
pub(crate) struct StatusLine {
    widgets: StatusWidgets,
}

impl StatusLine {
    /// That of the window's `.ui` file.
    pub(crate) fn new(builder: &gtk::Builder) -> Self {
        Self { widgets: StatusWidgets::of(builder) }
    }

    /// Says what the pointer is over and where that is in the world.
    pub(crate) fn show_position(&self, text: &str) {
        ui::set_label(&self.widgets.status_position, text);
    }

    /// Says how many triangles are drawn and how much memory the program takes.
    pub(crate) fn show_size(&self, triangles: u64) {
        let text = tr!("app-status-triangles", count = triangles, shown = format::group_digits(triangles));
        self.widgets.status_triangles.set_text(&text);
        if let Some(megabytes) = memory_usage::resident() {
            self.widgets.status_memory.set_text(&tr!("app-status-memory", size = format::number(megabytes, 0)));
        }
    }

    /// Shows what changed.
    pub(crate) fn refresh(&self, session: &mut Session, changes: ChangeSet) {
        if changes.any(ChangeSet::SELECTION | ChangeSet::DOCUMENT) {
            let name = session.selected().map(|id| i18n::label(session.document().scene.graph.label(id)).into_owned());
            ui::set_label(&self.widgets.status_selection, &name.unwrap_or_default());
        }
        if changes.any(ChangeSet::PICTURE) {
            let compared = session.compared().map(|compared| onion_skin_panel::difference(session, &compared));
            ui::set_label(&self.widgets.status_compared, &compared.unwrap_or_default());
        }
    }
}

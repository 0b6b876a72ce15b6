//! The status line: what is selected, where the pointer is, how two scenes differ, how much is drawn.

use gtk4 as gtk;

use super::ui::{self, object};
use super::{format, memory_usage, onion_skin_panel};
use crate::i18n;
use crate::session::{ChangeSet, Session};
use crate::tr;

/// Its labels.
#[derive(Clone)]
pub(super) struct StatusLine {
    selection: gtk::Label,
    position: gtk::Label,
    compared: gtk::Label,
    triangles: gtk::Label,
    memory: gtk::Label,
}

impl StatusLine {
    /// That of the window's `.ui` file.
    pub(super) fn new(builder: &gtk::Builder) -> Self {
        Self {
            selection: object(builder, "status_selection"),
            position: object(builder, "status_position"),
            compared: object(builder, "status_compared"),
            triangles: object(builder, "status_triangles"),
            memory: object(builder, "status_memory"),
        }
    }

    /// Says what the pointer is over and where that is in the world.
    pub(super) fn show_position(&self, text: &str) {
        ui::set_label(&self.position, text);
    }

    /// Says how many triangles are drawn and how much memory the program takes.
    pub(super) fn show_size(&self, triangles: u64) {
        let text = tr!("app-status-triangles", count = triangles, shown = format::group_digits(triangles));
        self.triangles.set_text(&text);
        if let Some(megabytes) = memory_usage::resident() {
            self.memory.set_text(&tr!("app-status-memory", size = format::number(megabytes, 0)));
        }
    }

    /// Shows what changed.
    pub(super) fn refresh(&self, session: &mut Session, changes: ChangeSet) {
        if changes.any(ChangeSet::SELECTION | ChangeSet::DOCUMENT) {
            let name = session.selected().map(|id| i18n::label(session.document().scene.graph.label(id)).into_owned());
            ui::set_label(&self.selection, &name.unwrap_or_default());
        }
        if changes.any(ChangeSet::PICTURE) {
            let compared = session.compared().map(|compared| onion_skin_panel::difference(session, &compared));
            ui::set_label(&self.compared, &compared.unwrap_or_default());
        }
    }
}

//! What commands act on: the handles of the window and the parts that commands of the window change.

use std::collections::HashMap;
use std::rc::Rc;

use gtk::gio;
use gtk4 as gtk;

use super::app_context::AppContext;
use super::commands::Command;
use super::document_loader::DocumentLoader;
use super::muscle_panel::MusclePanel;
use super::side_panels::SidePanels;
use super::timeline::Timeline;
use super::viewport::Viewport;

/// The parts of a window that commands act on.
pub(super) struct CommandContext {
    /// The handles of the window.
    pub app: Rc<AppContext>,
    /// Opens files.
    pub loader: Rc<DocumentLoader>,
    /// The picture.
    pub viewport: Rc<Viewport>,
    /// The timeline.
    pub timeline: Timeline,
    /// The page of muscles.
    pub muscle: Rc<MusclePanel>,
    /// The tree and the right panel.
    pub side_panels: SidePanels,
    /// The main menu's button.
    pub menu: gtk::MenuButton,
    /// An action a command.
    pub actions: HashMap<Command, gio::SimpleAction>,
}

impl CommandContext {
    /// Shows the page below the track that the settings say, or folds it away.
    pub(super) fn show_sheet(&self) {
        let page = self.app.settings.borrow().sheet;
        self.app.session.set_widgets(|session| self.timeline.sheet.show(session, page));
    }
}

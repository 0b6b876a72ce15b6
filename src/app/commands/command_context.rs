//! What commands act on: the handles of the window and the parts that commands of the window change.

use std::collections::HashMap;
use std::rc::Rc;

use gtk::gio;
use gtk4 as gtk;

use super::Command;
use crate::app::handles::app_context::AppContext;
use crate::app::loading::document_loader::DocumentLoader;
use crate::app::panels::muscle::muscle_panel::MusclePanel;
use crate::app::timeline::Timeline;
use crate::app::viewport::Viewport;
use crate::app::window::side_panels::SidePanels;

/// The parts of a window that commands act on.
pub(crate) struct CommandContext {
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
    pub(crate) fn show_sheet(&self) {
        let page = self.app.settings.borrow().sheet;
        self.app.session.set_widgets(|session| self.timeline.sheet.show(session, page));
    }
}

//! What a page of the right-hand panel is.

use gtk4 as gtk;

use crate::session::{ChangeSet, Session};

/// A page of the right-hand panel. A new one is its two files, `.rs` and `.ui`, its place in the list of pages, and its title in both catalogues.
pub(crate) trait Panel {
    /// Its name in the settings and in the stack of pages.
    fn id(&self) -> &'static str;

    /// What a person calls it.
    fn title(&self) -> String;

    /// The whole of it.
    fn widget(&self) -> gtk::Widget;

    /// Shows what changed.
    fn refresh(&self, session: &mut Session, changes: ChangeSet);
}

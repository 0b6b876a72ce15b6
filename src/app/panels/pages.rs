//! The pages of the right-hand panel.

use std::cell::Cell;
use std::rc::Rc;

use gtk4 as gtk;

use super::diagnostics_panel::DiagnosticsPanel;
use super::display_panel::DisplayPanel;
use super::measure_panel::MeasurePanel;
use super::panel::Panel;
use crate::app::handles::app_context::AppContext;
use crate::app::panels::muscle::muscle_panel::MusclePanel;
use crate::session::{ChangeSet, Session};

/// The pages, in a stack that shows one of them.
pub(crate) struct Pages {
    stack: gtk::Stack,
    list: Vec<Rc<dyn Panel>>,
    /// Whether the page of displays stands in for that of muscles.
    turned: Cell<bool>,
}

impl Pages {
    /// All pages, in their order.
    pub(crate) fn new(stack: gtk::Stack, app: &Rc<AppContext>, muscle: &Rc<MusclePanel>) -> Self {
        let list: Vec<Rc<dyn Panel>> = vec![
            muscle.clone(),
            Rc::new(DisplayPanel::new(&app.session)),
            MeasurePanel::new(app),
            Rc::new(DiagnosticsPanel::new(&app.session, &app.toasts)),
        ];
        for page in &list {
            stack.add_titled(&page.widget(), Some(page.id()), &page.title());
        }
        Self { stack, list, turned: Cell::default() }
    }

    /// The stack that holds them.
    pub(crate) fn stack(&self) -> &gtk::Stack {
        &self.stack
    }

    /// Brings up the page with this id, if there is one.
    pub(crate) fn show(&self, id: &str) {
        if self.stack.child_by_name(id).is_some() {
            self.stack.set_visible_child_name(id);
        }
    }

    /// The id of the page that the user chose.
    pub(crate) fn chosen(&self) -> Option<String> {
        let shown = self.stack.visible_child_name()?;
        Some(if self.turned.get() { MusclePanel::ID.to_owned() } else { shown.into() })
    }

    /// Shows what changed.
    pub(crate) fn refresh(&self, session: &mut Session, changes: ChangeSet) {
        self.list.iter().for_each(|page| page.refresh(session, changes));
    }

    /// A scene without a muscle has nothing on the muscle page, so the display page comes up in its place, and goes again with it.
    pub(crate) fn fit(&self, session: &Session) {
        let (page, has_muscle) = (self.stack.visible_child_name(), session.document().driven_rig().is_some());
        if has_muscle && self.turned.take() {
            self.stack.set_visible_child_name(MusclePanel::ID);
        } else if !has_muscle && !session.is_empty() && page.as_deref() == Some(MusclePanel::ID) {
            self.stack.set_visible_child_name(DisplayPanel::ID);
            self.turned.set(true);
        }
    }
}

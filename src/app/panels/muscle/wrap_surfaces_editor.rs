//! Editor of the surfaces that the selected muscle goes round.

use std::cell::RefCell;

use gtk::prelude::*;
use gtk4 as gtk;

use super::attachment_field::{Bones, connect_pick, show_pick};
use super::muscle_editor::Editor;
use super::wrap_surface_row::WrapSurfaceRow;
use crate::app::widgets::ui;
use crate::muscle::AttachmentPoint;
use crate::muscle::edit::WRAPS;
use crate::scene::MuscleId;
use crate::session::{PickTarget, Session};

ui::widgets! {
    /// The widgets of the muscle panel for wrap surfaces.
    struct WrapWidgets in "muscle_panel.ui" {
        wraps: gtk::Box,
        wrap_list: gtk::Box,
        wrap_add: gtk::Button,
        wrap_pick_new: gtk::ToggleButton,
        wrap_refused: gtk::Label,
    }
}

/// The button that picks the bone of a new surface picks that of the one behind the last: no muscle has so many.
const NEW: PickTarget = PickTarget::Point(AttachmentPoint::Wrap(WRAPS));

/// The whole.
pub(crate) struct WrapSurfacesEditor {
    widgets: WrapWidgets,
    bones: Bones,
    rows: RefCell<Vec<WrapSurfaceRow>>,
    labels: gtk::SizeGroup,
    editor: RefCell<Option<Editor>>,
}

impl WrapSurfacesEditor {
    /// That of a panel.
    pub(crate) fn new(builder: &gtk::Builder, bones: &Bones) -> Self {
        Self {
            widgets: WrapWidgets::of(builder),
            bones: bones.clone(),
            rows: RefCell::default(),
            labels: gtk::SizeGroup::new(gtk::SizeGroupMode::Horizontal),
            editor: RefCell::default(),
        }
    }

    /// Connects the input of the widgets. A rejected change is reported below them.
    pub(crate) fn connect(&self, editor: &Editor) {
        let editor = editor.refusing_in(self.widgets.wrap_refused.clone());
        let own = editor.clone();
        self.widgets.wrap_add.connect_clicked(move |_| {
            let id = own.id();
            own.tell(|session| session.add_wrap(id));
        });
        connect_pick(&self.widgets.wrap_pick_new, &editor, NEW);
        self.editor.replace(Some(editor));
    }

    /// What was refused is no longer of interest.
    pub(crate) fn forget_refusals(&self) {
        self.widgets.wrap_refused.set_visible(false);
    }

    /// Shows the surfaces of a muscle.
    pub(crate) fn show(&self, session: &Session, id: MuscleId, unit: &str, anew: bool) {
        let Some((rig, index)) = session.document().muscle(id) else { return };
        let Some(spec) = rig.spec(index) else { return };
        self.widgets.wraps.set_visible(spec.origin.is_some());
        let count = spec.wraps.len();
        while self.rows.borrow().len() < count {
            let Some(editor) = self.editor.borrow().clone() else { return };
            let row = WrapSurfaceRow::new(self.rows.borrow().len(), &editor, &self.bones, &self.widgets.wrap_add);
            row.labels().into_iter().for_each(|label| self.labels.add_widget(label));
            self.widgets.wrap_list.append(row.root());
            self.rows.borrow_mut().push(row);
        }
        for (number, row) in self.rows.borrow().iter().enumerate() {
            row.root().set_visible(number < count);
            if let Some(wrap) = spec.wraps.get(number) {
                row.show(session, id, spec, wrap, unit, anew);
            }
        }
        self.widgets.wrap_list.set_visible(count > 0);
        let has_room = rig.is_attached(index) && count < WRAPS;
        self.widgets.wrap_add.set_sensitive(has_room);
        self.widgets.wrap_pick_new.set_sensitive(has_room);
        show_pick(&self.widgets.wrap_pick_new, session, id, NEW);
    }
}

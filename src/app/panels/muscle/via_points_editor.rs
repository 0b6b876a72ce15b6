//! Editor of the via points of the selected muscle.

use std::cell::RefCell;
use std::rc::Rc;

use gtk::prelude::*;
use gtk4 as gtk;

use super::attachment_field::{AttachmentField, Bones, connect_pick, show_pick};
use super::muscle_editor::Editor;
use super::via_range::{RangeJoints, ViaRange};
use crate::app::widgets::ui::{self, object};
use crate::muscle::edit::VIA;
use crate::muscle::{AttachmentPoint, Edit};
use crate::scene::MuscleId;
use crate::session::{PickTarget, Session, UndoStep};
use crate::tr;

ui::widgets! {
    /// The widgets of the muscle panel for via points.
    struct ViaWidgets in "muscle_panel.ui" {
        via_heading: gtk::Label,
        way_no_ends: gtk::Label,
        via_list: gtk::Box,
        via_buttons: gtk::Box,
        via_add: gtk::Button,
        via_pick_new: gtk::ToggleButton,
        via_refused: gtk::Label,
    }
}

/// The widgets of a via point.
struct ViaRow {
    root: gtk::Grid,
    place: AttachmentField,
    range: ViaRange,
    up: gtk::Button,
    down: gtk::Button,
    delete: gtk::Button,
}

/// What a row's buttons need to know: the rows, and where the keyboard goes when the last one is gone.
#[derive(Clone)]
struct ViaRows {
    rows: Rc<RefCell<Vec<ViaRow>>>,
    add: gtk::Button,
}

/// The whole.
pub(crate) struct ViaPointsEditor {
    widgets: ViaWidgets,
    bones: Bones,
    joints: RangeJoints,
    rows: ViaRows,
    editor: RefCell<Option<Editor>>,
}

impl ViaPointsEditor {
    /// That of a panel.
    pub(crate) fn new(builder: &gtk::Builder, bones: &Bones) -> Self {
        let widgets = ViaWidgets::of(builder);
        Self {
            bones: bones.clone(),
            joints: RangeJoints::new(),
            rows: ViaRows { rows: Rc::default(), add: widgets.via_add.clone() },
            widgets,
            editor: RefCell::default(),
        }
    }

    /// Connects the input of the widgets. A rejected change is reported beside its widget.
    pub(crate) fn connect(&self, editor: &Editor) {
        let of_via = editor.refusing_in(self.widgets.via_refused.clone());
        let own = of_via.clone();
        self.rows.add.connect_clicked(move |_| {
            let id = own.id();
            own.tell(|session| session.add_via(id));
        });
        connect_pick(&self.widgets.via_pick_new, &of_via, PickTarget::NewVia);
        self.editor.replace(Some(of_via));
    }

    /// What was refused is no longer of interest.
    pub(crate) fn forget_refusals(&self) {
        self.widgets.via_refused.set_visible(false);
    }

    /// Shows the way of a muscle.
    pub(crate) fn show(&self, session: &Session, id: MuscleId, unit: &str, anew: bool) {
        let Some((rig, index)) = session.document().muscle(id) else { return };
        let Some(spec) = rig.spec(index) else { return };
        let (held, has_ends) = (rig.is_attached(index), spec.origin.is_some());
        let widgets = &self.widgets;
        widgets.way_no_ends.set_visible(!has_ends);
        widgets.via_buttons.set_visible(has_ends);
        self.show_rows(spec.via.len());
        self.joints.list(session, id);
        for (row, via) in self.rows.rows.borrow().iter().zip(&spec.via) {
            row.place.show(session, id, anew);
            row.range.show(via, &self.joints, anew);
        }
        self.rows.add.set_sensitive(held && spec.via.len() < VIA);
        self.widgets.via_pick_new.set_sensitive(held && spec.via.len() < VIA);
        show_pick(&self.widgets.via_pick_new, session, id, PickTarget::NewVia);
        widgets.via_heading.set_text(&if unit.is_empty() || spec.via.is_empty() {
            tr!("app-via")
        } else {
            tr!("app-via-unit", unit = unit)
        });
    }

    /// Lets as many rows be seen as there are points.
    fn show_rows(&self, count: usize) {
        while self.rows.rows.borrow().len() < count {
            let Some(editor) = self.editor.borrow().clone() else { return };
            let row = self.rows.make(&editor, &self.bones, &self.joints);
            self.widgets.via_list.append(&row.root);
            self.rows.rows.borrow_mut().push(row);
        }
        for (number, row) in self.rows.rows.borrow().iter().enumerate() {
            row.root.set_visible(number < count);
            row.up.set_sensitive(number > 0);
            row.down.set_sensitive(number + 1 < count);
        }
        self.widgets.via_list.set_visible(count > 0);
    }
}

impl ViaRows {
    /// The row of the next via point.
    fn make(&self, editor: &Editor, bones: &Bones, joints: &RangeJoints) -> ViaRow {
        let number = self.rows.borrow().len();
        let builder = ui::numbered(include_str!("via_point.ui"), number + 1);
        let place = AttachmentField::new(&builder, "via", AttachmentPoint::Via(number), bones);
        place.connect(editor);
        let range = ViaRange::new(number, &builder, editor, joints);
        let button = |id: &str| object::<gtk::Button>(&builder, id);
        let (up, down, delete) = (button("via_up"), button("via_down"), button("via_delete"));
        // A point that moves takes the keyboard with it.
        for (arrow, swapped, goes_to) in [(&up, number.checked_sub(1), number.wrapping_sub(1)), (&down, Some(number), number + 1)] {
            let (own, rows, is_up) = (editor.clone(), self.clone(), arrow == &up);
            arrow.connect_clicked(move |_| {
                if swapped.is_some_and(|swapped| own.edit(&Edit::SwapVia(swapped), UndoStep::New)) {
                    rows.focus(goes_to, |row| {
                        let (wished, other) = if is_up { (&row.up, &row.down) } else { (&row.down, &row.up) };
                        if wished.is_sensitive() { wished } else { other }
                    });
                }
            });
        }
        let (own, rows) = (editor.clone(), self.clone());
        delete.connect_clicked(move |_| {
            if own.edit(&Edit::DeleteVia(number), UndoStep::New) {
                rows.focus(number, |row| &row.delete);
            }
        });
        ViaRow { root: object(&builder, "via"), place, range, up, down, delete }
    }

    /// Gives the keyboard to a button of a row; where that is no longer there, to the last row's, else to the button that adds one.
    fn focus(&self, number: usize, button: impl Fn(&ViaRow) -> &gtk::Button) {
        let rows = self.rows.borrow();
        let seen = rows.iter().take(number + 1).rfind(|row| row.root.is_visible());
        seen.map_or(&self.add, button).grab_focus();
    }
}

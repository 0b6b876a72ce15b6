//! Editor of one attachment point: the bone, chosen from a list or picked in the viewport, and the offset from it.

use std::cell::RefCell;
use std::rc::Rc;

use gtk::prelude::*;
use gtk4 as gtk;

use super::muscle_editor::{Editor, connect_entry, show_text};
use crate::app::format;
use crate::app::widgets::ui::{self, object};
use crate::i18n;
use crate::muscle::{Anchor, AttachmentPoint, Edit};
use crate::scene::{MuscleId, NodeId};
use crate::session::{PickTarget, Session, UndoStep};
use crate::tr;

/// The bones that a muscle can be attached to, as rows of lists: one model for all of them.
#[derive(Clone)]
pub(crate) struct Bones {
    nodes: Rc<RefCell<Vec<NodeId>>>,
    /// Their names; before them, in the second, a row for none.
    names: gtk::StringList,
    or_none: gtk::StringList,
}

impl Bones {
    /// No bones yet.
    pub(crate) fn new() -> Self {
        Self { nodes: Rc::default(), names: ui::words::<&str>(&[]), or_none: ui::words(&[tr!("app-ends-none")]) }
    }

    /// Lists those of a muscle.
    pub(crate) fn list(&self, session: &Session, id: MuscleId) {
        let graph = &session.document().scene.graph;
        let nodes: Vec<NodeId> = session.bones_for(id).into_iter().map(|(node, _)| node).collect();
        let names: Vec<_> = nodes.iter().map(|node| i18n::shown(&i18n::label(graph.label(*node))).into_owned()).collect();
        let names: Vec<&str> = names.iter().map(AsRef::as_ref).collect();
        let shown = |row: usize| self.names.string(row as u32);
        // A model that changes loses the place that a person has scrolled to in a list.
        let same = self.names.n_items() as usize == names.len()
            && names.iter().enumerate().all(|(row, name)| shown(row).as_deref() == Some(*name));
        if !same {
            self.names.splice(0, self.names.n_items(), &names);
            self.or_none.splice(1, self.or_none.n_items() - 1, &names);
        }
        self.nodes.replace(nodes);
    }

    fn row(&self, node: Option<NodeId>) -> Option<u32> {
        let node = node?;
        self.nodes.borrow().iter().position(|bone| *bone == node).map(|row| row as u32)
    }

    fn at(&self, row: u32) -> Option<NodeId> {
        self.nodes.borrow().get(row as usize).copied()
    }

    fn is_empty(&self) -> bool {
        self.nodes.borrow().is_empty()
    }
}

/// The widgets of one point.
#[derive(Clone)]
pub(crate) struct AttachmentField {
    hold: AttachmentPoint,
    bone: gtk::DropDown,
    pick: gtk::ToggleButton,
    offset: gtk::Widget,
    entries: [gtk::Entry; 3],
    bones: Bones,
    /// Whether the point can be nowhere.
    or_none: bool,
}

impl AttachmentField {
    /// That of the widgets whose names begin with `name`. A via point is always on some bone; all else can be on none.
    pub(crate) fn new(builder: &gtk::Builder, name: &str, hold: AttachmentPoint, bones: &Bones) -> Self {
        let bone: gtk::DropDown = object(builder, &format!("{name}_bone"));
        let or_none = !matches!(hold, AttachmentPoint::Via(_));
        ui::narrow(&bone, 12);
        bone.set_model(Some(if or_none { &bones.or_none } else { &bones.names }));
        Self {
            hold,
            bone,
            pick: object(builder, &format!("{name}_pick")),
            offset: object(builder, &format!("{name}_offset")),
            entries: ["x", "y", "z"].map(|axis| object(builder, &format!("{name}_{axis}"))),
            bones: bones.clone(),
            or_none,
        }
    }

    /// Connects the input of the widgets.
    pub(crate) fn connect(&self, editor: &Editor) {
        let (own, field) = (editor.clone(), self.clone());
        self.bone.connect_selected_notify(move |list| {
            let row = list.selected();
            if row == gtk::INVALID_LIST_POSITION {
                return;
            }
            let (node, id) = (field.node(row), own.id());
            own.tell(|session| session.attach_to(id, field.hold, node));
        });
        let what = PickTarget::Point(self.hold);
        connect_pick(&self.pick, editor, what);
        for (axis, entry) in self.entries.iter().enumerate() {
            let (own, hold) = (editor.clone(), self.hold);
            connect_entry(entry, move |entry| typed(&own, hold, axis, entry));
        }
    }

    fn node(&self, row: u32) -> Option<NodeId> {
        if self.or_none { row.checked_sub(1).and_then(|row| self.bones.at(row)) } else { self.bones.at(row) }
    }

    /// Shows where the point is.
    pub(crate) fn show(&self, session: &Session, id: MuscleId, anew: bool) {
        let Some((rig, index)) = session.document().muscle(id) else { return };
        let Some(spec) = rig.spec(index) else { return };
        let row = self.bones.row(rig.hold_bone(index, self.hold));
        let row = if self.or_none { row.map_or(0, |row| row + 1) } else { row.unwrap_or(gtk::INVALID_LIST_POSITION) };
        self.bone.set_selected(row);
        self.bone.set_sensitive(!self.bones.is_empty());
        self.pick.set_sensitive(!self.bones.is_empty());
        show_pick(&self.pick, session, id, PickTarget::Point(self.hold));
        let anchor = spec.place(self.hold);
        self.offset.set_visible(anchor.is_some());
        for (axis, entry) in self.entries.iter().enumerate() {
            show_text(entry, &anchor.map_or_else(String::new, |anchor| offset_text(anchor, axis)), anew);
        }
    }
}

/// Lets a button begin and leave picking.
pub(crate) fn connect_pick(pick: &gtk::ToggleButton, editor: &Editor, what: PickTarget) {
    let own = editor.clone();
    pick.connect_clicked(move |pick| {
        let (id, on) = (own.id(), pick.is_active());
        own.tell(|session| {
            session.stop_picking();
            if on {
                session.start_picking(id, what);
            }
            Ok(())
        });
    });
}

/// Shows in a button whether this is being picked.
pub(crate) fn show_pick(pick: &gtk::ToggleButton, session: &Session, id: MuscleId, what: PickTarget) {
    pick.set_active(session.picking().is_some_and(|picking| picking.muscle == id && picking.target == what));
}

fn offset_text(anchor: &Anchor, axis: usize) -> String {
    format::number(anchor.offset[axis], 2)
}

/// Takes what was typed into an offset.
fn typed(editor: &Editor, hold: AttachmentPoint, axis: usize, entry: &gtk::Entry) {
    let Some(spec) = editor.spec() else { return };
    let Some(mut anchor) = spec.place(hold).cloned() else { return };
    if entry.text() == offset_text(&anchor, axis) {
        return entry.remove_css_class("error");
    }
    anchor.offset[axis] = format::parse_number(&entry.text()).unwrap_or(f64::NAN);
    let text = offset_text(&anchor, axis);
    let taken = Edit::place(&spec, hold, anchor).is_some_and(|edit| editor.edit(&edit, UndoStep::New));
    if taken {
        entry.remove_css_class("error");
        entry.set_text(&text);
    } else {
        entry.add_css_class("error");
    }
}

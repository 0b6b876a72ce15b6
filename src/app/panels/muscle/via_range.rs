//! The widgets that say while which angles of a joint a via point is passed, and what moves it.

use std::cell::RefCell;
use std::rc::Rc;

use gtk::prelude::*;
use gtk4 as gtk;

use super::muscle_editor::{Editor, connect_entry, show_text};
use crate::app::format;
use crate::app::widgets::ui;
use crate::i18n::shown;
use crate::muscle::{ActiveRange, ViaPoint};
use crate::scene::MuscleId;
use crate::session::Session;
use crate::tr;

ui::widgets! {
    /// The widgets of a via point that say while which angles it is passed, and what moves it.
    struct RangeWidgets in "via_point.ui" {
        via_moves: gtk::Label,
        via_ranged: gtk::CheckButton,
        via_range: gtk::Box,
        via_from: gtk::Entry,
        via_to: gtk::Entry,
        via_range_unit: gtk::Label,
        via_joint: gtk::DropDown,
    }
}

/// The joints whose angles via points can depend on, and their names as rows of a list: one model for all via points.
#[derive(Clone)]
pub(super) struct RangeJoints {
    joints: Rc<RefCell<Vec<ActiveRange>>>,
    names: gtk::StringList,
}

impl RangeJoints {
    /// No joints yet.
    pub(super) fn new() -> Self {
        Self { joints: Rc::default(), names: ui::words::<&str>(&[]) }
    }

    /// Lists those of a muscle.
    pub(super) fn list(&self, session: &Session, id: MuscleId) {
        let joints = session.joints_for_via(id);
        let same = |(row, joint): (usize, &ActiveRange)| self.names.string(row as u32).is_some_and(|name| name == joint.joint);
        // A model that changes loses what is chosen in its lists.
        if self.names.n_items() as usize != joints.len() || !joints.iter().enumerate().all(same) {
            let names: Vec<&str> = joints.iter().map(|joint| joint.joint.as_str()).collect();
            self.names.splice(0, self.names.n_items(), &names);
        }
        self.joints.replace(joints);
    }

    /// The joint of a row and the whole range of its angles.
    fn at(&self, row: u32) -> Option<ActiveRange> {
        self.joints.borrow().get(row as usize).cloned()
    }

    fn row(&self, joint: &str) -> u32 {
        let row = self.joints.borrow().iter().position(|known| known.joint == joint);
        row.map_or(gtk::INVALID_LIST_POSITION, |row| row as u32)
    }
}

/// The widgets of one via point.
pub(super) struct ViaRange(RangeWidgets);

impl ViaRange {
    /// Those of via point `number`, which `builder` has built.
    pub(super) fn new(number: usize, builder: &gtk::Builder, editor: &Editor, joints: &RangeJoints) -> Self {
        let widgets = RangeWidgets::of(builder);
        widgets.connect(number, editor, joints);
        Self(widgets)
    }

    /// Shows while which angles a via point is passed, and what moves it.
    pub(super) fn show(&self, via: &ViaPoint, joints: &RangeJoints, anew: bool) {
        self.0.show(via, joints, anew);
    }
}

impl RangeWidgets {
    /// Connects the input of the widgets of via point `number`.
    fn connect(&self, number: usize, editor: &Editor, joints: &RangeJoints) {
        self.via_joint.set_model(Some(&joints.names));
        let set = move |editor: &Editor, range: Option<ActiveRange>| {
            let id = editor.id();
            editor.tell(|session| session.set_via_range(id, number, range))
        };
        let present = move |editor: &Editor| editor.spec()?.via.get(number)?.active.clone();
        let (own, known) = (editor.clone(), joints.clone());
        self.via_ranged.connect_toggled(move |check| {
            // At first the whole range of the joint: the muscle goes on as it did.
            let range = known.at(0).filter(|_| check.is_active());
            if present(&own).is_some() != check.is_active() {
                set(&own, range);
            }
        });
        let (own, known) = (editor.clone(), joints.clone());
        self.via_joint.connect_selected_notify(move |list| {
            // The angles of one joint say nothing of another.
            if let (Some(chosen), Some(now)) = (known.at(list.selected()), present(&own))
                && chosen.joint != now.joint
            {
                set(&own, Some(chosen));
            }
        });
        for (end, entry) in [&self.via_from, &self.via_to].into_iter().enumerate() {
            let own = editor.clone();
            connect_entry(entry, move |entry| {
                let Some(mut range) = present(&own) else { return };
                if entry.text() == angle_text(&range, end) {
                    return entry.remove_css_class("error");
                }
                range.range[end] = format::parse_number(&entry.text()).unwrap_or(f64::NAN);
                let text = angle_text(&range, end);
                if set(&own, Some(range)) {
                    entry.remove_css_class("error");
                    entry.set_text(&text);
                } else {
                    entry.add_css_class("error");
                }
            });
        }
    }

    /// Shows while which angles a via point is passed, and what moves it.
    fn show(&self, via: &ViaPoint, joints: &RangeJoints, anew: bool) {
        self.via_moves.set_visible(via.moves.is_some());
        if let Some(moves) = &via.moves {
            self.via_moves.set_text(&tr!("app-via-moves", joint = &*shown(&moves.joint)));
        }
        let (count, active) = (joints.names.n_items(), via.active.as_ref().filter(|_| joints.names.n_items() > 0));
        self.via_ranged.set_visible(count > 0);
        self.via_ranged.set_active(active.is_some());
        let parts: [&gtk::Widget; 2] = [self.via_range.upcast_ref(), self.via_range_unit.upcast_ref()];
        parts.iter().for_each(|part| part.set_visible(active.is_some()));
        self.via_joint.set_visible(active.is_some() && count > 1);
        for (end, entry) in [&self.via_from, &self.via_to].into_iter().enumerate() {
            show_text(entry, &active.map_or_else(String::new, |range| angle_text(range, end)), anew);
        }
        if let Some(range) = active {
            self.via_joint.set_selected(joints.row(&range.joint));
        }
    }
}

fn angle_text(range: &ActiveRange, end: usize) -> String {
    format::number(range.range[end], 1)
}

//! Where the shown muscle is attached: a bone and an offset for each end, typed, chosen or picked.

use std::cell::RefCell;
use std::rc::Rc;

use gtk::prelude::*;
use gtk4 as gtk;

use super::muscle_editor::{Editor, connect_entry, show_text};
use super::session::{Session, Step};
use super::window::part;
use super::{format, ui};
use crate::muscle::{Anchor, Edit, Handhold, MuscleSpec};
use crate::scene::{MuscleId, NodeId};
use crate::tr;

const NAMES: [&str; 2] = ["origin", "insertion"];

/// The widgets of one end.
#[derive(Clone)]
struct End {
    bone: gtk::DropDown,
    pick: gtk::ToggleButton,
    offset: gtk::Box,
    entries: [gtk::Entry; 3],
    unit: gtk::Label,
}

/// Both ends.
pub struct MuscleEnds {
    ends: [End; 2],
    /// The bones behind the rows of both lists, after the first, which is none.
    bones: Rc<RefCell<Vec<NodeId>>>,
}

impl MuscleEnds {
    /// Those of a panel.
    pub fn new(builder: &gtk::Builder) -> Self {
        let ends = NAMES.map(|name| {
            let bone = part(builder, &format!("{name}_bone"));
            ui::narrow(&bone);
            End {
                bone,
                pick: part(builder, &format!("{name}_pick")),
                offset: part(builder, &format!("{name}_offset")),
                entries: ["x", "y", "z"].map(|axis| part(builder, &format!("{name}_{axis}"))),
                unit: part(builder, &format!("{name}_unit")),
            }
        });
        Self { ends, bones: Rc::default() }
    }

    /// Lets hands choose, pick and type.
    pub fn connect(&self, editor: &Editor) {
        for (number, end) in self.ends.iter().enumerate() {
            let (own, bones) = (editor.clone(), self.bones.clone());
            end.bone.connect_selected_notify(move |list| {
                let row = list.selected();
                if row == gtk::INVALID_LIST_POSITION {
                    return;
                }
                let (node, id) = ((row as usize).checked_sub(1).and_then(|row| bones.borrow().get(row).copied()), own.id());
                own.tell(|session| session.attach_to(id, number, node));
            });
            let own = editor.clone();
            end.pick.connect_clicked(move |pick| {
                let (id, on) = (own.id(), pick.is_active());
                own.tell(|session| {
                    session.stop_picking();
                    if on {
                        session.start_picking(id, number);
                    }
                    Ok(())
                });
            });
            for (axis, entry) in end.entries.iter().enumerate() {
                let own = editor.clone();
                connect_entry(entry, move |entry| typed(&own, number, axis, entry));
            }
        }
    }

    /// Lists the bones that the muscle can be attached to.
    pub fn list(&self, session: &Session, id: MuscleId) {
        let graph = &session.document().scene.graph;
        let bones: Vec<NodeId> = session.bones_for(id).into_iter().map(|(node, _)| node).collect();
        let none = tr!("app-ends-none");
        let names: Vec<&str> = std::iter::once(none.as_str()).chain(bones.iter().map(|bone| graph.node(*bone).name.as_str())).collect();
        for end in &self.ends {
            end.bone.set_model(Some(&gtk::StringList::new(&names)));
            end.bone.set_sensitive(!bones.is_empty());
            end.pick.set_sensitive(!bones.is_empty());
        }
        self.bones.replace(bones);
    }

    /// Shows where the muscle is attached.
    pub fn show(&self, session: &Session, id: MuscleId, unit: &str, anew: bool) {
        let Some((rig, index)) = session.document().muscle(id) else { return };
        let Some(spec) = rig.spec(index) else { return };
        let picked = session.picking().filter(|picking| picking.muscle == id).map(|picking| picking.end);
        for (number, end) in self.ends.iter().enumerate() {
            let node = rig.hold_bone(index, Handhold::End(number));
            let row = node.and_then(|node| self.bones.borrow().iter().position(|bone| *bone == node));
            end.bone.set_selected(row.map_or(0, |row| row as u32 + 1));
            end.pick.set_active(picked == Some(number));
            let anchor = anchor(spec, number);
            end.offset.set_visible(anchor.is_some());
            end.unit.set_visible(anchor.is_some());
            end.unit.set_text(unit);
            for (axis, entry) in end.entries.iter().enumerate() {
                show_text(entry, &anchor.map_or_else(String::new, |anchor| offset_text(anchor, axis)), anew);
            }
        }
    }
}

fn anchor(spec: &MuscleSpec, end: usize) -> Option<&Anchor> {
    if end == 0 { spec.origin.as_ref() } else { spec.insertion.as_ref() }
}

fn offset_text(anchor: &Anchor, axis: usize) -> String {
    format::number(anchor.offset[axis], 2)
}

/// Takes what was typed into an offset.
fn typed(editor: &Editor, end: usize, axis: usize, entry: &gtk::Entry) {
    let Some(mut anchor) = editor.spec().and_then(|spec| anchor(&spec, end).cloned()) else { return };
    if entry.text() == offset_text(&anchor, axis) {
        return entry.remove_css_class("error");
    }
    anchor.offset[axis] = format::typed(&entry.text()).unwrap_or(f64::NAN);
    if editor.edit(&Edit::End(end, anchor.clone()), Step::New) {
        entry.remove_css_class("error");
        entry.set_text(&offset_text(&anchor, axis));
    } else {
        entry.add_css_class("error");
    }
}

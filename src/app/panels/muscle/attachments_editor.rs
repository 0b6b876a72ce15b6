//! Editor of the origin and insertion of the selected muscle: a bone and an offset each.

use gtk::prelude::*;
use gtk4 as gtk;

use super::attachment_field::{AttachmentField, Bones};
use super::muscle_editor::Editor;
use crate::app::widgets::ui::object;
use crate::muscle::AttachmentPoint;
use crate::scene::MuscleId;
use crate::session::Session;

const NAMES: [&str; 2] = ["origin", "insertion"];

/// Both ends.
pub(crate) struct AttachmentsEditor {
    ends: [AttachmentField; 2],
    units: [gtk::Label; 2],
}

impl AttachmentsEditor {
    /// Those of a panel.
    pub(crate) fn new(builder: &gtk::Builder, bones: &Bones) -> Self {
        Self {
            ends: [0, 1].map(|end| AttachmentField::new(builder, NAMES[end], AttachmentPoint::End(end), bones)),
            units: NAMES.map(|name| object(builder, &format!("{name}_unit"))),
        }
    }

    /// Connects the input of the widgets.
    pub(crate) fn connect(&self, editor: &Editor) {
        self.ends.iter().for_each(|end| end.connect(editor));
    }

    /// Shows where the muscle is attached.
    pub(crate) fn show(&self, session: &Session, id: MuscleId, unit: &str, anew: bool) {
        let Some((rig, index)) = session.document().muscle(id) else { return };
        let has_ends = rig.spec(index).is_some_and(|spec| spec.origin.is_some());
        for (end, label) in self.ends.iter().zip(&self.units) {
            end.show(session, id, anew);
            label.set_text(unit);
            label.set_visible(has_ends);
        }
    }
}

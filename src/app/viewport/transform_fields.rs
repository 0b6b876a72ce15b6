//! Number fields of the active tool: translation, rotation, scale of the model.

use std::cell::Cell;
use std::rc::Rc;

use glam::DVec3;
use gtk::glib;
use gtk::prelude::*;
use gtk4 as gtk;

use crate::app::handles::session_handle::SessionHandle;
use crate::app::widgets::ui;
use crate::message;
use crate::session::{ModelTransform, Tool, UndoStep};
use crate::tr;

/// Room right of the numbers, logical pixels.
const MARGIN: i32 = 12;
/// Padding and border of what floats over the picture, both sides together.
const FRAME: i32 = 26;

ui::widgets! {
    /// The fields, each with the letter of its axis.
    struct FieldWidgets in "viewport.ui" {
        numbers: gtk::Box,
        numbers_label: gtk::Label,
        letter_x: gtk::Label,
        number_x: gtk::SpinButton,
        axis_y: gtk::Box,
        number_y: gtk::SpinButton,
        axis_z: gtk::Box,
        number_z: gtk::SpinButton,
    }
}

/// Three boxes, of which Scale uses one.
#[derive(Clone)]
pub(super) struct TransformFields {
    widgets: FieldWidgets,
    boxes: [gtk::SpinButton; 3],
    tool: Rc<Cell<Tool>>,
}

impl TransformFields {
    /// From the viewport's `.ui` file.
    pub(super) fn new(builder: &gtk::Builder) -> Self {
        let widgets = FieldWidgets::of(builder);
        let boxes = [&widgets.number_x, &widgets.number_y, &widgets.number_z].map(gtk::SpinButton::clone);
        Self { widgets, boxes, tool: Rc::default() }
    }

    /// Lets the boxes change the model.
    pub(super) fn connect(&self, session: &SessionHandle) {
        for (axis, number) in (0..).zip(&self.boxes) {
            let (boxes, tool) = (self.boxes.clone(), self.tool.clone());
            number.connect_value_changed(glib::clone!(
                #[weak]
                session,
                move |_| {
                    let [x, y, z] = boxes.each_ref().map(gtk::SpinButton::value);
                    session.update(|session| {
                        let change = |model: &mut ModelTransform| match tool.get() {
                            Tool::Navigate => {}
                            Tool::Move => model.translation = DVec3::new(x, y, z),
                            Tool::Rotate => model.set_degrees(DVec3::new(x, y, z)),
                            Tool::Scale => model.set_scale(x),
                        };
                        session.undoable(message!(tool.get().edit()), UndoStep::near(axis), |session| session.change_model(change));
                    });
                }
            ));
        }
    }

    /// Takes no more room than a picture of this width has, logical pixels: does without the buttons of the boxes, then without the name of the whole, and
    /// at last stands upright. Typing, the wheel and keys change numbers without buttons too.
    pub(super) fn fit(&self, width: i32) {
        let room = width - self.widgets.numbers.margin_start() - MARGIN;
        for (buttons, named, upright) in [(true, true, false), (false, true, false), (false, false, false), (true, true, true)] {
            for number in &self.boxes {
                let parts = std::iter::successors(number.first_child(), WidgetExt::next_sibling);
                parts.filter(|part| part.is::<gtk::Button>()).for_each(|button| button.set_visible(buttons));
            }
            self.widgets.numbers_label.set_visible(named);
            self.widgets.numbers.set_orientation(if upright { gtk::Orientation::Vertical } else { gtk::Orientation::Horizontal });
            if upright {
                self.widgets.numbers.add_css_class("upright")
            } else {
                self.widgets.numbers.remove_css_class("upright")
            }
            if self.width() <= room {
                break;
            }
        }
    }

    /// The width that all that is visible takes.
    fn width(&self) -> i32 {
        let parts = std::iter::successors(self.widgets.numbers.first_child(), WidgetExt::next_sibling).filter(WidgetExt::is_visible);
        let (widths, count) = parts.fold((0, 0), |(sum, count), part| (sum + part.measure(gtk::Orientation::Horizontal, -1).0, count + 1));
        widths + self.widgets.numbers.spacing() * (count - 1) + FRAME
    }

    /// Shows the numbers of a tool.
    pub(super) fn refresh(&self, tool: Tool, model: &ModelTransform) {
        let other = self.tool.replace(tool) != tool;
        self.widgets.numbers.set_visible(tool != Tool::Navigate);
        let (y, z) = (&self.widgets.axis_y, &self.widgets.axis_z);
        if other {
            let (limit, step, digits, label) = match tool {
                Tool::Navigate => return,
                Tool::Move => (1e6, 0.01, 3, tr!("app-numbers-move")),
                Tool::Rotate => (360.0, 1.0, 1, tr!("app-numbers-rotate")),
                Tool::Scale => (1.0 / ModelTransform::MIN_SCALE, 0.05, 3, tr!("app-numbers-scale")),
            };
            let lowest = if tool == Tool::Scale { ModelTransform::MIN_SCALE } else { -limit };
            self.widgets.numbers_label.set_text(&label);
            self.boxes.iter().for_each(|number| number.set_tooltip_text(Some(&label)));
            for number in &self.boxes {
                number.set_range(lowest, limit);
                number.set_increments(step, step * 10.0);
                number.set_digits(digits);
            }
            y.set_visible(tool != Tool::Scale);
            z.set_visible(tool != Tool::Scale);
            self.widgets.letter_x.set_visible(tool != Tool::Scale);
        }
        let values = match tool {
            Tool::Navigate => return,
            Tool::Move => model.translation,
            Tool::Rotate => model.degrees(),
            Tool::Scale => DVec3::splat(model.scale),
        };
        for (number, value) in self.boxes.iter().zip(values.to_array()) {
            ui::show_value(&number.adjustment(), value);
        }
    }
}

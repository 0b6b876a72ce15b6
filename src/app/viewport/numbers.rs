//! The numbers of the tool in hand: how far the model was moved, turned, scaled.

use std::cell::Cell;
use std::rc::Rc;

use glam::DVec3;
use gtk::glib;
use gtk::prelude::*;
use gtk4 as gtk;

use crate::app::session::{ModelTransform, Tool};
use crate::app::ui;
use crate::app::window::{Window, part};
use crate::tr;

/// Three boxes, of which Scale uses one.
#[derive(Clone)]
pub struct Numbers {
    root: gtk::Box,
    label: gtk::Label,
    boxes: [gtk::SpinButton; 3],
    tool: Rc<Cell<Tool>>,
}

impl Numbers {
    /// From the viewport's `.ui` file.
    pub fn new(builder: &gtk::Builder) -> Self {
        Self {
            root: part(builder, "numbers"),
            label: part(builder, "numbers_label"),
            boxes: ["number_x", "number_y", "number_z"].map(|id| part(builder, id)),
            tool: Rc::default(),
        }
    }

    /// Lets the boxes change the model.
    pub fn connect(&self, window: &Rc<Window>) {
        for number in &self.boxes {
            let (boxes, tool) = (self.boxes.clone(), self.tool.clone());
            number.connect_value_changed(glib::clone!(
                #[weak]
                window,
                move |_| {
                    let [x, y, z] = boxes.each_ref().map(gtk::SpinButton::value);
                    window.act(|session| {
                        session.remember_as(tool.get().edit());
                        session.change_model(|model| match tool.get() {
                            Tool::Navigate => {}
                            Tool::Move => model.translation = DVec3::new(x, y, z),
                            Tool::Rotate => model.set_degrees(DVec3::new(x, y, z)),
                            Tool::Scale => model.set_scale(x),
                        });
                    });
                }
            ));
        }
    }

    /// Takes less room where the picture is this narrow, logical pixels.
    pub fn fit(&self, width: i32) {
        let (narrow, tight) = (width < 540, width < 400);
        self.label.set_visible(!narrow);
        let letters = if tight || !narrow { 6 } else { 4 };
        self.boxes.iter().for_each(|number| number.set_width_chars(letters));
        for (class, wanted) in [("narrow", narrow), ("tight", tight)] {
            if wanted { self.root.add_css_class(class) } else { self.root.remove_css_class(class) }
        }
    }

    /// Shows the numbers of a tool.
    pub fn refresh(&self, tool: Tool, model: &ModelTransform) {
        let other = self.tool.replace(tool) != tool;
        self.root.set_visible(tool != Tool::Navigate);
        let [_, y, z] = &self.boxes;
        if other {
            let (limit, step, digits, label) = match tool {
                Tool::Navigate => return,
                Tool::Move => (1e6, 0.01, 3, tr!("app-numbers-move")),
                Tool::Rotate => (360.0, 1.0, 1, tr!("app-numbers-rotate")),
                Tool::Scale => (1.0 / ModelTransform::SMALLEST, 0.05, 3, tr!("app-numbers-scale")),
            };
            let lowest = if tool == Tool::Scale { ModelTransform::SMALLEST } else { -limit };
            self.label.set_text(&label);
            for number in &self.boxes {
                number.set_range(lowest, limit);
                number.set_increments(step, step * 10.0);
                number.set_digits(digits);
            }
            y.set_visible(tool != Tool::Scale);
            z.set_visible(tool != Tool::Scale);
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

//! The display panel: every switch of the picture.

use std::rc::Rc;

use gtk::glib;
use gtk::prelude::*;
use gtk4 as gtk;

use super::session::{Changes, Session};
use super::settings::SHADINGS;
use super::window::{Window, part};
use super::{format, ui};
use crate::document::Skinning;
use crate::tr;

/// The panel.
pub struct DisplayPanel {
    /// The whole.
    pub root: gtk::ScrolledWindow,
    shading: gtk::DropDown,
    skinning: gtk::DropDown,
    ambient: gtk::Scale,
    ambient_value: gtk::Label,
    light: gtk::Label,
}

impl DisplayPanel {
    /// A panel that is not connected yet.
    pub fn new() -> Self {
        let builder = ui::builder(ui::DISPLAY_PANEL);
        let list = |id: &str, keys: &[&str]| {
            let words: Vec<String> = keys.iter().map(|key| tr!(key)).collect();
            let list: gtk::DropDown = part(&builder, id);
            list.set_model(Some(&gtk::StringList::new(&words.iter().map(String::as_str).collect::<Vec<_>>())));
            list
        };
        Self {
            root: part(&builder, "root"),
            shading: list("shading", &["app-do-flat", "app-do-gouraud", "app-do-phong"]),
            skinning: list("skinning", &["app-skinning-linear", "app-skinning-dual"]),
            ambient: part(&builder, "ambient"),
            ambient_value: part(&builder, "ambient_value"),
            light: part(&builder, "light_position"),
        }
    }

    /// Lets the lists and the slider change the display.
    pub fn connect(&self, window: &Rc<Window>) {
        self.shading.connect_selected_notify(glib::clone!(
            #[weak]
            window,
            move |list| {
                if let Some((_, shading)) = SHADINGS.get(list.selected() as usize) {
                    window.act(|session| session.change_display(|display| display.shading = *shading));
                }
            }
        ));
        self.skinning.connect_selected_notify(glib::clone!(
            #[weak]
            window,
            move |list| {
                let skinning = if list.selected() == 1 { Skinning::DualQuaternion } else { Skinning::Linear };
                window.act(|session| session.set_skinning(skinning));
            }
        ));
        self.ambient.connect_value_changed(glib::clone!(
            #[weak]
            window,
            move |slider| window.act(|session| session.change_display(|display| display.ambient = slider.value() as f32))
        ));
    }

    /// Shows what changed.
    pub fn refresh(&self, session: &mut Session, changes: Changes) {
        if changes.any(Changes::DISPLAY) {
            let display = session.display();
            let shading = SHADINGS.iter().position(|(_, shading)| *shading == display.shading).unwrap_or(1);
            self.shading.set_selected(shading as u32);
            self.skinning.set_selected(u32::from(session.state().skinning == Skinning::DualQuaternion));
            self.ambient.set_value(f64::from(display.ambient));
            self.ambient_value.set_text(&format::with_unit(f64::from(display.ambient) * 100.0, 0, "%"));
        }
        if changes.any(Changes::LIGHT | Changes::DOCUMENT) {
            let text = match session.light() {
                None => tr!("app-light-default"),
                Some(aim) => {
                    let [x, y, z] = aim.position(&session.bounds()).to_array().map(|value| format::number(f64::from(value), 2));
                    tr!("app-light-position", x = x, y = y, z = z)
                }
            };
            self.light.set_text(&text);
        }
    }
}

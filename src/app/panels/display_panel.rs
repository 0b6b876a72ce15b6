//! The display panel: every display option of the viewport.

use gtk::glib;
use gtk::prelude::*;
use gtk4 as gtk;

use super::onion_skin_panel::OnionSkinPanel;
use super::panel::Panel;
use crate::app::format;
use crate::app::handles::session_handle::SessionHandle;
use crate::app::widgets::ui;
use crate::document::Skinning;
use crate::message;
use crate::session::{BackgroundPreset, ChangeSet, LightDirection, Session, UndoStep};
use crate::tr;
use crate::view::SHADINGS;

/// Sides of a cell of the grid to choose from, metres; none = after the size of the scene.
const CELLS: [Option<f32>; 6] = [None, Some(0.001), Some(0.01), Some(0.1), Some(1.0), Some(10.0)];

fn cell_name(cell: Option<f32>) -> String {
    match cell {
        None => tr!("app-grid-auto"),
        Some(metres) if metres < 0.01 => format::with_unit(f64::from(metres) * 1000.0, 0, &tr!("app-unit-mm")),
        Some(metres) if metres < 1.0 => format::with_unit(f64::from(metres) * 100.0, 0, &tr!("app-unit-cm")),
        Some(metres) => format::with_unit(f64::from(metres), 0, &tr!("app-unit-m")),
    }
}

ui::widgets! {
    /// The widgets of the panel.
    struct DisplayWidgets from "display_panel.ui" {
        root: gtk::ScrolledWindow,
        shading: gtk::DropDown,
        skinning: gtk::DropDown,
        grid_cell: gtk::DropDown,
        backdrop: gtk::DropDown,
        onion_skins_slot: gtk::Box,
        line_width: gtk::Scale,
        line_width_value: gtk::Label,
        ambient: gtk::Scale,
        ambient_value: gtk::Label,
        light_yaw: gtk::SpinButton,
        light_pitch: gtk::SpinButton,
        light_position: gtk::Label,
    }
}

/// The panel.
pub(crate) struct DisplayPanel {
    widgets: DisplayWidgets,
    onion_skins: OnionSkinPanel,
}

impl DisplayPanel {
    /// The name of the page.
    pub(crate) const ID: &'static str = "display";

    /// The panel of a session.
    pub(crate) fn new(session: &SessionHandle) -> Self {
        let widgets = DisplayWidgets::build();
        let list = |list: &gtk::DropDown, keys: &[&str]| {
            let words: Vec<String> = keys.iter().map(|key| tr!(key)).collect();
            list.set_model(Some(&ui::words(&words)));
        };
        let onion_skins = OnionSkinPanel::new(session);
        widgets.onion_skins_slot.append(&onion_skins.root);
        list(&widgets.shading, &["app-do-flat", "app-do-gouraud", "app-do-phong"]);
        list(&widgets.skinning, &["app-skinning-linear", "app-skinning-dual"]);
        list(&widgets.backdrop, &["app-background-theme", "app-background-white", "app-background-grey", "app-background-black"]);
        widgets.grid_cell.set_model(Some(&ui::words(&CELLS.map(cell_name))));
        let panel = Self { widgets, onion_skins };
        panel.connect(session);
        panel
    }

    /// Lets the lists and the slider change the display.
    fn connect(&self, session: &SessionHandle) {
        self.widgets.shading.connect_selected_notify(glib::clone!(
            #[weak]
            session,
            move |list| {
                if let Some((_, shading)) = SHADINGS.get(list.selected() as usize) {
                    session.update(|session| session.change_display(|display| display.shading = *shading));
                }
            }
        ));
        self.widgets.skinning.connect_selected_notify(glib::clone!(
            #[weak]
            session,
            move |list| {
                let skinning = if list.selected() == 1 { Skinning::DualQuaternion } else { Skinning::Linear };
                session.update(|session| session.set_skinning(skinning));
            }
        ));
        self.widgets.ambient.connect_value_changed(glib::clone!(
            #[weak]
            session,
            move |slider| session.update(|session| session.change_display(|display| display.ambient = slider.value() as f32))
        ));
        self.widgets.line_width.connect_value_changed(glib::clone!(
            #[weak]
            session,
            move |slider| session.update(|session| session.change_display(|display| display.line_width = slider.value() as f32))
        ));
        self.widgets.grid_cell.connect_selected_notify(glib::clone!(
            #[weak]
            session,
            move |list| {
                if let Some(cell) = CELLS.get(list.selected() as usize) {
                    session.update(|session| session.change_display(|display| display.grid_cell = *cell));
                }
            }
        ));
        self.widgets.backdrop.connect_selected_notify(glib::clone!(
            #[weak]
            session,
            move |list| {
                if let Some(backdrop) = BackgroundPreset::ALL.get(list.selected() as usize) {
                    session.update(|session| session.set_backdrop(*backdrop));
                }
            }
        ));
        for number in [&self.widgets.light_yaw, &self.widgets.light_pitch] {
            let (yaw, pitch) = (self.widgets.light_yaw.clone(), self.widgets.light_pitch.clone());
            number.connect_value_changed(glib::clone!(
                #[weak]
                session,
                move |_| {
                    let aim = LightDirection { yaw: yaw.value() as f32, pitch: pitch.value() as f32 };
                    session.update(|session| {
                        session.undoable(message!("app-edit-light"), UndoStep::near(0), |session| session.set_light(aim));
                    });
                }
            ));
        }
    }
}

impl Panel for DisplayPanel {
    fn id(&self) -> &'static str {
        Self::ID
    }

    fn title(&self) -> String {
        tr!("app-page-display")
    }

    fn widget(&self) -> gtk::Widget {
        self.widgets.root.clone().upcast()
    }

    fn refresh(&self, session: &mut Session, changes: ChangeSet) {
        self.onion_skins.refresh(session, changes);
        if changes.any(ChangeSet::DISPLAY) {
            let display = session.display();
            let shading = SHADINGS.iter().position(|(_, shading)| *shading == display.shading).unwrap_or(1);
            self.widgets.shading.set_selected(shading as u32);
            self.widgets.skinning.set_selected(u32::from(session.state().skinning == Skinning::DualQuaternion));
            self.widgets.ambient.set_value(f64::from(display.ambient));
            self.widgets.ambient_value.set_text(&format::with_unit(f64::from(display.ambient) * 100.0, 0, "%"));
        }
        if changes.any(ChangeSet::DISPLAY) {
            let display = session.display();
            let cell = CELLS.iter().position(|cell| *cell == display.grid_cell).unwrap_or(0);
            self.widgets.grid_cell.set_selected(cell as u32);
            let backdrop = BackgroundPreset::ALL.iter().position(|backdrop| *backdrop == session.backdrop()).unwrap_or(0);
            self.widgets.backdrop.set_selected(backdrop as u32);
            self.widgets.line_width.set_value(f64::from(display.line_width));
            self.widgets.line_width_value.set_text(&format!("{}\u{2009}×", format::number(f64::from(display.line_width), 1)));
        }
        if changes.any(ChangeSet::LIGHT | ChangeSet::DOCUMENT | ChangeSet::CAMERA) {
            let aim = session.light_direction();
            self.widgets.light_yaw.set_value(f64::from(aim.yaw.rem_euclid(360.0)));
            self.widgets.light_pitch.set_value(f64::from(aim.pitch));
        }
        if changes.any(ChangeSet::LIGHT | ChangeSet::DOCUMENT) {
            let text = match session.light() {
                None => tr!("app-light-default"),
                Some(aim) => {
                    let [x, y, z] = aim.position(&session.bounds()).to_array().map(|value| format::number(f64::from(value), 2));
                    tr!("app-light-position", x = x, y = y, z = z)
                }
            };
            self.widgets.light_position.set_text(&text);
        }
    }
}

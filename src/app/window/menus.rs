//! The menus of the header, made from the table of commands.

use std::rc::Rc;

use gtk::prelude::*;
use gtk::{gio, glib};
use gtk4 as gtk;

use crate::app::commands::Command;
use crate::app::loading::document_loader::DocumentLoader;
use crate::app::loading::open_buttons;
use crate::app::widgets::ui::{self, object};
use crate::i18n::{self, shown};
use crate::session::{Session, file_cameras};
use crate::tr;

/// The action that looks through a camera of the file, by its place in the list.
const LOOK_THROUGH: &str = "look-through";

/// Puts the menus into the header.
pub(crate) fn connect(loader: &Rc<DocumentLoader>, menu: &gtk::MenuButton, builder: &gtk::Builder) {
    menu.set_menu_model(Some(&main_menu()));
    object::<gtk::MenuButton>(builder, "display_menu").set_menu_model(Some(&display_menu()));
    let look = gio::SimpleAction::new(LOOK_THROUGH, Some(glib::VariantTy::UINT32));
    let session = &loader.app.session;
    look.connect_activate(glib::clone!(
        #[weak]
        session,
        move |_, place| {
            let Some(place) = place.and_then(glib::Variant::get::<u32>) else { return };
            session.update(|session| {
                if let Some((node, camera)) = file_cameras(&session.document().scene).get(place as usize).copied() {
                    session.change_camera(|controller| controller.look_through(node, camera));
                }
            });
        }
    ));
    loader.app.widget.add_action(&look);
    recent_menu(loader, &object(builder, "recent"));
}

fn section(menu: &gio::Menu, commands: &[Command]) {
    let section = gio::Menu::new();
    for command in commands {
        section.append_item(&item(*command));
    }
    menu.append_section(None, &section);
}

fn item(command: Command) -> gio::MenuItem {
    let item = gio::MenuItem::new(Some(&command.label()), Some(&format!("win.{}", command.id())));
    if let Some(key) = command.keys().first() {
        item.set_attribute_value("accel", Some(&key.to_variant()));
    }
    item
}

fn main_menu() -> gio::Menu {
    use Command as C;
    let menu = gio::Menu::new();
    section(&menu, &[C::StartPage, C::SaveSession]);
    section(&menu, &[C::Save, C::SaveAs, C::Revert]);
    section(&menu, &[C::Reload, C::PreviousFile, C::NextFile, C::Close]);
    section(&menu, &[C::Picture, C::PictureTransparent, C::CopyPicture, C::Export]);
    let time = gio::Menu::new();
    section(&time, &[C::Reverse, C::MarkA, C::MarkB, C::ClearMarks]);
    section(&time, &[C::Slower, C::Faster, C::NormalSpeed]);
    section(&time, &[C::PreviousClip, C::NextClip]);
    section(&time, &[C::TimeCloser, C::TimeWider, C::TimeWhole]);
    section(&time, &[C::Sheet, C::Curves]);
    let colours = gio::Menu::new();
    section(&colours, &[C::ColoursSystem, C::ColoursLight, C::ColoursDark]);
    let muscles = gio::Menu::new();
    section(&muscles, &[C::NewMuscle, C::DuplicateMuscle, C::MirrorMuscle, C::DeleteMuscle]);
    let sets = gio::Menu::new();
    section(&sets, &[C::AttachArms, C::AttachLegs, C::AttachBody]);
    muscles.append_submenu(Some(&tr!("app-menu-muscle-sets")), &sets);
    let more = gio::Menu::new();
    more.append_submenu(Some(&tr!("app-group-time")), &time);
    more.append_submenu(Some(&tr!("app-menu-muscles")), &muscles);
    more.append_submenu(Some(&tr!("app-menu-colours")), &colours);
    menu.append_section(None, &more);
    section(&menu, &[C::Sidebars, C::Fullscreen]);
    section(&menu, &[C::Help, C::Shortcuts, C::About, C::Quit]);
    menu
}

fn display_menu() -> gio::Menu {
    use Command as C;
    let menu = gio::Menu::new();
    section(&menu, &[C::PresetClean, C::PresetSkeleton, C::PresetInspection, C::PresetPrint]);
    section(&menu, &[C::Bones, C::BoneNames, C::Materials, C::SmoothNormals, C::NormalGlyphs, C::Wireframe, C::Muscle, C::Weights]);
    section(&menu, &[C::Isolate, C::Hide, C::ShowAll]);
    section(&menu, &[C::OnionSkins, C::BonePath, C::CompareSkinning, C::StopComparing]);
    section(&menu, &[C::Grid, C::Axes, C::BoundingBox]);
    section(&menu, &[C::Flat, C::Gouraud, C::Phong]);
    section(&menu, &[C::FrameTimes]);
    menu
}

/// The camera menu, with the cameras of the file.
pub(crate) fn list_cameras(button: &gtk::MenuButton, session: &Session) {
    use Command as C;
    let menu = gio::Menu::new();
    section(&menu, &[C::Fit, C::ResetCamera, C::Centre, C::Follow]);
    section(&menu, &[C::Front, C::Right, C::Top, C::Iso]);
    section(&menu, &[C::Back, C::Left, C::Bottom, C::IsoOpposite]);
    section(&menu, &[C::Orthographic, C::Fly, C::SmoothCamera]);
    let scene = &session.document().scene;
    let of_file = gio::Menu::new();
    for (place, (node, _)) in file_cameras(scene).iter().enumerate().take(20) {
        let item = gio::MenuItem::new(Some(&shown(&i18n::label(scene.graph.label(*node))).replace('_', "__")), None);
        item.set_action_and_target_value(Some(&format!("win.{LOOK_THROUGH}")), Some(&(place as u32).to_variant()));
        of_file.append_item(&item);
    }
    if of_file.n_items() > 0 {
        menu.append_section(Some(&tr!("app-file-cameras")), &of_file);
    }
    button.set_menu_model(Some(&menu));
}

/// The row that opens a file beside what is open.
fn add_compare(slot: &gtk::Box, done: impl Fn() + 'static) {
    slot.append(&gtk::Separator::new(gtk::Orientation::Horizontal));
    let label = gtk::Label::builder().label(Command::CompareFile.label()).xalign(0.0).build();
    let button: gtk::Button = ui::named("GtkButton", &label.text());
    button.set_child(Some(&label));
    button.set_has_frame(false);
    button.set_tooltip_text(Some(&Command::CompareFile.tooltip()));
    button.set_action_name(Some(&format!("win.{}", Command::CompareFile.id())));
    button.connect_clicked(move |_| done());
    slot.append(&button);
}

/// Recent files, listed anew whenever they are looked at.
fn recent_menu(loader: &Rc<DocumentLoader>, button: &gtk::MenuButton) {
    let slot = gtk::Box::new(gtk::Orientation::Vertical, 6);
    for set in [gtk::Box::set_margin_start, gtk::Box::set_margin_end, gtk::Box::set_margin_top, gtk::Box::set_margin_bottom] {
        set(&slot, 6);
    }
    let popover = gtk::Popover::builder().child(&slot).build();
    button.set_popover(Some(&popover));
    // Before the popover is shown: one that is shown empty has a surface of no width, in which what comes in then finds no room.
    button.set_create_popup_func(glib::clone!(
        #[weak]
        loader,
        #[weak]
        popover,
        move |_| {
            let popover = popover.downgrade();
            let done = move || {
                if let Some(popover) = popover.upgrade() {
                    popover.popdown();
                }
            };
            open_buttons::list_recent(&loader, &slot, done.clone());
            open_buttons::add_demos(&loader, &slot, done.clone());
            add_compare(&slot, done);
        }
    ));
}

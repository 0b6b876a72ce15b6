//! The keyboard of the window: keys go to commands before any widget sees them, but not where a widget needs them.

use std::rc::Rc;

use gtk::prelude::*;
use gtk::{gdk, glib};
use gtk4 as gtk;

use super::commands::Command;
use super::muscle_editor;
use super::shortcuts::at_place;
use super::ui;
use super::window::Window;

/// Listens at the window.
pub(super) fn connect(window: &Rc<Window>) {
    let keys = gtk::EventControllerKey::new();
    keys.set_propagation_phase(gtk::PropagationPhase::Capture);
    keys.connect_key_pressed(glib::clone!(
        #[weak]
        window,
        #[upgrade_or]
        glib::Propagation::Proceed,
        move |controller, key, code, modifiers| {
            let hardware = keycode(controller, code);
            if !is_typing(&window) && window.viewport.flight_key(&window, letter(key, hardware), key, true) {
                return glib::Propagation::Stop;
            }
            if leave_box(&window, key) || key == gdk::Key::Escape && leave(&window) {
                return glib::Propagation::Stop;
            }
            if matches!(key, gdk::Key::Tab | gdk::Key::ISO_Left_Tab)
                && !modifiers.intersects(gdk::ModifierType::CONTROL_MASK | gdk::ModifierType::ALT_MASK)
                && leave_list(&window, key == gdk::Key::Tab)
            {
                return glib::Propagation::Stop;
            }
            match window.keys.command(key, hardware, modifiers) {
                Some(command) if !is_for_widget(&window, key, modifiers) => {
                    run(&window, command);
                    glib::Propagation::Stop
                }
                _ => glib::Propagation::Proceed,
            }
        }
    ));
    keys.connect_key_released(glib::clone!(
        #[weak]
        window,
        move |controller, key, code, _| {
            window.viewport.flight_key(&window, letter(key, keycode(controller, code)), key, false);
        }
    ));
    window.widget.add_controller(keys);
    remember_text(window);
    window.widget.connect_is_active_notify(glib::clone!(
        #[weak]
        window,
        move |widget| {
            if !widget.is_active() {
                window.viewport.release_flight_keys();
            }
        }
    ));
}

/// Remembers what an entry said when the keyboard came to it, for Esc.
fn remember_text(window: &Rc<Window>) {
    window.widget.connect_focus_widget_notify(|widget| {
        if let Some(text) = GtkWindowExt::focus(widget).and_downcast::<gtk::Text>() {
            muscle_editor::remember_shown(&text);
        }
    });
}

/// Enter takes what was typed into a box of a number, Esc what a box or an entry said before, and the keyboard goes back to the picture. Whether it did.
fn leave_box(window: &Rc<Window>, key: gdk::Key) -> bool {
    let enter = matches!(key, gdk::Key::Return | gdk::Key::KP_Enter);
    let text = focus(window).and_downcast::<gtk::Text>().filter(|text| text.native().is_some_and(|native| native == window.widget));
    let Some(text) = text.filter(|_| enter || key == gdk::Key::Escape) else { return false };
    if let Some(number) = text.ancestor(gtk::SpinButton::static_type()).and_downcast::<gtk::SpinButton>() {
        if enter {
            number.update();
        } else {
            // The same value again: it is written anew.
            number.set_value(number.value());
        }
    } else if let Some(entry) = text.ancestor(gtk::Entry::static_type()).and_downcast::<gtk::Entry>().filter(|_| !enter) {
        muscle_editor::show_as_before(&entry);
    } else {
        return false;
    }
    window.viewport.take_focus();
    true
}

/// Esc leaves what has been begun, whatever has the focus; else it sends away what has come up over the scene, but not from under a menu or a text that is
/// being typed, which have an Esc of their own; at last it takes the selection away. Whether there was any of that.
fn leave(window: &Rc<Window>) -> bool {
    if window.read(|session| session.picking().is_some()) {
        window.update(|session| {
            session.stop_picking();
        });
        return true;
    }
    if is_typing(window) || focus(window).and_then(|widget| widget.native()).is_some_and(|native| native != window.widget) {
        return false;
    }
    if window.error_bar.root.is_visible() {
        window.error_bar.hide();
        return true;
    }
    if window.leave_start_page() {
        return true;
    }
    let selected = window.read(|session| session.selected().is_some());
    if selected {
        window.update(|session| session.select(None));
    }
    selected
}

/// Tab leaves a list as one thing, instead of going through its rows, of which there may be hundreds: arrows do that. Whether the focus was in one.
fn leave_list(window: &Rc<Window>, forward: bool) -> bool {
    let list = focus(window).and_then(|widget| widget.ancestor(gtk::ListView::static_type()));
    // Those of menus are left to the menus.
    let Some(list) = list.filter(|list| list.root().is_some_and(|root| root == window.widget)) else { return false };
    let direction = if forward { gtk::DirectionType::TabForward } else { gtk::DirectionType::TabBackward };
    list.set_can_focus(false);
    window.widget.emit_move_focus(direction);
    list.set_can_focus(true);
    true
}

/// Only what can be done now is done.
fn run(window: &Rc<Window>, command: Command) {
    if let Some(action) = window.actions().get(&command).filter(|action| action.is_enabled()) {
        action.activate(None);
    }
}

/// The keycode where keycodes are those of X11 and Wayland.
fn keycode(controller: &gtk::EventControllerKey, code: u32) -> Option<u32> {
    let display = controller.widget()?.display().type_().name();
    ["X11", "Wayland"].iter().any(|kind| display.contains(kind)).then_some(code)
}

/// The letter of a key in flight: there the letters mean their places, as in games.
fn letter(key: gdk::Key, hardware: Option<u32>) -> Option<char> {
    hardware.and_then(at_place).or_else(|| key.to_unicode()).map(|letter| letter.to_ascii_lowercase())
}

fn focus(window: &Rc<Window>) -> Option<gtk::Widget> {
    GtkWindowExt::focus(&window.widget)
}

/// Whether text is being typed somewhere.
fn is_typing(window: &Rc<Window>) -> bool {
    focus(window).is_some_and(|widget| widget.is::<gtk::Text>() || widget.is::<gtk::TextView>())
}

/// Whether the focused widget needs this key itself.
fn is_for_widget(window: &Rc<Window>, key: gdk::Key, modifiers: gdk::ModifierType) -> bool {
    use gdk::Key as K;
    let Some(widget) = focus(window) else { return false };
    let plain = !modifiers.intersects(gdk::ModifierType::CONTROL_MASK | gdk::ModifierType::ALT_MASK);
    let function = key.name().is_some_and(|name| name.len() > 1 && name.starts_with('F') && name[1..].parse::<u8>().is_ok());
    // Menus and other popovers take all that is typed.
    if widget.native().is_some_and(|native| native.downcast_ref::<gtk::Window>().is_none()) {
        return plain && !function;
    }
    if is_typing(window) {
        // No number has a space in it, so in a number box it plays as elsewhere. Letters do nothing there: a word that is typed by mistake is no command.
        let in_number = widget.ancestor(gtk::SpinButton::static_type()).is_some()
            || widget.ancestor(gtk::Entry::static_type()).and_downcast::<gtk::Entry>().is_some_and(|entry| ui::is_of_numbers(&entry));
        if in_number && plain && key == K::space {
            return false;
        }
        let text_keys = [K::c, K::z, K::Z, K::y, K::Left, K::Right, K::o].contains(&key) && key != K::o;
        return !function && (plain || text_keys && modifiers.contains(gdk::ModifierType::CONTROL_MASK));
    }
    let arrows = matches!(key, K::Left | K::Right | K::Up | K::Down | K::Home | K::End | K::Page_Up | K::Page_Down);
    if widget.is::<gtk::Range>() {
        return arrows && plain && !window.is_track(&widget);
    }
    let enter = matches!(key, K::Return | K::KP_Enter);
    let in_list = std::iter::successors(Some(widget.clone()), |widget| widget.parent())
        .any(|widget| widget.is::<gtk::ListView>() || widget.is::<gtk::ColumnView>() || widget.is::<gtk::StackSwitcher>());
    if in_list {
        return (arrows || enter) && plain;
    }
    // What is selected in a text is copied, not the picture.
    let selected = |label: &gtk::Label| label.selection_bounds().is_some();
    if !plain && matches!(key, K::c | K::C | K::Cyrillic_es | K::Cyrillic_ES) && widget.downcast_ref().is_some_and(selected) {
        return true;
    }
    // Enter presses a button; Space plays, whatever has the focus.
    (widget.is::<gtk::Button>() || widget.is::<gtk::Expander>() || widget.is::<gtk::CheckButton>() || widget.is::<gtk::MenuButton>())
        && enter
        && plain
}

//! The keyboard of the window: keys go to commands before any widget sees them, but not where a widget needs them.

use std::rc::Rc;

use gtk::prelude::*;
use gtk::{gdk, glib};
use gtk4 as gtk;

use super::Command;
use super::command_context::CommandContext;
use super::shortcuts::{KeyChords, at_place};
use crate::app::panels::muscle::muscle_editor;
use crate::app::widgets::ui;

/// Listens at the window.
pub(crate) fn connect(context: &Rc<CommandContext>) {
    let keys = gtk::EventControllerKey::new();
    keys.set_propagation_phase(gtk::PropagationPhase::Capture);
    let chords = KeyChords::default();
    keys.connect_key_pressed(glib::clone!(
        #[weak]
        context,
        #[upgrade_or]
        glib::Propagation::Proceed,
        move |controller, key, code, modifiers| {
            let hardware = keycode(controller, code);
            if !is_typing(&context) && context.viewport.flight_key(letter(key, hardware), key, true) {
                return glib::Propagation::Stop;
            }
            if leave_box(&context, key) || key == gdk::Key::Escape && leave(&context) {
                return glib::Propagation::Stop;
            }
            if matches!(key, gdk::Key::Tab | gdk::Key::ISO_Left_Tab)
                && !modifiers.intersects(gdk::ModifierType::CONTROL_MASK | gdk::ModifierType::ALT_MASK)
                && leave_list(&context, key == gdk::Key::Tab)
            {
                return glib::Propagation::Stop;
            }
            match chords.command(key, hardware, modifiers) {
                Some(command) if !is_for_widget(&context, key, modifiers) => {
                    run(&context, command);
                    glib::Propagation::Stop
                }
                _ => glib::Propagation::Proceed,
            }
        }
    ));
    keys.connect_key_released(glib::clone!(
        #[weak]
        context,
        move |controller, key, code, _| {
            context.viewport.flight_key(letter(key, keycode(controller, code)), key, false);
        }
    ));
    context.app.widget.add_controller(keys);
    remember_text(context);
    context.app.widget.connect_is_active_notify(glib::clone!(
        #[weak]
        context,
        move |widget| {
            if !widget.is_active() {
                context.viewport.release_flight_keys();
            }
        }
    ));
}

/// Remembers what an entry said when the keyboard came to it, for Esc.
fn remember_text(context: &Rc<CommandContext>) {
    context.app.widget.connect_focus_widget_notify(|widget| {
        if let Some(text) = GtkWindowExt::focus(widget).and_downcast::<gtk::Text>() {
            muscle_editor::remember_shown(&text);
        }
    });
}

/// Enter takes what was typed into a box of a number, Esc what a box or an entry said before, and the keyboard goes back to the picture. Whether it did.
fn leave_box(context: &Rc<CommandContext>, key: gdk::Key) -> bool {
    let enter = matches!(key, gdk::Key::Return | gdk::Key::KP_Enter);
    let text = focus(context).and_downcast::<gtk::Text>().filter(|text| text.native().is_some_and(|native| native == context.app.widget));
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
    context.app.focus.take();
    true
}

/// Esc leaves what has been begun, whatever has the focus; else it sends away what has come up over the scene, but not from under a menu or a text that is
/// being typed, which have an Esc of their own; at last it takes the selection away. Whether there was any of that.
fn leave(context: &Rc<CommandContext>) -> bool {
    if context.app.session.read(|session| session.picking().is_some()) {
        context.app.session.update(|session| {
            session.stop_picking();
        });
        return true;
    }
    if is_typing(context) || focus(context).and_then(|widget| widget.native()).is_some_and(|native| native != context.app.widget) {
        return false;
    }
    if context.app.error_bar.root.is_visible() {
        context.app.error_bar.hide();
        return true;
    }
    if context.app.start_page.leave() {
        return true;
    }
    let selected = context.app.session.read(|session| session.selected().is_some());
    if selected {
        context.app.session.update(|session| session.select(None));
    }
    selected
}

/// Tab leaves a list as one thing, instead of going through its rows, of which there may be hundreds: arrows do that. Whether the focus was in one.
fn leave_list(context: &Rc<CommandContext>, forward: bool) -> bool {
    let list = focus(context).and_then(|widget| widget.ancestor(gtk::ListView::static_type()));
    // Those of menus are left to the menus.
    let Some(list) = list.filter(|list| list.root().is_some_and(|root| root == context.app.widget)) else { return false };
    let direction = if forward { gtk::DirectionType::TabForward } else { gtk::DirectionType::TabBackward };
    list.set_can_focus(false);
    context.app.widget.emit_move_focus(direction);
    list.set_can_focus(true);
    true
}

/// Only what can be done now is done.
fn run(context: &Rc<CommandContext>, command: Command) {
    if let Some(action) = context.actions.get(&command).filter(|action| action.is_enabled()) {
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

fn focus(context: &Rc<CommandContext>) -> Option<gtk::Widget> {
    GtkWindowExt::focus(&context.app.widget)
}

/// Whether text is being typed somewhere.
fn is_typing(context: &Rc<CommandContext>) -> bool {
    focus(context).is_some_and(|widget| widget.is::<gtk::Text>() || widget.is::<gtk::TextView>())
}

/// Whether the focused widget needs this key itself.
fn is_for_widget(context: &Rc<CommandContext>, key: gdk::Key, modifiers: gdk::ModifierType) -> bool {
    use gdk::Key as K;
    let Some(widget) = focus(context) else { return false };
    let plain = !modifiers.intersects(gdk::ModifierType::CONTROL_MASK | gdk::ModifierType::ALT_MASK);
    let function = key.name().is_some_and(|name| name.len() > 1 && name.starts_with('F') && name[1..].parse::<u8>().is_ok());
    // Menus and other popovers take all that is typed.
    if widget.native().is_some_and(|native| native.downcast_ref::<gtk::Window>().is_none()) {
        return plain && !function;
    }
    if is_typing(context) {
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
        return arrows && plain && !context.timeline.is_track(&widget);
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

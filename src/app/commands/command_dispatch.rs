//! Performs commands, and shows in their actions what is on and what can be done.

use std::collections::HashMap;
use std::rc::Rc;

use gtk::prelude::*;
use gtk::{gio, glib};
use gtk4 as gtk;

use super::Command;
use super::command_action::{Action, AppCommand, AppSwitch};
use super::command_conditions::Conditions;
use super::command_context::CommandContext;
use crate::app::appearance;
use crate::app::dialogs::{about, compare_file, export_dialog, help, save_session, saving, screenshot};
use crate::app::panels::muscle::attach_muscles;
use crate::app::settings::SheetPage;
use crate::session::Session;

/// One action a command; those that are on or off have a state.
pub(crate) fn make_actions() -> HashMap<Command, gio::SimpleAction> {
    let make = |command: Command| match command.action() {
        Action::Change(_) | Action::Edit(_) | Action::LookFrom(_) | Action::TakePreset(_) | Action::Run(_) => {
            gio::SimpleAction::new(command.id(), None)
        }
        Action::Toggle(..)
        | Action::EditToggle(..)
        | Action::Flag(_)
        | Action::TakeTool(_)
        | Action::Shade(_)
        | Action::Colors(_)
        | Action::Switch(_) => gio::SimpleAction::new_stateful(command.id(), None, &false.to_variant()),
    };
    Command::ALL.iter().map(|command| (*command, make(*command))).collect()
}

/// Puts the actions into the window and lets them perform their commands.
pub(crate) fn connect(context: &Rc<CommandContext>) {
    for (command, action) in &context.actions {
        let command = *command;
        action.connect_activate(glib::clone!(
            #[weak]
            context,
            move |_, _| perform(&context, command)
        ));
        context.app.widget.add_action(action);
    }
}

/// Shows in the actions what is on and what can be done, unless the session is being changed just now.
pub(crate) fn refresh_states(context: &CommandContext) {
    context.app.session.show(|session| show_states(context, session));
}

/// Shows in the actions what is on and what can be done.
pub(crate) fn show_states(context: &CommandContext, session: &Session) {
    let conditions = Conditions { session, can_retry: context.loader.can_retry(), animates: appearance::animates() };
    for (command, action) in &context.actions {
        if let Some(on) = is_on(context, command.action(), session) {
            action.set_state(&on.to_variant());
        }
        action.set_enabled(command.is_possible(&conditions));
    }
}

/// Whether it is on; `None` for what is neither on nor off.
fn is_on(context: &CommandContext, action: Action, session: &Session) -> Option<bool> {
    match action {
        Action::Change(_) | Action::Edit(_) | Action::LookFrom(_) | Action::TakePreset(_) | Action::Run(_) => None,
        Action::Toggle(is_on, _) | Action::EditToggle(is_on, _) => Some(is_on(session)),
        Action::Flag(flag) => Some(*flag(&mut session.display().clone())),
        Action::TakeTool(tool) => Some(session.tool() == tool),
        Action::Shade(shading) => Some(session.display().shading == shading),
        Action::Colors(colors) => Some(context.app.settings.borrow().colours == colors),
        Action::Switch(switch) => Some(is_switch_on(context, switch)),
    }
}

fn is_switch_on(context: &CommandContext, switch: AppSwitch) -> bool {
    let settings = &context.app.settings;
    match switch {
        AppSwitch::Tree => context.side_panels.shown().0,
        AppSwitch::Panel => context.side_panels.shown().1,
        AppSwitch::Fullscreen => context.app.widget.is_fullscreen(),
        AppSwitch::FrameTimes => settings.borrow().frame_times,
        AppSwitch::Sheet(page) => settings.borrow().sheet == page,
        AppSwitch::SmoothCamera => settings.borrow().smooth_camera,
    }
}

/// Does it.
fn perform(context: &Rc<CommandContext>, command: Command) {
    let session = &context.app.session;
    match command.action() {
        Action::Change(change) | Action::Edit(change) | Action::Toggle(_, change) | Action::EditToggle(_, change) => session.update(change),
        Action::Flag(flag) => session.update(|session| {
            session.change_display(|display| {
                let on = flag(display);
                *on = !*on;
            });
        }),
        Action::TakeTool(tool) => session.update(|session| session.set_tool(tool)),
        Action::Shade(shading) => session.update(|session| session.change_display(|display| display.shading = shading)),
        Action::LookFrom(view) => session.update(|session| session.change_camera(|camera| camera.look_from(view))),
        Action::TakePreset(preset) => session.update(|session| session.take_preset(preset)),
        Action::Colors(colors) => {
            context.app.settings.borrow_mut().colours = colors;
            appearance::choose(colors);
            refresh_states(context);
        }
        Action::Switch(switch) => turn(context, switch),
        Action::Run(command) => perform_in_window(context, command),
    }
}

fn perform_in_window(context: &Rc<CommandContext>, command: AppCommand) {
    let (app, loader) = (&context.app, &context.loader);
    match command {
        AppCommand::Open => loader.choose(),
        AppCommand::CompareFile => compare_file::choose(app),
        AppCommand::Reload => loader.reload(),
        AppCommand::Save => saving::save(app, || ()),
        AppCommand::SaveAs => saving::save_as(app),
        AppCommand::Neighbour(by) => loader.open_neighbour(by),
        AppCommand::Close => loader.close(),
        AppCommand::Quit => app.widget.close(),
        AppCommand::SaveSession => save_session::save(app),
        AppCommand::StartPage => app.start_page.want(true),
        AppCommand::Picture => screenshot::save(app, &context.viewport, false),
        AppCommand::PictureTransparent => screenshot::save(app, &context.viewport, true),
        AppCommand::CopyPicture => screenshot::copy(app, &context.viewport),
        AppCommand::Export => export_dialog::show(app, &context.viewport),
        AppCommand::ZoomTime(factor) => context.timeline.axis.change(|track| track.zoom(factor, track.time)),
        AppCommand::WholeTime => context.timeline.axis.change(|track| track.range = track.whole),
        AppCommand::Fly => context.viewport.toggle_flight(),
        AppCommand::NewMuscle => context.muscle.add_muscle(),
        AppCommand::DuplicateMuscle => context.muscle.duplicate_muscle(),
        AppCommand::MirrorMuscle => attach_muscles::mirror(&app.session, &app.toasts),
        AppCommand::AttachSet(set) => attach_muscles::attach_set(&app.session, &app.toasts, set),
        AppCommand::DeleteMuscle => context.muscle.delete_muscle(),
        AppCommand::Sidebars => {
            let shown = context.side_panels.shown() != (false, false);
            show_sides(context, !shown, !shown);
        }
        AppCommand::Menu => context.menu.popup(),
        AppCommand::Help => help::show(&app.widget),
        AppCommand::Shortcuts => about::shortcuts(&app.widget),
        AppCommand::About => about::about(&app.widget),
    }
}

/// Turns something of the window on or off.
fn turn(context: &CommandContext, switch: AppSwitch) {
    let (app, (tree, panel)) = (&context.app, context.side_panels.shown());
    let on = !is_switch_on(context, switch);
    match switch {
        AppSwitch::Tree => return show_sides(context, on, panel),
        AppSwitch::Panel => return show_sides(context, tree, on),
        AppSwitch::Fullscreen if on => app.widget.fullscreen(),
        AppSwitch::Fullscreen => app.widget.unfullscreen(),
        AppSwitch::FrameTimes => {
            app.settings.borrow_mut().frame_times = on;
            context.viewport.show_times(on);
        }
        AppSwitch::Sheet(page) => {
            app.settings.borrow_mut().sheet = if on { page } else { SheetPage::None };
            context.show_sheet();
        }
        AppSwitch::SmoothCamera => {
            app.settings.borrow_mut().smooth_camera = on;
            app.session.update(|session| session.set_eased(on && appearance::animates()));
        }
    }
    refresh_states(context);
}

/// Shows or folds away the tree and the right panel. Where there is no room for both, the one that comes takes the other's place.
pub(crate) fn show_sides(context: &CommandContext, tree: bool, panel: bool) {
    context.side_panels.show(&context.app.widget, tree, panel);
    refresh_states(context);
}

//! What each command does, when it can be done, and what its switch shows.

use std::collections::HashMap;
use std::rc::Rc;

use gtk::prelude::*;
use gtk::{gio, glib};
use gtk4 as gtk;

use super::command_context::CommandContext;
use super::commands::Command;
use super::settings::{ColorScheme, SheetPage};
use super::{about, appearance, compare_file, export_dialog, help, save_session, saving, screenshot};
use crate::message;
use crate::muscle::AttachmentPoint;
use crate::render::{Samples, Shading};
use crate::scene::ViewDirection;
use crate::session::{CompareTarget, DisplayPreset, PickTarget, Session, Tool, UndoStep};

/// One action a command; those that are on or off have a state.
pub(super) fn make_actions() -> HashMap<Command, gio::SimpleAction> {
    let probe = Session::default();
    let make = |command: Command| match flag_state(command, &probe) {
        Some(_) => gio::SimpleAction::new_stateful(command.id(), None, &false.to_variant()),
        None if has_window_state(command) => gio::SimpleAction::new_stateful(command.id(), None, &false.to_variant()),
        None => gio::SimpleAction::new(command.id(), None),
    };
    Command::ALL.iter().map(|command| (*command, make(*command))).collect()
}

/// Lets the actions perform their commands.
pub(super) fn connect(context: &Rc<CommandContext>) {
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
pub(super) fn refresh_states(context: &CommandContext) {
    context.app.session.show(|session| show_states(context, session));
}

/// Shows or folds away the tree and the right panel. Where there is no room for both, the one that comes takes the other's place.
pub(super) fn show_sides(context: &CommandContext, tree: bool, panel: bool) {
    context.side_panels.show(&context.app.widget, tree, panel);
    refresh_states(context);
}

/// Shows in the actions what is on and what can be done.
pub(super) fn show_states(context: &CommandContext, session: &Session) {
    for (command, action) in &context.actions {
        if let Some(on) = flag_state(*command, session).or_else(|| window_state(context, *command)) {
            action.set_state(&on.to_variant());
        }
        action.set_enabled(is_possible(context, *command, session));
    }
}

fn tool_of(command: Command) -> Option<Tool> {
    match command {
        Command::ToolNavigate => Some(Tool::Navigate),
        Command::ToolMove => Some(Tool::Move),
        Command::ToolRotate => Some(Tool::Rotate),
        Command::ToolScale => Some(Tool::Scale),
        _ => None,
    }
}

fn shading_of(command: Command) -> Option<Shading> {
    match command {
        Command::Flat => Some(Shading::Flat),
        Command::Gouraud => Some(Shading::Gouraud),
        Command::Phong => Some(Shading::Phong),
        _ => None,
    }
}

fn color_scheme_of(command: Command) -> Option<ColorScheme> {
    match command {
        Command::ColoursSystem => Some(ColorScheme::System),
        Command::ColoursLight => Some(ColorScheme::Light),
        Command::ColoursDark => Some(ColorScheme::Dark),
        _ => None,
    }
}

fn flag_state(command: Command, session: &Session) -> Option<bool> {
    if let Some(switch) = command.display_flag() {
        return Some(*switch(&mut session.display().clone()));
    }
    if let Some(tool) = tool_of(command) {
        return Some(session.tool() == tool);
    }
    if let Some(shading) = shading_of(command) {
        return Some(session.display().shading == shading);
    }
    match command {
        Command::Play => Some(session.playback().playing),
        Command::Reverse => Some(session.playback().speed < 0.0),
        Command::Orthographic => Some(session.camera_controller().orbit().orthographic),
        Command::Weights => Some(session.display().highlight.weights.is_some()),
        Command::SmoothEdges => Some(session.display().samples == Samples::Four),
        Command::BoneNames => Some(session.bone_names()),
        Command::Ghosts => Some(session.onion_skin_settings().shown),
        Command::BonePath => Some(session.onion_skin_settings().path),
        Command::Follow => Some(session.followed().is_some()),
        Command::CompareSkinning => Some(matches!(session.compare_target(), Some(CompareTarget::Skinning))),
        Command::Isolate => Some(session.is_isolated()),
        _ => None,
    }
}

fn has_window_state(command: Command) -> bool {
    use Command as C;
    matches!(command, C::Tree | C::Panel | C::Fullscreen | C::FrameTimes | C::Sheet | C::Curves | C::SmoothCamera)
        || color_scheme_of(command).is_some()
}

fn window_state(context: &CommandContext, command: Command) -> Option<bool> {
    match command {
        Command::Tree => Some(context.side_panels.shown().0),
        Command::Panel => Some(context.side_panels.shown().1),
        Command::Fullscreen => Some(context.app.widget.is_fullscreen()),
        Command::FrameTimes => Some(context.app.settings.borrow().frame_times),
        Command::Sheet => Some(context.app.settings.borrow().sheet == SheetPage::Keys),
        Command::Curves => Some(context.app.settings.borrow().sheet == SheetPage::Curves),
        Command::SmoothCamera => Some(context.app.settings.borrow().smooth_camera),
        _ => color_scheme_of(command).map(|colours| context.app.settings.borrow().colours == colours),
    }
}

fn is_possible(context: &CommandContext, command: Command, session: &Session) -> bool {
    use Command as C;
    let has_time = session.playback().duration() > 0.0;
    match command {
        C::Undo => session.undo_counts().0,
        C::Redo => session.undo_counts().1,
        C::Play | C::Reverse | C::FrameBack | C::FrameForward | C::SecondBack | C::SecondForward | C::First | C::Last => has_time,
        C::PreviousKey | C::NextKey | C::MarkA | C::MarkB | C::TimeCloser | C::TimeWider | C::TimeWhole => has_time,
        C::ClearMarks => session.playback().mark_a.is_some() || session.playback().mark_b.is_some(),
        C::PreviousClip | C::NextClip => session.document().clips.len() > 1,
        // Where the desktop asks for no animation there is none, whatever is chosen here.
        C::SmoothCamera => appearance::animates(),
        C::Centre | C::Hide => session.selected().is_some(),
        C::Isolate => session.selected().is_some() || session.is_isolated(),
        C::ShowAll => session.hides_something(),
        C::Ghosts => has_time || session.onion_skin_settings().shown,
        C::BonePath => has_time || session.onion_skin_settings().path,
        C::Follow => session.can_follow() || session.followed().is_some(),
        C::StopComparing => session.compare_target().is_some(),
        C::CompareFile => !session.is_empty(),
        C::CompareSkinning => session.has_skins() || session.compare_target().is_some(),
        C::ContractMore | C::ContractLess | C::DuplicateMuscle | C::DeleteMuscle => session.document().muscle_count() > 0,
        C::ElbowMore | C::ElbowLess => session.bends_arm() || session.joint().is_some(),
        C::PickOrigin | C::PickInsertion => !session.bones_for(session.shown_muscle()).is_empty(),
        C::SeeThrough => session.posed().surfaces.iter().any(|surface| surface.skin),
        C::Weights => session.selected().is_some_and(|node| session.is_bone(node)) || session.display().highlight.weights.is_some(),
        C::ResetLight => session.light().is_some(),
        C::ResetModel => !session.model().is_identity(),
        C::Save | C::SaveAs => session.document().muscle_count() > 0,
        C::Revert => session.is_unsaved(),
        C::Reload | C::PreviousFile | C::NextFile => !session.files().is_empty() || context.loader.can_retry(),
        C::SaveSession | C::Picture | C::PictureTransparent | C::CopyPicture | C::Export => !session.is_empty(),
        _ => true,
    }
}

/// Does it.
pub(super) fn perform(context: &Rc<CommandContext>, command: Command) {
    use Command as C;
    if let Some(switch) = command.display_flag() {
        return context.app.session.update(|session| {
            session.change_display(|display| {
                let on = switch(display);
                *on = !*on;
            });
        });
    }
    if let Some(tool) = tool_of(command) {
        return context.app.session.update(|session| session.set_tool(tool));
    }
    if let Some(shading) = shading_of(command) {
        return context.app.session.update(|session| session.change_display(|display| display.shading = shading));
    }
    if let Some(colours) = color_scheme_of(command) {
        context.app.settings.borrow_mut().colours = colours;
        appearance::choose(colours);
        return refresh_states(context);
    }
    let look_from = |view: ViewDirection| context.app.session.update(|session| session.change_camera(|camera| camera.look_from(view)));
    match command {
        C::Open => context.loader.choose(),
        C::CompareFile => compare_file::choose(&context.app),
        C::Reload => context.loader.reload(),
        C::Save => saving::save(&context.app, || ()),
        C::SaveAs => saving::save_as(&context.app),
        C::PreviousFile => context.loader.open_neighbour(-1),
        C::NextFile => context.loader.open_neighbour(1),
        C::Close => context.loader.close(),
        C::Quit => context.app.widget.close(),
        C::SaveSession => save_session::save(&context.app),
        C::StartPage => context.app.start_page.want(true),
        C::Picture => screenshot::save(&context.app, &context.viewport, false),
        C::PictureTransparent => screenshot::save(&context.app, &context.viewport, true),
        C::CopyPicture => screenshot::copy(&context.app, &context.viewport),
        C::Export => export_dialog::show(&context.app, &context.viewport),
        C::Front => look_from(ViewDirection::Front),
        C::Back => look_from(ViewDirection::Back),
        C::Right => look_from(ViewDirection::Right),
        C::Left => look_from(ViewDirection::Left),
        C::Top => look_from(ViewDirection::Top),
        C::Bottom => look_from(ViewDirection::Bottom),
        C::Iso => look_from(ViewDirection::Iso),
        C::Sidebars => {
            let shown = context.side_panels.shown() != (false, false);
            show_sides(context, !shown, !shown);
        }
        C::Tree => show_sides(context, !context.side_panels.shown().0, context.side_panels.shown().1),
        C::Panel => show_sides(context, context.side_panels.shown().0, !context.side_panels.shown().1),
        C::Fullscreen => {
            if context.app.widget.is_fullscreen() {
                context.app.widget.unfullscreen()
            } else {
                context.app.widget.fullscreen()
            }
            refresh_states(context);
        }
        C::FrameTimes => {
            let shown = !context.app.settings.borrow().frame_times;
            context.app.settings.borrow_mut().frame_times = shown;
            context.viewport.show_times(shown);
            refresh_states(context);
        }
        C::TimeCloser => context.timeline.axis.change(|track| track.zoom(1.5, track.time)),
        C::TimeWider => context.timeline.axis.change(|track| track.zoom(1.0 / 1.5, track.time)),
        C::TimeWhole => context.timeline.axis.change(|track| track.range = track.whole),
        C::Sheet => unfold(context, SheetPage::Keys),
        C::Curves => unfold(context, SheetPage::Curves),
        C::SmoothCamera => {
            let smooth = !context.app.settings.borrow().smooth_camera;
            context.app.settings.borrow_mut().smooth_camera = smooth;
            context.app.session.update(|session| session.set_eased(smooth && appearance::animates()));
            refresh_states(context);
        }
        C::Menu => context.menu.popup(),
        C::Help => help::show(&context.app.widget),
        C::Shortcuts => about::shortcuts(&context.app.widget),
        C::About => about::about(&context.app.widget),
        C::Fly => context.viewport.toggle_flight(),
        C::NewMuscle => context.muscle.add_muscle(),
        C::DuplicateMuscle => context.muscle.duplicate_muscle(),
        C::DeleteMuscle => context.muscle.delete_muscle(),
        in_session => context.app.session.update(|session| change_session(in_session, session)),
    }
}

/// Unfolds a page below the track, or folds it away where it is shown.
fn unfold(context: &Rc<CommandContext>, page: SheetPage) {
    let shown = context.app.settings.borrow().sheet == page;
    context.app.settings.borrow_mut().sheet = if shown { SheetPage::None } else { page };
    context.show_sheet();
    refresh_states(context);
}

/// The commands that change the session and nothing else.
fn change_session(command: Command, session: &mut Session) {
    use Command as C;
    let pace = session.playback().speed.abs();
    let (here, start, end) = (session.playback().time, session.playback().start, session.playback().end);
    match command {
        C::Play => session.toggle_playing(),
        C::Reverse => session.time(|time| {
            time.speed = -time.speed;
            time.play();
        }),
        C::FrameBack => session.step_frames(-1),
        C::FrameForward => session.step_frames(1),
        C::SecondBack => session.time(|time| time.seek(here - 1.0)),
        C::SecondForward => session.time(|time| time.seek(here + 1.0)),
        C::First => session.time(|time| time.seek(start)),
        C::Last => session.time(|time| time.seek(end)),
        C::PreviousKey => session.step_key(false),
        C::NextKey => session.step_key(true),
        C::Slower => session.time(|time| time.set_speed(pace / 1.25)),
        C::Faster => session.time(|time| time.set_speed(pace * 1.25)),
        C::NormalSpeed => session.time(|time| time.speed = 1.0),
        C::LoopMode => session.next_loop_mode(),
        // A mark on the wrong side of the other one begins a new stretch.
        C::MarkA => session.time(|time| (time.mark_a, time.mark_b) = (Some(here), time.mark_b.filter(|b| *b > here))),
        C::MarkB => session.time(|time| (time.mark_a, time.mark_b) = (time.mark_a.filter(|a| *a < here), Some(here))),
        C::ClearMarks => session.time(|time| (time.mark_a, time.mark_b) = (None, None)),
        C::PreviousClip => session.next_clip(-1),
        C::NextClip => session.next_clip(1),
        C::Fit => session.fit(),
        C::ResetCamera => session.reset_camera(),
        C::Follow => session.toggle_follow(),
        C::Centre => {
            if let Some(node) = session.selected() {
                session.centre_on(node);
            }
        }
        C::IsoOpposite => session.change_camera(|camera| {
            camera.animate_to(|orbit| {
                let (yaw, pitch) = ViewDirection::Iso.angles();
                (orbit.yaw, orbit.pitch) = (yaw + 180.0, -pitch);
            });
        }),
        C::Orthographic => session.change_camera(|camera| camera.animate_to(|orbit| orbit.orthographic = !orbit.orthographic)),
        C::ResetLight => session.reset_light(),
        C::ResetModel => {
            session.undoable(message!("app-edit-reset-model"), UndoStep::New, |session| session.change_model(|model| model.reset()));
        }
        C::ContractMore | C::ContractLess => {
            if let Some(contraction) = session.contraction() {
                session.set_contraction_undoable(contraction + if command == C::ContractMore { 5.0 } else { -5.0 });
            }
        }
        C::ElbowMore | C::ElbowLess => {
            if let Some(bend) = session.angle_slider() {
                session.set_angle_undoable(bend.value + if command == C::ElbowMore { 5.0 } else { -5.0 });
            }
        }
        C::PickOrigin => session.start_picking(session.shown_muscle(), PickTarget::Point(AttachmentPoint::End(0))),
        C::PickInsertion => session.start_picking(session.shown_muscle(), PickTarget::Point(AttachmentPoint::End(1))),
        C::PresetClean => session.take_preset(DisplayPreset::Clean),
        C::PresetSkeleton => session.take_preset(DisplayPreset::Skeleton),
        C::PresetInspection => session.take_preset(DisplayPreset::Inspection),
        C::PresetPrint => session.take_preset(DisplayPreset::Print),
        C::Revert => session.revert(),
        C::Undo => session.undo(),
        C::Redo => session.redo(),
        C::Ghosts => session.change_onion_skin_settings(|ghosts| ghosts.shown = !ghosts.shown),
        C::BonePath => session.change_onion_skin_settings(|ghosts| ghosts.path = !ghosts.path),
        C::CompareSkinning => {
            let on = !matches!(session.compare_target(), Some(CompareTarget::Skinning));
            session.compare(on.then_some(CompareTarget::Skinning));
        }
        C::StopComparing => session.compare(None),
        C::Isolate => session.toggle_isolated(),
        C::Hide => session.hide_selected(),
        C::ShowAll => session.show_all(),
        C::BoneNames => session.set_bone_names(!session.bone_names()),
        C::Weights => session.set_weights(session.display().highlight.weights.is_none()),
        C::SmoothEdges => session.change_display(|display| {
            display.samples = if display.samples == Samples::Four { Samples::One } else { Samples::Four };
        }),
        // Every other command was done before it came here.
        _ => {}
    }
}

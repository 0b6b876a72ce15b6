//! What each command does, when it can be done, and what its switch shows.

use std::collections::HashMap;
use std::rc::Rc;

use gtk::prelude::*;
use gtk::{gio, glib};
use gtk4 as gtk;

use super::commands::Command;
use super::settings::{ColorScheme, SheetPage};
use super::window::Window;
use super::{about, appearance, compare_file, document_loader, export_dialog, help, save_session, saving, screenshot};
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
pub(super) fn connect(window: &Rc<Window>) {
    for (command, action) in window.actions() {
        let command = *command;
        action.connect_activate(glib::clone!(
            #[weak]
            window,
            move |_, _| perform(&window, command)
        ));
    }
}

/// Shows in the actions what is on and what can be done.
pub(super) fn show_states(window: &Rc<Window>, session: &Session, actions: &HashMap<Command, gio::SimpleAction>) {
    for (command, action) in actions {
        if let Some(on) = flag_state(*command, session).or_else(|| window_state(window, *command)) {
            action.set_state(&on.to_variant());
        }
        action.set_enabled(is_possible(window, *command, session));
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

fn window_state(window: &Rc<Window>, command: Command) -> Option<bool> {
    match command {
        Command::Tree => Some(window.shown_side_panels().0),
        Command::Panel => Some(window.shown_side_panels().1),
        Command::Fullscreen => Some(window.widget.is_fullscreen()),
        Command::FrameTimes => Some(window.settings.borrow().frame_times),
        Command::Sheet => Some(window.settings.borrow().sheet == SheetPage::Keys),
        Command::Curves => Some(window.settings.borrow().sheet == SheetPage::Curves),
        Command::SmoothCamera => Some(window.settings.borrow().smooth_camera),
        _ => color_scheme_of(command).map(|colours| window.settings.borrow().colours == colours),
    }
}

fn is_possible(window: &Rc<Window>, command: Command, session: &Session) -> bool {
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
        C::Reload | C::PreviousFile | C::NextFile => !session.files().is_empty() || window.files.can_retry(),
        C::SaveSession | C::Picture | C::PictureTransparent | C::CopyPicture | C::Export => !session.is_empty(),
        _ => true,
    }
}

/// Does it.
pub(super) fn perform(window: &Rc<Window>, command: Command) {
    use Command as C;
    if let Some(switch) = command.display_flag() {
        return window.update(|session| {
            session.change_display(|display| {
                let on = switch(display);
                *on = !*on;
            });
        });
    }
    if let Some(tool) = tool_of(command) {
        return window.update(|session| session.set_tool(tool));
    }
    if let Some(shading) = shading_of(command) {
        return window.update(|session| session.change_display(|display| display.shading = shading));
    }
    if let Some(colours) = color_scheme_of(command) {
        window.settings.borrow_mut().colours = colours;
        appearance::choose(colours);
        return window.show_states();
    }
    let look_from = |view: ViewDirection| window.update(|session| session.change_camera(|camera| camera.look_from(view)));
    match command {
        C::Open => document_loader::choose(window),
        C::CompareFile => compare_file::choose(window),
        C::Reload => document_loader::reload(window),
        C::Save => saving::save(window, || ()),
        C::SaveAs => saving::save_as(window),
        C::PreviousFile => document_loader::neighbour(window, -1),
        C::NextFile => document_loader::neighbour(window, 1),
        C::Close => document_loader::close(window),
        C::Quit => window.widget.close(),
        C::SaveSession => save_session::save(window),
        C::StartPage => window.start_page(true),
        C::Picture => screenshot::save(window, false),
        C::PictureTransparent => screenshot::save(window, true),
        C::CopyPicture => screenshot::copy(window),
        C::Export => export_dialog::show(window),
        C::Front => look_from(ViewDirection::Front),
        C::Back => look_from(ViewDirection::Back),
        C::Right => look_from(ViewDirection::Right),
        C::Left => look_from(ViewDirection::Left),
        C::Top => look_from(ViewDirection::Top),
        C::Bottom => look_from(ViewDirection::Bottom),
        C::Iso => look_from(ViewDirection::Iso),
        C::Sidebars => {
            let shown = window.shown_side_panels() != (false, false);
            window.show_side(!shown, !shown);
        }
        C::Tree => window.show_side(!window.shown_side_panels().0, window.shown_side_panels().1),
        C::Panel => window.show_side(window.shown_side_panels().0, !window.shown_side_panels().1),
        C::Fullscreen => {
            if window.widget.is_fullscreen() {
                window.widget.unfullscreen()
            } else {
                window.widget.fullscreen()
            }
            window.show_states();
        }
        C::FrameTimes => {
            let shown = !window.settings.borrow().frame_times;
            window.settings.borrow_mut().frame_times = shown;
            window.viewport.show_times(shown);
            window.show_states();
        }
        C::TimeCloser => window.change_visible_range(|track| track.zoom(1.5, track.time)),
        C::TimeWider => window.change_visible_range(|track| track.zoom(1.0 / 1.5, track.time)),
        C::TimeWhole => window.change_visible_range(|track| track.range = track.whole),
        C::Sheet => unfold(window, SheetPage::Keys),
        C::Curves => unfold(window, SheetPage::Curves),
        C::SmoothCamera => {
            let smooth = !window.settings.borrow().smooth_camera;
            window.settings.borrow_mut().smooth_camera = smooth;
            window.update(|session| session.set_eased(smooth && appearance::animates()));
            window.show_states();
        }
        C::Menu => window.menu.popup(),
        C::Help => help::show(window),
        C::Shortcuts => about::shortcuts(window),
        C::About => about::about(window),
        C::Fly => window.viewport.toggle_flight(window),
        C::NewMuscle | C::DuplicateMuscle | C::DeleteMuscle => window.change_muscles(command),
        in_session => window.update(|session| change_session(in_session, session)),
    }
}

/// Unfolds a page below the track, or folds it away where it is shown.
fn unfold(window: &Rc<Window>, page: SheetPage) {
    let shown = window.settings.borrow().sheet == page;
    window.settings.borrow_mut().sheet = if shown { SheetPage::None } else { page };
    window.show_sheet();
    window.show_states();
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

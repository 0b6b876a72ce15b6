//! What the commands of the session do, as the table of commands names it, and whether what they turn is on.

use crate::message;
use crate::muscle::AttachmentPoint;
use crate::render::Samples;
use crate::scene::ViewDirection;
use crate::session::{CompareTarget, PickTarget, Session, UndoStep};

/// Whether the clip plays.
pub(crate) fn is_playing(session: &Session) -> bool {
    session.playback().playing
}

/// Whether the clip plays backwards.
pub(crate) fn is_reversed(session: &Session) -> bool {
    session.playback().speed < 0.0
}

/// Plays in the other direction.
pub(crate) fn reverse(session: &mut Session) {
    session.time(|time| {
        time.speed = -time.speed;
        time.play();
    });
}

/// Plays so many times as fast.
pub(crate) fn change_speed(session: &mut Session, factor: f64) {
    let speed = session.playback().speed.abs();
    session.time(|time| time.set_speed(speed * factor));
}

/// Goes on by so many seconds.
pub(crate) fn seek_by(session: &mut Session, seconds: f64) {
    session.time(|time| time.seek(time.time + seconds));
}

/// Goes to the first moment.
pub(crate) fn seek_start(session: &mut Session) {
    session.time(|time| time.seek(time.start));
}

/// Goes to the last moment.
pub(crate) fn seek_end(session: &mut Session) {
    session.time(|time| time.seek(time.end));
}

/// Marks the present moment as A; a mark B that lies before it goes.
pub(crate) fn mark_a(session: &mut Session) {
    session.time(|time| (time.mark_a, time.mark_b) = (Some(time.time), time.mark_b.filter(|b| *b > time.time)));
}

/// Marks the present moment as B; a mark A that lies behind it goes.
pub(crate) fn mark_b(session: &mut Session) {
    session.time(|time| (time.mark_a, time.mark_b) = (time.mark_a.filter(|a| *a < time.time), Some(time.time)));
}

/// Takes both marks away.
pub(crate) fn clear_marks(session: &mut Session) {
    session.time(|time| (time.mark_a, time.mark_b) = (None, None));
}

/// Centres the camera on the selection.
pub(crate) fn centre(session: &mut Session) {
    if let Some(node) = session.selected() {
        session.centre_on(node);
    }
}

/// Looks from the lower left behind.
pub(crate) fn look_from_below(session: &mut Session) {
    session.change_camera(|camera| {
        camera.animate_to(|orbit| {
            let (yaw, pitch) = ViewDirection::Iso.angles();
            (orbit.yaw, orbit.pitch) = (yaw + 180.0, -pitch);
        });
    });
}

/// Whether rays are parallel.
pub(crate) fn is_orthographic(session: &Session) -> bool {
    session.camera_controller().orbit().orthographic
}

/// Parallel rays, or those of an eye.
pub(crate) fn toggle_orthographic(session: &mut Session) {
    session.change_camera(|camera| camera.animate_to(|orbit| orbit.orthographic = !orbit.orthographic));
}

/// Puts the model back to where the file has it.
pub(crate) fn reset_model(session: &mut Session) {
    session.undoable(message!("app-edit-reset-model"), UndoStep::New, |session| session.change_model(|model| model.reset()));
}

/// Contracts the muscle by so many per cent more.
pub(crate) fn contract(session: &mut Session, per_cent: f64) {
    if let Some(contraction) = session.contraction() {
        session.set_contraction_undoable(contraction + per_cent);
    }
}

/// Bends the elbow, or the joint in its place, by so many degrees more.
pub(crate) fn bend(session: &mut Session, degrees: f64) {
    if let Some(slider) = session.angle_slider() {
        session.set_angle_undoable(slider.value + degrees);
    }
}

/// Lets a click give an end of the muscle that is shown its place: 0 = origin, 1 = insertion.
pub(crate) fn pick_end(session: &mut Session, end: usize) {
    session.start_picking(session.shown_muscle(), PickTarget::Point(AttachmentPoint::End(end)));
}

/// Whether edges are smoothed.
pub(crate) fn is_antialiased(session: &Session) -> bool {
    session.display().samples == Samples::Four
}

/// Smooths edges, or does not.
pub(crate) fn toggle_antialiasing(session: &mut Session) {
    session.change_display(|display| display.samples = if display.samples == Samples::Four { Samples::One } else { Samples::Four });
}

/// Whether the weights of a bone are shown.
pub(crate) fn shows_weights(session: &Session) -> bool {
    session.display().highlight.weights.is_some()
}

/// Whether onion skins are shown.
pub(crate) fn shows_onion_skins(session: &Session) -> bool {
    session.onion_skin_settings().shown
}

/// Shows or hides onion skins.
pub(crate) fn toggle_onion_skins(session: &mut Session) {
    session.change_onion_skin_settings(|settings| settings.shown = !settings.shown);
}

/// Whether the motion path of the selection is shown.
pub(crate) fn shows_motion_path(session: &Session) -> bool {
    session.onion_skin_settings().path
}

/// Shows or hides the motion path of the selection.
pub(crate) fn toggle_motion_path(session: &mut Session) {
    session.change_onion_skin_settings(|settings| settings.path = !settings.path);
}

/// Whether the camera follows something.
pub(crate) fn is_following(session: &Session) -> bool {
    session.followed().is_some()
}

/// Whether both ways to bend a skin are compared.
pub(crate) fn compares_skinning(session: &Session) -> bool {
    matches!(session.compare_target(), Some(CompareTarget::Skinning))
}

/// Compares both ways to bend a skin, or no longer.
pub(crate) fn toggle_skinning_comparison(session: &mut Session) {
    let on = !compares_skinning(session);
    session.compare(on.then_some(CompareTarget::Skinning));
}

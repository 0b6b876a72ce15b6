//! When commands are possible, as the table of commands names it.

use crate::session::Session;

/// What the possibility of a command depends on.
pub(crate) struct Conditions<'a> {
    /// The session.
    pub session: &'a Session,
    /// Whether there is a file that could not be opened.
    pub can_retry: bool,
    /// Whether the desktop wants animation.
    pub animates: bool,
}

/// Something is open.
pub(crate) fn is_open(conditions: &Conditions) -> bool {
    !conditions.session.is_empty()
}

/// There are files to read again, or to go on from.
pub(crate) fn has_files(conditions: &Conditions) -> bool {
    !conditions.session.files().is_empty() || conditions.can_retry
}

/// There are muscles.
pub(crate) fn has_muscles(conditions: &Conditions) -> bool {
    conditions.session.document().muscle_count() > 0
}

/// Muscles were changed since they were saved.
pub(crate) fn is_unsaved(conditions: &Conditions) -> bool {
    conditions.session.is_unsaved()
}

/// There is a clip that takes time.
pub(crate) fn has_time(conditions: &Conditions) -> bool {
    conditions.session.playback().duration() > 0.0
}

/// There is a mark on the track.
pub(crate) fn has_marks(conditions: &Conditions) -> bool {
    let playback = conditions.session.playback();
    playback.mark_a.is_some() || playback.mark_b.is_some()
}

/// There are several clips.
pub(crate) fn has_clips(conditions: &Conditions) -> bool {
    conditions.session.document().clips.len() > 1
}

/// The desktop wants animation; where it does not there is none, whatever is chosen here.
pub(crate) fn animates(conditions: &Conditions) -> bool {
    conditions.animates
}

/// A node is selected.
pub(crate) fn has_selection(conditions: &Conditions) -> bool {
    conditions.session.selected().is_some()
}

/// There is a selection to isolate, or one is isolated.
pub(crate) fn can_isolate(conditions: &Conditions) -> bool {
    has_selection(conditions) || conditions.session.is_isolated()
}

/// Something is hidden.
pub(crate) fn hides_something(conditions: &Conditions) -> bool {
    conditions.session.hides_something()
}

/// There is time for onion skins, or they are shown.
pub(crate) fn can_show_onion_skins(conditions: &Conditions) -> bool {
    has_time(conditions) || conditions.session.onion_skin_settings().shown
}

/// There is time for a motion path, or it is shown.
pub(crate) fn can_show_motion_path(conditions: &Conditions) -> bool {
    has_time(conditions) || conditions.session.onion_skin_settings().path
}

/// There is something to follow, or it is followed.
pub(crate) fn can_follow(conditions: &Conditions) -> bool {
    conditions.session.can_follow() || conditions.session.followed().is_some()
}

/// Something is compared.
pub(crate) fn is_comparing(conditions: &Conditions) -> bool {
    conditions.session.compare_target().is_some()
}

/// There is a skin whose two ways of bending can be compared, or something is compared.
pub(crate) fn can_compare_skinning(conditions: &Conditions) -> bool {
    conditions.session.has_skins() || is_comparing(conditions)
}

/// There is an arm or a joint to bend.
pub(crate) fn can_bend(conditions: &Conditions) -> bool {
    conditions.session.bends_arm() || conditions.session.joint().is_some()
}

/// There are bones that the muscle that is shown can be attached to.
pub(crate) fn has_bones(conditions: &Conditions) -> bool {
    !conditions.session.bones_for(conditions.session.shown_muscle()).is_empty()
}

/// There is a skin in the picture.
pub(crate) fn has_skins(conditions: &Conditions) -> bool {
    conditions.session.posed().surfaces.iter().any(|surface| surface.skin)
}

/// A skin lies round a muscle on bones.
pub(crate) fn has_muscles_under_skin(conditions: &Conditions) -> bool {
    conditions.session.document().has_muscles_under_skin()
}

/// A bone is selected, or weights are shown.
pub(crate) fn can_show_weights(conditions: &Conditions) -> bool {
    let session = conditions.session;
    session.selected().is_some_and(|node| session.is_bone(node)) || session.display().highlight.weights.is_some()
}

/// The light was moved.
pub(crate) fn has_own_light(conditions: &Conditions) -> bool {
    conditions.session.light().is_some()
}

/// The model was moved.
pub(crate) fn is_model_moved(conditions: &Conditions) -> bool {
    !conditions.session.model().is_identity()
}

/// There is something to undo.
pub(crate) fn can_undo(conditions: &Conditions) -> bool {
    conditions.session.undo_counts().0
}

/// There is something to redo.
pub(crate) fn can_redo(conditions: &Conditions) -> bool {
    conditions.session.undo_counts().1
}

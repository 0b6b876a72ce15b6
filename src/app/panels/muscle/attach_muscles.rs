//! Puts muscles on the skeleton of a clip and says what was done: those that are on an arm of their own, whole sets, and those of one side on the other.

use crate::app::handles::session_handle::SessionHandle;
use crate::app::notices::toasts::Toasts;
use crate::i18n::Sentence;
use crate::message;
use crate::muscle::sets::{MuscleSet, Sides};
use crate::session::{AttachResult, AttachSetError};

/// Hangs the muscles of all files; whether there were any to hang.
pub(crate) fn attach_all(session: &SessionHandle, toasts: &Toasts) -> bool {
    let files = session.read(|session| session.document().muscle_files().count());
    attach(session, toasts, 0..files)
}

/// Hangs the muscles of these files; whether there were any to hang.
pub(crate) fn attach(session: &SessionHandle, toasts: &Toasts, files: impl IntoIterator<Item = usize>) -> bool {
    let mut hung: Option<AttachResult> = None;
    session.update(|session| {
        for new in files.into_iter().filter_map(|place| session.attach_to_skeleton(place)) {
            let before = hung.take().map_or(0, |hung| hung.muscles);
            hung = Some(AttachResult { muscles: before + new.muscles, ..new });
        }
    });
    let told = hung.map(|AttachResult { muscles, joint }| message!("app-attached", count = muscles, joint = joint).sentence());
    if let Some(told) = &told {
        toasts.toast(told, None);
    }
    told.is_some()
}

/// Puts a set of muscles on both sides of the figure of the clip.
pub(crate) fn attach_set(session: &SessionHandle, toasts: &Toasts, set: MuscleSet) {
    let mut result = Ok(0);
    session.update(|session| result = session.attach_set(set, Sides::Both));
    tell(toasts, result.map(|count| message!("app-set-attached", count = count).sentence()));
}

/// Copies the muscle that is shown to the other side of its figure.
pub(crate) fn mirror(session: &SessionHandle, toasts: &Toasts) {
    let mut result = Ok(());
    session.update(|session| result = session.mirror_muscle(session.shown_muscle()));
    if result.is_err() {
        tell(toasts, result.map(|()| String::new()));
    }
}

fn tell(toasts: &Toasts, result: Result<String, AttachSetError>) {
    toasts.toast(&result.unwrap_or_else(|error| error.sentence()), None);
}

//! Hangs muscles that are on an arm of their own on the skeleton of the clip that is open with them, and says where they went.

use crate::app::handles::session_handle::SessionHandle;
use crate::app::notices::toasts::Toasts;
use crate::i18n::Sentence;
use crate::message;
use crate::session::AttachResult;

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

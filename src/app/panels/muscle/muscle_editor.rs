//! Edits of muscles for the widgets of the muscle panel; a refused edit shows its reason beside the widget.

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use gtk::prelude::*;
use gtk4 as gtk;

use crate::app::handles::session_handle::{SessionHandle, WeakSession};
use crate::app::widgets::ui;
use crate::i18n::{self, Sentence, shown};
use crate::muscle::{Edit, EditError, MuscleFile, MuscleSpec};
use crate::scene::MuscleId;
use crate::session::{Session, UndoStep};

/// Changes the muscle that is shown.
#[derive(Clone)]
pub(crate) struct Editor {
    session: WeakSession,
    /// The muscle that is shown.
    shown: Rc<Cell<u32>>,
    /// Where the reason for a rejected change is shown.
    refused: gtk::Label,
}

impl Editor {
    /// The editor of a panel: `shown` is the muscle that it shows, `refused` is where it gives the reason for a rejected change.
    pub(crate) fn new(session: &SessionHandle, shown: &Rc<Cell<u32>>, refused: &gtk::Label) -> Self {
        Self { session: session.downgrade(), shown: shown.clone(), refused: refused.clone() }
    }

    /// The same editor with another place for its reasons.
    pub(crate) fn refusing_in(&self, refused: gtk::Label) -> Self {
        Self { refused, ..self.clone() }
    }

    /// The muscle that is shown.
    pub(crate) fn id(&self) -> MuscleId {
        MuscleId(self.shown.get())
    }

    /// Makes a change; whether it was made.
    pub(crate) fn edit(&self, edit: &Edit, step: UndoStep) -> bool {
        let id = self.id();
        self.tell(|session| session.edit_muscle(id, edit, step))
    }

    /// Does something to the session that may be refused; whether it was done.
    pub(crate) fn tell(&self, change: impl FnOnce(&mut Session) -> Result<(), EditError>) -> bool {
        let Some(session) = self.session.upgrade() else { return false };
        let mut result = Ok(());
        session.update(|session| result = change(session));
        self.refused.set_visible(result.is_err());
        if let Err(error) = &result {
            ui::set_label(&self.refused, &error.sentence());
        }
        result.is_ok()
    }

    /// What the muscle shown says; `None` while another document is being shown: an entry that goes away then still wants what was typed to be taken.
    pub(crate) fn spec(&self) -> Option<MuscleSpec> {
        let id = self.id();
        let spec = |session: &mut Session| {
            let (rig, index) = session.document().muscle(id)?;
            rig.spec(index).cloned()
        };
        self.session.upgrade()?.try_read(spec)?
    }

    /// The file that the muscle shown is in; `None` as above.
    pub(crate) fn file(&self) -> Option<MuscleFile> {
        let id = self.id();
        let file = |session: &mut Session| {
            let document = session.document();
            document.muscle_files().nth(document.file_of_muscle(id)?.0).cloned()
        };
        self.session.upgrade()?.try_read(file)?
    }

    /// What the muscle shown is called; `None` as above.
    pub(crate) fn name(&self) -> Option<String> {
        let id = self.id();
        let name = |session: &mut Session| {
            let (rig, index) = session.document().muscle(id)?;
            Some(i18n::label(rig.label(index)).into_owned())
        };
        self.session.upgrade()?.try_read(name)?
    }
}

/// Marks an entry whose text a person changed since it was shown.
const TYPED: &str = "typed";

/// Commits the text of an entry with Enter and when it loses the focus. `take` marks rejected text with the class `error`.
pub(crate) fn connect_entry(entry: &gtk::Entry, take: impl Fn(&gtk::Entry) + 'static) {
    let commit = Rc::new(move |entry: &gtk::Entry| {
        take(entry);
        if !entry.has_css_class("error") {
            entry.remove_css_class(TYPED);
        }
    });
    entry.connect_changed(|entry| entry.add_css_class(TYPED));
    let own = commit.clone();
    entry.connect_activate(move |entry| own(entry));
    let (focus, left) = (gtk::EventControllerFocus::new(), entry.downgrade());
    focus.connect_leave(move |_| {
        if let Some(entry) = left.upgrade().filter(|entry| entry.has_css_class(TYPED)) {
            commit(&entry);
        }
    });
    entry.add_controller(focus);
}

thread_local! {
    /// What the entry that has the keyboard said when that came to it.
    static SHOWN: RefCell<String> = RefCell::default();
}

/// Remembers what an entry says, now that the keyboard comes to it.
pub(crate) fn remember_shown(text: &gtk::Text) {
    SHOWN.set(text.text().into());
}

/// Lets the entry that has the keyboard say again what it said when that came to it.
pub(crate) fn show_as_before(entry: &gtk::Entry) {
    entry.set_text(&SHOWN.with_borrow(String::clone));
    entry.remove_css_class(TYPED);
    entry.remove_css_class("error");
}

/// Shows a text in an entry. Text that is being edited stays while something else changes, and so does rejected text, unless `anew`.
pub(crate) fn show_text(entry: &gtk::Entry, text: &str, anew: bool) {
    let typing = entry.has_css_class(TYPED) && entry.state_flags().contains(gtk::StateFlags::FOCUS_WITHIN);
    let text = &*shown(text);
    if entry.text() != text && (anew || !entry.has_css_class("error")) && !typing {
        entry.set_text(text);
        entry.remove_css_class(TYPED);
        entry.remove_css_class("error");
    }
}

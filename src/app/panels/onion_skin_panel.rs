//! The part of the display panel for onion skins, motion paths and comparisons.

use std::path::Path;

use gtk::glib;
use gtk::prelude::*;
use gtk4 as gtk;

use crate::app::format;
use crate::app::handles::session_handle::SessionHandle;
use crate::app::widgets::ui;
use crate::i18n;
use crate::session::{ChangeSet, CompareTarget, ComparisonState, Session};
use crate::tr;

ui::widgets! {
    /// The widgets of the panel.
    struct OnionSkinWidgets from "onion_skin_panel.ui" {
        root: gtk::Box,
        before: gtk::SpinButton,
        after: gtk::SpinButton,
        step: gtk::SpinButton,
        with: gtk::DropDown,
        shifts: gtk::Grid,
        aside: gtk::SpinButton,
        later: gtk::SpinButton,
        found: gtk::Label,
    }
}

/// Panel of onion skins and comparison.
pub(crate) struct OnionSkinPanel {
    /// The whole.
    pub root: gtk::Box,
    widgets: OnionSkinWidgets,
}

impl OnionSkinPanel {
    /// The panel of a session.
    pub(crate) fn new(session: &SessionHandle) -> Self {
        let widgets = OnionSkinWidgets::build();
        ui::narrow(&widgets.with, 18);
        let panel = Self { root: widgets.root.clone(), widgets };
        panel.connect(session);
        panel
    }

    /// Connects the input of the widgets.
    fn connect(&self, session: &SessionHandle) {
        for number in [&self.widgets.before, &self.widgets.after, &self.widgets.step] {
            let [before, after, step] = [&self.widgets.before, &self.widgets.after, &self.widgets.step].map(gtk::SpinButton::clone);
            number.connect_value_changed(glib::clone!(
                #[weak]
                session,
                move |_| {
                    let [before, after, step] = [&before, &after, &step].map(|number| number.value_as_int().max(0) as u32);
                    session.update(|session| {
                        session.change_onion_skin_settings(|onion_skins| {
                            (onion_skins.before, onion_skins.after, onion_skins.step) = (before, after, step)
                        });
                    });
                }
            ));
        }
        for number in [&self.widgets.aside, &self.widgets.later] {
            let (aside, later) = (self.widgets.aside.clone(), self.widgets.later.clone());
            number.connect_value_changed(glib::clone!(
                #[weak]
                session,
                move |_| session.update(|session| session.set_compare_offsets(later.value(), aside.value()))
            ));
        }
        self.widgets.with.connect_selected_notify(glib::clone!(
            #[weak]
            session,
            move |list| {
                let chosen = list.selected();
                session.update(|session| choose(session, chosen));
            }
        ));
    }

    /// Shows what changed.
    pub(crate) fn refresh(&self, session: &mut Session, changes: ChangeSet) {
        if changes.any(ChangeSet::OVERLAYS) {
            let onion_skins = session.onion_skin_settings();
            self.widgets.before.set_value(onion_skins.before.into());
            self.widgets.after.set_value(onion_skins.after.into());
            self.widgets.step.set_value(onion_skins.step.into());
        }
        if changes.any(ChangeSet::OVERLAYS | ChangeSet::DOCUMENT) {
            self.list(session);
        }
        if changes.any(ChangeSet::OVERLAYS | ChangeSet::PICTURE) {
            let compared = session.compared();
            self.widgets.shifts.set_visible(compared.is_some());
            self.widgets.found.set_visible(compared.is_some());
            if let Some(compared) = compared {
                self.widgets.aside.set_value(compared.offset);
                self.widgets.later.set_value(compared.time_offset);
                self.widgets.found.set_text(&difference(session, &compared));
            }
        }
    }

    /// What can be compared with: nothing, the clips, the other file that is there, the other way to bend a skin.
    fn list(&self, session: &Session) {
        let mut words = vec![tr!("app-compare-nothing")];
        words.extend(session.document().clips.iter().map(|clip| tr!("app-compare-clip", name = i18n::label(clip.label()))));
        let (other, chosen) = match session.compare_target() {
            None => (None, 0),
            Some(CompareTarget::Clip(clip)) => (None, *clip + 1),
            Some(CompareTarget::File(_, name)) => (Some(file_name(name)), words.len()),
            Some(CompareTarget::Skinning) => (Some(tr!("app-compare-skinning")), words.len()),
        };
        words.extend(other);
        let listed = self.widgets.with.model().and_downcast::<gtk::StringList>();
        let same = listed.is_some_and(|list| {
            list.n_items() as usize == words.len()
                && words.iter().enumerate().all(|(i, word)| list.string(i as u32).as_deref() == Some(word))
        });
        if !same {
            self.widgets.with.set_model(Some(&ui::words(&words)));
        }
        self.widgets.with.set_selected(chosen as u32);
    }
}

/// The name of a file without its folder.
pub(crate) fn file_name(path: &str) -> String {
    Path::new(path).file_name().map_or_else(|| path.to_owned(), |name| name.to_string_lossy().into_owned())
}

fn choose(session: &mut Session, place: u32) {
    let clips = session.document().clips.len();
    match (place as usize).checked_sub(1) {
        None => session.compare(None),
        Some(clip) if clip < clips => session.compare(Some(CompareTarget::Clip(clip))),
        // The last row is what is being compared with already.
        Some(_) => {}
    }
}

/// How far the two are apart, in one line.
pub(crate) fn difference(session: &Session, compared: &ComparisonState) -> String {
    match compared.farthest {
        None => tr!("app-compare-nothing-common"),
        Some((Some(joint), far)) => {
            let name = i18n::label(session.document().scene.graph.label(joint));
            tr!("app-compare-joint", name = name, distance = format::number(far, 4))
        }
        Some((None, far)) => tr!("app-compare-vertex", distance = format::number(far, 4)),
    }
}

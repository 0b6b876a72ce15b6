//! Banners over the viewport and the timeline for a joint that is held while the clip plays, with a button that releases it.

use gtk::glib;
use gtk::prelude::*;
use gtk4 as gtk;

use super::picture_focus::PictureFocus;
use super::session_handle::SessionHandle;
use super::ui::{self, object};
use crate::i18n::Sentence;
use crate::session::Session;

/// A few words and a button.
pub(super) struct HeldJointBanner {
    /// Both; hidden while no joint is held.
    pub root: gtk::Box,
    label: gtk::Label,
    release: gtk::Button,
}

impl HeldJointBanner {
    /// Hidden until a joint is held.
    pub(super) fn new(session: &SessionHandle, focus: &PictureFocus) -> Self {
        let builder = ui::builder(ui::HELD);
        let banner = Self { root: object(&builder, "root"), label: object(&builder, "label"), release: object(&builder, "release") };
        banner.connect(session, focus);
        banner
    }

    /// Lets the button release the joint.
    fn connect(&self, session: &SessionHandle, focus: &PictureFocus) {
        self.release.connect_clicked(glib::clone!(
            #[weak]
            session,
            #[strong]
            focus,
            move |_| {
                // Else the keyboard goes from the button that is hidden to the next widget.
                focus.take();
                session.update(Session::release_undoable);
            }
        ));
    }

    /// Says what is held.
    pub(super) fn refresh(&self, session: &mut Session) {
        let told = session.held_joint_text();
        self.root.set_visible(told.is_some());
        self.label.set_text(&told.map(|told| told.sentence()).unwrap_or_default());
    }
}

//! Banners over the viewport and the timeline for a joint that is held while the clip plays, with a button that releases it.

use gtk::glib;
use gtk::prelude::*;
use gtk4 as gtk;

use crate::app::handles::picture_focus::PictureFocus;
use crate::app::handles::session_handle::SessionHandle;
use crate::app::widgets::ui;
use crate::i18n::Sentence;
use crate::session::Session;

ui::widgets! {
    /// The widgets of the banner.
    struct BannerWidgets from "held_joint_banner.ui" {
        root: gtk::Box,
        label: gtk::Label,
        release: gtk::Button,
    }
}

/// A few words and a button.
pub(crate) struct HeldJointBanner {
    /// Both; hidden while no joint is held.
    pub root: gtk::Box,
    widgets: BannerWidgets,
}

impl HeldJointBanner {
    /// Hidden until a joint is held.
    pub(crate) fn new(session: &SessionHandle, focus: &PictureFocus) -> Self {
        let widgets = BannerWidgets::build();
        let banner = Self { root: widgets.root.clone(), widgets };
        banner.connect(session, focus);
        banner
    }

    /// Lets the button release the joint.
    fn connect(&self, session: &SessionHandle, focus: &PictureFocus) {
        self.widgets.release.connect_clicked(glib::clone!(
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
    pub(crate) fn refresh(&self, session: &mut Session) {
        let told = session.held_joint_text();
        self.root.set_visible(told.is_some());
        self.widgets.label.set_text(&told.map(|told| told.sentence()).unwrap_or_default());
    }
}

//! Notices over the picture that go away by themselves.

use std::cell::{Cell, RefCell};
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::time::Duration;

use gtk::prelude::*;
use gtk::{gio, glib};
use gtk4 as gtk;

use crate::app::widgets::ui;
use crate::tr;

/// How long a notice stays.
const SHOWN: Duration = Duration::from_secs(6);

/// The notices of a window.
#[derive(Clone)]
pub(crate) struct Toasts(Rc<Notice>);

ui::widgets! {
    /// The widgets of the notice.
    struct ToastWidgets in "../viewport/viewport.ui" {
        toast: gtk::Revealer,
        toast_label: gtk::Label,
        toast_folder: gtk::Button,
    }
}

/// The widgets of the notice, and what it is about.
struct Notice {
    widgets: ToastWidgets,
    /// Counts the notices, so that only the last one's time ends it.
    number: Rc<Cell<u32>>,
    /// The file that was written.
    file: RefCell<Option<PathBuf>>,
    /// Whether the notice is about the program, not about what is open.
    stays: Cell<bool>,
}

impl Toasts {
    /// Those of the viewport's `.ui` file.
    pub(crate) fn new(builder: &gtk::Builder) -> Self {
        let notice =
            Rc::new(Notice { widgets: ToastWidgets::of(builder), number: Rc::default(), file: RefCell::default(), stays: Cell::default() });
        let weak = Rc::downgrade(&notice);
        notice.widgets.toast_folder.connect_clicked(move |button| {
            if let Some(notice) = weak.upgrade() {
                Self(notice).open_folder(button);
            }
        });
        Self(notice)
    }

    /// Says something in passing; with the file that was written, offers its folder.
    pub(crate) fn toast(&self, text: &str, file: Option<PathBuf>) {
        let notice = &self.0;
        ui::set_label(&notice.widgets.toast_label, text);
        notice.widgets.toast_folder.set_visible(file.is_some());
        notice.file.replace(file);
        notice.stays.set(false);
        notice.widgets.toast.set_can_target(true);
        notice.widgets.toast.set_reveal_child(true);
        let (number, numbers, revealer) = (notice.number.get().wrapping_add(1), notice.number.clone(), notice.widgets.toast.clone());
        numbers.set(number);
        glib::timeout_add_local_once(SHOWN, move || {
            if numbers.get() == number {
                fold(&revealer);
            }
        });
    }

    /// Says something in passing that is about the program, whatever is open.
    pub(crate) fn notice(&self, text: &str) {
        self.toast(text, None);
        self.0.stays.set(true);
    }

    /// Hides notices about documents that are no longer open.
    pub(crate) fn hide_notice(&self) {
        if !self.0.stays.get() {
            self.0.number.set(self.0.number.get().wrapping_add(1));
            self.0.widgets.toast_label.set_text("");
            fold(&self.0.widgets.toast);
        }
    }

    /// Shows the folder of the file that was written.
    fn open_folder(self, button: &gtk::Button) {
        let file = self.0.file.borrow().as_deref().and_then(|file| std::path::absolute(file).ok());
        let Some(folder) = file.as_deref().and_then(Path::parent) else { return };
        let (uri, weak) = (gio::File::for_path(folder).uri(), Rc::downgrade(&self.0));
        let context = button.display().app_launch_context();
        gio::AppInfo::launch_default_for_uri_async(&uri, Some(&context), gio::Cancellable::NONE, move |shown| {
            if let (Err(error), Some(notice)) = (shown, weak.upgrade()) {
                Self(notice).toast(&tr!("app-folder-failed", reason = error.message().to_owned()), None);
            }
        });
    }
}

/// Folds a notice away; what lies under it takes clicks again.
fn fold(revealer: &gtk::Revealer) {
    revealer.set_reveal_child(false);
    revealer.set_can_target(false);
}

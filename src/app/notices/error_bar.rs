//! Error bar: a file that could not be read, the reason and the place in it.

use std::cell::RefCell;
use std::path::PathBuf;
use std::rc::Rc;

use gtk::glib;
use gtk::prelude::*;
use gtk4 as gtk;

use crate::app::widgets::ui;
use crate::session::LoadMode;

ui::widgets! {
    /// The widgets of the bar.
    struct ErrorBarWidgets from "error_bar.ui" {
        root: gtk::InfoBar,
        headline: gtk::Label,
        message: gtk::Label,
        details: gtk::Label,
        more: gtk::ToggleButton,
        retry: gtk::Button,
        close: gtk::Button,
    }
}

/// The bar.
pub(crate) struct ErrorBar {
    /// The whole.
    pub root: gtk::InfoBar,
    widgets: ErrorBarWidgets,
    again: RefCell<Option<(Vec<PathBuf>, LoadMode)>>,
}

/// What went wrong.
pub(crate) struct ErrorMessage {
    /// One line: what could not be done.
    pub headline: String,
    /// Why, and where.
    pub message: String,
    /// Everything known, for a report.
    pub details: String,
    /// What Retry opens.
    pub again: Option<(Vec<PathBuf>, LoadMode)>,
}

impl ErrorBar {
    /// A folded bar.
    pub(crate) fn new() -> Rc<Self> {
        let widgets = ErrorBarWidgets::build();
        let bar = Rc::new(Self { root: widgets.root.clone(), widgets, again: RefCell::new(None) });
        bar.root.connect_response(glib::clone!(
            #[weak]
            bar,
            move |_, _| bar.hide()
        ));
        bar.widgets.close.connect_clicked(glib::clone!(
            #[weak]
            bar,
            move |_| bar.hide()
        ));
        bar.root.set_visible(false);
        bar.widgets.more.connect_toggled(glib::clone!(
            #[weak(rename_to = details)]
            bar.widgets.details,
            move |more| details.set_visible(more.is_active())
        ));
        bar
    }

    /// Calls `retry` with the files that could not be opened when they are to be opened once more.
    pub(crate) fn connect_retry(self: &Rc<Self>, retry: impl Fn(Vec<PathBuf>, LoadMode) + 'static) {
        self.widgets.retry.connect_clicked(glib::clone!(
            #[weak(rename_to = bar)]
            self,
            move |_| {
                let again = bar.again.borrow().clone();
                if let Some((paths, load_mode)) = again {
                    retry(paths, load_mode);
                }
            }
        ));
    }

    /// Shows what went wrong, until it is closed or something opens.
    pub(crate) fn show(&self, trouble: ErrorMessage) {
        ui::set_label(&self.widgets.headline, &trouble.headline);
        ui::set_label(&self.widgets.message, &trouble.message);
        ui::set_label(&self.widgets.details, &trouble.details);
        self.widgets.more.set_active(false);
        self.widgets.more.set_visible(!trouble.details.is_empty());
        self.widgets.retry.set_visible(trouble.again.is_some());
        self.again.replace(trouble.again);
        self.root.set_visible(true);
        self.root.set_revealed(true);
    }

    /// Folds it away.
    pub(crate) fn hide(&self) {
        self.root.set_revealed(false);
        self.root.set_visible(false);
        self.again.replace(None);
    }
}

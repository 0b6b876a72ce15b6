//! The bar over the picture that shows how far reading is, with a button that stops it.

use gtk::prelude::*;
use gtk4 as gtk;

use crate::app::widgets::ui;

ui::widgets! {
    /// The widgets of the bar.
    struct LoadingWidgets in "../viewport/viewport.ui" {
        loading: gtk::Box,
        loading_label: gtk::Label,
        loading_bar: gtk::ProgressBar,
        loading_cancel: gtk::Button,
    }
}

/// The bar.
pub(crate) struct LoadingBar {
    widgets: LoadingWidgets,
}

impl LoadingBar {
    /// That of the viewport's `.ui` file.
    pub(crate) fn new(builder: &gtk::Builder) -> Self {
        Self { widgets: LoadingWidgets::of(builder) }
    }

    /// The button that stops reading.
    pub(crate) fn cancel_button(&self) -> &gtk::Button {
        &self.widgets.loading_cancel
    }

    /// Shows how far reading is: 0 to 1, or 0 while that is unknown.
    pub(crate) fn show(&self, text: &str, part_done: f64) {
        self.widgets.loading.set_visible(true);
        ui::set_label(&self.widgets.loading_label, text);
        if part_done > 0.0 { self.widgets.loading_bar.set_fraction(part_done.min(1.0)) } else { self.widgets.loading_bar.pulse() }
    }

    /// Nothing is being read.
    pub(crate) fn hide(&self) {
        self.widgets.loading.set_visible(false);
    }
}

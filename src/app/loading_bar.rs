//! The bar over the picture that shows how far reading is, with a button that stops it.

use gtk::prelude::*;
use gtk4 as gtk;

use super::ui::{self, object};

/// The bar.
#[derive(Clone)]
pub(super) struct LoadingBar {
    root: gtk::Box,
    label: gtk::Label,
    bar: gtk::ProgressBar,
    /// The button that stops reading.
    pub cancel: gtk::Button,
}

impl LoadingBar {
    /// That of the viewport's `.ui` file.
    pub(super) fn new(builder: &gtk::Builder) -> Self {
        Self {
            root: object(builder, "loading"),
            label: object(builder, "loading_label"),
            bar: object(builder, "loading_bar"),
            cancel: object(builder, "loading_cancel"),
        }
    }

    /// Shows how far reading is: 0 to 1, or 0 while that is unknown.
    pub(super) fn show(&self, text: &str, part_done: f64) {
        self.root.set_visible(true);
        ui::set_label(&self.label, text);
        if part_done > 0.0 { self.bar.set_fraction(part_done.min(1.0)) } else { self.bar.pulse() }
    }

    /// Nothing is being read.
    pub(super) fn hide(&self) {
        self.root.set_visible(false);
    }
}

//! Side panels: their widths, and which one is hidden where the window has no room for both.

use std::cell::Cell;

use gtk::gdk;
use gtk::prelude::*;
use gtk4 as gtk;

use crate::app::widgets::ui;

/// Below this width of the window there is room for one side panel only: the tree with the inspector, or the right one.
const ROOM_FOR_BOTH: i32 = 1000;

ui::widgets! {
    /// The boxes at the sides.
    struct SideWidgets in "main_window.ui" {
        tree_slot: gtk::Box,
        panel_slot: gtk::Box,
    }
}

/// Both sides.
pub(crate) struct SidePanels {
    widgets: SideWidgets,
    /// The tree was folded for lack of room, not by the user.
    tree_gave_way: Cell<bool>,
    /// The right panel was folded for lack of room, not by the user.
    panel_gave_way: Cell<bool>,
}

impl SidePanels {
    /// Those of a window.
    pub(crate) fn new(builder: &gtk::Builder) -> Self {
        Self { widgets: SideWidgets::of(builder), tree_gave_way: Cell::new(false), panel_gave_way: Cell::new(false) }
    }

    /// Whether the tree and the right panel are shown.
    pub(crate) fn shown(&self) -> (bool, bool) {
        (self.widgets.tree_slot.is_visible(), self.widgets.panel_slot.is_visible())
    }

    /// Whether the tree and the right panel would be shown if there were room.
    pub(crate) fn wanted(&self) -> (bool, bool) {
        let (tree, panel) = self.shown();
        (tree || self.tree_gave_way.get(), panel || self.panel_gave_way.get())
    }

    /// Shows or folds away both. Where there is no room for both, the one that comes takes the other's place.
    pub(crate) fn show(&self, window: &gtk::ApplicationWindow, mut tree: bool, mut panel: bool) {
        self.tree_gave_way.set(false);
        self.panel_gave_way.set(false);
        if tree && panel && window.is_visible() && is_narrow(window) {
            if self.widgets.tree_slot.is_visible() {
                tree = false;
            } else {
                panel = false;
            }
            self.tree_gave_way.set(!tree);
            self.panel_gave_way.set(!panel);
        }
        self.widgets.tree_slot.set_visible(tree);
        self.widgets.panel_slot.set_visible(panel);
    }

    /// Folds the tree away in a window that has become too narrow for both, and brings back what gave way when it is wide again; whether it did either.
    pub(crate) fn follow(&self, window: &gtk::ApplicationWindow) -> bool {
        let ((tree, panel), narrow) = (self.shown(), is_narrow(window));
        if narrow && tree && panel && window.is_visible() {
            self.show(window, false, panel);
            self.tree_gave_way.set(true);
            true
        } else if !narrow && (self.tree_gave_way.get() || self.panel_gave_way.get()) {
            self.show(window, true, true);
            true
        } else {
            false
        }
    }

    /// Makes the right panel as wide from the start as its widest page can get: what a scene brings up or hides must not move the picture.
    pub(crate) fn keep_width(&self, pages: &gtk::Stack) {
        let (widest, ..) = pages.measure(gtk::Orientation::Horizontal, -1);
        self.widgets.panel_slot.set_width_request(widest.max(self.widgets.panel_slot.width_request()));
    }
}

/// Whether there is room for one side panel only.
fn is_narrow(window: &gtk::ApplicationWindow) -> bool {
    window.default_width() < ROOM_FOR_BOTH && !window.is_maximized() && !window.is_fullscreen()
}

/// A size of the window that fits on the largest screen there is.
pub(crate) fn on_screen(width: i32, height: i32) -> (i32, i32) {
    let monitors = gdk::Display::default().map(|display| display.monitors());
    let sizes = monitors.iter().flat_map(|list| (0..list.n_items()).filter_map(|at| list.item(at).and_downcast::<gdk::Monitor>()));
    let largest = sizes.map(|monitor| monitor.geometry()).max_by_key(|area| i64::from(area.width()) * i64::from(area.height()));
    largest.map_or((width, height), |area| (width.min(area.width().max(640)), height.min(area.height().max(480))))
}

//! What all widgets are made with: `.ui` files, drawing areas, icons, plots.

pub(crate) mod drawing_area;
pub(crate) mod icons;
pub(crate) mod plot_view;
pub(crate) mod ui;

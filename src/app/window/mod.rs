//! The main window and what frames the picture in it: header with menus, side panels, status line, start page.

pub(crate) mod main_window;
mod memory_usage;
mod menus;
pub(crate) mod side_panels;
pub(crate) mod start_page;
pub(crate) mod status_line;
mod title_bar;

//! The pages of the right-hand panel, and the list of them.

mod diagnostics_panel;
mod display_panel;
mod measure_panel;
pub(crate) mod muscle;
pub(crate) mod onion_skin_panel;
pub(crate) mod pages;
pub(crate) mod panel;

//! The pages of the right-hand panel, and the list of them.

mod display_panel;
mod health_panel;
mod measure_panel;
pub(crate) mod muscle;
pub(crate) mod onion_skin_panel;
pub(crate) mod pages;
pub(crate) mod panel;

//! Skin that follows the muscles beneath it.

#[path = "../support/mod.rs"]
mod support;

mod demos;
mod figures;

//! Skin that follows the muscles beneath it: held against figures that are measured by other means than the program's own.

#[path = "../support/mod.rs"]
mod support;

mod demos;
mod figures;
mod limb;
mod limbs;
mod posed;

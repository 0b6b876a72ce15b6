//! Pictures, against references, closed forms and golden files.

#[path = "../collada_support/mod.rs"]
mod build;
#[path = "../render_support/mod.rs"]
mod render_support;

mod coverage;
mod exact;
mod glass;
mod golden;
mod pick;
mod solid;
mod texture;
mod texture_place;
mod two_sided;

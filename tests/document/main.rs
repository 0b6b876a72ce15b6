//! Documents: opening, posing, measuring, and real clips against reference figures.

#[path = "../support/mod.rs"]
mod support;

mod conformance;
mod inspect;
mod older_files;
mod open;
mod posing;
mod shared_models;

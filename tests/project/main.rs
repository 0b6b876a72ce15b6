//! What the project says of itself: catalogues, README, set-up, the repository.

#[path = "../support/mod.rs"]
mod support;

mod catalogue;
mod readme;
mod repository;
mod setup;

//! Muscles: the profile, the line of action, the surface, the YAML and its editing.

mod attach;
mod config;
mod edit;
mod experiment;
mod geometry;
mod joint;
mod line;
mod pappus;
mod profile;
mod save;
mod schema;

//! The COLLADA reader, point by point, on documents that the tests compose themselves.

#[path = "../collada_support/mod.rs"]
mod build;

mod animate;
mod archives;
mod controllers;
mod documents;
mod hostile;
mod materials;
mod meshes;
mod scenes;
mod skins;

//! Sinew opens skeletal animation clips (COLLADA) and volume-conserving muscles (YAML), puts both into one
//! scene graph and draws them with its own rasterizer.
//!
//! The map of the crate, from the ground up; arrows point downward only:
//!
//! | module | what it holds | knows |
//! |---|---|---|
//! | [`i18n`] | the translation catalogue (English, Russian) | nothing |
//! | [`diagnostics`] | findings: what a reader saw and what it did about it | nothing |
//! | [`limits`] | every bound on what input may ask for, in one place | nothing |
//! | [`message`] | what libraries tell people, without a language: keys, parameters, places | nothing |
//! | [`progress`] | how far a long task is, and a way to stop it | nothing |
//! | [`system`] | messages for people about failed system calls | `i18n` |
//! | [`input`] | reads files from outside: regular ones, within a size limit | `system` |
//! | [`yaml`] | the one reader of YAML, within bounds | `i18n`, `limits` |
//! | `simd` | vectors of numbers, with the same result to the bit on every instruction set | nothing |
//! | [`scene`] | graph, meshes, skins, materials, lights, cameras, the posed [`scene::Frame`] | `glam` |
//! | [`animation`] | curves, clips, the time cursor | `scene` |
//! | [`muscle`] | the volume-conserving profile, the arm, the surface, the YAML | `scene` |
//! | [`collada`] | the reader of `.dae` and `.zae` | `scene`, `animation` |
//! | [`render`] | the rasterizer | `scene` |
//! | [`document`] | any file to a [`document::Document`]; `Document::pose` makes a frame | all of the above but `render` |
//! | [`export`] | pictures, videos and surfaces as files; glTF of whole documents | `scene`, `render`, `document` |
//! | [`plot`] | quantities as curves, on a widget, as SVG and as PNG | `i18n` |
//! | [`view`] | how a document is shown, without a window: session files, display presets, onion skins and comparisons | `document`, `render` |
//! | [`sequence`] | frame sequences: what moves, and how it becomes files | `document`, `render`, `export`, `view` |
//! | [`session`] | what is open and how it is looked at, with undo; no widgets | `document`, `render`, `view` |
//! | [`cli`] | one file a subcommand | `document`, `render`, `export`, `sequence`, `view` |
//! | `app` | the GTK window, behind the feature `gui` | everything |
//!
//! There is one way to make a picture: [`document::Document::pose`] fills a [`scene::Frame`], and
//! [`render::Renderer::draw`] turns it into pixels. The window, the command line, the tests and the benches all call these two.

#[cfg(feature = "gui")]
pub mod app;
pub mod cli;

pub use sinew_collada as collada;
pub use sinew_engine::{document, export, input, plot, sequence, session, system, view};
pub use sinew_i18n::{self as i18n, tr};
pub use sinew_muscle as muscle;
pub use sinew_render as render;
pub use sinew_scene::{self as scene, animation, diagnostics, limits, message, progress};
pub use sinew_yaml as yaml;

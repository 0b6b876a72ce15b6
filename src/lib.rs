//! Sinew opens skeletal animation clips (COLLADA) and volume-conserving muscles (YAML), puts both into one
//! scene graph and draws them with its own rasterizer.
//!
//! The map of the crate, from the ground up; arrows point downward only:
//!
//! | module | what it holds | knows |
//! |---|---|---|
//! | [`i18n`] | the translation catalogue (English, Russian) | nobody |
//! | [`diagnostics`] | findings: what a reader saw and what it did about it | nobody |
//! | [`limits`] | every bound on what input may ask for, in one place | nobody |
//! | [`system`] | what the system says where it refuses, for people | `i18n` |
//! | [`input`] | the one door for files: regular ones, within a bound | `system` |
//! | [`yaml`] | the one reader of YAML, within bounds | `i18n`, `limits` |
//! | `simd` | vectors of numbers, the same bits with every instruction set | nobody |
//! | [`scene`] | graph, meshes, skins, materials, lights, cameras, the posed [`scene::Frame`] | `glam` |
//! | [`animation`] | curves, clips, the time cursor | `scene` |
//! | [`muscle`] | the volume-conserving profile, the arm, the surface, the YAML | `scene` |
//! | [`collada`] | the reader of `.dae` and `.zae` | `scene`, `animation` |
//! | [`render`] | the rasterizer | `scene` |
//! | [`document`] | any file to a [`document::Document`]; `Document::pose` makes a frame | all of the above but `render` |
//! | [`export`] | pictures, films and surfaces as files; glTF of whole documents | `scene`, `render`, `document` |
//! | [`plot`] | quantities as curves, on a widget, as SVG and as PNG | `i18n` |
//! | [`stage`] | how a document is looked at, without a window: session files, looks by name, ghosts and comparisons | `document`, `render` |
//! | [`film`] | pictures in a row: what moves, and how it becomes files | `document`, `render`, `export`, `stage` |
//! | [`cli`] | one file a subcommand | `document`, `render`, `export`, `film`, `stage` |
//! | `app` | the GTK window, behind the feature `gui` | everything |
//!
//! There is one way to make a picture: [`document::Document::pose`] fills a [`scene::Frame`], and
//! [`render::Renderer::draw`] turns it into pixels. The window, the command line, the tests and the benches all call these two.

pub mod animation;
#[cfg(feature = "gui")]
pub mod app;
pub mod cli;
pub mod collada;
pub mod diagnostics;
pub mod document;
pub mod export;
pub mod film;
pub mod i18n;
pub mod input;
pub mod limits;
pub mod muscle;
pub mod plot;
pub mod render;
pub mod scene;
mod simd;
pub mod stage;
pub mod system;
pub mod yaml;

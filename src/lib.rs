//! Sinew opens skeletal animation clips (COLLADA) and volume-conserving muscles (YAML), puts both into one
//! scene graph and draws them with its own rasterizer.
//!
//! This package is the program: [`cli`], one file a subcommand, and `app`, the GTK window behind the feature `gui`. The libraries that it is made of are
//! crates of their own under `crates`, named here once more so that tests and benches find everything in one place; `docs/ARCHITECTURE.md` has the map.
//!
//! There is one way to make a picture: [`document::Document::pose`] fills a [`scene::Frame`], and
//! [`render::Renderer::draw`] turns it into pixels. The window, the command line, the tests and the benches all call these two.

#[cfg(feature = "gui")]
pub mod app;
pub mod cli;
pub mod formats;

pub use sinew_collada as collada;
pub use sinew_engine::{document, input, output, session, system, view};
pub use sinew_export::{self as export, plot, sequence};
pub use sinew_i18n::{self as i18n, tr};
pub use sinew_muscle as muscle;
pub use sinew_render as render;
pub use sinew_scene::{self as scene, animation, diagnostics, limits, message, progress};
pub use sinew_yaml as yaml;

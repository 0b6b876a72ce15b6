//! A rasterizer for the processor. It knows the scene alone: a [`Frame`](sinew_scene::Frame) is all that it draws.
//!
//! A [`RenderJob`] is what a picture depends on, a [`PickJob`] a question about one of its pixels, and a [`Renderer`] what is kept between them: threads,
//! buffers, textures. After the first frames nothing is allocated any more.
//!
//! # How a frame is drawn
//!
//! 1. **Draw list** (`draw_list`, `color_source`, `resolve_material`). Each part of each shown surface becomes a draw call: material, display options and
//!    surface together, resolved to the numbers that the kernels read. Opaque ones come first, blended ones after, bones in an overlay.
//! 2. **Lines** (`scene_lines`, `debug_lines`, `line`). Grid, axes, wireframe and outlines are projected, clipped and put into the lists of the bands.
//! 3. **Vertex stage** (`vertex_arrays`, `vertex`). Every vertex is transformed, projected and lit once, into flat arrays, in chunks that the threads share.
//! 4. **Binning** (`triangle_bins`, `binning`, `clip`). The picture is cut into bands of rows. Triangles are culled by their snapped area, clipped where an
//!    outcode says that they reach beyond the near plane or the guard band, and listed for each band that they touch, in the order in which they were given.
//!    Blended ones are sorted by distance first.
//! 5. **Bands** (`band_raster`, `raster`, `small_triangles`, `shade`). A thread takes a band, draws the background, fills its triangles into a buffer that
//!    fits into its cache, lays lines and bones over it, averages the samples in linear light (`resolve`) and writes the finished rows into the target.
//!
//! Edges are exact: corners are snapped to a 256th of a pixel, edge functions set up in 64 bits and stepped in 32, and the top-left rule decides pixels that lie on
//! an edge. So neighbours neither overlap nor gape, and the same bits come out for any number of threads and any instruction set.
//!
//! # What was slower
//!
//! * **Setting triangles up one by one**, in `i64` and `f64`. For a triangle of a few pixels that costs ten times as much as its pixels do; small ones are
//!   set up sixteen at a time, in `i32` and `f32` where these are exact enough. Writing the corners' colours to an array on the way and reading them back at
//!   once was a quarter of the time of a small triangle.
//! * **Walking every row of a triangle's box from end to end.** Walking only the stretch that can be inside, with an apron round mip levels and texels
//!   blended in 16 bits, halved the time of a textured sphere.
//! * **A perspective division at each pixel.** Where 1/w hardly changes over a triangle, two of Newton's steps do.
//! * **Fetching texels one by one.** A texel and its right neighbour come by one gather of 64 bits.
//! * **Whole rows.** A figure in a wide picture paid for cleared, resolved and copied columns on either side; only the columns that something touches pass
//!   through the buffer now. The ground grid is drawn once and kept while the camera rests.
//! * **Shading what a closed surface hides.** Half of its triangles need no light, set-up or depth test while the camera is outside of it.
//! * **Threads for each frame.** Spawning two costs as much as clearing the picture; they are parked between frames instead.
//! * **Larger tiles.** Of the lanes of 4 × 4 blocks that begin at the triangle's box 61 % are lit with 10 000 triangles, of 8 × 2 blocks 54 %, of aligned
//!   4 × 4 blocks 58 %.
//!
//! # Memory
//!
//! Whatever grows with the picture or the scene is asked for in a way that the system can refuse: then drawing returns [`RenderError::OutOfMemory`] and the
//! renderer lets go of its buffers. Lists that are filled in hot loops remember that a value is missing, and are asked once at the end of their stage.
//!
//! # Fibres
//!
//! A surface may be made of [`Fibers`](sinew_scene::Fibers): a procedural texture along it, with other colours at its ends. A texture, not a formula at each
//! pixel: its mip levels keep distant fibres from glittering.

mod background;
mod band_raster;
mod bin_lists;
mod binning;
mod bones;
mod clip;
mod color_source;
mod debug_lines;
mod display;
mod draw_data;
mod draw_list;
mod edges;
mod error;
mod fiber_texture;
mod frame_stages;
mod framebuffer;
mod light;
mod line;
mod material_state;
mod memory;
mod mesh_cache;
mod pick;
mod pick_job;
mod pool;
mod projection;
mod raster;
mod render_job;
mod renderer;
mod resolve;
mod resolve_material;
mod scene_lines;
mod setup;
mod shade;
mod simd_error;
mod small_triangles;
mod srgb;
mod static_layer_cache;
mod texels;
mod texture;
mod tile_buffer;
mod triangle_bins;
mod vertex;
mod vertex_arrays;
mod weight_colormap;

pub use display::{Background, Display, Highlight, OverlayPalette, Samples, Shading, Theme};
pub use error::RenderError;
pub use framebuffer::Framebuffer;
pub use pick_job::{PickHit, PickJob};
pub use render_job::{RenderJob, RenderTarget};
pub use renderer::{Renderer, Stats};
pub use simd_error::SimdError;
pub use weight_colormap::weight_color;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

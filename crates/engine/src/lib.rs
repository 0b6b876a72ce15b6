//! Everything between the readers and the programs. Nothing here knows a window or a command line.
//!
//! # From files to a picture
//!
//! [`document::Document::open`] reads files, with the readers that it is given, and puts them side by side into one scene. [`document::Document::pose`] makes a
//! [`Frame`](sinew_scene::Frame) of any moment of it: curves are sampled, matrices composed, muscles solved, skins deformed. A
//! [`Renderer`](sinew_render::Renderer) draws the frame. The window, the command line, the tests and the benches call these and nothing else.
//!
//! ```
//! use sinew_engine::document::{Document, PoseBuffers};
//! use sinew_render::{Display, RenderJob, Renderer};
//! use sinew_scene::{Frame, OrbitCamera};
//!
//! let document = Document::built_in();
//! let mut state = document.start_state();
//! state.joints.drive = document.driven_rig().map_or(state.joints.drive, |rig| rig.at_flexion(90.0));
//! let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
//! document.pose(&state, &mut buffers, &mut frame);
//! let mut orbit = OrbitCamera::default();
//! orbit.fit(&frame.bounds, 1.0);
//! let (camera, display) = (orbit.camera(), Display::default());
//! let job = RenderJob { scene: &document.scene, frame: &frame, camera: &camera, display: &display, width: 64, height: 64 };
//! assert_eq!(Renderer::new(Some(1)).draw(&job)?.pixels.len(), 64 * 64);
//! # Ok::<(), sinew_render::RenderError>(())
//! ```
//!
//! # What is where
//!
//! | module | what it holds |
//! |---|---|
//! | [`document`] | files, posing, skinning, joints that are held, muscles on the bones of clips |
//! | [`view`] | how a document is shown: cameras, light, display options, onion skins, motion paths, comparison; session files and settings |
//! | [`session`] | what is open in a window: selection, tools, undo |
//! | [`input`], [`output`], [`system`] | files from outside; files that are written, none of which replaces one that is open; why the operating system refused |

pub mod document;
pub mod input;
pub mod output;
pub mod session;
pub mod system;
pub mod view;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

//! Everything between the readers and the programs: documents of several files, posing, skinning, measuring, sessions with undo, sequences of
//! frames, and export. Nothing here knows a window or a command line.

pub mod document;
pub mod export;
pub mod input;
pub mod plot;
pub mod sequence;
pub mod session;
pub mod system;
pub mod view;

//! Files that are written: none replaces a file that it is made from or that is open, and each is complete or not there.
//!
//! A file is written beside its final place under a temporary name and renamed when it is complete, so a failed save leaves what was there. What writes
//! takes an [`Output`], which only an [`OverwriteGuard`] gives out.

mod atomic_file;
mod error;
mod guard;
mod temporary;

pub use atomic_file::{PendingFile, prepare, write_atomic};
pub use error::OutputError;
pub use guard::{Output, OverwriteGuard, is_same};
pub use temporary::cleanup_temp_files;

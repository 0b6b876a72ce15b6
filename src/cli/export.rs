//! `sinew export`: the posed surface as a file.

use std::path::{Path, PathBuf};

use clap::ArgMatches;

use super::failure::{Failure, display_name};
use super::moment::Moment;
use super::{files, value};
use crate::collada::Progress;
use crate::document::{Document, Images, OpenOptions, PoseBuffers};
use crate::export::obj;
use crate::scene::Frame;
use crate::tr;

/// Runs the subcommand.
pub fn run(given: &ArgMatches) -> Result<(), Failure> {
    let files = files(given);
    // Both are required by the parser.
    let (Some(file), Some(out)) = (files.first(), value::<PathBuf>(given, "output")) else {
        return Err(Failure::usage(tr!("cli-call-wrong")));
    };
    if ending(&out) != "obj" {
        return Err(Failure::usage(tr!("cli-export-ending", out = display_name(&out))));
    }
    refuse_overwriting(&files, &out)?;
    let document = Document::open_with(&files, OpenOptions { images: Images::Locate }, &Progress::default())?;
    let state = Moment::given(given).state(&document, file)?;
    let mut frame = Frame::default();
    document.pose(&state, &mut PoseBuffers::default(), &mut frame);
    if !obj::has_surface(&frame) {
        return Err(Failure::file(file, tr!("cli-export-nothing")));
    }
    obj::save(&out, &document.scene, &frame)?;
    Ok(())
}

/// The ending of a file name in lower case, empty where it has none.
pub fn ending(file: &Path) -> String {
    file.extension().map(|ending| ending.to_string_lossy().to_lowercase()).unwrap_or_default()
}

/// A result never replaces the file that it was made from.
///
/// # Errors
/// [`Failure::Usage`] where `out` is one of `inputs`, by whatever path.
pub fn refuse_overwriting(inputs: &[PathBuf], out: &Path) -> Result<(), Failure> {
    let same = |input: &PathBuf| match (input.canonicalize(), out.canonicalize()) {
        (Ok(input), Ok(out)) => input == out,
        _ => false,
    };
    if inputs.iter().any(same) { Err(Failure::usage(tr!("cli-out-is-input", out = display_name(out)))) } else { Ok(()) }
}

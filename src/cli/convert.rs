//! `sinew convert`: the whole document as glTF.

use std::path::PathBuf;

use clap::ArgMatches;

use super::export::refuse_overwriting;
use super::failure::{Failure, complain, display_name};
use super::{files, value};
use crate::collada::Progress;
use crate::document::{Document, Images, OpenOptions};
use crate::export::gltf::{Form, save};
use crate::tr;

/// Runs the subcommand.
pub fn run(given: &ArgMatches) -> Result<(), Failure> {
    let files = files(given);
    // Required by the parser.
    let Some(out) = value::<PathBuf>(given, "out") else { return Err(Failure::usage(tr!("cli-call-wrong"))) };
    let form = Form::of(&out).ok_or_else(|| Failure::usage(tr!("cli-convert-ending", out = display_name(&out))))?;
    refuse_overwriting(&files, &out)?;
    let document = Document::open_with(&files, OpenOptions { images: Images::Decode }, &Progress::default())?;
    for loss in save(&out, form, &document)? {
        complain(&format!("{}: {loss}", display_name(&out)));
    }
    Ok(())
}

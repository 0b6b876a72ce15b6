//! `sinew convert`: the whole document as glTF.

use std::path::PathBuf;

use clap::ArgMatches;

use super::export::allow_overwriting;
use super::failure::{Failure, notice, one_file, output_name, remark, wrong_ending};
use super::progress::leave_nothing;
use super::{files, value};
use crate::collada::Progress;
use crate::document::{Document, Images, OpenOptions};
use crate::export::gltf::{Form, save};
use crate::export::guard::Guard;
use crate::tr;

/// Runs the subcommand.
pub(super) fn run(given: &ArgMatches) -> Result<(), Failure> {
    let files = files(given);
    // Required by the parser.
    let Some(out) = value::<PathBuf>(given, "out") else { return Err(Failure::usage(tr!("cli-call-wrong"))) };
    let form = Form::of(&out).ok_or_else(|| wrong_ending(&out, "cli-convert-ending"))?;
    one_file(&out)?;
    let guard = Guard::of_files(&files);
    guard.output(&out)?;
    let document = Document::open_with(&files, OpenOptions { images: Images::Decode }, &Progress::default())?;
    remark(document.diagnostics.iter());
    let target = guard.and(document.files()).output(&out)?;
    allow_overwriting(given, std::iter::once(out.clone()))?;
    leave_nothing();
    for loss in save(&target, form, &document)? {
        notice(&format!("{}: {loss}", output_name(&out)));
    }
    Ok(())
}

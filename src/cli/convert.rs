//! `sinew convert`: the whole document as glTF.

use std::path::PathBuf;

use clap::ArgMatches;

use super::export::allow_overwriting;
use super::output::{Failure, output_name, print_notice, print_verbose, refuse_number_pattern, wrong_extension};
use super::progress::install_interrupt_handler;
use super::{files, value};
use crate::document::{Document, ImageLoading, OpenOptions};
use crate::export::gltf::{GltfContainer, save};
use crate::formats::SCENE_READERS;
use crate::i18n;
use crate::i18n::Sentence;
use crate::output::OverwriteGuard;
use crate::progress::Progress;
use crate::tr;

/// Runs the subcommand.
pub(super) fn run(given: &ArgMatches) -> Result<(), Failure> {
    let files = files(given);
    // Required by the parser.
    let Some(out) = value::<PathBuf>(given, "out") else { return Err(Failure::usage(tr!("cli-usage-error"))) };
    let form = GltfContainer::of(&out).ok_or_else(|| wrong_extension(&out, "cli-convert-ending"))?;
    refuse_number_pattern(&out)?;
    let guard = OverwriteGuard::of_files(&files);
    guard.output(&out)?;
    let document =
        Document::open_with(&files, OpenOptions { images: ImageLoading::Decode, ..OpenOptions::new(SCENE_READERS) }, &Progress::default())?;
    print_verbose(document.diagnostics.iter().map(i18n::finding_line));
    let target = guard.and(document.files()).output(&out)?;
    allow_overwriting(given, std::iter::once(out.clone()))?;
    install_interrupt_handler();
    for loss in save(&target, form, &document)? {
        print_notice(&format!("{}: {}", output_name(&out), loss.sentence()));
    }
    Ok(())
}

//! `sinew export`: the posed surface as a file.

use std::io::{self, BufRead, IsTerminal};
use std::path::PathBuf;

use clap::ArgMatches;

use super::output::{Failure, is_quiet, output_name, print_prompt, print_verbose, refuse_number_pattern, wrong_extension};
use super::pose_options::PoseOptions;
use super::progress::install_interrupt_handler;
use super::{files, value};
use crate::document::{Document, ImageLoading, OpenOptions, PoseBuffers};
use crate::export::mtl;
use crate::export::surface::SurfaceFormat;
use crate::export::world_mesh;
use crate::formats::SCENE_READERS;
use crate::i18n;
use crate::output::OverwriteGuard;
use crate::progress::Progress;
use crate::scene::Frame;
use crate::tr;

/// Runs the subcommand.
pub(super) fn run(given: &ArgMatches) -> Result<(), Failure> {
    let files = files(given);
    // Both are required by the parser.
    let (Some(file), Some(out)) = (files.first(), value::<PathBuf>(given, "output")) else {
        return Err(Failure::usage(tr!("cli-usage-error")));
    };
    let format = SurfaceFormat::of(&out).ok_or_else(|| wrong_extension(&out, "cli-export-ending"))?;
    refuse_number_pattern(&out)?;
    let library = (format == SurfaceFormat::Obj).then(|| mtl::library(&out));
    let outs = || std::iter::once(out.clone()).chain(library.clone());
    let guard = OverwriteGuard::of_files(&files);
    outs().try_for_each(|out| guard.output(&out).map(drop))?;
    let document =
        Document::open_with(&files, OpenOptions { images: ImageLoading::Locate, ..OpenOptions::new(SCENE_READERS) }, &Progress::default())?;
    print_verbose(document.diagnostics.iter().map(i18n::finding_line));
    let guard = guard.and(document.files());
    outs().try_for_each(|out| guard.output(&out).map(drop))?;
    allow_overwriting(given, outs())?;
    let state = PoseOptions::given(given).state(&document, file)?;
    let mut frame = Frame::default();
    document.pose(&state, &mut PoseBuffers::default(), &mut frame);
    if !world_mesh::is_any(&frame) {
        return Err(Failure::file(file, tr!("cli-export-nothing")));
    }
    install_interrupt_handler();
    format.save(&guard.output(&out)?, &document.scene, &frame)?;
    print_verbose([tr!("cli-export-written", out = output_name(&out))]);
    Ok(())
}

/// An existing file is only replaced after a question where standard input is a terminal; scripts and desktops, which cannot be asked, replace it,
/// and so does `--force`.
///
/// # Errors
/// [`Failure::Files`] where the answer is no.
pub(super) fn allow_overwriting(given: &ArgMatches, outs: impl Iterator<Item = PathBuf>) -> Result<(), Failure> {
    if given.get_flag("force") || is_quiet() || !io::stdin().is_terminal() || !io::stderr().is_terminal() {
        return Ok(());
    }
    let there: Vec<PathBuf> = outs.filter(|out| out.is_file()).collect();
    let Some(first) = there.first() else { return Ok(()) };
    print_prompt(&tr!("cli-ask-overwrite", out = output_name(first), more = there.len() - 1));
    let mut answer = String::new();
    // No answer is a no.
    let _ = io::stdin().lock().read_line(&mut answer);
    if ["y", "yes", "д", "да"].contains(&answer.trim().to_lowercase().as_str()) {
        Ok(())
    } else {
        Err(Failure::file(first, tr!("cli-left-alone")))
    }
}

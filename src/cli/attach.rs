//! `sinew attach`: a set of muscles on the bones of a figure, as a muscle file.

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::PathBuf;

use clap::ArgMatches;

use super::export::allow_overwriting;
use super::output::{Failure, output_name, print_notice, print_verbose, refuse_number_pattern, wrong_extension};
use super::progress::install_interrupt_handler;
use super::{files, value};
use crate::document::{Document, ImageLoading, OpenOptions};
use crate::export::file_extension::extension;
use crate::formats::SCENE_READERS;
use crate::i18n::{self, Sentence};
use crate::muscle::BodySide;
use crate::muscle::MuscleFile;
use crate::muscle::sets::{MuscleSet, Sides};
use crate::output::{OverwriteGuard, write_atomic};
use crate::progress::Progress;
use crate::tr;

/// Runs the subcommand.
pub(super) fn run(given: &ArgMatches) -> Result<(), Failure> {
    let files = files(given);
    // All are required by the parser.
    let (Some(file), Some(out), Some(set)) =
        (files.first(), value::<PathBuf>(given, "output"), value::<String>(given, "set").and_then(|id| MuscleSet::by_id(&id)))
    else {
        return Err(Failure::usage(tr!("cli-usage-error")));
    };
    if !matches!(extension(&out).as_str(), "yaml" | "yml") {
        return Err(wrong_extension(&out, "cli-fit-ending"));
    }
    refuse_number_pattern(&out)?;
    let guard = OverwriteGuard::of_files(&files);
    guard.output(&out)?;
    let sides = match value::<String>(given, "side").as_deref() {
        Some("left") => Sides::One(BodySide::Left),
        Some("right") => Sides::One(BodySide::Right),
        _ => Sides::Both,
    };
    let document =
        Document::open_with(&files, OpenOptions { images: ImageLoading::Locate, ..OpenOptions::new(SCENE_READERS) }, &Progress::default())?;
    print_verbose(document.diagnostics.iter().map(i18n::finding_line));
    let target = guard.and(document.files()).output(&out)?;
    let attached = document.attach_set(set, sides).map_err(|error| Failure::file(file, error.sentence()))?;
    if attached.figures > 1 {
        print_notice(&tr!("cli-attach-several-figures", file = super::output::display_name(file), count = attached.figures));
    }
    // Its clip is named from where it is written.
    let made = document.muscle_file_for(usize::MAX, &attached.file, &out);
    allow_overwriting(given, std::iter::once(out.clone()))?;
    install_interrupt_handler();
    let text = credited(set, &made);
    write_atomic(&target, |sink| sink.write_all(text.as_bytes()))?;
    print_verbose([tr!("cli-attach-written", out = output_name(&out), count = made.muscles.len())]);
    Ok(())
}

/// The file as YAML, below the credit that the licences of the models ask for.
fn credited(set: MuscleSet, file: &MuscleFile) -> String {
    let mut text =
        format!("# Muscles made by “sinew attach --set {}” from published models, carried to the joints of this clip:\n", set.id());
    for (name, credit) in set.credits() {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "# {name}: {credit}.");
    }
    text.push_str("# CC BY 3.0: https://creativecommons.org/licenses/by/3.0/\n");
    text.push_str("# Volumes are F_max / σ · l_opt with σ = 45 N/cm², scaled with the bones. Angles of joints count from the rest pose of the clip.\n");
    text.push_str(&file.to_yaml());
    text
}

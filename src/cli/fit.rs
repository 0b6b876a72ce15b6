//! `sinew fit`: a muscle file from measured radii.

use std::io::Write as _;
use std::path::{Path, PathBuf};

use clap::ArgMatches;
use serde::Serialize;

use super::compare::rms_lines;
use super::export::allow_overwriting;
use super::output::{Failure, display_name, output_name, print_json, print_result, refuse_number_pattern, wrong_extension};
use super::progress::install_interrupt_handler;
use super::{files, measured, value};
use crate::document::{Document, ImageLoading, OpenOptions, SourceKind};
use crate::export::file_extension::extension;
use crate::export::tables::{unit_label, unit_name};
use crate::formats::SCENE_READERS;
use crate::i18n::{Sentence, decimal};
use crate::muscle::parameter_fit::{Fitted, Model, fitted_file};
use crate::muscle::validation::Table;
use crate::muscle::{MuscleFile, MuscleRig};
use crate::output::OverwriteGuard;
use crate::output::write_atomic;
use crate::progress::Progress;
use crate::tr;

/// What was fitted; the names are a contract.
#[derive(Debug, Serialize)]
struct FitReport {
    file: String,
    fitted_to: String,
    unit: String,
    model: &'static str,
    growth: Vec<f64>,
    rms: FitRms,
}

/// Root of the mean squared difference over all nodes and angles.
#[derive(Debug, Serialize)]
struct FitRms {
    own_growth: Option<f64>,
    fitted_growth: f64,
    measured_poses: f64,
}

/// Runs the subcommand.
pub(super) fn run(given: &ArgMatches) -> Result<(), Failure> {
    let files = files(given);
    // Both are required by the parser.
    let (Some(csv), Some(out)) = (files.first(), value::<PathBuf>(given, "output")) else {
        return Err(Failure::usage(tr!("cli-usage-error")));
    };
    if !matches!(extension(&out).as_str(), "yaml" | "yml") {
        return Err(wrong_extension(&out, "cli-fit-ending"));
    }
    refuse_number_pattern(&out)?;
    let like = value::<PathBuf>(given, "like");
    let guard = OverwriteGuard::of_files(files.iter().chain(&like));
    guard.output(&out)?;
    let table = measured::read(csv)?;
    let document = match &like {
        Some(file) => Document::open_with(
            std::slice::from_ref(file),
            OpenOptions { images: ImageLoading::Locate, ..OpenOptions::new(SCENE_READERS) },
            &Progress::default(),
        )?,
        None => Document::built_in(),
    };
    let target = guard.and(document.files()).output(&out)?;
    let model = if value::<String>(given, "model").as_deref() == Some("poses") { Model::Poses } else { Model::Growth };
    let (file, rig) = muscles(&document, like.as_deref().unwrap_or(csv))?;
    // What is made from it lies elsewhere.
    let file = &document.muscle_file_for(0, file, &out);
    let mut fitted = fit_first(file, rig, &table, model).map_err(|error| Failure::file(csv, error.sentence()))?;
    let misfit = if model == Model::Poses { fitted.poses } else { fitted.growth };
    let unit = unit_name(file.unit_metres);
    let growth = match fitted.file.muscles.first_mut() {
        Some(muscle) => {
            let rms = format!("{} {}", decimal(misfit, 2), unit_label(&unit).sentence());
            muscle.source = tr!("cli-fit-source", table = file_name(csv), rms = rms);
            muscle.profile.growth().to_vec()
        }
        None => Vec::new(),
    };
    allow_overwriting(given, std::iter::once(out.clone()))?;
    install_interrupt_handler();
    write_atomic(&target, |sink| sink.write_all(fitted.file.to_yaml().as_bytes()))?;
    let rms = FitRms { own_growth: fitted.own, fitted_growth: fitted.growth, measured_poses: fitted.poses };
    if given.get_flag("json") {
        let model = if model == Model::Poses { "poses" } else { "growth" };
        print_json(&FitReport { file: output_name(&out), fitted_to: display_name(csv), unit, model, growth, rms })
    } else {
        print_result(rms_lines(rms.own_growth, rms.fitted_growth, rms.measured_poses, &unit_label(&unit).sentence()).trim_start())
    }
}

fn muscles<'a>(document: &'a Document, file: &Path) -> Result<(&'a MuscleFile, &'a MuscleRig), Failure> {
    let found = document.sources.iter().find_map(|source| match &source.kind {
        SourceKind::Muscles(muscles, rig) => Some((&**muscles, &**rig)),
        SourceKind::Scene(_) => None,
    });
    found.ok_or_else(|| Failure::file(file, tr!("cli-like-no-muscle")))
}

/// Fits the first muscle that hangs on a joint, and leaves the others out: the table speaks of one.
fn fit_first(file: &MuscleFile, rig: &MuscleRig, table: &Table, model: Model) -> Result<Fitted, crate::muscle::validation::CompareError> {
    let index = (0..rig.len()).find(|index| rig.is_attached(*index)).unwrap_or(0);
    let mut fitted = fitted_file(file, rig, index, table, model)?;
    if index < fitted.file.muscles.len() {
        fitted.file.muscles = vec![fitted.file.muscles.swap_remove(index)];
    }
    Ok(fitted)
}

fn file_name(file: &Path) -> String {
    file.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

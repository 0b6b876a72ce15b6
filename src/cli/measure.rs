//! `sinew measure`: muscles and joints in numbers.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use clap::ArgMatches;

use super::arg_parsers::{Angles, MOST_DEGREES, Times, plain};
use super::compare::CompareReport;
use super::export::allow_overwriting;
use super::output::{
    Failure, display_name, output_name, print_json, print_notice, print_result, print_verbose, refuse_number_pattern, wrong_extension,
};
use super::pose_options::unknown_clip;
use super::progress::install_interrupt_handler;
use super::text_table::columns;
use super::{files, joints, value};
use crate::document::{Document, ImageLoading, OpenOptions, PoseState};
use crate::export::plot::Page;
use crate::export::tables::{
    JointTable, MeasureTable, MuscleTable, PLOT_SCALE, PlotFormat, TableError, TableFormat, TableSubject, UnknownJoint, even_times,
    save_page, unit_label,
};
use crate::formats::SCENE_READERS;
use crate::i18n::{self, Sentence, decimal};
use crate::output::OverwriteGuard;
use crate::progress::Progress;
use crate::sequence::DEFAULT_FPS;
use crate::tr;

/// Runs the subcommand.
pub(super) fn run(given: &ArgMatches) -> Result<(), Failure> {
    let files = files(given);
    let document =
        Document::open_with(&files, OpenOptions { images: ImageLoading::Locate, ..OpenOptions::new(SCENE_READERS) }, &Progress::default())?;
    let file = files.first().cloned().unwrap_or_default();
    let name = files.iter().map(|file| display_name(file)).collect::<Vec<_>>().join(", ");
    let sheet = MeasureReport {
        given,
        guard: OverwriteGuard::of_files(&files).and(document.files()),
        name: name.clone(),
        unit_metres: document.muscle_files().next().map_or(0.001, |file| file.unit_metres),
    };
    if given.get_flag("joints") {
        // A file without joints is to be told so, whether it has a clip or not.
        if TableError::check(TableSubject::Joints, &document, &document.start_state(), DEFAULT_FPS) == Err(TableError::NoJoint) {
            return Err(match document.clips.is_empty() {
                true => Failure::usage(tr!("cli-measure-no-joint-no-clip", file = display_name(&file))),
                false => table_failure(TableError::NoJoint, &file),
            });
        }
        let (state, times) = times(given, &document, &file)?;
        let table = JointTable::over_time(&document, display_name(&file), &state, &times);
        return sheet.answer(&MeasureTable::Joints(table.map_err(|error| table_failure(error, &file))?));
    }
    if document.muscle_count() == 0 {
        return Err(Failure::file(&file, TableError::NoMuscle.sentence()));
    }
    if !has_one_unit(&document) {
        return Err(Failure::usage(tr!("cli-measure-units-differ")));
    }
    if let Some(csv) = value::<PathBuf>(given, "compare") {
        let comparison = CompareReport::of(&document, &file, &csv)?;
        return if given.get_flag("json") {
            print_json(&comparison)
        } else if given.get_flag("csv") {
            print_result(&comparison.csv())
        } else {
            print_result(&comparison.text())
        };
    }
    if given.contains_id("times") {
        let (state, times) = times(given, &document, &file)?;
        let table = MuscleTable::over_time(&document, name, &state, &times);
        return sheet.answer(&MeasureTable::Muscles(table.map_err(|error| table_failure(error, &file))?));
    }
    let angles = value::<Angles>(given, "angles").or_else(|| value::<Angles>(given, "sweep")).map(|angles| angles.0);
    if let Some(angles) = &angles {
        if let Some(angle) = angles.iter().find(|angle| angle.abs() > MOST_DEGREES) {
            let option = if given.contains_id("sweep") { "--sweep" } else { "--angles" };
            let error = tr!("cli-value-out-of-range", low = plain(-MOST_DEGREES), high = plain(MOST_DEGREES));
            return Err(Failure::usage(tr!("cli-value-wrong", option = option, value = plain(*angle), why = error)));
        }
        if !given.contains_id("joint") {
            print_angles_out_of_range(&document, angles, &file);
        }
    }
    if angles.is_none() && given.contains_id("plot") && !given.contains_id("joint") {
        // Four angles are a table, but no curve.
        let table = MeasureTable::measure(TableSubject::Muscles, &document, &document.start_state(), DEFAULT_FPS)
            .map_err(|why| table_failure(why, &file))?;
        return sheet.answer(&table);
    }
    let joint = value::<String>(given, "joint");
    let table = MuscleTable::over_joint(&document, name, joint.as_deref(), angles.as_deref());
    let table = table.map_err(|error| unknown_joint(&error, &file))?;
    let table = table.ok_or_else(|| Failure::usage(tr!("cli-no-arm-to-measure", file = display_name(&file))))?;
    sheet.answer(&MeasureTable::Muscles(table))
}

/// Whether all muscle files give lengths in the same unit, which a table has one of.
fn has_one_unit(document: &Document) -> bool {
    let mut units = document.muscle_files().map(|file| file.unit_metres);
    let first = units.next();
    units.all(|unit| Some(unit) == first)
}

/// How a table is to be answered.
struct MeasureReport<'a> {
    given: &'a ArgMatches,
    guard: OverwriteGuard,
    /// What the files are called.
    name: String,
    /// Metres a unit of the muscle files.
    unit_metres: f64,
}

impl MeasureReport<'_> {
    /// Draws the plot that is asked for, and prints the table where that is asked for or there is no plot.
    fn answer(&self, table: &MeasureTable) -> Result<(), Failure> {
        let given = self.given;
        let (json, csv) = (given.get_flag("json"), given.get_flag("csv"));
        if let Some(out) = value::<PathBuf>(given, "plot") {
            self.draw(table, &out)?;
            if !json && !csv {
                return Ok(());
            }
        }
        match table {
            MeasureTable::Muscles(table) if json => print_json(table),
            MeasureTable::Joints(table) if json => print_json(table),
            MeasureTable::Muscles(table) => print_result(&if csv { table.csv() } else { text(table) }),
            MeasureTable::Joints(table) => print_result(&if csv { table.csv() } else { joints::text(table) }),
        }
    }

    fn draw(&self, table: &MeasureTable, out: &Path) -> Result<(), Failure> {
        let form = TableFormat::of_plot(out).ok_or_else(|| wrong_extension(out, "cli-plot-ending"))?;
        refuse_number_pattern(out)?;
        let scale = value::<f64>(self.given, "scale").unwrap_or(PLOT_SCALE);
        let published = self.given.get_flag("published").then(|| self.published_page(table)).transpose()?;
        let target = self.guard.output(out)?;
        allow_overwriting(self.given, std::iter::once(out.to_owned()))?;
        install_interrupt_handler();
        match published {
            Some(page) => save_page(&page, &target, if form == TableFormat::Png { PlotFormat::Png { scale } } else { PlotFormat::Svg })?,
            None => table.save(&target, form, scale, i18n::sentence)?,
        }
        print_verbose([tr!("cli-export-written", out = output_name(out))]);
        Ok(())
    }
}

impl MeasureReport<'_> {
    /// Moment arms beside published ones.
    fn published_page(&self, table: &MeasureTable) -> Result<Page, Failure> {
        let page = match table {
            MeasureTable::Muscles(table) => table.published_page(self.unit_metres, i18n::sentence),
            MeasureTable::Joints(_) => None,
        };
        page.ok_or_else(|| Failure::usage(tr!("cli-measure-none-published", file = self.name.clone())))
    }
}

/// The clip and its times that were asked for; all of it, [`DEFAULT_FPS`] times a second, where none were.
fn times(given: &ArgMatches, document: &Document, file: &Path) -> Result<(PoseState, Vec<f64>), Failure> {
    let mut state = document.start_state();
    if let Some(name) = value::<String>(given, "clip") {
        state.clip = Some(document.clip_named(&name).ok_or_else(|| unknown_clip(document, file, &name))?);
    }
    let clip = state.clip.and_then(|clip| document.clips.get(clip)).ok_or_else(|| table_failure(TableError::NoClip, file))?;
    let Some(Times(times)) = value::<Times>(given, "times") else {
        return Ok((state, even_times(clip.start, clip.end, DEFAULT_FPS)));
    };
    if times.iter().any(|time| !(clip.start..=clip.end).contains(time)) {
        let (start, end) = (plain(clip.start), plain(clip.end));
        print_notice(&tr!("cli-measure-time-held", file = display_name(file), start = start, end = end));
    }
    Ok((state, times))
}

/// Says which joints there are instead of the one that was asked for.
fn unknown_joint(error: &UnknownJoint, file: &Path) -> Failure {
    let mut known: Vec<String> = error.known.iter().map(|name| i18n::shown(name).into_owned()).collect();
    known.dedup();
    let (file, joint) = (display_name(file), i18n::shown(&error.name).into_owned());
    Failure::usage(match known.is_empty() {
        true => tr!("cli-measure-no-joints", file = file, joint = joint),
        false => tr!("cli-measure-unknown-joint", file = file, joint = joint, known = known.join(", ")),
    })
}

fn table_failure(why: TableError, file: &Path) -> Failure {
    match why {
        TableError::NoClip => Failure::usage(tr!("cli-measure-no-clip", file = display_name(file))),
        TableError::TooLong => Failure::usage(why.sentence()),
        TableError::NoMuscle | TableError::NoJoint => Failure::file(file, why.sentence()),
    }
}

/// The formulas go on beyond the angles that a joint reaches, and so does the table; it says so.
fn print_angles_out_of_range(document: &Document, angles: &[f64], file: &Path) {
    for range in document.rigs().filter_map(|(rig, _)| rig.measured_range()) {
        if angles.iter().any(|angle| !range.contains(angle)) {
            let tenth = |degrees: f64| plain((10.0 * degrees).round() / 10.0);
            let (low, high) = (tenth(*range.start()), tenth(*range.end()));
            print_notice(&tr!("cli-measure-beyond", file = display_name(file), low = low, high = high));
        }
    }
}

/// A table a muscle, for people.
fn text(table: &MuscleTable) -> String {
    let unit = &unit_label(&table.unit).sentence();
    let mut text = String::new();
    for muscle in &table.muscles {
        if !text.is_empty() {
            text.push('\n');
        }
        let _ = writeln!(text, "{}", i18n::shown(&i18n::label(muscle.name.as_label())));
        let head = [
            tr!("cli-measure-angle"),
            tr!("cli-measure-length", unit = unit.clone()),
            tr!("cli-measure-unit-length", unit = unit.clone()),
            tr!("cli-measure-moment-arm", unit = unit.clone()),
            tr!("cli-measure-volume", unit = unit.clone()),
            tr!("cli-measure-error"),
            tr!("cli-measure-delta"),
            tr!("cli-measure-largest", unit = unit.clone()),
        ];
        let timed = table.is_over_time();
        let mut rows = vec![timed.then(|| tr!("cli-measure-time")).into_iter().chain(head).collect::<Vec<_>>()];
        for row in &muscle.samples {
            let dash = |value: Option<f64>, digits| value.map_or_else(|| "–".to_owned(), |value| decimal(value, digits));
            let mark = if row.held { " *" } else { "" };
            let cells = [
                dash(row.angle, 1),
                decimal(row.length, 2) + mark,
                decimal(row.unit_length, 2),
                dash(row.moment_arm, 2),
                decimal(row.volume, 1),
                i18n::localise_decimal_mark(&format!("{:.1e}", row.volume_error)),
                decimal(row.delta, 4),
                decimal(row.largest_radius, 2),
            ];
            rows.push(timed.then(|| dash(row.time, 3)).into_iter().chain(cells).collect());
        }
        text.push_str(&columns(&rows));
        if muscle.samples.iter().any(|row| row.held) {
            let _ = writeln!(text, "* {}", tr!("cli-measure-held"));
        }
    }
    text
}

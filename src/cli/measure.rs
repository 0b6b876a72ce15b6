//! `sinew measure`: muscles in numbers.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use clap::ArgMatches;
use serde::Serialize;

use super::compare::Comparison;
use super::failure::{Failure, answer, answer_json, display_name, notice};
use super::moment::unknown_clip;
use super::values::{Angles, plain};
use super::{files, value};
use crate::collada::Progress;
use crate::document::{Document, PoseBuffers, PoseState, SourceKind, TimeSample};
use crate::i18n::decimal;
use crate::muscle::{Rig, Sample, Solved};
use crate::scene::{Frame, MuscleId};
use crate::tr;

/// Elbow angles where the call does not say.
const ANGLES: [f64; 4] = [0.0, 30.0, 60.0, 90.0];

/// Contractions, per cent, of a muscle that is on no arm.
const CONTRACTIONS: [f64; 5] = [0.0, 25.0, 50.0, 75.0, 100.0];

/// All muscles of a file. The names and their order are a contract; lengths are in `unit`.
#[derive(Debug, Serialize)]
struct Measurement {
    file: String,
    unit: String,
    muscles: Vec<MuscleRows>,
}

#[derive(Debug, Serialize)]
struct MuscleRows {
    name: String,
    samples: Vec<Row>,
}

/// One row of a measurement; lengths are in the file's unit.
#[derive(Debug, Serialize)]
pub struct Row {
    /// Seconds on the clip's axis, where the measurement is one over time.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub time: Option<f64>,
    /// Degrees; none for a muscle that is on no arm.
    pub angle: Option<f64>,
    pub length: f64,
    moment_arm: Option<f64>,
    pub volume: f64,
    volume_error: f64,
    delta: f64,
    pub radii: Vec<f64>,
    largest_radius: f64,
    /// Length from origin to insertion, tendons counted.
    path_length: f64,
    /// Whether the length asked for was outside what the muscle can do and was held at the limit.
    held: bool,
}

/// Runs the subcommand.
pub fn run(given: &ArgMatches) -> Result<(), Failure> {
    let files = files(given);
    let document = Document::open(&files, &Progress::default())?;
    let file = files.first().cloned().unwrap_or_default();
    if document.muscle_count() == 0 {
        return Err(Failure::file(&file, tr!("cli-measure-no-muscle")));
    }
    if let Some(csv) = value::<PathBuf>(given, "compare") {
        let comparison = Comparison::of(&document, &file, &csv)?;
        return if given.get_flag("json") {
            answer_json(&comparison)
        } else if given.get_flag("csv") {
            answer(&comparison.csv())
        } else {
            answer(&comparison.text())
        };
    }
    if let Some(times) = value::<Angles>(given, "times") {
        let clip = value::<String>(given, "clip");
        return over_time(&document, &file, &times.0, clip.as_deref())?.answer(given);
    }
    let angles = value::<Angles>(given, "angles").or_else(|| value::<Angles>(given, "sweep")).map(|angles| angles.0);
    if let Some(angles) = &angles {
        say_what_no_joint_does(&document, angles, &file);
    }
    let measurement = Measurement {
        file: display_name(&file),
        unit: unit(&document),
        muscles: document
            .rigs()
            .flat_map(|(rig, first)| (0..rig.len()).map(move |index| (rig, first, index)))
            .map(|(rig, first, index)| {
                let samples = samples(&document, rig, first, index, angles.as_deref())?;
                Some(MuscleRows { name: rig.name(index).to_owned(), samples })
            })
            .collect::<Option<_>>()
            .ok_or_else(|| Failure::usage(tr!("cli-no-arm-to-measure", file = display_name(&file))))?,
    };
    measurement.answer(given)
}

/// All muscles at times of a clip that moves their bones.
fn over_time(document: &Document, file: &Path, times: &[f64], clip: Option<&str>) -> Result<Measurement, Failure> {
    let mut state = document.start_state();
    if let Some(name) = clip {
        let found = document.clips.iter().position(|clip| clip.name == *name);
        state.clip = Some(found.ok_or_else(|| unknown_clip(document, file, name))?);
    }
    let Some(clip) = state.clip.and_then(|clip| document.clips.get(clip)) else {
        return Err(Failure::usage(tr!("cli-measure-no-clip", file = display_name(file))));
    };
    if times.iter().any(|time| !(clip.start..=clip.end).contains(time)) {
        let (start, end) = (plain(clip.start), plain(clip.end));
        notice(&tr!("cli-measure-time-held", file = display_name(file), start = start, end = end));
    }
    let names = document.rigs().flat_map(|(rig, _)| (0..rig.len()).map(|index| rig.name(index).to_owned()));
    let rows = document.measure_times(&state, times);
    let muscles = names.zip(&rows).map(|(name, samples)| MuscleRows { name, samples: samples.iter().map(Row::at_time).collect() });
    Ok(Measurement { file: display_name(file), unit: unit(document), muscles: muscles.collect() })
}

/// The formulas go on beyond the angles that a joint reaches, and so does the table; it says so.
fn say_what_no_joint_does(document: &Document, angles: &[f64], file: &Path) {
    for range in document.rigs().filter_map(|(rig, _)| rig.measured_range()) {
        if angles.iter().any(|angle| !range.contains(angle)) {
            let (low, high) = (plain(*range.start()), plain(*range.end()));
            notice(&tr!("cli-measure-beyond", file = display_name(file), low = low, high = high));
        }
    }
}

/// Samples of one muscle at these angles; `None` where there are angles but no arm to bend.
fn samples(document: &Document, rig: &Rig, first: MuscleId, index: usize, angles: Option<&[f64]>) -> Option<Vec<Row>> {
    if rig.measured_range().is_some() {
        return Some(rig.measure(index, angles.unwrap_or(&ANGLES)).iter().map(Row::at_angle).collect());
    }
    if angles.is_some() {
        return None;
    }
    let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
    let rows = CONTRACTIONS.iter().filter_map(|contraction| {
        let state = PoseState { drive: rig.at_contraction(*contraction), ..document.start_state() };
        document.pose(&state, &mut buffers, &mut frame);
        buffers.solved().get(first.index() + index).map(Row::alone)
    });
    Some(rows.collect())
}

impl Row {
    /// A sample at an elbow angle.
    pub fn at_angle(sample: &Sample) -> Self {
        Self { angle: Some(sample.angle), moment_arm: Some(sample.moment_arm + 0.0), ..Self::alone(&sample.solved) }
    }

    /// A sample at a time of a clip.
    fn at_time(sample: &TimeSample) -> Self {
        let plain = |value: Option<f64>| value.map(|value| value + 0.0);
        Self { time: Some(sample.time), angle: plain(sample.angle), moment_arm: plain(sample.moment_arm), ..Self::alone(&sample.solved) }
    }

    fn alone(solved: &Solved) -> Self {
        Self {
            time: None,
            angle: None,
            length: solved.length,
            moment_arm: None,
            volume: solved.volume,
            volume_error: solved.volume_error + 0.0,
            // `+ 0.0` turns a negative zero into zero.
            delta: solved.delta + 0.0,
            radii: solved.radii.clone(),
            largest_radius: solved.radii.iter().copied().fold(0.0, f64::max),
            path_length: solved.path_length,
            held: solved.held,
        }
    }
}

impl Measurement {
    fn answer(&self, given: &ArgMatches) -> Result<(), Failure> {
        if given.get_flag("json") {
            answer_json(self)
        } else if given.get_flag("csv") {
            answer(&self.csv())
        } else {
            answer(&self.text())
        }
    }

    /// Whether the rows are those of times.
    fn is_over_time(&self) -> bool {
        self.muscles.iter().flat_map(|muscle| &muscle.samples).any(|row| row.time.is_some())
    }

    /// A line a sample. Numbers have a point and every digit.
    fn csv(&self) -> String {
        let nodes = self.muscles.iter().flat_map(|muscle| &muscle.samples).map(|row| row.radii.len()).max().unwrap_or(0);
        let timed = self.is_over_time();
        let mut text = String::from(if timed { "muscle,time," } else { "muscle," });
        text.push_str("angle,length,moment_arm,volume,volume_error,delta,largest_radius,path_length,held");
        (1..=nodes).for_each(|node| text.push_str(&format!(",r{node}")));
        text.push('\n');
        let optional = |value: Option<f64>| value.map(|value| value.to_string()).unwrap_or_default();
        for muscle in &self.muscles {
            for row in &muscle.samples {
                let cells = [row.length, row.volume, row.volume_error, row.delta, row.largest_radius, row.path_length]
                    .map(|value| value.to_string());
                let [length, volume, error, delta, largest, path] = cells;
                let (angle, arm) = (optional(row.angle), optional(row.moment_arm));
                let time = if timed { optional(row.time) + "," } else { String::new() };
                // Writing to a string cannot fail.
                let _ = write!(
                    text,
                    "{},{time}{angle},{length},{arm},{volume},{error},{delta},{largest},{path},{}",
                    csv_cell(&muscle.name),
                    row.held
                );
                row.radii.iter().for_each(|radius| text.push_str(&format!(",{radius}")));
                text.push('\n');
            }
        }
        text
    }

    /// A table a muscle, for people.
    fn text(&self) -> String {
        let unit = &unit_for_people(&self.unit);
        let mut text = String::new();
        for muscle in &self.muscles {
            if !text.is_empty() {
                text.push('\n');
            }
            let _ = writeln!(text, "{}", muscle.name);
            let head = [
                tr!("cli-measure-angle"),
                tr!("cli-measure-length", unit = unit.clone()),
                tr!("cli-measure-moment-arm", unit = unit.clone()),
                tr!("cli-measure-volume", unit = unit.clone()),
                tr!("cli-measure-error"),
                tr!("cli-measure-delta"),
                tr!("cli-measure-largest", unit = unit.clone()),
            ];
            let timed = self.is_over_time();
            let mut rows = vec![timed.then(|| tr!("cli-measure-time")).into_iter().chain(head).collect::<Vec<_>>()];
            for row in &muscle.samples {
                let dash = |value: Option<f64>, digits| value.map_or_else(|| "–".to_owned(), |value| decimal(value, digits));
                let mark = if row.held { " *" } else { "" };
                let cells = [
                    dash(row.angle, 1),
                    decimal(row.length, 2) + mark,
                    dash(row.moment_arm, 2),
                    decimal(row.volume, 1),
                    crate::i18n::localise_decimal_mark(&format!("{:.1e}", row.volume_error)),
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
}

/// Right-aligned columns.
pub fn columns(rows: &[Vec<String>]) -> String {
    let count = rows.iter().map(Vec::len).max().unwrap_or(0);
    let widths: Vec<usize> =
        (0..count).map(|i| rows.iter().filter_map(|row| row.get(i)).map(|cell| cell.chars().count()).max().unwrap_or(0)).collect();
    let mut text = String::new();
    for row in rows {
        for (cell, width) in row.iter().zip(&widths) {
            let _ = write!(text, "  {cell:>width$}");
        }
        text.push('\n');
    }
    text
}

/// A cell of a CSV file, in quotes where it must be (RFC 4180).
pub fn csv_cell(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_owned() }
}

/// The name of the unit of the muscles' lengths.
pub fn unit(document: &Document) -> String {
    let metres = document.sources.iter().find_map(|source| match &source.kind {
        SourceKind::Muscles(file, _) => Some(file.unit_metres),
        SourceKind::Collada(_) => None,
    });
    unit_name(metres.unwrap_or(1.0))
}

/// The name of a unit that is this many metres long.
pub fn unit_name(metres: f64) -> String {
    let known = [(1e-3, "mm"), (1e-2, "cm"), (1.0, "m"), (0.0254, "in")];
    let found = known.iter().find(|(value, _)| (value - metres).abs() <= 1e-9 * value);
    found.map_or_else(|| format!("{metres} m"), |(_, name)| (*name).to_owned())
}

/// The same in the user's language.
pub fn unit_for_people(unit: &str) -> String {
    match unit {
        "mm" => tr!("cli-unit-mm"),
        "cm" => tr!("cli-unit-cm"),
        "m" => tr!("cli-unit-m"),
        "in" => tr!("cli-unit-in"),
        other => other.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_quoted_where_they_must_be() {
        assert_eq!(csv_cell("biceps"), "biceps");
        assert_eq!(csv_cell("long, \"short\""), "\"long, \"\"short\"\"\"");
    }

    #[test]
    fn columns_line_up() {
        let rows = [vec!["°".to_owned(), "мм".to_owned()], vec!["10".to_owned(), "3".to_owned()]];
        assert_eq!(columns(&rows), "   °  мм\n  10   3\n");
    }
}

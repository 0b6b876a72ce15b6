//! Tables of muscles and joints over angles and over time, as CSV, JSON and plots.

mod joints;
mod muscles;
mod plots;

use std::io::{self, Write};
use std::path::Path;

use sinew_engine::output::Output;
use sinew_engine::output::write_atomic;

use super::ExportError;
use super::plot::Page;
use sinew_engine::document::{Document, PoseState};
use sinew_muscle::MuscleRig;
use sinew_scene::limits;
use sinew_scene::message;
use sinew_scene::message::{Message, ToMessage};
use sinew_scene::visible;

pub use joints::{JointRow, JointRows, JointTable};
pub use muscles::{MuscleRow, MuscleRows, MuscleTable, UnknownJoint, joint_names, unit, unit_name};
pub use plots::{Translate, unit_label};

/// What a table is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TableSubject {
    /// Muscles: over the clip that moves their bones, else over the angles of their arm.
    Muscles,
    /// Joints, over the clip.
    Joints,
}

/// How a table is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TableFormat {
    /// Comma-separated text.
    Csv,
    /// JSON.
    Json,
    /// Curves, in pixels.
    Png,
    /// Curves, sharp at any size.
    Svg,
}

/// Default number of pixels per logical pixel of a plot.
pub const PLOT_SCALE: f64 = 2.0;

/// A table of a whole clip, or of a whole range of angles.
#[derive(Debug, Clone)]
pub enum MeasureTable {
    /// Of muscles.
    Muscles(MuscleTable),
    /// Of joints.
    Joints(JointTable),
}

impl TableFormat {
    /// The kind of plot that a file name's ending asks for.
    pub fn of_plot(file: &Path) -> Option<Self> {
        match file.extension()?.to_string_lossy().to_lowercase().as_str() {
            "png" => Some(Self::Png),
            "svg" => Some(Self::Svg),
            _ => None,
        }
    }
}

impl MeasureTable {
    /// Measures in the clip that `state` names, `fps` times a second; muscles that no clip moves degree by degree.
    ///
    /// # Errors
    /// [`TableError`].
    pub fn measure(of: TableSubject, document: &Document, state: &PoseState, fps: f64) -> Result<Self, TableError> {
        TableError::check(of, document, state, fps)?;
        let file = document.sources.iter().map(|source| source.name.to_string()).collect::<Vec<_>>().join(", ");
        let times = times(document, state, fps);
        match (of, times) {
            (TableSubject::Joints, times) => JointTable::over_time(document, file, state, &times.unwrap_or_default()).map(Self::Joints),
            (TableSubject::Muscles, Some(times)) => MuscleTable::over_time(document, file, state, &times).map(Self::Muscles),
            (TableSubject::Muscles, None) => {
                let angles =
                    document.driven_rig().and_then(MuscleRig::measured_range).map(|range| even_times(*range.start(), *range.end(), 1.0));
                let table = angles.and_then(|angles| MuscleTable::over_angles(document, file.clone(), Some(&angles)));
                table.or_else(|| MuscleTable::over_angles(document, file, None)).map(Self::Muscles).ok_or(TableError::NoMuscle)
            }
        }
    }

    /// Writes it to `file` atomically; a plot with the words of `say`, in pixels `scale` times its logical size.
    ///
    /// # Errors
    /// [`ExportError`] where the file cannot be written, or a plot in pixels cannot be drawn.
    pub fn save(&self, file: &Output, form: TableFormat, scale: f64, say: Translate) -> Result<(), ExportError> {
        match (form, self) {
            (TableFormat::Png, _) => save_page(&self.page(say), file, PlotFormat::Png { scale })?,
            (TableFormat::Svg, _) => save_page(&self.page(say), file, PlotFormat::Svg)?,
            (TableFormat::Csv, Self::Muscles(table)) => write_atomic(file, |out| out.write_all(table.csv().as_bytes()))?,
            (TableFormat::Csv, Self::Joints(table)) => write_atomic(file, |out| out.write_all(table.csv().as_bytes()))?,
            (TableFormat::Json, Self::Muscles(table)) => write_atomic(file, |out| json(out, table))?,
            (TableFormat::Json, Self::Joints(table)) => write_atomic(file, |out| json(out, table))?,
        }
        Ok(())
    }
}

/// How a page of plots is written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PlotFormat {
    /// In pixels, so many a logical pixel.
    Png {
        /// See [`PLOT_SCALE`].
        scale: f64,
    },
    /// Sharp at any size.
    Svg,
}

/// Writes a page of plots to `file` atomically.
///
/// # Errors
/// [`ExportError`] where the file cannot be written, or a plot in pixels cannot be drawn.
pub fn save_page(page: &Page, file: &Output, format: PlotFormat) -> Result<(), ExportError> {
    let drawn = match format {
        PlotFormat::Png { scale } => page.png(scale).map_err(|why| ExportError::Plot { file: file.file().to_owned(), why })?,
        PlotFormat::Svg => page.svg().into_bytes(),
    };
    Ok(write_atomic(file, |out| out.write_all(&drawn))?)
}

fn json(out: &mut impl Write, table: &impl serde::Serialize) -> io::Result<()> {
    let text = serde_json::to_string_pretty(table)?;
    out.write_all(visible::json(&text).as_bytes())?;
    out.write_all(b"\n")
}

/// Times of the clip that `state` names; `None` where it names none.
fn times(document: &Document, state: &PoseState, fps: f64) -> Option<Vec<f64>> {
    let clip = state.clip.and_then(|clip| document.clips.get(clip))?;
    Some(even_times(clip.start, clip.end, fps))
}

/// Why there is no such table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TableError {
    /// No clip moves anything.
    NoClip,
    /// There is no muscle.
    NoMuscle,
    /// There is no joint.
    NoJoint,
    /// There would be more rows than [`limits::TABLE_ROWS`].
    TooLong,
}

impl TableError {
    /// Whether [`MeasureTable::measure`] would refuse, known at once.
    ///
    /// # Errors
    /// Why it would.
    pub fn check(of: TableSubject, document: &Document, state: &PoseState, fps: f64) -> Result<(), Self> {
        let times = times(document, state, fps).map(|times| times.len());
        match (of, times) {
            (TableSubject::Joints, _) if joints::count(document) == 0 => Err(Self::NoJoint),
            (TableSubject::Joints, None) => Err(Self::NoClip),
            (TableSubject::Joints, Some(times)) => Self::hold(joints::count(document), times, Self::NoJoint),
            (TableSubject::Muscles, times) => Self::hold(document.muscle_count(), times.unwrap_or(1), Self::NoMuscle),
        }
    }

    /// Refuses a table of `things` measured at `times` moments that is empty or too long.
    fn hold(things: usize, times: usize, none: Self) -> Result<(), Self> {
        match things.saturating_mul(times) {
            0 => Err(none),
            rows if rows > limits::TABLE_ROWS => Err(Self::TooLong),
            _ => Ok(()),
        }
    }
}

impl ToMessage for TableError {
    fn message(&self) -> Message {
        match self {
            Self::NoClip => message!("table-no-clip"),
            Self::NoMuscle => message!("table-no-muscle"),
            Self::NoJoint => message!("table-no-joint"),
            Self::TooLong => message!("table-too-long", limit = limits::TABLE_ROWS),
        }
    }
}

/// Times from `start` to `end`, both included, `fps` a second.
pub fn even_times(start: f64, end: f64, fps: f64) -> Vec<f64> {
    let steps = ((end - start).max(0.0) * fps + 1e-6).floor().min(limits::TABLE_ROWS as f64) as usize;
    let mut times: Vec<f64> = (0..=steps).map(|step| start + step as f64 / fps).collect();
    if times.last().is_some_and(|last| *last < end - 1e-6) && times.len() <= limits::TABLE_ROWS {
        times.push(end);
    }
    times
}

/// A cell of a CSV file, in quotes where it must be (RFC 4180), on one line and with nothing in it that a terminal would obey.
pub fn csv_cell(text: &str) -> String {
    let text = visible::shown(text);
    if text.contains([',', '"', '\n', '\r']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.into_owned() }
}

/// A number as a cell: a point, every digit, nothing where there is none.
fn csv_number(value: Option<f64>) -> String {
    value.map(|value| value.to_string()).unwrap_or_default()
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
    fn times_hold_both_ends_once() {
        assert_eq!(even_times(0.5, 1.0, 4.0), [0.5, 0.75, 1.0]);
        assert_eq!(even_times(0.0, 1.1, 2.0), [0.0, 0.5, 1.0, 1.1]);
        assert_eq!(even_times(2.0, 2.0, 25.0), [2.0]);
        assert_eq!(even_times(3.0, 2.0, 25.0), [3.0]);
    }
}

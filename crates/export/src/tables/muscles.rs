//! Muscles over elbow angles, contractions, or the time of a clip.

use std::fmt::Write as _;

use serde::Serialize;

use super::{TableError, csv_cell, csv_number};
use sinew_engine::document::{Document, PoseBuffers, PoseState, SourceKind};
use sinew_muscle::{MuscleRig, MuscleSample, Solved};
use sinew_scene::{Frame, MuscleId, OwnedLabel};

/// Default elbow angles.
const ANGLES: [f64; 4] = [0.0, 30.0, 60.0, 90.0];

/// Contractions, per cent, of a muscle that is on no arm.
const CONTRACTIONS: [f64; 5] = [0.0, 25.0, 50.0, 75.0, 100.0];

/// All muscles of a file. The names and their order are a contract; lengths are in `unit`.
#[derive(Debug, Clone, Serialize)]
pub struct MuscleTable {
    /// The file it was measured in.
    pub file: String,
    /// The unit of lengths.
    pub unit: String,
    /// One entry a muscle.
    pub muscles: Vec<MuscleRows>,
}

/// One muscle.
#[derive(Debug, Clone, Serialize)]
pub struct MuscleRows {
    /// Its name.
    pub name: OwnedLabel,
    /// One row an angle or time.
    pub samples: Vec<MuscleRow>,
}

/// One row of a measurement; lengths are in the file's unit.
#[derive(Debug, Clone, Serialize)]
pub struct MuscleRow {
    /// Seconds on the clip's axis, where the measurement is one over time.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub time: Option<f64>,
    /// Degrees; none for a muscle that is on no arm.
    pub angle: Option<f64>,
    /// Length of the muscle without its tendons.
    pub length: f64,
    /// −dL/dφ, φ in radians.
    pub moment_arm: Option<f64>,
    /// Volume of the cones.
    pub volume: f64,
    /// Its difference from the volume at rest, relative.
    pub volume_error: f64,
    /// What the radii grew by, in multiples of their growth.
    pub delta: f64,
    /// Radius of each node.
    pub radii: Vec<f64>,
    /// The largest of them.
    pub largest_radius: f64,
    /// Length from origin to insertion, tendons counted.
    pub path_length: f64,
    /// Whether the length asked for was outside what the muscle can do and was held at the limit.
    pub held: bool,
}

impl MuscleTable {
    /// Measures at elbow angles, at four of them where none are given; a muscle that is on no arm at five contractions. `None` where angles are
    /// given but a muscle has no arm to bend.
    pub fn over_angles(document: &Document, file: String, angles: Option<&[f64]>) -> Option<Self> {
        let muscles = document
            .rigs()
            .flat_map(|(rig, first)| (0..rig.len()).map(move |index| (rig, first, index)))
            .map(|(rig, first, index)| {
                let samples = samples(document, rig, first, index, angles)?;
                Some(MuscleRows { name: rig.label(index).to_owned(), samples })
            })
            .collect::<Option<_>>()?;
        Some(Self { file, unit: unit(document), muscles })
    }

    /// Measures at times of the clip that `state` names, which moves the muscles' bones.
    ///
    /// # Errors
    /// [`TableError`] where there is no clip or no muscle, or there would be too many rows.
    pub fn over_time(document: &Document, file: String, state: &PoseState, times: &[f64]) -> Result<Self, TableError> {
        if state.clip.and_then(|clip| document.clips.get(clip)).is_none() {
            return Err(TableError::NoClip);
        }
        TableError::hold(document.muscle_count(), times.len(), TableError::NoMuscle)?;
        let names = document.rigs().flat_map(|(rig, _)| (0..rig.len()).map(|index| rig.label(index).to_owned()));
        let rows = document.measure_times(state, times);
        let muscles = names.zip(&rows).map(|(name, samples)| MuscleRows { name, samples: samples.iter().map(MuscleRow::of).collect() });
        Ok(Self { file, unit: unit(document), muscles: muscles.collect() })
    }

    /// Whether the rows are those of times.
    pub fn is_over_time(&self) -> bool {
        self.muscles.iter().flat_map(|muscle| &muscle.samples).any(|row| row.time.is_some())
    }

    /// A line a sample. Numbers have a point and every digit.
    pub fn csv(&self) -> String {
        let nodes = self.muscles.iter().flat_map(|muscle| &muscle.samples).map(|row| row.radii.len()).max().unwrap_or(0);
        let timed = self.is_over_time();
        let mut text = String::from(if timed { "muscle,time," } else { "muscle," });
        text.push_str("angle,length,moment_arm,volume,volume_error,delta,largest_radius,path_length,held");
        (1..=nodes).for_each(|node| text.push_str(&format!(",r{node}")));
        text.push('\n');
        for muscle in &self.muscles {
            for row in &muscle.samples {
                let cells = [row.length, row.volume, row.volume_error, row.delta, row.largest_radius, row.path_length]
                    .map(|value| value.to_string());
                let [length, volume, error, delta, largest, path] = cells;
                let (angle, arm) = (csv_number(row.angle), csv_number(row.moment_arm));
                let time = if timed { csv_number(row.time) + "," } else { String::new() };
                // Writing to a string cannot fail.
                let _ = write!(
                    text,
                    "{},{time}{angle},{length},{arm},{volume},{error},{delta},{largest},{path},{}",
                    csv_cell(&muscle.name.to_string()),
                    row.held
                );
                row.radii.iter().for_each(|radius| text.push_str(&format!(",{radius}")));
                text.push('\n');
            }
        }
        text
    }
}

fn samples(document: &Document, rig: &MuscleRig, first: MuscleId, index: usize, angles: Option<&[f64]>) -> Option<Vec<MuscleRow>> {
    if rig.measured_range().is_some() {
        return Some(rig.measure(index, angles.unwrap_or(&ANGLES)).iter().map(MuscleRow::of).collect());
    }
    if angles.is_some() {
        return None;
    }
    let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
    let rows = CONTRACTIONS.iter().filter_map(|contraction| {
        let state = document.start_state().with_drive(rig.at_contraction(*contraction));
        document.pose(&state, &mut buffers, &mut frame);
        buffers.solved().get(first.index() + index).map(|solved| MuscleRow::alone(solved))
    });
    Some(rows.collect())
}

impl MuscleRow {
    /// The row of a sample.
    pub fn of(sample: &MuscleSample) -> Self {
        // `+ 0.0` turns a negative zero into zero.
        let plain = |value: Option<f64>| value.map(|value| value + 0.0);
        Self { time: sample.time, angle: plain(sample.angle), moment_arm: plain(sample.moment_arm), ..Self::alone(&sample.solved) }
    }

    fn alone(solved: &Solved) -> Self {
        Self {
            time: None,
            angle: None,
            length: solved.length,
            moment_arm: None,
            volume: solved.volume,
            volume_error: solved.volume_error + 0.0,
            delta: solved.delta + 0.0,
            radii: solved.radii.clone(),
            largest_radius: solved.largest_radius(),
            path_length: solved.path_length,
            held: solved.held,
        }
    }
}

/// The name of the unit of the muscles' lengths.
pub fn unit(document: &Document) -> String {
    let metres = document.sources.iter().find_map(|source| match &source.kind {
        SourceKind::Muscles(file, _) => Some(file.unit_metres),
        SourceKind::Scene(_) => None,
    });
    unit_name(metres.unwrap_or(1.0))
}

/// The name of a unit that is this many metres long.
pub fn unit_name(metres: f64) -> String {
    let known = [(1e-3, "mm"), (1e-2, "cm"), (1.0, "m"), (0.0254, "in")];
    let found = known.iter().find(|(value, _)| (value - metres).abs() <= 1e-9 * value);
    found.map_or_else(|| format!("{metres} m"), |(_, name)| (*name).to_owned())
}

//! The report's experiment: radii of a model beside measured ones, and what the measured ones say about their own volume.
//!
//! The report compares the growth of each node from 0° to 90° and finds the model's far smaller than the measured. The reason is in the data: the
//! measured radii, at the lengths that the arm has at those angles, imply volumes that differ by half. A model that keeps its volume cannot follow
//! data that do not.
//!
//! [`super::parameter_fit`] asks how near a model that keeps its volume can come.

use std::f64::consts::PI;
use std::ops::Range;

use super::profile::{ProfileError, cone_sum};
use super::{MuscleRig, MuscleSample};
use sinew_scene::message;
use sinew_scene::message::{Message, ToMessage};

pub use super::csv_table::{Table, TableError, TableErrorKind};

/// A model's radii beside a table's.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Comparison {
    /// Angles of the table, degrees.
    pub angles: Vec<f64>,
    /// Lengths of the muscle there.
    pub lengths: Vec<f64>,
    /// The model there, all nodes.
    pub samples: Vec<MuscleSample>,
    /// The nodes that the table speaks of, counted from 0.
    pub nodes: Range<usize>,
    /// The model's radii of the table's nodes: one row a node, one radius an angle.
    pub model: Vec<Vec<f64>>,
    /// The table's.
    pub measured: Vec<Vec<f64>>,
    /// Growth of each node from the first to the last angle: model, measured.
    pub growth: Vec<[f64; 2]>,
    /// Measured growth over the model's, both as the mean size over the nodes.
    pub growth_ratio: f64,
    /// Volume that the table's radii imply at each angle, with the model's own end radii where the table leaves them out.
    pub implied_volumes: Vec<f64>,
    /// Root mean square of model − measured over the nodes at each angle.
    pub rms_at: Vec<f64>,
    /// The same over all nodes and angles.
    pub rms: f64,
}

/// Why a table cannot be held against a muscle.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{}", self.message())]
pub enum CompareError {
    /// The table has another number of rows than the muscle nodes, with or without its two ends.
    Nodes {
        /// Rows of the table.
        rows: usize,
        /// Nodes of the muscle.
        nodes: usize,
    },
    /// The rig has no such muscle, or no joint to turn.
    NoJoint,
    /// Radii that make no muscle.
    Profile(#[from] ProfileError),
}

impl ToMessage for CompareError {
    fn message(&self) -> Message {
        match self {
            Self::Nodes { rows, nodes } => message!("muscle-compare-nodes", rows = rows, nodes = nodes, inner = nodes.saturating_sub(2)),
            Self::NoJoint => message!("muscle-compare-no-joint"),
            Self::Profile(error) => error.message(),
        }
    }
}

/// A table with the lengths at its angles, its rows extended to all nodes of the muscle.
pub(super) struct Data {
    pub lengths: Vec<f64>,
    /// One column an angle, a radius a node.
    pub columns: Vec<Vec<f64>>,
    /// The nodes that the table speaks of.
    pub rows: Range<usize>,
}

impl Data {
    pub(super) fn new(rig: &MuscleRig, index: usize, table: &Table) -> Result<Self, CompareError> {
        let data = Self::resized(rig, index, table)?;
        let (rows, nodes) = (table.radii.len(), rig.profile(index).map_or(0, |profile| profile.radii().len()));
        if data.columns.iter().any(|column| column.len() != nodes) { Err(CompareError::Nodes { rows, nodes }) } else { Ok(data) }
    }

    /// The same for a table of any number of rows: with as many as the muscle has nodes they are all nodes, else all but the two ends.
    pub(super) fn resized(rig: &MuscleRig, index: usize, table: &Table) -> Result<Self, CompareError> {
        let profile =
            rig.profile(index).filter(|_| rig.is_attached(index) && rig.measured_range().is_some()).ok_or(CompareError::NoJoint)?;
        let rows = table.radii.len();
        let ends = usize::from(rows != profile.radii().len());
        let nodes = rows + 2 * ends;
        let lengths = rig.measure(index, &table.angles).iter().map(|sample| sample.solved.length).collect();
        // `nodes` is at least 2, so both ends are there.
        let ends_of = |mut inner: Vec<f64>| {
            if ends == 1 {
                inner.insert(0, profile.radii().first().copied().unwrap_or(0.0));
                inner.push(profile.radii().last().copied().unwrap_or(0.0));
            }
            inner
        };
        let columns = (0..table.angles.len()).map(|angle| ends_of(table.column(angle))).collect();
        Ok(Self { lengths, columns, rows: ends..nodes - ends })
    }

    /// Root mean square of model − table over the table's nodes and all angles.
    pub(super) fn rms(&self, model: &[Vec<f64>]) -> f64 {
        rms(self.rows.clone(), self.columns.iter().zip(model))
    }
}

/// Root mean square of the differences of these pairs of columns over `nodes`.
fn rms<'a>(nodes: Range<usize>, pairs: impl IntoIterator<Item = (&'a Vec<f64>, &'a Vec<f64>)>) -> f64 {
    let differences = pairs.into_iter().flat_map(|(a, b)| nodes.clone().filter_map(|node| Some(a.get(node)? - b.get(node)?)));
    let (count, squares) = differences.fold((0_u32, 0.0), |(count, sum), difference| (count + 1, sum + difference * difference));
    (squares / f64::from(count.max(1))).sqrt()
}

/// Holds muscle `index` against a table of measured radii: all nodes, or all but the two ends.
///
/// # Errors
/// [`CompareError`] where the table does not fit the muscle.
pub fn compare(rig: &MuscleRig, index: usize, table: &Table) -> Result<Comparison, CompareError> {
    let data = Data::new(rig, index, table)?;
    let samples = rig.measure(index, &table.angles);
    let model: Vec<Vec<f64>> = samples.iter().map(|sample| sample.solved.radii.clone()).collect();
    let grown = |columns: &[Vec<f64>], node: usize| {
        let at = |column: Option<&Vec<f64>>| column.and_then(|column| column.get(node)).copied().unwrap_or(0.0);
        at(columns.last()) - at(columns.first())
    };
    let growth: Vec<[f64; 2]> = data.rows.clone().map(|node| [grown(&model, node), grown(&data.columns, node)]).collect();
    let size = |which: usize| growth.iter().filter_map(|pair| pair.get(which)).map(|value| value.abs()).sum::<f64>();
    let by_node = |columns: &[Vec<f64>]| -> Vec<Vec<f64>> {
        data.rows.clone().map(|node| columns.iter().filter_map(|column| column.get(node).copied()).collect()).collect()
    };
    Ok(Comparison {
        angles: table.angles.clone(),
        growth_ratio: if size(0) > 0.0 { size(1) / size(0) } else { f64::INFINITY },
        implied_volumes: data.columns.iter().zip(&data.lengths).map(|(radii, length)| volume(radii, *length)).collect(),
        rms_at: data.columns.iter().zip(&model).map(|(measured, model)| rms(data.rows.clone(), [(measured, model)])).collect(),
        rms: data.rms(&model),
        model: by_node(&model),
        measured: by_node(&data.columns),
        growth,
        samples,
        nodes: data.rows,
        lengths: data.lengths,
    })
}

/// Volume of truncated cones over these radii: π L / (n − 1) · F(r).
pub(super) fn volume(radii: &[f64], length: f64) -> f64 {
    PI * length / radii.len().saturating_sub(1).max(1) as f64 * cone_sum(radii)
}

//! `sinew measure --compare`: the model beside measured radii, in the tables of the report's experiment.
//!
//! The measured radii imply a volume of their own: that of the truncated cones through them, over the length that the muscle has at the same
//! angle. Where those volumes differ from angle to angle, no model that keeps its volume can meet the measurement.

use std::fmt::Write as _;
use std::path::Path;

use serde::Serialize;

use super::measured;
use super::output::{Failure, display_name};
use super::text_table::columns;
use crate::document::Document;
use crate::export::tables::{MuscleRow, csv_cell, unit, unit_label};
use crate::i18n::{self, Sentence, decimal};
use crate::muscle::MuscleRig;
use crate::muscle::parameter_fit::{Fits, fit};
use crate::muscle::validation::{self, CompareError, Table};
use crate::tr;

/// All muscles of a file that the table fits.
#[derive(Debug, Serialize)]
pub(super) struct CompareReport {
    file: String,
    compared_with: String,
    unit: String,
    muscles: Vec<Compared>,
}

/// One muscle beside the table.
#[derive(Debug, Serialize)]
struct Compared {
    name: String,
    samples: Vec<Pair>,
    growth: Growth,
    /// Root of the mean squared difference over all nodes and angles, of three models that keep the volume of the first angle.
    rms: CompareRms,
}

/// Model and measurement at one angle.
#[derive(Debug, Serialize)]
struct Pair {
    #[serde(flatten)]
    model: MuscleRow,
    /// One radius a node of the muscle; none for an end that the table leaves out.
    measured_radii: Vec<Option<f64>>,
    /// Volume of the cones through the measured radii; ends that the table leaves out have the model's.
    measured_volume: f64,
    /// Root of the mean squared difference of the radii.
    rms: f64,
}

/// How much each node of the table grows from the first angle to the last.
#[derive(Debug, Serialize)]
struct Growth {
    from: f64,
    to: f64,
    model: Vec<f64>,
    measured: Vec<f64>,
    /// Mean size of what was measured over that of the model's; none where the model does not grow.
    ratio: Option<f64>,
}

#[derive(Debug, Serialize)]
struct CompareRms {
    own_growth: f64,
    fitted_growth: f64,
    measured_poses: f64,
}

impl CompareReport {
    /// Compares the muscles of `document` with the table in `csv`.
    ///
    /// # Errors
    /// [`Failure::Files`] where the table cannot be read or fits no muscle, [`Failure::Usage`] where there is no arm to bend.
    pub(super) fn of(document: &Document, file: &Path, csv: &Path) -> Result<Self, Failure> {
        let table = measured::read(csv)?;
        let muscles = || document.rigs().flat_map(|(rig, _)| (0..rig.len()).map(move |index| (rig, index)));
        if muscles().all(|(rig, index)| rig.measured_range().is_none() || !rig.is_attached(index)) {
            return Err(Failure::usage(tr!("cli-no-arm-to-compare", file = display_name(file))));
        }
        let (mut compared, mut refused) = (Vec::new(), None);
        for (rig, index) in muscles() {
            match Compared::of(rig, index, &table) {
                Ok(muscle) => compared.push(muscle),
                Err(error) => refused = refused.or(Some(error)),
            }
        }
        match refused.filter(|_| compared.is_empty()) {
            Some(error) => Err(Failure::file(csv, error.sentence())),
            None => Ok(Self { file: display_name(file), compared_with: display_name(csv), unit: unit(document), muscles: compared }),
        }
    }

    /// A line for each muscle, node and angle. Numbers have a point and every digit.
    pub(super) fn csv(&self) -> String {
        let mut text = String::from("muscle,node,angle,model,measured,difference\n");
        for muscle in &self.muscles {
            for pair in &muscle.samples {
                for (node, (model, measured)) in pair.radii().enumerate().map(|(i, radii)| (i + 1, radii)) {
                    let angle = pair.model.angle.unwrap_or_default();
                    // Writing to a string cannot fail.
                    let _ = writeln!(text, "{},{node},{angle},{model},{measured},{}", csv_cell(&muscle.name), model - measured);
                }
            }
        }
        text
    }

    /// Tables for people.
    pub(super) fn text(&self) -> String {
        let mut text = String::new();
        for muscle in &self.muscles {
            if !text.is_empty() {
                text.push('\n');
            }
            let unit = unit_label(&self.unit).sentence();
            let _ = writeln!(text, "{}", tr!("cli-compare-title", name = muscle.name.clone(), unit = unit.clone()));
            text.push_str(&columns(&muscle.rows(&self.unit)));
            let growth = &muscle.growth;
            let (from, to) = (decimal(growth.from, 0), decimal(growth.to, 0));
            let _ = writeln!(text, "\n{}", tr!("cli-compare-growth", from = from.clone(), to = to.clone(), unit = unit.clone()));
            text.push_str(&columns(&growth.rows()));
            if let Some(ratio) = growth.ratio {
                let _ = writeln!(text, "{}", tr!("cli-compare-ratio", from = from, to = to, ratio = decimal(ratio, 1)));
            }
            let volumes = || muscle.samples.iter().map(|pair| pair.measured_volume);
            let (least, most) = (volumes().fold(f64::INFINITY, f64::min), volumes().fold(0.0, f64::max));
            if least > 0.0 && most > least * 1.01 {
                let _ = writeln!(text, "{}", tr!("cli-compare-explained", spread = decimal((most / least - 1.0) * 100.0, 0)));
            }
            text.push_str(&rms_lines(Some(muscle.rms.own_growth), muscle.rms.fitted_growth, muscle.rms.measured_poses, &unit));
        }
        text
    }
}

/// How far each model is from a table, a line each.
pub(super) fn rms_lines(own: Option<f64>, fitted: f64, poses: f64, unit: &str) -> String {
    let mut rows = vec![];
    for (name, rms) in [(tr!("cli-rms-own"), own), (tr!("cli-rms-fitted"), Some(fitted)), (tr!("cli-rms-poses"), Some(poses))] {
        rows.extend(rms.map(|rms| (name, decimal(rms, 2))));
    }
    let width = rows.iter().map(|(name, _)| name.chars().count()).max().unwrap_or(0);
    let mut text = format!("\n{}\n", tr!("cli-rms-title", unit = unit.to_owned()));
    for (name, rms) in rows {
        let _ = writeln!(text, "  {name:<width$}  {rms:>6}");
    }
    text
}

impl Compared {
    fn of(rig: &MuscleRig, index: usize, table: &Table) -> Result<Self, CompareError> {
        let found = validation::compare(rig, index, table)?;
        let Fits { own, fitted, poses, .. } = fit(rig, index, table)?;
        let (from, to) = (found.angles.first().copied().unwrap_or(0.0), found.angles.last().copied().unwrap_or(0.0));
        let volumes = found.implied_volumes.iter().zip(&found.rms_at);
        let pair = |(column, (sample, (volume, rms))): (usize, (_, (&f64, &f64)))| {
            let model = MuscleRow::of(sample, &[]);
            let mut measured_radii = vec![None; model.radii.len()];
            for (slot, row) in measured_radii.iter_mut().skip(found.nodes.start).zip(&found.measured) {
                *slot = row.get(column).copied();
            }
            Pair { model, measured_radii, measured_volume: *volume, rms: *rms }
        };
        Ok(Self {
            name: i18n::label(rig.label(index)).into_owned(),
            samples: found.samples.iter().zip(volumes).enumerate().map(pair).collect(),
            growth: Growth {
                from,
                to,
                model: found.growth.iter().map(|pair| pair[0]).collect(),
                measured: found.growth.iter().map(|pair| pair[1]).collect(),
                ratio: Some(found.growth_ratio).filter(|ratio| ratio.is_finite()),
            },
            rms: CompareRms { own_growth: own, fitted_growth: fitted, measured_poses: poses },
        })
    }

    /// A row a node, model and measurement of each angle side by side, then differences and volumes.
    fn rows(&self, unit: &str) -> Vec<Vec<String>> {
        let mut head = vec![tr!("cli-compare-node")];
        for pair in &self.samples {
            let angle = decimal(pair.model.angle.unwrap_or_default(), 0);
            head.extend([tr!("cli-compare-model", angle = angle), tr!("cli-compare-measured")]);
        }
        let mut rows = vec![head];
        let count = self.samples.first().map_or(0, |pair| pair.radii().count());
        for node in 0..count {
            let mut row = vec![(node + 1).to_string()];
            for (model, measured) in self.samples.iter().filter_map(|pair| pair.radii().nth(node)) {
                row.extend([decimal(model, 1), decimal(measured, 1)]);
            }
            rows.push(row);
        }
        let mut rms = vec![tr!("cli-compare-rms")];
        rms.extend(self.samples.iter().flat_map(|pair| [String::new(), decimal(pair.rms, 2)]));
        // Millilitres say more than cubic millimetres.
        let (scale, name) = if unit == "mm" { (1e-3, tr!("cli-unit-ml")) } else { (1.0, unit_label(unit).sentence() + "³") };
        let mut volumes = vec![tr!("cli-compare-volume", unit = name)];
        volumes.extend(self.samples.iter().flat_map(|pair| [pair.model.volume, pair.measured_volume].map(|v| decimal(v * scale, 0))));
        rows.extend([rms, volumes]);
        rows
    }
}

impl Pair {
    /// Model and measurement of each node that was measured.
    fn radii(&self) -> impl Iterator<Item = (f64, f64)> {
        self.model.radii.iter().zip(&self.measured_radii).filter_map(|(model, measured)| Some((*model, (*measured)?)))
    }
}

impl Growth {
    /// A row a node: model, measurement, and how often the one goes into the other.
    fn rows(&self) -> Vec<Vec<String>> {
        let mut rows =
            vec![vec![tr!("cli-compare-node"), tr!("cli-compare-grown-model"), tr!("cli-compare-measured"), tr!("cli-compare-times")]];
        for (node, (model, measured)) in self.model.iter().zip(&self.measured).enumerate() {
            let times = if model.abs() < 0.005 { "–".to_owned() } else { decimal(measured / model, 1) };
            rows.push(vec![(node + 1).to_string(), decimal(*model, 2), decimal(*measured, 2), times]);
        }
        rows
    }
}

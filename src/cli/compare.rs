//! `sinew measure --compare`: the model beside measured radii.
//!
//! The measured radii imply a volume of their own: that of the truncated cones through them, over the length that the muscle has at the same
//! angle. Where those volumes differ from angle to angle, no model that keeps its volume can meet the measurement.

use std::f64::consts::PI;
use std::fmt::Write as _;
use std::path::Path;

use serde::Serialize;

use super::failure::{Failure, display_name};
use super::measure::{Row, columns, csv_cell, unit, unit_for_people};
use super::measured::{self, Table};
use crate::document::Document;
use crate::i18n::decimal;
use crate::muscle::Rig;
use crate::tr;

/// All muscles of a file that the table fits.
#[derive(Debug, Serialize)]
pub struct Comparison {
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
}

/// Model and measurement at one angle.
#[derive(Debug, Serialize)]
struct Pair {
    #[serde(flatten)]
    model: Row,
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
    /// Sum of what was measured over sum of the model's; none where the model does not grow.
    ratio: Option<f64>,
}

impl Comparison {
    /// Compares the muscles of `document` with the table in `csv`.
    ///
    /// # Errors
    /// [`Failure::Files`] where the table cannot be read or fits no muscle, [`Failure::Usage`] where there is no arm to bend.
    pub fn of(document: &Document, file: &Path, csv: &Path) -> Result<Self, Failure> {
        let table = measured::read(csv)?;
        let muscles = || document.rigs().flat_map(|(rig, _)| (0..rig.len()).map(move |index| (rig, index)));
        if muscles().all(|(rig, _)| rig.measured_range().is_none()) {
            return Err(Failure::usage(tr!("cli-no-arm-to-compare", file = display_name(file))));
        }
        let compared: Vec<_> = muscles().filter_map(|(rig, index)| Compared::of(rig, index, &table)).collect();
        if compared.is_empty() {
            let nodes = muscles().find_map(|(rig, index)| rig.profile(index)).map_or(0, |profile| profile.radii().len());
            let message = tr!("cli-table-fits-none", rows = table.radii.len(), nodes = nodes, inner = nodes.saturating_sub(2));
            return Err(Failure::file(csv, message));
        }
        Ok(Self { file: display_name(file), compared_with: display_name(csv), unit: unit(document), muscles: compared })
    }

    /// A line for each muscle, node and angle. Numbers have a point and every digit.
    pub fn csv(&self) -> String {
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
    pub fn text(&self) -> String {
        let mut text = String::new();
        for muscle in &self.muscles {
            if !text.is_empty() {
                text.push('\n');
            }
            let _ = writeln!(text, "{}", tr!("cli-compare-title", name = muscle.name.clone(), unit = unit_for_people(&self.unit)));
            text.push_str(&columns(&muscle.rows(&self.unit)));
            let growth = &muscle.growth;
            if let Some(ratio) = growth.ratio {
                let (from, to) = (decimal(growth.from, 0), decimal(growth.to, 0));
                let _ = writeln!(text, "{}", tr!("cli-compare-ratio", from = from, to = to, ratio = decimal(ratio, 1)));
            }
            let volumes = || muscle.samples.iter().map(|pair| pair.measured_volume);
            let (least, most) = (volumes().fold(f64::INFINITY, f64::min), volumes().fold(0.0, f64::max));
            if least > 0.0 && most > least * 1.01 {
                let _ = writeln!(text, "{}", tr!("cli-compare-explained", spread = decimal((most / least - 1.0) * 100.0, 0)));
            }
        }
        text
    }
}

impl Compared {
    /// `None` where the table does not fit the muscle or nothing bends it.
    fn of(rig: &Rig, index: usize, table: &Table) -> Option<Self> {
        let nodes = rig.profile(index)?.radii().len();
        rig.measured_range()?;
        let offset = match nodes.checked_sub(table.radii.len())? {
            0 => 0,
            // The ends are tendons; tables leave them out.
            2 => 1,
            _ => return None,
        };
        let samples: Vec<Pair> = rig
            .measure(index, &table.angles)
            .iter()
            .enumerate()
            .map(|(column, sample)| {
                let radii = table.radii.iter().filter_map(|row| row.get(column).copied()).collect();
                Pair::of(Row::at_angle(sample), radii, offset)
            })
            .collect();
        let growth = Growth::of(samples.first()?, samples.last()?);
        Some(Self { name: rig.name(index).to_owned(), samples, growth })
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
        let (scale, name) = if unit == "mm" { (1e-3, tr!("cli-unit-ml")) } else { (1.0, unit_for_people(unit) + "³") };
        let mut volumes = vec![tr!("cli-compare-volume", unit = name)];
        volumes.extend(self.samples.iter().flat_map(|pair| [pair.model.volume, pair.measured_volume].map(|v| decimal(v * scale, 0))));
        rows.extend([rms, volumes]);
        rows
    }
}

impl Pair {
    fn of(model: Row, table: Vec<f64>, offset: usize) -> Self {
        let nodes = model.radii.len();
        let mut measured_radii = vec![None; nodes];
        for (slot, radius) in measured_radii.iter_mut().skip(offset).zip(&table) {
            *slot = Some(*radius);
        }
        let filled: Vec<f64> = measured_radii.iter().zip(&model.radii).map(|(measured, model)| measured.unwrap_or(*model)).collect();
        let measured_volume = cones(&filled, model.length);
        let mut pair = Self { model, measured_radii, measured_volume, rms: 0.0 };
        let squares: Vec<f64> = pair.radii().map(|(model, measured)| (model - measured).powi(2)).collect();
        pair.rms = (squares.iter().sum::<f64>() / squares.len().max(1) as f64).sqrt();
        pair
    }

    /// Model and measurement of each node that was measured.
    fn radii(&self) -> impl Iterator<Item = (f64, f64)> {
        self.model.radii.iter().zip(&self.measured_radii).filter_map(|(model, measured)| Some((*model, (*measured)?)))
    }
}

impl Growth {
    fn of(first: &Pair, last: &Pair) -> Self {
        let grown = first.radii().zip(last.radii());
        let (model, measured): (Vec<f64>, Vec<f64>) = grown.map(|((a, b), (c, d))| (c - a, d - b)).unzip();
        let (of_model, of_measured) = (model.iter().sum::<f64>(), measured.iter().sum::<f64>());
        let angle = |pair: &Pair| pair.model.angle.unwrap_or_default();
        let ratio = (of_model != 0.0).then(|| of_measured / of_model);
        Self { from: angle(first), to: angle(last), model, measured, ratio }
    }
}

/// Volume of the truncated cones through `radii`, at equal spacing over `length`.
fn cones(radii: &[f64], length: f64) -> f64 {
    let spans = radii.len().saturating_sub(1).max(1) as f64;
    let sum: f64 = radii.windows(2).map(|pair| if let [a, b] = pair { (a * a + a * b + b * b) / 3.0 } else { 0.0 }).sum();
    PI * length / spans * sum
}

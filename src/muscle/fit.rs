//! How near models that keep their volume come to measured radii.
//!
//! Three are held against a table, all at the volume that it implies at its first angle, so that what remains is the misfit of shape: the file's own
//! growth multipliers, multipliers fitted by least squares, and the measured shapes themselves, each scaled to the conserved volume and blended over
//! the length ([`ScaledPoses`]).

use super::Rig;
use super::experiment::{CompareError, Data, Table, volume};
use super::profile::{Profile, ProfileError};

/// The measured shapes as a model: at each angle of a table the measured radii, scaled to the volume of the first, between them blended linearly and
/// scaled again, so that the volume is kept at every length.
#[derive(Debug, Clone, PartialEq)]
pub struct ScaledPoses {
    lengths: Vec<f64>,
    shapes: Vec<Vec<f64>>,
    volume: f64,
}

impl ScaledPoses {
    /// From a table, for muscle `index` of a rig.
    ///
    /// # Errors
    /// [`CompareError`] where the table does not fit the muscle or has no volume.
    pub fn new(rig: &Rig, index: usize, table: &Table) -> Result<Self, CompareError> {
        let data = Data::new(rig, index, table)?;
        Self::from_data(&data)
    }

    fn from_data(data: &Data) -> Result<Self, CompareError> {
        let volumes: Vec<f64> = data.columns.iter().zip(&data.lengths).map(|(radii, length)| volume(radii, *length)).collect();
        if volumes.iter().any(|volume| *volume < f64::MIN_POSITIVE) {
            return Err(ProfileError::NoRadius.into());
        }
        Ok(Self { lengths: data.lengths.clone(), shapes: data.columns.clone(), volume: volumes.first().copied().unwrap_or(0.0) })
    }

    /// Radii at a length; beyond the table's lengths the shape of the nearest one.
    pub fn radii(&self, length: f64) -> Vec<f64> {
        let blend = |a: &[f64], b: &[f64], share: f64| a.iter().zip(b).map(|(a, b)| a + (b - a) * share).collect::<Vec<f64>>();
        let between = self.lengths.windows(2).zip(self.shapes.windows(2)).find_map(|(at, shape)| {
            let share = (length - at[0]) / (at[1] - at[0]);
            (0.0..=1.0).contains(&share).then(|| blend(&shape[0], &shape[1], share))
        });
        let nearest = || {
            let far = |at: &f64| (at - length).abs();
            let best = self.lengths.iter().zip(&self.shapes).min_by(|a, b| far(a.0).total_cmp(&far(b.0)));
            best.map(|(_, shape)| shape.clone()).unwrap_or_default()
        };
        let shape = between.unwrap_or_else(nearest);
        let scale = (self.volume / volume(&shape, length)).sqrt();
        shape.into_iter().map(|radius| radius * scale).collect()
    }
}

/// How well each model follows a table, all at the volume of its first angle; root mean squares over all nodes and angles.
#[derive(Debug, Clone, PartialEq)]
pub struct Fits {
    /// The file's own growth multipliers.
    pub own: f64,
    /// Multipliers fitted by least squares.
    pub fitted: f64,
    /// Those multipliers, one a node, the largest of size 1.
    pub growth: Vec<f64>,
    /// The measured shapes scaled to the conserved volume.
    pub poses: f64,
}

/// Fits growth multipliers to a table and holds all three models against it.
///
/// # Errors
/// [`CompareError`] where the table does not fit the muscle.
pub fn fit(rig: &Rig, index: usize, table: &Table) -> Result<Fits, CompareError> {
    let data = Data::new(rig, index, table)?;
    let profile = rig.profile(index).ok_or(CompareError::NoJoint)?;
    let solve = |profile: &Profile| -> Vec<Vec<f64>> { data.lengths.iter().map(|length| profile.solve(*length).radii).collect() };
    let growth = fit_growth(&data)?;
    let (Some(first), Some(length)) = (data.columns.first(), data.lengths.first()) else { return Err(CompareError::NoJoint) };
    let fitted = Profile::new(first.clone(), growth.clone(), *length)?;
    let poses = ScaledPoses::from_data(&data)?;
    let scaled: Vec<Vec<f64>> = data.lengths.iter().map(|length| poses.radii(*length)).collect();
    Ok(Fits { own: data.rms(&solve(profile)), fitted: data.rms(&solve(&fitted)), growth, poses: data.rms(&scaled) })
}

/// Growth multipliers that follow the data best under conserved volume: the sum `E` of the squared misfits over nodes and angles is least.
///
/// The radii are `r₀ + m δ`, where `δ` follows from `m` through the volume: with `g = ∂F/∂r` at the grown radii, `∂δ/∂mᵢ = −δ gᵢ / Σ gⱼ mⱼ`. That
/// gives the gradient of `E` exactly, and a descent with steps after Barzilai and Borwein, halved until `E` falls, goes to its minimum. Only the
/// direction of `m` matters, since a common factor goes into `δ`; it is given with a largest multiplier of size 1.
fn fit_growth(data: &Data) -> Result<Vec<f64>, CompareError> {
    const ROUNDS: usize = 2000;
    let (Some(first), Some(length)) = (data.columns.first(), data.lengths.first()) else { return Err(CompareError::NoJoint) };
    let last = data.columns.last().unwrap_or(first);
    // The start: the growth that the table itself shows.
    let mut growth: Vec<f64> = last.iter().zip(first).map(|(last, first)| last - first).collect();
    if growth.iter().all(|m| *m == 0.0) {
        growth.fill(1.0);
    }
    let mut here = Misfit::new(data, first, *length, growth)?;
    let mut step = 1e-3 / here.gradient.iter().map(|g| g * g).sum::<f64>().sqrt().max(f64::MIN_POSITIVE);
    for _ in 0..ROUNDS {
        let next = (0..40).find_map(|halving| {
            let shorter = step * 0.5_f64.powi(halving);
            let moved = here.growth.iter().zip(&here.gradient).map(|(m, g)| m - shorter * g).collect();
            Misfit::new(data, first, *length, moved).ok().filter(|next| next.error < here.error)
        });
        let Some(next) = next else { break };
        let (mut moved, mut turned) = (0.0, 0.0);
        for node in 0..here.growth.len() {
            let by = next.growth[node] - here.growth[node];
            moved += by * by;
            turned += by * (next.gradient[node] - here.gradient[node]);
        }
        step = if turned > 0.0 { moved / turned } else { 2.0 * step };
        here = next;
    }
    Ok(here.growth)
}

/// The misfit of one choice of multipliers. All lists have one entry a node.
struct Misfit {
    growth: Vec<f64>,
    error: f64,
    gradient: Vec<f64>,
}

impl Misfit {
    fn new(data: &Data, first: &[f64], length: f64, growth: Vec<f64>) -> Result<Self, ProfileError> {
        let largest = growth.iter().fold(0.0_f64, |most, m| most.max(m.abs()));
        let growth: Vec<f64> = growth.into_iter().map(|m| m / largest).collect();
        let profile = Profile::new(first.to_vec(), growth.clone(), length)?;
        let (mut error, mut gradient) = (0.0, vec![0.0; growth.len()]);
        for (measured, length) in data.columns.iter().zip(&data.lengths) {
            let solved = profile.solve(*length);
            // Nodes that the table leaves out keep their radius and don't count.
            let misfit_at =
                |(node, (model, measured)): (usize, (&f64, &f64))| if data.rows.contains(&node) { model - measured } else { 0.0 };
            let misfit: Vec<f64> = solved.radii.iter().zip(measured).enumerate().map(misfit_at).collect();
            let slope = cone_slope(&solved.radii);
            let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
            let along = dot(&slope, &growth);
            // All nodes together, through δ; at a limit of the length δ no longer follows.
            let through = if along == 0.0 || solved.held { 0.0 } else { -solved.delta * dot(&misfit, &growth) / along };
            error += dot(&misfit, &misfit);
            for ((sum, misfit), slope) in gradient.iter_mut().zip(&misfit).zip(&slope) {
                *sum += 2.0 * (misfit * solved.delta + through * slope);
            }
        }
        for (node, sum) in gradient.iter_mut().enumerate() {
            if !data.rows.contains(&node) {
                *sum = 0.0;
            }
        }
        Ok(Self { growth, error, gradient })
    }
}

/// ∂F/∂rᵢ: (2 rᵢ + rᵢ₊₁) / 3 from the cone on one side, (rᵢ₋₁ + 2 rᵢ) / 3 from that on the other.
fn cone_slope(radii: &[f64]) -> Vec<f64> {
    let mut slope = vec![0.0; radii.len()];
    for (node, pair) in radii.windows(2).enumerate() {
        if let ([a, b], [slope_a, slope_b, ..]) = (pair, &mut slope[node..]) {
            *slope_a += (2.0 * a + b) / 3.0;
            *slope_b += (a + 2.0 * b) / 3.0;
        }
    }
    slope
}

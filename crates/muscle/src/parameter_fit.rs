//! How near models that keep their volume come to measured radii.
//!
//! Three are held against a table, all at the volume that it implies at its first angle, so that what remains is the misfit of shape: the file's own
//! growth multipliers, multipliers fitted by least squares, and the measured shapes themselves, each scaled to the conserved volume and blended over
//! the length (`muscle::poses`).

use super::MuscleRig;
use super::config::{Form, MuscleFile, MuscleSpec, PoseAt, PoseSpec};
use super::measured_shapes::Pose;
use super::profile::{Profile, ProfileError};
use super::validation::{CompareError, Data, Table};

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
pub fn fit(rig: &MuscleRig, index: usize, table: &Table) -> Result<Fits, CompareError> {
    let data = Data::new(rig, index, table)?;
    let profile = rig.profile(index).ok_or(CompareError::NoJoint)?;
    let fitted = fitted_profile(&data)?;
    let poses = posed_profile(&data)?;
    Ok(Fits { own: misfit(&data, profile), fitted: misfit(&data, &fitted), growth: fitted.growth().to_vec(), poses: misfit(&data, &poses) })
}

/// Which model [`fitted_file`] makes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Model {
    /// Growth multipliers.
    #[default]
    Growth,
    /// Measured poses.
    Poses,
}

/// A muscle file fitted to a table.
#[derive(Debug, Clone, PartialEq)]
pub struct Fitted {
    /// The file: arm, ends and all else as they were, muscle `index` fitted.
    pub file: MuscleFile,
    /// Root mean square of the file's own model − table; `None` where the table has another number of nodes.
    pub own: Option<f64>,
    /// Of the fitted multipliers.
    pub growth: f64,
    /// Of the measured poses.
    pub poses: f64,
}

/// Fits muscle `index` of `file`, which stands in the scene as `rig`, to a table. Its volume becomes the one that the table implies at its first
/// angle. A table with another number of nodes than the muscle gives all but the two ends, which keep their radius.
///
/// # Errors
/// [`CompareError`] where nothing turns the muscle, or the table makes no muscle.
pub fn fitted_file(file: &MuscleFile, rig: &MuscleRig, index: usize, table: &Table, model: Model) -> Result<Fitted, CompareError> {
    let data = Data::resized(rig, index, table)?;
    let profile = rig.profile(index).ok_or(CompareError::NoJoint)?;
    let (growth, poses) = (fitted_profile(&data)?, posed_profile(&data)?);
    let fits_own = data.columns.iter().all(|column| column.len() == profile.radii().len());
    let mut file = MuscleFile { form: Form::Rich, ..file.clone() };
    let muscle = file.muscles.get_mut(index).ok_or(CompareError::NoJoint)?;
    let own = fits_own.then(|| misfit(&data, profile));
    let misfits = (misfit(&data, &growth), misfit(&data, &poses));
    muscle.poses.clear();
    match model {
        Model::Growth => muscle.profile = growth,
        Model::Poses => {
            muscle.poses = table
                .angles
                .iter()
                .zip(&data.columns)
                .map(|(angle, radii)| PoseSpec { at: PoseAt::Angle(*angle), radii: radii.clone() })
                .collect();
            muscle.profile = MuscleSpec::posed(&muscle.poses, poses.rest_length(), |_| None)?;
        }
    }
    Ok(Fitted { file, own, growth: misfits.0, poses: misfits.1 })
}

/// Root mean square of a profile − data over all nodes of the table and all angles.
fn misfit(data: &Data, profile: &Profile) -> f64 {
    let radii: Vec<Vec<f64>> = data.lengths.iter().map(|length| profile.solve(*length).radii).collect();
    data.rms(&radii)
}

fn fitted_profile(data: &Data) -> Result<Profile, CompareError> {
    let growth = fit_growth(data)?;
    let (Some(first), Some(length)) = (data.columns.first(), data.lengths.first()) else { return Err(CompareError::NoJoint) };
    Ok(Profile::new(first.clone(), growth, *length)?)
}

fn posed_profile(data: &Data) -> Result<Profile, CompareError> {
    let poses = data.lengths.iter().zip(&data.columns).map(|(length, radii)| Pose { length: *length, radii: radii.clone() });
    let length = data.lengths.first().copied().unwrap_or(0.0);
    Ok(Profile::of_poses(poses.collect(), length)?)
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

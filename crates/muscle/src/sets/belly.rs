//! The shape of a muscle of a set: its volume from the model, its length from the figure.
//!
//! A model gives the greatest force F, the optimal length of the fibres l and the slack length of the tendon. The physiological cross-section is F over the
//! specific tension σ, so the volume is V = F / σ · l; σ is 45 N/cm², as in Holzbaur et al. 2005 (Arm26). What the tendon leaves of the unit's length is
//! the belly. Fibres of pennate muscles are shorter than their belly, along which they follow one another; there the belly is lengthened, and the tendon
//! shortened, until the belly is as slender as bellies are.

use super::bone_space::STEPS;
use super::data::MuscleData;
use crate::config::{MuscleSpec, Tendon};
use crate::profile::{Profile, ProfileError};

/// Specific tension, newtons a square metre.
pub const SPECIFIC_TENSION: f64 = 45e4;
/// Most that the thickest radius of a belly is, as a share of its length.
const SLENDER: f64 = 0.11;
/// Nodes of a belly.
const NODES: usize = 11;
/// Radius at the ends of a belly as a share of the thickest.
const ENDS: f64 = 0.22;
/// Growth multiplier at the middle; 0 at the ends.
const GROWTH: f64 = 2.0;

/// The belly and tendons of a muscle whose unit is `unit` long on the figure; `scale` is the figure's length over the model's. All lengths are multiplied by `per_metre`.
pub(super) fn shape(data: &MuscleData, unit: f64, scale: f64, per_metre: f64) -> Result<MuscleSpec, ProfileError> {
    let volume = data.force / SPECIFIC_TENSION * data.fiber * scale.powi(3);
    let outline: Vec<f64> = (0..NODES).map(|node| ENDS + (1.0 - ENDS) * wave(node)).collect();
    let growth: Vec<f64> = (0..NODES).map(|node| rounded(GROWTH * wave(node))).collect();
    // The volume of a belly of thickest radius 1 and length 1.
    let unit_volume = Profile::new(outline.clone(), growth.clone(), 1.0)?.volume();
    let slender = (volume / (unit_volume * SLENDER * SLENDER)).cbrt();
    let most = data.belly_end * unit;
    let length = (unit - data.tendon * scale).max(slender).min(most);
    let radius = (volume / (unit_volume * length)).sqrt();
    let radii = outline.iter().map(|share| rounded(share * radius * per_metre)).collect();
    let at_origin = (data.origin_tendon * (unit - length)).min(most - length);
    let tendon = |length: f64| Tendon { length: rounded(length * per_metre), radius: rounded(0.8 * ENDS * radius * per_metre) };
    let spec = MuscleSpec::new(Profile::new(radii, growth, rounded(length * per_metre))?);
    Ok(MuscleSpec { tendons: [tendon(at_origin), tendon(unit - length - at_origin)], ..spec })
}

/// Numbers in a file have so many decimals, far finer than anything that can be seen, so that the same file comes from every machine.
fn rounded(value: f64) -> f64 {
    (value * STEPS).round() / STEPS
}

/// Half a wave over the nodes.
fn wave(node: usize) -> f64 {
    // The wave of the last node would miss 0 by a rounding.
    let from_end = node.min(NODES - 1 - node);
    (std::f64::consts::PI * from_end as f64 / (NODES - 1) as f64).sin()
}

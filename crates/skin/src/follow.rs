//! What one point of a skin follows: which cross-sections it has to clear, and how fully.

use glam::Vec3;

use crate::clearance::{Pair, lack_over};
use crate::section::MuscleTissue;
use crate::soft::{positive_part, smooth_step};
use crate::station::{Station, Stations};

/// Cross-sections farther along the muscle than this from a point at rest are not the point's to clear, metres.
const ALONG: f32 = 0.06;
/// Penalties set in over this distance, metres.
const SET_IN: f32 = 0.01;
/// A cross-section with a larger penalty is left out, metres.
const LEFT_OUT: f32 = 0.045;
/// Penalty of skin that faces the muscle: that of the other leg, metres.
const FACING: f32 = 0.06;
/// Added to the layer of tissue, so that chords of a coarse skin and rounding do not show the muscle, metres.
const SPARE: f32 = 0.001;
/// Share of the reach up to which skin follows in full.
const IN_FULL: f32 = 0.5;

/// A point that at rest lacks more than this to clear a cross-section and its layer, though it is outside of the muscle, does not lie over it, metres.
const NOT_OVER: f32 = 0.008;

/// A point among the muscles at rest.
#[derive(Debug, Clone, Default)]
pub(crate) struct Following {
    /// How fully it follows, 0 to 1.
    pub(crate) weight: f32,
    /// Elasticity of the skin over the muscles that it follows.
    pub(crate) elasticity: f32,
    pub(crate) pairs: Vec<Pair>,
}

/// What the point at `position`, whose normal is `normal` (outward, of length 1) and whose edges have the length `edge`, follows of `muscles`.
pub(crate) fn following(position: Vec3, normal: Vec3, edge: f32, among: &[usize], muscles: &[MuscleTissue], rest: &Stations) -> Following {
    let (mut following, mut apart) = (Following::default(), 1.0);
    let mut sum = 0.0;
    for index in among {
        let Some(muscle) = muscles.get(*index) else { continue };
        let own = rest.list.get(muscle.sections.clone()).unwrap_or(&[]);
        let reach = muscle.layer.reach as f32;
        let distance = own.iter().map(|station| surface_distance(station, position)).fold(f32::INFINITY, f32::min);
        let share = if reach > 0.0 { distance / reach } else { 1.0 };
        let weight = 1.0 - smooth_step((share - IN_FULL) / (1.0 - IN_FULL));
        if weight <= 0.0 {
            continue;
        }
        apart *= 1.0 - weight;
        sum += weight;
        following.elasticity += weight * muscle.layer.elasticity as f32;
        let layer = muscle.layer.fat as f32 + SPARE;
        for (number, station) in own.iter().enumerate() {
            let (lacks, _) = lack_over(station, position, edge, layer, rest.scale as f32);
            // What is in doubt at rest is so in every pose, and says nothing of where the point lies.
            let penalty =
                penalty(station, position, normal) + station.doubt + 3.0 * positive_part(lacks + station.doubt - NOT_OVER, SET_IN);
            if penalty < LEFT_OUT {
                following.pairs.push(Pair { station: (muscle.sections.start + number) as u32, layer, penalty });
            }
        }
    }
    following.weight = 1.0 - apart;
    following.elasticity /= if sum > 0.0 { sum } else { 1.0 };
    following
}

/// Distance from a point to the surface round a station; 0 inside.
fn surface_distance(station: &Station, point: Vec3) -> f32 {
    let offset = point - station.center;
    let along = offset.dot(station.along).clamp(-station.half, station.half);
    ((offset - station.along * along).length() - station.height.max(station.across)).max(0.0)
}

/// By how much less a point at rest has to clear a cross-section because it lies elsewhere, metres.
fn penalty(station: &Station, position: Vec3, normal: Vec3) -> f32 {
    let offset = position - station.center;
    let (along, height) = (offset.dot(station.along), offset.dot(station.outward));
    let away = 3.0 * positive_part(along.abs() - station.half - ALONG, SET_IN);
    // On the flanks of the muscle a little, on the other side of the bone for good.
    let flank = 1.5 * positive_part(-height, 0.5 * SET_IN);
    let behind = 3.0 * positive_part(-height - station.depth, SET_IN);
    let beside = offset - station.along * along;
    let apart = beside.length();
    let facing = normal.dot(beside) / (apart + 0.5 * SET_IN);
    away + flank + behind + FACING * smooth_step((0.1 - facing) / 0.5)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::section::SkinLayer;

    fn rest() -> (Vec<MuscleTissue>, Stations) {
        let station = |index: i32| Station {
            center: Vec3::new(0.0, 0.01 * index as f32, 0.02),
            along: Vec3::Y,
            outward: Vec3::Z,
            height: 0.012,
            across: 0.012,
            half: 0.005,
            depth: 0.02,
            belly: true,
            doubt: 0.0,
        };
        let muscles = vec![MuscleTissue { sections: 0..25, bones: vec![0], layer: SkinLayer::default() }];
        let mut stations = Stations::default();
        (stations.list, stations.scale) = ((-12..=12).map(station).collect(), 1.0);
        (muscles, stations)
    }

    #[test]
    fn skin_over_the_muscle_follows_and_skin_elsewhere_does_not() {
        let (muscles, rest) = rest();
        let at = |x: f32, z: f32, normal: Vec3| following(Vec3::new(x, 0.0, z), normal, 0.005, &[0], &muscles, &rest);
        let over = at(0.0, 0.04, Vec3::Z);
        assert!(over.weight > 0.999 && over.elasticity == 0.5);
        assert!(over.pairs.iter().any(|pair| (pair.layer - 0.004).abs() < 1e-6 && pair.penalty == 0.0));
        // From 60 mm to either side on there are no cross-sections.
        assert!((12..=17).contains(&over.pairs.len()), "{}", over.pairs.len());
        let behind = at(0.0, -0.02, Vec3::NEG_Z);
        assert!(behind.pairs.is_empty() && behind.weight > 0.0);
        // The other leg's inner side looks at the muscle.
        assert!(at(0.0, 0.05, Vec3::NEG_Z).pairs.is_empty());
        assert_eq!(at(0.0, 0.09, Vec3::Z).weight, 0.0);
    }
}

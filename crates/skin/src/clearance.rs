//! How far a point of the skin lacks to lie outside of the muscles beneath it.
//!
//! For a cross-section with centre `c`, line `t`, outward direction `e`, half axes `h` along `e` and `w` square to it, and a point at `d` from its centre,
//! `s = d·e` is the point's height, `b` how far it is sideways, `a` how far it is beyond the cross-section along the line, and `q² = b² + a²`. The point
//! lacks `tent(q) − s`. The tent is the ellipse `h √(1 − q²/k²)` down to a slope of 45°, where `k` is the half axis in the point's direction,
//! `q²/k² = b²/w² + a²/h²`, and the tangent there beyond it: a skin of straight edges that touches the tent does not cut into the ellipse. Of all
//! cross-sections the smoothed largest counts.

use glam::Vec3;

use crate::soft::{positive_part, smooth_step};
use crate::station::Station;

/// τ of the smoothed largest value `τ ln Σ exp(x/τ)`, metres.
const SMOOTHED: f32 = 0.0005;
/// A value this much below the largest counts for nothing, times τ.
const FORGOTTEN: f32 = 16.0;
/// Longer edges are taken to be this long, metres: a skin so coarse shows no tendons.
const LONGEST: f32 = 0.03;
/// The height of a tent is at most so many times the longer half axis: √2, rounded up.
const SLOPE: f32 = 1.4143;
/// The directions of cross-sections whose values are less than this below the largest are blended, metres.
const BLENDED: f32 = 0.008;
/// A cross-section is thick from this half axis on, in full from twice that, metres.
const THICK: f32 = 0.006;
/// Tangent of the angle by which skin moves to the side beside a thick cross-section.
const TILT: f32 = 0.5;
/// Where the mean of blended directions is shorter than this, they do not agree.
const AGREED: f32 = 0.7;
/// Points deeper than this below a cross-section belong to another side of the limb, metres.
const DEEP: f32 = 0.022;
/// Over this distance penalties set in, metres.
const SET_IN: f32 = 0.01;
/// What a point lacks is not told apart below minus this, metres.
const NO_MATTER: f32 = 0.01;
/// A point this far outside of a cross-section and its layer of tissue may be moved freely, metres.
const FREE: f32 = 0.008;
/// How many times the length of an edge its chord is taken to cut off over a thin part.
const CHORD: f32 = 1.5;

/// A cross-section that a point has to clear.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pair {
    pub(crate) station: u32,
    /// The layer of tissue that lies between, metres.
    pub(crate) layer: f32,
    /// By how much less the point has to clear it because it lies elsewhere at rest, metres.
    pub(crate) penalty: f32,
}

/// What a point lacks, and where to.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Lack {
    /// Metres; negative where there is room, and not below a centimetre.
    pub(crate) amount: f32,
    /// Of length 1 where [`Lack::amount`] is not far below 0, shorter where the muscle pushes to several sides.
    pub(crate) outward: Vec3,
    /// How freely it may be moved otherwise: 1 where it is far from every cross-section, 0 where it touches the layer of tissue over one.
    pub(crate) room: f32,
}

/// The height of the tent at a distance from its middle, of an ellipse of this height whose other half axis has this square.
fn tent(q: f32, height: f32, across_squared: f32) -> f32 {
    let top = (height * height + across_squared).sqrt();
    if q * top < across_squared { height * (1.0 - q * q / across_squared).sqrt() } else { top - q }
}

/// How far a point lacks to clear one cross-section, without layer and penalty, and how far it is outside of it along the ray from its centre. `edge` is the
/// length of the skin's edges there.
///
/// Where neither can matter, both are infinite.
pub(crate) fn lack_over(station: &Station, point: Vec3, edge: f32, layer: f32, scale: f32) -> (f32, f32) {
    let offset = point - station.center;
    let (along, height) = (offset.dot(station.along), offset.dot(station.outward));
    let sideways = (offset.length_squared() - along * along - height * height).max(0.0);
    let beyond = positive_part(along.abs() - 0.6 * station.half, 0.8 * station.half).powi(2);
    let (tall, wide) = (station.height * station.height, station.across * station.across);
    // Above the plane through the middle a point lacks at most the top of the tent less its distance.
    let chord = CHORD * edge.min(LONGEST * scale);
    let most = SLOPE * station.height.max(station.across) + chord + (layer + NO_MATTER) * scale;
    if height > 0.0 && height * height + sideways + beyond > most * most {
        return (f32::NEG_INFINITY, f32::INFINITY);
    }
    // Straight above the middle every direction is as good as another.
    let least = 1e-4 * tall;
    let across = (sideways + beyond + least) / (sideways / wide + (beyond + least) / tall);
    let q = (sideways + beyond).sqrt();
    let thin = smooth_step((edge / station.height - 0.25) / 0.75);
    let q = if thin > 0.0 { positive_part(q - chord * thin, 0.002 * scale) } else { q };
    let deep = if height < -DEEP * scale { 1.5 * positive_part(-height - DEEP * scale, SET_IN * scale) } else { 0.0 };
    let ratio = (height * height / tall + sideways / wide + beyond / tall + 1e-6).sqrt();
    let outside = (height * height + sideways + beyond).sqrt() * (1.0 - 1.0 / ratio);
    (tent(q, station.height, across) - height - deep - station.doubt, outside)
}

/// Where a point moves to clear a cross-section: outward, and beside a thick belly a little to its side.
fn direction(station: &Station, point: Vec3, scale: f32) -> Vec3 {
    let offset = point - station.center;
    let beside = offset - station.along * offset.dot(station.along) - station.outward * offset.dot(station.outward);
    let apart = beside.length();
    let thick = smooth_step(station.height / (THICK * scale) - 1.0);
    let tilt = TILT * smooth_step(2.0 * apart / station.across - 1.0) * thick;
    if tilt > 0.0 { (station.outward + beside * (tilt / apart)).normalize_or_zero() } else { station.outward }
}

/// How far a point lacks to clear all of its cross-sections. `values` is working memory.
pub(crate) fn lack(stations: &[Station], pairs: &[Pair], point: Vec3, edge: f32, scale: f32, values: &mut Vec<f32>) -> Lack {
    let tau = SMOOTHED * scale;
    values.clear();
    let (mut most, mut room) = (f32::NEG_INFINITY, 1.0);
    for pair in pairs {
        let Some(station) = stations.get(pair.station as usize) else { continue };
        let (lacking, outside) = lack_over(station, point, edge, pair.layer, scale);
        let value = lacking + (pair.layer - pair.penalty) * scale;
        room *= smooth_step((outside - pair.layer * scale) / (FREE * scale));
        most = most.max(value);
        values.push(value);
    }
    // The sum adds at most τ ln n: beyond that nobody asks for the exact value.
    if most + tau * (pairs.len() as f32).ln() < -NO_MATTER * scale || !most.is_finite() {
        return Lack { amount: -NO_MATTER * scale, outward: Vec3::ZERO, room };
    }
    let sum: f32 = values.iter().map(|value| (value - most) / tau).filter(|below| *below > -FORGOTTEN).map(f32::exp).sum();
    let amount = (most + tau * sum.ln()).max(-NO_MATTER * scale);
    let (mut weights, mut outward) = (0.0, Vec3::ZERO);
    for (pair, value) in pairs.iter().zip(values.iter()) {
        let weight = 1.0 - (amount - value) / (BLENDED * scale);
        if weight > 0.0
            && let Some(station) = stations.get(pair.station as usize)
        {
            weights += weight * weight;
            outward += direction(station, point, scale) * (weight * weight);
        }
    }
    // Between parts of a muscle that push to opposite sides, as in a fold, a point goes neither way.
    let agreed = outward.length() / weights.max(f32::MIN_POSITIVE);
    Lack { amount, outward: outward.normalize_or_zero() * smooth_step(agreed / AGREED), room }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn station(y: f32) -> Station {
        Station {
            center: Vec3::Y * y,
            along: Vec3::Y,
            outward: Vec3::Z,
            height: 0.02,
            across: 0.02,
            half: 0.005,
            depth: 0.03,
            belly: true,
            doubt: 0.0,
        }
    }

    fn row() -> (Vec<Station>, Vec<Pair>) {
        let stations: Vec<Station> = (-6..=6).map(|step| station(0.01 * step as f32)).collect();
        let pairs = (0..stations.len() as u32).map(|station| Pair { station, layer: 0.0, penalty: 0.0 }).collect();
        (stations, pairs)
    }

    #[test]
    fn a_point_that_was_moved_by_what_it_lacks_is_outside_of_a_cylinder() {
        let (stations, pairs) = row();
        for (x, y, z) in [(0.0, 0.0, 0.0), (0.01, 0.013, 0.004), (-0.014, -0.02, 0.01), (0.018, 0.004, 0.001), (0.0, 0.037, 0.019)] {
            let point = Vec3::new(x, y, z);
            let lack = lack(&stations, &pairs, point, 0.004, 1.0, &mut Vec::new());
            let moved = point + lack.outward * lack.amount;
            let radius = moved.x.hypot(moved.z);
            assert!(radius > 0.02 - 1e-6 && lack.amount < 0.0265, "{point}: {} {radius}", lack.amount);
        }
    }

    #[test]
    fn a_point_with_room_lacks_less_than_nothing_and_scale_changes_nothing() {
        let (stations, pairs) = row();
        let high = lack(&stations, &pairs, Vec3::new(0.0, 0.003, 0.026), 0.004, 1.0, &mut Vec::new());
        assert!((high.amount + 0.006).abs() < 0.001, "{}", high.amount);
        let large: Vec<Station> = stations
            .iter()
            .map(|s| Station { center: s.center * 8.0, height: 0.16, across: 0.16, half: 0.04, depth: 0.24, ..*s })
            .collect();
        let scaled = lack(&large, &pairs, Vec3::new(0.0, 0.024, 0.208), 0.032, 8.0, &mut Vec::new());
        assert!((scaled.amount - 8.0 * high.amount).abs() < 1e-6);
        assert_eq!(lack(&stations, &[], Vec3::ZERO, 0.004, 1.0, &mut Vec::new()).outward, Vec3::ZERO);
        assert!(lack(&stations, &pairs, Vec3::Z * 9.0, 0.004, 1.0, &mut Vec::new()).amount <= -NO_MATTER);
    }

    #[test]
    fn what_a_point_lacks_has_no_jump_in_its_slope() {
        let (stations, pairs) = row();
        let at = |x: f32, y: f32, z: f32| lack(&stations, &pairs, Vec3::new(x, y, z), 0.004, 1.0, &mut Vec::new()).amount;
        let bend = |h: f32| {
            let mut most = 0.0f32;
            for step in 0..400 {
                let x = -0.04 + 0.0002 * step as f32;
                let along = |step: f32| at(0.007, x + step, 0.01);
                let across = |step: f32| at(x + step, 0.3 * x, 0.01);
                for line in [&along as &dyn Fn(f32) -> f32, &across] {
                    // What has more room than is told apart has a constant amount.
                    if line(0.0) > -0.9 * NO_MATTER {
                        most = most.max((line(h) - 2.0 * line(0.0) + line(-h)).abs());
                    }
                }
            }
            most
        };
        // Of a kink the second difference would halve with the step, of a smooth function it is a quarter.
        assert!(bend(2e-4) < 0.32 * bend(4e-4), "{} {}", bend(2e-4), bend(4e-4));
    }
}

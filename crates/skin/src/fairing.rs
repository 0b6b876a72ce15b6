//! Skin beside a bulge is drawn along: displacements pass to their neighbours, never back.
//!
//! In the crook of a joint a skeleton crushes the skin until triangles have next to no width; what moves one end of a crushed edge moves the other too, or the
//! triangle would be turned over.

use glam::Vec3;
use rustc_hash::FxHashMap;

use crate::lists::Lists;
use crate::soft::smooth_step;

/// How often displacements pass to neighbours.
const STEPS: usize = 3;
/// How often those of crushed points do after that.
const CRUSHED_STEPS: usize = 12;
/// An edge of obtuse triangles counts this much at least, so that no point is without neighbours.
const LEAST_WEIGHT: f32 = 0.05;
/// An edge that is crushed counts up to 1 over this as much as one of its length at rest.
const CRUSHED: f32 = 0.01;
/// Over this much displacement it sets in, metres.
const SET_IN: f32 = 0.001;

/// An edge from a point to one beside it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Edge {
    /// The point at its other end.
    pub(crate) point: u32,
    /// Its cotangent weight; those of a point add up to 1.
    pub(crate) weight: f32,
    /// The square of its length at rest, m².
    rest_squared: f32,
}

/// The edges of each point that moves.
pub(crate) type Neighbours = Lists<Edge>;

/// The points beside each of the first `count` points, with the cotangent weights of the edges between them; those of a point add up to 1.
///
/// Pinkall & Polthier 1993, "Computing discrete minimal surfaces and their conjugates".
pub(crate) fn cotangents(places: &[Vec3], triangles: &[[u32; 3]], count: usize) -> Neighbours {
    let mut weights: FxHashMap<(u32, u32), f32> = FxHashMap::default();
    for &[a, b, c] in triangles {
        for (a, b, c) in [(a, b, c), (b, c, a), (c, a, b)] {
            let [Some(p), Some(q), Some(r)] = [a, b, c].map(|point| places.get(point as usize)) else { continue };
            let (one, other) = (*p - *r, *q - *r);
            let cotangent = 0.5 * one.dot(other) / one.cross(other).length().max(f32::MIN_POSITIVE);
            let cotangent = if cotangent.is_finite() { cotangent } else { 0.0 };
            *weights.entry((a, b)).or_default() += cotangent;
            *weights.entry((b, a)).or_default() += cotangent;
        }
    }
    let mut sorted: Vec<((u32, u32), f32)> = weights.into_iter().filter(|((point, _), _)| (*point as usize) < count).collect();
    sorted.sort_unstable_by_key(|(edge, _)| *edge);
    let mut lists = Lists::default();
    let mut rest = sorted.as_slice();
    let length_squared = |one: u32, other: u32| match (places.get(one as usize), places.get(other as usize)) {
        (Some(one), Some(other)) => one.distance_squared(*other).max(f32::MIN_POSITIVE),
        _ => 1.0,
    };
    for point in 0..count as u32 {
        let (own, others) = rest.split_at(rest.partition_point(|((from, _), _)| *from <= point));
        rest = others;
        let sum: f32 = own.iter().map(|(_, weight)| weight.max(LEAST_WEIGHT)).sum();
        let edge = |((from, to), weight): &((u32, u32), f32)| Edge {
            point: *to,
            weight: weight.max(LEAST_WEIGHT) / sum,
            rest_squared: length_squared(*from, *to),
        };
        lists.push(own.iter().map(edge));
    }
    lists
}

/// The weights of a pose: neighbours that the skeleton has pushed together go together.
#[derive(Debug, Clone, Default)]
pub(crate) struct Coupling {
    /// By entry of the neighbours: the weight; those of a point add up to 1.
    weights: Vec<f32>,
    /// By point: its first entry in the weights.
    starts: Vec<usize>,
    /// By point: what share of the way to its neighbours' mean a displacement goes.
    shares: Vec<f32>,
    /// The points with crushed edges, with the share of the way that their displacements go after that.
    crushed: Vec<(u32, f32)>,
    before: Vec<Vec3>,
}

impl Coupling {
    /// Computes the weights of a pose from the positions of the points. `scale` is how many times as large as at rest the model is.
    pub(crate) fn set(&mut self, neighbours: &Neighbours, elasticity: &[f32], follows: &[f32], positions: &[Vec3], scale: f32) {
        self.weights.clear();
        self.starts.clear();
        self.shares.clear();
        self.crushed.clear();
        // A later pose may crush what this one leaves alone.
        self.crushed.reserve(elasticity.len());
        for (point, (elasticity, follows)) in elasticity.iter().zip(follows).enumerate() {
            let here = positions.get(point).copied().unwrap_or(Vec3::ZERO);
            let (first, mut sum) = (self.weights.len(), 0.0);
            self.starts.push(first);
            for edge in neighbours.of(point) {
                let there = positions.get(edge.point as usize).copied().unwrap_or(here);
                // The square of how many times as long as at rest the edge is.
                let stretched = here.distance_squared(there) / (edge.rest_squared * scale * scale);
                let weight = edge.weight / (stretched + CRUSHED);
                sum += weight;
                self.weights.push(weight);
            }
            for weight in self.weights.iter_mut().skip(first) {
                *weight /= sum;
            }
            let crushed = follows * (1.0 - smooth_step(2.0 / sum));
            self.shares.push(follows * elasticity + crushed * (1.0 - elasticity));
            if crushed > 0.0 {
                self.crushed.push((point as u32, crushed));
            }
        }
    }

    /// Lets displacements go towards the means of their neighbours', where those reach farther than they do themselves.
    ///
    /// `moves` has one displacement a point, those that do not move included. `scale` as in [`Coupling::set`].
    pub(crate) fn spread(&mut self, neighbours: &Neighbours, scale: f32, moves: &mut [Vec3]) {
        let mut before = std::mem::take(&mut self.before);
        before.clear();
        before.extend_from_slice(moves);
        for _ in 0..STEPS {
            for (point, share) in self.shares.iter().enumerate() {
                if let Some(slot) = moves.get_mut(point) {
                    *slot = self.step(neighbours, scale, &before, point, *share);
                }
            }
            before.copy_from_slice(moves);
        }
        for _ in 0..CRUSHED_STEPS {
            for (point, share) in &self.crushed {
                if let Some(slot) = moves.get_mut(*point as usize) {
                    *slot = self.step(neighbours, scale, &before, *point as usize, *share);
                }
            }
            for (point, _) in &self.crushed {
                if let (Some(slot), Some(moved)) = (before.get_mut(*point as usize), moves.get(*point as usize)) {
                    *slot = *moved;
                }
            }
        }
        self.before = before;
    }

    /// The displacement of a point after a step.
    fn step(&self, neighbours: &Neighbours, scale: f32, from: &[Vec3], point: usize, share: f32) -> Vec3 {
        let own = from.get(point).copied().unwrap_or(Vec3::ZERO);
        let weights = self.starts.get(point).and_then(|start| self.weights.get(*start..)).unwrap_or(&[]);
        let mut mean = Vec3::ZERO;
        for (edge, weight) in neighbours.of(point).iter().zip(weights) {
            mean += from.get(edge.point as usize).copied().unwrap_or(Vec3::ZERO) * *weight;
        }
        let change = mean - own;
        let farther = smooth_step(change.dot(mean.normalize_or_zero()) / (SET_IN * scale));
        own + change * (share * farther)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bulge_draws_its_neighbours_along_and_is_not_drawn_in_itself() {
        let places: Vec<Vec3> = (0..7).flat_map(|y| (0..7).map(move |x| Vec3::new(x as f32, y as f32, 0.0) * 0.01)).collect();
        let square = |x: u32, y: u32| [[y * 7 + x, y * 7 + x + 1, y * 7 + x + 8], [y * 7 + x, y * 7 + x + 8, y * 7 + x + 7]];
        let triangles: Vec<[u32; 3]> = (0..6).flat_map(|y| (0..6).flat_map(move |x| square(x, y))).collect();
        let neighbours = cotangents(&places, &triangles, 49);
        for point in 0..49 {
            let sum: f32 = neighbours.of(point).iter().map(|edge| edge.weight).sum();
            assert!((sum - 1.0).abs() < 1e-6);
        }
        let mut from = vec![Vec3::ZERO; 49];
        from[24] = Vec3::Z * 0.02;
        let spread = |elasticity: f32, positions: &[Vec3]| {
            let (mut coupling, mut to) = (Coupling::default(), from.clone());
            coupling.set(&neighbours, &[elasticity; 49], &[1.0; 49], positions, 1.0);
            coupling.spread(&neighbours, 1.0, &mut to);
            to
        };
        let to = spread(0.5, &places);
        assert_eq!(to[24], from[24]);
        for beside in [23, 25, 17, 31] {
            assert!((0.003..0.008).contains(&to[beside].z), "{}", to[beside]);
        }
        assert!(to[0].length() < 1e-9 && to[6].length() < 1e-9);
        assert_eq!(spread(0.0, &places), from);
        // What is crushed along x goes together along x, even where the skin is not elastic.
        let crushed: Vec<Vec3> = places.iter().map(|place| place * Vec3::new(0.02, 1.0, 1.0)).collect();
        let to = spread(0.0, &crushed);
        assert!(to[23].z > 0.015 && to[17].z < 0.001, "{} {}", to[23], to[17]);
    }
}

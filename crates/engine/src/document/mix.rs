//! Morphs: a shape mixed with its targets.

use glam::Vec3;
use rustc_hash::FxHashMap;

use sinew_scene::{Mesh, Morph, MorphMethod, smooth_normals};

/// A morph at one moment.
pub(super) struct ActiveMorph<'a, G> {
    pub morph: &'a Morph,
    /// One a target.
    pub weights: &'a [f32],
    /// The bare mesh, from which the deltas of the targets count.
    pub mesh: &'a Mesh,
    /// Targets that have another shape now than the morph says: their places, and one position a vertex.
    pub given: G,
}

/// What mixing needs, laid out once.
#[derive(Debug, Clone, Default)]
pub(super) struct MorphMixer {
    /// For morphs without normals: vertices that share point and normal, so that hard edges stay hard.
    groups: Option<(Vec<u32>, usize)>,
}

impl MorphMixer {
    /// A mixer for `mesh`; `smooths` where any target lacks normals.
    pub(super) fn new(mesh: &Mesh, smooths: bool) -> Self {
        Self { groups: smooths.then(|| groups(mesh)) }
    }

    /// Mixes the shape in `positions` and `normals` with the targets: `base · (1 − Σw) + Σ w·target`, or `base + Σ w·target`.
    pub(super) fn mix<'a, G>(&self, active: &ActiveMorph<'a, G>, positions: &mut [Vec3], normals: &mut Vec<Vec3>)
    where
        G: Iterator<Item = (usize, &'a [Vec3])> + Clone,
    {
        let ActiveMorph { morph, mesh, .. } = active;
        let weights = || {
            let weights = morph.targets.iter().zip(active.weights).enumerate();
            weights
                .filter(|(_, (_, weight))| **weight != 0.0 && weight.is_finite())
                .map(|(place, (target, weight))| (place, target, *weight))
        };
        let sum: f32 = weights().map(|(_, _, weight)| weight).sum();
        if weights().next().is_none() {
            return;
        }
        // The deltas of a normalised morph count from the bare mesh: what was done to that since is mixed away with it. Over the bare mesh nothing was.
        if morph.method == MorphMethod::Normalized {
            let toward = |now: &mut [Vec3], rest_shape: &[Vec3]| {
                for (now, rest_shape) in now.iter_mut().zip(rest_shape) {
                    *now += (*rest_shape - *now) * sum;
                }
            };
            toward(positions, &mesh.positions);
            toward(normals, &mesh.normals);
        }
        for (place, target, weight) in weights() {
            match active.given.clone().find(|(given, _)| *given == place) {
                Some((_, given)) if morph.method == MorphMethod::Relative => add(positions, given.iter().copied(), weight),
                Some((_, given)) => add(positions, given.iter().zip(&mesh.positions).map(|(to, from)| *to - *from), weight),
                None => add(positions, target.position_deltas.iter().copied(), weight),
            }
            add(normals, target.normal_deltas.iter().copied(), weight);
        }
        match &self.groups {
            Some((group, count)) => {
                let of = |vertex: u32| group.get(vertex as usize).copied().unwrap_or(0);
                smooth_normals(positions, &mesh.triangles, of, *count, normals);
            }
            None => normals.iter_mut().for_each(|normal| *normal = normal.normalize_or(Vec3::Y)),
        }
    }
}

/// [`MorphMixer::mix`] for the position of one vertex.
pub(super) fn morph_point(morph: &Morph, weights: &[f32], mesh: &Mesh, vertex: usize, base: Vec3) -> Vec3 {
    let rest_shape = mesh.positions.get(vertex).copied().unwrap_or(base);
    let mixed = morph.targets.iter().zip(weights).filter(|(_, weight)| weight.is_finite());
    mixed.fold(base, |now, (target, weight)| {
        let back = if morph.method == MorphMethod::Normalized { rest_shape - base } else { Vec3::ZERO };
        now + (back + target.position_deltas.get(vertex).copied().unwrap_or(Vec3::ZERO)) * *weight
    })
}

fn add(to: &mut [Vec3], deltas: impl Iterator<Item = Vec3>, weight: f32) {
    for (to, delta) in to.iter_mut().zip(deltas) {
        *to += delta * weight;
    }
}

/// Numbers the different pairs of point and normal; returns one number a vertex and how many there are.
fn groups(mesh: &Mesh) -> (Vec<u32>, usize) {
    let mut known = FxHashMap::default();
    let group = mesh
        .source_vertex
        .iter()
        .zip(&mesh.normals)
        .map(|(point, normal)| {
            let next = known.len() as u32;
            *known.entry((*point, normal.to_array().map(f32::to_bits))).or_insert(next)
        })
        .collect();
    (group, known.len())
}

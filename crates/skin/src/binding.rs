//! A skin bound to the muscles beneath it: made once, at rest.

use glam::Vec3;

use crate::clearance::{Pair, lack};
use crate::follow::following;
use crate::layout::{Layout, measured};
use crate::lists::Lists;
use crate::pieces::pieces_of;
use crate::points::{Points, SkinMesh};
use crate::section::MuscleTissue;
use crate::splines::{SPLINES, splines_at};
use crate::station::{Stations, bone_shares};

/// The share of a bone below which a point is not counted as the bone's.
const LEAST_SHARE: f64 = 0.02;

/// A skin bound to muscles.
#[derive(Debug, Clone, Default)]
pub struct Binding {
    pub(crate) layout: Layout,
    /// By point that moves: the cross-sections that it has to clear.
    pub(crate) pairs: Lists<Pair>,
    /// By point that moves: how fully it follows, 0 to 1.
    pub(crate) follows: Vec<f32>,
    /// By point that moves: what [`crate::SkinLayer::elasticity`] says there.
    pub(crate) elasticity: Vec<f32>,
    /// By point that moves: minus what it lacks at rest where it lacks something, else 0. Metres.
    pub(crate) at_rest: Vec<f32>,
    /// By point: 1 where the triangles run counter-clockwise seen from outside, −1 where they run clockwise.
    pub(crate) orientation: Vec<f32>,
    /// By point: the splines of bones there that are not 0, as `bone · SPLINES + spline`, with their values.
    pub(crate) splines: Lists<(u32, f32)>,
    /// Volume of muscle by bone and spline at rest, m³.
    pub(crate) muscle_volumes: Vec<[f64; SPLINES]>,
    enclosed: Vec<bool>,
    vertex_count: usize,
}

impl Binding {
    /// Binds a skin at rest to muscles at rest. A connected piece of the skin that lies round no muscle is bound to none, and so is what lies out of every
    /// muscle's reach.
    pub fn new(skin: &SkinMesh<'_>, muscles: &[MuscleTissue], rest: &Stations) -> Self {
        let mut binding = Self { enclosed: vec![false; muscles.len()], vertex_count: skin.positions.len(), ..Self::default() };
        if rest.list.is_empty() || !rest.is_finite() {
            return binding;
        }
        let points = Points::of(skin);
        let pieces = pieces_of(&points, muscles, rest);
        for muscle in pieces.iter().flat_map(|piece| &piece.muscles) {
            if let Some(enclosed) = binding.enclosed.get_mut(*muscle) {
                *enclosed = true;
            }
        }
        let piece_of = |point: usize| points.pieces.get(point).and_then(|piece| pieces.get(*piece as usize));
        let normals = points.normals();
        let (edges, _) = measured(&points.positions, &points.triangles);
        let (mut order, mut followings) = (Vec::new(), Vec::new());
        // Most points are out of most muscles' reach.
        let boxes: Vec<[Vec3; 2]> = muscles.iter().map(|muscle| reached(muscle, rest)).collect();
        let mut near: Vec<usize> = Vec::new();
        for (point, ((position, normal), edge)) in points.positions.iter().zip(normals).zip(edges).enumerate() {
            let Some(piece) = piece_of(point).filter(|piece| !piece.muscles.is_empty() && position.is_finite()) else { continue };
            let normal = if piece.inverted { -normal } else { normal };
            let reaches =
                |muscle: &usize| boxes.get(*muscle).is_some_and(|[low, high]| position.cmpge(*low).all() && position.cmple(*high).all());
            near.clear();
            near.extend(piece.muscles.iter().copied().filter(reaches));
            let following = following(*position, normal, edge, &near, muscles, rest);
            if following.weight > 0.0 {
                order.push(point as u32);
                followings.push(following);
            }
        }
        binding.layout = Layout::of(&points, order);
        let places: Vec<Vec3> = binding.layout.order.iter().filter_map(|point| points.positions.get(*point as usize).copied()).collect();
        let mut values = Vec::new();
        for ((following, place), edge) in followings.into_iter().zip(&places).zip(&binding.layout.edges) {
            let lack = lack(&rest.list, &following.pairs, *place, *edge, rest.scale as f32, &mut values);
            binding.at_rest.push(-lack.amount.max(0.0));
            binding.follows.push(following.weight);
            binding.elasticity.push(following.elasticity);
            binding.pairs.push(following.pairs);
        }
        let inverted = |point: &u32| piece_of(*point as usize).is_some_and(|piece| piece.inverted);
        binding.orientation = binding.layout.order.iter().map(|point| if inverted(point) { -1.0 } else { 1.0 }).collect();
        binding.place_on_bones(&places, muscles, rest);
        binding
    }

    /// Number of points that move.
    pub fn bound_points(&self) -> usize {
        self.layout.bound
    }

    /// Number of vertices of the mesh that it was made for.
    pub fn vertex_count(&self) -> usize {
        self.vertex_count
    }

    /// Whether nothing moves.
    pub fn is_empty(&self) -> bool {
        self.layout.bound == 0
    }

    /// Whether the skin lies round muscle `index`.
    pub fn encloses(&self, index: usize) -> bool {
        self.enclosed.get(index).copied().unwrap_or(false)
    }

    /// The vertices that may move.
    pub fn vertices(&self) -> impl Iterator<Item = u32> + '_ {
        (0..self.layout.bound).flat_map(|point| self.layout.vertices.of(point)).copied()
    }

    /// Finds where each point is along which bones.
    fn place_on_bones(&mut self, places: &[Vec3], muscles: &[MuscleTissue], rest: &Stations) {
        let inside = muscles.iter().enumerate().filter(|(index, _)| self.encloses(*index));
        let mut bones: Vec<usize> = inside.flat_map(|(_, muscle)| muscle.bones.iter().copied()).collect();
        bones.sort_unstable();
        bones.dedup();
        self.muscle_volumes.clone_from(&rest.volumes);
        for place in places {
            let place = place.as_dvec3();
            let shares = bone_shares(&bones, rest.bones(), place, rest.scale).filter(|(_, share)| *share > LEAST_SHARE);
            let entries = shares.flat_map(|(bone, share)| {
                let along = rest.bones().get(bone).map_or(f64::NAN, |segment| segment.share(place));
                splines_at(along)
                    .into_iter()
                    .enumerate()
                    .filter(|(_, value)| *value > 0.0)
                    .map(move |(spline, value)| ((bone * SPLINES + spline) as u32, (value * share) as f32))
            });
            self.splines.push(entries);
        }
    }
}

/// The box round all that a muscle may reach.
fn reached(muscle: &MuscleTissue, rest: &Stations) -> [Vec3; 2] {
    let own = rest.list.get(muscle.sections.clone()).unwrap_or(&[]);
    let around = own.iter().map(|station| (station.center, station.half + station.height.max(station.across) + muscle.layer.reach as f32));
    around.fold([Vec3::INFINITY, Vec3::NEG_INFINITY], |[low, high], (center, reach)| [low.min(center - reach), high.max(center + reach)])
}

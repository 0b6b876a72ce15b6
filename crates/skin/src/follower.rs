//! A skin that follows its muscles in one pose.

use std::ops::Range;

use glam::{Quat, Vec3};

use crate::balance::{Balance, BentSkin};
use crate::binding::Binding;
use crate::clearance::lack;
use crate::fairing::{Coupling, Edge};
use crate::points::add_normals;
use crate::soft::{positive_part, saturated, smooth_step};
use crate::station::Stations;

/// A point begins to move softly over this much, metres.
const SOFT: f32 = 0.002;
/// No point is moved farther than this to clear a muscle, metres.
const FARTHEST: f32 = 0.08;
/// With fewer points one thread does all.
const ALONE: usize = 3000;
/// Where the mean normal of a point's triangles is shorter than this share of what it is on a flat surface at rest, it counts less.
const STRAIGHT: f32 = 0.5;
/// How often room is averaged over neighbours.
const ROOM_STEPS: usize = 4;

/// Moves a skin. Holds nothing but working memory: the same skin and stations give the same moves whatever came before.
#[derive(Debug, Clone, Default)]
pub struct Follower {
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    room: Vec<f32>,
    around: Vec<f32>,
    beyond: Vec<f32>,
    moves: Vec<Vec3>,
    passed: Vec<Vec3>,
    after: Vec<Vec3>,
    values: [Vec<f32>; 2],
    coupling: Coupling,
    balance: Balance,
}

/// The parts of a range of points that clearing writes to.
struct Cleared<'a> {
    room: &'a mut [f32],
    moves: &'a mut [Vec3],
    values: &'a mut Vec<f32>,
}

impl Follower {
    /// Moves the vertices of a skin, which its skeleton has bent already, so that it clears the muscles at these stations, and turns the normals with it.
    ///
    /// `positions` and `normals` have one entry a vertex of the mesh that `binding` was made for, in the world, metres; otherwise nothing is done. The same
    /// where a station or a position is no number.
    pub fn follow(&mut self, binding: &Binding, stations: &Stations, positions: &mut [Vec3], normals: &mut [Vec3]) {
        let count = binding.vertex_count();
        if binding.is_empty() || positions.len() != count || normals.len() != count || !stations.is_finite() {
            return;
        }
        if !self.gather(binding, positions, stations.scale) {
            return;
        }
        self.clear(binding, stations);
        self.share_room(binding);
        self.pass_on(binding, stations);
        self.passed.clone_from(&self.moves);
        let skin = BentSkin { positions: &self.positions, normals: &self.normals, room: &self.room, cleared: &self.passed };
        self.balance.add(binding, stations, &skin, &mut self.moves);
        self.write(binding, positions, normals);
    }

    /// How far each point that moves was moved the last time, metres.
    pub fn moves<'a>(&'a self, binding: &Binding) -> &'a [Vec3] {
        self.moves.get(..binding.bound_points()).unwrap_or(&[])
    }

    /// Collects the points of the skin and their normals; `false` where one is no number.
    fn gather(&mut self, binding: &Binding, positions: &[Vec3], scale: f64) -> bool {
        let layout = &binding.layout;
        self.positions.clear();
        for point in 0..layout.order.len() {
            let first = layout.vertices.of(point).first().and_then(|vertex| positions.get(*vertex as usize));
            self.positions.push(first.copied().unwrap_or(Vec3::NAN));
        }
        if !self.positions.iter().all(|position| position.is_finite()) {
            return false;
        }
        self.normals.clear();
        self.normals.resize(self.positions.len(), Vec3::ZERO);
        add_normals(&self.positions, &layout.triangles, &mut self.normals);
        let flat = 6.0 * (scale * scale) as f32;
        for ((normal, orientation), area) in self.normals.iter_mut().zip(&binding.orientation).zip(&layout.areas) {
            // Of crushed triangles the mean normal may turn round in no time; before it does it gets short.
            let straight = normal.length() / (flat * area).max(f32::MIN_POSITIVE);
            *normal = normal.normalize_or_zero() * (*orientation * smooth_step(straight / STRAIGHT));
        }
        true
    }

    /// Moves each point that lacks something out of the muscles.
    fn clear(&mut self, binding: &Binding, stations: &Stations) {
        let bound = binding.bound_points();
        self.room.clear();
        self.room.resize(bound, 0.0);
        self.moves.clear();
        self.moves.resize(self.positions.len(), Vec3::ZERO);
        let positions = &self.positions;
        let (Some(moves), [one, other]) = (self.moves.get_mut(..bound), &mut self.values) else { return };
        let room = self.room.as_mut_slice();
        let middle = bound / 2;
        if bound < ALONE {
            clear_points(binding, stations, positions, 0..bound, Cleared { room, moves, values: one });
            return;
        }
        let (first_room, last_room) = room.split_at_mut(middle);
        let (first_moves, last_moves) = moves.split_at_mut(middle);
        let mut last = Some(Cleared { room: last_room, moves: last_moves, values: other });
        std::thread::scope(|scope| {
            let last = &mut last;
            let work = move || {
                if let Some(last) = last.take() {
                    clear_points(binding, stations, positions, middle..bound, last);
                }
            };
            // Where no thread can be had, the second half is done below.
            let _ = std::thread::Builder::new().spawn_scoped(scope, work);
            clear_points(binding, stations, positions, 0..middle, Cleared { room: first_room, moves: first_moves, values: one });
        });
        if let Some(last) = last.take() {
            clear_points(binding, stations, positions, middle..bound, last);
        }
    }

    /// Gives less room to points whose neighbours have little, so that no single point is drawn in between others that stay.
    fn share_room(&mut self, binding: &Binding) {
        let Self { room, around, beyond, .. } = self;
        around.clone_from(room);
        for _ in 0..ROOM_STEPS {
            beyond.clone_from(around);
            for (point, mean) in around.iter_mut().enumerate() {
                let of = |edge: &Edge| beyond.get(edge.point as usize).copied().unwrap_or(0.0) * edge.weight;
                *mean = binding.layout.neighbours.of(point).iter().map(of).sum();
            }
        }
        for (room, around) in room.iter_mut().zip(around) {
            *room *= *around;
        }
    }

    /// Lets displacements pass to their neighbours.
    fn pass_on(&mut self, binding: &Binding, stations: &Stations) {
        let (neighbours, scale) = (&binding.layout.neighbours, stations.scale as f32);
        self.coupling.set(neighbours, &binding.elasticity, &binding.follows, &self.positions, scale);
        self.coupling.spread(neighbours, scale, &mut self.moves);
    }

    /// Writes the moved vertices, and their normals turned as those of the points are.
    fn write(&mut self, binding: &Binding, positions: &mut [Vec3], normals: &mut [Vec3]) {
        let layout = &binding.layout;
        for (position, step) in self.positions.iter_mut().zip(&self.moves) {
            *position += *step;
        }
        self.after.clear();
        self.after.resize(self.positions.len(), Vec3::ZERO);
        add_normals(&self.positions, &layout.triangles, &mut self.after);
        let points = self.moves.iter().zip(&self.normals).zip(self.after.iter().zip(&binding.orientation));
        for (point, ((step, before), (after, orientation))) in points.enumerate().take(layout.bound) {
            let (before, after) = (before.normalize_or_zero(), after.normalize_or_zero() * *orientation);
            let turn = if before == Vec3::ZERO || after == Vec3::ZERO || before == after {
                None
            } else {
                Some(Quat::from_rotation_arc(before, after))
            };
            for vertex in layout.vertices.of(point) {
                let Some((position, normal)) = positions.get_mut(*vertex as usize).zip(normals.get_mut(*vertex as usize)) else { continue };
                *position += *step;
                if let Some(turn) = turn {
                    *normal = (turn * *normal).normalize_or(*normal);
                }
            }
        }
    }
}

/// Clears the points of a range: writes by how much each moves, and how freely it may be moved otherwise.
fn clear_points(binding: &Binding, stations: &Stations, positions: &[Vec3], range: Range<usize>, cleared: Cleared<'_>) {
    let scale = stations.scale as f32;
    let Cleared { room, moves, values } = cleared;
    for ((point, room), step) in range.zip(room).zip(moves) {
        let of = |list: &[f32]| list.get(point).copied().unwrap_or(0.0);
        let Some(position) = positions.get(point) else { break };
        let (follows, edge, at_rest) = (of(&binding.follows), of(&binding.layout.edges) * scale, of(&binding.at_rest) * scale);
        let lack = lack(&stations.list, binding.pairs.of(point), *position, edge, scale, values);
        let amount = lack.amount + at_rest;
        *step = lack.outward * (follows * saturated(positive_part(amount, SOFT * scale), FARTHEST * scale));
        *room = follows * lack.room;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::points::SkinMesh;
    use crate::section::{CrossSection, MuscleTissue, Segment, SkinLayer};
    use glam::DVec3;

    /// A tube of skin along y and a muscle of this radius in it.
    fn tube(corners: u32, rings: u32) -> (Vec<Vec3>, Vec<[u32; 3]>) {
        let at = |ring: u32, corner: u32| {
            let angle = corner as f32 / corners as f32 * std::f32::consts::TAU;
            Vec3::new(0.045 * angle.sin(), 0.3 * ring as f32 / (rings - 1) as f32, 0.045 * angle.cos())
        };
        let positions = (0..rings).flat_map(|ring| (0..corners).map(move |corner| at(ring, corner))).collect();
        let square = |ring: u32, corner: u32| {
            let (a, b) = (ring * corners + corner, ring * corners + (corner + 1) % corners);
            [[a, b, a + corners], [b, b + corners, a + corners]]
        };
        let triangles = (0..rings - 1).flat_map(|ring| (0..corners).flat_map(move |corner| square(ring, corner))).collect();
        (positions, triangles)
    }

    fn stations(muscles: &[MuscleTissue], radius: f64) -> Stations {
        let section = |index: u32| CrossSection {
            center: DVec3::new(0.0, 0.05 + 0.01 * f64::from(index), 0.02),
            tangent: DVec3::Y,
            radius,
            flatness: 1.0,
            flattened_along: DVec3::Z,
            half_length: 0.005,
            volume: std::f64::consts::PI * radius * radius * 0.01,
            belly: true,
        };
        let sections: Vec<CrossSection> = (0..20).map(section).collect();
        let mut stations = Stations::default();
        stations.place(muscles, &sections, &[Segment { start: DVec3::ZERO, end: DVec3::Y * 0.3 }], 1.0);
        stations
    }

    #[test]
    fn two_threads_clear_points_to_the_same_bits_as_one() {
        let muscles = [MuscleTissue { sections: 0..20, bones: vec![0], layer: SkinLayer::default() }];
        let (positions, triangles) = tube(80, 90);
        let mesh = SkinMesh { positions: &positions, triangles: &triangles };
        let binding = Binding::new(&mesh, &muscles, &stations(&muscles, 0.014));
        let bound = binding.bound_points();
        assert!(bound > ALONE);
        let thick = stations(&muscles, 0.027);
        let mut follower = Follower::default();
        assert!(follower.gather(&binding, &positions, 1.0));
        follower.clear(&binding, &thick);
        let (mut room, mut moves) = (vec![0.0; bound], vec![Vec3::ZERO; bound]);
        let alone = Cleared { room: &mut room, moves: &mut moves, values: &mut Vec::new() };
        clear_points(&binding, &thick, &follower.positions, 0..bound, alone);
        assert!(moves.iter().any(|by| by.length() > 0.003));
        assert_eq!((follower.moves(&binding), &follower.room), (moves.as_slice(), &room));
    }

    #[test]
    fn a_position_that_is_no_number_leaves_the_skin_as_it_was() {
        let muscles = [MuscleTissue { sections: 0..20, bones: vec![0], layer: SkinLayer::default() }];
        let (positions, triangles) = tube(40, 40);
        let mesh = SkinMesh { positions: &positions, triangles: &triangles };
        let binding = Binding::new(&mesh, &muscles, &stations(&muscles, 0.014));
        let mut bad = positions.clone();
        bad[800] = Vec3::new(f32::NAN, 0.0, 0.0);
        let (mut now, mut normals) = (bad.clone(), vec![Vec3::Y; bad.len()]);
        Follower::default().follow(&binding, &stations(&muscles, 0.027), &mut now, &mut normals);
        let bits = |list: &[Vec3]| list.iter().map(|p| p.to_array().map(f32::to_bits)).collect::<Vec<_>>();
        assert!(bits(&now) == bits(&bad));
        // So does a muscle that is nowhere.
        let mut still = positions.clone();
        Follower::default().follow(&binding, &stations(&muscles, f64::NAN), &mut still, &mut normals);
        assert_eq!(still, positions);
    }
}

//! The points of a skin that move, numbered anew, and those beside them.

use glam::Vec3;

use crate::fairing::{Neighbours, cotangents};
use crate::lists::Lists;
use crate::points::Points;

/// The part of a skin that moves: first the points that do, then those beside them.
#[derive(Debug, Clone, Default)]
pub(crate) struct Layout {
    /// How many points move.
    pub(crate) bound: usize,
    /// By point: its number in the mesh.
    pub(crate) order: Vec<u32>,
    /// By point: the mesh's vertices there.
    pub(crate) vertices: Lists<u32>,
    /// All triangles with a corner that moves.
    pub(crate) triangles: Vec<[u32; 3]>,
    /// By point that moves: the edges to those beside it.
    pub(crate) neighbours: Neighbours,
    /// By point: mean length of the edges at rest, metres.
    pub(crate) edges: Vec<f32>,
    /// By point: a third of the areas of its triangles at rest, m².
    pub(crate) areas: Vec<f32>,
}

impl Layout {
    /// Of the points of a mesh with these numbers.
    pub(crate) fn of(points: &Points, mut order: Vec<u32>) -> Self {
        let bound = order.len();
        let mut numbers: Vec<Option<u32>> = vec![None; points.positions.len()];
        for (number, point) in order.iter().enumerate() {
            if let Some(slot) = numbers.get_mut(*point as usize) {
                *slot = Some(number as u32);
            }
        }
        let mut triangles = Vec::new();
        for triangle in &points.triangles {
            let moves = |point: &u32| numbers.get(*point as usize).copied().flatten().is_some_and(|number| (number as usize) < bound);
            if !triangle.iter().any(moves) {
                continue;
            }
            triangles.push(triangle.map(|point| {
                let Some(slot) = numbers.get_mut(point as usize) else { return 0 };
                *slot.get_or_insert_with(|| {
                    order.push(point);
                    order.len() as u32 - 1
                })
            }));
        }
        let places: Vec<Vec3> = order.iter().map(|point| points.positions.get(*point as usize).copied().unwrap_or(Vec3::ZERO)).collect();
        let neighbours = cotangents(&places, &triangles, bound);
        let (edges, areas) = measured(&places, &triangles);
        Self { bound, vertices: vertices_of(points, &numbers, order.len()), order, triangles, neighbours, edges, areas }
    }
}

/// The vertices at each numbered point.
fn vertices_of(points: &Points, numbers: &[Option<u32>], count: usize) -> Lists<u32> {
    let mut vertices: Vec<Vec<u32>> = vec![Vec::new(); count];
    for (vertex, point) in points.of_vertex.iter().enumerate() {
        let number = numbers.get(*point as usize).copied().flatten();
        if let Some(list) = number.and_then(|number| vertices.get_mut(number as usize)) {
            list.push(vertex as u32);
        }
    }
    let mut lists = Lists::default();
    for list in vertices {
        lists.push(list);
    }
    lists
}

/// Mean length of the edges at each point, and a third of the areas of its triangles.
pub(crate) fn measured(places: &[Vec3], triangles: &[[u32; 3]]) -> (Vec<f32>, Vec<f32>) {
    let (mut lengths, mut counts, mut areas) = (vec![0.0f32; places.len()], vec![0.0f32; places.len()], vec![0.0f32; places.len()]);
    for triangle in triangles {
        let corners = triangle.map(|point| places.get(point as usize).copied().unwrap_or(Vec3::ZERO));
        let third = (corners[1] - corners[0]).cross(corners[2] - corners[0]).length() / 6.0;
        for (corner, point) in triangle.iter().enumerate() {
            let (here, others) = (corners[corner], [corners[(corner + 1) % 3], corners[(corner + 2) % 3]]);
            let point = *point as usize;
            if let (Some(length), Some(count), Some(area)) = (lengths.get_mut(point), counts.get_mut(point), areas.get_mut(point)) {
                *length += others.iter().map(|other| other.distance(here)).sum::<f32>();
                *count += 2.0;
                *area += third;
            }
        }
    }
    let mean = |(length, count): (f32, f32)| if count > 0.0 { length / count } else { 0.0 };
    (lengths.into_iter().zip(counts).map(mean).collect(), areas)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::points::SkinMesh;

    #[test]
    fn points_that_move_come_first_and_those_beside_them_follow() {
        let positions: Vec<Vec3> = (0..4).flat_map(|y| (0..4).map(move |x| Vec3::new(x as f32, y as f32, 0.0))).collect();
        let square = |x: u32, y: u32| [[y * 4 + x, y * 4 + x + 1, y * 4 + x + 5], [y * 4 + x, y * 4 + x + 5, y * 4 + x + 4]];
        let triangles: Vec<[u32; 3]> = (0..3).flat_map(|y| (0..3).flat_map(move |x| square(x, y))).collect();
        let points = Points::of(&SkinMesh { positions: &positions, triangles: &triangles });
        let layout = Layout::of(&points, vec![5]);
        assert_eq!((layout.bound, layout.order.len(), layout.triangles.len()), (1, 7, 6));
        assert_eq!(layout.order[0], 5);
        assert_eq!(layout.neighbours.of(0).len(), 6);
        assert!((layout.areas[0] - 1.0).abs() < 1e-6);
        assert!((1.0..1.42).contains(&layout.edges[0]), "{}", layout.edges[0]);
        assert_eq!(layout.vertices.of(0), [5]);
    }
}

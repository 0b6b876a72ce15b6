//! Which meshes cover muscles, so that they can let them be seen.

use glam::Vec3;

use sinew_scene::{Frame, Surface};

/// So many muscles are looked at; one that is covered is enough.
const MAX_MUSCLES: usize = 8;

/// Marks as skin the meshes of a posed frame that lie round the middle of a muscle: on all six sides along the world's axes.
pub(super) fn mark_covering_surfaces(frame: &mut Frame) {
    let muscles: Vec<Vec3> =
        frame.surfaces.iter().filter(|surface| surface.muscle.is_some()).take(MAX_MUSCLES).filter_map(middle).collect();
    for surface in frame.surfaces.iter_mut().filter(|surface| surface.muscle.is_none()) {
        surface.skin = muscles.iter().any(|point| encloses(surface, *point));
    }
}

/// Mean of the vertices; `None` for a muscle that has none, or none that are finite.
fn middle(muscle: &Surface) -> Option<Vec3> {
    let count = muscle.mesh.positions.len() as u32;
    let sum: Vec3 = (0..count).map(|v| muscle.position(v)).sum();
    (count > 0).then_some(sum / count as f32).filter(|middle| middle.is_finite())
}

/// Whether the rays from a point along ±X, ±Y and ±Z all meet the surface.
fn encloses(surface: &Surface, point: Vec3) -> bool {
    let mut met = [[false; 2]; 3];
    for triangle in &surface.mesh.triangles {
        let corners = triangle.map(|v| surface.position(v) - point);
        for (axis, met) in met.iter_mut().enumerate().filter(|(_, met)| met.contains(&false)) {
            if let Some(depth) = depth_along(axis, corners) {
                met[usize::from(depth > 0.0)] = true;
            }
        }
        if met == [[true; 2]; 3] {
            return true;
        }
    }
    false
}

/// Where the line through the origin along an axis meets a triangle; `None` where it passes by.
fn depth_along(axis: usize, corners: [Vec3; 3]) -> Option<f32> {
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    let area = |a: Vec3, b: Vec3| a[u] * b[v] - a[v] * b[u];
    let [a, b, c] = corners;
    let weights = [area(b, c), area(c, a), area(a, b)];
    let within = weights.iter().all(|weight| *weight >= 0.0) || weights.iter().all(|weight| *weight <= 0.0);
    let whole: f32 = weights.iter().sum();
    (within && whole != 0.0).then(|| weights.iter().zip(corners).map(|(weight, corner)| weight * corner[axis]).sum::<f32>() / whole)
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use glam::Mat4;
    use sinew_scene::{Mesh, MuscleId, NodeId, SurfaceGeometry};

    /// A box with corners at ±`half`, without its side at +X where it is `open`.
    fn surface(half: Vec3, at: Vec3, open: bool, muscle: Option<MuscleId>) -> Surface {
        let corner = |i: usize| Vec3::from_array(std::array::from_fn(|axis| if i >> axis & 1 == 1 { half[axis] } else { -half[axis] }));
        let sides = [[0, 2, 6, 4], [0, 1, 5, 4], [2, 3, 7, 6], [0, 1, 3, 2], [4, 5, 7, 6], [1, 3, 7, 5]];
        let sides = &sides[..if open { 5 } else { 6 }];
        let mesh = Mesh {
            positions: (0..8).map(corner).collect(),
            triangles: sides.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect(),
            ..Mesh::default()
        };
        Surface {
            node: NodeId(0),
            mesh: Arc::new(mesh),
            materials: Arc::new([]),
            geometry: SurfaceGeometry::Rigid(Mat4::from_translation(at)),
            mirrored: false,
            solid: None,
            muscle,
            fibers: Arc::default(),
            visible: true,
            content: 0,
            skin: false,
            coordinates: Vec::new(),
            ghost: None,
        }
    }

    #[test]
    fn what_lies_round_a_muscle_is_skin_and_what_lies_beside_or_within_is_not() {
        let muscle = surface(Vec3::new(0.1, 0.4, 0.1), Vec3::new(0.3, 0.1, -0.02), false, Some(MuscleId(0)));
        let skin = surface(Vec3::new(1.0, 2.0, 1.0), Vec3::ZERO, false, None);
        let open = surface(Vec3::new(1.0, 2.0, 1.0), Vec3::ZERO, true, None);
        let bone = surface(Vec3::new(0.1, 1.0, 0.1), Vec3::ZERO, false, None);
        let nothing = surface(Vec3::NAN, Vec3::ZERO, false, None);
        let mut frame = Frame { surfaces: vec![skin, bone, muscle, open, nothing], ..Frame::default() };
        mark_covering_surfaces(&mut frame);
        assert_eq!(frame.surfaces.iter().map(|surface| surface.skin).collect::<Vec<_>>(), [true, false, false, false, false]);
        frame.surfaces.retain(|surface| surface.muscle.is_none());
        mark_covering_surfaces(&mut frame);
        assert!(frame.surfaces.iter().all(|surface| !surface.skin));
    }
}

//! What a bone is like round its axis: how thick it is in each direction, from end to end. It pushes the bellies of muscles aside.

use std::f64::consts::TAU;

use glam::{DMat3, DVec3};

/// Slices along the axis, and sectors round it.
const SLICES: usize = 24;
const SECTORS: usize = 16;
/// Most points that are looked at along an edge of a triangle.
const POINTS: usize = 12;
/// Fewer points than this tell no shape.
const FEWEST: usize = 8;

/// A bone round its axis, in the axes that offsets on it are in. Lengths are in the file's unit.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct BoneShape {
    /// A point of the axis.
    origin: DVec3,
    /// Two directions across, and that along the axis.
    axes: DMat3,
    /// Where it begins and ends along the axis, from the origin.
    ends: [f64; 2],
    /// Distance of its surface from the axis: a row of sectors a slice; one number for a capsule.
    radii: Vec<f64>,
}

/// A point beside a bone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Beside {
    /// How far the point is from the bone's axis, between its ends.
    pub distance: f64,
    /// How far the bone's surface is from the axis in that direction.
    pub radius: f64,
    /// From the axis towards the point, of length 1.
    pub outward: DVec3,
}

impl BoneShape {
    /// A rod with round ends from the bone's node to `tip`.
    pub(super) fn capsule(tip: DVec3, radius: f64) -> Option<Self> {
        let along = tip.try_normalize()?;
        Some(Self { origin: DVec3::ZERO, axes: about(along), ends: [0.0, tip.length()], radii: vec![radius] })
    }

    /// The shape of these triangles round an axis in the direction of `tip`. `None` where they are none.
    pub(super) fn of_triangles(triangles: &[[DVec3; 3]], tip: DVec3) -> Option<Self> {
        let axes = about(tip.try_normalize()?);
        let corners = || triangles.iter().flatten();
        let count = corners().count();
        if count < FEWEST || !corners().all(|corner| corner.is_finite()) {
            return None;
        }
        let mean = corners().sum::<DVec3>() / count as f64;
        let origin = mean - axes.z_axis * mean.dot(axes.z_axis);
        let place = |point: DVec3| axes.transpose() * (point - origin);
        let along = || corners().map(|corner| place(*corner).z);
        let ends = [along().fold(f64::INFINITY, f64::min), along().fold(f64::NEG_INFINITY, f64::max)];
        if ends[1] - ends[0] <= 0.0 {
            return None;
        }
        let mut radii = vec![0.0_f64; SLICES * SECTORS];
        let cell = (ends[1] - ends[0]) / SLICES as f64;
        for [a, b, c] in triangles {
            let longest = a.distance(*b).max(b.distance(*c)).max(c.distance(*a));
            let steps = ((2.0 * longest / cell).ceil() as usize).clamp(1, POINTS);
            for i in 0..=steps {
                for j in 0..=steps - i {
                    let (u, v) = (i as f64 / steps as f64, j as f64 / steps as f64);
                    let point = place(*a * (1.0 - u - v) + *b * u + *c * v);
                    let slice = (((point.z - ends[0]) / cell) as usize).min(SLICES - 1);
                    let sector = ((turn(point) * SECTORS as f64) as usize).min(SECTORS - 1);
                    if let Some(radius) = radii.get_mut(slice * SECTORS + sector) {
                        *radius = radius.max(point.truncate().length());
                    }
                }
            }
        }
        fill(&mut radii);
        Some(Self { origin, axes, ends, radii })
    }

    /// The bone beside a point; `None` on its axis. Beyond its ends the distance is that from the end of the axis.
    pub(super) fn beside(&self, point: DVec3) -> Option<Beside> {
        let local = self.axes.transpose() * (point - self.origin);
        let from_axis = local.with_z(local.z - local.z.clamp(self.ends[0], self.ends[1]));
        let outward = (self.axes * from_axis).try_normalize()?;
        Some(Beside { distance: from_axis.length(), radius: self.radius_at(local), outward })
    }

    /// How far a point is from the bone's axis.
    pub(super) fn axis_distance(&self, point: DVec3) -> f64 {
        (self.axes.transpose() * (point - self.origin)).truncate().length()
    }

    fn radius_at(&self, local: DVec3) -> f64 {
        let [radius] = self.radii.as_slice() else {
            let along = ((local.z - self.ends[0]) / (self.ends[1] - self.ends[0]) * SLICES as f64 - 0.5).clamp(0.0, (SLICES - 1) as f64);
            let round = (turn(local) * SECTORS as f64 - 0.5).rem_euclid(SECTORS as f64);
            let (slice, sector) = (along as usize, round as usize);
            let at =
                |slice: usize, sector: usize| self.radii.get(slice.min(SLICES - 1) * SECTORS + sector % SECTORS).copied().unwrap_or(0.0);
            let mix = |a: f64, b: f64, share: f64| a + (b - a) * share;
            let (s, t) = (along - slice as f64, round - sector as f64);
            return mix(mix(at(slice, sector), at(slice, sector + 1), t), mix(at(slice + 1, sector), at(slice + 1, sector + 1), t), s);
        };
        *radius
    }
}

/// Two directions square to one, and that one.
fn about(along: DVec3) -> DMat3 {
    let (x, y) = along.any_orthonormal_pair();
    DMat3::from_cols(x, y, along)
}

/// How far round the axis a point lies, from 0 to 1.
fn turn(local: DVec3) -> f64 {
    (local.y.atan2(local.x) / TAU).rem_euclid(1.0)
}

/// Gives sectors that no point lies in what lies beside them in their slice, and slices without any what the nearest slice has.
fn fill(radii: &mut [f64]) {
    for slice in radii.chunks_mut(SECTORS) {
        let known: Vec<(usize, f64)> = slice.iter().copied().enumerate().filter(|(_, radius)| *radius > 0.0).collect();
        if known.is_empty() {
            continue;
        }
        for (sector, radius) in slice.iter_mut().enumerate().filter(|(_, radius)| **radius <= 0.0) {
            let away = |other: usize| other.abs_diff(sector).min(SECTORS - other.abs_diff(sector));
            *radius = known.iter().min_by_key(|(other, _)| away(*other)).map_or(0.0, |(_, radius)| *radius);
        }
    }
    let whole: Vec<usize> = (0..SLICES).filter(|slice| radii.get(slice * SECTORS).is_some_and(|radius| *radius > 0.0)).collect();
    for slice in (0..SLICES).filter(|slice| !whole.contains(slice)) {
        if let Some(near) = whole.iter().min_by_key(|other| other.abs_diff(slice)) {
            radii.copy_within(near * SECTORS..(near + 1) * SECTORS, slice * SECTORS);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_capsule_has_round_ends() {
        let bone = BoneShape::capsule(DVec3::Y * 100.0, 8.0).unwrap();
        let beside = bone.beside(DVec3::new(3.0, 50.0, 4.0)).unwrap();
        assert!(
            (beside.distance - 5.0).abs() < 1e-12 && beside.radius == 8.0 && beside.outward.distance(DVec3::new(0.6, 0.0, 0.8)) < 1e-12
        );
        let end = bone.beside(DVec3::new(3.0, 104.0, 0.0)).unwrap();
        assert!(end.radius == 8.0 && (end.distance - 5.0).abs() < 1e-12 && end.outward.distance(DVec3::new(0.6, 0.8, 0.0)) < 1e-12);
        assert_eq!(bone.beside(DVec3::Y * 50.0), None);
    }

    #[test]
    fn a_mesh_tells_how_thick_a_bone_is_in_each_direction() {
        // A tapered tube with an oval section beside the node's own axis.
        let point = |slice: usize, corner: usize| {
            let (sin, cos) = (corner as f64 / 32.0 * TAU).sin_cos();
            let size = 10.0 - 5.0 * slice as f64 / 20.0;
            DVec3::new(3.0 + 2.0 * size * cos, 10.0 * slice as f64, size * sin)
        };
        let mut triangles = Vec::new();
        for slice in 0..20 {
            for corner in 0..32 {
                let (a, b, c, d) = (point(slice, corner), point(slice, corner + 1), point(slice + 1, corner), point(slice + 1, corner + 1));
                triangles.extend([[a, b, c], [b, d, c]]);
            }
        }
        let bone = BoneShape::of_triangles(&triangles, DVec3::Y).unwrap();
        for (y, size) in [(30.0, 9.25), (100.0, 7.5), (170.0, 5.75)] {
            for (side, radius) in [(DVec3::X, 2.0 * size), (DVec3::NEG_X, 2.0 * size), (DVec3::Z, size), (DVec3::NEG_Z, size)] {
                let beside = bone.beside(DVec3::new(3.0, y, 0.0) + side * 40.0).unwrap();
                assert!(
                    (beside.radius - radius).abs() < 0.12 * radius && (beside.distance - 40.0).abs() < 0.1,
                    "{y} {side}: {beside:?} {radius}"
                );
            }
        }
        assert_eq!(BoneShape::of_triangles(&triangles[..2], DVec3::Y), None);
        assert_eq!(BoneShape::of_triangles(&triangles, DVec3::ZERO), None);
    }
}

//! Figures of a skin and the muscles under it, in double precision and by other means than the program's own.

use std::f64::consts::PI;

use glam::DVec3;
use sinew::scene::Surface;

/// A surface in a pose.
pub(crate) struct Shape {
    pub(crate) points: Vec<DVec3>,
    pub(crate) triangles: Vec<[u32; 3]>,
}

impl Shape {
    /// A surface of a posed frame.
    pub(crate) fn of(surface: &Surface) -> Self {
        let points = (0..surface.mesh.positions.len() as u32).map(|v| surface.position(v).as_dvec3()).collect();
        Self { points, triangles: surface.mesh.triangles.clone() }
    }

    /// One part of the mesh of a surface.
    pub(crate) fn of_part(surface: &Surface, part: usize) -> Self {
        let range = &surface.mesh.parts[part].triangles;
        let triangles = surface.mesh.triangles[range.start as usize..range.end as usize].to_vec();
        Self { triangles, ..Self::of(surface) }
    }

    /// The points that a triangle has.
    pub(crate) fn used(&self) -> Vec<DVec3> {
        let mut used: Vec<u32> = self.triangles.iter().flatten().copied().collect();
        used.sort_unstable();
        used.dedup();
        used.into_iter().map(|point| self.points[point as usize]).collect()
    }

    fn corners(&self, triangle: &[u32; 3]) -> [DVec3; 3] {
        triangle.map(|point| self.points[point as usize])
    }

    /// How often the surface goes round a point: the sum of the solid angles of its triangles over 4π.
    pub(crate) fn winding(&self, point: DVec3) -> f64 {
        let angle = |triangle: &[u32; 3]| {
            let [a, b, c] = self.corners(triangle).map(|corner| corner - point);
            let [x, y, z] = [a.length(), b.length(), c.length()];
            2.0 * a.dot(b.cross(c)).atan2(x * y * z + a.dot(b) * z + b.dot(c) * x + c.dot(a) * y)
        };
        self.triangles.iter().map(angle).sum::<f64>() / (4.0 * PI)
    }

    /// The share of these points that lie outside.
    pub(crate) fn share_outside(&self, points: &[DVec3]) -> f64 {
        let turned = self.orientation();
        points.iter().filter(|point| self.winding(**point) * turned < 0.5).count() as f64 / points.len().max(1) as f64
    }

    fn volume(&self) -> f64 {
        let middle = self.points.iter().sum::<DVec3>() / self.points.len() as f64;
        let of = |triangle: &[u32; 3]| {
            let [a, b, c] = self.corners(triangle).map(|corner| corner - middle);
            a.dot(b.cross(c)) / 6.0
        };
        self.triangles.iter().map(of).sum()
    }

    fn orientation(&self) -> f64 {
        self.volume().signum()
    }

    /// The volume between two planes square to the line through `from` and `to`, at these shares of it. The surface need not be closed at the planes: the flux
    /// of a field without a component along the line is measured.
    pub(crate) fn volume_between(&self, from: DVec3, to: DVec3, shares: [f64; 2]) -> f64 {
        let along = (to - from).normalize();
        let [low, high] = shares.map(|share| share * from.distance(to));
        let mut sum = 0.0;
        for triangle in &self.triangles {
            let polygon = self.corners(triangle).map(|corner| corner - from).to_vec();
            let polygon = clipped(&polygon, |point| point.dot(along) - low);
            let polygon = clipped(&polygon, |point| high - point.dot(along));
            for index in 1..polygon.len().saturating_sub(1) {
                let [a, b, c] = [polygon[0], polygon[index], polygon[index + 1]];
                let middle = (a + b + c) / 3.0;
                sum += 0.5 * middle.reject_from_normalized(along).dot((b - a).cross(c - a)) * 0.5;
            }
        }
        sum * self.orientation()
    }
}

/// The part of a polygon where `height` is at least 0.
fn clipped(polygon: &[DVec3], height: impl Fn(DVec3) -> f64) -> Vec<DVec3> {
    let mut kept = Vec::new();
    for (index, &point) in polygon.iter().enumerate() {
        let next = polygon[(index + 1) % polygon.len()];
        let (here, there) = (height(point), height(next));
        if here >= 0.0 {
            kept.push(point);
        }
        if (here < 0.0) != (there < 0.0) {
            kept.push(point + (next - point) * (here / (here - there)));
        }
    }
    kept
}

/// The number of pairs of triangles that cross each other and share no point. Points at one place count as one.
pub(crate) fn crossing_pairs(shape: &Shape) -> usize {
    let same: Vec<u32> = {
        let mut first = std::collections::HashMap::new();
        let key = |point: &DVec3| point.to_array().map(|x| (x * 1e6).round() as i64);
        shape.points.iter().enumerate().map(|(index, point)| *first.entry(key(point)).or_insert(index as u32)).collect()
    };
    let triangles: Vec<[u32; 3]> = shape.triangles.iter().map(|triangle| triangle.map(|point| same[point as usize])).collect();
    let bounds: Vec<(DVec3, DVec3)> = triangles
        .iter()
        .map(|triangle| {
            let [a, b, c] = shape.corners(triangle);
            (a.min(b).min(c), a.max(b).max(c))
        })
        .collect();
    // Swept along x.
    let mut order: Vec<usize> = (0..triangles.len()).collect();
    order.sort_by(|a, b| bounds[*a].0.x.total_cmp(&bounds[*b].0.x));
    let mut count = 0;
    for (place, &one) in order.iter().enumerate() {
        for &other in &order[place + 1..] {
            if bounds[other].0.x > bounds[one].1.x {
                break;
            }
            let apart = bounds[one].0.cmpgt(bounds[other].1).any() || bounds[other].0.cmpgt(bounds[one].1).any();
            if apart || triangles[one].iter().any(|point| triangles[other].contains(point)) {
                continue;
            }
            let (a, b) = (shape.corners(&triangles[one]), shape.corners(&triangles[other]));
            if pierces(a, b) || pierces(b, a) {
                count += 1;
            }
        }
    }
    count
}

/// Whether a side of `one` passes through the inside of `other`.
fn pierces(one: [DVec3; 3], other: [DVec3; 3]) -> bool {
    let [a, b, c] = other;
    let volume = |p: DVec3, q: DVec3, r: DVec3, s: DVec3| (q - p).dot((r - p).cross(s - p));
    (0..3).any(|side| {
        let (p, q) = (one[side], one[(side + 1) % 3]);
        if volume(p, a, b, c) * volume(q, a, b, c) >= 0.0 {
            return false;
        }
        let turns = [volume(p, q, a, b), volume(p, q, b, c), volume(p, q, c, a)];
        turns.iter().all(|turn| *turn > 0.0) || turns.iter().all(|turn| *turn < 0.0)
    })
}

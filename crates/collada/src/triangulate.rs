//! Cuts polygons into triangles: ear clipping, holes joined to the outline by bridges.
//!
//! A polygon in space is laid flat along its Newell normal first. Ears that have an area come first; only where none is left
//! (collinear or self-crossing outlines) are others cut, so that every corner stays in some triangle and the surface keeps its winding.

use glam::{DVec2, DVec3, Vec3};

/// What cutting one polygon needs, kept from one to the next.
#[derive(Default)]
pub(super) struct Triangulator {
    flat: Vec<DVec2>,
    /// The outline with its holes joined in: indices into `flat`, each with its neighbours.
    ring: Vec<Corner>,
    /// Positions of the corners that point inwards, close together because every ear is held against all of them, and which corners they are.
    reflex: Vec<(DVec2, usize)>,
}

#[derive(Clone, Copy)]
struct Corner {
    point: usize,
    before: usize,
    after: usize,
    /// Where it stands among the reflex corners; `CONVEX` where it is none.
    reflex: usize,
}

const CONVEX: usize = usize::MAX;

/// Twice the area of a triangle, positive when it runs counter-clockwise.
fn doubled_area(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    (b - a).perp_dot(c - a)
}

impl Triangulator {
    /// Cuts the polygon whose corners are `points`; `rings` are the lengths of the outline and of each hole, in order. Appends index triples to
    /// `triangles`. Takes what it does from `steps`; `false` where they run out, and nothing is appended.
    pub(super) fn cut(&mut self, points: &[Vec3], rings: &[usize], steps: &mut u64, triangles: &mut Vec<[u32; 3]>) -> bool {
        let outline = rings.first().copied().unwrap_or(0).min(points.len());
        match (outline, rings.len()) {
            (0..=2, _) => return true,
            (3, 1) => {
                triangles.push([0, 1, 2]);
                return true;
            }
            _ => {}
        }
        if let ([a, b, c, d], 1) = (points, rings.len())
            && outline == 4
        {
            // The diagonal lies inside where both halves face the same way; most quads are done here.
            let across = *c - *a;
            if (*b - *a).cross(across).dot(across.cross(*d - *a)) > 0.0 {
                triangles.extend([[0, 1, 2], [0, 2, 3]]);
                return true;
            }
        }
        let normal = newell(points.get(..outline).unwrap_or_default());
        self.flatten(points, normal);
        if rings.len() == 1 && self.is_convex(outline) {
            triangles.extend((1..outline as u32 - 1).map(|i| [0, i, i + 1]));
            return true;
        }
        let done = triangles.len();
        if self.join(rings, steps) && self.clip(steps, triangles) {
            return true;
        }
        triangles.truncate(done);
        false
    }

    /// Lays the points flat so that the outline runs counter-clockwise.
    fn flatten(&mut self, points: &[Vec3], normal: DVec3) {
        let side = normal.any_orthonormal_vector();
        let up = normal.cross(side);
        self.flat.clear();
        self.flat.extend(points.iter().map(|p| {
            let p = p.as_dvec3();
            let flat = DVec2::new(p.dot(side), p.dot(up));
            if flat.is_finite() { flat } else { DVec2::ZERO }
        }));
    }

    /// Whether every corner of the outline turns left, and all of them turn once round.
    fn is_convex(&self, outline: usize) -> bool {
        let Some(points) = self.flat.get(..outline) else { return false };
        let mut turned = 0.0;
        let corners = points.iter().zip(points.iter().cycle().skip(1)).zip(points.iter().cycle().skip(2));
        for ((a, b), c) in corners {
            let (ab, bc) = (*b - *a, *c - *b);
            let turn = ab.perp_dot(bc);
            if turn < 0.0 || (turn == 0.0 && ab.dot(bc) <= 0.0) {
                return false;
            }
            turned += ab.angle_to(bc);
        }
        turned < 1.5 * std::f64::consts::TAU
    }

    /// Builds the ring: the outline, with each hole cut in along a bridge, the hole with the rightmost corner first.
    fn join(&mut self, rings: &[usize], steps: &mut u64) -> bool {
        self.ring.clear();
        let mut start = 0;
        let mut holes = Vec::new();
        for (i, length) in rings.iter().enumerate() {
            let range = start..(start + length).min(self.flat.len());
            start = range.end;
            if i == 0 {
                self.append(&range.collect::<Vec<_>>());
            } else if range.len() >= 3 {
                let mut order: Vec<usize> = range.collect();
                // A hole runs against its outline.
                let area: f64 = (0..order.len()).map(|i| self.at(order[i]).perp_dot(self.at(order[(i + 1) % order.len()]))).sum();
                if area > 0.0 {
                    order.reverse();
                }
                let right = (0..order.len()).max_by(|a, b| self.at(order[*a]).x.total_cmp(&self.at(order[*b]).x)).unwrap_or(0);
                order.rotate_left(right);
                holes.push(order);
            }
        }
        holes.sort_by(|a, b| self.at(b[0]).x.total_cmp(&self.at(a[0]).x));
        for hole in &holes {
            match steps.checked_sub(self.ring.len() as u64 + hole.len() as u64) {
                Some(left) => *steps = left,
                None => return false,
            }
            let bridge = self.bridge(self.at(hole[0]));
            // The bridge goes from the ring's corner to the hole, round it, and back: both ends stand twice.
            let mut order = Vec::with_capacity(hole.len() + 2);
            order.extend_from_slice(hole);
            order.push(hole[0]);
            order.push(self.ring[bridge].point);
            let after = self.ring[bridge].after;
            let first = self.ring.len();
            for (i, point) in order.iter().enumerate() {
                let before = if i == 0 { bridge } else { first + i - 1 };
                let next = if i + 1 == order.len() { after } else { first + i + 1 };
                self.ring.push(Corner { point: *point, before, after: next, reflex: CONVEX });
            }
            let last = self.ring.len() - 1;
            self.ring[after].before = last;
            self.ring[bridge].after = first;
        }
        self.reflex.clear();
        for i in 0..self.ring.len() {
            self.mark(i);
        }
        true
    }

    fn append(&mut self, order: &[usize]) {
        let length = order.len();
        self.ring.extend(order.iter().enumerate().map(|(i, point)| Corner {
            point: *point,
            before: (i + length - 1) % length,
            after: (i + 1) % length,
            reflex: CONVEX,
        }));
    }

    /// A flat point; indices come from `flat`'s own length.
    fn at(&self, point: usize) -> DVec2 {
        self.flat.get(point).copied().unwrap_or(DVec2::ZERO)
    }

    /// The corner of the ring that `from`, the rightmost corner of a hole, sees: shoot a ray to the right, take the edge that it meets first, and
    /// from its further end move to a reflex corner inside the triangle between, if there is one (D. Eberly, "Triangulation by Ear Clipping").
    fn bridge(&self, from: DVec2) -> usize {
        let mut hit = f64::INFINITY;
        let mut best = 0;
        let mut seen = false;
        for (i, corner) in self.ring.iter().enumerate() {
            let (a, b) = (self.at(corner.point), self.at(self.ring[corner.after].point));
            // The ring is counter-clockwise: edges to the right of the hole go up.
            if a.y <= from.y && b.y >= from.y && a.y != b.y {
                let x = a.x + (from.y - a.y) / (b.y - a.y) * (b.x - a.x);
                if x >= from.x && x < hit {
                    hit = x;
                    best = if a.x > b.x { i } else { corner.after };
                    seen = true;
                }
            }
        }
        if !seen {
            // The hole lies outside: any corner will do, the nearest makes the least harm.
            let near = |i: &usize| self.at(self.ring[*i].point).distance_squared(from);
            return (0..self.ring.len()).min_by(|a, b| near(a).total_cmp(&near(b))).unwrap_or(0);
        }
        let end = self.at(self.ring[best].point);
        let meet = DVec2::new(hit, from.y);
        let mut flattest = f64::INFINITY;
        let mut found = best;
        for (i, corner) in self.ring.iter().enumerate() {
            let p = self.at(corner.point);
            if p.x < from.x || !in_triangle(p, from, meet, end) || (i != best && p != end && !self.is_reflex(i)) {
                continue;
            }
            let slope = (p.y - from.y).abs() / (p.x - from.x).max(f64::MIN_POSITIVE);
            // Among corners on one spot the one whose inside the bridge enters.
            if (slope < flattest
                || (slope == flattest && p.distance_squared(from) < self.at(self.ring[found].point).distance_squared(from)))
                && self.opens_towards(i, from)
            {
                flattest = slope;
                found = i;
            }
        }
        found
    }

    /// Whether the line from corner `i` to `target` starts inside the polygon.
    fn opens_towards(&self, i: usize, target: DVec2) -> bool {
        let corner = self.ring[i];
        let (before, here, after) =
            (self.at(self.ring[corner.before].point), self.at(corner.point), self.at(self.ring[corner.after].point));
        if doubled_area(before, here, after) >= 0.0 {
            doubled_area(here, target, before) >= 0.0 && doubled_area(here, after, target) >= 0.0
        } else {
            !(doubled_area(here, target, after) > 0.0 && doubled_area(here, before, target) > 0.0)
        }
    }

    fn is_reflex(&self, i: usize) -> bool {
        let corner = self.ring[i];
        doubled_area(self.at(self.ring[corner.before].point), self.at(corner.point), self.at(self.ring[corner.after].point)) <= 0.0
    }

    /// Brings the list of reflex corners up to date with corner `i`.
    fn mark(&mut self, i: usize) {
        if !self.is_reflex(i) {
            self.unmark(i);
        } else if self.ring[i].reflex == CONVEX {
            self.ring[i].reflex = self.reflex.len();
            self.reflex.push((self.at(self.ring[i].point), i));
        }
    }

    fn unmark(&mut self, i: usize) {
        let slot = std::mem::replace(&mut self.ring[i].reflex, CONVEX);
        if slot != CONVEX {
            self.reflex.swap_remove(slot);
            if let Some((_, moved)) = self.reflex.get(slot) {
                self.ring[*moved].reflex = slot;
            }
        }
    }

    /// Cuts ears until a triangle is left.
    fn clip(&mut self, steps: &mut u64, triangles: &mut Vec<[u32; 3]>) -> bool {
        let mut left = self.ring.len();
        let mut here = 0;
        let mut tried = 0;
        // 0: ears with an area; 1: also flat ones; 2: anything, since the outline crosses itself.
        let mut patience = 0;
        while left > 3 {
            match steps.checked_sub(1 + self.reflex.len() as u64) {
                Some(left) => *steps = left,
                None => return false,
            }
            if patience == 2 || self.is_ear(here, patience == 1) {
                let corner = self.ring[here];
                triangles.push([self.ring[corner.before].point as u32, corner.point as u32, self.ring[corner.after].point as u32]);
                self.unmark(here);
                self.ring[corner.before].after = corner.after;
                self.ring[corner.after].before = corner.before;
                self.mark(corner.before);
                self.mark(corner.after);
                left -= 1;
                tried = 0;
                patience = 0;
                // Going on after the next corner gives fatter triangles than cutting round one spot.
                here = self.ring[corner.after].after;
            } else {
                here = self.ring[here].after;
                tried += 1;
                if tried > left {
                    tried = 0;
                    patience += 1;
                }
            }
        }
        let corner = self.ring[here];
        triangles.push([self.ring[corner.before].point as u32, corner.point as u32, self.ring[corner.after].point as u32]);
        true
    }

    fn is_ear(&self, i: usize, flat_too: bool) -> bool {
        let corner = self.ring[i];
        let (a, b, c) = (self.at(self.ring[corner.before].point), self.at(corner.point), self.at(self.ring[corner.after].point));
        let area = doubled_area(a, b, c);
        if flat_too && area == 0.0 {
            return true;
        }
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        let apart = |p: DVec2| p.x < low.x || p.x > high.x || p.y < low.y || p.y > high.y;
        // Only a reflex corner can stand in an ear. Bridges put several corners on one spot; those do not stand in the way.
        area > 0.0 && !self.reflex.iter().any(|(p, _)| !apart(*p) && *p != a && *p != b && *p != c && in_triangle(*p, a, b, c))
    }
}

/// Whether `p` lies in or on the triangle, whichever way it runs.
fn in_triangle(p: DVec2, a: DVec2, b: DVec2, c: DVec2) -> bool {
    let (u, v, w) = (doubled_area(a, b, p), doubled_area(b, c, p), doubled_area(c, a, p));
    (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0)
}

/// The unit normal of a polygon, which need not be flat (M. Newell's sum); +Z for one without an area.
fn newell(points: &[Vec3]) -> DVec3 {
    let origin = points.first().map_or(DVec3::ZERO, |p| p.as_dvec3());
    let mut sum = DVec3::ZERO;
    for (a, b) in points.iter().zip(points.iter().cycle().skip(1)) {
        sum += (a.as_dvec3() - origin).cross(b.as_dvec3() - origin);
    }
    sum.try_normalize().unwrap_or(DVec3::Z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn cut(points: &[Vec3], rings: &[usize]) -> Vec<[u32; 3]> {
        let mut triangles = Vec::new();
        assert!(Triangulator::default().cut(points, rings, &mut u64::MAX.clone(), &mut triangles));
        triangles
    }

    /// Signed area of the triangles, seen from +Z, and the same without signs.
    fn areas(points: &[Vec3], triangles: &[[u32; 3]]) -> (f32, f32) {
        let area = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|i| points[i as usize].truncate());
            (b - a).perp_dot(c - a) / 2.0
        };
        (triangles.iter().map(area).sum(), triangles.iter().map(|t| area(t).abs()).sum())
    }

    fn flat(points: &[(f32, f32)]) -> Vec<Vec3> {
        points.iter().map(|(x, y)| Vec3::new(*x, *y, 0.0)).collect()
    }

    #[test]
    fn concave_polygons_are_covered_once() {
        let arrow = flat(&[(0.0, 0.0), (2.0, 1.0), (0.0, 2.0), (0.5, 1.0)]);
        let triangles = cut(&arrow, &[4]);
        assert_eq!(triangles.len(), 2);
        let (signed, plain) = areas(&arrow, &triangles);
        assert!((signed - 1.5).abs() < 1e-6 && (plain - 1.5).abs() < 1e-6);
        // A comb of 66 corners.
        let mut comb = vec![(0.0, 0.0), (32.0, 0.0)];
        for tooth in (0..32).rev() {
            comb.push((tooth as f32 + 0.9, 5.0));
            comb.push((tooth as f32 + 0.1, 1.0));
        }
        let comb = flat(&comb);
        let triangles = cut(&comb, &[comb.len()]);
        assert_eq!(triangles.len(), 64);
        let (signed, plain) = areas(&comb, &triangles);
        assert!((signed - plain).abs() < 1e-3, "{signed} {plain}");
    }

    #[test]
    fn holes_stay_open_whichever_way_they_run() {
        let mut points = flat(&[(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)]);
        points.extend(flat(&[(1.0, 1.0), (2.0, 1.0), (2.0, 2.0), (1.0, 2.0)]));
        points.extend(flat(&[(5.0, 5.0), (5.0, 8.0), (8.0, 8.0), (8.0, 5.0)]));
        points.extend(flat(&[(3.0, 1.0), (4.0, 1.0), (3.5, 2.0)]));
        let triangles = cut(&points, &[4, 4, 4, 3]);
        let (signed, plain) = areas(&points, &triangles);
        let wanted = 100.0 - 1.0 - 9.0 - 0.5;
        assert!((signed - wanted).abs() < 1e-4 && (plain - wanted).abs() < 1e-4, "{signed} {plain}");
        assert_eq!(triangles.len(), 15 + 2 * 3 - 2);
    }

    #[test]
    fn a_polygon_in_space_keeps_its_winding() {
        let turned: Vec<Vec3> =
            flat(&[(0.0, 0.0), (2.0, 1.0), (0.0, 2.0), (0.5, 1.0)]).iter().map(|p| Vec3::new(p.y, p.x, p.x + p.y)).collect();
        let normal = newell(&turned);
        for [a, b, c] in cut(&turned, &[4]) {
            let [a, b, c] = [a, b, c].map(|i| turned[i as usize].as_dvec3());
            assert!((b - a).cross(c - a).dot(normal) > 0.0);
        }
    }

    #[test]
    fn collinear_crossing_and_empty_outlines_end() {
        assert_eq!(cut(&flat(&[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (3.0, 0.0)]), &[4]).len(), 2);
        assert_eq!(cut(&flat(&[(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)]), &[4]).len(), 2);
        assert_eq!(cut(&[Vec3::NAN; 5], &[5]).len(), 3);
        assert!(cut(&[], &[0]).is_empty());
        let square_with_point = flat(&[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)]);
        let triangles = cut(&square_with_point, &[5]);
        assert_eq!(triangles.len(), 3);
        assert!((areas(&square_with_point, &triangles).0 - 4.0).abs() < 1e-6);
    }

    #[test]
    fn too_many_steps_are_refused() {
        let star: Vec<Vec3> = (0..2000)
            .map(|i| {
                let (angle, radius) = (i as f32 / 2000.0 * std::f32::consts::TAU, if i % 2 == 0 { 1.0 } else { 0.1 });
                Vec3::new(angle.cos() * radius, angle.sin() * radius, 0.0)
            })
            .collect();
        let mut triangles = vec![[7; 3]];
        assert!(!Triangulator::default().cut(&star, &[2000], &mut 10_000, &mut triangles));
        assert_eq!(triangles, [[7; 3]]);
        assert_eq!(cut(&star, &[2000]).len(), 1998);
    }

    proptest! {
        #[test]
        fn stars_of_any_shape_are_covered_once(radii in prop::collection::vec(0.1f32..10.0, 4..40)) {
            let count = radii.len() as f32;
            let points: Vec<Vec3> = radii.iter().enumerate().map(|(i, r)| {
                let angle = i as f32 / count * std::f32::consts::TAU;
                Vec3::new(angle.cos() * r, angle.sin() * r, 0.0)
            }).collect();
            let wanted: f32 = (0..points.len()).map(|i| points[i].truncate().perp_dot(points[(i + 1) % points.len()].truncate()) / 2.0).sum();
            let (signed, plain) = areas(&points, &cut(&points, &[points.len()]));
            prop_assert!((signed - wanted).abs() < 1e-3 * wanted.abs().max(1.0));
            prop_assert!((plain - wanted).abs() < 1e-3 * wanted.abs().max(1.0));
        }

        #[test]
        fn random_outlines_and_holes_end(points in prop::collection::vec((-5i8..5, -5i8..5), 3..30), cut_at in 3usize..10) {
            let points: Vec<Vec3> = points.iter().map(|(x, y)| Vec3::new(f32::from(*x), f32::from(*y), 0.0)).collect();
            let outline = cut_at.min(points.len());
            let triangles = cut(&points, &[outline, points.len() - outline]);
            prop_assert!(triangles.iter().flatten().all(|i| (*i as usize) < points.len()));
        }
    }
}

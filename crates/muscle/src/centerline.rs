//! Curves that a muscle's centre line is made of: straight pieces and circular arcs, each exact in length, with a frame that does not twist.
//!
//! Arcs keep everything closed: the length is a product, the cross-sections stand perpendicular by construction, and where radius × curvature
//! stays below 1 Pappus' theorem makes the volume round a bent line exactly that round a straight one.

use glam::DVec3;

/// Most pieces of one path.
pub(super) const PIECES: usize = 32;

/// A straight piece or an arc.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Segment {
    start: DVec3,
    tangent: DVec3,
    /// Unit vector towards the centre of the arc; any perpendicular one on a straight piece.
    normal: DVec3,
    binormal: DVec3,
    /// 1 / radius; 0 = straight.
    curvature: f64,
    length: f64,
    /// Components of the frame's first axis along `normal` and `binormal`.
    along: (f64, f64),
}

/// Where a cross-section stands: `u`, `v`, `tangent` are perpendicular unit vectors, right-handed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CrossSectionFrame {
    /// Centre.
    pub position: DVec3,
    /// Direction of the path.
    pub tangent: DVec3,
    /// First axis of the cross-section.
    pub u: DVec3,
    /// Second axis of the cross-section.
    pub v: DVec3,
    /// Curvature of the path here, 1 / length.
    pub curvature: f64,
    /// Towards the centre of curvature; of no meaning where the curvature is 0.
    pub normal: DVec3,
}

/// A centre line. Lives on the stack, so that laying a muscle allocates nothing.
#[derive(Debug, Clone)]
pub struct Path {
    pieces: [Segment; PIECES],
    count: usize,
    length: f64,
    /// The frame's first axis at the end.
    u: DVec3,
}

impl Path {
    /// An empty path whose cross-sections will have their first axis as near `u` as the first piece's direction allows.
    pub fn new(u: DVec3) -> Self {
        Self { pieces: [Segment::default(); PIECES], count: 0, length: 0.0, u }
    }

    /// Length of all pieces.
    pub fn length(&self) -> f64 {
        self.length
    }

    /// The pieces' largest curvature over `range` of the length.
    pub fn sharpest(&self, from: f64, to: f64) -> f64 {
        let (mut start, mut most) = (0.0, 0.0_f64);
        for piece in self.pieces.iter().take(self.count) {
            let end = start + piece.length;
            if end > from && start < to {
                most = most.max(piece.curvature);
            }
            start = end;
        }
        most
    }

    /// Adds a straight piece; nothing where it has no length or the path is full.
    pub fn line(&mut self, start: DVec3, end: DVec3) {
        let Some(tangent) = (end - start).try_normalize() else { return };
        let u = perpendicular(self.u, tangent);
        self.push(Segment {
            start,
            tangent,
            normal: u,
            binormal: tangent.cross(u),
            curvature: 0.0,
            length: start.distance(end),
            along: (1.0, 0.0),
        });
        self.u = u;
    }

    /// Adds an arc that leaves `start` along the unit vector `tangent` and bends towards the unit vector `normal` (perpendicular to it) through
    /// `angle` radians with this radius.
    pub fn arc(&mut self, start: DVec3, tangent: DVec3, normal: DVec3, radius: f64, angle: f64) {
        if !(radius > 0.0 && angle > 0.0) {
            return;
        }
        let binormal = tangent.cross(normal);
        let u = perpendicular(self.u, tangent);
        let along = (u.dot(normal), u.dot(binormal));
        self.push(Segment { start, tangent, normal, binormal, curvature: 1.0 / radius, length: radius * angle, along });
        let (sin, cos) = angle.sin_cos();
        self.u = along.0 * (normal * cos - tangent * sin) + along.1 * binormal;
    }

    fn push(&mut self, piece: Segment) {
        if let Some(slot) = self.pieces.get_mut(self.count) {
            *slot = piece;
            self.count += 1;
            self.length += piece.length;
        }
    }

    /// A path of exactly `length` from `start` to `end`, which lie at most `length` apart, bulging towards `side`: an arc, a straight middle, and
    /// an arc that mirrors the first. Each arc takes the share `shoulder` (at most ½) of the length.
    ///
    /// With `θ` the angle at which it leaves the chord `c`, the arcs have the radius `s / θ` over their length `s = shoulder · L`, so
    /// `c = L − 2 s (1 − sin θ / θ)`; `θ` is found by Newton's method. Where even a full arch is too short, it is scaled to end at `end`.
    pub fn arc_between(start: DVec3, end: DVec3, length: f64, shoulder: f64, side: DVec3) -> Self {
        let chord = end - start;
        let distance = chord.length();
        let along = chord.try_normalize().unwrap_or(DVec3::NEG_Y);
        let up = perpendicular(side, along);
        let mut path = Self::new(up);
        let shoulder_length = shoulder * length;
        let slack = length - distance;
        let theta = if slack > 1e-12 * length { angle_of_slack(slack / (2.0 * shoulder_length)) } else { 0.0 };
        if theta < 1e-7 {
            path.line(start, end);
            return path;
        }
        let (sin, cos) = theta.sin_cos();
        let radius = shoulder_length / theta;
        let (first, normal) = (along * cos + up * sin, along * sin - up * cos);
        path.arc(start, first, normal, radius, theta);
        let top = start + first * (radius * sin) + normal * (radius * (1.0 - cos));
        let flat = (1.0 - 2.0 * shoulder) * length;
        if flat > 0.0 {
            path.line(top, top + along * flat);
        }
        path.arc(top + along * flat, along, -up, radius, theta);
        path
    }

    /// The cross-section at length `at` from the start; before the start and after the end it goes straight on.
    pub fn frame_at(&self, at: f64) -> CrossSectionFrame {
        self.cursor().frame_at(at)
    }

    /// Walks along the path: frames asked for in rising order are found in one pass.
    pub fn cursor(&self) -> Cursor<'_> {
        Cursor { path: self, piece: 0, start: 0.0 }
    }
}

/// A place on a path that only moves forward.
#[derive(Debug, Clone)]
pub struct Cursor<'a> {
    path: &'a Path,
    piece: usize,
    /// Length before the present piece.
    start: f64,
}

impl Cursor<'_> {
    /// The cross-section at length `at` from the start, not before the piece of the last one asked for.
    pub fn frame_at(&mut self, at: f64) -> CrossSectionFrame {
        let path = self.path;
        while let (Some(piece), true) = (path.pieces.get(self.piece), self.piece + 1 < path.count) {
            if at <= self.start + piece.length {
                break;
            }
            self.start += piece.length;
            self.piece += 1;
        }
        // `PIECES` is not zero and `piece` stays below `count`, so the piece is there; an empty path gives a piece of zeros.
        let piece = path.pieces.get(self.piece).copied().unwrap_or_default();
        piece.frame_at(at - self.start)
    }
}

impl Segment {
    fn frame_at(&self, at: f64) -> CrossSectionFrame {
        let inside = at.clamp(0.0, self.length);
        let (sin, cos) = (self.curvature * inside).sin_cos();
        let tangent = self.tangent * cos + self.normal * sin;
        let normal = self.normal * cos - self.tangent * sin;
        let position = if self.curvature > 0.0 {
            self.start + self.tangent * (sin / self.curvature) + self.normal * ((1.0 - cos) / self.curvature)
        } else {
            self.start + self.tangent * inside
        };
        let u = normal * self.along.0 + self.binormal * self.along.1;
        CrossSectionFrame {
            position: position + tangent * (at - inside),
            tangent,
            u,
            v: tangent.cross(u),
            curvature: self.curvature,
            normal,
        }
    }
}

/// The unit vector nearest `wish` that is perpendicular to the unit vector `axis`.
pub(super) fn perpendicular(wish: DVec3, axis: DVec3) -> DVec3 {
    let across = wish - axis * wish.dot(axis);
    // Below this the direction would be rounding noise.
    if across.length_squared() > 1e-12 * wish.length_squared() {
        across.normalize_or(axis.any_orthonormal_vector())
    } else {
        axis.any_orthonormal_vector()
    }
}

/// The angle θ in 0..π with `1 − sin θ / θ = slack`; π where the slack is 1 or more.
fn angle_of_slack(slack: f64) -> f64 {
    use std::f64::consts::PI;
    if slack >= 1.0 {
        return PI;
    }
    // 1 − sinc θ ≈ θ² / 6 near 0: a start below the root of a function that rises and is convex there, then concave; Newton stays bracketed.
    let (mut low, mut high) = (0.0, PI);
    let mut theta = (6.0 * slack).sqrt().min(0.9 * PI);
    for _ in 0..60 {
        let error = one_minus_sinc(theta) - slack;
        if error > 0.0 {
            high = theta
        } else {
            low = theta
        }
        let slope = (theta.sin() - theta * theta.cos()) / (theta * theta);
        let next = theta - error / slope;
        let next = if next > low && next < high { next } else { 0.5 * (low + high) };
        if (next - theta).abs() <= 1e-16 * theta {
            break;
        }
        theta = next;
    }
    theta
}

/// 1 − sin x / x without cancellation near 0.
fn one_minus_sinc(x: f64) -> f64 {
    let xx = x * x;
    if xx < 0.25 {
        // Taylor: x²/3! − x⁴/5! + x⁶/7! − …, beyond rounding for |x| < ½.
        xx / 6.0 * (1.0 - xx / 20.0 * (1.0 - xx / 42.0 * (1.0 - xx / 72.0 * (1.0 - xx / 110.0 * (1.0 - xx / 156.0)))))
    } else {
        1.0 - x.sin() / x
    }
}

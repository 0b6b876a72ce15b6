//! Curves that a muscle's centreline is made of: straight pieces, circular arcs and geodesics, each exact in length, with a frame that does not twist.
//!
//! Cross-sections stand perpendicular by construction, and where radius × curvature stays below 1 Pappus' theorem makes the volume round a bent line exactly
//! that round a straight one.

use glam::DVec3;

use super::wrapping::Arc;

/// A geodesic that is no circle is drawn in pieces that turn by about this much, radians: a cubic through both ends is off by 1e-5 of the radius of curvature.
const TURN: f64 = 0.25;
/// Most pieces of one geodesic.
const GEODESIC_PIECES: usize = 48;

/// A piece of a centreline.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Piece {
    Arc(Segment),
    Curve(CurvePiece),
}

impl Piece {
    fn length(&self) -> f64 {
        match self {
            Self::Arc(segment) => segment.length,
            Self::Curve(curve) => curve.length,
        }
    }

    fn curvature(&self) -> f64 {
        match self {
            Self::Arc(segment) => segment.curvature,
            Self::Curve(curve) => curve.curvature,
        }
    }

    fn frame_at(&self, at: f64) -> CrossSectionFrame {
        match self {
            Self::Arc(segment) => segment.frame_at(at),
            Self::Curve(curve) => curve.frame_at(at),
        }
    }
}

/// A piece of a curve by its ends and the directions there: the cubic between them, as a function of the length of the curve itself.
#[derive(Debug, Clone, Copy, PartialEq)]
struct CurvePiece {
    start: DVec3,
    start_tangent: DVec3,
    end: DVec3,
    end_tangent: DVec3,
    length: f64,
    /// The frame's first axis at the start.
    u: DVec3,
    /// The largest of both halves, as the angle between directions over the length.
    curvature: f64,
}

impl CurvePiece {
    /// The length of the cubic, by Gauss' rule with five points.
    fn measured(&self) -> f64 {
        const NODES: [(f64, f64); 5] = [
            (0.046_910_077_030_668_0, 0.118_463_442_528_094_55),
            (0.230_765_344_947_158_45, 0.239_314_335_249_683_23),
            (0.5, 0.284_444_444_444_444_44),
            (0.769_234_655_052_841_6, 0.239_314_335_249_683_23),
            (0.953_089_922_969_332, 0.118_463_442_528_094_55),
        ];
        NODES.iter().map(|(t, weight)| weight * self.slope(*t).length()).sum()
    }

    /// The derivative by t, which goes from 0 to 1.
    fn slope(&self, t: f64) -> DVec3 {
        let (m, n) = (self.start_tangent * self.length, self.end_tangent * self.length);
        (self.end - self.start) * (6.0 * t * (1.0 - t)) + m * ((1.0 - t) * (1.0 - 3.0 * t)) + n * (t * (3.0 * t - 2.0))
    }

    fn frame_at(&self, at: f64) -> CrossSectionFrame {
        let inside = at.clamp(0.0, self.length);
        let t = inside / self.length;
        let (m, n) = (self.start_tangent * self.length, self.end_tangent * self.length);
        let chord = self.end - self.start;
        let position = self.start + chord * (t * t * (3.0 - 2.0 * t)) + m * (t * (1.0 - t) * (1.0 - t)) - n * (t * t * (1.0 - t));
        let slope = self.slope(t);
        let bend = chord * (6.0 - 12.0 * t) + m * (6.0 * t - 4.0) + n * (6.0 * t - 2.0);
        let tangent = slope.normalize_or(self.start_tangent);
        let normal = bend.reject_from_normalized(tangent).normalize_or(DVec3::ZERO);
        let u = carried(self.u, (self.start, self.start_tangent), (position, tangent));
        let curvature = bend.reject_from_normalized(tangent).length() / slope.length_squared().max(f64::MIN_POSITIVE);
        CrossSectionFrame { position: position + tangent * (at - inside), tangent, u, v: tangent.cross(u), curvature, normal }
    }
}

/// The axis `u` of a cross-section carried along a curve from one place and direction to another near by, without twist: two reflections
/// [Wang, Jüttler, Zheng & Liu 2008, Computation of rotation minimizing frames].
fn carried(u: DVec3, from: (DVec3, DVec3), to: (DVec3, DVec3)) -> DVec3 {
    let mirrored = |vector: DVec3, normal: DVec3| {
        let square = normal.length_squared();
        if square > f64::MIN_POSITIVE { vector - normal * (2.0 * normal.dot(vector) / square) } else { vector }
    };
    let between = to.0 - from.0;
    // Two places that differ by a rounding have no direction between them.
    if between.dot(from.1) <= 0.5 * between.length() {
        return perpendicular(u, to.1);
    }
    let (u, tangent) = (mirrored(u, between), mirrored(from.1, between));
    perpendicular(mirrored(u, to.1 - tangent), to.1)
}

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

/// The line through the centres of a muscle's cross-sections.
#[derive(Debug, Clone, Default)]
pub struct Centerline {
    pieces: Vec<Piece>,
    length: f64,
    /// The frame's first axis at the end.
    u: DVec3,
}

impl Centerline {
    /// An empty line whose cross-sections will have their first axis as near `u` as the first piece's direction allows.
    pub fn new(u: DVec3) -> Self {
        Self { pieces: Vec::new(), length: 0.0, u }
    }

    /// Makes it an empty line, whose memory is kept.
    pub(super) fn begin(&mut self, u: DVec3) {
        self.pieces.clear();
        // Room for the lines of most poses, so that none of them asks for more.
        self.pieces.reserve(GEODESIC_PIECES);
        (self.length, self.u) = (0.0, u);
    }

    /// Length of all pieces.
    pub fn length(&self) -> f64 {
        self.length
    }

    /// The pieces' largest curvature over `range` of the length.
    pub fn sharpest(&self, from: f64, to: f64) -> f64 {
        let (mut start, mut most) = (0.0, 0.0_f64);
        for piece in &self.pieces {
            let end = start + piece.length();
            if end > from && start < to {
                most = most.max(piece.curvature());
            }
            start = end;
        }
        most
    }

    /// Adds a straight piece; nothing where it has no length.
    pub fn line(&mut self, start: DVec3, end: DVec3) {
        let Some(tangent) = (end - start).try_normalize() else { return };
        let u = perpendicular(self.u, tangent);
        self.push(Piece::Arc(Segment {
            start,
            tangent,
            normal: u,
            binormal: tangent.cross(u),
            curvature: 0.0,
            length: start.distance(end),
            along: (1.0, 0.0),
        }));
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
        self.push(Piece::Arc(Segment { start, tangent, normal, binormal, curvature: 1.0 / radius, length: radius * angle, along }));
        let (sin, cos) = angle.sin_cos();
        self.u = along.0 * (normal * cos - tangent * sin) + along.1 * binormal;
    }

    /// Adds a geodesic of a solved line: an arc where it is a circle, else pieces of a curve.
    pub(super) fn geodesic(&mut self, arc: &Arc) {
        if let Some(radius) = arc.circle() {
            self.arc(arc.start, arc.start_tangent, -arc.start_normal(), radius, arc.length / radius);
            return;
        }
        let count = ((arc.turn() / TURN).ceil().max(1.0) as usize).min(GEODESIC_PIECES);
        let length = arc.length / count as f64;
        self.u = perpendicular(self.u, arc.start_tangent);
        let mut before: Option<(DVec3, DVec3)> = None;
        for (end, end_tangent) in arc.sample(count + 1) {
            if let Some((start, start_tangent)) = before {
                let middle = (end - start).normalize_or(start_tangent);
                let curvature = 2.0 * (angle(start_tangent, middle).max(angle(middle, end_tangent))) / length;
                let piece = CurvePiece { start, start_tangent, end, end_tangent, length, u: self.u, curvature };
                self.u = carried(self.u, (start, start_tangent), (end, end_tangent));
                self.push(Piece::Curve(piece));
            }
            before = Some((end, end_tangent));
        }
    }

    /// Adds a smooth curve through `count` points that follow one another at about even spacing, with these directions at them.
    pub(super) fn through(&mut self, count: usize, point: impl Fn(usize) -> (DVec3, DVec3)) {
        let last = count.saturating_sub(1);
        let (at, direction) = (|index: usize| point(index).0, |index: usize| point(index).1.normalize_or(DVec3::X));
        self.u = perpendicular(self.u, direction(0));
        for index in 0..last {
            let (start, end) = (at(index), at(index + 1));
            let (start_tangent, end_tangent) = (direction(index), direction(index + 1));
            let chord = start.distance(end);
            let piece = CurvePiece { start, start_tangent, end, end_tangent, length: chord, u: self.u, curvature: 0.0 };
            let length = piece.measured();
            let middle = (end - start).normalize_or(start_tangent);
            let curvature = 2.0 * angle(start_tangent, middle).max(angle(middle, end_tangent)) / length.max(f64::MIN_POSITIVE);
            self.u = carried(self.u, (start, start_tangent), (end, end_tangent));
            if length > 0.0 {
                self.push(Piece::Curve(CurvePiece { length, curvature, ..piece }));
            }
        }
    }

    fn push(&mut self, piece: Piece) {
        self.length += piece.length();
        self.pieces.push(piece);
    }

    /// A path of exactly `length` from `start` to `end`, which lie at most `length` apart, bulging towards `side`: an arc, a straight middle, and
    /// an arc that mirrors the first. Each arc takes the share `shoulder` (at most ½) of the length.
    ///
    /// With `θ` the angle at which it leaves the chord `c`, the arcs have the radius `s / θ` over their length `s = shoulder · L`, so
    /// `c = L − 2 s (1 − sin θ / θ)`; `θ` is found by Newton's method. Where even a full arch is too short, it is scaled to end at `end`.
    pub fn arc_between(start: DVec3, end: DVec3, length: f64, shoulder: f64, side: DVec3) -> Self {
        let mut path = Self::default();
        path.arch(start, end, length, shoulder, side);
        path
    }

    /// Makes it [`Centerline::arc_between`]; its memory is kept.
    pub(super) fn arch(&mut self, start: DVec3, end: DVec3, length: f64, shoulder: f64, side: DVec3) {
        let chord = end - start;
        let distance = chord.length();
        let along = chord.try_normalize().unwrap_or(DVec3::NEG_Y);
        let up = perpendicular(side, along);
        let path = self;
        path.begin(up);
        let shoulder_length = shoulder * length;
        let slack = length - distance;
        let theta = if slack > 1e-12 * length { angle_of_slack(slack / (2.0 * shoulder_length)) } else { 0.0 };
        if theta < 1e-7 {
            path.line(start, end);
            return;
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
    path: &'a Centerline,
    piece: usize,
    /// Length before the present piece.
    start: f64,
}

impl Cursor<'_> {
    /// The cross-section at length `at` from the start, not before the piece of the last one asked for.
    pub fn frame_at(&mut self, at: f64) -> CrossSectionFrame {
        let path = self.path;
        while let (Some(piece), true) = (path.pieces.get(self.piece), self.piece + 1 < path.pieces.len()) {
            if at <= self.start + piece.length() {
                break;
            }
            self.start += piece.length();
            self.piece += 1;
        }
        // An empty line gives a piece of zeros.
        let piece = path.pieces.get(self.piece).copied().unwrap_or(Piece::Arc(Segment::default()));
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

/// The angle between two directions, exact for small ones.
fn angle(one: DVec3, other: DVec3) -> f64 {
    one.cross(other).length().atan2(one.dot(other))
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

//! Where a hand's new via point goes, and the ball of a muscle that is to go round a joint.

use glam::{DMat4, DVec3};

use super::MuscleState;
use super::config::{Anchor, Wrap};
use super::line_of_action::{Frames, Line};
use super::muscle_rig::MuscleRig;
use super::retarget::{beside, neat};
use sinew_scene::{Graph, NodeId, Scene};

/// Places along a centre line that are looked at for the nearest one.
const PLACES: u32 = 256;
/// Radius of a new ball over the muscle's thickest radius.
const THICK: f64 = 0.8;
/// A side that is as near as this to an axis of its bone, as a cosine, is that axis: numbers that a person can read.
const NEAR_AXIS: f64 = 0.95;
/// Nearer to the centre line than this share of its length a ball's middle is on it, and the line does not say on which side it passes.
const ON_LINE: f64 = 1e-3;

/// The ball that a muscle goes round, in the world, metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WrapSphere {
    /// Its middle.
    pub center: DVec3,
    /// Its radius.
    pub radius: f64,
    /// The side on which the muscle passes, of length 1.
    pub side: DVec3,
}

impl MuscleRig {
    /// Where a new via point of muscle `index` goes that is to change its way the least: on the drawn centre line, half-way along the longest stretch.
    /// Its number, its bone (that of the point before it) and its place in the world; `None` where nothing holds the muscle.
    pub fn via_half_way(&self, index: usize, drive: MuscleState, world: &[DMat4]) -> Option<(usize, NodeId, DVec3)> {
        let line = self.line(index)?;
        let corners = self.corners(line, world);
        let length = |pair: &[DVec3]| pair[0].distance(pair[1]);
        let (number, pair) = corners.windows(2).enumerate().max_by(|a, b| length(a.1).total_cmp(&length(b.1)))?;
        let before = number.checked_sub(1).and_then(|before| line.via.get(before)).unwrap_or(&line.origin);
        let (place, _) = self.nearest(index, drive, world, 0.5 * (pair[0] + pair[1]))?;
        Some((number, *self.bones.get(before.bone)?, self.root_matrix(world).transform_point3(place)))
    }

    /// The number of a new via point of muscle `index` at a place in the world: the stretch that passes nearest gets it.
    pub fn via_number_at(&self, index: usize, place: DVec3, world: &[DMat4]) -> Option<usize> {
        let corners = self.corners(self.line(index)?, world);
        let place = self.frames(world).from_world.transform_point3(place);
        let away = |pair: &[DVec3]| {
            let along = pair[1] - pair[0];
            let share = (place - pair[0]).dot(along) / along.length_squared().max(f64::MIN_POSITIVE);
            place.distance(pair[0] + along * share.clamp(0.0, 1.0))
        };
        corners.windows(2).enumerate().min_by(|a, b| away(a.1).total_cmp(&away(b.1))).map(|(number, _)| number)
    }

    /// Where a via point of muscle `index` goes for which a hand shows a place on the muscle itself: the bone of the point before it, and the place inside,
    /// on the drawn centre line, in the world.
    pub fn via_inside(&self, index: usize, place: DVec3, drive: MuscleState, world: &[DMat4]) -> Option<(NodeId, DVec3)> {
        let line = self.line(index)?;
        let number = self.via_number_at(index, place, world)?;
        let before = number.checked_sub(1).and_then(|before| line.via.get(before)).unwrap_or(&line.origin);
        let (inside, _) = self.nearest(index, drive, world, self.frames(world).from_world.transform_point3(place))?;
        Some((*self.bones.get(before.bone)?, self.root_matrix(world).transform_point3(inside)))
    }

    /// What muscle `index` goes round where a hand chooses `node` for it: a ball in the joint by which the muscle leaves that bone, on the side on which
    /// the muscle passes now. Radius and side of a ball that is there already stay. `None` where nothing holds the muscle or the file has no name for the
    /// bone.
    pub fn wrap_on(&self, index: usize, node: NodeId, scene: &Scene, drive: MuscleState, world: &[DMat4]) -> Option<Wrap> {
        let (line, spec) = (self.line(index)?, self.spec(index)?);
        let node = self.carrier(&scene.graph, node);
        let ends = [line.origin, line.insertion].map(|point| self.bones.get(point.bone).copied());
        let joint = joint_of(&scene.graph, node, [ends[0]?, ends[1]?]);
        let middle = world.get(joint.index())?.w_axis.truncate();
        let there = self.wrap_sphere(index, world);
        let side = match there {
            Some(ball) => ball.side,
            None => self.root_matrix(world).transform_vector3(self.side_of(index, middle, scene, drive, world)?),
        };
        let thickest = spec.profile.radii().iter().copied().fold(0.0, f64::max);
        let radius = spec.wrap.as_ref().map_or_else(|| neat(THICK * thickest), |wrap| wrap.radius);
        let root = self.root_matrix(world);
        let ends = [line.origin, line.insertion].map(|point| root.transform_point3(self.frames(world).place(point)));
        let wide = root.transform_vector3(DVec3::X * (radius * self.scale(index))).length();
        let middle = beside(middle, ends, side.normalize_or(DVec3::X), wide);
        let center: Anchor = self.anchor_at(&scene.graph, node, middle, world)?;
        Some(Wrap { center, radius, side: readable(self.direction_on(node, side, world)) })
    }

    /// The ball that muscle `index` goes round.
    pub fn wrap_sphere(&self, index: usize, world: &[DMat4]) -> Option<WrapSphere> {
        let wrap_object = self.line(index)?.wrap_object?;
        let (frames, root) = (self.frames(world), self.root_matrix(world));
        let side = root.transform_vector3(frames.frame(wrap_object.center.bone).transform_vector3(wrap_object.side));
        let radius = root.transform_vector3(DVec3::X * wrap_object.radius).length();
        Some(WrapSphere { center: root.transform_point3(frames.place(wrap_object.center)), radius, side: side.normalize_or(DVec3::X) })
    }

    fn line(&self, index: usize) -> Option<&Line> {
        self.muscles.get(index)?.line.as_ref()
    }

    /// Origin, via points and insertion, from the root.
    fn corners(&self, line: &Line, world: &[DMat4]) -> Vec<DVec3> {
        let frames = self.frames(world);
        [&line.origin].into_iter().chain(&line.via).chain([&line.insertion]).map(|point| frames.place(*point)).collect()
    }

    /// The place on the drawn centre line nearest to a point, both from the root, and the line's direction there.
    fn nearest(&self, index: usize, drive: MuscleState, world: &[DMat4], point: DVec3) -> Option<(DVec3, DVec3)> {
        let path = self.centre_line(index, &self.solve(index, drive, world), world)?;
        let mut cursor = path.cursor();
        let frames = (0..=PLACES).map(|step| cursor.frame_at(path.length() * f64::from(step) / f64::from(PLACES)));
        let away = |at: DVec3| at.distance_squared(point);
        let nearest = frames.min_by(|a, b| away(a.position).total_cmp(&away(b.position)))?;
        Some((nearest.position, nearest.tangent))
    }

    /// The side of a point of the world on which muscle `index` passes; where it goes right through, the one to which the joint bends. From the root.
    fn side_of(&self, index: usize, middle: DVec3, scene: &Scene, drive: MuscleState, world: &[DMat4]) -> Option<DVec3> {
        let middle = self.frames(world).from_world.transform_point3(middle);
        let (place, tangent) = self.nearest(index, drive, world, middle)?;
        let out = (place - middle).reject_from_normalized(tangent.normalize_or(DVec3::Y));
        if out.length() > ON_LINE * self.profile(index)?.rest_length() {
            return Some(out.normalize_or(DVec3::X));
        }
        let bends = self.joint().map_or(DVec3::Z.cross(tangent), |joint| self.hinge_of(&joint, scene, world).bends(tangent));
        Some(bends.normalize_or(DVec3::X))
    }
}

/// The joint by which a muscle between the bones `ends` leaves the bone `node`: its own where just one end is beyond it, else that of the bone on it which
/// leads to one end alone.
fn joint_of(graph: &Graph, node: NodeId, ends: [NodeId; 2]) -> NodeId {
    let parts = |top: NodeId| {
        let below = graph.subtree(top);
        below.contains(&ends[0]) != below.contains(&ends[1])
    };
    if parts(node) {
        return node;
    }
    graph.node(node).children().iter().copied().find(|child| parts(*child)).unwrap_or(node)
}

/// A direction in numbers that a person can read.
fn readable(side: DVec3) -> DVec3 {
    let largest = (0..3).max_by(|a, b| side[*a].abs().total_cmp(&side[*b].abs())).unwrap_or(0);
    if side[largest].abs() >= NEAR_AXIS * side.length() {
        return DVec3::AXES[largest] * side[largest].signum() + DVec3::ZERO;
    }
    (side * 100.0).round() / 100.0 + DVec3::ZERO
}

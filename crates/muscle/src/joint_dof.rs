//! A joint of a skeleton that can be turned: its elbow, found by itself in usual rigs, or whichever joint a muscle file names.
//!
//! The elbow is known by the name of the bone below it ([`super::bone_name_heuristics`]); where no name tells, by what the clip does with it: a hinge in the
//! upper half of the body, off its middle. Its axis is that about which the clip bends it, else that of the bend it has at rest, else the one
//! that brings the hand to the front. Flexion is the angle between upper arm and forearm, 0° for the straight arm.

use glam::{DMat3, DMat4, DQuat, DVec3};

use super::bone_name_heuristics::{self, BodyPart, Side};
use super::config::JointSpec;
use super::humanoid;
use sinew_scene::animation::{Clip, Pose};
use sinew_scene::{Graph, NodeId, Scene};

/// Farthest that an elbow which was found is bent, degrees.
const FLEXION: f64 = 150.0;
/// Farthest that a joint which a person chose turns either way, degrees.
pub(super) const AROUND: f64 = 150.0;
/// Moments of each clip that are looked at.
const MOMENTS: usize = 24;
/// Bend that tells an axis, degrees: in a clip, and at rest, where bones that are not quite straight mislead.
const TELLS: [f64; 2] = [15.0, 3.0];

/// How a joint came to be the one that is turned.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FoundBy {
    /// The muscle file names it.
    File,
    /// Its bone is called a forearm.
    Name,
    /// It moves as an elbow does.
    Shape,
    /// A person chose it.
    Hand,
}

/// A joint with one axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointDof {
    /// The node that turns, with everything below it.
    pub node: NodeId,
    /// The axis through that node, of length 1, in the axes of the node above it.
    pub axis: DVec3,
    /// The joint's angle in the rest pose, degrees.
    pub at_rest: f64,
    /// Least and greatest angle, degrees.
    pub range: [f64; 2],
    /// How it was found.
    pub found: FoundBy,
}

/// A joint turned by hand, beside what the clip does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointRotation {
    /// The node that turns.
    pub node: NodeId,
    /// The axis through that node, of length 1, in the axes of the node above it.
    pub axis: DVec3,
    /// How far, degrees, right-handed about the axis.
    pub degrees: f64,
    /// Whether it turns on top of what the clip does; else the clip does not move this node, and it turns from its rest pose.
    pub on_top: bool,
}

impl JointRotation {
    /// Turns the node, whose local matrices are these in the pose and at rest.
    pub fn apply(&self, local: DMat4, rest: DMat4) -> DMat4 {
        if !self.degrees.is_finite() {
            return local;
        }
        let from = if self.on_top { local } else { rest };
        let turn = DMat4::from_quat(DQuat::from_axis_angle(self.axis, self.degrees.to_radians()));
        let mut turned = turn * from;
        turned.w_axis = from.w_axis;
        turned
    }
}

/// What tells a joint's angle from a pose alone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct JointAngle {
    node: NodeId,
    above: Option<NodeId>,
    axis: DVec3,
    at_rest: f64,
    /// How its node is turned at rest.
    rest: Option<DQuat>,
}

impl JointAngle {
    pub(super) fn new(joint: &JointDof, graph: &Graph) -> Self {
        let node = graph.node(joint.node);
        let rest = rotation(&node.transform.matrix());
        Self { node: joint.node, above: node.parent(), axis: joint.axis, at_rest: joint.at_rest, rest }
    }

    /// The angle in a pose, degrees: see [`JointDof::angle`].
    pub(super) fn of(&self, world: &[DMat4]) -> Option<f64> {
        let own = world.get(self.node.index())?;
        let above = self.above.map_or(Some(&DMat4::IDENTITY), |parent| world.get(parent.index()))?;
        if above.determinant().abs() <= f64::MIN_POSITIVE {
            return None;
        }
        let turn = rotation(&(above.inverse() * *own))? * self.rest?.inverse();
        let half = DVec3::new(turn.x, turn.y, turn.z).dot(self.axis).atan2(turn.w);
        let degrees = (2.0 * half).to_degrees();
        // Half a turn either way of where the joint is at rest.
        Some(self.at_rest + (degrees + 180.0).rem_euclid(360.0) - 180.0)
    }
}

impl JointDof {
    /// The joint at this angle, whatever the clip does with it.
    pub fn absolute(&self, degrees: f64) -> JointRotation {
        JointRotation { node: self.node, axis: self.axis, degrees: self.held(degrees) - self.at_rest, on_top: false }
    }

    /// The joint turned by so much on top of what the clip does.
    pub fn relative(&self, degrees: f64) -> JointRotation {
        JointRotation { node: self.node, axis: self.axis, degrees, on_top: true }
    }

    /// An angle held within the range.
    pub fn held(&self, degrees: f64) -> f64 {
        degrees.clamp(self.range[0], self.range[1])
    }

    /// The joint's angle in a pose of `scene`, degrees: how far the node is turned about the axis from its rest pose, added to the angle that it has
    /// there. `world` is one matrix a node.
    pub fn angle(&self, scene: &Scene, world: &[DMat4]) -> Option<f64> {
        JointAngle::new(self, &scene.graph).of(world)
    }

    /// The joint that a muscle file names, in the node that has been found for it.
    pub fn of_file(scene: &Scene, node: NodeId, spec: &JointSpec) -> Self {
        let local = rotation(&scene.graph.node(node).transform.matrix()).unwrap_or(DQuat::IDENTITY);
        let axis = (local * spec.axis).normalize_or(DVec3::Z);
        Self { node, axis, at_rest: 0.0, range: spec.range, found: FoundBy::File }
    }

    /// The elbow of a skeleton in `scene`, without the nodes below `skip`; `None` where there is none.
    pub fn elbow(scene: &Scene, clips: &[Clip], skip: &[NodeId]) -> Option<Self> {
        let skeleton = Skeleton::new(scene, clips, skip);
        skeleton.by_name().or_else(|| skeleton.by_shape())
    }

    /// The joint at `node` as a hinge, its axis found like an elbow's.
    pub fn at_node(scene: &Scene, clips: &[Clip], node: NodeId) -> Option<Self> {
        Skeleton::new(scene, clips, &[]).hinge(node, FoundBy::Shape)
    }

    /// The joint at `node` that turns about an axis along the bone's own axes at rest, from the rest pose by up to 150 degrees either way.
    pub fn about(scene: &Scene, node: NodeId, axis: DVec3) -> Self {
        let spec = JointSpec { name: String::new(), bone: String::new(), axis, range: [-AROUND, AROUND] };
        Self { found: FoundBy::Hand, ..Self::of_file(scene, node, &spec) }
    }

    /// The nodes whose places make the joint's two limbs at rest: above it, its own, below it. `None` where there is none above.
    pub fn limbs(scene: &Scene, node: NodeId) -> Option<[NodeId; 3]> {
        Skeleton::new(scene, &[], &[]).segments(node).map(|parts| [parts.above, parts.node, parts.below])
    }
}

/// The rotation in a matrix, by Gram and Schmidt; `None` where it is flat.
pub fn rotation(matrix: &DMat4) -> Option<DQuat> {
    let axes = DMat3::from_mat4(*matrix);
    let x = axes.x_axis.try_normalize()?;
    let y = (axes.y_axis - x * x.dot(axes.y_axis)).try_normalize()?;
    Some(DQuat::from_mat3(&DMat3::from_cols(x, y, x.cross(y))))
}

/// A scene at rest and at some moments of its clips.
struct Skeleton<'a> {
    graph: &'a Graph,
    /// Whether a node is a bone that may be chosen.
    bones: Vec<bool>,
    rest: Vec<DMat4>,
    moments: Vec<Vec<DMat4>>,
}

/// A place where one segment hangs on another, both with a length.
#[derive(Clone, Copy)]
struct Segments {
    above: NodeId,
    node: NodeId,
    below: NodeId,
}

impl<'a> Skeleton<'a> {
    fn new(scene: &'a Scene, clips: &[Clip], skip: &[NodeId]) -> Self {
        let graph = &scene.graph;
        let bones = humanoid::bone_flags(graph, skip);
        let (mut rest, mut local, mut moments) = (Vec::new(), Vec::new(), Vec::new());
        graph.world_from_local(&graph.rest_locals(), &mut rest);
        if clips.iter().any(|clip| clip.duration() > 0.0) {
            let mut pose = Pose::rest(scene);
            for clip in clips.iter().filter(|clip| clip.duration() > 0.0).take(4) {
                for moment in 0..MOMENTS {
                    pose.reset(scene);
                    clip.sample(clip.start + clip.duration() * moment as f64 / (MOMENTS - 1) as f64, &mut pose);
                    pose.locals(&mut local);
                    let mut world = Vec::new();
                    graph.world_from_local(&local, &mut world);
                    moments.push(world);
                }
            }
        }
        Self { graph, bones, rest, moments }
    }

    fn by_name(&self) -> Option<JointDof> {
        let named = self.graph.iter().filter(|(id, _)| self.is_bone(*id)).filter_map(|(id, node)| {
            let meaning = [&node.name, &node.id, &node.sid]
                .into_iter()
                .filter_map(|name| bone_name_heuristics::names(name, BodyPart::Forearm))
                .min_by_key(|m| m.rank)?;
            let parts = self.segments(id)?;
            // A bone without one below it is the last of its arm, or a helper.
            let leaf = parts.below == id;
            let side = match meaning.side {
                Some(Side::Right) => 0,
                Some(Side::Left) => 1,
                None => 2,
            };
            (!(meaning.helper || leaf && meaning.rank > 0)).then_some(((meaning.rank, leaf, side, self.depth(id), id.0), id))
        });
        let (_, node) = named.min_by_key(|(key, _)| *key)?;
        self.hinge(node, FoundBy::Name)
    }

    /// The hinge that the clips bend most, where the arms are.
    fn by_shape(&self) -> Option<JointDof> {
        let positions: Vec<DVec3> =
            self.graph.iter().filter(|(id, _)| self.is_bone(*id)).map(|(id, _)| place(&self.rest, id)).filter(|p| p.is_finite()).collect();
        let low = positions.iter().copied().reduce(DVec3::min)?;
        let high = positions.iter().copied().reduce(DVec3::max)?;
        let (size, middle) = (high - low, 0.5 * (low + high));
        // A bone with nothing below it is a helper or a tip, no limb.
        let limb = |id: &&NodeId| self.is_bone(**id) && self.graph.node(**id).children().iter().any(|below| self.is_bone(*below));
        let branches = self.graph.iter().any(|(id, node)| self.is_bone(id) && node.children().iter().filter(limb).count() > 1);
        let candidates = self.graph.iter().filter(|(id, _)| self.is_bone(*id)).filter_map(|(id, _)| {
            let parts = self.segments(id).filter(|parts| parts.below != id)?;
            let [upper, fore] = self.directions(&self.rest, parts).map(DVec3::length);
            let alike = (0.4..=2.5).contains(&(upper / fore)) && upper.min(fore) > 0.08 * size.length();
            let at = place(&self.rest, id);
            let where_arms_are = !branches || (at.y > low.y + 0.5 * size.y && (at - middle).with_y(0.0).length() > 0.08 * size.y);
            let bends = self.moments.iter().map(|world| self.bend(world, parts));
            let (least, most) = bends.fold((f64::INFINITY, 0.0), |(least, most): (f64, f64), bend| (least.min(bend), most.max(bend)));
            (alike && where_arms_are && most - least > TELLS[0]).then_some((most - least, id))
        });
        let (_, node) = candidates.max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)))?;
        self.hinge(node, FoundBy::Shape)
    }

    fn hinge(&self, node: NodeId, found: FoundBy) -> Option<JointDof> {
        let parts = self.segments(node)?;
        let above = |world: &[DMat4]| {
            let parent = self.graph.node(node).parent();
            parent.and_then(|parent| world.get(parent.index())).map_or(Some(DQuat::IDENTITY), rotation)
        };
        let axis_in = |world: &[DMat4]| {
            let [upper, fore] = self.directions(world, parts);
            Some((above(world)?.inverse() * upper.cross(fore)).try_normalize()?).filter(|axis| axis.is_finite())
        };
        let bent = self.moments.iter().map(|world| (self.bend(world, parts), world)).max_by(|a, b| a.0.total_cmp(&b.0));
        let at_rest = self.bend(&self.rest, parts);
        let axis = match bent {
            Some((bend, world)) if bend > TELLS[0] => axis_in(world),
            _ if at_rest > TELLS[1] => axis_in(&self.rest),
            _ => None,
        };
        let to_front = || {
            let [upper, _] = self.directions(&self.rest, parts);
            let axis = upper.cross(self.front(node));
            (above(&self.rest)?.inverse() * axis.try_normalize().unwrap_or(upper.any_orthogonal_vector())).try_normalize()
        };
        let axis = axis.or_else(to_front)?;
        // Seen along the axis the rest pose may be bent the other way.
        let signed = self.signed_bend(parts, above(&self.rest)? * axis);
        Some(JointDof { node, axis, at_rest: signed, range: [0.0, FLEXION], found })
    }

    /// The bend at rest about `axis`, degrees.
    fn signed_bend(&self, parts: Segments, axis: DVec3) -> f64 {
        let [upper, fore] = self.directions(&self.rest, parts).map(|along| along - axis * along.dot(axis));
        let degrees = upper.cross(fore).dot(axis).atan2(upper.dot(fore)).to_degrees();
        if degrees.is_finite() { degrees } else { 0.0 }
    }

    /// Where the body looks: across the line from the right arm's bones to the left one's; +Z where there is no such pair.
    fn front(&self, node: NodeId) -> DVec3 {
        let side_of = |id: NodeId| {
            let node = self.graph.node(id);
            [&node.name, &node.id]
                .into_iter()
                .find_map(|name| bone_name_heuristics::names(name, BodyPart::Forearm))
                .and_then(|meaning| meaning.side)
        };
        let other = self
            .graph
            .iter()
            .map(|(id, _)| id)
            .find(|id| self.is_bone(*id) && matches!((side_of(node), side_of(*id)), (Some(own), Some(other)) if own != other));
        let across = other.map(|other| match side_of(node) {
            Some(Side::Left) => place(&self.rest, node) - place(&self.rest, other),
            _ => place(&self.rest, other) - place(&self.rest, node),
        });
        across.and_then(|left| left.cross(DVec3::Y).try_normalize()).unwrap_or(DVec3::Z)
    }

    /// The nearest bones above and below that lie elsewhere; the node itself where there is none below. `None` where there is none above.
    fn segments(&self, node: NodeId) -> Option<Segments> {
        let here = place(&self.rest, node);
        let apart = |id: NodeId| humanoid::are_apart(place(&self.rest, id), here);
        let mut above = self.graph.node(node).parent();
        while let Some(id) = above.filter(|id| !apart(*id)) {
            above = self.graph.node(id).parent();
        }
        let above = above.filter(|id| self.is_bone(*id))?;
        // Of several below, the farthest leads on: helpers lie close by.
        let mut below = (0.0, node);
        let mut open: Vec<NodeId> = self.graph.node(node).children().to_vec();
        while let Some(id) = open.pop() {
            if !self.is_bone(id) {
                continue;
            }
            let far = place(&self.rest, id).distance(here);
            if !apart(id) {
                open.extend(self.graph.node(id).children());
            } else if far > below.0 {
                below = (far, id);
            }
        }
        Some(Segments { above, node, below: below.1 })
    }

    /// From the bone above to the joint, and from the joint to the bone below; for a last bone, straight on at rest.
    fn directions(&self, world: &[DMat4], parts: Segments) -> [DVec3; 2] {
        let here = place(world, parts.node);
        let upper = here - place(world, parts.above);
        if parts.below != parts.node {
            return [upper, place(world, parts.below) - here];
        }
        let rest_upper = place(&self.rest, parts.node) - place(&self.rest, parts.above);
        let turned = |matrix: Option<&DMat4>| matrix.and_then(rotation).unwrap_or(DQuat::IDENTITY);
        let index = parts.node.index();
        [upper, turned(world.get(index)) * turned(self.rest.get(index)).inverse() * rest_upper]
    }

    fn bend(&self, world: &[DMat4], parts: Segments) -> f64 {
        let [upper, fore] = self.directions(world, parts);
        let bend = upper.angle_between(fore).to_degrees();
        if bend.is_finite() { bend } else { 0.0 }
    }

    fn depth(&self, node: NodeId) -> usize {
        std::iter::successors(self.graph.node(node).parent(), |id| self.graph.node(*id).parent()).count()
    }

    fn is_bone(&self, id: NodeId) -> bool {
        self.bones.get(id.index()).copied().unwrap_or(false)
    }
}

fn place(world: &[DMat4], id: NodeId) -> DVec3 {
    world.get(id.index()).map_or(DVec3::NAN, |matrix| matrix.w_axis.truncate())
}

//! Puts a muscle file into a scene: its nodes, the arm if it has one, and its muscles; attaches muscles to the bones of a clip.

use std::sync::OnceLock;

use glam::{DMat4, DVec3};

use super::Finding;
use super::arm::{AXIS, Arm, ArmNodes, ELBOW_JOINT, FOREARM, FULL_FLEXION, UPPER_ARM};
use super::bone_shape::BoneShape;
use super::config::{self, Anchor, MuscleFile, MuscleSpec, PoseAt, WrapRange};
use super::joint_dof::{FoundBy, JointAngle, JointDof};
use super::line_of_action::{CenterlineOffset, Frames, Line, Point};
use super::muscle_rig::{Muscle, MuscleRig, RigJoint};
use super::muscle_state::LengthRange;
use super::profile::Profile;
use super::revolute_joint::RevoluteJoint;
use super::tessellation::MuscleTopology;
use super::via_point::{MotionCurve, ViaPoint};
use super::wrap_object::WrapObject;
use super::{bone_clearance, materials, primitive_meshes, scaling};
use sinew_scene::animation::Clip;
use sinew_scene::diagnostics::Diagnostic;
use sinew_scene::{Content, Graph, MaterialBinding, MaterialId, MuscleId, Node, NodeId, NodeKind, Scene, Transform, TransformOp};

/// Radius of the arcs at via points over the muscle's thickest radius.
const ROUNDING: f64 = 1.25;

impl MuscleRig {
    /// Adds the file's nodes, rods and muscles to `scene`; its muscles get the ids from `first` on. Muscles on bones of a clip lie on their own until
    /// [`MuscleRig::attach`] finds those bones.
    pub fn build(file: &MuscleFile, name: &str, scene: &mut Scene, first: MuscleId) -> Self {
        let unit = if file.unit_metres > 0.0 && file.unit_metres.is_finite() { file.unit_metres } else { 0.001 };
        let mut node = Node::new(name);
        node.kind = NodeKind::Asset;
        node.transform = Transform { ops: vec![TransformOp::Scale(DVec3::splat(unit))] };
        let root = scene.graph.add(None, node);
        let mut rig =
            Self { root: Some(root), joint_specs: file.joints.clone(), unit, scaled_at: file.scale, skin: file.skin, ..Self::default() };
        if let Some(arm) = file.arm {
            let nodes = arm.build(scene, root);
            rig.bones = vec![nodes.upper, nodes.elbow];
            let range = arm.flexion.unwrap_or([0.0, FULL_FLEXION]);
            let dof = JointDof { node: nodes.elbow, axis: AXIS, at_rest: 0.0, range, found: FoundBy::File };
            let angle = JointAngle::new(&dof, &scene.graph);
            let revolute = RevoluteJoint::elbow(&arm, range);
            rig.bone_shapes = vec![
                BoneShape::capsule(DVec3::NEG_Y * arm.upper, arm.thickness),
                BoneShape::capsule(DVec3::NEG_Y * arm.lower, arm.thickness),
            ];
            rig.joints = vec![RigJoint { name: ELBOW_JOINT.to_owned(), dof, angle, revolute, carries: vec![false] }];
            rig.arm = Some((arm, nodes));
        }
        let tendon = materials::tendon(scene);
        let mut height = 0.0;
        for (index, spec) in file.muscles.iter().enumerate() {
            let mut spec = spec.clone();
            if spec.name.is_empty() && file.muscles.len() == 1 {
                // A file of one muscle is that muscle.
                name.clone_into(&mut spec.name);
            }
            // Muscles that nothing holds lie above each other, each clear of the ground at its thickest.
            let thick = 1.6 * spec.profile.radii().iter().copied().fold(0.0, f64::max);
            let free_middle = DVec3::Y * (height + thick);
            if spec.origin.is_none() {
                height += 2.0 * thick;
            }
            let mut node = Node::new(spec.name.clone());
            node.contents.push(Content::Muscle(MuscleId(first.0 + index as u32)));
            scene.graph.add(Some(root), node);
            let mut muscle = new_muscle(spec, index as u32 + 1, scene, tendon, free_middle);
            if rig.arm.is_some() {
                let find = |bone: &str| match bone {
                    UPPER_ARM => Some(0),
                    FOREARM => Some(1),
                    _ => None,
                };
                muscle.line = resolve(&muscle.spec, &[ELBOW_JOINT.to_owned()], find).ok().flatten();
            }
            rig.muscles.push(muscle);
        }
        rig.place_poses();
        rig.settle_on_arm(scene, tendon);
        rig.check_joint_range(&scene.graph);
        rig
    }

    /// Attaches the muscles that name bones of a clip to nodes of `scene` with these ids, scoped ids or names, and finds the joint that the file
    /// names. A bone that is not there is a finding, and its muscle lies on its own. May be called again when the scene has changed.
    ///
    /// The scene's rest pose is where the joint's angle is 0.
    pub fn attach(&mut self, scene: &Scene) -> Vec<Diagnostic<Finding>> {
        self.attach_moving(scene, &[])
    }

    /// [`MuscleRig::attach`] to a scene that these clips move. Where the file names no joint, what they bend tells more about it than the rest pose does.
    pub fn attach_moving(&mut self, scene: &Scene, clips: &[Clip]) -> Vec<Diagnostic<Finding>> {
        if self.arm.is_some() {
            return Vec::new();
        }
        self.findings.clear();
        self.bones.clear();
        let mut names: Vec<String> = Vec::new();
        let mut rest = Vec::new();
        scene.graph.world_from_local(&scene.graph.rest_locals(), &mut rest);
        self.ride = self.scaled_at.map(|at| scaling::ride(&scene.graph, self.unit, at));
        // Joints that the file names come first, so that via points find them by their number.
        self.joints.clear();
        let (named, missing) = self.named_joints(scene);
        let joint_names: Vec<String> = named.iter().map(|(name, _)| name.clone()).collect();
        let (bones, root, scaled_at) = (&mut self.bones, self.root, self.scaled_at);
        for muscle in &mut self.muscles {
            let find = |bone: &str| {
                if let Some(known) = names.iter().position(|name| name == bone) {
                    return Some(known);
                }
                bones.push(find_bone(&scene.graph, root, bone)?);
                names.push(bone.to_owned());
                Some(bones.len() - 1)
            };
            match resolve(&muscle.spec, &joint_names, find) {
                Ok(line) => {
                    // It is as large as the bone that it comes from.
                    let origin = line.as_ref().and_then(|line| bones.get(line.origin.bone));
                    let scale = scaled_at.zip(origin).map_or(1.0, |(at, bone)| scaling::of_bone(&scene.graph, &rest, *bone) / at);
                    muscle.rescale(scale);
                    muscle.line = line.map(|line| line.scaled(muscle.scale));
                }
                Err(bone) => {
                    muscle.rescale(1.0);
                    muscle.line = None;
                    self.findings.push(Diagnostic::new(Finding::BoneNotFound { bone }, None, muscle.label().to_owned()));
                }
            }
        }
        self.findings.extend(missing);
        self.shape_bones(scene, &rest);
        let named = if self.joint_specs.is_empty() {
            self.found_joint(scene, clips).map(|joint| (String::new(), joint)).into_iter().collect()
        } else {
            named
        };
        self.turn(scene, named, &rest);
        self.place_poses();
        self.check_joint_range(&scene.graph);
        self.findings.clone()
    }

    /// The joints that the file names and that are there, with what they are called; and what is to be said of those that are not.
    fn named_joints(&self, scene: &Scene) -> (Vec<(String, JointDof)>, Vec<Diagnostic<Finding>>) {
        let (mut named, mut missing) = (Vec::new(), Vec::new());
        for joint in &self.joint_specs {
            match find_bone(&scene.graph, self.root, &joint.bone) {
                Some(node) => named.push((joint.label().to_owned(), JointDof::of_file(scene, node, joint))),
                None => {
                    let bone = joint.bone.clone();
                    missing.push(Diagnostic::new(Finding::JointNotFound { bone: bone.clone() }, None, bone));
                }
            }
        }
        (named, missing)
    }

    /// The joint that measurements turn where the file names none: the elbow that moves one end of a muscle, else the joint at an insertion.
    fn found_joint(&self, scene: &Scene, clips: &[Clip]) -> Option<JointDof> {
        let graph = &scene.graph;
        let lines = || self.muscles.iter().filter_map(|muscle| muscle.line.as_ref());
        let ends = |line: &Line| Some([*self.bones.get(line.origin.bone)?, *self.bones.get(line.insertion.bone)?]);
        lines().next()?;
        let skip: Vec<NodeId> = self.root.into_iter().collect();
        if let Some(elbow) = JointDof::elbow(scene, clips, &skip) {
            let below = graph.subtree(elbow.node);
            let crosses = |[origin, insertion]: [NodeId; 2]| below.contains(&origin) != below.contains(&insertion);
            if lines().filter_map(ends).any(crosses) {
                return Some(elbow);
            }
        }
        let crossing = lines().filter_map(ends).find(|[origin, insertion]| !graph.subtree(*insertion).contains(origin))?;
        JointDof::at_node(scene, clips, crossing[1])
    }

    /// Takes these joints as those that measurements turn, from the rest pose.
    fn turn(&mut self, scene: &Scene, joints: Vec<(String, JointDof)>, rest: &[DMat4]) {
        let graph = &scene.graph;
        let above = |joint: &JointDof| graph.node(joint.node).parent();
        let parents: Vec<Option<NodeId>> = joints.iter().map(|(_, joint)| above(joint)).collect();
        // The angles of all are asked for where one is placed, so that they come first.
        let angles: Vec<JointAngle> = joints.iter().map(|(_, joint)| JointAngle::new(joint, graph)).collect();
        let rest_angles: Vec<f64> = angles.iter().map(|angle| angle.of(rest).unwrap_or(f64::NAN)).collect();
        let turning = |(number, (name, dof)): (usize, (String, JointDof))| {
            let below = graph.subtree(dof.node);
            let carries = parents.iter().map(|parent| parent.is_some_and(|parent| below.contains(&parent))).collect();
            let revolute = RevoluteJoint { angles: rest_angles.clone(), own: Some(number), ..self.revolute_of(&dof, scene, rest) };
            RigJoint { name, dof, angle: angles[number], revolute, carries }
        };
        self.joints = joints.into_iter().enumerate().map(turning).collect();
    }

    /// The joint in a pose, with the bones that it moves.
    pub(super) fn revolute_of(&self, joint: &JointDof, scene: &Scene, world: &[DMat4]) -> RevoluteJoint {
        let below = scene.graph.subtree(joint.node);
        let frames = self.frames(world);
        let bone = |(index, node): (usize, &NodeId)| frames.bone(index, below.contains(node));
        let bones = self.bones.iter().enumerate().map(bone).collect();
        let of = |node: NodeId| world.get(node.index()).map_or(frames.from_world, |world| frames.from_world * *world);
        let above = scene.graph.node(joint.node).parent().map_or(frames.from_world, of);
        let pivot = above.inverse().transform_point3(of(joint.node).w_axis.truncate());
        let angles = (0..self.joints.len()).map(|number| frames.angle(number)).collect();
        let own = self.joints.iter().position(|known| known.dof.node == joint.node && known.dof.axis == joint.axis);
        RevoluteJoint { at_rest: joint.at_rest, range: joint.range, angles, own, ..RevoluteJoint::new(above, pivot, joint.axis, bones) }
    }

    /// On the arm: finds drawn ends and the range of the elbow, once all muscles are there, and roots the ends in the rods.
    fn settle_on_arm(&mut self, scene: &mut Scene, tendon: MaterialId) {
        let (Some((arm, nodes)), Some(revolute)) = (self.arm, self.joints.first_mut().map(|joint| &mut joint.revolute)) else { return };
        let asked = revolute.range;
        let mut range = asked;
        for (index, muscle) in self.muscles.iter_mut().enumerate() {
            let fixed = muscle.fixed();
            let Some(line) = &mut muscle.line else { continue };
            let fit = bone_clearance::fit(&arm, line, &muscle.shape, &muscle.tendons, asked);
            if line.via.is_empty() && !line.wraps.iter().any(|wrap| wrap.is_shaped()) {
                line.drawn = Some(fit.drawn);
                add_roots(scene, &arm, &nodes, &muscle.spec, &fit.drawn, tendon);
            }
            if index == 0 {
                if arm.flexion.is_none() {
                    range[1] = range[1].min(fit.flexion);
                }
                let valid = muscle.shape.length_range();
                range = super::muscle_state::valid_part(range, |angle| valid.contains(&(line.length(&revolute.at(angle)) - fixed)));
            }
        }
        revolute.range = range;
        self.span = Some(LengthRange::new(range, |angle| self.driving_length(angle)));
    }

    /// Finds out how long muscles are at the angles of their measured poses, now that they are on their joint.
    fn place_poses(&mut self) {
        let revolute = self.joints.first().map(|joint| &joint.revolute);
        for muscle in self.muscles.iter_mut().filter(|muscle| muscle.spec.poses.iter().any(|pose| matches!(pose.at, PoseAt::Angle(_)))) {
            let found = revolute.zip(muscle.line.as_ref());
            let length_at = |angle: f64| found.map(|(revolute, line)| (line.length(&revolute.at(angle)) - muscle.fixed()) / muscle.scale);
            let finding = match MuscleSpec::posed(&muscle.spec.poses, muscle.spec.profile.rest_length(), length_at) {
                Ok(profile) => {
                    let whole = profile.is_posed();
                    muscle.shape = profile.scaled(muscle.scale);
                    muscle.spec.profile = profile;
                    if whole {
                        continue;
                    }
                    Finding::PosesWithoutJoint
                }
                Err(error) => Finding::PosesDoNotFit(error),
            };
            self.findings.push(Diagnostic::new(finding, None, muscle.label().to_owned()));
        }
    }
}

fn new_muscle(spec: MuscleSpec, number: u32, scene: &mut Scene, tendon: MaterialId, free_middle: DVec3) -> Muscle {
    let layout = MuscleTopology::new(spec.profile.radii().len(), &spec.tendons);
    let flesh = materials::muscle(scene, &spec.name, number, spec.color);
    let material = |part| Some(MaterialBinding::plain(if part == 0 { flesh } else { tendon }));
    let (shape, tendons) = (spec.profile.clone(), spec.tendons);
    let materials = (0..layout.parts()).map(material).collect();
    Muscle { materials, spec, number, scale: 1.0, shape, tendons, line: None, layout, mesh: OnceLock::new(), free_middle }
}

/// Radius of the arcs at the via points of a muscle of this shape.
pub(super) fn rounding(shape: &Profile) -> f64 {
    ROUNDING * shape.radii().iter().copied().fold(0.0, f64::max)
}

/// The line of action of a muscle whose bones `find` knows by index and whose joints have these names; `None` where it has no ends, the name of the bone that
/// is not there as the error. A via point that depends on a joint that is not there is passed always, where it is.
pub(super) fn resolve(spec: &MuscleSpec, joints: &[String], mut find: impl FnMut(&str) -> Option<usize>) -> Result<Option<Line>, String> {
    let (Some(origin), Some(insertion)) = (&spec.origin, &spec.insertion) else { return Ok(None) };
    let mut point = |anchor: &Anchor| -> Result<Point, String> {
        let bone = find(&anchor.bone).ok_or_else(|| anchor.bone.clone())?;
        Ok(Point { bone, local: anchor.offset })
    };
    let (origin, insertion) = (point(origin)?, point(insertion)?);
    let joint = |name: &str| joints.iter().position(|known| known == name);
    let via_point = |via: &config::ViaPoint| -> Result<ViaPoint, String> {
        let active = via.active.as_ref().and_then(|active| Some((joint(&active.joint)?, active.range)));
        let moves = via.moves.as_ref().and_then(|moves| Some((joint(&moves.joint)?, MotionCurve::new(moves))));
        Ok(ViaPoint { point: point(&via.place)?, active, moves })
    };
    let via = spec.via.iter().map(via_point).collect::<Result<Vec<_>, _>>()?;
    let mut line = Line { origin, insertion, via, wraps: Vec::new(), rounding: rounding(&spec.profile), drawn: None };
    // A joint is where two bones meet.
    let bones: Vec<usize> = line.bones().collect();
    let at_joint = bones.windows(2).position(|pair| pair[0] != pair[1]).unwrap_or(0);
    for wrap in &spec.wraps {
        let stretches = match wrap.range {
            WrapRange::AtJoint => at_joint..at_joint + 1,
            WrapRange::Whole => 0..line.count() - 1,
            WrapRange::Between([from, to]) => from..to,
        };
        let bone = find(&wrap.center.bone).ok_or_else(|| wrap.center.bone.clone())?;
        line.wraps.push(WrapObject::new(wrap, Point { bone, local: wrap.center.offset }, stretches));
    }
    Ok(Some(line))
}

/// A node by id, scoped id or name, joints first; nodes below `own` are the rig's own and don't count.
pub(super) fn find_bone(graph: &Graph, own: Option<NodeId>, name: &str) -> Option<NodeId> {
    let own = own.map(|root| graph.subtree(root)).unwrap_or_default();
    let fields: [fn(&Node) -> &str; 3] = [|node| &node.id, |node| &node.sid, |node| &node.name];
    let find = |joints: bool, field: fn(&Node) -> &str, name: &str| {
        let matches = |node: &Node| (node.kind == NodeKind::Joint || !joints) && field(node) == name;
        graph.iter().find(|(id, node)| matches(node) && !own.contains(id)).map(|(id, _)| id)
    };
    let among = |name: &str| [true, false].into_iter().find_map(|joints| fields.iter().find_map(|field| find(joints, *field, name)));
    among(name).or_else(|| graph.find_unnamed(name, |id| !own.contains(&id)))
}

/// Roots of tendon, fixed to the rods, from the drawn ends of a muscle to the rods' axes.
fn add_roots(scene: &mut Scene, arm: &Arm, nodes: &ArmNodes, spec: &MuscleSpec, drawn: &CenterlineOffset, tendon: MaterialId) {
    let radii = spec.profile.radii();
    for (end, point) in drawn.ends.into_iter().enumerate() {
        let node = if point.bone == 0 { nodes.upper } else { nodes.elbow };
        let belly = if end == 0 { radii.first() } else { radii.last() }.copied().unwrap_or(0.0);
        let tip = if spec.tendons[end].length > 0.0 { spec.tendons[end].radius } else { belly };
        let out = DVec3::new(point.local.x, 0.0, point.local.z).length();
        // It leans away from the elbow, as a tendon does that has been pulled at.
        let away = if point.bone == 0 { 1.0 } else { -1.0 };
        let foot = DVec3::new(0.0, (point.local.y + away * 1.1 * out).clamp(-arm.upper.max(arm.lower), 0.0), 0.0);
        let mesh = primitive_meshes::root(foot, point.local, [0.95 * arm.thickness, 0.92 * tip]);
        primitive_meshes::hang(scene, node, mesh, tendon);
    }
}

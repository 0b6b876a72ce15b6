//! A ready muscle laid on the bones of any skeleton: made as long and as thick as these bones are beside those of the arm it was made for.

use glam::{DMat3, DMat4, DVec3};

use super::arm::UPPER_ARM;
use super::build::resolve;
use super::config::{Anchor, MuscleFile, MuscleSpec, PoseAt, PoseSpec, Tendon, ViaPoint, Wrap, WrapShape};
use super::joint_dof::JointDof;
use super::line_of_action::{Frames, Line};
use super::muscle_rig::{MuscleRig, WorldFrames};
use super::profile::{Profile, ProfileError};
use super::wrap_object::{angles_of, turned};
use sinew_scene::{Graph, NodeId, Scene};

impl MuscleSpec {
    /// The same muscle with all lengths multiplied by `scale`, resting at `length`; attached to nothing.
    ///
    /// # Errors
    /// [`ProfileError`] where that is no muscle: a scale that is not above 0, a length out of bounds.
    pub fn scaled(&self, scale: f64, length: f64) -> Result<Self, ProfileError> {
        let times = |values: &[f64]| values.iter().map(|value| neat(value * scale)).collect::<Vec<_>>();
        let tendon = |tendon: Tendon| Tendon { length: neat(tendon.length * scale), radius: neat(tendon.radius * scale) };
        let pose = |pose: &PoseSpec| PoseSpec {
            at: match pose.at {
                PoseAt::Length(length) => PoseAt::Length(neat(length * scale)),
                PoseAt::Angle(angle) => PoseAt::Angle(angle),
            },
            radii: times(&pose.radii),
        };
        let poses: Vec<PoseSpec> = self.poses.iter().map(pose).collect();
        let profile = if poses.is_empty() {
            Profile::new(times(self.profile.radii()), self.profile.growth().to_vec(), neat(length))?
        } else {
            Self::posed(&poses, neat(length), |_| None)?
        };
        Ok(Self {
            profile,
            poses,
            tendons: self.tendons.map(tendon),
            origin: None,
            via: Vec::new(),
            wraps: Vec::new(),
            insertion: None,
            ..self.clone()
        })
    }

    /// Length that both tendons take.
    pub fn tendon_length(&self) -> f64 {
        self.tendons[0].length + self.tendons[1].length
    }
}

/// Four digits are enough for a person, and for a muscle.
pub(super) fn neat(value: f64) -> f64 {
    if value == 0.0 || !value.is_finite() {
        return value;
    }
    let step = 10f64.powf(3.0 - value.abs().log10().floor());
    (value * step).round() / step
}

/// How far from the middle of its ball a line passes at least, as a share of the radius.
const BESIDE: f64 = 0.02;

/// Sine of the angle between a joint's axis and a bone below which the joint turns that bone about itself: two degrees.
const TWISTS: f64 = 0.035;

impl JointDof {
    /// Whether the joint turns one of its bones about that bone itself, so that no side of it turns to the other; `world` is the scene in some pose.
    pub fn twists(&self, scene: &Scene, world: &[DMat4]) -> bool {
        let Some(nodes) = Self::limbs(scene, self.node) else { return false };
        let [above, node, below] = nodes.map(|id| world.get(id.index()).map(|matrix| matrix.w_axis.truncate()));
        let parent = scene.graph.node(self.node).parent().and_then(|id| world.get(id.index())).copied().unwrap_or(DMat4::IDENTITY);
        let axis = parent.transform_vector3(self.axis).normalize_or_zero();
        let along = |from: Option<DVec3>, to: Option<DVec3>| {
            let way = to? - from?;
            (way.length() > 0.0 && axis != DVec3::ZERO).then(|| axis.cross(way).length() <= way.length() * TWISTS)
        };
        along(above, node) == Some(true) || along(node, below) == Some(true)
    }
}

/// Where the middle of a ball goes that a line between these ends goes round on one side: `center`, or so far behind it that the line, which offsets as a
/// file has them round to one side or the other, does not pass through the middle itself.
pub(super) fn beside(center: DVec3, ends: [DVec3; 2], side: DVec3, radius: f64) -> DVec3 {
    let Some(along) = (ends[1] - ends[0]).try_normalize() else { return center };
    let off = (ends[0] - center).reject_from_normalized(along).dot(side);
    let least = BESIDE * radius;
    if off.abs() < least { center - side * (least - off) } else { center }
}

/// Two limbs that meet in a joint, with the joint straight.
struct Limbs {
    /// The bones that carry the upper and the lower end.
    nodes: [NodeId; 2],
    /// Where they begin, and the way along each to its end, metres.
    starts: [DVec3; 2],
    along: [DVec3; 2],
    /// Where each turns to when the joint bends, of length 1.
    front: [DVec3; 2],
    axis: DVec3,
}

impl Limbs {
    fn new(scene: &Scene, joint: &JointDof, world: &[DMat4]) -> Option<Self> {
        let [above, node, below] = JointDof::limbs(scene, joint.node)?;
        let place = |id: NodeId| world.get(id.index()).map(|matrix| matrix.w_axis.truncate());
        let (shoulder, elbow, wrist) = (place(above)?, place(node)?, place(below)?);
        let upper = elbow - shoulder;
        let lower = if below == node { upper } else { wrist - elbow };
        let parent = scene.graph.node(joint.node).parent().and_then(|id| world.get(id.index())).copied().unwrap_or(DMat4::IDENTITY);
        let axis = parent.transform_vector3(joint.axis).try_normalize()?;
        if [upper, lower].iter().any(|along| axis.cross(*along).length() <= along.length() * TWISTS) {
            return None;
        }
        // Where the lower limb turns to is asked in the joint's own axes: in the world they may be mirrored.
        let front = parent.transform_vector3(joint.axis.cross(parent.inverse().transform_vector3(lower)));
        let across = |along: DVec3| (front - along * (front.dot(along) / along.length_squared())).try_normalize();
        let front = [across(upper)?, across(lower)?];
        Some(Self { nodes: [above, node], starts: [shoulder, elbow], along: [upper, lower], front, axis })
    }
}

impl MuscleRig {
    /// By what a muscle from the bone `node` is multiplied.
    fn scale_on(&self, graph: &Graph, node: NodeId, world: &[DMat4]) -> f64 {
        let scale = self.scaled_at.map_or(1.0, |at| super::scaling::of_bone(graph, world, node) / at);
        if scale > 0.0 && scale.is_finite() { scale } else { 1.0 }
    }

    /// The muscle `spec` of the arm of `ready` on the two limbs that meet in `joint`, in this rig's unit; `world` is the scene with that joint straight.
    /// `None` where there are no two limbs, this file has no names for them, or `ready` has no arm.
    pub fn fitted(&self, spec: &MuscleSpec, ready: &MuscleFile, joint: &JointDof, scene: &Scene, world: &[DMat4]) -> Option<MuscleSpec> {
        let arm = ready.arm?;
        let limbs = Limbs::new(scene, joint, world)?;
        // Metres a unit of the ready file, along each limb and across both.
        let along = [limbs.along[0].length() / arm.upper, limbs.along[1].length() / arm.lower];
        let across = along[0];
        let place = |anchor: &Anchor| {
            let limb = usize::from(anchor.bone != UPPER_ARM);
            limbs.starts[limb] - limbs.along[limb].normalize() * (anchor.offset.y * along[limb])
                + limbs.front[limb] * (anchor.offset.x * across)
                + limbs.axis * (anchor.offset.z * across)
        };
        let anchor =
            |anchor: &Anchor| self.anchor_at(&scene.graph, limbs.nodes[usize::from(anchor.bone != UPPER_ARM)], place(anchor), world);
        let scale = across * self.per_metre(world) / self.scale_on(&scene.graph, limbs.nodes[0], world);
        let mut fitted = spec.scaled(scale, spec.profile.rest_length() * scale).ok()?;
        fitted.origin = Some(anchor(spec.origin.as_ref()?)?);
        fitted.insertion = Some(anchor(spec.insertion.as_ref()?)?);
        fitted.via = spec
            .via
            .iter()
            // Motions and ranges are of the arm's joint, which has another name here.
            .map(|via| Some(ViaPoint::from(anchor(&via.place)?)))
            .collect::<Option<_>>()?;
        for wrap in &spec.wraps {
            let limb = usize::from(wrap.center.bone != UPPER_ARM);
            // The arm's axes in the world: x to the front, y against the way along the limb, z along the joint's axis.
            let axes = DMat3::from_cols(limbs.front[limb], -limbs.along[limb].normalize(), limbs.axis);
            let mut center = place(&wrap.center);
            let mut put = Wrap { shape: wrap.shape.scaled(scale).neat(), ..wrap.clone() };
            match (wrap.shape, wrap.side) {
                (WrapShape::Sphere { radius }, Some(side)) => {
                    let side = self.direction_on(limbs.nodes[limb], axes * turned(wrap.rotation) * side, world);
                    let ends = [place(spec.origin.as_ref()?), place(spec.insertion.as_ref()?)];
                    let out = self
                        .root_matrix(world)
                        .transform_vector3(WorldFrames { bones: &limbs.nodes, ..self.frames(world) }.frame(limb).transform_vector3(side));
                    center = beside(center, ends, out.normalize_or_zero(), radius * across);
                    (put.rotation, put.side) = (DVec3::ZERO, Some(side));
                }
                _ => {
                    let frame = axes * turned(wrap.rotation);
                    let [x, y, z] =
                        [frame.x_axis, frame.y_axis, frame.z_axis].map(|axis| self.direction_on(limbs.nodes[limb], axis, world));
                    let mirrored = x.cross(y).dot(z) < 0.0;
                    put.rotation = angles_of(x, z);
                    put.side = wrap.side.map(|side| if mirrored { side * DVec3::new(1.0, -1.0, 1.0) } else { side });
                }
            }
            put.center = self.anchor_at(&scene.graph, limbs.nodes[limb], center, world)?;
            fitted.wraps.push(put);
        }
        self.rested(fitted, &scene.graph, &limbs.nodes, world)
    }

    /// The muscle with the length that it has in this pose as its rest length, its thickness kept.
    fn rested(&self, spec: MuscleSpec, graph: &Graph, nodes: &[NodeId], world: &[DMat4]) -> Option<MuscleSpec> {
        let names: Vec<Option<String>> = nodes.iter().map(|node| self.bone_name(graph, *node)).collect();
        let line: Line = resolve(&spec, &[], |bone| names.iter().position(|name| name.as_deref() == Some(bone))).ok()??;
        let frames = self.frames(world);
        let scale = nodes.first().map_or(1.0, |node| self.scale_on(graph, *node, world));
        let length = line.scaled(scale).length(&WorldFrames { bones: nodes, ..frames }) / scale - spec.tendon_length();
        let profile = &spec.profile;
        let length = if length > 0.0 { neat(length) } else { profile.rest_length() };
        let profile = if spec.poses.is_empty() {
            Profile::new(profile.radii().to_vec(), profile.growth().to_vec(), length).ok()?
        } else {
            MuscleSpec::posed(&spec.poses, length, |_| None).ok()?
        };
        Some(MuscleSpec { profile, ..spec })
    }
}

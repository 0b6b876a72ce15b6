//! Muscles placed in a scene: what they solve, lay and measure. [`super::build`] puts them there.

use std::ops::RangeInclusive;
use std::sync::{Arc, OnceLock};

use glam::{DMat4, DVec3, Vec2, Vec3};

use super::Finding;
use super::arm::{Arm, ArmNodes};
use super::bone_shape::BoneShape;
use super::config::{JointSpec, MuscleSpec, SkinSpec, Tendon};
use super::joint_dof::{JointAngle, JointDof};
use super::line_of_action::{Frames, Line, LineSolver};
use super::muscle_state::{FREE, LengthRange};
use super::pennation::{self, BellyTurns};
use super::profile::Profile;
use super::revolute_joint::{Bone, RevoluteJoint, plain};
use super::solved_muscle::SolvedMuscle;
use super::solver_report::SolverReport;
use super::tessellation::{Laid, MeshQuality, MuscleTopology, ToWorld};
use super::{MuscleSample, MuscleState, Solved, measure};
use sinew_scene::animation::Pose;
use sinew_scene::diagnostics::Diagnostic;
use sinew_scene::{Graph, Label, MaterialBinding, Mesh, NodeId, OwnedLabel, Scene, Unnamed};

/// A muscle on a clip that begins nearer than this share of its rest length to the axis of its bone is a scheme that tells no side.
const SCHEMATIC: f64 = 0.02;

/// A muscle file placed in a scene.
#[derive(Debug, Clone, Default)]
pub struct MuscleRig {
    /// The root of its nodes; carries the unit.
    pub root: Option<NodeId>,
    pub(super) arm: Option<(Arm, ArmNodes)>,
    /// Nodes of the bones that lines of action name.
    pub(super) bones: Vec<NodeId>,
    /// Shape of each, where it has a length; muscles are pushed aside by it.
    pub(super) bone_shapes: Vec<Option<BoneShape>>,
    pub(super) muscles: Vec<Muscle>,
    /// The joints that the file names.
    pub(super) joint_specs: Vec<JointSpec>,
    /// What measurements turn, the first above all: the arm's elbow, the joints that the file names, or one that was found; none where nothing is known to turn.
    pub(super) joints: Vec<RigJoint>,
    pub(super) span: Option<LengthRange>,
    pub(super) findings: Vec<Diagnostic<Finding>>,
    /// See [`WorldFrames::ride`].
    pub(super) ride: Option<Vec<f64>>,
    /// Metres a unit of the file.
    pub(super) unit: f64,
    /// How skin lies over the muscles, in the file's unit.
    pub(super) skin: Option<SkinSpec>,
    /// The bones' scale at which the file's lengths hold, where muscles scale with the bones.
    pub(super) scaled_at: Option<f64>,
}

/// A joint that measurements turn.
#[derive(Debug, Clone)]
pub(super) struct RigJoint {
    /// What it is called; empty where it was found.
    pub name: String,
    pub dof: JointDof,
    pub angle: JointAngle,
    /// The joint in the rest pose.
    pub revolute: RevoluteJoint,
    /// For each joint of the rig whether this one moves the node above it.
    pub carries: Vec<bool>,
}

/// One muscle of a rig.
#[derive(Debug, Clone)]
pub(super) struct Muscle {
    /// As the file has it; the only muscle of a file has the file's name where it has none.
    pub spec: MuscleSpec,
    /// Its place in the file, from 1.
    pub number: u32,
    /// By what its lengths are multiplied where it is: 1 unless the file lets muscles scale with the bones.
    pub scale: f64,
    /// Its profile, so multiplied.
    pub shape: Profile,
    /// Its tendons, so multiplied.
    pub tendons: [Tendon; 2],
    /// Its line of action; `None` where nothing holds it.
    pub line: Option<Line>,
    pub layout: MuscleTopology,
    /// Made when it is first drawn: to tell what is in a file needs none.
    pub mesh: OnceLock<Arc<Mesh>>,
    pub materials: Vec<Option<MaterialBinding>>,
    /// Where it lies when nothing holds it: the middle of its line, from the root.
    pub free_middle: DVec3,
}

/// Bone frames of a posed scene, seen from the rig's root.
pub(super) struct WorldFrames<'a> {
    pub from_world: DMat4,
    pub world: &'a [DMat4],
    pub bones: &'a [NodeId],
    pub joints: &'a [RigJoint],
    /// By what offsets on each node are multiplied along its axes where muscles scale with the bones; `None` where they keep the file's unit.
    pub ride: Option<&'a [f64]>,
}

impl WorldFrames<'_> {
    /// Bone `index` as a joint turns it.
    pub(super) fn bone(&self, index: usize, moves: bool) -> Bone {
        let world = self.bones.get(index).and_then(|node| self.world.get(node.index()));
        let mut matrix = world.map_or(DMat4::IDENTITY, |world| self.from_world * *world);
        let ride = self.bones.get(index).and_then(|node| self.ride?.get(node.index())).copied();
        if let Some(ride) = ride {
            for axis in [&mut matrix.x_axis, &mut matrix.y_axis, &mut matrix.z_axis] {
                *axis *= ride;
            }
        }
        Bone { matrix, moves, plain: ride.is_none() }
    }
}

impl Frames for WorldFrames<'_> {
    fn angle(&self, index: usize) -> f64 {
        self.joints.get(index).and_then(|joint| joint.angle.of(self.world)).unwrap_or(f64::NAN)
    }

    fn frame(&self, index: usize) -> DMat4 {
        let bone = self.bone(index, false);
        if bone.plain { plain(bone.matrix) } else { bone.matrix }
    }
}

impl MuscleRig {
    /// Number of muscles.
    pub fn len(&self) -> usize {
        self.muscles.len()
    }

    /// Whether there is no muscle.
    pub fn is_empty(&self) -> bool {
        self.muscles.is_empty()
    }

    /// Whether elbow angle or contraction changes anything: there is an arm, or a muscle that no bone holds.
    pub fn is_drivable(&self) -> bool {
        self.flexion_range().is_some() || (0..self.len()).any(|index| !self.is_attached(index))
    }

    /// What muscle `index` is called: by its name, else by its place in the file.
    pub fn label(&self, index: usize) -> Label<'_> {
        self.muscles.get(index).map_or(Label::Name(""), Muscle::label)
    }

    /// What the file says about muscle `index`; the only muscle of a file is called like the file where it has no name.
    pub fn spec(&self, index: usize) -> Option<&MuscleSpec> {
        self.muscles.get(index).map(|muscle| &muscle.spec)
    }

    /// Shape at rest of muscle `index` where it is: the file's, multiplied by [`MuscleRig::scale`].
    pub fn profile(&self, index: usize) -> Option<&Profile> {
        self.muscles.get(index).map(|muscle| &muscle.shape)
    }

    /// By what the lengths of muscle `index` are multiplied where it is: 1 unless the file lets muscles scale with the bones.
    pub fn scale(&self, index: usize) -> f64 {
        self.muscles.get(index).map_or(1.0, |muscle| muscle.scale)
    }

    /// Whether muscle `index` is held by bones; else it lies on its own and contraction alone gives its length.
    pub fn is_attached(&self, index: usize) -> bool {
        self.muscles.get(index).is_some_and(|muscle| muscle.line.is_some())
    }

    /// Oddities seen while building and attaching: bones that are not there, a muscle bent tighter than it is thick.
    pub fn findings(&self) -> &[Diagnostic<Finding>] {
        &self.findings
    }

    /// The elbow angles that the arm allows, degrees; `None` without an arm.
    pub fn flexion_range(&self) -> Option<RangeInclusive<f64>> {
        self.span.map(|span| span.flexion[0]..=span.flexion[1])
    }

    /// The angles that [`MuscleRig::measure`] turns the joint through, degrees: the arm's elbow or the file's `joint`; `None` where there is none.
    pub fn measured_range(&self) -> Option<RangeInclusive<f64>> {
        self.range_of(0)
    }

    /// The joints that [`MuscleRig::measure_over`] turns: what each is called (empty where it was found and not named), and where it is.
    pub fn joints(&self) -> impl ExactSizeIterator<Item = (&str, JointDof)> {
        self.joints.iter().map(|joint| (joint.name.as_str(), joint.dof))
    }

    /// What joint `joint` of the rig is called: as the file names it, else as its node is.
    pub fn joint_label(&self, joint: usize, graph: &Graph) -> Option<OwnedLabel> {
        let joint = self.joints.get(joint)?;
        let named = (!joint.name.is_empty()).then(|| OwnedLabel::from(joint.name.clone()));
        Some(named.unwrap_or_else(|| graph.label(joint.dof.node).to_owned()))
    }

    /// The angles that joint `joint` of the rig is turned through, degrees.
    pub fn range_of(&self, joint: usize) -> Option<RangeInclusive<f64>> {
        self.joints.get(joint).map(|joint| joint.revolute.range[0]..=joint.revolute.range[1])
    }

    /// How skin lies over the muscles: lengths in metres.
    pub fn skin(&self) -> SkinSpec {
        let unit = if self.unit > 0.0 { self.unit } else { 1.0 };
        let SkinSpec { fat, reach, elasticity } = self.skin.unwrap_or_else(|| SkinSpec::in_unit(unit));
        SkinSpec { fat: fat * unit, reach: reach * unit, elasticity }
    }

    /// The joint that [`MuscleRig::measure`] turns: the arm's elbow, the one that the file names, or the one that was found in the clip's skeleton.
    pub fn joint(&self) -> Option<JointDof> {
        self.joints.first().map(|joint| joint.dof)
    }

    /// −dL/dφ of muscle `index` about that joint in a pose of `scene`, φ in radians; `None` where nothing holds the muscle or nothing turns.
    pub fn moment_arm(&self, index: usize, scene: &Scene, world: &[DMat4]) -> Option<f64> {
        self.moment_arm_about(index, &self.joint()?, scene, world)
    }

    /// −dL/dφ of muscle `index` about any joint in a pose of `scene`, φ in radians; `None` where nothing holds the muscle.
    pub fn moment_arm_about(&self, index: usize, joint: &JointDof, scene: &Scene, world: &[DMat4]) -> Option<f64> {
        let line = self.muscles.get(index)?.line.as_ref()?;
        let revolute = self.revolute_of(joint, scene, world);
        // The bones stand where the pose has them: not turned any further.
        Some(measure::at_angle(&revolute, line, revolute.at_rest, &mut LineSolver::default()).moment_arm)
    }

    /// The numbers behind a solution of muscle `index` in a pose of `scene`.
    pub fn ledger(&self, index: usize, solved: &Solved, scene: &Scene, world: &[DMat4]) -> Option<SolverReport> {
        Some(SolverReport::new(self.profile(index)?, solved, self.moment_arm(index, scene, world)))
    }

    /// The state with this elbow angle, held within the range. Without an arm: the muscle at rest.
    pub fn at_flexion(&self, degrees: f64) -> MuscleState {
        match self.span {
            Some(span) => span.at_flexion(degrees, |angle| self.driving_length(angle)),
            None => MuscleState { flexion: 0.0, contraction: 100.0 * self.free_contraction_at_rest() },
        }
    }

    /// The state with this contraction, 0 to 100.
    pub fn at_contraction(&self, per_cent: f64) -> MuscleState {
        match self.span {
            Some(span) => span.at_contraction(per_cent, |angle| self.driving_length(angle)),
            None => MuscleState { flexion: 0.0, contraction: if per_cent.is_nan() { 0.0 } else { per_cent.clamp(0.0, 100.0) } },
        }
    }

    /// Length of the first muscle's line of action on the arm.
    pub(super) fn driving_length(&self, angle: f64) -> f64 {
        let line = self.muscles.first().and_then(|muscle| muscle.line.as_ref());
        self.main_joint().zip(line).map_or(0.0, |(revolute, line)| line.length(&revolute.at(angle)))
    }

    fn free_contraction_at_rest(&self) -> f64 {
        let Some(muscle) = self.muscles.first() else { return 0.0 };
        let [long, short] = muscle.free_lengths();
        if long == short { 0.0 } else { (long - muscle.shape.rest_length()) / (long - short) }
    }

    /// Turns the arm's nodes.
    pub fn apply(&self, drive: MuscleState, pose: &mut Pose) {
        if let (Some((_, nodes)), Some(span)) = (&self.arm, &self.span) {
            let angle = if drive.flexion.is_nan() { span.flexion[0] } else { drive.flexion };
            nodes.bend(angle.clamp(span.flexion[0], span.flexion[1]), pose);
        }
    }

    /// Solves muscle `index` for the world that the pose made. `world` is one matrix a node of the scene.
    pub fn solve(&self, index: usize, drive: MuscleState, world: &[DMat4]) -> SolvedMuscle {
        let mut solved = SolvedMuscle::default();
        self.solve_into(index, drive, world, &mut solved);
        solved
    }

    /// [`MuscleRig::solve`] into a value whose buffers are kept.
    pub fn solve_into(&self, index: usize, drive: MuscleState, world: &[DMat4], solved: &mut SolvedMuscle) {
        let Some(muscle) = self.muscles.get(index) else {
            *solved = SolvedMuscle::default();
            return;
        };
        let SolvedMuscle { shape, line: solver, centerline, flesh } = solved;
        match &muscle.line {
            Some(line) => {
                let frames = self.frames(world);
                muscle.solve_along(line.solve(&frames, solver).length, shape);
                line.draw(&frames, solver, muscle.drawn_length(shape), centerline);
                // What is drawn as an arch keeps clear of the rods by itself; a muscle that begins on the axis of its bone tells no side of it.
                if line.drawn.is_some() || self.is_schematic(muscle, line) {
                    flesh.leave();
                } else {
                    let bones = line.bones().map(|bone| (bone, frames.frame(bone)));
                    flesh.lay(centerline, shape, &muscle.tendons, &self.bone_shapes, bones);
                }
            }
            None => {
                let [long, short] = muscle.free_lengths();
                let share = if drive.contraction.is_nan() { 0.0 } else { drive.contraction.clamp(0.0, 100.0) / 100.0 };
                muscle.shape.solve_into(long + (short - long) * share, shape);
                shape.path_length = shape.length + muscle.fixed();
                *solver = LineSolver::default();
                flesh.leave();
                let half = DVec3::X * (0.5 * shape.path_length);
                centerline.begin(DVec3::Y);
                centerline.line(muscle.free_middle - half, muscle.free_middle + half);
            }
        }
    }

    /// Whether a muscle begins so near to the axis of its bone that it is a scheme.
    pub(super) fn is_schematic(&self, muscle: &Muscle, line: &Line) -> bool {
        let shape = self.bone_shapes.get(line.origin.bone).and_then(Option::as_ref);
        shape.is_none_or(|shape| shape.axis_distance(line.origin.local) < SCHEMATIC * muscle.spec.profile.rest_length())
    }

    /// The joint that measurements turn above all, in the rest pose.
    pub(super) fn main_joint(&self) -> Option<&RevoluteJoint> {
        self.joints.first().map(|joint| &joint.revolute)
    }

    pub(super) fn root_matrix(&self, world: &[DMat4]) -> DMat4 {
        self.root.and_then(|root| world.get(root.index())).copied().unwrap_or(DMat4::IDENTITY)
    }

    pub(super) fn frames<'a>(&'a self, world: &'a [DMat4]) -> WorldFrames<'a> {
        let root = self.root_matrix(world);
        // A root that is scaled to nothing has no inside to measure in.
        let from_world = if root.determinant().abs() > f64::MIN_POSITIVE { root.inverse() } else { DMat4::IDENTITY };
        WorldFrames { from_world, world, bones: &self.bones, joints: &self.joints, ride: self.ride.as_deref() }
    }

    /// The node of the bone that muscle `index` originates from; `None` where it lies on its own.
    pub fn origin_bone(&self, index: usize) -> Option<NodeId> {
        self.bones.get(self.muscles.get(index)?.line.as_ref()?.origin.bone).copied()
    }

    /// Topology of muscle `index`'s surface: fixed while the number of its nodes is.
    pub fn mesh(&self, index: usize) -> Arc<Mesh> {
        let made = |muscle: &Muscle| Arc::clone(muscle.mesh.get_or_init(|| muscle.layout.mesh(&muscle.spec.name)));
        self.muscles.get(index).map(made).unwrap_or_default()
    }

    /// Materials of muscle `index`: one a part of its mesh, already in the scene.
    pub fn materials(&self, index: usize) -> &[Option<MaterialBinding>] {
        self.muscles.get(index).map_or(&[], |muscle| &muscle.materials)
    }

    /// Writes the surface of muscle `index` into the buffers, in the world (metres): one entry a vertex of [`MuscleRig::mesh`]. `None` where there is no such
    /// muscle; then the buffers stay as they are.
    pub fn deform(
        &self,
        index: usize,
        solved: &SolvedMuscle,
        world: &[DMat4],
        positions: &mut Vec<Vec3>,
        normals: &mut Vec<Vec3>,
    ) -> Option<MeshQuality> {
        let muscle = self.muscles.get(index)?;
        let to_world = ToWorld::new(self.root_matrix(world));
        Some(muscle.layout.deform(&Laid::of(solved, &muscle.tendons), &to_world, positions, normals))
    }

    /// Writes the texture coordinates of muscle `index`'s surface, one a vertex of [`MuscleRig::mesh`], that draw its fibres at their pennation: fibres lie along
    /// v at constant u. Those of a muscle without pennation are its mesh's, and `coordinates` becomes empty.
    pub fn fiber_coordinates(&self, index: usize, solved: &SolvedMuscle, coordinates: &mut Vec<Vec2>) {
        coordinates.clear();
        let Some(muscle) = self.muscles.get(index).filter(|muscle| muscle.spec.pennation > 0.0) else { return };
        let angle = self.pennation(index, solved);
        coordinates.extend(self.mesh(index).uv_sets.first().into_iter().flatten());
        muscle.layout.turn_fibers(&BellyTurns::new(&solved.shape.radii, solved.shape.length, angle), coordinates);
    }

    /// The angle of the fibres of muscle `index` to its line of action in a pose, radians; 0 of one without pennation.
    pub fn pennation(&self, index: usize, solved: &SolvedMuscle) -> f64 {
        self.muscles
            .get(index)
            .map_or(0.0, |muscle| pennation::angle(muscle.spec.pennation, muscle.shape.rest_length(), solved.shape.length))
    }

    /// Measures muscle `index` at angles of the elbow, or of the joint that the file names first, in degrees; the other joints are at rest. Without any there
    /// is no angle, and each row is the muscle at rest.
    pub fn measure(&self, index: usize, angles: &[f64]) -> Vec<MuscleSample> {
        self.measure_over(index, 0, angles)
    }

    /// [`MuscleRig::measure`] over joint `joint` of the rig.
    pub fn measure_over(&self, index: usize, joint: usize, angles: &[f64]) -> Vec<MuscleSample> {
        let Some(muscle) = self.muscles.get(index) else { return Vec::new() };
        let mut solver = LineSolver::default();
        let mut row = |&angle: &f64| {
            let mut solved = Solved::default();
            let (Some(turning), Some(line)) = (self.joints.get(joint), &muscle.line) else {
                muscle.shape.solve_into(muscle.shape.rest_length(), &mut solved);
                return MuscleSample { time: None, angle: Some(angle), moment_arm: Some(0.0), moment_arms: Vec::new(), solved };
            };
            let at = measure::at_angle(&turning.revolute, line, angle, &mut solver);
            muscle.solve_along(at.length, &mut solved);
            let turned = turning.revolute.at(angle);
            let about = |(number, other): (usize, &RigJoint)| {
                if number == joint {
                    return at.moment_arm;
                }
                let other = other.revolute.in_pose(&turned, turning.carries.get(number).copied().unwrap_or(false));
                measure::at_angle(&other, line, other.at_rest, &mut solver).moment_arm
            };
            let moment_arms = if self.joints.len() > 1 { self.joints.iter().enumerate().map(about).collect() } else { vec![at.moment_arm] };
            MuscleSample { time: None, angle: Some(angle), moment_arm: Some(at.moment_arm), moment_arms, solved }
        };
        angles.iter().map(&mut row).collect()
    }
}

impl Muscle {
    /// What it is called.
    pub(super) fn label(&self) -> Label<'_> {
        Label::of(&self.spec.name, Unnamed::Muscle(self.number))
    }

    /// Multiplies the lengths of the file by `scale`; one that is no number or not above 0 is 1.
    pub(super) fn rescale(&mut self, scale: f64) {
        self.scale = if scale > 0.0 && scale.is_finite() { scale } else { 1.0 };
        self.shape = self.spec.profile.scaled(self.scale);
        self.tendons = self.spec.tendons.map(|tendon| Tendon { length: tendon.length * self.scale, radius: tendon.radius * self.scale });
    }

    /// Length that the tendons take.
    pub(super) fn fixed(&self) -> f64 {
        self.tendons[0].length + self.tendons[1].length
    }

    /// Length of the centreline that is drawn: tendons longer than what the belly leaves them hang slack, and no arch is drawn for them.
    pub(super) fn drawn_length(&self, solved: &Solved) -> f64 {
        (solved.length + self.fixed()).min(solved.path_length.max(solved.length))
    }

    pub(super) fn solve_along(&self, path_length: f64, solved: &mut Solved) {
        self.shape.solve_into(path_length - self.fixed(), solved);
        solved.path_length = path_length;
    }

    /// Lengths at contraction 0 and 100 % where nothing holds the muscle.
    fn free_lengths(&self) -> [f64; 2] {
        let (rest, valid) = (self.shape.rest_length(), self.shape.length_range());
        FREE.map(|share| (share * rest).clamp(*valid.start(), *valid.end()))
    }
}

//! Muscles placed in a scene: nodes, bones, surfaces, and the state that drives them.

use std::ops::RangeInclusive;
use std::sync::Arc;

use glam::{DMat4, DVec3, Vec3};

use super::arm::{Arm, ArmNodes, FOREARM, UPPER_ARM};
use super::clearance;
use super::config::{Anchor, MuscleFile, MuscleSpec, Tendon};
use super::drive::{FREE, Span};
use super::line::{Frames, Line, Point};
use super::path::Path;
use super::profile::Profile;
use super::surface::{Layout, ToWorld};
use super::{Drive, Sample, Solved, measure};
use crate::animation::Pose;
use crate::scene::{
    Content, Material, MaterialBinding, MaterialId, Mesh, MuscleId, Node, NodeId, NodeKind, Paint, Scene, ShadingModel, Transform,
    TransformOp,
};
use crate::tr;

/// A muscle file placed in a scene.
#[derive(Debug, Clone, Default)]
pub struct Rig {
    /// The root of its nodes; carries the unit.
    pub root: Option<NodeId>,
    arm: Option<(Arm, ArmNodes)>,
    /// Nodes of the bones that lines of action name.
    bones: Vec<NodeId>,
    muscles: Vec<Muscle>,
    span: Option<Span>,
}

/// One muscle of a rig.
#[derive(Debug, Clone)]
struct Muscle {
    name: String,
    profile: Profile,
    tendons: [Tendon; 2],
    line: Option<Line>,
    layout: Layout,
    mesh: Arc<Mesh>,
    materials: Vec<Option<MaterialBinding>>,
    /// Where it lies when nothing holds it: the middle of its line, from the root.
    free_middle: DVec3,
}

/// Bone frames of a posed scene, seen from the rig's root.
struct WorldFrames<'a> {
    from_world: DMat4,
    world: &'a [DMat4],
    bones: &'a [NodeId],
}

impl Frames for WorldFrames<'_> {
    fn frame(&self, index: usize) -> DMat4 {
        let world = self.bones.get(index).and_then(|node| self.world.get(node.index()));
        let mut frame = world.map_or(DMat4::IDENTITY, |world| self.from_world * *world);
        // Offsets are in the muscle's own unit, whatever the bone's scale.
        for axis in [&mut frame.x_axis, &mut frame.y_axis, &mut frame.z_axis] {
            *axis = axis.normalize_or_zero();
        }
        frame
    }
}

impl Rig {
    /// Adds the file's nodes, rods and muscles to `scene`; its muscles get the ids from `first` on.
    pub fn build(file: &MuscleFile, name: &str, scene: &mut Scene, first: MuscleId) -> Self {
        let unit = if file.unit_metres > 0.0 && file.unit_metres.is_finite() { file.unit_metres } else { 0.001 };
        let mut node = Node::new(name);
        node.kind = NodeKind::Asset;
        node.transform = Transform { ops: vec![TransformOp::Scale(DVec3::splat(unit))] };
        let root = scene.graph.add(None, node);
        let mut rig = Self { root: Some(root), ..Self::default() };
        if let Some(arm) = file.arm {
            let nodes = arm.build(scene, root);
            rig.bones = vec![nodes.upper, nodes.elbow];
            rig.arm = Some((arm, nodes));
        }
        let tendon = tendon_material(scene);
        let mut height = 0.0;
        for (index, spec) in file.muscles.iter().enumerate() {
            let mut muscle = rig.muscle(index, spec, scene, tendon);
            // Muscles that nothing holds lie above each other, each clear of the ground at its thickest.
            let thick = 1.6 * spec.profile.radii().iter().copied().fold(0.0, f64::max);
            muscle.free_middle = DVec3::Y * (height + thick);
            if muscle.line.is_none() {
                height += 2.0 * thick;
            }
            let id = MuscleId(first.0 + index as u32);
            let mut node = Node::new(muscle.name.clone());
            node.contents.push(Content::Muscle(id));
            scene.graph.add(Some(root), node);
            rig.muscles.push(muscle);
        }
        rig.settle();
        rig
    }

    fn muscle(&self, index: usize, spec: &MuscleSpec, scene: &mut Scene, tendon: MaterialId) -> Muscle {
        let name = if spec.name.is_empty() { tr!("muscle-name", number = index + 1) } else { spec.name.clone() };
        let layout = Layout::new(spec.profile.radii().len(), &spec.tendons);
        let mesh = layout.mesh(&name);
        let flesh = muscle_material(scene, &name);
        let materials = mesh.parts.iter().enumerate().map(|(part, _)| Some(MaterialBinding::plain(if part == 0 { flesh } else { tendon })));
        let line = spec.origin.as_ref().zip(spec.insertion.as_ref()).and_then(|(origin, insertion)| {
            let (origin, insertion) = (self.arm_point(origin)?, self.arm_point(insertion)?);
            Some(Line { origin, insertion, drawn: None })
        });
        Muscle {
            name,
            profile: spec.profile.clone(),
            tendons: spec.tendons,
            line,
            layout,
            materials: materials.collect(),
            mesh,
            free_middle: DVec3::ZERO,
        }
    }

    fn arm_point(&self, anchor: &Anchor) -> Option<Point> {
        self.arm?;
        let bone = match anchor.bone.as_str() {
            UPPER_ARM => 0,
            FOREARM => 1,
            _ => return None,
        };
        Some(Point { bone, local: anchor.offset })
    }

    /// Finds drawn ends and the range of the elbow, once all muscles are there.
    fn settle(&mut self) {
        let Some((arm, _)) = self.arm else { return };
        let asked = arm.flexion.unwrap_or([0.0, super::FULL_FLEXION]);
        let mut range = asked;
        for (index, muscle) in self.muscles.iter_mut().enumerate() {
            let fixed = muscle.fixed();
            let Some(line) = &mut muscle.line else { continue };
            let fit = clearance::fit(&arm, line, &muscle.profile, &muscle.tendons, asked);
            line.drawn = Some(fit.drawn);
            if index == 0 {
                if arm.flexion.is_none() {
                    range[1] = range[1].min(fit.flexion);
                }
                range = within_valid_lengths(&arm, line, fixed, &muscle.profile, range);
            }
        }
        let line = self.muscles.first().and_then(|muscle| muscle.line.as_ref());
        self.span = Some(Span::new(range, |angle| line.map_or(0.0, |line| line.length(&arm.frames(angle)))));
    }

    /// Number of muscles.
    pub fn len(&self) -> usize {
        self.muscles.len()
    }

    /// Whether there is no muscle.
    pub fn is_empty(&self) -> bool {
        self.muscles.is_empty()
    }

    /// Name of muscle `index`.
    pub fn name(&self, index: usize) -> &str {
        self.muscles.get(index).map_or("", |muscle| &muscle.name)
    }

    /// Shape at rest of muscle `index`.
    pub fn profile(&self, index: usize) -> Option<&Profile> {
        self.muscles.get(index).map(|muscle| &muscle.profile)
    }

    /// The elbow angles that the arm allows, degrees; `None` without an arm.
    pub fn flexion_range(&self) -> Option<RangeInclusive<f64>> {
        self.span.map(|span| span.flexion[0]..=span.flexion[1])
    }

    /// The state with this elbow angle, held within the range. Without an arm: the muscle at rest.
    pub fn at_flexion(&self, degrees: f64) -> Drive {
        match self.span {
            Some(span) => span.at_flexion(degrees, |angle| self.driving_length(angle)),
            None => Drive { flexion: 0.0, contraction: 100.0 * self.free_contraction_at_rest() },
        }
    }

    /// The state with this contraction, 0 to 100.
    pub fn at_contraction(&self, per_cent: f64) -> Drive {
        match self.span {
            Some(span) => span.at_contraction(per_cent, |angle| self.driving_length(angle)),
            None => Drive { flexion: 0.0, contraction: if per_cent.is_nan() { 0.0 } else { per_cent.clamp(0.0, 100.0) } },
        }
    }

    /// Length of the first muscle's line of action on the arm.
    fn driving_length(&self, angle: f64) -> f64 {
        let line = self.muscles.first().and_then(|muscle| muscle.line.as_ref());
        self.arm.zip(line).map_or(0.0, |((arm, _), line)| line.length(&arm.frames(angle)))
    }

    fn free_contraction_at_rest(&self) -> f64 {
        let Some(muscle) = self.muscles.first() else { return 0.0 };
        let [long, short] = muscle.free_lengths();
        if long == short { 0.0 } else { (long - muscle.profile.rest_length()) / (long - short) }
    }

    /// Turns the arm's nodes.
    pub fn apply(&self, drive: Drive, pose: &mut Pose) {
        if let (Some((_, nodes)), Some(span)) = (&self.arm, &self.span) {
            let angle = if drive.flexion.is_nan() { span.flexion[0] } else { drive.flexion };
            nodes.bend(angle.clamp(span.flexion[0], span.flexion[1]), pose);
        }
    }

    /// Solves muscle `index` for the world that the pose made. `world` is one matrix a node of the scene.
    pub fn solve(&self, index: usize, drive: Drive, world: &[DMat4]) -> Solved {
        let mut solved = Solved::default();
        self.solve_into(index, drive, world, &mut solved);
        solved
    }

    /// [`Rig::solve`] into a value whose buffer is kept.
    pub fn solve_into(&self, index: usize, drive: Drive, world: &[DMat4], solved: &mut Solved) {
        let Some(muscle) = self.muscles.get(index) else {
            *solved = Solved::default();
            return;
        };
        match &muscle.line {
            Some(line) => muscle.solve_along(line.length(&self.frames(world)), solved),
            None => {
                let [long, short] = muscle.free_lengths();
                let share = if drive.contraction.is_nan() { 0.0 } else { drive.contraction.clamp(0.0, 100.0) / 100.0 };
                muscle.profile.solve_into(long + (short - long) * share, solved);
                solved.path_length = solved.length + muscle.fixed();
            }
        }
    }

    fn root_matrix(&self, world: &[DMat4]) -> DMat4 {
        self.root.and_then(|root| world.get(root.index())).copied().unwrap_or(DMat4::IDENTITY)
    }

    fn frames<'a>(&'a self, world: &'a [DMat4]) -> WorldFrames<'a> {
        let root = self.root_matrix(world);
        // A root that is scaled to nothing has no inside to measure in.
        let from_world = if root.determinant().abs() > f64::MIN_POSITIVE { root.inverse() } else { DMat4::IDENTITY };
        WorldFrames { from_world, world, bones: &self.bones }
    }

    /// Topology of muscle `index`'s surface: fixed while the number of its nodes is.
    pub fn mesh(&self, index: usize) -> Arc<Mesh> {
        self.muscles.get(index).map(|muscle| Arc::clone(&muscle.mesh)).unwrap_or_default()
    }

    /// Materials of muscle `index`: one a part of its mesh, already in the scene.
    pub fn materials(&self, index: usize) -> &[Option<MaterialBinding>] {
        self.muscles.get(index).map_or(&[], |muscle| &muscle.materials)
    }

    /// Writes the surface of muscle `index` into the buffers, in the world (metres): one entry a vertex of [`Rig::mesh`].
    pub fn deform(&self, index: usize, solved: &Solved, world: &[DMat4], positions: &mut Vec<Vec3>, normals: &mut Vec<Vec3>) {
        let Some(muscle) = self.muscles.get(index) else { return };
        let path = self.path(muscle, solved, world);
        let to_world = ToWorld::new(self.root_matrix(world));
        muscle.layout.deform(solved, &muscle.tendons, &path, &to_world, positions, normals);
    }

    /// The centre line of muscle `index` as it is drawn, in the space of the rig's root and its unit, tendons included.
    pub fn centre_line(&self, index: usize, solved: &Solved, world: &[DMat4]) -> Option<Path> {
        self.muscles.get(index).map(|muscle| self.path(muscle, solved, world))
    }

    fn path(&self, muscle: &Muscle, solved: &Solved, world: &[DMat4]) -> Path {
        let length = solved.length + muscle.fixed();
        match &muscle.line {
            Some(line) => line.lay(&self.frames(world), length),
            None => {
                let half = DVec3::X * (0.5 * length);
                let mut path = Path::new(DVec3::Y);
                path.line(muscle.free_middle - half, muscle.free_middle + half);
                path
            }
        }
    }

    /// Measures muscle `index` at elbow angles in degrees. Without an arm there is no angle, and each row is the muscle at rest.
    pub fn measure(&self, index: usize, angles: &[f64]) -> Vec<Sample> {
        let Some(muscle) = self.muscles.get(index) else { return Vec::new() };
        let row = |&angle: &f64| {
            let mut solved = Solved::default();
            let moment_arm = match (&self.arm, &muscle.line) {
                (Some((arm, _)), Some(line)) => {
                    muscle.solve_along(line.length(&arm.frames(angle)), &mut solved);
                    measure::moment_arm(arm, line, angle)
                }
                _ => {
                    muscle.profile.solve_into(muscle.profile.rest_length(), &mut solved);
                    0.0
                }
            };
            Sample { angle, moment_arm, solved }
        };
        angles.iter().map(row).collect()
    }
}

impl Muscle {
    /// Length that the tendons take.
    fn fixed(&self) -> f64 {
        self.tendons[0].length + self.tendons[1].length
    }

    fn solve_along(&self, path_length: f64, solved: &mut Solved) {
        self.profile.solve_into(path_length - self.fixed(), solved);
        solved.path_length = path_length;
    }

    /// Lengths at contraction 0 and 100 % where nothing holds the muscle.
    fn free_lengths(&self) -> [f64; 2] {
        let (rest, valid) = (self.profile.rest_length(), self.profile.length_range());
        FREE.map(|share| (share * rest).clamp(*valid.start(), *valid.end()))
    }
}

/// The part of `range` (degrees) around its most restful angle in which the muscle's length is valid.
fn within_valid_lengths(arm: &Arm, line: &Line, fixed: f64, profile: &Profile, range: [f64; 2]) -> [f64; 2] {
    const STEPS: usize = 300;
    let valid = profile.length_range();
    let angle = |step: usize| range[0] + (range[1] - range[0]) * step as f64 / STEPS as f64;
    let fits = |angle: f64| valid.contains(&(line.length(&arm.frames(angle)) - fixed));
    let all: Vec<bool> = (0..=STEPS).map(|step| fits(angle(step))).collect();
    let Some(first) = all.iter().position(|fits| *fits) else { return range };
    let last = all.iter().skip(first).position(|fits| !fits).map_or(STEPS, |count| first + count - 1);
    // Between a step that fits and its neighbour that doesn't, halve to the limit.
    let limit = |mut inside: f64, mut outside: f64| {
        for _ in 0..60 {
            let middle = 0.5 * (inside + outside);
            if fits(middle) { inside = middle } else { outside = middle }
        }
        inside
    };
    let low = if first == 0 { range[0] } else { limit(angle(first), angle(first - 1)) };
    let high = if last == STEPS { range[1] } else { limit(angle(last), angle(last + 1)) };
    [low, high]
}

fn muscle_material(scene: &mut Scene, name: &str) -> MaterialId {
    let id = MaterialId(scene.materials.len() as u32);
    scene.materials.push(Material {
        name: name.to_owned(),
        id: "muscle".to_owned(),
        model: ShadingModel::Blinn,
        // The palette's muscle, #B8322E.
        diffuse: Paint::color(0.722, 0.196, 0.180),
        specular: Paint::color(0.18, 0.14, 0.14),
        shininess: 24.0,
        ..Material::default()
    });
    id
}

fn tendon_material(scene: &mut Scene) -> MaterialId {
    let id = MaterialId(scene.materials.len() as u32);
    scene.materials.push(Material {
        name: tr!("muscle-material-tendon"),
        id: "tendon".to_owned(),
        model: ShadingModel::Blinn,
        // The palette's tendon, #E8DFC8.
        diffuse: Paint::color(0.910, 0.875, 0.784),
        specular: Paint::color(0.16, 0.16, 0.16),
        shininess: 30.0,
        ..Material::default()
    });
    id
}

//! A document at one moment: the only way from files to something that can be drawn.

use std::sync::Arc;
use std::time::Instant;

use glam::{DMat4, Mat4};

use super::deform::MeshDeformer;
use super::occlusion_test::mark_covering_surfaces;
use super::skin_follow::SkinBuffers;
use super::{Document, PoseState, SourceKind};
use sinew_muscle::SolvedMuscle;
use sinew_scene::animation::Pose;
use sinew_scene::{Bounds, Content, Frame, FrameJoint, MeshInstance, MuscleId, NodeId, NodeKind, Surface, SurfaceGeometry};

/// Buffers that posing uses again and again, and what it found out on the way.
#[derive(Debug, Clone, Default)]
pub struct PoseBuffers {
    revision: u64,
    muscle_revision: u64,
    pose: Pose,
    local: Vec<DMat4>,
    shown: Vec<bool>,
    plans: Vec<SurfacePlan>,
    solved: Vec<SolvedMuscle>,
    times: PoseTimes,
    skin: SkinBuffers,
    /// Whether the surfaces that cover muscles were looked for since the frame was laid out.
    covering_surfaces_marked: bool,
}

/// Milliseconds that the parts of the last pose took.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PoseTimes {
    /// Sampling the clip, world transforms, solving the muscles.
    pub pose_ms: f64,
    /// Deforming the surfaces: skins, morphs, muscles.
    pub deform_ms: f64,
}

impl PoseBuffers {
    /// How long the last pose took.
    pub fn times(&self) -> PoseTimes {
        self.times
    }

    /// Solutions of all muscles at the last pose, by [`MuscleId`].
    pub fn solved(&self) -> &[SolvedMuscle] {
        &self.solved
    }

    /// The pose's animated values: transform operations, morph weights.
    pub fn pose(&self) -> &Pose {
        &self.pose
    }
}

/// How one surface of the frame is made.
#[derive(Debug, Clone)]
enum SurfacePlan {
    /// A mesh as it is; its box is kept until the matrix changes.
    Rigid { made_for: Option<(Mat4, Bounds)> },
    /// A morphed or skinned mesh.
    Bent(Box<MeshDeformer>),
    /// A muscle.
    Muscle(MuscleId),
}

impl Document {
    /// Poses the document: fills `frame` for the moment that `state` names. Never fails: what is out of range is held at the limit.
    ///
    /// The same `buffers` and `frame` are to be passed again for the next moment; then nothing is allocated.
    pub fn pose(&self, state: &PoseState, buffers: &mut PoseBuffers, frame: &mut Frame) {
        let begun = Instant::now();
        self.pose_nodes(state, buffers, frame);
        for (animated, at_rest) in frame.materials.iter_mut().zip(&buffers.pose.materials) {
            animated.copy_animated_from(at_rest);
        }
        self.solve_muscles(state, buffers, frame);
        let posed = Instant::now();
        self.place_surfaces(state, buffers, frame);
        if !std::mem::replace(&mut buffers.covering_surfaces_marked, true) {
            mark_covering_surfaces(frame);
        }
        let milliseconds = |from: Instant, to: Instant| to.duration_since(from).as_secs_f64() * 1e3;
        buffers.times = PoseTimes { pose_ms: milliseconds(begun, posed), deform_ms: milliseconds(posed, Instant::now()) };
    }

    /// The first half of [`Document::pose`]: samples the clip and places the nodes, and leaves surfaces, materials and muscles as they were. For
    /// questions about bones alone, which need no skin.
    pub fn pose_nodes(&self, state: &PoseState, buffers: &mut PoseBuffers, frame: &mut Frame) {
        if buffers.revision != self.revision || frame.layout_revision != self.revision {
            self.prepare(buffers, frame);
        } else if buffers.muscle_revision != self.muscle_revision || frame.muscle_revision != self.muscle_revision {
            self.prepare_muscles(buffers, frame);
        }
        let pose = &mut buffers.pose;
        pose.reset(&self.scene);
        if let Some(clip) = state.clip.and_then(|clip| self.clips.get(clip)) {
            clip.sample(if state.time.is_finite() { state.time } else { clip.start }, pose);
        }
        for (rig, _) in self.rigs() {
            rig.apply(state.joints.drive, pose);
        }
        pose.locals(&mut buffers.local);
        if let Some(turn) = &state.joints.rotation
            && let Some(local) = buffers.local.get_mut(turn.node.index())
        {
            *local = turn.apply(*local, self.scene.graph.node(turn.node).transform.matrix());
        }
        for turn in state.joints.overrides() {
            if let Some(local) = buffers.local.get_mut(turn.node.index()) {
                *local *= turn.matrix();
            }
        }
        for root in self.scene.graph.roots() {
            if let Some(local) = buffers.local.get_mut(root.index()) {
                *local = state.model * *local;
            }
        }
        self.scene.graph.world_from_local(&buffers.local, &mut frame.world);
    }

    pub(super) fn solve_muscles(&self, state: &PoseState, buffers: &mut PoseBuffers, frame: &Frame) {
        let mut next = 0;
        for (rig, _) in self.rigs() {
            for index in 0..rig.len() {
                if let Some(solved) = buffers.solved.get_mut(next) {
                    rig.solve_into(index, state.joints.drive, &frame.world, solved);
                }
                next += 1;
            }
        }
    }

    fn place_surfaces(&self, state: &PoseState, buffers: &mut PoseBuffers, frame: &mut Frame) {
        self.update_visibility(&mut buffers.shown);
        frame.bounds = Bounds::EMPTY;
        buffers.skin.begin(self, state, &buffers.solved, &frame.world);
        for (index, (surface, plan)) in frame.surfaces.iter_mut().zip(&mut buffers.plans).enumerate() {
            surface.visible = buffers.shown.get(surface.node.index()).copied().unwrap_or(true);
            let world = frame.world.get(surface.node.index()).copied().unwrap_or(DMat4::IDENTITY);
            let (bounds, solid) = match plan {
                SurfacePlan::Rigid { made_for } => {
                    let matrix = world.as_mat4();
                    surface.geometry = SurfaceGeometry::Rigid(matrix);
                    surface.mirrored = world.determinant() < 0.0;
                    let bounds = match made_for {
                        Some((for_matrix, bounds)) if *for_matrix == matrix => *bounds,
                        _ => {
                            let bounds = Bounds::of(surface.mesh.positions.iter().map(|p| matrix.transform_point3(*p)));
                            *made_for = Some((matrix, bounds));
                            bounds
                        }
                    };
                    (bounds, surface.mesh.solid)
                }
                SurfacePlan::Bent(bender) => {
                    let SurfaceGeometry::Deformed { positions, normals } = &mut surface.geometry else { continue };
                    let Some(instance) = self.instance(surface.node, surface.content) else { continue };
                    let (weights, into) = (&buffers.pose.morph_weights, (positions, normals));
                    let (bounds, mirrored) =
                        bender.deform(&self.scene, (surface.node, instance), &surface.mesh, state, &frame.world, weights, into);
                    surface.mirrored = mirrored;
                    (buffers.skin.follow(index, surface).unwrap_or(bounds), false)
                }
                SurfacePlan::Muscle(id) => {
                    let SurfaceGeometry::Deformed { positions, normals } = &mut surface.geometry else { continue };
                    let (Some((rig, index)), Some(solved)) = (self.muscle(*id), buffers.solved.get(id.index())) else { continue };
                    let Some(shape) = rig.deform(index, solved, &frame.world, positions, normals) else { continue };
                    rig.fiber_coordinates(index, solved, &mut surface.coordinates);
                    surface.mirrored = shape.mirrored;
                    (Bounds::of(positions.iter().copied()), !shape.folded)
                }
            };
            surface.solid = solid.then_some(bounds);
            if surface.visible {
                frame.bounds.merge(&bounds);
            }
        }
        if frame.bounds.is_empty() {
            frame.bounds = Bounds::of(frame.joints.iter().map(|joint| frame.position(joint.node)));
        }
    }

    /// Whether each node and all above it are visible.
    pub(super) fn update_visibility(&self, shown: &mut Vec<bool>) {
        shown.clear();
        for (_, node) in self.scene.graph.iter() {
            let above = node.parent().is_none_or(|parent| shown.get(parent.index()).copied().unwrap_or(true));
            shown.push(above && node.visible);
        }
    }

    fn instance(&self, node: NodeId, content: u32) -> Option<&MeshInstance> {
        match self.scene.graph.node(node).contents.get(content as usize) {
            Some(Content::Mesh(instance)) => Some(instance),
            _ => None,
        }
    }

    /// Makes buffers and frame fit the document's nodes, muscles and joints; no surfaces.
    pub(super) fn prepare_nodes(&self, buffers: &mut PoseBuffers, frame: &mut Frame) {
        *buffers = PoseBuffers { revision: self.revision, ..PoseBuffers::default() };
        *frame = Frame { layout_revision: self.revision, ..Frame::default() };
        self.prepare_nodes_from(0, buffers, frame);
    }

    /// The same for the nodes from `first` on, where the buffers and the frame fit those before.
    fn prepare_nodes_from(&self, first: usize, buffers: &mut PoseBuffers, frame: &mut Frame) {
        (buffers.muscle_revision, frame.muscle_revision) = (self.muscle_revision, self.muscle_revision);
        buffers.pose = Pose::rest(&self.scene);
        buffers.solved.resize(self.muscle_count(), SolvedMuscle::default());
        for (id, node) in self.scene.graph.iter().skip(first) {
            if node.kind == NodeKind::Joint {
                frame.joints.push(FrameJoint { node: id, parent: self.joint_above(id) });
            }
        }
    }

    /// Makes buffers and frame fit the document: one surface for each mesh and muscle, in the order of the nodes.
    fn prepare(&self, buffers: &mut PoseBuffers, frame: &mut Frame) {
        self.prepare_nodes(buffers, frame);
        self.prepare_surfaces_from(0, buffers, frame);
    }

    /// The same where nothing changed but the muscles, whose nodes stand behind all others: what the skins of a clip were prepared for stays.
    fn prepare_muscles(&self, buffers: &mut PoseBuffers, frame: &mut Frame) {
        let first = self.first_muscle_node();
        frame.joints.retain(|joint| joint.node.index() < first);
        let kept = frame.surfaces.partition_point(|surface| surface.node.index() < first);
        frame.surfaces.truncate(kept);
        buffers.plans.truncate(kept);
        buffers.covering_surfaces_marked = false;
        buffers.skin.invalidate();
        self.prepare_nodes_from(first, buffers, frame);
        self.prepare_surfaces_from(first, buffers, frame);
    }

    fn prepare_surfaces_from(&self, first: usize, buffers: &mut PoseBuffers, frame: &mut Frame) {
        frame.materials.clone_from(&self.scene.materials);
        let deformed = || SurfaceGeometry::Deformed { positions: Vec::new(), normals: Vec::new() };
        for (id, node) in self.scene.graph.iter().skip(first) {
            for (content, thing) in node.contents.iter().enumerate() {
                let content = content as u32;
                let blank = |mesh, materials, placement, (muscle, fibers)| Surface {
                    node: id,
                    mesh,
                    materials,
                    geometry: placement,
                    mirrored: false,
                    solid: None,
                    muscle,
                    fibers,
                    coordinates: Vec::new(),
                    visible: true,
                    content,
                    skin: false,
                    ghost: None,
                };
                match thing {
                    Content::Mesh(instance) => {
                        let Some(mesh) = self.scene.meshes.get(instance.mesh.index()) else { continue };
                        let (plan, placement) = if instance.deformers.is_empty() {
                            (SurfacePlan::Rigid { made_for: None }, SurfaceGeometry::Rigid(Mat4::IDENTITY))
                        } else {
                            (SurfacePlan::Bent(Box::new(MeshDeformer::new(&self.scene, instance, mesh))), deformed())
                        };
                        buffers.plans.push(plan);
                        frame.surfaces.push(blank(Arc::clone(mesh), Arc::clone(&instance.materials), placement, (None, Arc::default())));
                    }
                    Content::Muscle(muscle) => {
                        let Some((rig, index)) = self.muscle(*muscle) else { continue };
                        buffers.plans.push(SurfacePlan::Muscle(*muscle));
                        let (mesh, materials) = (rig.mesh(index), rig.materials(index).into());
                        let shown = (Some(*muscle), sinew_muscle::fibers(&mesh));
                        frame.surfaces.push(blank(mesh, materials, deformed(), shown));
                    }
                    Content::Light(_) | Content::Camera(_) => {}
                }
            }
        }
    }

    fn joint_above(&self, node: NodeId) -> Option<NodeId> {
        let graph = &self.scene.graph;
        let mut above = graph.node(node).parent();
        while let Some(id) = above {
            if graph.node(id).kind == NodeKind::Joint {
                break;
            }
            above = graph.node(id).parent();
        }
        above
    }

    /// The root nodes that carry muscle files, with their rigs, for showing and editing them.
    pub fn rig_roots(&self) -> impl Iterator<Item = NodeId> {
        self.sources.iter().filter(|source| matches!(source.kind, SourceKind::Muscles(..))).filter_map(|source| source.root)
    }
}

//! Skins that follow the muscles beneath them: which do is found once a document, at rest.

use std::sync::{Arc, Mutex, PoisonError};

use glam::DMat4;

use super::{Document, Finding, PoseBuffers, PoseState, SkinMotion, SourceKind};
use rustc_hash::FxHashSet;
use sinew_muscle::{BoneAxis, CrossSection, SkinSpec, SolvedMuscle};
use sinew_scene::diagnostics::Diagnostic;
use sinew_scene::{Bounds, Content, Deformer, Frame, MuscleId, NodeId, Surface, SurfaceGeometry};
use sinew_skin::{Binding, Follower, MuscleTissue, Segment, SkinLayer, SkinMesh, Stations};

/// The skins of a document, bound to its muscles.
#[derive(Debug, Default)]
pub(super) struct BoundSkins {
    muscles: Vec<MuscleTissue>,
    bones: Vec<BoneAxis>,
    /// By surface of the frame; `None` where it follows nothing.
    bindings: Vec<Option<Binding>>,
}

impl BoundSkins {
    /// The surfaces that follow muscles, by their place in the frame.
    pub(super) fn bindings(&self) -> impl Iterator<Item = (usize, &Binding)> {
        self.bindings.iter().enumerate().filter_map(|(index, binding)| Some((index, binding.as_ref()?)))
    }
}

/// The bound skins of one state of a document; copies of the document share it.
#[derive(Debug, Clone, Default)]
pub(super) struct SkinCache(Arc<Mutex<Option<CachedSkins>>>);

#[derive(Debug, Clone)]
struct CachedSkins {
    revisions: [u64; 2],
    skins: Arc<BoundSkins>,
}

/// What moving skins in a pose needs; its memory is kept.
#[derive(Debug, Clone, Default)]
pub(super) struct SkinBuffers {
    skins: Option<Arc<BoundSkins>>,
    moment: Moment,
    follower: Follower,
    follows: bool,
}

/// Muscles and bones at one moment.
#[derive(Debug, Clone, Default)]
struct Moment {
    sections: Vec<CrossSection>,
    tissue: Vec<sinew_skin::CrossSection>,
    bones: Vec<Segment>,
    stations: Stations,
}

impl SkinBuffers {
    /// Forgets what was bound.
    pub(super) fn invalidate(&mut self) {
        self.skins = None;
    }

    /// Prepares for the surfaces of a pose whose muscles are solved.
    pub(super) fn begin(&mut self, document: &Document, state: &PoseState, solved: &[SolvedMuscle], world: &[DMat4]) {
        let size = state.model.determinant();
        self.follows = state.skin == SkinMotion::FollowsMuscles && size > 0.0 && document.may_have_bound_skins();
        if !self.follows {
            return;
        }
        let skins = Arc::clone(self.skins.get_or_insert_with(|| document.bound_skins()));
        self.follows = skins.bindings.iter().any(Option::is_some);
        if self.follows {
            self.moment.place(document, &skins.muscles, &skins.bones, solved, world, size.cbrt());
        }
    }

    /// Moves surface `index` of the frame, which its skeleton has bent; the box round it where it moved.
    pub(super) fn follow(&mut self, index: usize, surface: &mut Surface) -> Option<Bounds> {
        let binding = self.skins.as_ref().filter(|_| self.follows)?.bindings.get(index)?.as_ref()?;
        let SurfaceGeometry::Deformed { positions, normals } = &mut surface.geometry else { return None };
        self.follower.follow(binding, &self.moment.stations, positions, normals);
        Some(Bounds::of(positions.iter().copied()))
    }
}

impl Moment {
    fn place(
        &mut self,
        document: &Document,
        muscles: &[MuscleTissue],
        bones: &[BoneAxis],
        solved: &[SolvedMuscle],
        world: &[DMat4],
        scale: f64,
    ) {
        self.sections.clear();
        for (rig, first) in document.rigs() {
            for index in 0..rig.len() {
                if let Some(solved) = solved.get(first.index() + index) {
                    rig.cross_sections(index, solved, world, &mut self.sections);
                }
            }
        }
        self.tissue.clear();
        self.tissue.extend(self.sections.iter().map(tissue));
        self.bones.clear();
        let axis = |bone: &BoneAxis| {
            bone.ends(world).map_or(Segment { start: glam::DVec3::ZERO, end: glam::DVec3::ZERO }, |[start, end]| Segment { start, end })
        };
        self.bones.extend(bones.iter().map(axis));
        self.stations.place(muscles, &self.tissue, &self.bones, scale);
    }
}

fn tissue(section: &CrossSection) -> sinew_skin::CrossSection {
    sinew_skin::CrossSection {
        center: section.center,
        tangent: section.tangent,
        radius: section.radius,
        flatness: section.flatness,
        flattened_along: section.toward,
        half_length: section.half_length,
        volume: section.volume,
        belly: section.belly,
    }
}

impl Document {
    /// The muscles that lie in a skin which follows them.
    pub fn muscles_under_skin(&self) -> Vec<MuscleId> {
        if !self.may_have_bound_skins() {
            return Vec::new();
        }
        let skins = self.bound_skins();
        let under = |index: &usize| skins.bindings().any(|(_, binding)| binding.encloses(*index));
        (0..self.muscle_count()).filter(under).map(|index| MuscleId(index as u32)).collect()
    }

    /// The surfaces that follow muscles, by their place in the frame, each with the vertices that may move, rising.
    pub fn bound_surfaces(&self) -> Vec<(usize, Vec<u32>)> {
        if !self.may_have_bound_skins() {
            return Vec::new();
        }
        let bound = |(index, binding): (usize, &Binding)| {
            let mut vertices: Vec<u32> = binding.vertices().collect();
            vertices.sort_unstable();
            (index, vertices)
        };
        self.bound_skins().bindings().map(bound).collect()
    }

    /// Number of vertices that follow muscles.
    pub fn bound_vertices(&self) -> usize {
        if !self.may_have_bound_skins() {
            return 0;
        }
        self.bound_skins().bindings().map(|(_, binding)| binding.vertices().count()).sum()
    }

    /// Whether a skin follows any muscle.
    pub fn has_muscles_under_skin(&self) -> bool {
        self.may_have_bound_skins() && self.bound_skins().bindings().next().is_some()
    }

    /// Tells of the muscles on bones of a skin that lie outside of it, in place of what was told of that before.
    pub(super) fn tell_of_muscles_outside_skin(&mut self) {
        self.diagnostics.retain(|found| found.finding != Finding::MuscleOutsideSkin);
        if !self.may_have_bound_skins() {
            return;
        }
        let skins = self.bound_skins();
        let joints = self.scene.graph.iter().flat_map(|(_, node)| &node.contents).filter_map(|content| match content {
            Content::Mesh(instance) => Some(&instance.deformers),
            _ => None,
        });
        let joints: FxHashSet<NodeId> = joints
            .flatten()
            .filter_map(|deformer| match deformer {
                Deformer::Skin { joints, .. } => Some(joints),
                Deformer::Morph(_) => None,
            })
            .flat_map(|joints| joints.iter().flatten().copied())
            .collect();
        let mut told = Vec::new();
        for source in &self.sources {
            let SourceKind::Muscles(_, rig) = &source.kind else { continue };
            let first = self.rigs().find(|(other, _)| std::ptr::eq(*other, &raw const **rig)).map_or(0, |(_, first)| first.index());
            for index in 0..rig.len() {
                let bones = skins.muscles.get(first + index).map_or(&[][..], |muscle| &muscle.bones);
                let moved = bones.iter().any(|bone| skins.bones.get(*bone).is_some_and(|bone| joints.contains(&bone.node)));
                if moved && !skins.bindings().any(|(_, binding)| binding.encloses(first + index)) {
                    let found = Diagnostic::new(Finding::MuscleOutsideSkin, None, rig.label(index).to_owned());
                    told.push(found.in_file(source.name.clone()));
                }
            }
        }
        self.diagnostics.extend(told);
    }

    /// Whether there are muscles on bones and meshes that bones move at all.
    fn may_have_bound_skins(&self) -> bool {
        !self.scene.skins.is_empty() && self.rigs().any(|(rig, _)| (0..rig.len()).any(|index| rig.is_attached(index)))
    }

    /// The document's skins as they are bound to its muscles at rest. Made when they are asked for first.
    pub(super) fn bound_skins(&self) -> Arc<BoundSkins> {
        let mut cache = self.skins.0.lock().unwrap_or_else(PoisonError::into_inner);
        let revisions = [self.revision, self.muscle_revision];
        match &*cache {
            Some(cached) if cached.revisions == revisions => Arc::clone(&cached.skins),
            _ => {
                let skins = Arc::new(self.bind_skins());
                *cache = Some(CachedSkins { revisions, skins: Arc::clone(&skins) });
                skins
            }
        }
    }

    fn bind_skins(&self) -> BoundSkins {
        let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
        self.pose(&PoseState { skin: SkinMotion::Skeleton, ..PoseState::default() }, &mut buffers, &mut frame);
        let mut skins = BoundSkins::default();
        let mut first_section = 0;
        for (rig, _) in self.rigs() {
            let SkinSpec { fat, reach, elasticity } = rig.skin();
            for index in 0..rig.len() {
                let count = rig.cross_section_count(index);
                let mut numbers = Vec::new();
                for axis in rig.bone_chain(index, &self.scene.graph, &frame.world) {
                    let known = skins.bones.iter().position(|bone| *bone == axis);
                    numbers.push(known.unwrap_or(skins.bones.len()));
                    if known.is_none() {
                        skins.bones.push(axis);
                    }
                }
                let sections = first_section..first_section + count;
                skins.muscles.push(MuscleTissue { sections, bones: numbers, layer: SkinLayer { fat, reach, elasticity } });
                first_section += count;
            }
        }
        let mut moment = Moment::default();
        moment.place(self, &skins.muscles, &skins.bones, buffers.solved(), &frame.world, 1.0);
        let bind = |surface: &Surface| {
            let SurfaceGeometry::Deformed { positions, .. } = &surface.geometry else { return None };
            let mesh = SkinMesh { positions, triangles: &surface.mesh.triangles };
            let bound = surface.muscle.is_none().then(|| Binding::new(&mesh, &skins.muscles, &moment.stations))?;
            (!bound.is_empty()).then_some(bound)
        };
        skins.bindings = frame.surfaces.iter().map(bind).collect();
        skins
    }
}

//! Any file to a document, and a document to a frame.
//!
//! [`Document::open`] reads files and puts them side by side into one scene; [`Document::pose`] makes a [`sinew_scene::Frame`] of any moment of it.

mod angle;
mod arm_placement;
mod built_in;
mod deform;
mod error;
mod file;
mod finding;
mod foreign;
mod formats;
mod image_budget;
mod image_decoder;
mod image_finding;
mod image_paths;
mod image_scaler;
mod images;
mod joint_angles;
mod joint_control;
mod joint_ik;
mod joint_override;
mod merge;
mod mix;
mod motion_bounds;
mod muscle_samples;
mod muscle_sources;
mod occlusion_test;
mod open;
mod outline;
mod pose;
mod posed_copy;
mod skin_follow;
mod skin_kernel;
mod skin_plan;
mod skinning;
mod vertex_influences;

pub use angle::angle_at;
pub use error::{OpenError, OpenErrorKind};
pub use finding::Finding;
pub use foreign::UnsupportedFormat;
pub use formats::SceneReaders;
pub use image_finding::ImageFinding;
pub use joint_angles::{JointSample, JointTrack};
pub use joint_control::JointControl;
pub use joint_override::JointOverride;
pub use open::{ImageLoading, OpenOptions};
pub use pose::{PoseBuffers, PoseTimes};
pub use posed_copy::PosedCopy;
pub use vertex_influences::{JointContribution, VertexInfluences};

use std::path::PathBuf;
use std::sync::atomic::{AtomicU64, Ordering};

use glam::DMat4;

use sinew_muscle::{JointDof, JointRotation, MuscleFile, MuscleRig, MuscleState};
use sinew_scene::animation::Clip;
use sinew_scene::diagnostics::Diagnostic;
use sinew_scene::import::Asset;
use sinew_scene::message::SourceName;
use sinew_scene::{Content, Label, MuscleId, NodeId, NodeKind, Scene, Unnamed};

/// Where a document's parts came from.
#[derive(Debug, Clone)]
pub struct Source {
    /// What it was read from.
    pub name: SourceName,
    /// The file; `None` for standard input and the built-in scene.
    pub path: Option<PathBuf>,
    /// The root of its nodes.
    pub root: Option<NodeId>,
    /// What kind of file, with what only that kind has.
    pub kind: SourceKind,
}

/// What kind of file a source is.
#[derive(Debug, Clone)]
pub enum SourceKind {
    /// A scene: what the file says of itself.
    Scene(Asset),
    /// Muscles: what the file said, and where it stands in the scene.
    Muscles(Box<MuscleFile>, Box<MuscleRig>),
}

/// What stands in the way of a moving picture, told plainly in the window.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Missing {
    /// No mesh.
    Mesh,
    /// No skeleton.
    Skeleton,
    /// No animation.
    Animation,
}

/// One open scene: files side by side in one graph.
#[derive(Debug, Clone, Default)]
pub struct Document {
    /// The scene at rest.
    pub scene: Scene,
    /// The files it was made from.
    pub sources: Vec<Source>,
    /// All clips.
    pub clips: Vec<Clip>,
    /// All findings, by file and line.
    pub diagnostics: Vec<Diagnostic<Finding>>,
    /// How much of the scene is not muscles'.
    scene_baseline: muscle_sources::SceneBaseline,
    /// Changes whenever nodes or meshes of the files do, so that frames know when to lay out their buffers anew.
    revision: u64,
    /// Changes whenever the muscles do, whose nodes stand behind all others: then only what belongs to muscles is laid out anew.
    muscle_revision: u64,
    skins: skin_follow::SkinCache,
}

/// How joints bend a skin.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Skinning {
    /// Blends matrices: what COLLADA defines.
    #[default]
    Linear,
    /// Blends unit dual quaternions: keeps the volume of a twisted joint (Kavan et al., "Skinning with dual quaternions", I3D 2007).
    DualQuaternion,
}

/// What moves a skin.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SkinMotion {
    /// The skeleton, and the muscles that lie beneath it.
    #[default]
    FollowsMuscles,
    /// The skeleton alone.
    Skeleton,
}

/// The values that choose a moment.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PoseState {
    /// Index in [`Document::clips`]; `None` = rest pose.
    pub clip: Option<usize>,
    /// Seconds on the file's own time axis.
    pub time: f64,
    /// How joints are turned by hand.
    pub joints: JointControl,
    /// Moves the whole model in the world, after everything else.
    pub model: DMat4,
    /// How joints bend a skin.
    pub skinning: Skinning,
    /// Whether muscles move the skin over them.
    pub skin: SkinMotion,
}

impl PoseState {
    /// The same at another time, seconds on the file's own axis.
    pub fn at_time(&self, time: f64) -> Self {
        Self { time, ..self.clone() }
    }

    /// The same with the arms of muscle files in this state.
    pub fn with_drive(&self, drive: MuscleState) -> Self {
        let mut state = self.clone();
        state.joints.drive = drive;
        state
    }

    /// The same with the joint of the clip turned so; `None` = as the clip has it.
    pub fn with_rotation(&self, rotation: Option<JointRotation>) -> Self {
        let mut state = self.clone();
        state.joints.rotation = rotation;
        state
    }
}

/// A number that no document has had yet: copies of a document share buffers until one of them changes.
fn next_revision() -> u64 {
    static NEXT: AtomicU64 = AtomicU64::new(1);
    NEXT.fetch_add(1, Ordering::Relaxed)
}

impl Document {
    /// Whether anything but bones is there to be drawn.
    pub fn shows_surface(&self) -> bool {
        let drawn = |content: &Content| matches!(content, Content::Mesh(_) | Content::Muscle(_));
        self.scene.graph.iter().any(|(_, node)| node.contents.iter().any(drawn))
    }

    /// The scene that is shown when no file is given: the report's measured biceps on its arm.
    pub fn built_in() -> Self {
        built_in::document()
    }

    /// What stands in the way of a moving picture; empty where a muscle can be driven.
    pub fn missing(&self) -> Vec<Missing> {
        let mut missing = Vec::new();
        if self.rigs().next().is_some() {
            return missing;
        }
        let (mut mesh, mut joint) = (false, false);
        for (_, node) in self.scene.graph.iter() {
            mesh |= node.contents.iter().any(|content| matches!(content, Content::Mesh(_)));
            joint |= node.kind == NodeKind::Joint;
        }
        for (there, what) in [(mesh, Missing::Mesh), (joint, Missing::Skeleton), (!self.clips.is_empty(), Missing::Animation)] {
            if !there {
                missing.push(what);
            }
        }
        missing
    }

    /// The state to start with: first clip at its start, straight arm.
    pub fn start_state(&self) -> PoseState {
        PoseState {
            clip: (!self.clips.is_empty()).then_some(0),
            time: self.clips.first().map_or(0.0, |clip| clip.start),
            joints: JointControl::driven(self.driven_rig().map_or_else(MuscleState::default, |rig| rig.at_flexion(0.0))),
            ..PoseState::default()
        }
    }

    /// The rigs with their first muscle's id.
    pub fn rigs(&self) -> impl Iterator<Item = (&MuscleRig, MuscleId)> {
        let mut first = 0;
        self.sources.iter().filter_map(move |source| match &source.kind {
            SourceKind::Muscles(_, rig) => {
                let id = MuscleId(first);
                first += rig.len() as u32;
                Some((&**rig, id))
            }
            SourceKind::Scene(_) => None,
        })
    }

    /// The rig that the sliders drive: the first one.
    pub fn driven_rig(&self) -> Option<&MuscleRig> {
        self.rigs().next().map(|(rig, _)| rig)
    }

    /// The joint of a clip's skeleton that the user can rotate: the one that a muscle file names or its muscles cross, else the elbow that is found
    /// in the skeleton. `None` where there is none. Looks at the whole scene and its clips: ask once, when a document has been opened.
    ///
    /// The elbow of a muscle file's own arm is none of these; [`JointControl::drive`] bends it.
    pub fn joint(&self) -> Option<JointDof> {
        self.muscles_joint().or_else(|| self.elbow())
    }

    /// The joint that a muscle file names or its muscles cross; quick.
    pub fn muscles_joint(&self) -> Option<JointDof> {
        self.rigs().filter(|(rig, _)| rig.flexion_range().is_none()).find_map(|(rig, _)| rig.joint())
    }

    /// The elbow that is found in a clip's skeleton, whatever muscles there are. Looks at the whole scene and its clips.
    pub fn elbow(&self) -> Option<JointDof> {
        let own: Vec<NodeId> = self.rig_roots().collect();
        JointDof::elbow(&self.scene, &self.clips, &own)
    }

    /// The rig of muscle `id` and the muscle's index in it.
    pub fn muscle(&self, id: MuscleId) -> Option<(&MuscleRig, usize)> {
        self.rigs().find_map(|(rig, first)| {
            let index = id.0.checked_sub(first.0)? as usize;
            (index < rig.len()).then_some((rig, index))
        })
    }

    /// The first clip of this name, else of this id; `#2` is the second clip. A clip without a name is found by what it is called in any language.
    pub fn clip_named(&self, name: &str) -> Option<usize> {
        let by = |is: &dyn Fn(&Clip) -> bool| self.clips.iter().position(is).filter(|_| !name.is_empty());
        let numbered = || name.strip_prefix('#')?.parse::<usize>().ok()?.checked_sub(1).filter(|index| *index < self.clips.len());
        let unnamed = || Unnamed::parse(name).map(Label::Unnamed);
        by(&|clip| clip.name == name)
            .or_else(|| by(&|clip| clip.id == name))
            .or_else(numbered)
            .or_else(|| unnamed().and_then(|label| by(&|clip| clip.label() == label)))
    }

    /// What [`Document::clip_named`] finds this clip by: its name where it has one that is its own, else `#` and its place from 1.
    pub fn clip_key(&self, index: usize) -> Option<String> {
        let name = &self.clips.get(index)?.name;
        let own = self.clip_named(name) == Some(index);
        Some(if own { name.clone() } else { format!("#{}", index + 1) })
    }

    /// Number of muscles of all rigs.
    pub fn muscle_count(&self) -> usize {
        self.rigs().map(|(rig, _)| rig.len()).sum()
    }

    /// Says that nodes, meshes or materials were changed, so that the next pose lays out its buffers anew.
    pub fn bump_revision(&mut self) {
        self.revision = next_revision();
        self.bump_muscle_revision();
    }

    /// Says that muscles were changed and nothing else.
    fn bump_muscle_revision(&mut self) {
        self.muscle_revision = next_revision();
    }
}

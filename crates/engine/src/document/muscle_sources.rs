//! Muscle files in the scene, and their exchange while the scene is open.
//!
//! What belongs to muscles stands behind everything else in the scene's lists, so that an edit takes off the tail and builds it anew: ids of bones
//! and meshes of a clip stay as they are.

use std::path::{Path, PathBuf};

use glam::DMat4;

use super::Finding;
use super::arm_placement::ArmPlacer;
use super::{Document, Source, SourceKind};
use sinew_muscle::sets::{AttachedSet, MuscleSet, SetError, Sides};
use sinew_muscle::{MuscleFile, MuscleRig};
use sinew_scene::animation::Pose;
use sinew_scene::diagnostics::Diagnostic;
use sinew_scene::message::SourceName;
use sinew_scene::{Bounds, MuscleId, NodeId, TransformOp};

/// Moments of a clip at which muscles on its bones are looked at, the first clips alone, and the most nodes posed for that at all moments of one.
const CLIP_SAMPLES: usize = 32;
const MAX_CLIPS: usize = 2;
const MAX_SAMPLED_NODES: usize = 40_000;

/// Lengths of the scene's lists without muscles.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct SceneBaseline {
    nodes: usize,
    meshes: usize,
    materials: usize,
    /// The box round the scene at its start; empty where no arm has to keep clear of it.
    bounds: Bounds,
}

impl Document {
    /// Puts the muscles of all files into the scene, once everything else is there, and attaches them to the bones that they name.
    pub(super) fn place_muscles(&mut self) {
        let scene = &self.scene;
        self.scene_baseline =
            SceneBaseline { nodes: scene.graph.len(), meshes: scene.meshes.len(), materials: scene.materials.len(), bounds: Bounds::EMPTY };
        if self.scene_baseline.nodes > 0 && self.muscle_files().any(|file| file.arm.is_some()) {
            self.bump_revision();
            self.scene_baseline.bounds = self.outline(&self.start_state());
        }
        self.build_muscles();
        self.bump_revision();
        self.tell_of_muscles_outside_skin();
    }

    fn build_muscles(&mut self) {
        let mut first = MuscleId(0);
        let mut placer = ArmPlacer::new(&self.scene_baseline.bounds);
        for source in &mut self.sources {
            let SourceKind::Muscles(file, rig) = &mut source.kind else { continue };
            let title = match &source.path {
                Some(path) => path.file_stem().unwrap_or_default().to_string_lossy().into_owned(),
                None => String::new(),
            };
            **rig = MuscleRig::build(file, &title, &mut self.scene, first);
            if let (Some(arm), Some(root)) = (file.arm, rig.root)
                && let Some(place) = placer.place(&arm, file)
            {
                self.scene.graph.node_mut(root).transform.ops.insert(0, TransformOp::Translate(place));
            }
            first.0 += rig.len() as u32;
            source.root = rig.root;
        }
        let moments = self.clip_samples();
        for source in &mut self.sources {
            let SourceKind::Muscles(_, rig) = &mut source.kind else { continue };
            rig.attach_moving(&self.scene, &self.clips);
            rig.check_clip(&moments);
            tell_findings(&mut self.diagnostics, &source.name, rig);
        }
    }

    /// Gives the muscles the shapes of these files, where nothing but shapes differs, so that nothing is built anew; whether that was so. Else nothing changes.
    fn reshape_muscles(&mut self, files: &[MuscleFile]) -> bool {
        let rigs = self.rigs().map(|(rig, _)| rig);
        let is_same_count = self.muscle_files().count() == files.len();
        if !(is_same_count && rigs.zip(self.muscle_files()).zip(files).all(|((rig, old), new)| old == new || rig.can_reshape(old, new))) {
            return false;
        }
        let moments = self.clip_samples();
        for (source, new) in self.sources.iter_mut().filter(|source| matches!(source.kind, SourceKind::Muscles(..))).zip(files) {
            if let SourceKind::Muscles(file, rig) = &mut source.kind
                && **file != *new
            {
                rig.reshape(file, new, &self.scene.graph, &moments);
                file.as_mut().clone_from(new);
                tell_findings(&mut self.diagnostics, &source.name, rig);
            }
        }
        true
    }

    /// The nodes at some moments of the clips, for muscles on bones to be looked at; none where there are no such muscles.
    fn clip_samples(&self) -> Vec<(f64, Vec<DMat4>)> {
        if self.muscle_files().all(|file| file.arm.is_some()) {
            return Vec::new();
        }
        let (mut pose, mut local, mut moments) = (Pose::rest(&self.scene), Vec::new(), Vec::new());
        let count = (MAX_SAMPLED_NODES / self.scene.graph.len().max(1)).clamp(2, CLIP_SAMPLES);
        for clip in self.clips.iter().filter(|clip| clip.duration() > 0.0).take(MAX_CLIPS) {
            for moment in 0..count {
                let time = clip.start + clip.duration() * moment as f64 / (count - 1) as f64;
                pose.reset(&self.scene);
                clip.sample(time, &mut pose);
                pose.locals(&mut local);
                let mut world = Vec::new();
                self.scene.graph.world_from_local(&local, &mut world);
                moments.push((time, world));
            }
        }
        moments
    }

    /// A set of muscles on the first figure of the scene at rest; the scene stays as it is.
    ///
    /// # Errors
    /// [`SetError`] where there is no figure, or it lacks joints.
    pub fn attach_set(&self, set: MuscleSet, sides: Sides) -> Result<AttachedSet, SetError> {
        let own: Vec<NodeId> = self.rigs().filter_map(|(rig, _)| rig.root).collect();
        set.attach(&self.scene, &self.clips, &own, sides)
    }

    /// The muscle files, in the order of their sources.
    pub fn muscle_files(&self) -> impl Iterator<Item = &MuscleFile> {
        self.sources.iter().filter_map(|source| match &source.kind {
            SourceKind::Muscles(file, _) => Some(&**file),
            SourceKind::Scene(_) => None,
        })
    }

    /// The number of the file among [`Document::muscle_files`] that muscle `id` is in, and its place there.
    pub fn file_of_muscle(&self, id: MuscleId) -> Option<(usize, usize)> {
        self.rigs().enumerate().find_map(|(file, (rig, first))| {
            let index = id.0.checked_sub(first.0)? as usize;
            (index < rig.len()).then_some((file, index))
        })
    }

    /// Puts other muscle files in place of those that are there, in the same order, and builds their muscles anew. Nodes of other files keep their ids.
    /// Files beyond those that are there come in as new ones, kept nowhere yet; where there are fewer, the last ones leave the scene.
    pub fn set_muscle_files(&mut self, files: &[MuscleFile]) {
        self.bump_muscle_revision();
        if self.reshape_muscles(files) {
            self.tell_of_muscles_outside_skin();
            return;
        }
        let count = self.muscle_files().count();
        for number in count..files.len() {
            let kind = SourceKind::Muscles(Box::default(), Box::default());
            let name = SourceName::New(number);
            self.sources.push(Source { name, path: None, root: None, kind });
        }
        let mut seen = 0;
        let diagnostics = &mut self.diagnostics;
        self.sources.retain(|source| {
            let stays = !matches!(source.kind, SourceKind::Muscles(..)) || seen < files.len();
            seen += usize::from(matches!(source.kind, SourceKind::Muscles(..)));
            if !stays {
                diagnostics.retain(|finding| finding.file != source.name);
            }
            stays
        });
        for (source, new) in self.muscle_sources_mut().zip(files) {
            if let SourceKind::Muscles(file, _) = &mut source.kind {
                file.as_mut().clone_from(new);
            }
        }
        self.scene.graph.truncate(self.scene_baseline.nodes);
        self.scene.meshes.truncate(self.scene_baseline.meshes);
        self.scene.materials.truncate(self.scene_baseline.materials);
        self.build_muscles();
        self.tell_of_muscles_outside_skin();
    }

    /// Where muscle file `index` is kept; `None` for one that was never saved.
    pub fn muscle_file_path(&self, index: usize) -> Option<&Path> {
        let mut sources = self.sources.iter().filter(|source| matches!(source.kind, SourceKind::Muscles(..)));
        sources.nth(index)?.path.as_deref()
    }

    /// Says that muscle file `index` is kept at `path` from now on.
    pub fn set_muscle_file_path(&mut self, index: usize, path: PathBuf) {
        let name = SourceName::from(path.display().to_string());
        let Some(source) = self.muscle_sources_mut().nth(index) else { return };
        let before = std::mem::replace(&mut source.name, name.clone());
        source.path = Some(path);
        self.diagnostics.iter_mut().filter(|finding| finding.file == before).for_each(|finding| finding.file.clone_from(&name));
    }

    /// The index of the first node that belongs to muscles.
    pub(super) fn first_muscle_node(&self) -> usize {
        self.scene_baseline.nodes
    }

    fn muscle_sources_mut(&mut self) -> impl Iterator<Item = &mut Source> {
        self.sources.iter_mut().filter(|source| matches!(source.kind, SourceKind::Muscles(..)))
    }
}

/// Puts the findings of a rig in place of those that were told of its file.
fn tell_findings(diagnostics: &mut Vec<Diagnostic<Finding>>, name: &SourceName, rig: &MuscleRig) {
    diagnostics.retain(|found| found.file != *name || !matches!(found.finding, Finding::Muscle(_)));
    diagnostics.extend(rig.findings().iter().cloned().map(|found| found.map(Finding::Muscle).in_file(name.clone())));
}

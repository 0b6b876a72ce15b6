//! `sinew info`: what is in a file.

use std::fmt::Write as _;

use clap::ArgMatches;
use serde::Serialize;

use super::check::FindingReport;
use super::files;
use super::output::{Failure, display_name, print_json, print_result};
use crate::document::{Document, ImageLoading, OpenOptions, SourceKind};
use crate::export::tables::{unit_label, unit_name};
use crate::formats::SCENE_READERS;
use crate::i18n::{self, Sentence, decimal};
use crate::progress::Progress;
use crate::scene::{Content, Deformer, MeshId, MeshInstance, NodeKind};
use crate::tr;
use crate::view;

/// What is in a file. The names and their order are a contract.
#[derive(Debug, Serialize)]
struct Info {
    file: String,
    format: String,
    version: String,
    authoring_tool: String,
    up_axis: String,
    unit_metres: f64,
    nodes: usize,
    joints: usize,
    meshes: Vec<MeshInfo>,
    clips: Vec<ClipInfo>,
    materials: usize,
    images: Vec<ImageInfo>,
    muscles: Vec<MuscleInfo>,
    bounds: Option<BoundsInfo>,
    warnings: Vec<FindingReport>,
}

#[derive(Debug, Serialize)]
struct MeshInfo {
    name: String,
    /// Points of the file.
    vertices: u32,
    triangles: usize,
    skinned: bool,
    joints: usize,
    morph_targets: usize,
    /// Vertices after points were split where normals or texture coordinates differ.
    drawn_vertices: usize,
}

#[derive(Debug, Serialize)]
struct ClipInfo {
    name: String,
    start: f64,
    duration: f64,
    channels: usize,
    keyframes: usize,
}

#[derive(Debug, Serialize)]
struct ImageInfo {
    uri: String,
    found: bool,
}

#[derive(Debug, Serialize)]
struct MuscleInfo {
    name: String,
    nodes: usize,
    rest_length: f64,
    volume: f64,
}

/// A box in the world, metres.
#[derive(Debug, Serialize)]
struct BoundsInfo {
    min: [f32; 3],
    max: [f32; 3],
}

/// Runs the subcommand.
pub(super) fn run(given: &ArgMatches) -> Result<(), Failure> {
    let files = files(given);
    // What images show says nothing about the file; that they are there and are images does.
    let document =
        view::open(&files, OpenOptions { images: ImageLoading::Locate, ..OpenOptions::new(SCENE_READERS) }, &Progress::default())?.document;
    let name = files.first().map(|file| display_name(file)).unwrap_or_default();
    let info = Info::of(&document, name);
    // The program ends here: giving back what was read piece by piece would only take time.
    #[expect(clippy::mem_forget, reason = "nothing in a document does anything when it is dropped but give back memory")]
    std::mem::forget(document);
    if given.get_flag("json") { print_json(&info) } else { print_result(&info.text()) }
}

impl Info {
    fn of(document: &Document, file: String) -> Self {
        let bounds = document.outline(&document.start_state());
        let scene = &document.scene;
        let (format, version, authoring_tool, up_axis, unit_metres) = match document.sources.first().map(|source| &source.kind) {
            Some(SourceKind::Scene(asset)) => {
                let format = asset.format.to_ascii_lowercase();
                (format, asset.version.clone(), asset.authoring_tool.clone(), asset.up_axis.clone(), asset.unit_metres)
            }
            Some(SourceKind::Muscles(file, _)) => ("muscle".to_owned(), String::new(), String::new(), "Y_UP".to_owned(), file.unit_metres),
            None => (String::new(), String::new(), String::new(), String::new(), 1.0),
        };
        Self {
            file,
            format,
            version,
            authoring_tool,
            up_axis,
            unit_metres,
            nodes: scene.graph.iter().filter(|(_, node)| node.kind != NodeKind::Asset).count(),
            joints: scene.graph.iter().filter(|(_, node)| node.kind == NodeKind::Joint).count(),
            meshes: meshes(document),
            clips: document
                .clips
                .iter()
                .map(|clip| ClipInfo {
                    name: i18n::label(clip.label()).into_owned(),
                    start: clip.start,
                    duration: clip.duration(),
                    channels: clip.channels.len(),
                    keyframes: clip.keyframes(),
                })
                .collect(),
            materials: scene.materials.len(),
            images: scene
                .images
                .iter()
                .map(|image| ImageInfo { uri: image.uri.clone(), found: image.path.is_some() || image.archived || image.pixels.is_some() })
                .collect(),
            muscles: muscles(document),
            bounds: (!bounds.is_empty()).then(|| BoundsInfo { min: bounds.min.to_array(), max: bounds.max.to_array() }),
            warnings: document.diagnostics.iter().map(FindingReport::from).collect(),
        }
    }

    fn text(&self) -> String {
        let mut rows = vec![
            (tr!("cli-info-file"), self.file.clone()),
            (tr!("cli-info-format"), format!("{} {}", self.format, self.version).trim_end().to_owned()),
        ];
        if !self.authoring_tool.is_empty() {
            rows.push((tr!("cli-info-tool"), self.authoring_tool.clone()));
        }
        rows.push((tr!("cli-info-axis"), self.up_axis.clone()));
        rows.push((tr!("cli-info-unit"), tr!("cli-info-metres", value = number(self.unit_metres))));
        rows.push((tr!("cli-info-nodes"), tr!("cli-info-nodes-value", nodes = self.nodes, joints = self.joints)));
        for mesh in &self.meshes {
            let mut text = tr!("cli-info-mesh-value", name = mesh.name.clone(), vertices = mesh.vertices, triangles = mesh.triangles);
            if mesh.skinned {
                text.push_str(&tr!("cli-info-mesh-joints", joints = mesh.joints));
            }
            if mesh.morph_targets > 0 {
                text.push_str(&tr!("cli-info-mesh-morphs", targets = mesh.morph_targets));
            }
            rows.push((tr!("cli-info-mesh"), text));
        }
        for clip in &self.clips {
            let value = tr!(
                "cli-info-clip-value",
                name = clip.name.clone(),
                start = decimal(clip.start, 3),
                end = decimal(clip.start + clip.duration, 3),
                channels = clip.channels,
                keys = clip.keyframes
            );
            rows.push((tr!("cli-info-clip"), value));
        }
        rows.push((tr!("cli-info-materials"), self.materials.to_string()));
        for image in &self.images {
            let key = if image.found { "cli-info-image-found" } else { "cli-info-image-missing" };
            rows.push((tr!("cli-info-image"), tr!(key, uri = image.uri.clone())));
        }
        for muscle in &self.muscles {
            let value = tr!(
                "cli-info-muscle-value",
                name = muscle.name.clone(),
                nodes = muscle.nodes,
                length = number(muscle.rest_length),
                volume = number(muscle.volume),
                unit = unit_label(&unit_name(self.unit_metres)).sentence()
            );
            rows.push((tr!("cli-info-muscle"), value));
        }
        if let Some(bounds) = &self.bounds {
            let corner = |corner: [f32; 3]| corner.map(|x| decimal(x.into(), 3)).join(" ");
            rows.push((tr!("cli-info-bounds"), tr!("cli-info-bounds-value", min = corner(bounds.min), max = corner(bounds.max))));
        }
        rows.push((tr!("cli-info-warnings"), self.warnings.len().to_string()));
        table(&rows)
    }
}

/// A number in text: up to six digits after the decimal mark, fewer for large numbers, none that say nothing.
fn number(value: f64) -> String {
    let text = decimal(value, if value.abs() < 1000.0 { 6 } else { 1 });
    if text.contains(['.', ',']) { text.trim_end_matches('0').trim_end_matches(['.', ',']).to_owned() } else { text }
}

/// Labels in a column of their own, repeated ones once.
fn table(rows: &[(String, String)]) -> String {
    let width = rows.iter().map(|(label, _)| label.chars().count()).max().unwrap_or(0);
    let (mut text, mut before) = (String::new(), "");
    for (label, value) in rows {
        let shown = if label == before { "" } else { label };
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{shown:width$}  {}", i18n::shown(value));
        before = label;
    }
    text
}

/// Each mesh with what its instances put on it.
fn meshes(document: &Document) -> Vec<MeshInfo> {
    let scene = &document.scene;
    let mut found: Vec<MeshInfo> = scene
        .meshes
        .iter()
        .map(|mesh| MeshInfo {
            name: i18n::label(mesh.label()).into_owned(),
            vertices: mesh.source_count,
            triangles: mesh.triangles.len(),
            skinned: false,
            joints: 0,
            morph_targets: 0,
            drawn_vertices: mesh.positions.len(),
        })
        .collect();
    let contents = scene.graph.iter().flat_map(|(_, node)| &node.contents);
    for content in contents {
        let Content::Mesh(MeshInstance { mesh: MeshId(mesh), deformers, .. }) = content else { continue };
        let Some(info) = found.get_mut(*mesh as usize) else { continue };
        for deformer in deformers {
            match deformer {
                Deformer::Skin { skin, .. } => {
                    info.skinned = true;
                    info.joints = info.joints.max(scene.skins.get(skin.index()).map_or(0, |skin| skin.joints.len()));
                }
                Deformer::Morph(morph) => {
                    info.morph_targets = info.morph_targets.max(scene.morphs.get(morph.index()).map_or(0, |morph| morph.targets.len()));
                }
            }
        }
    }
    found
}

fn muscles(document: &Document) -> Vec<MuscleInfo> {
    let all = document.rigs().flat_map(|(rig, _)| (0..rig.len()).map(move |index| (rig, index)));
    all.filter_map(|(rig, index)| {
        let profile = rig.profile(index)?;
        Some(MuscleInfo {
            name: i18n::label(rig.label(index)).into_owned(),
            nodes: profile.radii().len(),
            rest_length: profile.rest_length(),
            volume: profile.volume(),
        })
    })
    .collect()
}

//! From the scene, the frame and the display to items: what is drawn, how, and in which order.

use std::sync::{Arc, Weak};

use glam::Vec3;

use super::drawing::{Item, Source};
use super::light::{Gloss, Lights};
use super::renderer::Buffers;
use super::style::{Fill, Layer, Normals, Style, Varying};
use super::texture::{Alpha, Cache, Sampler};
use super::view::View;
use super::{Display, Shading};
use crate::scene::{AlphaSource, Bounds, Frame, Material, MaterialBinding, Mesh, Scene, ShadingModel, Surface, TextureRef};

/// What was found out about meshes, kept from frame to frame.
#[derive(Debug, Default)]
pub(super) struct Collector {
    known: Vec<Facts>,
    /// Items by layer before they are put in order.
    pending: Vec<Item>,
}

/// Facts about one mesh.
#[derive(Debug)]
struct Facts {
    /// Keeps the address from being given to another mesh.
    mesh: Weak<Mesh>,
    /// For each part the mesh vertices it uses: first and one past the last.
    ranges: Vec<(u32, u32)>,
}

impl Collector {
    /// The vertices that each part of a mesh uses.
    fn ranges(&mut self, mesh: &Arc<Mesh>) -> &[(u32, u32)] {
        let known = self.known.iter().position(|facts| std::ptr::eq(facts.mesh.as_ptr(), Arc::as_ptr(mesh)));
        let index = known.unwrap_or_else(|| {
            self.known.retain(|facts| facts.mesh.strong_count() > 0);
            let range = |part: &crate::scene::Part| {
                let triangles = mesh.triangles.get(part.triangles.start as usize..part.triangles.end as usize).unwrap_or(&[]);
                let corners = || triangles.iter().flatten().copied().filter(|v| (*v as usize) < mesh.positions.len());
                (corners().min().unwrap_or(0), corners().max().map_or(0, |v| v + 1))
            };
            self.known.push(Facts { mesh: Arc::downgrade(mesh), ranges: mesh.parts.iter().map(range).collect() });
            self.known.len() - 1
        });
        &self.known[index].ranges
    }

    /// The light of the picture.
    pub(super) fn lights(&self, frame: &Frame, view: &View, display: &Display) -> Lights {
        let position = display.light.filter(|p| p.is_finite()).unwrap_or_else(|| key_light(&frame.bounds, view));
        Lights::new(position, display.ambient, view)
    }
}

/// High on the left of the camera, some way off the bounds.
pub(super) fn key_light(bounds: &Bounds, view: &View) -> Vec3 {
    let radius = if bounds.is_empty() { 1.0 } else { (bounds.diagonal() * 0.5).max(1e-6) };
    bounds.center() + (view.back * 1.9 - view.right * 1.6 + view.up * 2.1) * radius
}

/// `0xRRGGBB` as numbers from 0 to 1.
pub(super) fn rgb(color: u32) -> [f32; 3] {
    [16, 8, 0].map(|shift| (color >> shift & 255) as f32 / 255.0)
}

impl Buffers {
    /// Makes the list of items and numbers their vertices and triangles.
    pub(super) fn collect(&mut self, cache: &mut Cache, scene: &Scene, frame: &Frame, view: &View, display: &Display) {
        let _ = view;
        let mut pending = std::mem::take(&mut self.collector.pending);
        pending.clear();
        for (index, surface) in frame.surfaces.iter().enumerate() {
            let shown = if surface.muscle.is_some() { display.muscle } else { display.mesh };
            if !shown || !surface.visible {
                continue;
            }
            self.surface(&mut pending, cache, scene, frame, display, index as u32, surface);
        }
        self.items.clear();
        for layer in [Layer::Opaque, Layer::Blended, Layer::Overlay] {
            self.items.extend(pending.iter().filter(|item| item.style.layer == layer).cloned());
        }
        let (mut vertices, mut triangles) = (0usize, 0u32);
        let mut fitting = 0;
        for item in &mut self.items {
            let (count, after) = (item.triangles.len() as u32, triangles);
            // Beyond this the numbers do not fit in their 31 bits.
            let Some(end) = after.checked_add(count).filter(|end| *end < super::drawing::CUT) else { break };
            item.triangles = after..end;
            item.vertices = vertices..vertices + item.vertices.len();
            (vertices, triangles) = (item.vertices.end, end);
            fitting += 1;
        }
        self.items.truncate(fitting);
        self.collector.pending = pending;
    }

    #[allow(clippy::too_many_arguments)]
    fn surface(
        &mut self,
        pending: &mut Vec<Item>,
        cache: &mut Cache,
        scene: &Scene,
        frame: &Frame,
        display: &Display,
        index: u32,
        surface: &Surface,
    ) {
        let mesh = &surface.mesh;
        for part in 0..mesh.parts.len() {
            let triangles = mesh.parts[part].triangles.clone();
            if triangles.is_empty() || triangles.end as usize > mesh.triangles.len() {
                continue;
            }
            let binding = surface.materials.get(part).and_then(Option::as_ref);
            let material = binding.and_then(|binding| frame.materials.get(binding.material.index()));
            let style = style(cache, scene, display, surface, material, binding);
            if style.opacity <= 0.0 {
                continue;
            }
            let (first, end) = self.collector.ranges(mesh)[part];
            let expanded = (end.saturating_sub(first)) as usize > triangles.len() * 3;
            let count = if expanded { triangles.len() * 3 } else { end.saturating_sub(first) as usize };
            pending.push(Item {
                cull: display.cull_back_faces && !material.is_some_and(|material| material.double_sided),
                vertices: 0..count,
                first_vertex: first,
                expanded,
                triangles: 0..triangles.len() as u32,
                source: Source::Surface { index, triangles },
                heat: None,
                style,
            });
        }
    }
}

/// How a part of a surface is drawn.
fn style(
    cache: &mut Cache,
    scene: &Scene,
    display: &Display,
    surface: &Surface,
    material: Option<&Material>,
    binding: Option<&MaterialBinding>,
) -> Style {
    let neutral = Material::default();
    let material = material.filter(|_| display.materials).unwrap_or(&neutral);
    let mut style = Style {
        albedo: material.diffuse.color.to_array(),
        opacity: if material.opacity.is_finite() { material.opacity.clamp(0.0, 1.0) } else { 1.0 },
        emission: material.emission.color.to_array(),
        mirrored: surface.mirrored,
        tinted: display.materials && !surface.mesh.colors.is_empty(),
        depth_test: display.depth_test,
        both_sides: !(display.cull_back_faces && !material.double_sided),
        ..Style::default()
    };
    if display.materials {
        let mut sampler = |texture: &TextureRef, alpha: Alpha| {
            let set = binding.map_or(0, |binding| binding.uv_set(texture));
            let pixels = scene.images.get(texture.image.index())?.pixels.as_ref()?;
            surface.mesh.uv_sets.get(set as usize)?;
            Some(Sampler { texture: cache.get(pixels, alpha), wrap: [texture.wrap_s, texture.wrap_t], uv_set: set })
        };
        style.diffuse = material.diffuse.texture.as_ref().and_then(|texture| sampler(texture, Alpha::Solid));
        style.cutout = material
            .opacity_texture
            .as_ref()
            .and_then(|(texture, source): &(TextureRef, AlphaSource)| sampler(texture, Alpha::From(*source)));
        style.glow = material.emission.texture.as_ref().and_then(|texture| sampler(texture, Alpha::Solid));
        let shiny = matches!(material.model, ShadingModel::Phong | ShadingModel::Blinn) && material.specular.color.max_element() > 0.0;
        if shiny {
            style.specular = material.specular.color.to_array();
            style.gloss = Gloss { exponent: material.shininess.clamp(1.0, 1000.0), mirrored: material.model == ShadingModel::Phong };
        }
        style.unlit = material.model == ShadingModel::Constant;
    }
    let textured = style.diffuse.is_some() || style.cutout.is_some() || style.glow.is_some();
    style.layer = if style.opacity < 1.0 || style.cutout.is_some() { Layer::Blended } else { Layer::Opaque };
    style.normals = match (display.shading, display.smooth_normals) {
        (Shading::Flat, _) => Normals::Flat,
        (_, false) => Normals::Face,
        _ => Normals::Smooth,
    };
    (style.fill, style.varying) = match (display.shading, textured) {
        (Shading::Phong, false) => (Fill::Phong, Varying::Geometry),
        (Shading::Phong, true) => (Fill::PhongTextured, Varying::Geometry),
        (_, false) => (Fill::Gouraud, Varying::Color),
        (_, true) => (Fill::Textured, Varying::Light),
    };
    if style.normals != Normals::Smooth {
        style.varying = Varying::Geometry;
    }
    style
}

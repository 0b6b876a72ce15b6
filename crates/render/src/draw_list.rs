//! Builds the list of draw calls from the scene, the frame and the display options, in drawing order.

use std::sync::{Arc, Weak};

use glam::{Affine2, Vec3};
use rustc_hash::FxHashSet;

use super::binning::BandLayout;
use super::debug_lines::LineBuilder;
use super::draw_data::{DrawCall, GeometrySource};
use super::edges::Edge;
use super::light::Specular;
use super::line::{LinePass, LineStyle};
use super::material_state::{Normals, RenderPass, ResolvedMaterial, ShaderKind, VertexOutput};
use super::projection::ViewTransform;
use super::renderer::Buffers;
use super::texture::{Alpha, TextureCache, TextureSampler};
use super::{Display, Shading};
use sinew_scene::{
    AlphaSource, Bounds, Frame, Ghost, Material, MaterialBinding, Mesh, Scene, ShadingModel, Surface, SurfaceGeometry, TextureRef,
    backed_triangles,
};

/// What was found out about meshes, kept from frame to frame.
#[derive(Debug, Default)]
pub(super) struct DrawListBuilder {
    mesh_caches: Vec<MeshCache>,
    /// Items by layer before they are put in order.
    pending: Vec<DrawCall>,
    /// Which triangles of a surface face the camera, while its outline is drawn.
    facing: Vec<bool>,
    /// Opaque parts of shared meshes that are drawn in this frame: one more in the very same place would change no pixel.
    drawn_keys: FxHashSet<DuplicateKey>,
}

/// A part of a mesh in its place, with its materials; mesh and materials by their addresses.
#[derive(Debug, PartialEq, Eq, Hash)]
struct DuplicateKey {
    mesh: usize,
    part: usize,
    materials: usize,
    matrix: [u32; 16],
}

impl DuplicateKey {
    /// `None` for what cannot stand twice in one place, or may look different there.
    fn of(surface: &Surface, part: usize, material: &ResolvedMaterial) -> Option<Self> {
        let SurfaceGeometry::Rigid(matrix) = &surface.geometry else { return None };
        // The scene holds each mesh once, the frame once for each of its surfaces.
        let shared = Arc::strong_count(&surface.mesh) > 2 && surface.ghost.is_none() && surface.muscle.is_none();
        (shared && material.pass == RenderPass::Opaque && material.mark_share == 0.0).then(|| Self {
            mesh: Arc::as_ptr(&surface.mesh) as usize,
            part,
            materials: surface.materials.as_ptr() as usize,
            matrix: matrix.to_cols_array().map(f32::to_bits),
        })
    }
}

/// Facts about one mesh.
#[derive(Debug)]
struct MeshCache {
    /// Keeps the address from being given to another mesh.
    mesh: Weak<Mesh>,
    /// For each part the mesh vertices it uses: first and one past the last.
    ranges: Vec<(u32, u32)>,
    edges: Option<Vec<Edge>>,
    /// See [`DrawCall::backed_triangles`], for the whole mesh; found when it is first drawn.
    backed: Option<Option<Arc<[bool]>>>,
}

impl DrawListBuilder {
    /// The facts about a mesh, found when first asked for: an index in `known`.
    fn mesh_cache(&mut self, mesh: &Arc<Mesh>) -> usize {
        let known = self.mesh_caches.iter().position(|mesh_cache| std::ptr::eq(mesh_cache.mesh.as_ptr(), Arc::as_ptr(mesh)));
        known.unwrap_or_else(|| {
            self.mesh_caches.retain(|mesh_cache| mesh_cache.mesh.strong_count() > 0);
            let range = |part: &sinew_scene::Part| {
                let triangles = mesh.triangles.get(part.triangles.start as usize..part.triangles.end as usize).unwrap_or(&[]);
                let corners = || triangles.iter().flatten().copied().filter(|v| (*v as usize) < mesh.positions.len());
                (corners().min().unwrap_or(0), corners().max().map_or(0, |v| v + 1))
            };
            self.mesh_caches.push(MeshCache {
                mesh: Arc::downgrade(mesh),
                ranges: mesh.parts.iter().map(range).collect(),
                edges: None,
                backed: None,
            });
            self.mesh_caches.len() - 1
        })
    }
}

impl MeshCache {
    /// Which triangles lie on others of the opposite winding; `None` where none does.
    fn backed(&mut self, mesh: &Mesh) -> Option<Arc<[bool]>> {
        let find = || Some(backed_triangles(mesh)).filter(|backed| !backed.is_empty()).map(Arc::from);
        self.backed.get_or_insert_with(find).clone()
    }
}

/// Where the light is: where the display puts it, or its usual place.
pub(super) fn light_position(frame: &Frame, view: &ViewTransform, display: &Display) -> Vec3 {
    display.light.filter(|p| p.is_finite()).unwrap_or_else(|| key_light(&frame.bounds, view))
}

/// High on the left of the camera, some way off the bounds.
fn key_light(bounds: &Bounds, view: &ViewTransform) -> Vec3 {
    let radius = if bounds.is_empty() { 1.0 } else { (bounds.diagonal() * 0.5).max(1e-6) };
    bounds.center() + (view.back * 2.3 - view.right * 1.6 + view.up * 2.1) * radius
}

/// `0xRRGGBB` as numbers from 0 to 1.
pub(super) fn rgb(color: u32) -> [f32; 3] {
    [16, 8, 0].map(|shift| (color >> shift & 255) as f32 / 255.0)
}

impl Buffers {
    /// Makes the list of items and numbers their vertices and triangles.
    pub(super) fn build(
        &mut self,
        cache: &mut TextureCache,
        (scene, frame): (&Scene, &Frame),
        view: &ViewTransform,
        display: &Display,
        without_ghosts: bool,
    ) {
        let mut pending = std::mem::take(&mut self.collector.pending);
        pending.clear();
        self.weight_colors.clear();
        self.collector.drawn_keys.clear();
        for (index, surface) in frame.surfaces.iter().enumerate() {
            if is_shown(display, surface) && !(without_ghosts && surface.ghost.is_some()) {
                self.surface(&mut pending, cache, (scene, frame), view, display, index as u32, surface);
            }
        }
        if display.bones {
            self.bones.bones(scene, frame, display);
            pending.push(DrawCall {
                source: GeometrySource::Bones,
                material: ResolvedMaterial {
                    pass: RenderPass::Overlay,
                    tinted: true,
                    depth_test: display.depth_test,
                    ..ResolvedMaterial::default()
                },
                cull: false,
                vertices: 0..self.bones.positions.len(),
                first_vertex: 0,
                expanded: false,
                triangles: 0..self.bones.triangles.len() as u32,
                backed_triangles: None,
                weight_colors: None,
            });
        }
        self.items.clear();
        for layer in [RenderPass::Opaque, RenderPass::Blended, RenderPass::Overlay] {
            let of_layer = |item: &&DrawCall| item.material.pass == layer && !item.triangles.is_empty();
            self.items.extend(pending.iter().filter(of_layer).cloned());
        }
        let (mut vertices, mut triangles) = (0usize, 0u32);
        let mut fitting = 0;
        for item in &mut self.items {
            let (count, after) = (item.triangles.len() as u32, triangles);
            // Beyond this the numbers do not fit in their 31 bits.
            let Some(end) = after.checked_add(count).filter(|end| *end < super::draw_data::CLIPPED_FLAG) else { break };
            item.triangles = after..end;
            item.vertices = vertices..vertices + item.vertices.len();
            (vertices, triangles) = (item.vertices.end, end);
            fitting += 1;
        }
        self.items.truncate(fitting);
        self.collector.pending = pending;
    }

    /// Makes all lines; those of the ground only where they are not the same as before.
    pub(super) fn add_lines(
        &mut self,
        scene: &Scene,
        frame: &Frame,
        view: &ViewTransform,
        bands: &BandLayout,
        display: &Display,
        light: Vec3,
    ) {
        let mut segments = std::mem::take(&mut self.segments);
        segments.reset(LinePass::Over, bands);
        segments.reset(LinePass::Overlay, bands);
        let mut builder = LineBuilder { view, bands, display, segments: &mut segments };
        if self.ground.is_new() {
            builder.segments.reset(LinePass::Under, bands);
            if display.grid {
                builder.grid(&display.ground.unwrap_or(frame.bounds));
            }
        }
        builder.helpers(frame, light);
        for surface in frame.surfaces.iter().filter(|surface| is_shown(display, surface)) {
            let selected = display.selected == Some(surface.node) && surface.ghost.is_none();
            let wireframe = display.wireframe && surface.ghost.is_none_or(|ghost| ghost.opacity >= 1.0);
            if wireframe || selected {
                let index = self.collector.mesh_cache(&surface.mesh);
                let mesh_cache = &mut self.collector.mesh_caches[index];
                let edges = mesh_cache.edges.get_or_insert_with(|| super::edges::find(&surface.mesh));
                if wireframe {
                    builder.wireframe(surface, edges);
                }
                if selected {
                    builder.outline(surface, edges, display.palette.selected, &mut self.collector.facing);
                }
            }
            // A muscle's own lines are the rings of its nodes, of interest while it is selected.
            if surface.muscle.is_none() || selected {
                let color = match surface.ghost {
                    Some(ghost) => ghost.tint.to_array(),
                    None if selected => rgb(display.palette.selected),
                    None => default_color(frame, display, surface),
                };
                builder.mesh_lines(surface, color);
            }
        }
        if display.bones || display.bone_axes {
            builder.joints(scene, frame);
        }
        builder.selected_bones(scene, frame);
        for mark in &frame.overlay_lines {
            let line_style = builder.line_style(mark.color.to_array(), mark.opacity, mark.width);
            builder.line(mark.from, mark.to, &LineStyle { pass: LinePass::Overlay, ..line_style });
        }
        self.segments = segments;
    }

    #[allow(clippy::too_many_arguments, reason = "parts of the renderer that are borrowed apart from each other")]
    fn surface(
        &mut self,
        pending: &mut Vec<DrawCall>,
        cache: &mut TextureCache,
        (scene, frame): (&Scene, &Frame),
        view: &ViewTransform,
        display: &Display,
        index: u32,
        surface: &Surface,
    ) {
        let mesh = &surface.mesh;
        let weight_colors = display.weights.filter(|_| surface.muscle.is_none() && surface.ghost.is_none()).map(|joint| {
            let from = self.weight_colors.len();
            super::weight_colormap::append_weight_colors(scene, surface, joint, &mut self.weight_colors);
            from
        });
        for part in 0..mesh.parts.len() {
            let triangles = mesh.parts[part].triangles.clone();
            if triangles.is_empty() || triangles.end as usize > mesh.triangles.len() {
                continue;
            }
            let binding = surface.materials.get(part).and_then(Option::as_ref);
            let foreign = surface.ghost.is_some_and(|ghost| !ghost.materials);
            let material = binding.filter(|_| !foreign).and_then(|binding| frame.materials.get(binding.material.index()));
            let mut resolved = resolve_material(cache, scene, display, surface, part, material, binding);
            let is_see_through = is_see_through(display, surface) && resolved.pass == RenderPass::Opaque;
            if is_see_through {
                (resolved.opacity, resolved.pass) = (SEE_THROUGH_OPACITY, RenderPass::Blended);
            }
            let hides = resolved.pass == RenderPass::Opaque && hides_inside(view, surface, display);
            resolved.both_sides &= !hides;
            if resolved.opacity <= 0.0 {
                continue;
            }
            if weight_colors.is_none()
                && let Some(spot) = DuplicateKey::of(surface, part, &resolved)
                && !self.collector.drawn_keys.insert(spot)
            {
                continue;
            }
            let mesh_cache = self.collector.mesh_cache(mesh);
            let mesh_cache = &mut self.collector.mesh_caches[mesh_cache];
            let (first, end) = mesh_cache.ranges[part];
            // A muscle has no second surface, and its mesh is another one with every edit.
            let backed = if surface.muscle.is_none() { mesh_cache.backed(mesh) } else { None };
            let expanded = (end.saturating_sub(first)) as usize > triangles.len() * 3;
            let count = if expanded { triangles.len() * 3 } else { end.saturating_sub(first) as usize };
            pending.push(DrawCall {
                // The far side of a ghost, or of a skin that is seen through, would only cloud the near one.
                cull: hides
                    || ((display.cull_back_faces || is_see_through || surface.ghost.is_some_and(|ghost| ghost.opacity < 1.0))
                        && !mesh.double_sided
                        && !material.is_some_and(|material| material.double_sided)),
                vertices: 0..count,
                first_vertex: first,
                expanded,
                triangles: 0..triangles.len() as u32,
                source: GeometrySource::Surface { index, triangles },
                backed_triangles: backed,
                weight_colors,
                material: resolved,
            });
        }
    }
}

/// Whether a surface is drawn at all.
pub(super) fn is_shown(display: &Display, surface: &Surface) -> bool {
    surface.visible && if surface.muscle.is_some() { display.muscle } else { display.mesh }
}

/// Whether back faces of an opaque surface cannot be seen anyway: it is solid, and all of it lies in front of the camera.
fn hides_inside(view: &ViewTransform, surface: &Surface, display: &Display) -> bool {
    surface.solid.is_some_and(|bounds| display.depth_test && bounds.corners().iter().all(|corner| view.reaches(*corner)))
}

/// How much of a skin that is seen through is seen itself.
const SEE_THROUGH_OPACITY: f32 = 0.38;

/// Whether a surface lets the muscles beneath it be seen.
fn is_see_through(display: &Display, surface: &Surface) -> bool {
    surface.skin && display.see_through && display.muscle && display.weights.is_none() && surface.ghost.is_none()
}

/// The colour of the lines that a mesh brings along: its material's.
fn default_color(frame: &Frame, display: &Display, surface: &Surface) -> [f32; 3] {
    let material = surface.materials.iter().flatten().next().and_then(|binding| frame.materials.get(binding.material.index()));
    let neutral = Material::default();
    material.filter(|_| display.materials).unwrap_or(&neutral).diffuse.color.to_array()
}

/// How a part of a surface is drawn.
#[allow(clippy::too_many_arguments, reason = "parts of the renderer that are borrowed apart from each other")]
fn resolve_material(
    cache: &mut TextureCache,
    scene: &Scene,
    display: &Display,
    surface: &Surface,
    part: usize,
    material: Option<&Material>,
    binding: Option<&MaterialBinding>,
) -> ResolvedMaterial {
    let neutral = Material::default();
    let heated = display.weights.is_some() && surface.muscle.is_none() && surface.ghost.is_none();
    let colored = display.materials && !heated && surface.ghost.is_none_or(|ghost| ghost.materials);
    let tinted = colored && !surface.mesh.colors.is_empty();
    // Colours of vertices stand for a material where none is bound; they multiply white.
    let white = heated || (tinted && material.is_none());
    let material = material.filter(|_| colored).unwrap_or(&neutral);
    let mut resolved = ResolvedMaterial {
        albedo: if white { [1.0; 3] } else { material.diffuse.color.to_array() },
        opacity: if material.opacity.is_finite() { material.opacity.clamp(0.0, 1.0) } else { 1.0 },
        emission: material.emission.color.to_array(),
        mirrored: surface.mirrored,
        tinted: heated || tinted,
        depth_test: display.depth_test,
        both_sides: !display.cull_back_faces || material.double_sided || surface.mesh.double_sided,
        ..ResolvedMaterial::default()
    };
    if colored {
        let mut sampler = |texture: &TextureRef, alpha: Alpha| {
            let set = binding.map_or(0, |binding| binding.uv_set(texture));
            let pixels = scene.images.get(texture.image.index())?.pixels.as_ref()?;
            surface.mesh.uv_sets.get(set as usize)?;
            let wrap = [texture.wrap_s, texture.wrap_t];
            let uv_transform = texture.transform.map(|uv_transform| uv_transform.matrix()).filter(Affine2::is_finite);
            Some(TextureSampler { uv_transform, texture: cache.get(pixels, alpha, wrap), wrap, uv_set: set })
        };
        resolved.diffuse = material.diffuse.texture.as_ref().and_then(|texture| sampler(texture, Alpha::Solid));
        let cutout = |(texture, source): &(TextureRef, AlphaSource)| sampler(texture, Alpha::From(*source));
        resolved.cutout = material.opacity_texture.as_ref().and_then(cutout);
        resolved.cutout_share =
            if material.opacity_texture_share.is_finite() { material.opacity_texture_share.clamp(0.0, 1.0) } else { 1.0 };
        resolved.emission_texture = material.emission.texture.as_ref().and_then(|texture| sampler(texture, Alpha::Solid));
        let shiny = matches!(material.model, ShadingModel::Phong | ShadingModel::Blinn) && material.specular.color.max_element() > 0.0;
        if shiny {
            resolved.specular = material.specular.color.clamp(Vec3::ZERO, Vec3::ONE).to_array();
            resolved.highlight =
                Specular { exponent: material.shininess.clamp(1.0, 1000.0), mirrored: material.model == ShadingModel::Phong };
        }
        resolved.unlit = material.model == ShadingModel::Constant;
        if resolved.unlit && resolved.emission.iter().any(|e| *e > 0.0) {
            resolved.albedo = [0.0; 3];
        }
        if surface.muscle.is_some() {
            apply_muscle_material(&mut resolved, cache, display, surface, part, material, &neutral);
        }
    }
    match surface.ghost {
        Some(ghost) => apply_ghost(&mut resolved, &ghost),
        None => apply_selection(&mut resolved, display, surface),
    }
    let textured = resolved.diffuse.is_some() || resolved.cutout.is_some() || resolved.emission_texture.is_some();
    resolved.pass = if resolved.opacity < 1.0 || resolved.cutout.is_some() { RenderPass::Blended } else { RenderPass::Opaque };
    resolved.normals = match (display.shading, display.smooth_normals) {
        (Shading::Flat, _) => Normals::Flat,
        (_, false) => Normals::Face,
        _ => Normals::Smooth,
    };
    (resolved.shader, resolved.vertex_output) = match (display.shading, textured) {
        (Shading::Phong, false) => (ShaderKind::Phong, VertexOutput::Geometry),
        (Shading::Phong, true) => (ShaderKind::PhongTextured, VertexOutput::Geometry),
        (_, false) => (ShaderKind::Gouraud, VertexOutput::Color),
        (_, true) => (ShaderKind::Textured, VertexOutput::Light),
    };
    if resolved.normals != Normals::Smooth {
        resolved.vertex_output = VertexOutput::Geometry;
    }
    resolved
}

/// Replaces a muscle's plain colour by the fibre texture, with a soft highlight; flat shading has none.
#[allow(clippy::too_many_arguments, reason = "parts of the renderer that are borrowed apart from each other")]
fn apply_muscle_material(
    resolved: &mut ResolvedMaterial,
    cache: &mut TextureCache,
    display: &Display,
    surface: &Surface,
    part: usize,
    material: &Material,
    neutral: &Material,
) {
    let tendon = surface.mesh.parts.get(part).is_some_and(|part| part.symbol == "tendon");
    if std::ptr::eq(material, neutral) {
        // `#B8322E` and, for a tendon, `#E8DFC8`.
        resolved.albedo = rgb(if tendon { 0xE8DFC8 } else { 0xB8322E });
    }
    if resolved.highlight.exponent == 0.0 {
        resolved.specular = [0.28; 3];
        resolved.highlight = Specular { exponent: 26.0, mirrored: false };
    }
    if display.shading == Shading::Flat || surface.mesh.uv_sets.is_empty() || resolved.diffuse.is_some() {
        return;
    }
    let color = resolved.albedo.map(|c| (c.clamp(0.0, 1.0) * 255.0 + 0.5) as u8);
    let texture = cache.muscle(color, !tendon);
    resolved.diffuse = Some(TextureSampler { uv_transform: None, texture, wrap: super::muscle_texture::WRAP, uv_set: 0 });
    // The fibres bring their own colour.
    resolved.albedo = [1.0; 3];
    resolved.tinted = false;
}

/// Applies tint, opacity and depth offset of a secondary pose.
fn apply_ghost(material: &mut ResolvedMaterial, ghost: &Ghost) {
    let within = |share: f32| if share.is_finite() { share.clamp(0.0, 1.0) } else { 1.0 };
    (material.mark, material.mark_share) = (ghost.tint.to_array(), within(ghost.tint_share));
    material.opacity *= within(ghost.opacity);
    material.depth_offset = if ghost.depth_offset.is_finite() { ghost.depth_offset.clamp(0.0, 100.0) } else { 0.0 };
}

/// Tints what is selected or under the pointer.
fn apply_selection(material: &mut ResolvedMaterial, display: &Display, surface: &Surface) {
    let found = if display.selected == Some(surface.node) {
        Some((display.palette.selected, 0.14))
    } else if display.hovered == Some(surface.node) {
        Some((display.palette.hovered, 0.10))
    } else {
        None
    };
    if let Some((color, share)) = found {
        (material.mark, material.mark_share) = (rgb(color), share);
    }
}

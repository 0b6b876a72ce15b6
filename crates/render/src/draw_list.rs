//! Builds the list of draw calls from the scene, the frame and the display options, in drawing order.

use std::sync::Arc;

use glam::{Vec3, Vec4};
use rustc_hash::FxHashSet;

use super::color_source::ColorSource;
use super::draw_data::{CLIPPED_FLAG, DrawCall, FrameData, GeneratedMesh, GeometrySource};
use super::frame_stages::TargetLayout;
use super::light::Lights;
use super::material_state::{RenderPass, ResolvedMaterial};
use super::memory::push;
use super::mesh_cache::MeshCaches;
use super::projection::ViewTransform;
use super::resolve_material::{SurfacePart, resolve_material};
use super::texture::TextureCache;
use super::vertex_arrays::VertexArrays;
use super::{Display, RenderError, RenderJob};
use sinew_scene::{Bounds, Frame, Surface, SurfaceGeometry};

/// What is drawn in a frame, in drawing order, with what it is made from.
#[derive(Debug, Default)]
pub(super) struct DrawList {
    pub draw_calls: Vec<DrawCall>,
    pub bones: GeneratedMesh,
    pub computed_colors: Vec<Vec4>,
    pub meshes: MeshCaches,
    /// Which triangles of a surface face the camera, while its outline is drawn.
    pub facing: Vec<bool>,
    textures: TextureCache,
    /// Draw calls before they are put in order.
    pending: Vec<DrawCall>,
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
        let shared = Arc::strong_count(&surface.mesh) > 2 && surface.ghost.is_none() && !surface.is_fibrous();
        (shared && material.pass == RenderPass::Opaque && material.mark_share == 0.0).then(|| Self {
            mesh: Arc::as_ptr(&surface.mesh) as usize,
            part,
            materials: surface.materials.as_ptr() as usize,
            matrix: matrix.to_cols_array().map(f32::to_bits),
        })
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

impl DrawList {
    /// Makes the list of the triangles that are to be drawn, or with `picking` that can be picked.
    pub(super) fn build(
        &mut self,
        job: &RenderJob<'_>,
        layout: &TargetLayout,
        picking: bool,
    ) -> Result<(ViewTransform, Lights), RenderError> {
        let view = ViewTransform::new(job.camera, layout.width, layout.height);
        // Without a camera nothing is drawn but the background.
        let seen = view.is_some();
        let view = view.unwrap_or_else(ViewTransform::degenerate);
        let position = light_position(job.frame, &view, job.display);
        self.draw_calls.clear();
        if seen {
            self.textures.begin();
            self.collect(job, &view, picking)?;
            self.number();
        }
        Ok((view, Lights::new(position, job.display.ambient, &view)))
    }

    /// What the stages after the vertex stage read.
    pub(super) fn frame_data<'a>(
        &'a self,
        vertices: &'a VertexArrays,
        frame: &'a Frame,
        view: ViewTransform,
        lights: Lights,
    ) -> FrameData<'a> {
        FrameData {
            view,
            lights,
            frame,
            bones: &self.bones,
            draw_calls: &self.draw_calls,
            textures: self.textures.textures(),
            computed_colors: &self.computed_colors,
            screen: &vertices.screen,
            front: &vertices.front,
            back: &vertices.back,
        }
    }

    /// Makes the list of draw calls, by pass.
    fn collect(&mut self, job: &RenderJob<'_>, view: &ViewTransform, without_ghosts: bool) -> Result<(), RenderError> {
        let RenderJob { scene, frame, display, .. } = *job;
        self.pending.clear();
        self.computed_colors.clear();
        self.drawn_keys.clear();
        for (index, surface) in frame.surfaces.iter().enumerate() {
            if is_shown(display, surface) && !(without_ghosts && surface.ghost.is_some()) {
                self.surface(job, view, index as u32, surface)?;
            }
        }
        if display.bones {
            self.bones.bones(scene, frame, display)?;
            let bones = DrawCall {
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
                computed_colors: None,
            };
            push(&mut self.pending, bones)?;
        }
        self.draw_calls.try_reserve(self.pending.len())?;
        for layer in [RenderPass::Opaque, RenderPass::Blended, RenderPass::Overlay] {
            let of_layer = |item: &&DrawCall| item.material.pass == layer && !item.triangles.is_empty();
            self.draw_calls.extend(self.pending.iter().filter(of_layer).cloned());
        }
        Ok(())
    }

    /// Numbers the vertices and triangles of the draw calls through the picture.
    fn number(&mut self) {
        let (mut vertices, mut triangles) = (0usize, 0u32);
        let mut fitting = 0;
        for item in &mut self.draw_calls {
            let (count, after) = (item.triangles.len() as u32, triangles);
            // Beyond this the numbers do not fit in their 31 bits.
            let Some(end) = after.checked_add(count).filter(|end| *end < CLIPPED_FLAG) else { break };
            item.triangles = after..end;
            item.vertices = vertices..vertices + item.vertices.len();
            (vertices, triangles) = (item.vertices.end, end);
            fitting += 1;
        }
        self.draw_calls.truncate(fitting);
    }

    /// Makes the draw calls of a surface, one a part.
    fn surface(&mut self, job: &RenderJob<'_>, view: &ViewTransform, index: u32, surface: &Surface) -> Result<(), RenderError> {
        let RenderJob { scene, frame, display, .. } = *job;
        let mesh = &surface.mesh;
        let source = ColorSource::of(display, surface);
        let computed_colors = source.append_vertex_colors(scene, surface, &mut self.computed_colors)?;
        for part in 0..mesh.parts.len() {
            let triangles = mesh.parts[part].triangles.clone();
            if triangles.is_empty() || triangles.end as usize > mesh.triangles.len() {
                continue;
            }
            let binding = surface.materials.get(part).and_then(Option::as_ref);
            let foreign = surface.ghost.is_some_and(|ghost| !ghost.materials);
            let material = binding.filter(|_| !foreign).and_then(|binding| frame.materials.get(binding.material.index()));
            let mut resolved =
                resolve_material(&mut self.textures, &SurfacePart { scene, display, surface, source, part, material, binding })?;
            let is_see_through = is_see_through(display, surface, source) && resolved.pass == RenderPass::Opaque;
            if is_see_through {
                (resolved.opacity, resolved.pass) = (SEE_THROUGH_OPACITY, RenderPass::Blended);
            }
            let hides = resolved.pass == RenderPass::Opaque && hides_inside(view, surface, display);
            resolved.both_sides &= !hides;
            if resolved.opacity <= 0.0 {
                continue;
            }
            if computed_colors.is_none()
                && let Some(spot) = DuplicateKey::of(surface, part, &resolved)
            {
                self.drawn_keys.try_reserve(1)?;
                if !self.drawn_keys.insert(spot) {
                    continue;
                }
            }
            let mesh_cache = self.meshes.of(mesh)?;
            let (first, end) = mesh_cache.ranges[part];
            // A surface of fibres has no second one on its back, and while it is edited its mesh is another one in each frame.
            let backed = if surface.is_fibrous() { None } else { mesh_cache.backed(mesh)? };
            let expanded = (end.saturating_sub(first)) as usize > triangles.len() * 3;
            let count = if expanded { triangles.len() * 3 } else { end.saturating_sub(first) as usize };
            let draw_call = DrawCall {
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
                computed_colors,
                material: resolved,
            };
            push(&mut self.pending, draw_call)?;
        }
        Ok(())
    }
}

/// Whether a surface is drawn at all.
pub(super) fn is_shown(display: &Display, surface: &Surface) -> bool {
    surface.visible && if surface.is_fibrous() { display.muscle } else { display.mesh }
}

/// Whether back faces of an opaque surface cannot be seen anyway: it is solid, and all of it lies in front of the camera.
fn hides_inside(view: &ViewTransform, surface: &Surface, display: &Display) -> bool {
    surface.solid.is_some_and(|bounds| display.depth_test && bounds.corners().iter().all(|corner| view.reaches(*corner)))
}

/// How much of a skin that is seen through is seen itself.
const SEE_THROUGH_OPACITY: f32 = 0.38;

/// Whether a surface lets the fibres beneath it be seen.
fn is_see_through(display: &Display, surface: &Surface, source: ColorSource) -> bool {
    surface.skin && display.see_through && display.muscle && source.allows_see_through() && surface.ghost.is_none()
}

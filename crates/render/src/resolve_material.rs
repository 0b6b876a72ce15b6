//! What a part of a surface is drawn with: material, display options and surface together.

use glam::{Affine2, Vec3};

use super::color_source::ColorSource;
use super::draw_list::rgb;
use super::fiber_texture::WRAP;
use super::light::Specular;
use super::material_state::{Normals, RenderPass, ResolvedMaterial, ShaderKind, VertexOutput};
use super::texture::{Alpha, TextureCache, TextureSampler};
use super::{Display, RenderError, Shading};
use sinew_scene::{Fibers, Ghost, Material, MaterialBinding, Scene, ShadingModel, Surface, TextureRef};

/// One part of a surface, and what decides how it looks.
#[derive(Clone, Copy)]
pub(super) struct SurfacePart<'a> {
    pub scene: &'a Scene,
    pub display: &'a Display,
    pub surface: &'a Surface,
    /// Where its colours come from.
    pub source: ColorSource,
    /// Index in the parts of its mesh.
    pub part: usize,
    /// Its material at this moment, if it has one.
    pub material: Option<&'a Material>,
    pub binding: Option<&'a MaterialBinding>,
}

/// How a part of a surface is drawn.
pub(super) fn resolve_material(cache: &mut TextureCache, part: &SurfacePart<'_>) -> Result<ResolvedMaterial, RenderError> {
    let SurfacePart { scene, display, surface, source, material, binding, .. } = *part;
    let neutral = Material::default();
    let computed = source.replaces_vertex_colors();
    let colored = source == ColorSource::Materials;
    let tinted = colored && !surface.mesh.colors.is_empty();
    // Colours of vertices stand for a material where none is bound; they multiply white.
    let white = computed || (tinted && material.is_none());
    let material = material.filter(|_| colored).unwrap_or(&neutral);
    let mut resolved = ResolvedMaterial {
        albedo: if white { [1.0; 3] } else { material.diffuse.color.to_array() },
        opacity: if material.opacity.is_finite() { material.opacity.clamp(0.0, 1.0) } else { 1.0 },
        emission: material.emission.color.to_array(),
        mirrored: surface.mirrored,
        tinted: computed || tinted,
        depth_test: display.depth_test,
        both_sides: !display.cull_back_faces || material.double_sided || surface.mesh.double_sided,
        ..ResolvedMaterial::default()
    };
    if colored {
        let mut sampler = |texture: Option<&TextureRef>, alpha: Alpha| {
            let Some(texture) = texture else { return Ok(None) };
            let set = binding.map_or(0, |binding| binding.uv_set(texture));
            let image = scene.images.get(texture.image.index()).and_then(|image| image.pixels.as_ref());
            let (Some(pixels), Some(_)) = (image, surface.mesh.uv_sets.get(set as usize)) else { return Ok(None) };
            let wrap = [texture.wrap_s, texture.wrap_t];
            let uv_transform = texture.transform.map(|uv_transform| uv_transform.matrix()).filter(Affine2::is_finite);
            Ok::<_, RenderError>(Some(TextureSampler { uv_transform, texture: cache.get(pixels, alpha, wrap)?, wrap, uv_set: set }))
        };
        resolved.diffuse = sampler(material.diffuse.texture.as_ref(), Alpha::Solid)?;
        if let Some((texture, source)) = &material.opacity_texture {
            resolved.cutout = sampler(Some(texture), Alpha::From(*source))?;
        }
        resolved.cutout_share =
            if material.opacity_texture_share.is_finite() { material.opacity_texture_share.clamp(0.0, 1.0) } else { 1.0 };
        resolved.emission_texture = sampler(material.emission.texture.as_ref(), Alpha::Solid)?;
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
        if let Some(fibers) = surface.fibers.get(part.part) {
            apply_fibers(&mut resolved, cache, part, fibers, std::ptr::eq(material, &neutral))?;
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
    Ok(resolved)
}

/// Replaces a plain colour by the fibre texture, with a soft highlight; flat shading has none. `bare` says that no material is bound.
fn apply_fibers(
    resolved: &mut ResolvedMaterial,
    cache: &mut TextureCache,
    part: &SurfacePart<'_>,
    fibers: &Fibers,
    bare: bool,
) -> Result<(), RenderError> {
    if bare {
        resolved.albedo = rgb(fibers.color);
    }
    if resolved.highlight.exponent == 0.0 {
        resolved.specular = [0.28; 3];
        resolved.highlight = Specular { exponent: 26.0, mirrored: false };
    }
    if part.display.shading == Shading::Flat || part.surface.mesh.uv_sets.is_empty() || resolved.diffuse.is_some() {
        return Ok(());
    }
    let color = resolved.albedo.map(|c| (c.clamp(0.0, 1.0) * 255.0 + 0.5) as u8);
    let texture = cache.fibers(color, fibers.ends)?;
    resolved.diffuse = Some(TextureSampler { uv_transform: None, texture, wrap: WRAP, uv_set: 0 });
    // The fibres bring their own colour.
    resolved.albedo = [1.0; 3];
    resolved.tinted = false;
    Ok(())
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
    let found = if display.highlight.selected == Some(surface.node) {
        Some((display.palette.selected, 0.14))
    } else if display.highlight.hovered == Some(surface.node) {
        Some((display.palette.hovered, 0.10))
    } else {
        None
    };
    if let Some((color, share)) = found {
        (material.mark, material.mark_share) = (rgb(color), share);
    }
}

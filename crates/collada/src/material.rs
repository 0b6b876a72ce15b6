//! `library_materials`: materials made from effects, and their opacity.

use roxmltree::NodeId;
use rustc_hash::FxHashMap;

use super::context::{Context, ReadResult, child, children, id_of, name_of, text_of};
use super::effect::Effect;
use super::image::Images;
use super::{El, Finding, asset};
use sinew_scene::animation::MaterialSlot;
use sinew_scene::{AlphaSource, Material, MaterialId, Paint, Scene, ShadingModel};

/// What a material takes, roughly, for the budget.
const MATERIAL_BYTES: usize = 640;

/// A material that an effect made, for animation.
pub(super) struct Made<'a> {
    /// The material.
    pub material: MaterialId,
    /// Its effect's common profile.
    pub effect: Effect<'a>,
    /// What the file's transparency sets.
    pub opacity: Opacity,
}

/// What the file's transparency sets in a material.
#[derive(Debug, Clone, Copy)]
pub(super) struct Opacity {
    /// Opacity, or the share of its texture.
    pub slot: MaterialSlot,
    /// The value as a line over transparency: at 0, and what 1 adds.
    pub line: (f64, f64),
}

impl Opacity {
    fn line(start: f64, slope: f64) -> Self {
        Self { slot: MaterialSlot::Opacity, line: (start, slope) }
    }
}

/// The materials that were read.
#[derive(Default)]
pub(super) struct Materials<'a> {
    by_element: FxHashMap<NodeId, MaterialId>,
    /// What each effect made.
    by_effect: FxHashMap<NodeId, Vec<Made<'a>>>,
}

impl<'a> Materials<'a> {
    /// Reads all materials of the libraries.
    ///
    /// # Errors
    /// Where commas separate their numbers.
    pub(super) fn read(context: &mut Context<'a>, scene: &mut Scene, images: &mut Images) -> ReadResult<Self> {
        let mut materials = Self::default();
        for library in context.libraries("library_materials") {
            for element in children(library, "material") {
                if !context.spend(element, MATERIAL_BYTES) {
                    return Ok(materials);
                }
                materials.add(context, scene, images, element)?;
            }
        }
        Ok(materials)
    }

    /// The material of a `material` element.
    pub(super) fn of(&self, element: El<'_>) -> Option<MaterialId> {
        self.by_element.get(&element.id()).copied()
    }

    /// The materials that an `effect` element made.
    pub(super) fn made_by(&self, effect: El<'_>) -> &[Made<'a>] {
        self.by_effect.get(&effect.id()).map_or(&[], Vec::as_slice)
    }

    fn add(&mut self, context: &mut Context<'a>, scene: &mut Scene, images: &mut Images, element: El<'a>) -> ReadResult<()> {
        let id = MaterialId(scene.materials.len() as u32);
        self.by_element.insert(element.id(), id);
        let mut material = Material { name: name_of(element), id: id_of(element), ..Material::default() };
        let effect = child(element, "instance_effect").and_then(|instance| {
            let effect = context.follow(instance, "url", &["effect"])?;
            // Many materials may name one long effect.
            context.spend(instance, effect.range().len()).then_some(())?;
            let common = Effect::find(context, effect, instance)?;
            Some((effect, common))
        });
        if let Some((element_of_effect, effect)) = effect {
            material.double_sided = is_double_sided(element_of_effect) || is_double_sided(element);
            let opacity = shade(context, scene, images, &effect, &mut material)?;
            self.by_effect.entry(element_of_effect.id()).or_default().push(Made { material: id, effect, opacity });
        }
        scene.materials.push(material);
        Ok(())
    }
}

/// Fills a material from an effect; returns what its transparency sets.
fn shade<'a>(
    context: &mut Context<'a>,
    scene: &mut Scene,
    images: &mut Images,
    effect: &Effect<'a>,
    material: &mut Material,
) -> ReadResult<Opacity> {
    material.model = effect.model;
    let linear = asset::is_scene_linear(effect.shader);
    let mut paint = |tag| -> ReadResult<Option<Paint>> {
        let paint = effect.paint(context, scene, images, tag)?.map(|(paint, _)| paint);
        Ok(paint.map(|paint| Paint { color: if linear { paint.color.map(encoded) } else { paint.color }, ..paint }))
    };
    let emission = paint("emission")?;
    material.diffuse = match paint("diffuse")? {
        Some(diffuse) => diffuse,
        // A formula that only names a glow has no diffuse part; one that names nothing gets the neutral colour.
        None if effect.model == ShadingModel::Constant || emission.is_some() => Paint::default(),
        None => Material::default().diffuse,
    };
    material.emission = emission.unwrap_or_default();
    material.ambient = paint("ambient")?.unwrap_or_default();
    material.specular = paint("specular")?.unwrap_or_default();
    if let Some(shininess) = effect.number(context, "shininess")? {
        material.shininess = shininess.clamp(0.0, 1000.0);
    }
    opacity(context, scene, images, effect, material)
}

/// Opacity after the opaque mode of `transparent` (COLLADA 1.5.0, "Determining Transparency (Opacity) in COLLADA"):
/// A_ONE `a·t`, A_ZERO `1 − a·t`, RGB_ONE `luminance·t`, RGB_ZERO `1 − luminance·t`; without the attribute A_ONE.
///
/// Several exporters (ColladaMaya, FCollada, early SketchUp) write a transparency of 0 for a solid material while their mode asks for 1. A material
/// that would not be seen at all is therefore taken to be written the wrong way round.
fn opacity<'a>(
    context: &mut Context<'a>,
    scene: &mut Scene,
    images: &mut Images,
    effect: &Effect<'a>,
    material: &mut Material,
) -> ReadResult<Opacity> {
    let element = child(effect.shader, "transparent");
    let transparency = effect.number(context, "transparency")?;
    if element.is_none() && transparency.is_none() {
        return Ok(Opacity::line(1.0, 0.0));
    }
    let amount = transparency.unwrap_or(1.0).clamp(0.0, 1.0);
    let mode = element.and_then(|element| element.attribute("opaque")).unwrap_or("A_ONE");
    let (paint, alpha) = effect.paint(context, scene, images, "transparent")?.unwrap_or_else(|| (Paint::color(1.0, 1.0, 1.0), 1.0));
    let by_alpha = !mode.starts_with("RGB");
    let inverse = mode.ends_with("ZERO");
    if let Some(texture) = paint.texture {
        let source = match (by_alpha, inverse) {
            (true, false) => AlphaSource::Alpha,
            (true, true) => AlphaSource::InverseAlpha,
            (false, false) => AlphaSource::Luminance,
            (false, true) => AlphaSource::InverseLuminance,
        };
        material.opacity_texture = Some((texture, source));
        // A_ZERO is 1 − a·t, which is 1 − t + t·(1 − a): transparency weighs the texture. The other modes multiply the two.
        if inverse {
            material.opacity_texture_share = amount;
            return Ok(Opacity { slot: MaterialSlot::OpacityTextureShare, line: (0.0, 1.0) });
        }
        if amount == 0.0 {
            material.opacity = 1.0;
            context.report.report(element.unwrap_or(effect.shader), Finding::TransparencyInverted);
            return Ok(Opacity::line(1.0, -1.0));
        }
        material.opacity = amount;
        return Ok(Opacity::line(0.0, 1.0));
    }
    let color = paint.color;
    let luminance = 0.212_671 * color.x + 0.715_160 * color.y + 0.072_169 * color.z;
    let share = if by_alpha { alpha } else { luminance }.clamp(0.0, 1.0);
    let line = if inverse { (1.0, -f64::from(share)) } else { (0.0, f64::from(share)) };
    let opacity = (line.0 + line.1 * f64::from(amount)).clamp(0.0, 1.0) as f32;
    if opacity < 1.0 / 512.0 {
        context.report.report(element.unwrap_or(effect.shader), Finding::TransparencyInverted);
        material.opacity = 1.0;
        // An animation of it is read the other way round as well.
        return Ok(if inverse { Opacity::line(0.0, 1.0) } else { Opacity::line(1.0, -1.0) });
    }
    material.opacity = opacity;
    Ok(Opacity::line(line.0, line.1))
}

/// A scene-linear value as sRGB (IEC 61966-2-1).
pub(super) fn encoded(value: f32) -> f32 {
    if value <= 0.003_130_8 { value.max(0.0) * 12.92 } else { 1.055 * value.powf(1.0 / 2.4) - 0.055 }
}

/// The hint that several exporters put into `extra`.
pub(super) fn is_double_sided(element: El<'_>) -> bool {
    element
        .descendants()
        .filter(|hint| hint.tag_name().name() == "double_sided")
        .any(|hint| matches!(text_of(hint).trim(), "1" | "true" | "TRUE"))
}

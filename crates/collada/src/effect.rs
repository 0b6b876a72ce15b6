//! `library_effects`: the common profile, its parameters, colours and textures.

use std::collections::HashMap;

use glam::{Vec2, Vec3, Vec4};

use super::context::{Context, ReadResult, child, children, text_of};
use super::image::Images;
use super::{El, Finding};
use sinew_scene::{Paint, Scene, ShadingModel, TextureRef, TextureTransform, WrapMode};

/// The parameters that hold in one effect, by sid: an element with the value inside.
pub(super) type Params<'a> = HashMap<&'a str, El<'a>>;

/// An effect's common profile.
pub(super) struct Effect<'a> {
    /// The element of the lighting formula, such as `phong`.
    pub shader: El<'a>,
    /// The formula.
    pub model: ShadingModel,
    /// Its parameters.
    pub params: Params<'a>,
}

impl<'a> Effect<'a> {
    /// The common profile of `effect` with what `instance` sets; `None`, reported, where there is none.
    pub(super) fn find(context: &mut Context<'a>, effect: El<'a>, instance: El<'a>) -> Option<Self> {
        let profile = child(effect, "profile_COMMON");
        let technique = profile.and_then(|profile| child(profile, "technique"));
        let shader = technique.and_then(|technique| {
            technique.children().find_map(|shader| {
                let model = match shader.tag_name().name() {
                    "constant" => ShadingModel::Constant,
                    "lambert" => ShadingModel::Lambert,
                    "phong" => ShadingModel::Phong,
                    "blinn" => ShadingModel::Blinn,
                    _ => return None,
                };
                Some((shader, model))
            })
        });
        let Some((shader, model)) = shader else {
            context.report.report(effect, Finding::NoCommonProfile);
            return None;
        };
        let mut params = Params::new();
        for scope in [Some(effect), profile, technique].into_iter().flatten() {
            params.extend(children(scope, "newparam").filter_map(|param| Some((param.attribute("sid")?, param))));
        }
        params.extend(children(instance, "setparam").filter_map(|param| Some((param.attribute("ref")?, param))));
        Some(Self { shader, model, params })
    }

    /// A colour or texture with its alpha; `None` where the shader has no such child.
    ///
    /// # Errors
    /// Where commas separate its numbers.
    pub(super) fn paint(
        &self,
        context: &mut Context<'a>,
        scene: &mut Scene,
        images: &mut Images,
        tag: &str,
    ) -> ReadResult<Option<(Paint, f32)>> {
        let Some(slot) = child(self.shader, tag) else { return Ok(None) };
        if let Some(texture) = child(slot, "texture") {
            let Some(texture) = self.texture(context, scene, images, texture)? else { return Ok(None) };
            return Ok(Some((Paint { color: Vec3::ONE, texture: Some(texture) }, 1.0)));
        }
        let value = child(slot, "color").or_else(|| self.param(slot));
        let Some(value) = value else { return Ok(None) };
        let numbers: Vec<f32> = context.reals(value, 4)?;
        let mut color = Vec4::new(0.0, 0.0, 0.0, 1.0);
        context.finite(value, numbers.iter().all(|number| number.is_finite()));
        for (channel, number) in color.as_mut().iter_mut().zip(numbers) {
            *channel = if number.is_finite() { number } else { 0.0 };
        }
        Ok(Some((Paint { color: color.truncate(), texture: None }, color.w)))
    }

    /// A number; `None` where the shader has none.
    ///
    /// # Errors
    /// Where commas separate numbers in it.
    pub(super) fn number(&self, context: &mut Context<'a>, tag: &str) -> ReadResult<Option<f32>> {
        let Some(slot) = child(self.shader, tag) else { return Ok(None) };
        let Some(value) = child(slot, "float").or_else(|| self.param(slot)) else { return Ok(None) };
        let number = context.reals::<f32>(value, 1)?.first().copied();
        Ok(number.filter(|number| context.finite(value, number.is_finite())))
    }

    /// The element with the numbers of the parameter that `slot` refers to.
    fn param(&self, slot: El<'a>) -> Option<El<'a>> {
        let mut param = *self.params.get(child(slot, "param")?.attribute("ref")?)?;
        // One parameter may stand for another; a handful of steps is plenty.
        for _ in 0..8 {
            let value = param.children().find(|child| child.tag_name().name().starts_with("float"));
            match (value, child(param, "param").and_then(|next| next.attribute("ref"))) {
                (Some(value), _) => return Some(value),
                (None, Some(next)) => param = *self.params.get(next)?,
                (None, None) => return None,
            }
        }
        None
    }

    /// The tag of the shader's child that refers to parameter `sid`.
    pub(super) fn slot_of_param(&self, sid: &str) -> Option<&'a str> {
        let refers = |slot: &El<'a>| child(*slot, "param").is_some_and(|param| param.attribute("ref") == Some(sid));
        self.shader.children().find(refers).map(|slot| slot.tag_name().name())
    }

    fn texture(
        &self,
        context: &mut Context<'a>,
        scene: &mut Scene,
        images: &mut Images,
        texture: El<'a>,
    ) -> ReadResult<Option<TextureRef>> {
        let name = texture.attribute("texture").unwrap_or_default();
        let sampler = self.params.get(name).and_then(|param| sampler_of(*param));
        let image = match sampler {
            Some(sampler) => self.sampled_image(context, scene, images, sampler),
            // Straight to an image: not by the letter, but common.
            None => context.lookup.by_id(texture, name, &["image"]).map(|image| images.place(context, scene, image)),
        };
        let Some(image) = image else {
            context.report.report(texture, Finding::TextureNotFound(super::context::shortened(name)));
            return Ok(None);
        };
        let wrap = |tag| sampler.and_then(|sampler| child(sampler, tag)).map_or(WrapMode::Repeat, |wrap| wrap_mode(&text_of(wrap)));
        let semantic = texture.attribute("texcoord").unwrap_or_default().to_owned();
        let mut used = TextureRef { image, semantic, wrap_s: wrap("wrap_s"), wrap_t: wrap("wrap_t"), transform: None };
        placed(context, texture, &mut used)?;
        Ok(Some(used))
    }

    fn sampled_image(
        &self,
        context: &mut Context<'a>,
        scene: &mut Scene,
        images: &mut Images,
        sampler: El<'a>,
    ) -> Option<sinew_scene::ImageId> {
        // 1.5: the sampler names the image.
        if let Some(instance) = child(sampler, "instance_image") {
            return context.follow(instance, "url", &["image"]).map(|image| images.place(context, scene, image));
        }
        // 1.4: the sampler names a surface, and that the image.
        let source = text_of(child(sampler, "source")?).trim().to_owned();
        let surface = self.params.get(source.as_str()).and_then(|param| child(*param, "surface"));
        let (element, name) = match surface {
            Some(surface) => {
                let from = ["init_from", "init_planar", "init_cube", "init_volume"].iter().find_map(|tag| child(surface, tag))?;
                let all = child(from, "all").and_then(|all| all.attribute("ref"));
                (from, all.map_or_else(|| text_of(from).trim().to_owned(), ToOwned::to_owned))
            }
            None => (sampler, source),
        };
        match context.lookup.by_id(element, name.trim_start_matches('#'), &["image"]) {
            Some(image) => Some(images.place(context, scene, image)),
            // Some exporters put the file name here.
            None if surface.is_some() && name.contains('.') => Some(images.place_uri(context, scene, element, &name)),
            None => None,
        }
    }
}

/// What Maya says of a texture's place in an `extra` of its own: `repeatU`, `offsetU`, `rotateUV`, `wrapU`, `mirrorU` and the same for V.
fn placed<'a>(context: &mut Context<'a>, texture: El<'a>, used: &mut TextureRef) -> ReadResult<()> {
    let mut techniques = children(texture, "extra").flat_map(|extra| children(extra, "technique"));
    let is_maya = |technique: &El<'a>| technique.attribute("profile").is_some_and(|profile| profile.to_ascii_uppercase().contains("MAYA"));
    let Some(technique) = techniques.find(is_maya) else { return Ok(()) };
    let default = TextureTransform::default();
    let mut number = |tag, otherwise: f32| context.number(technique, tag).map(|value| value.map_or(otherwise, |value| value as f32));
    let placing = TextureTransform {
        repeat: Vec2::new(number("repeatU", default.repeat.x)?, number("repeatV", default.repeat.y)?),
        offset: Vec2::new(number("offsetU", default.offset.x)?, number("offsetV", default.offset.y)?),
        rotation: number("rotateUV", default.rotation)?,
    };
    used.transform = (placing != default).then_some(placing);
    let says = |tag| Some(matches!(text_of(child(technique, tag)?).trim().to_ascii_lowercase().as_str(), "1" | "true"));
    for (wrap, wraps, mirrors) in [(&mut used.wrap_s, says("wrapU"), says("mirrorU")), (&mut used.wrap_t, says("wrapV"), says("mirrorV"))] {
        *wrap = match (wraps, mirrors) {
            (Some(false), _) => WrapMode::Border,
            (_, Some(true)) => WrapMode::Mirror,
            (Some(true), _) => WrapMode::Repeat,
            (None, _) => *wrap,
        };
    }
    Ok(())
}

fn sampler_of(param: El<'_>) -> Option<El<'_>> {
    param.children().find(|child| child.tag_name().name().starts_with("sampler"))
}

fn wrap_mode(text: &str) -> WrapMode {
    match text.trim() {
        "MIRROR" | "MIRROR_ONCE" => WrapMode::Mirror,
        "CLAMP" => WrapMode::Clamp,
        "BORDER" | "NONE" => WrapMode::Border,
        _ => WrapMode::Repeat,
    }
}

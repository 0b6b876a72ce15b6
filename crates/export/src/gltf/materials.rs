//! Materials and images: COLLADA's lighting formulas as metallic-roughness materials.

use std::io::Cursor;
use std::sync::Arc;

use glam::{Vec2, Vec3};
use rustc_hash::FxHashMap;
use serde_json::{Value, json};

use super::buffer::{Buffer, Usage};
use super::unsupported_features::UnsupportedFeature;
use sinew_scene::limits;
use sinew_scene::{AlphaSource, Image, Material, MaterialBinding, Paint, Pixels, Scene, ShadingModel, TextureRef, WrapMode};

/// The materials, textures, samplers and images that are written.
#[derive(Debug, Default)]
pub(super) struct GltfMaterials {
    pub materials: Vec<Value>,
    pub textures: Vec<Value>,
    pub samplers: Vec<Value>,
    pub images: Vec<Value>,
    known: FxHashMap<Use, usize>,
    pictures: FxHashMap<ImageKey, Option<usize>>,
    /// The first image that was met with each decoded picture; one file may go by many ids.
    first: FxHashMap<*const Pixels, u32>,
    by_sampler: FxHashMap<(usize, u32, u32), usize>,
    unlit: bool,
    placed: bool,
    unbound: [Option<usize>; 4],
}

/// How a material is used: its number, its sets of texture coordinates, and whether it is seen from both sides.
type Use = (u32, Vec<(String, u32)>, bool);

/// What an image is made from: colours, and opacity from the same or another image.
type ImageKey = (Option<u32>, Option<(u32, u8)>);

impl GltfMaterials {
    /// Whether a material needs `KHR_materials_unlit`.
    pub(super) fn uses_unlit(&self) -> bool {
        self.unlit
    }

    /// Whether a texture needs `KHR_texture_transform`.
    pub(super) fn uses_transform(&self) -> bool {
        self.placed
    }

    /// The number of the material of what has none: white where vertices have colours, else the neutral colour; with `both_sides` it is seen from behind
    /// too.
    pub(super) fn unbound(&mut self, colored: bool, both_sides: bool) -> usize {
        let place = usize::from(colored) * 2 + usize::from(both_sides);
        if let Some(number) = self.unbound[place] {
            return number;
        }
        let tint = if colored { Vec3::ONE } else { linear(Material::default().diffuse.color) };
        let surface = json!({"baseColorFactor": [tint.x, tint.y, tint.z, 1.0], "metallicFactor": 0.0, "roughnessFactor": 1.0});
        self.materials.push(json!({"pbrMetallicRoughness": surface, "doubleSided": both_sides}));
        self.unbound[place] = Some(self.materials.len() - 1);
        self.materials.len() - 1
    }

    /// The number of the material that `binding` means, written if it is not yet; with `both_sides` it is seen from behind too.
    pub(super) fn number(
        &mut self,
        scene: &Scene,
        binding: &MaterialBinding,
        both_sides: bool,
        buffer: &mut Buffer,
        losses: &mut Vec<UnsupportedFeature>,
    ) -> Option<usize> {
        let material = scene.materials.get(binding.material.index())?;
        let key = (binding.material.0, binding.uv_sets.clone(), both_sides);
        if let Some(number) = self.known.get(&key) {
            return Some(*number);
        }
        let mut value = self.describe(scene, material, binding, buffer, losses);
        // Sinew draws both sides of every surface, and COLLADA has no word on it. Where another face lies on the back, that one is seen from there.
        if both_sides {
            value["doubleSided"] = true.into();
        }
        self.materials.push(value);
        self.known.insert(key, self.materials.len() - 1);
        Some(self.materials.len() - 1)
    }

    fn describe(
        &mut self,
        scene: &Scene,
        material: &Material,
        binding: &MaterialBinding,
        buffer: &mut Buffer,
        losses: &mut Vec<UnsupportedFeature>,
    ) -> Value {
        let constant = material.model == ShadingModel::Constant;
        let paint = if constant { &material.emission } else { &material.diffuse };
        let opacity = material.opacity_texture.as_ref();
        let mut surface = json!({"metallicFactor": 0.0, "roughnessFactor": roughness(material)});
        let tint = linear(paint.color);
        surface["baseColorFactor"] = json!([tint.x, tint.y, tint.z, material.opacity.clamp(0.0, 1.0)]);
        if let Some(used) = paint.texture.as_ref().or(opacity.map(|(texture, _)| texture)) {
            let picture =
                (paint.texture.as_ref().map(|texture| texture.image.0), opacity.map(|(texture, source)| (texture.image.0, *source as u8)));
            let texture = self.texture(scene, used, picture, opacity.map(|(_, source)| *source), buffer, losses);
            if let Some(texture) = texture {
                surface["baseColorTexture"] = self.read_at(texture, used, binding);
            }
        }
        let mut value = json!({"name": material.label().plain(), "pbrMetallicRoughness": surface});
        if material.opacity < 1.0 || opacity.is_some() {
            value["alphaMode"] = "BLEND".into();
        }
        if constant {
            self.unlit = true;
            value["extensions"] = json!({"KHR_materials_unlit": {}});
        } else {
            self.emission(scene, &material.emission, binding, &mut value, buffer, losses);
        }
        value
    }

    /// A texture with the coordinates that it is read with.
    fn read_at(&mut self, texture: usize, used: &TextureRef, binding: &MaterialBinding) -> Value {
        let mut value = json!({"index": texture, "texCoord": binding.uv_set(used)});
        if let Some(placing) = used.transform.filter(|placing| placing.matrix().is_finite()) {
            // The format counts from the upper edge, and turns the other way for it: its rotation of the same angle is this one.
            let moved = placing.matrix().transform_point2(Vec2::Y);
            value["extensions"] = json!({"KHR_texture_transform": {
                "offset": [moved.x, 1.0 - moved.y],
                "rotation": placing.rotation.to_radians(),
                "scale": placing.repeat.to_array(),
            }});
            self.placed = true;
        }
        value
    }

    fn emission(
        &mut self,
        scene: &Scene,
        paint: &Paint,
        binding: &MaterialBinding,
        value: &mut Value,
        buffer: &mut Buffer,
        losses: &mut Vec<UnsupportedFeature>,
    ) {
        let light = linear(paint.color);
        if light == Vec3::ZERO {
            return;
        }
        value["emissiveFactor"] = json!(light.to_array());
        if let Some(used) = &paint.texture
            && let Some(texture) = self.texture(scene, used, (Some(used.image.0), None), None, buffer, losses)
        {
            value["emissiveTexture"] = self.read_at(texture, used, binding);
        }
    }

    /// The image that is written for an image: the first one with the same decoded picture.
    fn first_of(&mut self, scene: &Scene, id: u32) -> u32 {
        match scene.images.get(id as usize).and_then(|image| image.pixels.as_ref()) {
            Some(pixels) => *self.first.entry(Arc::as_ptr(pixels)).or_insert(id),
            None => id,
        }
    }

    fn texture(
        &mut self,
        scene: &Scene,
        used: &TextureRef,
        picture: ImageKey,
        opacity: Option<AlphaSource>,
        buffer: &mut Buffer,
        losses: &mut Vec<UnsupportedFeature>,
    ) -> Option<usize> {
        let picture = (picture.0.map(|id| self.first_of(scene, id)), picture.1.map(|(id, source)| (self.first_of(scene, id), source)));
        let image = match self.pictures.get(&picture) {
            Some(known) => *known,
            None => {
                let made = encoded(scene, picture, opacity);
                if made.is_none() {
                    let name = scene.images.get(used.image.index()).map_or_else(String::new, |image| image.uri.clone());
                    losses.push(UnsupportedFeature::Image { name });
                }
                let number = made.map(|(kind, bytes)| {
                    let view = buffer.view(Usage::Other, None, |all| all.extend_from_slice(&bytes));
                    let name = scene.images.get(used.image.index()).map_or_else(String::new, |image| image.label().plain().into_owned());
                    self.images.push(json!({"bufferView": view, "mimeType": kind, "name": name}));
                    self.images.len() - 1
                });
                self.pictures.insert(picture, number);
                number
            }
        }?;
        let (s, t) = (wrap(used.wrap_s), wrap(used.wrap_t));
        Some(*self.by_sampler.entry((image, s, t)).or_insert_with(|| {
            let sampler = json!({"magFilter": 9729, "minFilter": 9987, "wrapS": s, "wrapT": t});
            let sampler = self.samplers.iter().position(|known| *known == sampler).unwrap_or_else(|| {
                self.samplers.push(sampler);
                self.samplers.len() - 1
            });
            self.textures.push(json!({"source": image, "sampler": sampler}));
            self.textures.len() - 1
        }))
    }
}

/// The numbers of the format for wrapping; a border of nothing comes closest as an edge that goes on.
fn wrap(wrap: WrapMode) -> u32 {
    match wrap {
        WrapMode::Repeat => 10497,
        WrapMode::Mirror => 33648,
        WrapMode::Clamp | WrapMode::Border => 33071,
    }
}

/// Roughness whose highlight is as wide as that of a Blinn exponent: `√(2 / (n + 2))` (B. Karis, "Specular BRDF reference", 2013, with α = roughness²).
fn roughness(material: &Material) -> f32 {
    if material.specular.color == Vec3::ZERO && material.specular.texture.is_none() {
        return 1.0;
    }
    (2.0 / (material.shininess.max(0.0) + 2.0)).sqrt().sqrt().clamp(0.05, 1.0)
}

/// Linear light from sRGB (IEC 61966-2-1).
fn linear(color: Vec3) -> Vec3 {
    let part = |c: f32| if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) };
    Vec3::from_array(color.to_array().map(|c| if c.is_finite() { part(c.clamp(0.0, 1.0)) } else { 0.0 }))
}

/// The bytes of an image with their kind; `None` where there is no picture to write.
fn encoded(scene: &Scene, (color, opacity): ImageKey, source: Option<AlphaSource>) -> Option<(&'static str, Vec<u8>)> {
    let image = |number: Option<u32>| scene.images.get(number? as usize);
    let pixels = |number: Option<u32>| image(number).and_then(|image| image.pixels.as_deref());
    match (opacity, source) {
        (Some((mask, _)), Some(source)) => {
            let mask_pixels = pixels(Some(mask))?;
            if source == AlphaSource::Alpha
                && color == Some(mask)
                && let Some(found) = as_it_stands(image(color)?)
            {
                return Some(found);
            }
            png(&masked(pixels(color), mask_pixels, source))
        }
        _ => as_it_stands(image(color)?).or_else(|| png(pixels(color)?)),
    }
}

/// The file itself where it is PNG or JPEG, which every reader knows.
fn as_it_stands(image: &Image) -> Option<(&'static str, Vec<u8>)> {
    let (path, size, _) = (image.path.as_ref()?, image.size?, image.pixels.as_ref()?);
    if std::fs::metadata(path).ok()?.len() > limits::IMAGE_BYTES {
        return None;
    }
    let bytes = std::fs::read(path).ok()?;
    let kind = match bytes.get(..3)? {
        b"\x89PN" => "image/png",
        b"\xff\xd8\xff" => "image/jpeg",
        _ => return None,
    };
    // A picture out of an archive has a path too, which may mean another file here.
    let found = image::ImageReader::new(Cursor::new(&bytes)).with_guessed_format().ok()?.into_dimensions().ok()?;
    (size == <[u32; 2]>::from(found)).then_some((kind, bytes))
}

fn png(pixels: &Pixels) -> Option<(&'static str, Vec<u8>)> {
    let mut bytes = Vec::new();
    let mut encoder = ::png::Encoder::new(&mut bytes, pixels.width, pixels.height);
    encoder.set_color(::png::ColorType::Rgba);
    encoder.set_compression(::png::Compression::Fast);
    encoder.write_header().and_then(|mut writer| writer.write_image_data(&pixels.rgba)).ok()?;
    Some(("image/png", bytes))
}

/// The colours (white without any) with the mask's opacity, as large as the colours, or the mask.
fn masked(color: Option<&Pixels>, mask: &Pixels, source: AlphaSource) -> Pixels {
    let (width, height) = color.map_or((mask.width, mask.height), |color| (color.width, color.height));
    let texel = |pixels: &Pixels, x: u32, y: u32| {
        let at = (y as usize * pixels.width as usize + x as usize) * 4;
        pixels.rgba.get(at..).and_then(|rest| rest.first_chunk::<4>()).copied().unwrap_or([255; 4])
    };
    let scaled = |at: u32, from: u32, to: u32| (u64::from(at) * u64::from(to) / u64::from(from.max(1))) as u32;
    let mut rgba = Vec::with_capacity(width as usize * height as usize * 4);
    for y in 0..height {
        for x in 0..width {
            let [red, green, blue, _] = color.map_or([255; 4], |color| texel(color, x, y));
            let [r, g, b, a] = texel(mask, scaled(x, width, mask.width), scaled(y, height, mask.height)).map(f32::from);
            let luminance = 0.212_671 * r + 0.715_160 * g + 0.072_169 * b;
            let alpha = match source {
                AlphaSource::Alpha => a,
                AlphaSource::InverseAlpha => 255.0 - a,
                AlphaSource::Luminance => luminance,
                AlphaSource::InverseLuminance => 255.0 - luminance,
            };
            rgba.extend_from_slice(&[red, green, blue, alpha.round() as u8]);
        }
    }
    Pixels { width, height, rgba }
}

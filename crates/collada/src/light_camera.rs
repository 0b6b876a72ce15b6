//! `library_lights` and `library_cameras`.

use glam::Vec3;
use roxmltree::NodeId;
use rustc_hash::FxHashMap;

use super::context::{Context, ReadResult, child, id_of, name_of};
use super::{El, Finding};
use sinew_scene::{CameraId, FileCamera, Light, LightId, LightKind, Projection, Scene};

/// The lights and cameras that were read.
#[derive(Default)]
pub(super) struct LightsAndCameras {
    lights: FxHashMap<NodeId, Option<LightId>>,
    cameras: FxHashMap<NodeId, Option<CameraId>>,
}

impl LightsAndCameras {
    /// The light of an element, if it was read.
    pub(super) fn light_of(&self, element: El<'_>) -> Option<LightId> {
        self.lights.get(&element.id()).copied().flatten()
    }

    /// The light of a `light` element, put into the scene the first time.
    ///
    /// # Errors
    /// Where commas separate its numbers.
    pub(super) fn light<'a>(&mut self, context: &mut Context<'a>, scene: &mut Scene, element: El<'a>) -> ReadResult<Option<LightId>> {
        if let Some(known) = self.lights.get(&element.id()) {
            return Ok(*known);
        }
        let light = read_light(context, element)?.map(|light| {
            scene.lights.push(light);
            LightId(scene.lights.len() as u32 - 1)
        });
        self.lights.insert(element.id(), light);
        Ok(light)
    }

    /// The camera of a `camera` element, put into the scene the first time.
    ///
    /// # Errors
    /// Where commas separate its numbers.
    pub(super) fn camera<'a>(&mut self, context: &mut Context<'a>, scene: &mut Scene, element: El<'a>) -> ReadResult<Option<CameraId>> {
        if let Some(known) = self.cameras.get(&element.id()) {
            return Ok(*known);
        }
        let camera = read_camera(context, element)?.map(|camera| {
            scene.cameras.push(camera);
            CameraId(scene.cameras.len() as u32 - 1)
        });
        self.cameras.insert(element.id(), camera);
        Ok(camera)
    }
}

fn read_light<'a>(context: &mut Context<'a>, element: El<'a>) -> ReadResult<Option<Light>> {
    let kinds = ["ambient", "directional", "point", "spot"];
    let technique = child(element, "technique_common");
    let Some(source) = technique.and_then(|technique| technique.children().find(|child| kinds.contains(&child.tag_name().name()))) else {
        context.report.report(element, Finding::BadLight);
        return Ok(None);
    };
    let mut color = Vec3::ONE;
    if let Some(element) = child(source, "color") {
        let values: Vec<f32> = context.reals(element, 3)?;
        for (channel, value) in color.as_mut().iter_mut().zip(values) {
            *channel = if value.is_finite() { value } else { 0.0 };
        }
    }
    let mut number = |tag, otherwise| context.number(source, tag).map(|value| value.unwrap_or(otherwise) as f32);
    let attenuation =
        Vec3::new(number("constant_attenuation", 1.0)?, number("linear_attenuation", 0.0)?, number("quadratic_attenuation", 0.0)?);
    let kind = match source.tag_name().name() {
        "ambient" => LightKind::Ambient,
        "directional" => LightKind::Directional,
        "point" => LightKind::Point,
        _ => LightKind::Spot { falloff_angle: number("falloff_angle", 180.0)?, falloff_exponent: number("falloff_exponent", 0.0)? },
    };
    let name = name_of(element);
    Ok(Some(Light { name, id: id_of(element), kind, color, attenuation }))
}

fn read_camera<'a>(context: &mut Context<'a>, element: El<'a>) -> ReadResult<Option<FileCamera>> {
    let technique = child(element, "optics").and_then(|optics| child(optics, "technique_common"));
    let source = technique
        .and_then(|technique| technique.children().find(|child| matches!(child.tag_name().name(), "perspective" | "orthographic")));
    let Some(source) = source else {
        context.report.report(element, Finding::BadCamera);
        return Ok(None);
    };
    let positive = |value: Option<f64>| value.filter(|value| *value > 0.0);
    let aspect = positive(context.number(source, "aspect_ratio")?);
    let (near, far) = (positive(context.number(source, "znear")?), positive(context.number(source, "zfar")?));
    let name = name_of(element);
    let (projection, aspect) = if source.tag_name().name() == "perspective" {
        let angle = |degrees: Option<f64>| degrees.filter(|degrees| *degrees > 0.0 && *degrees < 180.0).map(f64::to_radians);
        let (x, y) = (angle(context.number(source, "xfov")?), angle(context.number(source, "yfov")?));
        let aspect = aspect.or_else(|| Some((x? / 2.0).tan() / (y? / 2.0).tan()));
        // tan(x/2) = aspect · tan(y/2).
        let from_x = x.map(|x| 2.0 * ((x / 2.0).tan() / aspect.unwrap_or(4.0 / 3.0)).atan());
        let fov_y = y.or(from_x).unwrap_or(45_f64.to_radians()) as f32;
        (Projection::Perspective { fov_y }, aspect)
    } else {
        // The magnifications are half the width and height of the view.
        let (x, y) = (positive(context.number(source, "xmag")?), positive(context.number(source, "ymag")?));
        let aspect = aspect.or_else(|| Some(x? / y?));
        let from_x = x.map(|x| x / aspect.unwrap_or(4.0 / 3.0));
        let height = (2.0 * y.or(from_x).unwrap_or(1.0)) as f32;
        (Projection::Orthographic { height }, aspect)
    };
    Ok(Some(FileCamera {
        name,
        id: id_of(element),
        projection,
        aspect: aspect.map(|aspect| aspect as f32),
        near: near.unwrap_or(0.1) as f32,
        far: far.unwrap_or(1000.0) as f32,
    }))
}

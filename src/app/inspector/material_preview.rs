//! Thumbnail of a material: a lit sphere with its texture or colour.

use gtk::prelude::*;
use gtk::{cairo, gdk};
use gtk4 as gtk;

use crate::app::widgets::drawing_area::{PaintWidget, cairo as cairo_over, set_color};
use crate::scene::{Material, Pixels, Scene, ShadingModel};

/// Side of the picture, logical pixels.
const SIDE: i32 = 32;

/// The picture of a material.
pub(crate) fn of(scene: &Scene, material: &Material) -> PaintWidget {
    let canvas = PaintWidget::new(SIDE, SIDE);
    canvas.set_valign(gtk::Align::Center);
    let [red, green, blue] = material.diffuse.color.to_array();
    let color = gdk::RGBA::new(red, green, blue, 1.0);
    let image = material.diffuse.texture.as_ref().and_then(|texture| scene.images.get(texture.image.index()));
    let unlit = material.model == ShadingModel::Constant;
    let shines = matches!(material.model, ShadingModel::Phong | ShadingModel::Blinn);
    let shine = if shines { f64::from(material.specular.color.max_element().clamp(0.0, 1.0)) } else { 0.0 };
    let small = image.and_then(|image| image.pixels.as_deref()).and_then(shrink);
    canvas.set_painter(move |canvas, snapshot, width, height| {
        let context = cairo_over(snapshot, width, height);
        let (x, y, radius) = (width / 2.0, height / 2.0, width.min(height) / 2.0 - 1.0);
        context.arc(x, y, radius, 0.0, std::f64::consts::TAU);
        match &small {
            Some(surface) => {
                let scale = width / f64::from(surface.width());
                context.scale(scale, scale);
                // Cairo fails only where memory is gone; the swatch stays empty then.
                let _ = context.set_source_surface(surface, 0.0, 0.0);
                let _ = context.fill_preserve();
                context.scale(1.0 / scale, 1.0 / scale);
            }
            None => {
                set_color(&context, &color, 1.0);
                let _ = context.fill_preserve();
            }
        }
        let light = (x - radius * 0.4, y - radius * 0.45);
        if !unlit {
            let shade = cairo::RadialGradient::new(light.0, light.1, radius * 0.2, x, y, radius);
            shade.add_color_stop_rgba(0.0, 0.0, 0.0, 0.0, 0.0);
            shade.add_color_stop_rgba(1.0, 0.0, 0.0, 0.0, 0.55);
            let _ = context.set_source(&shade);
            let _ = context.fill_preserve();
        }
        if shine > 0.0 {
            let spot = cairo::RadialGradient::new(light.0, light.1, 0.0, light.0, light.1, radius * 0.45);
            spot.add_color_stop_rgba(0.0, 1.0, 1.0, 1.0, shine);
            spot.add_color_stop_rgba(1.0, 1.0, 1.0, 1.0, 0.0);
            let _ = context.set_source(&spot);
            let _ = context.fill_preserve();
        }
        set_color(&context, &canvas.text_color(), 0.3);
        context.set_line_width(1.0);
        let _ = context.stroke();
    });
    canvas
}

/// A texture at twice the swatch's side, one texel taken for each pixel.
fn shrink(pixels: &Pixels) -> Option<cairo::ImageSurface> {
    let side = SIDE * 2;
    let mut surface = cairo::ImageSurface::create(cairo::Format::Rgb24, side, side).ok()?;
    let stride = usize::try_from(surface.stride()).ok()?;
    {
        let mut data = surface.data().ok()?;
        for (y, row) in data.chunks_exact_mut(stride).enumerate() {
            for (x, pixel) in row.chunks_exact_mut(4).take(side as usize).enumerate() {
                let at = |place: usize, size: u32| place * size as usize / side as usize;
                let start = (at(y, pixels.height) * pixels.width as usize + at(x, pixels.width)) * 4;
                let [red, green, blue] = *pixels.rgba.get(start..start + 3)? else { return None };
                pixel.copy_from_slice(&u32::from_be_bytes([0, red, green, blue]).to_ne_bytes());
            }
        }
    }
    Some(surface)
}

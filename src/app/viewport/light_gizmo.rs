//! Light gizmo while the light is dragged: a line from the model towards it, and a sun at the edge where it lies outside of the picture.

use glam::{DVec2, Vec2, Vec3};
use gtk::cairo::LineCap;
use gtk4 as gtk;

use super::ignore;
use crate::app::widgets::drawing_area::{cairo, rgb, set_color};
use crate::scene::Camera;
use crate::session::Session;

/// How far from the edges the sun stays, logical pixels.
const MARGIN: f64 = 24.0;
/// The sun's colour, as the renderer's own one.
const SUN: u32 = 0xFF_DB73;

/// Draws it over the picture.
pub(super) fn draw(session: &mut Session, snapshot: &gtk::Snapshot, width: f64, height: f64) {
    let aim = session.light_direction();
    let (_, frame, camera, _) = session.picture();
    let (middle, light) = (frame.bounds.center(), aim.position(&frame.bounds));
    let size = DVec2::new(width, height);
    let Some(from) = place(&camera, middle, size) else { return };
    // What is behind the eye has no place; its direction has.
    let behind = (light - camera.eye).dot(camera.forward()) <= camera.near;
    let to = match place(&camera, light, size).filter(|_| !behind) {
        Some(to) => to,
        None => from + beside(&camera, light - middle) * size.length(),
    };
    let shown = clamped_to(from, to, size);
    let context = cairo(snapshot, width, height);
    context.set_line_cap(LineCap::Round);
    let along = (shown - from).normalize_or_zero();
    let (start, end) = (from + along * 10.0, shown - along * 16.0);
    for (color, line, opacity) in [(0, 3.5, 0.35), (SUN, 1.5, 0.95)] {
        set_color(&context, &rgb(color), opacity);
        context.set_line_width(line);
        if (shown - from).length() > 40.0 {
            // Dashed where the light is on the far side.
            let far = (light - middle).dot(camera.forward()) > 0.0;
            context.set_dash(if far { &[5.0, 5.0] } else { &[] }, 0.0);
            context.move_to(start.x, start.y);
            context.line_to(end.x, end.y);
            ignore(context.stroke());
            context.set_dash(&[], 0.0);
        }
        if shown != to || behind {
            sun(&context, shown, line);
        }
    }
}

/// A dot with eight rays.
fn sun(context: &cairo::Context, at: DVec2, line: f64) {
    context.arc(at.x, at.y, 4.0 + line / 2.0, 0.0, std::f64::consts::TAU);
    ignore(context.fill());
    for ray in 0..8 {
        let (sin, cos) = (f64::from(ray) * std::f64::consts::FRAC_PI_4).sin_cos();
        context.move_to(at.x + cos * 8.5, at.y + sin * 8.5);
        context.line_to(at.x + cos * 12.5, at.y + sin * 12.5);
        ignore(context.stroke());
    }
}

fn place(camera: &Camera, point: Vec3, size: DVec2) -> Option<DVec2> {
    let place = camera.project(point, Vec2::new(size.x as f32, size.y as f32))?;
    Some(place.truncate().as_dvec2()).filter(|place| place.is_finite())
}

/// A direction of the world as it lies in the picture, right and down; straight up where it goes along the line of sight.
fn beside(camera: &Camera, direction: Vec3) -> DVec2 {
    DVec2::new(f64::from(direction.dot(camera.right())), -f64::from(direction.dot(camera.up()))).normalize_or(DVec2::NEG_Y)
}

/// The point of a way from inside the picture that is farthest along and still within its margins.
fn clamped_to(from: DVec2, to: DVec2, size: DVec2) -> DVec2 {
    let (low, high) = (DVec2::splat(MARGIN), (size - MARGIN).max(DVec2::splat(MARGIN)));
    let from = from.clamp(low, high);
    let direction = to - from;
    let part = [(from.x, direction.x, low.x, high.x), (from.y, direction.y, low.y, high.y)].into_iter().fold(
        1.0_f64,
        |part, (at, direction, low, high)| {
            if direction > 0.0 {
                part.min((high - at) / direction)
            } else if direction < 0.0 {
                part.min((low - at) / direction)
            } else {
                part
            }
        },
    );
    from + direction * part.clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sun_outside_the_picture_is_held_at_the_edge_on_its_way() {
        let size = DVec2::new(600.0, 400.0);
        let middle = size / 2.0;
        assert_eq!(clamped_to(middle, DVec2::new(310.0, 120.0), size), DVec2::new(310.0, 120.0));
        assert_eq!(clamped_to(middle, DVec2::new(300.0, -1000.0), size), DVec2::new(300.0, MARGIN));
        let corner = clamped_to(middle, DVec2::new(9000.0, 6000.0), size);
        assert!((corner.x <= 576.0 + 1e-9) && (corner.y <= 376.0 + 1e-9) && (corner.x > 570.0 || corner.y > 370.0), "{corner}");
        // On the line still.
        assert!(((corner - middle).normalize() - DVec2::new(8700.0, 5800.0).normalize()).length() < 1e-9);
        assert!(clamped_to(middle, middle, DVec2::ZERO).is_finite());
    }
}

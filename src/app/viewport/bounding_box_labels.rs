//! Lengths of the bounding box, written at three of its edges.

use glam::{Vec2, Vec3};
use gtk4 as gtk;

use crate::app::format;
use crate::app::widgets::drawing_area::{PaintWidget, rgb, write_with_background};
use crate::render::Background;
use crate::scene::{Bounds, Camera};
use crate::session::Session;
use crate::tr;

/// Significant digits of a length.
const DIGITS: usize = 4;

/// Writes width, height and depth while the box is shown.
pub(super) fn draw(session: &mut Session, canvas: &PaintWidget, snapshot: &gtk::Snapshot, width: f64, height: f64) {
    let (_, frame, camera, display) = session.picture();
    if !display.bounding_box || frame.bounds.is_empty() {
        return;
    }
    let ground = rgb(match display.background {
        Background::Gradient(above, _) => above,
        Background::Solid(color) => color,
        Background::Transparent => display.palette.background.0,
    });
    let size = Vec2::new(width as f32, height as f32);
    let lengths = frame.bounds.size().to_array();
    for (axis, place) in places(&camera, &frame.bounds, size).into_iter().enumerate() {
        let Some(place) = place else { continue };
        let unit = tr!("app-unit-m");
        let length = f64::from(lengths[axis]);
        let text = format!("{} {}\u{2009}{unit}", ["X", "Y", "Z"][axis], format::significant(length, DIGITS));
        let half = text.chars().count() as f64 * 3.0;
        let at = (f64::from(place.x) - half, f64::from(place.y) - 9.0);
        write_with_background(canvas, snapshot, &text, at, 0.85, &rgb(display.palette.axes[axis]), &ground.with_alpha(0.8));
    }
}

/// The middles of the edges that are nearest to the lower edge of the picture, of the upright one to its left edge: there they hide least of what is
/// inside. By axis, logical pixels; `None` where the edge is not in the picture.
fn places(camera: &Camera, bounds: &Bounds, size: Vec2) -> [Option<Vec2>; 3] {
    let corners = bounds.corners();
    let middle = |axis: usize, corner: usize| -> Option<Vec2> {
        let middle: Vec3 = (corners[corner] + corners[corner | 1 << axis]) * 0.5;
        let place = camera.project(middle, size).filter(|place| (0.0..=1.0).contains(&place.z))?.truncate();
        (place.cmpge(Vec2::ZERO).all() && place.cmple(size).all()).then_some(place)
    };
    std::array::from_fn(|axis| {
        let edges = (0..corners.len()).filter(|corner| corner & 1 << axis == 0).filter_map(|corner| middle(axis, corner));
        let outward = |place: &Vec2| if axis == 1 { -place.x } else { place.y };
        edges.max_by(|a, b| outward(a).total_cmp(&outward(b)))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{OrbitCamera, ViewDirection};

    #[test]
    fn lengths_stand_at_edges_of_their_own() {
        let bounds = Bounds { min: Vec3::splat(-0.5), max: Vec3::new(0.5, 1.0, 0.5) };
        let size = Vec2::new(800.0, 600.0);
        let mut orbit = OrbitCamera::default();
        orbit.look_from(ViewDirection::Iso);
        orbit.fit(&bounds, 800.0 / 600.0);
        let places = places(&orbit.camera(), &bounds, size).map(|place| place.expect("in the picture"));
        // Seen from the upper right front: X and Z lie at the bottom, left and right of the near corner, Y at the left.
        let [x, y, z] = places;
        assert!(x.y > 300.0 && z.y > 300.0 && x.x < z.x && y.x < x.x, "{places:?}");
        // A box behind the eye has no edge in the picture.
        let away = Bounds { min: bounds.min + 1e3, max: bounds.max + 1e3 };
        assert!(super::places(&orbit.camera(), &away, size).iter().all(Option::is_none));
    }
}

//! Axis gizmo in the corner of the viewport: the orientation of the world; a click on an end selects that view.

use gtk::cairo::LineCap;
use gtk4 as gtk;

use super::ignore;
use crate::app::widgets::drawing_area::{PaintWidget, cairo, rgb, set_color, write_centered};
use crate::scene::{Camera, ViewDirection};
use crate::session::Session;
use glam::{DVec2, Vec3};

/// Length of an arm, logical pixels.
const ARM: f64 = 27.0;
/// Radius of a named end, and of one that points the other way.
const BALL: f64 = 8.0;
const BUTTON: f64 = 4.5;
/// Distance of the origin from the picture's left and lower edge.
const INSET: f64 = 44.0;

/// The ends: direction, axis, its name where it is the positive one, and the view from there.
const ENDS: [(Vec3, usize, Option<&str>, ViewDirection); 6] = [
    (Vec3::X, 0, Some("X"), ViewDirection::Right),
    (Vec3::Y, 1, Some("Y"), ViewDirection::Top),
    (Vec3::Z, 2, Some("Z"), ViewDirection::Front),
    (Vec3::NEG_X, 0, None, ViewDirection::Left),
    (Vec3::NEG_Y, 1, None, ViewDirection::Bottom),
    (Vec3::NEG_Z, 2, None, ViewDirection::Back),
];

/// Where an end stands, from the origin of the axes.
fn place(camera: &Camera, direction: Vec3) -> DVec2 {
    DVec2::new(f64::from(direction.dot(camera.right())), -f64::from(direction.dot(camera.up()))) * ARM
}

/// How near an end is to the eye.
fn nearness(camera: &Camera, direction: Vec3) -> f32 {
    -direction.dot(camera.forward())
}

/// The view that a click at a place of a picture of this height asks for, logical pixels.
pub(super) fn hit(camera: &Camera, x: f64, y: f64, height: f64) -> Option<ViewDirection> {
    let from = DVec2::new(x - INSET, y - (height - INSET));
    let under = ENDS.iter().filter(|(direction, ..)| (place(camera, *direction) - from).length() <= BALL + 2.0);
    under.max_by(|a, b| nearness(camera, a.0).total_cmp(&nearness(camera, b.0))).map(|end| end.3)
}

/// Draws the axes into the lower left corner, the end under the pointer larger.
pub(super) fn draw(session: &mut Session, canvas: &PaintWidget, snapshot: &gtk::Snapshot, height: f64, pointer: Option<(f64, f64)>) {
    let (_, _, camera, display) = session.picture();
    let lit = pointer.and_then(|(x, y)| hit(&camera, x, y, height));
    let mut ends = ENDS;
    // The one that points away is drawn first.
    ends.sort_by(|a, b| nearness(&camera, a.0).total_cmp(&nearness(&camera, b.0)));
    let origin = DVec2::new(INSET, height - INSET);
    for (direction, axis, name, view) in ends {
        let context = cairo(snapshot, 2.0 * INSET, height);
        context.set_line_cap(LineCap::Round);
        let color = rgb(display.palette.axes[axis]);
        let tip = origin + place(&camera, direction);
        let larger = if lit == Some(view) { 2.0 } else { 0.0 };
        set_color(&context, &color, 1.0);
        if name.is_some() {
            context.set_line_width(2.0);
            context.move_to(origin.x, origin.y);
            context.line_to(tip.x, tip.y);
            ignore(context.stroke());
        }
        let radius = if name.is_some() { BALL } else { BUTTON } + larger;
        set_color(&context, &color, if name.is_some() || larger > 0.0 { 1.0 } else { 0.45 });
        context.arc(tip.x, tip.y, radius, 0.0, std::f64::consts::TAU);
        ignore(context.fill());
        drop(context);
        if let Some(name) = name {
            write_centered(canvas, snapshot, name, (tip.x, tip.y), 0.75, &rgb(0x10_1010));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::OrbitCamera;

    #[test]
    fn each_end_is_hit_where_it_is_drawn() {
        let camera = OrbitCamera::default().camera();
        for (direction, _, _, view) in ENDS {
            let at = DVec2::new(INSET, 500.0 - INSET) + place(&camera, direction);
            assert_eq!(hit(&camera, at.x, at.y, 500.0), Some(view));
        }
        assert_eq!(hit(&camera, 200.0, 100.0, 500.0), None);
    }

    #[test]
    fn of_two_ends_in_one_place_the_nearer_is_hit() {
        let mut orbit = OrbitCamera::default();
        orbit.look_from(ViewDirection::Front);
        assert_eq!(hit(&orbit.camera(), INSET, 500.0 - INSET, 500.0), Some(ViewDirection::Front));
    }
}

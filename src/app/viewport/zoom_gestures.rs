//! Zoom by the wheel, and two-finger pinch and pan.

use std::cell::Cell;
use std::rc::Rc;

use gtk::prelude::*;
use gtk::{gdk, glib};
use gtk4 as gtk;

use super::Viewport;
use crate::app::widgets::drawing_area::PaintWidget;
use crate::scene::OrbitCamera;
use crate::session::CameraController;

/// What one notch of the wheel zooms.
const NOTCH: f64 = 1.12;

/// Two fingers on the picture: how far apart they are against when they came down, and where their middle was last.
#[derive(Default)]
struct PinchState {
    spread: Cell<f64>,
    middle: Cell<Option<(f64, f64)>>,
}

impl PinchState {
    /// The fingers come down.
    fn begin(&self) {
        self.spread.set(1.0);
        self.middle.set(None);
    }

    /// What the picture grows by since the last time; `scale` counts from when the fingers came down.
    fn factor(&self, scale: f64) -> f32 {
        if !(scale.is_finite() && scale > 0.0) {
            return 1.0;
        }
        (scale / self.spread.replace(scale)) as f32
    }

    /// How far the middle went since the last time.
    fn shift(&self, middle: Option<(f64, f64)>) -> (f64, f64) {
        match (self.middle.replace(middle), middle) {
            (Some((x, y)), Some((to_x, to_y))) => (to_x - x, to_y - y),
            _ => (0.0, 0.0),
        }
    }
}

/// Lets wheel and fingers zoom.
pub(super) fn connect(viewport: &Rc<Viewport>, canvas: &PaintWidget) {
    let wheel = gtk::EventControllerScroll::new(gtk::EventControllerScrollFlags::VERTICAL);
    wheel.connect_scroll(glib::clone!(
        #[weak]
        viewport,
        #[upgrade_or]
        glib::Propagation::Proceed,
        move |controller, _, dy| {
            let to_pointer = controller.current_event_state().contains(gdk::ModifierType::CONTROL_MASK);
            let point = if to_pointer { viewport.input.pointer() } else { None };
            let size = size(&viewport);
            viewport.session().update(|session| session.change_camera(|camera| zoom(camera, NOTCH.powf(-dy) as f32, point, size)));
            glib::Propagation::Stop
        }
    ));
    canvas.add_controller(wheel);
    let pinch = gtk::GestureZoom::new();
    let fingers = Rc::new(PinchState::default());
    pinch.connect_begin(glib::clone!(
        #[weak]
        viewport,
        #[strong]
        fingers,
        move |_, _| {
            viewport.input.drop_drag();
            fingers.begin();
        }
    ));
    pinch.connect_scale_changed(glib::clone!(
        #[weak]
        viewport,
        move |gesture, scale| {
            let (middle, size) = (gesture.bounding_box_center(), size(&viewport));
            let (delta, factor) = (fingers.shift(middle), fingers.factor(scale));
            viewport.session().update(|session| {
                session.change_camera(|camera| {
                    if camera.flying().is_none() {
                        camera.change(|orbit| pan(orbit, delta, size.1));
                    }
                    zoom(camera, factor, middle, size);
                });
            });
        }
    ));
    canvas.add_controller(pinch);
}

fn size(viewport: &Rc<Viewport>) -> (f64, f64) {
    let (width, height) = viewport.size();
    (f64::from(width), f64::from(height.max(1)))
}

/// Pans by a pointer movement, logical pixels of a picture of this height.
pub(super) fn pan(orbit: &mut OrbitCamera, (dx, dy): (f64, f64), height: f64) {
    orbit.pan((-dx / height) as f32, (dy / height) as f32);
}

/// Zooms by a factor; what lies under `point` (logical pixels) stays there. In flight it is the speed that grows.
fn zoom(camera: &mut CameraController, factor: f32, point: Option<(f64, f64)>, (width, height): (f64, f64)) {
    if let Some(fly) = camera.flying() {
        fly.speed = (fly.speed * factor).clamp(1e-4, 1e4);
        return;
    }
    camera.change(|orbit| {
        let before = orbit.distance;
        orbit.zoom(factor);
        if let Some((x, y)) = point {
            let part = before / orbit.distance - 1.0;
            orbit.pan(((x - width / 2.0) / height) as f32 * part, ((height / 2.0 - y) / height) as f32 * part);
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pinch_grows_the_picture_by_what_the_fingers_spread() {
        let fingers = PinchState::default();
        for scales in [&[1.1, 1.5, 1.2, 2.0][..], &[0.9, 0.0, f64::NAN, f64::INFINITY, 0.5]] {
            fingers.begin();
            let grown: f32 = scales.iter().map(|scale| fingers.factor(*scale)).product();
            let last = *scales.last().expect("some") as f32;
            assert!((grown - last).abs() < 1e-5, "{scales:?}: {grown}");
        }
    }

    #[test]
    fn two_fingers_move_the_picture_by_the_way_of_their_middle() {
        let fingers = PinchState::default();
        for delta in [&[(10.0, 20.0), (13.0, 18.0), (20.0, 18.0)][..], &[(500.0, 1.0), (490.0, 41.0)]] {
            fingers.begin();
            let sum = delta.iter().map(|place| fingers.shift(Some(*place))).fold((0.0, 0.0), |sum, by| (sum.0 + by.0, sum.1 + by.1));
            let (first, last) = (delta[0], delta[delta.len() - 1]);
            assert_eq!(sum, (last.0 - first.0, last.1 - first.1));
        }
        assert_eq!((fingers.shift(None), fingers.shift(Some((1.0, 1.0)))), ((0.0, 0.0), (0.0, 0.0)));
    }
}

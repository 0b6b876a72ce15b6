//! Side view of a muscle: the profile at rest as an outline and the present one filled, to one scale.

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use gtk::cairo::Context;
use gtk::prelude::*;
use gtk4 as gtk;

use crate::app::format;
use crate::app::widgets::drawing_area::{Align, PaintWidget, cairo, rgb, set_color, write};
use crate::muscle::Edit;
use crate::tr;

/// Room round the shape, logical pixels.
const INSET: f64 = 10.0;
/// Growth that one pixel of a drag with Shift changes.
const GROWTH_A_PIXEL: f64 = 0.01;
/// Height of the caption with the air above it, logical pixels.
const CAPTION: i32 = 26;
/// Muscle red, in light and dark.
const MUSCLE: u32 = 0xB8322E;

/// A muscle at rest and now; lengths in the file's unit.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct ProfileShape {
    /// Radii at rest.
    pub rest: Vec<f64>,
    /// Length at rest.
    pub rest_length: f64,
    /// Radii now.
    pub now: Vec<f64>,
    /// Length now.
    pub length: f64,
    /// The unit's sign.
    pub unit: String,
    /// Growth multipliers.
    pub growth: Vec<f64>,
}

/// A profile node that is being dragged.
#[derive(Debug, Clone, Copy)]
struct NodeHandle {
    node: usize,
    radius: f64,
    growth: f64,
    /// Pixels a unit, kept while dragging, so that the shape does not flee from the pointer.
    scale: f64,
    /// 1 above the axis, −1 below.
    side: f64,
}

/// The drawing.
pub(crate) struct ProfilePlot {
    /// Where it is drawn.
    pub canvas: PaintWidget,
    shape: Rc<RefCell<ProfileShape>>,
    grip: Rc<Cell<Option<NodeHandle>>>,
}

impl ProfilePlot {
    /// A drawing of nothing.
    pub(crate) fn new() -> Self {
        let canvas = PaintWidget::named(&tr!("app-profile"), 120, 130);
        canvas.set_hexpand(true);
        let shape = Rc::new(RefCell::new(ProfileShape::default()));
        let pointer = Rc::new(Cell::new(None::<f64>));
        let grip = Rc::new(Cell::new(None::<NodeHandle>));
        let (painted, at, held) = (shape.clone(), pointer.clone(), grip.clone());
        canvas.set_painter(move |canvas, snapshot, width, height| {
            painted.borrow().paint(canvas, snapshot, width, height, at.get(), held.get())
        });
        let motion = gtk::EventControllerMotion::new();
        let (at, drawn) = (pointer.clone(), canvas.downgrade());
        motion.connect_motion(move |_, x, _| {
            at.set(Some(x));
            if let Some(canvas) = drawn.upgrade() {
                canvas.queue_draw();
            }
        });
        let drawn = canvas.downgrade();
        motion.connect_leave(move |_| {
            pointer.set(None);
            if let Some(canvas) = drawn.upgrade() {
                canvas.queue_draw();
            }
        });
        canvas.add_controller(motion);
        // Over the caption alone: elsewhere the explanation would stand over the handle that is about to be dragged.
        canvas.connect_query_tooltip(|canvas, _, y, _, tooltip| {
            tooltip.set_text(Some(&tr!("app-profile-tip")));
            y > canvas.height() - CAPTION
        });
        canvas.set_has_tooltip(true);
        Self { canvas, shape, grip }
    }

    /// Lets handles be dragged: up and down for the radius, with Shift for the growth. The first change of a drag comes with `true`.
    pub(crate) fn connect(&self, change: impl Fn(Edit, bool) + 'static) {
        let drag = gtk::GestureDrag::new();
        let (shape, grip, canvas) = (self.shape.clone(), self.grip.clone(), self.canvas.downgrade());
        drag.connect_drag_begin(move |_, x, y| {
            if let Some(canvas) = canvas.upgrade() {
                grip.set(shape.borrow().grip(x, y, f64::from(canvas.width()), f64::from(canvas.height())));
            }
        });
        let (grip, begun) = (self.grip.clone(), Rc::new(Cell::new(false)));
        let first = begun.clone();
        drag.connect_drag_update(move |gesture, _, dy| {
            let Some(held) = grip.get() else { return };
            let up = -dy * held.side;
            let edit = if gesture.current_event_state().contains(gtk::gdk::ModifierType::SHIFT_MASK) {
                Edit::Growth(held.node, held.growth + up * GROWTH_A_PIXEL)
            } else {
                Edit::Radius(held.node, held.radius + up / held.scale)
            };
            change(edit, !first.replace(true));
        });
        let (grip, canvas) = (self.grip.clone(), self.canvas.downgrade());
        drag.connect_drag_end(move |_, _, _| {
            begun.set(false);
            grip.set(None);
            if let Some(canvas) = canvas.upgrade() {
                canvas.queue_draw();
            }
        });
        self.canvas.add_controller(drag);
    }

    /// Shows a shape.
    pub(crate) fn show(&self, shape: ProfileShape) {
        if *self.shape.borrow() != shape {
            self.shape.replace(shape);
            self.canvas.queue_draw();
        }
    }
}

impl ProfileShape {
    /// Pixels a unit, so that both shapes fit; one scale for length and radius.
    fn scale(&self, width: f64, height: f64) -> f64 {
        let longest = self.rest_length.max(self.length);
        let thickest = self.rest.iter().chain(&self.now).copied().fold(0.0, f64::max);
        // The caps stand out by the radius of the ends.
        let ends = |radii: &[f64]| radii.first().unwrap_or(&0.0) + radii.last().unwrap_or(&0.0);
        let scale = ((width - 2.0 * INSET) / (longest + ends(&self.rest).max(ends(&self.now)))).min((height - 34.0) / (2.0 * thickest));
        if scale.is_finite() && scale > 0.0 { scale } else { 1.0 }
    }

    /// The handle nearest to a place.
    fn grip(&self, x: f64, y: f64, width: f64, height: f64) -> Option<NodeHandle> {
        let scale = self.scale(width, height);
        let node = self.near(x, scale, width)?;
        let side = if y > (height - 18.0) / 2.0 { -1.0 } else { 1.0 };
        Some(NodeHandle { node, radius: *self.rest.get(node)?, growth: *self.growth.get(node)?, scale, side })
    }

    fn near(&self, x: f64, scale: f64, width: f64) -> Option<usize> {
        let places = places(self.now.len(), self.length, scale, width);
        (0..self.now.len()).min_by(|a, b| (places(*a) - x).abs().total_cmp(&(places(*b) - x).abs()))
    }

    fn paint(
        &self,
        canvas: &PaintWidget,
        snapshot: &gtk::Snapshot,
        width: f64,
        height: f64,
        pointer: Option<f64>,
        grip: Option<NodeHandle>,
    ) {
        if self.now.len() < 2 {
            return;
        }
        let scale = grip.map_or_else(|| self.scale(width, height), |grip| grip.scale);
        let middle = (height - 18.0) / 2.0;
        let text = canvas.text_color();
        let context = cairo(snapshot, width, height);
        set_color(&context, &rgb(MUSCLE), 0.85);
        outline(&context, &self.now, self.length, scale, width, middle);
        let _ = context.fill();
        set_color(&context, &text, 0.6);
        context.set_dash(&[4.0, 3.0], 0.0);
        context.set_line_width(1.0);
        outline(&context, &self.rest, self.rest_length, scale, width, middle);
        let _ = context.stroke();
        context.set_dash(&[], 0.0);
        let places = places(self.now.len(), self.length, scale, width);
        let near = grip.map(|grip| grip.node).or_else(|| pointer.and_then(|x| self.near(x, scale, width)));
        for (index, radius) in self.now.iter().enumerate() {
            set_color(&context, &rgb(0xFFFFFF), if near == Some(index) { 1.0 } else { 0.35 });
            context.rectangle(places(index).round(), middle - radius * scale, 1.0, 2.0 * radius * scale);
            let _ = context.fill();
            for side in [-1.0, 1.0] {
                set_color(&context, &rgb(if near == Some(index) { 0xFF7A59 } else { 0xFFFFFF }), 1.0);
                context.arc(
                    places(index),
                    middle + side * radius * scale,
                    if near == Some(index) { 4.5 } else { 3.0 },
                    0.0,
                    std::f64::consts::TAU,
                );
                let _ = context.fill_preserve();
                set_color(&context, &rgb(0x5A1210), 1.0);
                let _ = context.stroke();
            }
        }
        drop(context);
        let caption = match near {
            Some(index) => tr!(
                "app-profile-node",
                node = index + 1,
                now = format::with_unit(self.now.get(index).copied().unwrap_or(f64::NAN), 2, &self.unit),
                rest = format::with_unit(self.rest.get(index).copied().unwrap_or(f64::NAN), 2, &self.unit)
            ),
            None => tr!("app-profile-legend"),
        };
        write(canvas, snapshot, &caption, width / 2.0, height - 17.0, Align::Centre, 0.85, &text.with_alpha(0.7));
    }
}

/// Where node `index` of `count` stands.
fn places(count: usize, length: f64, scale: f64, width: f64) -> impl Fn(usize) -> f64 {
    let left = (width - length * scale) / 2.0;
    let step = length * scale / (count.max(2) - 1) as f64;
    move |index| left + step * index as f64
}

/// Upper and lower edge with round ends.
fn outline(context: &Context, radii: &[f64], length: f64, scale: f64, width: f64, middle: f64) {
    let (Some(first), Some(last)) = (radii.first(), radii.last()) else { return };
    let x = places(radii.len(), length, scale, width);
    let quarter = std::f64::consts::FRAC_PI_2;
    context.new_path();
    for (index, radius) in radii.iter().enumerate() {
        context.line_to(x(index), middle - radius * scale);
    }
    context.arc(x(radii.len() - 1), middle, last * scale, -quarter, quarter);
    for (index, radius) in radii.iter().enumerate().rev() {
        context.line_to(x(index), middle + radius * scale);
    }
    context.arc(x(0), middle, first * scale, quarter, 3.0 * quarter);
    context.close_path();
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_shapes_fit_to_one_scale() {
        let shape = ProfileShape {
            rest: vec![5.0, 20.0, 5.0],
            rest_length: 200.0,
            now: vec![6.0, 30.0, 6.0],
            length: 120.0,
            ..ProfileShape::default()
        };
        let scale = shape.scale(300.0, 130.0);
        assert!((200.0 + 10.0) * scale <= 300.0 - 2.0 * INSET + 1e-9 && 60.0 * scale <= 96.0 + 1e-9);
        assert_eq!(ProfileShape::default().scale(0.0, 0.0), 1.0);
    }

    #[test]
    fn nodes_stand_evenly_about_the_middle() {
        let at = places(3, 100.0, 2.0, 300.0);
        assert_eq!((at(0), at(1), at(2)), (50.0, 150.0, 250.0));
    }
}

//! Drawing of the handles of the active tool.

use glam::DVec2;
use gtk::cairo::{Context, LineCap, LineJoin};
use gtk4 as gtk;

use super::ignore;
use crate::app::widgets::drawing_area::{PaintWidget, cairo, rgb, set_color, write_centered};
use crate::session::{Gizmo, GizmoHandle, Tool};

/// Paints them; `lit` is under the pointer or held.
pub(super) fn draw(handles: &Gizmo, colors: [u32; 3], lit: Option<GizmoHandle>, canvas: &PaintWidget, snapshot: &gtk::Snapshot) {
    let Some(middle) = handles.project(handles.middle) else { return };
    let context = cairo(snapshot, handles.size.x, handles.size.y);
    context.set_line_cap(LineCap::Round);
    context.set_line_join(LineJoin::Round);
    for (axis, color) in colors.into_iter().enumerate() {
        let held = lit == Some(GizmoHandle::Axis(axis));
        // A dark edge keeps every colour legible over any model.
        for (color, wider, opacity) in [(0, 2.0, 0.35), (color, 0.0, if held || lit.is_none() { 1.0 } else { 0.75 })] {
            set_color(&context, &rgb(color), opacity);
            context.set_line_width(if held { 4.0 } else { 2.5 } + wider);
            match handles.tool {
                Tool::Navigate => {}
                Tool::Rotate => ring(&context, &handles.ring(axis)),
                Tool::Move | Tool::Scale => {
                    if let Some(tip) = handles.tip(axis) {
                        arm(&context, handles.tool, middle, tip, wider / 2.0 + if held { 1.0 } else { 0.0 });
                    }
                }
            }
        }
    }
    for (axis, color) in colors.into_iter().enumerate() {
        let Some(corners) = handles.square(axis) else { continue };
        let held = lit == Some(GizmoHandle::Plane(axis));
        corners.iter().for_each(|corner| context.line_to(corner.x, corner.y));
        context.close_path();
        set_color(&context, &rgb(color), if held { 0.75 } else { 0.4 });
        ignore(context.fill_preserve());
        set_color(&context, &rgb(color), 0.95);
        context.set_line_width(if held { 2.0 } else { 1.0 });
        ignore(context.stroke());
    }
    set_color(&context, &rgb(0xFF_FFFF), 0.9);
    context.arc(middle.x, middle.y, 3.5, 0.0, std::f64::consts::TAU);
    ignore(context.fill());
    drop(context);
    if handles.tool != Tool::Rotate {
        for (axis, name) in ["X", "Y", "Z"].into_iter().enumerate() {
            if let Some(tip) = handles.tip(axis) {
                let out = tip + (tip - middle).normalize_or(DVec2::Y) * 18.0;
                write_centered(canvas, snapshot, name, (out.x, out.y), 0.8, &rgb(colors[axis]));
            }
        }
    }
}

fn ring(context: &Context, places: &[DVec2]) {
    for (index, place) in places.iter().enumerate() {
        if index == 0 { context.move_to(place.x, place.y) } else { context.line_to(place.x, place.y) }
    }
    ignore(context.stroke());
}

/// An arrow, or a bar with a box at its end.
fn arm(context: &Context, tool: Tool, middle: DVec2, tip: DVec2, wider: f64) {
    let along = (tip - middle).normalize_or(DVec2::ZERO);
    let aside = DVec2::new(-along.y, along.x);
    let from = middle + along * 8.0;
    if (tip - middle).length() > 12.0 {
        context.move_to(from.x, from.y);
        context.line_to(tip.x, tip.y);
        ignore(context.stroke());
    }
    if tool == Tool::Scale {
        let half = 5.0 + wider;
        context.rectangle(tip.x - half, tip.y - half, 2.0 * half, 2.0 * half);
    } else {
        let (head, base) = (tip + along * (8.0 + wider), tip - along * (5.0 + wider));
        let half = aside * (6.0 + wider);
        for (index, place) in [head, base + half, base - half].into_iter().enumerate() {
            if index == 0 { context.move_to(place.x, place.y) } else { context.line_to(place.x, place.y) }
        }
        context.close_path();
    }
    ignore(context.fill());
}

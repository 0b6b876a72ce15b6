//! The widgets of one wrap surface: shape, place, sizes, side, and the part of the path on which it acts.

use gtk::prelude::*;
use gtk4 as gtk;

use super::attachment_field::{AttachmentField, Bones};
use super::muscle_editor::{Editor, connect_entry, show_text};
use crate::app::format;
use crate::app::widgets::ui::{self, object};
use crate::muscle::{AttachmentPoint, Edit, MuscleSpec, Wrap, WrapRange, WrapShape};
use crate::scene::MuscleId;
use crate::session::{Session, UndoStep};
use crate::tr;

/// Keys of the names of shapes, in the order of the list.
const SHAPES: [&str; 4] = ["app-wrap-sphere", "app-wrap-cylinder", "app-wrap-ellipsoid", "app-wrap-torus"];
/// Keys of the parts of a path on which a surface can act, in the order of the list.
const RANGES: [&str; 3] = ["app-wrap-at-joint", "app-wrap-whole", "app-wrap-between"];

ui::widgets! {
    /// The widgets of a wrap surface beside those of its centre.
    struct RowWidgets in "wrap_surface.ui" {
        wrap: gtk::Grid,
        wrap_number: gtk::Label,
        wrap_shape: gtk::DropDown,
        wrap_delete: gtk::Button,
        wrap_unit: gtk::Label,
        wrap_radius_label: gtk::Label,
        wrap_radius: gtk::Entry,
        wrap_radius_unit: gtk::Label,
        wrap_radii_label: gtk::Label,
        wrap_radii: gtk::Box,
        wrap_radii_unit: gtk::Label,
        wrap_length_label: gtk::Label,
        wrap_length: gtk::Entry,
        wrap_length_unit: gtk::Label,
        wrap_tube_label: gtk::Label,
        wrap_tube: gtk::Entry,
        wrap_tube_unit: gtk::Label,
        wrap_rotation_label: gtk::Label,
        wrap_rotation: gtk::Box,
        wrap_rotation_unit: gtk::Label,
        wrap_sided: gtk::CheckButton,
        wrap_side: gtk::Box,
        wrap_flip: gtk::Button,
        wrap_range: gtk::DropDown,
        wrap_between: gtk::Box,
        wrap_from: gtk::DropDown,
        wrap_to: gtk::DropDown,
    }
}

/// A number of a wrap surface that is typed into an entry.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Field {
    Radius,
    Radii(usize),
    Length,
    Tube,
    Rotation(usize),
    Side(usize),
}

impl Field {
    const ALL: [(Field, &'static str); 12] = [
        (Field::Radius, "wrap_radius"),
        (Field::Radii(0), "wrap_radius_x"),
        (Field::Radii(1), "wrap_radius_y"),
        (Field::Radii(2), "wrap_radius_z"),
        (Field::Length, "wrap_length"),
        (Field::Tube, "wrap_tube"),
        (Field::Rotation(0), "wrap_rotation_x"),
        (Field::Rotation(1), "wrap_rotation_y"),
        (Field::Rotation(2), "wrap_rotation_z"),
        (Field::Side(0), "wrap_side_x"),
        (Field::Side(1), "wrap_side_y"),
        (Field::Side(2), "wrap_side_z"),
    ];

    /// The number in a surface; `None` where its shape has no such number.
    fn of(self, wrap: &mut Wrap) -> Option<&mut f64> {
        match (self, &mut wrap.shape) {
            (Field::Radius, WrapShape::Sphere { radius } | WrapShape::Cylinder { radius, .. } | WrapShape::Torus { radius, .. }) => {
                Some(radius)
            }
            (Field::Radii(axis), WrapShape::Ellipsoid { radii }) => Some(&mut radii[axis]),
            (Field::Length, WrapShape::Cylinder { length, .. }) => Some(length),
            (Field::Tube, WrapShape::Torus { tube, .. }) => Some(tube),
            (Field::Rotation(axis), _) => Some(&mut wrap.rotation[axis]),
            (Field::Side(axis), _) => wrap.side.as_mut().map(|side| &mut side[axis]),
            _ => None,
        }
    }

    fn text(self, wrap: &Wrap) -> String {
        let digits = if matches!(self, Field::Side(_)) { 3 } else { 2 };
        let mut wrap = wrap.clone();
        self.of(&mut wrap).map_or_else(String::new, |value| format::number(*value, digits))
    }
}

/// A row.
pub(crate) struct WrapSurfaceRow {
    widgets: RowWidgets,
    center: AttachmentField,
    entries: Vec<(Field, gtk::Entry)>,
    /// The points of the path at which the part that the surface acts on can begin, and at which it can end.
    points: [gtk::StringList; 2],
}

impl WrapSurfaceRow {
    /// The row of surface `number`; when it is deleted, the keyboard goes to `next`.
    pub(crate) fn new(number: usize, editor: &Editor, bones: &Bones, next: &gtk::Button) -> Self {
        let builder = ui::numbered(include_str!("wrap_surface.ui"), number + 1);
        let widgets = RowWidgets::of(&builder);
        let center = AttachmentField::new(&builder, "wrap", AttachmentPoint::Wrap(number), bones);
        center.connect(editor);
        widgets.wrap_shape.set_model(Some(&ui::words(&SHAPES.map(|key| tr!(key)))));
        widgets.wrap_range.set_model(Some(&ui::words(&RANGES.map(|key| tr!(key)))));
        let points = [0, 1].map(|_| ui::words::<&str>(&[]));
        for (list, points) in [&widgets.wrap_from, &widgets.wrap_to].into_iter().zip(&points) {
            ui::narrow(list, 10);
            list.set_model(Some(points));
        }
        let entries: Vec<(Field, gtk::Entry)> = Field::ALL.into_iter().map(|(field, id)| (field, object(&builder, id))).collect();
        for (field, entry) in &entries {
            let (own, field) = (editor.clone(), *field);
            connect_entry(entry, move |entry| typed(&own, number, field, entry));
        }
        let change = move |editor: &Editor, change: &dyn Fn(&mut Wrap)| {
            let Some(wrap) = editor.spec().and_then(|spec| spec.wraps.get(number).cloned()) else { return };
            let mut changed = wrap.clone();
            change(&mut changed);
            if changed != wrap {
                editor.edit(&Edit::Wrap(number, changed), UndoStep::New);
            }
        };
        let own = editor.clone();
        widgets.wrap_shape.connect_selected_notify(move |list| {
            let (shape, id) = (list.selected() as usize, own.id());
            if shape < SHAPES.len() {
                own.tell(|session| session.set_wrap_shape(id, number, shape));
            }
        });
        let own = editor.clone();
        widgets.wrap_sided.connect_toggled(move |check| {
            let (on, id) = (check.is_active(), own.id());
            own.tell(|session| session.set_wrap_sided(id, number, on));
        });
        let own = editor.clone();
        widgets.wrap_flip.connect_clicked(move |_| {
            let id = own.id();
            own.tell(|session| session.flip_wrap(id, number));
        });
        let own = editor.clone();
        widgets.wrap_range.connect_selected_notify(move |list| {
            let chosen = list.selected();
            let last = own.spec().map_or(1, |spec| spec.via.len() + 1);
            change(&own, &|wrap| {
                wrap.range = match (chosen, wrap.range) {
                    (0, _) => WrapRange::AtJoint,
                    (1, _) => WrapRange::Whole,
                    (2, WrapRange::Between(points)) => WrapRange::Between(points),
                    (2, _) => WrapRange::Between([0, last]),
                    (_, range) => range,
                }
            });
        });
        for (end, list) in [&widgets.wrap_from, &widgets.wrap_to].into_iter().enumerate() {
            let own = editor.clone();
            list.connect_selected_notify(move |list| {
                let chosen = list.selected();
                change(&own, &|wrap| {
                    if let (WrapRange::Between([from, to]), true) = (&mut wrap.range, chosen != gtk::INVALID_LIST_POSITION) {
                        let chosen = chosen as usize;
                        // The other end gives way.
                        (*from, *to) = if end == 0 { (chosen, (*to).max(chosen + 1)) } else { ((*from).min(chosen), chosen + 1) };
                    }
                });
            });
        }
        let (own, next) = (editor.clone(), next.clone());
        widgets.wrap_delete.connect_clicked(move |_| {
            if own.edit(&Edit::DeleteWrap(number), UndoStep::New) {
                next.grab_focus();
            }
        });
        Self { widgets, center, entries, points }
    }

    /// The widget of all.
    pub(crate) fn root(&self) -> &gtk::Grid {
        &self.widgets.wrap
    }

    /// The widgets that stand before all others; the column of one surface is as wide as that of another.
    pub(crate) fn labels(&self) -> [&gtk::Widget; 2] {
        [self.widgets.wrap_number.upcast_ref(), self.widgets.wrap_sided.upcast_ref()]
    }

    /// Shows a surface of a muscle.
    pub(crate) fn show(&self, session: &Session, id: MuscleId, spec: &MuscleSpec, wrap: &Wrap, unit: &str, anew: bool) {
        let widgets = &self.widgets;
        let shape = match wrap.shape {
            WrapShape::Sphere { .. } => 0,
            WrapShape::Cylinder { .. } => 1,
            WrapShape::Ellipsoid { .. } => 2,
            WrapShape::Torus { .. } => 3,
        };
        widgets.wrap_shape.set_selected(shape);
        self.center.show(session, id, anew);
        let groups: [(bool, [&gtk::Widget; 3]); 5] = [
            (shape != 2, [widgets.wrap_radius_label.upcast_ref(), widgets.wrap_radius.upcast_ref(), widgets.wrap_radius_unit.upcast_ref()]),
            (shape == 2, [widgets.wrap_radii_label.upcast_ref(), widgets.wrap_radii.upcast_ref(), widgets.wrap_radii_unit.upcast_ref()]),
            (shape == 1, [widgets.wrap_length_label.upcast_ref(), widgets.wrap_length.upcast_ref(), widgets.wrap_length_unit.upcast_ref()]),
            (shape == 3, [widgets.wrap_tube_label.upcast_ref(), widgets.wrap_tube.upcast_ref(), widgets.wrap_tube_unit.upcast_ref()]),
            (
                shape != 0,
                [widgets.wrap_rotation_label.upcast_ref(), widgets.wrap_rotation.upcast_ref(), widgets.wrap_rotation_unit.upcast_ref()],
            ),
        ];
        for (shown, parts) in groups {
            parts.iter().for_each(|part| part.set_visible(shown));
        }
        let units =
            [&widgets.wrap_unit, &widgets.wrap_radius_unit, &widgets.wrap_radii_unit, &widgets.wrap_length_unit, &widgets.wrap_tube_unit];
        units.iter().for_each(|label| label.set_text(unit));
        widgets.wrap_sided.set_visible(shape != 3);
        widgets.wrap_sided.set_active(wrap.side.is_some());
        widgets.wrap_side.set_visible(wrap.side.is_some());
        widgets.wrap_flip.set_visible(wrap.side.is_some());
        for (field, entry) in &self.entries {
            show_text(entry, &field.text(wrap), anew);
        }
        self.show_range(spec, wrap);
    }

    fn show_range(&self, spec: &MuscleSpec, wrap: &Wrap) {
        let widgets = &self.widgets;
        // The first list leaves the insertion out, the second the origin.
        let count = spec.via.len() as u32 + 2;
        if self.points[0].n_items() + 1 != count {
            let name = |number: u32| match number {
                0 => tr!("app-origin"),
                number if number + 1 == count => tr!("app-insertion"),
                number => tr!("app-via-point-short", number = number),
            };
            for (first, points) in [0, 1].into_iter().zip(&self.points) {
                let names: Vec<String> = (first..count - 1 + first).map(name).collect();
                points.splice(0, points.n_items(), &names.iter().map(String::as_str).collect::<Vec<_>>());
            }
        }
        let (chosen, between) = match wrap.range {
            WrapRange::AtJoint => (0, None),
            WrapRange::Whole => (1, None),
            WrapRange::Between(points) => (2, Some(points)),
        };
        widgets.wrap_range.set_selected(chosen);
        widgets.wrap_between.set_visible(between.is_some());
        if let Some([from, to]) = between {
            widgets.wrap_from.set_selected(from as u32);
            widgets.wrap_to.set_selected(to as u32 - 1);
        }
    }
}

/// Takes what was typed into a field of a surface.
fn typed(editor: &Editor, number: usize, field: Field, entry: &gtk::Entry) {
    let Some(mut wrap) = editor.spec().and_then(|spec| spec.wraps.get(number).cloned()) else { return };
    if entry.text() == field.text(&wrap) {
        return entry.remove_css_class("error");
    }
    let Some(value) = field.of(&mut wrap) else { return };
    *value = format::parse_number(&entry.text()).unwrap_or(f64::NAN);
    let text = field.text(&wrap);
    if editor.edit(&Edit::Wrap(number, wrap), UndoStep::New) {
        entry.remove_css_class("error");
        entry.set_text(&text);
    } else {
        entry.add_css_class("error");
    }
}

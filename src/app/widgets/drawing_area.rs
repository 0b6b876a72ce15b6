//! A widget that a closure paints: the viewport, the timeline, the profile and the small icons are canvases.

use gtk::prelude::*;
use gtk::subclass::prelude::*;
use gtk::{cairo, gdk, glib, graphene};
use gtk4 as gtk;

use super::ui;
use crate::i18n::shown_lines;

mod imp {
    use std::cell::{Cell, RefCell};

    use super::*;

    /// Paints a canvas of a width and height, logical pixels.
    pub(crate) type Painter = Box<dyn Fn(&super::PaintWidget, &gtk::Snapshot, f64, f64)>;
    /// Hears of a new width and height.
    pub(crate) type Resized = Box<dyn Fn(i32, i32)>;

    #[derive(Default)]
    #[expect(unnameable_types, reason = "the macro below makes it part of the public wrapper")]
    pub struct PaintWidget {
        pub painter: RefCell<Option<Painter>>,
        pub resized: RefCell<Option<Resized>>,
        pub natural: Cell<(i32, i32)>,
    }

    #[glib::object_subclass]
    impl ObjectSubclass for PaintWidget {
        const NAME: &'static str = "SinewCanvas";
        type Type = super::PaintWidget;
        type ParentType = gtk::Widget;

        fn class_init(class: &mut Self::Class) {
            // GTK since 4.10 takes no name for what has no role.
            class.set_accessible_role(gtk::AccessibleRole::Img);
        }
    }

    impl ObjectImpl for PaintWidget {}

    impl WidgetImpl for PaintWidget {
        fn snapshot(&self, snapshot: &gtk::Snapshot) {
            let widget = self.obj();
            let (width, height) = (f64::from(widget.width()), f64::from(widget.height()));
            if let Some(painter) = &*self.painter.borrow()
                && width > 0.0
                && height > 0.0
            {
                painter(&widget, snapshot, width, height);
            }
        }

        fn size_allocate(&self, width: i32, height: i32, _baseline: i32) {
            if let Some(resized) = &*self.resized.borrow() {
                resized(width, height);
            }
        }

        fn measure(&self, orientation: gtk::Orientation, _for_size: i32) -> (i32, i32, i32, i32) {
            let (width, height) = self.natural.get();
            let natural = if orientation == gtk::Orientation::Horizontal { width } else { height };
            (natural, natural, -1, -1)
        }
    }
}

glib::wrapper! {
    /// A widget that a closure paints.
    pub struct PaintWidget(ObjectSubclass<imp::PaintWidget>)
        @extends gtk::Widget,
        @implements gtk::Buildable, gtk::ConstraintTarget;
}

impl Default for PaintWidget {
    fn default() -> Self {
        glib::Object::new()
    }
}

impl PaintWidget {
    /// A canvas of at least this size, logical pixels.
    pub fn new(width: i32, height: i32) -> Self {
        let canvas = Self::default();
        canvas.imp().natural.set((width, height));
        canvas
    }

    /// One that tells those who do not see it what it shows.
    pub fn named(name: &str, width: i32, height: i32) -> Self {
        Self::ensure_type();
        let canvas: Self = ui::named(Self::static_type().name(), name);
        canvas.imp().natural.set((width, height));
        canvas
    }

    /// Sets what paints it: the canvas, the snapshot, width and height.
    pub fn set_painter(&self, painter: impl Fn(&Self, &gtk::Snapshot, f64, f64) + 'static) {
        self.imp().painter.replace(Some(Box::new(painter)));
        self.queue_draw();
    }

    /// Sets what hears of a new size, logical pixels.
    pub fn set_resized(&self, resized: impl Fn(i32, i32) + 'static) {
        self.imp().resized.replace(Some(Box::new(resized)));
    }

    /// The colour of text here.
    pub fn text_color(&self) -> gdk::RGBA {
        text_color(self)
    }
}

/// The colour of text in a widget.
pub(crate) fn text_color(widget: &impl IsA<gtk::Widget>) -> gdk::RGBA {
    // From 4.10 on a widget has its own `color`; this one is there in all versions.
    #[allow(deprecated, reason = "GTK 4.8 has no other way to ask for a colour of the theme")]
    widget.style_context().color()
}

/// A cairo context over the whole of a snapshot.
pub(crate) fn cairo(snapshot: &gtk::Snapshot, width: f64, height: f64) -> cairo::Context {
    snapshot.append_cairo(&graphene::Rect::new(0.0, 0.0, width as f32, height as f32))
}

/// Sets the colour that a cairo context draws with.
pub(crate) fn set_color(context: &cairo::Context, color: &gdk::RGBA, opacity: f64) {
    context.set_source_rgba(color.red().into(), color.green().into(), color.blue().into(), f64::from(color.alpha()) * opacity);
}

/// A colour from `0xRRGGBB`.
pub(crate) fn rgb(color: u32) -> gdk::RGBA {
    let part = |shift: u32| ((color >> shift) & 0xFF) as f32 / 255.0;
    gdk::RGBA::new(part(16), part(8), part(0), 1.0)
}

/// Where text stands against its point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Align {
    /// The point is the upper left corner.
    Left,
    /// The point is the middle of the upper edge.
    Centre,
    /// The point is the upper right corner.
    Right,
}

/// Writes a letter or two such that what is seen of them has its middle at a point.
pub(crate) fn write_centered(canvas: &PaintWidget, snapshot: &gtk::Snapshot, text: &str, (x, y): (f64, f64), size: f64, color: &gdk::RGBA) {
    let layout = canvas.create_pango_layout(Some(&*shown_lines(text)));
    let attributes = gtk::pango::AttrList::new();
    attributes.insert(gtk::pango::AttrFloat::new_scale(size));
    layout.set_attributes(Some(&attributes));
    let (ink, _) = layout.pixel_extents();
    // On whole pixels of the device, where letters are sharp.
    let scale = f64::from(canvas.scale_factor());
    let whole = |middle: f64, start: i32, length: i32| ((middle - f64::from(start) - f64::from(length) / 2.0) * scale).round() / scale;
    let corner = graphene::Point::new(whole(x, ink.x(), ink.width()) as f32, whole(y, ink.y(), ink.height()) as f32);
    snapshot.save();
    snapshot.translate(&corner);
    snapshot.append_layout(&layout, color);
    snapshot.restore();
}

/// Writes text as [`write()`] does, on a ground that keeps it legible over anything; returns its width.
pub(crate) fn write_with_background(
    canvas: &PaintWidget,
    snapshot: &gtk::Snapshot,
    text: &str,
    (x, y): (f64, f64),
    size: f64,
    color: &gdk::RGBA,
    ground: &gdk::RGBA,
) -> f64 {
    let layout = canvas.create_pango_layout(Some(&*shown_lines(text)));
    let attributes = gtk::pango::AttrList::new();
    attributes.insert(gtk::pango::AttrFloat::new_scale(size));
    layout.set_attributes(Some(&attributes));
    let (width, height) = layout.pixel_size();
    let left = x.clamp(0.0, (f64::from(canvas.width()) - f64::from(width)).max(0.0));
    snapshot.save();
    snapshot.translate(&graphene::Point::new(left.round() as f32, y.round() as f32));
    snapshot.append_color(ground, &graphene::Rect::new(-3.0, 0.0, width as f32 + 6.0, height as f32));
    snapshot.append_layout(&layout, color);
    snapshot.restore();
    f64::from(width)
}

/// Writes text in the widget's own font, `size` times as large, held within the canvas' width; returns its width and height.
#[allow(clippy::too_many_arguments, reason = "the words, their style and their place")]
pub(crate) fn write(
    canvas: &PaintWidget,
    snapshot: &gtk::Snapshot,
    text: &str,
    x: f64,
    y: f64,
    align: Align,
    size: f64,
    color: &gdk::RGBA,
) -> (f64, f64) {
    let layout = canvas.create_pango_layout(Some(&*shown_lines(text)));
    let attributes = gtk::pango::AttrList::new();
    attributes.insert(gtk::pango::AttrFloat::new_scale(size));
    attributes.insert(gtk::pango::AttrFontFeatures::new("tnum"));
    layout.set_attributes(Some(&attributes));
    let (width, height) = layout.pixel_size();
    let (width, height) = (f64::from(width), f64::from(height));
    let left = match align {
        Align::Left => x,
        Align::Centre => x - width / 2.0,
        Align::Right => x - width,
    };
    let left = left.clamp(0.0, (f64::from(canvas.width()) - width).max(0.0));
    snapshot.save();
    snapshot.translate(&graphene::Point::new(left.round() as f32, y.round() as f32));
    snapshot.append_layout(&layout, color);
    snapshot.restore();
    (width, height)
}

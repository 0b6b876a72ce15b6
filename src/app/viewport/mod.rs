//! The picture: draws the session into a kept surface and shows what stands over it; its input is in [`input`].

mod attachment_overlay;
mod bounding_box_labels;
mod cairo_raster_source;
mod frame_surface;
mod input;
mod labels;
mod legend;
mod light_gizmo;
mod orientation_gizmo;
mod tool_gizmo;
mod transform_fields;
mod zoom_gestures;

use std::cell::{Cell, RefCell};
use std::path::PathBuf;
use std::rc::{Rc, Weak};
use std::time::{Duration, Instant};

use glam::DVec2;
use gtk::prelude::*;
use gtk::{cairo, gio, glib};
use gtk4 as gtk;

use self::frame_surface::FrameSurface;
use self::transform_fields::TransformFields;
use super::bone_names;
use super::drawing_area::{PaintWidget, cairo as cairo_over};
use super::icons::{self, Glyph};
use super::ui::object;
use super::window::Window;
use super::{format, ui};
use crate::muscle::AttachmentPoint;
use crate::render::{PickHit, PickJob, RenderJob, Renderer, Stats};
use crate::session::{ChangeSet, PickTarget, Session, Tool, Viewpoint};
use crate::tr;

/// Frame time, milliseconds, above which frames are drawn coarsely while the user interacts.
const HEAVY_MS: f64 = 14.0;
/// Time without interaction after which a coarse picture is drawn in full.
const REST: Duration = Duration::from_millis(120);

/// The picture with what stands over it.
pub(super) struct Viewport {
    /// The whole.
    pub root: gtk::Overlay,
    canvas: PaintWidget,
    screen: Rc<RefCell<FrameSurface>>,
    builder: gtk::Builder,
    transform_fields: TransformFields,
    input: input::ViewportInput,
    toasts: Rc<Cell<u32>>,
    toast_file: Rc<RefCell<Option<PathBuf>>>,
    /// Whether what is said in passing is about the program, not about what is open.
    toast_stays: Cell<bool>,
}

impl Viewport {
    /// An empty one; [`Viewport::connect`] brings it to life.
    pub(super) fn new() -> Self {
        let builder = ui::builder(ui::VIEWPORT);
        let root: gtk::Overlay = object(&builder, "root");
        let canvas = PaintWidget::named(&tr!("app-viewport"), 150, 150);
        canvas.set_focusable(true);
        canvas.add_css_class("scene");
        frame_when_reached(&canvas);
        root.set_child(Some(&canvas));
        for (id, glyph) in
            [("tool_navigate", Glyph::Navigate), ("tool_move", Glyph::Move), ("tool_rotate", Glyph::Rotate), ("tool_scale", Glyph::Scale)]
        {
            object::<gtk::ToggleButton>(&builder, id).set_child(Some(&icons::image(glyph)));
        }
        Self {
            root,
            canvas,
            screen: Rc::new(RefCell::new(FrameSurface::new())),
            transform_fields: TransformFields::new(&builder),
            builder,
            input: input::ViewportInput::default(),
            toasts: Rc::default(),
            toast_file: Rc::default(),
            toast_stays: Cell::default(),
        }
    }

    /// Connects painter, input and buttons.
    pub(super) fn connect(&self, window: &Rc<Window>) {
        let weak = Rc::downgrade(window);
        let screen = self.screen.clone();
        self.canvas.set_painter(move |canvas, snapshot, width, height| {
            if let Some(window) = weak.upgrade() {
                paint(&window, &screen, canvas, snapshot, width, height);
            }
        });
        let weak = Rc::downgrade(window);
        self.canvas.set_resized(move |width, height| {
            if let Some(window) = weak.upgrade() {
                window.update(|session| session.set_aspect(width as f32 / height.max(1) as f32));
                window.viewport.invalidate();
                window.viewport.fit_later(width);
            }
        });
        self.transform_fields.connect(window);
        input::connect(window, &self.canvas);
        self.show_times(window.settings.borrow().frame_times);
        let file = self.toast_file.clone();
        let weak = Rc::downgrade(window);
        object::<gtk::Button>(&self.builder, "toast_folder").connect_clicked(move |button| {
            let file = file.borrow().as_deref().and_then(|file| std::path::absolute(file).ok());
            let Some(folder) = file.as_deref().and_then(std::path::Path::parent) else { return };
            let (uri, weak) = (gio::File::for_path(folder).uri(), weak.clone());
            let context = button.display().app_launch_context();
            gio::AppInfo::launch_default_for_uri_async(&uri, Some(&context), gio::Cancellable::NONE, move |shown| {
                if let (Err(error), Some(window)) = (shown, weak.upgrade()) {
                    window.viewport.toast(&tr!("app-folder-failed", reason = error.message().to_owned()), None);
                }
            });
        });
    }

    /// Shows what changed.
    pub(super) fn refresh(&self, session: &mut Session, changes: ChangeSet) {
        if changes.any(ChangeSet::PICTURE) {
            self.invalidate();
        }
        if changes.any(ChangeSet::TOOL | ChangeSet::MODEL) {
            self.transform_fields.refresh(session.tool(), session.model());
        }
        if changes.any(ChangeSet::TOOL) {
            self.transform_fields.fit(self.canvas.width());
        }
        if changes.any(ChangeSet::TOOL | ChangeSet::MUSCLE) {
            self.draw_over();
        }
        if changes.any(ChangeSet::TOOL | ChangeSet::DOCUMENT | ChangeSet::PICKING | ChangeSet::CAMERA) {
            self.hint(&hint(session));
        }
        if changes.any(ChangeSet::TOOL | ChangeSet::DOCUMENT | ChangeSet::PICKING) {
            let name = if session.picking().is_some() { Some("crosshair") } else { None };
            self.canvas.set_cursor_from_name(name);
            object::<gtk::Box>(&self.builder, "tools").set_visible(!session.is_empty());
        }
    }

    /// The picture is no longer true.
    pub(super) fn invalidate(&self) {
        self.screen.borrow_mut().fresh = false;
        self.canvas.queue_draw();
    }

    /// Lets what stands over the picture follow its width, once widgets have their places.
    fn fit_later(&self, width: i32) {
        let transform_fields = self.transform_fields.clone();
        glib::idle_add_local_once(move || transform_fields.fit(width));
    }

    /// What stands over the picture is no longer true.
    pub(super) fn draw_over(&self) {
        self.canvas.queue_draw();
    }

    /// Logical width and height.
    pub(super) fn size(&self) -> (i32, i32) {
        (self.canvas.width(), self.canvas.height())
    }

    /// Pixels of the device a logical pixel.
    pub(super) fn scale(&self) -> i32 {
        self.canvas.scale_factor()
    }

    /// Where dropped files are accepted.
    pub(super) fn add_controller(&self, controller: &impl IsA<gtk::EventController>) {
        self.root.add_controller(controller.clone());
    }

    /// Gives the keyboard to the picture. A hand that did so knows where it is: nothing frames the picture then.
    pub(super) fn take_focus(&self) {
        self.canvas.grab_focus();
        self.canvas.remove_css_class(REACHED);
    }

    /// What lies under a point, logical pixels.
    pub(super) fn pick(&self, session: &mut Session, x: f64, y: f64) -> Option<PickHit> {
        let ((width, height), scale) = (self.size(), self.scale());
        let (scene, frame, camera, mut display) = session.picture();
        display.scale = scale as f32;
        let scale = f64::from(scale);
        let (width, height) = ((f64::from(width) * scale) as u32, (f64::from(height) * scale) as u32);
        let picture = RenderJob { scene, frame, camera: &camera, display: &display, width, height };
        let job = PickJob { picture, x: (x * scale) as f32, y: (y * scale) as f32 };
        // Where there is no memory for picking, there is none for the picture either, and nothing is seen there.
        self.screen.borrow_mut().renderer.pick(&job).ok().flatten()
    }

    /// The renderer, for pictures to take away.
    pub(super) fn with_renderer<T>(&self, work: impl FnOnce(&mut Renderer) -> T) -> T {
        work(&mut self.screen.borrow_mut().renderer)
    }

    /// Says for a while what a drag does.
    pub(super) fn hint(&self, text: &str) {
        let label: gtk::Label = object(&self.builder, "hint");
        ui::set_label(&label, text);
        label.set_visible(!text.is_empty());
    }

    /// Whether frame times stand over the picture.
    pub(super) fn show_times(&self, shown: bool) {
        object::<gtk::Label>(&self.builder, "times").set_visible(shown);
        self.invalidate();
    }

    /// Says something in passing; with the file that was written, offers its folder.
    pub(super) fn toast(&self, text: &str, file: Option<PathBuf>) {
        ui::set_label(&object(&self.builder, "toast_label"), text);
        object::<gtk::Button>(&self.builder, "toast_folder").set_visible(file.is_some());
        self.toast_file.replace(file);
        self.toast_stays.set(false);
        let revealer: gtk::Revealer = object(&self.builder, "toast");
        revealer.set_can_target(true);
        revealer.set_reveal_child(true);
        let (number, toasts) = (self.toasts.get().wrapping_add(1), self.toasts.clone());
        toasts.set(number);
        glib::timeout_add_local_once(Duration::from_secs(6), move || {
            if toasts.get() == number {
                revealer.set_reveal_child(false);
                revealer.set_can_target(false);
            }
        });
    }

    /// Says something in passing that is about the program, whatever is open.
    pub(super) fn notice(&self, text: &str) {
        self.toast(text, None);
        self.toast_stays.set(true);
    }

    /// Hides notices about documents that are no longer open.
    pub(super) fn hide_notice(&self) {
        if !self.toast_stays.get() {
            self.toasts.set(self.toasts.get().wrapping_add(1));
            object::<gtk::Label>(&self.builder, "toast_label").set_text("");
            let revealer: gtk::Revealer = object(&self.builder, "toast");
            revealer.set_reveal_child(false);
            revealer.set_can_target(false);
        }
    }

    /// Shows how far reading is; `None` = nothing is being read.
    pub(super) fn loading(&self, state: Option<(&str, f64)>) {
        object::<gtk::Box>(&self.builder, "loading").set_visible(state.is_some());
        if let Some((text, part_done)) = state {
            ui::set_label(&object(&self.builder, "loading_label"), text);
            let bar: gtk::ProgressBar = object(&self.builder, "loading_bar");
            if part_done > 0.0 { bar.set_fraction(part_done.min(1.0)) } else { bar.pulse() }
        }
    }

    /// The button that stops reading.
    pub(super) fn cancel_button(&self) -> gtk::Button {
        object(&self.builder, "loading_cancel")
    }

    /// Marks the place where files can be dropped.
    pub(super) fn drop_here(&self, shown: bool) {
        object::<gtk::Label>(&self.builder, "drop_here").set_visible(shown);
    }

    /// Flies, or lands.
    pub(super) fn toggle_flight(&self, window: &Rc<Window>) {
        self.input.toggle_flight(window);
    }

    /// Releases all keys of flight.
    pub(super) fn release_flight_keys(&self) {
        self.input.release_flight_keys();
    }

    /// Updates the hover text of a resting pointer after the scene changed under it.
    pub(super) fn refresh_hover(&self, window: &Rc<Window>) {
        input::refresh_hover(window);
    }

    /// Takes a key in flight; whether it was one of flight's.
    pub(super) fn flight_key(&self, window: &Rc<Window>, letter: Option<char>, key: gtk::gdk::Key, pressed: bool) -> bool {
        self.input.flight_key(window, letter, key, pressed)
    }

    /// Flies on for `seconds`; whether a key is held.
    pub(super) fn fly(&self, window: &Rc<Window>, seconds: f64) -> bool {
        self.input.fly(window, seconds)
    }
}

/// Marks the picture that the keyboard has come to by itself.
const REACHED: &str = "reached";

/// Frames the picture while the keyboard is there, once it has come by Tab. A key such as Space alone is no reason to.
fn frame_when_reached(canvas: &PaintWidget) {
    let focus = gtk::EventControllerFocus::new();
    let weak = canvas.downgrade();
    focus.connect_enter(move |_| {
        if let Some(canvas) = weak.upgrade() {
            canvas.add_css_class(REACHED);
        }
    });
    canvas.add_controller(focus);
}

/// What drags and keys do at present.
fn hint(session: &Session) -> String {
    if let Some(picking) = session.picking() {
        return tr!(match picking.target {
            PickTarget::Point(AttachmentPoint::End(0)) => "app-hint-pick-origin",
            PickTarget::Point(AttachmentPoint::End(_)) => "app-hint-pick-insertion",
            PickTarget::Point(AttachmentPoint::Wrap) => "app-hint-pick-wrap",
            _ => "app-hint-pick-via",
        });
    }
    if session.is_empty() {
        return String::new();
    }
    match (session.camera_controller().viewpoint(), session.tool()) {
        (Viewpoint::Fly(fly), _) => tr!("app-hint-fly", speed = format::significant(f64::from(fly.speed), 2)),
        (_, Tool::Navigate) => tr!("app-hint"),
        (_, Tool::Move) => tr!("app-hint-move"),
        (_, Tool::Rotate) => tr!("app-hint-rotate"),
        (_, Tool::Scale) => tr!("app-hint-scale"),
    }
}

/// Draws what is stale and shows it.
fn paint(window: &Rc<Window>, screen: &Rc<RefCell<FrameSurface>>, canvas: &PaintWidget, snapshot: &gtk::Snapshot, width: f64, height: f64) {
    let scale = canvas.scale_factor();
    let (pixel_width, pixel_height) = (width as i32 * scale, height as i32 * scale);
    let was_fresh = screen.borrow().is_fresh(pixel_width, pixel_height);
    if !was_fresh {
        // Most frames were posed before they are painted: the panels show the moment too.
        let pose_ms = window.read(|session| {
            session.frame();
            session.take_posing_ms()
        });
        let begun = Instant::now();
        let mut screen = screen.borrow_mut();
        let coarse = screen.full_ms > HEAVY_MS && window.viewport.input.is_dragging();
        let drawn = window.read(|session| screen.draw(session, pixel_width, pixel_height, scale, coarse));
        let total_ms = pose_ms + begun.elapsed().as_secs_f64() * 1e3;
        if let Some(stats) = drawn {
            if !coarse {
                screen.full_ms = total_ms;
            }
            drop(screen);
            if coarse {
                draw_in_full_when_at_rest(&Rc::downgrade(window));
            }
            // Labels must not change while the frame is being put together.
            let weak = Rc::downgrade(window);
            glib::idle_add_local_once(move || {
                if let Some(window) = weak.upgrade() {
                    tell(&window, pose_ms, total_ms, stats);
                }
            });
        }
    }
    let context = cairo_over(snapshot, width, height);
    screen.borrow().show(&context, scale);
    drop(context);
    window.read(|session| {
        if session.bone_names() {
            bone_names::write_all(session, canvas, snapshot, width, height);
        }
        if !session.is_empty() {
            let input = &window.viewport.input;
            orientation_gizmo::draw(session, canvas, snapshot, height, input.pointer());
            legend::draw(session, canvas, snapshot, width, height);
            bounding_box_labels::draw(session, canvas, snapshot, width, height);
            labels::draw(session, canvas, snapshot, width, height);
            if session.display().light_marker {
                light_gizmo::draw(session, snapshot, width, height);
            }
            let colors = session.display().palette.axes;
            session.with_gizmo(DVec2::new(width, height), |shown| tool_gizmo::draw(shown, colors, input.handle(), canvas, snapshot));
            if window.shows_muscles() && session.tool() == Tool::Navigate {
                let size = DVec2::new(width, height);
                let ring = session.wrap_sphere_circle(size);
                attachment_overlay::draw(&session.attachment_handles(size), ring, input.dot(), canvas, snapshot, (width, height));
            }
        }
    });
}

fn draw_in_full_when_at_rest(weak: &Weak<Window>) {
    let weak = weak.clone();
    glib::timeout_add_local_once(REST, move || {
        if let Some(window) = weak.upgrade()
            && !window.viewport.input.is_dragging()
        {
            window.viewport.invalidate();
        }
    });
}

/// Frame times and counts.
fn tell(window: &Rc<Window>, pose_ms: f64, total_ms: f64, stats: Stats) {
    window.show_stats(stats.triangles);
    let label: gtk::Label = object(&window.viewport.builder, "times");
    if label.is_visible() {
        let rate = window.viewport.screen.borrow().rate();
        label.set_text(&tr!(
            "app-times",
            rate = format::number(rate, 0),
            total = format::number(total_ms, 1),
            pose = format::number(pose_ms, 1),
            vertex = format::number(stats.vertex_ms, 1),
            raster = format::number(stats.raster_ms, 1),
            resolve = format::number(stats.resolve_ms, 1)
        ));
    }
}

/// Cairo's own words are of no use to a person; a picture that could not be shown is drawn again with the next change.
fn ignore(result: Result<(), cairo::Error>) {
    let _ = result;
}

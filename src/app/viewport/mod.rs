//! The picture: draws the session into a kept surface and shows what stands over it; its input is in [`input`].

mod attachment_overlay;
mod bone_names;
mod bounding_box_labels;
mod cairo_raster_source;
pub(crate) mod frame_clock;
mod frame_surface;
mod input;
mod labels;
mod legend;
mod light_gizmo;
mod orientation_gizmo;
mod tool_gizmo;
mod transform_fields;
mod zoom_gestures;

use std::cell::RefCell;
use std::rc::{Rc, Weak};
use std::time::{Duration, Instant};

use glam::DVec2;
use gtk::prelude::*;
use gtk::{cairo, glib};
use gtk4 as gtk;

use self::frame_clock::FrameClock;
use self::frame_surface::FrameSurface;
use self::transform_fields::TransformFields;
use crate::app::format;
use crate::app::handles::picture_focus::PictureFocus;
use crate::app::handles::session_handle::SessionHandle;
use crate::app::handles::settings_handle::SettingsHandle;
use crate::app::panels::muscle::muscle_editor::Editor;
use crate::app::widgets::drawing_area::{PaintWidget, cairo as cairo_over};
use crate::app::widgets::icons::{self, Icon};
use crate::app::widgets::ui;
use crate::app::window::status_line::StatusLine;
use crate::muscle::AttachmentPoint;
use crate::render::{PickHit, PickJob, RenderJob, Renderer, Stats};
use crate::session::{ChangeSet, PickTarget, Session, Tool, Viewpoint};
use crate::tr;

/// Frame time, milliseconds, above which frames are drawn coarsely while the user interacts.
const HEAVY_MS: f64 = 14.0;
/// Time without interaction after which a coarse picture is drawn in full.
const REST: Duration = Duration::from_millis(120);
ui::widgets! {
    /// The widgets over the picture.
    struct ViewportWidgets in "viewport.ui" {
        root: gtk::Overlay,
        tools: gtk::Box,
        tool_navigate: gtk::ToggleButton,
        tool_move: gtk::ToggleButton,
        tool_rotate: gtk::ToggleButton,
        tool_scale: gtk::ToggleButton,
        hint: gtk::Label,
        times: gtk::Label,
        drop_here: gtk::Label,
    }
}

/// What the viewport knows of the window.
pub(crate) struct ViewportHandles {
    /// The session.
    pub session: SessionHandle,
    /// What is remembered.
    pub settings: SettingsHandle,
    /// Where the pointer and the size of the picture are told.
    pub status: StatusLine,
    /// Drives flight.
    pub clock: FrameClock,
    /// Gives the keyboard to the picture.
    pub focus: PictureFocus,
    /// Takes the place that is picked for the end of a muscle.
    pub editor: Editor,
    /// The page of muscles: while it is looked at, the picture shows the dots of their ends.
    pub muscle_page: glib::WeakRef<gtk::Widget>,
}

/// The picture with what stands over it.
pub(crate) struct Viewport {
    /// The whole.
    pub root: gtk::Overlay,
    canvas: PaintWidget,
    screen: Rc<RefCell<FrameSurface>>,
    widgets: ViewportWidgets,
    transform_fields: TransformFields,
    input: input::ViewportInput,
    handles: ViewportHandles,
}

impl Viewport {
    /// The viewport of a session, from its `.ui` file.
    pub(crate) fn new(builder: gtk::Builder, handles: ViewportHandles) -> Rc<Self> {
        let widgets = ViewportWidgets::of(&builder);
        let root = widgets.root.clone();
        let canvas = PaintWidget::named(&tr!("app-viewport"), 150, 150);
        canvas.set_focusable(true);
        canvas.add_css_class("scene");
        handles.focus.set_picture(&canvas);
        root.set_child(Some(&canvas));
        for (button, icon) in [
            (&widgets.tool_navigate, Icon::Navigate),
            (&widgets.tool_move, Icon::Move),
            (&widgets.tool_rotate, Icon::Rotate),
            (&widgets.tool_scale, Icon::Scale),
        ] {
            button.set_child(Some(&icons::image(icon)));
        }
        let viewport = Rc::new(Self {
            root,
            canvas,
            screen: Rc::new(RefCell::new(FrameSurface::new())),
            transform_fields: TransformFields::new(&builder),
            widgets,
            input: input::ViewportInput::default(),
            handles,
        });
        viewport.connect();
        viewport
    }

    /// Connects painter and input.
    fn connect(self: &Rc<Self>) {
        let weak = Rc::downgrade(self);
        self.canvas.set_painter(move |_, snapshot, width, height| {
            if let Some(viewport) = weak.upgrade() {
                viewport.paint(snapshot, width, height);
            }
        });
        let weak = Rc::downgrade(self);
        self.canvas.set_resized(move |width, height| {
            if let Some(viewport) = weak.upgrade() {
                viewport.session().update(|session| session.set_aspect(width as f32 / height.max(1) as f32));
                viewport.invalidate();
                viewport.fit_later(width);
            }
        });
        self.transform_fields.connect(self.session());
        input::connect(self, &self.canvas);
        let weak = Rc::downgrade(self);
        self.handles.clock.drive(move |seconds| weak.upgrade().is_some_and(|viewport| input::fly(&viewport, seconds)));
        let weak = Rc::downgrade(self);
        self.session().observe(move |changes| {
            if let Some(viewport) = weak.upgrade().filter(|_| moves_what_is_seen(changes)) {
                input::refresh_hover(&viewport);
            }
        });
        self.show_times(self.handles.settings.borrow().frame_times);
    }

    /// The session that is shown.
    pub(crate) fn session(&self) -> &SessionHandle {
        &self.handles.session
    }

    /// Whether the page of muscles is looked at; then the picture shows the dots of their ends.
    fn shows_muscles(&self) -> bool {
        self.handles.muscle_page.upgrade().is_some_and(|page| page.is_mapped())
    }

    /// Shows what changed.
    pub(crate) fn refresh(&self, session: &mut Session, changes: ChangeSet) {
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
            self.widgets.tools.set_visible(!session.is_empty());
        }
    }

    /// The picture is no longer true.
    pub(crate) fn invalidate(&self) {
        self.screen.borrow_mut().fresh = false;
        self.canvas.queue_draw();
    }

    /// Lets what stands over the picture follow its width, once widgets have their places.
    fn fit_later(&self, width: i32) {
        let transform_fields = self.transform_fields.clone();
        glib::idle_add_local_once(move || transform_fields.fit(width));
    }

    /// What stands over the picture is no longer true.
    pub(crate) fn draw_over(&self) {
        self.canvas.queue_draw();
    }

    /// Logical width and height.
    pub(crate) fn size(&self) -> (i32, i32) {
        (self.canvas.width(), self.canvas.height())
    }

    /// Pixels of the device a logical pixel.
    pub(crate) fn scale(&self) -> i32 {
        self.canvas.scale_factor()
    }

    /// What lies under a point, logical pixels.
    pub(crate) fn pick(&self, session: &mut Session, x: f64, y: f64) -> Option<PickHit> {
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
    pub(crate) fn with_renderer<T>(&self, work: impl FnOnce(&mut Renderer) -> T) -> T {
        work(&mut self.screen.borrow_mut().renderer)
    }

    /// Says for a while what a drag does.
    pub(crate) fn hint(&self, text: &str) {
        let label = &self.widgets.hint;
        ui::set_label(label, text);
        label.set_visible(!text.is_empty());
    }

    /// Whether frame times stand over the picture.
    pub(crate) fn show_times(&self, shown: bool) {
        self.widgets.times.set_visible(shown);
        self.invalidate();
    }

    /// The mark of the place where files can be dropped.
    pub(crate) fn drop_mark(&self) -> gtk::Label {
        self.widgets.drop_here.clone()
    }

    /// Flies, or lands.
    pub(crate) fn toggle_flight(&self) {
        self.input.toggle_flight(self.session());
    }

    /// Releases all keys of flight.
    pub(crate) fn release_flight_keys(&self) {
        self.input.release_flight_keys();
    }

    /// Takes a key in flight; whether it was one of flight's.
    pub(crate) fn flight_key(&self, letter: Option<char>, key: gtk::gdk::Key, pressed: bool) -> bool {
        input::flight_key(self, letter, key, pressed)
    }

    /// Draws what is stale and shows it.
    fn paint(self: &Rc<Self>, snapshot: &gtk::Snapshot, width: f64, height: f64) {
        let (screen, canvas) = (&self.screen, &self.canvas);
        let scale = canvas.scale_factor();
        let (pixel_width, pixel_height) = (width as i32 * scale, height as i32 * scale);
        let was_fresh = screen.borrow().is_fresh(pixel_width, pixel_height);
        if !was_fresh {
            // Most frames were posed before they are painted: the panels show the moment too.
            let pose_ms = self.session().read(|session| {
                session.frame();
                session.take_posing_ms()
            });
            let begun = Instant::now();
            let mut screen = screen.borrow_mut();
            let coarse = screen.full_ms > HEAVY_MS && self.input.is_dragging();
            let drawn = self.session().read(|session| screen.draw(session, pixel_width, pixel_height, scale, coarse));
            let total_ms = pose_ms + begun.elapsed().as_secs_f64() * 1e3;
            if let Some(stats) = drawn {
                if !coarse {
                    screen.full_ms = total_ms;
                }
                drop(screen);
                if coarse {
                    draw_in_full_when_at_rest(Rc::downgrade(self));
                }
                // Labels must not change while the frame is being put together.
                let weak = Rc::downgrade(self);
                glib::idle_add_local_once(move || {
                    if let Some(viewport) = weak.upgrade() {
                        viewport.show_stats(pose_ms, total_ms, stats);
                    }
                });
            }
        }
        let context = cairo_over(snapshot, width, height);
        screen.borrow().show(&context, scale);
        drop(context);
        self.session().read(|session| {
            if session.bone_names() {
                bone_names::write_all(session, canvas, snapshot, width, height);
            }
            if !session.is_empty() {
                let input = &self.input;
                orientation_gizmo::draw(session, canvas, snapshot, height, input.pointer());
                legend::draw(session, canvas, snapshot, width, height);
                bounding_box_labels::draw(session, canvas, snapshot, width, height);
                labels::draw(session, canvas, snapshot, width, height);
                if session.display().light_marker {
                    light_gizmo::draw(session, snapshot, width, height);
                }
                let colors = session.display().palette.axes;
                session.with_gizmo(DVec2::new(width, height), |shown| tool_gizmo::draw(shown, colors, input.handle(), canvas, snapshot));
                if self.shows_muscles() && session.tool() == Tool::Navigate {
                    let size = DVec2::new(width, height);
                    let shown = attachment_overlay::Shown { handles: session.attachment_handles(size), wraps: session.wrap_outlines(size) };
                    attachment_overlay::draw(&shown, input.dot(), canvas, snapshot, (width, height));
                }
            }
        });
    }

    /// Frame times and counts.
    fn show_stats(&self, pose_ms: f64, total_ms: f64, stats: Stats) {
        self.handles.status.show_size(stats.triangles);
        let label = &self.widgets.times;
        if label.is_visible() {
            let rate = self.screen.borrow().rate();
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
}

/// Whether something else may have come to lie under a resting pointer.
fn moves_what_is_seen(changes: ChangeSet) -> bool {
    changes.any(
        ChangeSet::CAMERA
            | ChangeSet::TIME
            | ChangeSet::DOCUMENT
            | ChangeSet::MODEL
            | ChangeSet::JOINT_OVERRIDES
            | ChangeSet::EDIT
            | ChangeSet::DRIVE,
    )
}

/// What drags and keys do at present.
fn hint(session: &Session) -> String {
    if let Some(picking) = session.picking() {
        return tr!(match picking.target {
            PickTarget::Point(AttachmentPoint::End(0)) => "app-hint-pick-origin",
            PickTarget::Point(AttachmentPoint::End(_)) => "app-hint-pick-insertion",
            PickTarget::Point(AttachmentPoint::Wrap(_)) => "app-hint-pick-wrap",
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

fn draw_in_full_when_at_rest(weak: Weak<Viewport>) {
    glib::timeout_add_local_once(REST, move || {
        if let Some(viewport) = weak.upgrade().filter(|viewport| !viewport.input.is_dragging()) {
            viewport.invalidate();
        }
    });
}

/// Cairo's own words are of no use to a person; a picture that could not be shown is drawn again with the next change.
fn ignore(result: Result<(), cairo::Error>) {
    let _ = result;
}

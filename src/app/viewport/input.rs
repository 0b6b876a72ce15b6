//! Pointer and keyboard input of the viewport: orbit, pan, zoom, fly, gizmo dragging, picking.

use std::cell::{Cell, RefCell};
use std::collections::HashSet;
use std::rc::Rc;
use std::time::Duration;

use glam::{DVec2, Vec3};
use gtk::prelude::*;
use gtk::{gdk, glib};
use gtk4 as gtk;

use super::{Viewport, orientation_gizmo, zoom_gestures};
use crate::app::format;
use crate::app::handles::session_handle::SessionHandle;
use crate::app::widgets::drawing_area::PaintWidget;
use crate::i18n;
use crate::message;
use crate::muscle::AttachmentPoint;
use crate::session::{AttachmentDrag, AttachmentHandle as Dot, GizmoHandle, ModelDrag, Session, Tool, UndoStep, Viewpoint};
use crate::tr;

/// Degrees that a drag over one logical pixel turns.
const DEGREES: f32 = 0.4;
/// How long the picture must rest before it is asked what lies under a pointer that rests.
const AT_REST: Duration = Duration::from_millis(120);

/// What a drag does, decided when it begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum DragAction {
    Orbit,
    Pan,
    Zoom,
    Light,
    Model,
    Look,
    /// A dot of a muscle.
    Dot,
}

/// State of pointer and keyboard input.
#[derive(Default)]
pub(super) struct ViewportInput {
    grip: Cell<Option<DragAction>>,
    last: Cell<(f64, f64)>,
    moved: Cell<bool>,
    pointer: Cell<Option<(f64, f64)>>,
    /// The handle of the tool that is under the pointer or held.
    handle: Cell<Option<GizmoHandle>>,
    model: Cell<Option<ModelDrag>>,
    /// The dot of a muscle that is under the pointer or held.
    dot: Cell<Option<AttachmentPoint>>,
    dragged: Cell<Option<AttachmentDrag>>,
    /// Counts changes of what is under the pointer.
    pictures: Cell<u32>,
    /// Whether it is waited for the picture to rest.
    waiting: Cell<bool>,
    held: RefCell<HashSet<char>>,
    pace: Cell<(bool, bool)>,
}

impl ViewportInput {
    /// Whether a drag is under way.
    pub(super) fn is_dragging(&self) -> bool {
        self.grip.get().is_some()
    }

    /// Where the pointer is, logical pixels.
    pub(super) fn pointer(&self) -> Option<(f64, f64)> {
        self.pointer.get()
    }

    /// The handle of the tool that is under the pointer or held.
    pub(super) fn handle(&self) -> Option<GizmoHandle> {
        self.handle.get()
    }

    /// The dot of a muscle that is under the pointer or held.
    pub(super) fn dot(&self) -> Option<AttachmentPoint> {
        self.dot.get()
    }

    /// Flies, or lands.
    pub(super) fn toggle_flight(&self, session: &SessionHandle) {
        self.held.borrow_mut().clear();
        session.update(|session| {
            session.change_camera(|controller| if controller.flying().is_some() { controller.exit_fly() } else { controller.fly() })
        });
    }

    /// Lets go of a drag that turned out to be none: the first of two fingers had begun it.
    pub(super) fn drop_drag(&self) {
        self.grip.set(None);
        self.moved.set(true);
    }

    /// Releases all keys of flight, because keys that are released elsewhere send no event.
    pub(super) fn release_flight_keys(&self) {
        self.held.borrow_mut().clear();
        self.pace.set((false, false));
    }
}

/// Takes a key in flight; whether it was one of flight's.
pub(super) fn flight_key(viewport: &Viewport, letter: Option<char>, key: gdk::Key, pressed: bool) -> bool {
    let input = &viewport.input;
    if !viewport.session().read(|session| matches!(session.camera_controller().viewpoint(), Viewpoint::Fly(_))) {
        return false;
    }
    let (fast, slow) = input.pace.get();
    match (key, letter) {
        (gdk::Key::Escape, _) if pressed => viewport.toggle_flight(),
        (gdk::Key::Shift_L | gdk::Key::Shift_R, _) => input.pace.set((pressed, slow)),
        (gdk::Key::Alt_L | gdk::Key::Alt_R, _) => input.pace.set((fast, pressed)),
        (_, Some(letter @ ('w' | 'a' | 's' | 'd' | 'q' | 'e'))) => {
            if pressed {
                input.held.borrow_mut().insert(letter)
            } else {
                input.held.borrow_mut().remove(&letter)
            };
            viewport.handles.clock.request();
        }
        _ => return false,
    }
    true
}

/// Flies on for `seconds`; whether a key is held.
pub(super) fn fly(viewport: &Viewport, seconds: f64) -> bool {
    let input = &viewport.input;
    if input.held.borrow().is_empty() {
        return false;
    }
    // A flight that ended otherwise than by landing left its keys held.
    if !viewport.session().read(|session| matches!(session.camera_controller().viewpoint(), Viewpoint::Fly(_))) {
        input.release_flight_keys();
        return false;
    }
    let held = input.held.borrow();
    let along = |plus: char, minus: char| f32::from(u8::from(held.contains(&plus))) - f32::from(u8::from(held.contains(&minus)));
    let direction = Vec3::new(along('d', 'a'), along('e', 'q'), along('w', 's'));
    let (fast, slow) = input.pace.get();
    let pace = if fast { 4.0 } else { 1.0 } / if slow { 4.0 } else { 1.0 };
    viewport.session().update(|session| {
        session.change_camera(|controller| {
            if let Some(fly) = controller.flying() {
                fly.move_by(direction * pace, seconds.min(0.1) as f32);
            }
        });
    });
    true
}

/// Connects everything to the canvas.
pub(super) fn connect(viewport: &Rc<Viewport>, canvas: &PaintWidget) {
    connect_drag(viewport, canvas);
    connect_clicks(viewport, canvas);
    zoom_gestures::connect(viewport, canvas);
    connect_pointer(viewport, canvas);
}

fn connect_drag(viewport: &Rc<Viewport>, canvas: &PaintWidget) {
    let drag = gtk::GestureDrag::new();
    drag.set_button(0);
    drag.connect_drag_begin(glib::clone!(
        #[weak]
        viewport,
        move |gesture, x, y| {
            let input = &viewport.input;
            viewport.handles.focus.take();
            let state = gesture.current_event_state();
            let shift = state.contains(gdk::ModifierType::SHIFT_MASK);
            let control = state.contains(gdk::ModifierType::CONTROL_MASK);
            let (tool, flying) =
                viewport.session().read(|session| (session.tool(), matches!(session.camera_controller().viewpoint(), Viewpoint::Fly(_))));
            let (point, size) = (DVec2::new(x, y), picture_size(&viewport));
            let handle = if gesture.current_button() == gdk::BUTTON_PRIMARY && !shift && !flying {
                viewport.session().read(|session| session.with_gizmo(size, |handles| handles.handle_at(point))).flatten()
            } else {
                None
            };
            let plain = gesture.current_button() == gdk::BUTTON_PRIMARY && !shift && !control && !flying;
            let dot = if plain { dot_at(&viewport, point) } else { None };
            input.dot.set(dot.map(|dot| dot.attachment));
            input.dragged.set(dot.map(|dot| AttachmentDrag {
                muscle: viewport.session().read(|session| session.shown_muscle()),
                handle: dot,
                from: point,
            }));
            let grip = match gesture.current_button() {
                _ if dot.is_some() => DragAction::Dot,
                _ if handle.is_some() => DragAction::Model,
                gdk::BUTTON_SECONDARY if shift => {
                    viewport.session().update(Session::reset_light);
                    return;
                }
                gdk::BUTTON_SECONDARY => DragAction::Light,
                gdk::BUTTON_PRIMARY | gdk::BUTTON_MIDDLE if flying => DragAction::Look,
                gdk::BUTTON_PRIMARY | gdk::BUTTON_MIDDLE if shift => DragAction::Pan,
                gdk::BUTTON_PRIMARY | gdk::BUTTON_MIDDLE if control => DragAction::Zoom,
                gdk::BUTTON_PRIMARY if tool != Tool::Navigate => DragAction::Model,
                gdk::BUTTON_PRIMARY | gdk::BUTTON_MIDDLE => DragAction::Orbit,
                _ => return,
            };
            if grip == DragAction::Model {
                let start = viewport.session().read(|session| *session.model());
                input.handle.set(handle);
                input.model.set(Some(ModelDrag { handle: handle.unwrap_or(GizmoHandle::Free), start, from: point }));
            }
            input.grip.set(Some(grip));
            input.last.set((0.0, 0.0));
            input.moved.set(false);
        }
    ));
    drag.connect_drag_update(glib::clone!(
        #[weak]
        viewport,
        move |gesture, x, y| drag_on(&viewport, x, y, gesture.current_event_state().contains(gdk::ModifierType::CONTROL_MASK))
    ));
    drag.connect_drag_end(glib::clone!(
        #[weak]
        viewport,
        move |_, _, _| {
            let input = &viewport.input;
            if input.grip.replace(None).is_some() && input.moved.get() {
                viewport.session().update(|session| session.change_display(|display| display.light_marker = false));
                viewport.invalidate();
            }
        }
    ));
    canvas.add_controller(drag);
}

/// The dot of the shown muscle at a place of the picture, where dots are shown.
fn dot_at(viewport: &Rc<Viewport>, place: DVec2) -> Option<Dot> {
    if !viewport.shows_muscles() {
        return None;
    }
    let size = picture_size(viewport);
    viewport.session().read(|session| if session.tool() == Tool::Navigate { session.attachment_handle_at(place, size) } else { None })
}

/// Logical width and height of the picture.
fn picture_size(viewport: &Rc<Viewport>) -> DVec2 {
    let (width, height) = viewport.size();
    DVec2::new(f64::from(width.max(1)), f64::from(height.max(1)))
}

fn drag_on(viewport: &Rc<Viewport>, x: f64, y: f64, snap: bool) {
    let input = &viewport.input;
    let Some(grip) = input.grip.get() else { return };
    // A click that trembles is no drag.
    let mut step = UndoStep::Same;
    if !input.moved.get() {
        if x.abs().max(y.abs()) < 4.0 {
            return;
        }
        input.moved.set(true);
        step = UndoStep::New;
    }
    let (last_x, last_y) = input.last.replace((x, y));
    let (dx, dy) = (x - last_x, y - last_y);
    let height = f64::from(viewport.size().1.max(1));
    let (degrees_x, degrees_y) = (dx as f32 * DEGREES, dy as f32 * DEGREES);
    viewport.session().update(|session| match grip {
        DragAction::Orbit => session.change_camera(|controller| controller.change(|orbit| orbit.orbit(-degrees_x, degrees_y))),
        DragAction::Pan => session.change_camera(|controller| controller.change(|orbit| zoom_gestures::pan(orbit, (dx, dy), height))),
        DragAction::Zoom => session.change_camera(|controller| controller.change(|orbit| orbit.zoom((-dy / height * 3.0).exp() as f32))),
        DragAction::Look => session.change_camera(|controller| {
            if let Some(fly) = controller.flying() {
                fly.rotate(-degrees_x * 0.6, degrees_y * 0.6);
            }
        }),
        DragAction::Light => {
            session.undoable(message!("app-edit-light"), step, |session| session.rotate_light(degrees_x, -degrees_y));
            session.change_display(|display| display.light_marker = true);
        }
        DragAction::Model => {
            if let Some(drag) = input.model.get() {
                let (what, to) = (message!(session.tool().edit()), drag.from + DVec2::new(x, y));
                session.undoable(what, step, |session| session.drag_model(&drag, to, picture_size(viewport), snap));
            }
        }
        DragAction::Dot => {
            if let Some(drag) = input.dragged.get() {
                // Where the end cannot be it stays where it was.
                let _ = session.drag_attachment(&drag, drag.from + DVec2::new(x, y), picture_size(viewport), step);
            }
        }
    });
}

fn connect_clicks(viewport: &Rc<Viewport>, canvas: &PaintWidget) {
    let click = gtk::GestureClick::new();
    click.set_button(gdk::BUTTON_PRIMARY);
    click.connect_released(glib::clone!(
        #[weak]
        viewport,
        move |gesture, presses, x, y| {
            let plain = !gesture.current_event_state().intersects(gdk::ModifierType::SHIFT_MASK | gdk::ModifierType::CONTROL_MASK);
            if viewport.input.moved.get() || !plain {
                return;
            }
            let height = f64::from(viewport.size().1);
            if let Some(view) = viewport
                .session()
                .read(|session| orientation_gizmo::hit(&session.picture().2, x, y, height))
                .filter(|_| !viewport.session().read(|s| s.is_empty()))
            {
                return viewport.session().update(|session| session.change_camera(|controller| controller.look_from(view)));
            }
            if viewport.session().read(|session| session.picking().is_some()) {
                viewport.handles.editor.tell(|session| {
                    let pick = viewport.pick(session, x, y);
                    session.pick_at(pick)
                });
                return;
            }
            // A click on a dot is for the dot.
            if viewport.input.dot.get().is_some() {
                return;
            }
            viewport.session().update(|session| {
                let pick = viewport.pick(session, x, y);
                let place = pick.map(|pick| pick.point);
                session.point_at(pick);
                if let (true, Some(place)) = (presses == 2, place) {
                    session.centre_at(place);
                }
            });
        }
    ));
    canvas.add_controller(click);
}

fn connect_pointer(viewport: &Rc<Viewport>, canvas: &PaintWidget) {
    let motion = gtk::EventControllerMotion::new();
    motion.connect_motion(glib::clone!(
        #[weak]
        viewport,
        move |_, x, y| {
            let input = &viewport.input;
            // GTK repeats the last place when something under a still pointer changes.
            if input.pointer.replace(Some((x, y))) == Some((x, y)) || input.is_dragging() {
                return;
            }
            let (size, before) = (picture_size(&viewport), input.handle.get());
            input
                .handle
                .set(viewport.session().read(|session| session.with_gizmo(size, |handles| handles.handle_at(DVec2::new(x, y)))).flatten());
            let (dot_before, dot) = (input.dot.get(), dot_at(&viewport, DVec2::new(x, y)).map(|dot| dot.attachment));
            input.dot.set(dot);
            if dot != dot_before {
                viewport.draw_over();
            }
            // Over the axes in the corner, and when it leaves them, what stands over the picture looks different.
            if input.handle.get() != before || x < 100.0 && y > size.y - 100.0 {
                viewport.draw_over();
            }
            point(&viewport, x, y);
        }
    ));
    motion.connect_leave(glib::clone!(
        #[weak]
        viewport,
        move |_| {
            viewport.input.pointer.set(None);
            viewport.session().update(|session| session.hover(None));
            viewport.handles.status.show_position("");
        }
    ));
    canvas.add_controller(motion);
}

/// Highlights what is under the pointer, and says what and where it is.
fn point(viewport: &Rc<Viewport>, x: f64, y: f64) {
    let mut text = String::new();
    viewport.session().update(|session| {
        let found = viewport.pick(session, x, y);
        session.hover(found.map(|pick| pick.node));
        if let Some(pick) = found {
            let [x, y, z] = pick.point.to_array().map(|value| format::number(f64::from(value), 3));
            let name = i18n::label(session.document().scene.graph.label(pick.node)).into_owned();
            text = tr!("app-status-position", x = x, y = y, z = z, name = name);
        }
    });
    viewport.handles.status.show_position(&text);
}

/// The scene changed under a resting pointer: the hover text is outdated and is shown again once the picture rests too.
pub(super) fn refresh_hover(viewport: &Rc<Viewport>) {
    let input = &viewport.input;
    if input.pointer.get().is_none() {
        return;
    }
    viewport.handles.status.show_position("");
    input.pictures.set(input.pictures.get().wrapping_add(1));
    // One wait at a time, however many pictures go by.
    if !input.waiting.replace(true) {
        wait_for_rest(viewport);
    }
}

fn wait_for_rest(viewport: &Rc<Viewport>) {
    let (weak, number) = (Rc::downgrade(viewport), viewport.input.pictures.get());
    glib::timeout_add_local_once(AT_REST, move || {
        let Some(viewport) = weak.upgrade() else { return };
        let input = &viewport.input;
        if input.pictures.get() != number {
            return wait_for_rest(&viewport);
        }
        input.waiting.set(false);
        if let Some((x, y)) = input.pointer.get().filter(|_| !input.is_dragging()) {
            point(&viewport, x, y);
        }
    });
}

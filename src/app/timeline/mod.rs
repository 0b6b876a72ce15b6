//! The timeline: transport, clip, speed, the track that seeks wherever it is clicked, and the boxes for exact moments.
//!
//! The track is drawn by [`Track`]; under it lies a scale without looks, so that the keyboard and assistive tools find an ordinary slider
//! named *Time*. Below it unfolds the [`curve_editor`], on the same [`time_axis`].

mod curve_editor;
mod curve_plot;
mod time_axis;
mod timeline_ruler;

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use gtk::prelude::*;
use gtk::{gdk, glib};
use gtk4 as gtk;

use self::curve_editor::CurveEditor;
use self::time_axis::{TimeAxis, hold_while};
use self::timeline_ruler::{Track, frame_of};
use crate::animation::LoopMode;
use crate::app::commands::Command;
use crate::app::format;
use crate::app::handles::session_handle::SessionHandle;
use crate::app::widgets::drawing_area::PaintWidget;
use crate::app::widgets::icons::{self, Icon};
use crate::app::widgets::ui;
use crate::i18n;
use crate::session::{ChangeSet, RangeMark, Session};
use crate::tr;

/// The frame rates to choose from, beside the one that the keys tell.
const RATES: [f64; 9] = [12.0, 15.0, 24.0, 25.0, 30.0, 48.0, 50.0, 60.0, 120.0];

/// A menu of more clips than this can be searched.
const MANY: usize = 12;

/// What a drag on the track moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum RulerDrag {
    /// The present moment.
    Seek,
    /// A mark.
    Mark(RangeMark),
    /// Both marks: what lies between the ends of the drag.
    Range,
}

ui::widgets! {
    /// The widgets of the timeline.
    struct TimelineWidgets from "timeline.ui" {
        root: gtk::Box,
        track: gtk::Overlay,
        previous_key: gtk::Button,
        next_key: gtk::Button,
        frame_back: gtk::Button,
        frame_forward: gtk::Button,
        unfold: gtk::ToggleButton,
        play_image: gtk::Image,
        loop_mode: gtk::Button,
        clip: gtk::DropDown,
        speed: gtk::SpinButton,
        time: gtk::Scale,
        seconds: gtk::SpinButton,
        frame: gtk::SpinButton,
        rate: gtk::DropDown,
    }
}

/// The timeline.
pub(crate) struct Timeline {
    /// The whole.
    pub root: gtk::Box,
    widgets: TimelineWidgets,
    /// What is unfolded below the track.
    pub sheet: Rc<CurveEditor>,
    /// The time axis of the track and of what lies below it.
    pub axis: TimeAxis,
    canvas: PaintWidget,
    track: Rc<RefCell<Track>>,
}

impl Timeline {
    /// The timeline of a session.
    pub(crate) fn new(session: &SessionHandle) -> Self {
        let widgets = TimelineWidgets::build();
        let canvas = PaintWidget::new(160, 72);
        widgets.track.set_child(Some(&canvas));
        for (button, icon) in [
            (&widgets.previous_key, Icon::PreviousKey),
            (&widgets.next_key, Icon::NextKey),
            (&widgets.frame_back, Icon::FrameBack),
            (&widgets.frame_forward, Icon::FrameForward),
        ] {
            button.set_child(Some(&icons::image(icon)));
        }
        widgets.unfold.set_child(Some(&icons::image(Icon::DopeSheet)));
        let axis = TimeAxis::new(Track { empty: tr!("app-no-animation"), second: tr!("app-unit-s"), ..Track::default() });
        let track = axis.track.clone();
        let painted = track.clone();
        canvas.set_painter(move |canvas, snapshot, width, height| painted.borrow().paint(canvas, snapshot, width, height));
        // Exporters make clip names that are longer than the window is wide.
        ui::narrow(&widgets.clip, 12);
        let sheet = CurveEditor::new(session, &axis, &canvas);
        widgets.root.append(&sheet.root);
        axis.connect_changed(glib::clone!(
            #[weak]
            canvas,
            #[weak]
            sheet,
            move || {
                canvas.queue_draw();
                sheet.draw_anew();
            }
        ));
        let timeline = Self { root: widgets.root.clone(), widgets, sheet, axis, canvas, track };
        timeline.connect(session);
        timeline
    }

    /// What lies over the track.
    pub(crate) fn over_track(&self) -> gtk::Overlay {
        self.widgets.track.clone()
    }

    /// Whether a widget is the timeline itself, on which the keys of playing mean what they mean everywhere.
    pub(crate) fn is_track(&self, widget: &gtk::Widget) -> bool {
        self.widgets.time.upcast_ref::<gtk::Widget>() == widget
    }

    fn connect(&self, session: &SessionHandle) {
        self.connect_track(session);
        self.widgets.rate.connect_selected_notify(glib::clone!(
            #[weak]
            session,
            move |list| {
                let chosen = (list.selected() as usize).checked_sub(1).and_then(|place| RATES.get(place));
                session.update(|session| session.choose_rate(chosen.copied()));
            }
        ));
        for (widget, of_frame) in [(&self.widgets.seconds, false), (&self.widgets.frame, true)] {
            widget.connect_value_changed(glib::clone!(
                #[weak]
                session,
                move |number| {
                    let value = number.value();
                    session.update(|session| {
                        let rate = session.frame_rate();
                        session.time(|time| time.seek(if of_frame { value / rate } else { value }));
                    });
                }
            ));
        }
        self.widgets.time.connect_value_changed(glib::clone!(
            #[weak]
            session,
            move |scale| session.update(|session| session.time(|time| time.seek(scale.value())))
        ));
        self.widgets.speed.connect_value_changed(glib::clone!(
            #[weak]
            session,
            move |number| {
                let speed = number.value();
                // Zero lies on the way from forwards to backwards and is passed over.
                if speed.abs() >= *crate::animation::Playback::SPEED.start() {
                    session.update(|session| session.time(|time| time.speed = speed));
                }
            }
        ));
        self.widgets.clip.connect_selected_notify(glib::clone!(
            #[weak]
            session,
            move |list| {
                let chosen = list.selected();
                if chosen != gtk::INVALID_LIST_POSITION {
                    session.update(|session| session.set_clip(Some(chosen as usize)));
                }
            }
        ));
    }

    fn connect_track(&self, session: &SessionHandle) {
        let drag = gtk::GestureDrag::new();
        let track = self.track.clone();
        let grip = Rc::new(Cell::new(RulerDrag::Seek));
        drag.connect_drag_begin(glib::clone!(
            #[weak]
            session,
            #[strong]
            track,
            #[weak(rename_to = time)]
            self.widgets.time,
            #[strong]
            grip,
            move |gesture, x, y| {
                time.grab_focus();
                // A hand that is on it needs no frame round it.
                track.borrow_mut().focused = false;
                let width = gesture.widget().map_or(0.0, |canvas| f64::from(canvas.width()));
                let mark = track.borrow().mark_at(x, y, width);
                let shift = gesture.current_event_state().contains(gdk::ModifierType::SHIFT_MASK);
                grip.set(match mark {
                    Some(mark) => RulerDrag::Mark(mark),
                    None if shift => RulerDrag::Range,
                    None => RulerDrag::Seek,
                });
                if grip.get() == RulerDrag::Seek {
                    seek(&session, &track, gesture, x);
                }
            }
        ));
        hold_while(&drag, session);
        drag.connect_drag_update(glib::clone!(
            #[weak]
            session,
            #[strong]
            track,
            #[strong]
            grip,
            move |gesture, dx, _| {
                let (Some((x, _)), Some(canvas)) = (gesture.start_point(), gesture.widget()) else { return };
                let moment = |x: f64| track.borrow().time_at(x, f64::from(canvas.width()));
                let (from, to) = (moment(x), moment(x + dx));
                match grip.get() {
                    RulerDrag::Seek => seek(&session, &track, gesture, x + dx),
                    RulerDrag::Mark(mark) => session.update(|session| session.set_mark(mark, to)),
                    RulerDrag::Range if dx.abs() > 3.0 => session.update(|session| session.set_marks(from, to)),
                    RulerDrag::Range => {}
                }
            }
        ));
        self.canvas.add_controller(drag);
        let motion = gtk::EventControllerMotion::new();
        let point = |track: &Rc<RefCell<Track>>, canvas: &PaintWidget, x: Option<f64>| {
            track.borrow_mut().pointer = x;
            canvas.queue_draw();
        };
        motion.connect_motion(glib::clone!(
            #[strong]
            track,
            #[weak(rename_to = canvas)]
            self.canvas,
            move |_, x, _| point(&track, &canvas, Some(x))
        ));
        motion.connect_leave(glib::clone!(
            #[strong]
            track,
            #[weak(rename_to = canvas)]
            self.canvas,
            move |_| point(&track, &canvas, None)
        ));
        self.canvas.add_controller(motion);
        let wheel = gtk::EventControllerScroll::new(gtk::EventControllerScrollFlags::VERTICAL | gtk::EventControllerScrollFlags::DISCRETE);
        wheel.connect_scroll(glib::clone!(
            #[weak]
            session,
            #[strong]
            track,
            #[strong(rename_to = axis)]
            self.axis,
            #[upgrade_or]
            glib::Propagation::Proceed,
            move |controller, _, dy| {
                let width = controller.widget().map_or(1.0, |canvas| f64::from(canvas.width()));
                let about = {
                    let track = track.borrow();
                    track.pointer.map(|x| track.time_at(x, width))
                };
                if axis.wheel(controller.current_event_state(), dy, about) == glib::Propagation::Proceed {
                    session.update(|session| session.step_frames(if dy > 0.0 { 1 } else { -1 }));
                }
                glib::Propagation::Stop
            }
        ));
        self.canvas.add_controller(wheel);
        self.widgets.time.connect_has_focus_notify(glib::clone!(
            #[strong]
            track,
            #[weak(rename_to = canvas)]
            self.canvas,
            move |scale| {
                track.borrow_mut().focused =
                    scale.has_focus() && scale.root().and_downcast::<gtk::Window>().is_some_and(|w| w.gets_focus_visible());
                canvas.queue_draw();
            }
        ));
    }

    /// The rates, with the one that the keys tell first; listed anew only where that one changed, for a list that is open would close.
    fn list_rates(&self, session: &Session) {
        let own = tr!("app-rate-own", rate = format::number(session.own_rate(), 0));
        let listed = self.widgets.rate.model().and_downcast::<gtk::StringList>().and_then(|list| list.string(0));
        if listed.as_deref() != Some(own.as_str()) {
            let rates = RATES.map(|rate| tr!("app-rate", rate = format::number(rate, 0)));
            let words: Vec<&str> = std::iter::once(own.as_str()).chain(rates.iter().map(String::as_str)).collect();
            self.widgets.rate.set_model(Some(&ui::words(&words)));
        }
        let chosen = session.chosen_rate().and_then(|rate| RATES.iter().position(|known| *known == rate));
        self.widgets.rate.set_selected(chosen.map_or(0, |place| place as u32 + 1));
    }

    /// Shows what changed.
    pub(crate) fn refresh(&self, session: &Session, changes: ChangeSet) {
        self.show(session, changes);
        self.sheet.refresh(session, changes);
    }

    fn show(&self, session: &Session, changes: ChangeSet) {
        let playback = *session.playback();
        let rate = session.frame_rate();
        if changes.any(ChangeSet::DOCUMENT) {
            let mut names: Vec<_> = session.document().clips.iter().map(|clip| i18n::label(clip.label())).collect();
            if names.is_empty() {
                names.push("–".into());
            }
            self.widgets.clip.set_model(Some(&ui::words(&names)));
            self.widgets.clip.set_enable_search(names.len() > MANY);
        }
        if changes.any(ChangeSet::DOCUMENT | ChangeSet::PLAYBACK) {
            self.list_rates(session);
        }
        if changes.any(ChangeSet::DOCUMENT | ChangeSet::PLAYBACK) {
            self.widgets.clip.set_sensitive(!session.document().clips.is_empty());
            self.widgets.clip.set_selected(session.clip_index().map_or(0, |index| index as u32));
            let moves = playback.duration() > 0.0;
            for (widget, per_second, step) in [(&self.widgets.seconds, 1.0, 1.0 / rate), (&self.widgets.frame, rate, 1.0)] {
                widget.set_range(playback.start * per_second, playback.end * per_second);
                widget.set_increments(step, per_second);
                ui::set_sensitive(widget, moves);
            }
            // A clip that starts between two frames still shows the frame it starts in.
            self.widgets.frame.set_range(frame_of(playback.start, rate), frame_of(playback.end, rate));
            self.widgets.time.set_range(playback.start, playback.end.max(playback.start + 1e-9));
            self.widgets.time.set_increments(1.0 / rate, 1.0);
            self.widgets.time.set_sensitive(moves);
            ui::set_sensitive(&self.widgets.speed, moves);
            self.widgets.speed.set_value(playback.speed);
            self.widgets.play_image.set_icon_name(Some(if playback.playing {
                "media-playback-pause-symbolic"
            } else {
                "media-playback-start-symbolic"
            }));
            let (icon, name) = match playback.mode {
                LoopMode::Loop => ("media-playlist-repeat-symbolic", tr!("app-loop")),
                LoopMode::Once => ("media-playlist-consecutive-symbolic", tr!("app-once")),
                LoopMode::PingPong => ("object-flip-horizontal-symbolic", tr!("app-ping-pong")),
            };
            self.widgets.loop_mode.set_icon_name(icon);
            self.widgets.loop_mode.set_tooltip_text(Some(&tr!("app-loop-tip", mode = name, key = Command::LoopMode.key_label())));
        }
        if changes.any(ChangeSet::DOCUMENT | ChangeSet::PLAYBACK | ChangeSet::TIME) {
            self.widgets.time.set_value(playback.time);
            // A box that is being typed into keeps what is typed.
            for (number, value) in [(&self.widgets.seconds, playback.time), (&self.widgets.frame, frame_of(playback.time, rate))] {
                number.set_value(value);
            }
        }
        let shown = ChangeSet::DOCUMENT | ChangeSet::PLAYBACK | ChangeSet::TIME | ChangeSet::SELECTION | ChangeSet::DISPLAY;
        if changes.any(shown) {
            let mut track = self.track.borrow_mut();
            let before = track.range;
            (track.rate, track.accent) = (rate, session.display().palette.selected);
            track.show((playback.start, playback.end));
            if track.time != playback.time {
                track.time = playback.time;
                track.keep(playback.time);
            }
            track.marks = (playback.mark_a, playback.mark_b);
            if changes.any(ChangeSet::DOCUMENT | ChangeSet::PLAYBACK | ChangeSet::SELECTION) {
                track.keys = session.all_keys().to_vec();
                track.own_keys = session.own_keys().to_vec();
            }
            let turned = track.range != before;
            drop(track);
            self.canvas.queue_draw();
            if turned {
                self.sheet.draw_anew();
            }
        }
    }
}

fn seek(session: &SessionHandle, track: &Rc<RefCell<Track>>, gesture: &gtk::GestureDrag, x: f64) {
    let Some(canvas) = gesture.widget() else { return };
    if gesture.current_event().is_some_and(|event| event.event_type() == gdk::EventType::TouchCancel) {
        return;
    }
    let time = {
        let mut track = track.borrow_mut();
        track.pointer = Some(x);
        track.time_at(x, f64::from(canvas.width()))
    };
    session.update(|session| session.time(|cursor| cursor.seek(time)));
}

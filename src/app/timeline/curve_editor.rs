//! Below the track, unfolded on demand: the dope sheet with a row for each thing that the clip moves, and the curve view of one of them. Both share the
//! track's time axis, so that everything at one moment stands on one line.

use std::borrow::Cow;
use std::cell::{Cell, RefCell};
use std::rc::Rc;
use std::sync::Arc;

use gtk::prelude::*;
use gtk::{gio, glib};
use gtk4 as gtk;

use super::curve_plot::{CurvePlot, diamond};
use super::time_axis::{TimeAxis, hold_while};
use super::timeline_ruler::Track;
use crate::app::format;
use crate::app::handles::session_handle::SessionHandle;
use crate::app::settings::SheetPage;
use crate::app::widgets::drawing_area::{PaintWidget, cairo, rgb, set_color};
use crate::app::widgets::ui;
use crate::i18n;
use crate::scene::NodeId;
use crate::session::{AnimatedItem, ChangeSet, CurveGraph, GraphKind, Session, SheetRow};
use crate::tr;

/// Width of the names before the keys, logical pixels.
const NAMES: i32 = 180;
/// Height of a row.
const ROW: i32 = 22;
/// A click as near as this to a key goes to the key, logical pixels.
const NEAR: f64 = 6.0;

/// Data that the rows and both pages are painted from.
struct EditorState {
    track: Rc<RefCell<Track>>,
    track_canvas: PaintWidget,
    rows: RefCell<Arc<Vec<SheetRow>>>,
    plot: RefCell<CurvePlot>,
    pointer: Cell<Option<f64>>,
}

impl EditorState {
    /// Where the track starts in a canvas below it, and how wide it is.
    fn axis(&self, canvas: &PaintWidget) -> (f64, f64) {
        let left = self.track_canvas.translate_coordinates(canvas, 0.0, 0.0).map_or(0.0, |(x, _)| x);
        (left, f64::from(self.track_canvas.width()))
    }

    fn time_at(&self, canvas: &PaintWidget, x: f64) -> f64 {
        let (left, width) = self.axis(canvas);
        self.track.borrow().time_at(x - left, width)
    }
}

ui::widgets! {
    /// The widgets of both pages.
    struct CurveEditorWidgets from "curve_editor.ui" {
        list: gtk::ListView,
        keys_overlay: gtk::Overlay,
        curves_overlay: gtk::Overlay,
        root: gtk::Box,
        row: gtk::DropDown,
        graph: gtk::DropDown,
        values: gtk::Label,
        stack: gtk::Stack,
        nothing: gtk::Label,
        scroller: gtk::ScrolledWindow,
    }
}

/// The dope sheet and the curve view.
pub(crate) struct CurveEditor {
    /// The whole.
    pub root: gtk::Box,
    widgets: CurveEditorWidgets,
    selection: gtk::SingleSelection,
    curves: PaintWidget,
    cursors: [PaintWidget; 2],
    shown: Rc<EditorState>,
    graphs: RefCell<Vec<CurveGraph>>,
    /// The row whose curves are shown.
    moved: Cell<Option<AnimatedItem>>,
    /// The kind that the user chose.
    kind: Cell<Option<GraphKind>>,
    page: Cell<SheetPage>,
}

impl CurveEditor {
    /// That of a session, below a track with this time axis.
    pub(crate) fn new(session: &SessionHandle, axis: &TimeAxis, track_canvas: &PaintWidget) -> Rc<Self> {
        let widgets = CurveEditorWidgets::build();
        let shown = Rc::new(EditorState {
            track: axis.track.clone(),
            track_canvas: track_canvas.clone(),
            rows: RefCell::default(),
            plot: RefCell::new(CurvePlot::new(tr!("app-sheet-none"))),
            pointer: Cell::default(),
        });
        let cursor = |overlay: &gtk::Overlay| {
            let canvas = PaintWidget::new(0, 0);
            canvas.set_can_target(false);
            overlay.add_overlay(&canvas);
            let shown = shown.clone();
            canvas.set_painter(move |canvas, snapshot, width, height| paint_cursor(&shown, canvas, snapshot, width, height));
            canvas
        };
        let curves = PaintWidget::named(&tr!("app-do-curves"), 100, 100);
        widgets.curves_overlay.set_child(Some(&curves));
        let painted = shown.clone();
        curves.set_painter(move |canvas, snapshot, width, height| {
            painted.plot.borrow().paint(canvas, snapshot, (width, height), &painted.track.borrow(), painted.axis(canvas));
        });
        let selection = gtk::SingleSelection::new(None::<gio::ListModel>);
        selection.set_autoselect(false);
        selection.set_can_unselect(true);
        widgets.list.set_model(Some(&selection));
        ui::narrow(&widgets.row, 24);
        let editor = Rc::new(Self {
            root: widgets.root.clone(),
            cursors: [cursor(&widgets.keys_overlay), cursor(&widgets.curves_overlay)],
            widgets,
            selection,
            curves,
            shown,
            graphs: RefCell::default(),
            moved: Cell::default(),
            kind: Cell::default(),
            page: Cell::default(),
        });
        editor.connect(session, axis);
        editor
    }

    fn connect(self: &Rc<Self>, session: &SessionHandle, axis: &TimeAxis) {
        self.widgets.list.set_factory(Some(&factory(session, &self.shown)));
        self.selection.connect_selected_notify(glib::clone!(
            #[weak]
            session,
            #[weak(rename_to = editor)]
            self,
            move |selection| editor.take_row(&session, selection.selected())
        ));
        self.widgets.row.connect_selected_notify(glib::clone!(
            #[weak]
            session,
            #[weak(rename_to = editor)]
            self,
            move |list| editor.take_row(&session, list.selected())
        ));
        self.widgets.graph.connect_selected_notify(glib::clone!(
            #[weak]
            session,
            #[weak(rename_to = editor)]
            self,
            move |list| {
                let place = list.selected() as usize;
                session.set_widgets(|session| {
                    editor.kind.set(editor.graphs.borrow().get(place).map(|graph| graph.kind));
                    editor.show_graph(session, place);
                });
            }
        ));
        seek_by_hand(session, &self.curves, &self.shown, None);
        let motion = gtk::EventControllerMotion::new();
        let point = glib::clone!(
            #[weak]
            session,
            #[weak(rename_to = editor)]
            self,
            move |x: Option<f64>| {
                editor.shown.pointer.set(x);
                session.set_widgets(|session| editor.show_values(session));
            }
        );
        let moved = point.clone();
        motion.connect_motion(move |_, x, _| moved(Some(x)));
        motion.connect_leave(move |_| point(None));
        self.curves.add_controller(motion);
        let wheel = gtk::EventControllerScroll::new(gtk::EventControllerScrollFlags::VERTICAL | gtk::EventControllerScrollFlags::DISCRETE);
        let shown = self.shown.clone();
        wheel.connect_scroll(glib::clone!(
            #[strong]
            axis,
            #[weak(rename_to = curves)]
            self.curves,
            #[upgrade_or]
            glib::Propagation::Proceed,
            move |controller, _, dy| {
                let about = shown.pointer.get().map(|x| shown.time_at(&curves, x));
                axis.wheel(controller.current_event_state(), dy, about)
            }
        ));
        self.curves.add_controller(wheel);
    }

    /// The time axis is another one.
    pub(crate) fn draw_anew(&self) {
        self.curves.queue_draw();
        self.cursors.iter().for_each(PaintWidget::queue_draw);
        let rows = std::iter::successors(self.widgets.list.first_child(), WidgetExt::next_sibling);
        // In each row the keys stand last.
        rows.filter_map(|row| row.first_child()?.last_child()).for_each(|keys| keys.queue_draw());
    }

    /// Folds it away or shows one of its pages.
    pub(crate) fn show(&self, session: &Session, page: SheetPage) {
        self.page.set(page);
        self.root.set_visible(page != SheetPage::None);
        self.widgets.stack.set_visible_child_name(if page == SheetPage::Curves { "curves" } else { "keys" });
        self.list_rows(session);
    }

    /// Shows what changed.
    pub(crate) fn refresh(&self, session: &Session, changes: ChangeSet) {
        if self.page.get() == SheetPage::None {
            return;
        }
        if changes.any(ChangeSet::DOCUMENT | ChangeSet::PLAYBACK) {
            self.list_rows(session);
        } else if changes.any(ChangeSet::SELECTION) {
            self.follow_selection(session);
        }
        if changes.any(ChangeSet::DISPLAY) {
            self.shown.plot.borrow_mut().colors = session.display().palette.axes;
            self.curves.queue_draw();
        }
        if changes.any(ChangeSet::DOCUMENT | ChangeSet::PLAYBACK | ChangeSet::TIME) {
            self.show_values(session);
        }
    }

    fn list_rows(&self, session: &Session) {
        let rows = session.sheet_rows();
        if self.page.get() == SheetPage::None {
            return;
        }
        if !Arc::ptr_eq(&self.shown.rows.borrow(), &rows) {
            let name = |row: &SheetRow| session.sheet_label(row.item).map_or(Cow::Borrowed("–"), i18n::label);
            let names: Vec<_> = rows.iter().map(name).collect();
            let model = ui::words(&names);
            self.shown.rows.replace(rows.clone());
            self.selection.set_model(Some(&model));
            self.widgets.row.set_model(Some(&model));
            self.moved.set(None);
        }
        for list in [&self.widgets.row, &self.widgets.graph] {
            list.set_visible(self.page.get() == SheetPage::Curves && !rows.is_empty());
        }
        // Nothing to scroll, nothing for the keyboard.
        self.widgets.scroller.set_focusable(!rows.is_empty());
        self.widgets.nothing.set_visible(rows.is_empty());
        self.shown.plot.borrow_mut().colors = session.display().palette.axes;
        self.follow_selection(session);
        self.show_values(session);
    }

    /// The row of the selected node; without one the curves stay where they are, or show the first row in which anything happens.
    fn follow_selection(&self, session: &Session) {
        let rows = self.shown.rows.borrow();
        let selected = session.selected().and_then(|node| rows.iter().position(|row| row.item == AnimatedItem::Node(node)));
        self.selection.set_selected(selected.map_or(gtk::INVALID_LIST_POSITION, |place| place as u32));
        if let Some(place) = selected {
            ui::scroll_to(&self.widgets.list, place as u32);
        }
        let kept = self.moved.get().and_then(|moved| rows.iter().position(|row| row.item == moved));
        let moves = |row: &SheetRow| session.sheet_graphs(row.item).iter().any(CurveGraph::moves);
        let first = || rows.iter().position(moves).or(if rows.is_empty() { None } else { Some(0) });
        let place = selected.or(kept).or_else(first);
        drop(rows);
        self.show_row(session, place);
    }

    /// Shows the curves of a row.
    fn show_row(&self, session: &Session, place: Option<usize>) {
        let row = place.and_then(|place| self.shown.rows.borrow().get(place).map(|row| row.item));
        if let Some(place) = place {
            self.widgets.row.set_selected(place as u32);
        }
        self.moved.set(row);
        let graphs = row.map_or_else(Vec::new, |moved| session.sheet_graphs(moved));
        let names: Vec<String> = graphs.iter().map(|graph| kind_name(graph.kind)).collect();
        self.widgets.graph.set_model(Some(&ui::words(&names)));
        self.widgets.graph.set_sensitive(!names.is_empty());
        // The user's previous choice, else the first graph that changes.
        let chosen = graphs.iter().position(|graph| Some(graph.kind) == self.kind.get());
        let kept = chosen.or_else(|| graphs.iter().position(CurveGraph::moves)).unwrap_or(0);
        self.graphs.replace(graphs);
        if !names.is_empty() {
            self.widgets.graph.set_selected(kept as u32);
        }
        self.show_graph(session, kept);
    }

    fn show_graph(&self, session: &Session, place: usize) {
        let graph = self.graphs.borrow().get(place).cloned();
        let playback = session.playback();
        self.shown.plot.borrow_mut().set(graph, (playback.start, playback.end));
        self.curves.queue_draw();
        self.show_values(session);
    }

    /// The values under the pointer, else at the present moment.
    fn show_values(&self, session: &Session) {
        self.cursors.iter().for_each(PaintWidget::queue_draw);
        let time = match self.shown.pointer.get() {
            Some(x) => self.shown.time_at(&self.curves, x),
            None => session.playback().time,
        };
        let plot = self.shown.plot.borrow();
        let text = match &plot.graph {
            Some(graph) if self.page.get() == SheetPage::Curves => {
                let unit = if graph.kind == GraphKind::Rotation { "°" } else { "" };
                let value = |line: &crate::session::ValueGraph| format!("{} {}{unit}", line.name, format::number(line.value(time), 3));
                let values: Vec<String> = graph.lines.iter().take(12).map(value).collect();
                tr!(
                    "app-sheet-values",
                    time = format::with_unit(time, 3, &tr!("app-unit-s")),
                    values = values.join("   ").trim().to_owned()
                )
            }
            _ => String::new(),
        };
        self.widgets.values.set_text(&text);
    }

    /// The user selected a row: its node is selected everywhere, and its curves are shown.
    fn take_row(&self, session: &SessionHandle, place: u32) {
        if place == gtk::INVALID_LIST_POSITION {
            return;
        }
        let mut node: Option<NodeId> = None;
        session.set_widgets(|_| {
            if let Some(AnimatedItem::Node(found)) = self.moved_at(place as usize) {
                node = Some(found);
            }
        });
        match node {
            Some(node) => session.update(|session| session.select(Some(node))),
            None => session.set_widgets(|session| self.choose(session, place as usize)),
        }
    }

    /// The row at a place was chosen.
    fn choose(&self, session: &Session, place: usize) {
        if session.selected().is_none_or(|node| self.moved_at(place) != Some(AnimatedItem::Node(node))) {
            self.show_row(session, Some(place));
        }
    }

    fn moved_at(&self, place: usize) -> Option<AnimatedItem> {
        self.shown.rows.borrow().get(place).map(|row| row.item)
    }
}

fn kind_name(kind: GraphKind) -> String {
    tr!(match kind {
        GraphKind::Translation => "app-graph-translation",
        GraphKind::Rotation => "app-graph-rotation",
        GraphKind::Scale => "app-graph-scale",
        GraphKind::Other => "app-graph-other",
        GraphKind::Weights => "app-graph-weights",
        GraphKind::Colour => "app-graph-colour",
        GraphKind::Shininess => "app-graph-shininess",
        GraphKind::Opacity => "app-graph-opacity",
    })
}

fn factory(session: &SessionHandle, shown: &Rc<EditorState>) -> gtk::SignalListItemFactory {
    let factory = gtk::SignalListItemFactory::new();
    let weak = session.downgrade();
    let shown = shown.clone();
    factory.connect_setup(move |_, item| {
        let Some(item) = item.downcast_ref::<gtk::ListItem>() else { return };
        let content = gtk::Box::new(gtk::Orientation::Horizontal, 6);
        // A margin, not padding of the row: a list that is laid out before it has a width gives rows none, and what padding leaves of that is less than nothing.
        let label = gtk::Label::builder().xalign(0.0).ellipsize(gtk::pango::EllipsizeMode::Middle).width_request(NAMES);
        content.append(&label.max_width_chars(1).hexpand(false).margin_start(8).build());
        let keys = PaintWidget::new(20, ROW);
        keys.set_hexpand(true);
        let (painted, place) = (shown.clone(), item.downgrade());
        keys.set_painter(move |canvas, snapshot, width, height| {
            if let Some(item) = place.upgrade() {
                paint_row(&painted, item.position() as usize, canvas, snapshot, width, height);
            }
        });
        content.append(&keys);
        item.set_child(Some(&content));
        if let Some(session) = weak.upgrade() {
            seek_by_hand(&session, &keys, &shown, Some(item.downgrade()));
        }
    });
    factory.connect_bind(|_, item| {
        let Some(item) = item.downcast_ref::<gtk::ListItem>() else { return };
        let name = item.item().and_downcast::<gtk::StringObject>().map(|name| name.string());
        let content = item.child();
        if let (Some(label), Some(name)) = (content.as_ref().and_then(WidgetExt::first_child).and_downcast::<gtk::Label>(), name) {
            label.set_text(&name);
            label.set_tooltip_text(Some(&name));
        }
        if let Some(keys) = content.and_then(|content| content.last_child()) {
            keys.queue_draw();
        }
    });
    factory
}

/// A drag over a canvas goes to the moment under it; near a key of its row, to the key.
fn seek_by_hand(session: &SessionHandle, canvas: &PaintWidget, shown: &Rc<EditorState>, item: Option<glib::WeakRef<gtk::ListItem>>) {
    let drag = gtk::GestureDrag::new();
    let (shown, weak) = (shown.clone(), session.downgrade());
    let seek = move |gesture: &gtk::GestureDrag, x: f64| {
        let (Some(session), Some(canvas)) = (weak.upgrade(), gesture.widget().and_downcast::<PaintWidget>()) else { return };
        let mut time = shown.time_at(&canvas, x);
        if let Some(item) = item.as_ref().and_then(glib::WeakRef::upgrade) {
            let (left, width) = shown.axis(&canvas);
            let (rows, track) = (shown.rows.borrow(), shown.track.borrow());
            let keys = rows.get(item.position() as usize).map_or(&[][..], |row| row.keys.as_slice());
            let off = |key: &&f64| (left + track.x(**key, width) - x).abs();
            if let Some(key) = keys.iter().min_by(|a, b| off(a).total_cmp(&off(b))).filter(|key| off(key) <= NEAR) {
                time = *key;
            }
        }
        session.update(|session| session.time(|cursor| cursor.seek(time)));
    };
    let begin = seek.clone();
    drag.connect_drag_begin(move |gesture, x, _| begin(gesture, x));
    drag.connect_drag_update(move |gesture, dx, _| {
        if let Some((x, _)) = gesture.start_point() {
            seek(gesture, x + dx);
        }
    });
    hold_while(&drag, session);
    canvas.add_controller(drag);
}

fn paint_row(shown: &EditorState, place: usize, canvas: &PaintWidget, snapshot: &gtk::Snapshot, width: f64, height: f64) {
    let (rows, track) = (shown.rows.borrow(), shown.track.borrow());
    let Some(row) = rows.get(place) else { return };
    let (left, track_width) = shown.axis(canvas);
    let context = cairo(snapshot, width, height);
    let text = canvas.text_color();
    set_color(&context, &text, 0.12);
    context.rectangle(
        left + track.x(track.range.0, track_width),
        (height / 2.0).round(),
        track.x(track.range.1, track_width) - track.x(track.range.0, track_width),
        1.0,
    );
    // Cairo fails only where memory is gone, and the next change draws again.
    let _ = context.fill();
    set_color(&context, &text, 0.85);
    let (from, to) = track.range;
    let keys = row.keys.iter().filter(|key| (from..=to).contains(*key));
    let spread = track_width / keys.clone().count().max(1) as f64;
    let mut last = f64::NEG_INFINITY;
    for key in keys {
        let x = (left + track.x(*key, track_width)).round() + 0.5;
        if x < last + 1.5 {
            continue;
        }
        last = x;
        if spread < 9.0 {
            context.rectangle(x - 0.5, height / 2.0 - 5.0, 1.0, 10.0);
        } else {
            diamond(&context, (x, (height / 2.0).round() + 0.5), 3.5);
        }
    }
    let _ = context.fill();
}

/// The present moment and the pointer, over both pages.
fn paint_cursor(shown: &EditorState, canvas: &PaintWidget, snapshot: &gtk::Snapshot, width: f64, height: f64) {
    let track = shown.track.borrow();
    if track.range.1 <= track.range.0 {
        return;
    }
    let (left, track_width) = shown.axis(canvas);
    let context = cairo(snapshot, width, height);
    if let Some(x) = shown.pointer.get() {
        set_color(&context, &canvas.text_color(), 0.35);
        context.rectangle(left + track.x(track.time_at(x - left, track_width), track_width).round(), 0.0, 1.0, height);
        let _ = context.fill();
    }
    if !(track.range.0..=track.range.1).contains(&track.time) {
        return;
    }
    set_color(&context, &rgb(track.accent), 0.9);
    context.rectangle((left + track.x(track.time, track_width)).round() - 1.0, 0.0, 2.0, height);
    let _ = context.fill();
}

//! The main window: assembles the panels and distributes changes to them.

use std::cell::Cell;
use std::collections::HashMap;
use std::path::PathBuf;
use std::rc::Rc;

use gtk::prelude::*;
use gtk::{gio, glib};
use gtk4 as gtk;

use super::autosave::Autosave;
use super::commands::Command;
use super::curve_editor::CurveEditor;
use super::display_panel::DisplayPanel;
use super::document_loader::DocumentLoader;
use super::empty_state::EmptyState;
use super::error_bar::ErrorBar;
use super::health_panel::HealthPanel;
use super::held_joint_banner::HeldJointBanner;
use super::inspector::Inspector;
use super::measure_panel::MeasurePanel;
use super::muscle_panel::MusclePanel;
use super::scene_tree::SceneTree;
use super::session_handle::SessionHandle;
use super::settings::{self, Settings};
use super::settings_handle::SettingsHandle;
use super::shortcuts::KeyChords;
use super::side_panels::SidePanels;
use super::start_page::StartPage;
use super::timeline::Timeline;
use super::timeline_ruler::Track;
use super::tree_model::TreeRow;
use super::ui::{self, object};
use super::viewport::Viewport;
use super::{appearance, command_dispatch, document_loader, key_controller, menus, onion_skin_panel, saving, side_panels, title_bar};
use crate::document::Document;
use crate::i18n::{self, Sentence};
use crate::muscle::EditError;
use crate::scene::NodeId;
use crate::session::{ChangeSet, LoadMode, Session};
use crate::tr;

/// The main window.
pub(super) struct Window {
    /// The window itself.
    pub widget: gtk::ApplicationWindow,
    /// What is remembered.
    pub settings: SettingsHandle,
    /// The session.
    pub session: SessionHandle,
    /// The picture.
    pub viewport: Viewport,
    /// Errors.
    pub error_bar: ErrorBar,
    /// What is not saved, kept from crashes.
    pub recovery: Autosave,
    /// The main menu's button.
    pub menu: gtk::MenuButton,
    /// Opening, watching.
    pub files: DocumentLoader,
    /// Keys to commands.
    pub keys: KeyChords,
    ticking: Cell<bool>,
    page_turned: Cell<bool>,
    side_panels: SidePanels,
    actions: HashMap<Command, gio::SimpleAction>,
    builder: gtk::Builder,
    timeline: Timeline,
    tree: SceneTree,
    muscle: MusclePanel,
    display: DisplayPanel,
    pub(super) measure: MeasurePanel,
    health: HealthPanel,
    inspector: Inspector,
    empty_state: EmptyState,
    /// Over the picture and over the timeline.
    held: [HeldJointBanner; 2],
    start: StartPage,
}

impl Window {
    /// Opens a window that shows `files`, or the built-in biceps.
    pub(super) fn open(application: &gtk::Application, files: Vec<PathBuf>) {
        appearance::load_style();
        let (settings, notice) = Settings::load(&settings::path());
        let builder = ui::builder(ui::WINDOW);
        let widget: gtk::ApplicationWindow = object(&builder, "window");
        widget.set_application(Some(application));
        let (width, height) = side_panels::on_screen(settings.width, settings.height);
        widget.set_default_size(width, height);
        if settings.maximised {
            widget.maximize();
        }
        // With files on the way the picture stays empty until the first of them is there.
        let document = if files.is_empty() { Document::built_in() } else { Document::default() };
        let mut session = Session::new(document);
        settings.apply(&mut session);
        session.set_eased(settings.smooth_camera && appearance::animates());

        let window = Rc::new(Self {
            widget,
            settings: SettingsHandle::new(settings),
            session: SessionHandle::new(session),
            viewport: Viewport::new(),
            error_bar: ErrorBar::new(),
            recovery: Autosave::new(),
            menu: object(&builder, "menu"),
            files: DocumentLoader::default(),
            keys: KeyChords::default(),
            ticking: Cell::new(false),
            page_turned: Cell::new(false),
            side_panels: SidePanels::new(&builder),
            actions: command_dispatch::make_actions(),
            timeline: Timeline::new(),
            tree: SceneTree::new(),
            muscle: MusclePanel::new(),
            display: DisplayPanel::new(),
            measure: MeasurePanel::new(),
            health: HealthPanel::new(),
            inspector: Inspector::new(),
            empty_state: EmptyState::new(),
            held: std::array::from_fn(|_| HeldJointBanner::new()),
            start: StartPage::new(),
            builder,
        });
        window.assemble();
        let weak = Rc::downgrade(&window);
        window.session.subscribe(move |session, changes| {
            if let Some(window) = weak.upgrade() {
                window.refresh(session, changes);
            }
        });
        let weak = Rc::downgrade(&window);
        window.session.observe(move |changes| {
            if let Some(window) = weak.upgrade() {
                window.follow_up(changes);
            }
        });
        // Reading has begun before anything is shown, or the start page would flash.
        if !files.is_empty() {
            document_loader::open(&window, files, LoadMode::New);
        }
        appearance::follow(&window);
        window.session.refresh();
        if let Some(notice) = notice {
            window.viewport.notice(&notice.sentence());
        }
        window.recovery.offer(&window);
        // Newer GTK gives the keyboard to the first widget that takes it, which is the search of the tree; there keys would be letters.
        window.viewport.take_focus();
        window.widget.present();
    }

    fn assemble(self: &Rc<Self>) {
        let slot = |id: &str| object::<gtk::Box>(&self.builder, id);
        slot("error_slot").append(&self.error_bar.root);
        slot("error_slot").append(&self.recovery.root);
        let left: gtk::Paned = object(&self.builder, "tree_paned");
        left.set_start_child(Some(&self.tree.root));
        left.set_end_child(Some(&self.inspector.root));
        slot("viewport_slot").append(&self.viewport.root);
        slot("timeline_slot").append(&self.timeline.root);
        self.viewport.root.add_overlay(&self.empty_state.root);
        let [over_picture, over_timeline] = &self.held;
        over_picture.root.add_css_class("floating");
        self.viewport.root.add_overlay(&over_picture.root);
        self.timeline.over_track().add_overlay(&over_timeline.root);
        self.held.iter().for_each(|held| held.connect(self));
        self.viewport.root.add_overlay(&self.start.root);
        let stack: gtk::Stack = object(&self.builder, "stack");
        stack.add_titled(&self.muscle.root, Some("muscle"), &tr!("app-page-muscle"));
        stack.add_titled(&self.display.root, Some("display"), &tr!("app-page-display"));
        stack.add_titled(&self.measure.root, Some("measure"), &tr!("app-page-measure"));
        stack.add_titled(&self.health.root, Some("health"), &tr!("app-page-health"));
        let page = self.settings.borrow().page.clone();
        if stack.child_by_name(&page).is_some() {
            stack.set_visible_child_name(&page);
        }
        for action in self.actions.values() {
            self.widget.add_action(action);
        }
        self.viewport.connect(self);
        self.timeline.connect(self);
        self.tree.connect(self);
        self.muscle.connect(self);
        self.display.connect(self);
        self.measure.connect(self);
        self.health.connect(self);
        self.inspector.connect(self);
        self.error_bar.connect(self);
        self.recovery.connect(self);
        self.start.connect(self);
        command_dispatch::connect(self);
        key_controller::connect(self);
        menus::connect(self, &self.builder);
        document_loader::accept_drops(self);
        self.show_side(self.settings.borrow().tree_shown, self.settings.borrow().panel_shown);
        self.show_sheet();
        self.widget.connect_close_request(glib::clone!(
            #[strong(rename_to = window)]
            self,
            move |_| {
                if window.read(|session| session.is_unsaved()) {
                    saving::confirm_unsaved(&window, |window| {
                        window.save_settings();
                        window.files.stop();
                        window.widget.destroy();
                    });
                    return glib::Propagation::Stop;
                }
                window.save_settings();
                window.files.stop();
                glib::Propagation::Proceed
            }
        ));
        self.side_panels.keep_width(&stack);
        self.widget.connect_default_width_notify(glib::clone!(
            #[weak(rename_to = window)]
            self,
            move |widget| {
                if window.side_panels.follow(widget) {
                    window.show_states();
                }
            }
        ));
    }

    /// Changes the session and shows the result.
    pub(super) fn update(&self, change: impl FnOnce(&mut Session)) {
        self.session.update(change);
    }

    /// Reads the session.
    pub(super) fn read<T>(&self, read: impl FnOnce(&mut Session) -> T) -> T {
        self.session.read(read)
    }

    /// Refreshes the parts that show what changed.
    fn refresh(self: &Rc<Self>, session: &mut Session, changes: ChangeSet) {
        self.timeline.refresh(session, changes);
        self.tree.refresh(session, changes);
        self.muscle.refresh(session, changes);
        self.display.refresh(session, changes);
        self.measure.refresh(session, changes);
        self.health.refresh(session, changes);
        self.inspector.refresh(session, changes);
        self.viewport.refresh(session, changes);
        if changes.any(ChangeSet::DOCUMENT | ChangeSet::DRIVE | ChangeSet::PLAYBACK) {
            self.held.iter().for_each(|held| held.refresh(session));
        }
        if changes.any(ChangeSet::DOCUMENT) {
            menus::list_cameras(&object(&self.builder, "camera_menu"), session);
            self.show_page(session);
            self.empty_state.refresh(session);
        }
        if changes.any(ChangeSet::DOCUMENT | ChangeSet::SURROUNDINGS) {
            self.start.refresh(session, self.files.is_loading());
        }
        if changes.any(ChangeSet::DOCUMENT | ChangeSet::PLAYBACK | ChangeSet::EDIT) {
            title_bar::name(&self.builder, &self.widget, session);
        }
        if changes.any(ChangeSet::DOCUMENT | ChangeSet::EDIT) {
            self.recovery.note(self, session);
        }
        if changes.any(ChangeSet::HISTORY | ChangeSet::DOCUMENT) {
            title_bar::name_steps(&self.builder, session);
        }
        if changes.any(ChangeSet::SELECTION | ChangeSet::DOCUMENT) {
            let name = session.selected().map(|id| i18n::label(session.document().scene.graph.label(id)).into_owned());
            ui::set_label(&object(&self.builder, "status_selection"), &name.unwrap_or_default());
        }
        if changes.any(ChangeSet::PICTURE) {
            let compared = session.compared().map(|compared| onion_skin_panel::difference(session, &compared));
            ui::set_label(&object(&self.builder, "status_compared"), &compared.unwrap_or_default());
        }
        command_dispatch::show_states(self, session, &self.actions);
    }

    /// Lets what follows from a change happen once all parts show it.
    fn follow_up(self: &Rc<Self>, changes: ChangeSet) {
        let moves = ChangeSet::CAMERA
            | ChangeSet::TIME
            | ChangeSet::DOCUMENT
            | ChangeSet::MODEL
            | ChangeSet::JOINT_OVERRIDES
            | ChangeSet::EDIT
            | ChangeSet::DRIVE;
        if changes.any(moves) {
            self.viewport.refresh_hover(self);
        }
        if self.session.read(|session| session.is_moving()) {
            self.tick();
        }
    }

    /// Lets the display's frame clock drive what moves by itself.
    fn tick(self: &Rc<Self>) {
        if self.ticking.replace(true) {
            return;
        }
        let last = Cell::new(None::<i64>);
        let weak = Rc::downgrade(self);
        self.widget.add_tick_callback(move |_, clock| {
            let Some(window) = weak.upgrade() else { return glib::ControlFlow::Break };
            let now = clock.frame_time();
            let seconds = last.replace(Some(now)).map_or(0.0, |before| (now - before) as f64 * 1e-6);
            let flying = window.viewport.fly(&window, seconds);
            window.update(|session| session.advance(seconds));
            if flying || window.session.read(|session| session.is_moving()) {
                glib::ControlFlow::Continue
            } else {
                window.ticking.set(false);
                glib::ControlFlow::Break
            }
        });
    }

    /// Shows or folds away what lies below the track.
    pub(super) fn show_sheet(&self) {
        let page = self.settings.borrow().sheet;
        self.sheet(|sheet, session| sheet.show(session, page));
    }

    /// Lets what lies below the track show something else of the session. Signals of its widgets are no hand's meanwhile.
    pub(super) fn sheet(&self, work: impl FnOnce(&CurveEditor, &Session)) {
        self.session.set_widgets(|session| work(&self.timeline.sheet, session));
    }

    /// Changes the visible range of the timeline.
    pub(super) fn change_visible_range(&self, read: impl FnOnce(&mut Track)) {
        self.timeline.change_visible_range(read);
    }

    /// Whether a widget is the timeline.
    pub(super) fn is_track(&self, widget: &gtk::Widget) -> bool {
        self.timeline.is_track(widget)
    }

    /// Starts the clock for something that the session does not know of, such as a key held in flight.
    pub(super) fn request_tick(self: &Rc<Self>) {
        self.tick();
    }

    /// A scene without a muscle has nothing on the muscle page, so the display page comes up in its place, and goes again with it.
    fn show_page(&self, session: &Session) {
        let stack: gtk::Stack = object(&self.builder, "stack");
        let (page, has_muscle) = (stack.visible_child_name(), session.document().driven_rig().is_some());
        if has_muscle && self.page_turned.take() {
            stack.set_visible_child_name("muscle");
        } else if !has_muscle && !session.is_empty() && page.as_deref() == Some("muscle") {
            stack.set_visible_child_name("display");
            self.page_turned.set(true);
        }
    }

    /// Says what is drawn: triangles in the status line, times over the picture.
    pub(super) fn show_stats(&self, triangles: u64) {
        title_bar::tell_size(&self.builder, triangles);
    }

    /// Says where the pointer is in the world.
    pub(super) fn show_position(&self, text: &str) {
        ui::set_label(&object(&self.builder, "status_position"), text);
    }

    /// Whether the tree and the right panel are shown.
    pub(super) fn shown_side_panels(&self) -> (bool, bool) {
        self.side_panels.shown()
    }

    /// Shows or folds away the tree and the right panel. Where there is no room for both, the one that comes takes the other's place.
    pub(super) fn show_side(self: &Rc<Self>, tree: bool, panel: bool) {
        self.side_panels.show(&self.widget, tree, panel);
        self.show_states();
    }

    /// Shows the states of the actions anew.
    pub(super) fn show_states(self: &Rc<Self>) {
        self.session.show(|session| command_dispatch::show_states(self, session, &self.actions));
    }

    /// Brings the start page up over what is open, or sends it away.
    pub(super) fn start_page(self: &Rc<Self>, wanted: bool) {
        let was_there = self.start.root.is_visible();
        self.start.want(wanted);
        self.update(Session::touch);
        // The keyboard goes with what is seen.
        if wanted {
            self.start.take_focus();
        } else if was_there {
            self.viewport.take_focus();
        }
    }

    /// Sends the start page away where it came up over a scene; whether it did.
    pub(super) fn leave_start_page(self: &Rc<Self>) -> bool {
        let came = self.start.root.is_visible() && !self.session.read(|session| session.is_empty());
        if came {
            self.start_page(false);
        }
        came
    }

    /// What the scene tree shows of a node.
    pub(super) fn tree_row(&self, node: NodeId) -> Option<TreeRow> {
        self.tree.row(node)
    }

    /// Whether the page of muscles is looked at; then the picture shows the dots of their ends.
    pub(super) fn shows_muscles(&self) -> bool {
        self.muscle.root.is_mapped()
    }

    /// Lets a click give the end of a muscle its place; the muscle panel says why it cannot.
    pub(super) fn pick_end(self: &Rc<Self>, pick: impl FnOnce(&mut Session) -> Result<(), EditError>) {
        self.muscle.editor(self).tell(pick);
    }

    /// Adds, copies or takes away a muscle; the muscle panel says why it cannot.
    pub(super) fn change_muscles(self: &Rc<Self>, command: Command) {
        self.muscle.change(self, command);
    }

    /// The actions, to connect them.
    pub(super) fn actions(&self) -> &HashMap<Command, gio::SimpleAction> {
        &self.actions
    }

    /// Writes down what is remembered. A folder that cannot be written is no reason not to close.
    fn save_settings(&self) {
        self.recovery.clear();
        let mut settings = self.settings.borrow_mut();
        if !self.widget.is_maximized() && !self.widget.is_fullscreen() {
            // The size that GTK itself restores: the widget's own is less by the borders that it draws where no compositor gives it shadows.
            (settings.width, settings.height) = self.widget.default_size();
        }
        settings.maximised = self.widget.is_maximized();
        (settings.tree_shown, settings.panel_shown) = self.side_panels.wanted();
        if let Some(page) = object::<gtk::Stack>(&self.builder, "stack").visible_child_name() {
            settings.page = if self.page_turned.get() { "muscle".into() } else { page.into() };
        }
        *settings = self.settings.with_user_view(&settings, &self.session);
        if let Err(error) = settings.save(&settings::path()) {
            eprintln!("{}", tr!("app-settings-unsaved", reason = error.sentence()));
        }
    }
}

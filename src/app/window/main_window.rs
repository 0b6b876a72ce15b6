//! The main window: assembles the panels, and lets them hear of changes of the session.

use std::path::PathBuf;
use std::rc::Rc;

use gtk::glib;
use gtk::prelude::*;
use gtk4 as gtk;

use super::menus;
use super::side_panels::{self, SidePanels};
use super::status_line::StatusLine;
use super::title_bar::TitleBar;
use crate::app::appearance;
use crate::app::commands::command_context::CommandContext;
use crate::app::commands::{command_dispatch, key_controller};
use crate::app::dialogs::saving;
use crate::app::handles::app_context::AppContext;
use crate::app::handles::session_handle::SessionHandle;
use crate::app::handles::settings_handle::SettingsHandle;
use crate::app::inspector::Inspector;
use crate::app::loading::autosave::Autosave;
use crate::app::loading::document_loader::DocumentLoader;
use crate::app::loading::{drop_target, open_buttons};
use crate::app::notices::empty_state::EmptyState;
use crate::app::notices::held_joint_banner::HeldJointBanner;
use crate::app::panels::muscle::muscle_panel::MusclePanel;
use crate::app::panels::pages::Pages;
use crate::app::panels::panel::Panel;
use crate::app::scene_tree::SceneTree;
use crate::app::settings::{self, Settings};
use crate::app::timeline::Timeline;
use crate::app::viewport::frame_clock::FrameClock;
use crate::app::viewport::{Viewport, ViewportHandles};
use crate::app::widgets::ui::{self, object};
use crate::document::Document;
use crate::i18n::Sentence;
use crate::session::{ChangeSet, LoadMode, Session};
use crate::tr;

/// The main window.
pub(crate) struct Window {
    app: Rc<AppContext>,
    context: Rc<CommandContext>,
    pages: Pages,
    tree: SceneTree,
    inspector: Inspector,
    title: TitleBar,
    status: StatusLine,
    /// What is not saved, kept from crashes.
    recovery: Rc<Autosave>,
    empty_state: EmptyState,
    /// Over the picture and over the timeline.
    held: [HeldJointBanner; 2],
}

impl Window {
    /// Opens a window that shows `files`, or the built-in biceps.
    pub(crate) fn open(application: &gtk::Application, files: Vec<PathBuf>) {
        appearance::load_style();
        let (settings, notice) = Settings::load(&settings::path());
        let builder = ui::builder(include_str!("main_window.ui"));
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

        let picture = ui::builder(include_str!("../viewport/viewport.ui"));
        let app = Rc::new(AppContext::new(widget, SessionHandle::new(session), SettingsHandle::new(settings), &picture));
        let window = Self::new(&app, &builder, picture);
        window.assemble(&builder);
        window.subscribe();
        // Reading has begun before anything is shown, or the start page would flash.
        if !files.is_empty() {
            window.context.loader.open(files, LoadMode::New);
        }
        appearance::follow(&app);
        app.session.refresh();
        if let Some(notice) = notice {
            app.toasts.notice(&notice.sentence());
        }
        window.recovery.offer();
        // Newer GTK gives the keyboard to the first widget that takes it, which is the search of the tree; there keys would be letters.
        app.focus.take();
        app.widget.present();
    }

    /// Makes the parts; `picture` is the builder of the viewport.
    fn new(app: &Rc<AppContext>, builder: &gtk::Builder, picture: gtk::Builder) -> Rc<Self> {
        let (session, focus) = (&app.session, &app.focus);
        let (status, muscle) = (StatusLine::new(builder), Rc::new(MusclePanel::new(session, &app.toasts)));
        let handles = ViewportHandles {
            session: session.clone(),
            settings: app.settings.clone(),
            status: status.clone(),
            clock: FrameClock::new(&app.widget, session),
            focus: focus.clone(),
            editor: muscle.editor().clone(),
            muscle_page: muscle.widget().downgrade(),
        };
        let loader = DocumentLoader::new(app);
        let context = Rc::new(CommandContext {
            app: app.clone(),
            loader: loader.clone(),
            viewport: Viewport::new(picture, handles),
            timeline: Timeline::new(session),
            muscle: muscle.clone(),
            side_panels: SidePanels::new(builder),
            menu: object(builder, "menu"),
            actions: command_dispatch::make_actions(),
        });
        Rc::new(Self {
            app: app.clone(),
            context,
            pages: Pages::new(object(builder, "stack"), app, &muscle),
            tree: SceneTree::new(session, muscle.editor(), focus),
            inspector: Inspector::new(session, &app.toasts),
            title: TitleBar::new(builder, &app.widget),
            status,
            recovery: Autosave::new(&loader),
            empty_state: EmptyState::new(),
            held: std::array::from_fn(|_| HeldJointBanner::new(session, focus)),
        })
    }

    /// Puts the parts into their places and connects them.
    fn assemble(self: &Rc<Self>, builder: &gtk::Builder) {
        let (app, context, loader) = (&self.app, &self.context, &self.context.loader);
        let (viewport, timeline) = (&context.viewport, &context.timeline);
        let slot = |id: &str| object::<gtk::Box>(builder, id);
        slot("error_slot").append(&app.error_bar.root);
        slot("error_slot").append(&self.recovery.root);
        let left: gtk::Paned = object(builder, "tree_paned");
        left.set_start_child(Some(&self.tree.root));
        left.set_end_child(Some(&self.inspector.root));
        slot("viewport_slot").append(&viewport.root);
        slot("timeline_slot").append(&timeline.root);
        viewport.root.add_overlay(&self.empty_state.root);
        let [over_picture, over_timeline] = &self.held;
        over_picture.root.add_css_class("floating");
        viewport.root.add_overlay(&over_picture.root);
        timeline.over_track().add_overlay(&over_timeline.root);
        viewport.root.add_overlay(&app.start_page.root);
        open_buttons::connect(loader);
        self.pages.show(&app.settings.borrow().page);
        command_dispatch::connect(context);
        key_controller::connect(context);
        menus::connect(loader, &context.menu, builder);
        drop_target::connect(loader, &viewport.root, &viewport.drop_mark());
        let (tree_shown, panel_shown) = (app.settings.borrow().tree_shown, app.settings.borrow().panel_shown);
        command_dispatch::show_sides(context, tree_shown, panel_shown);
        context.show_sheet();
        self.connect_close();
        context.side_panels.keep_width(self.pages.stack());
        app.widget.connect_default_width_notify(glib::clone!(
            #[weak]
            context,
            move |widget| {
                if context.side_panels.follow(widget) {
                    command_dispatch::refresh_states(&context);
                }
            }
        ));
    }

    /// Asks before unsaved changes are lost, and remembers the settings. The handler keeps the parts of the window alive until the widget is destroyed.
    fn connect_close(self: &Rc<Self>) {
        self.app.widget.connect_close_request(glib::clone!(
            #[strong(rename_to = window)]
            self,
            move |_| {
                if window.app.session.read(|session| session.is_unsaved()) {
                    let closed = window.clone();
                    saving::confirm_unsaved(&window.app, move || {
                        closed.end();
                        closed.app.widget.destroy();
                    });
                    return glib::Propagation::Stop;
                }
                window.end();
                glib::Propagation::Proceed
            }
        ));
    }

    /// Shows changes of the session in all parts.
    fn subscribe(self: &Rc<Self>) {
        let weak = Rc::downgrade(self);
        self.app.session.subscribe(move |session, changes| {
            if let Some(window) = weak.upgrade() {
                window.refresh(session, changes);
            }
        });
    }

    fn refresh(&self, session: &mut Session, changes: ChangeSet) {
        self.context.timeline.refresh(session, changes);
        self.tree.refresh(session, changes);
        self.pages.refresh(session, changes);
        self.inspector.refresh(session, changes);
        self.context.viewport.refresh(session, changes);
        if changes.any(ChangeSet::DOCUMENT | ChangeSet::DRIVE | ChangeSet::PLAYBACK) {
            self.held.iter().for_each(|held| held.refresh(session));
        }
        if changes.any(ChangeSet::DOCUMENT) {
            self.pages.fit(session);
            self.empty_state.refresh(session);
        }
        if changes.any(ChangeSet::DOCUMENT | ChangeSet::SURROUNDINGS) {
            self.app.start_page.refresh(session, self.app.reader.is_loading());
        }
        if changes.any(ChangeSet::DOCUMENT | ChangeSet::EDIT) {
            self.recovery.note(session);
        }
        self.title.refresh(session, changes);
        self.status.refresh(session, changes);
        command_dispatch::show_states(&self.context, session);
    }

    /// Stops what is under way and writes down what is remembered. A folder that cannot be written is no reason not to close.
    fn end(&self) {
        self.save_settings();
        self.app.reader.stop();
    }

    fn save_settings(&self) {
        self.recovery.clear();
        let widget = &self.app.widget;
        let mut settings = self.app.settings.borrow_mut();
        if !widget.is_maximized() && !widget.is_fullscreen() {
            // The size that GTK itself restores: the widget's own is less by the borders that it draws where no compositor gives it shadows.
            (settings.width, settings.height) = widget.default_size();
        }
        settings.maximised = widget.is_maximized();
        (settings.tree_shown, settings.panel_shown) = self.context.side_panels.wanted();
        if let Some(page) = self.pages.chosen() {
            settings.page = page;
        }
        *settings = self.app.settings.with_user_view(&settings, &self.app.session);
        if let Err(error) = settings.save(&settings::path()) {
            eprintln!("{}", tr!("app-settings-unsaved", reason = error.sentence()));
        }
    }
}

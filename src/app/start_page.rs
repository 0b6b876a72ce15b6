//! The start page: first steps, sample files with pictures, recent files. It opens when no file is open, and from the menu.

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use gtk::prelude::*;
use gtk::{cairo, gio, glib};
use gtk4 as gtk;

use super::drawing_area::{PaintWidget, cairo as cairo_over};
use super::error_bar::ErrorMessage;
use super::samples::{self, DEMOS, Demo};
use super::ui::{self, object};
use super::window::Window;
use super::{document_loader, recent, saving};
use crate::document::Document;
use crate::i18n::Sentence;
use crate::render::Theme;
use crate::session::{LoadMode, Session};
use crate::tr;

/// Size of a demo's picture, logical pixels.
const PICTURE: (i32, i32) = (144, 108);

/// The page, over the picture.
pub(super) struct StartPage {
    /// The whole.
    pub root: gtk::ScrolledWindow,
    builder: gtk::Builder,
    pictures: Vec<PaintWidget>,
    drawn_for: Cell<Option<Theme>>,
    wanted: Cell<bool>,
}

impl StartPage {
    /// A page that is not connected yet.
    pub(super) fn new() -> Self {
        let builder = ui::builder(ui::START);
        let pictures = DEMOS.iter().map(|_| PaintWidget::new(PICTURE.0, PICTURE.1)).collect();
        Self { root: object(&builder, "root"), builder, pictures, drawn_for: Cell::default(), wanted: Cell::default() }
    }

    /// Lets the buttons work; recent files are listed anew whenever the page appears.
    pub(super) fn connect(&self, window: &Rc<Window>) {
        self.root.set_visible(false);
        let flow: gtk::FlowBox = object(&self.builder, "demos");
        for (demo, picture) in DEMOS.iter().zip(&self.pictures) {
            let card = gtk::Box::new(gtk::Orientation::Vertical, 6);
            let name = gtk::Label::builder().label(tr!(demo.name)).wrap(true).justify(gtk::Justification::Center).max_width_chars(16);
            picture.set_halign(gtk::Align::Center);
            card.append(picture);
            card.append(&name.css_classes(["small"]).build());
            let button: gtk::Button = ui::named("GtkButton", &tr!(demo.name));
            button.set_child(Some(&card));
            button.set_has_frame(false);
            button.connect_clicked(glib::clone!(
                #[weak]
                window,
                move |_| open_demo(&window, *demo)
            ));
            flow.append(&button);
            if let Some(child) = button.parent() {
                child.set_focusable(false);
            }
        }
        object::<gtk::Button>(&self.builder, "back").connect_clicked(glib::clone!(
            #[weak]
            window,
            move |_| window.start_page(false)
        ));
        let slot: gtk::Box = object(&self.builder, "recent_slot");
        self.root.connect_map(glib::clone!(
            #[weak]
            window,
            move |_| recent::fill(&window, &slot, || ())
        ));
    }

    /// Asks for the page, or sends it away.
    pub(super) fn want(&self, wanted: bool) {
        self.wanted.set(wanted);
    }

    /// Gives the keyboard to the page.
    pub(super) fn take_focus(&self) {
        object::<gtk::Button>(&self.builder, "open").grab_focus();
    }

    /// Shows the page where it belongs: wanted, or nothing is open and nothing on its way.
    pub(super) fn refresh(&self, session: &Session, is_loading: bool) {
        let empty = session.is_empty() && !is_loading;
        self.root.set_visible(empty || self.wanted.get());
        object::<gtk::Button>(&self.builder, "back").set_visible(!session.is_empty());
        object::<gtk::Label>(&self.builder, "title").set_text(&tr!(if session.is_empty() { "app-start-title" } else { "app-start-more" }));
        if self.root.is_visible() && self.drawn_for.replace(Some(session.theme())) != Some(session.theme()) {
            for (demo, picture) in DEMOS.iter().zip(&self.pictures) {
                draw(*demo, picture, session.theme());
            }
        }
    }
}

/// Draws a demo off the interface thread and puts it on its canvas.
fn draw(demo: Demo, canvas: &PaintWidget, theme: Theme) {
    let (width, height) = (PICTURE.0 * 2, PICTURE.1 * 2);
    let canvas = canvas.downgrade();
    glib::spawn_future_local(async move {
        let drawn = gio::spawn_blocking(move || demo.draw(&samples::folder(), theme, width as u32, height as u32)).await;
        let (Ok(Some(pixels)), Some(canvas)) = (drawn, canvas.upgrade()) else { return };
        let bytes: Vec<u8> = pixels.iter().flat_map(|pixel| pixel.to_ne_bytes()).collect();
        let Ok(surface) = cairo::ImageSurface::create_for_data(bytes, cairo::Format::Rgb24, width, height, width * 4) else { return };
        let surface = RefCell::new(surface);
        canvas.set_painter(move |_, snapshot, w, h| {
            let context = cairo_over(snapshot, w, h);
            context.scale(w / f64::from(width), h / f64::from(height));
            // Cairo fails only where memory is gone; the card keeps its name then.
            let _ = context.set_source_surface(&*surface.borrow(), 0.0, 0.0);
            let _ = context.paint();
        });
    });
}

/// Opens a demo.
pub(super) fn open_demo(window: &Rc<Window>, demo: Demo) {
    match demo.unpack(&samples::folder()) {
        Ok(Some(path)) => document_loader::open(window, vec![path], LoadMode::New),
        Ok(None) => saving::confirm_unsaved(window, |window| {
            window.start_page(false);
            document_loader::forget(window);
            window.settings.restore_view(&window.session);
            window.update(|session| session.show(Document::built_in(), LoadMode::New));
        }),
        Err(error) => window.error_bar.show(ErrorMessage {
            headline: tr!("app-demo-unwritten", folder = samples::folder().display().to_string()),
            message: error.sentence(),
            details: String::new(),
            again: None,
        }),
    }
}

//! The start page: first steps, sample files with pictures, recent files. It opens when no file is open, and from the menu.

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use gtk::prelude::*;
use gtk::{cairo, gio, glib};
use gtk4 as gtk;

use crate::app::handles::picture_focus::PictureFocus;
use crate::app::handles::session_handle::SessionHandle;
use crate::app::loading::samples::{self, DEMOS, Demo};
use crate::app::widgets::drawing_area::{PaintWidget, cairo as cairo_over};
use crate::app::widgets::ui;
use crate::render::Theme;
use crate::session::Session;
use crate::tr;

/// Size of a demo's picture, logical pixels.
const PICTURE: (i32, i32) = (144, 108);

ui::widgets! {
    /// The widgets of the page.
    struct StartWidgets from "start_page.ui" {
        root: gtk::ScrolledWindow,
        title: gtk::Label,
        open: gtk::Button,
        back: gtk::Button,
        demos: gtk::FlowBox,
        recent_slot: gtk::Box,
    }
}

/// The page, over the picture.
pub(crate) struct StartPage {
    /// The whole.
    pub root: gtk::ScrolledWindow,
    widgets: StartWidgets,
    pictures: Vec<PaintWidget>,
    drawn_for: Cell<Option<Theme>>,
    wanted: Cell<bool>,
    session: SessionHandle,
    focus: PictureFocus,
}

impl StartPage {
    /// A page that is not connected yet.
    pub(crate) fn new(session: &SessionHandle, focus: &PictureFocus) -> Rc<Self> {
        let widgets = StartWidgets::build();
        let pictures = DEMOS.iter().map(|_| PaintWidget::new(PICTURE.0, PICTURE.1)).collect();
        Rc::new(Self {
            root: widgets.root.clone(),
            widgets,
            pictures,
            drawn_for: Cell::default(),
            wanted: Cell::default(),
            session: session.clone(),
            focus: focus.clone(),
        })
    }

    /// Lets the buttons work: `open` opens a demo, `list_recent` fills a box with the recent files, anew whenever the page appears.
    pub(crate) fn connect(self: &Rc<Self>, open: impl Fn(Demo) + Clone + 'static, list_recent: impl Fn(&gtk::Box) + 'static) {
        self.root.set_visible(false);
        let flow = &self.widgets.demos;
        for (demo, picture) in DEMOS.iter().zip(&self.pictures) {
            let card = gtk::Box::new(gtk::Orientation::Vertical, 6);
            let name = gtk::Label::builder().label(tr!(demo.name)).wrap(true).justify(gtk::Justification::Center).max_width_chars(16);
            picture.set_halign(gtk::Align::Center);
            card.append(picture);
            card.append(&name.css_classes(["small"]).build());
            let button: gtk::Button = ui::named("GtkButton", &tr!(demo.name));
            button.set_child(Some(&card));
            button.set_has_frame(false);
            let open = open.clone();
            button.connect_clicked(move |_| open(*demo));
            flow.append(&button);
            if let Some(child) = button.parent() {
                child.set_focusable(false);
            }
        }
        self.widgets.back.connect_clicked(glib::clone!(
            #[weak(rename_to = page)]
            self,
            move |_| page.want(false)
        ));
        let slot = self.widgets.recent_slot.clone();
        self.root.connect_map(move |_| list_recent(&slot));
    }

    /// Brings the page up over what is open, or sends it away.
    pub(crate) fn want(&self, wanted: bool) {
        let was_there = self.root.is_visible();
        self.wanted.set(wanted);
        self.session.update(Session::touch);
        // The keyboard goes with what is seen.
        if wanted {
            self.widgets.open.grab_focus();
        } else if was_there {
            self.focus.take();
        }
    }

    /// Sends the page away where it came up over a scene; whether it did.
    pub(crate) fn leave(&self) -> bool {
        let came = self.root.is_visible() && !self.session.read(|session| session.is_empty());
        if came {
            self.want(false);
        }
        came
    }

    /// Shows the page where it belongs: wanted, or nothing is open and nothing on its way.
    pub(crate) fn refresh(&self, session: &Session, is_loading: bool) {
        let empty = session.is_empty() && !is_loading;
        self.root.set_visible(empty || self.wanted.get());
        self.widgets.back.set_visible(!session.is_empty());
        self.widgets.title.set_text(&tr!(if session.is_empty() { "app-start-title" } else { "app-start-more" }));
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

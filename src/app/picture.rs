//! Pictures to take away: saved as PNG, or copied.

use std::io::Write;
use std::rc::Rc;

use gtk::prelude::*;
use gtk::{gdk, glib};
use gtk4 as gtk;

use super::save_as;
use super::window::Window;
use crate::export::atomic::write_whole;
use crate::render::Background;
use crate::tr;

/// The picture as it is on the screen, without what stands over it.
fn take(window: &Rc<Window>, transparent: bool) -> gdk::Texture {
    let scale = window.viewport.scale();
    let (width, height) = window.viewport.size();
    let (width, height) = ((width * scale).max(1), (height * scale).max(1));
    let bytes = window.look(|session| {
        let (scene, frame, camera, mut display) = session.picture();
        display.scale = scale as f32;
        display.hovered = None;
        if transparent {
            display.background = Background::Transparent;
        }
        window.viewport.with_renderer(|renderer| {
            let picture = renderer.draw(scene, frame, &camera, &display, width as u32, height as u32);
            picture
                .pixels
                .iter()
                .flat_map(|pixel| if transparent { *pixel } else { *pixel | 0xFF00_0000 }.to_ne_bytes())
                .collect::<Vec<u8>>()
        })
    });
    let format =
        if cfg!(target_endian = "little") { gdk::MemoryFormat::B8g8r8a8Premultiplied } else { gdk::MemoryFormat::A8r8g8b8Premultiplied };
    gdk::MemoryTexture::new(width, height, format, &glib::Bytes::from_owned(bytes), width as usize * 4).upcast()
}

/// Copies the picture.
pub fn copy(window: &Rc<Window>) {
    window.widget.clipboard().set_texture(&take(window, false));
    window.viewport.toast(&tr!("app-picture-copied"), None);
}

/// Asks where to and saves the picture.
pub fn save(window: &Rc<Window>, transparent: bool) {
    let texture = take(window, transparent);
    save_as::ask(window, &tr!("app-picture-title"), &save_as::name_like_open(window, "png"), None, move |window, path| {
        match write_whole(&path, |file| file.write_all(&texture.save_to_png_bytes())) {
            Ok(()) => window.viewport.toast(&tr!("app-saved", file = save_as::name_of(&path)), Some(path)),
            Err(error) => save_as::failed(window, &path, error.to_string()),
        }
    });
}

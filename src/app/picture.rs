//! Pictures to take away: saved as PNG, or copied.

use std::cell::RefCell;
use std::io::Write;
use std::path::Path;
use std::rc::Rc;

use gtk::prelude::*;
use gtk::{gdk, gio, glib};
use gtk4 as gtk;

use super::error_bar::Trouble;
use super::window::Window;
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
    let dialog = gtk::FileChooserNative::new(
        Some(&tr!("app-picture-title")),
        Some(&window.widget),
        gtk::FileChooserAction::Save,
        Some(&tr!("app-save")),
        Some(&tr!("app-cancel")),
    );
    let name =
        window.look(|session| session.files()).first().and_then(|path| path.file_stem().map(|stem| stem.to_string_lossy().into_owned()));
    dialog.set_current_name(&format!("{}.png", name.unwrap_or_else(|| "sinew".into())));
    let keep = RefCell::new(Some(dialog.clone()));
    dialog.connect_response(glib::clone!(
        #[weak]
        window,
        move |dialog, response| {
            keep.take();
            if let (gtk::ResponseType::Accept, Some(path)) = (response, dialog.file().and_then(|file| file.path())) {
                saved(&window, &path, write(&texture, &path));
            }
        }
    ));
    dialog.show();
}

fn saved(window: &Rc<Window>, path: &Path, result: std::io::Result<()>) {
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    match result {
        Ok(()) => window.viewport.toast(&tr!("app-saved", file = name), Some(path.to_owned())),
        Err(error) => window.error_bar.show(Trouble {
            headline: tr!("app-unsaved", file = name),
            message: error.to_string(),
            details: path.display().to_string(),
            again: None,
        }),
    }
}

/// Writes by way of a temporary file, so that a failure leaves the old picture.
fn write(texture: &gdk::Texture, path: &Path) -> std::io::Result<()> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut file = tempfile::NamedTempFile::new_in(folder)?;
    file.write_all(&texture.save_to_png_bytes())?;
    file.persist(path)?;
    // Temporary files are for their owner alone; a picture is an ordinary file.
    let readable = gio::File::for_path(path);
    let _ = readable.set_attribute_uint32("unix::mode", 0o644, gio::FileQueryInfoFlags::NONE, gio::Cancellable::NONE);
    Ok(())
}

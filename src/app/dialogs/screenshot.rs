//! Pictures of the viewport, saved as PNG or copied to the clipboard.

use std::rc::Rc;

use gtk::prelude::*;
use gtk::{gdk, glib};
use gtk4 as gtk;

use super::export_job::note;
use super::save_as::{self, SaveRequest};
use crate::app::handles::app_context::AppContext;
use crate::app::viewport::Viewport;
use crate::export::png::{self, SOFTWARE};
use crate::i18n::Sentence;
use crate::render::{Background, Framebuffer, RenderError, RenderJob};
use crate::sequence::FrameSpec;
use crate::tr;

/// A picture with what made it.
struct ScreenshotImage {
    pixels: Framebuffer,
    transparent: bool,
    note: String,
}

/// The picture as it is on the screen, without what stands over it.
fn take(viewport: &Viewport, transparent: bool) -> Result<ScreenshotImage, RenderError> {
    let scale = viewport.scale();
    let (width, height) = viewport.size();
    let (width, height) = ((width * scale).max(1), (height * scale).max(1));
    viewport.session().read(|session| {
        let note = note(session.document(), session.camera_controller())(&FrameSpec { state: session.state(), turntable: 0.0 });
        let (scene, frame, camera, mut display) = session.picture();
        display.scale = scale as f32;
        display.highlight.hovered = None;
        if transparent {
            display.background = Background::Transparent;
        }
        let job = RenderJob { scene, frame, camera: &camera, display: &display, width: width as u32, height: height as u32 };
        let pixels = viewport.with_renderer(|renderer| renderer.draw(&job).cloned())?;
        Ok(ScreenshotImage { pixels, transparent, note })
    })
}

/// The picture as the clipboard takes it.
fn texture(picture: &ScreenshotImage) -> gdk::Texture {
    let Framebuffer { width, height, pixels } = &picture.pixels;
    let opaque = if picture.transparent { 0 } else { 0xFF00_0000 };
    let bytes: Vec<u8> = pixels.iter().flat_map(|pixel| (pixel | opaque).to_ne_bytes()).collect();
    let format =
        if cfg!(target_endian = "little") { gdk::MemoryFormat::B8g8r8a8Premultiplied } else { gdk::MemoryFormat::A8r8g8b8Premultiplied };
    // No side is longer than a screen.
    gdk::MemoryTexture::new(*width as i32, *height as i32, format, &glib::Bytes::from_owned(bytes), *width as usize * 4).upcast()
}

/// Copies the picture.
pub(crate) fn copy(app: &AppContext, viewport: &Viewport) {
    match take(viewport, false) {
        Ok(picture) => {
            app.widget.clipboard().set_texture(&texture(&picture));
            app.toasts.toast(&tr!("app-picture-copied"), None);
        }
        Err(error) => app.toasts.toast(&error.sentence(), None),
    }
}

/// Asks where to and saves the picture.
pub(crate) fn save(app: &Rc<AppContext>, viewport: &Viewport, transparent: bool) {
    let picture = match take(viewport, transparent) {
        Ok(picture) => picture,
        Err(error) => return app.toasts.toast(&error.sentence(), None),
    };
    let name = save_as::name_like_open(app, "png");
    let wanted = SaveRequest { title: tr!("app-picture-title"), name, folder: None, endings: &["png"], own: None };
    save_as::ask(app, wanted, move |app, output| {
        let path = output.file();
        let notes = [("Software", SOFTWARE), ("Comment", picture.note.as_str())];
        match png::save(output, &picture.pixels, picture.transparent, &notes) {
            Ok(()) => save_as::done(app, path),
            Err(error) => save_as::failed(app, path, error.sentence()),
        }
    });
}

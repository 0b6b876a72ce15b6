//! The program's own clips and muscles: written to the user's cache folder when one is opened, and drawn for the start page.

use std::io::Write;
use std::path::{Path, PathBuf};

use crate::document::{Document, PoseBuffers};
use crate::export::ExportError;
use crate::formats::SCENE_READERS;
use crate::output::Output;
use crate::output::write_atomic;
use crate::progress::Progress;
use crate::render::{Background, Display, OverlayPalette, RenderJob, Renderer, Theme};
use crate::scene::{Frame, OrbitCamera, ViewDirection};

/// A shipped scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Demo {
    /// The key of its name in the catalogue.
    pub name: &'static str,
    /// Its files, the one to open first; none = the built-in scene. Clips that a muscle file names come after it.
    files: &'static [(&'static str, &'static [u8])],
}

macro_rules! shipped {
    ($($file:literal),*) => {
        &[$(($file, include_bytes!(concat!("../../../configs/", $file)))),*]
    };
}

/// All demos, in the order of the start page.
pub(crate) const DEMOS: [Demo; 5] = [
    Demo { name: "app-demo-biceps", files: &[] },
    Demo { name: "app-demo-curl", files: shipped!("curl-muscles.yaml", "curl.dae") },
    Demo { name: "app-demo-atlas", files: shipped!("atlas-muscles.yaml", "atlas.dae") },
    Demo { name: "app-demo-walker", files: shipped!("walker.dae", "walker.png") },
    Demo { name: "app-demo-lamp", files: shipped!("lamp.dae") },
];

impl Demo {
    /// Writes its files into `folder`, where they are not there already, and names the one to open; `None` for the built-in scene.
    ///
    /// # Errors
    /// [`ExportError`].
    pub(crate) fn unpack(&self, folder: &Path) -> Result<Option<PathBuf>, ExportError> {
        for (name, bytes) in self.files {
            let path = folder.join(name);
            if std::fs::read(&path).ok().as_deref() != Some(*bytes) {
                std::fs::create_dir_all(folder).map_err(|error| ExportError::io(folder, error))?;
                write_atomic(&Output::of_program(&path), |file| file.write_all(bytes))?;
            }
        }
        Ok(self.files.first().map(|(name, _)| folder.join(name)))
    }

    /// Draws it, a third of its clip on or half bent, in the colours of a theme; `width · height` pixels of `0xAARRGGBB`. `None` where it cannot be written or there is no memory for it.
    pub(crate) fn draw(&self, folder: &Path, theme: Theme, width: u32, height: u32) -> Option<Vec<u32>> {
        let document = match self.unpack(folder).ok()? {
            Some(path) => Document::open(&[path], SCENE_READERS, &Progress::default()).ok()?,
            None => Document::built_in(),
        };
        let mut state = document.start_state();
        if let Some(clip) = state.clip.and_then(|clip| document.clips.get(clip)) {
            state.time = clip.start + clip.duration() * 0.35;
        }
        if let Some(rig) = document.driven_rig() {
            state.joints.drive = rig.at_contraction(50.0);
        }
        let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
        document.pose(&state, &mut buffers, &mut frame);
        let palette = OverlayPalette::of(theme);
        let display = Display {
            palette,
            background: Background::Gradient(palette.background.0, palette.background.1),
            grid: false,
            ..Display::default()
        };
        let mut orbit = OrbitCamera::default();
        orbit.look_from(ViewDirection::Start);
        orbit.fit(&frame.bounds, width as f32 / height as f32);
        let mut renderer = Renderer::new(Some(1));
        let job = RenderJob { scene: &document.scene, frame: &frame, camera: &orbit.camera(), display: &display, width, height };
        Some(renderer.draw(&job).ok()?.pixels.to_vec())
    }
}

/// Where demos are written: `sinew/demos` in the user's cache folder.
pub(crate) fn folder() -> PathBuf {
    gtk4::glib::user_cache_dir().join("sinew").join("demos")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tr;

    #[test]
    fn every_demo_has_a_name_opens_and_shows_something() {
        let folder = tempfile::tempdir().expect("a folder");
        for demo in DEMOS {
            assert_ne!(tr!(demo.name), demo.name);
            let pixels = demo.draw(folder.path(), Theme::Light, 64, 48).expect("drawn");
            assert_eq!(pixels.len(), 64 * 48);
            // The background is the same along each row; something stands before it.
            assert!(pixels.chunks(64).any(|row| row.iter().any(|pixel| pixel != &row[0])), "{}", demo.name);
            let Some(path) = demo.unpack(folder.path()).expect("unpacked") else { continue };
            let document = Document::open(&[path], SCENE_READERS, &Progress::default()).expect("opened");
            assert!(document.diagnostics.iter().all(|finding| finding.code() != "clip-not-opened"), "{}", demo.name);
        }
    }

    #[test]
    fn a_spoiled_copy_is_written_again() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = DEMOS[4].unpack(folder.path()).expect("unpacked").expect("a file");
        std::fs::write(&path, "spoiled").expect("written");
        DEMOS[4].unpack(folder.path()).expect("unpacked");
        assert_eq!(std::fs::read(&path).expect("read"), DEMOS[4].files[0].1);
    }
}

//! The finished picture.

use super::RenderError;
use super::memory::zeroed;

/// A finished picture: 32 bits a pixel, `0xAARRGGBB` in native byte order (cairo's ARGB32 / RGB24), premultiplied, rows from the top.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Framebuffer {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// `width · height` pixels.
    pub pixels: Vec<u32>,
}

impl Framebuffer {
    /// An empty picture.
    ///
    /// # Errors
    /// [`RenderError::OutOfMemory`] where the system gives no memory for it.
    pub fn new(width: u32, height: u32) -> Result<Self, RenderError> {
        Ok(Self { width, height, pixels: zeroed(width as usize * height as usize)? })
    }

    /// Takes another size; what the pixels hold then is of no use.
    pub(super) fn resize(&mut self, width: u32, height: u32) -> Result<(), RenderError> {
        let count = width as usize * height as usize;
        if self.pixels.capacity() < count {
            // The old one goes first, so that there is never memory for two.
            *self = Self::default();
            *self = Self::new(width, height)?;
        }
        self.pixels.resize(count, 0);
        (self.width, self.height) = (width, height);
        Ok(())
    }
}

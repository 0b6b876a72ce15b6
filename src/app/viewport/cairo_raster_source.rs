//! A surface as a source that cairo borrows instead of copying.
//!
//! A surface that was painted from is copied before it is drawn into again, because the painting may have been recorded and cairo keeps its word that a
//! recording shows what was there. A raster source has no such promise: the surface is requested when the recording is replayed. So the owner must not draw into
//! a surface that is in use; the number of references tells, and `ImageSurface::data` refuses where there is more than one.

use std::ffi::c_int;

use gtk::cairo::{Content, ImageSurface, Pattern, ffi};
use gtk4 as gtk;

type Acquire = unsafe extern "C" fn(
    *mut ffi::cairo_pattern_t,
    *mut ffi::cairo_surface_t,
    *mut ffi::cairo_surface_t,
    *const ffi::cairo_rectangle_int_t,
) -> *mut ffi::cairo_surface_t;
type Release = unsafe extern "C" fn(*mut ffi::cairo_pattern_t, *mut ffi::cairo_surface_t, *mut ffi::cairo_surface_t);
type Copy = unsafe extern "C" fn(*mut ffi::cairo_pattern_t, *mut ffi::cairo_surface_t, *const ffi::cairo_pattern_t) -> ffi::cairo_status_t;
type Finish = unsafe extern "C" fn(*mut ffi::cairo_pattern_t, *mut ffi::cairo_surface_t);

// In cairo since 1.12, and not bound by cairo-rs. What is passed through, a `void*` in C, is always a surface here.
unsafe extern "C" {
    fn cairo_pattern_create_raster_source(
        surface_in_use: *mut ffi::cairo_surface_t,
        content: ffi::cairo_content_t,
        width: c_int,
        height: c_int,
    ) -> *mut ffi::cairo_pattern_t;
    fn cairo_raster_source_pattern_set_acquire(pattern: *mut ffi::cairo_pattern_t, acquire: Acquire, release: Release);
    fn cairo_raster_source_pattern_set_copy(pattern: *mut ffi::cairo_pattern_t, copy: Copy);
    fn cairo_raster_source_pattern_set_finish(pattern: *mut ffi::cairo_pattern_t, finish: Finish);
}

/// A source of the pixels of `surface`, its corner at the origin.
pub(super) fn source(surface: &ImageSurface) -> Pattern {
    let surface_in_use = surface.to_raw_none();
    // SAFETY: the pattern holds a reference to the surface, taken here and given back by `finish`; copies of it take theirs. The callbacks are told the
    // pointer that is passed here. Width and height are the surface's, which is an image.
    unsafe {
        ffi::cairo_surface_reference(surface_in_use);
        let pattern = cairo_pattern_create_raster_source(surface_in_use, Content::Color.into(), surface.width(), surface.height());
        cairo_raster_source_pattern_set_acquire(pattern, acquire, release);
        cairo_raster_source_pattern_set_copy(pattern, copy);
        cairo_raster_source_pattern_set_finish(pattern, finish);
        Pattern::from_raw_full(pattern)
    }
}

unsafe extern "C" fn acquire(
    _: *mut ffi::cairo_pattern_t,
    surface_in_use: *mut ffi::cairo_surface_t,
    _: *mut ffi::cairo_surface_t,
    _: *const ffi::cairo_rectangle_int_t,
) -> *mut ffi::cairo_surface_t {
    // SAFETY: the pattern's own reference keeps it alive.
    unsafe { ffi::cairo_surface_reference(surface_in_use) }
}

unsafe extern "C" fn release(_: *mut ffi::cairo_pattern_t, _: *mut ffi::cairo_surface_t, acquired: *mut ffi::cairo_surface_t) {
    // SAFETY: the reference that `acquire` handed out.
    unsafe { ffi::cairo_surface_destroy(acquired) }
}

unsafe extern "C" fn copy(
    _: *mut ffi::cairo_pattern_t,
    surface_in_use: *mut ffi::cairo_surface_t,
    _: *const ffi::cairo_pattern_t,
) -> ffi::cairo_status_t {
    // SAFETY: the pattern that is copied keeps it alive until the copy has a reference too.
    unsafe { ffi::cairo_surface_reference(surface_in_use) };
    ffi::STATUS_SUCCESS
}

unsafe extern "C" fn finish(_: *mut ffi::cairo_pattern_t, surface_in_use: *mut ffi::cairo_surface_t) {
    // SAFETY: the reference of this pattern, which is not used after this.
    unsafe { ffi::cairo_surface_destroy(surface_in_use) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gtk::cairo::{Context, Filter, Format, Operator, RecordingSurface};

    /// A surface of stripes.
    fn striped(width: i32, height: i32) -> ImageSurface {
        let mut surface = ImageSurface::create(Format::Rgb24, width, height).expect("a surface");
        for (i, byte) in surface.data().expect("its pixels").iter_mut().enumerate() {
            *byte = (i * 37 % 251) as u8;
        }
        surface
    }

    fn references(surface: &ImageSurface) -> u32 {
        // SAFETY: the surface is alive.
        unsafe { ffi::cairo_surface_get_reference_count(surface.to_raw_none()) }
    }

    /// Paints onto a black picture twice the size, scaled by `scale`, with either kind of source.
    fn painted(surface: &ImageSurface, scale: f64, borrowed: bool) -> Vec<u8> {
        let recorded = RecordingSurface::create(Content::ColorAlpha, None).expect("a recording");
        {
            let context = Context::new(&recorded).expect("a context");
            context.scale(scale, scale);
            if borrowed {
                context.set_source(source(surface)).expect("a source");
            } else {
                context.set_source_surface(surface, 0.0, 0.0).expect("a source");
            }
            context.source().set_filter(Filter::Nearest);
            context.set_operator(Operator::Source);
            context.paint().expect("painted");
        }
        let mut target = ImageSurface::create(Format::Rgb24, 2 * surface.width(), 2 * surface.height()).expect("a target");
        {
            let context = Context::new(&target).expect("a context");
            context.set_source_surface(&recorded, 0.0, 0.0).expect("a source");
            context.paint().expect("replayed");
        }
        drop(recorded);
        target.data().expect("its pixels").to_vec()
    }

    #[test]
    fn what_is_borrowed_looks_like_what_is_copied() {
        let surface = striped(23, 17);
        for scale in [1.0, 2.0] {
            let copied = painted(&surface, scale, false);
            assert_eq!(painted(&surface, scale, true), copied);
            assert!(copied.iter().any(|byte| *byte != 0));
        }
    }

    #[test]
    fn references_are_given_back() {
        let mut surface = striped(8, 8);
        let before = references(&surface);
        painted(&surface, 1.0, true);
        assert_eq!(references(&surface), before);
        let (pattern, recorded) = (source(&surface), RecordingSurface::create(Content::ColorAlpha, None).expect("a recording"));
        let context = Context::new(&recorded).expect("a context");
        context.set_source(&pattern).expect("a source");
        context.paint().expect("painted");
        drop((context, pattern));
        assert!(surface.data().is_err(), "a recording holds it, so nobody may draw into it");
        drop(recorded);
        assert_eq!(references(&surface), before);
        assert!(surface.data().is_ok());
    }
}

//! The surfaces that pictures are drawn into: kept, used again, and filled by the renderer without a copy.
//!
//! There are three, in turn: GTK holds on to the last two pictures, and borrows them (see [`super::cairo_raster_source`]).

use std::collections::VecDeque;
use std::time::Instant;

use gtk::cairo::{Context, Filter, Format, ImageSurface, Operator};
use gtk4 as gtk;

use super::ignore;
use crate::render::{RenderJob, RenderTarget, Renderer, Stats};
use crate::session::Session;

/// How many frames the frame rate is taken over.
const FRAMES: usize = 30;

/// The kept surfaces and what draws into them.
pub(super) struct FrameSurface {
    /// The rasterizer.
    pub renderer: Renderer,
    /// Whether the surface shows the session as it is.
    pub fresh: bool,
    /// Milliseconds that the last frame in full took.
    pub full_ms: f64,
    /// The one that is shown, and those before it.
    surfaces: [Option<ImageSurface>; 3],
    /// Width and height that were asked for, device pixels.
    size: (i32, i32),
    times: VecDeque<Instant>,
}

impl FrameSurface {
    /// An empty one.
    pub(super) fn new() -> Self {
        Self {
            renderer: Renderer::new(None),
            fresh: false,
            full_ms: 0.0,
            surfaces: [None, None, None],
            size: (0, 0),
            times: VecDeque::with_capacity(FRAMES),
        }
    }

    /// Whether the surface shows the session as it is, in this size.
    pub(super) fn is_fresh(&self, width: i32, height: i32) -> bool {
        self.fresh && self.size == (width, height)
    }

    /// Frames a second over the last few; 0 where the last one is long ago.
    pub(super) fn rate(&self) -> f64 {
        match (self.times.front(), self.times.back()) {
            (Some(first), Some(last)) if last > first && last.elapsed().as_secs_f64() < 1.0 => {
                (self.times.len() - 1) as f64 / (*last - *first).as_secs_f64()
            }
            _ => 0.0,
        }
    }

    /// Draws the session; `coarse` at half the resolution. `None` where there is no memory for the picture.
    pub(super) fn draw(&mut self, session: &mut Session, width: i32, height: i32, scale: i32, coarse: bool) -> Option<Stats> {
        let part = if coarse { 2 } else { 1 };
        let (drawn_width, drawn_height) = ((width / part).max(1), (height / part).max(1));
        let fits = |surface: &ImageSurface| surface.width() == drawn_width && surface.height() == drawn_height;
        let mut surface =
            self.surfaces[2].take().filter(fits).or_else(|| ImageSurface::create(Format::Rgb24, drawn_width, drawn_height).ok())?;
        // GTK may hold more than the last two pictures; then this one gets a surface of its own.
        if surface.data().is_err() {
            surface = ImageSurface::create(Format::Rgb24, drawn_width, drawn_height).ok()?;
        }
        let stride = usize::try_from(surface.stride()).ok()?;
        {
            let mut data = surface.data().ok()?;
            let (scene, frame, camera, mut display) = session.picture();
            display.scale = scale as f32 / part as f32;
            let job =
                RenderJob { scene, frame, camera: &camera, display: &display, width: drawn_width as u32, height: drawn_height as u32 };
            self.renderer.draw_into(&job, RenderTarget { bytes: &mut data, stride }).ok()?;
        }
        self.surfaces.rotate_right(1);
        self.surfaces[0] = Some(surface);
        self.size = (width, height);
        self.fresh = true;
        let now = Instant::now();
        if self.times.back().is_some_and(|last| (now - *last).as_secs_f64() > 0.5) {
            self.times.clear();
        }
        if self.times.len() == FRAMES {
            self.times.pop_front();
        }
        self.times.push_back(now);
        Some(self.renderer.stats())
    }

    /// Puts the surface on the screen, pixel for pixel.
    pub(super) fn show(&self, context: &Context, scale: i32) {
        let [Some(surface), ..] = &self.surfaces else { return };
        let (width, height) = (f64::from(self.size.0) / f64::from(scale), f64::from(self.size.1) / f64::from(scale));
        context.scale(width / f64::from(surface.width()), height / f64::from(surface.height()));
        ignore(context.set_source(super::cairo_raster_source::source(surface)));
        let whole = surface.width() == self.size.0;
        context.source().set_filter(if whole { Filter::Nearest } else { Filter::Bilinear });
        context.set_operator(Operator::Source);
        ignore(context.paint());
    }
}

//! Plots on a page, two beside each other under a heading, as SVG or PNG.

use super::raster::{Fonts, PixmapCanvas};
use super::svg::SvgCanvas;
use super::{BACKGROUND, Canvas, Color, Plot, Stroke, TextAnchor};
use sinew_scene::limits;
use sinew_scene::message;
use sinew_scene::message::{Message, ToMessage};

/// Size of a plot on the page and the room about it, logical pixels.
const WIDTH: f64 = 400.0;
const HEIGHT: f64 = 250.0;
const MARGIN: f64 = 16.0;
const HEADING: f64 = 26.0;
/// Size of a picture that still opens everywhere, pixels to a side.
const MAX_PIXELS: f64 = 20_000.0;

/// Sections of plots.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Page {
    /// Each with its heading.
    pub sections: Vec<(String, Vec<Plot>)>,
}

/// Why a page could not be drawn to pixels.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{}", self.message())]
pub enum PlotError {
    /// There is no font on the machine; SVG needs none.
    NoFont,
    /// The picture would be too large.
    TooLarge,
    /// The system gave no memory for it.
    Memory,
    /// Packing failed.
    Png(String),
}

impl ToMessage for PlotError {
    fn message(&self) -> Message {
        match self {
            Self::NoFont => message!("plot-no-font"),
            Self::TooLarge => message!("plot-too-large"),
            Self::Memory => message!("plot-memory"),
            Self::Png(words) => Message::verbatim(words),
        }
    }
}

impl Page {
    fn size(&self) -> (f64, f64) {
        let rows = |plots: &[Plot]| plots.len().div_ceil(2) as f64;
        let columns = if self.sections.iter().any(|(_, plots)| plots.len() > 1) { 2.0 } else { 1.0 };
        let height: f64 = self.sections.iter().map(|(_, plots)| HEADING + rows(plots) * (HEIGHT + MARGIN)).sum();
        (columns * (WIDTH + MARGIN) + MARGIN, height + MARGIN)
    }

    /// Draws it.
    fn draw(&self, canvas: &mut dyn Canvas) {
        let (width, height) = self.size();
        canvas.rectangle([0.0, 0.0, width, height], Color::Rgb(BACKGROUND), 1.0);
        let mut top = MARGIN;
        for (heading, plots) in &self.sections {
            canvas.text(heading, (MARGIN, top), TextAnchor::Start, Color::Text, 1.0);
            top += HEADING;
            for (index, plot) in plots.iter().enumerate() {
                let left = MARGIN + (index % 2) as f64 * (WIDTH + MARGIN);
                plot.draw(&mut Offset { canvas, by: (left, top) }, WIDTH, HEIGHT);
                if index % 2 == 1 || index + 1 == plots.len() {
                    top += HEIGHT + MARGIN;
                }
            }
        }
    }

    /// An SVG 1.1 document.
    pub fn svg(&self) -> String {
        let (width, height) = self.size();
        let mut document = SvgCanvas::new(width, height);
        self.draw(&mut document);
        document.finish()
    }

    /// A PNG picture, `scale` pixels a logical pixel, at least 0.1 and at most 8.
    ///
    /// # Errors
    /// [`PlotError`] where there is no font, or the picture would be too large.
    pub fn png(&self, scale: f64) -> Result<Vec<u8>, PlotError> {
        let scale = scale.clamp(0.1, 8.0);
        let (width, height) = self.size();
        if (width.max(height) * scale) > MAX_PIXELS {
            return Err(PlotError::TooLarge);
        }
        // The picture, its rows of three bytes a pixel, and what they are packed into.
        if !limits::is_room((width * scale * height * scale * 10.0) as u64) {
            return Err(PlotError::Memory);
        }
        let fonts = Fonts::find().ok_or(PlotError::NoFont)?;
        let mut pixels = PixmapCanvas::new(width, height, scale, &fonts).ok_or(PlotError::TooLarge)?;
        self.draw(&mut pixels);
        pixels.png().map_err(|error| PlotError::Png(error.to_string()))
    }
}

/// The same ink somewhere else.
struct Offset<'a> {
    canvas: &'a mut dyn Canvas,
    by: (f64, f64),
}

impl Offset<'_> {
    fn translated(&self, (x, y): (f64, f64)) -> (f64, f64) {
        (x + self.by.0, y + self.by.1)
    }
}

impl Canvas for Offset<'_> {
    fn rectangle(&mut self, [x, y, width, height]: [f64; 4], color: Color, opacity: f64) {
        let (x, y) = self.translated((x, y));
        self.canvas.rectangle([x, y, width, height], color, opacity);
    }

    fn line(&mut self, points: &[(f64, f64)], stroke: Stroke) {
        let points: Vec<(f64, f64)> = points.iter().map(|point| self.translated(*point)).collect();
        self.canvas.line(&points, stroke);
    }

    fn disc(&mut self, centre: (f64, f64), radius: f64, color: Color, ring: Option<f64>) {
        self.canvas.disc(self.translated(centre), radius, color, ring);
    }

    fn text(&mut self, text: &str, at: (f64, f64), anchor: TextAnchor, color: Color, opacity: f64) {
        self.canvas.text(text, self.translated(at), anchor, color, opacity);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plot::Series;

    fn page() -> Page {
        let plot = Plot {
            x_label: "Elbow angle, °".into(),
            y_label: "Length, <mm> & \"more\"".into(),
            points: (0..=90).map(|angle| (f64::from(angle), f64::from(angle).to_radians().sin())).collect(),
            color: 0xC0_392B,
            reference_series: vec![Series { name: "Arm26".into(), points: vec![(0.0, 0.1), (45.0, 0.6)] }],
            ..Plot::default()
        };
        Page { sections: vec![("Бицепс".into(), vec![plot.clone(), plot.clone(), plot])] }
    }

    #[test]
    fn the_svg_is_well_formed_and_holds_every_curve() {
        let text = page().svg();
        let document = roxmltree::Document::parse(&text).unwrap();
        let lines = document.descendants().filter(|node| node.has_tag_name("polyline"));
        let lengths: Vec<usize> = lines.map(|node| node.attribute("points").unwrap().split_whitespace().count()).collect();
        assert_eq!(lengths, [2, 91, 2, 91, 2, 91]);
        assert!(text.contains("Бицепс") && text.contains("&lt;mm&gt; &amp;"));
        let size = document.root_element().attribute("viewBox").unwrap();
        assert_eq!(size, "0 0 848 574");
    }

    #[test]
    fn the_picture_is_the_page_in_pixels() {
        let bytes = match page().png(2.0) {
            Ok(bytes) => bytes,
            // A machine without fonts says so and writes nothing.
            Err(error) => return assert_eq!(error, PlotError::NoFont),
        };
        let picture = image::load_from_memory(&bytes).unwrap().to_rgb8();
        assert_eq!(picture.dimensions(), (1696, 1148));
        assert_eq!(picture.get_pixel(0, 0).0, [255; 3]);
        // The curve is there in its colour, three times.
        let red =
            |left: u32, top: u32| (left..left + 800).any(|x| (top..top + 500).any(|y| picture.get_pixel(x, y).0 == [0xC0, 0x39, 0x2B]));
        assert!(red(32, 84) && red(864, 84) && red(32, 616) && !red(864, 640));
        assert_eq!(page().png(2.0).unwrap(), bytes);
    }

    #[test]
    fn what_would_be_too_large_is_refused() {
        let (heading, plots) = page().sections.remove(0);
        let long = Page { sections: vec![(heading, plots.into_iter().cycle().take(400).collect())] };
        assert_eq!(long.png(8.0), Err(PlotError::TooLarge));
        assert!(Page::default().svg().contains("<svg"));
    }
}

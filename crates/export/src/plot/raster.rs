//! A plot as pixels: shapes by `tiny-skia`, letters by `ab_glyph` in a font of the machine that `fontdb` finds.

use ab_glyph::{Font, FontVec, OutlineCurve, ScaleFont};
use tiny_skia::{FillRule, LineJoin, Paint, Path, PathBuilder, Pixmap, Rect, StrokeDash, Transform};

use super::TEXT_COLOR;
use super::{Canvas, Color, Stroke, TextAnchor};

/// Size of text and the height of its letters above the base line, logical pixels.
const SIZE: f32 = 11.0;
const ASCENT: f32 = 10.5;
/// Families that have Latin, Cyrillic and the signs of units, in the order in which they are taken.
const FAMILIES: [&str; 6] = ["DejaVu Sans", "Noto Sans", "Liberation Sans", "Cantarell", "Arial", "Helvetica"];
/// How far a circle's Bézier handles reach, in radii.
const CIRCLE_HANDLE: f32 = 0.552_284_8;

/// A font of the machine.
pub(super) struct Fonts(FontVec);

impl Fonts {
    /// The first of the known families, else any upright font that has letters.
    pub(super) fn find() -> Option<Self> {
        let mut found = fontdb::Database::new();
        found.load_system_fonts();
        let families = FAMILIES.map(fontdb::Family::Name);
        let known = found.query(&fontdb::Query { families: &families, ..fontdb::Query::default() });
        let upright = found.faces().filter(|face| face.style == fontdb::Style::Normal).map(|face| face.id);
        known.into_iter().chain(upright).find_map(|id| {
            let (bytes, index) = found.with_face_data(id, |bytes, index| (bytes.to_vec(), index))?;
            let font = FontVec::try_from_vec_and_index(bytes, index).ok()?;
            ['A', '0', '°'].iter().all(|letter| font.glyph_id(*letter).0 != 0).then_some(Self(font))
        })
    }
}

/// A picture that is being drawn.
pub(super) struct PixmapCanvas<'a> {
    pixmap: Pixmap,
    scale: f32,
    font: &'a FontVec,
}

impl<'a> PixmapCanvas<'a> {
    /// An empty one of this size in logical pixels; `None` where it would be empty or too large.
    pub(super) fn new(width: f64, height: f64, scale: f64, fonts: &'a Fonts) -> Option<Self> {
        let map = Pixmap::new((width * scale).round() as u32, (height * scale).round() as u32)?;
        Some(Self { pixmap: map, scale: scale as f32, font: &fonts.0 })
    }

    /// As PNG.
    pub(super) fn png(&self) -> Result<Vec<u8>, png::EncodingError> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.pixmap.width(), self.pixmap.height());
        encoder.set_color(png::ColorType::Rgb);
        // The ground is opaque, so every pixel is.
        let rows: Vec<u8> = self.pixmap.pixels().iter().flat_map(|pixel| [pixel.red(), pixel.green(), pixel.blue()]).collect();
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&rows)?;
        writer.finish()?;
        Ok(bytes)
    }

    fn transform(&self) -> Transform {
        Transform::from_scale(self.scale, self.scale)
    }

    fn fill(&mut self, path: &Path, color: Color, opacity: f64) {
        let at = self.transform();
        self.pixmap.fill_path(path, &paint(color, opacity), FillRule::Winding, at, None);
    }

    fn stroke(&mut self, path: &Path, color: Color, stroke: &tiny_skia::Stroke) {
        let at = self.transform();
        self.pixmap.stroke_path(path, &paint(color, 1.0), stroke, at, None);
    }
}

fn paint(color: Color, opacity: f64) -> Paint<'static> {
    let color = match color {
        Color::Text => TEXT_COLOR,
        Color::Rgb(color) => color,
    };
    let part = |shift: u32| ((color >> shift) & 0xFF) as u8;
    let mut paint = Paint::default();
    paint.set_color_rgba8(part(16), part(8), part(0), (opacity.clamp(0.0, 1.0) * 255.0).round() as u8);
    paint
}

fn circle(x: f32, y: f32, radius: f32) -> Option<Path> {
    let handle = radius * CIRCLE_HANDLE;
    let mut path = PathBuilder::new();
    path.move_to(x + radius, y);
    path.cubic_to(x + radius, y + handle, x + handle, y + radius, x, y + radius);
    path.cubic_to(x - handle, y + radius, x - radius, y + handle, x - radius, y);
    path.cubic_to(x - radius, y - handle, x - handle, y - radius, x, y - radius);
    path.cubic_to(x + handle, y - radius, x + radius, y - handle, x + radius, y);
    path.close();
    path.finish()
}

impl Canvas for PixmapCanvas<'_> {
    fn rectangle(&mut self, [x, y, width, height]: [f64; 4], color: Color, opacity: f64) {
        if let Some(place) = Rect::from_xywh(x as f32, y as f32, width as f32, height as f32) {
            self.fill(&PathBuilder::from_rect(place), color, opacity);
        }
    }

    fn line(&mut self, points: &[(f64, f64)], stroke: Stroke) {
        let mut path = PathBuilder::new();
        for (index, (x, y)) in points.iter().enumerate() {
            let (x, y) = (*x as f32, *y as f32);
            if index == 0 { path.move_to(x, y) } else { path.line_to(x, y) }
        }
        let dash = if stroke.dashed { StrokeDash::new(vec![5.0, 4.0], 0.0) } else { None };
        let stroke_style =
            tiny_skia::Stroke { width: stroke.width as f32, line_join: LineJoin::Round, dash, ..tiny_skia::Stroke::default() };
        if let Some(path) = path.finish() {
            self.stroke(&path, stroke.color, &stroke_style);
        }
    }

    fn disc(&mut self, (x, y): (f64, f64), radius: f64, color: Color, ring: Option<f64>) {
        let Some(path) = circle(x as f32, y as f32, radius as f32) else { return };
        match ring {
            Some(width) => self.stroke(&path, color, &tiny_skia::Stroke { width: width as f32, ..tiny_skia::Stroke::default() }),
            None => self.fill(&path, color, 1.0),
        }
    }

    fn text(&mut self, text: &str, (x, y): (f64, f64), anchor: TextAnchor, color: Color, opacity: f64) {
        let font = self.font.as_scaled(self.font.pt_to_px_scale(SIZE * 0.75).unwrap_or(SIZE.into()));
        let width: f32 = text.chars().map(|letter| font.h_advance(font.glyph_id(letter))).sum();
        let mut left = match anchor {
            TextAnchor::Start => x as f32,
            TextAnchor::Middle => x as f32 - width / 2.0,
            TextAnchor::End => x as f32 - width,
        };
        let base = y as f32 + ASCENT;
        let mut path = PathBuilder::new();
        for letter in text.chars() {
            let glyph = font.glyph_id(letter);
            let unit = font.scale_factor();
            let place = |point: ab_glyph::Point| (left + point.x * unit.horizontal, base - point.y * unit.vertical);
            let mut pen = None;
            for curve in self.font.outline(glyph).into_iter().flat_map(|outline| outline.curves) {
                let (start, end) = match &curve {
                    OutlineCurve::Line(a, b) | OutlineCurve::Quad(a, _, b) | OutlineCurve::Cubic(a, _, _, b) => (*a, *b),
                };
                if pen != Some(start) {
                    let (x, y) = place(start);
                    path.move_to(x, y);
                }
                pen = Some(end);
                let (x, y) = place(end);
                match curve {
                    OutlineCurve::Line(..) => path.line_to(x, y),
                    OutlineCurve::Quad(_, handle, _) => {
                        let (hx, hy) = place(handle);
                        path.quad_to(hx, hy, x, y);
                    }
                    OutlineCurve::Cubic(_, first, second, _) => {
                        let ((ax, ay), (bx, by)) = (place(first), place(second));
                        path.cubic_to(ax, ay, bx, by, x, y);
                    }
                }
            }
            left += font.h_advance(glyph);
        }
        if let Some(path) = path.finish() {
            self.fill(&path, color, opacity);
        }
    }
}

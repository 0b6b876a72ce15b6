//! Auxiliary lines: ground grid, axes, bounding boxes, normals, the light.

use glam::{Mat4, Vec3};

use super::Display;
use super::binning::BandLayout;
use super::draw_list::rgb;
use super::line::{LinePass, LineSegments, LineStyle};
use super::projection::ViewTransform;
use sinew_scene::{Bounds, Frame, NodeId, SurfaceGeometry};

/// Everything that drawing a helper line needs.
pub(super) struct LineBuilder<'a> {
    pub view: &'a ViewTransform,
    pub bands: &'a BandLayout,
    pub display: &'a Display,
    pub segments: &'a mut LineSegments,
}

impl LineBuilder<'_> {
    pub(super) fn line(&mut self, a: Vec3, b: Vec3, line_style: &LineStyle) {
        self.segments.line(self.view, self.bands, a, b, line_style);
    }

    /// A line over the surfaces, brought a little forward.
    pub(super) fn line_style(&self, color: [f32; 3], alpha: f32, width: f32) -> LineStyle {
        let (stage, depth_test) = (LinePass::Over, self.display.depth_test);
        LineStyle { color, alpha: [alpha; 2], width: width * self.scale() * self.thickness(), pass: stage, depth_test, depth_bias: 1.0 }
    }

    /// Device pixels a logical pixel.
    pub(super) fn scale(&self) -> f32 {
        if self.display.scale.is_finite() { self.display.scale.clamp(0.25, 8.0) } else { 1.0 }
    }

    /// How many times as wide as usual lines are.
    fn thickness(&self) -> f32 {
        if self.display.line_width.is_finite() { self.display.line_width.clamp(0.5, 4.0) } else { 1.0 }
    }

    /// The helpers that the display asks for.
    pub(super) fn helpers(&mut self, frame: &Frame, light: Vec3) {
        let display = self.display;
        let size = frame.bounds.diagonal().max(1e-6);
        if display.axes {
            for (axis, color) in [Vec3::X, Vec3::Y, Vec3::Z].into_iter().zip(display.palette.axes) {
                let line_style = self.line_style(rgb(color), 1.0, 2.0);
                self.line(Vec3::ZERO, axis * size * 0.3, &line_style);
            }
        }
        if display.bounding_box && !frame.bounds.is_empty() {
            let line_style = self.line_style(rgb(display.palette.grid.0), (display.palette.grid.1 * 4.0).min(1.0), 1.2);
            let corners = frame.bounds.corners();
            for (i, a) in corners.iter().enumerate() {
                for bit in [1, 2, 4] {
                    if i & bit == 0 {
                        self.line(*a, corners[i | bit], &line_style);
                    }
                }
            }
        }
        if display.light_marker {
            self.light(light);
        }
        if display.normal_glyphs {
            self.normals(frame, size * 0.012);
        }
    }

    /// A small sun: a dot with eight rays, always of the same size.
    fn light(&mut self, at: Vec3) {
        let pixel = self.view.pixel_at(at) * self.scale();
        let color = [1.0, 0.86, 0.45];
        let dot = LineStyle { depth_test: false, ..self.line_style(color, 1.0, 10.0) };
        self.line(at, at, &dot);
        let ray = LineStyle { depth_test: false, ..self.line_style(color, 0.9, 1.6) };
        for k in 0..8 {
            let (sin, cos) = (k as f32 * std::f32::consts::FRAC_PI_4).sin_cos();
            let towards = self.view.right * cos + self.view.up * sin;
            self.line(at + towards * (pixel * 8.5), at + towards * (pixel * 12.5), &ray);
        }
    }

    /// A line along each vertex normal of what is shown.
    fn normals(&mut self, frame: &Frame, length: f32) {
        let line_style = self.line_style(rgb(self.display.palette.axes[2]), 0.9, 1.0);
        for surface in frame.surfaces.iter().filter(|surface| surface.visible && surface.ghost.is_none()) {
            if !(if surface.is_fibrous() { self.display.muscle } else { self.display.mesh }) {
                continue;
            }
            let mut one = |p: Vec3, n: Vec3| self.line(p, p + n.normalize_or_zero() * length, &line_style);
            match &surface.geometry {
                SurfaceGeometry::Deformed { positions, normals } => positions.iter().zip(normals).for_each(|(p, n)| one(*p, *n)),
                SurfaceGeometry::Rigid(matrix) => {
                    let turn = super::draw_data::normal_matrix(matrix);
                    let mesh = &surface.mesh;
                    mesh.positions.iter().zip(&mesh.normals).for_each(|(p, n)| one(matrix.transform_point3(*p), turn * *n));
                }
            }
        }
    }

    /// The three axes of a node, this long.
    pub(super) fn node_axes(&mut self, frame: &Frame, node: NodeId, length: f32) {
        let Some(matrix) = frame.world.get(node.index()) else { return };
        let matrix: Mat4 = matrix.as_mat4();
        let at = matrix.w_axis.truncate();
        for (axis, color) in [matrix.x_axis, matrix.y_axis, matrix.z_axis].into_iter().zip(self.display.palette.axes) {
            let line_style =
                LineStyle { pass: LinePass::Overlay, depth_bias: super::bones::DEPTH_BIAS, ..self.line_style(rgb(color), 1.0, 1.5) };
            self.line(at, at + axis.truncate().normalize_or_zero() * length, &line_style);
        }
    }

    /// The ground: lines a power of ten apart, every tenth stronger, fading with distance and where they would crowd.
    pub(super) fn grid(&mut self, bounds: &Bounds) {
        let (center, size) = if bounds.is_empty() { (Vec3::ZERO, 1.0) } else { (bounds.center(), bounds.diagonal().max(1e-6)) };
        // At height 0 where the model stands there, more or less; under it where that would cut it in two.
        let zero = bounds.min.y..=bounds.min.y + 0.2 * bounds.size().y;
        let through_zero = bounds.is_empty() || zero.contains(&0.0);
        let level = if through_zero { 0.0 } else { bounds.min.y };
        let spacing = match self.display.grid_cell {
            // A cell far too small for the scene would be a grey cloud of millions of lines.
            Some(cell) if cell >= size / 500.0 => cell,
            Some(_) => return,
            None => 10f32.powf((size / 4.0).log10().floor()),
        };
        // Farther off than `f32` tells cells apart there would be no lines, only a smear.
        let told_apart = (center / spacing).abs().max_element() < 1e6;
        if !(spacing > 0.0 && spacing.is_finite() && told_apart && size < 1e15) {
            return;
        }
        let radius = size * 1.6;
        let lines = (radius / spacing).ceil() as i32;
        let (color, opacity) = self.display.palette.grid;
        let middle = [(center.x / spacing).round() as i64, (center.z / spacing).round() as i64];
        for along_x in [true, false] {
            for k in -lines..=lines {
                let number = middle[usize::from(along_x)] + i64::from(k);
                let major = number % 10 == 0;
                let offset = k as f32 * spacing;
                let reach = (radius * radius - offset * offset).max(0.0).sqrt();
                let strength = opacity * if major { 1.9 } else { 0.9 };
                let at = |t: f32| {
                    let (line, free) = (number as f32 * spacing, middle[usize::from(!along_x)] as f32 * spacing + t * reach);
                    if along_x { Vec3::new(free, level, line) } else { Vec3::new(line, level, free) }
                };
                let alpha = |t: f32| {
                    let far = ((t * reach).powi(2) + offset * offset) / (radius * radius);
                    let gap = spacing * if major { 10.0 } else { 1.0 } / self.view.pixel_at(at(t)).max(1e-20);
                    let crowding = ((gap - 5.0) / 14.0).clamp(0.0, 1.0);
                    strength * (1.0 - far).max(0.0).powi(2) * crowding
                };
                const PIECES: i32 = 10;
                for piece in 0..PIECES {
                    let [t0, t1] = [piece, piece + 1].map(|i| i as f32 / PIECES as f32 * 2.0 - 1.0);
                    let ends = [alpha(t0), alpha(t1)];
                    if ends[0].max(ends[1]) > 0.004 {
                        let line_style =
                            LineStyle { alpha: ends, pass: LinePass::Under, depth_bias: 0.0, ..self.line_style(rgb(color), 1.0, 1.0) };
                        let (a, b) = (at(t0), at(t1));
                        self.line(a, b, &line_style);
                    }
                }
            }
        }
    }
}

//! The primitives of a mesh: triangles, strips, fans, polygons with holes, lines.

use super::context::{Context, ReadResult, child, children};
use super::source::number_attribute;
use super::triangulate::Triangulator;
use super::vertex_dedup::{Builder, VertexLayout};
use super::{El, Finding};
use glam::Vec3;

/// How the corners of a primitive make faces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum PrimitiveKind {
    /// Three corners each.
    Triangles,
    /// A fan in each `p`.
    Fans,
    /// A strip in each `p`.
    Strips,
    /// As many corners each as `vcount` says.
    Polylist,
    /// A polygon in each `p`, or in `ph` with holes.
    Polygons,
    /// Two corners each.
    Lines,
    /// A line strip in each `p`.
    LineStrips,
}

impl PrimitiveKind {
    /// The shape of a tag; `None` where it is no primitive.
    pub(super) fn of(tag: &str) -> Option<Self> {
        Some(match tag {
            "triangles" => Self::Triangles,
            "trifans" => Self::Fans,
            "tristrips" => Self::Strips,
            "polylist" => Self::Polylist,
            "polygons" => Self::Polygons,
            "lines" => Self::Lines,
            "linestrips" => Self::LineStrips,
            _ => return None,
        })
    }
}

/// What went wrong in one primitive element, counted so that one finding tells it all.
#[derive(Default)]
struct Trouble {
    out_of_range: usize,
    incomplete: usize,
    too_complex: usize,
}

/// The state of reading one primitive element.
struct PrimitiveReader<'r> {
    layout: &'r VertexLayout,
    builder: &'r mut Builder,
    triangulator: &'r mut Triangulator,
    steps: &'r mut u64,
    trouble: Trouble,
    /// Vertices of the polygon at hand, their positions, and the triangles cut from it.
    vertices: Vec<u32>,
    points: Vec<Vec3>,
    cut: Vec<[u32; 3]>,
}

/// What came of one primitive element.
pub(super) struct PrimitiveOutcome {
    /// Whether faces were left out, which was told.
    pub told: bool,
    /// What its `count` says, where that is wrong.
    pub wrong_count: Option<(usize, usize)>,
}

/// Reads all faces of `element` into the builder.
///
/// # Errors
/// Where commas stand among the indices, or on cancel.
pub(super) fn read<'a>(
    context: &mut Context<'a>,
    element: El<'a>,
    shape: PrimitiveKind,
    layout: &VertexLayout,
    builder: &mut Builder,
    triangulator: &mut Triangulator,
    steps: &mut u64,
) -> ReadResult<PrimitiveOutcome> {
    let mut reading = PrimitiveReader {
        layout,
        builder,
        triangulator,
        steps,
        trouble: Trouble::default(),
        vertices: Vec::new(),
        points: Vec::new(),
        cut: Vec::new(),
    };
    let mut faces = 0;
    if shape == PrimitiveKind::Polylist {
        faces = reading.polylist(context, element)?;
    } else {
        for part in element.children() {
            match part.tag_name().name() {
                "p" => {
                    let indices = context.integers(part)?;
                    faces += reading.run(shape, &indices);
                }
                "ph" if shape == PrimitiveKind::Polygons => {
                    faces += 1;
                    reading.with_holes(context, part)?;
                }
                _ => {}
            }
        }
    }
    let trouble = reading.trouble;
    let lacks = builder.lacks;
    let said = number_attribute(element, "count").filter(|said| *said != faces && trouble.incomplete == 0);
    if trouble.out_of_range > 0 {
        context.report.report(element, Finding::FacesOutOfRange(trouble.out_of_range));
    }
    if trouble.incomplete > 0 {
        context.report.report(element, Finding::IncompleteFaces(trouble.incomplete));
    }
    if trouble.too_complex > 0 {
        context.report.report(element, Finding::PolygonsTooComplex(trouble.too_complex));
    }
    if lacks.out_of_range > 0 {
        context.report.report(element, Finding::AttributesOutOfRange(lacks.out_of_range));
    }
    if lacks.not_finite > 0 {
        context.report.report(element, Finding::AttributesNotFinite(lacks.not_finite));
    }
    context.check_cancelled()?;
    let told = trouble.out_of_range + trouble.incomplete + trouble.too_complex > 0;
    Ok(PrimitiveOutcome { told, wrong_count: said.map(|said| (said, faces)) })
}

impl PrimitiveReader<'_> {
    /// One `p` of any shape but a polylist: the number of faces it holds, as `count` counts them.
    fn run(&mut self, shape: PrimitiveKind, indices: &[i32]) -> usize {
        let corners = indices.chunks_exact(self.layout.stride);
        let left_over = !corners.remainder().is_empty();
        let total = corners.len();
        match shape {
            PrimitiveKind::Triangles => {
                self.trouble.incomplete += usize::from(left_over || !total.is_multiple_of(3));
                for face in indices.chunks_exact(self.layout.stride.saturating_mul(3)) {
                    self.triangle(face);
                }
                total / 3
            }
            PrimitiveKind::Lines => {
                self.trouble.incomplete += usize::from(left_over || !total.is_multiple_of(2));
                for line in indices.chunks_exact(self.layout.stride.saturating_mul(2)) {
                    let (from, to) = line.split_at(self.layout.stride);
                    let (from, to) = (self.vertex(from), self.vertex(to));
                    self.line(from, to);
                }
                total / 2
            }
            PrimitiveKind::LineStrips => {
                self.trouble.incomplete += usize::from(left_over);
                let mut before = None;
                for corner in corners {
                    let vertex = self.vertex(corner);
                    if let Some(before) = before {
                        self.line(before, vertex);
                    }
                    before = Some(vertex);
                }
                1
            }
            PrimitiveKind::Fans | PrimitiveKind::Strips => {
                self.trouble.incomplete += usize::from(left_over || matches!(total, 1 | 2));
                let vertices: Vec<Option<u32>> = corners.map(|corner| self.vertex(corner)).collect();
                for i in 2..vertices.len() {
                    let first = if shape == PrimitiveKind::Fans { 0 } else { i - 2 };
                    let (Some(&a), Some(&b), Some(&c)) = (vertices.get(first), vertices.get(i - 1), vertices.get(i)) else { continue };
                    match (a, b, c) {
                        (Some(a), Some(b), Some(c)) if shape == PrimitiveKind::Strips && i % 2 == 1 => {
                            self.builder.mesh.triangles.push([b, a, c])
                        }
                        (Some(a), Some(b), Some(c)) => self.builder.mesh.triangles.push([a, b, c]),
                        _ => self.trouble.out_of_range += 1,
                    }
                }
                1
            }
            PrimitiveKind::Polygons | PrimitiveKind::Polylist => {
                self.trouble.incomplete += usize::from(left_over);
                self.polygon(indices);
                1
            }
        }
    }

    fn vertex(&mut self, corner: &[i32]) -> Option<u32> {
        self.builder.vertex(self.layout, corner)
    }

    fn line(&mut self, from: Option<u32>, to: Option<u32>) {
        match (from, to) {
            (Some(from), Some(to)) => self.builder.mesh.lines.push([from, to]),
            _ => self.trouble.out_of_range += 1,
        }
    }

    fn triangle(&mut self, face: &[i32]) {
        let mut vertices = [0; 3];
        for (vertex, corner) in vertices.iter_mut().zip(face.chunks_exact(self.layout.stride)) {
            match self.builder.vertex(self.layout, corner) {
                Some(found) => *vertex = found,
                None => {
                    self.trouble.out_of_range += 1;
                    return;
                }
            }
        }
        self.builder.mesh.triangles.push(vertices);
    }

    /// `vcount` and `p`: the number of polygons.
    fn polylist<'a>(&mut self, context: &mut Context<'a>, element: El<'a>) -> ReadResult<usize> {
        let Some(counts) = child(element, "vcount") else {
            // Without counts each `p` can only be one polygon.
            let mut faces = 0;
            for part in children(element, "p") {
                let indices = context.integers(part)?;
                faces += self.run(PrimitiveKind::Polygons, &indices);
            }
            return Ok(faces);
        };
        let counts = context.integers(counts)?;
        let mut wanted = counts.iter();
        let mut faces = 0;
        for part in children(element, "p") {
            let indices = context.integers(part)?;
            let mut rest = indices.as_slice();
            while !rest.is_empty() {
                let Some(count) = wanted.next() else {
                    self.trouble.incomplete += 1;
                    break;
                };
                let length = usize::try_from(*count).unwrap_or(0).saturating_mul(self.layout.stride);
                let Some((face, tail)) = rest.split_at_checked(length) else {
                    self.trouble.incomplete += 1;
                    break;
                };
                rest = tail;
                faces += 1;
                match length / self.layout.stride {
                    3 => self.triangle(face),
                    _ => self.polygon(face),
                }
            }
        }
        self.trouble.incomplete += wanted.filter(|count| **count > 0).count();
        Ok(faces)
    }

    fn polygon(&mut self, indices: &[i32]) {
        self.vertices.clear();
        let rings = [self.ring(indices)];
        self.cut_polygon(&rings);
    }

    /// Appends the vertices of one ring: how many there are; 0 where an index is out of range.
    fn ring(&mut self, indices: &[i32]) -> usize {
        let start = self.vertices.len();
        for corner in indices.chunks_exact(self.layout.stride) {
            match self.builder.vertex(self.layout, corner) {
                Some(vertex) => self.vertices.push(vertex),
                None => {
                    self.trouble.out_of_range += 1;
                    self.vertices.truncate(start);
                    return 0;
                }
            }
        }
        let length = self.vertices.len() - start;
        if (1..3).contains(&length) {
            self.trouble.incomplete += 1;
            self.vertices.truncate(start);
            return 0;
        }
        length
    }

    fn cut_polygon(&mut self, rings: &[usize]) {
        let positions = &self.builder.mesh.positions;
        self.points.clear();
        self.points.extend(self.vertices.iter().map(|vertex| positions.get(*vertex as usize).copied().unwrap_or(Vec3::ZERO)));
        self.cut.clear();
        if !self.triangulator.cut(&self.points, rings, self.steps, &mut self.cut) {
            self.trouble.too_complex += 1;
        }
        let vertices = &self.vertices;
        let vertex = |corner: u32| vertices.get(corner as usize).copied().unwrap_or(0);
        self.builder.mesh.triangles.extend(self.cut.iter().map(|corners| corners.map(vertex)));
    }

    /// `ph`: an outline `p` and holes `h`.
    fn with_holes<'a>(&mut self, context: &mut Context<'a>, element: El<'a>) -> ReadResult<()> {
        self.vertices.clear();
        let mut rings = Vec::new();
        if let Some(outline) = child(element, "p") {
            let indices = context.integers(outline)?;
            rings.push(self.ring(&indices));
        }
        if rings.first().is_none_or(|outline| *outline == 0) {
            return Ok(());
        }
        for hole in children(element, "h") {
            let indices = context.integers(hole)?;
            let length = self.ring(&indices);
            if length > 0 {
                rings.push(length);
            }
        }
        self.cut_polygon(&rings);
        Ok(())
    }
}

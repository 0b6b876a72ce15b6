//! `library_geometries`: meshes.

use std::rc::Rc;

use glam::{DMat3, DMat4, DVec3, Vec3};
use roxmltree::NodeId;
use rustc_hash::FxHashMap;

use super::context::{Context, ReadResult, child, children, id_of, name_of};
use super::material::is_double_sided;
use super::morph_target::CachedTarget;
use super::primitive::{self, PrimitiveKind};
use super::source::{Accessor, Arrays, Input, inputs};
use super::triangulate::Triangulator;
use super::vertex_dedup::{Builder, Stream, VertexLayout};
use super::{Asset, El, Finding, asset};
use sinew_scene::limits;
use sinew_scene::{Mesh, MeshId, Part, Scene, smooth_normals};

/// A mesh that was read.
pub(super) struct Geometry {
    /// The mesh, until it is put into a scene.
    pub mesh: Mesh,
    /// The `set` number of each of the mesh's sets of texture coordinates.
    pub sets: Vec<u32>,
    /// The points of the file; kept only where a morph may need them.
    pub points: Vec<Vec3>,
    /// The vertex of each corner in file order; kept only where a morph may need them.
    pub corners: Vec<u32>,
    /// Whether the file has nothing to draw in it, without anything wrong that was told.
    empty: bool,
}

/// What instances need of a mesh.
#[derive(Clone)]
pub(super) struct PlacedMesh {
    /// The mesh in the scene.
    pub mesh: MeshId,
    /// The `set` number of each set of texture coordinates.
    pub sets: Rc<[u32]>,
    /// The whole, where a morph may need it.
    pub geometry: Option<Rc<Geometry>>,
}

/// Reads geometries, each once.
pub(super) struct Geometries {
    arrays: Arrays<f32>,
    placed: FxHashMap<NodeId, Option<PlacedMesh>>,
    targets: FxHashMap<NodeId, Option<Rc<Geometry>>>,
    /// Morph targets that are controllers, by their element.
    pub shapes: FxHashMap<NodeId, CachedTarget>,
    keep: bool,
    steps: u64,
    triangulator: Triangulator,
}

impl Geometries {
    /// A reader that keeps points and corners if the document has a morph.
    pub(super) fn new(has_morph: bool) -> Self {
        Self {
            arrays: Arrays::default(),
            placed: FxHashMap::default(),
            targets: FxHashMap::default(),
            shapes: FxHashMap::default(),
            keep: has_morph,
            steps: limits::TRIANGULATION_STEPS,
            triangulator: Triangulator::default(),
        }
    }

    /// The mesh of a `geometry` element, put into the scene the first time; `None` where there is nothing to draw.
    ///
    /// # Errors
    /// Where commas separate its numbers, or on cancel.
    pub(super) fn place<'a>(
        &mut self,
        context: &mut Context<'a>,
        scene: &mut Scene,
        asset: &Asset,
        element: El<'a>,
    ) -> ReadResult<Option<PlacedMesh>> {
        if let Some(known) = self.placed.get(&element.id()) {
            return Ok(known.clone());
        }
        context.check_cancelled()?;
        let geometry = self.read(context, asset, element)?;
        if geometry.as_ref().is_some_and(|geometry| geometry.empty) {
            context.report.report(element, Finding::NoFaces);
        }
        let placed = geometry.map(|mut geometry| {
            let id = MeshId(scene.meshes.len() as u32);
            let sets = Rc::from(geometry.sets.as_slice());
            if self.keep {
                scene.meshes.push(geometry.mesh.clone().into());
                PlacedMesh { mesh: id, sets, geometry: Some(Rc::new(geometry)) }
            } else {
                scene.meshes.push(std::mem::take(&mut geometry.mesh).into());
                PlacedMesh { mesh: id, sets, geometry: None }
            }
        });
        self.placed.insert(element.id(), placed.clone());
        Ok(placed)
    }

    /// The shape of a morph target, which is not drawn by itself.
    ///
    /// # Errors
    /// As [`Geometries::place`].
    pub(super) fn target<'a>(&mut self, context: &mut Context<'a>, asset: &Asset, element: El<'a>) -> ReadResult<Option<Rc<Geometry>>> {
        if let Some(Some(placed)) = self.placed.get(&element.id()) {
            return Ok(placed.geometry.clone());
        }
        if let Some(known) = self.targets.get(&element.id()) {
            return Ok(known.clone());
        }
        let geometry = self.read(context, asset, element)?.map(Rc::new);
        self.targets.insert(element.id(), geometry.clone());
        Ok(geometry)
    }

    fn read<'a>(&mut self, context: &mut Context<'a>, asset: &Asset, element: El<'a>) -> ReadResult<Option<Geometry>> {
        let Some(mesh) = child(element, "mesh") else {
            let kind = element.children().find(|child| ["convex_mesh", "spline", "brep"].contains(&child.tag_name().name()));
            let tag = kind.map_or("?", |kind| kind.tag_name().name());
            context.report.report(element, Finding::UnsupportedGeometry(tag.to_owned()));
            return Ok(None);
        };
        let mut raws = Vec::new();
        let mut sets = Vec::new();
        for part in mesh.children() {
            if let Some(shape) = PrimitiveKind::of(part.tag_name().name()) {
                let raw = RawLayout::read(context, part, shape);
                sets.extend(raw.uvs.iter().map(|(set, _)| *set));
                raws.push(raw);
            }
        }
        sets.sort_unstable();
        sets.dedup();
        if sets.len() > limits::UV_SETS {
            context.report.report(mesh, Finding::TooManyUvSets);
            sets.truncate(limits::UV_SETS);
        }
        let Some(points) = self.points(context, mesh, &raws)? else {
            context.report.report(mesh, Finding::NoPositions);
            return Ok(None);
        };
        // Maya puts the hint here, others into the effect.
        let double_sided = children(element, "extra").chain(children(mesh, "extra")).any(is_double_sided);
        let own = Mesh { double_sided, name: name_of(element), id: id_of(element), ..Mesh::default() };
        let mut builder = Builder::new(own, sets.len(), raws.iter().any(|raw| raw.color.is_some()), self.keep);
        let (mut told, mut wrong_counts) = (false, Vec::new());
        for raw in &raws {
            let part = Part {
                symbol: raw.element.attribute("material").unwrap_or_default().to_owned(),
                triangles: builder.mesh.triangles.len() as u32..0,
                lines: builder.mesh.lines.len() as u32..0,
            };
            if let Some(layout) = self.layout(context, raw, &sets)? {
                builder.start(&layout);
                let (builder, triangulator) = (&mut builder, &mut self.triangulator);
                let outcome = primitive::read(context, raw.element, raw.shape, &layout, builder, triangulator, &mut self.steps)?;
                told |= outcome.told;
                wrong_counts.extend(outcome.wrong_count.map(|(said, found)| (raw.element, said, found)));
            } else {
                told = true;
            }
            let (triangles, lines) = (builder.mesh.triangles.len() as u32, builder.mesh.lines.len() as u32);
            builder.mesh.parts.push(Part { triangles: part.triangles.start..triangles, lines: part.lines.start..lines, ..part });
        }
        let empty = builder.mesh.triangles.is_empty() && builder.mesh.lines.is_empty();
        // That a mesh has no faces says all that a count of them could.
        for (part, said, found) in wrong_counts.into_iter().filter(|_| !empty || told) {
            context.report.wrong_count(part, said, found);
        }
        let corners = builder.corners.take().unwrap_or_default();
        let mut geometry = Geometry { corners, mesh: builder.mesh, sets, points: Vec::new(), empty: empty && !told };
        finish(context, mesh, &mut geometry.mesh, &points);
        if self.keep {
            geometry.points = (0..geometry.mesh.source_count as usize).map(|i| Vec3::from_array(points.row(i, [0.0; 3]))).collect();
        }
        if let Some(matrix) = asset::space(context, asset, element) {
            move_to(&mut geometry, &matrix);
        }
        Ok(Some(geometry))
    }

    /// The points of a mesh: those of its first primitive, else those of `vertices`.
    fn points<'a>(&mut self, context: &mut Context<'a>, mesh: El<'a>, raws: &[RawLayout<'a>]) -> ReadResult<Option<Accessor<f32>>> {
        let source = raws.iter().find_map(|raw| raw.position).map(|(_, source)| source).or_else(|| {
            let vertices = child(mesh, "vertices")?;
            let input = inputs(vertices).into_iter().find(|input| input.semantic == "POSITION")?;
            context.follow(input.element, "source", &["source"])
        });
        match source {
            Some(source) => self.arrays.accessor(context, source, 3),
            None => Ok(None),
        }
    }

    fn layout<'a>(&mut self, context: &mut Context<'a>, raw: &RawLayout<'a>, sets: &[u32]) -> ReadResult<Option<VertexLayout>> {
        let Some(position) = self.stream(context, raw.position, 3)? else {
            context.report.report(raw.element, Finding::NoPositions);
            return Ok(None);
        };
        let normal = self.optional(context, raw.normal, 3)?;
        let color = self.optional(context, raw.color, 4)?;
        let mut uvs = Vec::new();
        for (set, at) in &raw.uvs {
            if let (Ok(place), Some(stream)) = (sets.binary_search(set), self.optional(context, Some(*at), 2)?) {
                uvs.push((place, stream));
            }
        }
        Ok(Some(VertexLayout::new(raw.stride, position, normal, uvs, color)))
    }

    fn stream<'a>(&mut self, context: &mut Context<'a>, at: Option<(usize, El<'a>)>, width: usize) -> ReadResult<Option<Stream>> {
        let Some((offset, source)) = at else { return Ok(None) };
        Ok(self.arrays.accessor(context, source, width)?.map(|values| Stream { offset, values }))
    }

    /// [`Self::stream`] of what a face can do without: an empty list, which some exporters write and point into, counts as none.
    fn optional<'a>(&mut self, context: &mut Context<'a>, at: Option<(usize, El<'a>)>, width: usize) -> ReadResult<Option<Stream>> {
        let stream = self.stream(context, at, width)?;
        if let (Some((_, source)), Some(Stream { values, .. })) = (at, &stream)
            && values.available == 0
        {
            context.report.report(source, Finding::EmptyList);
            return Ok(None);
        }
        Ok(stream)
    }
}

/// What a primitive's inputs say, before the sources are read: offset and source of each list.
struct RawLayout<'a> {
    element: El<'a>,
    shape: PrimitiveKind,
    stride: usize,
    position: Option<(usize, El<'a>)>,
    normal: Option<(usize, El<'a>)>,
    color: Option<(usize, El<'a>)>,
    uvs: Vec<(u32, (usize, El<'a>))>,
}

impl<'a> RawLayout<'a> {
    fn read(context: &mut Context<'a>, element: El<'a>, shape: PrimitiveKind) -> Self {
        let mut raw = Self { element, shape, stride: 1, position: None, normal: None, color: None, uvs: Vec::new() };
        let own = inputs(element);
        raw.stride = own.iter().map(|input| input.offset.saturating_add(1)).max().unwrap_or(1);
        // A primitive's own lists come before those that its vertices bring along.
        for input in own.iter().filter(|input| input.semantic != "VERTEX") {
            raw.add(context, *input, input.offset);
        }
        for vertex in own.iter().filter(|input| input.semantic == "VERTEX") {
            // A mesh has one `vertices` only, so a broken reference can mean no other.
            let named = context.follow(vertex.element, "source", &["vertices"]);
            let vertices = named.or_else(|| element.parent().and_then(|mesh| child(mesh, "vertices")));
            for input in vertices.map(inputs).unwrap_or_default() {
                raw.add(context, input, vertex.offset);
            }
        }
        raw
    }

    fn add(&mut self, context: &mut Context<'a>, input: Input<'a>, offset: usize) {
        let wanted = match input.semantic {
            "POSITION" => self.position.is_none(),
            "NORMAL" => self.normal.is_none(),
            "COLOR" => self.color.is_none(),
            "TEXCOORD" | "UV" => self.uvs.len() < 4 * limits::UV_SETS,
            _ => false,
        };
        if !wanted {
            return;
        }
        let Some(source) = context.follow(input.element, "source", &["source"]) else { return };
        match input.semantic {
            "POSITION" => self.position = Some((offset, source)),
            "NORMAL" => self.normal = Some((offset, source)),
            "COLOR" => self.color = Some((offset, source)),
            _ => {
                let taken = |set: u32| self.uvs.iter().any(|(known, _)| *known == set);
                let set = input.set.filter(|set| !taken(*set)).or_else(|| (0..u32::MAX).find(|set| !taken(*set)));
                self.uvs.extend(set.map(|set| (set, (offset, source))));
            }
        }
    }
}

/// Counts the points, fills in the normals that are missing.
fn finish(context: &mut Context<'_>, element: El<'_>, mesh: &mut Mesh, points: &Accessor<f32>) {
    let used = mesh.source_vertex.iter().max().map_or(0, |last| *last as usize + 1);
    if used > points.count {
        context.report.wrong_count(element, points.count, points.available);
    }
    mesh.source_count = u32::try_from(points.count.max(used)).unwrap_or(u32::MAX);
    if mesh.positions.iter().any(|position| !position.is_finite()) {
        context.report.report(element, Finding::PointsNotFinite);
    }
    if mesh.normals.iter().any(|normal| normal.is_nan()) {
        let mut computed = Vec::new();
        let source = &mesh.source_vertex;
        let group = |v: u32| source.get(v as usize).copied().unwrap_or(0);
        smooth_normals(&mesh.positions, &mesh.triangles, group, mesh.source_count as usize, &mut computed);
        for (normal, computed) in mesh.normals.iter_mut().zip(computed) {
            if normal.is_nan() {
                *normal = computed;
            }
        }
    }
}

/// Moves a geometry out of its own unit and axes.
fn move_to(geometry: &mut Geometry, matrix: &DMat4) {
    let turn = DMat3::from_mat4(*matrix);
    let moved = |point: &Vec3| matrix.transform_point3(point.as_dvec3()).as_vec3();
    for point in geometry.mesh.positions.iter_mut().chain(&mut geometry.points) {
        *point = moved(point);
    }
    for normal in &mut geometry.mesh.normals {
        // Turn and even scale only, so no inverse transpose is needed.
        *normal = (turn * normal.as_dvec3()).try_normalize().unwrap_or(DVec3::Y).as_vec3();
    }
}

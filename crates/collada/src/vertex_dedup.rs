//! Makes vertices out of a file's corners: each different combination of indices becomes one vertex.

use std::collections::HashMap;

use glam::{Vec2, Vec3, Vec4};

use super::source::Accessor;
use sinew_scene::Mesh;

/// One list of values that a primitive's corners point into.
#[derive(Clone)]
pub(super) struct Stream {
    /// Where its index stands in a corner.
    pub offset: usize,
    /// The values.
    pub values: Accessor<f32>,
}

/// The lists that one primitive uses.
#[derive(Clone)]
pub(super) struct VertexLayout {
    /// Numbers a corner.
    pub stride: usize,
    /// Points.
    pub position: Stream,
    /// Normals.
    pub normal: Option<Stream>,
    /// Texture coordinates, each with its place in the mesh's list of sets.
    pub uvs: Vec<(usize, Stream)>,
    /// Colours.
    pub color: Option<Stream>,
    /// Which corner offsets make a vertex, beyond that of the position.
    keys: Vec<usize>,
    position_limit: u32,
}

impl VertexLayout {
    /// A layout of these streams.
    pub(super) fn new(stride: usize, position: Stream, normal: Option<Stream>, uvs: Vec<(usize, Stream)>, color: Option<Stream>) -> Self {
        let position_limit = u32::try_from(position.values.available).unwrap_or(u32::MAX).min(i32::MAX as u32);
        let mut keys: Vec<usize> = Vec::new();
        for stream in normal.iter().chain(uvs.iter().map(|(_, stream)| stream)).chain(&color) {
            if stream.offset != position.offset && !keys.contains(&stream.offset) {
                keys.push(stream.offset);
            }
        }
        Self { stride, position, normal, uvs, color, keys, position_limit }
    }
}

impl Stream {
    /// The values that a corner points at; `None` where there are none.
    fn row<const N: usize>(&self, corner: &[i32], fill: [f32; N]) -> Option<[f32; N]> {
        let index = usize::try_from(*corner.get(self.offset)?).ok()?;
        (index < self.values.available).then(|| self.values.row(index, fill))
    }
}

/// What was wrong with the values beside the positions, counted in vertices.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Lacks {
    /// An index points outside its list.
    pub out_of_range: usize,
    /// A value is infinite or not a number.
    pub not_finite: usize,
}

/// Longest chain of vertices on one point that is walked; beyond it a hash table takes over, so that a fan of a million corners stays fast.
const CHAIN: usize = 16;
const NONE: u32 = u32::MAX;

/// Builds the vertex lists of one mesh.
pub(super) struct Builder {
    /// The mesh so far.
    pub mesh: Mesh,
    has_colors: bool,
    /// What was wrong since [`Builder::start`].
    pub lacks: Lacks,
    /// Index of each corner's vertex, in file order, where that is wanted.
    pub corners: Option<Vec<u32>>,
    /// Latest vertex on each point, with the primitive that made it.
    heads: Vec<(u32, u32)>,
    /// The vertex before on the same point.
    links: Vec<u32>,
    keys: Vec<i32>,
    key_starts: Vec<u32>,
    overflow: HashMap<Vec<i32>, u32>,
    primitive: u32,
    key: Vec<i32>,
}

impl Builder {
    /// A builder for a mesh with `sets` sets of texture coordinates.
    pub(super) fn new(mesh: Mesh, sets: usize, has_colors: bool, want_corners: bool) -> Self {
        let mut mesh = mesh;
        mesh.uv_sets = vec![Vec::new(); sets];
        Self {
            mesh,
            has_colors,
            lacks: Lacks::default(),
            corners: want_corners.then(Vec::new),
            heads: Vec::new(),
            links: Vec::new(),
            keys: Vec::new(),
            key_starts: Vec::new(),
            overflow: HashMap::new(),
            primitive: 0,
            key: Vec::new(),
        }
    }

    /// Starts a primitive: vertices are shared within it only, since the next may point into other lists.
    pub(super) fn start(&mut self, layout: &VertexLayout) {
        self.primitive += 1;
        self.lacks = Lacks::default();
        self.overflow.clear();
        if self.heads.len() < layout.position.values.available {
            self.heads.resize(layout.position.values.available, (0, NONE));
        }
    }

    /// The vertex of a corner; `None` where its point is out of range. Of the other values what is out of range is left at its default, normals to be
    /// computed.
    pub(super) fn vertex(&mut self, layout: &VertexLayout, corner: &[i32]) -> Option<u32> {
        let point = u32::try_from(*corner.get(layout.position.offset)?).ok().filter(|point| *point < layout.position_limit)?;
        self.key.clear();
        for offset in &layout.keys {
            self.key.push(*corner.get(*offset)?);
        }
        let width = self.key.len();
        let head = self.heads.get_mut(point as usize)?;
        if head.0 != self.primitive {
            *head = (self.primitive, NONE);
        }
        let (mut vertex, mut walked) = (head.1, 0);
        while vertex != NONE && walked < CHAIN {
            let start = self.key_starts.get(vertex as usize).copied().unwrap_or(0) as usize;
            if self.keys.get(start..start + width) == Some(self.key.as_slice()) {
                return Some(self.note(vertex));
            }
            vertex = self.links.get(vertex as usize).copied().unwrap_or(NONE);
            walked += 1;
        }
        if walked == CHAIN {
            let mut key = self.key.clone();
            key.push(point as i32);
            if let Some(known) = self.overflow.get(&key) {
                return Some(self.note(*known));
            }
            let new = self.push(layout, corner, point);
            self.overflow.insert(key, new);
            return Some(self.note(new));
        }
        let new = self.push(layout, corner, point);
        if let Some(head) = self.heads.get_mut(point as usize) {
            if let Some(link) = self.links.get_mut(new as usize) {
                *link = head.1;
            }
            head.1 = new;
        }
        Some(self.note(new))
    }

    fn note(&mut self, vertex: u32) -> u32 {
        if let Some(corners) = &mut self.corners {
            corners.push(vertex);
        }
        vertex
    }

    fn push(&mut self, layout: &VertexLayout, corner: &[i32], point: u32) -> u32 {
        let mesh = &mut self.mesh;
        let (mut outside, mut odd) = (false, false);
        let vertex = mesh.positions.len() as u32;
        mesh.positions.push(Vec3::from_array(layout.position.values.row(point as usize, [0.0; 3])));
        mesh.source_vertex.push(point);
        // What is missing is not a number until all primitives are there, and is computed then.
        let normal = layout.normal.as_ref().and_then(|stream| noted(stream.row(corner, [0.0; 3]), &mut outside, &mut odd));
        mesh.normals.push(normal.and_then(|normal| Vec3::from_array(normal).try_normalize()).unwrap_or(Vec3::NAN));
        for uvs in &mut mesh.uv_sets {
            uvs.push(Vec2::ZERO);
        }
        for (set, stream) in &layout.uvs {
            if let Some(uv) = mesh.uv_sets.get_mut(*set).and_then(|uvs| uvs.last_mut()) {
                *uv = noted(stream.row(corner, [0.0; 2]), &mut outside, &mut odd).map_or(Vec2::ZERO, Vec2::from_array);
            }
        }
        if self.has_colors {
            let color = layout.color.as_ref().and_then(|stream| noted(stream.row(corner, [0.0, 0.0, 0.0, 1.0]), &mut outside, &mut odd));
            mesh.colors.push(color.map_or(Vec4::ONE, Vec4::from_array).clamp(Vec4::ZERO, Vec4::ONE));
        }
        self.lacks.out_of_range += usize::from(outside);
        self.lacks.not_finite += usize::from(odd);
        self.links.push(NONE);
        self.key_starts.push(self.keys.len() as u32);
        self.keys.extend_from_slice(&self.key);
        vertex
    }
}

/// Finite values; what is missing is noted as `outside`, what is not finite as `odd`.
fn noted<const N: usize>(values: Option<[f32; N]>, outside: &mut bool, odd: &mut bool) -> Option<[f32; N]> {
    *outside |= values.is_none();
    let finite = values.filter(|values| values.iter().all(|value| value.is_finite()));
    *odd |= values.is_some() && finite.is_none();
    finite
}

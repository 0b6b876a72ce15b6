//! Edges of a mesh, computed once: for the wireframe and for the selection outline.

use std::collections::HashMap;

use super::RenderError;
use super::debug_lines::LineBuilder;
use super::draw_list::rgb;
use super::memory::push;
use super::projection::ViewTransform;
use sinew_scene::{Mesh, Surface};

/// An edge: its two vertices and the triangles on its sides ([`NO_FACE`] where there is none).
#[derive(Debug, Clone, Copy)]
pub(super) struct Edge {
    ends: [u32; 2],
    sides: [u32; 2],
}

const NO_FACE: u32 = u32::MAX;

/// The edges of a mesh, each once. Vertices that are the same point of the file are one, so a seam of the texture is no edge of the shape.
pub(super) fn find(mesh: &Mesh) -> Result<Vec<Edge>, RenderError> {
    let point = |v: u32| mesh.source_vertex.get(v as usize).copied().unwrap_or(v);
    let (mut known, mut edges) = (HashMap::<(u32, u32), u32>::new(), Vec::<Edge>::new());
    // In a closed surface each edge has two triangles.
    known.try_reserve(mesh.triangles.len() * 3 / 2)?;
    edges.try_reserve(mesh.triangles.len() * 3 / 2)?;
    for (t, corners) in mesh.triangles.iter().enumerate() {
        for k in 0..3 {
            let (a, b) = (corners[k], corners[(k + 1) % 3]);
            let (pa, pb) = (point(a), point(b));
            known.try_reserve(1)?;
            let index = *known.entry((pa.min(pb), pa.max(pb))).or_insert(edges.len() as u32) as usize;
            match edges.get_mut(index) {
                Some(edge) => {
                    if edge.sides[1] == NO_FACE {
                        edge.sides[1] = t as u32;
                    }
                }
                None => push(&mut edges, Edge { ends: [a, b], sides: [t as u32, NO_FACE] })?,
            }
        }
    }
    Ok(edges)
}

/// Whether each triangle of a surface faces the camera.
fn facing(view: &ViewTransform, surface: &Surface, out: &mut Vec<bool>) -> Result<(), RenderError> {
    out.clear();
    out.try_reserve(surface.mesh.triangles.len())?;
    out.extend(surface.mesh.triangles.iter().map(|corners| {
        let [a, b, c] = corners.map(|v| surface.position(v));
        let towards = if view.perspective { view.eye - a } else { view.back };
        (b - a).cross(c - a).dot(towards) > 0.0
    }));
    Ok(())
}

impl LineBuilder<'_> {
    /// All edges of a surface.
    pub(super) fn wireframe(&mut self, surface: &Surface, edges: &[Edge]) {
        let dark = self.display.palette.grid.0 != 0;
        let line_style = if dark { self.line_style([0.05, 0.06, 0.08], 0.55, 1.0) } else { self.line_style([0.1, 0.12, 0.15], 0.5, 1.0) };
        for edge in edges {
            let [a, b] = edge.ends.map(|v| surface.position(v));
            self.line(a, b, &line_style);
        }
    }

    /// The silhouette edges, between front and back faces, and the boundary edges.
    pub(super) fn outline(&mut self, surface: &Surface, edges: &[Edge], color: u32, scratch: &mut Vec<bool>) -> Result<(), RenderError> {
        facing(self.view, surface, scratch)?;
        let line_style = self.line_style(rgb(color), 1.0, 2.0);
        for edge in edges {
            let [one, two] = edge.sides.map(|t| scratch.get(t as usize).copied());
            if one != two {
                let [a, b] = edge.ends.map(|v| surface.position(v));
                self.line(a, b, &line_style);
            }
        }
        Ok(())
    }

    /// The lines that a mesh brings along.
    pub(super) fn mesh_lines(&mut self, surface: &Surface, color: [f32; 3]) {
        let line_style = self.line_style(color, 1.0, 1.4);
        for line in &surface.mesh.lines {
            let [a, b] = line.map(|v| surface.position(v));
            self.line(a, b, &line_style);
        }
    }
}

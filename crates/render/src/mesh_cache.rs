//! What is found out about meshes once and kept from frame to frame.

use std::sync::{Arc, Weak};

use super::RenderError;
use super::edges::{self, Edge};
use super::memory::{collect, push};
use sinew_scene::{Mesh, Part, backed_triangles};

/// The meshes that were drawn lately.
#[derive(Debug, Default)]
pub(super) struct MeshCaches(Vec<MeshCache>);

/// Facts about one mesh.
#[derive(Debug)]
pub(super) struct MeshCache {
    /// Keeps the address from being given to another mesh.
    mesh: Weak<Mesh>,
    /// For each part the mesh vertices it uses: first and one past the last.
    pub ranges: Vec<(u32, u32)>,
    edges: Option<Vec<Edge>>,
    /// See [`super::draw_data::DrawCall::backed_triangles`], for the whole mesh; found when it is first drawn.
    backed: Option<Option<Arc<Vec<bool>>>>,
}

impl MeshCaches {
    /// The facts about a mesh, found when first asked for.
    pub(super) fn of(&mut self, mesh: &Arc<Mesh>) -> Result<&mut MeshCache, RenderError> {
        let known = self.0.iter().position(|mesh_cache| std::ptr::eq(mesh_cache.mesh.as_ptr(), Arc::as_ptr(mesh)));
        let index = match known {
            Some(index) => index,
            None => {
                self.0.retain(|mesh_cache| mesh_cache.mesh.strong_count() > 0);
                push(&mut self.0, MeshCache::new(mesh)?)?;
                self.0.len() - 1
            }
        };
        Ok(&mut self.0[index])
    }
}

impl MeshCache {
    fn new(mesh: &Arc<Mesh>) -> Result<Self, RenderError> {
        let range = |part: &Part| {
            let triangles = mesh.triangles.get(part.triangles.start as usize..part.triangles.end as usize).unwrap_or(&[]);
            let corners = || triangles.iter().flatten().copied().filter(|v| (*v as usize) < mesh.positions.len());
            (corners().min().unwrap_or(0), corners().max().map_or(0, |v| v + 1))
        };
        Ok(Self { mesh: Arc::downgrade(mesh), ranges: collect(mesh.parts.iter().map(range))?, edges: None, backed: None })
    }

    /// Which triangles lie on others of the opposite winding; `None` where none does.
    pub(super) fn backed(&mut self, mesh: &Mesh) -> Result<Option<Arc<Vec<bool>>>, RenderError> {
        if self.backed.is_none() {
            self.backed = Some(Some(backed_triangles(mesh)?).filter(|backed| !backed.is_empty()).map(Arc::new));
        }
        Ok(self.backed.clone().flatten())
    }

    /// The edges of the mesh.
    pub(super) fn edges(&mut self, mesh: &Mesh) -> Result<&[Edge], RenderError> {
        if self.edges.is_none() {
            self.edges = Some(edges::find(mesh)?);
        }
        Ok(self.edges.as_deref().unwrap_or_default())
    }
}

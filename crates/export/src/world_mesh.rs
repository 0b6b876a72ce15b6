//! A posed surface as every file format wants it: vertices that are used, in the world, finite, faces turned outwards.

use glam::{Mat3, Vec3};

use sinew_scene::{Frame, Surface, SurfaceGeometry};

/// The surfaces of `frame` that are shown.
pub fn visible(frame: &Frame) -> impl Iterator<Item = &Surface> {
    frame.surfaces.iter().filter(|surface| surface.visible)
}

/// Whether `frame` shows any triangle.
pub fn is_any(frame: &Frame) -> bool {
    visible(frame).any(|surface| !surface.mesh.triangles.is_empty())
}

/// One surface's vertices and triangles in the world.
pub struct WorldMesh<'a> {
    surface: &'a Surface,
    /// Turns normals of a rigid surface into the world, up to their length.
    normal_matrix: Mat3,
    /// The vertices that triangles use, in their order.
    used: Vec<u32>,
    /// Place of each vertex in `used`.
    places: Vec<u32>,
}

impl<'a> WorldMesh<'a> {
    /// Finds out which vertices are used: those of triangles whose corners are all there and finite.
    pub fn of(surface: &'a Surface) -> Self {
        let normal_matrix = match &surface.geometry {
            SurfaceGeometry::Rigid(matrix) => {
                // The cofactor matrix is the inverse transpose times the determinant: it is there even where the inverse is not.
                let [x, y, z] = [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(|axis| axis.truncate());
                let cofactor = Mat3::from_cols(y.cross(z), z.cross(x), x.cross(y));
                if x.dot(y.cross(z)) < 0.0 { -cofactor } else { cofactor }
            }
            SurfaceGeometry::Deformed { .. } => Mat3::IDENTITY,
        };
        let mut places = vec![0; surface.mesh.positions.len()];
        for corner in surface.mesh.triangles.iter().filter(|corners| is_whole(surface, corners)).flatten() {
            if let Some(place) = places.get_mut(*corner as usize) {
                *place = 1;
            }
        }
        let used: Vec<u32> = (0..).zip(&places).filter(|(_, used)| **used == 1).map(|(v, _)| v).collect();
        for (place, v) in (0..).zip(&used) {
            if let Some(slot) = places.get_mut(*v as usize) {
                *slot = place;
            }
        }
        Self { surface, normal_matrix, used, places }
    }

    /// The vertices that are used.
    pub fn used(&self) -> &[u32] {
        &self.used
    }

    /// Each triangle's index in the mesh, and its corners as places in [`WorldMesh::used`], counter-clockwise seen from outside.
    pub fn triangles(&self) -> impl Iterator<Item = (u32, [u32; 3])> {
        let place = |v: u32| self.places.get(v as usize).copied().unwrap_or_default();
        let whole = (0..).zip(&self.surface.mesh.triangles).filter(|(_, corners)| is_whole(self.surface, corners));
        whole.map(move |(index, &[a, b, c])| {
            let [b, c] = if self.surface.mirrored { [c, b] } else { [b, c] };
            (index, [a, b, c].map(place))
        })
    }

    /// Where a vertex of the mesh is, metres.
    pub fn position(&self, v: u32) -> Vec3 {
        // `+ 0.0` turns a negative zero into zero.
        self.surface.position(v) + 0.0
    }

    /// A unit vector; upwards where the surface has no normal.
    pub fn normal(&self, v: u32) -> Vec3 {
        let normals = match &self.surface.geometry {
            SurfaceGeometry::Rigid(_) => &self.surface.mesh.normals,
            SurfaceGeometry::Deformed { normals, .. } => normals,
        };
        normals.get(v as usize).and_then(|normal| (self.normal_matrix * *normal).try_normalize()).unwrap_or(Vec3::Y) + 0.0
    }
}

/// Whether all corners are there and finite.
fn is_whole(surface: &Surface, corners: &[u32; 3]) -> bool {
    corners.iter().all(|v| (*v as usize) < surface.mesh.positions.len() && surface.position(*v).is_finite())
}

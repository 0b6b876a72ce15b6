//! The posed surface as PLY (binary, little-endian): one list of vertices with normals, and colours where a surface has them.

use std::io::{self, Write};

use glam::Vec3;

use super::world_mesh::{WorldMesh, visible};
use sinew_engine::output::Output;
use sinew_engine::output::write_atomic;

use super::ExportError;
use sinew_scene::Frame;

/// Writes the visible surfaces of `frame` to `file`.
///
/// # Errors
/// [`ExportError`] where the file cannot be written.
pub fn save(file: &Output, frame: &Frame) -> Result<(), ExportError> {
    Ok(write_atomic(file, |out| write(out, frame))?)
}

/// Writes the visible surfaces of `frame`: world space, metres, Y up, `float` positions and unit normals, `uchar` colours (vertex colours, or
/// else the diffuse colour of the surface's first material), triangles counter-clockwise seen from outside.
///
/// # Errors
/// What `out` returns.
pub fn write(out: &mut impl Write, frame: &Frame) -> io::Result<()> {
    let surfaces: Vec<_> = visible(frame).map(|surface| (surface, WorldMesh::of(surface))).collect();
    let vertices: usize = surfaces.iter().map(|(_, posed)| posed.used().len()).sum();
    let triangles: usize = surfaces.iter().map(|(_, posed)| posed.triangles().count()).sum();
    write!(out, "ply\nformat binary_little_endian 1.0\ncomment Sinew {}: world space, metres, Y up\n", env!("CARGO_PKG_VERSION"))?;
    writeln!(out, "element vertex {vertices}")?;
    for name in ["x", "y", "z", "nx", "ny", "nz"] {
        writeln!(out, "property float {name}")?;
    }
    for name in ["red", "green", "blue"] {
        writeln!(out, "property uchar {name}")?;
    }
    write!(out, "element face {triangles}\nproperty list uchar int vertex_indices\nend_header\n")?;
    for (surface, posed) in &surfaces {
        let first = surface.materials.iter().flatten().next().and_then(|binding| frame.materials.get(binding.material.index()));
        let plain = first.map_or(Vec3::ONE, |material| material.diffuse.color);
        for v in posed.used() {
            let (position, normal) = (posed.position(*v), posed.normal(*v));
            for value in position.to_array().into_iter().chain(normal.to_array()) {
                out.write_all(&value.to_le_bytes())?;
            }
            let color = surface.mesh.colors.get(*v as usize).map_or(plain, |color| color.truncate());
            out.write_all(&color.to_array().map(|part| (part.clamp(0.0, 1.0) * 255.0).round() as u8))?;
        }
    }
    let mut before = 0_u32;
    for (_, posed) in &surfaces {
        for (_, corners) in posed.triangles() {
            out.write_all(&[3])?;
            for corner in corners {
                out.write_all(&(corner + before).to_le_bytes())?;
            }
        }
        before += posed.used().len() as u32;
    }
    Ok(())
}

//! The posed surface as binary STL, for printers: triangles alone.

use std::io::{self, Write};

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

/// Writes the visible surfaces of `frame`: world space, metres, Y up, each triangle with its own plane's unit normal (zero where it has no area),
/// corners counter-clockwise seen from outside.
///
/// # Errors
/// What `out` returns; [`io::ErrorKind::InvalidInput`] for more triangles than the format counts.
pub fn write(out: &mut impl Write, frame: &Frame) -> io::Result<()> {
    let surfaces: Vec<_> = visible(frame).map(WorldMesh::of).collect();
    let count: usize = surfaces.iter().map(|posed| posed.triangles().count()).sum();
    let count = u32::try_from(count).map_err(|_| io::Error::from(io::ErrorKind::InvalidInput))?;
    let mut header = [b' '; 80];
    let title = concat!("Sinew ", env!("CARGO_PKG_VERSION"), ": world space, metres, Y up");
    // A header that begins with "solid" would be taken for the text form.
    for (slot, byte) in header.iter_mut().zip(title.bytes()) {
        *slot = byte;
    }
    out.write_all(&header)?;
    out.write_all(&count.to_le_bytes())?;
    for posed in &surfaces {
        for (_, corners) in posed.triangles() {
            let [a, b, c] = corners.map(|place| posed.used().get(place as usize).map_or(glam::Vec3::ZERO, |v| posed.position(*v)));
            let normal = (b - a).cross(c - a).normalize_or_zero();
            for value in [normal, a, b, c].into_iter().flat_map(|point| point.to_array()) {
                out.write_all(&value.to_le_bytes())?;
            }
            out.write_all(&[0, 0])?;
        }
    }
    Ok(())
}

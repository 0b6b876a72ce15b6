//! The posed surface as Wavefront OBJ: world space, metres, Y up, triangles with normals, one group a surface, materials in a file beside it.

use std::collections::HashSet;
use std::io::{self, Write};

use glam::{Vec2, Vec3};

use super::world_mesh::{WorldMesh, visible};
use super::{ExportError, mtl};
use sinew_engine::output::Output;
use sinew_engine::output::{prepare, write_atomic};
use sinew_scene::{Frame, Scene, Surface};

/// Writes the visible surfaces of `frame`, a pose of `scene`, to `file`, and their materials to the file beside it that ends in `.mtl`: the old
/// files stay until both are complete.
///
/// # Errors
/// [`ExportError`] where a file cannot be written.
pub fn save(file: &Output, scene: &Scene, frame: &Frame) -> Result<(), ExportError> {
    let materials = mtl::MtlLibrary::of(frame);
    if materials.is_empty() {
        return Ok(write_atomic(file, |out| write(out, scene, frame, &materials, None))?);
    }
    let library = file.with(&mtl::library(file.file()))?;
    let name = library.file().file_name().map(|name| name.to_string_lossy().into_owned());
    // First the one that was asked for: where nothing can be written, that one is named.
    let asked_for = prepare(file, |out| write(out, scene, frame, &materials, name.as_deref()))?;
    let beside = prepare(&library, |out| materials.write(out, scene, frame, file.file()))?;
    asked_for.commit()?;
    Ok(beside.commit()?)
}

/// Writes the visible surfaces of `frame`, a pose of `scene`, as OBJ to `out`. `library` is the name of the file with the `materials`.
///
/// Numbers have as many digits as tell the `f32` apart from its neighbours. Faces are counter-clockwise seen from outside, also where the
/// transform mirrors. A triangle with a corner that is not finite is left out, and so are vertices that no triangle uses.
///
/// # Errors
/// What `out` returns.
pub fn write(out: &mut impl Write, scene: &Scene, frame: &Frame, materials: &mtl::MtlLibrary, library: Option<&str>) -> io::Result<()> {
    writeln!(out, "# Sinew {}: world space, metres, Y up", env!("CARGO_PKG_VERSION"))?;
    if let Some(library) = library {
        writeln!(out, "mtllib {library}")?;
    }
    let mut names = HashSet::new();
    let mut written = ObjCounts::default();
    for surface in visible(frame) {
        let name = &scene.graph.label(surface.node).plain();
        writeln!(out, "g {}", unique(&group_name(name), &mut names))?;
        write_surface(out, frame, surface, materials, &mut written)?;
    }
    Ok(())
}

/// How much of each list the file has already: its numbers run on from surface to surface.
#[derive(Debug, Clone, Copy, Default)]
struct ObjCounts {
    vertices: u64,
    uvs: u64,
}

fn write_surface(
    out: &mut impl Write,
    frame: &Frame,
    surface: &Surface,
    materials: &mtl::MtlLibrary,
    written: &mut ObjCounts,
) -> io::Result<()> {
    let posed = WorldMesh::of(surface);
    for v in posed.used() {
        let Vec3 { x, y, z } = posed.position(*v);
        writeln!(out, "v {x} {y} {z}")?;
    }
    let set = materials.uvs(frame, surface);
    if let Some(uvs) = &set {
        for v in posed.used() {
            // `+ 0.0` turns a negative zero into zero.
            let Vec2 { x, y } = uvs.get(*v as usize).copied().filter(|uv| uv.is_finite()).unwrap_or_default() + 0.0;
            writeln!(out, "vt {x} {y}")?;
        }
    }
    for v in posed.used() {
        let Vec3 { x, y, z } = posed.normal(*v);
        writeln!(out, "vn {x} {y} {z}")?;
    }
    let mut shown = None;
    for (triangle, corners) in posed.triangles() {
        let material = materials.of_triangle(surface, triangle);
        if material != shown {
            if let Some(name) = material.and_then(|material| materials.name(material)) {
                writeln!(out, "usemtl {name}")?;
            }
            shown = material;
        }
        let [a, b, c] = corners.map(|corner| u64::from(corner) + written.vertices + 1);
        let [s, t, u] = corners.map(|corner| u64::from(corner) + written.uvs + 1);
        match set {
            Some(_) => writeln!(out, "f {a}/{s}/{a} {b}/{t}/{b} {c}/{u}/{c}")?,
            None => writeln!(out, "f {a}//{a} {b}//{b} {c}//{c}")?,
        }
    }
    let count = posed.used().len() as u64;
    written.vertices += count;
    written.uvs += if set.is_some() { count } else { 0 };
    Ok(())
}

/// A name as OBJ readers take it: no blanks, no line breaks, not empty.
pub(super) fn group_name(name: &str) -> String {
    let name: String = name.trim().chars().map(|c| if c.is_whitespace() || c.is_control() || c == '#' { '_' } else { c }).collect();
    if name.is_empty() { "surface".to_owned() } else { name }
}

pub(super) fn unique(name: &str, taken: &mut HashSet<String>) -> String {
    let mut candidate = name.to_owned();
    let mut number = 2_u32;
    while !taken.insert(candidate.clone()) {
        candidate = format!("{name}.{number}");
        number += 1;
    }
    candidate
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Mat4;
    use sinew_scene::{Mesh, Node, SurfaceGeometry};
    use std::sync::Arc;

    fn scene_of(names: &[&str]) -> Scene {
        let mut scene = Scene::default();
        for name in names {
            scene.graph.add(None, Node::new(*name));
        }
        scene
    }

    /// A triangle in the XY plane that faces +Z.
    fn triangle(node: u32, placement: SurfaceGeometry, mirrored: bool) -> Surface {
        let mesh = Mesh {
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
            normals: vec![Vec3::Z; 3],
            triangles: vec![[0, 1, 2]],
            ..Mesh::default()
        };
        Surface {
            node: sinew_scene::NodeId(node),
            mesh: Arc::new(mesh),
            materials: Arc::new([]),
            geometry: placement,
            mirrored,
            solid: None,
            muscle: None,
            fibers: Arc::default(),
            coordinates: Vec::new(),
            ghost: None,
            visible: true,
            content: 0,
            skin: false,
        }
    }

    fn written(scene: &Scene, surfaces: Vec<Surface>) -> Vec<String> {
        let mut out = Vec::new();
        let frame = Frame { surfaces, ..Frame::default() };
        write(&mut out, scene, &frame, &mtl::MtlLibrary::of(&frame), None).expect("memory is writable");
        String::from_utf8(out).expect("text").lines().skip(1).map(str::to_owned).collect()
    }

    #[test]
    fn surfaces_follow_one_another_with_running_numbers() {
        let scene = scene_of(&["left arm", "left arm"]);
        let moved = SurfaceGeometry::Rigid(Mat4::from_translation(Vec3::new(0.1, -0.0, 1e-7)));
        let lines = written(&scene, vec![triangle(0, SurfaceGeometry::Rigid(Mat4::IDENTITY), false), triangle(1, moved, false)]);
        assert_eq!(lines[0..2], ["g left_arm", "v 0 0 0"]);
        assert_eq!(lines[7], "f 1//1 2//2 3//3");
        assert_eq!(lines[8..10], ["g left_arm.2", "v 0.1 0 0.0000001"]);
        assert_eq!(lines[15], "f 4//4 5//5 6//6");
    }

    #[test]
    fn a_mirrored_surface_keeps_its_outside() {
        let scene = scene_of(&["a"]);
        let mirror = Mat4::from_scale(Vec3::new(-2.0, 1.0, 1.0));
        let lines = written(&scene, vec![triangle(0, SurfaceGeometry::Rigid(mirror), true)]);
        assert_eq!(lines[1..], ["v 0 0 0", "v -2 0 0", "v 0 1 0", "vn 0 0 1", "vn 0 0 1", "vn 0 0 1", "f 1//1 3//3 2//2"]);
    }

    #[test]
    fn normals_follow_the_inverse_transpose() {
        let scene = scene_of(&["a"]);
        let mut surface = triangle(0, SurfaceGeometry::Rigid(Mat4::from_scale(Vec3::new(2.0, 1.0, 1.0))), false);
        Arc::get_mut(&mut surface.mesh).expect("the only owner").normals = vec![Vec3::new(1.0, 1.0, 0.0).normalize(); 3];
        let lines = written(&scene, vec![surface]);
        let normal: Vec<f32> = lines[4].split(' ').skip(1).map(|x| x.parse().expect("a number")).collect();
        let expected = Vec3::new(1.0, 2.0, 0.0).normalize();
        assert!((Vec3::from_slice(&normal) - expected).length() < 1e-6);
    }

    #[test]
    fn what_is_not_finite_or_not_there_is_left_out() {
        let scene = scene_of(&["a"]);
        let mut surface = triangle(0, SurfaceGeometry::Rigid(Mat4::IDENTITY), false);
        let mesh = Arc::get_mut(&mut surface.mesh).expect("the only owner");
        mesh.positions.push(Vec3::NAN);
        mesh.triangles.extend([[0, 1, 3], [0, 1, 99]]);
        let mut hidden = triangle(0, SurfaceGeometry::Rigid(Mat4::IDENTITY), false);
        hidden.visible = false;
        let lines = written(&scene, vec![surface, hidden]);
        assert_eq!(lines.iter().filter(|line| line.starts_with("f ")).count(), 1);
        assert_eq!(lines.iter().filter(|line| line.starts_with("v ")).count(), 3);
        let flat = triangle(0, SurfaceGeometry::Rigid(Mat4::ZERO), false);
        assert!(written(&scene, vec![flat]).iter().all(|line| !line.contains("NaN")));
    }
}

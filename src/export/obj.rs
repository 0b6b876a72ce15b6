//! The posed surface as Wavefront OBJ: world space, metres, Y up, triangles with normals, one group a surface.

use std::collections::HashSet;
use std::io::{self, Write};
use std::path::Path;

use glam::{Mat3, Vec3};

use super::{ExportError, atomic::write_whole};
use crate::scene::{Frame, Placement, Scene, Surface};

/// Whether `frame` shows any triangle.
pub fn has_surface(frame: &Frame) -> bool {
    frame.surfaces.iter().any(|surface| surface.visible && !surface.mesh.triangles.is_empty())
}

/// Writes the visible surfaces of `frame`, a pose of `scene`, to `file`.
///
/// # Errors
/// [`ExportError`] where the file cannot be written.
pub fn save(file: &Path, scene: &Scene, frame: &Frame) -> Result<(), ExportError> {
    write_whole(file, |out| write(out, scene, frame))
}

/// Writes the visible surfaces of `frame`, a pose of `scene`, as OBJ to `out`.
///
/// Numbers have as many digits as tell the `f32` apart from its neighbours. Faces are counter-clockwise seen from outside, also where the
/// transform mirrors. A triangle with a corner that is not finite is left out, and so are vertices that no triangle uses.
///
/// # Errors
/// What `out` returns.
pub fn write(out: &mut impl Write, scene: &Scene, frame: &Frame) -> io::Result<()> {
    writeln!(out, "# Sinew {}: world space, metres, Y up", env!("CARGO_PKG_VERSION"))?;
    let mut names = HashSet::new();
    let mut written = 0;
    for surface in frame.surfaces.iter().filter(|surface| surface.visible) {
        let name = &scene.graph.node(surface.node).name;
        writeln!(out, "g {}", unique(&group_name(name), &mut names))?;
        written += write_surface(out, surface, written)?;
    }
    Ok(())
}

/// Writes one surface whose first vertex is number `before + 1`, and returns how many vertices it has.
fn write_surface(out: &mut impl Write, surface: &Surface, before: u64) -> io::Result<u64> {
    let vertices = Vertices::of(surface);
    // Number of each vertex in the file, from 1; 0 = not written.
    let mut numbers = vec![0_u64; surface.mesh.positions.len()];
    let finite = |v: &u32| vertices.position(*v).is_finite() && (*v as usize) < surface.mesh.positions.len();
    let triangles = || surface.mesh.triangles.iter().filter(|corners| corners.iter().all(finite));
    for corner in triangles().flatten() {
        if let Some(number) = numbers.get_mut(*corner as usize) {
            *number = 1;
        }
    }
    let used: Vec<u32> = (0..).zip(&numbers).filter(|(_, used)| **used == 1).map(|(v, _)| v).collect();
    for (number, v) in (before + 1..).zip(&used) {
        // `+ 0.0` turns a negative zero into zero.
        let Vec3 { x, y, z } = vertices.position(*v) + 0.0;
        writeln!(out, "v {x} {y} {z}")?;
        if let Some(slot) = numbers.get_mut(*v as usize) {
            *slot = number;
        }
    }
    for v in &used {
        let Vec3 { x, y, z } = vertices.normal(*v) + 0.0;
        writeln!(out, "vn {x} {y} {z}")?;
    }
    let number = |v: u32| numbers.get(v as usize).copied().unwrap_or_default();
    for &[a, b, c] in triangles() {
        let (a, b, c) = if surface.mirrored { (a, c, b) } else { (a, b, c) };
        let (a, b, c) = (number(a), number(b), number(c));
        writeln!(out, "f {a}//{a} {b}//{b} {c}//{c}")?;
    }
    Ok(used.len() as u64)
}

/// A surface's vertices in the world.
struct Vertices<'a> {
    surface: &'a Surface,
    /// Turns normals of a rigid surface into the world, up to their length.
    normal_matrix: Mat3,
}

impl<'a> Vertices<'a> {
    fn of(surface: &'a Surface) -> Self {
        let normal_matrix = match &surface.placement {
            Placement::Rigid(matrix) => {
                // The cofactor matrix is the inverse transpose times the determinant: it is there even where the inverse is not.
                let [x, y, z] = [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(|axis| axis.truncate());
                let cofactor = Mat3::from_cols(y.cross(z), z.cross(x), x.cross(y));
                if x.dot(y.cross(z)) < 0.0 { -cofactor } else { cofactor }
            }
            Placement::Deformed { .. } => Mat3::IDENTITY,
        };
        Self { surface, normal_matrix }
    }

    fn position(&self, v: u32) -> Vec3 {
        self.surface.position(v)
    }

    /// A unit vector; upwards where the surface has no normal.
    fn normal(&self, v: u32) -> Vec3 {
        let normals = match &self.surface.placement {
            Placement::Rigid(_) => &self.surface.mesh.normals,
            Placement::Deformed { normals, .. } => normals,
        };
        normals.get(v as usize).and_then(|normal| (self.normal_matrix * *normal).try_normalize()).unwrap_or(Vec3::Y)
    }
}

/// A name as OBJ readers take it: no blanks, no line breaks, not empty.
fn group_name(name: &str) -> String {
    let name: String = name.trim().chars().map(|c| if c.is_whitespace() || c.is_control() || c == '#' { '_' } else { c }).collect();
    if name.is_empty() { "surface".to_owned() } else { name }
}

fn unique(name: &str, taken: &mut HashSet<String>) -> String {
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
    use crate::scene::{Mesh, Node};
    use glam::Mat4;
    use std::sync::Arc;

    fn scene_of(names: &[&str]) -> Scene {
        let mut scene = Scene::default();
        for name in names {
            scene.graph.add(None, Node::new(*name));
        }
        scene
    }

    /// A triangle in the XY plane that faces +Z.
    fn triangle(node: u32, placement: Placement, mirrored: bool) -> Surface {
        let mesh = Mesh {
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
            normals: vec![Vec3::Z; 3],
            triangles: vec![[0, 1, 2]],
            ..Mesh::default()
        };
        Surface {
            node: crate::scene::NodeId(node),
            mesh: Arc::new(mesh),
            materials: Arc::new([]),
            placement,
            mirrored,
            muscle: None,
            visible: true,
            content: 0,
        }
    }

    fn written(scene: &Scene, surfaces: Vec<Surface>) -> Vec<String> {
        let mut out = Vec::new();
        write(&mut out, scene, &Frame { surfaces, ..Frame::default() }).expect("memory is writable");
        String::from_utf8(out).expect("text").lines().skip(1).map(str::to_owned).collect()
    }

    #[test]
    fn surfaces_follow_one_another_with_running_numbers() {
        let scene = scene_of(&["left arm", "left arm"]);
        let moved = Placement::Rigid(Mat4::from_translation(Vec3::new(0.1, -0.0, 1e-7)));
        let lines = written(&scene, vec![triangle(0, Placement::Rigid(Mat4::IDENTITY), false), triangle(1, moved, false)]);
        assert_eq!(lines[0..2], ["g left_arm", "v 0 0 0"]);
        assert_eq!(lines[7], "f 1//1 2//2 3//3");
        assert_eq!(lines[8..10], ["g left_arm.2", "v 0.1 0 0.0000001"]);
        assert_eq!(lines[15], "f 4//4 5//5 6//6");
    }

    #[test]
    fn a_mirrored_surface_keeps_its_outside() {
        let scene = scene_of(&["a"]);
        let mirror = Mat4::from_scale(Vec3::new(-2.0, 1.0, 1.0));
        let lines = written(&scene, vec![triangle(0, Placement::Rigid(mirror), true)]);
        assert_eq!(lines[1..], ["v 0 0 0", "v -2 0 0", "v 0 1 0", "vn 0 0 1", "vn 0 0 1", "vn 0 0 1", "f 1//1 3//3 2//2"]);
    }

    #[test]
    fn normals_follow_the_inverse_transpose() {
        let scene = scene_of(&["a"]);
        let mut surface = triangle(0, Placement::Rigid(Mat4::from_scale(Vec3::new(2.0, 1.0, 1.0))), false);
        Arc::get_mut(&mut surface.mesh).expect("the only owner").normals = vec![Vec3::new(1.0, 1.0, 0.0).normalize(); 3];
        let lines = written(&scene, vec![surface]);
        let normal: Vec<f32> = lines[4].split(' ').skip(1).map(|x| x.parse().expect("a number")).collect();
        let expected = Vec3::new(1.0, 2.0, 0.0).normalize();
        assert!((Vec3::from_slice(&normal) - expected).length() < 1e-6);
    }

    #[test]
    fn what_is_not_finite_or_not_there_is_left_out() {
        let scene = scene_of(&["a"]);
        let mut surface = triangle(0, Placement::Rigid(Mat4::IDENTITY), false);
        let mesh = Arc::get_mut(&mut surface.mesh).expect("the only owner");
        mesh.positions.push(Vec3::NAN);
        mesh.triangles.extend([[0, 1, 3], [0, 1, 99]]);
        let mut hidden = triangle(0, Placement::Rigid(Mat4::IDENTITY), false);
        hidden.visible = false;
        let lines = written(&scene, vec![surface, hidden]);
        assert_eq!(lines.iter().filter(|line| line.starts_with("f ")).count(), 1);
        assert_eq!(lines.iter().filter(|line| line.starts_with("v ")).count(), 3);
        let flat = triangle(0, Placement::Rigid(Mat4::ZERO), false);
        assert!(written(&scene, vec![flat]).iter().all(|line| !line.contains("NaN")));
    }
}

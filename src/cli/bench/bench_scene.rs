//! The scene of the benchmark: a sphere that every renderer can draw.

use std::sync::Arc;

use glam::{Mat4, Quat, Vec2, Vec3};

use super::spheres::{HEIGHT, WIDTH};
use crate::render::{Display, RenderJob};
use crate::scene::{
    Bounds, Camera, Frame, Image, ImageId, Material, MaterialBinding, MaterialId, Mesh, Node, Paint, Part, Pixels, Projection, Scene,
    Surface, SurfaceGeometry, TextureRef, WrapMode,
};

/// A scene of one sphere.
pub(super) struct BenchScene {
    pub scene: Scene,
    pub frame: Frame,
}

impl BenchScene {
    /// A sphere of so many segments round and rings from pole to pole, plain or with a texture of 512 × 512.
    pub(super) fn sphere(segments: u32, rings: u32, textured: bool) -> Self {
        let mut scene = Scene::default();
        let node = scene.graph.add(None, Node::new("sphere"));
        let mut material = Material { diffuse: Paint::color(0.9, 0.6, 0.5), ..Material::default() };
        if textured {
            let checker = |i: u32| if (i % 512 / 32 + i / 512 / 32).is_multiple_of(2) { [200, 180, 90, 255] } else { [90, 120, 200, 255] };
            let pixels = Pixels { width: 512, height: 512, rgba: (0..512 * 512).flat_map(checker).collect() };
            scene.images.push(Image { pixels: Some(Arc::new(pixels)), ..Image::default() });
            let texture = TextureRef {
                image: ImageId(0),
                semantic: String::new(),
                wrap_s: WrapMode::Repeat,
                wrap_t: WrapMode::Repeat,
                transform: None,
            };
            material.diffuse.texture = Some(texture);
        }
        scene.materials.push(material.clone());
        let surface = Surface {
            node,
            mesh: Arc::new(sphere(segments, rings)),
            materials: vec![Some(MaterialBinding::plain(MaterialId(0)))].into(),
            geometry: SurfaceGeometry::Rigid(Mat4::IDENTITY),
            mirrored: false,
            solid: None,
            muscle: None,
            fibers: Arc::default(),
            coordinates: Vec::new(),
            ghost: None,
            visible: true,
            content: 0,
            skin: false,
        };
        let bounds = Bounds { min: Vec3::NEG_ONE, max: Vec3::ONE };
        let frame = Frame { surfaces: vec![surface], materials: vec![material], bounds, ..Frame::default() };
        Self { scene, frame }
    }

    /// The picture of the sphere.
    pub(super) fn job<'a>(&'a self, camera: &'a Camera, display: &'a Display) -> RenderJob<'a> {
        RenderJob { scene: &self.scene, frame: &self.frame, camera, display, width: WIDTH, height: HEIGHT }
    }

    /// Turns the sphere to this angle, radians.
    pub(super) fn turn(&mut self, angle: f32) {
        self.frame.surfaces[0].geometry = SurfaceGeometry::Rigid(Mat4::from_rotation_y(angle));
    }
}

/// A camera so far in front of the sphere's middle.
pub(super) fn camera(distance: f32) -> Camera {
    Camera {
        eye: Vec3::Z * distance,
        rotation: Quat::IDENTITY,
        projection: Projection::Perspective { fov_y: 45f32.to_radians() },
        near: 0.1,
        far: 100.0,
    }
}

/// A UV sphere of radius 1 with smooth normals, `2 · segments · (rings − 1)` triangles.
pub(super) fn sphere(segments: u32, rings: u32) -> Mesh {
    let mut mesh = Mesh { name: "sphere".into(), ..Mesh::default() };
    let mut uv = Vec::new();
    for ring in 0..=rings {
        let v = ring as f32 / rings as f32;
        let (sin, cos) = (v * std::f32::consts::PI).sin_cos();
        for segment in 0..=segments {
            let u = segment as f32 / segments as f32;
            let (s, c) = (u * std::f32::consts::TAU).sin_cos();
            mesh.positions.push(Vec3::new(sin * s, cos, sin * c));
            uv.push(Vec2::new(u, 1.0 - v));
        }
    }
    let at = |ring: u32, segment: u32| ring * (segments + 1) + segment;
    for ring in 0..rings {
        for segment in 0..segments {
            let (a, b, c, d) = (at(ring, segment), at(ring + 1, segment), at(ring + 1, segment + 1), at(ring, segment + 1));
            if ring + 1 < rings {
                mesh.triangles.push([a, b, c]);
            }
            if ring > 0 {
                mesh.triangles.push([a, c, d]);
            }
        }
    }
    mesh.normals = mesh.positions.clone();
    mesh.source_count = mesh.positions.len() as u32;
    mesh.source_vertex = (0..mesh.source_count).collect();
    mesh.uv_sets = vec![uv];
    mesh.parts = vec![Part { symbol: String::new(), triangles: 0..mesh.triangles.len() as u32, lines: 0..0 }];
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_yardstick_has_the_triangles_it_says() {
        assert_eq!(sphere(100, 51).triangles.len(), 10_000);
        assert_eq!(sphere(316, 159).triangles.len(), 99_856);
    }
}

//! How fast the rasterizer is on this machine: spheres that every renderer can draw, and the floor that no program gets below.
//!
//! The sphere has radius 1 and is lit by one far light, back faces are left out, and the picture is 1280 × 720 with a vertical field of view
//! of 45°. "Fill" stands 2.6 in front of the camera and covers 411 thousand pixels, "figure" stands at 5.0. The sphere turns by 0.01 rad a frame. A frame is
//! everything from clearing to finished pixels in memory.

use std::hint::black_box;
use std::sync::Arc;
use std::time::{Duration, Instant};

use glam::{Mat4, Quat, Vec2, Vec3};

use super::{Background, Display, Renderer, Samples, Shading};
use crate::scene::{
    Bounds, Camera, Frame, Image, ImageId, Material, MaterialBinding, MaterialId, Mesh, Node, Paint, Part, Pixels, Placement, Projection,
    Scene, Surface, TextureRef, Wrap,
};

/// One thing that was measured.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// What: `10k fill`, …
    pub name: &'static str,
    /// The fastest frame, milliseconds.
    pub min_ms: f64,
    /// The median frame, milliseconds.
    pub median_ms: f64,
}

/// What [`run`] found.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// The instruction set of the kernels.
    pub simd: &'static str,
    /// Threads that drew.
    pub threads: usize,
    /// Measurements, the floor first.
    pub rows: Vec<Row>,
}

impl Report {
    /// The median of the row with this name; infinite where there is none.
    pub fn median(&self, name: &str) -> f64 {
        self.rows.iter().find(|row| row.name == name).map_or(f64::INFINITY, |row| row.median_ms)
    }
}

const WIDTH: u32 = 1280;
const HEIGHT: u32 = 720;

/// Measures with this many threads (`None` = one a core) and an instruction set by name (`None` = the fastest), each scene for at most `budget` or
/// 400 frames.
pub fn run(threads: Option<usize>, simd: Option<&str>, budget: Duration) -> Report {
    let mut renderer = Renderer::new(threads);
    if let Some(name) = simd {
        renderer.set_simd(name);
    }
    let mut rows = floor(budget);
    let base = Display {
        samples: Samples::One,
        grid: false,
        background: Background::Solid(0x20242C),
        cull_back_faces: true,
        ambient: 0.15,
        light: Some(Vec3::new(0.4, 0.6, 0.7).normalize() * 1e4),
        ..Display::default()
    };
    let phong = Display { shading: Shading::Phong, ..base.clone() };
    let four = Display { samples: Samples::Four, ..base.clone() };
    let mut measure = |name: &'static str, yard: &mut Yard, display: &Display, size: [u32; 2]| {
        rows.push(median(name, budget, |turn| yard.draw(&mut renderer, display, turn, size)));
    };
    let full = [WIDTH, HEIGHT];
    let mut ten = Yard::sphere(100, 51, false);
    measure("10k fill", &mut ten, &base, full);
    measure("10k fill, phong", &mut ten, &phong, full);
    measure("10k fill, 4 samples", &mut ten, &four, full);
    measure("10k figure", &mut ten.at(5.0), &base, full);
    measure("10k fill, textured", &mut Yard::sphere(100, 51, true), &base, full);
    let mut hundred = Yard::sphere(316, 159, false);
    measure("100k fill", &mut hundred, &base, full);
    measure("100k fill, 4 samples", &mut hundred, &four, full);
    measure("100k figure", &mut hundred.at(5.0), &base, full);
    measure("1M fill", &mut Yard::sphere(1000, 501, false), &base, full);
    measure("muscle 800 x 600", &mut Yard::sphere(36, 11, true), &Display::default(), [800, 600]);
    Report { simd: renderer.simd(), threads: renderer.threads(), rows }
}

/// Runs `frame` with a growing angle and reports the times.
fn median(name: &'static str, budget: Duration, mut frame: impl FnMut(f32)) -> Row {
    // The first frames make buffers and warm caches.
    for warm in 0..3 {
        frame(warm as f32 * 0.01);
    }
    let (begin, mut times) = (Instant::now(), Vec::new());
    while times.len() < 5 || (times.len() < 400 && begin.elapsed() < budget) {
        let start = Instant::now();
        frame(times.len() as f32 * 0.01);
        times.push(start.elapsed().as_secs_f64() * 1e3);
    }
    times.sort_by(f64::total_cmp);
    Row { name, min_ms: times[0], median_ms: times[times.len() / 2] }
}

/// What any renderer of this picture has to do at least, on one thread.
fn floor(budget: Duration) -> Vec<Row> {
    let pixels = (WIDTH * HEIGHT) as usize;
    let (mut color, mut depth, mut copy) = (vec![0u32; pixels], vec![0f32; pixels], vec![0u32; pixels]);
    let clear = median("floor: clear colour and depth", budget, |turn| {
        color.fill(turn.to_bits());
        depth.fill(1.0);
        black_box((&mut color, &mut depth));
    });
    let pass = median("floor: depth test and write every pixel", budget, |turn| {
        for (color, depth) in color.iter_mut().zip(&mut depth) {
            let front = turn < *depth;
            *depth = if front { turn } else { *depth };
            *color = if front { turn.to_bits() } else { *color };
        }
        black_box((&mut color, &mut depth));
    });
    let memcpy = median("floor: copy the picture", budget, |_| {
        copy.copy_from_slice(&color);
        black_box(&mut copy);
    });
    vec![clear, pass, memcpy]
}

/// A scene of one sphere.
struct Yard {
    scene: Scene,
    frame: Frame,
    distance: f32,
}

impl Yard {
    fn sphere(segments: u32, rings: u32, textured: bool) -> Self {
        let mut scene = Scene::default();
        let node = scene.graph.add(None, Node::new("sphere"));
        let mut material = Material { diffuse: Paint::color(0.9, 0.6, 0.5), ..Material::default() };
        if textured {
            let checker = |i: u32| if (i % 512 / 32 + i / 512 / 32).is_multiple_of(2) { [200, 180, 90, 255] } else { [90, 120, 200, 255] };
            let pixels = Pixels { width: 512, height: 512, rgba: (0..512 * 512).flat_map(checker).collect() };
            scene.images.push(Image { pixels: Some(Arc::new(pixels)), ..Image::default() });
            let texture = TextureRef { image: ImageId(0), semantic: String::new(), wrap_s: Wrap::Repeat, wrap_t: Wrap::Repeat };
            material.diffuse.texture = Some(texture);
        }
        scene.materials.push(material.clone());
        let surface = Surface {
            node,
            mesh: Arc::new(sphere(segments, rings)),
            materials: vec![Some(MaterialBinding::plain(MaterialId(0)))].into(),
            placement: Placement::Rigid(Mat4::IDENTITY),
            mirrored: false,
            muscle: None,
            visible: true,
            content: 0,
        };
        let bounds = Bounds { min: Vec3::NEG_ONE, max: Vec3::ONE };
        let frame = Frame { surfaces: vec![surface], materials: vec![material], bounds, ..Frame::default() };
        Self { scene, frame, distance: 2.6 }
    }

    fn at(&self, distance: f32) -> Self {
        Self { scene: self.scene.clone(), frame: self.frame.clone(), distance }
    }

    fn draw(&mut self, renderer: &mut Renderer, display: &Display, turn: f32, size: [u32; 2]) {
        self.frame.surfaces[0].placement = Placement::Rigid(Mat4::from_rotation_y(turn));
        let camera = Camera {
            eye: Vec3::Z * self.distance,
            rotation: Quat::IDENTITY,
            projection: Projection::Perspective { fov_y: 45f32.to_radians() },
            near: 0.1,
            far: 100.0,
        };
        black_box(renderer.draw(&self.scene, &self.frame, &camera, display, size[0], size[1]));
    }
}

/// A UV sphere of radius 1 with smooth normals, `2 · segments · (rings − 1)` triangles.
fn sphere(segments: u32, rings: u32) -> Mesh {
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

    #[test]
    fn a_run_measures_everything() {
        let report = run(Some(1), None, Duration::ZERO);
        assert_eq!(report.rows.len(), 13);
        assert!(report.rows.iter().all(|row| row.min_ms > 0.0 && row.min_ms <= row.median_ms));
        assert!(report.median("10k fill").is_finite() && report.median("no such row").is_infinite());
    }
}

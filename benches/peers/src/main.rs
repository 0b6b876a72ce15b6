//! Draws the yardstick of `sinew bench` with `euc` and `retrofire-core`, and sets all side by side. Given the program: `sinew-peers target/release/sinew`.
//!
//! The scene is described in src/render/bench/mod.rs: a sphere of radius 1, one far light, back faces left out, 1280 × 720. Both peers draw with one
//! thread, which is all they have.

use std::hint::black_box;
use std::process::{Command, ExitCode};
use std::time::Instant;

const SIZE: [usize; 2] = [1280, 720];
const LIGHT: [f32; 3] = [0.398, 0.597, 0.696];
const COLOR: [f32; 3] = [0.9, 0.6, 0.5];
const SECONDS: f64 = 2.0;

/// A sphere's points, which are its normals too, and its triangles, outside anticlockwise.
struct Sphere {
    points: Vec<[f32; 3]>,
    triangles: Vec<[usize; 3]>,
}

fn sphere(segments: usize, rings: usize) -> Sphere {
    let (mut points, mut triangles) = (Vec::new(), Vec::new());
    for ring in 0..=rings {
        let (sin, cos) = (ring as f32 / rings as f32 * std::f32::consts::PI).sin_cos();
        for segment in 0..=segments {
            let (s, c) = (segment as f32 / segments as f32 * std::f32::consts::TAU).sin_cos();
            points.push([sin * s, cos, sin * c]);
        }
    }
    let at = |ring: usize, segment: usize| ring * (segments + 1) + segment;
    for ring in 0..rings {
        for segment in 0..segments {
            let [a, b, c, d] = [at(ring, segment), at(ring + 1, segment), at(ring + 1, segment + 1), at(ring, segment + 1)];
            if ring + 1 < rings {
                triangles.push([a, b, c]);
            }
            if ring > 0 {
                triangles.push([a, c, d]);
            }
        }
    }
    Sphere { points, triangles }
}

fn lambert(normal: [f32; 3]) -> [f32; 3] {
    let cosine: f32 = normal.iter().zip(LIGHT).map(|(n, l)| n * l).sum();
    COLOR.map(|c| c * (0.15 + 0.85 * cosine.max(0.0)))
}

/// Median milliseconds of a frame.
fn median(mut frame: impl FnMut(u32)) -> f64 {
    (0..3).for_each(&mut frame);
    let (begin, mut times) = (Instant::now(), Vec::new());
    while times.len() < 10 || (times.len() < 400 && begin.elapsed().as_secs_f64() < SECONDS) {
        let start = Instant::now();
        frame(times.len() as u32);
        times.push(start.elapsed().as_secs_f64() * 1e3);
    }
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

mod by_euc {
    use euc::buffer::Buffer2d;
    use euc::{Pipeline, Target, rasterizer};
    use vek::{Mat4, Rgb, Vec3, Vec4};

    use super::{SIZE, Sphere, lambert, median};

    struct Lit {
        turn: Mat4<f32>,
        clip: Mat4<f32>,
    }

    impl Pipeline for Lit {
        type Vertex = [f32; 3];
        type VsOut = Rgb<f32>;
        type Pixel = u32;

        #[inline(always)]
        fn vert(&self, &[x, y, z]: &[f32; 3]) -> ([f32; 4], Rgb<f32>) {
            let turned = self.turn * Vec4::new(x, y, z, 1.0);
            let [r, g, b] = lambert([turned.x, turned.y, turned.z]);
            ((self.clip * turned).into_array(), Rgb::new(r, g, b))
        }

        #[inline(always)]
        fn frag(&self, color: &Rgb<f32>) -> u32 {
            let [r, g, b] = color.map(|c| (c * 255.0 + 0.5) as u32).into_array();
            0xFF00_0000 | r << 16 | g << 8 | b
        }
    }

    pub fn measure(sphere: &Sphere, distance: f32) -> (f64, usize) {
        // It has no indices.
        let corners: Vec<[f32; 3]> = sphere.triangles.iter().flatten().map(|&i| sphere.points[i]).collect();
        let (mut color, mut depth) = (Buffer2d::new(SIZE, 0u32), Buffer2d::new(SIZE, 1.0f32));
        let clip = Mat4::perspective_fov_rh_no(45f32.to_radians(), SIZE[0] as f32, SIZE[1] as f32, 0.1, 100.0)
            * Mat4::translation_3d(Vec3::new(0.0, 0.0, -distance));
        let took = median(|number| {
            color.clear(0);
            depth.clear(1.0);
            let turn = Mat4::rotation_y(number as f32 * 0.01);
            let pipeline = Lit { turn, clip };
            pipeline.draw::<rasterizer::Triangles<_, rasterizer::BackfaceCullingEnabled>, _>(&corners, &mut color, Some(&mut depth));
        });
        (took, color.as_ref().iter().filter(|pixel| **pixel != 0).count())
    }
}

mod by_retrofire {
    use retrofire_core::math::color::Color3f;
    use retrofire_core::math::mat::ProjMat3;
    use retrofire_core::prelude::*;
    use retrofire_core::render::{Model, render, shader};
    use retrofire_core::util::Dims;

    use super::{SIZE, Sphere, lambert, median};

    pub fn measure(sphere: &Sphere, distance: f32) -> (f64, usize) {
        let points: Vec<Vertex3<()>> = sphere.points.iter().map(|p| vertex(pt3(p[0], p[1], p[2]), ())).collect();
        let triangles: Vec<Tri<usize>> = sphere.triangles.iter().map(|&[a, b, c]| tri(a, b, c)).collect();
        let [w, h] = SIZE.map(|side| side as u32);
        let mut target = Framebuf {
            color_buf: Colorbuf::<_, retrofire_core::util::pixfmt::Xrgb8888>::new(Buf2::<u32>::new(Dims(w, h))),
            depth_buf: Buf2::<f32>::new(Dims(w, h)),
        };
        let aspect = w as f32 / h as f32;
        let focal = 1.0 / 22.5f32.to_radians().tan() / aspect;
        let project = perspective(focal, aspect, 0.1..100.0);
        let viewport = viewport(pt2(0, 0)..pt2(w, h));
        let context = Context::default();
        let took = median(|number| {
            target.color_buf.buf.fill(0);
            // It keeps the reciprocal of the depth: nothing is infinitely far.
            target.depth_buf.fill(0.0);
            let (sin, cos) = (number as f32 * 0.01).sin_cos();
            let shader = shader::new(
                move |v: Vertex3<()>, clip: &ProjMat3<Model>| {
                    let [x, y, z] = v.pos.0;
                    let turned = [x * cos + z * sin, y, z * cos - x * sin];
                    let [r, g, b] = lambert(turned);
                    vertex(clip.apply(&pt3(turned[0], turned[1], turned[2])), rgb(r, g, b))
                },
                |frag: Frag<Color3f<_>>, _| frag.var.to_color4(),
            );
            let clip = translate(vec3(0.0, 0.0, distance)).to().then(&project);
            render(&triangles, &points, &shader, &clip, viewport, &mut target, &context);
        });
        (took, target.color_buf.buf.data().iter().filter(|pixel| **pixel != 0).count())
    }
}

fn main() -> ExitCode {
    let Some(program) = std::env::args().nth(1) else {
        eprintln!("sinew-peers PROGRAM");
        return ExitCode::FAILURE;
    };
    let call = Command::new(program).args(["bench", "--json", "--seconds", "2", "--scene", "sphere-10"]).output();
    let report = call.ok().and_then(|output| serde_json::from_slice::<serde_json::Value>(&output.stdout).ok());
    let Some(report) = report else {
        eprintln!("sinew bench could not be read");
        return ExitCode::FAILURE;
    };
    let ours = |scene: &str, view: &str| {
        let rows = report["scenes"].as_array()?;
        let row =
            rows.iter().find(|row| row["scene"] == scene && row["view"] == view && row["shading"] == "gouraud" && row["samples"] == 1)?;
        Some((row["median_ms"].as_f64()?, row["lit_pixels"].as_u64()?))
    };
    println!("{:24}{:>18}{:>14}{:>14}{:>8}   lit pixels of both", "scene", "peer", "its ms", "sinew, ms", "ratio");
    for (scene, segments, rings) in [("sphere-10k", 100, 51), ("sphere-100k", 316, 159)] {
        let sphere = sphere(segments, rings);
        for (view, distance) in [("fill", 2.6), ("figure", 5.0)] {
            let Some((median_ms, lit)) = ours(scene, view) else { continue };
            for (peer, (took, pixels)) in
                [("euc", by_euc::measure(&sphere, distance)), ("retrofire-core", by_retrofire::measure(&sphere, distance))]
            {
                let label = format!("{scene} {view}");
                println!("{label:24}{peer:>18}{took:14.2}{median_ms:14.2}{:7.1}×   {} {lit}", took / median_ms, black_box(pixels));
            }
        }
    }
    ExitCode::SUCCESS
}

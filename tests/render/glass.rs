//! Glass: what is laid over what is there is laid there once, at every size, number of samples, number of threads and vector width.

use crate::render_support::models::soup;
use crate::render_support::reference::{self, Corner};
use crate::render_support::rng::Rng;
use crate::render_support::{World, camera_at, pixel_camera, plain};
use glam::{Mat4, Quat, Vec3, Vec4};
use sinew::render::{Display, Renderer, Samples};
use sinew::scene::{Camera, Material, MaterialBinding, Paint, ShadingModel};

const OPACITY: f64 = 0.5;

fn glass(world: &mut World) -> MaterialBinding {
    let white = Paint::color(1.0, 1.0, 1.0);
    world.material(Material { model: ShadingModel::Constant, diffuse: white, opacity: OPACITY as f32, ..Material::default() })
}

/// Triangles whose corners are pixels (y downward) as a surface before `pixel_camera`.
fn world_of(triangles: &[[Corner; 3]], size: [u32; 2]) -> World {
    let mut world = World::default();
    let glass = glass(&mut world);
    let corners = || triangles.iter().flatten();
    // Nearness falls with the distance, as in the reference.
    let place = |c: &Corner| Vec3::new(c.x as f32 / 256.0, size[1] as f32 - c.y as f32 / 256.0, 10.0 - c.distance as f32);
    let indices = (0..triangles.len() as u32).map(|t| [t * 3, t * 3 + 1, t * 3 + 2]).collect();
    let mut mesh = soup(corners().map(place).collect(), indices, Vec::new());
    let color = |t: &[Corner; 3]| [Vec4::new(t[0].color[0] as f32, t[0].color[1] as f32, t[0].color[2] as f32, 255.0) / 255.0; 3];
    mesh.colors = triangles.iter().flat_map(color).collect();
    world.place(mesh, Mat4::IDENTITY, Some(glass));
    world
}

/// Draws with everything that must not matter, and compares each pixel with the reference.
fn check(what: &str, triangles: &[[Corner; 3]], size: [u32; 2]) {
    let world = world_of(triangles, size);
    for samples in [Samples::One, Samples::Four] {
        let count = if samples == Samples::One { 1 } else { 4 };
        let expected = reference::draw_glass(triangles, OPACITY, count, size);
        for (simd, threads) in Renderer::simd_names().into_iter().zip([1, 2, 3, 2]) {
            let mut renderer = Renderer::new(Some(threads));
            assert!(renderer.set_simd(simd));
            let found = world.draw(&mut renderer, &pixel_camera(size), &Display { samples, ..plain() }, size);
            for (at, (expected, found)) in expected.iter().zip(&found).enumerate() {
                let channels = [16, 8, 0].map(|shift| f64::from(found >> shift & 255));
                // Every layer is rounded to bytes, which the next ones halve.
                let near = expected.iter().zip(channels).all(|(e, f)| (e - f).abs() <= 1.6);
                let place = (at as u32 % size[0], at as u32 / size[0]);
                assert!(near, "{what}, {size:?}, {samples:?}, {simd}, pixel {place:?}: {expected:?}, not {channels:?}");
            }
        }
    }
}

fn corner(x: f64, y: f64, distance: f64, color: [f64; 3]) -> Corner {
    Corner { x: (x * 256.0).round() as i64, y: (y * 256.0).round() as i64, distance, color }
}

fn color(rng: &mut Rng) -> [f64; 3] {
    std::array::from_fn(|_| rng.between(90.0, 255.0).round())
}

/// Wider than one, two, and eight times what a row is walked in at a time.
const SIZES: [[u32; 2]; 4] = [[90, 60], [300, 40], [1100, 20], [2400, 9]];

#[test]
fn triangles_lie_over_each_other_as_they_should() {
    let mut rng = Rng(21);
    for size in SIZES {
        let [w, h] = size.map(f64::from);
        for round in 0..12 {
            let triangle = |rng: &mut Rng| {
                // Even in depth, so that the order is that of the distances.
                let (distance, color) = (rng.between(1.0, 9.0), color(rng));
                std::array::from_fn(|_| corner(rng.between(-0.2, 1.2) * w, rng.between(-0.5, 1.5) * h, distance, color))
            };
            let mut triangles: Vec<[Corner; 3]> = (0..1 + round / 3).map(|_| triangle(&mut rng)).collect();
            if round == 0 {
                // As wide as the picture.
                triangles = vec![[(0.01, 0.3), (0.99, 0.1), (0.4, 0.98)].map(|(x, y)| corner(x * w, y * h, 5.0, [200.0, 130.0, 90.0]))];
            }
            check("triangles", &triangles, size);
        }
    }
}

#[test]
fn fans_strips_and_combs_cover_each_pixel_once() {
    let mut rng = Rng(22);
    for size in SIZES {
        let [w, h] = size.map(f64::from);
        for round in 0..4 {
            let color = color(&mut rng);
            let at = |x: f64, y: f64| corner(x, y, 5.0, color);
            let hub = at(rng.between(0.3, 0.7) * w, rng.between(0.3, 0.7) * h);
            let spokes = 3 + round * 11;
            let rim = |k: usize| {
                let angle = k as f64 / spokes as f64 * std::f64::consts::TAU;
                at((0.5 + angle.cos() * 0.6) * w, (0.5 + angle.sin() * 0.6) * h)
            };
            let fan: Vec<_> = (0..spokes).map(|k| [hub, rim(k), rim((k + 1) % spokes)]).collect();
            check("fan", &fan, size);
            // Thin and as wide as the picture.
            let teeth = 4 + round * 9;
            let point = |k: usize| at(if k.is_multiple_of(2) { 0.004 * w } else { 0.997 * w }, (k as f64 + 0.3) / teeth as f64 * h);
            let comb: Vec<_> = (0..teeth).map(|k| [point(k), point(k + 1), point(k + 2)]).collect();
            check("comb", &comb, size);
            let lattice: Vec<Corner> = (0..4)
                .flat_map(|j| (0..6).map(move |i| (i, j)))
                .map(|(i, j)| {
                    let shift = |rng: &mut Rng| rng.between(-0.3, 0.3);
                    at((f64::from(i) + shift(&mut rng)) / 5.0 * w, (f64::from(j) + shift(&mut rng)) / 3.0 * h)
                })
                .collect();
            let cells = (0..3).flat_map(|j| (0..5).map(move |i| i + j * 6));
            let mesh: Vec<_> =
                cells.flat_map(|k| [[lattice[k], lattice[k + 1], lattice[k + 7]], [lattice[k], lattice[k + 7], lattice[k + 6]]]).collect();
            check("mesh", &mesh, size);
        }
    }
}

#[test]
fn a_sheet_that_is_cut_by_the_picture_is_blended_once() {
    // A flat mesh cannot lie over itself, so each sample is glass or it is not, wherever the near plane and the guard band cut.
    let mut rng = Rng(23);
    let size = [400u32, 200];
    let cells = 7u32;
    for round in 0..150 {
        let mut world = World::default();
        let glass = glass(&mut world);
        let place = |rng: &mut Rng, k: u32| k as f32 / cells as f32 * 2.0 - 1.0 + rng.between(-0.04, 0.04) as f32;
        let positions = (0..=cells).flat_map(|j| (0..=cells).map(move |i| (i, j)));
        let positions: Vec<Vec3> = positions.map(|(i, j)| Vec3::new(place(&mut rng, i), place(&mut rng, j), 0.0)).collect();
        let corner = (0..cells).flat_map(|j| (0..cells).map(move |i| i + j * (cells + 1)));
        let triangles = corner.flat_map(|k| [[k, k + 1, k + cells + 2], [k, k + cells + 2, k + cells + 1]]).collect();
        let mut turn = || Quat::from_euler(glam::EulerRot::YXZ, rng.between(-1.6, 1.6) as f32, rng.between(-1.6, 1.6) as f32, 0.3);
        let (model, eye) = (turn(), turn());
        let scale = [1.0, 30.0, 900.0][round % 3];
        world.place(
            soup(positions, triangles, Vec::new()),
            Mat4::from_scale_rotation_translation(Vec3::splat(scale), model, Vec3::ZERO),
            Some(glass),
        );
        // Close above the sheet, looking anywhere.
        let eye = Camera { eye: model * Vec3::new(0.1, 0.2, 0.05), rotation: eye, ..camera_at(0.0) };
        for samples in [Samples::One, Samples::Four] {
            let found = world.draw(&mut Renderer::new(Some(2)), &eye, &Display { samples, ..plain() }, size);
            let levels = (0..=4).map(|hits| reference::byte(reference::light(128.0) * f64::from(hits) / 4.0));
            let levels: Vec<f64> = if samples == Samples::One { vec![0.0, 128.0] } else { levels.collect() };
            for (at, pixel) in found.iter().enumerate() {
                let value = f64::from(pixel & 255);
                let place = (at as u32 % size[0], at as u32 / size[0]);
                assert!(levels.iter().any(|level| (level - value).abs() <= 1.0), "round {round}, {samples:?}, pixel {place:?}: {value}");
            }
        }
    }
}

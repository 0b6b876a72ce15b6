//! The picture against a plain `f64` rasterizer, and against itself with other threads and instruction sets.

use crate::render_support::models::{self, belly, checker, profile, soup, sphere};
use crate::render_support::reference::{self, Corner};
use crate::render_support::rng::Rng;
use crate::render_support::{World, camera_at, plain};
use glam::{Mat4, Vec3, Vec4};
use proptest::prelude::*;
use sinew::render::{Background, Display, Highlight, RenderJob, RenderTarget, Renderer, Samples, Shading};
use sinew::scene::{Bounds, Camera, Material, OrbitCamera, Paint, Projection, ShadingModel, WrapMode};

const SIZE: [u32; 2] = [96, 72];

/// A corner of the picture as a point in the world of `camera_at(0)`, which looks along −Z.
fn to_world(corner: &Corner) -> Vec3 {
    let [w, h] = SIZE.map(f64::from);
    let tan = (45f64.to_radians() * 0.5).tan();
    let ndc = [corner.x as f64 / 256.0 / w * 2.0 - 1.0, 1.0 - corner.y as f64 / 256.0 / h * 2.0];
    let d = corner.distance;
    Vec3::new((ndc[0] * tan * w / h * d) as f32, (ndc[1] * tan * d) as f32, -d as f32)
}

fn world_of(triangles: &[[Corner; 3]]) -> World {
    let mut world = World::default();
    let unlit = world.material(Material { model: ShadingModel::Constant, diffuse: Paint::color(1.0, 1.0, 1.0), ..Material::default() });
    let corners = || triangles.iter().flatten();
    let indices = (0..triangles.len() as u32).map(|t| [t * 3, t * 3 + 1, t * 3 + 2]).collect();
    let mut mesh = soup(corners().map(to_world).collect(), indices, Vec::new());
    mesh.colors = corners().map(|c| Vec4::new(c.color[0] as f32, c.color[1] as f32, c.color[2] as f32, 255.0) / 255.0).collect();
    world.place(mesh, Mat4::IDENTITY, Some(unlit));
    world
}

/// Draws into the test's own memory.
fn draw_into(renderer: &mut Renderer, job: &RenderJob<'_>, bytes: &mut [u8], stride: usize) {
    renderer.draw_into(job, RenderTarget { bytes, stride }).expect("there is memory for the picture");
}

#[test]
fn agrees_with_the_plain_rasterizer_on_every_pixel() {
    let mut rng = Rng(7);
    let mut renderer = Renderer::new(Some(2));
    for round in 0..60 {
        let triangles: Vec<_> = (0..1 + round / 4).map(|_| reference::random(&mut rng, SIZE[0], SIZE[1])).collect();
        let expected = reference::draw(&triangles, SIZE[0], SIZE[1]);
        let found = world_of(&triangles).draw(&mut renderer, &camera_at(0.0), &plain(), SIZE);
        for (at, (expected, found)) in expected.iter().zip(&found).enumerate() {
            let channels = [16, 8, 0].map(|shift| f64::from(found >> shift & 255));
            let place = (at as u32 % SIZE[0], at as u32 / SIZE[0]);
            for (e, f) in expected.unwrap_or([0.0; 3]).iter().zip(channels) {
                assert!((e - f).abs() <= 1.0, "round {round}, pixel {place:?}: {expected:?}, not {channels:?}");
            }
        }
    }
}

#[test]
fn four_samples_agree_with_the_plain_rasterizer() {
    let mut rng = Rng(11);
    let mut renderer = Renderer::new(Some(1));
    for _ in 0..20 {
        let mut triangle = reference::random(&mut rng, SIZE[0], SIZE[1]);
        triangle.iter_mut().for_each(|corner| corner.color = [255.0; 3]);
        let display = Display { samples: Samples::Four, ..plain() };
        let found = world_of(&[triangle]).draw(&mut renderer, &camera_at(0.0), &display, SIZE);
        for (at, pixel) in found.iter().enumerate() {
            let (x, y) = (at as i64 % i64::from(SIZE[0]), at as i64 / i64::from(SIZE[0]));
            let hit = |[dx, dy]: &[i64; 2]| reference::inside(&triangle, x * 256 + 128 + dx, y * 256 + 128 + dy).is_some();
            let hits = reference::GRID.iter().filter(|offset| hit(offset)).count() as u32;
            assert_eq!(pixel & 255, reference::byte(f64::from(hits) / 4.0).round() as u32, "pixel ({x}, {y})");
        }
    }
}

#[test]
fn lambert_is_lambert() {
    // A square that faces the camera, a light off to the side, no ambient light: red = albedo · cos.
    for (light, distance) in [(Vec3::new(0.0, 0.0, 5.0), 5.0f32), (Vec3::new(3.0, 0.0, 4.0), 5.0), (Vec3::new(0.0, -40.0, 30.0), 50.0)] {
        let mut world = World::default();
        let red = world.material(Material { diffuse: Paint::color(0.8, 0.0, 0.0), ..Material::default() });
        world.place(models::square(), Mat4::from_scale(Vec3::splat(1e-3)), Some(red));
        for shading in [Shading::Flat, Shading::Gouraud, Shading::Phong] {
            let display = Display { light: Some(light), ambient: 0.0, shading, ..plain() };
            let pixels = world.draw(&mut Renderer::new(Some(1)), &camera_at(0.101), &display, [9, 9]);
            let expected = 0.8 * light.z / distance * 255.0;
            let found = (pixels[40] >> 16 & 255) as f32;
            assert!((expected - found).abs() <= 1.0, "{shading:?} {light}: {expected}, not {found}");
        }
    }
}

/// A world with a bit of everything.
fn everything() -> (World, Display, Camera) {
    let mut world = World::default();
    let texture = world.image(64, 48, |x, y| checker(x, y, 8, 64), WrapMode::Mirror);
    let diffuse = Paint { color: Vec3::ONE, texture: Some(texture) };
    let specular = Paint::color(0.5, 0.5, 0.4);
    let checkered = world.material(Material { diffuse, model: ShadingModel::Phong, specular, shininess: 40.0, ..Material::default() });
    world.place(sphere(24, 13), Mat4::IDENTITY, Some(checkered));
    let glass = world.material(Material { diffuse: Paint::color(0.3, 0.6, 0.9), opacity: 0.4, ..Material::default() });
    world.place(sphere(16, 9), Mat4::from_translation(Vec3::new(0.9, 0.3, 0.8)), Some(glass));
    world.place_muscle(belly(21, 18, profile), Mat4::from_translation(Vec3::new(-1.2, 0.0, 0.5)), None);
    models::arm(&mut world, 40.0);
    let mut orbit = OrbitCamera::default();
    orbit.fit(&world.frame.bounds, 1.5);
    let display = Display {
        bones: true,
        bone_axes: true,
        axes: true,
        bounding_box: true,
        wireframe: true,
        normal_glyphs: true,
        light_marker: true,
        highlight: Highlight { selected: Some(sinew::scene::NodeId(0)), ..Highlight::default() },
        ..Display::default()
    };
    (world, display, orbit.camera())
}

#[test]
fn threads_and_vector_widths_do_not_change_a_bit() {
    let (world, display, camera) = everything();
    let size = [211, 149];
    for shading in [Shading::Flat, Shading::Gouraud, Shading::Phong] {
        for samples in [Samples::One, Samples::Four] {
            let display = Display { shading, samples, ..display.clone() };
            let mut first: Option<Vec<u32>> = None;
            for threads in [1, 2, 5] {
                let mut renderer = Renderer::new(Some(threads));
                for simd in Renderer::simd_names() {
                    assert!(renderer.set_simd(simd));
                    let found = world.draw(&mut renderer, &camera, &display, size);
                    let expected = first.get_or_insert_with(|| found.clone());
                    let differing = expected.iter().zip(&found).filter(|(a, b)| a != b).count();
                    assert_eq!(differing, 0, "{shading:?} {samples:?} {threads} threads {simd}");
                }
            }
        }
    }
}

#[test]
fn many_triangles_in_many_units_keep_their_order() {
    // Without a depth test the last triangle wins, so any disorder between workers shows.
    let mut rng = Rng(3);
    let triangles: Vec<_> = (0..9000).map(|_| reference::random(&mut rng, SIZE[0], SIZE[1])).collect();
    let world = world_of(&triangles);
    let display = Display { depth_test: false, ..plain() };
    let one = world.draw(&mut Renderer::new(Some(1)), &camera_at(0.0), &display, SIZE);
    for threads in [2, 3, 8] {
        assert!(one == world.draw(&mut Renderer::new(Some(threads)), &camera_at(0.0), &display, SIZE), "{threads} threads");
    }
    let last = triangles[triangles.len() - 1];
    for (found, expected) in one.iter().zip(reference::draw(&[last], SIZE[0], SIZE[1])) {
        if let Some([red, ..]) = expected {
            assert!((f64::from(found >> 16 & 255) - red).abs() <= 1.0, "the last triangle does not lie on top");
        }
    }
}

#[test]
fn sizes_from_nothing_to_wide() {
    let world = World::sphere(12, 7, [0.8, 0.5, 0.4]);
    let mut renderer = Renderer::new(Some(2));
    for size in [[0, 0], [0, 5], [1, 1], [1, 300], [300, 1], [33, 31], [16_384, 3], [3, 16_384]] {
        let pixels = world.draw(&mut renderer, &camera_at(3.0), &Display::default(), size);
        assert_eq!(pixels.len(), (size[0] * size[1]) as usize);
        assert!(pixels.iter().all(|p| p >> 24 == 255), "{size:?}");
    }
    // The largest picture would be a gigabyte: its uppermost rows, filled by a sphere that is close before the eye.
    let stride = 16_384 * 4;
    let mut top = vec![0u8; stride * 40];
    let camera = Camera { near: 0.001, ..camera_at(1.01) };
    for samples in [Samples::One, Samples::Four] {
        let display = Display { samples, background: Background::Transparent, grid: false, ..Display::default() };
        top.fill(0);
        draw_into(&mut renderer, &world.job(&camera, &display, [16_384, 16_384]), &mut top, stride);
        assert!(top.as_chunks::<4>().0.iter().all(|pixel| u32::from_ne_bytes(*pixel) >> 24 == 255), "{samples:?}");
    }
    let clamped = renderer.draw(&world.job(&camera_at(3.0), &plain(), [u32::MAX, 2])).expect("there is memory for the picture");
    assert_eq!((clamped.width, clamped.height), (16_384, 2));
}

#[test]
fn a_target_with_another_stride_or_too_small_gets_what_fits() {
    let world = World::sphere(12, 7, [0.8, 0.5, 0.4]);
    let mut renderer = Renderer::new(Some(2));
    let whole = world.draw(&mut renderer, &camera_at(3.0), &plain(), [40, 70]);
    let (stride, rows) = (40 * 4 + 13, 66);
    let mut bytes = vec![0xABu8; stride * rows - 20];
    draw_into(&mut renderer, &world.job(&camera_at(3.0), &plain(), [40, 70]), &mut bytes, stride);
    for (y, row) in bytes.chunks(stride).enumerate() {
        let (pixels, rest) = row.split_at(row.len().min(160) / 4 * 4);
        let expected: Vec<u8> = whole[y * 40..][..40].iter().flat_map(|p| p.to_ne_bytes()).collect();
        assert_eq!(pixels, &expected[..pixels.len()], "row {y}");
        assert!(rest.iter().all(|b| *b == 0xAB), "row {y} wrote beyond its end");
    }
    draw_into(&mut renderer, &world.job(&camera_at(3.0), &plain(), [40, 70]), &mut [], 160);
    draw_into(&mut renderer, &world.job(&camera_at(3.0), &plain(), [40, 70]), &mut [0; 7], 3);
}

#[test]
fn a_kept_ground_is_the_ground() {
    let (world, display, camera) = everything();
    let other = Camera { eye: camera.eye + Vec3::new(0.1, 0.3, 0.0), ..camera };
    let size = [211, 149];
    for samples in [Samples::One, Samples::Four] {
        let display = Display { samples, ..display.clone() };
        let bare = Display { grid: false, ..display.clone() };
        let anew = |camera: &Camera, display: &Display| world.draw(&mut Renderer::new(Some(1)), camera, display, size);
        let (here, there, gridless) = (anew(&camera, &display), anew(&other, &display), anew(&camera, &bare));
        assert!(here != there && here != gridless);
        let mut renderer = Renderer::new(Some(2));
        // The second picture is the one that is kept; a target that ends early must not leave holes in what later ones are made of.
        let mut short = vec![0; 211 * 4 * 40];
        draw_into(&mut renderer, &world.job(&camera, &display, [211, 149]), &mut short, 211 * 4);
        draw_into(&mut renderer, &world.job(&camera, &display, [211, 149]), &mut short, 211 * 4);
        for turn in 0..5 {
            assert!(world.draw(&mut renderer, &camera, &display, size) == here, "{samples:?}, turn {turn}");
            world.pick(&mut renderer, &camera, &display, [211, 149], 100.0, 70.0);
        }
        for turn in 0..4 {
            assert!(world.draw(&mut renderer, &other, &display, size) == there, "{samples:?}, turn {turn}");
            assert!(world.draw(&mut renderer, &camera, &bare, size) == gridless, "{samples:?}, turn {turn}");
        }
        // Only what stands on the ground changes.
        let mut emptied = World::default();
        emptied.frame.bounds = world.frame.bounds;
        let alone = emptied.draw(&mut Renderer::new(Some(1)), &camera, &display, size);
        for _ in 0..3 {
            world.draw(&mut renderer, &camera, &display, size);
        }
        assert!(emptied.draw(&mut renderer, &camera, &display, size) == alone);
    }
}

#[test]
fn a_kept_ground_does_not_outlive_a_change_of_samples() {
    let (world, camera, size) = (World::sphere(24, 13, [0.6, 0.7, 0.9]), camera_at(4.0), [200, 150]);
    let mut renderer = Renderer::new(Some(2));
    for samples in [Samples::One, Samples::Four, Samples::One] {
        let display = Display { samples, grid: true, ..Display::default() };
        let anew = world.draw(&mut Renderer::new(Some(1)), &camera, &display, size);
        for turn in 0..4 {
            assert!(world.draw(&mut renderer, &camera, &display, size) == anew, "{samples:?}, turn {turn}");
        }
    }
}

#[test]
fn a_ground_beyond_what_numbers_tell_apart_has_no_grid() {
    // A box far off that is not large for it: its lines would have numbers beyond any integer.
    let mut world = World::sphere(8, 5, [0.5; 3]);
    world.frame.bounds = Bounds { min: Vec3::splat(-3e30), max: Vec3::splat(-2.999_999e30) };
    for size in [1e-3, 1.0, 1e6] {
        let ground = Bounds { min: Vec3::new(1e30, 0.0, -1e30), max: Vec3::new(1e30, size, -1e30) };
        for ground in [None, Some(ground)] {
            let display = Display { ground, ..Display::default() };
            let without = Display { grid: false, ..display.clone() };
            let mut renderer = Renderer::new(Some(1));
            let found = world.draw(&mut renderer, &camera_at(3.0), &display, SIZE);
            assert!(found == world.draw(&mut renderer, &camera_at(3.0), &without, SIZE));
        }
    }
}

#[test]
fn lines_that_are_nearly_level_do_not_depend_on_the_vectors() {
    // Edge on, a grid is a bundle of lines that rise by a hair over the whole guard band.
    let mut world = World::default();
    world.frame.bounds = Bounds { min: Vec3::new(0.0, 0.0, 4.3e-19), max: Vec3::new(0.0, 2048.0, 1.1e-43) };
    for height in [2.5e-29, 1e-9, 1e-3, 0.5, 40.0] {
        for eye in [Vec3::new(-3e-13, 6e-41, 2.5625), Vec3::new(0.3, 1e-4, 2.5)] {
            let projection = Projection::Orthographic { height };
            let camera = Camera { eye, near: 0.0, far: 5.7e-42, projection, ..camera_at(0.0) };
            for samples in [Samples::One, Samples::Four] {
                let display = Display { samples, ..Display::default() };
                let mut pictures = Renderer::simd_names().into_iter().map(|simd| {
                    let mut renderer = Renderer::new(Some(1));
                    assert!(renderer.set_simd(simd));
                    (simd, world.draw(&mut renderer, &camera, &display, [170, 170]))
                });
                let (_, first) = pictures.next().expect("there is always the scalar one");
                pictures.for_each(|(simd, other)| assert!(first == other, "{simd}, {height} m, {samples:?}"));
            }
        }
    }
}

/// Coordinates that a file or a broken pose may bring.
fn coordinate() -> impl Strategy<Value = f32> {
    prop_oneof![
        6 => -3.0f32..3.0,
        1 => -1e4f32..1e4,
        1 => prop::sample::select(vec![
            0.0, -0.0, 1e30, -1e30, f32::MAX, f32::MIN, f32::INFINITY, f32::NEG_INFINITY, f32::NAN, 1e-40, f32::MIN_POSITIVE, 2.0
        ]),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn any_coordinates_are_drawn_alike_by_all_or_not_at_all(
        points in prop::collection::vec((coordinate(), coordinate(), coordinate()), 3..24),
        picks in prop::collection::vec((0u32..26, 0u32..26, 0u32..26), 1..16),
        ortho in any::<bool>(),
        four in any::<bool>(),
        opacity in prop::sample::select(vec![1.0f32, 0.5, f32::NAN]),
        shading in prop::sample::select(vec![Shading::Flat, Shading::Gouraud, Shading::Phong]),
    ) {
        let mut world = World::default();
        let texture = world.image(5, 3, |x, y| checker(x, y, 2, 5), WrapMode::Repeat);
        let diffuse = Paint { color: Vec3::ONE, texture: four.then_some(texture) };
        let material = world.material(Material { diffuse, opacity, ..Material::default() });
        let positions: Vec<Vec3> = points.iter().map(|&(x, y, z)| Vec3::new(x, y, z)).collect();
        let uv = positions.iter().map(|p| p.truncate()).collect();
        let triangles = picks.iter().map(|&(a, b, c)| [a, b, c]).collect();
        let mut mesh = soup(positions.clone(), triangles, uv);
        mesh.normals = positions;
        mesh.lines = vec![[0, 1], [1, 2], [2, 900]];
        let node = world.place(mesh, Mat4::IDENTITY, Some(material));
        let mut camera = camera_at(2.0);
        if ortho {
            camera.projection = Projection::Orthographic { height: 3.0 };
        }
        let samples = if four { Samples::Four } else { Samples::One };
        let highlight = Highlight { selected: Some(node), ..Highlight::default() };
        let display = Display { samples, shading, wireframe: true, normal_glyphs: true, bounding_box: true, highlight, ..Display::default() };
        let mut pictures = Vec::new();
        for (threads, simd) in [(1, "scalar"), (2, "sse2"), (3, "avx2"), (2, "avx512")] {
            let mut renderer = Renderer::new(Some(threads));
            if renderer.set_simd(simd) {
                pictures.push(world.draw(&mut renderer, &camera, &display, [50, 40]));
                world.pick(&mut renderer, &camera, &display, [50, 40], 25.0, 20.0);
            }
        }
        for other in &pictures[1..] {
            prop_assert!(pictures[0] == *other);
        }
    }

    #[test]
    fn any_camera_is_survived(
        eye in (coordinate(), coordinate(), coordinate()),
        planes in (coordinate(), coordinate()),
        opening in coordinate(),
        ortho in any::<bool>(),
    ) {
        let world = World::sphere(8, 5, [0.5; 3]);
        let projection = if ortho { Projection::Orthographic { height: opening } } else { Projection::Perspective { fov_y: opening } };
        let camera = Camera { eye: eye.into(), near: planes.0, far: planes.1, projection, ..camera_at(1.0) };
        let background = Background::Solid(0x112233);
        let pixels = world.draw(&mut Renderer::new(Some(1)), &camera, &Display { background, ..Display::default() }, [20, 15]);
        prop_assert_eq!(pixels.len(), 300);
        world.pick(&mut Renderer::new(Some(1)), &camera, &Display::default(), [20, 15], 10.0, 7.0);
    }
}

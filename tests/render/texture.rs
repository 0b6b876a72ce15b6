//! Textures that are seen smaller than they are, and that repeat.

use crate::render_support::models::soup;
use crate::render_support::{World, camera_at, pixel_camera, plain};
use glam::{Mat4, Quat, Vec2, Vec3};
use sinew::render::{Display, Renderer, Samples, Shading};
use sinew::scene::{Material, MaterialBinding, Paint, ShadingModel, TextureRef, WrapMode};

/// A colour from a texture alone, without light.
fn painted(world: &mut World, texture: TextureRef) -> MaterialBinding {
    let diffuse = Paint { color: Vec3::ONE, texture: Some(texture) };
    world.material(Material { model: ShadingModel::Constant, diffuse, ..Material::default() })
}

/// A rectangle from one corner to the opposite one, in the plane of x and y, with texture coordinates that run likewise.
fn rectangle([from, to]: [Vec2; 2], [first, last]: [Vec2; 2]) -> sinew::scene::Mesh {
    let between = |a: Vec2, b: Vec2| [Vec2::new(a.x, a.y), Vec2::new(b.x, a.y), Vec2::new(b.x, b.y), Vec2::new(a.x, b.y)];
    let positions = between(from, to).map(|p| p.extend(0.0)).to_vec();
    soup(positions, vec![[0, 1, 2], [0, 2, 3]], between(first, last).to_vec())
}

fn grey(pixel: u32) -> f64 {
    f64::from(pixel >> 8 & 255)
}

#[test]
fn a_fine_checker_becomes_the_grey_that_sends_out_its_light() {
    let size = [90, 70];
    for (side, repeats) in [(64u32, 2.0f32), (64, 3.0), (256, 1.0), (256, 40.0), (512, 0.4)] {
        let mut world = World::default();
        let checker = world.image(side, side, |x, y| if (x + y) % 2 == 0 { [255; 4] } else { [0, 0, 0, 255] }, WrapMode::Repeat);
        let paint = painted(&mut world, checker);
        let uv = [Vec2::ZERO, Vec2::new(repeats, repeats)];
        world.place(rectangle([Vec2::new(3.0, 2.0), Vec2::new(83.0, 66.0)], uv), Mat4::IDENTITY, Some(paint));
        for (shading, samples) in [(Shading::Gouraud, Samples::One), (Shading::Phong, Samples::Four)] {
            let found = world.draw(&mut Renderer::new(Some(1)), &pixel_camera(size), &Display { shading, samples, ..plain() }, size);
            for (x, y) in (4..82).flat_map(|x| (5..67).map(move |y| (x, y))) {
                let value = grey(found[(y * size[0] + x) as usize]);
                assert!((value - 188.0).abs() <= 1.0, "{side} × {repeats}, pixel ({x}, {y}): {value}");
            }
        }
    }
}

#[test]
fn no_texel_of_an_odd_side_is_left_out() {
    // One white column of three, of five, of seven: their light is shared by all.
    for side in [3u32, 5, 7, 13] {
        for white in 0..side {
            let mut world = World::default();
            let stripes = world.image(side, 1, |x, _| if x == white { [255; 4] } else { [0, 0, 0, 255] }, WrapMode::Repeat);
            let paint = painted(&mut world, stripes);
            let uv = [Vec2::ZERO, Vec2::new(400.0, 1.0)];
            world.place(rectangle([Vec2::ZERO, Vec2::new(40.0, 20.0)], uv), Mat4::IDENTITY, Some(paint));
            let found = world.draw(&mut Renderer::new(Some(1)), &pixel_camera([40, 20]), &plain(), [40, 20]);
            let expected = crate::render_support::reference::byte(1.0 / f64::from(side));
            assert!(
                (grey(found[10 * 40 + 20]) - expected).abs() <= 3.0,
                "{white} of {side}: {}, not {expected}",
                grey(found[10 * 40 + 20])
            );
        }
    }
}

#[test]
fn levels_pass_into_each_other_without_a_line() {
    // The same ground, each time a fiftieth farther off: contrast falls by and by until all is grey, and nowhere at once.
    let size = [160u32, 160];
    let mut contrasts = Vec::new();
    for step in 0..150 {
        let texels_a_pixel = 1.02f32.powi(step);
        let mut world = World::default();
        let checker = world.image(64, 64, |x, y| if (x / 8 + y / 8) % 2 == 0 { [230; 4] } else { [40, 60, 120, 255] }, WrapMode::Repeat);
        let paint = painted(&mut world, checker);
        let reach = 200.0 * texels_a_pixel / 64.0;
        let ground = rectangle([Vec2::splat(-200.0), Vec2::splat(200.0)], [Vec2::splat(-reach), Vec2::splat(reach)]);
        world.place(ground, Mat4::from_rotation_translation(Quat::from_rotation_z(0.3), Vec3::new(80.0, 80.0, 0.0)), Some(paint));
        let found = world.draw(&mut Renderer::new(Some(1)), &pixel_camera(size), &plain(), size);
        let red: Vec<f64> = found.iter().map(|pixel| f64::from(pixel >> 16 & 255)).collect();
        let mean = red.iter().sum::<f64>() / red.len() as f64;
        contrasts.push((red.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / red.len() as f64).sqrt());
    }
    let steepest = contrasts.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f64::max);
    assert!(contrasts[0] > 70.0 && contrasts[149] < 2.0, "{contrasts:?}");
    assert!(steepest < 8.0, "{steepest} at once: {contrasts:?}");
}

/// A picture with no symmetry and no step at its edges where it repeats.
fn waves(x: u32, y: u32) -> [u8; 4] {
    let wave = |t: f32| ((t * std::f32::consts::TAU / 16.0).sin() * 0.5 + 0.5) * 235.0 + 10.0;
    [wave(x as f32 + 1.3), wave(y as f32 + x as f32), wave(y as f32 * 3.0 - x as f32), 255.0].map(|c| c as u8)
}

/// Which texel of 16 stands at `at` of an endless row.
fn texel(wrap: WrapMode, at: u32) -> u32 {
    if wrap == WrapMode::Mirror && at / 16 % 2 == 1 { 15 - at % 16 } else { at % 16 }
}

#[test]
fn repeats_are_like_a_picture_that_holds_them_all() {
    let size = [150, 110];
    for wrap in [WrapMode::Repeat, WrapMode::Mirror] {
        let tiles = 4u32;
        let (mut small, mut large) = (World::default(), World::default());
        let one = small.image(16, 16, waves, wrap);
        // Row 0 of an image is its top, where v is 1: four tiles down from there.
        let row = |y: u32| 15 - texel(wrap, 16 * tiles - 1 - y);
        let all = large.image(16 * tiles, 16 * tiles, |x, y| waves(texel(wrap, x), row(y)), WrapMode::Repeat);
        let (one, all) = (painted(&mut small, one), painted(&mut large, all));
        for (first, turn) in [(0.0, 0.0), (0.0, 0.9), (-8.0, 0.4), (1000.0, 1.2), (-1000.0, -1.1)] {
            for scale in [0.05f32, 0.2, 0.9] {
                small.frame.surfaces.clear();
                large.frame.surfaces.clear();
                let matrix = Mat4::from_scale_rotation_translation(Vec3::splat(scale), Quat::from_rotation_y(turn), Vec3::ZERO);
                let square = [Vec2::splat(-1.0), Vec2::splat(1.0)];
                small.place(rectangle(square, [Vec2::splat(first), Vec2::splat(first + tiles as f32)]), matrix, Some(one.clone()));
                large.place(rectangle(square, [Vec2::ZERO, Vec2::ONE]), matrix, Some(all.clone()));
                let draw = |world: &World| world.draw(&mut Renderer::new(Some(1)), &camera_at(2.0), &plain(), size);
                let (found, expected) = (draw(&small), draw(&large));
                for (at, (found, expected)) in found.iter().zip(&expected).enumerate() {
                    let apart = found.to_be_bytes().iter().zip(expected.to_be_bytes()).map(|(a, b)| a.abs_diff(b)).max();
                    // A thousand and a fraction leaves a fraction of 14 bits.
                    let most = if first.abs() > 100.0 { 8 } else { 4 };
                    let place = (at % size[0] as usize, at / size[0] as usize);
                    assert!(apart <= Some(most), "{wrap:?} from {first}, {turn}, {scale}, {place:?}: {found:x}, not {expected:x}");
                }
            }
        }
    }
}

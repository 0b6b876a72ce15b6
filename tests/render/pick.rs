//! Picking finds what the picture shows.

use crate::render_support::models::{self, sphere, square};
use crate::render_support::{World, camera_at, plain};
use glam::{Mat4, Vec2, Vec3};
use sinew::render::{Display, Renderer};
use sinew::scene::{Material, OrbitCamera, Paint, ShadingModel};

const SIZE: [u32; 2] = [80, 60];

/// Each surface in its own flat colour, so that the picture itself says what is where.
fn coloured() -> World {
    let mut world = World::default();
    for k in 0..6u32 {
        let color = Paint::color((k + 1) as f32 / 8.0, 0.0, 0.0);
        let material = world.material(Material { model: ShadingModel::Constant, diffuse: color, ..Material::default() });
        let place = Mat4::from_translation(Vec3::new(k as f32 * 0.5 - 1.2, (k as f32 * 1.7).sin() * 0.6, (k as f32 * 2.3).cos()));
        let mesh = if k % 2 == 0 { sphere(12, 7) } else { square() };
        world.place(mesh, place * Mat4::from_rotation_y(k as f32) * Mat4::from_scale(Vec3::splat(0.7)), Some(material));
    }
    world
}

#[test]
fn every_pixel_picks_what_it_shows() {
    let world = coloured();
    let mut renderer = Renderer::new(Some(2));
    for (distance, cull) in [(4.0, false), (4.0, true), (1.2, false), (0.4, false)] {
        let camera = camera_at(distance);
        let display = Display { cull_back_faces: cull, ..plain() };
        let picture = world.draw(&mut renderer, &camera, &display, SIZE);
        for (i, pixel) in picture.iter().enumerate() {
            let (x, y) = ((i as u32 % SIZE[0]) as f32 + 0.5, (i as u32 / SIZE[0]) as f32 + 0.5);
            let pick = world.pick(&mut renderer, &camera, &display, SIZE, x, y);
            let shown = ((pixel >> 16 & 255) as f32 / 255.0 * 8.0).round() as u32;
            assert_eq!(pick.map_or(0, |pick| pick.node.0 + 1), shown, "at {distance}, pixel ({x}, {y})");
            let Some(pick) = pick else { continue };
            assert_eq!(pick.surface, Some(pick.node.0));
            // The point is on the pixel, and the weights say where in the triangle it is.
            let at = camera.project(pick.point, Vec2::new(SIZE[0] as f32, SIZE[1] as f32)).expect("in front of the eye");
            assert!((at.truncate() - Vec2::new(x, y)).abs().max_element() < 0.02, "{at} for ({x}, {y})");
            let surface = &world.frame.surfaces[pick.node.index()];
            let corners = surface.mesh.triangles[pick.triangle as usize].map(|v| surface.position(v));
            let point = corners[0] * pick.barycentric.x + corners[1] * pick.barycentric.y + corners[2] * pick.barycentric.z;
            assert!((point - pick.point).length() < 1e-4 && (pick.barycentric.element_sum() - 1.0).abs() < 1e-4);
        }
    }
}

#[test]
fn bones_are_picked_where_they_show() {
    let mut world = World::default();
    let joints = models::arm(&mut world, 0.0);
    let mut orbit = OrbitCamera::default();
    orbit.look_from(sinew::scene::ViewDirection::Front);
    orbit.fit(&world.frame.bounds, 4.0 / 3.0);
    let camera = orbit.camera();
    let mut renderer = Renderer::new(Some(1));
    let mut at = |display: &Display, point: Vec3| {
        let pixel = camera.project(point, Vec2::new(SIZE[0] as f32, SIZE[1] as f32)).expect("in front of the eye");
        world.pick(&mut renderer, &camera, display, SIZE, pixel.x, pixel.y).map(|pick| (pick.node, pick.surface))
    };
    let shown = Display { bones: true, ..Display::default() };
    assert_eq!(at(&shown, Vec3::new(0.4, 0.0, 0.0)), Some((joints[0], None)));
    assert_eq!(at(&shown, Vec3::new(1.4, 0.0, 0.0)), Some((joints[1], None)));
    assert_eq!(at(&shown, Vec3::new(2.0, 0.0, 0.0)), Some((joints[2], None)), "the last joint is a dot");
    let skin = world.frame.surfaces[0].node;
    for other in [Display { bones: false, ..shown.clone() }, Display { xray: false, ..shown.clone() }] {
        assert_eq!(at(&other, Vec3::new(0.4, 0.0, 0.0)), Some((skin, Some(0))));
    }
    assert_eq!(at(&Display { mesh: false, ..Display::default() }, Vec3::new(0.4, 0.0, 0.0)), None);
}

#[test]
fn outside_the_picture_there_is_nothing() {
    let world = coloured();
    let mut renderer = Renderer::new(Some(1));
    for (x, y) in [(-0.1, 5.0), (80.0, 5.0), (5.0, 60.0), (f32::NAN, 5.0), (5.0, f32::INFINITY)] {
        assert_eq!(world.pick(&mut renderer, &camera_at(3.0), &plain(), [80, 60], x, y), None);
    }
}

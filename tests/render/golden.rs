//! Golden pictures, one a feature; see `render_support::golden`.

use crate::render_support::golden::check;
use crate::render_support::models::{self, belly, checker, profile, sphere, square};
use crate::render_support::{World, camera_at};
use glam::{Mat4, Vec2, Vec3};
use sinew::render::{Background, Display, Highlight, OverlayPalette, Renderer, Samples, Shading, Theme};
use sinew::scene::{AlphaSource, Camera, Material, OrbitCamera, Paint, ShadingModel, TextureRef, ViewDirection, WrapMode};

const SIZE: [u32; 2] = [160, 120];

fn golden(name: &str, world: &World, camera: &Camera, display: &Display) {
    let pixels = world.draw(&mut Renderer::new(Some(2)), camera, display, SIZE);
    check(name, &pixels, SIZE[0]);
}

/// A camera that has all of the world in view.
fn fitted(world: &World, view: ViewDirection) -> Camera {
    let mut orbit = OrbitCamera::default();
    orbit.look_from(view);
    orbit.fit(&world.frame.bounds, 4.0 / 3.0);
    orbit.camera()
}

fn quiet() -> Display {
    Display { grid: false, ..Display::default() }
}

fn shiny(color: [f32; 3]) -> Material {
    let [r, g, b] = color;
    let (model, specular) = (ShadingModel::Phong, Paint::color(0.6, 0.6, 0.6));
    Material { diffuse: Paint::color(r, g, b), model, specular, shininess: 30.0, ..Material::default() }
}

#[test]
fn shading() {
    for (name, shading) in [("flat", Shading::Flat), ("gouraud", Shading::Gouraud), ("phong", Shading::Phong)] {
        let mut world = World::default();
        let material = world.material(shiny([0.8, 0.5, 0.4]));
        world.place(sphere(16, 9), Mat4::IDENTITY, Some(material));
        golden(&format!("shading-{name}"), &world, &fitted(&world, ViewDirection::Start), &Display { shading, ..quiet() });
        let faces = Display { shading, smooth_normals: false, ..quiet() };
        golden(&format!("shading-{name}-faces"), &world, &fitted(&world, ViewDirection::Start), &faces);
    }
}

#[test]
fn the_light_can_be_moved_and_seen() {
    let world = World::sphere(32, 17, [0.8, 0.5, 0.4]);
    let camera = camera_at(4.5);
    for (name, light) in [("right", Vec3::new(1.5, 0.3, 0.8)), ("behind", Vec3::new(-0.5, 0.6, -3.0))] {
        let display = Display { light: Some(light), light_marker: true, ..quiet() };
        golden(&format!("light-{name}"), &world, &camera, &display);
    }
}

#[test]
fn inside_of_an_open_surface_is_lit() {
    let mut world = World::default();
    world.place(belly(21, 24, |v| 0.35 + 0.35 * v), Mat4::IDENTITY, None);
    let camera = fitted(&world, ViewDirection::Top);
    golden("two-sided", &world, &camera, &quiet());
    golden("back-faces-left-out", &world, &fitted(&world, ViewDirection::Iso), &Display { cull_back_faces: true, ..quiet() });
}

#[test]
fn textures_wrap_four_ways() {
    for wrap in [WrapMode::Repeat, WrapMode::Mirror, WrapMode::Clamp, WrapMode::Border] {
        let mut world = World::default();
        let texture = world.image(8, 8, |x, y| checker(x, y, 4, 8), wrap);
        let material = world.material(Material { diffuse: Paint { color: Vec3::ONE, texture: Some(texture) }, ..Material::default() });
        let mut mesh = square();
        // From −0.5 to 1.5 of the image: its own square in the middle, (0, 0) at the bottom left.
        mesh.uv_sets[0].iter_mut().for_each(|uv| *uv = *uv * 2.0 - Vec2::splat(0.5));
        world.place(mesh, Mat4::IDENTITY, Some(material));
        golden(&format!("wrap-{wrap:?}").to_lowercase(), &world, &camera_at(2.6), &quiet());
    }
}

#[test]
fn textures_lie_in_perspective_and_get_coarser_with_distance() {
    let mut world = World::default();
    let texture = world.image(128, 128, |x, y| checker(x, y, 16, 128), WrapMode::Repeat);
    let material = world.material(Material { diffuse: Paint { color: Vec3::ONE, texture: Some(texture) }, ..Material::default() });
    let mut mesh = square();
    mesh.uv_sets[0].iter_mut().for_each(|uv| *uv *= 6.0);
    let floor = Mat4::from_translation(Vec3::new(0.0, -0.6, -6.0))
        * Mat4::from_rotation_x(-std::f32::consts::FRAC_PI_2)
        * Mat4::from_scale(Vec3::splat(8.0));
    world.place(mesh, floor, Some(material));
    for (name, shading) in [("gouraud", Shading::Gouraud), ("phong", Shading::Phong)] {
        golden(&format!("floor-{name}"), &world, &camera_at(1.0), &Display { shading, ..quiet() });
    }
}

#[test]
fn opacity_from_a_texture_cuts_holes() {
    for source in [AlphaSource::Alpha, AlphaSource::InverseAlpha, AlphaSource::Luminance, AlphaSource::InverseLuminance] {
        let mut world = World::default();
        let ring = |x: u32, y: u32| {
            let d = ((x as f32 - 15.5).powi(2) + (y as f32 - 15.5).powi(2)).sqrt();
            let on = if (6.0..13.0).contains(&d) { 255 } else { 0 };
            [on, on, on, on]
        };
        let texture: TextureRef = world.image(32, 32, ring, WrapMode::Clamp);
        let material = world.material(Material { opacity_texture: Some((texture, source)), ..Material::default() });
        world.place(square(), Mat4::IDENTITY, Some(material));
        golden(&format!("cutout-{source:?}").to_lowercase(), &world, &camera_at(2.8), &quiet());
    }
}

#[test]
fn glass_shows_what_is_behind() {
    let mut world = World::default();
    for (k, (color, opacity)) in [([0.9, 0.3, 0.2], 1.0), ([0.3, 0.8, 0.3], 0.5), ([0.3, 0.4, 0.9], 0.35)].into_iter().enumerate() {
        let material = world.material(Material { opacity, ..shiny(color) });
        world.place(sphere(32, 17), Mat4::from_translation(Vec3::new(k as f32 * 0.8 - 0.8, 0.0, k as f32 * 0.6)), Some(material));
    }
    golden("glass", &world, &fitted(&world, ViewDirection::Front), &quiet());
    golden("glass-transparent", &world, &fitted(&world, ViewDirection::Front), &Display { background: Background::Transparent, ..quiet() });
}

#[test]
fn vertices_bring_colours() {
    let mut world = World::default();
    let mut mesh = sphere(32, 17);
    mesh.colors = mesh.positions.iter().map(|p| (*p * 0.5 + Vec3::splat(0.5)).extend(1.0)).collect();
    let white = world.material(Material { diffuse: Paint::color(1.0, 1.0, 1.0), ..Material::default() });
    world.place(mesh, Mat4::IDENTITY, Some(white));
    for (name, shading) in [("gouraud", Shading::Gouraud), ("phong", Shading::Phong)] {
        golden(&format!("colours-{name}"), &world, &fitted(&world, ViewDirection::Start), &Display { shading, ..quiet() });
    }
    golden("no-materials", &world, &fitted(&world, ViewDirection::Start), &Display { materials: false, ..quiet() });
}

#[test]
fn emission_glows() {
    let mut world = World::default();
    let glow = world.image(16, 16, |x, _| if x / 2 % 2 == 0 { [255, 200, 60, 255] } else { [0, 0, 0, 255] }, WrapMode::Repeat);
    let emission = Paint { color: Vec3::ONE, texture: Some(glow) };
    let material = world.material(Material { diffuse: Paint::color(0.2, 0.2, 0.3), emission, ..Material::default() });
    world.place(sphere(32, 17), Mat4::IDENTITY, Some(material));
    golden("emission", &world, &fitted(&world, ViewDirection::Start), &quiet());
}

#[test]
fn muscles_have_fibres() {
    let mut world = World::default();
    let node = world.place_muscle(belly(41, 36, profile), Mat4::from_rotation_z(1.2), None);
    let camera = fitted(&world, ViewDirection::Front);
    golden("muscle", &world, &camera, &quiet());
    golden("muscle-phong", &world, &camera, &Display { shading: Shading::Phong, ..quiet() });
    golden("muscle-flat", &world, &camera, &Display { shading: Shading::Flat, ..quiet() });
    golden(
        "muscle-selected",
        &world,
        &camera,
        &Display { highlight: Highlight { selected: Some(node), ..Highlight::default() }, ..quiet() },
    );
    golden("muscle-hovered", &world, &camera, &Display { highlight: Highlight { hovered: Some(node), ..Highlight::default() }, ..quiet() });
    golden("muscle-off", &world, &camera, &Display { muscle: false, ..quiet() });
}

#[test]
fn bones() {
    let mut world = World::default();
    let joints = models::arm(&mut world, 50.0);
    let camera = fitted(&world, ViewDirection::Start);
    let base = Display { bones: true, ..quiet() };
    golden("bones", &world, &camera, &base);
    golden("bones-no-xray", &world, &camera, &Display { xray: false, ..base.clone() });
    golden("bones-alone", &world, &camera, &Display { mesh: false, ..base.clone() });
    golden(
        "bones-selected",
        &world,
        &camera,
        &Display { highlight: Highlight { selected: Some(joints[1]), hovered: Some(joints[0]), weights: None }, ..base.clone() },
    );
    golden("bones-axes", &world, &camera, &Display { bone_axes: true, ..base.clone() });
    let highlight = Highlight { weights: Some(joints[1]), ..Highlight::default() };
    golden("weights", &world, &camera, &Display { highlight, ..base.clone() });
    golden("weights-phong", &world, &camera, &Display { highlight, shading: Shading::Phong, bones: false, ..base });
}

#[test]
fn helpers() {
    let mut world = World::default();
    models::arm(&mut world, 50.0);
    let camera = fitted(&world, ViewDirection::Start);
    golden("grid", &world, &camera, &Display::default());
    golden("axes", &world, &camera, &Display { axes: true, bounding_box: true, ..quiet() });
    golden("wireframe", &world, &camera, &Display { wireframe: true, ..quiet() });
    golden("wireframe-one-sample", &world, &camera, &Display { wireframe: true, samples: Samples::One, ..quiet() });
    golden("normals", &world, &camera, &Display { normal_glyphs: true, ..quiet() });
    golden("scale", &world, &camera, &Display { scale: 2.0, bones: true, bounding_box: true, ..quiet() });
    let palette = OverlayPalette::of(Theme::Light);
    let background = Background::Gradient(palette.background.0, palette.background.1);
    golden(
        "light-theme",
        &world,
        &camera,
        &Display {
            palette,
            background,
            bones: true,
            highlight: Highlight { selected: Some(sinew::scene::NodeId(3)), ..Highlight::default() },
            ..Display::default()
        },
    );
}

#[test]
fn depth_test_off_lets_later_triangles_win() {
    let mut world = World::default();
    for (z, color) in [(0.5, [0.9, 0.3, 0.2]), (-0.5, [0.2, 0.4, 0.9])] {
        let material = world.material(Material { diffuse: Paint::color(color[0], color[1], color[2]), ..Material::default() });
        let tilt = Mat4::from_translation(Vec3::new(0.4 * z, 0.3 * z, z)) * Mat4::from_rotation_y(z);
        world.place(square(), tilt, Some(material));
    }
    golden("depth-test", &world, &camera_at(4.0), &quiet());
    golden("depth-test-off", &world, &camera_at(4.0), &Display { depth_test: false, ..quiet() });
}

#[test]
fn parallel_rays() {
    let world = World::sphere(32, 17, [0.6, 0.7, 0.4]);
    let mut orbit = OrbitCamera { orthographic: true, ..OrbitCamera::default() };
    orbit.fit(&world.frame.bounds, 4.0 / 3.0);
    golden("orthographic", &world, &orbit.camera(), &Display { bounding_box: true, ..Display::default() });
}

#[test]
fn from_the_inside_the_near_plane_cuts() {
    let world = World::sphere(32, 17, [0.6, 0.5, 0.4]);
    golden("inside", &world, &camera_at(0.95), &quiet());
}

#[test]
fn nothing_is_white_or_black() {
    // A white shiny thing and a muscle in the default light: bright, but never clipped; dark, but never black.
    let mut world = World::default();
    let white = world.material(Material { diffuse: Paint::color(0.95, 0.95, 0.95), ..shiny([1.0; 3]) });
    world.place(sphere(48, 25), Mat4::IDENTITY, Some(white));
    let display = Display { background: Background::Transparent, samples: Samples::One, ..quiet() };
    let pixels = world.draw(&mut Renderer::new(Some(1)), &fitted(&world, ViewDirection::Start), &display, SIZE);
    let surface: Vec<u32> = pixels.into_iter().filter(|p| p >> 24 == 255).collect();
    assert!(surface.len() > 3000, "{}", surface.len());
    let lightest = surface.iter().map(|p| p & 255).max();
    let darkest = surface.iter().map(|p| p & 255).min();
    assert!(lightest < Some(255) && lightest > Some(225), "{lightest:?}");
    assert!(darkest > Some(35), "{darkest:?}");
}

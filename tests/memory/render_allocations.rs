//! A frame allocates nothing after the first ones.

use crate::counting::allocations;
use crate::render_support::World;
use crate::render_support::models::{self, belly, profile, sphere};
use glam::{Mat4, Vec3};
use sinew::render::{Display, Highlight, Renderer, Samples, Shading};
use sinew::scene::{Material, OrbitCamera};

pub(crate) fn frames_after_the_first_allocate_nothing() {
    let mut world = World::default();
    let glass = world.material(Material { opacity: 0.5, ..Material::default() });
    world.place(sphere(60, 31), Mat4::IDENTITY, Some(glass));
    world.place(sphere(100, 51), Mat4::from_translation(Vec3::X), None);
    world.place_muscle(belly(21, 36, profile), Mat4::from_translation(Vec3::Y), None);
    let joints = models::arm(&mut world, 30.0);
    let mut orbit = OrbitCamera::default();
    orbit.fit(&world.frame.bounds, 1.5);
    let camera = orbit.camera();
    let mut renderer = Renderer::new(Some(2));
    for shading in [Shading::Flat, Shading::Gouraud, Shading::Phong] {
        let base = Display { shading, bones: true, bone_axes: true, wireframe: true, ..Display::default() };
        for display in [
            base.clone(),
            Display {
                samples: Samples::One,
                highlight: Highlight { weights: Some(joints[1]), selected: Some(joints[1]), hovered: None },
                ..base.clone()
            },
            Display {
                highlight: Highlight { selected: Some(world.frame.surfaces[0].node), ..Highlight::default() },
                normal_glyphs: true,
                bounding_box: true,
                axes: true,
                ..base
            },
        ] {
            // The second frame like the first may keep the ground.
            for _ in 0..2 {
                renderer.draw(&world.job(&camera, &display, [300, 200])).expect("there is memory for the picture");
            }
            let before = allocations();
            for _ in 0..5 {
                renderer.draw(&world.job(&camera, &display, [300, 200])).expect("there is memory for the picture");
            }
            assert_eq!(allocations() - before, 0, "{shading:?}");
        }
    }
}

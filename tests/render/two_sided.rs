//! Faces that lie on each other with opposite windings: the one that faces the viewer is seen, from every side.

use crate::render_support::models::soup;
use crate::render_support::rng::Rng;
use crate::render_support::{World, plain};
use glam::{EulerRot, Mat4, Quat, Vec3};
use sinew::render::{Display, Renderer, Samples, Shading};
use sinew::scene::{Camera, Material, MaterialBinding, Mesh, OrbitCamera, Paint, Part, Projection, ShadingModel, SurfaceGeometry};

const SIZE: [u32; 2] = [120, 90];
const OUTSIDE: [[u32; 4]; 6] = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];

/// The sides of a box, turned outward or inward, cut along one of their diagonals.
fn sides(inward: bool, other: bool) -> Vec<[u32; 3]> {
    let cut = |[a, b, c, d]: [u32; 4]| if other { [[b, c, d], [b, d, a]] } else { [[a, b, c], [a, c, d]] };
    let turn = |[a, b, c]: [u32; 3]| if inward { [c, b, a] } else { [a, b, c] };
    OUTSIDE.into_iter().flat_map(cut).map(turn).collect()
}

/// A box that is not square, with corners in no even numbers.
fn corners() -> Vec<Vec3> {
    let corner = |i: u32| Vec3::new([-0.913, 1.07][i as usize & 1], [-0.77, 0.831][i as usize >> 1 & 1], [-1.21, 0.973][i as usize >> 2]);
    (0..8).map(corner).collect()
}

fn color(world: &mut World, color: [f32; 3], opacity: f32) -> MaterialBinding {
    let diffuse = Paint::color(color[0], color[1], color[2]);
    world.material(Material { model: ShadingModel::Constant, diffuse, opacity, ..Material::default() })
}

/// How a box is put together.
#[derive(Debug, Clone, Copy)]
struct Make {
    /// The inner faces come first.
    inner_first: bool,
    /// They are cut along the other diagonals.
    other: bool,
    /// They are a surface of their own.
    apart: bool,
    mirrored: bool,
    deformed: bool,
    opacity: f32,
}

const PLAIN: Make = Make { inner_first: true, other: true, apart: false, mirrored: false, deformed: false, opacity: 1.0 };

/// A box that is red outside and blue inside, or red alone.
fn world_of(make: Make, two_sided: bool) -> World {
    let mut world = World::default();
    let (red, blue) = (color(&mut world, [1.0, 0.0, 0.0], make.opacity), color(&mut world, [0.0, 0.0, 1.0], make.opacity));
    let (out, within) = (sides(false, false), sides(true, make.other));
    let scale = if make.mirrored { Vec3::new(-1.0, 1.0, 1.0) } else { Vec3::ONE };
    let matrix = Mat4::from_scale_rotation_translation(scale, Quat::from_euler(EulerRot::XYZ, 0.3, 0.7, 0.2), Vec3::new(3.0, -2.0, 0.7));
    let lists = match (two_sided, make.inner_first) {
        (false, _) => vec![(out, red)],
        (true, false) => vec![(out, red), (within, blue)],
        (true, true) => vec![(within, blue), (out, red)],
    };
    let lists: Vec<Vec<(Vec<[u32; 3]>, MaterialBinding)>> =
        if make.apart { lists.into_iter().map(|list| vec![list]).collect() } else { vec![lists] };
    for lists in lists {
        let mut mesh = soup(corners(), lists.iter().flat_map(|(triangles, _)| triangles.clone()).collect(), Vec::new());
        mesh.parts = (0..lists.len() as u32).map(|k| Part { triangles: k * 12..k * 12 + 12, ..Part::default() }).collect();
        place(&mut world, mesh, lists.into_iter().map(|(_, color)| color).collect(), matrix, make);
    }
    world
}

fn place(world: &mut World, mesh: Mesh, colors: Vec<MaterialBinding>, matrix: Mat4, make: Make) {
    let positions: Vec<Vec3> = mesh.positions.iter().map(|p| matrix.transform_point3(*p)).collect();
    let normals = mesh.normals.clone();
    world.place(mesh, matrix, None);
    let surface = world.frame.surfaces.last_mut().expect("it was just placed");
    surface.materials = colors.into_iter().map(Some).collect();
    surface.mirrored = make.mirrored;
    if make.deformed {
        surface.geometry = SurfaceGeometry::Deformed { positions, normals };
    }
}

fn views(world: &World, count: usize, seed: u64) -> Vec<Camera> {
    let mut rng = Rng(seed);
    let bounds = world.bounds();
    (0..count)
        .map(|k| {
            let mut orbit = OrbitCamera::default();
            orbit.fit(&bounds, 4.0 / 3.0);
            let mut camera = orbit.camera();
            let turn = Quat::from_euler(EulerRot::YXZ, k as f32 / count as f32 * 6.3, rng.between(-1.5, 1.5) as f32, 0.0);
            let distance = [3.5, 5.0, 40.0][k % 3];
            (camera.rotation, camera.eye) = (turn, bounds.center() + turn * Vec3::Z * distance);
            camera.near = 0.01;
            if k % 4 == 3 {
                camera.projection = Projection::Orthographic { height: 4.0 };
            }
            camera
        })
        .collect()
}

fn drawn(world: &World, renderer: &mut Renderer, camera: &Camera, display: &Display) -> Vec<u32> {
    world.draw(renderer, camera, display, SIZE)
}

#[test]
fn the_outside_is_red_from_every_view_however_it_is_made() {
    for (inner_first, other) in [(true, true), (true, false), (false, true), (false, false)] {
        for (apart, mirrored, deformed) in
            [(false, false, false), (true, false, false), (true, true, false), (false, true, true), (true, false, true)]
        {
            let make = Make { inner_first, other, apart, mirrored, deformed, ..PLAIN };
            let (both, red) = (world_of(make, true), world_of(make, false));
            for (k, camera) in views(&both, 24, 5).iter().enumerate() {
                let samples = if k % 2 == 0 { Samples::One } else { Samples::Four };
                let display = Display { samples, ..plain() };
                let mut renderer = Renderer::new(Some(1));
                let (found, expected) = (drawn(&both, &mut renderer, camera, &display), drawn(&red, &mut renderer, camera, &display));
                let wrong = found.iter().zip(&expected).filter(|(a, b)| a != b).count();
                assert_eq!(wrong, 0, "{make:?}, view {k}, {samples:?}");
            }
        }
    }
}

#[test]
fn the_inside_is_blue_from_every_view() {
    for make in [PLAIN, Make { apart: true, ..PLAIN }, Make { mirrored: true, inner_first: false, ..PLAIN }] {
        let both = world_of(make, true);
        for camera in views(&both, 12, 9) {
            let camera = Camera { eye: both.bounds().center(), projection: Projection::Perspective { fov_y: 1.2 }, ..camera };
            for (samples, shading) in [(Samples::One, Shading::Gouraud), (Samples::Four, Shading::Phong)] {
                let found = drawn(&both, &mut Renderer::new(Some(1)), &camera, &Display { samples, shading, ..plain() });
                let wrong = found.iter().position(|pixel| *pixel != 0xFF00_00FF);
                assert_eq!(wrong.map(|at| (at, found[at])), None, "{make:?}, {samples:?}, {camera:?}");
            }
        }
    }
}

#[test]
fn culling_glass_threads_and_vectors_change_nothing_of_it() {
    for make in
        [PLAIN, Make { apart: true, ..PLAIN }, Make { opacity: 0.5, ..PLAIN }, Make { opacity: 0.5, mirrored: true, other: false, ..PLAIN }]
    {
        let both = world_of(make, true);
        for (k, camera) in views(&both, 8, 3).iter().enumerate() {
            for samples in [Samples::One, Samples::Four] {
                let display = Display { samples, ..plain() };
                let first = drawn(&both, &mut Renderer::new(Some(1)), camera, &display);
                for (simd, threads) in Renderer::simd_names().into_iter().zip([2, 3, 1, 2]) {
                    let mut renderer = Renderer::new(Some(threads));
                    assert!(renderer.set_simd(simd));
                    let same = drawn(&both, &mut renderer, camera, &display) == first;
                    assert!(same, "{make:?}, view {k}, {samples:?}, {simd}");
                    let culled = Display { cull_back_faces: true, ..display.clone() };
                    assert!(drawn(&both, &mut renderer, camera, &culled) == first, "{make:?}, view {k}, {samples:?}, culled");
                }
                if make.opacity < 1.0 && samples == Samples::One {
                    // The near wall from outside and the far wall from inside, each once; triangles are sorted whole, so either may come first.
                    let walls = [0xFF80_0040, 0xFF40_0080];
                    let right = |pixel: &u32| *pixel == 0xFF00_0000 || walls.iter().any(|known| close(*pixel, *known));
                    assert_eq!(first.iter().find(|pixel| !right(pixel)), None, "{make:?}, view {k}");
                    assert!(first.iter().any(|pixel| close(*pixel, walls[0])));
                }
            }
        }
    }
}

fn close(a: u32, b: u32) -> bool {
    a.to_be_bytes().iter().zip(b.to_be_bytes()).all(|(a, b)| a.abs_diff(b) <= 1)
}

#[test]
fn a_sheet_with_two_sides_shows_the_right_one_and_what_is_picked_is_what_is_seen() {
    let mut rng = Rng(31);
    for round in 0..30 {
        // A quadrilateral, cut along either diagonal, as one mesh and as two.
        let mut world = World::default();
        let (red, blue) = (color(&mut world, [1.0, 0.0, 0.0], 1.0), color(&mut world, [0.0, 0.0, 1.0], 1.0));
        let quad: Vec<Vec3> = [[-1.0, -1.0], [1.2, -0.9], [1.0, 0.8], [-0.8, 1.1]].iter().map(|[x, y]| Vec3::new(*x, *y, 0.0)).collect();
        let back = if round % 2 == 0 { [[1, 0, 3], [1, 3, 2]] } else { [[0, 2, 1], [0, 3, 2]] };
        let turn =
            Quat::from_euler(EulerRot::XYZ, rng.between(-1.4, 1.4) as f32, rng.between(-1.4, 1.4) as f32, rng.between(0.0, 6.0) as f32);
        let matrix = Mat4::from_quat(turn);
        for (triangles, color) in [(vec![[0, 1, 2], [0, 2, 3]], red), (back.to_vec(), blue)] {
            let mesh = soup(quad.clone(), triangles, Vec::new());
            world.place(mesh, matrix, Some(color));
        }
        for side in [1.0, -1.0] {
            let camera = Camera {
                eye: Vec3::Z * 4.0 * side,
                rotation: if side > 0.0 { Quat::IDENTITY } else { Quat::from_rotation_y(std::f32::consts::PI) },
                ..crate::render_support::camera_at(4.0)
            };
            let facing = (turn * Vec3::Z).dot(camera.eye) > 0.0;
            let mut renderer = Renderer::new(Some(1));
            for samples in [Samples::One, Samples::Four] {
                let display = Display { samples, ..plain() };
                let found = drawn(&world, &mut renderer, &camera, &display);
                let (right, wrong) = if facing { (16, 0) } else { (0, 16) };
                assert!(found.iter().all(|pixel| pixel >> wrong & 255 == 0), "round {round}, {side}, {samples:?}");
                let lit: Vec<usize> = (0..found.len()).filter(|at| found[*at] >> right & 255 == 255).collect();
                assert!(!lit.is_empty());
                for at in lit.iter().step_by(97) {
                    let (x, y) = (*at as f32 % SIZE[0] as f32 + 0.5, (*at as u32 / SIZE[0]) as f32 + 0.5);
                    if let Some(pick) = world.pick(&mut renderer, &camera, &display, SIZE, x, y) {
                        assert_eq!(pick.surface, Some(u32::from(!facing)), "round {round}, {side}");
                    }
                }
            }
        }
    }
}

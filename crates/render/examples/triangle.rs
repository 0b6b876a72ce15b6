//! Draws one triangle, shows the picture as letters, and asks what lies under its middle.

use std::sync::Arc;

use glam::{Mat4, Quat, Vec3};
use sinew_render::{Background, Display, Framebuffer, PickHit, PickJob, RenderError, RenderJob, Renderer, Samples};
use sinew_scene::{Bounds, Camera, Frame, Mesh, Node, Part, Projection, Scene, Surface, SurfaceGeometry};

/// Columns and rows of the picture.
pub(crate) const SIZE: [u32; 2] = [36, 18];

/// A triangle in the plane z = 0, posed.
fn posed() -> (Scene, Frame) {
    let mut scene = Scene::default();
    let node = scene.graph.add(None, Node::new("triangle"));
    let positions = vec![Vec3::new(-1.0, -1.0, 0.0), Vec3::new(1.0, -1.0, 0.0), Vec3::new(0.0, 1.0, 0.0)];
    let bounds = Bounds::of(positions.iter().copied());
    let mesh = Mesh {
        normals: vec![Vec3::Z; 3],
        positions,
        triangles: vec![[0, 1, 2]],
        parts: vec![Part { symbol: String::new(), triangles: 0..1, lines: 0..0 }],
        ..Mesh::default()
    };
    let surface = Surface {
        node,
        mesh: Arc::new(mesh),
        materials: Arc::new([None]),
        geometry: SurfaceGeometry::Rigid(Mat4::IDENTITY),
        mirrored: false,
        muscle: None,
        solid: None,
        fibers: Arc::default(),
        visible: true,
        content: 0,
        skin: false,
        coordinates: Vec::new(),
        ghost: None,
    };
    (scene, Frame { surfaces: vec![surface], bounds, ..Frame::default() })
}

/// The picture, and what lies under its middle.
pub(crate) fn draw_and_pick() -> Result<(Framebuffer, Option<PickHit>), RenderError> {
    let (scene, frame) = posed();
    let camera =
        Camera { eye: Vec3::Z * 3.0, rotation: Quat::IDENTITY, projection: Projection::Orthographic { height: 2.4 }, near: 0.1, far: 10.0 };
    let display = Display { background: Background::Transparent, samples: Samples::One, grid: false, ..Display::default() };
    let job = RenderJob { scene: &scene, frame: &frame, camera: &camera, display: &display, width: SIZE[0], height: SIZE[1] };
    // Kept for the next picture, a renderer allocates nothing more.
    let mut renderer = Renderer::new(Some(1));
    let picture = renderer.draw(&job)?.clone();
    let hit = renderer.pick(&PickJob { picture: job, x: SIZE[0] as f32 / 2.0, y: SIZE[1] as f32 / 2.0 })?;
    Ok((picture, hit))
}

fn main() -> Result<(), RenderError> {
    let (picture, hit) = draw_and_pick()?;
    for row in picture.pixels.chunks(SIZE[0] as usize) {
        println!("{}", row.iter().map(|pixel| if *pixel == 0 { '.' } else { '#' }).collect::<String>());
    }
    println!("in the middle: {hit:?}");
    Ok(())
}

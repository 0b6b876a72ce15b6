//! Any coordinates, corners, materials and cameras are drawn or left out, by every instruction set alike, and can be picked.
#![no_main]

use std::sync::Arc;

use glam::{Mat4, Quat, Vec2, Vec3, Vec4};
use libfuzzer_sys::fuzz_target;
use sinew::render::{Display, Highlight, PickJob, RenderJob, Renderer, Samples, Shading};
use sinew::scene::{Bounds, Camera, Frame, Material, MaterialBinding, MaterialId, Mesh, Node, Part, SurfaceGeometry, Projection, Scene, Surface};

/// Numbers out of the input, one after the other; zeros when it is used up.
struct Source<'a>(&'a [u8]);

impl Source<'_> {
    fn byte(&mut self) -> u8 {
        let Some((first, rest)) = self.0.split_first() else { return 0 };
        self.0 = rest;
        *first
    }

    fn word(&mut self) -> u32 {
        u32::from_le_bytes(std::array::from_fn(|_| self.byte()))
    }

    /// Any float at all, or one of the picture's own size, as its first byte says.
    fn float(&mut self) -> f32 {
        if self.byte() & 1 == 0 { f32::from_bits(self.word()) } else { f32::from(i16::from_le_bytes([self.byte(), self.byte()])) / 8192.0 }
    }

    fn point(&mut self) -> Vec3 {
        Vec3::new(self.float(), self.float(), self.float())
    }
}

fuzz_target!(|bytes: &[u8]| {
    let mut from = Source(bytes);
    let flags = from.word();
    let on = |bit: u32| flags >> bit & 1 == 1;
    let mut mesh = Mesh::default();
    for _ in 0..from.byte() % 48 {
        mesh.positions.push(from.point());
        mesh.normals.push(from.point());
        mesh.colors.push(from.point().extend(from.float()));
    }
    let count = mesh.positions.len() as u32;
    // Two corners more than there are.
    let corner = |from: &mut Source<'_>| u32::from(from.byte()) % (count + 2);
    for _ in 0..from.byte() % 48 {
        mesh.triangles.push(std::array::from_fn(|_| corner(&mut from)));
    }
    for _ in 0..from.byte() % 8 {
        mesh.lines.push(std::array::from_fn(|_| corner(&mut from)));
    }
    mesh.source_count = count;
    mesh.source_vertex = (0..count).collect();
    mesh.uv_sets = vec![mesh.positions.iter().map(|p| Vec2::new(p.x, p.y)).collect()];
    mesh.parts = vec![Part { symbol: String::new(), triangles: 0..mesh.triangles.len() as u32, lines: 0..mesh.lines.len() as u32 }];
    let mut scene = Scene::default();
    let node = scene.graph.add(None, Node::new("any"));
    let material = Material { opacity: from.float(), double_sided: on(0), ..Material::default() };
    let geometry = if on(1) {
        let columns = std::array::from_fn(|_| Vec4::new(from.float(), from.float(), from.float(), from.float()));
        let [a, b, c, d] = columns;
        SurfaceGeometry::Rigid(Mat4::from_cols(a, b, c, d))
    } else {
        SurfaceGeometry::Rigid(Mat4::IDENTITY)
    };
    let bounds = Bounds { min: from.point(), max: from.point() };
    let surface = Surface {
        node,
        mesh: Arc::new(mesh),
        materials: vec![Some(MaterialBinding::plain(MaterialId(0)))].into(),
        geometry,
        mirrored: on(2),
        solid: on(17).then_some(bounds),
        muscle: None,
        fibers: Arc::default(),
        ghost: None,
        visible: true,
        content: 0,
        skin: false,
    };
    scene.materials.push(material.clone());
    let frame = Frame { surfaces: vec![surface], materials: vec![material], bounds, ..Frame::default() };
    let projection =
        if on(3) { Projection::Orthographic { height: from.float() } } else { Projection::Perspective { fov_y: from.float() } };
    let camera = Camera { eye: from.point(), rotation: Quat::IDENTITY, projection, near: from.float(), far: from.float() };
    let display = Display {
        shading: [Shading::Flat, Shading::Gouraud, Shading::Phong][(flags >> 4) as usize % 3],
        samples: if on(8) { Samples::Four } else { Samples::One },
        wireframe: on(9),
        normal_glyphs: on(10),
        bounding_box: on(11),
        axes: on(12),
        smooth_normals: on(13),
        depth_test: on(14),
        cull_back_faces: on(15),
        highlight: Highlight { selected: on(16).then_some(node), ..Highlight::default() },
        ..Display::default()
    };
    let (width, height) = (u32::from(from.byte()), u32::from(from.byte()));
    let mut first: Option<Vec<u32>> = None;
    for name in Renderer::simd_names() {
        let mut renderer = Renderer::new(Some(1));
        renderer.set_simd(name);
        let job = RenderJob { scene: &scene, frame: &frame, camera: &camera, display: &display, width, height };
        let picture = renderer.draw(&job).expect("there is memory for the picture").pixels.clone();
        assert!(*first.get_or_insert_with(|| picture.clone()) == picture, "{name} differs");
        let pick = PickJob { picture: job, x: width as f32 / 2.0, y: height as f32 / 2.0 };
        renderer.pick(&pick).expect("there is memory for picking");
    }
});

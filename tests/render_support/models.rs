//! Meshes made from formulas.

use std::sync::Arc;

use glam::{Mat4, Vec2, Vec3};
use sinew::scene::{
    Bounds, Image, ImageId, Material, MaterialBinding, MaterialId, Mesh, MuscleId, Node, NodeId, Paint, Part, Pixels, Surface,
    SurfaceGeometry, TextureRef, WrapMode, smooth_normals,
};

use super::World;

/// A UV sphere of radius 1 with (u, v) over it.
pub(crate) fn sphere(segments: u32, rings: u32) -> Mesh {
    let mut mesh = Mesh { name: "sphere".into(), ..Mesh::default() };
    let mut uv = Vec::new();
    for ring in 0..=rings {
        let v = ring as f32 / rings as f32;
        let (sin, cos) = (v * std::f32::consts::PI).sin_cos();
        for segment in 0..=segments {
            let u = segment as f32 / segments as f32;
            let (s, c) = (u * std::f32::consts::TAU).sin_cos();
            mesh.positions.push(Vec3::new(sin * s, cos, sin * c));
            uv.push(Vec2::new(u, 1.0 - v));
        }
    }
    let at = |ring: u32, segment: u32| ring * (segments + 1) + segment;
    for ring in 0..rings {
        for segment in 0..segments {
            let (a, b, c, d) = (at(ring, segment), at(ring + 1, segment), at(ring + 1, segment + 1), at(ring, segment + 1));
            if ring + 1 < rings {
                mesh.triangles.push([a, b, c]);
            }
            if ring > 0 {
                mesh.triangles.push([a, c, d]);
            }
        }
    }
    mesh.normals = mesh.positions.clone();
    mesh.uv_sets = vec![uv];
    finish(mesh)
}

/// A muscle's belly: radius over length from a smooth profile, u round it and v along it, along +Y from −1 to 1.
pub(crate) fn belly(nodes: u32, segments: u32, radius: impl Fn(f32) -> f32) -> Mesh {
    let mut mesh = Mesh { name: "belly".into(), ..Mesh::default() };
    let mut uv = Vec::new();
    for node in 0..nodes {
        let v = node as f32 / (nodes - 1) as f32;
        for segment in 0..=segments {
            let u = segment as f32 / segments as f32;
            let (s, c) = (u * std::f32::consts::TAU).sin_cos();
            let r = radius(v);
            mesh.positions.push(Vec3::new(r * s, v * 2.0 - 1.0, r * c));
            uv.push(Vec2::new(u, v));
        }
    }
    let at = |node: u32, segment: u32| node * (segments + 1) + segment;
    for node in 0..nodes - 1 {
        for segment in 0..segments {
            let (a, b, c, d) = (at(node, segment), at(node, segment + 1), at(node + 1, segment + 1), at(node + 1, segment));
            mesh.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    mesh.normals = Vec::new();
    let group = |v: u32| v / (segments + 1) * segments + v % (segments + 1) % segments;
    smooth_normals(&mesh.positions, &mesh.triangles, group, mesh.positions.len(), &mut mesh.normals);
    mesh.uv_sets = vec![uv];
    let mut mesh = finish(mesh);
    // The two ends of a ring are one point.
    mesh.source_vertex = (0..mesh.positions.len() as u32).map(group).collect();
    mesh
}

/// A square in the XY plane from −1 to 1, facing +Z, with (u, v) from 0 to 1.
pub(crate) fn square() -> Mesh {
    soup(
        vec![Vec3::new(-1.0, -1.0, 0.0), Vec3::new(1.0, -1.0, 0.0), Vec3::new(1.0, 1.0, 0.0), Vec3::new(-1.0, 1.0, 0.0)],
        vec![[0, 1, 2], [0, 2, 3]],
        vec![Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y],
    )
}

/// Any triangles, with normals towards +Z.
pub(crate) fn soup(positions: Vec<Vec3>, triangles: Vec<[u32; 3]>, uv: Vec<Vec2>) -> Mesh {
    let normals = vec![Vec3::Z; positions.len()];
    finish(Mesh { name: "soup".into(), positions, normals, triangles, uv_sets: vec![uv], ..Mesh::default() })
}

/// One part over everything, each vertex its own point.
pub(crate) fn finish(mut mesh: Mesh) -> Mesh {
    mesh.source_count = mesh.positions.len() as u32;
    mesh.source_vertex = (0..mesh.source_count).collect();
    mesh.parts = vec![Part { symbol: String::new(), triangles: 0..mesh.triangles.len() as u32, lines: 0..mesh.lines.len() as u32 }];
    mesh
}

impl World {
    /// Adds a material and returns its binding.
    pub(crate) fn material(&mut self, material: Material) -> MaterialBinding {
        self.scene.materials.push(material.clone());
        self.frame.materials.push(material);
        MaterialBinding::plain(MaterialId(self.scene.materials.len() as u32 - 1))
    }

    /// Adds an image and returns a reference to it.
    pub(crate) fn image(&mut self, width: u32, height: u32, texel: impl Fn(u32, u32) -> [u8; 4], wrap: WrapMode) -> TextureRef {
        let rgba = (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).flat_map(|(x, y)| texel(x, y)).collect();
        self.scene.images.push(Image { pixels: Some(Arc::new(Pixels { width, height, rgba })), ..Image::default() });
        TextureRef {
            image: ImageId(self.scene.images.len() as u32 - 1),
            semantic: String::new(),
            wrap_s: wrap,
            wrap_t: wrap,
            transform: None,
        }
    }

    /// Puts a mesh into the world on a node of its own.
    pub(crate) fn place(&mut self, mesh: Mesh, matrix: Mat4, material: Option<MaterialBinding>) -> NodeId {
        self.put(Arc::new(mesh), matrix, material, None)
    }

    /// The same for a muscle.
    pub(crate) fn place_muscle(&mut self, mesh: Mesh, matrix: Mat4, material: Option<MaterialBinding>) -> NodeId {
        self.put(Arc::new(mesh), matrix, material, Some(MuscleId(0)))
    }

    fn put(&mut self, mesh: Arc<Mesh>, matrix: Mat4, material: Option<MaterialBinding>, muscle: Option<MuscleId>) -> NodeId {
        let node = self.scene.graph.add(None, Node::new("thing"));
        self.frame.world.push(matrix.as_dmat4());
        let bounds = mesh.bounds().transformed(&matrix);
        self.frame.bounds.merge(&bounds);
        let materials = vec![material; mesh.parts.len()].into();
        let mirrored = matrix.determinant() < 0.0;
        let fibers = if muscle.is_some() { sinew::muscle::fibers(&mesh) } else { Arc::default() };
        let placement = SurfaceGeometry::Rigid(matrix);
        self.frame.surfaces.push(Surface {
            node,
            mesh,
            materials,
            geometry: placement,
            mirrored,
            solid: None,
            muscle,
            fibers,
            visible: true,
            content: 0,
            skin: false,
            coordinates: Vec::new(),
            ghost: None,
        });
        node
    }

    /// A sphere of that many segments and rings in a plain colour.
    pub(crate) fn sphere(segments: u32, rings: u32, color: [f32; 3]) -> Self {
        let mut world = Self::default();
        let material = world.material(Material { diffuse: Paint::color(color[0], color[1], color[2]), ..Material::default() });
        world.place(sphere(segments, rings), Mat4::IDENTITY, Some(material));
        world
    }

    /// The box round everything.
    pub(crate) fn bounds(&self) -> Bounds {
        self.frame.bounds
    }
}

/// A checkerboard with a gradient, so that every corner can be told from the others.
pub(crate) fn checker(x: u32, y: u32, cells: u32, size: u32) -> [u8; 4] {
    let dark = (x * cells / size + y * cells / size).is_multiple_of(2);
    let shade = if dark { 60 } else { 255 };
    [(shade * x / size.max(1)) as u8, (shade * y / size.max(1)) as u8, shade as u8, 255]
}

/// An arm: a skinned tube along +X from 0 to 2 with three joints, the elbow at 1 bent by `degrees`. Returns the joints.
pub(crate) fn arm(world: &mut World, degrees: f32) -> [NodeId; 3] {
    use glam::{DMat4, DVec3};
    use sinew::scene::{Content, Deformer, FrameJoint, Influence, MeshInstance, NodeKind, Skin, SkinJoint};
    let (rings, segments) = (40u32, 24u32);
    let mut rest = belly(rings, segments, |v| 0.16 + 0.05 * (v * std::f32::consts::TAU * 2.0).sin().abs());
    for p in rest.positions.iter_mut().chain(&mut rest.normals) {
        *p = Vec3::new(p.y, -p.x, p.z);
    }
    for p in &mut rest.positions {
        p.x += 1.0;
    }
    let turn = DMat4::from_rotation_z(f64::from(degrees).to_radians());
    let locals = [DMat4::IDENTITY, DMat4::from_translation(DVec3::X) * turn, DMat4::from_translation(DVec3::X)];
    let (mut parent, mut above, mut joints) = (None, DMat4::IDENTITY, Vec::new());
    for (k, local) in locals.into_iter().enumerate() {
        let node = world.scene.graph.add(parent, Node::new(["shoulder", "elbow", "hand"][k]).with_kind(NodeKind::Joint));
        above *= local;
        world.frame.world.push(above);
        world.frame.joints.push(FrameJoint { node, parent });
        joints.push(node);
        parent = Some(node);
    }
    let share = |x: f32| ((x - 0.8) / 0.4).clamp(0.0, 1.0);
    let elbow = world.frame.world[joints[1].index()].as_mat4() * Mat4::from_translation(-Vec3::X);
    let blend = |p: Vec3| Mat4::IDENTITY * (1.0 - share(p.x)) + elbow * share(p.x);
    let positions: Vec<Vec3> = rest.positions.iter().map(|p| blend(*p).transform_point3(*p)).collect();
    let normals = rest.positions.iter().zip(&rest.normals).map(|(p, n)| blend(*p).transform_vector3(*n).normalize_or_zero()).collect();
    let mut skin = Skin { bind_shape: DMat4::IDENTITY, offsets: vec![0], ..Skin::default() };
    for (k, name) in ["shoulder", "elbow"].into_iter().enumerate() {
        skin.joints.push(SkinJoint { name: name.into(), inverse_bind: DMat4::from_translation(-DVec3::X * k as f64) });
    }
    for p in &rest.positions {
        let s = share(p.x);
        skin.influences.extend([Influence { joint: 0, weight: 1.0 - s }, Influence { joint: 1, weight: s }]);
        skin.offsets.push(skin.influences.len() as u32);
    }
    world.scene.skins.push(skin);
    let deformers = vec![Deformer::Skin { skin: sinew::scene::SkinId(0), joints: vec![Some(joints[0]), Some(joints[1])] }];
    let instance = MeshInstance { mesh: sinew::scene::MeshId(0), deformers, materials: vec![None].into(), skinned_targets: Vec::new() };
    let node = world.scene.graph.add(None, Node::new("skin").with_content(Content::Mesh(instance)));
    world.frame.world.push(DMat4::IDENTITY);
    world.frame.bounds.merge(&Bounds::of(positions.iter().copied()));
    let materials = vec![None; rest.parts.len()].into();
    let placement = SurfaceGeometry::Deformed { positions, normals };
    let mesh = Arc::new(rest);
    world.frame.surfaces.push(Surface {
        node,
        mesh,
        materials,
        geometry: placement,
        mirrored: false,
        solid: None,
        muscle: None,
        fibers: Arc::default(),
        visible: true,
        content: 0,
        skin: false,
        coordinates: Vec::new(),
        ghost: None,
    });
    [joints[0], joints[1], joints[2]]
}

/// A biceps-like outline: thin at the ends, thick a little above the middle.
pub(crate) fn profile(v: f32) -> f32 {
    0.06 + 0.30 * (std::f32::consts::PI * v.powf(0.9)).sin().max(0.0).powf(1.3)
}

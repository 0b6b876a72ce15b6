//! Documents that the tests compose themselves, and a look at what came out.
#![allow(dead_code, reason = "each test target uses a part of it")]

use glam::{DMat4, DVec3, Vec3};
use sinew::animation::Pose;
use sinew::collada::{ColladaScene, ReadError, read};
use sinew::document::{Document, PoseBuffers, PoseState};
use sinew::formats::SCENE_READERS;
use sinew::progress::Progress;
use sinew::scene::{Content, Deformer, Frame, Graph, Mesh, MeshInstance, Node, NodeId};

/// Reads `text` as the file `test.dae`.
pub(crate) fn try_load(text: &str) -> Result<ColladaScene, ReadError> {
    read(text.as_bytes(), "test.dae", &Progress::default())
}

/// Reads `text`, which must be readable.
#[track_caller]
pub(crate) fn load(text: &str) -> ColladaScene {
    try_load(text).unwrap_or_else(|error| panic!("line {:?}: {error}", error.line))
}

/// Reads `text`, which must give no finding at all.
#[track_caller]
pub(crate) fn load_clean(text: &str) -> ColladaScene {
    let loaded = load(text);
    assert!(loaded.findings.is_empty(), "{:#?}", loaded.findings);
    loaded
}

/// The codes of all findings, in file order.
pub(crate) fn codes(loaded: &ColladaScene) -> Vec<&'static str> {
    loaded.findings.iter().map(|finding| finding.code()).collect()
}

/// A whole document: `body` between an asset (metres, Y up) and the scene named `s`.
pub(crate) fn document(body: &str) -> String {
    headed("1.4.1", "<asset><unit meter=\"1\"/><up_axis>Y_UP</up_axis></asset>", body)
}

/// A whole document with its own version and asset.
pub(crate) fn headed(version: &str, asset: &str, body: &str) -> String {
    format!(
        "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"{version}\">\n\
         {asset}\n{body}\n<scene><instance_visual_scene url=\"#s\"/></scene>\n</COLLADA>\n"
    )
}

/// The visual scene `s` with these nodes.
pub(crate) fn scene(nodes: &str) -> String {
    format!("<library_visual_scenes><visual_scene id=\"s\">{nodes}</visual_scene></library_visual_scenes>\n")
}

/// A source of floats with one named param for each of `names`, such as `"X Y Z"`.
pub(crate) fn floats(id: &str, names: &str, values: &str) -> String {
    let (stride, count) = (names.split_whitespace().count(), values.split_whitespace().count());
    let params: String = names.split_whitespace().map(|name| format!("<param name=\"{name}\" type=\"float\"/>")).collect();
    format!(
        "<source id=\"{id}\"><float_array id=\"{id}-a\" count=\"{count}\">{values}</float_array><technique_common>\
         <accessor source=\"#{id}-a\" count=\"{}\" stride=\"{stride}\">{params}</accessor></technique_common></source>\n",
        count / stride.max(1)
    )
}

/// A source of whole matrices, written row by row.
pub(crate) fn matrices(id: &str, values: &[DMat4]) -> String {
    let text: Vec<String> = values.iter().map(rows).collect();
    format!(
        "<source id=\"{id}\"><float_array id=\"{id}-a\" count=\"{}\">{}</float_array><technique_common>\
         <accessor source=\"#{id}-a\" count=\"{}\"><param name=\"TRANSFORM\" type=\"float4x4\"/></accessor></technique_common></source>\n",
        values.len() * 16,
        text.join("\n"),
        values.len()
    )
}

/// A matrix as COLLADA writes it: row by row.
pub(crate) fn rows(matrix: &DMat4) -> String {
    matrix.transpose().to_cols_array().map(|value| value.to_string()).join(" ")
}

/// A source of names; `tag` is such as `Name_array`.
pub(crate) fn names(id: &str, tag: &str, param: &str, values: &str) -> String {
    let count = values.split_whitespace().count();
    format!(
        "<source id=\"{id}\"><{tag} id=\"{id}-a\" count=\"{count}\">{values}</{tag}><technique_common><accessor source=\"#{id}-a\" \
         count=\"{count}\" stride=\"1\"><param name=\"{param}\" type=\"name\"/></accessor></technique_common></source>\n"
    )
}

/// A geometry with the points `values` and whatever primitives are given; the vertices are called `{id}-v`.
pub(crate) fn geometry(id: &str, points: &str, primitives: &str) -> String {
    format!(
        "<geometry id=\"{id}\"><mesh>{}<vertices id=\"{id}-v\"><input semantic=\"POSITION\" source=\"#{id}-p\"/></vertices>\n{primitives}</mesh></geometry>\n",
        floats(&format!("{id}-p"), "X Y Z", points)
    )
}

/// Library of geometries.
pub(crate) fn geometries(all: &str) -> String {
    format!("<library_geometries>{all}</library_geometries>\n")
}

/// A triangle of the points 0 0 0, 1 0 0, 0 1 0 called `g`, in its library.
pub(crate) fn triangle() -> String {
    geometries(&geometry("g", "0 0 0 1 0 0 0 1 0", &triangles("g", "0 1 2")))
}

/// A `triangles` element over the vertices of geometry `id`.
pub(crate) fn triangles(id: &str, indices: &str) -> String {
    format!(
        "<triangles count=\"{}\"><input semantic=\"VERTEX\" source=\"#{id}-v\" offset=\"0\"/><p>{indices}</p></triangles>\n",
        indices.split_whitespace().count() / 3
    )
}

/// An animation called `id`: times, values (params named by `param`), interpolation names; moves `target`.
pub(crate) fn animation(id: &str, target: &str, times: &str, param: &str, values: &str, modes: &str) -> String {
    format!(
        "<animation id=\"{id}\">{}{}{}<sampler id=\"{id}-s\"><input semantic=\"INPUT\" source=\"#{id}-t\"/>\
         <input semantic=\"OUTPUT\" source=\"#{id}-v\"/><input semantic=\"INTERPOLATION\" source=\"#{id}-i\"/></sampler>\n\
         <channel source=\"#{id}-s\" target=\"{target}\"/></animation>\n",
        floats(&format!("{id}-t"), "TIME", times),
        floats(&format!("{id}-v"), param, values),
        names(&format!("{id}-i"), "Name_array", "INTERPOLATION", modes),
    )
}

/// Library of animations.
pub(crate) fn animations(all: &str) -> String {
    format!("<library_animations>{all}</library_animations>\n")
}

/// The node with this name.
#[track_caller]
pub(crate) fn node(loaded: &ColladaScene, name: &str) -> NodeId {
    loaded.scene.graph.find(name).unwrap_or_else(|| panic!("there is no node {name}"))
}

/// World matrices at rest.
pub(crate) fn rest_world(loaded: &ColladaScene) -> Vec<DMat4> {
    let mut world = Vec::new();
    loaded.scene.graph.world_from_local(&loaded.scene.graph.rest_locals(), &mut world);
    world
}

/// World matrices with clip `clip` at `time`.
pub(crate) fn posed_world(loaded: &ColladaScene, clip: usize, time: f64) -> Vec<DMat4> {
    let mut pose = Pose::rest(&loaded.scene);
    loaded.clips[clip].sample(time, &mut pose);
    let (mut local, mut world) = (Vec::new(), Vec::new());
    Graph::compose_flat(&pose.ops, &pose.ranges, &mut local);
    loaded.scene.graph.world_from_local(&local, &mut world);
    world
}

/// The pose of clip `clip` at `time`.
pub(crate) fn pose(loaded: &ColladaScene, clip: usize, time: f64) -> Pose {
    let mut pose = Pose::rest(&loaded.scene);
    loaded.clips[clip].sample(time, &mut pose);
    pose
}

/// Mesh instances with their nodes, in order of the graph.
pub(crate) fn instances(loaded: &ColladaScene) -> Vec<(&Node, &MeshInstance)> {
    let graph = &loaded.scene.graph;
    graph
        .iter()
        .flat_map(|(_, node)| {
            node.contents.iter().filter_map(move |content| match content {
                Content::Mesh(instance) => Some((node, instance)),
                _ => None,
            })
        })
        .collect()
}

/// The only mesh.
#[track_caller]
pub(crate) fn mesh(loaded: &ColladaScene) -> &Mesh {
    assert_eq!(loaded.scene.meshes.len(), 1);
    &loaded.scene.meshes[0]
}

/// The nodes that the skin of instance `index` is bound to.
#[track_caller]
pub(crate) fn joints(loaded: &ColladaScene, index: usize) -> Vec<Option<NodeId>> {
    let found = instances(loaded)[index].1.deformers.iter().find_map(|deformer| match deformer {
        Deformer::Skin { joints, .. } => Some(joints.clone()),
        Deformer::Morph(_) => None,
    });
    found.expect("a skin")
}

/// The points of a mesh's triangles, as the file's numbers.
pub(crate) fn corners(mesh: &Mesh) -> Vec<[[f32; 3]; 3]> {
    mesh.triangles.iter().map(|triangle| triangle.map(|vertex| mesh.positions[vertex as usize].to_array())).collect()
}

/// The area of a mesh.
pub(crate) fn area(mesh: &Mesh) -> f32 {
    let point = |vertex: u32| mesh.positions[vertex as usize];
    mesh.triangles.iter().map(|[a, b, c]| (point(*b) - point(*a)).cross(point(*c) - point(*a)).length() / 2.0).sum()
}

/// Checks that two points are the same but for rounding.
#[track_caller]
pub(crate) fn near(found: DVec3, wanted: DVec3) {
    assert!((found - wanted).length() < 1e-9, "{found} is not {wanted}");
}

/// The same in single precision.
#[track_caller]
pub(crate) fn near32(found: Vec3, wanted: Vec3) {
    assert!((found - wanted).length() < 1e-5, "{found} is not {wanted}");
}

/// Where the vertices of all surfaces of a file with these bytes are at `time`; world, metres.
#[track_caller]
pub(crate) fn drawn_bytes(name: &str, bytes: &[u8], time: f64) -> Vec<Vec3> {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join(name);
    std::fs::write(&file, bytes).expect("written");
    let document = Document::open(&[file], SCENE_READERS, &Progress::default()).expect("readable");
    let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
    document.pose(&PoseState { time, ..document.start_state() }, &mut buffers, &mut frame);
    frame.surfaces.iter().flat_map(|surface| (0..surface.mesh.positions.len() as u32).map(|v| surface.position(v))).collect()
}

/// [`drawn_bytes`] of a document.
#[track_caller]
pub(crate) fn drawn(text: &str, time: f64) -> Vec<Vec3> {
    drawn_bytes("test.dae", text.as_bytes(), time)
}

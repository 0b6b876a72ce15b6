//! Surfaces whose two sides look different, as two faces that lie on each other.

use serde_json::Value;
use sinew::document::Document;
use sinew::export::gltf::{GltfContainer, save};
use sinew::formats::SCENE_READERS;
use sinew::output::Output;
use sinew::progress::Progress;

use crate::reader::Glb;
use crate::support;

/// A square that is red on one side and blue on the other, cut along different diagonals; red also covers a triangle that has no other side.
const SHEET: &str = r##"<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset><up_axis>Y_UP</up_axis></asset>
<library_effects>
<effect id="r"><profile_COMMON><technique sid="c"><lambert><diffuse><color>1 0 0 1</color></diffuse></lambert></technique></profile_COMMON></effect>
<effect id="b"><profile_COMMON><technique sid="c"><lambert><diffuse><color>0 0 1 1</color></diffuse></lambert></technique></profile_COMMON></effect>
</library_effects>
<library_materials><material id="red"><instance_effect url="#r"/></material><material id="blue"><instance_effect url="#b"/></material></library_materials>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="21">0 0 0 1 0 0.3 1 1 0.3 0 1 0 5 0 0 6 0 0 5 1 0</float_array><technique_common>
<accessor source="#pa" count="7" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor>
</technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="2" material="inner"><input semantic="VERTEX" source="#v" offset="0"/><p>1 0 3 1 3 2</p></triangles>
<triangles count="3" material="outer"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2 4 5 6 0 2 3</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n"><instance_geometry url="#g"><bind_material><technique_common>
<instance_material symbol="inner" target="#blue"/><instance_material symbol="outer" target="#red"/>
</technique_common></bind_material></instance_geometry></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>
"##;

#[test]
fn faces_on_each_other_are_seen_from_their_own_sides_only() {
    let folder = support::folder();
    let file = support::models::write(folder.path(), "sheet.dae", SHEET);
    let document = Document::open(&[&file], SCENE_READERS, &Progress::default()).unwrap_or_else(|error| panic!("{error}"));
    let out = folder.path().join("sheet.glb");
    save(&Output::of_program(&out), GltfContainer::Binary, &document).expect("written");
    let glb = Glb::read(&std::fs::read(&out).expect("there"));
    let number = |value: &Value| value.as_u64().expect("a number") as usize;
    let mut found: Vec<(String, bool, usize)> = Vec::new();
    for primitive in glb.root()["meshes"][0]["primitives"].as_array().expect("primitives") {
        let material = &glb.root()["materials"][number(&primitive["material"])];
        let color = &material["pbrMetallicRoughness"]["baseColorFactor"];
        let name = if color[0].as_f64() > Some(0.5) { "red" } else { "blue" };
        let both = material.get("doubleSided").is_some_and(|both| both == true);
        found.push((name.to_owned(), both, glb.rows(number(&primitive["indices"])).len() / 3));
    }
    found.sort();
    assert_eq!(found, [("blue".to_owned(), false, 2), ("red".to_owned(), false, 2), ("red".to_owned(), true, 1)]);
}

#[test]
fn other_surfaces_are_seen_from_both_sides() {
    let folder = support::folder();
    let file = support::models::write(folder.path(), "cube.dae", &support::models::cube(""));
    let document = Document::open(&[&file], SCENE_READERS, &Progress::default()).unwrap_or_else(|error| panic!("{error}"));
    let out = folder.path().join("cube.glb");
    save(&Output::of_program(&out), GltfContainer::Binary, &document).expect("written");
    let glb = Glb::read(&std::fs::read(&out).expect("there"));
    let materials = glb.root()["materials"].as_array().cloned().unwrap_or_default();
    assert!(materials.iter().all(|material| material["doubleSided"] == true), "{materials:?}");
}

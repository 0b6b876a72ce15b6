//! `library_visual_scenes`, `library_nodes`, lights and cameras.

use glam::{DMat4, DVec3, Vec3};
use sinew::scene::{Content, LightKind, NodeKind, Projection, TransformOp};

use crate::build::*;

#[test]
fn the_scene_that_is_named_is_shown() {
    let two = "<library_visual_scenes><visual_scene id=\"a\"><node name=\"wrong\"/></visual_scene><visual_scene id=\"s\"><node name=\"right\"/></visual_scene></library_visual_scenes>";
    let loaded = load_clean(&document(two));
    assert!(loaded.scene.graph.find("right").is_some() && loaded.scene.graph.find("wrong").is_none());
    let unnamed = load(&document(two).replace("<scene><instance_visual_scene url=\"#s\"/></scene>", ""));
    assert_eq!(codes(&unnamed), ["no-scene-named"]);
    assert!(unnamed.scene.graph.find("wrong").is_some());
    let broken = load(&document(two).replace("url=\"#s\"", "url=\"#nowhere\""));
    assert_eq!(codes(&broken), ["no-scene-named", "broken-reference"]);
    assert!(broken.scene.graph.find("wrong").is_some());
}

#[test]
fn without_a_scene_the_parts_are_shown() {
    let loaded = load(&document(&triangle()).replace("<scene><instance_visual_scene url=\"#s\"/></scene>", ""));
    assert_eq!(codes(&loaded), ["no-scene"]);
    assert_eq!(instances(&loaded).len(), 1);
}

#[test]
fn transforms_are_kept_in_document_order_and_compose_left_to_right() {
    let ops = "<lookat>0 0 5 0 0 0 0 1 0</lookat><matrix>1 0 0 7 0 1 0 8 0 0 1 9 0 0 0 1</matrix><rotate>0 0 10 90</rotate><scale>1 2 3</scale>\
               <skew>45 0 1 0 1 0 0</skew><translate>1 0 0</translate>";
    let loaded = load_clean(&document(&scene(&format!("<node name=\"n\">{ops}</node>"))));
    let node = loaded.scene.graph.node(node(&loaded, "n"));
    assert_eq!(node.transform.ops.len(), 6);
    assert_eq!(node.transform.ops[1], TransformOp::Matrix(DMat4::from_translation(DVec3::new(7.0, 8.0, 9.0))));
    // Text is row by row: a rotation of 90° about z turns x into y.
    let turned = "<matrix>0 -1 0 0 1 0 0 0 0 0 1 0 0 0 0 1</matrix>";
    let loaded =
        load_clean(&document(&scene(&format!("<node name=\"n\"><translate>1 0 0</translate>{turned}<scale>2 2 2</scale></node>"))));
    let matrix = loaded.scene.graph.node(crate::build::node(&loaded, "n")).transform.matrix();
    near(matrix.transform_point3(DVec3::X), DVec3::new(1.0, 2.0, 0.0));
}

#[test]
fn transforms_with_the_wrong_numbers_do_nothing_but_keep_their_place() {
    let loaded = load(&document(&scene("<node name=\"n\"><translate>1 2</translate><matrix>1 0</matrix><scale>2 2 2</scale></node>")));
    assert_eq!(codes(&loaded), ["bad-transform", "bad-transform"]);
    let node = loaded.scene.graph.node(node(&loaded, "n"));
    assert_eq!(node.transform.ops.len(), 3);
    near(node.transform.matrix().transform_point3(DVec3::X), DVec3::X * 2.0);
}

#[test]
fn nodes_of_the_library_stand_where_they_are_instanced() {
    let library = "<library_nodes><node id=\"part\" name=\"part\"><translate>0 1 0</translate><instance_node url=\"#leaf\"/></node>\
                   <node id=\"leaf\" name=\"leaf\"><translate>0 0 1</translate></node></library_nodes>";
    let nodes = "<node name=\"a\"><translate>1 0 0</translate><instance_node url=\"#part\"/><instance_node url=\"#part\"/></node><instance_node url=\"#leaf\"/>";
    let loaded = load_clean(&document(&(library.to_owned() + &scene(nodes))));
    // Asset, a, part, leaf, part, leaf, leaf.
    assert_eq!(loaded.scene.graph.len(), 7);
    near(rest_world(&loaded)[3].w_axis.truncate(), DVec3::ONE);
}

#[test]
fn circles_of_nodes_are_cut_and_told() {
    let itself = "<node id=\"a\"><instance_node url=\"#a\"/></node>";
    let pair = "<node id=\"a\"><instance_node url=\"#b\"/></node><node id=\"b\"><instance_node url=\"#a\"/></node>";
    for nodes in [itself, pair] {
        let loaded = load(&document(&scene(nodes)));
        assert!(codes(&loaded).iter().all(|code| *code == "reference-cycle"), "{:?}", codes(&loaded));
        assert!(!loaded.findings.is_empty() && loaded.scene.graph.len() < 10);
    }
}

#[test]
fn several_things_hang_on_one_node() {
    let lights = "<library_lights><light id=\"l\"><technique_common><spot><color>1 0.5 0</color><constant_attenuation>2</constant_attenuation>\
                  <falloff_angle>30</falloff_angle><falloff_exponent>4</falloff_exponent></spot></technique_common></light></library_lights>";
    let cameras = "<library_cameras><camera id=\"c\"><optics><technique_common><perspective><xfov>90</xfov><aspect_ratio>2</aspect_ratio><znear>0.5</znear>\
                   <zfar>50</zfar></perspective></technique_common></optics></camera><camera id=\"o\"><optics><technique_common><orthographic><ymag>3</ymag>\
                   <znear>1</znear><zfar>2</zfar></orthographic></technique_common></optics></camera></library_cameras>";
    let nodes = "<node name=\"n\"><instance_geometry url=\"#g\"/><instance_light url=\"#l\"/><instance_camera url=\"#c\"/><instance_camera url=\"#o\"/></node>";
    let loaded = load_clean(&document(&(triangle() + lights + cameras + &scene(nodes))));
    let contents = &loaded.scene.graph.node(node(&loaded, "n")).contents;
    assert!(matches!(contents[..], [Content::Mesh(_), Content::Light(_), Content::Camera(_), Content::Camera(_)]));
    let light = &loaded.scene.lights[0];
    assert_eq!((light.color, light.attenuation), (Vec3::new(1.0, 0.5, 0.0), Vec3::new(2.0, 0.0, 0.0)));
    assert_eq!(light.kind, LightKind::Spot { falloff_angle: 30.0, falloff_exponent: 4.0 });
    // tan(x/2) = aspect · tan(y/2).
    let wanted = 2.0 * (0.5f32).atan();
    assert!(matches!(loaded.scene.cameras[0].projection, Projection::Perspective { fov_y } if (fov_y - wanted).abs() < 1e-6));
    assert_eq!((loaded.scene.cameras[0].near, loaded.scene.cameras[0].far), (0.5, 50.0));
    assert_eq!(loaded.scene.cameras[1].projection, Projection::Orthographic { height: 6.0 });
}

#[test]
fn every_kind_of_light_is_read() {
    for (tag, kind) in [("ambient", LightKind::Ambient), ("directional", LightKind::Directional), ("point", LightKind::Point)] {
        let light = format!(
            "<library_lights><light id=\"l\"><technique_common><{tag}><color>1 1 1</color></{tag}></technique_common></light></library_lights>"
        );
        let loaded = load_clean(&document(&(light + &scene("<node><instance_light url=\"#l\"/></node>"))));
        assert_eq!(loaded.scene.lights[0].kind, kind);
    }
    let odd = "<library_lights><light id=\"l\"/></library_lights><library_cameras><camera id=\"c\"/></library_cameras>";
    let loaded = load(&document(&(odd.to_owned() + &scene("<node><instance_light url=\"#l\"/><instance_camera url=\"#c\"/></node>"))));
    assert_eq!(codes(&loaded), ["bad-light-or-camera"; 2]);
}

#[test]
fn joints_are_told_from_nodes_and_keep_their_names() {
    let loaded = load_clean(&document(&scene("<node id=\"i\" name=\"bone\" sid=\"b\" type=\"JOINT\"/><node id=\"j\"/>")));
    let bone = loaded.scene.graph.node(node(&loaded, "bone"));
    assert_eq!((bone.kind, bone.id.as_str(), bone.sid.as_str()), (NodeKind::Joint, "i", "b"));
    assert_eq!(loaded.scene.graph.node(node(&loaded, "j")).kind, NodeKind::Node);
    assert_eq!(loaded.scene.graph.node(loaded.scene.graph.roots()[0]).kind, NodeKind::Asset);
    assert_eq!(loaded.scene.graph.node(loaded.scene.graph.roots()[0]).name, "test");
}

#[test]
fn a_skew_moves_points_along_its_first_vector_in_proportion_to_its_second() {
    for (skew, wanted) in [
        ("45 1 0 0 0 0 1", DVec3::new(4.0, 2.0, 3.0)),
        ("45 0 0 1 1 0 0", DVec3::new(1.0, 2.0, 4.0)),
        ("-45 0 2 0 0 0 0.5", DVec3::new(1.0, -1.0, 3.0)),
        ("60 1 0 0 0 1 0", DVec3::new(1.0 + 2.0 * 3_f64.sqrt(), 2.0, 3.0)),
        ("0 1 0 0 0 1 0", DVec3::new(1.0, 2.0, 3.0)),
    ] {
        let loaded = load_clean(&document(&scene(&format!("<node name=\"n\"><skew>{skew}</skew></node>"))));
        let matrix = loaded.scene.graph.node(node(&loaded, "n")).transform.matrix();
        near(matrix.transform_point3(DVec3::new(1.0, 2.0, 3.0)), wanted);
    }
}

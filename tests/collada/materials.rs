//! `library_materials`, `library_effects`, `library_images`.

use glam::{Vec2, Vec3};
use sinew::collada::{ColladaScene, Finding};
use sinew::diagnostics::Severity;
use sinew::scene::{AlphaSource, Material, ShadingModel, TextureTransform, WrapMode};

use crate::build::*;

/// The triangle with material `m`, whose effect has this in its profile (before the technique) and this shader.
fn painted(profile: &str, shader: &str) -> String {
    let body = "<library_materials><material id=\"m\" name=\"paint\"><instance_effect url=\"#e\"/></material></library_materials>"
        .to_owned()
        + &format!(
            "<library_effects><effect id=\"e\"><profile_COMMON>{profile}<technique sid=\"common\">{shader}</technique></profile_COMMON></effect></library_effects>"
        );
    let used = "<node><instance_geometry url=\"#g\"><bind_material><technique_common><instance_material symbol=\"s\" target=\"#m\">\
                <bind_vertex_input semantic=\"UV\" input_semantic=\"TEXCOORD\" input_set=\"4\"/></instance_material></technique_common></bind_material></instance_geometry></node>";
    let sources = floats("t1", "S T", "0 0 1 0 0 1") + &floats("t4", "S T", "0 0 1 0 0 1");
    let triangle = triangle().replace("<triangles ", "<triangles material=\"s\" ").replace("<mesh>", &format!("<mesh>{sources}")).replace(
        "<p>",
        "<input semantic=\"TEXCOORD\" source=\"#t4\" offset=\"0\" set=\"4\"/><input semantic=\"TEXCOORD\" source=\"#t1\" offset=\"0\" set=\"1\"/><p>",
    );
    document(&(body + &triangle + &scene(used)))
}

fn material(loaded: &ColladaScene) -> &Material {
    let binding = instances(loaded)[0].1.materials[0].clone().expect("a material");
    &loaded.scene.materials[binding.material.index()]
}

#[test]
fn every_formula_is_read_with_its_colours() {
    for (tag, model) in [
        ("constant", ShadingModel::Constant),
        ("lambert", ShadingModel::Lambert),
        ("phong", ShadingModel::Phong),
        ("blinn", ShadingModel::Blinn),
    ] {
        let shader = format!(
            "<{tag}><emission><color>0.1 0 0 1</color></emission><ambient><color>0 0.2 0 1</color></ambient><diffuse><color>0 0 0.3 1</color></diffuse>\
             <specular><color>0.4 0.4 0.4 1</color></specular><shininess><float>12.5</float></shininess></{tag}>"
        );
        let loaded = load_clean(&painted("", &shader));
        let material = material(&loaded);
        assert_eq!((material.model, material.name.as_str(), material.id.as_str()), (model, "paint", "m"));
        assert_eq!(material.emission.color, Vec3::new(0.1, 0.0, 0.0));
        assert_eq!(material.ambient.color, Vec3::new(0.0, 0.2, 0.0));
        assert_eq!(material.diffuse.color, Vec3::new(0.0, 0.0, 0.3));
        assert_eq!(material.specular.color, Vec3::splat(0.4));
        assert_eq!((material.shininess, material.opacity), (12.5, 1.0));
    }
}

#[test]
fn parameters_stand_for_colours_and_numbers() {
    let params = "<newparam sid=\"c\"><float3>0.1 0.2 0.3</float3></newparam><newparam sid=\"f\"><float>7</float></newparam>";
    let shader = "<phong><diffuse><param ref=\"c\"/></diffuse><shininess><param ref=\"f\"/></shininess></phong>";
    let loaded = load_clean(&painted(params, shader));
    assert_eq!((material(&loaded).diffuse.color, material(&loaded).shininess), (Vec3::new(0.1, 0.2, 0.3), 7.0));
    let set = painted(params, shader).replace(
        "<instance_effect url=\"#e\"/>",
        "<instance_effect url=\"#e\"><setparam ref=\"f\"><float>9</float></setparam></instance_effect>",
    );
    assert_eq!(material(&load_clean(&set)).shininess, 9.0);
}

/// A lambert shader with this for transparency.
fn seen(transparent: &str, transparency: &str) -> ColladaScene {
    load(&painted("", &format!("<lambert><diffuse><color>1 1 1 1</color></diffuse>{transparent}{transparency}</lambert>")))
}

#[test]
fn four_opaque_modes_make_one_opacity() {
    for (mode, color, amount, wanted) in [
        ("A_ONE", "0 0 0 0.5", "0.5", 0.25),
        ("A_ZERO", "0 0 0 0.5", "0.5", 0.75),
        ("RGB_ONE", "0.5 0.5 0.5 1", "0.5", 0.25),
        ("RGB_ZERO", "0.5 0.5 0.5 1", "0.5", 0.75),
        ("RGB_ZERO", "0 0 0 1", "1", 1.0),
        ("RGB_ZERO", "1 1 1 1", "0", 1.0),
    ] {
        let loaded = seen(
            &format!("<transparent opaque=\"{mode}\"><color>{color}</color></transparent>"),
            &format!("<transparency><float>{amount}</float></transparency>"),
        );
        assert!((material(&loaded).opacity - wanted).abs() < 1e-5, "{mode} {color} {amount}: {}", material(&loaded).opacity);
        assert!(loaded.findings.is_empty());
    }
    assert_eq!(material(&seen("", "<transparency><float>0.25</float></transparency>")).opacity, 0.25);
    assert_eq!(material(&seen("<transparent><color>1 1 1 0.5</color></transparent>", "")).opacity, 0.5);
}

#[test]
fn what_would_be_invisible_was_written_the_wrong_way_round() {
    for (transparent, amount) in [
        ("<transparent><color>0 0 0 1</color></transparent>", "0"),
        ("<transparent opaque=\"RGB_ZERO\"><color>1 1 1 1</color></transparent>", "1"),
        ("", "0"),
    ] {
        let loaded = seen(transparent, &format!("<transparency><float>{amount}</float></transparency>"));
        assert_eq!((material(&loaded).opacity, codes(&loaded)), (1.0, vec!["transparency-inverted"]));
        assert_eq!(loaded.findings[0].severity(), Severity::Info);
    }
}

const IMAGE: &str = "<library_images><image id=\"i\" name=\"photo\"><init_from>./maps/a%20b.png</init_from></image></library_images>";
const SAMPLER_14: &str = "<newparam sid=\"u\"><surface type=\"2D\"><init_from>i</init_from></surface></newparam>\
                          <newparam sid=\"x\"><sampler2D><source>u</source><wrap_s>CLAMP</wrap_s><wrap_t>MIRROR</wrap_t></sampler2D></newparam>";
const TEXTURED: &str = "<phong><diffuse><texture texture=\"x\" texcoord=\"UV\"/></diffuse></phong>";

fn textured(profile: &str, shader: &str, image: &str) -> String {
    painted(profile, shader).replace("<library_materials>", &format!("{image}<library_materials>"))
}

#[test]
fn textures_come_through_samplers_or_straight() {
    let modern = "<newparam sid=\"x\"><sampler2D><instance_image url=\"#i\"/></sampler2D></newparam>";
    for (profile, shader) in
        [(SAMPLER_14, TEXTURED.to_owned()), (modern, TEXTURED.to_owned()), ("", TEXTURED.replace("texture=\"x\"", "texture=\"i\""))]
    {
        let loaded = load_clean(&textured(profile, &shader, IMAGE));
        let texture = material(&loaded).diffuse.texture.clone().expect("a texture");
        let image = &loaded.scene.images[texture.image.index()];
        assert_eq!((image.uri.as_str(), image.name.as_str(), image.line.is_some()), ("./maps/a b.png", "photo", true));
        let binding = instances(&loaded)[0].1.materials[0].clone().expect("a binding");
        // Sets 1 and 4 of the file are 0 and 1 of the mesh.
        assert_eq!(binding.uv_set(&texture), 1);
        assert_eq!(material(&loaded).diffuse.color, Vec3::ONE);
    }
    let loaded = load_clean(&textured(SAMPLER_14, TEXTURED, IMAGE));
    let texture = material(&loaded).diffuse.texture.clone().expect("a texture");
    assert_eq!((texture.wrap_s, texture.wrap_t), (WrapMode::Clamp, WrapMode::Mirror));
}

#[test]
fn images_are_named_in_every_way() {
    for (reference, wanted) in [
        ("<init_from> photo 1.png\n</init_from>", "photo 1.png"),
        ("<init_from><ref>..\\maps\\a.png</ref></init_from>", "../maps/a.png"),
        ("<init_from>file:///C:/maps/a%20b.png</init_from>", "C:/maps/a b.png"),
    ] {
        let image = format!("<library_images><image id=\"i\">{reference}</image></library_images>");
        assert_eq!(load_clean(&textured(SAMPLER_14, TEXTURED, &image)).scene.images[0].uri, wanted);
    }
    let inside = "<library_images><image id=\"i\"><init_from><hex format=\"PNG\">89 50 4E47</hex></init_from></image></library_images>";
    let loaded = load_clean(&textured(SAMPLER_14, TEXTURED, inside));
    assert_eq!(loaded.archived, [(loaded.scene.images[0].uri.clone().into(), vec![0x89, 0x50, 0x4E, 0x47])]);
    let file_name = SAMPLER_14.replace("<init_from>i<", "<init_from>wood.png<");
    assert_eq!(load_clean(&textured(&file_name, TEXTURED, "")).scene.images[0].uri, "wood.png");
}

#[test]
fn textures_that_lead_nowhere_are_told() {
    let loaded = load(&textured("", TEXTURED, ""));
    assert_eq!(codes(&loaded), ["texture-not-found"]);
    let loaded = load(&textured(&SAMPLER_14.replace(">i<", ">j<"), TEXTURED, IMAGE));
    assert_eq!(codes(&loaded), ["texture-not-found"]);
}

#[test]
fn a_texture_may_hold_the_opacity() {
    for (mode, wanted) in [
        ("A_ONE", AlphaSource::Alpha),
        ("A_ZERO", AlphaSource::InverseAlpha),
        ("RGB_ONE", AlphaSource::Luminance),
        ("RGB_ZERO", AlphaSource::InverseLuminance),
    ] {
        let shader = format!("<lambert><transparent opaque=\"{mode}\"><texture texture=\"x\" texcoord=\"UV\"/></transparent></lambert>");
        let loaded = load_clean(&textured(SAMPLER_14, &shader, IMAGE));
        assert_eq!(material(&loaded).opacity_texture.as_ref().map(|(_, source)| *source), Some(wanted));
        assert_eq!(material(&loaded).opacity, 1.0);
    }
}

#[test]
fn transparency_weighs_a_texture_that_takes_opacity_away_and_multiplies_one_that_gives_it() {
    for (mode, opacity, share) in [("A_ONE", 0.25, 1.0), ("RGB_ONE", 0.25, 1.0), ("A_ZERO", 1.0, 0.25), ("RGB_ZERO", 1.0, 0.25)] {
        let shader = format!(
            "<lambert><transparent opaque=\"{mode}\"><texture texture=\"x\" texcoord=\"UV\"/></transparent><transparency><float sid=\"o\">0.25</float></transparency></lambert>"
        );
        let moves = animations(&animation("b", "e/o", "0 1", "X", "0 1", "LINEAR LINEAR"));
        let loaded = load_clean(&textured(SAMPLER_14, &shader, IMAGE).replace("<scene>", &format!("{moves}<scene>")));
        assert_eq!((material(&loaded).opacity, material(&loaded).opacity_texture_share), (opacity, share), "{mode}");
        let moved = &pose(&loaded, 0, 0.75).materials[0];
        let wanted = if share == 1.0 { (0.75, 1.0) } else { (1.0, 0.75) };
        assert_eq!((moved.opacity, moved.opacity_texture_share), wanted, "{mode}");
    }
}

#[test]
fn an_effect_without_a_common_profile_is_told_once_however_many_materials_use_it() {
    let text = painted("", "<lambert/>")
        .replace("profile_COMMON", "profile_GLSL")
        .replace("</library_materials>", "<material id=\"m2\"><instance_effect url=\"#e\"/></material></library_materials>");
    assert_eq!(codes(&load(&text)), ["no-common-profile"]);
}

#[test]
fn both_sides_of_a_mesh_show_where_its_geometry_says_so() {
    for (hint, wanted) in [("1", true), ("0", false)] {
        let extra = format!("<extra><technique profile=\"MAYA\"><double_sided>{hint}</double_sided></technique></extra></geometry>");
        assert_eq!(mesh(&load_clean(&painted("", "<lambert/>").replace("</geometry>", &extra))).double_sided, wanted);
    }
}

#[test]
fn materials_are_bound_by_symbol_and_two_on_one_mesh_stay_apart() {
    let text = painted("", "<lambert/>")
        .replace("</library_materials>", "<material id=\"m2\" name=\"other\"><instance_effect url=\"#e\"/></material></library_materials>")
        .replace("</triangles>", "</triangles><triangles material=\"s2\" count=\"1\"><input semantic=\"VERTEX\" source=\"#g-v\" offset=\"0\"/><p>0 2 1</p></triangles>")
        .replace("</technique_common></bind_material>", "<instance_material symbol=\"s2\" target=\"#m2\"/></technique_common></bind_material>");
    let loaded = load_clean(&text);
    let bound: Vec<&str> =
        instances(&loaded)[0].1.materials.iter().flatten().map(|b| loaded.scene.materials[b.material.index()].name.as_str()).collect();
    assert_eq!(bound, ["paint", "other"]);
}

#[test]
fn what_is_not_bound_is_none_or_meant_directly() {
    let unbound = load(&painted("", "<lambert/>").replace("symbol=\"s\"", "symbol=\"z\""));
    assert_eq!((codes(&unbound), instances(&unbound)[0].1.materials.to_vec()), (vec!["unbound-material"], vec![None]));
    let direct = load_clean(&painted("", "<lambert/>").replace("symbol=\"s\"", "symbol=\"z\"").replace("material=\"s\"", "material=\"m\""));
    assert_eq!(material(&direct).name, "paint");
}

#[test]
fn effects_without_a_common_profile_are_neutral_and_double_sides_are_seen() {
    let loaded = load(&painted("", "<lambert/>").replace("profile_COMMON", "profile_GLSL"));
    assert_eq!(codes(&loaded), ["no-common-profile"]);
    assert_eq!(material(&loaded).diffuse, Material::default().diffuse);
    let extra = "<extra><technique profile=\"GOOGLEEARTH\"><double_sided>1</double_sided></technique></extra></profile_COMMON>";
    assert!(material(&load_clean(&painted("", "<lambert/>").replace("</profile_COMMON>", extra))).double_sided);
    assert!(!material(&load_clean(&painted("", "<lambert/>"))).double_sided);
}

#[test]
fn colours_opacity_and_lights_are_animated() {
    let shader = "<lambert><diffuse><color sid=\"d\">0 0 0 1</color></diffuse><transparent opaque=\"RGB_ZERO\"><color>1 1 1 1</color></transparent>\
                  <transparency><float sid=\"o\">0.5</float></transparency></lambert>";
    let light = "<library_lights><light id=\"l\"><technique_common><point><color sid=\"c\">0 0 0</color></point></technique_common></light></library_lights>";
    let moves = animations(
        &(animation("a", "e/common/d.G", "0 1", "X", "0 1", "LINEAR LINEAR")
            + &animation("b", "e/o", "0 1", "X", "0 1", "LINEAR LINEAR")
            + &animation("c", "l/c", "0 1", "R G B", "0 0 0 1 0.5 0", "LINEAR LINEAR")),
    );
    let text = painted("", shader)
        .replace("<scene>", &format!("{light}{moves}<scene>"))
        .replace("</visual_scene>", "<node><instance_light url=\"#l\"/></node></visual_scene>");
    let loaded = load_clean(&text);
    let pose = pose(&loaded, 0, 0.25);
    assert_eq!(pose.materials[0].diffuse.color, Vec3::new(0.0, 0.25, 0.0));
    assert_eq!(pose.materials[0].opacity, 0.75);
    assert_eq!(pose.light_colors, [Vec3::new(0.25, 0.125, 0.0)]);
}

/// A lambert material with a texture that has this `extra`, and this in its sampler.
fn maya_texture(extra: &str, sampler: &str) -> String {
    let images = "<library_images><image id=\"i\"><init_from>wood.png</init_from></image></library_images>";
    let profile = format!(
        "<newparam sid=\"u\"><surface type=\"2D\"><init_from>i</init_from></surface></newparam><newparam sid=\"v\"><sampler2D><source>u</source>{sampler}</sampler2D></newparam>"
    );
    let shader = format!("<lambert><diffuse><texture texture=\"v\" texcoord=\"UV\">{extra}</texture></diffuse></lambert>");
    painted(&profile, &shader).replace("<library_materials>", &format!("{images}<library_materials>"))
}

#[test]
fn the_place_that_maya_gives_a_texture_is_read() {
    let maya = |profile: &str, inside: &str| format!("<extra type=\"x\"><technique profile=\"{profile}\">{inside}</technique></extra>");
    let placed = |extra: &str, sampler: &str| {
        let loaded = load_clean(&maya_texture(extra, sampler));
        material(&loaded).diffuse.texture.clone().expect("a texture")
    };
    let full = "<repeatU>3</repeatU><repeatV sid=\"r\"> 2 </repeatV><offsetU>0.5</offsetU><offsetV>-0.25</offsetV><rotateUV>90</rotateUV>";
    for profile in ["MAYA", "OpenCOLLADAMaya"] {
        let texture = placed(&maya(profile, full), "");
        assert_eq!(
            texture.transform,
            Some(TextureTransform { repeat: Vec2::new(3.0, 2.0), offset: Vec2::new(0.5, -0.25), rotation: 90.0 })
        );
    }
    assert_eq!(placed(&maya("MAX3D", full), "").transform, None);
    assert_eq!(placed(&maya("MAYA", "<repeatU>1</repeatU><rotateUV>0</rotateUV>"), "").transform, None);
    for (inside, wanted) in [
        ("<wrapU>1</wrapU>", WrapMode::Repeat),
        ("<wrapU>FALSE</wrapU>", WrapMode::Border),
        ("<mirrorU>true</mirrorU>", WrapMode::Mirror),
        ("<wrapU>TRUE</wrapU><mirrorU>1</mirrorU>", WrapMode::Mirror),
        ("<repeatU>2</repeatU>", WrapMode::Clamp),
    ] {
        let texture = placed(&maya("MAYA", inside), "<wrap_s>CLAMP</wrap_s>");
        assert_eq!((texture.wrap_s, texture.wrap_t), (wanted, WrapMode::Repeat), "{inside}");
    }
}

#[test]
fn blender_writes_colours_as_scene_linear_values_and_nobody_else_does() {
    let shader = "<phong><emission><color>0 0 0 1</color></emission><diffuse><color sid=\"d\">0.5 0.002 1 1</color></diffuse><specular><color>0.25 0.25 0.25 1</color></specular>\
                  <transparent opaque=\"RGB_ZERO\"><color>0.5 0.5 0.5 1</color></transparent></phong>";
    let by = |tool: &str| {
        painted("", shader).replace("<asset>", &format!("<asset><contributor><authoring_tool>{tool}</authoring_tool></contributor>"))
    };
    for (tool, wanted, specular) in [
        ("Blender 3.4.1 commit date:2022-12-19", Vec3::new(0.735_357, 0.025_84, 1.0), 0.537_1),
        ("Maya 2020", Vec3::new(0.5, 0.002, 1.0), 0.25),
    ] {
        let loaded = load_clean(&by(tool));
        near32(material(&loaded).diffuse.color, wanted);
        assert!((material(&loaded).specular.color.x - specular).abs() < 1e-4, "{tool}");
        // Opacity is no colour.
        assert!((material(&loaded).opacity - 0.5).abs() < 1e-6);
        let moves = animations(&animation("a", "e/d", "0 1", "R G B A", "0.5 0.002 1 1 0.5 0.002 1 1", "LINEAR LINEAR"));
        let animated = load_clean(&by(tool).replace("<library_visual_scenes>", &format!("{moves}<library_visual_scenes>")));
        near32(pose(&animated, 0, 1.0).materials[0].diffuse.color, wanted);
    }
}

#[test]
fn what_is_wrong_with_a_material_that_occurs_often_is_told_once() {
    let node = "<node><instance_geometry url=\"#g\"/></node>";
    let materials = "<library_materials><material id=\"other\"/></library_materials>";
    let text = document(&(triangle().replace("<triangles ", "<triangles material=\"lost\" ") + materials + &scene(&node.repeat(16))));
    let loaded = load(&text);
    assert_eq!(codes(&loaded), ["unbound-material"]);
    assert_eq!((&loaded.findings[0].finding, loaded.findings[0].more_places), (&Finding::UnboundMaterial("lost".to_owned()), 15));
}

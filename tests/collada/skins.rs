//! `skin`: matrices, weights, and which nodes move it.

use glam::{DMat4, DVec3};
use sinew::collada::{ColladaScene, Finding};
use sinew::scene::{Influence, NodeKind};

use crate::build::*;

/// A skin over the triangle `g`: joints named by `tag` and `joints`, one inverse bind matrix for each of `count`, `vcount` and `v` as given.
struct Skin<'a> {
    tag: &'a str,
    joints: &'a str,
    count: usize,
    weights: &'a str,
    vcount: &'a str,
    v: &'a str,
}

const PLAIN: Skin<'static> = Skin { tag: "Name_array", joints: "a b", count: 2, weights: "1 0.5", vcount: "1 2 1", v: "0 0 0 1 1 1 1 0" };

impl Skin<'_> {
    fn library(&self) -> String {
        let binds: Vec<DMat4> = (0..self.count).map(|i| DMat4::from_translation(DVec3::X * -(i as f64))).collect();
        format!(
            "<library_controllers><controller id=\"c\" name=\"skin\"><skin source=\"#g\"><bind_shape_matrix>{}</bind_shape_matrix>{}{}{}\
             <joints><input semantic=\"JOINT\" source=\"#j\"/><input semantic=\"INV_BIND_MATRIX\" source=\"#m\"/></joints>\
             <vertex_weights count=\"3\"><input semantic=\"JOINT\" source=\"#j\" offset=\"0\"/><input semantic=\"WEIGHT\" source=\"#w\" offset=\"1\"/>\
             <vcount>{}</vcount><v>{}</v></vertex_weights></skin></controller></library_controllers>",
            rows(&DMat4::from_translation(DVec3::new(0.0, 5.0, 0.0))),
            names("j", self.tag, "JOINT", self.joints),
            matrices("m", &binds),
            floats("w", "WEIGHT", self.weights),
            self.vcount,
            self.v
        )
    }

    fn text(&self, nodes: &str) -> String {
        document(&(triangle() + &self.library() + &scene(nodes)))
    }
}

const BONES: &str =
    "<node id=\"A\" name=\"bone a\" sid=\"a\" type=\"JOINT\"><node id=\"B\" name=\"bone b\" sid=\"b\" type=\"JOINT\"/></node>";
const USE: &str = "<node name=\"body\"><instance_controller url=\"#c\"><skeleton>#A</skeleton></instance_controller></node>";

fn nodes(loaded: &ColladaScene, names: &[&str]) -> Vec<Option<sinew::scene::NodeId>> {
    names.iter().map(|name| Some(node(loaded, name))).collect()
}

#[test]
fn matrices_weights_and_joints_are_read() {
    let loaded = load_clean(&PLAIN.text(&(BONES.to_owned() + USE)));
    let skin = &loaded.scene.skins[0];
    assert_eq!(skin.bind_shape, DMat4::from_translation(DVec3::new(0.0, 5.0, 0.0)));
    assert_eq!(skin.joints[1].inverse_bind, DMat4::from_translation(DVec3::NEG_X));
    assert_eq!(skin.offsets, [0, 1, 3, 4]);
    assert_eq!(skin.influences_of(1), [Influence { joint: 0, weight: 0.5 }, Influence { joint: 1, weight: 0.5 }]);
    assert_eq!(joints(&loaded, 0), nodes(&loaded, &["bone a", "bone b"]));
    assert_eq!((skin.name.as_str(), skin.id.as_str()), ("skin", "c"));
}

#[test]
fn names_with_blanks_are_joined_as_the_nodes_know_them() {
    let bones =
        "<node id=\"A\" name=\"bone a\" sid=\"Bip01\" type=\"JOINT\"><node name=\"bone b\" sid=\"Bip01 L Hand\" type=\"JOINT\"/></node>";
    let skin = Skin { joints: "Bip01 Bip01 L Hand", ..PLAIN };
    let loaded = load(&skin.text(&(bones.to_owned() + USE)));
    assert_eq!(codes(&loaded), ["joint-names-rejoined"]);
    assert_eq!(joints(&loaded, 0), nodes(&loaded, &["bone a", "bone b"]));
    assert_eq!(loaded.scene.skins[0].joints[1].name, "Bip01 L Hand");
}

#[test]
fn names_are_sids_under_the_skeleton_first() {
    // Another node with the same sid stands earlier, outside of the skeleton.
    let decoy = "<node name=\"decoy\" sid=\"b\"/>";
    let loaded = load_clean(&PLAIN.text(&(decoy.to_owned() + BONES + USE)));
    assert_eq!(joints(&loaded, 0), nodes(&loaded, &["bone a", "bone b"]));
    // A joint outside of the named skeleton is found in the whole scene.
    let apart = "<node id=\"A\" name=\"bone a\" sid=\"a\"/><node name=\"bone b\" sid=\"b\"/>";
    let loaded = load_clean(&PLAIN.text(&(apart.to_owned() + USE)));
    assert_eq!(joints(&loaded, 0), nodes(&loaded, &["bone a", "bone b"]));
    // What moves a skin is a bone, whatever the file calls it.
    assert_eq!(loaded.scene.graph.node(node(&loaded, "bone b")).kind, NodeKind::Joint);
}

#[test]
fn then_ids_then_names() {
    let skin = Skin { joints: "A b", ..PLAIN };
    let loaded = load_clean(&skin.text(&(BONES.to_owned() + USE)));
    assert_eq!(joints(&loaded, 0), nodes(&loaded, &["bone a", "bone b"]));
    let bones = "<node id=\"A\" name=\"a\"><node name=\"b\"/></node>";
    let loaded = load_clean(&PLAIN.text(&(bones.to_owned() + USE)));
    assert_eq!(joints(&loaded, 0), nodes(&loaded, &["a", "b"]));
}

#[test]
fn idrefs_are_ids_and_sidrefs_are_paths() {
    let decoy = "<node name=\"decoy\" sid=\"A\"/>";
    let skin = Skin { tag: "IDREF_array", joints: "A B", ..PLAIN };
    let loaded = load_clean(&skin.text(&(decoy.to_owned() + BONES + USE)));
    assert_eq!(joints(&loaded, 0), nodes(&loaded, &["bone a", "bone b"]));
    let skin = Skin { tag: "SIDREF_array", joints: "A A/b", ..PLAIN };
    let loaded = load_clean(&skin.text(&(BONES.to_owned() + USE)));
    assert_eq!(joints(&loaded, 0), nodes(&loaded, &["bone a", "bone b"]));
}

#[test]
fn without_a_skeleton_the_whole_scene_is_searched() {
    let loaded = load_clean(&PLAIN.text(&(BONES.to_owned() + USE)).replace("<skeleton>#A</skeleton>", ""));
    assert_eq!(joints(&loaded, 0), nodes(&loaded, &["bone a", "bone b"]));
    let of_scene = load_clean(&PLAIN.text(&(BONES.to_owned() + USE)).replace("<skeleton>#A<", "<skeleton>#s<"));
    assert_eq!(joints(&of_scene, 0), nodes(&of_scene, &["bone a", "bone b"]));
}

#[test]
fn several_skeletons_of_one_instance_are_all_searched() {
    let bones = "<node name=\"decoy\" sid=\"b\"/><node id=\"A\" name=\"bone a\" sid=\"a\"/><node id=\"B\" name=\"root\"><node name=\"bone b\" sid=\"b\"/></node>";
    let text = PLAIN.text(&(bones.to_owned() + USE)).replace("<skeleton>#A</skeleton>", "<skeleton>#A</skeleton><skeleton> #B </skeleton>");
    let loaded = load_clean(&text);
    assert_eq!(joints(&loaded, 0), nodes(&loaded, &["bone a", "bone b"]));
}

#[test]
fn one_controller_stands_on_two_skeletons() {
    let bones = |id: &str| format!("<node id=\"{id}\" name=\"{id}a\" sid=\"a\"><node name=\"{id}b\" sid=\"b\"/></node>");
    let used = |id: &str| format!("<node><instance_controller url=\"#c\"><skeleton>#{id}</skeleton></instance_controller></node>");
    let loaded = load_clean(&PLAIN.text(&(bones("L") + &bones("R") + &used("L") + &used("R"))));
    assert_eq!(joints(&loaded, 0), nodes(&loaded, &["La", "Lb"]));
    assert_eq!(joints(&loaded, 1), nodes(&loaded, &["Ra", "Rb"]));
    assert_eq!((loaded.scene.skins.len(), loaded.scene.meshes.len()), (1, 1));
}

#[test]
fn joints_of_the_node_library_are_those_of_the_own_instance() {
    let library = format!("<library_nodes><node id=\"figure\">{BONES}{USE}</node></library_nodes>");
    let twice = "<instance_node url=\"#figure\"/><instance_node url=\"#figure\"/>";
    let loaded = load_clean(&document(&(triangle() + &PLAIN.library() + &library + &scene(twice))));
    let [first, second] = [joints(&loaded, 0), joints(&loaded, 1)];
    assert!(first.iter().zip(&second).all(|(a, b)| a.is_some() && a < b), "{first:?} {second:?}");
    let body = |index: usize| loaded.scene.graph.iter().filter(|(_, node)| node.name == "body").nth(index).map(|(id, _)| id);
    assert!(first[1] < body(0) && body(0) < second[0]);
}

#[test]
fn a_skeleton_outside_of_the_scene_is_brought_in() {
    let library = format!("<library_nodes>{BONES}</library_nodes>");
    let loaded = load(&document(&(triangle() + &PLAIN.library() + &library + &scene(USE))));
    assert_eq!(codes(&loaded), ["skeleton-not-in-scene"]);
    assert_eq!(joints(&loaded, 0), nodes(&loaded, &["bone a", "bone b"]));
}

#[test]
fn joints_that_are_nowhere_are_told() {
    let skin = Skin { joints: "a lost", ..PLAIN };
    let loaded = load(&skin.text(&(BONES.to_owned() + USE)));
    assert_eq!(codes(&loaded), ["joint-not-found"]);
    assert_eq!(loaded.findings[0].finding, Finding::JointsNotFound { count: 1, first: "lost".to_owned() });
    assert_eq!(joints(&loaded, 0), [Some(node(&loaded, "bone a")), None]);
}

#[test]
fn joints_have_a_name_and_a_matrix() {
    for (joints, count) in [("a", 2), ("a b c", 2), ("a b", 1)] {
        let skin = Skin { joints, count, vcount: "1 1 1", v: "0 0 0 0 0 0", ..PLAIN };
        let loaded = load(&skin.text(&(BONES.to_owned() + USE)));
        assert!(
            codes(&loaded).iter().any(|code| ["count-mismatch", "joint-names-rejoined"].contains(code)),
            "{joints}: {:?}",
            codes(&loaded)
        );
        assert_eq!(loaded.scene.skins[0].joints.len(), count.min(joints.split(' ').count()));
    }
}

#[test]
fn points_have_any_number_of_influences_none_and_the_bind_shape_included() {
    let skin = Skin { weights: "0.1 0.2 1", vcount: "8 0 1", v: "0 0 1 0 0 0 1 0 0 0 1 0 0 1 1 1 -1 2", ..PLAIN };
    let loaded = load_clean(&skin.text(&(BONES.to_owned() + USE)));
    let skin = &loaded.scene.skins[0];
    assert_eq!(skin.influences_of(0).len(), 8);
    assert!((skin.influences_of(0).iter().map(|influence| influence.weight).sum::<f32>() - 1.0).abs() < 1e-6);
    assert!(skin.influences_of(1).is_empty());
    assert_eq!(skin.influences_of(2), [Influence { joint: -1, weight: 1.0 }]);
}

#[test]
fn sums_other_than_one_are_scaled_and_told() {
    let skin = Skin { weights: "1 3", vcount: "2 1 1", v: "0 0 1 1 0 0 1 0", ..PLAIN };
    let loaded = load(&skin.text(&(BONES.to_owned() + USE)));
    assert_eq!(codes(&loaded), ["weights-not-normalised"]);
    assert_eq!(loaded.scene.skins[0].influences_of(0), [Influence { joint: 0, weight: 0.25 }, Influence { joint: 1, weight: 0.75 }]);
    let nothing = Skin { weights: "0 1", vcount: "1 1 1", v: "0 0 0 1 0 1", ..PLAIN };
    let loaded = load(&nothing.text(&(BONES.to_owned() + USE)));
    assert_eq!(codes(&loaded), ["weights-not-normalised"]);
    assert!(loaded.scene.skins[0].influences_of(0).is_empty());
}

#[test]
fn weights_that_lead_nowhere_or_are_missing_are_told() {
    for (vcount, v, wanted) in [
        ("1 1 1", "9 0 0 0 0 0", "index-out-of-range"),
        ("1 1 1", "0 9 0 0 0 0", "index-out-of-range"),
        ("1 1 1", "-2 0 0 0 0 0", "index-out-of-range"),
        ("1 1 1", "0 0 0 0", "count-mismatch"),
        ("1 1 4000000000", "0 0 0 0 0 0", "count-mismatch"),
        ("1 1", "0 0 0 0", "skin-points-mismatch"),
        ("1 1 1 1", "0 0 0 0 0 0 0 0", "skin-points-mismatch"),
    ] {
        let loaded = load(&Skin { vcount, v, ..PLAIN }.text(&(BONES.to_owned() + USE)));
        assert_eq!(codes(&loaded), [wanted], "{vcount} / {v}");
        assert_eq!(loaded.scene.skins[0].offsets.len(), 4);
    }
}

#[test]
fn a_skin_that_lacks_its_parts_still_shows_the_mesh() {
    for (from, to) in [("semantic=\"WEIGHT\"", "semantic=\"X\""), ("semantic=\"JOINT\"", "semantic=\"X\""), ("vertex_weights", "other")] {
        let loaded = load(&PLAIN.text(&(BONES.to_owned() + USE)).replace(from, to));
        assert_eq!(codes(&loaded), ["bad-skin"], "{from}");
        assert_eq!(instances(&loaded).len(), 1);
    }
}

#[test]
fn a_circle_of_controllers_is_cut() {
    let loaded = load(&PLAIN.text(&(BONES.to_owned() + USE)).replace("<skin source=\"#g\">", "<skin source=\"#c\">"));
    assert_eq!(codes(&loaded), ["reference-cycle"]);
}

#[test]
fn what_is_not_below_the_skeleton_is_looked_for_around_it_first() {
    // Two figures alike; the second one's skeleton is named by a joint in the middle, so that its root lies above.
    let figure = |n: usize| {
        format!(
            "<node id=\"F{n}\" name=\"figure {n}\"><node id=\"A{n}\" name=\"a{n}\" sid=\"a\" type=\"JOINT\"><node id=\"B{n}\" name=\"b{n}\" sid=\"b\" type=\"JOINT\"/></node></node>"
        )
    };
    let used = "<node><instance_controller url=\"#c\"><skeleton>#B2</skeleton></instance_controller></node>";
    let loaded = load_clean(&PLAIN.text(&(figure(1) + &figure(2) + used)));
    assert_eq!(joints(&loaded, 0), nodes(&loaded, &["a2", "b2"]));
}

#[test]
fn names_with_blanks_are_counted_by_the_accessor_where_there_are_no_matrices() {
    let skin = Skin { joints: "a Bip01 Head", ..PLAIN };
    let text = skin
        .text(
            &("<node name=\"a\" sid=\"a\"><node name=\"Bip01 Head\"/></node>".to_owned()
                + "<node><instance_controller url=\"#c\"/></node>"),
        )
        .replace("source=\"#j-a\" count=\"3\"", "source=\"#j-a\" count=\"2\"")
        .replace("<input semantic=\"INV_BIND_MATRIX\" source=\"#m\"/>", "");
    let loaded = load(&text);
    assert_eq!(joints(&loaded, 0), nodes(&loaded, &["a", "Bip01 Head"]));
    let mut found = codes(&loaded);
    found.sort_unstable();
    assert_eq!(found, ["bad-skin", "joint-names-rejoined"]);
}

#[test]
fn without_a_bind_shape_matrix_the_mesh_stands_as_it_is() {
    let text = PLAIN.text(&(BONES.to_owned() + USE));
    let from = text.find("<bind_shape_matrix>").expect("it is there");
    let to = text.find("</bind_shape_matrix>").expect("it is there") + "</bind_shape_matrix>".len();
    let loaded = load_clean(&(text[..from].to_owned() + &text[to..]));
    assert_eq!(loaded.scene.skins[0].bind_shape, DMat4::IDENTITY);
}

#[test]
fn weights_count_the_joints_of_their_own_source() {
    // The joints are a and b; the weights call b the first and a the second.
    let own = names("k", "Name_array", "JOINT", "b a");
    let text = PLAIN.text(&(BONES.to_owned() + USE));
    let at = text.find("<vertex_weights").unwrap_or_default();
    let (before, after) = text.split_at(at);
    let text = format!("{before}{own}{}", after.replacen("source=\"#j\"", "source=\"#k\"", 1));
    let loaded = load_clean(&text);
    let skin = &loaded.scene.skins[0];
    assert_eq!(joints(&loaded, 0), nodes(&loaded, &["bone a", "bone b"]));
    assert_eq!(skin.influences_of(0), [Influence { joint: 1, weight: 1.0 }]);
    assert_eq!(skin.influences_of(2), [Influence { joint: 0, weight: 1.0 }]);
    // Names that the skin has not are of no use: its own order holds.
    let loaded = load_clean(&text.replace(">b a<", ">b x<"));
    assert_eq!(loaded.scene.skins[0].influences_of(0), [Influence { joint: 0, weight: 1.0 }]);
}

#[test]
fn joints_written_as_urls_are_found() {
    for (tag, written) in [("Name_array", "#A #B"), ("IDREF_array", "#A #B")] {
        let loaded = load_clean(&Skin { tag, joints: written, ..PLAIN }.text(&(BONES.to_owned() + USE)));
        assert_eq!(joints(&loaded, 0), nodes(&loaded, &["bone a", "bone b"]), "{tag}");
    }
    let signs = "#".repeat(1_000_000);
    let loaded = load(&Skin { joints: &format!("a {signs}"), ..PLAIN }.text(&(BONES.to_owned() + USE)));
    assert_eq!(codes(&loaded), ["joint-not-found"]);
}

#[test]
fn a_mesh_called_like_a_bone_is_not_taken_for_it() {
    // As the FBX converter writes it: no skeleton, and the mesh of the head is called as the bone is.
    let bare = "<instance_controller url=\"#c\"/>";
    let bone = "<node id=\"A\" name=\"bone a\" sid=\"a\" type=\"JOINT\"/>";
    for (mesh, bone_b) in [
        ("sid=\"b\"", "id=\"B\" name=\"bone b\" sid=\"b\" type=\"JOINT\""),
        ("id=\"b\"", "id=\"B\" name=\"bone b\" sid=\"b\""),
        ("id=\"b\"", "name=\"b\" type=\"JOINT\""),
        ("name=\"b\"", "name=\"b\""),
    ] {
        let loaded = load_clean(&PLAIN.text(&format!("<node {mesh}>{bare}</node>{bone}<node {bone_b}/>")));
        let last = loaded.scene.graph.iter().last().map(|(id, _)| id);
        assert_eq!(joints(&loaded, 0), [Some(node(&loaded, "bone a")), last], "{mesh} {bone_b}");
    }
    // Other meshes than its own, too, where the file says which of them is a joint.
    let decoy = "<node name=\"decoy\" sid=\"b\"/>";
    let loaded = load_clean(&PLAIN.text(&format!("<node>{decoy}<node>{bare}</node></node>{BONES}")));
    assert_eq!(joints(&loaded, 0), nodes(&loaded, &["bone a", "bone b"]));
    // A mesh that hangs on its own bone stays there.
    let own = format!("<node name=\"bone b\" sid=\"b\">{bare}</node>");
    let loaded = load_clean(&PLAIN.text(&(bone.to_owned() + &own)));
    assert_eq!(joints(&loaded, 0), nodes(&loaded, &["bone a", "bone b"]));
}

#[test]
fn names_that_stand_for_themselves_are_not_joined() {
    let skin = Skin { joints: "a b", count: 1, vcount: "1 1 1", v: "0 0 0 0 0 0", ..PLAIN };
    let loaded = load(&skin.text(&(BONES.to_owned() + USE)));
    assert_eq!((codes(&loaded), joints(&loaded, 0)), (vec!["count-mismatch"], nodes(&loaded, &["bone a"])));
}

#[test]
fn skins_that_share_an_array_of_matrices_have_their_own_number_of_joints() {
    let text = Skin { count: 3, ..PLAIN }.text(&(BONES.to_owned() + USE));
    let shared = text.replace("source=\"#m-a\" count=\"3\"", "source=\"#m-a\" count=\"2\" offset=\"16\"");
    assert_ne!(shared, text);
    let loaded = load_clean(&shared);
    assert_eq!(joints(&loaded, 0), nodes(&loaded, &["bone a", "bone b"]));
    assert_eq!(loaded.scene.skins[0].joints[1].inverse_bind, DMat4::from_translation(DVec3::X * -2.0));
}

#[test]
fn the_bottom_row_of_every_matrix_is_0_0_0_1() {
    let flat = "1 0 0 1 0 1 0 2 0 0 1 3 0 0 0 0";
    let moved = DMat4::from_translation(DVec3::new(1.0, 2.0, 3.0));
    let text = PLAIN.text(&(BONES.to_owned() + USE));
    let shape = rows(&DMat4::from_translation(DVec3::new(0.0, 5.0, 0.0)));
    let loaded = load(&text.replace(&shape, flat));
    assert_eq!((codes(&loaded), loaded.scene.skins[0].bind_shape), (vec!["bad-transform"], moved));
    let first = rows(&DMat4::from_translation(DVec3::X * -0.0));
    let loaded = load(&text.replace(&format!(">{first}"), &format!(">{flat}")));
    assert_eq!((codes(&loaded), loaded.scene.skins[0].joints[0].inverse_bind), (vec!["bad-transform"], moved));
    let nodes = format!("<node><translate>5 0 0</translate><node name=\"n\"><matrix>{flat}</matrix></node></node>");
    let loaded = load(&document(&(triangle() + &scene(&nodes))));
    assert_eq!(codes(&loaded), ["bad-transform"]);
    near(rest_world(&loaded)[node(&loaded, "n").index()].w_axis.truncate(), DVec3::new(6.0, 2.0, 3.0));
}

#[test]
fn a_controller_hangs_on_either_kind_of_instance() {
    let text = PLAIN.text(&(BONES.to_owned() + USE)).replace("instance_controller", "instance_geometry");
    let loaded = load_clean(&text);
    assert_eq!(joints(&loaded, 0), nodes(&loaded, &["bone a", "bone b"]));
}

#[test]
fn a_count_of_matrices_that_lies_makes_no_joint_without_a_name_and_is_told_once() {
    // Two matrices where the array says sixteen numbers, the accessor one row, and there is one name.
    let skin = Skin { joints: "a", count: 2, vcount: "1 1 1", v: "0 0 0 0 0 0", ..PLAIN };
    let text = skin
        .text(&(BONES.to_owned() + USE))
        .replace("count=\"32\"", "count=\"16\"")
        .replace("\"#m-a\" count=\"2\"", "\"#m-a\" count=\"1\"");
    let loaded = load(&text);
    assert_eq!((codes(&loaded), loaded.scene.skins[0].joints.len()), (vec!["count-mismatch"], 1));
}

/// The triangle on a skin with one bone whose points have these numbers of weights, with its bind shape and inverse bind matrix.
fn bound(bind_shape: DMat4, inverse_bind: DMat4, vcount: &str, nodes: &str) -> String {
    let skin = Skin { joints: "a", count: 1, weights: "1", vcount, v: "0 0 0 0 0 0", ..PLAIN };
    let (old, moved) = (rows(&DMat4::from_translation(DVec3::new(0.0, 5.0, 0.0))), rows(&bind_shape));
    // The one inverse bind matrix is written with a zero of its own.
    let nought = rows(&DMat4::from_translation(DVec3::X * -0.0));
    let text = skin.text(nodes);
    assert!(text.contains(&old) && text.contains(&nought));
    text.replace(&nought, &rows(&inverse_bind)).replace(&old, &moved)
}

#[test]
fn a_point_without_weights_keeps_to_its_bind_shape_and_goes_with_its_node_only_where_that_is_the_identity() {
    let nodes = "<node id=\"A\" sid=\"a\" type=\"JOINT\"/><node><translate>0 0 5</translate><instance_controller url=\"#c\"><skeleton>#A</skeleton></instance_controller></node>";
    for (bind, wanted) in
        [(DMat4::IDENTITY, 5.0), (DMat4::from_translation(DVec3::Z * 5.0), 5.0), (DMat4::from_translation(DVec3::Z * 2.0), 2.0)]
    {
        let points = drawn(&bound(bind, DMat4::IDENTITY, "1 1 0", nodes), 0.0);
        assert!((points[2].z - wanted).abs() < 1e-6, "{bind}: {points:?}");
        assert!((points[0].z - bind.w_axis.z as f32).abs() < 1e-6, "{bind}: {points:?}");
    }
}

#[test]
fn a_skin_and_bones_that_do_not_meet_at_rest_are_told_with_joint_and_factor() {
    let told = |text: &str| -> Option<String> {
        let loaded = load(text);
        assert!(codes(&loaded).iter().all(|code| *code == "bind-pose-mismatch") && loaded.findings.len() < 2, "{:?}", loaded.findings);
        loaded.findings.first().map(sinew::i18n::finding)
    };
    let size = |factor: f64| DMat4::from_scale(DVec3::splat(factor));
    let apart = |joint: &str| {
        format!(
            "<node id=\"A\" sid=\"a\" type=\"JOINT\">{joint}</node><node><instance_controller url=\"#c\"><skeleton>#A</skeleton></instance_controller></node>"
        )
    };
    let beneath = |above: &str, joint: &str| {
        format!(
            "<node>{above}<node id=\"A\" sid=\"a\" type=\"JOINT\">{joint}</node><node><instance_controller url=\"#c\"><skeleton>#A</skeleton></instance_controller></node></node>"
        )
    };
    let text = |ibm: f64, nodes: String| bound(DMat4::IDENTITY, size(ibm), "1 1 1", &nodes);
    // A scale in the inverse bind matrix that no node has; and one that a node has.
    let message = told(&text(10.0, apart(""))).expect("told");
    assert!(message.contains("skin") && message.contains("“a”") && message.contains("by 10"), "{message}");
    assert_eq!(told(&text(10.0, apart("<scale>0.1 0.1 0.1</scale>"))), None);
    // A rig that is scaled as a whole, or posed, takes its skin along.
    assert_eq!(told(&text(1.0, apart("<scale>3 3 3</scale>"))), None);
    assert_eq!(told(&text(1.0, apart("<rotate>1 0 0 50</rotate>"))), None);
    assert_eq!(told(&text(1.0, beneath("<scale>3 3 3</scale>", ""))), None);
    assert_eq!(told(&text(1.0, beneath("<translate>3 3 3</translate>", "<rotate>0 0 1 20</rotate>"))), None);
    // A mesh beneath the armature that its bones undo: scaled, or turned.
    let message = told(&text(100.0, beneath("<scale>0.01 0.01 0.01</scale>", ""))).expect("told");
    assert!(message.contains("“a”") && message.contains("by 100"), "{message}");
    let turned = bound(DMat4::IDENTITY, DMat4::from_rotation_x(90_f64.to_radians()), "1 1 1", &beneath("<rotate>1 0 0 -90</rotate>", ""));
    let message = told(&turned).expect("told");
    assert!(message.contains("“a”") && message.contains("90°"), "{message}");
}

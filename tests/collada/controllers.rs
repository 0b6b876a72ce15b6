//! `morph`, and chains of morphs and skins.

use glam::{DMat4, Vec3};
use sinew::scene::{Deformer, MorphId, MorphMethod, SkinId};

use crate::build::*;

/// The triangle `g` and two shapes: `high` (one unit up) and `wide` (twice as wide).
fn shapes() -> String {
    geometries(
        &(geometry("g", "0 0 0 1 0 0 0 1 0", &triangles("g", "0 1 2"))
            + &geometry("high", "0 0 1 1 0 1 0 1 1", &triangles("high", "0 1 2"))
            + &geometry("wide", "0 0 0 2 0 0 0 1 0", &triangles("wide", "0 1 2"))),
    )
}

fn morph(id: &str, source: &str, method: &str, targets: &str, weights: &str) -> String {
    format!(
        "<controller id=\"{id}\"><morph source=\"#{source}\"{method}>{}{}<targets><input semantic=\"MORPH_TARGET\" source=\"#{id}-t\"/>\
         <input semantic=\"MORPH_WEIGHT\" source=\"#{id}-w\"/></targets></morph></controller>",
        names(&format!("{id}-t"), "IDREF_array", "MORPH_TARGET", targets),
        floats(&format!("{id}-w"), "MORPH_WEIGHT", weights)
    )
}

fn skin(id: &str, source: &str) -> String {
    format!(
        "<controller id=\"{id}\"><skin source=\"#{source}\">{}{}{}<joints><input semantic=\"JOINT\" source=\"#{id}-j\"/><input semantic=\"INV_BIND_MATRIX\" \
         source=\"#{id}-m\"/></joints><vertex_weights count=\"3\"><input semantic=\"JOINT\" source=\"#{id}-j\" offset=\"0\"/><input semantic=\"WEIGHT\" \
         source=\"#{id}-w\" offset=\"1\"/><vcount>1 1 1</vcount><v>0 0 0 0 0 0</v></vertex_weights></skin></controller>",
        names(&format!("{id}-j"), "Name_array", "JOINT", "bone"),
        matrices(&format!("{id}-m"), &[DMat4::IDENTITY]),
        floats(&format!("{id}-w"), "WEIGHT", "1")
    )
}

fn with(controllers: &str, used: &str, more: &str) -> String {
    let nodes = format!("<node sid=\"bone\"/><node><instance_controller url=\"#{used}\"/></node>");
    document(&(shapes() + "<library_controllers>" + controllers + "</library_controllers>" + more + &scene(&nodes)))
}

#[test]
fn normalized_and_relative_targets_become_deltas() {
    let loaded = load_clean(&with(&morph("m", "g", "", "high wide", "0.25 0.5"), "m", ""));
    let read = &loaded.scene.morphs[0];
    assert_eq!((read.method, read.weights.as_slice()), (MorphMethod::Normalized, &[0.25, 0.5][..]));
    assert_eq!(read.targets[0].position_deltas, [Vec3::Z; 3]);
    assert_eq!(read.targets[1].position_deltas, [Vec3::ZERO, Vec3::X, Vec3::ZERO]);
    assert_eq!(read.targets[1].normal_deltas, [Vec3::ZERO; 3]);
    assert_eq!(read.targets[0].name, "high");
    // A relative target is the delta itself, however the word is written.
    for method in [" method=\"RELATIVE\"", " method=\"relative\""] {
        let loaded = load_clean(&with(&morph("m", "g", method, "wide", "1"), "m", ""));
        let read = &loaded.scene.morphs[0];
        assert_eq!(read.method, MorphMethod::Relative);
        assert_eq!(read.targets[0].position_deltas, [Vec3::ZERO, Vec3::X * 2.0, Vec3::Y]);
    }
    // The shapes are not drawn themselves.
    assert_eq!(loaded.scene.meshes.len(), 1);
}

#[test]
fn deltas_follow_the_points_when_vertices_are_split() {
    let split = shapes().replace(
        &triangles("g", "0 1 2"),
        "<triangles count=\"2\"><input semantic=\"VERTEX\" source=\"#g-v\" offset=\"0\"/><input semantic=\"NORMAL\" source=\"#high-p\" offset=\"1\"/>\
         <p>0 0 1 0 2 0 0 1 2 0 1 2</p></triangles>",
    );
    let loaded = load(&with(&morph("m", "g", "", "wide", "1"), "m", "").replace(&shapes(), &split));
    let mesh = mesh(&loaded);
    assert!(mesh.positions.len() > 3);
    for (vertex, source) in mesh.source_vertex.iter().enumerate() {
        let wanted = if *source == 1 { Vec3::X } else { Vec3::ZERO };
        assert_eq!(loaded.scene.morphs[0].targets[0].position_deltas[vertex], wanted);
    }
}

#[test]
fn targets_that_do_not_fit_keep_their_place_and_do_nothing() {
    let more = shapes().replace(
        "</library_geometries>",
        &(geometry("four", "0 0 0 1 0 0 0 1 0 5 5 5", &triangles("four", "0 1 2")) + "</library_geometries>"),
    );
    let loaded = load(&with(&morph("m", "g", "", "four lost high", "1 1 1"), "m", "").replace(&shapes(), &more));
    let mut found = codes(&loaded);
    found.sort_unstable();
    assert_eq!(found, ["broken-reference", "morph-target-mismatch"]);
    let targets = &loaded.scene.morphs[0].targets;
    assert_eq!(targets.len(), 3);
    assert!(targets[..2].iter().all(|target| target.position_deltas == [Vec3::ZERO; 3]));
    assert_eq!(targets[2].position_deltas, [Vec3::Z; 3]);
}

#[test]
fn chains_are_applied_from_the_mesh_outwards() {
    let (m, s) = (Deformer::Morph(MorphId(0)), |loaded: &sinew::collada::ColladaScene| Deformer::Skin {
        skin: SkinId(0),
        joints: joints(loaded, 0),
    });
    let on_morph = load_clean(&with(&(skin("k", "m") + &morph("m", "g", "", "high", "1")), "k", ""));
    assert_eq!(instances(&on_morph)[0].1.deformers, [m.clone(), s(&on_morph)]);
    let on_skin = load_clean(&with(&(morph("m", "k", "", "high", "1") + &skin("k", "g")), "m", ""));
    assert_eq!(instances(&on_skin)[0].1.deformers, [s(&on_skin), m.clone()]);
    let twice = load_clean(&with(&(morph("m", "n", "", "high", "1") + &morph("n", "g", "", "wide", "0")), "m", ""));
    assert_eq!(instances(&twice)[0].1.deformers, [m, Deformer::Morph(MorphId(1))]);
    assert_eq!(twice.scene.morphs[0].targets[0].name, "wide");
}

#[test]
fn weights_are_animated_by_every_address() {
    for address in ["m-w(1)", "m-w-a(1)", "m/weights(1)", "m(1)"] {
        let moves = animations(&animation("a", address, "0 1", "X", "0 1", "LINEAR LINEAR"));
        let loaded = load_clean(&with(&morph("m", "g", "", "high wide", "0 0"), "m", &moves));
        assert_eq!(pose(&loaded, 0, 0.5).morph_weights, [[0.0, 0.5]], "{address}");
    }
    // All weights at once.
    let moves = animations(&animation("a", "m-w", "0 1", "A B", "0 1 1 0", "LINEAR LINEAR"));
    let loaded = load_clean(&with(&morph("m", "g", "", "high wide", "0 0"), "m", &moves));
    assert_eq!(pose(&loaded, 0, 0.25).morph_weights, [[0.25, 0.75]]);
    let beyond = animations(&animation("a", "m-w(7)", "0 1", "X", "0 1", "LINEAR LINEAR"));
    assert_eq!(codes(&load(&with(&morph("m", "g", "", "high wide", "0 0"), "m", &beyond))), ["unknown-target"]);
}

#[test]
fn a_morph_without_targets_or_weights_is_told() {
    let loaded = load(&with(&morph("m", "g", "", "high", "1"), "m", "").replace("MORPH_TARGET\" source", "X\" source"));
    assert_eq!(codes(&loaded), ["bad-morph"]);
    assert_eq!(instances(&loaded).len(), 1);
    let loaded = load(&with(&morph("m", "g", "", "high", "1"), "m", "").replace("MORPH_WEIGHT\" source", "X\" source"));
    assert_eq!((codes(&loaded), loaded.scene.morphs[0].weights.as_slice()), (vec!["bad-morph"], &[0.0][..]));
}

#[test]
fn a_skin_over_a_skin_is_told_and_the_one_nearer_to_the_mesh_is_used() {
    let loaded = load(&with(&(skin("inner", "g") + &skin("outer", "inner")), "outer", ""));
    assert_eq!(codes(&loaded), ["second-skin"]);
    let deformers = &instances(&loaded)[0].1.deformers;
    assert!(matches!(deformers.as_slice(), [Deformer::Skin { skin: SkinId(0), .. }]));
    assert_eq!(loaded.scene.skins[0].id, "inner");
}

#[test]
fn morphs_that_share_an_array_of_targets_keep_to_their_own() {
    let text = with(&morph("m", "g", "", "high wide", "0.25 0.5"), "m", "");
    let text = text.replace("count=\"2\" stride=\"1\"", "count=\"1\" stride=\"1\"");
    let loaded = load_clean(&text);
    assert_eq!(loaded.scene.morphs[0].targets.len(), 1);
    assert_eq!(loaded.scene.morphs[0].weights, [0.25]);
}

#[test]
fn a_target_that_is_a_controller_looks_as_its_own_controllers_leave_it() {
    // Half way to `wide`, which alone would be one unit wider.
    let loaded = load_clean(&with(&(morph("m", "g", "", "half", "1") + &morph("half", "g", "", "wide", "0.5")), "m", ""));
    assert_eq!(loaded.scene.morphs[0].targets[0].position_deltas, [Vec3::ZERO, Vec3::X * 0.5, Vec3::ZERO]);
    let relative = morph("half", "g", " method=\"RELATIVE\"", "high", "0.5");
    let loaded = load_clean(&with(&(morph("m", "g", "", "half", "1") + &relative), "m", ""));
    assert_eq!(loaded.scene.morphs[0].targets[0].position_deltas, [Vec3::Z * 0.5, Vec3::new(0.5, 0.0, 0.5), Vec3::new(0.0, 0.5, 0.5)]);
    // A skin in its bind shape.
    let lifted = skin("k", "wide").replace(
        "<skin source=\"#wide\">",
        "<skin source=\"#wide\"><bind_shape_matrix>1 0 0 0 0 1 0 0 0 0 1 3 0 0 0 1</bind_shape_matrix>",
    );
    let loaded = load_clean(&with(&(morph("m", "g", "", "k high", "1 0") + &lifted), "m", ""));
    assert_eq!(loaded.scene.morphs[0].targets[0].position_deltas, [Vec3::Z * 3.0, Vec3::new(1.0, 0.0, 3.0), Vec3::Z * 3.0]);
    // One that is a target of itself, at some remove.
    let loaded =
        load(&with(&(morph("m", "g", "", "a high", "1 1") + &morph("a", "g", "", "b", "1") + &morph("b", "g", "", "a", "1")), "m", ""));
    assert_eq!(loaded.scene.morphs[0].targets[0].position_deltas, [Vec3::ZERO; 3]);
    assert_eq!(loaded.scene.morphs[0].targets[1].position_deltas, [Vec3::Z; 3]);
    assert_eq!(codes(&loaded), ["reference-cycle"]);
}

/// The morph `m` over the skin `k` (bone moved by 3 along z), on a node that makes ten of one.
fn over_skin(controllers: &str, more: &str) -> String {
    let nodes = "<node id=\"B\" sid=\"bone\"><translate sid=\"t\">0 0 3</translate></node>\
                 <node><scale>10 10 10</scale><instance_controller url=\"#m\"><skeleton>#B</skeleton></instance_controller></node>";
    document(&(shapes() + "<library_controllers>" + controllers + "</library_controllers>" + more + &scene(nodes)))
}

#[track_caller]
fn same(found: &[Vec3], wanted: [[f32; 3]; 3]) {
    assert_eq!(found.len(), 3);
    for (found, wanted) in found.iter().zip(wanted) {
        near32(*found, Vec3::from_array(wanted));
    }
}

#[test]
fn a_morph_over_a_skin_mixes_the_skinned_shape_and_goes_with_its_node() {
    // Half skinned base (z 3), half the target as it stands (z 0, twice as wide).
    let normalized = morph("m", "k", "", "wide", "0.5") + &skin("k", "g");
    same(&drawn(&over_skin(&normalized, ""), 0.0), [[0.0, 0.0, 15.0], [15.0, 0.0, 15.0], [0.0, 10.0, 15.0]]);
    // The target is added to the whole base.
    let relative = morph("m", "k", " method=\"RELATIVE\"", "wide", "0.5") + &skin("k", "g");
    same(&drawn(&over_skin(&relative, ""), 0.0), [[0.0, 0.0, 30.0], [20.0, 0.0, 30.0], [0.0, 15.0, 30.0]]);
    // A morph below the skin comes first: its shape is skinned, then mixed.
    let below = morph("m", "k", "", "wide", "0.5") + &skin("k", "n") + &morph("n", "g", "", "high", "1");
    same(&drawn(&over_skin(&below, ""), 0.0), [[0.0, 0.0, 20.0], [15.0, 0.0, 20.0], [0.0, 10.0, 20.0]]);
    // In other axes and another unit it is the same picture, turned and scaled.
    for (asset, turn) in [
        ("<unit meter=\"0.1\"/><up_axis>Z_UP</up_axis>", [[0.0, 1.5, 0.0], [1.5, 1.5, 0.0], [0.0, 1.5, -1.0]]),
        ("<unit meter=\"0.1\"/><up_axis>X_UP</up_axis>", [[0.0, 0.0, 1.5], [0.0, 1.5, 1.5], [-1.0, 0.0, 1.5]]),
    ] {
        let text = over_skin(&normalized, "").replace("<unit meter=\"1\"/><up_axis>Y_UP</up_axis>", asset);
        same(&drawn(&text, 0.0), turn);
    }
}

#[test]
fn a_target_with_a_skin_of_its_own_is_skinned_and_follows_its_joints() {
    let both = morph("m", "k", "", "l", "0.5") + &skin("k", "g") + &skin("l", "wide");
    same(&drawn(&over_skin(&both, ""), 0.0), [[0.0, 0.0, 30.0], [15.0, 0.0, 30.0], [0.0, 10.0, 30.0]]);
    let moves = animations(&animation("a", "B/t.Z", "0 1", "Z", "3 5", "LINEAR LINEAR"));
    same(&drawn(&over_skin(&both, &moves), 1.0), [[0.0, 0.0, 50.0], [15.0, 0.0, 50.0], [0.0, 10.0, 50.0]]);
    // Over plain geometry as well.
    let over_mesh = morph("m", "g", "", "l", "0.5") + &skin("l", "wide");
    same(&drawn(&over_skin(&over_mesh, ""), 0.0), [[0.0, 0.0, 15.0], [15.0, 0.0, 15.0], [0.0, 10.0, 15.0]]);
}

#[test]
fn a_morph_over_a_morph_mixes_the_morphed_shape() {
    let twice = morph("m", "n", "", "wide", "0.5") + &morph("n", "g", "", "high", "1");
    same(&drawn(&over_skin(&twice, ""), 0.0), [[0.0, 0.0, 5.0], [15.0, 0.0, 5.0], [0.0, 10.0, 5.0]]);
}

#[test]
fn the_weights_that_khronos_exporters_name_move_the_morph() {
    let extra = "<extra><technique profile=\"KHR\"><morph_weights sid=\"MORPH_WEIGHT_TO_TARGET\" count=\"2\">0.25 0</morph_weights></technique></extra>";
    for place in ["</morph></controller>", "</controller>", "</targets>"] {
        let controller = morph("m", "g", "", "high wide", "0 0").replace(place, &format!("{extra}{place}"));
        for (target, found) in [("m/MORPH_WEIGHT_TO_TARGET(1)", [0.0, 0.5]), ("m/MORPH_WEIGHT_TO_TARGET(0)", [0.5, 0.0])] {
            let moves = animations(&animation("a", target, "0 1", "W", "0 1", "LINEAR LINEAR"));
            let loaded = load_clean(&with(&controller, "m", &moves));
            assert_eq!(pose(&loaded, 0, 0.5).morph_weights, [found], "{place} {target}");
        }
        // Where no other weights are given, these are those at rest.
        let lone = controller.replace("semantic=\"MORPH_WEIGHT\"", "semantic=\"X\"");
        assert_eq!(load_clean(&with(&lone, "m", "")).scene.morphs[0].weights, [0.25, 0.0], "{place}");
    }
    let moves = animations(&animation("a", "m/MORPH_WEIGHT_TO_TARGET(1)", "0 1", "W", "0 1", "LINEAR LINEAR"));
    assert_eq!(pose(&load_clean(&with(&morph("m", "g", "", "high wide", "0 0"), "m", &moves)), 0, 0.5).morph_weights, [[0.0, 0.5]]);
}

#[test]
fn targets_may_be_named_by_url() {
    for names in ["#wide #high", "wide #high", "test.dae#wide high"] {
        for tag in ["IDREF_array", "Name_array"] {
            let loaded = load_clean(&with(&morph("m", "g", "", names, "1 0").replace("IDREF_array", tag), "m", ""));
            assert_eq!(loaded.scene.morphs[0].targets[0].position_deltas, [Vec3::ZERO, Vec3::X, Vec3::ZERO], "{names}");
        }
    }
    assert_eq!(codes(&load(&with(&morph("m", "g", "", "#nowhere", "1"), "m", ""))), ["broken-reference"]);
}

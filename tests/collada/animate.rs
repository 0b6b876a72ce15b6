//! `library_animations` and `library_animation_clips`.

use glam::{DMat4, DQuat, DVec3};
use sinew::animation::{Clip, Interpolation};
use sinew::collada::{ColladaScene, Finding};
use sinew::scene::{Label, TransformOp, Unnamed};

use crate::build::*;

const NODE: &str = "<node id=\"n\" name=\"n\"><translate sid=\"t\">1 2 3</translate><rotate sid=\"r\">0 0 1 10</rotate><scale sid=\"s\">1 1 1</scale>\
                    <matrix sid=\"m\">1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix><lookat sid=\"l\">0 0 1 0 0 0 0 1 0</lookat><skew sid=\"k\">0 0 1 0 1 0 0</skew></node>";

fn moved(animation: &str) -> String {
    document(&(animations(animation) + &scene(NODE)))
}

/// Operation `index` of the node at `time`.
#[track_caller]
fn op(loaded: &ColladaScene, index: usize, time: f64) -> TransformOp {
    let pose = pose(loaded, 0, time);
    let range = pose.ranges[node(loaded, "n").index()].clone();
    pose.ops[range.start as usize + index]
}

/// Two linear keys at 0 and 1.
fn linear(target: &str, param: &str, values: &str) -> String {
    moved(&animation("a", target, "0 1", param, values, "LINEAR LINEAR"))
}

#[test]
fn members_indices_and_whole_vectors_are_set() {
    for (target, index, wanted) in [
        ("n/t.X", 0, TransformOp::Translate(DVec3::new(5.0, 2.0, 3.0))),
        ("n/t.Z", 0, TransformOp::Translate(DVec3::new(1.0, 2.0, 5.0))),
        ("n/t(1)", 0, TransformOp::Translate(DVec3::new(1.0, 5.0, 3.0))),
        ("n/r.ANGLE", 1, TransformOp::Rotate { axis: DVec3::Z, angle: 5.0 }),
        ("n/r(3)", 1, TransformOp::Rotate { axis: DVec3::Z, angle: 5.0 }),
        ("n/r.X", 1, TransformOp::Rotate { axis: DVec3::new(5.0, 0.0, 1.0), angle: 10.0 }),
        ("n/s.Y", 2, TransformOp::Scale(DVec3::new(1.0, 5.0, 1.0))),
        ("n/l(0)", 4, TransformOp::LookAt { eye: DVec3::new(5.0, 0.0, 1.0), target: DVec3::ZERO, up: DVec3::Y }),
        ("n/l(7)", 4, TransformOp::LookAt { eye: DVec3::Z, target: DVec3::ZERO, up: DVec3::Y * 5.0 }),
        ("n/k(0)", 5, TransformOp::Skew { angle: 5.0, along: DVec3::Y, across: DVec3::X }),
    ] {
        let loaded = load_clean(&linear(target, "X", "0 10"));
        assert_eq!(op(&loaded, index, 0.5), wanted, "{target}");
    }
    let whole = load_clean(&linear("n/t", "X Y Z", "0 0 0 2 4 6"));
    assert_eq!(op(&whole, 0, 0.5), TransformOp::Translate(DVec3::new(1.0, 2.0, 3.0)));
    let whole = load_clean(&linear("n/r", "X Y Z ANGLE", "1 0 0 0 1 0 0 90"));
    assert_eq!(op(&whole, 1, 0.5), TransformOp::Rotate { axis: DVec3::X, angle: 45.0 });
}

#[test]
fn cells_of_a_matrix_are_column_then_row_and_single_indices_follow_the_text() {
    for target in ["n/m(3)(0)", "n/m(3)"] {
        let loaded = load_clean(&linear(target, "X", "0 10"));
        assert_eq!(op(&loaded, 3, 0.5), TransformOp::Matrix(DMat4::from_translation(DVec3::X * 5.0)), "{target}");
    }
    let loaded = load_clean(&linear("n/m(0)(1)", "X", "0 10"));
    let TransformOp::Matrix(matrix) = op(&loaded, 3, 0.5) else { panic!("not a matrix") };
    assert_eq!(matrix.x_axis.y, 5.0);
    // The bottom row is not the animation's to change.
    for target in ["n/m(3)(3)", "n/m(0)(3)", "n/m(15)"] {
        assert_eq!(op(&load_clean(&linear(target, "X", "0 0")), 3, 0.5), TransformOp::Matrix(DMat4::IDENTITY), "{target}");
    }
}

fn matrix_keys(times: &str, keys: &[DMat4]) -> String {
    let body = floats("t", "TIME", times)
        + &matrices("v", keys)
        + "<sampler id=\"x\"><input semantic=\"INPUT\" source=\"#t\"/><input semantic=\"OUTPUT\" source=\"#v\"/></sampler><channel source=\"#x\" target=\"n/m\"/>";
    moved(&format!("<animation>{body}</animation>"))
}

#[test]
fn whole_matrices_turn_along_the_shortest_arc() {
    let turn = |degrees: f64| DMat4::from_rotation_translation(DQuat::from_rotation_y(degrees.to_radians()), DVec3::X * degrees);
    let loaded = load_clean(&matrix_keys("0 1", &[turn(340.0), turn(20.0)]));
    let TransformOp::Matrix(matrix) = op(&loaded, 3, 0.25) else { panic!("not a matrix") };
    let mut wanted = turn(350.0);
    wanted.w_axis.x = 260.0;
    assert!(matrix.abs_diff_eq(wanted, 1e-9), "{matrix}");
    let mut sheared = DMat4::IDENTITY;
    sheared.y_axis.x = 0.5;
    let loaded = load(&matrix_keys("0 1", &[DMat4::IDENTITY, sheared]));
    assert_eq!(codes(&loaded), ["sheared-keys"]);
    let TransformOp::Matrix(matrix) = op(&loaded, 3, 0.5) else { panic!("not a matrix") };
    assert_eq!(matrix.y_axis.x, 0.25);
    let mut zeroed = DMat4::from_translation(DVec3::X);
    zeroed.w_axis.w = 0.0;
    let loaded = load_clean(&matrix_keys("0 1", &[zeroed, zeroed]));
    assert_eq!(op(&loaded, 3, 0.5), TransformOp::Matrix(DMat4::from_translation(DVec3::X)));
}

#[test]
fn angles_are_plain_numbers_so_full_turns_turn() {
    let loaded = load_clean(&linear("n/r.ANGLE", "ANGLE", "0 360"));
    assert_eq!(op(&loaded, 1, 0.5), TransformOp::Rotate { axis: DVec3::Z, angle: 180.0 });
}

#[test]
fn each_key_has_its_own_mode_and_none_means_linear() {
    let loaded = load_clean(&moved(&animation("a", "n/t.X", "0 1 2", "X", "0 10 20", "STEP LINEAR STEP")));
    let curve = &loaded.clips[0].channels[0].curve;
    assert_eq!(curve.modes, [Interpolation::Step, Interpolation::Linear, Interpolation::Step]);
    assert_eq!([curve.value(0.9, 0), curve.value(1.5, 0)], [0.0, 15.0]);
    let silent = linear("n/t.X", "X", "0 10").replace("<input semantic=\"INTERPOLATION\" source=\"#a-i\"/>", "");
    assert_eq!(load_clean(&silent).clips[0].channels[0].curve.value(0.5, 0), 5.0);
    for name in ["CARDINAL", "BSPLINE", "WHATEVER"] {
        let loaded = load(&linear("n/t.X", "X", "0 10").replace("LINEAR LINEAR", &format!("{name} {name}")));
        assert_eq!(codes(&loaded), ["unsupported-interpolation"]);
        assert_eq!(loaded.findings[0].finding, Finding::UnsupportedInterpolation(name.to_owned()));
        assert_eq!(loaded.clips[0].channels[0].curve.value(0.5, 0), 5.0);
    }
}

/// Two keys (0, 0) and (1, 1) with tangents of these params.
fn curved(mode: &str, param: &str, out: &str, arriving: &str) -> String {
    let tangents = floats("o", param, out) + &floats("i", param, arriving);
    linear("n/t.X", "X", "0 1").replace("LINEAR LINEAR", &format!("{mode} {mode}")).replace(
        "<sampler id=\"a-s\">",
        &format!(
            "{tangents}<sampler id=\"a-s\"><input semantic=\"OUT_TANGENT\" source=\"#o\"/><input semantic=\"IN_TANGENT\" source=\"#i\"/>"
        ),
    )
}

#[test]
fn bezier_solves_time_for_value() {
    // Control points (0.8, 0) and (0.9, 0.5): where x(s) = t.
    let loaded = load_clean(&curved("BEZIER", "X Y", "0.8 0 0 0", "0 0 0.9 0.5"));
    let curve = &loaded.clips[0].channels[0].curve;
    for i in 0..=20 {
        let s = f64::from(i) / 20.0;
        let r = 1.0 - s;
        let (x, y) = (3.0 * r * r * s * 0.8 + 3.0 * r * s * s * 0.9 + s.powi(3), 3.0 * r * s * s * 0.5 + s.powi(3));
        assert!((curve.value(x, 0) - y).abs() < 1e-9, "at {x}");
    }
    let thirds = load_clean(&curved("BEZIER", "X", "0 0", "0 1"));
    let s: f64 = 0.3;
    assert!((thirds.clips[0].channels[0].curve.value(s, 0) - (3.0 * 0.7 * s * s + s.powi(3))).abs() < 1e-12);
}

#[test]
fn hermite_tangents_are_vectors() {
    let loaded = load_clean(&curved("HERMITE", "X Y", "1 2 0 0", "0 0 1 0"));
    let s: f64 = 0.4;
    let wanted = 2.0 * (s.powi(3) - 2.0 * s * s + s) + 3.0 * s * s - 2.0 * s.powi(3);
    assert!((loaded.clips[0].channels[0].curve.value(s, 0) - wanted).abs() < 1e-12);
    let bare = load(&linear("n/t.X", "X", "0 10").replace("LINEAR LINEAR", "BEZIER HERMITE"));
    assert_eq!((codes(&bare), bare.clips[0].channels[0].curve.value(0.5, 0)), (vec!["missing-tangents"], 5.0));
}

#[test]
fn keys_may_be_in_any_order_repeated_single_and_early() {
    let loaded = load_clean(&moved(&animation("a", "n/t.X", "2 -1 2", "X", "5 1 6", "LINEAR LINEAR LINEAR")));
    let clip = &loaded.clips[0];
    assert_eq!((clip.start, clip.end, clip.keyframes()), (-1.0, 2.0, 3));
    assert_eq!(clip.key_times(None), [-1.0, 2.0]);
    assert_eq!(clip.key_times(Some(node(&loaded, "n"))), [-1.0, 2.0]);
    assert!(clip.key_times(Some(loaded.scene.graph.roots()[0])).is_empty());
    assert_eq!(op(&loaded, 0, 99.0), TransformOp::Translate(DVec3::new(6.0, 2.0, 3.0)));
    let single = load_clean(&moved(&animation("a", "n/t.X", "0.04", "X", "7", "LINEAR")));
    assert_eq!((single.clips[0].start, single.clips[0].duration()), (0.04, 0.0));
    assert_eq!(op(&single, 0, 0.0), TransformOp::Translate(DVec3::new(7.0, 2.0, 3.0)));
    let broken = load(&moved(&animation("a", "n/t.X", "0 NaN 2", "X", "0 5 4", "LINEAR LINEAR LINEAR")));
    assert_eq!((codes(&broken), op(&broken, 0, 1.0)), (vec!["not-finite"], TransformOp::Translate(DVec3::new(2.0, 2.0, 3.0))));
}

#[test]
fn targets_that_are_not_there_are_told_and_the_rest_moves() {
    for (target, code) in [
        ("x/t.X", "unknown-target"),
        ("n/x", "unknown-target"),
        ("n/t.ANGLE", "unknown-target"),
        ("n/t(3)", "unknown-target"),
        ("", "unknown-target"),
    ] {
        let both =
            animation("a", target, "0 1", "X", "0 10", "LINEAR LINEAR") + &animation("b", "n/t.Y", "0 1", "X", "0 10", "LINEAR LINEAR");
        let loaded = load(&moved(&both));
        assert_eq!(codes(&loaded), [code], "{target}");
        assert_eq!(loaded.clips[0].channels.len(), 1);
    }
    let camera = "<library_cameras><camera id=\"c\"><optics><technique_common><perspective><yfov sid=\"f\">40</yfov></perspective></technique_common></optics></camera></library_cameras>";
    let loaded =
        load(&(moved(&animation("a", "c/f", "0 1", "X", "0 10", "LINEAR LINEAR")).replace("<scene>", &format!("{camera}<scene>"))));
    assert_eq!(codes(&loaded), ["unsupported-target"]);
    assert!(loaded.clips.is_empty());
}

#[test]
fn paths_go_through_deeper_sids_and_prefer_nodes() {
    let nodes =
        "<node id=\"root\"><node sid=\"arm\"><node sid=\"hand\" name=\"n\"><translate sid=\"t\">0 0 0</translate></node></node></node>";
    for path in ["root/arm/hand/t.X", "root/hand/t.X", "root/t.X"] {
        let loaded = load_clean(&document(&(animations(&animation("a", path, "0 1", "X", "0 10", "LINEAR LINEAR")) + &scene(nodes))));
        assert_eq!(op(&loaded, 0, 0.5), TransformOp::Translate(DVec3::X * 5.0), "{path}");
    }
    // A camera and its node with one id, as the FBX exporter writes them.
    let camera = "<library_cameras><camera id=\"n\"><optics><technique_common><perspective><yfov>40</yfov></perspective></technique_common></optics></camera></library_cameras>";
    let loaded = load(
        &(camera.to_owned() + &linear("n/t.X", "X", "0 10"))
            .replacen(camera, "", 1)
            .replace("<library_animations>", &format!("{camera}<library_animations>")),
    );
    assert_eq!((codes(&loaded), loaded.clips.len()), (vec![], 1));
}

#[test]
fn a_transform_without_a_sid_is_found_by_its_tag() {
    let loaded = load_clean(&document(
        &(animations(&animation("a", "n/translate.X", "0 1", "X", "0 10", "LINEAR LINEAR"))
            + &scene("<node id=\"n\" name=\"n\"><translate>0 0 0</translate></node>")),
    ));
    assert_eq!(op(&loaded, 0, 0.5), TransformOp::Translate(DVec3::X * 5.0));
}

#[test]
fn the_usual_name_of_a_matrix_finds_the_only_one() {
    let text = |matrices: &str| {
        let keys: Vec<DMat4> = [0.0, 4.0].map(|x| DMat4::from_translation(DVec3::X * x)).into();
        document(&(animations(&keyed(&keys, "n/transform")) + &scene(&format!("<node id=\"n\" name=\"n\">{matrices}</node>"))))
    };
    let matrix = "<matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix>";
    let loaded = load_clean(&text(matrix));
    assert_eq!(op(&loaded, 0, 0.5), TransformOp::Matrix(DMat4::from_translation(DVec3::X * 2.0)));
    // Of two nobody knows which.
    assert_eq!(codes(&load(&text(&matrix.repeat(2)))), ["unknown-target"]);
}

/// An animation of whole matrices at 0 s and 1 s.
fn keyed(keys: &[DMat4], target: &str) -> String {
    format!(
        "<animation id=\"k\">{}{}<sampler id=\"k-s\"><input semantic=\"INPUT\" source=\"#k-t\"/><input semantic=\"OUTPUT\" source=\"#k-v\"/></sampler>\
         <channel source=\"#k-s\" target=\"{target}\"/></animation>",
        floats("k-t", "TIME", "0 1"),
        matrices("k-v", keys)
    )
}

#[test]
fn nodes_are_addressed_by_sid_or_name_where_no_id_fits_and_only_one_goes_by_it() {
    let nodes = |third: &str| {
        format!(
            "<node id=\"i\" name=\"n\" sid=\"hip\"><translate sid=\"t\">0 0 0</translate></node>\
             <node id=\"j\" sid=\"foot\" name=\"Left Foot\"><translate sid=\"t\">0 0 0</translate></node>{third}"
        )
    };
    let text = |target: &str, third: &str| {
        document(&(animations(&animation("a", target, "0 1", "X", "0 10", "LINEAR LINEAR")) + &scene(&nodes(third))))
    };
    for target in ["hip/t.X", "n/t.X"] {
        assert_eq!(op(&load_clean(&text(target, "")), 0, 0.5), TransformOp::Translate(DVec3::X * 5.0), "{target}");
    }
    assert_eq!(load_clean(&text("Left Foot/t.X", "")).clips[0].channels.len(), 1);
    // An id goes first, and what two go by is nobody's.
    let other = "<node id=\"hip\" name=\"other\"><translate sid=\"t\">0 0 0</translate></node>";
    assert_eq!(op(&load_clean(&text("hip/t.X", other)), 0, 0.5), TransformOp::Translate(DVec3::ZERO));
    let twin = "<node id=\"k\" sid=\"hip\" name=\"twin\"><translate sid=\"t\">0 0 0</translate></node>";
    assert_eq!(codes(&load(&text("hip/t.X", twin))), ["unknown-target"]);
}

#[test]
fn ids_may_have_slashes_in_them() {
    let nodes = "<node id=\"arm/left/low\" name=\"n\"><translate sid=\"t\">0 0 0</translate><node sid=\"hand\"><scale sid=\"s\">1 1 1</scale></node></node>";
    for (target, moved) in [("arm/left/low/t.X", 5.0), ("arm/left/low/hand/s.X", 0.0)] {
        let keys = animation("a", target, "0 1", "X", "0 10", "LINEAR LINEAR");
        let loaded = load_clean(&document(&(animations(&keys) + &scene(nodes))));
        assert_eq!(op(&loaded, 0, 0.5), TransformOp::Translate(DVec3::X * moved), "{target}");
    }
}

#[test]
fn keys_of_a_whole_value_give_the_one_number_that_is_addressed() {
    for (target, params, values, index, wanted) in [
        ("n/t.Y", "X Y Z", "7 0 8 9 10 11", 0, TransformOp::Translate(DVec3::new(1.0, 5.0, 3.0))),
        ("n/r.ANGLE", "X Y Z ANGLE", "0 0 1 20 0 0 1 40", 1, TransformOp::Rotate { axis: DVec3::Z, angle: 30.0 }),
        ("n/s(2)", "X Y Z", "7 7 0 9 9 10", 2, TransformOp::Scale(DVec3::new(1.0, 1.0, 5.0))),
    ] {
        let loaded = load_clean(&moved(&animation("a", target, "0 1", params, values, "LINEAR LINEAR")));
        assert_eq!(op(&loaded, index, 0.5), wanted, "{target}");
    }
    // Matrices go row by row: column 3, row 0 is number 3.
    let keys = [2.0, 4.0].map(|x| DMat4::from_translation(DVec3::new(x, 9.0, 9.0)));
    for target in ["n/m(3)(0)", "n/m(3)"] {
        let loaded = load_clean(&moved(&keyed(&keys, target)));
        assert_eq!(op(&loaded, 3, 0.5), TransformOp::Matrix(DMat4::from_translation(DVec3::X * 3.0)), "{target}");
    }
}

#[test]
fn each_sampler_means_the_sources_of_its_own_animation_where_ids_repeat() {
    let one = |target: &str, values: &str| animation("a", target, "0 1", "X", values, "LINEAR LINEAR");
    let loaded = load(&moved(&(one("n/t.X", "0 10") + &one("n/t.Y", "20 30"))));
    assert!(codes(&loaded).iter().all(|code| *code == "repeated-id"), "{:?}", codes(&loaded));
    assert_eq!(op(&loaded, 0, 0.5), TransformOp::Translate(DVec3::new(5.0, 25.0, 3.0)));
}

#[test]
fn every_instance_of_a_node_moves() {
    let library = "<library_nodes><node id=\"p\"><translate sid=\"t\">0 0 0</translate></node></library_nodes>";
    let text = document(
        &(library.to_owned()
            + &animations(&animation("a", "p/t.X", "0 1", "X", "0 10", "LINEAR LINEAR"))
            + &scene("<instance_node url=\"#p\"/><instance_node url=\"#p\"/>")),
    );
    let loaded = load_clean(&text);
    assert_eq!(loaded.clips[0].channels.len(), 2);
    let world = posed_world(&loaded, 0, 0.5);
    near(world[1].w_axis.truncate(), DVec3::X * 5.0);
    near(world[2].w_axis.truncate(), DVec3::X * 5.0);
}

#[test]
fn nested_animations_and_sources_elsewhere_make_one_clip_over_everything() {
    let inner = animation("a", "n/t.X", "0 1", "X", "0 10", "LINEAR LINEAR");
    let shared = "<animation id=\"far\"><sampler id=\"far-s\"><input semantic=\"INPUT\" source=\"#a-t\"/><input semantic=\"OUTPUT\" source=\"#a-v\"/></sampler>\
                  <channel source=\"#far-s\" target=\"n/t.Y\"/><channel source=\"#a-s\" target=\"n/t.Z\"/></animation>";
    let loaded = load_clean(&moved(&format!("<animation name=\"walk\"><animation>{inner}</animation>{shared}</animation>")));
    assert_eq!(loaded.clips.len(), 1);
    assert_eq!((loaded.clips[0].name.as_str(), loaded.clips[0].channels.len()), ("walk", 3));
    assert_eq!(op(&loaded, 0, 0.5), TransformOp::Translate(DVec3::splat(5.0)));
    let two = load_clean(&moved(&(inner + &animation("b", "n/t.Y", "1 3", "X", "0 10", "LINEAR LINEAR"))));
    assert_eq!((two.clips[0].start, two.clips[0].end), (0.0, 3.0));
    assert_eq!(two.clips[0].label(), Label::Unnamed(Unnamed::Animation));
}

#[test]
fn clips_have_their_own_stretch_and_may_overlap() {
    let both =
        animation("a", "n/t.X", "0 10", "X", "0 10", "LINEAR LINEAR") + &animation("b", "n/t.Y", "0 10", "X", "0 10", "LINEAR LINEAR");
    let clips = "<library_animation_clips><animation_clip name=\"walk\" start=\"2\" end=\"4\"><instance_animation url=\"#a\"/><instance_animation url=\"#b\"/></animation_clip>\
                 <animation_clip id=\"run\" start=\"3\"><instance_animation url=\"#b\"/></animation_clip><animation_clip name=\"none\"/></library_animation_clips>";
    let loaded = load(&document(&(animations(&both) + clips + &scene(NODE))));
    assert_eq!(codes(&loaded), ["empty-clip"]);
    let found: Vec<(&str, f64, f64, usize)> =
        loaded.clips.iter().map(|c: &Clip| (c.name.as_str(), c.start, c.end, c.channels.len())).collect();
    assert_eq!(found, [("walk", 2.0, 4.0, 2), ("run", 3.0, 10.0, 1)]);
    // Outside of the clip its ends hold.
    assert_eq!(op(&loaded, 0, 0.0), TransformOp::Translate(DVec3::new(2.0, 2.0, 3.0)));
    assert_eq!(op(&loaded, 0, 99.0), TransformOp::Translate(DVec3::new(4.0, 4.0, 3.0)));
}

#[test]
fn clips_without_a_name_are_told_by_their_place_among_those_that_move_something() {
    let both =
        animation("a", "n/t.X", "0 10", "X", "0 10", "LINEAR LINEAR") + &animation("b", "n/t.Y", "0 10", "X", "0 10", "LINEAR LINEAR");
    let clip = |url: &str| format!("<animation_clip><instance_animation url=\"#{url}\"/></animation_clip>");
    let clips = format!("<library_animation_clips>{}<animation_clip/>{}</library_animation_clips>", clip("a"), clip("b"));
    let loaded = load(&document(&(animations(&both) + &clips + &scene(NODE))));
    assert_eq!(codes(&loaded), ["empty-clip"]);
    let called: Vec<_> = loaded.clips.iter().map(Clip::label).collect();
    assert_eq!(called, [Label::Unnamed(Unnamed::Clip(1)), Label::Unnamed(Unnamed::Clip(2))]);
}

#[test]
fn samplers_that_lack_or_mix_up_their_sources_are_told() {
    let text = linear("n/t.X", "X", "0 10");
    for (from, to, code) in [
        ("semantic=\"OUTPUT\"", "semantic=\"X\"", "bad-curve"),
        ("source=\"#a-s\"", "source=\"#lost\"", "broken-reference"),
        ("target=\"n/t.X\"", "target=\"n/t\"", "bad-curve"),
        ("target=\"n/t.X\"", "target=\"n/m\"", "bad-curve"),
    ] {
        let loaded = load(&text.replace(from, to));
        assert_eq!((codes(&loaded), loaded.clips.len()), (vec![code], 0), "{to}");
    }
    let short = load(
        &text
            .replace(">0 10<", ">0 10 20<")
            .replace("count=\"2\" stride=\"1\"><param name=\"X\"", "count=\"3\" stride=\"1\"><param name=\"X\""),
    );
    assert!(codes(&short).iter().all(|code| *code == "count-mismatch") && short.clips.len() == 1, "{:?}", codes(&short));
}

#[test]
fn a_pose_depends_on_the_time_alone() {
    let keys: Vec<DMat4> =
        (0..20).map(|i| DMat4::from_rotation_y(f64::from(i) * 1.3) * DMat4::from_translation(DVec3::Y * f64::from(i))).collect();
    let times: Vec<String> = (0..20).map(|i| (f64::from(i) * 0.1).to_string()).collect();
    let loaded = load_clean(&matrix_keys(&times.join(" "), &keys));
    let mut wandering = sinew::animation::Pose::rest(&loaded.scene);
    for i in [7.0, 0.3, 1.99, 0.75, 0.1, 1.2345, -1.0, 0.0] {
        loaded.clips[0].sample(i, &mut wandering);
        assert_eq!(wandering.ops, pose(&loaded, 0, i).ops);
    }
}

#[test]
fn keys_of_one_number_on_a_whole_rotation_are_its_angle() {
    let loaded = load_clean(&linear("n/r", "ANGLE", "0 90"));
    assert_eq!(op(&loaded, 1, 0.5), TransformOp::Rotate { axis: DVec3::Z, angle: 45.0 });
    // For a vector one number is too few.
    assert_eq!(codes(&load(&linear("n/t", "X", "0 90"))), ["bad-curve"]);
}

#[test]
fn modes_in_any_case_and_addresses_with_a_hash_are_understood() {
    let loaded = load_clean(&moved(&animation("a", "#n/t.X", "0 1", "X", "0 10", "Step linear")));
    assert_eq!(op(&loaded, 0, 0.9), TransformOp::Translate(DVec3::new(0.0, 2.0, 3.0)));
}

#[test]
fn ids_with_dots_blanks_and_brackets_are_found_and_members_in_any_case() {
    // As Blender (`Bone.001`), 3ds Max (`Bip01 Head`) and hand-made files name them.
    for (id, target) in [
        ("Bone.001", "Bone.001/t.X"),
        ("Bone.X", "Bone.X/t(0)"),
        ("Bip01 Head", "Bip01 Head/t.X"),
        ("Bip01 Head", "Bip01%20Head/t.X"),
        ("arm(1)", "arm(1)/t.X"),
        ("mixamorig:Hips", "mixamorig:Hips/t.x"),
    ] {
        let nodes = format!("<node id=\"{id}\" name=\"n\"><translate sid=\"t\">0 0 0</translate></node>");
        let moves = animations(&animation("a", target, "0 1", "X", "0 10", "LINEAR LINEAR"));
        let loaded = load_clean(&document(&(moves + &scene(&nodes))));
        assert_eq!(op(&loaded, 0, 0.5), TransformOp::Translate(DVec3::X * 5.0), "{target}");
    }
}

#[test]
fn the_pivots_of_maya_are_composed_in_their_order() {
    // translate · pivot · rotate · pivot⁻¹ turns about the point (1, 0, 0).
    let nodes = "<node id=\"n\" name=\"n\"><translate sid=\"translate\">0 0 5</translate><translate sid=\"rotatePivot\">1 0 0</translate>\
                 <rotate sid=\"rotateZ\">0 0 1 0</rotate><rotate sid=\"rotateY\">0 1 0 0</rotate><rotate sid=\"rotateX\">1 0 0 0</rotate>\
                 <translate sid=\"rotatePivotInverse\">-1 0 0</translate></node>";
    let moves = animations(&animation("a", "n/rotateZ.ANGLE", "0 1", "ANGLE", "0 90", "LINEAR LINEAR"));
    let loaded = load_clean(&document(&(moves + &scene(nodes))));
    let world = posed_world(&loaded, 0, 1.0)[node(&loaded, "n").index()];
    near(world.transform_point3(DVec3::X), DVec3::new(1.0, 0.0, 5.0));
    near(world.transform_point3(DVec3::X * 2.0), DVec3::new(1.0, 1.0, 5.0));
}

#[test]
fn of_several_scenes_that_repeat_ids_the_one_that_is_shown_moves() {
    let other = "<library_visual_scenes><visual_scene id=\"other\"><node id=\"n\"><translate sid=\"t\">9 9 9</translate></node></visual_scene></library_visual_scenes>";
    let text = moved(&animation("a", "n/t.X", "0 1", "X", "0 10", "LINEAR LINEAR")).replacen("<library_", &format!("{other}<library_"), 1);
    let loaded = load(&text);
    assert_eq!(codes(&loaded), ["repeated-id"]);
    assert!(matches!(op(&loaded, 0, 0.5), TransformOp::Translate(by) if by.x == 5.0));
}

#[test]
fn channels_of_one_program_alone_move_nothing() {
    let hidden = animation("b", "n/t.X", "0 1", "X", "0 90", "LINEAR LINEAR");
    let all = animation("a", "n/t.X", "0 1", "X", "0 10", "LINEAR LINEAR")
        + &format!("<animation id=\"c\"><extra><technique profile=\"OTHER\">{hidden}</technique></extra></animation>");
    let loaded = load_clean(&moved(&all));
    assert_eq!(loaded.clips[0].channels.len(), 1);
}

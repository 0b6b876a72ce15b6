//! Headers, encodings, references, numbers: the document as a whole.

use glam::DVec3;
use sinew::collada::{Finding, ReadErrorKind, read};
use sinew::i18n::Sentence;
use sinew::progress::Progress;
use sinew::scene::{Label, Unnamed};

use crate::build::*;

fn shown() -> String {
    triangle() + &scene("<node name=\"n\"><instance_geometry url=\"#g\"/></node>")
}

#[test]
fn three_versions_are_read_without_a_word_and_others_with_one() {
    for version in ["1.4.0", "1.4.1", "1.5.0"] {
        let loaded = load_clean(&headed(version, "<asset><unit meter=\"1\"/><up_axis>Y_UP</up_axis></asset>", &shown()));
        assert_eq!(loaded.asset.version, version);
        assert_eq!(mesh(&loaded).triangles.len(), 1);
    }
    assert_eq!(codes(&load(&headed("1.3.0", "", &shown()))), ["unknown-version"]);
}

#[test]
fn any_namespace_prefix_will_do() {
    let text = document(&shown());
    let prefixed =
        text.replace("</", "</c:").replace('<', "<c:").replace("<c:/c:", "</c:").replace("<c:?", "<?").replace("xmlns=", "xmlns:c=");
    let loaded = load_clean(&prefixed);
    assert_eq!(corners(mesh(&loaded)), corners(mesh(&load_clean(&text))));
}

#[test]
fn prefixes_that_nobody_declares_are_passed_over() {
    let text = document(&shown())
        .replace("<COLLADA ", "<COLLADA xsi:schemaLocation=\"a b:c\" ")
        .replace("<library_geometries>", "<library_geometries>\n<extra><my:thing my:kind=\"x\"/></extra>");
    let loaded = load(&text);
    assert_eq!(codes(&loaded), ["undeclared-prefix", "undeclared-prefix"]);
    let line_of = |what: &str| text.get(..text.find(what).unwrap_or_default()).map(|before| before.lines().count() as u32);
    let lines: Vec<Option<u32>> = loaded.findings.iter().map(|finding| finding.line).collect();
    assert_eq!(lines, [line_of("xsi:"), line_of("my:thing")]);
    assert_eq!(mesh(&loaded).triangles.len(), 1);
}

#[test]
fn marks_utf16_and_windows_line_ends_change_nothing() {
    let text = document(&shown()).replace("name=\"n\"", "name=\"Schräg и криво\"");
    let wanted = corners(mesh(&load_clean(&text)));
    let mut marked = vec![0xEF, 0xBB, 0xBF];
    marked.extend(text.as_bytes());
    let little: Vec<u8> = [0xFF, 0xFE].into_iter().chain(text.encode_utf16().flat_map(u16::to_le_bytes)).collect();
    let big: Vec<u8> = [0xFE, 0xFF].into_iter().chain(text.encode_utf16().flat_map(u16::to_be_bytes)).collect();
    let windows = text.replace('\n', "\r\n").into_bytes();
    for bytes in [marked, little, big, windows] {
        let loaded = read(&bytes, "test.dae", &Progress::default()).expect("readable");
        assert!(loaded.findings.is_empty(), "{:?}", loaded.findings);
        assert_eq!(corners(mesh(&loaded)), wanted);
        assert!(loaded.scene.graph.find("Schräg и криво").is_some());
    }
}

#[test]
fn zeros_behind_the_document_are_no_part_of_it() {
    for zeros in ["\0", "\n\0\0\0"] {
        load_clean(&(document(&shown()) + zeros));
    }
    assert!(try_load(&document(&shown()).replace("<p>", "<p>\0")).is_err());
}

#[test]
fn lines_are_those_of_the_file_whatever_its_line_ends() {
    let text = document(&shown()).replace("<p>0 1 2</p>", "\n\n<p>0 1 9</p>");
    let line = text.lines().position(|line| line.contains("<triangles")).expect("it is there") as u32 + 1;
    for text in [text.clone(), text.replace('\n', "\r\n"), format!("\n\n{text}")] {
        let loaded = load(&text);
        assert_eq!(codes(&loaded), ["index-out-of-range"]);
        let before = u32::from(text.starts_with('\n')) * 2;
        assert_eq!(loaded.findings[0].line, Some(line + before));
        assert_eq!(loaded.findings[0].element.to_string(), "<triangles> in <geometry> \"g\"");
    }
}

#[test]
fn unit_and_axis_are_applied_last_and_default_to_a_metre_and_y_up() {
    let at = "<node name=\"n\"><translate>1 2 3</translate></node>";
    for (asset, wanted) in [
        ("", DVec3::new(1.0, 2.0, 3.0)),
        ("<asset/>", DVec3::new(1.0, 2.0, 3.0)),
        ("<asset><unit meter=\"0.01\"/><up_axis>Z_UP</up_axis></asset>", DVec3::new(0.01, 0.03, -0.02)),
        ("<asset><unit meter=\" 2 \"/><up_axis> X_UP\n</up_axis></asset>", DVec3::new(-4.0, 2.0, 6.0)),
    ] {
        let loaded = load_clean(&headed("1.4.1", asset, &scene(at)));
        near(rest_world(&loaded)[node(&loaded, "n").index()].w_axis.truncate(), wanted);
        assert_eq!(loaded.scene.graph.roots().len(), 1);
    }
    let odd = load(&headed("1.4.1", "<asset><unit meter=\"-1\"/><up_axis>UP</up_axis></asset>", &scene(at)));
    assert_eq!(codes(&odd), ["bad-unit", "bad-up-axis"]);
    assert_eq!((odd.asset.unit_metres, odd.asset.up_axis.as_str()), (1.0, "Y_UP"));
}

#[test]
fn an_asset_on_an_element_holds_for_that_element() {
    let own = "<asset><unit meter=\"10\"/><up_axis>Z_UP</up_axis></asset>";
    let nodes = format!(
        "<node name=\"outer\">{own}<translate>1 2 3</translate><instance_geometry url=\"#g\"/><node name=\"inner\"><translate>0 0 1</translate></node></node>"
    );
    let loaded = load_clean(&document(&(triangle() + &scene(&nodes))));
    let world = rest_world(&loaded);
    // (1, 2, 3) in tens of metres, Z up; what hangs on the node keeps the document's own metres.
    near(world[node(&loaded, "outer").index()].transform_point3(DVec3::X), DVec3::new(11.0, 30.0, -20.0));
    near(world[node(&loaded, "inner").index()].w_axis.truncate(), DVec3::new(10.0, 40.0, -20.0));
    let in_geometry = triangle().replace("<mesh>", &format!("{own}<mesh>"));
    let loaded = load_clean(&document(&(in_geometry + &scene("<node><instance_geometry url=\"#g\"/></node>"))));
    assert_eq!(corners(mesh(&loaded)), [[[0.0, 0.0, 0.0], [10.0, 0.0, 0.0], [0.0, 0.0, -10.0]]]);
    near32(mesh(&loaded).normals[0], glam::Vec3::Y);
    let quiet = document(&shown()).replace("<mesh>", "<asset><contributor/></asset><mesh>");
    assert_eq!(corners(mesh(&load_clean(&quiet)))[0][1], [1.0, 0.0, 0.0]);
}

#[test]
fn libraries_repeat_and_come_in_any_order() {
    let second = geometries(&geometry("h", "0 0 5 1 0 5 0 1 5", &triangles("h", "0 1 2")));
    let nodes = scene("<node><instance_geometry url=\"#g\"/><instance_geometry url=\"#h\"/></node>");
    let loaded = load_clean(&document(&(nodes + &second + &triangle())));
    assert_eq!(loaded.scene.meshes.len(), 2);
    assert_eq!(instances(&loaded).len(), 2);
}

#[test]
fn ids_and_names_may_be_missing() {
    let loaded = load_clean(&document(&(triangle() + &scene("<node><node/><instance_geometry url=\"#g\"/></node>"))));
    let called: Vec<_> = loaded.scene.graph.iter().map(|(id, _)| loaded.scene.graph.label(id)).collect();
    let unnamed = |number| Label::Unnamed(Unnamed::Node(number));
    assert_eq!(called, [Label::Name("test"), unnamed(1), unnamed(2)]);
}

#[test]
fn urls_are_relative_absolute_or_percent_encoded() {
    for url in ["#g", "test.dae#g", "./test.dae#g", "file:///C:/models/test.dae#g", "g"] {
        load_clean(&document(&shown()).replace("url=\"#g\"", &format!("url=\"{url}\"")));
    }
    let blank = document(&shown()).replace("id=\"g\"", "id=\"a g\"").replace("url=\"#g\"", "url=\"#a%20g\"");
    assert_eq!(mesh(&load_clean(&blank)).triangles.len(), 1);
}

#[test]
fn references_to_other_files_and_to_nothing_are_named() {
    let loaded = load(&document(&shown()).replace("url=\"#g\"", "url=\"parts/wheel.dae#rim\""));
    assert_eq!(codes(&loaded), ["external-reference"]);
    assert_eq!(loaded.findings[0].finding, Finding::ExternalReference("parts/wheel.dae".to_owned()));
    let loaded = load(&document(&shown()).replace("url=\"#g\"", "url=\"#nothing\""));
    assert_eq!(codes(&loaded), ["broken-reference"]);
    assert_eq!(loaded.findings[0].finding, Finding::BrokenReference("#nothing".to_owned()));
    let loaded = load(&document(&shown()).replace("url=\"#g\"", "url=\"#s\""));
    assert_eq!(loaded.findings[0].finding, Finding::WrongReference { target: "#s".to_owned(), tag: "visual_scene".to_owned() });
}

#[test]
fn ids_that_repeat_are_told_once_and_only_where_a_reference_has_to_choose() {
    let text = document(&(triangle() + &scene("<node id=\"g\" name=\"n\"><instance_geometry url=\"#g\"/></node>")));
    // A mesh and a node are two things.
    assert_eq!(mesh(&load_clean(&text)).triangles.len(), 1);
    let twins = geometry("g", "0 0 0 2 0 0 0 2 0", "").repeat(3);
    let text = document(&(triangle() + &geometries(&twins) + &scene("<node><instance_geometry url=\"#g\"/></node>")));
    let loaded = load(&text);
    assert_eq!(codes(&loaded), ["repeated-id"]);
    assert_eq!(loaded.findings[0].more_places, 2);
    load_clean(&text.replace("<instance_geometry url=\"#g\"/>", ""));
}

#[test]
fn numbers_are_read_however_they_are_written() {
    let odd = document(&shown()).replace("0 0 0 1 0 0 0 1 0", "\n\t 0.0 -0 +0\r\n1e0 0E+5   0. .0 1.0e-0 <!-- half way --> 00 ");
    assert_eq!(corners(mesh(&load_clean(&odd))), [[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]]);
    let infinite = load(&document(&shown()).replace("0 0 0 1 0 0 0 1 0", "NaN 0 0 INF 0 0 0 -INF 0"));
    assert_eq!(codes(&infinite), ["not-finite"]);
    let worded = load(&document(&shown()).replace("0 0 0 1 0 0 0 1 0", "zero 0 0 1 0 0 0 1 0"));
    assert_eq!(codes(&worded), ["bad-number"]);
    assert_eq!(worded.findings[0].finding, Finding::BadNumbers { count: 1, first: "zero".to_owned() });
}

#[test]
fn arrays_of_truths_and_words_are_known_and_are_no_numbers() {
    for (tag, values) in [("bool_array", "true false 1 0"), ("Name_array", "a b"), ("IDREF_array", "n g"), ("SIDREF_array", "n/t n")] {
        let beside = document(&shown()).replace("<vertices", &(names("more", tag, "ON", values) + "<vertices"));
        assert_eq!(corners(mesh(&load_clean(&beside))).len(), 1, "{tag}");
        let instead = beside.replace("semantic=\"POSITION\" source=\"#g-p\"", "semantic=\"POSITION\" source=\"#more\"");
        let loaded = load(&instead);
        assert!(codes(&loaded).contains(&"no-positions"), "{tag}: {:?}", codes(&loaded));
    }
}

#[test]
fn decimal_commas_are_points_and_are_told_once() {
    let text = document(&shown()).replace("0 0 0 1 0 0 0 1 0", "0,0 0 0\n1 0,5 0 0 1e0 -0,25");
    let text =
        text.replace("meter=\"1\"", "meter=\"0,01\"").replace("<instance_geometry", "<translate>1,5 0 0</translate><instance_geometry");
    let loaded = load(&text);
    assert_eq!(codes(&loaded), ["decimal-comma"]);
    assert_eq!(loaded.asset.unit_metres, 0.01);
    assert_eq!(corners(mesh(&loaded)), [[[0.0, 0.0, 0.0], [1.0, 0.5, 0.0], [0.0, 1.0, -0.25]]]);
}

#[test]
fn commas_between_numbers_are_refused_with_their_line() {
    for numbers in ["0 0 0\n1,0,5 0 0 1 0", "0 0 0\n1, 0.5 0 0 1 0", "0 0 0\n1.5,0 0 0 1 0", "0,5 0 0\n1 ,0 0 0 1 0"] {
        let text = document(&shown()).replace("0 0 0 1 0 0 0 1 0", numbers);
        let entry = numbers.lines().last().and_then(|line| line.split(' ').find(|entry| entry.contains(','))).expect("it is there");
        let line =
            text.lines().position(|line| line.starts_with(entry) || line.contains(&format!(" {entry}"))).expect("it is there") as u32 + 1;
        let error = try_load(&text).expect_err("refused");
        assert_eq!(error.line, Some(line), "{numbers}");
        let ReadErrorKind::CommaSeparated { element, entry: found } = &error.kind else { panic!("{error}") };
        assert!(found == entry && element.contains("g-p-a"), "{error}");
    }
    assert!(try_load(&document(&shown()).replace("<p>0 1 2</p>", "<p>0,1,2</p>")).is_err());
}

#[test]
fn counts_that_lie_are_told_and_the_data_win() {
    for (from, to, wanted) in [
        ("count=\"9\"", "count=\"7\"", "count-mismatch"),
        ("count=\"9\"", "count=\"4000000000\"", "count-mismatch"),
        ("count=\"3\" stride", "count=\"4000000000\" stride", "count-mismatch"),
        ("count=\"3\" stride", "count=\"2\" stride", "count-mismatch"),
        ("<triangles count=\"1\"", "<triangles count=\"99999999999999999999999\"", ""),
        ("<triangles count=\"1\"", "<triangles count=\"5\"", "count-mismatch"),
    ] {
        let text = document(&shown());
        assert!(text.contains(from));
        let loaded = load(&text.replace(from, to));
        assert_eq!(codes(&loaded).join(" "), wanted, "{from} -> {to}");
        assert_eq!(mesh(&loaded).triangles.len(), 1);
        assert_eq!(mesh(&loaded).source_count, 3);
    }
}

#[test]
fn kinematics_and_formulas_are_named() {
    let body = "<library_formulas><formula id=\"f\"/></library_formulas><library_joints><joint id=\"j\"/></library_joints><library_kinematics_models/>";
    let loaded = load(&document(&(body.to_owned() + &shown())));
    assert_eq!(codes(&loaded), ["unsupported-element", "unsupported-element"]);
    assert_eq!(loaded.findings[0].finding, Finding::UnsupportedElement("library_formulas".to_owned()));
}

#[test]
fn what_is_no_collada_is_refused_plainly() {
    let wrong_tag = ReadErrorKind::WrongCloseTag { expected: "asset".to_owned(), actual: "COLLADA".to_owned() };
    for (text, kind, part) in [
        ("", ReadErrorKind::NotXml, "XML"),
        ("hello", ReadErrorKind::NotXml, "XML"),
        ("<html><body/></html>", ReadErrorKind::NotCollada("html".to_owned()), "<html>"),
        ("<COLLADA version=\"1.4.1\"><asset></COLLADA>", wrong_tag, "asset"),
        ("<COLLADA version=\"1.4.1\"><asset>", ReadErrorKind::CutShort, "truncated"),
    ] {
        let error = try_load(text).expect_err("refused");
        assert_eq!(error.kind, kind, "{text}");
        assert!(error.sentence().contains(part), "{text}: {error}");
    }
    assert_eq!(load("<COLLADA version=\"1.4.1\"/>").scene.graph.len(), 1);
}

#[test]
fn reading_stops_when_asked_and_says_how_far_it_is() {
    let progress = Progress::default();
    read(document(&shown()).as_bytes(), "test.dae", &progress).expect("readable");
    assert_eq!(progress.share(), 1.0);
    progress.cancel();
    assert!(read(document(&shown()).as_bytes(), "test.dae", &progress).is_err());
}

/// A document in which node `n` moves to x = 8 in two keys, with these counts on the arrays and accessors of the times and values.
fn counted(arrays: [usize; 2], accessors: [usize; 2]) -> String {
    let source = |id: &str, values: &str, array: usize, accessor: usize| {
        format!(
            "<source id=\"{id}\"><float_array id=\"{id}-a\" count=\"{array}\">{values}</float_array><technique_common><accessor source=\"#{id}-a\" \
             count=\"{accessor}\" stride=\"1\"><param name=\"X\" type=\"float\"/></accessor></technique_common></source>"
        )
    };
    let sources = source("t", "0 1", arrays[0], accessors[0]) + &source("v", "0 8", arrays[1], accessors[1]);
    let moves = format!(
        "<animation>{sources}<sampler id=\"s1\"><input semantic=\"INPUT\" source=\"#t\"/><input semantic=\"OUTPUT\" source=\"#v\"/></sampler>\
         <channel source=\"#s1\" target=\"n/t.X\"/></animation>"
    );
    document(&(animations(&moves) + &scene("<node id=\"n\" name=\"n\"><translate sid=\"t\">0 0 0</translate></node>")))
}

#[test]
fn keys_are_all_there_whatever_the_counts_say() {
    for (arrays, accessors, findings) in [
        ([2, 2], [2, 2], 0),
        ([2, 2], [0, 0], 2),
        ([2, 2], [9, 9], 2),
        ([0, 0], [0, 0], 2),
        ([1, 1], [1, 1], 2),
        ([9, 9], [9, 9], 2),
        ([2, 2], [1, 2], 1),
        ([2, 2], [2, 1], 1),
    ] {
        let loaded = load(&counted(arrays, accessors));
        near(posed_world(&loaded, 0, 1.0)[node(&loaded, "n").index()].w_axis.truncate(), DVec3::X * 8.0);
        // However many counts of one animation lie, it is told once.
        assert_eq!(codes(&loaded), vec!["count-mismatch"; findings.min(1)], "{arrays:?} {accessors:?}");
    }
}

#[test]
fn accessors_that_share_an_array_keep_to_their_own_part_of_it() {
    let moves = "<animation><source id=\"t\"><float_array id=\"all\" count=\"5\">0 1 0 8 99</float_array><technique_common><accessor source=\"#all\" count=\"2\" stride=\"1\">\
                 <param name=\"TIME\" type=\"float\"/></accessor></technique_common></source><source id=\"v\"><technique_common><accessor source=\"#all\" offset=\"2\" count=\"2\" stride=\"1\">\
                 <param name=\"X\" type=\"float\"/></accessor></technique_common></source><sampler id=\"s1\"><input semantic=\"INPUT\" source=\"#t\"/><input semantic=\"OUTPUT\" source=\"#v\"/></sampler>\
                 <channel source=\"#s1\" target=\"n/t.X\"/></animation>";
    let loaded =
        load_clean(&document(&(animations(moves) + &scene("<node id=\"n\" name=\"n\"><translate sid=\"t\">0 0 0</translate></node>"))));
    assert_eq!((loaded.clips[0].start, loaded.clips[0].end, loaded.clips[0].keyframes()), (0.0, 1.0, 2));
    near(posed_world(&loaded, 0, 0.5)[node(&loaded, "n").index()].w_axis.truncate(), DVec3::X * 4.0);
}

#[test]
fn a_stride_smaller_than_its_params_is_told_and_the_params_win() {
    let matrix = "<node id=\"n\" name=\"n\"><matrix sid=\"m\">1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix></node>";
    let keys = [glam::DMat4::IDENTITY, glam::DMat4::from_translation(DVec3::Y)];
    let moves = format!(
        "<animation>{}{}<sampler id=\"s1\"><input semantic=\"INPUT\" source=\"#t\"/><input semantic=\"OUTPUT\" source=\"#v\"/></sampler><channel source=\"#s1\" target=\"n/m\"/></animation>",
        floats("t", "TIME", "0 1"),
        matrices("v", &keys)
    );
    let text = document(&(animations(&moves) + &scene(matrix)));
    for (from, to, told) in [
        ("count=\"2\"><param name=\"TRANSFORM\"", "count=\"2\" stride=\"1\"><param name=\"TRANSFORM\"", 1),
        (
            "count=\"2\"><param name=\"TRANSFORM\" type=\"float4x4\"",
            "count=\"2\" stride=\"16\"><param name=\"TRANSFORM\" type=\"float\"",
            0,
        ),
        ("count=\"2\"><param name=\"TRANSFORM\" type=\"float4x4\"/>", "count=\"2\" stride=\"16\">", 0),
    ] {
        assert!(text.contains(from));
        let loaded = load(&text.replace(from, to));
        near(posed_world(&loaded, 0, 1.0)[node(&loaded, "n").index()].w_axis.truncate(), DVec3::Y);
        assert_eq!(codes(&loaded), vec!["count-mismatch"; told], "{to}");
    }
}

#[test]
fn a_document_with_nothing_in_it_says_so() {
    let loaded = load("<COLLADA version=\"1.4.1\"><library_lights/></COLLADA>");
    assert_eq!(codes(&loaded), ["no-scene"]);
    assert_eq!(loaded.findings[0].line, Some(1));
}

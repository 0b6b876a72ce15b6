//! `library_geometries`.

use glam::{Vec2, Vec3, Vec4};
use sinew::collada::{ColladaScene, Finding};

use crate::build::*;

/// A mesh of `points` with these primitives, shown once.
fn shown(points: &str, primitives: &str) -> String {
    document(&(geometries(&geometry("g", points, primitives)) + &scene("<node><instance_geometry url=\"#g\"/></node>")))
}

/// A mesh with further sources before its vertices.
fn with_sources(points: &str, sources: &str, primitives: &str) -> String {
    shown(points, primitives).replace("<mesh>", &format!("<mesh>{sources}"))
}

const VERTEX: &str = "<input semantic=\"VERTEX\" source=\"#g-v\" offset=\"0\"/>";
const SQUARE: &str = "0 0 0 1 0 0 1 1 0 0 1 0";

#[test]
fn accessors_walk_by_offset_and_stride_and_leave_out_what_has_no_name() {
    let text = shown("9 0 0 0 7 1 0 0 7 0 1 0 7", &triangles("g", "0 1 2"));
    let accessor = "count=\"4\" stride=\"3\">";
    assert!(text.contains(accessor));
    let offset = text.replace(accessor, "count=\"3\" stride=\"4\" offset=\"1\">");
    assert_eq!(corners(mesh(&load_clean(&offset))), [[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]]);
    let text = shown("0 7 0 0 1 7 0 0 0 7 1 0", &triangles("g", "0 1 2"));
    let named = "<param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/><param name=\"Z\" type=\"float\"/>";
    let skipping =
        "<param name=\"X\" type=\"float\"/><param type=\"float\"/><param name=\"Y\" type=\"float\"/><param name=\"Z\" type=\"float\"/>";
    let skipped = text.replace(accessor, "count=\"3\" stride=\"4\">").replace(named, skipping);
    assert_eq!(corners(mesh(&load_clean(&skipped))), [[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]]);
    // Without any name all numbers count, and without a stride the params tell it.
    let plain = shown("0 0 0 1 0 0 0 1 0", &triangles("g", "0 1 2"))
        .replace(" stride=\"3\"", "")
        .replace(named, &"<param type=\"float\"/>".repeat(3));
    assert_eq!(corners(mesh(&load_clean(&plain))), [[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]]);
}

#[test]
fn vertices_may_bring_normals_and_texture_coordinates() {
    let sources = floats("n", "X Y Z", "0 0 2 0 0 2 0 0 2") + &floats("t", "S T", "0 0 1 0 0 1");
    let text = with_sources("0 0 0 1 0 0 0 1 0", &sources, &triangles("g", "0 1 2"))
        .replace("</vertices>", "<input semantic=\"NORMAL\" source=\"#n\"/><input semantic=\"TEXCOORD\" source=\"#t\"/></vertices>");
    let loaded = load_clean(&text);
    let mesh = mesh(&loaded);
    assert_eq!(mesh.normals, [Vec3::Z; 3]);
    assert_eq!(mesh.uv_sets, [[Vec2::ZERO, Vec2::X, Vec2::Y]]);
}

#[test]
fn every_primitive_gives_its_triangles() {
    let points = "0 0 0 1 0 0 1 1 0 0 1 0 -1 1 0 -1 0 0";
    for (primitive, wanted) in [
        (format!("<triangles count=\"2\">{VERTEX}<p>0 1 2</p><p>0 2 3</p></triangles>"), vec![[0, 1, 2], [0, 2, 3]]),
        (format!("<trifans count=\"1\">{VERTEX}<p>0 1 2 3 4</p></trifans>"), vec![[0, 1, 2], [0, 2, 3], [0, 3, 4]]),
        (format!("<trifans count=\"2\">{VERTEX}<p>0 1 2</p><p>0 3 4</p></trifans>"), vec![[0, 1, 2], [0, 3, 4]]),
        (format!("<tristrips count=\"2\">{VERTEX}<p>0 1 3 2</p><p>5 0 4</p></tristrips>"), vec![[0, 1, 3], [3, 1, 2], [5, 0, 4]]),
        (
            format!("<polylist count=\"2\">{VERTEX}<vcount>4 3</vcount><p>0 1 2 3 0 3 4</p></polylist>"),
            vec![[0, 1, 2], [0, 2, 3], [0, 3, 4]],
        ),
        (
            format!("<polygons count=\"2\">{VERTEX}<p>0 1 2 3</p><p>0 3 4 5</p></polygons>"),
            vec![[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]],
        ),
    ] {
        let loaded = load_clean(&shown(points, &primitive));
        let mesh = mesh(&loaded);
        let found: Vec<[u32; 3]> = mesh.triangles.iter().map(|t| t.map(|v| mesh.source_vertex[v as usize])).collect();
        // A triangle may start at any of its corners.
        let turned = |t: &[u32; 3]| (0..3).map(|i| [t[i], t[(i + 1) % 3], t[(i + 2) % 3]]).min().expect("three");
        assert_eq!(found.iter().map(turned).collect::<Vec<_>>(), wanted.iter().map(turned).collect::<Vec<_>>(), "{primitive}");
    }
}

#[test]
fn lines_and_line_strips_are_kept_as_lines() {
    let both = format!("<lines count=\"1\">{VERTEX}<p>0 1</p></lines><linestrips count=\"2\">{VERTEX}<p>0 1 2</p><p>2 3</p></linestrips>");
    let loaded = load_clean(&shown(SQUARE, &both));
    let mesh = mesh(&loaded);
    let found: Vec<[u32; 2]> = mesh.lines.iter().map(|l| l.map(|v| mesh.source_vertex[v as usize])).collect();
    assert_eq!(found, [[0, 1], [0, 1], [1, 2], [2, 3]]);
    assert_eq!((mesh.parts[0].lines.clone(), mesh.parts[1].lines.clone()), (0..1, 1..4));
    assert!(mesh.triangles.is_empty());
}

#[test]
fn holes_stay_holes() {
    let points = "0 0 0 4 0 0 4 4 0 0 4 0 1 1 0 2 1 0 2 2 0 1 2 0";
    let ph = format!("<polygons count=\"1\">{VERTEX}<ph><p>0 1 2 3</p><h>4 5 6 7</h></ph></polygons>");
    let loaded = load_clean(&shown(points, &ph));
    assert!((area(mesh(&loaded)) - 15.0).abs() < 1e-5);
}

#[test]
fn concave_polygons_are_not_fans() {
    // A star of 66 corners, once as one polygon of a list, once alone.
    let mut points = String::new();
    for i in 0..66 {
        let (angle, radius) = (f64::from(i) / 66.0 * std::f64::consts::TAU, if i % 2 == 0 { 2.0 } else { 1.0 });
        points += &format!("{} {} 0 ", angle.cos() * radius, angle.sin() * radius);
    }
    let order: Vec<String> = (0..66).map(|i| i.to_string()).collect();
    // Half the sum of r_i r_{i+1} sin(2π/66).
    let wanted = (66.0 * 2.0 * (std::f64::consts::TAU / 66.0).sin() / 2.0) as f32;
    for primitive in [
        format!("<polylist count=\"1\">{VERTEX}<vcount>66</vcount><p>{}</p></polylist>", order.join(" ")),
        format!("<polygons count=\"1\">{VERTEX}<p>{}</p></polygons>", order.join(" ")),
    ] {
        let loaded = load_clean(&shown(&points, &primitive));
        assert_eq!(mesh(&loaded).triangles.len(), 64);
        assert!((area(mesh(&loaded)) - wanted).abs() < 1e-4);
        assert!(mesh(&loaded).normals.iter().all(|normal| normal.z > 0.999));
    }
}

#[test]
fn corners_share_offsets_and_unused_offsets_count_for_the_stride() {
    let sources = floats("n", "X Y Z", "0 0 1 0 0 -1") + &floats("t", "S T", "0 0 1 0 1 1") + &floats("c", "R G B", "1 0 0 0 1 0");
    let primitive = format!(
        "<triangles material=\"m\" count=\"1\">{VERTEX}<input semantic=\"NORMAL\" source=\"#n\" offset=\"1\"/><input semantic=\"COLOR\" source=\"#c\" offset=\"1\"/>\
         <input semantic=\"TEXCOORD\" source=\"#t\" offset=\"0\" set=\"3\"/><input semantic=\"TEXTANGENT\" source=\"#n\" offset=\"4\"/>\
         <p>0 0 9 9 0  1 1 9 9 0  2 0 9 9 0</p></triangles>"
    );
    let loaded = load_clean(&with_sources("0 0 0 1 0 0 0 1 0", &sources, &primitive));
    let mesh = mesh(&loaded);
    assert_eq!(mesh.normals, [Vec3::Z, Vec3::NEG_Z, Vec3::Z]);
    assert_eq!(mesh.colors, [Vec4::new(1.0, 0.0, 0.0, 1.0), Vec4::new(0.0, 1.0, 0.0, 1.0), Vec4::new(1.0, 0.0, 0.0, 1.0)]);
    assert_eq!(mesh.uv_sets, [[Vec2::ZERO, Vec2::X, Vec2::ONE]]);
    assert_eq!(mesh.parts[0].symbol, "m");
}

#[test]
fn points_are_split_where_their_values_differ_and_only_there() {
    let sources = floats("n", "X Y Z", "0 0 1 1 0 0");
    let primitive = format!(
        "<triangles count=\"2\">{VERTEX}<input semantic=\"NORMAL\" source=\"#n\" offset=\"1\"/><p>0 0 1 0 2 0  0 0 2 1 3 0</p></triangles>"
    );
    let loaded = load_clean(&with_sources(SQUARE, &sources, &primitive));
    let mesh = mesh(&loaded);
    assert_eq!(mesh.source_vertex, [0, 1, 2, 2, 3]);
    assert_eq!(mesh.triangles, [[0, 1, 2], [0, 3, 4]]);
    assert_eq!(mesh.source_count, 4);
}

#[test]
fn a_point_with_many_combinations_is_split_right_and_fast() {
    // One point with 20,000 different normals, each used twice.
    let normals: Vec<String> = (0..20_000).map(|i| format!("{i} 1 0")).collect();
    let corners: Vec<String> = (0..40_000).map(|i| format!("0 {}", i % 20_000)).collect();
    let primitive = format!(
        "<trifans count=\"1\">{VERTEX}<input semantic=\"NORMAL\" source=\"#n\" offset=\"1\"/><p>{}</p></trifans>",
        corners.join(" ")
    );
    let loaded = load_clean(&with_sources("0 0 0", &floats("n", "X Y Z", &normals.join(" ")), &primitive));
    assert_eq!(mesh(&loaded).positions.len(), 20_000);
}

#[test]
fn indices_out_of_range_cost_their_primitive_alone() {
    for bad in ["9", "-1", "4000000000", "x"] {
        let loaded =
            load(&shown(SQUARE, &format!("<polylist count=\"2\">{VERTEX}<vcount>3 4</vcount><p>0 1 {bad} 0 1 2 3</p></polylist>")));
        assert_eq!(codes(&loaded).last(), Some(&"index-out-of-range"), "{bad}");
        assert_eq!(mesh(&loaded).triangles.len(), 2);
    }
}

#[test]
fn indices_out_of_range_beside_the_points_cost_that_value_alone() {
    for (semantic, names, values) in [("NORMAL", "X Y Z", "1 0 0"), ("TEXCOORD", "S T", "0.5 0.5"), ("COLOR", "R G B", "1 0 0")] {
        for shared in [false, true] {
            for bad in ["1", "-1", "4000000000"] {
                let offset = usize::from(!shared);
                let input = format!("{VERTEX}<input semantic=\"{semantic}\" source=\"#t\" offset=\"{offset}\"/>");
                let corners = |points: &[&str]| -> String {
                    points
                        .iter()
                        .map(
                            |point| {
                                if shared { format!("{point} ") } else { format!("{point} {} ", if *point == "2" { bad } else { "0" }) }
                            },
                        )
                        .collect()
                };
                let (one, two, strip) = (corners(&["0", "1", "2"]), corners(&["0", "2", "3"]), corners(&["0", "1", "3", "2"]));
                for (primitive, faces) in [
                    (format!("<triangles count=\"2\">{input}<p>{one}{two}</p></triangles>"), 2),
                    (format!("<polylist count=\"1\">{input}<vcount>4</vcount><p>{}</p></polylist>", corners(&["0", "1", "2", "3"])), 2),
                    (format!("<polygons count=\"1\">{input}<p>{one}</p></polygons>"), 1),
                    (format!("<trifans count=\"1\">{input}<p>{}</p></trifans>", corners(&["0", "1", "2", "3"])), 2),
                    (format!("<tristrips count=\"1\">{input}<p>{strip}</p></tristrips>"), 2),
                ] {
                    let loaded = load(&with_sources(SQUARE, &floats("t", names, values), &primitive));
                    let mesh = mesh(&loaded);
                    assert_eq!((codes(&loaded), mesh.triangles.len()), (vec!["index-out-of-range"], faces), "{primitive}");
                    let lost = mesh.source_vertex.iter().position(|point| *point == 2).expect("it is drawn");
                    match semantic {
                        "NORMAL" => assert!(mesh.normals[lost].z.abs() > 0.99, "{primitive}"),
                        "TEXCOORD" => assert_eq!(mesh.uv_sets[0][lost], Vec2::ZERO),
                        _ => assert_eq!(mesh.colors[lost], Vec4::ONE),
                    }
                }
                let line = format!("<lines count=\"1\">{input}<p>{}</p></lines>", corners(&["1", "2"]));
                assert_eq!(mesh(&load(&with_sources(SQUARE, &floats("t", names, values), &line))).lines.len(), 1);
            }
        }
    }
}

#[test]
fn values_that_are_no_numbers_beside_the_points_are_told_and_replaced() {
    for (semantic, names, values) in
        [("NORMAL", "X Y Z", "0 0 NaN 0 1.#QNAN 1"), ("TEXCOORD", "S T", "INF 0 0 -1.#IND"), ("COLOR", "R G B", "NaN 0 0 1 1 INF")]
    {
        let primitive = format!(
            "<triangles count=\"1\">{VERTEX}<input semantic=\"{semantic}\" source=\"#t\" offset=\"1\"/><p>0 0 1 1 2 1</p></triangles>"
        );
        let loaded = load(&with_sources(SQUARE, &floats("t", names, values), &primitive));
        assert_eq!(codes(&loaded), ["not-finite"], "{semantic}");
        assert!(loaded.findings[0].element.to_string().contains("\"g\""), "{}", loaded.findings[0].element);
        let mesh = mesh(&loaded);
        assert!(mesh.normals.iter().all(|normal| normal.z.abs() > 0.99), "{semantic}");
        assert!(mesh.uv_sets.iter().flatten().all(|uv| uv.is_finite()) && mesh.colors.iter().all(|color| color.is_finite()));
    }
}

#[test]
fn a_mesh_without_faces_is_told_once_and_a_wrong_count_of_them_not_beside_it() {
    for primitives in ["", "<triangles count=\"2\"><input semantic=\"VERTEX\" source=\"#g-v\" offset=\"0\"/></triangles>"] {
        let loaded =
            load(&shown(SQUARE, primitives).replace("</visual_scene>", "<node><instance_geometry url=\"#g\"/></node></visual_scene>"));
        assert_eq!(codes(&loaded), ["no-faces"], "{primitives}");
        assert!(loaded.findings[0].element.to_string().contains("\"g\""), "{}", loaded.findings[0].element);
    }
}

#[test]
fn lists_that_are_empty_cost_no_face() {
    for (semantic, names) in [("NORMAL", "X Y Z"), ("TEXCOORD", "S T"), ("COLOR", "R G B")] {
        let primitive = format!(
            "<triangles count=\"2\">{VERTEX}<input semantic=\"{semantic}\" source=\"#t\" offset=\"1\"/><p>0 0 1 0 2 0  0 0 2 0 3 0</p></triangles>"
        );
        let loaded = load(&with_sources(SQUARE, &floats("t", names, ""), &primitive));
        assert_eq!((codes(&loaded), mesh(&loaded).triangles.len()), (vec!["index-out-of-range"], 2), "{semantic}");
        assert!(mesh(&loaded).normals.iter().all(|normal| normal.z.abs() > 0.99), "{semantic}");
    }
}

#[test]
fn empty_and_cut_off_primitives_are_harmless() {
    let whole = format!("<triangles count=\"1\">{VERTEX}<p>0 1 2</p></triangles>");
    load_clean(&shown(
        SQUARE,
        &format!("<triangles count=\"0\">{VERTEX}<p></p></triangles><triangles count=\"0\">{VERTEX}</triangles>{whole}"),
    ));
    for primitive in [
        format!("<triangles count=\"2\">{VERTEX}<p>0 1 2 3</p></triangles>"),
        format!("<polylist count=\"2\">{VERTEX}<vcount>3 4</vcount><p>0 1 2 3</p></polylist>"),
        format!("<polylist count=\"2\">{VERTEX}<vcount>3 2</vcount><p>0 1 2 3 0</p></polylist>"),
        format!("<polylist count=\"1\">{VERTEX}<vcount>3</vcount><p>0 1 2 3</p></polylist>"),
        format!("<polylist count=\"2\">{VERTEX}<vcount>3 4000000000</vcount><p>0 1 2 3</p></polylist>"),
    ] {
        let loaded = load(&shown(SQUARE, &primitive));
        assert_eq!((codes(&loaded), mesh(&loaded).triangles.len()), (vec!["incomplete-primitive"], 1), "{primitive}");
    }
}

#[test]
fn missing_normals_are_computed_and_smooth() {
    // Two triangles of one size at a right angle, along the line from point 1 to point 2.
    let points = "0 0 0 1 0 0 1 1 0 1 0 -1";
    let loaded = load_clean(&shown(points, &triangles("g", "0 1 2 1 3 2")));
    let mesh = mesh(&loaded);
    near32(mesh.normals[0], Vec3::Z);
    near32(mesh.normals[1], Vec3::new(1.0, 0.0, 1.0).normalize());
}

#[test]
fn geometry_that_is_no_mesh_is_named_and_skipped() {
    for kind in ["convex_mesh", "spline", "brep"] {
        let body = format!("<library_geometries><geometry id=\"g\"><{kind}/></geometry></library_geometries>");
        let loaded = load(&document(&(body + &scene("<node><instance_geometry url=\"#g\"/></node>"))));
        assert_eq!(codes(&loaded), ["unsupported-geometry"]);
        assert_eq!(loaded.findings[0].finding, Finding::UnsupportedGeometry(kind.to_owned()));
    }
}

#[test]
fn a_mesh_without_positions_is_told() {
    let loaded: ColladaScene = load(&shown(SQUARE, &triangles("g", "0 1 2")).replace("semantic=\"POSITION\"", "semantic=\"OTHER\""));
    assert_eq!(codes(&loaded), ["no-positions"]);
    assert!(loaded.scene.meshes.is_empty());
}

#[test]
fn a_mesh_is_read_once_however_often_it_stands_in_the_scene() {
    let loaded = load_clean(&document(
        &(triangle()
            + &scene(
                "<node><instance_geometry url=\"#g\"/></node><node><instance_geometry url=\"#g\"/><instance_geometry url=\"#g\"/></node>",
            )),
    ));
    assert_eq!((loaded.scene.meshes.len(), instances(&loaded).len()), (1, 3));
}

#[test]
fn each_mesh_means_its_own_sources_where_ids_repeat() {
    let one = |points: &str| geometry("g", points, &triangles("g", "0 1 2"));
    let both = one("0 0 0 1 0 0 0 1 0").replace("geometry id=\"g\"", "geometry id=\"first\"")
        + &one("0 0 0 3 0 0 0 3 0").replace("geometry id=\"g\"", "geometry id=\"second\"");
    let nodes = "<node><instance_geometry url=\"#first\"/></node><node><instance_geometry url=\"#second\"/></node>";
    let loaded = load(&document(&(geometries(&both) + &scene(nodes))));
    assert!(codes(&loaded).iter().all(|code| *code == "repeated-id"), "{:?}", codes(&loaded));
    let areas: Vec<f32> = loaded.scene.meshes.iter().map(|mesh| area(mesh)).collect();
    assert_eq!(areas, [0.5, 4.5]);
}

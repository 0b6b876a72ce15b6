//! `.zae` archives.

use std::io::{Cursor, Write};
use std::path::PathBuf;

use glam::Vec3;
use sinew::collada::{ColladaScene, ReadError, ReadErrorKind, read};
use sinew::progress::Progress;
use zip::write::SimpleFileOptions;

use crate::build::*;

fn packed(files: &[(&str, &[u8])]) -> Vec<u8> {
    let mut zip = zip::ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in files {
        zip.start_file(*name, SimpleFileOptions::default()).expect("a name");
        zip.write_all(bytes).expect("memory");
    }
    zip.finish().expect("memory").into_inner()
}

fn open(bytes: &[u8]) -> Result<ColladaScene, ReadError> {
    read(bytes, "model.zae", &Progress::default())
}

fn text() -> String {
    let images = "<library_images><image id=\"i\"><init_from>../images/wood.png</init_from></image></library_images>";
    document(&(images.to_owned() + &triangle() + &scene("<node><instance_geometry url=\"scene.dae#g\"/></node>")))
}

#[test]
fn the_manifest_names_the_root_and_images_come_along() {
    let manifest = b"<?xml version=\"1.0\"?><dae_root>./models/scene.dae#s</dae_root>";
    let text = text();
    let files: [(&str, &[u8]); 4] =
        [("manifest.xml", manifest), ("a.dae", b"<nonsense/>"), ("models/scene.dae", text.as_bytes()), ("images/wood.png", b"pixels")];
    let loaded = open(&packed(&files)).expect("readable");
    assert!(loaded.findings.is_empty(), "{:?}", loaded.findings);
    assert_eq!(mesh(&loaded).triangles.len(), 1);
    assert_eq!(loaded.scene.images[0].uri, "images/wood.png");
    assert_eq!(loaded.archived, [(PathBuf::from("images/wood.png"), b"pixels".to_vec())]);
    assert_eq!(loaded.scene.graph.node(loaded.scene.graph.roots()[0]).name, "model");
}

#[test]
fn without_a_manifest_the_topmost_document_is_read() {
    let text = text();
    let loaded = open(&packed(&[("deep/down/a.dae", b"<nonsense/>"), ("scene.dae", text.as_bytes())])).expect("readable");
    assert_eq!(mesh(&loaded).triangles.len(), 1);
}

#[test]
fn broken_empty_and_exploding_archives_are_refused() {
    let good = packed(&[("scene.dae", text().as_bytes())]);
    for bytes in [&good[..good.len() / 2], b"PK\x03\x04", b"PK\x05\x06nothing"] {
        assert!(open(bytes).is_err());
    }
    assert!(open(&packed(&[("readme.txt", b"hello")])).is_err());
    let lost = packed(&[("manifest.xml", b"<dae_root>lost.dae</dae_root>"), ("scene.dae", text().as_bytes())]);
    assert_eq!(open(&lost).expect_err("refused").kind, ReadErrorKind::ArchiveRootMissing("lost.dae".to_owned()));
    let bomb = packed(&[("scene.dae", &vec![b' '; 200 << 20])]);
    assert!(bomb.len() < 1 << 20);
    assert_eq!(open(&bomb).expect_err("refused").kind, ReadErrorKind::ArchiveTooLarge);
    let image_bomb = packed(&[("scene.dae", text().as_bytes()), ("a.png", &vec![0; 200 << 20])]);
    assert!(open(&image_bomb).is_err());
    let many: Vec<(String, &[u8])> = (0..5000).map(|i| (format!("{i}.txt"), &b""[..])).collect();
    let many: Vec<(&str, &[u8])> = many.iter().map(|(name, bytes)| (name.as_str(), *bytes)).collect();
    assert!(open(&packed(&many)).is_err());
}

#[test]
fn damage_anywhere_ends_in_a_result() {
    let good = packed(&[("manifest.xml", b"<dae_root>scene.dae</dae_root>"), ("scene.dae", text().as_bytes()), ("a.png", b"pixels")]);
    for at in (0..good.len()).step_by(3) {
        let mut damaged = good.clone();
        damaged[at] ^= 0xFF;
        let _ = open(&damaged);
        let _ = open(&good[..at]);
    }
}

/// A document without a scene of its own, whose asset says this.
fn part(asset: &str, body: &str) -> String {
    headed("1.4.1", &format!("<asset>{asset}</asset>"), body).replace("<scene><instance_visual_scene url=\"#s\"/></scene>", "")
}

#[test]
fn documents_inside_the_archive_are_read_where_they_are_referred_to() {
    // Both documents have a mesh `g`; the part has a material and an image of its own, and it is in another folder.
    let used = "<node><instance_geometry url=\"../parts/wheel.dae#g\"><bind_material><technique_common><instance_material symbol=\"m\" target=\"../parts/wheel.dae#m\"/>\
                </technique_common></bind_material></instance_geometry></node><node><instance_geometry url=\"#g\"/></node>";
    let root = document(&(triangle() + &scene(used)));
    let library = "<library_images><image id=\"i\"><init_from>wood.png</init_from></image></library_images>\
                   <library_effects><effect id=\"e\"><profile_COMMON><technique><lambert><diffuse><texture texture=\"i\" texcoord=\"\"/></diffuse></lambert></technique></profile_COMMON></effect></library_effects>\
                   <library_materials><material id=\"m\" name=\"wood\"><instance_effect url=\"#e\"/></material></library_materials>";
    let other =
        geometries(&geometry("g", "0 0 0 3 0 0 0 3 0", &triangles("g", "0 1 2").replace("<triangles ", "<triangles material=\"m\" ")));
    for manifest in [true, false] {
        let wheel = part("<unit meter=\"1\"/><up_axis>Y_UP</up_axis>", &(library.to_owned() + &other));
        let mut files: Vec<(&str, &[u8])> = vec![
            ("models/a.dae", root.as_bytes()),
            ("parts/wheel.dae", wheel.as_bytes()),
            ("parts/wood.png", b"pixels"),
            ("unused.dae", b"<broken"),
        ];
        if manifest {
            files.push(("manifest.xml", b"<dae_root>models/a.dae</dae_root>"));
        } else {
            files.retain(|(name, _)| *name != "unused.dae");
        }
        let loaded = open(&packed(&files)).expect("readable");
        assert!(loaded.findings.is_empty(), "{:?}", loaded.findings);
        let areas: Vec<f32> = instances(&loaded).iter().map(|(_, instance)| area(&loaded.scene.meshes[instance.mesh.index()])).collect();
        assert_eq!(areas, [4.5, 0.5]);
        let binding = instances(&loaded)[0].1.materials[0].clone().expect("bound");
        assert_eq!(loaded.scene.materials[binding.material.index()].name, "wood");
        assert_eq!(loaded.scene.images[0].uri, "parts/wood.png");
    }
}

#[test]
fn a_document_behind_another_one_keeps_its_unit_axes_and_lines_and_leads_on() {
    let root = document(&scene("<instance_node url=\"b.dae#arm\"/>"));
    let arm = "<library_nodes><node id=\"arm\" name=\"arm\"><translate>0 0 100</translate><instance_geometry url=\"sub/c.dae#g\"/></node></library_nodes>";
    let b = part("<unit meter=\"0.01\"/><up_axis>Z_UP</up_axis>", arm);
    let c = part(
        "<unit meter=\"0.1\"/><up_axis>Y_UP</up_axis>",
        &("\n\n".to_owned()
            + &triangle().replace("<p>0 1 2</p>", "<p>0 1 2 9 9 9</p>").replace("<triangles count=\"1\"", "<triangles count=\"2\"")),
    );
    let files: [(&str, &[u8]); 3] = [("a.dae", root.as_bytes()), ("b.dae", b.as_bytes()), ("sub/c.dae", c.as_bytes())];
    let packed = packed(&[("manifest.xml", b"<dae_root>a.dae</dae_root>" as &[u8])].into_iter().chain(files).collect::<Vec<_>>());
    let loaded = open(&packed).expect("readable");
    assert_eq!(codes(&loaded), ["index-out-of-range"]);
    let line = c.lines().position(|line| line.contains("<triangles")).expect("it is there") as u32 + 1;
    assert_eq!((loaded.findings[0].file.path(), loaded.findings[0].line), (Some("sub/c.dae"), Some(line)));
    // One metre up, the triangle ten centimetres wide.
    let points = drawn_bytes("model.zae", &packed, 0.0);
    near32(points[0], Vec3::Y);
    near32(points[1], Vec3::new(0.1, 1.0, 0.0));
}

#[test]
fn documents_that_are_not_there_broken_or_refer_in_a_circle_are_told() {
    let root =
        document(&(triangle() + &scene("<node><instance_geometry url=\"b.dae#g\"/></node><node><instance_geometry url=\"#g\"/></node>")));
    let open = |more: &[(&str, &[u8])]| {
        let files = [("manifest.xml", b"<dae_root>a.dae</dae_root>" as &[u8]), ("a.dae", root.as_bytes())];
        open(&packed(&files.into_iter().chain(more.iter().copied()).collect::<Vec<_>>())).expect("readable")
    };
    let lost = open(&[]);
    assert_eq!((codes(&lost), lost.scene.meshes.len()), (vec!["external-reference"], 1));
    for broken in ["<COLLADA><x></COLLADA>", "<html/>", "", "<!DOCTYPE COLLADA [<!ENTITY e \"x\">]><COLLADA>&e;</COLLADA>"] {
        let loaded = open(&[("b.dae", broken.as_bytes())]);
        assert!(codes(&loaded).iter().all(|code| *code == "external-reference"), "{broken}: {:?}", loaded.findings);
        assert_eq!(loaded.scene.meshes.len(), 1, "{broken}");
        assert!(loaded.findings.iter().any(|finding| finding.file.path() == Some("b.dae")), "{broken}: {:?}", loaded.findings);
    }
    let circle =
        part("", "<library_nodes><node id=\"g\"><instance_node url=\"a.dae#s\"/><instance_node url=\"b.dae#g\"/></node></library_nodes>");
    assert!(!open(&[("b.dae", circle.as_bytes())]).findings.is_empty());
}

#[test]
fn all_documents_of_an_archive_have_one_budget() {
    let root = document(&scene("<node><instance_geometry url=\"b.dae#g\"/></node>"));
    let blank = part("", &(" ".repeat(90 << 20) + &triangle()));
    let packed = packed(&[("a.dae", root.as_bytes()), ("b.dae", blank.as_bytes())]);
    assert!(open(&packed).is_err(), "{} bytes", packed.len());
}

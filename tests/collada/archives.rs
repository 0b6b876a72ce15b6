//! `.zae` archives.

use std::io::{Cursor, Write};
use std::path::PathBuf;

use sinew::collada::{Loaded, Progress, ReadError, read};
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

fn open(bytes: &[u8]) -> Result<Loaded, ReadError> {
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
    assert!(open(&lost).expect_err("refused").message.contains("lost.dae"));
    let bomb = packed(&[("scene.dae", &vec![b' '; 200 << 20])]);
    assert!(bomb.len() < 1 << 20);
    assert!(open(&bomb).expect_err("refused").message.contains("10"));
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

//! Several files in one document, and files that cannot be used.

use std::path::{Path, PathBuf};

use glam::Vec3;
use sinew::document::{Document, Missing, PoseBuffers, SourceKind};
use sinew::formats::SCENE_READERS;
use sinew::progress::Progress;
use sinew::scene::{Content, Deformer, Frame};

fn config(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("configs").join(name)
}

fn open(names: &[&str]) -> Document {
    let files: Vec<_> = names.iter().map(|name| config(name)).collect();
    Document::open(&files, SCENE_READERS, &Progress::default()).expect("the shipped files open")
}

/// World positions of all vertices of all surfaces at the start.
fn vertices(document: &Document) -> Vec<Vec3> {
    let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
    document.pose(&document.start_state(), &mut buffers, &mut frame);
    let each = |surface: &sinew::scene::Surface| (0..surface.mesh.positions.len() as u32).map(|v| surface.position(v)).collect::<Vec<_>>();
    frame.surfaces.iter().flat_map(each).collect()
}

#[test]
fn every_shipped_file_opens_without_a_finding() {
    let names = std::fs::read_dir(config("")).expect("configs").flatten().map(|entry| entry.file_name().to_string_lossy().into_owned());
    let names: Vec<_> = names.filter(|name| [".dae", ".yaml"].iter().any(|ending| name.ends_with(ending))).collect();
    assert!(names.len() >= 4);
    for name in names {
        let document = open(&[&name]);
        // What is found of the walker's muscles is held by the tests of sets of muscles.
        let is_set = name == "walker-muscles.yaml";
        assert!(is_set || document.diagnostics.is_empty(), "{name}: {:?}", document.diagnostics);
        assert!(document.missing().is_empty() || name == "lamp.dae", "{name}: {:?}", document.missing());
    }
}

#[test]
fn files_side_by_side_look_as_they_do_alone() {
    let together = open(&["curl.dae", "biceps.yaml", "walker.dae"]);
    assert_eq!(together.sources.len(), 3);
    assert!(matches!(together.sources[1].kind, SourceKind::Muscles(..)));
    // Only the first clip plays, so the walker is compared at rest: by its own start, which the clip does not reach.
    // What belongs to muscles stands behind everything else in the scene.
    let (clip, muscle) = (vertices(&open(&["curl.dae"])), vertices(&open(&["biceps.yaml"])));
    let all = vertices(&together);
    assert!(all.len() > clip.len() + muscle.len());
    let bits = |positions: &[Vec3]| positions.iter().map(|position| position.to_array().map(f32::to_bits)).collect::<Vec<_>>();
    assert!(bits(&all[..clip.len()]) == bits(&clip), "a clip stands where its file says");
    // An arm, of which its file does not say where it is, stands beside: all of it moved by one way along the ground.
    let tail = &all[all.len() - muscle.len()..];
    let way = tail[0] - muscle[0];
    assert!(way.x > 0.1 && way.y.abs() < 1e-6, "{way}");
    let off = tail.iter().zip(&muscle).map(|(beside, alone)| (*beside - *alone - way).length()).fold(0.0, f32::max);
    assert!(off < 1e-6, "{off}");
    for (_, node) in together.scene.graph.iter() {
        for content in &node.contents {
            let Content::Mesh(instance) = content else { continue };
            let mesh = &together.scene.meshes[instance.mesh.index()];
            assert_eq!(mesh.parts.len(), instance.materials.len());
            for binding in instance.materials.iter().flatten() {
                assert!(binding.material.index() < together.scene.materials.len());
            }
            for deformer in &instance.deformers {
                let Deformer::Skin { skin, joints } = deformer else { continue };
                let skin = &together.scene.skins[skin.index()];
                assert_eq!(skin.joints.len(), joints.len());
                for (joint, node) in skin.joints.iter().zip(joints) {
                    let node = together.scene.graph.node(node.expect("every joint has its node"));
                    assert!(
                        node.sid == joint.name || node.id == joint.name || node.name == joint.name,
                        "{} is not {}",
                        node.name,
                        joint.name
                    );
                }
            }
        }
    }
}

#[test]
fn what_is_missing_is_said_only_where_nothing_can_be_driven() {
    assert_eq!(Document::default().missing(), [Missing::Mesh, Missing::Skeleton, Missing::Animation]);
    assert_eq!(open(&["lamp.dae"]).missing(), [Missing::Skeleton]);
    assert!(open(&["walker.dae"]).missing().is_empty());
    assert!(Document::built_in().missing().is_empty());
}

#[test]
fn the_built_in_scene_is_there_and_can_be_driven() {
    let document = Document::built_in();
    let rig = document.driven_rig().expect("a muscle");
    assert_eq!(rig.len(), 1);
    assert!(!vertices(&document).is_empty());
}

#[test]
fn a_file_that_cannot_be_used_is_named_with_its_place() {
    let folder = tempfile::tempdir().expect("a folder");
    let cases: [(&str, &[u8], Option<u32>); 4] = [
        ("broken.dae", b"<?xml version=\"1.0\"?>\n<COLLADA version=\"1.4.1\">\n<asset>", Some(3)),
        ("broken.yaml", b"muscle_config:\n  radiuses: [1, 2\n", None),
        ("latin.yaml", b"muscle_config:\n  name: \"\xE9\"\n", Some(2)),
        ("blank.dae", b"  \n ", None),
    ];
    for (name, bytes, line) in cases {
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).expect("written");
        let error = Document::open(&[&path], SCENE_READERS, &Progress::default()).expect_err(name);
        let text = error.to_string();
        assert!(text.starts_with(&path.display().to_string()), "{text}");
        assert_eq!(text.lines().count(), 1, "{text}");
        if line.is_some() {
            assert_eq!(error.location.line, line, "{text}");
        }
    }
    let missing = Document::open(&[folder.path().join("none.dae")], SCENE_READERS, &Progress::default()).expect_err("no such file");
    assert!(missing.to_string().contains("none.dae"));
}

//! Nothing is lost: what is written is never what is open, by whatever name, and no end of the program leaves a half file behind for good.
#![cfg(unix)]

use std::collections::BTreeMap;
use std::fs;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::process::Stdio;

use crate::support::{arg, call, config, folder, models, run, sinew, sinew_ru};
use proptest::prelude::*;
use sinew::document::{Document, OpenOptions, PoseBuffers};
use sinew::export::gltf::{self, GltfContainer};
use sinew::export::surface::SurfaceFormat;
use sinew::export::tables::{self, MeasureTable, TableSubject};
use sinew::export::{ExportError, png};
use sinew::formats::SCENE_READERS;
use sinew::output::{OutputError, OverwriteGuard, is_same, write_atomic};
use sinew::progress::Progress;
use sinew::render::Framebuffer;
use sinew::scene::Frame;
use sinew::view;

const MUSCLES: &str = "clip: column.dae
muscles:
  - {name: M, length: 1200.0, radii: [20.0, 40.0, 20.0], growth: [1.0, 1.0, 1.0],
     origin: {bone: lower, offset: [100.0, 0.0, 200.0]}, insertion: {bone: upper, offset: [100.0, 0.0, 500.0]}}
";

/// A clip with a texture, muscles that name it, a session of both, and measured radii.
fn sources(folder: &Path) -> Vec<PathBuf> {
    fs::create_dir_all(folder.join("maps")).expect("made");
    let textured = models::column().replace(
        "<library_effects>",
        "<library_images><image id=\"i\"><init_from>maps/skin.png</init_from></image></library_images><library_effects>",
    );
    fs::copy(config("walker.png"), folder.join("maps/skin.png")).expect("copied");
    let mut files = vec![models::write(folder, "column.dae", &textured), folder.join("maps/skin.png")];
    files.push(models::write(folder, "muscles.yaml", MUSCLES));
    files.push(models::write(folder, "look.yaml", "sinew_session:\n  files: [muscles.yaml]\n  compared: {file: other.dae}\n"));
    files.push(models::write(folder, "other.dae", &models::cube("1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1")));
    fs::copy(config("biceps-radii.csv"), folder.join("radii.csv")).expect("copied");
    files.push(folder.join("radii.csv"));
    files
}

fn contents(files: &[PathBuf]) -> BTreeMap<PathBuf, Vec<u8>> {
    files.iter().map(|file| (file.clone(), fs::read(file).expect("still there"))).collect()
}

fn hidden(folder: &Path) -> Vec<String> {
    let names = fs::read_dir(folder).expect("readable").flatten().map(|entry| entry.file_name().to_string_lossy().into_owned());
    names.filter(|name| name.starts_with('.')).collect()
}

/// Ways to write a result.
const KINDS: [&str; 7] = ["png", "obj", "stl", "glb", "csv", "svg", "yaml"];

fn write(kind: &str, document: &Document, guard: &OverwriteGuard, out: &Path) -> Result<(), ExportError> {
    let output = guard.output(out)?;
    let mut frame = Frame::default();
    document.pose(&document.start_state(), &mut PoseBuffers::default(), &mut frame);
    let table = || MeasureTable::measure(TableSubject::Joints, document, &document.start_state(), 5.0).expect("joints move");
    match kind {
        "png" => png::save(&output, &Framebuffer { width: 2, height: 2, pixels: vec![0xFF00_FF00; 4] }, false, &[]),
        "obj" => SurfaceFormat::Obj.save(&output, &document.scene, &frame),
        "stl" => SurfaceFormat::Stl.save(&output, &document.scene, &frame),
        "glb" => gltf::save(&output, GltfContainer::Binary, document).map(drop),
        "csv" => table().save(&output, tables::TableFormat::Csv, 1.0, sinew::i18n::sentence),
        "svg" => table().save(&output, tables::TableFormat::Svg, 1.0, sinew::i18n::sentence),
        _ => Ok(write_atomic(&output, |file| std::io::Write::write_all(file, b"sinew_session: {}\n"))?),
    }
}

/// Names for `source` in `folder`: itself and others that lead to it.
fn alias(folder: &Path, source: &Path, way: usize, ending: &str) -> PathBuf {
    let relative = source.strip_prefix(folder).expect("in the folder");
    let name = folder.join(format!("alias.{ending}"));
    let second = folder.join(format!("second.{ending}"));
    match way {
        0 => return source.to_owned(),
        1 => return folder.join("maps/../.").join(relative),
        2 => symlink(relative, &name).expect("links work"),
        3 => symlink(source, &second).and_then(|()| symlink(format!("second.{ending}"), &name)).expect("links work"),
        4 => fs::hard_link(source, &name).expect("links work"),
        5 => {
            symlink(".", folder.join("round")).expect("links work");
            return folder.join("round/round").join(relative);
        }
        // Another file.
        _ => {}
    }
    name
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, ..ProptestConfig::default() })]

    #[test]
    fn what_is_written_is_not_what_is_open(
        opened in prop::sample::subsequence(vec![0usize, 2, 4], 1..=3),
        kind in prop::sample::select(KINDS.to_vec()),
        target in 0usize..6,
        way in 0usize..7,
    ) {
        let folder = folder();
        let folder = fs::canonicalize(folder.path()).expect("there");
        let folder = folder.as_path();
        let files = sources(folder);
        let paths: Vec<&PathBuf> = opened.iter().filter_map(|index| files.get(*index)).collect();
        let document = Document::open(&paths, SCENE_READERS, &Progress::default()).expect("opened");
        let guard = OverwriteGuard::of_document(&document);
        // The texture and the clip that muscles name are open too.
        let held: Vec<&PathBuf> = files.iter().enumerate().filter(|(index, _)| match index {
            0 | 1 => opened.contains(&0) || opened.contains(&2),
            _ => opened.contains(index),
        }).map(|(_, file)| file).collect();
        let out = alias(folder, &files[target], way, kind);
        let before = contents(&files);
        let is_open = held.iter().any(|source| is_same(source, &out));
        prop_assert_eq!(is_open, way < 6 && held.contains(&&files[target]));
        // A cube alone has no joints to measure.
        prop_assume!(opened != [4] || !matches!(kind, "csv" | "svg"));
        let written = write(kind, &document, &guard, &out);
        if is_open {
            prop_assert!(matches!(written, Err(ExportError::Output(OutputError::Held { .. }))), "{:?}", written);
        } else {
            prop_assert!(written.is_ok() && out.is_file(), "{:?}", written);
        }
        for source in held {
            prop_assert!(fs::read(source).expect("still there") == before[source], "{}", source.display());
        }
        prop_assert_eq!(hidden(folder), Vec::<String>::new());
    }
}

#[test]
fn no_command_replaces_what_it_reads() {
    let links: [fn(&PathBuf, &Path) -> std::io::Result<()>; 2] = [|from, to| symlink(from, to), |from, to| fs::hard_link(from, to)];
    for (number, link) in links.iter().enumerate() {
        let folder = folder();
        let at = |name: &str| folder.path().join(name);
        let files = sources(folder.path());
        let [clip, skin, muscles, look, other, radii] = &files[..] else { panic!("six files") };
        let aliased = |source: &PathBuf, name: &str| {
            let alias = at(name);
            link(source, &alias).expect("links work");
            alias
        };
        let before = contents(&files);
        let small = ["--size", "16x16"];
        let mut calls: Vec<Vec<String>> = Vec::new();
        let mut add = |words: &[&str]| calls.push(words.iter().map(|word| (*word).to_owned()).collect());
        for (index, source) in [clip, skin, muscles, look, other].into_iter().enumerate() {
            let read = if index < 2 { muscles } else { look };
            let out = aliased(source, &format!("picture-{index}.png"));
            add(&[&["render", arg(read), "-o", arg(&out)][..], &small].concat());
            let film = aliased(source, &format!("film-{index}.gif"));
            add(&[&["render", arg(read), "-o", arg(&film), "--to", "0.6"][..], &small].concat());
            aliased(source, &format!("frame{index}-0002.png"));
            let pattern = at(&format!("frame{index}-%04d.png"));
            add(&[&["render", arg(read), "-o", arg(&pattern), "--fps", "8"][..], &small].concat());
        }
        for (index, source) in [clip, skin, muscles].into_iter().enumerate() {
            for ending in ["obj", "ply", "stl"] {
                add(&["export", arg(muscles), "-o", arg(&aliased(source, &format!("surface-{index}.{ending}")))]);
            }
            aliased(source, &format!("beside-{index}.mtl"));
            add(&["export", arg(muscles), "-o", arg(&at(&format!("beside-{index}.obj")))]);
            for ending in ["glb", "gltf"] {
                add(&["convert", arg(muscles), arg(&aliased(source, &format!("scene-{index}.{ending}")))]);
            }
            let plot = aliased(source, &format!("plot-{index}.svg"));
            add(&["measure", arg(muscles), "--times", "0.5:1.5:0.5", "--plot", arg(&plot)]);
        }
        add(&["render", arg(skin), "-o", arg(skin)]);
        add(&["fit", arg(radii), "-o", arg(&aliased(radii, "fit.yaml"))]);
        add(&["fit", arg(radii), "--like", arg(muscles), "-o", arg(muscles)]);
        add(&["fit", arg(radii), "--like", arg(muscles), "-o", arg(&aliased(clip, "clip.yaml"))]);
        for words in &calls {
            let said = sinew(words).refused(2);
            assert!(said.ends_with("is one of the input files; choose another name for the result."), "{words:?}: {said}");
            sinew_ru(words).refused(2);
        }
        assert!(contents(&files) == before, "{number}");
        assert_eq!(hidden(folder.path()), Vec::<String>::new());
    }
}

#[test]
fn what_belongs_to_a_compared_file_is_held_as_what_is_open_is() {
    // The session shows a cube alone; the muscles that it is compared with bring their clip, and that its picture.
    for way in 0..6 {
        let folder = folder();
        let folder = fs::canonicalize(folder.path()).expect("there");
        let files = sources(&folder);
        let session = models::write(&folder, "session.yaml", "sinew_session:\n  files: [other.dae]\n  compared: {file: muscles.yaml}\n");
        let [clip, skin, muscles, _, other, _] = &files[..] else { panic!("six files") };
        let held = [clip, skin, muscles, other, &session];
        let before = contents(&[files.as_slice(), std::slice::from_ref(&session)].concat());
        let opened = view::open(&[&session], OpenOptions::new(SCENE_READERS), &Progress::default()).expect("opened");
        let compared = opened.compared.as_ref().map(|(file, document)| (file.as_path(), document));
        // The command line and the window ask the same.
        let guards = [opened.guard(&folder), view::guard_of(&opened.document, compared)].map(|guard| guard.and([&session]));
        for source in held {
            for ending in ["png", "gif"] {
                let out = alias(&folder, source, way, ending);
                assert!(guards.iter().all(|guard| matches!(guard.output(&out), Err(OutputError::Held { .. }))), "{}", out.display());
                if out.extension().is_some_and(|there| there == ending) {
                    let turning = (ending == "gif").then_some("--turntable");
                    let words = ["render", arg(&session), "-o", arg(&out), "--size", "16x16"].into_iter().chain(turning);
                    let said = sinew(words).refused(2);
                    assert!(said.ends_with("is one of the input files; choose another name for the result."), "{said}");
                }
                for link in ["alias", "second"] {
                    let _ = fs::remove_file(folder.join(format!("{link}.{ending}")));
                }
                let _ = fs::remove_file(folder.join("round"));
            }
            let numbered = folder.join("fr-1.png");
            if fs::hard_link(source, &numbered).is_ok() {
                let pattern = folder.join("fr-%d.png");
                let row = ["render", arg(&session), "-o", arg(&pattern), "--size", "16x16", "--turntable", "--duration", "1", "--fps", "4"];
                sinew(row).refused(2);
                sinew_ru(row).refused(2);
                fs::remove_file(&numbered).expect("ours");
            }
        }
        assert!(contents(&before.keys().cloned().collect::<Vec<_>>()) == before, "{way}");
        assert_eq!(hidden(&folder), Vec::<String>::new());
        let out = folder.join("free.png");
        sinew(["render", arg(&session), "-o", arg(&out), "--size", "16x16"]).well();
        assert!(out.is_file());
    }
}

#[test]
fn what_standard_input_reads_is_held_too() {
    let folder = folder();
    let clip = models::write(folder.path(), "column.dae", &models::column());
    let out = folder.path().join("out.glb");
    fs::hard_link(&clip, &out).expect("links work");
    let mut command = call(["convert", "-", arg(&out)]);
    let ended = command.stdin(fs::File::open(&clip).expect("there")).output().expect("runs");
    assert_eq!(ended.status.code(), Some(2), "{}", String::from_utf8_lossy(&ended.stderr));
    assert_eq!(fs::read_to_string(&clip).expect("there"), models::column());
    // A pipe is no file.
    let other = folder.path().join("other.glb");
    run(call(["convert", "-", arg(&other)]), models::column().as_bytes()).well();
}

#[test]
fn what_lies_in_an_archive_is_no_file_beside_it() {
    let folder = folder();
    let textured = models::column().replace(
        "<library_effects>",
        "<library_images><image id=\"i\"><init_from>skin.png</init_from></image></library_images><library_effects>",
    );
    let archive = folder.path().join("column.zae");
    let mut zip = zip::ZipWriter::new(fs::File::create(&archive).expect("made"));
    let options = zip::write::SimpleFileOptions::default();
    for (name, bytes) in [("column.dae", textured.into_bytes()), ("skin.png", fs::read(config("walker.png")).expect("there"))] {
        zip.start_file(name, options).and_then(|()| Ok(std::io::Write::write_all(&mut zip, &bytes)?)).expect("written");
    }
    zip.finish().expect("written");
    assert_eq!(sinew(["info", arg(&archive), "--json"]).json()["images"][0]["found"], true);
    let mut command = call(["render", "column.zae", "-o", "skin.png", "--size", "16x16"]);
    command.current_dir(folder.path());
    run(command, b"").well();
    assert!(folder.path().join("skin.png").is_file());
}

#[test]
fn what_is_killed_leaves_nothing_for_the_next_one() {
    let folder = folder();
    let clip = models::write(folder.path(), "column.dae", &models::column());
    let film = folder.path().join("film.gif");
    let long = ["render", arg(&clip), "-o", arg(&film), "--size", "900x900", "--fps", "50", "--turntable", "--duration", "1000"];
    let begin = |left: &[String]| {
        let mut child = call(long).stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("starts");
        for _ in 0..600 {
            let there = hidden(folder.path());
            if there.len() == 2 && there.iter().all(|name| !left.contains(name)) {
                return child;
            }
            assert!(child.try_wait().expect("ours").is_none(), "it ended by itself");
            std::thread::sleep(std::time::Duration::from_millis(50));
        }
        panic!("nothing was written");
    };
    let mut dead = begin(&[]);
    dead.kill().and_then(|()| dead.wait()).expect("ours");
    let left = hidden(folder.path());
    assert_eq!(left.len(), 2);
    // The next one takes them away before it makes its own.
    let mut alive = begin(&left);
    let of_the_living = hidden(folder.path());
    let picture = folder.path().join("picture.png");
    sinew(["render", arg(&clip), "-o", arg(&picture), "--size", "16x16"]).well();
    assert_eq!(hidden(folder.path()), of_the_living, "what is being written stays");
    alive.kill().and_then(|()| alive.wait()).expect("ours");
    sinew(["render", arg(&clip), "-o", arg(&picture), "--size", "16x16"]).well();
    assert_eq!(hidden(folder.path()), Vec::<String>::new());
}

#[test]
fn what_cannot_be_written_leaves_nothing() {
    let folder = folder();
    let clip = models::write(folder.path(), "column.dae", &models::column());
    fs::create_dir_all(folder.path().join("frame-3.png")).expect("made");
    symlink("/dev/full", folder.path().join("full.obj")).expect("links work");
    let long = format!("{}.png", "x".repeat(260));
    for (out, code) in [("frame-%d.png", 1), ("full.obj", 1), (&long, 1), ("none/a.png", 1), ("column.dae/a.png", 1), ("frame-3.png", 1)] {
        let out = folder.path().join(out);
        let command = if out.extension().is_some_and(|ending| ending == "obj") { "export" } else { "render" };
        sinew(
            [command, arg(&clip), "-o", arg(&out)]
                .into_iter()
                .chain((command == "render").then_some(["--size", "16x16"]).into_iter().flatten()),
        )
        .refused(code);
        assert_eq!(hidden(folder.path()), Vec::<String>::new(), "{}", out.display());
        assert!(!folder.path().join("frame-0.png").exists(), "all or nothing");
    }
}

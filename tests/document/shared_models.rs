//! Real files, where they are there: every one is read without a panic, in time, and says what a person would agree with.
//!
//! The models lie in `../shared/models` (or under `SINEW_SHARED`); an unpacked conformance suite is read from the folder that `SINEW_CTS` names.
//! With `SINEW_VERBOSE` set, all findings are printed.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use sinew::collada::{ColladaScene, ReadError, read};
use sinew::diagnostics::Severity;
use sinew::i18n::Sentence;
use sinew::progress::Progress;

fn documents(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut open = vec![folder.to_owned()];
    while let Some(folder) = open.pop() {
        for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
            let path = entry.path();
            if path.is_dir() {
                open.push(path);
            } else if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("dae") || ending.eq_ignore_ascii_case("zae")) {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

fn load(path: &Path) -> Result<ColladaScene, ReadError> {
    let bytes = std::fs::read(path).expect("the file was listed");
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let start = Instant::now();
    let result = read(&bytes, &name, &Progress::default());
    assert!(start.elapsed() < Duration::from_secs(120), "{} took {:?}", path.display(), start.elapsed());
    if std::env::var_os("SINEW_VERBOSE").is_some() {
        match &result {
            Ok(loaded) => {
                for finding in &loaded.findings {
                    println!("{}: {}", path.display(), sinew::i18n::finding_line(finding));
                }
            }
            Err(error) => println!("{}: refused: {:?}: {error}", path.display(), error.line),
        }
    }
    result
}

#[test]
fn models_that_programs_wrote_are_read_as_they_are_meant() {
    let Some(shared) = crate::support::shared() else {
        eprintln!("skipped: there is no folder of shared models");
        return;
    };
    for path in documents(&shared.join("models")) {
        let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        let loaded = load(&path).unwrap_or_else(|error| panic!("{name}: {error}"));
        let warnings: Vec<_> =
            loaded.findings.iter().filter(|finding| finding.severity() == Severity::Warning).map(|finding| finding.code()).collect();
        match name.as_str() {
            "malformed_p_negative_index.dae" => assert_eq!(warnings, ["index-out-of-range"], "{name}"),
            "missing_visual_scene.dae" => assert_eq!(warnings, ["no-scene-named", "broken-reference"], "{name}"),
            _ => {}
        }
        // Nothing that is meant to be seen vanishes.
        assert!(loaded.scene.materials.iter().all(|material| material.opacity > 0.0), "{name}");
        assert_eq!(loaded.scene.graph.roots().len(), 1, "{name}");
    }
}

#[test]
fn the_conformance_suite_is_read_or_refused_with_a_reason() {
    let Some(folder) = std::env::var_os("SINEW_CTS") else {
        eprintln!("skipped: SINEW_CTS names no folder");
        return;
    };
    let (mut read, mut refused) = (0, 0);
    for path in documents(Path::new(&folder)) {
        match load(&path) {
            Ok(_) => read += 1,
            Err(error) => {
                assert!(!error.sentence().is_empty());
                refused += 1;
            }
        }
    }
    println!("{read} read, {refused} refused");
}

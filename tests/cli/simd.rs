//! The environment variable that chooses an instruction set: followed, or refused in one sentence, never silently something else.

use crate::support::{Ended, call, config, folder, run};
use sinew::render::Renderer;

fn with(value: &str, arguments: &[&str], language: &str) -> Ended {
    let mut command = call(arguments);
    command.env("SINEW_SIMD", value).env("LANG", language);
    run(command, b"")
}

#[test]
fn what_is_there_is_used() {
    for name in Renderer::simd_names() {
        let report = with(name, &["bench", "--scene", "10k figure", "--seconds", "0.01", "--json"], "C.UTF-8").json();
        assert_eq!(report["simd"], name);
    }
}

#[test]
fn what_is_not_there_is_one_sentence_for_every_command() {
    let lamp = config("lamp.dae");
    let lamp = lamp.to_str().expect("a plain name");
    let folder = folder();
    let out = folder.path().join("x.png");
    let out = out.to_str().expect("a plain name");
    let all = "scalar, sse2, avx2, avx512";
    let unknown = format!("sinew: SINEW_SIMD is “foo”, which is not an instruction set that Sinew knows: {all}.");
    for call in [&["render", lamp, "-o", out][..], &["info", lamp], &["bench"], &["measure", lamp], &[lamp]] {
        assert_eq!(with("foo", call, "C.UTF-8").refused(2), unknown, "{call:?}");
    }
    assert!(!folder.path().join("x.png").exists());
    let empty = format!("sinew: The variable SINEW_SIMD is empty; set it to an instruction set ({all}) or unset it.");
    assert_eq!(with("", &["info", lamp], "C.UTF-8").refused(2), empty);
    // Names are as they are written.
    for name in ["AVX2", " avx2", "avx2,sse2", "0"] {
        assert!(with(name, &["info", lamp], "C.UTF-8").refused(2).contains("not an instruction set"), "{name:?}");
    }
    for name in ["scalar", "sse2", "avx2", "avx512"].into_iter().filter(|name| !Renderer::simd_names().contains(name)) {
        assert!(with(name, &["info", lamp], "C.UTF-8").refused(2).contains("this processor does not have"), "{name}");
    }
    assert!(with("foo", &["info", lamp], "ru_RU.UTF-8").refused(2).contains("такого набора команд"));
    // What draws nothing does not mind.
    assert!(with("foo", &["--version"], "C.UTF-8").well().starts_with("sinew"));
    with("foo", &["help"], "C.UTF-8").well();
}

#[test]
#[cfg(unix)]
fn a_value_that_is_no_text_is_refused_too() {
    use std::os::unix::ffi::OsStrExt;
    let mut command = call(["bench"]);
    command.env("SINEW_SIMD", std::ffi::OsStr::from_bytes(b"avx2\xff"));
    assert!(run(command, b"").refused(2).contains("not an instruction set"));
}

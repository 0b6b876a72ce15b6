//! What must hold of the repository itself: licences of what is linked in, no private paths, demo files that can be read.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

use spdx::{Expression, LicenseReq, ParseMode};

/// Licences that a program under MIT OR Apache-2.0 may link in.
const ALLOWED: &[&str] = &[
    "0BSD",
    "Apache-2.0",
    "Apache-2.0 WITH LLVM-exception",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "BSL-1.0",
    "CC0-1.0",
    "ISC",
    "MIT",
    "MIT-0",
    "Unicode-3.0",
    "Unlicense",
    "Zlib",
];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Whether an SPDX expression can be met by [`ALLOWED`] alone. The old `MIT/Apache-2.0` means OR.
fn acceptable(expression: &str) -> bool {
    let mode = ParseMode { allow_deprecated: true, allow_slash_as_or_operator: true, ..ParseMode::STRICT };
    let is_allowed = |requirement: &LicenseReq| ALLOWED.contains(&requirement.to_string().as_str());
    Expression::parse_mode(expression, mode).is_ok_and(|expression| expression.evaluate(is_allowed))
}

#[test]
fn licence_expressions_are_understood() {
    for good in
        ["MIT", "MIT/Apache-2.0", "Apache-2.0 OR GPL-2.0-only", "(MIT OR GPL-3.0) AND Unicode-3.0", "Apache-2.0 WITH LLVM-exception"]
    {
        assert!(acceptable(good), "{good}");
    }
    for bad in ["GPL-3.0", "MIT AND AGPL-3.0", "(MIT OR Zlib) AND LGPL-2.1", "", "MIT OR", "(MIT", "Apache-2.0 WITH GCC-exception-3.1"] {
        assert!(!acceptable(bad), "{bad}");
    }
}

#[test]
fn dependencies_are_freely_licensed() {
    let host = Command::new("rustc").arg("-vV").output().expect("rustc runs where cargo test does");
    let host = String::from_utf8_lossy(&host.stdout).lines().find_map(|line| line.strip_prefix("host: ").map(str::to_owned));
    let output = Command::new(env!("CARGO"))
        .args(["metadata", "--format-version", "1", "--offline", "--locked", "--filter-platform"])
        .arg(host.expect("rustc names its host"))
        .current_dir(root())
        .output()
        .expect("cargo runs where cargo test does");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let metadata: serde_json::Value = serde_json::from_slice(&output.stdout).expect("cargo metadata is JSON");
    let packages = metadata["packages"].as_array().expect("metadata lists packages");
    assert!(packages.len() > 20, "only {} packages", packages.len());
    let refused: BTreeSet<String> = packages
        .iter()
        .filter(|package| !package["license"].as_str().is_some_and(acceptable))
        .map(|package| format!("{} {}: {}", package["name"], package["version"], package["license"]))
        .collect();
    assert!(refused.is_empty(), "licences to look at: {refused:#?}");
}

/// Every file of the project, without what builds and version control put there.
fn files() -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![root().to_path_buf()];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).expect("the project's folders can be read") {
            let path = entry.expect("the project's folders can be read").path();
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            if matches!(name.as_ref(), "target" | "out" | ".git") {
                continue;
            }
            if path.is_dir() { folders.push(path) } else { found.push(path) }
        }
    }
    found
}

#[test]
fn no_file_names_a_private_path() {
    // This machine's own paths; one with a single name, such as /src, might stand anywhere.
    let own = [Some(env!("CARGO_MANIFEST_DIR").to_owned()), std::env::var("HOME").ok()];
    let private: Vec<String> =
        own.into_iter().flatten().filter(|path| path == "/root" || path.matches('/').count() > 1).map(|path| path + "/").collect();
    let mut named = Vec::new();
    for path in files() {
        // Pictures and other binary files cannot be searched line by line.
        let Ok(text) = std::fs::read_to_string(&path) else { continue };
        for (number, line) in text.lines().enumerate() {
            if private.iter().any(|private| line.contains(private.as_str())) {
                named.push(format!("{}:{}", path.display(), number + 1));
            }
        }
    }
    assert!(named.is_empty(), "private paths in: {named:#?}");
}

#[test]
fn shipped_clips_are_well_formed_small_and_ours() {
    let mut clips = 0;
    let shipped = |path: &PathBuf| path.starts_with(root().join("configs")) && path.extension().is_some_and(|ending| ending == "dae");
    for path in files().into_iter().filter(shipped) {
        let text = std::fs::read_to_string(&path).expect("a shipped clip is UTF-8");
        assert!(text.len() < 1_400_000, "{} has {} bytes", path.display(), text.len());
        let document = roxmltree::Document::parse(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        assert_eq!(document.root_element().tag_name().name(), "COLLADA", "{}", path.display());
        let licence = document
            .descendants()
            .find(|node| node.has_tag_name((document.root_element().tag_name().namespace().unwrap_or(""), "copyright")));
        assert_eq!(licence.and_then(|node| node.text()), Some("MIT OR Apache-2.0"), "{}", path.display());
        for image in document
            .descendants()
            .filter(|node| node.tag_name().name() == "init_from" && node.parent().is_some_and(|p| p.tag_name().name() == "image"))
        {
            let name = image.text().unwrap_or_default().trim();
            assert!(path.with_file_name(name).is_file(), "{} names {name}, which is not beside it", path.display());
        }
        clips += 1;
    }
    assert!(clips > 0, "no clip is shipped");
}

#[test]
fn nothing_is_written_but_through_the_guard() {
    // What a temporary file becomes is decided by `engine::output`, which asks for a guard; nothing else may make, rename or fill files.
    let words = [
        "File::create",
        "create_new(",
        "fs::write(",
        "fs::rename(",
        "fs::copy(",
        "NamedTempFile",
        "tempfile_in(",
        "replace_contents",
        "File::options(",
    ];
    let mut found = Vec::new();
    for path in files().into_iter().filter(|path| {
        ["src", "crates"].iter().any(|folder| path.starts_with(root().join(folder)))
            && path.extension().is_some_and(|ending| ending == "rs")
    }) {
        if path.ends_with("output/temporary.rs") {
            continue;
        }
        let text = std::fs::read_to_string(&path).expect("source is UTF-8");
        // Tests stand at the end and make their own files.
        let program = text.split("#[cfg(test)]").next().unwrap_or_default();
        for (number, line) in program.lines().enumerate() {
            if words.iter().any(|word| line.contains(word)) {
                found.push(format!("{}:{}", path.display(), number + 1));
            }
        }
    }
    assert!(found.is_empty(), "written past the guard: {found:#?}");
}

#[test]
fn what_a_crate_includes_lies_in_its_folder() {
    // What lies outside would be missing from the published package.
    let mut outside = Vec::new();
    for path in
        files().into_iter().filter(|path| path.starts_with(root().join("crates")) && path.extension().is_some_and(|end| end == "rs"))
    {
        let inside = path.strip_prefix(root().join("crates")).expect("it was found there").components().count() - 2;
        let text = std::fs::read_to_string(&path).expect("source is UTF-8");
        for (number, line) in text.lines().enumerate() {
            let included = line.split(['"']).find(|piece| piece.starts_with("../")).filter(|_| line.contains("include_"));
            if included.is_some_and(|included| included.matches("../").count() > inside) {
                outside.push(format!("{}:{}", path.display(), number + 1));
            }
        }
    }
    assert!(outside.is_empty(), "included from outside of the package: {outside:#?}");
}

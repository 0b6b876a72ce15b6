//! The README pages say what is so: their examples run, their tables are whole, their YAML is what is shipped.

use std::path::Path;
use std::process::Command;

const PAGES: &[&str] = &["README.md", "README.ru.md"];

fn read(name: &str) -> String {
    std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// The example calls of a page, each as its arguments.
fn calls(page: &str) -> Vec<Vec<String>> {
    let calls = page.lines().filter_map(|line| line.strip_prefix("    sinew "));
    calls.map(|call| call.split('#').next().unwrap_or_default().split_whitespace().map(str::to_owned).collect()).collect()
}

#[test]
fn every_example_call_works() {
    let out = tempfile::tempdir().expect("a temporary folder can be made");
    let examples = calls(&read("README.md"));
    assert!(examples.len() >= 8, "{examples:?}");
    for example in &examples {
        // What is read is shipped; what is written must not land in the checkout.
        let whole = |argument: &String| match argument.starts_with("configs/") {
            true => Path::new(env!("CARGO_MANIFEST_DIR")).join(argument).display().to_string(),
            false => argument.clone(),
        };
        let arguments: Vec<String> = example.iter().map(whole).collect();
        let output = Command::new(env!("CARGO_BIN_EXE_sinew"))
            .args(&arguments)
            .current_dir(out.path())
            .env("LC_ALL", "C.UTF-8")
            .output()
            .expect("the program starts");
        assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    }
    assert!(std::fs::read_dir(out.path()).expect("the temporary folder can be read").count() > 10, "pictures were written");
    assert_eq!(examples, calls(&read("README.ru.md")), "both pages have the same examples");
}

#[test]
fn every_finding_is_explained() {
    let others = [
        "image-missing",
        "image-broken",
        "clip-not-opened",
        "muscle-bone-not-found",
        "muscle-joint-not-found",
        "muscle-bent-too-tight",
        "muscle-ends-coincide",
        "muscle-shorter-than-tendons",
        "muscle-poses-not-placed",
        "muscle-too-short",
        "muscle-wrap-inert",
        "moment-arm-changes-sign",
        "muscle-path-jumps",
        "muscle-path-not-found",
        "muscle-wrap-beyond-end",
        "muscle-bow-strings",
        "muscle-through-bone",
        "muscle-too-thick",
        "muscle-outside-skin",
    ];
    let codes = sinew::collada::diagnostic_codes::ALL.iter().map(|(code, _)| *code).chain(others);
    let codes: Vec<&str> = codes.collect();
    for page in PAGES {
        let text = read(page);
        for code in &codes {
            assert!(text.contains(&format!("| `{code}` | ")), "{page} does not explain {code}");
        }
        let rows = text.lines().filter(|line| line.starts_with("| `")).count();
        assert_eq!(rows, codes.len(), "{page} explains a code that is gone");
    }
}

/// YAML without its comments and empty lines: the Russian page has the comments in Russian.
fn without_comments(yaml: &str) -> Vec<String> {
    let lines = yaml.lines().map(|line| if line.trim_start().starts_with('#') { "" } else { line.split(" #").next().unwrap_or_default() });
    lines.map(|line| line.trim_end().to_owned()).filter(|line| !line.is_empty()).collect()
}

#[test]
fn the_yaml_shown_is_the_yaml_shipped() {
    let files = ["configs/biceps.yaml", "configs/example.yaml"].map(read);
    for file in &files {
        assert!(read("README.md").contains(file.trim_end()), "README.md shows another {file}");
    }
    let russian = read("README.ru.md");
    let shown = russian.split("```yaml\n").skip(1).filter_map(|rest| rest.split("```").next());
    let shown: Vec<_> = shown.map(without_comments).collect();
    assert_eq!(shown, files.map(|file| without_comments(&file)), "README.ru.md shows the same keys and values");
}

#[test]
fn every_link_leads_somewhere() {
    for page in PAGES {
        let text = read(page);
        for link in text.split("](").skip(1).filter_map(|rest| rest.split(')').next()).filter(|link| !link.starts_with("http")) {
            assert!(Path::new(env!("CARGO_MANIFEST_DIR")).join(link).is_file(), "{page} links to {link}");
        }
    }
}

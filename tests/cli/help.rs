//! Help pages and wrong calls, in both languages.

use crate::support::{sinew, sinew_ru};

const COMMANDS: [&str; 11] = ["info", "check", "render", "export", "convert", "measure", "fit", "attach", "bench", "completions", "help"];

#[test]
fn every_page_is_there_in_both_languages() {
    let mut pages = vec![vec!["--help"], vec!["-h"]];
    pages.extend(COMMANDS.iter().map(|command| vec![*command, "--help"]));
    for page in pages {
        let english = sinew(&page).well();
        for part in ["Usage:\n  sinew", "Examples:\n  sinew", "--help", "Exit code: 0"] {
            assert!(english.contains(part), "{page:?} lacks {part}:\n{english}");
        }
        let russian = sinew_ru(&page).well();
        for part in ["Вызов:\n  sinew", "Примеры:\n  sinew", "--help", "Код возврата: 0"] {
            assert!(russian.contains(part), "{page:?} lacks {part}:\n{russian}");
        }
        for left in ["Usage", "Options", "default:", "possible values", "Print help", " the ", "cli-", "[OPTIONS]"] {
            assert!(!russian.contains(left), "{page:?} has English left, {left}:\n{russian}");
        }
        assert!(!english.contains("cli-"), "{page:?}:\n{english}");
    }
}

#[test]
fn the_first_page_names_every_command_and_help_shows_each_page() {
    let first = sinew(["--help"]).well();
    for command in COMMANDS {
        assert!(first.contains(&format!("\n  {command}")), "{command}");
        assert_eq!(sinew(["help", command]).well(), sinew([command, "--help"]).well());
    }
    assert_eq!(sinew(["help"]).well(), first);
    assert_eq!(sinew(["--version"]).well().trim(), format!("sinew {}", env!("CARGO_PKG_VERSION")));
}

#[test]
fn help_names_every_option_of_the_contract() {
    let options = |command: &str, names: &[&str]| {
        let page = sinew([command, "--help"]).well();
        for name in names {
            assert!(page.lines().any(|line| line.split([' ', ',']).any(|word| word == *name)), "{command} lacks {name}:\n{page}");
        }
    };
    options("info", &["--json"]);
    options("check", &["--json"]);
    let moment = ["-o", "--time", "--clip", "--angle", "--contraction"];
    options("render", &moment);
    options(
        "render",
        &["--size", "--from", "--to", "--fps", "--camera", "--yaw", "--pitch", "--zoom", "--light", "--shading", "--samples", "--bones"],
    );
    options("render", &["--wireframe", "--no-materials", "--no-normals", "--background", "--turntable", "--threads", "--stats"]);
    options("export", &moment);
    options("render", &["--scale", "--duration", "--sweep-angle", "--sweep-contraction", "--grid", "--axes", "--bounding-box"]);
    for command in ["render", "export"] {
        options(command, &["--force", "-q", "--quiet", "-v", "--verbose"]);
    }
    options(
        "measure",
        &["--angles", "--sweep", "--times", "--joints", "--compare", "--csv", "--json", "--plot", "--scale", "--published", "--force"],
    );
}

/// Wrong calls with a part of what is said about each.
const WRONG: &[(&[&str], &str)] = &[
    (&["render"], "--output"),
    (&["render", "a.dae"], "--output"),
    (&["render", "-o", "a.png"], "FILE"),
    (&["info"], "FILE"),
    (&["check"], "FILE"),
    (&["export", "a.dae"], "--output"),
    (&["measure"], "FILE"),
    (&["info", "a.dae", "b.dae"], "b.dae"),
    (&["--colour"], "--colour"),
    (&["info", "a.dae", "--jason"], "--json"),
    (&["info", "a.dae", "--json=yes"], "--json"),
    (&["info", "a.dae", "--json", "--json"], "--json"),
    (&["render", "a.dae", "-o", "a.bmp"], "a.bmp"),
    (&["render", "a.dae", "-o", "a"], ".png"),
    (&["export", "a.dae", "-o", "a.fbx"], ".obj"),
    (&["render", "a.dae", "-o", "a.png", "--size", "0x0"], "0x0"),
    (&["render", "a.dae", "-o", "a.png", "--size", "1000000x1000000"], "16384"),
    (&["render", "a.dae", "-o", "a.png", "--size", "640"], "640"),
    (&["render", "a.dae", "-o", "a.png", "--size"], "--size"),
    (&["render", "a.dae", "-o", "a.png", "--time", "soon"], "soon"),
    (&["render", "a.dae", "-o", "a.png", "--time", "1,5"], "1.5"),
    (&["render", "a.dae", "-o", "a.png", "--time", "inf"], "inf"),
    (&["render", "a.dae", "-o", "a.png", "--angle", "nan"], "nan"),
    (&["render", "a.dae", "-o", "a.png", "--contraction", "101"], "100"),
    (&["render", "a.dae", "-o", "a.png", "--contraction", "-1"], "100"),
    (&["render", "a.dae", "-o", "a.png", "--zoom", "0"], "--zoom"),
    (&["render", "a.dae", "-o", "a.png", "--pitch", "91"], "--pitch"),
    (&["render", "a.dae", "-o", "a.gif", "--fps", "0"], "--fps"),
    (&["render", "a.dae", "-o", "a.gif", "--fps", "-5"], "--fps"),
    (&["render", "a.dae", "-o", "a.png", "--camera", "back"], "front"),
    (&["render", "a.dae", "-o", "a.png", "--shading", "toon"], "gouraud"),
    (&["render", "a.dae", "-o", "a.png", "--samples", "2"], "--samples"),
    (&["render", "a.dae", "-o", "a.png", "--light", "1,2"], "--light"),
    (&["render", "a.dae", "-o", "a.png", "--background", "#12345"], "#12345"),
    (&["render", "a.dae", "-o", "a.png", "--threads", "0"], "256"),
    (&["render", "a.dae", "-o", "a.png", "--angle", "1", "--contraction", "1"], "--contraction"),
    (&["render", "a.dae", "-o", "a.gif", "--time", "1", "--from", "0"], "--from"),
    (&["measure", "a.yaml", "--angles", "0;30"], "0;30"),
    (&["measure", "a.yaml", "--sweep", "0:90"], "0:90"),
    (&["measure", "a.yaml", "--sweep", "0:90:0"], "0:90:0"),
    (&["measure", "a.yaml", "--sweep", "90:0:5"], "90:0:5"),
    (&["measure", "a.yaml", "--sweep", "0:90:0.0000001"], "100000"),
    (&["measure", "a.yaml", "--angles", "0", "--sweep", "0:1:1"], "--sweep"),
    (&["measure", "a.yaml", "--csv", "--json"], "--csv"),
    (&["bench", "--seconds", "0"], "--seconds"),
    (&["help", "dance"], "dance"),
    (&["rendr", "a.dae"], "render"),
    (&["inof"], "info"),
];

#[test]
fn wrong_calls_get_one_sentence_and_exit_code_2() {
    for (arguments, part) in WRONG {
        let english = sinew(*arguments).refused(2);
        assert!(english.starts_with("sinew: ") && english.contains(part), "{arguments:?}: {english}");
        let russian = sinew_ru(*arguments).refused(2);
        assert!(russian.starts_with("sinew: ") && russian.contains(part), "{arguments:?}: {russian}");
        assert!(russian.chars().any(|c| ('а'..='я').contains(&c)), "{arguments:?}: {russian}");
        assert!(!russian.contains("error") && !russian.contains("cli-"), "{arguments:?}: {russian}");
    }
}

#[test]
fn without_a_display_one_sentence_says_what_to_do() {
    let said = sinew(std::iter::empty::<&str>()).refused(1);
    assert!(said.contains("sinew render"), "{said}");
    let said = sinew_ru(["no-such-file.dae"]).refused(1);
    assert!(said.contains("sinew render"), "{said}");
}

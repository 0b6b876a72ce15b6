//! Calls that cannot be meant so: each is told in one true sentence, in both languages.

use crate::support::{Ended, arg, call, config, folder, models, run, sinew, sinew_ru};

/// Checks that a call ends with `code` and one line in both languages, and returns the English one.
#[track_caller]
fn told(words: &[&str], code: i32) -> String {
    let said = sinew(words).refused(code);
    let russian = sinew_ru(words).refused(code);
    assert!(russian.chars().any(|c| ('а'..='я').contains(&c)), "{words:?}: {russian}");
    assert!(!said.contains("cli-") && !russian.contains("cli-") && !said.contains("document-"), "{said} {russian}");
    said
}

#[test]
fn a_format_that_is_not_read_is_named() {
    let folder = folder();
    for (name, bytes, format) in [
        ("a.fbx", &b"Kaydara FBX Binary  \0\x1A\0"[..], "FBX"),
        ("a.obj", b"# by hand\nv 0 0 0\nf 1 1 1\n", "OBJ"),
        ("a.blend", b"BLENDER-v300", "Blender"),
        ("a.bvh", b"HIERARCHY\nROOT Hips\n", "BVH"),
        ("a.usd", b"PXR-USDC\0\0", "USD"),
        ("a.usdz", b"PK\x03\x04", "USD"),
        ("a.glb", b"glTF\x02\0\0\0", "glTF"),
        ("a.gltf", b"{\"asset\": {\"version\": \"2.0\"}}", "glTF"),
        ("a.png", b"\x89PNG\r\n\x1A\n", "PNG"),
        ("a.c3d", b"\x02\x50\0\0", "C3D"),
        ("a.trc", b"PathFileType\t4\n", "TRC"),
        ("a.osim", b"<?xml version=\"1.0\"?><OpenSimDocument Version=\"30000\">", "OpenSim"),
        // What it is called does not hide what it is.
        ("b.dae", b"glTF\x02\0\0\0", "glTF"),
        ("b.yaml", b"\x89PNG\r\n\x1A\n", "PNG"),
        ("b", b"HIERARCHY\nROOT Hips\n", "BVH"),
    ] {
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).expect("written");
        let out = folder.path().join("out.stl");
        for words in [vec!["info", arg(&path)], vec!["check", arg(&path)], vec!["export", arg(&path), "-o", arg(&out)]] {
            let said = told(&words, 1);
            assert!(said.starts_with(&format!("{}: Sinew does not read {format}", arg(&path))) && said.contains(".dae"), "{said}");
        }
        let said = run(call(["info", "-"]), bytes);
        if !matches!(name, "a.usdz" | "a.c3d") {
            assert!(said.refused(1).starts_with(&format!("standard input: Sinew does not read {format}")), "{name}");
        }
    }
    for (name, bytes, part) in [
        ("c.csv", &b"node,deg0\n1,2\n"[..], "is a table"),
        ("c.dat", b"\0\x01\x02\x03", "is not known"),
        ("c.txt", b"hello world\n", "is not known"),
    ] {
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).expect("written");
        assert!(told(&["info", arg(&path)], 1).contains(part), "{name}");
    }
    // What is read is read, whatever it is called.
    for (name, text) in [("d.fbx", models::column()), ("d.txt", models::BICEPS.to_owned()), ("d", models::BICEPS.to_owned())] {
        let path = models::write(folder.path(), name, &text);
        sinew(["info", arg(&path)]).well();
    }
}

#[test]
fn a_mistyped_command_is_told_as_one() {
    let mistyped = [
        (&["rendr"][..], "render"),
        (&["rendr", "walk.dae"], "render"),
        (&["rendr", "walk.dae", "-o", "walk.png"], "render"),
        (&["redner", "walk.dae", "--size", "8x8"], "render"),
        (&["Info", "walk.dae", "--json"], "info"),
        (&["chekc", "--help"], "check"),
        (&["conver", "a.dae", "a.glb"], "convert"),
        (&["measur", "biceps.yaml", "--angles", "0,30"], "measure"),
    ];
    for (words, meant) in mistyped {
        let expected = format!("sinew: There is neither a file nor a command “{}”; did you mean “{meant}”?", words[0]);
        assert_eq!(told(words, 2), expected);
        // Also where a window could be opened.
        let mut command = call(words);
        command.env("DISPLAY", ":4711");
        assert_eq!(run(command, b"").refused(2), expected);
    }
    assert_eq!(told(&["foo", "bar"], 2), "sinew: There is neither a file nor a command “foo”; see sinew --help.");
    assert_eq!(told(&["help", "rendr"], 2), "sinew: There is no command “rendr”; did you mean render?");
    assert_eq!(told(&["help", "foo"], 2), "sinew: There is no command “foo”; see sinew --help.");
    // A file may be called so.
    let folder = folder();
    models::write(folder.path(), "rendr", &models::column());
    let mut command = call(["rendr"]);
    command.current_dir(folder.path());
    assert!(run(command, b"").refused(1).contains("display") || !cfg!(feature = "gui"));
}

#[test]
fn values_that_make_no_sense_are_told_as_values() {
    let folder = folder();
    let clip = models::write(folder.path(), "column.dae", &models::column());
    let out = folder.path().join("out.gif");
    let render = |more: &[&str]| told(&[&["render", arg(&clip), "-o", arg(&out)][..], more].concat(), 2);
    for (option, value, part) in [
        ("--size", "-1x5", "is not a size"),
        ("--size", "0x5", "is not a size"),
        ("--size", "1000000x1000000", "16384"),
        ("--threads", "-1", "is not a number of threads"),
        ("--threads", "0", "is not a number of threads"),
        ("--threads", "1000000", "256"),
        ("--samples", "-1", "is none of 1, 4"),
        ("--camera", "-1", "is none of orbit"),
        ("--background", "-1", "is not a colour"),
        ("--scale", "NaN", "is not finite"),
        ("--zoom", "inf", "is not finite"),
        ("--fps", "0", "is outside 0.01 to 1000"),
        ("--time", "1e309", "is not finite"),
        ("--angle", "1e308", "is outside -1000000 to 1000000"),
        ("--sweep-angle", "1e308:0", "is outside -360 to 360"),
        ("--sweep-angle", "a", "as in 0:130"),
        ("--sweep-contraction", "-5:10", "is outside 0 to 100"),
        ("--sweep-contraction", "5", "as in 0:100"),
        ("--pitch", "", "is not a number"),
    ] {
        let said = render(&[option, value]);
        assert!(said.starts_with(&format!("sinew: {option}: “{value}”")) && said.contains(part), "{said}");
    }
    let muscle = config("biceps.yaml");
    for (words, part) in [
        (&["--sweep", "1e300:1e300:1"][..], "--sweep: “1e300” is outside"),
        (&["--angles", "0,-1e308"], "--angles: “-1e308” is outside"),
        (&["--angles", "0,NaN"], "is not a list of angles"),
        (&["--sweep", "1:0:1"], "contains no angle"),
        (&["--sweep", "0:1:1e-300"], "gives more than"),
        (&["--clip", "x"], "--times|--joints is missing"),
    ] {
        let said = told(&[&["measure", arg(&muscle)][..], words].concat(), 2);
        assert!(said.contains(part), "{said}");
    }
    assert!(!out.exists());
}

#[test]
fn times_outside_a_movement_are_told_by_its_own_ends() {
    let folder = folder();
    let clip = models::write(folder.path(), "column.dae", &models::column());
    let gif = folder.path().join("out.gif");
    let render = |more: &[&str], code| told(&[&["render", arg(&clip), "-o", arg(&gif), "--size", "8x8"][..], more].concat(), code);
    let late = render(&["--from", "1e308"], 2);
    assert!(late.contains("the animation ends at 1.5 s") && late.contains("--from 1e308") && !late.contains("--to"), "{late}");
    let early = render(&["--to", "-3"], 2);
    assert!(early.contains("the animation starts at 0.5 s") && early.contains("--to -3") && !early.contains("--from"), "{early}");
    assert!(render(&["--from", "1", "--to", "0.75"], 2).contains("--from 1 lies after --to 0.75"));
    assert!(render(&["--from", "-1e308", "--to", "1e308"], 2).contains("more than 100000 frames"));
    // A single moment is held at the ends, as the help says; far outside that is worth a word.
    let png = folder.path().join("out.png");
    let at = |time: &str| sinew(["render", arg(&clip), "-o", arg(&png), "--size", "8x8", "--time", time]);
    let Ended { code, out, err } = at("1e308");
    assert_eq!((code, out.as_str(), err.lines().count()), (0, "", 1), "{err}");
    assert!(err.contains("the clip goes from 0.5 s to 1.5 s"), "{err}");
    for held in ["0", "1.5", "9", "-3"] {
        at(held).well();
    }
}

#[test]
fn a_pattern_has_one_number() {
    let folder = folder();
    let clip = models::write(folder.path(), "column.dae", &models::column());
    let render = |name: &str| {
        let out = folder.path().join(name);
        ["render", arg(&clip), "-o", arg(&out), "--size", "8x8", "--to", "0.6"].map(str::to_owned)
    };
    for name in ["a-%d-%d.png", "%04d%2d.png"] {
        let said = told(&render(name).each_ref().map(String::as_str), 2);
        assert!(said.contains("has two number patterns"), "{said}");
    }
    sinew(render("a-%d-%%d.png")).well();
    assert!(folder.path().join("a-0-%d.png").is_file());
    // A folder's name is what it is.
    std::fs::create_dir(folder.path().join("100%done")).expect("made");
    sinew(render("100%done/f-%d.png")).well();
    assert!(folder.path().join("100%done/f-2.png").is_file());
}

#[test]
fn one_file_has_no_place_for_a_number() {
    let folder = folder();
    let clip = models::write(folder.path(), "column.dae", &models::column());
    let (csv, muscle) = (config("biceps-radii.csv"), config("biceps.yaml"));
    let at = |ending: &str| folder.path().join(format!("f-%d.{ending}")).to_string_lossy().into_owned();
    let mut calls: Vec<Vec<String>> = Vec::new();
    let mut add = |words: &[&str]| calls.push(words.iter().map(|word| (*word).to_owned()).collect());
    for ending in ["gif", "apng", "mp4", "webm"] {
        add(&["render", arg(&clip), "-o", &at(ending)]);
    }
    for ending in ["obj", "ply", "stl"] {
        add(&["export", arg(&clip), "-o", &at(ending)]);
    }
    for ending in ["glb", "gltf"] {
        add(&["convert", arg(&clip), &at(ending)]);
    }
    for ending in ["yaml", "yml"] {
        add(&["fit", arg(&csv), "-o", &at(ending)]);
    }
    for ending in ["png", "svg"] {
        add(&["measure", arg(&muscle), "--plot", &at(ending)]);
    }
    for words in &calls {
        let words: Vec<&str> = words.iter().map(String::as_str).collect();
        let said = told(&words, 2);
        assert!(
            said.contains("f-%d.") && said.contains("is for numbered images") && said.contains("this command writes one file"),
            "{said}"
        );
    }
    assert_eq!(std::fs::read_dir(folder.path()).expect("there").count(), 1, "nothing was written");
}

#[cfg(unix)]
#[test]
fn what_the_system_refuses_is_told_without_its_numbers() {
    let folder = folder();
    let clip = models::write(folder.path(), "column.dae", &models::column());
    let at = |name: &str| folder.path().join(name);
    std::os::unix::fs::symlink("round.dae", at("round.dae")).expect("links work");
    let long = format!("{}.dae", "x".repeat(300));
    for (name, part) in [
        ("column.dae/a.dae", "a part of the path is not a folder."),
        ("round.dae", "symbolic links form a cycle."),
        (&long, "the file system does not allow this name."),
    ] {
        let path = at(name);
        for words in [&["info", arg(&path)][..], &["check", arg(&path)], &["render", arg(&path), "-o", "x.png"]] {
            let said = told(words, 1);
            assert!(said.ends_with(part) && !said.contains("os error"), "{said}");
        }
    }
    // A result is told by the name that it was asked for by, also where another file belongs to it.
    for (name, part) in [
        ("no/such/out.obj", "the folder does not exist."),
        ("column.dae/out.obj", "a part of the path is not a folder."),
        ("no/such/out.stl", "the folder does not exist."),
    ] {
        let out = at(name);
        let said = told(&["export", arg(&clip), "-o", arg(&out)], 1);
        assert!(said.starts_with(arg(&out)) && said.ends_with(part) && !said.contains("os error"), "{said}");
    }
    // The other one is named where it alone stands in the way.
    std::fs::create_dir(at("out.mtl")).expect("made");
    let said = told(&["export", arg(&clip), "-o", arg(&at("out.obj"))], 1);
    assert!(said.contains("out.mtl: This is a folder"), "{said}");
    assert!(!at("out.obj").exists());
}

#[test]
fn files_of_the_wrong_kind_are_told_so() {
    let folder = folder();
    let cube = models::write(folder.path(), "cube.dae", &models::cube("1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"));
    let csv = config("biceps-radii.csv");
    let out = folder.path().join("out.yaml");
    assert!(told(&["measure", arg(&cube), "--joints"], 2).ends_with("has no joint and no clip that would move one; remove --joints."));
    let lamp = models::write(
        folder.path(),
        "plate.dae",
        &models::column()
            .replace(" type=\"JOINT\"", "")
            .replace("instance_controller url=\"#skin\"", "instance_geometry url=\"#column\"")
            .replace("</instance_controller>", "</instance_geometry>")
            .replace("<skeleton>#lower-bone</skeleton>", ""),
    );
    assert!(told(&["measure", arg(&lamp), "--joints"], 1).ends_with("This file has no joint, so nothing can be measured."));
    let said = told(&["fit", arg(&csv), "--like", arg(&cube), "-o", arg(&out)], 1);
    assert!(said.starts_with(arg(&cube)) && said.contains("--like needs a muscle file"), "{said}");
    assert!(told(&["fit", arg(&csv), "--like", arg(&csv), "-o", arg(&out)], 1).contains("is a table"));
    for (words, part) in [
        (&["info", ""][..], "FILE is empty"),
        (&["render", "-", "-", "-o", "x.png"], "standard input can be read only once"),
        (&["fit", "-", "--like", "-", "-o", "x.yaml"], "standard input can be read only once"),
        (&["render", arg(&cube), "-o", ".png"], ".png consists of an ending only"),
        (&["fit", arg(&csv), "-o", ".yaml"], ".yaml consists of an ending only"),
        (&["render", arg(&cube), "-o", "x"], "the name must end in"),
        (&["bench", "--scene", "nosuch", "--seconds", "0.01"], "No scene has “nosuch”"),
    ] {
        let said = told(words, 2);
        assert!(said.contains(part), "{said}");
    }
    // Measured radii may come from standard input, as every file may.
    let radii = std::fs::read(&csv).expect("there");
    run(call(["fit", "-", "-o", arg(&out)]), &radii).well();
    assert!(out.is_file());
    run(call(["measure", arg(&config("biceps-measured.yaml")), "--compare", "-", "--json"]), &radii).json();
}

/// Runs a call with no more than so many kB of addresses.
fn in_little_memory(kilobytes: u32, words: &[&str]) -> Ended {
    let mut command = std::process::Command::new("sh");
    let own = call(words);
    command.args(["-c", &format!("ulimit -v {kilobytes}; exec \"$0\" \"$@\"")]).arg(own.get_program()).args(own.get_args());
    command.env_remove("LC_ALL").env_remove("LC_MESSAGES").env("LANG", "C.UTF-8");
    run(command, b"")
}

#[test]
fn pictures_for_which_there_is_no_memory_are_refused_in_one_sentence() {
    let folder = folder();
    let out = folder.path().join("out");
    let curl = config("curl-muscles.yaml");
    for (ending, more) in [("png", &["--time", "0"][..]), ("gif", &["--fps", "2"]), ("apng", &["--fps", "2"])] {
        let file = out.with_extension(ending);
        let words = [&["render", arg(&curl), "-o", arg(&file), "--size", "16384x16384"], more].concat();
        let said = in_little_memory(800_000, &words).refused(1);
        assert_eq!(said, format!("{}: The file could not be written: there is not enough memory for it.", file.display()));
    }
    let plot = out.with_extension("png");
    let said = in_little_memory(150_000, &["measure", arg(&config("atlas-muscles.yaml")), "--plot", arg(&plot), "--scale", "8"]).refused(1);
    assert!(said.contains("There is not enough memory for an image of this size"), "{said}");
    assert_eq!(std::fs::read_dir(folder.path()).expect("there").count(), 0);
}

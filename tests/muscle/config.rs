//! Muscle files: what is read, what is refused and where, and that what is written reads back the same.

use proptest::prelude::*;
use sinew::muscle::{Form, MuscleFile, MuscleRig};
use sinew::scene::{MuscleId, Scene};

const SHIPPED: [&str; 5] = [
    include_str!("../../configs/biceps.yaml"),
    include_str!("../../configs/biceps-measured.yaml"),
    include_str!("../../configs/biceps-human.yaml"),
    include_str!("../../configs/biceps-human-wrapped.yaml"),
    include_str!("../../configs/example.yaml"),
];

/// A good file in the report's form with one line replaced.
fn report(find: &str, replace: &str) -> String {
    let good = "muscle_config:\n  radiuses: [5.0, 9.0, 5.0]\n  grow_mults: [0.0, 1.0, 0.0]\n  len: 250.0\n\
                carcass_config:\n  data: [[30.0, 230.0], [30.0, 120.0]]\n  thickness: 5.0\n";
    assert!(good.contains(find), "{find}");
    good.replace(find, replace)
}

/// A good file in the richer form with one part replaced.
fn rich(find: &str, replace: &str) -> String {
    let good = "unit: cm\narm: {upper: 33, forearm: 26, thickness: 1}\nmuscles:\n  - name: A\n    length: 30\n    radii: [1, 2, 1]\n    growth: [0, 1, 0]\n    \
                origin: {bone: upper arm, offset: [0, -3, 0]}\n    insertion: {bone: forearm, offset: [0, -5, 0]}\n";
    assert!(good.contains(find), "{find}");
    good.replace(find, replace)
}

#[test]
fn shipped_files_read_build_and_round_trip() {
    for text in SHIPPED {
        let file = MuscleFile::parse(text).unwrap_or_else(|error| panic!("{error}\n{text}"));
        let again = MuscleFile::parse(&file.to_yaml()).unwrap();
        assert_eq!(again, file);
        let rig = MuscleRig::build(&file, "test", &mut Scene::default(), MuscleId(0));
        assert_eq!(rig.len(), file.muscles.len());
        assert!(rig.findings().is_empty(), "{:?}", rig.findings());
    }
}

#[test]
fn the_reports_form_says_what_it_says() {
    let file = MuscleFile::parse(SHIPPED[1]).unwrap();
    assert_eq!(file.form, Form::Report);
    assert_eq!(file.unit_metres, 0.001);
    let arm = file.arm.unwrap();
    assert_eq!((arm.upper, arm.lower, arm.thickness), (250.0, 150.0, 5.0));
    let muscle = &file.muscles[0];
    assert_eq!(muscle.profile.radii()[2], 18.2);
    assert_eq!(muscle.profile.growth()[2], -3.0);
    assert_eq!(muscle.origin.as_ref().unwrap().offset.y, -30.0);
    assert_eq!(muscle.insertion.as_ref().unwrap().offset.y, -30.0);
    assert!(file.to_yaml().starts_with("muscle_config:"));
    // A leading document mark, a BOM and Windows line ends change nothing.
    assert_eq!(MuscleFile::parse(&format!("\u{feff}---\r\n{}", SHIPPED[1].replace('\n', "\r\n"))).unwrap(), file);
    // A rod's part that vanishes beside the other stays a part, and the form the report's.
    for data in ["[[8.9e82, 230.0], [30.0, 120.5]]", "[[30.0, 230.0], [8.9e82, 1.0]]"] {
        let text = format!(
            "muscle_config:\n  radiuses: [1.0, 2.0]\n  grow_mults: [1.0, 1.0]\n  len: 9.0\ncarcass_config:\n  data: {data}\n  thickness: 2.0\n"
        );
        let vanishing = MuscleFile::parse(&text).unwrap();
        assert_eq!(MuscleFile::parse(&vanishing.to_yaml()).unwrap(), vanishing);
    }
    // What the report's form cannot say is written in the richer one.
    let mut named = file;
    named.muscles[0].name = "Biceps: \"left\"\n#1 – сгибатель \u{7f}\u{2028}".to_owned();
    let text = named.to_yaml();
    assert!(text.starts_with("unit: mm"));
    let again = MuscleFile::parse(&text).unwrap();
    assert_eq!((again.muscles, again.arm), (named.muscles, named.arm));
}

#[test]
fn units_are_names_or_metres() {
    for (unit, metres) in [("mm", 0.001), ("cm", 0.01), ("m", 1.0), ("in", 0.0254), ("0.3048", 0.3048)] {
        assert_eq!(MuscleFile::parse(&rich("unit: cm", &format!("unit: {unit}"))).unwrap().unit_metres, metres);
    }
}

#[test]
fn bad_files_are_refused_with_place_and_remedy() {
    // Text, line, column (0 = any), and words that the message must hold.
    let table: Vec<(String, u32, u32, &[&str])> = vec![
        (String::new(), 1, 1, &["empty", "muscle_config"]),
        ("# only a comment\n".into(), 1, 1, &["empty"]),
        ("[1, 2]\n".into(), 1, 1, &["file", "list"]),
        ("muscle_config: [\n".into(), 2, 0, &["not valid YAML"]),
        (report("len: 250.0", "len: 250.0\n  length: 3"), 5, 3, &["length", "len"]),
        (report("radiuses", "radius"), 2, 3, &["radius", "did you mean “radiuses”"]),
        (report("carcass_config", "carcas_config"), 5, 1, &["did you mean “carcass_config”"]),
        (report("len: 250.0", "len: long"), 4, 8, &["len", "number", "text"]),
        (report("len: 250.0", "len: \"250,5\""), 4, 8, &["250.5", "point"]),
        (report("len: 250.0", "len: -1"), 4, 8, &["len", "above 0"]),
        (report("len: 250.0", "len: 0"), 4, 8, &["above 0"]),
        (report("len: 250.0", "len: .inf"), 4, 8, &["infinite"]),
        (report("  len: 250.0\n", ""), 2, 3, &["missing", "len"]),
        (report("[5.0, 9.0, 5.0]", "[5.0, -9.0, 5.0]"), 2, 19, &["radiuses 2", "-9"]),
        (report("[5.0, 9.0, 5.0]", "[5.0, .nan, 5.0]"), 2, 19, &["not a number"]),
        (report("[5.0, 9.0, 5.0]", "[5.0, true, 5.0]"), 2, 19, &["number", "true"]),
        (report("[5.0, 9.0, 5.0]", "{a: 1}"), 2, 13, &["list"]),
        (report("[5.0, 9.0, 5.0]", "[5.0, 9.0]"), 3, 15, &["2 radii", "3 growth"]),
        (report("[0.0, 1.0, 0.0]", "[0.0, 0.0, 0.0]"), 3, 15, &["growth", "0"]),
        (report("[5.0, 9.0, 5.0]", "[0, 0, 0]"), 2, 13, &["radii are 0"]),
        (report("[[30.0, 230.0], [30.0, 120.0]]", "[[30.0, 230.0]]"), 6, 9, &["two rods"]),
        (report("[[30.0, 230.0], [30.0, 120.0]]", "[[30.0], [30.0, 120.0]]"), 6, 10, &["2 numbers", "1"]),
        (report("230.0", "-230.0"), 6, 17, &["0 or more"]),
        (report("230.0", "0"), 6, 10, &["elbow"]),
        (report("thickness: 5.0", "thickness: 0"), 7, 14, &["thickness", "above 0"]),
        (report("thickness: 5.0", "thickness: 5.0\n---\na: 1"), 8, 1, &["second document"]),
        (report("len: 250.0", "len: !big 250.0"), 4, 8, &["number", "tag"]),
        ("muscle_config:\n  radiuses: [1.0]\n  grow_mults: [1.0]\n  len: 5\n".into(), 2, 13, &["at least 2 nodes"]),
        (rich("unit: cm", "unit: parsec"), 1, 7, &["parsec", "mm"]),
        (rich("unit: cm", "unit: -2"), 1, 7, &["above 0"]),
        (rich("upper: 33", "uper: 33"), 2, 7, &["did you mean “upper”"]),
        (rich("bone: forearm", "bone: fore arm"), 9, 23, &["forearm", "upper arm"]),
        (rich("    insertion: {bone: forearm, offset: [0, -5, 0]}\n", ""), 4, 0, &["origin", "insertion"]),
        (rich("    length: 30\n", "    color: red\n    length: 30\n"), 5, 12, &["colour", "#B8322E"]),
        (
            rich("    length: 30\n", "    wrap: {bone: upper arm, radius: 1, side: [0, 0, 0]}\n    length: 30\n"),
            5,
            46,
            &["side", "direction"],
        ),
        (rich("thickness: 1}", "thickness: 1, flexion: [90, 10]}"), 2, 0, &["least", "greatest"]),
        ("unit: mm\nmuscles: []\n".into(), 2, 10, &["at least one"]),
        ("unit: mm\n".into(), 1, 1, &["missing", "muscles"]),
    ];
    sinew::i18n::set_language(sinew::i18n::Language::English);
    for (text, line, column, words) in table {
        let error = MuscleFile::parse(&text).expect_err(&text);
        assert_eq!(error.line, Some(line), "{error}\n{text}");
        if column > 0 {
            assert_eq!(error.column, Some(column), "{error}\n{text}");
        }
        for word in words {
            assert!(error.message.contains(word), "“{word}” is not in: {}\n{text}", error.message);
        }
    }
}

#[test]
fn aliases_and_depth_cannot_eat_memory() {
    let mut bomb = String::from("a0: &a0 [1,1,1,1,1,1,1,1,1,1]\n");
    for level in 1..12 {
        let below = vec![format!("*a{}", level - 1); 10].join(",");
        bomb += &format!("a{level}: &a{level} [{below}]\n");
    }
    let staircase: String = (0..3000).map(|level| format!("{:level$}a:\n", "")).collect();
    let texts = [
        bomb,
        "[".repeat(1 << 20),
        "{a: ".repeat(1 << 20),
        "- ".repeat(1 << 20),
        "? ".repeat(1 << 20),
        "a: ".repeat(1 << 20),
        "-\n".repeat(1 << 20),
        "&a ".repeat(1 << 20),
        "!a ".repeat(1 << 20),
        "[a, ".repeat(90) + &"a, ".repeat(1 << 20),
        "x".repeat(5 << 20),
        "a: &a [*a]".to_owned(),
        "\"".repeat(1 << 20),
        "a: b\n".repeat(1 << 18),
        (0..1 << 17).map(|i| format!("k{i}: 1\n")).collect(),
        staircase,
    ];
    for text in texts {
        let start = std::time::Instant::now();
        assert!(MuscleFile::parse(&text).is_err());
        let (seconds, beginning) = (start.elapsed().as_secs_f64(), text.chars().take(12).collect::<String>());
        assert!(seconds < 120.0, "{beginning:?} took {seconds} s");
    }
}

proptest! {
    #[test]
    fn any_report_file_round_trips(
        nodes in prop::collection::vec((0.0..50.0_f64, -10.0..20.0_f64), 2..12),
        length in 0.001..1e6_f64,
        (a, p, d, b, t) in (0.0..100.0_f64, 0.1..1000.0_f64, 0.1..100.0_f64, 0.0..300.0_f64, 0.1..30.0_f64),
    ) {
        let (radii, growth): (Vec<f64>, Vec<f64>) = nodes.into_iter().unzip();
        prop_assume!(radii.iter().any(|r| *r > 1e-3) && growth.iter().any(|m| m.abs() > 1e-3));
        let text = format!("muscle_config:\n  radiuses: {radii:?}\n  grow_mults: {growth:?}\n  len: {length:?}\ncarcass_config:\n  data: [[{a:?}, {p:?}], [{d:?}, {b:?}]]\n  thickness: {t:?}\n");
        let file = MuscleFile::parse(&text).unwrap();
        let written = file.to_yaml();
        let again = MuscleFile::parse(&written).unwrap();
        prop_assert_eq!(again.arm, file.arm, "{}", written);
        prop_assert_eq!(again.muscles, file.muscles);
    }

    #[test]
    fn no_text_makes_the_reader_panic(text in "(muscle_config|radiuses|len|[-:\\[\\]{}&*!|>'\"%@, \n0-9.#~]){0,40}") {
        let _ = MuscleFile::parse(&text);
    }
}

//! Muscle files: what is read, what is refused and where, and that what is written reads back the same.

use proptest::prelude::*;
use sinew::i18n::{Language, Sentence};
use sinew::muscle::config::{ConfigErrorKind as Kind, ValueName, WantedKind};
use sinew::muscle::{Form, MuscleFile, MuscleRig, ProfileError};
use sinew::scene::{MuscleId, Scene};
use sinew::yaml::{SyntaxReason, ValueKind, YamlErrorKind};

use crate::in_each_language;

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

/// What errors call a value.
fn name(key: &'static str, items: &[usize]) -> ValueName {
    ValueName { key: Some(key), items: items.to_vec() }
}

/// Texts that are refused, with line, column (0 = any) and what is wrong.
fn refused() -> Vec<(String, u32, u32, Kind)> {
    use {ValueKind as Found, WantedKind as Wanted};
    const MUSCLE: &[&str] = &["radiuses", "grow_mults", "len"];
    let wrong = |name, wanted, found| Kind::WrongType { name, wanted, found };
    let unknown = |key: &str, near, known| Kind::UnknownKey { key: key.to_owned(), near, known };
    vec![
        (String::new(), 1, 1, Kind::Empty),
        ("# only a comment\n".into(), 1, 1, Kind::Empty),
        ("[1, 2]\n".into(), 1, 1, wrong(ValueName { key: None, items: Vec::new() }, Wanted::Map, Found::List)),
        ("muscle_config: [\n".into(), 2, 0, Kind::Yaml(YamlErrorKind::Syntax(SyntaxReason::Value))),
        (report("len: 250.0", "len: 250.0\n  length: 3"), 5, 3, unknown("length", None, MUSCLE)),
        (report("radiuses", "radius"), 2, 3, unknown("radius", Some("radiuses"), MUSCLE)),
        (
            report("carcass_config", "carcas_config"),
            5,
            1,
            unknown("carcas_config", Some("carcass_config"), &["muscle_config", "carcass_config"]),
        ),
        (report("len: 250.0", "len: long"), 4, 8, wrong(name("len", &[]), Wanted::Number, Found::Text)),
        (report("len: 250.0", "len: \"250,5\""), 4, 8, Kind::NumberAsText { name: name("len", &[]), text: "250,5".into() }),
        (report("len: 250.0", "len: -1"), 4, 8, Kind::NotPositive { name: name("len", &[]), value: -1.0 }),
        (report("len: 250.0", "len: 0"), 4, 8, Kind::NotPositive { name: name("len", &[]), value: 0.0 }),
        (report("len: 250.0", "len: .inf"), 4, 8, Kind::NotFinite(name("len", &[]))),
        (report("  len: 250.0\n", ""), 2, 3, Kind::MissingKey { key: "len", name: name("muscle_config", &[]) }),
        (report("[5.0, 9.0, 5.0]", "[5.0, -9.0, 5.0]"), 2, 19, Kind::Negative { name: name("radiuses", &[2]), value: -9.0 }),
        (report("[5.0, 9.0, 5.0]", "[5.0, .nan, 5.0]"), 2, 19, Kind::NotFinite(name("radiuses", &[2]))),
        (report("[5.0, 9.0, 5.0]", "[5.0, true, 5.0]"), 2, 19, wrong(name("radiuses", &[2]), Wanted::Number, Found::Bool)),
        (report("[5.0, 9.0, 5.0]", "{a: 1}"), 2, 13, wrong(name("radiuses", &[]), Wanted::List, Found::Map)),
        (report("[5.0, 9.0, 5.0]", "[5.0, 9.0]"), 3, 15, Kind::Profile(ProfileError::LengthsDiffer { radii: 2, growth: 3 })),
        (report("[0.0, 1.0, 0.0]", "[0.0, 0.0, 0.0]"), 3, 15, Kind::Profile(ProfileError::NoGrowth)),
        (report("[5.0, 9.0, 5.0]", "[0, 0, 0]"), 2, 13, Kind::Profile(ProfileError::NoRadius)),
        (report("[[30.0, 230.0], [30.0, 120.0]]", "[[30.0, 230.0]]"), 6, 9, Kind::NotTwoRods(1)),
        (
            report("[[30.0, 230.0], [30.0, 120.0]]", "[[30.0], [30.0, 120.0]]"),
            6,
            10,
            Kind::WrongCount { name: name("data", &[1]), wanted: 2, found: 1 },
        ),
        (report("230.0", "-230.0"), 6, 17, Kind::Negative { name: name("data", &[1, 2]), value: -230.0 }),
        (report("230.0", "0"), 6, 10, Kind::AttachedAtElbow(name("data", &[1]))),
        (report("thickness: 5.0", "thickness: 0"), 7, 14, Kind::NotPositive { name: name("thickness", &[]), value: 0.0 }),
        (report("thickness: 5.0", "thickness: 5.0\n---\na: 1"), 8, 1, Kind::Yaml(YamlErrorKind::SeveralDocuments)),
        (report("len: 250.0", "len: !big 250.0"), 4, 8, wrong(name("len", &[]), Wanted::Number, Found::Tagged)),
        ("muscle_config:\n  radiuses: [1.0]\n  grow_mults: [1.0]\n  len: 5\n".into(), 2, 13, Kind::Profile(ProfileError::TooFewNodes(1))),
        (rich("unit: cm", "unit: parsec"), 1, 7, Kind::UnknownUnit("parsec".into())),
        (rich("unit: cm", "unit: -2"), 1, 7, Kind::NotPositive { name: name("unit", &[]), value: -2.0 }),
        (rich("upper: 33", "uper: 33"), 2, 7, unknown("uper", Some("upper"), &["upper", "forearm", "thickness", "flexion"])),
        (rich("bone: forearm", "bone: fore arm"), 9, 23, Kind::UnknownArmBone { bone: "fore arm".into(), near: "forearm" }),
        (rich("    insertion: {bone: forearm, offset: [0, -5, 0]}\n", ""), 4, 0, Kind::OneEnd(name("muscles", &[1]))),
        (rich("    length: 30\n", "    color: red\n    length: 30\n"), 5, 12, Kind::BadColor("red".into())),
        (
            rich("    length: 30\n", "    wrap: {bone: upper arm, radius: 1, side: [0, 0, 0]}\n    length: 30\n"),
            5,
            46,
            Kind::NoDirection(name("side", &[])),
        ),
        (
            rich("thickness: 1}", "thickness: 1, flexion: [90, 10]}"),
            2,
            0,
            Kind::BadRange { name: name("flexion", &[]), least: 0.0, most: 180.0 },
        ),
        ("unit: mm\nmuscles: []\n".into(), 2, 10, Kind::NoMuscles),
        ("unit: mm\n".into(), 1, 1, Kind::MissingKey { key: "muscles", name: ValueName { key: None, items: Vec::new() } }),
    ]
}

#[test]
fn bad_files_are_refused_with_place_and_kind() {
    for (text, line, column, kind) in refused() {
        let error = MuscleFile::parse(&text).expect_err(&text);
        assert_eq!((error.line, &error.kind), (Some(line), &kind), "{text}");
        if column > 0 {
            assert_eq!(error.column, Some(column), "{error}\n{text}");
        }
    }
}

#[test]
fn errors_are_sentences_with_the_remedy_in_both_languages() {
    let words = |text: String, english: &'static str, russian: &'static str| (text, english, russian);
    let examples = [
        words(report("radiuses", "radius"), "did you mean “radiuses”", "«radiuses»"),
        words(report("len: 250.0", "len: \"250,5\""), "write the number as 250.5", "250.5"),
        words(report("[5.0, 9.0, 5.0]", "[5.0, -9.0, 5.0]"), "“radiuses 2” is -9; it must be 0 or more.", "«radiuses 2»"),
        words("[1, 2]\n".into(), "“the file” must be", "«файл»"),
        words(report("[5.0, 9.0, 5.0]", "[5.0, 9.0]"), "2 radii but 3 growth multipliers", "2"),
        words(rich("unit: cm", "unit: parsec"), "Unknown unit “parsec”; write mm", "«parsec»"),
        words(rich("    length: 30\n", "    color: red\n    length: 30\n"), "#B8322E", "#B8322E"),
    ];
    in_each_language(|language| {
        for (text, ..) in refused() {
            let said = MuscleFile::parse(&text).expect_err(&text).sentence();
            assert!(!said.contains("muscle-") && !said.contains("yaml-") && !said.contains("{ $"), "{said}");
            assert!(said.ends_with('.'), "{said}");
            assert_eq!(said.chars().any(|letter| ('а'..='я').contains(&letter)), language == Language::Russian, "{said}");
        }
        for (text, english, russian) in &examples {
            let said = MuscleFile::parse(text).expect_err(text).sentence();
            let words = if language == Language::English { english } else { russian };
            assert!(said.contains(words), "“{words}” is not in: {said}\n{text}");
        }
    });
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

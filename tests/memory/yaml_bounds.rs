//! Whatever a YAML text asks for, it is read or refused within bounds: sessions, muscles, settings and what is kept for recovery alike. Memory and work
//! are counted, not timed.

use crate::counting::{allocations, peak};
use proptest::prelude::*;
use sinew::i18n::Sentence;
use sinew::limits;
use sinew::muscle::MuscleFile;
use sinew::view::{RecoveryFile, SessionState, Settings};
use sinew::yaml::{Node, Value, read};

/// Most memory that any text may take, whatever reads it, bytes.
const MEMORY: usize = 64 << 20;

/// All four readers on a text; what each says of it, `None` where it takes it.
fn refusals(text: &str) -> [Option<String>; 4] {
    let session =
        SessionState::parse(text).map_or_else(|| Some("no session".to_owned()), |read| read.err().map(|error| error.kind.sentence()));
    [
        session,
        MuscleFile::parse(text).err().map(|error| error.sentence()),
        Settings::parse(text).err().map(|error| error.sentence()),
        RecoveryFile::parse(text).err().map(|error| error.sentence()),
    ]
}

/// Reads the text with every reader and holds each to the bounds.
fn stays_small(text: &str) -> [Option<String>; 4] {
    let before = allocations();
    let (said, bytes) = peak(|| refusals(text));
    let work = allocations() - before;
    // A value behind an alias stands in the muscle reader’s tree once for each time, in less than 200 bytes with its key and the list around it.
    let most = MEMORY.min(4_000_000 + 200 * limits::YAML_VALUES + 60 * text.len());
    assert!(bytes <= most, "{} bytes of text took {bytes}", text.len());
    // A value is a few allocations in each reader; what is behind an alias is met again by whoever walks the tree.
    assert!(
        work <= 100_000 + 40 * text.len().min(4 * limits::YAML_VALUES) + 6 * limits::YAML_VALUES,
        "{} bytes of text: {work}",
        text.len()
    );
    said.into_iter().flatten().for_each(|sentence| assert!(!sentence.contains('\n') && sentence.len() < 600, "{sentence}"));
    refusals(text)
}

/// The text under the keys that make it a session, and as it is.
fn both(text: &str) -> [String; 2] {
    [text.to_owned(), format!("sinew_session: {{time: 1}}\nrest:\n  {}", text.replace('\n', "\n  "))]
}

pub(crate) fn what_the_parser_would_choke_on_is_refused_or_read() {
    let n = 200_000;
    let chain: String = (1..60).map(|i| format!("a{i}: &a{i} [*a{}, *a{}]\n", i - 1, i - 1)).collect();
    let wide: String = (1..9).map(|i| format!("a{i}: &a{i} [{}]\n", vec![format!("*a{}", i - 1); 10].join(", "))).collect();
    let maps: String = (1..40).map(|i| format!("a{i}: &a{i} {{x: *a{0}, y: *a{0}}}\n", i - 1)).collect();
    let merges: String = (1..40).map(|i| format!("a{i}: &a{i}\n  <<: [*a{0}, *a{0}]\n", i - 1)).collect();
    let long = "A".repeat(n / 2);
    let sawtooth: String = (0..40).flat_map(|_| (0..95).map(|level| format!("{:level$}a:\n", ""))).collect();
    let shapes = [
        ("brackets", "[".repeat(n), true),
        ("braces", "{".repeat(n), true),
        ("brackets behind comments", "[ #]\n".repeat(n / 5), true),
        ("brackets behind quotes", "[ \"]\", ".repeat(n / 7), true),
        ("pairs in brackets", "[a: ".repeat(n / 4), true),
        ("dashes", "- ".repeat(n / 2), true),
        ("question marks", "? ".repeat(n / 2), true),
        ("colons", ": ".repeat(n / 2), true),
        ("dashes by indentation", (0..300).map(|level| format!("{:level$}-\n", "")).collect(), true),
        ("keys by indentation", (0..300).map(|level| format!("{:level$}a:\n", "")).collect(), true),
        ("a saw of indentation", sawtooth, false),
        ("tags", format!("{}1", "!a [".repeat(n / 4)), true),
        ("anchors on brackets", (0..n / 10).map(|i| format!("&a{i} [")).collect(), true),
        ("a chain of pairs", format!("a0: &a0 [1, 1]\n{chain}"), true),
        ("a chain of tens", format!("a0: &a0 [1, 1]\n{wide}"), true),
        ("a chain of maps", format!("a0: &a0 {{x: 1}}\n{maps}"), true),
        ("a chain of merges", format!("a0: &a0 {{x: 1}}\n{merges}"), true),
        (
            "a chain one deep each",
            format!("a0: &a0 [1]\n{}", (1..200).map(|i| format!("a{i}: &a{i} [*a{}]\n", i - 1)).collect::<String>()),
            true,
        ),
        ("one long text, often", format!("x: &x \"{long}\"\ny: [{}]", "*x,".repeat(n / 10)), true),
        ("long keys, often", format!("x: &x \"{long}\"\ny: [{}]", "{*x : 1},".repeat(n / 20)), true),
        ("an alias in itself", "a: &a [1, *a]".to_owned(), true),
        ("an alias of nothing", "a: *a".to_owned(), true),
        ("values", format!("a: [{}]", "1,".repeat(2 * n)), true),
        ("nothing, often", format!("a: [{}]", "~,".repeat(2 * n)), true),
        ("keys", (0..2 * n).map(|i| format!("k{i}: 1\n")).collect(), true),
        ("directives", format!("{}--- 1", (0..n / 14).map(|i| format!("%TAG !a{i}! x\n")).collect::<String>()), true),
        // Indented, as under the keys of a session, such marks are words.
        ("documents", "---\n".repeat(n / 4), false),
        ("comments", "#\n".repeat(n / 2), false),
        ("blank lines", "\n".repeat(n), false),
        ("an open quote", format!("a: \"{long}"), true),
        ("lines in quotes", format!("a: \"{}\"", "x\n".repeat(n / 2)), false),
        ("a block of lines", format!("a: |\n{}", "  x\n".repeat(n / 4)), false),
        ("digits", format!("a: {}", "1".repeat(n)), false),
        ("too much", " ".repeat(limits::RECOVERY_BYTES as usize + 1), true),
    ];
    for (what, text, refused) in shapes {
        for text in both(&text) {
            let said = stays_small(&text);
            if refused {
                for (reader, said) in ["session", "muscles", "settings", "recovery"].iter().zip(&said) {
                    assert!(said.is_some(), "{what}: {reader} takes it");
                }
            }
        }
    }
}

pub(crate) fn a_second_document_is_refused() {
    assert!(stays_small(&"---\n".repeat(50_000)).iter().all(Option::is_some));
}

pub(crate) fn limits_are_named() {
    let deep = format!("sinew_session: {}", "[".repeat(101));
    for said in refusals(&deep).into_iter().flatten() {
        assert!(said.contains("100") || said.contains("session"), "{said}");
    }
    let many = format!("sinew_session:\n  files: [{}]", "a.dae,".repeat(limits::SESSION_FILES + 1));
    let error = SessionState::parse(&many).expect("a session").expect_err("too many files");
    assert!(error.kind.sentence().contains("101") && error.kind.sentence().contains("100"), "{}", error.kind.sentence());
    let fits = format!("sinew_session:\n  files: [{}]", "a.dae,".repeat(limits::SESSION_FILES));
    assert!(SessionState::parse(&fits).expect("a session").is_ok());
}

pub(crate) fn the_product_of_nodes_and_muscles_is_bounded_before_anything_is_built() {
    let file = |muscles: usize, nodes: usize| {
        let (radii, growth) = (vec!["9"; nodes].join(","), vec!["1"; nodes].join(","));
        let first = format!("muscles:\n  - {{length: 267, radii: &r [{radii}], growth: &g [{growth}]}}\n");
        first + &"  - {length: 267, radii: *r, growth: *g}\n".repeat(muscles - 1)
    };
    for (muscles, nodes, fits) in [
        (1, 10_000, true),
        (5, 10_000, true),
        (6, 10_000, false),
        (12, 10_000, false),
        (45, 10_000, false),
        (1000, 11, true),
        (1000, 60, false),
        (1001, 2, false),
    ] {
        let text = file(muscles, nodes);
        let (read, bytes) = peak(|| MuscleFile::parse(&text));
        assert_eq!(read.is_ok(), fits, "{muscles} × {nodes}: {:?}", read.err());
        assert!(bytes < MEMORY, "{muscles} × {nodes}: {bytes}");
    }
}

/// A text of anchors and aliases of any shape, each value made of the ones before it.
fn bomb() -> impl Strategy<Value = String> {
    let part = (0..6_u8, proptest::collection::vec(any::<proptest::sample::Index>(), 1..12));
    proptest::collection::vec(part, 1..40).prop_map(|parts| {
        let mut text = String::from("a0: &a0 [1, word, \"quoted\"]\n");
        for (number, (shape, members)) in parts.iter().enumerate() {
            let aliases: Vec<String> = members.iter().map(|member| format!("*a{}", member.index(number + 1))).collect();
            let entries: Vec<String> = aliases.iter().enumerate().map(|(key, alias)| format!("k{key}: {alias}")).collect();
            let name = number + 1;
            text += &match shape {
                0 => format!("a{name}: &a{name} [{}]\n", aliases.join(", ")),
                1 => format!("a{name}: &a{name} {{{}}}\n", entries.join(", ")),
                2 => format!("a{name}: &a{name}\n  - {}\n", aliases.join("\n  - ")),
                3 => format!("a{name}: &a{name}\n  {}\n", entries.join("\n  ")),
                4 => format!("a{name}: &a{name} [[{}], {{x: {}}}]\n", aliases.join(", "), aliases[0]),
                _ => format!("? &a{name} [{}]\n: 1\n", aliases.join(", ")),
            };
        }
        text
    })
}

/// Brackets, marks and indentation in any order.
fn nesting() -> impl Strategy<Value = String> {
    let piece = prop_oneof![
        Just("["),
        Just("]"),
        Just("{"),
        Just("}"),
        Just("- "),
        Just("? "),
        Just(": "),
        Just("a: "),
        Just("\n"),
        Just("\n  "),
        Just("\n    "),
        Just("#]\n"),
        Just("\"]\""),
        Just("'}'"),
        Just(","),
        Just("!t "),
        Just("&a "),
        Just("*a"),
        Just("|\n"),
        Just("1"),
        Just("---\n"),
        Just("<<: ")
    ];
    (proptest::collection::vec(piece, 0..30), 1..200_usize).prop_map(|(pieces, times)| pieces.concat().repeat(times))
}

/// How many values a reader would meet, aliases counted each time, and how deep they nest; stops where that is plainly too much.
fn walk(node: &Node, met: &mut usize) -> usize {
    *met += 1;
    assert!(*met <= limits::YAML_VALUES, "more values than there may be");
    match &node.value {
        Value::List(items) => 1 + items.iter().map(|item| walk(item, met)).max().unwrap_or(0),
        Value::Map(entries) => 1 + entries.iter().map(|(key, value)| walk(key, met).max(walk(value, met))).max().unwrap_or(0),
        Value::Plain(_) | Value::Text(_) | Value::Tagged => 0,
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, ..ProptestConfig::default() })]

    fn alias_bombs_of_any_shape_are_small(text in bomb()) {
        stays_small(&text);
        stays_small(&format!("{text}sinew_session: {{time: 1}}\n"));
        if let Ok(tree) = read(&text, limits::YAML_BYTES) {
            let mut met = 0;
            let depth = walk(&tree, &mut met);
            prop_assert!(depth <= limits::YAML_DEPTH);
        }
    }

    fn nesting_of_any_shape_is_small(text in nesting()) {
        stays_small(&text);
        if let Ok(tree) = read(&text, limits::YAML_BYTES) {
            let mut met = 0;
            let depth = walk(&tree, &mut met);
            prop_assert!(depth <= limits::YAML_DEPTH);
        }
    }
}

pub(crate) fn random_texts_are_small() {
    alias_bombs_of_any_shape_are_small();
    nesting_of_any_shape_is_small();
}

//! Saving over a text: what changed is changed, all else stays to the letter, and what is written reads back the same.

use std::path::Path;

use proptest::prelude::*;
use sinew::document::{Document, ImageLoading, OpenOptions};
use sinew::formats::SCENE_READERS;
use sinew::muscle::{Anchor, MuscleFile, Profile, Tendon, ViaPoint};
use sinew::progress::Progress;

const SHIPPED: [&str; 7] = [
    include_str!("../../configs/biceps.yaml"),
    include_str!("../../configs/biceps-measured.yaml"),
    include_str!("../../configs/biceps-human.yaml"),
    include_str!("../../configs/biceps-human-wrapped.yaml"),
    include_str!("../../configs/example.yaml"),
    include_str!("../../configs/curl-muscles.yaml"),
    include_str!("../../configs/atlas-muscles.yaml"),
];

fn parse(text: &str) -> MuscleFile {
    MuscleFile::parse(text).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn with_radius(file: &MuscleFile, muscle: usize, node: usize, radius: f64) -> MuscleFile {
    let mut file = file.clone();
    let profile = &file.muscles[muscle].profile;
    let mut radii = profile.radii().to_vec();
    radii[node] = radius;
    file.muscles[muscle].profile = Profile::new(radii, profile.growth().to_vec(), profile.rest_length()).unwrap();
    file
}

/// Saves over `text`, checks that it reads back equal, and gives the new text.
#[track_caller]
fn saved(file: &MuscleFile, text: &str) -> String {
    let saved = file.to_yaml_keeping(text);
    assert!(!saved.comments_lost, "{}", saved.text);
    let again = parse(&saved.text);
    assert_eq!(
        (again.muscles, again.arm, again.joints, again.clip),
        (file.muscles.clone(), file.arm, file.joints.clone(), file.clip.clone())
    );
    saved.text
}

/// Lines of `a` that are not in `b`, each with its place.
fn differing<'a>(a: &'a str, b: &str) -> Vec<&'a str> {
    let others: Vec<&str> = b.lines().collect();
    a.lines().filter(|line| !others.contains(line)).collect()
}

#[test]
fn nothing_changed_is_nothing_written() {
    for text in SHIPPED {
        for text in [text.to_owned(), format!("\u{feff}{}", text.replace('\n', "\r\n"))] {
            assert_eq!(saved(&parse(&text), &text), text);
        }
    }
}

#[test]
fn one_number_changed_is_one_line_changed() {
    for text in SHIPPED {
        for text in [text.to_owned(), format!("\u{feff}{}", text.replace('\n', "\r\n"))] {
            let written = saved(&with_radius(&parse(&text), 0, 1, 6.25), &text);
            assert_eq!(differing(&written, &text).len(), 1, "{written}");
            assert_eq!((differing(&text, &written).len(), written.lines().count()), (1, text.lines().count()));
            assert_eq!(written.matches('#').count(), text.matches('#').count());
        }
    }
}

#[test]
fn every_kind_of_change_keeps_the_comments() {
    let text = include_str!("../../configs/example.yaml");
    let file = parse(text);
    let check = |change: &dyn Fn(&mut MuscleFile)| {
        let mut changed = file.clone();
        change(&mut changed);
        let written = saved(&changed, text);
        assert_eq!(written.matches("# ").count(), text.matches("# ").count(), "{written}");
        written
    };
    let mut longer = file.clone();
    longer.muscles[0].profile = Profile::new(vec![1.0, 2.0, 3.0, 2.0], vec![0.0, 1.0, 1.0, 0.0], 300.0).unwrap();
    check(&|changed| changed.muscles[0] = longer.muscles[0].clone());
    assert!(check(&|changed| changed.muscles[0].name = "Сгибатель: #1".to_owned()).contains("Сгибатель: #1"));
    check(&|changed| changed.muscles[1].source = "added\nlater".to_owned());
    check(&|changed| changed.muscles[0].tendons[1] = Tendon { length: 60.0, radius: 2.5 });
    check(&|changed| changed.muscles[1].tendons[0] = Tendon { length: 10.0, radius: 4.0 });
    check(&|changed| changed.muscles[1].tendons = [Tendon::default(); 2]);
    check(&|changed| changed.muscles[1].wraps.clear());
    check(&|changed| {
        changed.muscles[0].via = vec![Anchor { bone: "upper arm".to_owned(), offset: glam::DVec3::new(30.0, -150.0, 0.0) }.into()]
    });
    check(&|changed| changed.muscles[0].origin.as_mut().unwrap().offset.y = -31.5);
    check(&|changed| changed.unit_metres = 0.01);
    check(&|changed| changed.arm.as_mut().unwrap().flexion = Some([5.0, 120.0]));
    let added = check(&|changed| {
        let mut muscle = changed.muscles[0].clone();
        muscle.name = "Brachialis".to_owned();
        changed.muscles.push(muscle);
    });
    assert!(added.contains("- name: \"Brachialis\""), "{added}");
}

#[test]
fn a_muscle_taken_away_takes_only_its_own_lines() {
    let text = include_str!("../../configs/example.yaml");
    let mut file = parse(text);
    file.muscles.remove(1);
    let written = saved(&file, text);
    assert_eq!(written.trim_end(), text.split("  - name: Triceps").next().unwrap().trim_end());
    let mut file = parse(text);
    file.muscles.remove(0);
    let written = saved(&file, text);
    assert!(written.starts_with("# Every key of the full format.") && written.contains("- name: Triceps") && !written.contains("Biceps"));
}

#[test]
fn keys_that_go_and_come_take_no_other_line() {
    let text = "# a\nmuscles:\n  # b\n  - color: \"#102030\" # c\n    name: A # d\n    length: 30 # e\n    radii: # f\n      - 1 # g\n      - 2.50 # h\n      - 1\n    growth: [0, 1, 0]\n    source: >-\n      two\n\n      lines\n    # i\n";
    let file = parse(text);
    let mut changed = file.clone();
    changed.muscles[0].color = None;
    let written = changed.to_yaml_keeping(text);
    assert!(!written.comments_lost && written.text.contains("# d") && written.text.contains("- name: A"), "{}", written.text);
    let written = saved(&with_radius(&file, 0, 2, 1.5), text);
    assert!(written.contains("- 2.50 # h\n      - 1.5\n"), "{written}");
    let mut changed = file.clone();
    changed.muscles[0].source = String::new();
    let written = saved(&changed, text);
    assert!(written.contains("growth: [0, 1, 0]\n    # i\n"), "{written}");
    // Where a list of another length takes the place of one with remarks in it, the loss is said.
    let mut changed = file;
    changed.muscles[0].profile = Profile::new(vec![1.0, 2.0], vec![1.0, 1.0], 30.0).unwrap();
    let written = changed.to_yaml_keeping(text);
    assert!(written.comments_lost);
    assert_eq!(parse(&written.text).muscles, changed.muscles);
}

#[test]
fn via_points_that_come_and_go_keep_the_comments_beside_them() {
    let muscle =
        "muscles:\n  - length: 30 # a\n    radii: [1, 2, 1]\n    growth: [0, 1, 0]\n    origin: {bone: b} # b\n    insertion: {bone: c}\n";
    let block = "    via: # c\n      - {bone: b, offset: [1, 0, 0]} # d\n      - bone: c # e\n        offset: [2, 0, 0]\n";
    let flow = "    via: [{bone: b, offset: [1, 0, 0]}, {bone: c, offset: [2, 0, 0]}] # c\n";
    let point = |x: f64| ViaPoint::from(Anchor { bone: "b".to_owned(), offset: glam::DVec3::new(x, 0.5, 0.0) });
    for (via, tail) in [("", ""), (block, ""), (flow, "    name: N # f\n"), (block, "    name: N # f\n")] {
        let text = format!("{muscle}{via}{tail}");
        let file = parse(&text);
        let change = |change: &dyn Fn(&mut Vec<ViaPoint>)| {
            let mut changed = file.clone();
            change(&mut changed.muscles[0].via);
            let written = changed.to_yaml_keeping(&text);
            assert_eq!(parse(&written.text).muscles, changed.muscles, "{}", written.text);
            assert!(written.text.contains("# a") && written.text.contains("# b"), "{}", written.text);
            assert_eq!(written.text.contains("# f"), !tail.is_empty(), "{}", written.text);
            written
        };
        assert!(!change(&|via| via.push(point(3.0))).comments_lost);
        change(&|via| via.insert(0, point(3.0)));
        if !via.is_empty() {
            assert!(!change(&|via| via[1].place.offset.x = 9.0).comments_lost);
            // What stood beside the point that went goes with it, and so does what stood beside a whole list.
            let gone = change(&|via| drop(via.remove(0))).text;
            assert!(!gone.contains("[1, 0, 0]"), "{gone}");
            assert!(!change(&Vec::clear).text.contains("via"));
            change(&|via| via.swap(0, 1));
        }
    }
}

#[test]
fn what_cannot_be_kept_is_written_anew_and_said() {
    // An alias: changing the one list would change the other.
    let text = "# x\nmuscles:\n  - {length: 30, radii: &r [1, 2, 1], growth: *r}\n";
    let written = with_radius(&parse(text), 0, 1, 3.0).to_yaml_keeping(text);
    assert!(written.comments_lost);
    assert_eq!(parse(&written.text).muscles[0].profile.radii(), [1.0, 3.0, 1.0]);
    assert_eq!(parse(&written.text).muscles[0].profile.growth(), [1.0, 2.0, 1.0]);
    // The report's form cannot name a muscle; a text that is none is no help.
    let mut file = parse(SHIPPED[0]);
    file.muscles[0].name = "Biceps".to_owned();
    let written = file.to_yaml_keeping(SHIPPED[0]);
    assert!(written.comments_lost && parse(&written.text).muscles == file.muscles);
    assert_eq!(file.to_yaml_keeping("{").text, file.to_yaml());
    assert!(!file.to_yaml_keeping("").comments_lost);
}

proptest! {
    #[test]
    fn whatever_the_text_the_result_reads_back_the_same(
        shipped in 0..SHIPPED.len(),
        cut in 0.0..1.0_f64,
        insert in "[ \\[\\]{}#:,'\"a-c0-9\n-]{0,6}",
        node in 0..3_usize,
        radius in 0.5..9.0_f64,
    ) {
        let text = SHIPPED[shipped];
        let file = with_radius(&parse(text), 0, node, radius);
        let mut at = (cut * text.len() as f64) as usize;
        while !text.is_char_boundary(at) {
            at -= 1;
        }
        let mutated = format!("{}{insert}{}", &text[..at], &text[at..]);
        let written = file.to_yaml_keeping(&mutated);
        let again = MuscleFile::parse(&written.text).unwrap();
        prop_assert_eq!(again.muscles, file.muscles);
        prop_assert_eq!((again.arm, again.joints, again.clip), (file.arm, file.joints, file.clip));
    }
}

/// Muscles on bones, which name their clip.
fn on_clip(clip: &str) -> String {
    include_str!("../../configs/curl-muscles.yaml").replace("curl.dae", clip)
}

#[test]
fn the_clip_is_named_from_where_the_muscles_are_written() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    for name in ["a/b", "c", "sub"] {
        std::fs::create_dir_all(at(name)).unwrap();
    }
    for name in ["a/curl.dae", "c/curl.dae"] {
        std::fs::copy(Path::new(env!("CARGO_MANIFEST_DIR")).join("configs/curl.dae"), at(name)).unwrap();
    }
    let open = |files: &[&Path]| {
        Document::open_with(files, OpenOptions { images: ImageLoading::Locate, ..OpenOptions::new(SCENE_READERS) }, &Progress::default())
            .unwrap()
    };
    // As many files as there are, the muscles' own clip is meant: another one that is open beside it is not.
    for (from, clip, beside) in
        [("a/m.yaml", "curl.dae", None), ("a/b/m.yaml", "../curl.dae", Some("c/curl.dae")), ("m.yaml", "./c/../a/curl.dae", None)]
    {
        std::fs::write(at(from), on_clip(clip)).unwrap();
        let beside = beside.map(at);
        let own = at(from);
        let document = open(&beside.iter().map(|path| path.as_path()).chain([own.as_path()]).collect::<Vec<_>>());
        let file = document.muscle_files().next().unwrap();
        for (to, way) in
            [("a/n.yaml", "curl.dae"), ("sub/n.yaml", "../a/curl.dae"), ("n.yaml", "a/curl.dae"), ("a/b/n.yaml", "../curl.dae")]
        {
            let written = document.muscle_file_for(0, file, &at(to));
            assert_eq!(written.clip.as_deref(), Some(way), "{from} {to}");
            assert_eq!(MuscleFile { clip: file.clip.clone(), ..written.clone() }, *file);
            std::fs::write(at(to), written.to_yaml()).unwrap();
            let again = open(&[&at(to)]);
            assert_eq!(again.sources.len(), 2, "{to}: {:?}", again.diagnostics);
        }
    }
    // One that is not there is named from there all the same.
    std::fs::write(at("a/m.yaml"), on_clip("gone.dae")).unwrap();
    let lost = open(&[&at("a/m.yaml")]);
    let file = lost.muscle_files().next().unwrap();
    assert_eq!(lost.muscle_file_for(0, file, &at("sub/n.yaml")).clip.as_deref(), Some("../a/gone.dae"));
    // Where another clip stands in for it, that one is.
    let helped = open(&[&at("c/curl.dae"), &at("a/m.yaml")]);
    let file = helped.muscle_files().next().unwrap();
    assert_eq!(helped.muscle_file_for(0, file, &at("sub/n.yaml")).clip.as_deref(), Some("../c/curl.dae"));
}

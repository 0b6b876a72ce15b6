//! Documents that want to crash, hang or fill the memory.

use std::time::{Duration, Instant};

use sinew::collada::{Finding, ReadErrorKind, read};
use sinew::i18n::Sentence;
use sinew::progress::Progress;

use crate::build::*;

/// Runs `work`, which must not hang. The limit is far beyond what a loaded machine needs: this tells a hang from an answer, not fast from slow.
#[track_caller]
fn swift<R>(work: impl FnOnce() -> R) -> R {
    let start = Instant::now();
    let result = work();
    assert!(start.elapsed() < Duration::from_secs(120), "took {:?}", start.elapsed());
    result
}

/// A document with a bit of everything; fuzzing starts from it too.
fn rich() -> String {
    include_str!("../fuzz/seeds/collada/everything.dae").to_owned()
}

#[test]
fn the_rich_document_itself_is_good() {
    let loaded = load(&rich());
    assert_eq!(codes(&loaded), ["joint-names-rejoined"]);
    assert_eq!((loaded.scene.skins.len(), loaded.scene.morphs.len(), loaded.clips.len()), (1, 1, 1));
    assert_eq!(loaded.clips[0].channels.len(), 5);
}

#[test]
fn a_document_cut_off_anywhere_ends_in_a_result() {
    let text = rich();
    for at in (0..text.len()).step_by(7) {
        let _ = read(&text.as_bytes()[..at], "cut.dae", &Progress::default());
    }
}

/// A small generator of numbers that is the same everywhere (xorshift).
struct Dice(u64);

impl Dice {
    fn roll(&mut self, sides: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % sides as u64) as usize
    }
}

#[test]
fn damaged_bytes_end_in_a_result_that_can_be_posed() {
    let text = rich();
    let mut dice = Dice(0x5EED);
    for _ in 0..3000 {
        let mut bytes = text.clone().into_bytes();
        for _ in 0..1 + dice.roll(4) {
            let at = dice.roll(bytes.len());
            // Mostly what keeps the XML whole: digits, letters, signs.
            bytes[at] = b"0123456789-.eE#/ ()aNsXYZ_<>\"\x00\xFF"[dice.roll(31)];
        }
        if let Ok(loaded) = read(&bytes, "hit.dae", &Progress::default()) {
            for clip in 0..loaded.clips.len() {
                let _ = posed_world(&loaded, clip, 0.7);
            }
        }
    }
}

#[test]
fn words_swapped_for_others_end_in_a_result() {
    // Attribute values and list entries of the document itself, put in other places: references that lead to the wrong kinds of things.
    let text = rich();
    let words: Vec<&str> = text.split(['"', '>', '<']).filter(|word| !word.trim().is_empty() && word.len() < 40).collect();
    let mut dice = Dice(0xD1CE);
    for _ in 0..2000 {
        let (from, to) = (words[dice.roll(words.len())], words[dice.roll(words.len())]);
        let _ = swift(|| try_load(&text.replacen(&format!("\"{from}\""), &format!("\"{to}\""), 1 + dice.roll(3))));
    }
}

#[test]
fn deep_nesting_is_refused_or_cut() {
    for tag in ["node", "animation", "extra"] {
        let text = document(&scene(&format!("<{tag}>").repeat(1_000_000)));
        let error = swift(|| try_load(&text)).expect_err("refused");
        assert_eq!(error.kind, ReadErrorKind::TooDeep, "{tag}");
    }
    let chain: String = (0..5000).map(|i| format!("<node id=\"n{i}\"><instance_node url=\"#n{}\"/></node>", i + 1)).collect();
    let loaded = swift(|| load(&document(&(format!("<library_nodes>{chain}</library_nodes>") + &scene("<instance_node url=\"#n0\"/>")))));
    assert!(codes(&loaded).contains(&"limit-reached"));
    assert!(loaded.scene.graph.len() <= 1002);
}

#[test]
fn references_do_not_multiply_without_end() {
    // Twelve levels of ten instances each would be a million million nodes.
    let levels: String =
        (0..12).map(|i| format!("<node id=\"n{i}\">{}</node>", format!("<instance_node url=\"#n{}\"/>", i + 1).repeat(10))).collect();
    let body = format!("<library_nodes>{levels}<node id=\"n12\"/></library_nodes>");
    let loaded = swift(|| load(&document(&(body + &scene("<instance_node url=\"#n0\"/>")))));
    assert!(codes(&loaded).contains(&"limit-reached"));
    assert!(loaded.scene.graph.len() < 100_000, "{}", loaded.scene.graph.len());
    // One mesh named as its own morph target ten thousand times.
    let points: Vec<String> = (0..3000).map(|i| format!("{i} 0 0")).collect();
    let big =
        geometries(&geometry("g", &points.join(" "), &triangles("g", &(0..3000).map(|i| i.to_string()).collect::<Vec<_>>().join(" "))));
    let morph = format!(
        "<library_controllers><controller id=\"c\"><morph source=\"#g\">{}<targets><input semantic=\"MORPH_TARGET\" source=\"#t\"/></targets></morph></controller></library_controllers>",
        names("t", "IDREF_array", "MORPH_TARGET", &"g ".repeat(10_000))
    );
    let loaded = swift(|| load(&document(&(big + &morph + &scene("<node><instance_controller url=\"#c\"/></node>")))));
    assert!(codes(&loaded).contains(&"limit-reached"));
    assert!(loaded.scene.morphs[0].targets.len() < 2000);
}

#[test]
fn counts_offsets_and_strides_beyond_all_bounds_are_harmless() {
    let text = rich();
    let mut tried = 0;
    for (at, _) in text
        .match_indices("count=\"")
        .chain(text.match_indices("stride=\""))
        .chain(text.match_indices("offset=\""))
        .chain(text.match_indices("set=\""))
    {
        let start = text[at..].find('"').map_or(at, |quote| at + quote + 1);
        let end = text[start..].find('"').map_or(start, |quote| start + quote);
        for value in ["0", "4000000000", "18446744073709551615", "99999999999999999999999", "-1", "x"] {
            let _ = swift(|| try_load(&format!("{}{value}{}", &text[..start], &text[end..])));
            tried += 1;
        }
    }
    assert!(tried > 100);
}

#[test]
fn a_flood_of_findings_is_cut_off_with_a_word() {
    let nodes = "<node><translate>1</translate></node>".repeat(5000);
    let loaded = swift(|| load(&document(&scene(&nodes))));
    assert_eq!(loaded.findings.len(), 1001);
    assert_eq!(loaded.findings.last().map(|found| &found.finding), Some(&Finding::More(4000)));
}

#[test]
fn polygons_of_absurd_size_are_cut_or_left_out_in_time() {
    let count = 120_000;
    let mut points = String::new();
    for i in 0..count {
        let (angle, radius) = (f64::from(i) / f64::from(count) * std::f64::consts::TAU, if i % 2 == 0 { 2.0 } else { 1.0 });
        points += &format!("{:.5} {:.5} 0 ", angle.cos() * radius, angle.sin() * radius);
    }
    let order: Vec<String> = (0..count).map(|i| i.to_string()).collect();
    let polygon =
        format!("<polygons count=\"1\"><input semantic=\"VERTEX\" source=\"#g-v\" offset=\"0\"/><p>{}</p></polygons>", order.join(" "));
    let text = document(&(geometries(&geometry("g", &points, &polygon)) + &scene("<node><instance_geometry url=\"#g\"/></node>")));
    let loaded = swift(|| load(&text));
    assert!(codes(&loaded).is_empty() || codes(&loaded) == ["polygon-too-complex"]);
}

/// The clips that the program ships, as bytes.
fn shipped() -> Vec<(String, Vec<u8>)> {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("configs");
    let mut clips: Vec<_> = std::fs::read_dir(folder)
        .expect("configs is there")
        .flatten()
        .map(|entry| entry.path())
        .filter(|path| path.extension().is_some_and(|ending| ending == "dae"))
        .map(|path| (path.display().to_string(), std::fs::read(&path).expect("it can be read")))
        .collect();
    clips.sort();
    assert!(clips.len() >= 4, "the clips are gone");
    clips
}

/// Reads what may be broken. What is read can be posed; what is refused is refused in one line.
fn try_to_show(name: &str, bytes: &[u8]) -> bool {
    match read(bytes, name, &Progress::default()) {
        Ok(loaded) => {
            for (index, clip) in loaded.clips.iter().enumerate() {
                assert!(posed_world(&loaded, index, (clip.start + clip.end) / 2.0).len() == loaded.scene.graph.len());
            }
            true
        }
        Err(error) => {
            let said = error.sentence();
            assert!(!said.is_empty() && !said.contains('\n'), "{name}: {said}");
            false
        }
    }
}

#[test]
fn the_shipped_clips_cut_off_anywhere_are_refused_in_one_line() {
    let mut dice = Dice(0xC07);
    for (name, bytes) in shipped() {
        assert!(try_to_show(&name, &bytes));
        // Early, late, and anywhere: the last bytes are white space after the root, without which the document is whole.
        let whole = bytes.iter().rposition(|byte| *byte == b'>').expect("it has tags") + 1;
        for cut in (0..12).map(|_| dice.roll(whole)).chain([0, 1, 3, whole - 1]).collect::<Vec<_>>() {
            assert!(!try_to_show(&name, &bytes[..cut]), "{name} cut at {cut} was read");
        }
        assert!(try_to_show(&name, &bytes[..whole]));
    }
}

#[test]
fn the_shipped_clips_with_flipped_bits_are_read_or_refused() {
    let mut dice = Dice(0xF11B);
    for (name, bytes) in shipped() {
        let mut read = 0;
        for round in 0..16 {
            let mut hit = bytes.clone();
            for _ in 0..1 << (round % 5) {
                let at = dice.roll(hit.len());
                hit[at] ^= 1 << dice.roll(8);
            }
            read += usize::from(try_to_show(&name, &hit));
        }
        // Most of a clip is numbers, where a flipped bit breaks no tag.
        assert!(read > 0, "{name}: nothing was read");
    }
}

#[test]
fn a_flood_of_loose_parts_costs_no_more_than_the_scene_that_it_makes() {
    let nodes = "<node id=\"a\"/>".repeat(60_000);
    let loaded = swift(|| load(&format!("<COLLADA version=\"1.4.1\"><library_nodes>{nodes}</library_nodes></COLLADA>")));
    assert!(codes(&loaded).contains(&"no-scene"));
    assert!(loaded.scene.graph.len() > 1000);
}

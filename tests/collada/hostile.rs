//! Documents that want to crash, hang or fill the memory.

use std::time::{Duration, Instant};

use sinew::collada::{Progress, read};

use crate::build::*;

/// Runs `work`, which must not hang. The limit is far beyond what a loaded machine needs: this tells a hang from an answer, not fast from slow.
#[track_caller]
fn swift<R>(work: impl FnOnce() -> R) -> R {
    let start = Instant::now();
    let result = work();
    assert!(start.elapsed() < Duration::from_secs(120), "took {:?}", start.elapsed());
    result
}

/// A document with a bit of everything.
fn rich() -> String {
    let mesh = geometry(
        "g",
        "0 0 0 1 0 0 1 1 0 0 1 0",
        "<polylist count=\"1\" material=\"s\"><input semantic=\"VERTEX\" source=\"#g-v\" offset=\"0\"/><vcount>4</vcount><p>0 1 2 3</p></polylist>",
    );
    let target = geometry("h", "0 0 1 1 0 1 1 1 1 0 1 1", &triangles("h", "0 1 2"));
    let controllers = format!(
        "<library_controllers><controller id=\"m\"><morph source=\"#g\">{}{}<targets><input semantic=\"MORPH_TARGET\" source=\"#mt\"/><input semantic=\"MORPH_WEIGHT\" source=\"#mw\"/></targets></morph></controller>\
         <controller id=\"c\"><skin source=\"#m\"><bind_shape_matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</bind_shape_matrix>{}{}{}<joints><input semantic=\"JOINT\" source=\"#j\"/>\
         <input semantic=\"INV_BIND_MATRIX\" source=\"#b\"/></joints><vertex_weights count=\"4\"><input semantic=\"JOINT\" source=\"#j\" offset=\"0\"/><input semantic=\"WEIGHT\" source=\"#w\" offset=\"1\"/>\
         <vcount>1 1 2 1</vcount><v>0 0 1 0 0 1 1 1 -1 0</v></vertex_weights></skin></controller></library_controllers>",
        names("mt", "IDREF_array", "MORPH_TARGET", "h"),
        floats("mw", "MORPH_WEIGHT", "0.5"),
        names("j", "Name_array", "JOINT", "Bone 1 Bone2"),
        matrices("b", &[glam::DMat4::IDENTITY; 2]),
        floats("w", "WEIGHT", "1 0.5"),
    );
    let effects = "<library_images><image id=\"i\"><init_from>a%20b.png</init_from></image></library_images><library_materials><material id=\"mat\"><instance_effect url=\"#fx\"/></material></library_materials>\
                   <library_effects><effect id=\"fx\"><profile_COMMON><newparam sid=\"u\"><surface><init_from>i</init_from></surface></newparam><newparam sid=\"x\"><sampler2D><source>u</source></sampler2D></newparam>\
                   <technique sid=\"t\"><phong><diffuse><texture texture=\"x\" texcoord=\"UV\"/></diffuse><transparency><float>0.5</float></transparency></phong></technique></profile_COMMON></effect></library_effects>";
    let moves = animations(
        &(animation("a", "n/r.ANGLE", "0 1 2", "X", "0 90 10", "LINEAR BEZIER STEP")
            + &animation("k", "mw(0)", "0 1", "X", "0 1", "STEP LINEAR")),
    );
    let clips = "<library_animation_clips><animation_clip id=\"clip\" start=\"0\" end=\"1\"><instance_animation url=\"#a\"/></animation_clip></library_animation_clips>";
    let nodes = "<node id=\"n\" sid=\"Bone 1\" type=\"JOINT\"><translate>1 2 3</translate><rotate sid=\"r\">0 0 1 90</rotate><node sid=\"Bone2\" type=\"JOINT\"><matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix></node></node>\
                 <node><instance_controller url=\"#c\"><skeleton>#n</skeleton><bind_material><technique_common><instance_material symbol=\"s\" target=\"#mat\"/></technique_common></bind_material></instance_controller></node>\
                 <instance_node url=\"#n\"/>";
    document(&(geometries(&(mesh + &target)) + &controllers + effects + &moves + clips + &scene(nodes)))
}

#[test]
fn the_rich_document_itself_is_good() {
    let loaded = load(&rich());
    assert_eq!(codes(&loaded), ["joint-names-rejoined", "missing-tangents"]);
    assert_eq!((loaded.scene.skins.len(), loaded.scene.morphs.len(), loaded.clips.len()), (1, 1, 1));
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
        assert!(error.message.contains("1,000") || error.message.contains("1000"), "{error}");
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
    assert_eq!(loaded.findings.last().map(|finding| finding.code), Some("more-findings"));
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

//! No control character, no C1 character and none that turns the reading order comes from a file to the terminal, in any subcommand; JSON keeps the names.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::support::{Ended, arg, call, folder, models, run};
use serde_json::Value;
use sinew::i18n::is_unsafe;

/// What XML lets stand in a name: C1, DEL, bidirectional controls, line separators, a tab and line ends as references.
const EVIL: &str = "N\u{9b}31mX\u{85}\u{7f}\u{202e}evil\u{2066}\u{200f}\u{61c}\u{2028}\u{feff}&#9;&#10;é";
/// The same and C0, as YAML writes it in quotes.
const EVIL_YAML: &str = r"M\e[31mX\a\b\0\x7f\n\t\N\L\P\u202e\u2066\u200f\u061c\x9b31m\ufeff é";
/// That name.
const EVIL_NAME: &str = "M\u{1b}[31mX\u{7}\u{8}\0\u{7f}\n\t\u{85}\u{2028}\u{2029}\u{202e}\u{2066}\u{200f}\u{61c}\u{9b}31m\u{feff} é";

/// A clip with such letters in every name, id, reference, symbol, count and comment; much of it wrong, so that findings name it.
fn clip() -> String {
    let e = EVIL;
    format!(
        r##"<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><contributor><authoring_tool>T{e}</authoring_tool></contributor><up_axis>{e}</up_axis></asset>
<library_images><image id="i{e}" name="{e}"><init_from>{e}.png</init_from></image></library_images>
<library_effects><effect id="e{e}" name="{e}"><profile_COMMON>
  <newparam sid="s{e}"><surface type="2D"><init_from>i{e}</init_from></surface></newparam>
  <newparam sid="p{e}"><sampler2D><source>s{e}</source></sampler2D></newparam>
  <technique sid="c"><lambert><diffuse><texture texture="p{e}" texcoord="{e}"/></diffuse></lambert></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="m{e}" name="{e}"><instance_effect url="#e{e}"/></material></library_materials>
<library_lights><light id="l{e}" name="{e}"><technique_common><ambient><color>{e}</color></ambient></technique_common></light></library_lights>
<library_cameras><camera id="c{e}" name="{e}"><optics><technique_common><perspective><yfov>{e}</yfov></perspective></technique_common></optics></camera></library_cameras>
<library_geometries>
 <geometry id="g" name="{e}"><mesh>
  <source id="g-p{e}"><float_array id="g-a" count="12">0 0 0 1 0 0 1 1 0 0 1 0</float_array>
   <technique_common><accessor source="#g-a" count="4" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
  <vertices id="g-v"><input semantic="POSITION" source="#g-p{e}"/></vertices>
  <triangles material="{e}" count="2"><input semantic="VERTEX" source="#g-v" offset="0"/><input semantic="{e}" source="#none{e}" offset="0"/><p>0 1 2 0 2 99</p></triangles>
 </mesh></geometry>
 <geometry id="b{e}" name="{e}"><mesh><vertices id="b-v{e}"><input semantic="POSITION" source="#none{e}"/></vertices></mesh></geometry>
</library_geometries>
<library_controllers><controller id="k{e}" name="{e}"><skin source="#g">
  <source id="kj"><Name_array id="kja" count="1">{name}</Name_array><technique_common><accessor source="#kja" count="1" stride="1"><param name="JOINT" type="name"/></accessor></technique_common></source>
  <source id="kw"><float_array id="kwa" count="1">1</float_array><technique_common><accessor source="#kwa" count="1" stride="1"><param name="WEIGHT" type="float"/></accessor></technique_common></source>
  <joints><input semantic="JOINT" source="#kj"/></joints>
  <vertex_weights count="4"><input semantic="JOINT" source="#kj" offset="0"/><input semantic="WEIGHT" source="#kw" offset="1"/><vcount>1 1 1 1</vcount><v>0 0 0 0 0 0 0 0</v></vertex_weights>
 </skin></controller></library_controllers>
<library_animations><animation id="a{e}" name="{e}">
  <source id="at"><float_array id="ata" count="2">0 1</float_array><technique_common><accessor source="#ata" count="2" stride="1"><param name="TIME" type="float"/></accessor></technique_common></source>
  <source id="av"><float_array id="ava" count="2">0 90</float_array><technique_common><accessor source="#ava" count="2" stride="1"><param name="ANGLE" type="float"/></accessor></technique_common></source>
  <source id="ai"><Name_array id="aia" count="2">LINEAR {name}</Name_array><technique_common><accessor source="#aia" count="2" stride="1"><param name="INTERPOLATION" type="name"/></accessor></technique_common></source>
  <sampler id="as"><input semantic="INPUT" source="#at"/><input semantic="OUTPUT" source="#av"/><input semantic="INTERPOLATION" source="#ai"/></sampler>
  <channel source="#as" target="elbow/turn.ANGLE"/><channel source="#as" target="none{e}/turn{e}.X"/>
 </animation></library_animations>
<library_animation_clips><animation_clip id="clip{e}" name="{e}" start="0" end="1"><instance_animation url="#a{e}"/></animation_clip></library_animation_clips>
<library_visual_scenes><visual_scene id="v" name="{e}">
 <node id="shoulder" name="{e}" sid="{name}" type="JOINT">
  <node id="elbow" name="{e}" sid="e{name}" type="JOINT"><translate>0 0 1</translate><rotate sid="turn">1 0 0 0</rotate>
   <node id="hand" name="{e}" sid="h{name}" type="JOINT"><translate>0 0 1</translate></node></node></node>
 <node id="n{e}" name="{e}"><instance_controller url="#k{e}"><skeleton>#{e}</skeleton><bind_material><technique_common><instance_material symbol="{e}" target="#m{e}"/></technique_common></bind_material></instance_controller></node>
 <node id="o{e}" name="{e}"><instance_geometry url="#g"/><instance_geometry url="#none{e}"/><instance_light url="#l{e}"/><instance_camera url="#c{e}"/></node>
</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#v"/></scene></COLLADA>
"##,
        name = "J\u{9b}\u{202e}1"
    )
}

/// Muscles on that clip, and on an arm, with such letters in every text.
fn muscles(on: &str) -> String {
    let e = EVIL_YAML;
    let (place, ends) = match on {
        "arm" => ("arm: {upper: 330, forearm: 260, thickness: 8}\n".to_owned(), ["upper arm", "forearm"]),
        _ => (format!("clip: \"none {e}.dae\"\njoint: {{bone: \"{e}\", axis: [1, 0, 0]}}\n"), ["shoulder", "elbow"]),
    };
    let bone = |name: &str| format!("{{bone: {name}, offset: [0, -30, 0]}}");
    format!(
        "{place}muscles:\n  - name: \"{e}\"\n    source: \"{e}\"\n    length: 267\n    radii: [9, 12, 9]\n    growth: [0, 1, 0]\n    origin: {}\n    insertion: {}\n  \
         - name: \"lost {e}\"\n    length: 267\n    radii: [9, 12, 9]\n    growth: [0, 1, 0]\n{}",
        bone(ends[0]),
        bone(ends[1]),
        if on == "arm" { String::new() } else { format!("    origin: {{bone: \"{e}\"}}\n    insertion: {{bone: \"x{e}\"}}\n") }
    )
}

/// Holds what a call said against the rule, whatever it said.
#[track_caller]
fn quiet(command: Command, what: &str) -> Ended {
    let ended = run(command, b"");
    for (stream, text) in [("output", &ended.out), ("error", &ended.err)] {
        let found = text.char_indices().find(|(_, letter)| is_unsafe(*letter) && *letter != '\n');
        let around = found.map(|(at, _)| text.get(at.saturating_sub(40)..).unwrap_or(text).chars().take(60).collect::<String>());
        assert_eq!(around, None, "{what}: standard {stream}");
    }
    assert!(!ended.err.contains("panicked"), "{what}: {}", ended.err);
    ended
}

fn everything(folder: &Path) -> Vec<PathBuf> {
    let write = |name: &str, text: &str| models::write(folder, name, text);
    let session = format!(
        "sinew_session:\n  files: [\"clip.dae\", \"none {EVIL_YAML}.dae\"]\n  clip: \"{EVIL_YAML}\"\n  hidden: [{{node: 1, name: \"{EVIL_YAML}\"}}]\n"
    );
    vec![
        write("clip.dae", &clip()),
        write("arm.yaml", &muscles("arm")),
        write("bones.yaml", &muscles("bones")),
        write("session.yaml", &session),
        write("wrong-key.yaml", &format!("\"{EVIL_YAML}\": 1\nmuscles: []\n")),
        write("wrong-word.yaml", &format!("unit: \"{EVIL_YAML}\"\nmuscles: [{{length: 1, radii: [\"{EVIL_YAML}\"], growth: [1]}}]\n")),
        write("wrong-session.yaml", &format!("sinew_session:\n  backdrop: \"{EVIL_YAML}\"\n")),
        write("no-xml.dae", &format!("<COLLADA><a{}></b\u{202e}>", "\u{9b}")),
        write("named\u{1b}[31m\u{9b}\u{202e}.dae", &clip()),
        folder.join("none\u{1b}]0;x\u{7}\u{202e}.dae"),
    ]
}

#[test]
fn no_subcommand_lets_a_name_act_on_the_terminal() {
    let folder = folder();
    let files = everything(folder.path());
    let out = |ending: &str| folder.path().join(format!("out.{ending}"));
    for file in &files {
        let name = arg(file);
        let (picture, object, glb, plot) = (out("png"), out("obj"), out("glb"), out("svg"));
        let calls: [&[&str]; 19] = [
            &["info", name],
            &["info", name, "--json"],
            &["check", name],
            &["check", name, "--json"],
            &["render", name, "-o", arg(&picture), "--size", "64x48", "--verbose"],
            &["render", name, "-o", arg(&picture), "--size", "64x48", "--clip", "none\u{9b}"],
            &["render", name, "-o", arg(&picture), "--size", "64x48", "--verbose", "--angle", "400"],
            &["export", name, "-o", arg(&object), "--verbose"],
            &["convert", name, "-o", arg(&glb), "--verbose"],
            &["measure", name],
            &["measure", name, "--csv"],
            &["measure", name, "--json"],
            &["measure", name, "--joints"],
            &["measure", name, "--joints", "--csv"],
            &["measure", name, "--joints", "--json"],
            &["measure", name, "--plot", arg(&plot)],
            &["measure", name, "--compare", name],
            &["fit", name],
            &["bench", name, "--frames", "1"],
        ];
        for arguments in calls {
            let mut russian = call(arguments);
            russian.env("LANG", "ru_RU.UTF-8");
            quiet(russian, &format!("{arguments:?}"));
            quiet(call(arguments), &format!("{arguments:?}"));
        }
        if let Ok(svg) = std::fs::read_to_string(&plot) {
            assert!(!svg.chars().any(|letter| is_unsafe(letter) && letter != '\n'), "{name}: the plot");
        }
    }
    for arguments in [&["\u{1b}[31m"][..], &["info", "--\u{1b}[31m\u{202e}"], &["render", "x.dae", "--size", "\u{9b}"], &["info"]] {
        quiet(call(arguments), &format!("{arguments:?}"));
    }
}

#[test]
fn json_keeps_the_names() {
    let folder = folder();
    let file = models::write(folder.path(), "arm.yaml", &muscles("arm"));
    let name = arg(&file);
    let info: Value = quiet(call(["info", name, "--json"]), "info").json();
    assert_eq!(info["muscles"][0]["name"], EVIL_NAME);
    let measured: Value = quiet(call(["measure", name, "--json", "--angles", "0"]), "measure").json();
    assert_eq!(measured["muscles"][0]["name"], EVIL_NAME);
}

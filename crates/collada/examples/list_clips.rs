//! What a COLLADA file holds, and what the reader has to say about it: `cargo run --example list_clips -- walk.dae`.

use std::error::Error;

use sinew_collada::{ColladaScene, ReadError, read};
use sinew_scene::progress::Progress;

/// A node that rises by two metres in a second; the count of its keys is wrong.
pub(crate) const LIFT: &str = r##"<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><unit meter="1"/><up_axis>Y_UP</up_axis></asset>
  <library_animations><animation id="rise">
    <source id="t"><float_array id="ta" count="3">0 1</float_array>
      <technique_common><accessor source="#ta" count="2"><param name="TIME" type="float"/></accessor></technique_common></source>
    <source id="v"><float_array id="va" count="2">0 2</float_array>
      <technique_common><accessor source="#va" count="2"><param name="Y" type="float"/></accessor></technique_common></source>
    <sampler id="s"><input semantic="INPUT" source="#t"/><input semantic="OUTPUT" source="#v"/></sampler>
    <channel source="#s" target="lift/place.Y"/>
  </animation></library_animations>
  <library_visual_scenes><visual_scene id="scene">
    <node id="lift"><translate sid="place">0 0 0</translate></node>
  </visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#scene"/></scene>
</COLLADA>"##;

/// One line for each clip, then one for each diagnostic.
pub(crate) fn lines(file: &ColladaScene) -> Vec<String> {
    let clips = file
        .clips
        .iter()
        .map(|clip| format!("clip {}: {} s to {} s, {} channels", clip.label().plain(), clip.start, clip.end, clip.channels.len()));
    let findings = file.findings.iter().map(|finding| {
        let line = finding.line.map_or_else(|| "?".to_owned(), |line| line.to_string());
        format!("line {line}: {} ({})", finding.code(), finding.message())
    });
    clips.chain(findings).collect()
}

/// Reads a text as the file of that name.
pub(crate) fn read_text(text: &[u8], name: &str) -> Result<ColladaScene, ReadError> {
    read(text, name, &Progress::default())
}

fn main() -> Result<(), Box<dyn Error>> {
    let file = match std::env::args().nth(1) {
        Some(path) => read_text(&std::fs::read(&path)?, &path)?,
        None => read_text(LIFT.as_bytes(), "lift.dae")?,
    };
    lines(&file).iter().for_each(|line| println!("{line}"));
    Ok(())
}

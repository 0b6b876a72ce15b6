//! Models that the tests make themselves, with closed forms for what must come out.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use glam::DVec3;

/// Writes `text` to `name` in `folder`.
pub(crate) fn write(folder: &Path, name: &str, text: &str) -> PathBuf {
    let path = folder.join(name);
    std::fs::write(&path, text).expect("a writable folder");
    path
}

/// A square column of two bones that bends: Z up, centimetres, 20 × 20 × 200, bones of 100. From 0.5 s to 1.5 s the upper bone turns about
/// X from 0° to 90°, in whole-matrix keys. The lower ring follows the lower bone, the upper ring the upper bone, the middle ring both.
pub(crate) fn column() -> String {
    let rings = [0, 100, 200];
    let mut points = String::new();
    for z in rings {
        for (x, y) in [(-10, -10), (10, -10), (10, 10), (-10, 10)] {
            let _ = write!(points, "{x} {y} {z} ");
        }
    }
    let mut quads = String::from("3 2 1 0 ");
    for ring in 0..2 {
        for side in 0..4 {
            let (a, b) = (ring * 4 + side, ring * 4 + (side + 1) % 4);
            let _ = write!(quads, "{a} {b} {} {} ", b + 4, a + 4);
        }
    }
    quads.push_str("8 9 10 11");
    COLUMN.replace("POINTS", points.trim()).replace("QUADS", &quads)
}

/// Where a point of the column's upper ring, (x, y, 200) in the file, stands in the world when the upper bone has turned by `degrees`.
pub(crate) fn column_top(x: f64, y: f64, degrees: f64) -> DVec3 {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let (y, z) = (y * cos - 100.0 * sin, y * sin + 100.0 * cos + 100.0);
    // Z up to Y up, centimetres to metres.
    DVec3::new(x, z, -y) * 0.01
}

const COLUMN: &str = r##"<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset>
    <contributor><authoring_tool>Sinew's tests</authoring_tool></contributor>
    <unit name="centimeter" meter="0.01"/>
    <up_axis>Z_UP</up_axis>
  </asset>
  <library_effects>
    <effect id="red-effect"><profile_COMMON><technique sid="common"><lambert>
      <diffuse><color>0.8 0.1 0.1 1</color></diffuse>
    </lambert></technique></profile_COMMON></effect>
  </library_effects>
  <library_materials><material id="red" name="red"><instance_effect url="#red-effect"/></material></library_materials>
  <library_geometries>
    <geometry id="column" name="column"><mesh>
      <source id="points"><float_array id="points-array" count="36">POINTS</float_array>
        <technique_common><accessor source="#points-array" count="12" stride="3">
          <param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
        </accessor></technique_common></source>
      <vertices id="vertices"><input semantic="POSITION" source="#points"/></vertices>
      <polylist material="paint" count="10">
        <input semantic="VERTEX" source="#vertices" offset="0"/>
        <vcount>4 4 4 4 4 4 4 4 4 4</vcount>
        <p>QUADS</p>
      </polylist>
    </mesh></geometry>
  </library_geometries>
  <library_controllers>
    <controller id="skin"><skin source="#column">
      <bind_shape_matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</bind_shape_matrix>
      <source id="joints"><Name_array id="joints-array" count="2">lower upper</Name_array>
        <technique_common><accessor source="#joints-array" count="2"><param name="JOINT" type="name"/></accessor></technique_common></source>
      <source id="binds"><float_array id="binds-array" count="32">1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1
          1 0 0 0 0 1 0 0 0 0 1 -100 0 0 0 1</float_array>
        <technique_common><accessor source="#binds-array" count="2" stride="16"><param name="TRANSFORM" type="float4x4"/></accessor></technique_common></source>
      <source id="weights"><float_array id="weights-array" count="2">1 0.5</float_array>
        <technique_common><accessor source="#weights-array" count="2"><param name="WEIGHT" type="float"/></accessor></technique_common></source>
      <joints>
        <input semantic="JOINT" source="#joints"/>
        <input semantic="INV_BIND_MATRIX" source="#binds"/>
      </joints>
      <vertex_weights count="12">
        <input semantic="JOINT" source="#joints" offset="0"/>
        <input semantic="WEIGHT" source="#weights" offset="1"/>
        <vcount>1 1 1 1 2 2 2 2 1 1 1 1</vcount>
        <v>0 0 0 0 0 0 0 0  0 1 1 1 0 1 1 1 0 1 1 1 0 1 1 1  1 0 1 0 1 0 1 0</v>
      </vertex_weights>
    </skin></controller>
  </library_controllers>
  <library_animations>
    <animation id="bend" name="bend">
      <source id="times"><float_array id="times-array" count="2">0.5 1.5</float_array>
        <technique_common><accessor source="#times-array" count="2"><param name="TIME" type="float"/></accessor></technique_common></source>
      <source id="matrices"><float_array id="matrices-array" count="32">1 0 0 0 0 1 0 0 0 0 1 100 0 0 0 1
          1 0 0 0 0 0 -1 0 0 1 0 100 0 0 0 1</float_array>
        <technique_common><accessor source="#matrices-array" count="2" stride="16"><param name="TRANSFORM" type="float4x4"/></accessor></technique_common></source>
      <source id="modes"><Name_array id="modes-array" count="2">LINEAR LINEAR</Name_array>
        <technique_common><accessor source="#modes-array" count="2"><param name="INTERPOLATION" type="name"/></accessor></technique_common></source>
      <sampler id="bend-sampler">
        <input semantic="INPUT" source="#times"/>
        <input semantic="OUTPUT" source="#matrices"/>
        <input semantic="INTERPOLATION" source="#modes"/>
      </sampler>
      <channel source="#bend-sampler" target="upper-bone/transform"/>
    </animation>
  </library_animations>
  <library_visual_scenes>
    <visual_scene id="scene">
      <node id="lower-bone" name="lower" sid="lower" type="JOINT">
        <matrix sid="transform">1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix>
        <node id="upper-bone" name="upper" sid="upper" type="JOINT">
          <matrix sid="transform">1 0 0 0 0 1 0 0 0 0 1 100 0 0 0 1</matrix>
        </node>
      </node>
      <node id="body" name="body">
        <instance_controller url="#skin">
          <skeleton>#lower-bone</skeleton>
          <bind_material><technique_common><instance_material symbol="paint" target="#red"/></technique_common></bind_material>
        </instance_controller>
      </node>
    </visual_scene>
  </library_visual_scenes>
  <scene><instance_visual_scene url="#scene"/></scene>
</COLLADA>
"##;

/// A unit cube on a node with this transform (elements as COLLADA writes them), metres, Y up, nothing animated.
pub(crate) fn cube(transform: &str) -> String {
    CUBE.replace("TRANSFORM", transform)
}

const CUBE: &str = r##"<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><unit meter="1"/><up_axis>Y_UP</up_axis></asset>
  <library_geometries>
    <geometry id="cube" name="cube"><mesh>
      <source id="points"><float_array id="points-array" count="24">0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1</float_array>
        <technique_common><accessor source="#points-array" count="8" stride="3">
          <param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
        </accessor></technique_common></source>
      <vertices id="vertices"><input semantic="POSITION" source="#points"/></vertices>
      <polylist count="6">
        <input semantic="VERTEX" source="#vertices" offset="0"/>
        <vcount>4 4 4 4 4 4</vcount>
        <p>0 3 2 1 4 5 6 7 0 1 5 4 1 2 6 5 2 3 7 6 3 0 4 7</p>
      </polylist>
    </mesh></geometry>
  </library_geometries>
  <library_visual_scenes>
    <visual_scene id="scene">
      <node id="box" name="box">TRANSFORM<instance_geometry url="#cube"/></node>
    </visual_scene>
  </library_visual_scenes>
  <scene><instance_visual_scene url="#scene"/></scene>
</COLLADA>
"##;

/// A muscle on an arm, in the short form: 4 nodes, millimetres, at rest as long as the straight arm's span.
pub(crate) const BICEPS: &str = "\
muscle_config:
  radiuses: [5.0, 15.0, 12.0, 5.0]
  grow_mults: [0.0, 2.0, 1.0, 0.0]
  len: 250.0

carcass_config:
  data: [[30.0, 220.0], [30.0, 120.0]]
  thickness: 5.0
";

/// The figures of [`BICEPS`]: attachment to elbow on the first and on the second rod.
pub(crate) const BICEPS_ARM: (f64, f64) = (220.0, 30.0);
/// Radii of [`BICEPS`] at rest.
pub(crate) const BICEPS_RADII: [f64; 4] = [5.0, 15.0, 12.0, 5.0];
/// Growth multipliers of [`BICEPS`].
pub(crate) const BICEPS_GROWTH: [f64; 4] = [0.0, 2.0, 1.0, 0.0];

/// Distance of the attachments at an elbow angle in degrees, and the moment arm.
pub(crate) fn biceps_length(degrees: f64) -> (f64, f64) {
    let (p, d) = BICEPS_ARM;
    let (sin, cos) = degrees.to_radians().sin_cos();
    let length = (p * p + d * d + 2.0 * p * d * cos).sqrt();
    (length, p * d * sin / length)
}

/// Volume of truncated cones through `radii` at equal spacing over `length`.
pub(crate) fn cones(radii: &[f64], length: f64) -> f64 {
    let sum: f64 = radii.windows(2).map(|r| (r[0] * r[0] + r[0] * r[1] + r[1] * r[1]) / 3.0).sum();
    std::f64::consts::PI * length / (radii.len() - 1) as f64 * sum
}

/// δ of [`BICEPS`] at a length, by bisection: the volume grows with δ, since no growth multiplier is negative.
pub(crate) fn biceps_delta(length: f64) -> f64 {
    let rest = cones(&BICEPS_RADII, 250.0);
    let at = |delta: f64| cones(&std::array::from_fn::<f64, 4, _>(|i| BICEPS_RADII[i] + BICEPS_GROWTH[i] * delta), length);
    let (mut low, mut high) = (-5.0, 50.0);
    for _ in 0..200 {
        let middle = (low + high) / 2.0;
        if at(middle) < rest { low = middle } else { high = middle }
    }
    (low + high) / 2.0
}

//! A limb that the tests make: a closed tube of skin round two bones, and a muscle from the one to the other.

use std::fmt::Write as _;
use std::path::Path;

use sinew::document::Document;
use sinew::formats::SCENE_READERS;
use sinew::progress::Progress;

use crate::support::models::write;

/// Length of each bone, millimetres.
pub(crate) const BONE: f64 = 280.0;

/// A limb along y from 0, the first bone, to twice [`BONE`]; x is its front, and it bends about −z. Lengths in millimetres.
#[derive(Debug, Clone)]
pub(crate) struct Limb {
    /// Radius of the tube.
    pub(crate) radius: f64,
    /// About how long the sides of its triangles are.
    pub(crate) edge: f64,
    /// Metres a unit of the scene file.
    pub(crate) unit: f64,
    /// Whether z is turned round, in the limb and in its muscle.
    pub(crate) mirrored: bool,
    /// How many tubes there are, one round the other, 1 mm apart.
    pub(crate) skins: usize,
    /// Whether the ends are open.
    pub(crate) open: bool,
    /// The muscle's axis in front of the bone, and beside it.
    pub(crate) front: f64,
    pub(crate) side: f64,
    /// How far in front of the second bone it ends.
    pub(crate) end: f64,
    /// Its largest radius.
    pub(crate) thick: f64,
    /// Growth of its belly.
    pub(crate) growth: f64,
    /// What else stands in the muscle file.
    pub(crate) more: String,
}

impl Default for Limb {
    fn default() -> Self {
        Self {
            radius: 45.0,
            edge: 8.0,
            unit: 0.001,
            mirrored: false,
            skins: 1,
            open: false,
            front: 24.0,
            side: 0.0,
            end: 14.0,
            thick: 15.0,
            growth: 2.0,
            more: String::new(),
        }
    }
}

impl Limb {
    /// Opens it from a folder of its own.
    pub(crate) fn open(&self) -> Document {
        let folder = crate::support::folder();
        self.open_in(folder.path())
    }

    /// Opens it from this folder.
    pub(crate) fn open_in(&self, folder: &Path) -> Document {
        write(folder, "limb.dae", &self.scene());
        let file = write(folder, "limb.yaml", &self.muscle());
        Document::open(&[file], SCENE_READERS, &Progress::default()).expect("a sound limb")
    }

    fn muscle(&self) -> String {
        let Self { front, end, thick, growth, more, .. } = self;
        let side = if self.mirrored { -self.side } else { self.side };
        let radii = [0.25, 0.6, 0.9, 1.0, 0.85, 0.5, 0.2].map(|share| format!("{:.3}", share * thick)).join(", ");
        let growths = [0.0, 0.6, 0.9, 1.0, 0.8, 0.5, 0.0].map(|share| format!("{:.3}", share * growth)).join(", ");
        format!(
            "unit: mm\nclip: limb.dae\njoint: {{bone: lower, axis: [0, 0, -1], range: [0, 120]}}\n{more}\nmuscles:\n  - name: Flexor\n    length: 220\n    \
             radii: [{radii}]\n    growth: [{growths}]\n    origin: {{bone: upper, offset: [{front}, 20, {side}]}}\n    \
             via: [{{bone: upper, offset: [{front}, 200, {side}]}}]\n    insertion: {{bone: lower, offset: [{end}, 40, 0]}}\n    tendons:\n      \
             origin: {{length: 10, radius: 3}}\n      insertion: {{length: 60, radius: 2.5}}\n"
        )
    }

    fn scene(&self) -> String {
        let scale = 0.001 / self.unit;
        let rows = (2.0 * BONE / self.edge).round() as u32;
        let corners = ((2.0 * std::f64::consts::PI * self.radius / self.edge / 4.0).round() as u32 * 4).max(8);
        let (mut points, mut weights, mut influences) = (String::new(), String::from("1 "), String::new());
        let (mut triangles, mut count, mut counts) = (String::new(), 0, String::new());
        let mut weight_count = 1;
        let turned = if self.mirrored { -1.0 } else { 1.0 };
        for skin in 0..self.skins as u32 {
            let first = count;
            let mut point = |x: f64, y: f64, z: f64| {
                let _ = write!(points, "{} {} {} ", x * scale, y * scale, z * turned * scale);
                // The skin bends over 40 mm to either side of the joint.
                let share = ((y - BONE) / 80.0 + 0.5).clamp(0.0, 1.0);
                let share = share * share * (3.0 - 2.0 * share);
                if share == 0.0 || share == 1.0 {
                    counts.push_str("1 ");
                    let _ = write!(influences, "{} 0 ", u32::from(share == 1.0));
                } else {
                    counts.push_str("2 ");
                    let _ = write!(weights, "{} {} ", 1.0 - share, share);
                    let _ = write!(influences, "0 {} 1 {} ", weight_count, weight_count + 1);
                    weight_count += 2;
                }
                count += 1;
            };
            for row in 0..=rows {
                for corner in 0..corners {
                    let angle = f64::from(corner) / f64::from(corners) * std::f64::consts::TAU;
                    let radius = self.radius + f64::from(skin);
                    point(radius * angle.cos(), f64::from(row) / f64::from(rows) * 2.0 * BONE, radius * angle.sin());
                }
            }
            point(0.0, 0.0, 0.0);
            point(0.0, 2.0 * BONE, 0.0);
            let mut triangle = |[a, b, c]: [u32; 3]| {
                let [b, c] = if self.mirrored { [c, b] } else { [b, c] };
                let _ = write!(triangles, "{a} {b} {c} ");
            };
            for row in 0..rows {
                for corner in 0..corners {
                    let (a, b) = (first + row * corners + corner, first + row * corners + (corner + 1) % corners);
                    triangle([a, a + corners, b]);
                    triangle([b, a + corners, b + corners]);
                }
            }
            let (low, high) = (first + (rows + 1) * corners, first + (rows + 1) * corners + 1);
            for corner in (0..corners).filter(|_| !self.open) {
                let (a, b) = (first + corner, first + (corner + 1) % corners);
                triangle([low, a, b]);
                triangle([high, b + rows * corners, a + rows * corners]);
            }
        }
        let bone = BONE * scale;
        SCENE
            .replace("UNIT", &self.unit.to_string())
            .replace("POINTS", points.trim())
            .replace("NUMBERS", &(3 * count).to_string())
            .replace("VERTICES", &count.to_string())
            .replace("FACES", &(triangles.split_whitespace().count() / 3).to_string())
            .replace("TRIANGLES", triangles.trim())
            .replace("SHARES", &weight_count.to_string())
            .replace("WEIGHTS", weights.trim())
            .replace("COUNTS", counts.trim())
            .replace("INFLUENCES", influences.trim())
            .replace("BONE", &bone.to_string())
    }
}

const SCENE: &str = r##"<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><unit name="unit" meter="UNIT"/><up_axis>Y_UP</up_axis></asset>
  <library_geometries>
    <geometry id="tube" name="tube"><mesh>
      <source id="points"><float_array id="points-array" count="NUMBERS">POINTS</float_array>
        <technique_common><accessor source="#points-array" count="VERTICES" stride="3">
          <param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
        </accessor></technique_common></source>
      <vertices id="vertices"><input semantic="POSITION" source="#points"/></vertices>
      <triangles count="FACES"><input semantic="VERTEX" source="#vertices" offset="0"/><p>TRIANGLES</p></triangles>
    </mesh></geometry>
  </library_geometries>
  <library_controllers>
    <controller id="skin"><skin source="#tube">
      <source id="joints"><Name_array id="joints-array" count="2">upper lower</Name_array>
        <technique_common><accessor source="#joints-array" count="2"><param name="JOINT" type="name"/></accessor></technique_common></source>
      <source id="binds"><float_array id="binds-array" count="32">1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1
          1 0 0 0 0 1 0 -BONE 0 0 1 0 0 0 0 1</float_array>
        <technique_common><accessor source="#binds-array" count="2" stride="16"><param name="TRANSFORM" type="float4x4"/></accessor></technique_common></source>
      <source id="weights"><float_array id="weights-array" count="SHARES">WEIGHTS</float_array>
        <technique_common><accessor source="#weights-array" count="SHARES"><param name="WEIGHT" type="float"/></accessor></technique_common></source>
      <joints><input semantic="JOINT" source="#joints"/><input semantic="INV_BIND_MATRIX" source="#binds"/></joints>
      <vertex_weights count="VERTICES">
        <input semantic="JOINT" source="#joints" offset="0"/>
        <input semantic="WEIGHT" source="#weights" offset="1"/>
        <vcount>COUNTS</vcount>
        <v>INFLUENCES</v>
      </vertex_weights>
    </skin></controller>
  </library_controllers>
  <library_visual_scenes>
    <visual_scene id="scene">
      <node id="upper" name="upper" sid="upper" type="JOINT">
        <node id="lower" name="lower" sid="lower" type="JOINT">
          <matrix sid="transform">1 0 0 0 0 1 0 BONE 0 0 1 0 0 0 0 1</matrix>
          <node id="tip" name="tip" sid="tip" type="JOINT"><matrix>1 0 0 0 0 1 0 BONE 0 0 1 0 0 0 0 1</matrix></node>
        </node>
      </node>
      <node id="body" name="body"><instance_controller url="#skin"><skeleton>#upper</skeleton></instance_controller></node>
    </visual_scene>
  </library_visual_scenes>
  <scene><instance_visual_scene url="#scene"/></scene>
</COLLADA>
"##;

//! Figures of human build as COLLADA files: bones alone, named and scaled as a test asks.

use std::fmt::Write as _;

use glam::DVec3;

/// The bones of a figure that stands upright in metres, Y up, looks along +Z and has its left at +X. `#` in a name stands for the side.
pub(crate) struct Figure {
    /// Name, number of the bone above, and where it begins.
    pub bones: Vec<(String, Option<usize>, DVec3)>,
    /// Metres a unit of the file.
    pub unit: f64,
    /// Whether the file has Z up.
    pub z_up: bool,
    /// Scale of the node above the bones, whose places are divided by it.
    pub armature: DVec3,
}

/// What rigs call pelvis, clavicle, upper arm, forearm, hand, thigh, shin, foot and toes, and what stands for left and right in it.
pub(crate) const CONVENTIONS: [(&str, [&str; 2], [&str; 9]); 10] = [
    (
        "Mixamo",
        ["Left", "Right"],
        [
            "mixamorig:Hips",
            "mixamorig:#Shoulder",
            "mixamorig:#Arm",
            "mixamorig:#ForeArm",
            "mixamorig:#Hand",
            "mixamorig:#UpLeg",
            "mixamorig:#Leg",
            "mixamorig:#Foot",
            "mixamorig:#ToeBase",
        ],
    ),
    (
        "Biped",
        ["L", "R"],
        [
            "Bip01 Pelvis",
            "Bip01 # Clavicle",
            "Bip01 # UpperArm",
            "Bip01 # Forearm",
            "Bip01 # Hand",
            "Bip01 # Thigh",
            "Bip01 # Calf",
            "Bip01 # Foot",
            "Bip01 # Toe0",
        ],
    ),
    (
        "Rigify",
        ["L", "R"],
        [
            "DEF-spine",
            "DEF-shoulder.#",
            "DEF-upper_arm.#",
            "DEF-forearm.#",
            "DEF-hand.#",
            "DEF-thigh.#",
            "DEF-shin.#",
            "DEF-foot.#",
            "DEF-toe.#",
        ],
    ),
    ("Daz Genesis 8", ["l", "r"], ["pelvis", "#Collar", "#ShldrBend", "#ForearmBend", "#Hand", "#ThighBend", "#Shin", "#Foot", "#Toe"]),
    (
        "VRM",
        ["L", "R"],
        [
            "J_Bip_C_Hips",
            "J_Bip_#_Shoulder",
            "J_Bip_#_UpperArm",
            "J_Bip_#_LowerArm",
            "J_Bip_#_Hand",
            "J_Bip_#_UpperLeg",
            "J_Bip_#_LowerLeg",
            "J_Bip_#_Foot",
            "J_Bip_#_ToeBase",
        ],
    ),
    ("Unreal", ["l", "r"], ["pelvis", "clavicle_#", "upperarm_#", "lowerarm_#", "hand_#", "thigh_#", "calf_#", "foot_#", "ball_#"]),
    ("HumanIK", ["Left", "Right"], ["Hips", "#Shoulder", "#Arm", "#ForeArm", "#Hand", "#UpLeg", "#Leg", "#Foot", "#ToeBase"]),
    ("Biovision", ["Left", "Right"], ["Hips", "#Collar", "#Shoulder", "#Elbow", "#Wrist", "#Hip", "#Knee", "#Ankle", "#Toe"]),
    ("Poser", ["l", "r"], ["hip", "#Collar", "#Shldr", "#ForeArm", "#Hand", "#Thigh", "#Shin", "#Foot", "#Toe"]),
    ("no names", ["", ""], [""; 9]),
];

/// Pelvis, chest and head, and the left side from the clavicle out and from the hip down.
type Places = ([DVec3; 3], [DVec3; 4], [DVec3; 4]);

/// A person with the arms out to the sides.
pub(crate) fn t_pose() -> Places {
    let v = DVec3::new;
    (
        [v(0.0, 1.0, 0.0), v(0.0, 1.35, 0.0), v(0.0, 1.6, 0.0)],
        [v(0.03, 1.45, 0.0), v(0.18, 1.45, 0.0), v(0.46, 1.45, 0.0), v(0.71, 1.45, 0.0)],
        [v(0.09, 0.95, 0.0), v(0.09, 0.53, 0.01), v(0.09, 0.09, -0.02), v(0.09, 0.03, 0.11)],
    )
}

/// A person of the very proportions of Gait2392 and Arm26, in their default pose: standing, arms hanging.
pub(crate) fn model_pose() -> Places {
    // The models look along x and have their right at z; hips and shoulders stand above each other.
    let at = |base: DVec3, [x, y, z]: [f64; 3]| base + DVec3::new(-z, y, x);
    let (hip, shoulder) = (DVec3::new(0.0835, 0.9, 0.0), DVec3::new(0.17, 1.4, 0.0));
    // The left side has z the other way.
    let left = |base: DVec3, [x, y, z]: [f64; 3]| at(base, [x, y, -z]);
    // The centre of the knee on the femur and on the tibia, see the data of the set.
    let knee = left(hip, [-0.0108, -0.4086, 0.0]);
    let ankle = left(knee, [0.0057, -0.4162, 0.0]);
    let elbow = left(shoulder, [0.0061, -0.2904, -0.0123]);
    (
        [DVec3::new(0.0, 0.97, 0.0), DVec3::new(0.0, 1.3, 0.0), DVec3::new(0.0, 1.55, 0.0)],
        [DVec3::new(0.03, 1.4, 0.0), shoulder, elbow, left(elbow, [0.008, -0.249, 0.063])],
        [hip, knee, ankle, left(ankle, [0.13003, -0.04395, 0.009])],
    )
}

impl Figure {
    /// A figure of these proportions in the names of a convention.
    pub(crate) fn new((trunk, arm, leg): Places, convention: &str) -> Self {
        let (_, sides, names) = CONVENTIONS.into_iter().find(|(name, ..)| *name == convention).expect("a convention");
        let mut bones: Vec<(String, Option<usize>, DVec3)> = vec![
            (names[0].to_owned(), None, trunk[0]),
            ("spine".to_owned(), Some(0), trunk[1]),
            ("head".to_owned(), Some(1), trunk[2]),
            ("head end".to_owned(), Some(2), trunk[2] + DVec3::Y * 0.2),
        ];
        for (side, mirror) in [(0, 1.0), (1, -1.0)] {
            for (number, place) in arm.into_iter().chain(leg).enumerate() {
                let above = match number {
                    0 => 1,
                    4 => 0,
                    _ => bones.len() - 1,
                };
                bones.push((names[number + 1].replace('#', sides[side]), Some(above), place * DVec3::new(mirror, 1.0, 1.0)));
            }
        }
        if convention == "no names" {
            bones.iter_mut().enumerate().for_each(|(number, bone)| bone.0 = format!("b{number:02}"));
        }
        Self { bones, unit: 1.0, z_up: false, armature: DVec3::ONE }
    }

    /// The same figure without the bones of these numbers and all below them.
    pub(crate) fn without(mut self, gone: &[usize]) -> Self {
        let is_gone = |bones: &[(String, Option<usize>, DVec3)], mut number: usize| loop {
            if gone.contains(&number) {
                return true;
            }
            match bones[number].1 {
                Some(above) => number = above,
                None => return false,
            }
        };
        let keep: Vec<usize> = (0..self.bones.len()).filter(|number| !is_gone(&self.bones, *number)).collect();
        let new_number = |old: usize| keep.iter().position(|kept| *kept == old);
        self.bones =
            keep.iter().map(|old| self.bones[*old].clone()).map(|(name, above, at)| (name, above.and_then(new_number), at)).collect();
        self
    }

    /// The figure as COLLADA; `prefix` goes before each id.
    pub(crate) fn scene_nodes(&self, prefix: &str) -> String {
        let up = |at: DVec3| if self.z_up { DVec3::new(at.x, -at.z, at.y) } else { at };
        let mut text = String::new();
        let scale = self.armature;
        let _ = write!(text, "<node id=\"{prefix}armature\" name=\"armature\"><scale>{} {} {}</scale>", scale.x, scale.y, scale.z);
        let roots: Vec<usize> = (0..self.bones.len()).filter(|number| self.bones[*number].1.is_none()).collect();
        roots.into_iter().for_each(|root| self.write_bone(&mut text, root, prefix, &up));
        text.push_str("</node>");
        text
    }

    fn write_bone(&self, text: &mut String, number: usize, prefix: &str, up: &impl Fn(DVec3) -> DVec3) {
        let (name, above, at) = &self.bones[number];
        let from = above.map_or(DVec3::ZERO, |above| self.bones[above].2);
        let offset = up(*at - from) / self.unit / self.armature;
        let _ = write!(text, "<node id=\"{prefix}bone{number}\" name=\"{name}\" type=\"JOINT\">");
        let _ = write!(text, "<translate>{} {} {}</translate>", offset.x, offset.y, offset.z);
        let below: Vec<usize> = (0..self.bones.len()).filter(|other| self.bones[*other].1 == Some(number)).collect();
        below.into_iter().for_each(|bone| self.write_bone(text, bone, prefix, up));
        text.push_str("</node>");
    }

    /// The figure as a COLLADA file.
    pub(crate) fn dae(&self) -> String {
        file(self.unit, self.z_up, &self.scene_nodes(""))
    }
}

/// A COLLADA file with these nodes.
pub(crate) fn file(unit: f64, z_up: bool, nodes: &str) -> String {
    let up = if z_up { "Z_UP" } else { "Y_UP" };
    format!(
        "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">\
         <asset><unit meter=\"{unit}\"/><up_axis>{up}</up_axis></asset>\
         <library_visual_scenes><visual_scene id=\"scene\">{nodes}</visual_scene></library_visual_scenes>\
         <scene><instance_visual_scene url=\"#scene\"/></scene></COLLADA>"
    )
}

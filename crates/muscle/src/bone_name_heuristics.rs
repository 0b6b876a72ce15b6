//! What the names of bones mean in usual rigs: which part of a body each one is, and of which side.
//!
//! Programs name the bone below a joint after the part of the body (Mixamo `mixamorig:LeftForeArm`, 3ds Max `Bip01 L Forearm`, Rigify `DEF-forearm.L`, Daz
//! `lForearmBend`), after the lower or the upper half of a limb (Unreal `lowerarm_l`, VRM `J_Bip_L_LowerArm`), or after the joint itself (Maya `L_elbow_JNT`,
//! Biovision `LeftKnee`); people name it in their own language. Beside it lie helpers that carry its name and are something else: twist bones, inverse
//! kinematics, controls. One word may mean two parts (`LeftShoulder` is a clavicle above `LeftArm` and an upper arm above `LeftElbow`; `LeftLeg` is a shin below
//! `LeftUpLeg`), so each part has words of several ranks, and [`super::humanoid`] weighs them along the chain of bones.

/// A part of a body that has a bone of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum BodyPart {
    /// From the shoulder to the elbow.
    UpperArm,
    /// From the elbow to the wrist.
    Forearm,
    /// From the wrist on.
    Hand,
    /// From the hip to the knee.
    Thigh,
    /// From the knee to the ankle.
    Shin,
    /// From the ankle on.
    Foot,
    /// From the ball of the foot on.
    Toes,
}

impl BodyPart {
    /// Parts of a name, in lower case without separators, that mean this part: the earlier a group, the surer.
    fn words(self) -> &'static [&'static [&'static str]] {
        match self {
            Self::UpperArm => &UPPER_ARM,
            Self::Forearm => &FOREARM,
            Self::Hand => &HAND,
            Self::Thigh => &THIGH,
            Self::Shin => &SHIN,
            Self::Foot => &FOOT,
            Self::Toes => &TOES,
        }
    }

    /// Parts of a name that make it name another part, although it has a word of this one.
    fn other_words(self) -> &'static [&'static str] {
        match self {
            Self::UpperArm => {
                &["forearm", "lowerarm", "lowarm", "armature", "предплеч", "unterarm", "elbow", "antebra", "avantbra", "avambra"]
            }
            Self::Hand => &["thumb", "index", "middle", "ring", "pinky", "finger", "carpal", "handle"],
            Self::Thigh => &["lowerleg", "lowleg", "leglower", "hips"],
            Self::Shin => &["upleg", "upperleg", "legupper", "thigh"],
            Self::Foot => &["toe"],
            Self::Forearm | Self::Toes => &[],
        }
    }
}

/// See [`BodyPart::words`].
const UPPER_ARM: [&[&str]; 3] = [
    &["upperarm", "uparm", "armupper", "armup", "shldr", "humerus", "oberarm", "bras", "brazo", "braccio", "上腕"],
    &["arm", "плечо", "плеча", "腕"],
    &["shoulder", "schulter", "肩"],
];
/// See [`BodyPart::words`].
const HAND: [&[&str]; 2] = [&["hand", "wrist", "кист", "запяст", "mano", "手首"], &["palm", "poignet", "手"]];
/// See [`BodyPart::words`].
const THIGH: [&[&str]; 2] = [
    &["thigh", "upleg", "upperleg", "legupper", "legup", "femur", "бедр", "oberschenkel", "cuisse", "muslo", "coscia", "太もも"],
    &["hip", "leg", "足"],
];
/// See [`BodyPart::words`]. A bare “leg” is one below an upper leg, which the chain of bones tells.
const SHIN: [&[&str]; 3] = [
    &[
        "shin",
        "calf",
        "lowerleg",
        "lowleg",
        "leglower",
        "leglow",
        "crus",
        "голен",
        "unterschenkel",
        "mollet",
        "pantorrilla",
        "polpaccio",
        "すね",
    ],
    &["knee", "tibia", "колен", "knie", "genou", "rodilla", "ginocchio", "ひざ", "膝"],
    &["leg"],
];
/// See [`BodyPart::words`].
const FOOT: [&[&str]; 1] = [&["foot", "ankle", "ступн", "стоп", "лодыж", "fuss", "fuß", "cheville", "tobillo", "caviglia", "足首"]];
/// See [`BodyPart::words`].
const TOES: [&[&str]; 1] = [&["toe", "ball", "носок", "пальц", "zehen", "orteil", "つま先"]];

/// See [`BodyPart::words`]. Those that name the bone come before those that name the joint, which helpers at the elbow are also called.
const FOREARM: [&[&str]; 3] = [
    &[
        "forearm",
        "lowerarm",
        "lowarm",
        "armlower",
        "armlow",
        "предплеч",
        "unterarm",
        "avantbras",
        "antebrazo",
        "avambraccio",
        "antebraco",
        "antebraço",
        "前臂",
        "前腕",
        "przedrami",
        "onderarm",
        "underarm",
    ],
    &[
        "elbow",
        "локоть",
        "локот",
        "ellbogen",
        "ellenbogen",
        "coude",
        "codo",
        "gomito",
        "cotovelo",
        "ひじ",
        "肘",
        "lokiec",
        "łokieć",
        "elleboog",
    ],
    &["lradius", "rradius", "radius", "ulna"],
];

/// Words that make a bone of such a name something else.
const HELPERS: [&str; 24] = [
    "twist",
    "roll",
    "helper",
    "ik",
    "fk",
    "pole",
    "ctrl",
    "control",
    "controller",
    "target",
    "end",
    "nub",
    "tip",
    "effector",
    "goal",
    "corrective",
    "tweak",
    "vis",
    "mch",
    "aux",
    "half",
    "driver",
    "pv",
    "捩",
];

/// Side of the body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Side {
    /// The character's left.
    Left,
    /// The character's right.
    Right,
}

/// What a bone's name says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct BoneNameMatch {
    /// Number of the group of words that it has one of: the lower, the surer.
    pub rank: usize,
    /// Whether it is also called a helper of some kind.
    pub helper: bool,
    /// The side, where it says one.
    pub side: Option<Side>,
}

/// What `name` says about a part of a body; `None` where it names something else.
pub(super) fn names(name: &str, part: BodyPart) -> Option<BoneNameMatch> {
    let words = words(name);
    let joined = words.concat();
    let found = |group: &[&'static str]| group.iter().copied().find(|word| joined.contains(word));
    let (rank, word) = part.words().iter().enumerate().find_map(|(rank, group)| Some((rank, found(group)?)))?;
    if part.other_words().iter().any(|word| joined.contains(word)) {
        return None;
    }
    let helper = words.iter().any(|word| HELPERS.contains(&word.as_str())) || joined.contains("twist");
    // One letter run together with the part, as in “lthigh”.
    let run_together = || match joined.split_at_checked(1) {
        Some(("l", rest)) if rest.starts_with(word) => Some(Side::Left),
        Some(("r", rest)) if rest.starts_with(word) => Some(Side::Right),
        _ => None,
    };
    Some(BoneNameMatch { rank, helper, side: side(&words, &joined).or_else(run_together) })
}

/// The words of a name in lower case: it is cut at namespaces, signs, digits, where a small letter meets a capital, and before the last of several capitals
/// that a small letter follows.
fn words(name: &str) -> Vec<String> {
    let own = name.rsplit([':', '|']).next().unwrap_or(name);
    let mut words = vec![String::new()];
    let mut before = ' ';
    let mut letters = own.chars().take(120).peekable();
    while let Some(letter) = letters.next() {
        let last_capital = before.is_uppercase() && letters.peek().is_some_and(|next| next.is_lowercase());
        let cut = !letter.is_alphabetic() || (letter.is_uppercase() && (before.is_lowercase() || last_capital));
        if cut && words.last().is_some_and(|word| !word.is_empty()) {
            words.push(String::new());
        }
        if let (true, Some(word)) = (letter.is_alphabetic(), words.last_mut()) {
            word.extend(letter.to_lowercase());
        }
        before = letter;
    }
    words.retain(|word| !word.is_empty());
    words
}

fn side(words: &[String], joined: &str) -> Option<Side> {
    let is = |list: &[&str]| words.iter().any(|word| list.contains(&word.as_str()));
    // Words run together, as in “leftforearm” and “lradius”.
    let starts = |list: &[&str]| list.iter().any(|start| joined.contains(start));
    if is(&["l", "left", "lf", "lft", "л", "лев", "левый", "левая", "левое", "links", "gauche", "izq"])
        || starts(&["left", "左", "lradius", "lulna"])
    {
        Some(Side::Left)
    } else if is(&["r", "right", "rt", "rgt", "п", "прав", "правый", "правая", "правое", "rechts", "droite", "der"])
        || starts(&["right", "右", "rradius", "rulna"])
    {
        Some(Side::Right)
    } else {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn usual_rigs_are_understood() {
        use Side::{Left, Right};
        for (name, side) in [
            ("mixamorig:LeftForeArm", Some(Left)),
            ("mixamorig_RightForeArm", Some(Right)),
            ("Bip01 L Forearm", Some(Left)),
            ("Bip001_R_Forearm", Some(Right)),
            ("forearm.L", Some(Left)),
            ("lower_arm.R", Some(Right)),
            ("Lower_Arm_R", Some(Right)),
            ("DEF-forearm.L.001", Some(Left)),
            ("lForearmBend", Some(Left)),
            ("rForeArm", Some(Right)),
            ("lowerarm_l", Some(Left)),
            ("J_Bip_L_LowerArm", Some(Left)),
            ("CC_Base_R_Forearm", Some(Right)),
            ("L_elbow_JNT", Some(Left)),
            ("elbow_R", Some(Right)),
            ("char|rig:LeftElbow", Some(Left)),
            ("lradius", Some(Left)),
            ("Предплечье_Л", Some(Left)),
            ("правое предплечье", Some(Right)),
            ("左ひじ", Some(Left)),
            ("Unterarm_links", Some(Left)),
            ("forearm", None),
        ] {
            let meaning = names(name, BodyPart::Forearm).unwrap_or_else(|| panic!("{name}"));
            assert_eq!((meaning.side, meaning.helper), (side, false), "{name}");
        }
        for name in ["lowerarm_twist_01_l", "lForearmTwist", "forearm_ik.L", "L_elbow_PV", "Bip01 L ForeTwist elbow", "ORG-forearm_tweak.L"]
        {
            assert!(names(name, BodyPart::Forearm).is_none_or(|meaning| meaning.helper), "{name}");
        }
        for name in ["LeftArm", "upper_arm.L", "LeftHand", "Bip01 L UpperArm", "shin.L", "плечо", "", "arm"] {
            assert_eq!(names(name, BodyPart::Forearm), None, "{name}");
        }
    }

    #[test]
    fn every_part_of_a_body_is_told_from_the_others() {
        use BodyPart::{Foot, Hand, Shin, Thigh, Toes, UpperArm};
        use Side::{Left, Right};
        for (part, rank, names_of_it) in [
            (UpperArm, 0, ["upper_arm.L", "Bip01 L UpperArm", "J_Bip_L_UpperArm", "lShldrBend", "upperarm_l", "l_upperarm"]),
            (UpperArm, 1, ["mixamorig:LeftArm", "LeftArm", "arm.L", "Arm_L", "L_arm_jnt", "левое плечо"]),
            (UpperArm, 2, ["LeftShoulder", "LShoulder", "L_shoulder_JNT", "shoulder_l", "lshoulder", "左肩"]),
            (Hand, 0, ["mixamorig:LeftHand", "hand.L", "Bip01 L Hand", "lHand", "LWrist", "L_wrist_JNT"]),
            (Thigh, 0, ["LeftUpLeg", "thigh.L", "Bip01 L Thigh", "lThighBend", "J_Bip_L_UpperLeg", "DEF-thigh.L.001"]),
            (Thigh, 1, ["LeftHip", "LHipJoint", "L_hip_JNT", "leg.L", "lhip", "左足"]),
            (Shin, 0, ["shin.L", "Bip01 L Calf", "lShin", "J_Bip_L_LowerLeg", "calf_l", "левая голень"]),
            (Shin, 1, ["LeftKnee", "LKnee", "L_knee_JNT", "knee.L", "lknee", "左ひざ"]),
            (Shin, 2, ["mixamorig:LeftLeg", "LeftLeg", "leg.L", "Leg_L", "l_leg", "lleg"]),
            (Foot, 0, ["mixamorig:LeftFoot", "foot.L", "Bip01 L Foot", "lFoot", "LAnkle", "J_Bip_L_Foot"]),
            (Toes, 0, ["mixamorig:LeftToeBase", "toe.L", "Bip01 L Toe0", "lToe", "ball_l", "J_Bip_L_ToeBase"]),
        ] {
            for name in names_of_it {
                let found = names(name, part).unwrap_or_else(|| panic!("{name}"));
                assert_eq!((found.rank, found.side, found.helper), (rank, Some(Left), false), "{name} as {part:?}");
            }
        }
        for (part, name) in [
            (UpperArm, "LeftForeArm"),
            (UpperArm, "lowerarm_l"),
            (UpperArm, "Armature"),
            (Hand, "LeftHandIndex1"),
            (Hand, "LeftForeArm"),
            (Thigh, "LeftLowerLeg"),
            (Thigh, "Hips"),
            (Shin, "RightUpLeg"),
            (Foot, "LeftToeBase"),
            (Toes, "LeftFoot"),
        ] {
            assert_eq!(names(name, part), None, "{name} as {part:?}");
        }
        assert_eq!(names("RKnee", Shin).and_then(|found| found.side), Some(Right));
        assert!(names("lThighTwist", Thigh).is_some_and(|found| found.helper));
    }
}

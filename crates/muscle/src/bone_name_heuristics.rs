//! What the names of bones mean in usual rigs: which one is a forearm, and of which side.
//!
//! Programs name the bone below the elbow after the forearm (Mixamo `mixamorig:LeftForeArm`, 3ds Max `Bip01 L Forearm`, Rigify `DEF-forearm.L`, Daz
//! `lForearmBend`), after the lower arm (Unreal `lowerarm_l`, VRM `J_Bip_L_LowerArm`), or after the joint itself (Maya `L_elbow_JNT`); people
//! name it in their own language. Beside it lie helpers that carry its name and are something else: twist bones, inverse kinematics, controls.

/// Parts of a name, in lower case without separators, that mean the bone below the elbow; those that name the bone come before those that name the
/// joint, which helpers at the elbow are also called.
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
    /// Place in [`FOREARM`] of the word that it has: the lower, the surer.
    pub rank: usize,
    /// Whether it is also called a helper of some kind.
    pub helper: bool,
    /// The side, where it says one.
    pub side: Option<Side>,
}

/// What `name` says about a forearm; `None` where it names something else.
pub(super) fn forearm(name: &str) -> Option<BoneNameMatch> {
    let words = words(name);
    let joined = words.concat();
    let rank = FOREARM.iter().position(|group| group.iter().any(|word| joined.contains(word)))?;
    let helper = words.iter().any(|word| HELPERS.contains(&word.as_str())) || joined.contains("twist");
    Some(BoneNameMatch { rank, helper, side: side(&words, &joined) })
}

/// The words of a name in lower case: it is cut at namespaces, signs, digits, and where a small letter meets a capital.
fn words(name: &str) -> Vec<String> {
    let own = name.rsplit([':', '|']).next().unwrap_or(name);
    let mut words = vec![String::new()];
    let mut before = ' ';
    for letter in own.chars().take(120) {
        let cut = !letter.is_alphabetic() || (before.is_lowercase() && letter.is_uppercase());
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
            let meaning = forearm(name).unwrap_or_else(|| panic!("{name}"));
            assert_eq!((meaning.side, meaning.helper), (side, false), "{name}");
        }
        for name in ["lowerarm_twist_01_l", "lForearmTwist", "forearm_ik.L", "L_elbow_PV", "Bip01 L ForeTwist elbow", "ORG-forearm_tweak.L"]
        {
            assert!(forearm(name).is_none_or(|meaning| meaning.helper), "{name}");
        }
        for name in ["LeftArm", "upper_arm.L", "LeftHand", "Bip01 L UpperArm", "shin.L", "плечо", "", "arm"] {
            assert_eq!(forearm(name), None, "{name}");
        }
    }
}

//! What things are called, also those that their file gives no name.

use std::borrow::Cow;
use std::fmt;

use crate::message;
use crate::message::{Message, ToMessage, Value};

/// What something is called.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Label<'a> {
    /// The name that its file gives it.
    Name(&'a str),
    /// It has no name, and people tell it by what it is.
    Unnamed(Unnamed),
}

/// What something is called, kept apart from it.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum OwnedLabel {
    /// The name that its file gives it.
    Name(String),
    /// It has no name.
    Unnamed(Unnamed),
}

/// A part of the two-rod arm that muscle files describe, or what a part of it or of a muscle is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum BodyPart {
    /// The upper rod.
    UpperArm,
    /// The free end of the upper rod.
    Shoulder,
    /// The joint between the rods.
    Elbow,
    /// The lower rod.
    Forearm,
    /// The free end of the lower rod.
    Wrist,
    /// What rods are made of.
    Bone,
    /// A tendon, or what it is made of.
    Tendon,
}

/// A thing without a name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Unnamed {
    /// The node at this place in its file, from 1.
    Node(u32),
    /// The root of what was read from no file.
    Scene,
    /// The clip at this place in its file, from 1.
    Clip(u32),
    /// All animation of a file that names no clips.
    Animation,
    /// A mesh.
    Mesh,
    /// A skin.
    Skin,
    /// A morph.
    Morph,
    /// A material.
    Material,
    /// An image.
    Image,
    /// A light.
    Light,
    /// A camera.
    Camera,
    /// A part of the two-rod arm or of a muscle.
    Part(BodyPart),
    /// The muscle at this place in its file, from 1.
    Muscle(u32),
}

impl<'a> Label<'a> {
    /// The name, or `otherwise` where it is empty.
    pub fn of(name: &'a str, otherwise: Unnamed) -> Self {
        if name.is_empty() { Self::Unnamed(otherwise) } else { Self::Name(name) }
    }

    /// The same apart from what it belongs to.
    pub fn to_owned(self) -> OwnedLabel {
        match self {
            Self::Name(name) => OwnedLabel::Name(name.to_owned()),
            Self::Unnamed(unnamed) => OwnedLabel::Unnamed(unnamed),
        }
    }

    /// Whether this is what a text means.
    pub fn is(self, text: &str) -> bool {
        match self {
            Self::Name(name) => name == text,
            Self::Unnamed(unnamed) => Unnamed::parse(text) == Some(unnamed),
        }
    }

    /// The text in files that are written: the same in every language.
    pub fn plain(self) -> Cow<'a, str> {
        match self {
            Self::Name(name) => Cow::Borrowed(name),
            Self::Unnamed(unnamed) => unnamed.plain(),
        }
    }
}

impl OwnedLabel {
    /// The same as a view.
    pub fn as_label(&self) -> Label<'_> {
        match self {
            Self::Name(name) => Label::Name(name),
            Self::Unnamed(unnamed) => Label::Unnamed(*unnamed),
        }
    }

    /// Whether there is nothing to say.
    pub fn is_empty(&self) -> bool {
        matches!(self, Self::Name(name) if name.is_empty())
    }
}

impl<T: Into<String>> From<T> for OwnedLabel {
    fn from(name: T) -> Self {
        Self::Name(name.into())
    }
}

/// The text in files that are written: the same in every language.
impl fmt::Display for OwnedLabel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.as_label().plain())
    }
}

impl serde::Serialize for OwnedLabel {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl BodyPart {
    /// All of them.
    pub const ALL: [Self; 7] = [Self::UpperArm, Self::Shoulder, Self::Elbow, Self::Forearm, Self::Wrist, Self::Bone, Self::Tendon];

    /// The id of nodes, meshes and materials that are this part. Those of files that are read have their id for a name where they have no other, so that
    /// only this program's own have an id alone.
    pub const fn id(self) -> &'static str {
        match self {
            Self::UpperArm => "upper arm",
            Self::Shoulder => "shoulder",
            Self::Elbow => "elbow",
            Self::Forearm => "forearm",
            Self::Wrist => "wrist",
            Self::Bone => "bone",
            Self::Tendon => "tendon",
        }
    }

    /// What it is called in English and in the other languages of the program.
    fn names(self) -> [&'static str; 2] {
        match self {
            Self::UpperArm => ["Upper arm", "Плечо"],
            Self::Shoulder => ["Shoulder", "Плечевой сустав"],
            Self::Elbow => ["Elbow", "Локоть"],
            Self::Forearm => ["Forearm", "Предплечье"],
            Self::Wrist => ["Wrist", "Запястье"],
            Self::Bone => ["Bone", "Кость"],
            Self::Tendon => ["Tendon", "Сухожилие"],
        }
    }
}

impl From<Label<'_>> for Value {
    fn from(label: Label<'_>) -> Self {
        match label {
            Label::Name(name) => Self::from(name),
            Label::Unnamed(unnamed) => Self::from(unnamed.message()),
        }
    }
}

impl Unnamed {
    /// What stands before the number of a node, in English and in the other languages of the program.
    const NODE: [&str; 2] = ["Node ", "Узел "];
    /// The same of a clip.
    const CLIP: [&str; 2] = ["Clip ", "Клип "];
    /// The same of a muscle.
    const MUSCLE: [&str; 2] = ["Muscle ", "Мышца "];
    /// The same in ids.
    const MUSCLE_ID: &str = "muscle ";
    /// The root of what was read from no file.
    const SCENE: [&str; 2] = ["Scene", "Сцена"];
    /// All animation of a file.
    const ANIMATION: [&str; 2] = ["Animation", "Анимация"];

    /// What something with this id is called that has no name, `otherwise` unless it is a part of the arm or of a muscle.
    pub(super) fn of_id(id: &str, otherwise: Self) -> Self {
        let part = || BodyPart::ALL.into_iter().find(|part| part.id() == id).map(Self::Part);
        let muscle = || Some(Self::Muscle(id.strip_prefix(Self::MUSCLE_ID)?.parse().ok()?));
        part().or_else(muscle).unwrap_or(otherwise)
    }

    /// The id of what belongs to the muscle at this place in its file, from 1.
    pub fn muscle_id(number: u32) -> String {
        format!("{}{number}", Self::MUSCLE_ID)
    }

    /// What it is called in files that are written: the same in every language.
    pub fn plain(self) -> Cow<'static, str> {
        let ([node, ..], [clip, ..], [animation, ..], [muscle, ..]) = (Self::NODE, Self::CLIP, Self::ANIMATION, Self::MUSCLE);
        Cow::Borrowed(match self {
            Self::Node(number) => return format!("{node}{number}").into(),
            Self::Clip(number) => return format!("{clip}{number}").into(),
            Self::Scene => Self::SCENE[0],
            Self::Animation => animation,
            Self::Mesh => "Mesh",
            Self::Skin => "Skin",
            Self::Morph => "Morph",
            Self::Material => "Material",
            Self::Image => "Image",
            Self::Light => "Light",
            Self::Camera => "Camera",
            Self::Part(part) => part.names()[0],
            Self::Muscle(number) => return format!("{muscle}{number}").into(),
        })
    }

    /// The node, part of a body, muscle or clip that a text means. People type what they see, and older files hold it, in whatever language the program had.
    pub fn parse(text: &str) -> Option<Self> {
        if Self::ANIMATION.contains(&text) {
            return Some(Self::Animation);
        }
        if Self::SCENE.contains(&text) {
            return Some(Self::Scene);
        }
        if let Some(part) = BodyPart::ALL.into_iter().find(|part| part.names().contains(&text)) {
            return Some(Self::Part(part));
        }
        let number = |before: [&str; 2]| {
            let digits = before.iter().find_map(|before| text.strip_prefix(before))?;
            // As it is written: no sign, no zeros before it.
            digits.parse::<u32>().ok().filter(|number| number.to_string() == digits)
        };
        let clip = || number(Self::CLIP).map(Self::Clip);
        number(Self::NODE).map(Self::Node).or_else(clip).or_else(|| number(Self::MUSCLE).map(Self::Muscle))
    }
}

impl ToMessage for Unnamed {
    fn message(&self) -> Message {
        match self {
            Self::Node(number) => message!("document-unnamed-node", number = number),
            Self::Scene => message!("document-unnamed-scene"),
            Self::Clip(number) => message!("document-unnamed-clip", number = number),
            Self::Animation => message!("document-unnamed-animation"),
            Self::Mesh => message!("document-unnamed-mesh"),
            Self::Skin => message!("document-unnamed-skin"),
            Self::Morph => message!("document-unnamed-morph"),
            Self::Material => message!("document-unnamed-material"),
            Self::Image => message!("document-unnamed-image"),
            Self::Light => message!("document-unnamed-light"),
            Self::Camera => message!("document-unnamed-camera"),
            Self::Muscle(number) => message!("muscle-name", number = number),
            Self::Part(BodyPart::UpperArm) => message!("muscle-upper-arm"),
            Self::Part(BodyPart::Shoulder) => message!("muscle-shoulder"),
            Self::Part(BodyPart::Elbow) => message!("muscle-elbow"),
            Self::Part(BodyPart::Forearm) => message!("muscle-forearm"),
            Self::Part(BodyPart::Wrist) => message!("muscle-wrist"),
            Self::Part(BodyPart::Bone) => message!("muscle-material-bone"),
            Self::Part(BodyPart::Tendon) => message!("muscle-material-tendon"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_and_clips_are_known_by_what_they_are_called() {
        for unnamed in [Unnamed::Scene, Unnamed::Node(12), Unnamed::Clip(3), Unnamed::Muscle(2), Unnamed::Animation] {
            assert_eq!(Unnamed::parse(&unnamed.plain()), Some(unnamed));
        }
        for text in ["Clip", "Clip x", "Clip -1", "Clip +1", "Clip 012", "Клип 12 и ещё", "", "Clip 99999999999", "Mesh"] {
            assert_eq!(Unnamed::parse(text), None, "{text}");
        }
        for part in BodyPart::ALL {
            assert_eq!(Unnamed::of_id(part.id(), Unnamed::Mesh), Unnamed::Part(part));
            assert_eq!(Unnamed::parse(&Unnamed::Part(part).plain()), Some(Unnamed::Part(part)));
        }
        assert_eq!(Label::of("arm", Unnamed::Mesh).plain(), "arm");
        assert_eq!(Label::of("", Unnamed::Mesh).plain(), "Mesh");
    }
}

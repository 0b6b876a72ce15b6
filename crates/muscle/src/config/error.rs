//! Why a muscle file cannot be used, and where.

use super::full_format::{ARM_BONES, WITH_BONES};
use super::yaml::Step;
use crate::edit::{MOTION_POINTS, VIA, WRAPS};
use crate::pennation;
use crate::profile::ProfileError;
use sinew_scene::limits;
use sinew_scene::message;
use sinew_scene::message::{Message, ToMessage, shortened};
use sinew_yaml::{ValueKind, YamlError, YamlErrorKind};

/// Why a YAML file could not be used, and where.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{}", self.message())]
pub struct ConfigError {
    /// Line from 1.
    pub line: Option<u32>,
    /// Column from 1.
    pub column: Option<u32>,
    /// What is wrong.
    pub kind: ConfigErrorKind,
}

/// What is wrong with the value at a path of the YAML tree.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct DecodeError {
    /// Where in the tree.
    pub path: Vec<Step>,
    /// What is wrong.
    pub kind: ConfigErrorKind,
}

/// What errors call a value: its key, and its numbers in the lists below that key.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ValueName {
    /// The key; `None` for the file as a whole.
    pub key: Option<&'static str>,
    /// From 1.
    pub items: Vec<usize>,
}

/// What a value should be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WantedKind {
    /// A number.
    Number,
    /// Text.
    Text,
    /// A list.
    List,
    /// A mapping.
    Map,
}

/// What is wrong with a muscle file. Texts from the file are as they stand there.
#[derive(Debug, Clone, PartialEq)]
pub enum ConfigErrorKind {
    /// The text is no YAML that can be read.
    Yaml(YamlErrorKind),
    /// Nothing stands in it.
    Empty,
    /// A value of another kind than belongs there.
    WrongType {
        /// What the value is called.
        name: ValueName,
        /// What belongs there.
        wanted: WantedKind,
        /// What there is.
        found: ValueKind,
    },
    /// A number that is infinite or none.
    NotFinite(ValueName),
    /// A number in quotes, or with a comma for a point.
    NumberAsText {
        /// What the value is called.
        name: ValueName,
        /// The text.
        text: String,
    },
    /// A number below zero.
    Negative {
        /// What the value is called.
        name: ValueName,
        /// The number.
        value: f64,
    },
    /// A number that is not above zero.
    NotPositive {
        /// What the value is called.
        name: ValueName,
        /// The number.
        value: f64,
    },
    /// A list with another number of items than it should have.
    WrongCount {
        /// What the list is called.
        name: ValueName,
        /// How many it should have.
        wanted: usize,
        /// How many it has.
        found: usize,
    },
    /// A key of this mapping is no text.
    KeyNotText(ValueName),
    /// A key that has no meaning there.
    UnknownKey {
        /// The key.
        key: String,
        /// The known key that it is probably meant to be.
        near: Option<&'static str>,
        /// All keys that have a meaning there.
        known: &'static [&'static str],
    },
    /// A key that stands twice in one mapping.
    RepeatedKey(String),
    /// A key that must be there and is not.
    MissingKey {
        /// The key.
        key: &'static str,
        /// The mapping that it is missing in.
        name: ValueName,
    },
    /// Radii, growth, length or poses that make no muscle.
    Profile(ProfileError),
    /// The short format has another number of rods than two.
    NotTwoRods(usize),
    /// A rod without a length.
    RodWithoutLength(ValueName),
    /// A rod on which the muscle is attached at the elbow itself.
    AttachedAtElbow(ValueName),
    /// Both an arm and a clip.
    ArmAndClip,
    /// Both an arm and a joint.
    ArmAndJoint,
    /// Both an arm and a scale.
    ArmAndScale,
    /// An empty list of muscles.
    NoMuscles,
    /// So many muscles, more than [`limits::MUSCLES`].
    TooManyMuscles(usize),
    /// The surfaces of the muscles have more vertices than [`limits::MUSCLE_VERTICES`] together.
    TooMuchSurface,
    /// A unit of length that is not known.
    UnknownUnit(String),
    /// A text for the scale that is not the one that it may be.
    BadScale,
    /// A number above what is possible.
    TooLarge {
        /// Of which value.
        name: ValueName,
        /// The largest that is possible, in the file's unit.
        most: f64,
    },
    /// A range of angles that is empty or goes beyond what is possible.
    BadRange {
        /// What the range is called.
        name: ValueName,
        /// The least that is possible, degrees.
        least: f64,
        /// The greatest that is possible, degrees.
        most: f64,
    },
    /// A direction of length zero.
    NoDirection(ValueName),
    /// Both poses, and radii or growth multipliers.
    PosesAndRadii,
    /// A muscle with one end.
    OneEnd(ValueName),
    /// This key in a muscle without ends.
    WithoutEnds(&'static str),
    /// So many via points, more than [`VIA`].
    TooManyViaPoints(usize),
    /// An empty list of poses.
    NoPoses,
    /// A pose with both or neither of an angle and a length.
    PosePlace,
    /// A bone that the arm has not.
    UnknownArmBone {
        /// Its name.
        bone: String,
        /// The bone that is probably meant.
        near: &'static str,
    },
    /// A text that is no colour.
    BadColor(String),
    /// A pennation angle, degrees, that no muscle of a file may have.
    BadPennation(f64),
    /// Both the key `joint` and the key `joints`.
    JointAndJoints,
    /// No joint, or so many, more than [`limits::JOINTS`].
    JointCount(usize),
    /// Two joints of this name.
    RepeatedJoint(String),
    /// A joint that the file has not.
    UnknownJoint {
        /// Its name.
        joint: String,
        /// The joints that the file has.
        known: Vec<String>,
    },
    /// A via point with both a place and a motion.
    OffsetAndMoves,
    /// Angles of a motion that are too few, too many, not rising, or more than a turn.
    MotionAngles,
    /// Both the key `wrap` and the key `wraps`.
    WrapAndWraps,
    /// So many wrap surfaces, more than [`WRAPS`].
    TooManyWraps(usize),
    /// A shape that no wrap surface has.
    UnknownShape {
        /// The text.
        shape: String,
        /// The shape that it is probably meant to be.
        near: Option<&'static str>,
    },
    /// A key that a wrap surface of this shape does not have.
    NotOfShape {
        /// The key.
        key: &'static str,
        /// The shape.
        shape: &'static str,
    },
    /// A torus whose tube is as wide as the ring.
    TorusWithoutHole {
        /// From the centre to the middle of the tube.
        radius: f64,
        /// Radius of the tube.
        tube: f64,
    },
    /// A text that is no half axis.
    UnknownSide(String),
    /// A side of a cylinder along its axis.
    SideAlongCylinder,
    /// A part of the way that is none; the way's last point has this number.
    BadBetween {
        /// The number of the insertion.
        last: usize,
    },
}

impl ConfigError {
    /// An error at a line and a column, both from 1.
    pub(super) fn at(place: Option<(usize, usize)>, kind: ConfigErrorKind) -> Self {
        let number = |n: usize| u32::try_from(n).ok();
        Self { line: place.and_then(|(line, _)| number(line)), column: place.and_then(|(_, column)| number(column)), kind }
    }
}

impl From<YamlError> for ConfigError {
    fn from(error: YamlError) -> Self {
        Self {
            line: error.place.map(|place| place.line),
            column: error.place.map(|place| place.column),
            kind: ConfigErrorKind::Yaml(error.kind),
        }
    }
}

impl ToMessage for ConfigError {
    fn message(&self) -> Message {
        self.kind.message()
    }
}

impl ToMessage for ValueName {
    fn message(&self) -> Message {
        let key = self.key.map_or_else(|| message!("muscle-yaml-the-file"), Message::verbatim);
        self.items.iter().fold(key, |name, number| message!("muscle-yaml-item", name = name, number = number))
    }
}

impl ToMessage for WantedKind {
    fn message(&self) -> Message {
        match self {
            Self::Number => message!("muscle-yaml-a-number"),
            Self::Text => message!("muscle-yaml-a-text"),
            Self::List => message!("muscle-yaml-a-list"),
            Self::Map => message!("muscle-yaml-a-map"),
        }
    }
}

impl ToMessage for ConfigErrorKind {
    fn message(&self) -> Message {
        match self {
            Self::Yaml(error) => error.message(),
            Self::Empty => message!("muscle-yaml-empty"),
            Self::WrongType { name, wanted, found } => {
                message!("muscle-yaml-wrong-type", name = name.message(), wanted = wanted.message(), found = found.message())
            }
            Self::NotFinite(name) => message!("muscle-yaml-not-finite", name = name.message()),
            Self::NumberAsText { name, text } => {
                let number = text.replace(',', ".").trim().to_owned();
                message!("muscle-yaml-number-as-text", name = name.message(), text = shortened(text), number = number)
            }
            Self::Negative { name, value } => message!("muscle-yaml-negative", name = name.message(), value = value),
            Self::NotPositive { name, value } => message!("muscle-yaml-not-positive", name = name.message(), value = value),
            Self::WrongCount { name, wanted, found } => {
                message!("muscle-yaml-wrong-count", name = name.message(), wanted = wanted, found = found)
            }
            Self::KeyNotText(name) => message!("muscle-yaml-key-not-text", name = name.message()),
            Self::UnknownKey { key, near: Some(near), known } => {
                message!("muscle-yaml-unknown-key-near", key = shortened(key), near = *near, known = known.join(", "))
            }
            Self::UnknownKey { key, near: None, known } => {
                message!("muscle-yaml-unknown-key", key = shortened(key), known = known.join(", "))
            }
            Self::RepeatedKey(key) => message!("muscle-yaml-repeated-key", key = shortened(key)),
            Self::MissingKey { key, name } => message!("muscle-yaml-missing-key", key = *key, name = name.message()),
            Self::Profile(error) => error.message(),
            Self::NotTwoRods(found) => message!("muscle-carcass-two-rods", found = found),
            Self::RodWithoutLength(name) => message!("muscle-rod-no-length", name = name.message()),
            Self::AttachedAtElbow(name) => message!("muscle-attached-at-elbow", name = name.message()),
            Self::ArmAndClip => message!("muscle-arm-and-clip"),
            Self::ArmAndJoint => message!("muscle-arm-and-joint"),
            Self::ArmAndScale => message!("muscle-arm-and-scale"),
            Self::NoMuscles => message!("muscle-no-muscles"),
            Self::TooManyMuscles(count) => message!("muscle-too-many-muscles", count = count, limit = limits::MUSCLES),
            Self::TooMuchSurface => message!("muscle-too-much-surface", limit = limits::MUSCLE_VERTICES),
            Self::UnknownUnit(unit) => message!("muscle-unknown-unit", unit = shortened(unit)),
            Self::BadScale => message!("muscle-bad-scale", known = WITH_BONES),
            Self::TooLarge { name, most } => message!("muscle-too-large", name = name.message(), most = most),
            Self::BadRange { name, least, most } => message!("muscle-bad-range", name = name.message(), least = least, most = most),
            Self::NoDirection(name) => message!("muscle-no-direction", name = name.message()),
            Self::PosesAndRadii => message!("muscle-poses-and-radii"),
            Self::OneEnd(name) => message!("muscle-one-end", name = name.message()),
            Self::WithoutEnds(key) => message!("muscle-no-ends", name = *key),
            Self::TooManyViaPoints(count) => message!("muscle-too-many-via", limit = VIA, count = count),
            Self::NoPoses => message!("muscle-no-poses"),
            Self::PosePlace => message!("muscle-pose-place"),
            Self::UnknownArmBone { bone, near } => {
                message!("muscle-unknown-arm-bone", bone = shortened(bone), near = *near, known = ARM_BONES.join(", "))
            }
            Self::BadColor(text) => message!("muscle-bad-color", text = shortened(text)),
            Self::BadPennation(value) => message!("muscle-bad-pennation", value = value, limit = pennation::LIMIT),
            Self::JointAndJoints => message!("muscle-joint-and-joints"),
            Self::JointCount(count) => message!("muscle-joint-count", limit = limits::JOINTS, count = count),
            Self::RepeatedJoint(joint) => message!("muscle-repeated-joint", joint = shortened(joint)),
            Self::UnknownJoint { joint, known } if known.is_empty() => message!("muscle-no-joint-of-name", joint = shortened(joint)),
            Self::UnknownJoint { joint, known } => {
                let known: Vec<String> = known.iter().map(|name| shortened(name)).collect();
                message!("muscle-unknown-joint", joint = shortened(joint), known = known.join(", "))
            }
            Self::OffsetAndMoves => message!("muscle-offset-and-moves"),
            Self::MotionAngles => message!("muscle-motion-angles", limit = MOTION_POINTS),
            Self::WrapAndWraps => message!("muscle-wrap-and-wraps"),
            Self::TooManyWraps(count) => message!("muscle-too-many-wraps", limit = WRAPS, count = count),
            Self::UnknownShape { shape, near: Some(near) } => message!("muscle-unknown-shape-near", shape = shortened(shape), near = *near),
            Self::UnknownShape { shape, near: None } => message!("muscle-unknown-shape", shape = shortened(shape)),
            Self::NotOfShape { key, shape } => message!("muscle-not-of-shape", key = *key, shape = *shape),
            Self::TorusWithoutHole { radius, tube } => message!("muscle-torus-no-hole", radius = radius, tube = tube),
            Self::UnknownSide(side) => message!("muscle-unknown-side", side = shortened(side)),
            Self::SideAlongCylinder => message!("muscle-side-along-cylinder"),
            Self::BadBetween { last } => message!("muscle-bad-between", last = last),
        }
    }
}

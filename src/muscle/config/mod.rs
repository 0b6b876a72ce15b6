//! Muscle files: what they say, how they are read, and how they are written.

mod decode;
mod report;
mod yaml;

use glam::DVec3;

use super::arm::Arm;
use super::profile::Profile;
use crate::{limits, tr};
use decode::{At, Complaint};

/// Which of the two forms a file is written in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Form {
    /// `muscle_config` and `carcass_config`: one muscle, millimetres.
    #[default]
    Report,
    /// The richer form.
    Rich,
}

/// What a YAML file describes: muscles, and the arm they are on if there is one.
#[derive(Debug, Clone, PartialEq)]
pub struct MuscleFile {
    /// Metres a unit of the file.
    pub unit_metres: f64,
    /// The form it was written in, which it is saved in again.
    pub form: Form,
    /// The two-rod arm.
    pub arm: Option<Arm>,
    /// The muscles.
    pub muscles: Vec<MuscleSpec>,
}

impl Default for MuscleFile {
    fn default() -> Self {
        Self { unit_metres: 0.001, form: Form::Report, arm: None, muscles: Vec::new() }
    }
}

/// A muscle as its file describes it.
#[derive(Debug, Clone, PartialEq)]
pub struct MuscleSpec {
    /// What a person calls it; empty where the file gives no name.
    pub name: String,
    /// Shape at rest.
    pub profile: Profile,
    /// Where it begins.
    pub origin: Option<Anchor>,
    /// Where it ends.
    pub insertion: Option<Anchor>,
    /// Tendons at the origin and at the insertion.
    pub tendons: [Tendon; 2],
}

impl MuscleSpec {
    /// A muscle of this shape, attached to nothing.
    pub fn new(profile: Profile) -> Self {
        Self { name: String::new(), profile, origin: None, insertion: None, tendons: [Tendon::default(); 2] }
    }
}

/// A point on a bone.
#[derive(Debug, Clone, PartialEq)]
pub struct Anchor {
    /// Id or name of the bone's node.
    pub bone: String,
    /// From the bone's node, along the bone's own axes, in the file's unit.
    pub offset: DVec3,
}

/// A tendon: it goes on from the muscle's end and does not change its length.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Tendon {
    /// Length; 0 = no tendon.
    pub length: f64,
    /// Radius.
    pub radius: f64,
}

/// Why a YAML file could not be used: one sentence that says where and what would be right.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{message}")]
pub struct ConfigError {
    /// Line from 1.
    pub line: Option<u32>,
    /// Column from 1.
    pub column: Option<u32>,
    /// The sentence, in the user's language, with the remedy.
    pub message: String,
}

impl ConfigError {
    fn at(place: Option<(usize, usize)>, message: String) -> Self {
        let number = |n: usize| u32::try_from(n).ok();
        Self { line: place.and_then(|(line, _)| number(line)), column: place.and_then(|(_, column)| number(column)), message }
    }
}

impl MuscleFile {
    /// Reads YAML: the report's form or the richer one.
    ///
    /// # Errors
    /// [`ConfigError`] with line, column and remedy.
    pub fn parse(text: &str) -> Result<Self, ConfigError> {
        if text.len() as u64 > limits::YAML_BYTES {
            return Err(ConfigError::at(None, tr!("muscle-yaml-too-large", limit = limits::YAML_BYTES >> 20)));
        }
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let tree = yaml::read(text)?;
        if tree == yaml::Yaml::Null {
            return Err(ConfigError::at(Some((1, 1)), tr!("muscle-yaml-empty")));
        }
        let root = At::root(&tree);
        report::decode(&root).map_err(|Complaint { path, message }| ConfigError::at(yaml::locate(text, &path), message))
    }
}

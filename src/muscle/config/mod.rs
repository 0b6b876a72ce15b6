//! Muscle files: what they say, how they are read, and how they are written.
//!
//! There are two forms. The **report's form** describes one muscle on a two-rod arm, in millimetres:
//!
//! ```yaml
#![doc = include_str!("../../../configs/biceps.yaml")]
//! ```
//!
//! `carcass_config.data` is `[[a, p], [d, b]]`: free end of the upper rod to the attachment, attachment to elbow; elbow to the attachment on the
//! forearm, attachment to its free end. Without `carcass_config` the muscle lies on its own. `len` is the length at which the radii are
//! those of `radiuses`: where it differs from `p + d`, the straight arm stretches or slackens the muscle.
//!
//! The **richer form** describes any number of muscles, on the arm or on the bones of any clip. All keys, with comments:
//!
//! ```yaml
#![doc = include_str!("../../../configs/example.yaml")]
//! ```
//!
//! `resources/muscle.schema.json` is the same as a JSON schema, for editors. Reading refuses what it does not know or cannot use, with line,
//! column and remedy. [`MuscleFile::to_yaml`] writes every value; [`MuscleFile::to_yaml_keeping`] changes only what differs in a text that is there
//! already, so that its comments stay.

mod decode;
mod full_format;
mod lossless_save;
mod short_format;
mod source_spans;
mod spec;
mod write;
mod yaml;

pub use lossless_save::Saved;
pub use spec::{Anchor, Form, JointSpec, MuscleFile, MuscleSpec, PoseAt, PoseSpec, Tendon, Wrap};

use crate::message::{Message, ToMessage};
use crate::tr;
use crate::yaml::{YamlError, YamlErrorKind};
use decode::{At, Complaint};

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

/// What is wrong with a muscle file.
#[derive(Debug, Clone, PartialEq)]
pub enum ConfigErrorKind {
    /// The text is no YAML that can be read.
    Yaml(YamlErrorKind),
    /// In words.
    Words(String),
}

impl ToMessage for ConfigError {
    fn message(&self) -> Message {
        self.kind.message()
    }
}

impl ToMessage for ConfigErrorKind {
    fn message(&self) -> Message {
        match self {
            Self::Yaml(error) => error.message(),
            Self::Words(words) => Message::verbatim(words),
        }
    }
}

impl ConfigError {
    fn at(place: Option<(usize, usize)>, message: String) -> Self {
        let number = |n: usize| u32::try_from(n).ok();
        Self {
            line: place.and_then(|(line, _)| number(line)),
            column: place.and_then(|(_, column)| number(column)),
            kind: ConfigErrorKind::Words(message),
        }
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

impl MuscleFile {
    /// Reads YAML: the report's form or the richer one.
    ///
    /// # Errors
    /// [`ConfigError`] with line, column and remedy.
    pub fn parse(text: &str) -> Result<Self, ConfigError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let tree = yaml::read(text)?;
        if tree == yaml::Yaml::Null {
            return Err(ConfigError::at(Some((1, 1)), tr!("muscle-yaml-empty")));
        }
        let root = At::root(&tree);
        let file = if full_format::KEYS.iter().any(|key| root.has(key)) { full_format::decode(&root) } else { short_format::decode(&root) };
        file.map_err(|Complaint { path, message }| ConfigError::at(yaml::locate(text, &path), message))
    }
}

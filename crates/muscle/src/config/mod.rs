//! Muscle files: what they say, how they are read, and how they are written.
//!
//! There are two forms. The **report's form** describes one muscle on a two-rod arm, in millimetres:
//!
//! ```yaml
#![doc = include_str!("../../presets/biceps.yaml")]
//! ```
//!
//! `carcass_config.data` is `[[a, p], [d, b]]`: free end of the upper rod to the attachment, attachment to elbow; elbow to the attachment on the
//! forearm, attachment to its free end. Without `carcass_config` the muscle lies on its own. `len` is the length at which the radii are
//! those of `radiuses`: where it differs from `p + d`, the straight arm stretches or slackens the muscle.
//!
//! The **richer form** describes any number of muscles, on the arm or on the bones of any clip. All keys, with comments:
//!
//! ```yaml
#![doc = include_str!("../../presets/example.yaml")]
//! ```
//!
//! `resources/muscle.schema.json` is the same as a JSON schema, for editors. Reading refuses what it does not know or cannot use, with line,
//! column and remedy. [`MuscleFile::to_yaml`] writes every value; [`MuscleFile::to_yaml_keeping`] changes only what differs in a text that is there
//! already, so that its comments stay.

mod decode;
mod error;
mod full_format;
mod lossless_save;
mod path;
mod short_format;
mod source_spans;
mod spec;
mod write;
mod yaml;

pub use error::{ConfigError, ConfigErrorKind, ValueName, WantedKind};
pub use lossless_save::SaveResult;
pub use spec::{
    ActiveRange, Anchor, Form, JointSpec, MuscleFile, MuscleSpec, PointMotion, PoseAt, PoseSpec, SkinSpec, Tendon, ViaPoint, Wrap,
    WrapRange, WrapShape,
};

use decode::At;
use error::DecodeError;

impl MuscleFile {
    /// Reads YAML: the report's form or the richer one.
    ///
    /// ```
    /// use sinew_muscle::MuscleFile;
    ///
    /// let file = MuscleFile::parse("muscle_config: {radiuses: [5, 18, 5], grow_mults: [0, 1, 0], len: 250}")?;
    /// assert_eq!(file.muscles[0].profile.rest_length(), 250.0);
    /// assert_eq!(MuscleFile::parse(&file.to_yaml())?, file);
    /// # Ok::<(), sinew_muscle::ConfigError>(())
    /// ```
    ///
    /// # Errors
    /// [`ConfigError`] with line, column and remedy.
    pub fn parse(text: &str) -> Result<Self, ConfigError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let tree = yaml::read(text)?;
        if tree == yaml::Yaml::Null {
            return Err(ConfigError::at(Some((1, 1)), ConfigErrorKind::Empty));
        }
        let root = At::root(&tree);
        let file = if full_format::KEYS.iter().any(|key| root.has(key)) { full_format::decode(&root) } else { short_format::decode(&root) };
        file.map_err(|DecodeError { path, kind }| ConfigError::at(yaml::locate(text, &path), kind))
    }
}

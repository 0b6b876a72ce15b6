//! Recovery file for unsaved muscles.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::save_error::{self, SaveError};
use crate::input;
use sinew_muscle::MuscleFile;
use sinew_scene::limits;
use sinew_yaml::YamlError;

/// Muscles that have not been saved, with the files they belong to.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RecoveryFile {
    /// Absolute paths of the open files; none = the built-in scene.
    pub files: Vec<PathBuf>,
    /// All muscle files, in the order of the scene, as YAML.
    pub muscles: Vec<String>,
}

impl RecoveryFile {
    /// The parsed muscle files; `None` where one of them is damaged, or together they exceed what can be drawn.
    pub fn muscle_files(&self) -> Option<Vec<MuscleFile>> {
        let files = self.muscles.iter().map(|text| MuscleFile::parse(text).ok()).collect::<Option<Vec<_>>>()?;
        MuscleFile::can_be_drawn(&files).then_some(files)
    }

    /// Reads a recovery file; `None` where it is missing or damaged.
    pub fn read(path: &Path) -> Option<Self> {
        let text = input::read_text(path, limits::RECOVERY_BYTES).ok()?;
        let whole = |unsaved: &Self| unsaved.files.len() <= limits::SESSION_FILES && unsaved.muscle_files().is_some();
        let mut unsaved = Self::parse(&text).ok().filter(whole)?;
        for file in &mut unsaved.files {
            *file = input::named_in(Path::new(""), file);
        }
        Some(unsaved)
    }

    /// Reads the text of such a file.
    ///
    /// # Errors
    /// [`YamlError`].
    pub fn parse(text: &str) -> Result<Self, YamlError> {
        sinew_yaml::from_text(text, limits::RECOVERY_BYTES)
    }

    /// As YAML.
    ///
    /// # Errors
    /// [`YamlError`]; names and texts can always be written, unless a path is no Unicode.
    pub fn to_yaml(&self) -> Result<String, YamlError> {
        sinew_yaml::to_text(self)
    }

    /// Writes the file.
    ///
    /// # Errors
    /// [`SaveError`]; the old file stays then.
    pub fn write(&self, path: &Path) -> Result<(), SaveError> {
        save_error::write(path, &self.to_yaml()?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_kept_comes_back_and_what_is_damaged_does_not() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("new").join("unsaved.yaml");
        let muscles = "muscles:\n  - {length: 9.0, radii: [1.0, 2.0], growth: [1.0, 1.0], name: \"a\\u202eb\"}\n".to_owned();
        let unsaved = RecoveryFile { files: vec!["/a/walk.dae".into(), "-".into()], muscles: vec![muscles] };
        unsaved.write(&path).expect("written");
        let read = RecoveryFile::read(&path).expect("read");
        assert_eq!((&read.files[0], read.files[1].as_os_str()), (&unsaved.files[0], "./-".as_ref()));
        assert_eq!(read.muscles, unsaved.muscles);
        for text in ["files: []\nmuscles: [\"x\"]", "files: [", "", "muscles: []"] {
            std::fs::write(&path, text).expect("written");
            assert_eq!(RecoveryFile::read(&path), None, "{text:?}");
        }
        let many = RecoveryFile { files: vec!["a.dae".into(); limits::SESSION_FILES + 1], muscles: Vec::new() };
        many.write(&path).expect("written");
        assert_eq!(RecoveryFile::read(&path), None);
    }
}

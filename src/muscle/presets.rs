//! Ready muscles, reachable by name: the report's two, and three in human proportions.

use super::config::MuscleFile;
use crate::tr;

/// A ready muscle file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Preset {
    /// What a command or a setting calls it; never translated.
    pub id: &'static str,
    /// The file, one of `configs/`, comments and all.
    pub yaml: &'static str,
}

/// All presets, in the order in which a menu shows them.
pub const PRESETS: [Preset; 5] = [
    Preset { id: "report", yaml: include_str!("../../configs/biceps.yaml") },
    Preset { id: "measured", yaml: include_str!("../../configs/biceps-measured.yaml") },
    Preset { id: "biceps", yaml: include_str!("../../configs/biceps-human-wrapped.yaml") },
    Preset { id: "triceps", yaml: include_str!("../../configs/triceps-human.yaml") },
    Preset { id: "brachialis", yaml: include_str!("../../configs/brachialis-human.yaml") },
];

impl Preset {
    /// The preset with this id.
    pub fn by_id(id: &str) -> Option<Self> {
        PRESETS.into_iter().find(|preset| preset.id == id)
    }

    /// Its name in the user's language.
    pub fn name(&self) -> String {
        match self.id {
            "report" => tr!("muscle-preset-report"),
            "measured" => tr!("muscle-preset-measured"),
            "biceps" => tr!("muscle-preset-biceps"),
            "triceps" => tr!("muscle-preset-triceps"),
            _ => tr!("muscle-preset-brachialis"),
        }
    }

    /// What its muscle is called in the user's language.
    pub fn muscle_name(&self) -> String {
        match self.id {
            "triceps" => tr!("muscle-called-triceps"),
            "brachialis" => tr!("muscle-called-brachialis"),
            _ => tr!("muscle-called-biceps"),
        }
    }

    /// What it describes. A test reads every preset, so the empty file is never seen.
    pub fn file(&self) -> MuscleFile {
        MuscleFile::parse(self.yaml).unwrap_or_default()
    }
}

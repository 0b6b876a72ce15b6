//! Ready muscles, reachable by name: the report's two, and three in human proportions.

use super::config::MuscleFile;
use sinew_scene::message;
use sinew_scene::message::Message;

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
    Preset { id: "report", yaml: include_str!("../presets/biceps.yaml") },
    Preset { id: "measured", yaml: include_str!("../presets/biceps-measured.yaml") },
    Preset { id: "biceps", yaml: include_str!("../presets/biceps-human-wrapped.yaml") },
    Preset { id: "triceps", yaml: include_str!("../presets/triceps-human.yaml") },
    Preset { id: "brachialis", yaml: include_str!("../presets/brachialis-human.yaml") },
];

impl Preset {
    /// The preset with this id.
    pub fn by_id(id: &str) -> Option<Self> {
        PRESETS.into_iter().find(|preset| preset.id == id)
    }

    /// What a menu calls it.
    pub fn name(&self) -> Message {
        match self.id {
            "report" => message!("muscle-preset-report"),
            "measured" => message!("muscle-preset-measured"),
            "biceps" => message!("muscle-preset-biceps"),
            "triceps" => message!("muscle-preset-triceps"),
            _ => message!("muscle-preset-brachialis"),
        }
    }

    /// What a new muscle made from it is called.
    pub fn muscle_name(&self) -> Message {
        match self.id {
            "triceps" => message!("muscle-called-triceps"),
            "brachialis" => message!("muscle-called-brachialis"),
            _ => message!("muscle-called-biceps"),
        }
    }

    /// What it describes. A test reads every preset, so the empty file is never seen.
    pub fn file(&self) -> MuscleFile {
        MuscleFile::parse(self.yaml).unwrap_or_default()
    }
}

//! Muscles: the volume-conserving profile, the arm that carries it, its surface, and the YAML that describes it.

use std::ops::RangeInclusive;
use std::sync::Arc;

use glam::{DMat4, Vec3};

use crate::animation::Pose;
use crate::scene::{MaterialBinding, Mesh, MuscleId, NodeId, Scene};

/// What a YAML file describes: muscles, and the arm they are on if there is one.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MuscleFile {
    /// Metres a unit of the file.
    pub unit_metres: f64,
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

/// The state that the two sliders share; each follows the other.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Drive {
    /// Elbow angle, degrees; 0 = straight arm.
    pub flexion: f64,
    /// Contraction, per cent of the way from the longest to the shortest length.
    pub contraction: f64,
}

/// One solved muscle at one moment: what the ledger, `measure` and the surface read. Lengths are in the file's unit.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Solved {
    /// Length after holding it within its limits.
    pub length: f64,
    /// Whether the length asked for was outside the limits.
    pub held: bool,
    /// Radius of each node.
    pub radii: Vec<f64>,
    /// The change of radius for a growth of 1.
    pub delta: f64,
    /// Coefficients A, B, C of the quadratic.
    pub quadratic: [f64; 3],
    /// B² − 4AC.
    pub discriminant: f64,
    /// Both roots; the first is the one taken.
    pub roots: [f64; 2],
    /// Volume.
    pub volume: f64,
    /// Volume over rest volume, minus 1.
    pub volume_error: f64,
}

/// A muscle file placed in a scene.
#[derive(Debug, Clone, Default)]
pub struct Rig {
    /// The root of its nodes; carries the unit.
    pub root: Option<NodeId>,
}

/// One row of a measurement. Lengths are in the file's unit, angles in degrees.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Sample {
    /// Elbow angle.
    pub angle: f64,
    /// −dL/dφ, with φ in radians.
    pub moment_arm: f64,
    /// The solution at that angle.
    pub solved: Solved,
}

impl MuscleFile {
    /// Reads YAML: the report's form or the richer one.
    ///
    /// # Errors
    /// [`ConfigError`] with line, column and remedy.
    pub fn parse(text: &str) -> Result<Self, ConfigError> {
        let _ = text;
        Ok(Self::default())
    }
}

impl Rig {
    /// Adds the file's nodes, rods and muscles to `scene`; its muscles get the ids from `first` on.
    pub fn build(file: &MuscleFile, name: &str, scene: &mut Scene, first: MuscleId) -> Self {
        let _ = (file, name, scene, first);
        Self::default()
    }

    /// Number of muscles.
    pub fn len(&self) -> usize {
        0
    }

    /// Whether there is no muscle.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Name of muscle `index`.
    pub fn name(&self, index: usize) -> &str {
        let _ = index;
        ""
    }

    /// The elbow angles that the arm allows, degrees; `None` without an arm.
    pub fn flexion_range(&self) -> Option<RangeInclusive<f64>> {
        None
    }

    /// The state with this elbow angle, held within the range.
    pub fn at_flexion(&self, degrees: f64) -> Drive {
        Drive { flexion: degrees, contraction: 0.0 }
    }

    /// The state with this contraction, 0 to 100.
    pub fn at_contraction(&self, per_cent: f64) -> Drive {
        Drive { flexion: 0.0, contraction: per_cent }
    }

    /// Turns the arm's nodes.
    pub fn apply(&self, drive: Drive, pose: &mut Pose) {
        let _ = (drive, pose);
    }

    /// Solves muscle `index` for the world that the pose made. `world` is one matrix a node of the scene.
    pub fn solve(&self, index: usize, drive: Drive, world: &[DMat4]) -> Solved {
        let _ = (index, drive, world);
        Solved::default()
    }

    /// Topology of muscle `index`'s surface: fixed while the number of its nodes is.
    pub fn mesh(&self, index: usize) -> Arc<Mesh> {
        let _ = index;
        Arc::default()
    }

    /// Materials of muscle `index`: one a part of its mesh, already in the scene.
    pub fn materials(&self, index: usize) -> &[Option<MaterialBinding>] {
        let _ = index;
        &[]
    }

    /// Writes the surface of muscle `index` into the buffers, in the world (metres): one entry a vertex of [`Rig::mesh`].
    pub fn deform(&self, index: usize, solved: &Solved, world: &[DMat4], positions: &mut Vec<Vec3>, normals: &mut Vec<Vec3>) {
        let _ = (index, solved, world, positions, normals);
    }

    /// Measures muscle `index` at elbow angles in degrees.
    pub fn measure(&self, index: usize, angles: &[f64]) -> Vec<Sample> {
        let _ = (index, angles);
        Vec::new()
    }
}

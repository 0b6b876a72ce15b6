//! Lights that a file brings along.

use glam::Vec3;

use super::{Label, Unnamed};

/// Kinds of light in COLLADA.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LightKind {
    /// From everywhere.
    Ambient,
    /// Along the node's −Z.
    Directional,
    /// From the node's origin.
    Point,
    /// From the node's origin along −Z.
    Spot {
        /// Full opening angle, degrees.
        falloff_angle: f32,
        /// Exponent of the fall-off.
        falloff_exponent: f32,
    },
}

/// A light of the file. It stands in the tree and the report; the picture is lit by the viewer's own light.
#[derive(Debug, Clone, PartialEq)]
pub struct Light {
    /// The name in its file; empty where it has none.
    pub name: String,
    /// The id in the file.
    pub id: String,
    /// Its kind.
    pub kind: LightKind,
    /// Its colour.
    pub color: Vec3,
    /// Constant, linear, quadratic attenuation.
    pub attenuation: Vec3,
}

impl Light {
    /// What it is called.
    pub fn label(&self) -> Label<'_> {
        Label::of(&self.name, Unnamed::Light)
    }
}

//! A pose: every value that animation can change, in flat lists.

use std::ops::Range;

use glam::{DMat4, Vec3};

use crate::{Graph, Material, Scene, TransformOp};

/// The animated state of a scene. Make it once, reset and fill it every frame: nothing is allocated after the first.
#[derive(Debug, Clone, Default)]
pub struct Pose {
    /// Transform operations of all nodes, one after the other.
    pub ops: Vec<TransformOp>,
    /// Each node's stretch of [`Pose::ops`].
    pub ranges: Vec<Range<u32>>,
    /// Weights of each morph.
    pub morph_weights: Vec<Vec<f32>>,
    /// Materials with their animated values.
    pub materials: Vec<Material>,
    /// Colours of the lights.
    pub light_colors: Vec<Vec3>,
    rest_ops: Vec<TransformOp>,
}

impl Pose {
    /// The rest pose of `scene`.
    pub fn rest(scene: &Scene) -> Self {
        let (rest_ops, ranges) = scene.graph.flat_ops();
        Self {
            ops: rest_ops.clone(),
            rest_ops,
            ranges,
            morph_weights: scene.morphs.iter().map(|morph| morph.weights.clone()).collect(),
            materials: scene.materials.clone(),
            light_colors: scene.lights.iter().map(|light| light.color).collect(),
        }
    }

    /// Back to the rest pose of the scene it was made from.
    pub fn reset(&mut self, scene: &Scene) {
        self.ops.copy_from_slice(&self.rest_ops);
        for (weights, morph) in self.morph_weights.iter_mut().zip(&scene.morphs) {
            weights.clone_from(&morph.weights);
        }
        for (material, rest) in self.materials.iter_mut().zip(&scene.materials) {
            material.copy_animated_from(rest);
        }
        for (color, light) in self.light_colors.iter_mut().zip(&scene.lights) {
            *color = light.color;
        }
    }

    /// Local matrix of each node.
    pub fn locals(&self, local: &mut Vec<DMat4>) {
        Graph::compose_flat(&self.ops, &self.ranges, local);
    }
}

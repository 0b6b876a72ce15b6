//! Clips: channels that move parts of the scene together.

use std::sync::Arc;

use glam::Vec3;

use super::{Curve, Pose};
use crate::{Label, LightId, MaterialId, MorphId, NodeId, TransformOp, Unnamed};

/// Which numbers of its target a curve sets.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Components {
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
    /// How much of the opacity's texture counts.
    OpacityTextureShare,
}

/// What a channel moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ChannelTarget {
    /// Operation `op` of a node's transform list.
    Transform {
        /// The node.
        node: NodeId,
        /// Index in its operations.
        op: u32,
        /// Which numbers.
        components: Components,
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
        components: Components,
    },
    /// The colour of a light.
    LightColor {
        /// The light.
        light: LightId,
        /// Which numbers of it.
        components: Components,
    },
}

/// A curve and what it moves.
#[derive(Debug, Clone)]
pub struct Channel {
    /// What it moves.
    pub target: ChannelTarget,
    /// The keys; clips may share them.
    pub curve: Arc<Curve>,
}

/// A named animation.
#[derive(Debug, Clone, Default)]
pub struct Clip {
    /// The name in its file; empty where it has none.
    pub name: String,
    /// The id that the file gives it; empty where it gives none.
    pub id: String,
    /// Its place among the clips of its file, from 1; `None` where it holds all animation of a file that has none.
    pub place: Option<u32>,
    /// First moment, seconds on the file's own time axis.
    pub start: f64,
    /// Last moment, seconds.
    pub end: f64,
    /// What moves.
    pub channels: Vec<Channel>,
}

impl Clip {
    /// What it is called.
    pub fn label(&self) -> Label<'_> {
        Label::of(&self.name, self.place.map_or(Unnamed::Animation, Unnamed::Clip))
    }

    /// Seconds from start to end.
    pub fn duration(&self) -> f64 {
        (self.end - self.start).max(0.0)
    }

    /// Number of keys, all channels together.
    pub fn keyframes(&self) -> usize {
        self.channels.iter().map(|channel| channel.curve.times.len()).sum()
    }

    /// Writes the values at `time` into `pose`, which holds the rest pose or an earlier clip's. Outside of the clip its ends hold.
    pub fn sample(&self, time: f64, pose: &mut Pose) {
        let time = if time.is_nan() { self.start } else { time.min(self.end).max(self.start) };
        for channel in &self.channels {
            channel.sample(time, pose);
        }
    }

    /// Times of the keys that move `node`, or of all keys, ascending, each once; those within the clip.
    pub fn key_times(&self, node: Option<NodeId>) -> Vec<f64> {
        let moves = |channel: &&Channel| match (node, channel.target) {
            (None, _) => true,
            (Some(wanted), ChannelTarget::Transform { node, .. }) => node == wanted,
            (Some(_), _) => false,
        };
        let mut times: Vec<f64> = self
            .channels
            .iter()
            .filter(moves)
            .flat_map(|channel| channel.curve.times.iter().copied())
            .filter(|time| (self.start..=self.end).contains(time))
            .collect();
        times.sort_unstable_by(f64::total_cmp);
        times.dedup();
        times
    }
}

impl Channel {
    /// Writes the value at `time`; a target that the pose doesn't have is left alone.
    fn sample(&self, time: f64, pose: &mut Pose) {
        match self.target {
            ChannelTarget::Transform { node, op, components } => {
                if let Some(op) = pose.ranges.get(node.index()).and_then(|range| range.clone().nth(op as usize))
                    && let Some(op) = pose.ops.get_mut(op as usize)
                {
                    set_op(op, components, &self.curve, time);
                }
            }
            ChannelTarget::MorphWeight { morph, target } => {
                if let Some(weight) = pose.morph_weights.get_mut(morph.index()).and_then(|weights| weights.get_mut(target as usize)) {
                    *weight = self.curve.value(time, 0) as f32;
                }
            }
            ChannelTarget::Material { material, slot, components } => {
                let Some(material) = pose.materials.get_mut(material.index()) else { return };
                match slot {
                    MaterialSlot::Diffuse => set_color(&mut material.diffuse.color, components, &self.curve, time),
                    MaterialSlot::Emission => set_color(&mut material.emission.color, components, &self.curve, time),
                    MaterialSlot::Ambient => set_color(&mut material.ambient.color, components, &self.curve, time),
                    MaterialSlot::Specular => set_color(&mut material.specular.color, components, &self.curve, time),
                    MaterialSlot::Shininess => material.shininess = self.curve.value(time, 0).clamp(0.0, 1000.0) as f32,
                    MaterialSlot::Opacity => material.opacity = self.curve.value(time, 0).clamp(0.0, 1.0) as f32,
                    MaterialSlot::OpacityTextureShare => {
                        material.opacity_texture_share = self.curve.value(time, 0).clamp(0.0, 1.0) as f32;
                    }
                }
            }
            ChannelTarget::LightColor { light, components } => {
                if let Some(color) = pose.light_colors.get_mut(light.index()) {
                    set_color(color, components, &self.curve, time);
                }
            }
        }
    }
}

/// Sets a whole operation, or one number of it.
fn set_op(op: &mut TransformOp, components: Components, curve: &Curve, time: f64) {
    match (op, components) {
        (TransformOp::Matrix(matrix), Components::Whole) => *matrix = curve.matrix(time),
        (TransformOp::Matrix(matrix), Components::Component(component)) => {
            // The bottom row stays 0 0 0 1, whatever the file animates it to.
            let (column, row) = (usize::from(component) / 4, usize::from(component) % 4);
            if column < 4 && row < 3 {
                matrix.col_mut(column).as_mut()[row] = curve.value(time, 0);
            }
            for column in 0..4 {
                matrix.col_mut(column).w = if column == 3 { 1.0 } else { 0.0 };
            }
        }
        (TransformOp::Translate(vector) | TransformOp::Scale(vector), components) => {
            set_numbers(&mut [vector.as_mut()], components, curve, time)
        }
        (TransformOp::Rotate { angle, .. }, Components::Component(3)) => *angle = curve.value(time, 0),
        (TransformOp::Rotate { axis, angle }, components) => {
            set_numbers(&mut [axis.as_mut(), std::slice::from_mut(angle)], components, curve, time)
        }
        (TransformOp::LookAt { eye, target, up }, components) => {
            set_numbers(&mut [eye.as_mut(), target.as_mut(), up.as_mut()], components, curve, time);
        }
        (TransformOp::Skew { angle, along, across }, components) => {
            set_numbers(&mut [std::slice::from_mut(angle), along.as_mut(), across.as_mut()], components, curve, time);
        }
    }
}

/// Sets all numbers of `parts`, which follow each other, or the one that `components` names.
fn set_numbers(parts: &mut [&mut [f64]], components: Components, curve: &Curve, time: f64) {
    let mut numbers = parts.iter_mut().flat_map(|part| part.iter_mut());
    match components {
        Components::Whole => {
            let mut values = [0.0; 16];
            curve.sample(time, &mut values);
            for (number, value) in numbers.zip(values.iter().take(curve.dimension)) {
                *number = *value;
            }
        }
        Components::Component(component) => {
            if let Some(number) = numbers.nth(usize::from(component)) {
                *number = curve.value(time, 0);
            }
        }
    }
}

fn set_color(color: &mut Vec3, components: Components, curve: &Curve, time: f64) {
    for (component, channel) in color.as_mut().iter_mut().enumerate() {
        match components {
            Components::Whole if component < curve.dimension => *channel = curve.value(time, component) as f32,
            Components::Component(wanted) if usize::from(wanted) == component => *channel = curve.value(time, 0) as f32,
            _ => {}
        }
    }
}

//! Animations: the document's clips, or the arm bent from straight to full where there is no clip.

use glam::{DMat4, DVec3};
use serde_json::{Value, json};

use super::buffer::{Buffer, ENTRY, Usage};
use super::keyframe_reduction::{KeyTime, Tolerance, moments, numbers, track};
use super::spline::Spline;
use super::trs::Placing;
use super::unsupported_features::UnsupportedFeature;
use sinew_engine::document::{Document, PoseState};
use sinew_scene::animation::{Channel, ChannelTarget, Clip, Curve, Interpolation, Pose};
use sinew_scene::{MorphId, NodeId, TransformOp, compose};

/// Names of the animations that files have for muscles without a clip; they do not depend on the language of the user.
const BEND_NAME: &str = "Elbow angle";
const CONTRACT_NAME: &str = "Contraction";

/// Seconds that the arm takes to bend.
const BEND_SECONDS: f64 = 2.0;
/// Keys that a bend is looked at first.
const BEND_KEYS: usize = 9;

/// A stretch of time to write.
#[derive(Debug, Clone)]
pub(super) struct AnimationRange {
    pub name: String,
    /// First and last moment, seconds on its own axis.
    pub span: (f64, f64),
    /// What is added to times where they are written: the format knows none below zero.
    pub shift: f64,
    kind: AnimationSource,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum AnimationSource {
    /// A clip of the document.
    Clip(usize),
    /// The elbow from one angle to another, degrees.
    Bend([f64; 2]),
    /// The contraction from 0 to 100 %, for a muscle on its own.
    Contract,
}

impl AnimationRange {
    /// All that a document can play.
    pub(super) fn all(document: &Document) -> Vec<Self> {
        if document.clips.is_empty() {
            let Some(rig) = document.driven_rig() else { return Vec::new() };
            let (name, kind) = match rig.flexion_range() {
                Some(range) => (BEND_NAME.to_owned(), AnimationSource::Bend([*range.start(), *range.end()])),
                None => (CONTRACT_NAME.to_owned(), AnimationSource::Contract),
            };
            return vec![Self { name, span: (0.0, BEND_SECONDS), shift: 0.0, kind }];
        }
        let range = |(number, clip): (usize, &Clip)| Self {
            name: clip.label().plain().into_owned(),
            span: (clip.start, clip.end.max(clip.start)),
            shift: if clip.start < 0.0 { -clip.start } else { 0.0 },
            kind: AnimationSource::Clip(number),
        };
        document.clips.iter().enumerate().map(range).collect()
    }

    /// The state of the document at a moment of it.
    pub(super) fn state(&self, document: &Document, at: f64) -> PoseState {
        let start = document.start_state();
        let part = ((at - self.span.0) / (self.span.1 - self.span.0)).clamp(0.0, 1.0);
        let drive = |make: fn(&sinew_muscle::MuscleRig, f64) -> sinew_muscle::MuscleState, value: f64| {
            document.driven_rig().map_or(start.joints.drive, |rig| make(rig, value))
        };
        match self.kind {
            AnimationSource::Clip(clip) => PoseState { clip: Some(clip), time: at, ..start },
            AnimationSource::Bend([from, to]) => start.with_drive(drive(sinew_muscle::MuscleRig::at_flexion, from + (to - from) * part)),
            AnimationSource::Contract => start.with_drive(drive(sinew_muscle::MuscleRig::at_contraction, 100.0 * part)),
        }
    }

    /// Moments that any key of it stands at.
    pub(super) fn moments(&self, document: &Document) -> Vec<KeyTime> {
        match self.kind {
            AnimationSource::Clip(clip) => document.clips.get(clip).map_or_else(Vec::new, |clip| {
                let channels: Vec<&Channel> = clip.channels.iter().collect();
                moments(&within(clip.key_times(None), self.span), &jumps(&channels), self.shift)
            }),
            AnimationSource::Bend(_) | AnimationSource::Contract => moments(&self.even(), &[], self.shift),
        }
    }

    fn even(&self) -> Vec<f64> {
        let step = (self.span.1 - self.span.0) / (BEND_KEYS - 1) as f64;
        (0..BEND_KEYS).map(|key| self.span.0 + step * key as f64).collect()
    }
}

/// The times, with the ends of the span.
fn within(mut times: Vec<f64>, (from, to): (f64, f64)) -> Vec<f64> {
    times.retain(|time| *time > from && *time < to);
    times.insert(0, from);
    if to > from {
        times.push(to);
    }
    times
}

/// An animation as it is written.
#[derive(Debug, Default)]
pub(super) struct Animation {
    samplers: Vec<Value>,
    channels: Vec<Value>,
}

impl Animation {
    /// Adds a sampler with its channel.
    pub(super) fn add(&mut self, node: usize, path: &str, input: usize, output: usize, interpolation: &str) {
        self.samplers.push(json!({"input": input, "output": output, "interpolation": interpolation}));
        self.channels.push(json!({"sampler": self.samplers.len() - 1, "target": {"node": node, "path": path}}));
    }

    /// The whole; `None` where nothing moves.
    pub(super) fn value(self, range: &AnimationRange) -> Option<Value> {
        if self.channels.is_empty() {
            return None;
        }
        let mut value = json!({"name": range.name, "samplers": self.samplers, "channels": self.channels});
        if range.shift != 0.0 {
            value["extras"] = json!({"timeShift": range.shift});
        }
        Some(value)
    }

    fn write_track(&mut self, node: usize, keys: &[(f32, Placing)], rest: &Placing, stepped: bool, buffer: &mut Buffer) {
        let mode = if stepped { "STEP" } else { "LINEAR" };
        let times: Vec<f32> = keys.iter().map(|(time, _)| *time).collect();
        let mut input = None;
        let mut add = |path: &str, differs: bool, output: &mut dyn FnMut(&mut Buffer) -> usize, buffer: &mut Buffer| {
            if differs {
                let input = *input.get_or_insert_with(|| buffer.scalars(&times, true));
                let output = output(buffer);
                self.add(node, path, input, output, mode);
            }
        };
        let moved = |pick: fn(&Placing) -> DVec3| keys.iter().any(|(_, key)| (pick(key) - pick(rest)).abs().max_element() > 0.0);
        let vectors =
            |pick: fn(&Placing) -> DVec3| -> Vec<[f32; 3]> { keys.iter().map(|(_, key)| pick(key).as_vec3().to_array()).collect() };
        let (translations, scales) = (vectors(|key| key.translation), vectors(|key| key.scale));
        let rotations: Vec<[f32; 4]> = keys.iter().map(|(_, key)| key.rotation.normalize().as_quat().normalize().to_array()).collect();
        let turned = keys.iter().any(|(_, key)| key.rotation.dot(rest.rotation).abs() < 1.0 - 1e-14);
        add("translation", moved(|key| key.translation), &mut |buffer| buffer.floats(Usage::Other, &translations, false), buffer);
        add("rotation", turned, &mut |buffer| buffer.floats(Usage::Other, &rotations, false), buffer);
        // The last digits of a scale come from taking a matrix apart and mean nothing.
        let scaled = keys.iter().any(|(_, key)| (key.scale - rest.scale).abs().max_element() > 1e-7 * rest.scale.abs().max_element());
        add("scale", scaled, &mut |buffer| buffer.floats(Usage::Other, &scales, false), buffer);
    }
}

/// What moving nodes are written with.
pub(super) struct Stage<'a> {
    pub document: &'a Document,
    /// The node in the file for each node of the scene, and how it rests; `None` where it rests as two nodes or a matrix.
    pub nodes: &'a [(usize, Placing)],
    /// Largest deviation, metres.
    pub length: f64,
    /// World scale of each node's parent at rest, so that the tolerance means the same everywhere.
    pub scales: &'a [f64],
}

impl Stage<'_> {
    fn tolerance(&self, node: NodeId) -> Tolerance {
        let scale = self.scales.get(node.index()).copied().unwrap_or(1.0);
        Tolerance { length: if scale > 0.0 { self.length / scale } else { f64::INFINITY } }
    }

    /// Writes the moving nodes of a take.
    /// `pose` rests; each node of it that is moved is put back before it is moved again.
    pub(super) fn write(
        &self,
        range: &AnimationRange,
        pose: &mut Pose,
        animation: &mut Animation,
        buffer: &mut Buffer,
        unsupported: &mut Vec<UnsupportedFeature>,
    ) {
        match range.kind {
            AnimationSource::Clip(number) => {
                if let Some(clip) = self.document.clips.get(number) {
                    self.write_clip(range, clip, pose, animation, buffer, unsupported);
                }
            }
            AnimationSource::Bend(_) | AnimationSource::Contract => self.write_bend(range, animation, buffer),
        }
    }

    fn write_bend(&self, range: &AnimationRange, animation: &mut Animation, buffer: &mut Buffer) {
        let Some(rig) = self.document.driven_rig() else { return };
        let mut pose = Pose::rest(&self.document.scene);
        let mut at = |time: f64, node: NodeId| {
            rig.apply(range.state(self.document, time).joints.drive, &mut pose);
            local(&pose, node)
        };
        for (id, _) in self.document.scene.graph.iter() {
            let Some((written, rest)) = self.nodes.get(id.index()) else { continue };
            let keys = track(&moments(&range.even(), &[], range.shift), self.tolerance(id), &mut |time| Placing::of(&at(time, id)).0);
            animation.write_track(*written, &keys, rest, false, buffer);
        }
    }

    fn write_clip(
        &self,
        range: &AnimationRange,
        clip: &Clip,
        pose: &mut Pose,
        animation: &mut Animation,
        buffer: &mut Buffer,
        unsupported: &mut Vec<UnsupportedFeature>,
    ) {
        let mut by_node: Vec<(NodeId, Vec<&Channel>)> = Vec::new();
        let mut at_node = rustc_hash::FxHashMap::default();
        let mut colours = false;
        for channel in &clip.channels {
            match channel.target {
                ChannelTarget::Transform { node, .. } => {
                    let place = *at_node.entry(node).or_insert_with(|| {
                        by_node.push((node, Vec::new()));
                        by_node.len() - 1
                    });
                    by_node[place].1.push(channel);
                }
                ChannelTarget::MorphWeight { .. } => {}
                ChannelTarget::Material { .. } | ChannelTarget::LightColor { .. } => colours = true,
            }
        }
        if colours {
            unsupported.push(UnsupportedFeature::Colours { clip: clip.label().plain().into_owned() });
        }
        if range.shift != 0.0 {
            unsupported.push(UnsupportedFeature::Moved {
                clip: clip.label().plain().into_owned(),
                milliseconds: (range.shift * 1000.0).round() as i64,
            });
        }
        for (node, channels) in by_node {
            let keys: usize = channels.iter().map(|channel| channel.curve.times.len()).sum();
            buffer.spend(6 * ENTRY + keys * size_of::<(f32, Placing)>());
            if buffer.is_full() {
                return;
            }
            self.reset_pose(pose, node);
            self.write_node(range, node, &channels, pose, animation, buffer, unsupported);
        }
    }

    fn reset_pose(&self, pose: &mut Pose, node: NodeId) {
        let Some(range) = pose.ranges.get(node.index()).cloned() else { return };
        if let Some(ops) = pose.ops.get_mut(range.start as usize..range.end as usize) {
            ops.iter_mut().zip(&self.document.scene.graph.node(node).transform.ops).for_each(|(op, rest)| *op = *rest);
        }
    }

    #[allow(clippy::too_many_arguments, reason = "what is written and the tables that it goes into, each borrowed for itself")]
    fn write_node(
        &self,
        range: &AnimationRange,
        node: NodeId,
        channels: &[&Channel],
        pose: &mut Pose,
        animation: &mut Animation,
        buffer: &mut Buffer,
        unsupported: &mut Vec<UnsupportedFeature>,
    ) {
        let Some((written, rest)) = self.nodes.get(node.index()) else { return };
        if let Some(spline) = Spline::of_node(range, node, channels, pose) {
            let input = buffer.scalars(&spline.times, true);
            let output = buffer.floats(Usage::Other, spline.rows.as_chunks::<3>().0, false);
            animation.add(*written, spline.path, input, output, "CUBICSPLINE");
            return;
        }
        let clip = Clip {
            start: range.span.0,
            end: range.span.1,
            channels: channels.iter().map(|channel| (*channel).clone()).collect(),
            ..Clip::default()
        };
        let stepped = channels.iter().all(|channel| all_steps(&channel.curve));
        let (times, jumps) = (within(clip.key_times(None), range.span), if stepped { Vec::new() } else { jumps(channels) });
        let mut sheared = false;
        let mut at = |time: f64| {
            clip.sample(time, pose);
            let (placing, shear) = Placing::of(&local(pose, node));
            sheared |= shear;
            placing
        };
        let when = moments(&times, &jumps, range.shift);
        let keys = if stepped {
            when.iter().map(|moment| (moment.written, at(moment.at))).collect()
        } else {
            track(&when, self.tolerance(node), &mut at)
        };
        if sheared {
            unsupported.push(UnsupportedFeature::Shear { node: self.document.scene.graph.label(node).plain().into_owned() });
        }
        animation.write_track(*written, &keys, rest, stepped, buffer);
    }
}

pub(super) fn ops(pose: &Pose, node: NodeId) -> &[TransformOp] {
    pose.ranges.get(node.index()).and_then(|range| pose.ops.get(range.start as usize..range.end as usize)).unwrap_or(&[])
}

pub(super) fn local(pose: &Pose, node: NodeId) -> DMat4 {
    compose(ops(pose, node))
}

fn all_steps(curve: &Curve) -> bool {
    let last = curve.modes.len().saturating_sub(1);
    last > 0 && curve.modes.iter().take(last).all(|mode| *mode == Interpolation::Step)
}

/// Where a value leaps: at the end of a step, and where two keys have one time.
fn jumps(channels: &[&Channel]) -> Vec<f64> {
    let of = |curve: &Curve| -> Vec<f64> {
        let pairs = curve.times.iter().zip(curve.times.iter().skip(1)).zip(&curve.modes);
        pairs.filter(|((from, to), mode)| **mode == Interpolation::Step || from == to).map(|((_, to), _)| *to).collect()
    };
    let mut found: Vec<f64> = channels.iter().flat_map(|channel| of(&channel.curve)).collect();
    found.sort_unstable_by(f64::total_cmp);
    found.dedup();
    found
}

/// Weights of morphs over a take: how many targets of each morph go before it on the mesh, and where.
pub(super) struct Weights<'a> {
    pub node: usize,
    /// The morphs of the mesh, in order.
    pub morphs: &'a [MorphId],
}

impl Weights<'_> {
    /// Writes the weights where the take moves any of them.
    pub(super) fn write(&self, document: &Document, take: &AnimationRange, animation: &mut Animation, buffer: &mut Buffer) {
        let AnimationSource::Clip(number) = take.kind else { return };
        let Some(clip) = document.clips.get(number) else { return };
        // All channels are looked through for each mesh that morphs.
        buffer.spend(size_of_val(clip.channels.as_slice()));
        let moves = |channel: &&Channel| matches!(channel.target, ChannelTarget::MorphWeight { morph, .. } if self.morphs.contains(&morph));
        let channels: Vec<&Channel> = clip.channels.iter().filter(moves).collect();
        if channels.is_empty() {
            return;
        }
        let rest: Vec<(MorphId, u32, f64)> = self
            .morphs
            .iter()
            .filter_map(|id| Some((*id, document.scene.morphs.get(id.index())?)))
            .flat_map(|(id, morph)| {
                let weights = morph.weights.iter().copied().chain(std::iter::repeat(0.0)).take(morph.targets.len());
                weights.zip(0..).map(move |(weight, target)| (id, target, f64::from(weight)))
            })
            .collect();
        if let Some(spline) = Spline::of_weights(take, &channels, &rest) {
            let input = buffer.scalars(&spline.times, true);
            let output = buffer.scalars(&spline.rows, false);
            animation.add(self.node, spline.path, input, output, "CUBICSPLINE");
            return;
        }
        let own = Clip {
            start: take.span.0,
            end: take.span.1,
            channels: channels.iter().map(|channel| (*channel).clone()).collect(),
            ..Clip::default()
        };
        let stepped = channels.iter().all(|channel| all_steps(&channel.curve));
        let when = moments(&within(own.key_times(None), take.span), &if stepped { Vec::new() } else { jumps(&channels) }, take.shift);
        let mut pose = Pose::rest(&document.scene);
        let mut at = |time: f64| {
            own.sample(time, &mut pose);
            let weight = |(morph, target, _): &(MorphId, u32, f64)| pose.morph_weights.get(morph.index())?.get(*target as usize).copied();
            rest.iter().map(|place| weight(place).unwrap_or(0.0)).collect::<Vec<f32>>()
        };
        let keys =
            if stepped { when.iter().map(|moment| (moment.written, at(moment.at))).collect() } else { numbers(&when, WEIGHT, &mut at) };
        let input = buffer.scalars(&keys.iter().map(|(time, _)| *time).collect::<Vec<_>>(), true);
        let output = buffer.scalars(&keys.iter().flat_map(|(_, weights)| weights.iter().copied()).collect::<Vec<_>>(), false);
        animation.add(self.node, "weights", input, output, if stepped { "STEP" } else { "LINEAR" });
    }
}

/// Largest error of a sampled weight; a whole weight moves a point by no more than the diagonal, mostly.
const WEIGHT: f64 = 2e-5;

//! Rows and graphs of the dope sheet and the curve view: one row a bone or other target, one graph a component. No widgets.

use std::collections::HashMap;
use std::sync::Arc;

use glam::{DMat4, EulerRot};

use sinew_scene::animation::{Channel, ChannelTarget, Clip, Components, Curve, MaterialSlot};
use sinew_scene::{Label, LightId, MaterialId, MorphId, NodeId, Scene, TransformOp};

/// What a row of the dope sheet stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum AnimatedItem {
    /// A node or bone.
    Node(NodeId),
    /// The weights of a morph.
    Morph(MorphId),
    /// The values of a material.
    Material(MaterialId),
    /// The colour of a light.
    Light(LightId),
}

/// A row of the dope sheet.
#[derive(Debug, Clone, PartialEq)]
pub struct SheetRow {
    /// What it stands for.
    pub item: AnimatedItem,
    /// Key times within the clip; seconds, ascending, each once.
    pub keys: Vec<f64>,
}

/// What a graph shows; the unit of its values follows from it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GraphKind {
    /// Lengths in the file's unit.
    Translation,
    /// Degrees.
    Rotation,
    /// Factors.
    Scale,
    /// The numbers of a skew or look-at.
    Other,
    /// Weights of morph targets.
    Weights,
    /// Parts of a colour.
    Colour,
    /// The exponent of a highlight.
    Shininess,
    /// From 0 to 1.
    Opacity,
}

/// How a line reads its number from a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum ValueReader {
    Number(usize),
    Position(usize),
    Turn(usize),
    Size(usize),
}

/// One number over time.
#[derive(Debug, Clone)]
pub struct ValueGraph {
    /// `X`, `Y`, `Z`, or the name of a morph target.
    pub name: String,
    /// 0, 1, 2 = the colour of that axis.
    pub axis: usize,
    curve: Arc<Curve>,
    reading: ValueReader,
}

/// Lines of one kind.
#[derive(Debug, Clone)]
pub struct CurveGraph {
    /// What they are.
    pub kind: GraphKind,
    /// The lines.
    pub lines: Vec<ValueGraph>,
}

impl CurveGraph {
    /// Whether a line of it has not the same value at all its keys.
    pub fn moves(&self) -> bool {
        self.lines.iter().any(|line| {
            let first = line.keys().first().map_or(0.0, |key| line.value(*key));
            line.keys().iter().any(|key| (line.value(*key) - first).abs() > 1e-4)
        })
    }
}

impl ValueGraph {
    /// The value at a moment, seconds.
    pub fn value(&self, time: f64) -> f64 {
        match self.reading {
            ValueReader::Number(component) => self.curve.value(time, component),
            ValueReader::Position(axis) => self.curve.matrix(time).w_axis.to_array()[axis],
            ValueReader::Turn(axis) => {
                let (_, rotation, _) = is_valid(self.curve.matrix(time)).to_scale_rotation_translation();
                let (z, y, x) = rotation.to_euler(EulerRot::ZYX);
                [x, y, z][axis].to_degrees()
            }
            ValueReader::Size(axis) => {
                let matrix = self.curve.matrix(time);
                [matrix.x_axis, matrix.y_axis, matrix.z_axis][axis].truncate().length()
            }
        }
    }

    /// Its key times, seconds, ascending.
    pub fn keys(&self) -> &[f64] {
        &self.curve.times
    }

    /// The ends of the tangents of a segment, as (time, value); none where it goes straight.
    pub fn tangents(&self, segment: usize) -> Option<[(f64, f64); 2]> {
        match self.reading {
            ValueReader::Number(component) => self.curve.control_points(segment, component),
            _ => None,
        }
    }
}

/// A matrix without a rotation, such as a flat one, turns nothing.
fn is_valid(matrix: DMat4) -> DMat4 {
    let flat = matrix.determinant().abs() < 1e-30 || !matrix.is_finite();
    if flat { DMat4::IDENTITY } else { matrix }
}

/// What a channel moves.
fn animated_item(channel: &Channel) -> AnimatedItem {
    match channel.target {
        ChannelTarget::Transform { node, .. } => AnimatedItem::Node(node),
        ChannelTarget::MorphWeight { morph, .. } => AnimatedItem::Morph(morph),
        ChannelTarget::Material { material, .. } => AnimatedItem::Material(material),
        ChannelTarget::LightColor { light, .. } => AnimatedItem::Light(light),
    }
}

/// The rows of a clip, in the order in which the file animates them.
pub(super) fn rows(clip: &Clip) -> Vec<SheetRow> {
    let mut places: HashMap<AnimatedItem, usize> = HashMap::new();
    let mut rows: Vec<SheetRow> = Vec::new();
    for channel in &clip.channels {
        let what = animated_item(channel);
        let place = *places.entry(what).or_insert_with(|| {
            rows.push(SheetRow { item: what, keys: Vec::new() });
            rows.len() - 1
        });
        if let Some(row) = rows.get_mut(place) {
            row.keys.extend(channel.curve.times.iter().filter(|time| (clip.start..=clip.end).contains(time)));
        }
    }
    for row in &mut rows {
        row.keys.sort_unstable_by(f64::total_cmp);
        row.keys.dedup();
    }
    rows
}

/// What an item is called; `None` where the scene has no such thing.
pub(super) fn label(scene: &Scene, what: AnimatedItem) -> Option<Label<'_>> {
    match what {
        AnimatedItem::Node(id) => (id.index() < scene.graph.len()).then(|| scene.graph.label(id)),
        AnimatedItem::Morph(id) => scene.morphs.get(id.index()).map(|morph| morph.label()),
        AnimatedItem::Material(id) => scene.materials.get(id.index()).map(|material| material.label()),
        AnimatedItem::Light(id) => scene.lights.get(id.index()).map(|light| light.label()),
    }
}

/// The graphs of a row, in a fixed order, as far as the clip moves them.
pub(super) fn graphs(scene: &Scene, clip: &Clip, what: AnimatedItem) -> Vec<CurveGraph> {
    use GraphKind as K;
    let mut graphs: Vec<CurveGraph> = Vec::new();
    for channel in clip.channels.iter().filter(|channel| animated_item(channel) == what) {
        for (kind, line) in lines(scene, channel) {
            match graphs.iter_mut().find(|graph| graph.kind == kind) {
                Some(graph) => graph.lines.push(line),
                None => graphs.push(CurveGraph { kind, lines: vec![line] }),
            }
        }
    }
    let order = [K::Translation, K::Rotation, K::Scale, K::Other, K::Weights, K::Colour, K::Shininess, K::Opacity];
    graphs.sort_by_key(|graph| order.iter().position(|kind| *kind == graph.kind));
    for graph in &mut graphs {
        graph.lines.sort_by_key(|line| line.axis);
    }
    graphs
}

const AXES: [&str; 3] = ["X", "Y", "Z"];
const PARTS: [&str; 3] = ["R", "G", "B"];

/// The lines that a channel adds, each with its kind.
fn lines(scene: &Scene, channel: &Channel) -> Vec<(GraphKind, ValueGraph)> {
    let line = |name: &str, axis: usize, reading| ValueGraph { name: name.into(), axis, curve: channel.curve.clone(), reading };
    // Numbers of a vector: all of them, or the one of the lane.
    let vector = |kind, lane, names: [&str; 3]| -> Vec<(GraphKind, ValueGraph)> {
        match lane {
            Components::Whole => {
                (0..channel.curve.dimension.min(3)).map(|axis| (kind, line(names[axis], axis, ValueReader::Number(axis)))).collect()
            }
            Components::Component(axis) => {
                let axis = usize::from(axis).min(2);
                vec![(kind, line(names[axis], axis, ValueReader::Number(0)))]
            }
        }
    };
    match channel.target {
        ChannelTarget::Transform { node, op, components: lane } => {
            let op = (node.index() < scene.graph.len()).then(|| scene.graph.node(node).transform.ops.get(op as usize)).flatten();
            match (op, lane) {
                (Some(TransformOp::Translate(_)), lane) => vector(GraphKind::Translation, lane, AXES),
                (Some(TransformOp::Scale(_)), lane) => vector(GraphKind::Scale, lane, AXES),
                (Some(TransformOp::Rotate { axis, .. }), lane) => {
                    let number = if lane == Components::Whole { channel.curve.dimension.saturating_sub(1) } else { 0 };
                    let size = axis.abs();
                    let along = if size.x >= size.y && size.x >= size.z { 0 } else { 1 + usize::from(size.z > size.y) };
                    vec![(GraphKind::Rotation, line(AXES[along], along, ValueReader::Number(number)))]
                }
                (Some(TransformOp::Matrix(_)), Components::Whole) => (0..3)
                    .flat_map(|axis| {
                        [
                            (GraphKind::Translation, line(AXES[axis], axis, ValueReader::Position(axis))),
                            (GraphKind::Rotation, line(AXES[axis], axis, ValueReader::Turn(axis))),
                            (GraphKind::Scale, line(AXES[axis], axis, ValueReader::Size(axis))),
                        ]
                    })
                    .collect(),
                (_, Components::Component(component)) => {
                    vec![(GraphKind::Other, line(&component.to_string(), usize::from(component) % 3, ValueReader::Number(0)))]
                }
                (_, Components::Whole) => vector(GraphKind::Other, lane, AXES),
            }
        }
        ChannelTarget::MorphWeight { morph, target } => {
            let target = target as usize;
            let found = scene.morphs.get(morph.index()).and_then(|morph| morph.targets.get(target)).map(|target| target.name.clone());
            vec![(GraphKind::Weights, line(&found.unwrap_or_else(|| target.to_string()), target, ValueReader::Number(0)))]
        }
        ChannelTarget::Material { slot, components: lane, .. } => match slot {
            MaterialSlot::Shininess => vec![(GraphKind::Shininess, line("", 0, ValueReader::Number(0)))],
            MaterialSlot::Opacity => vec![(GraphKind::Opacity, line("", 0, ValueReader::Number(0)))],
            _ => vector(GraphKind::Colour, lane, PARTS),
        },
        ChannelTarget::LightColor { components: lane, .. } => vector(GraphKind::Colour, lane, PARTS),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;
    use sinew_scene::animation::{Interpolation, Keys, Tangents};
    use sinew_scene::{Node, Transform};

    fn scene() -> Scene {
        let mut scene = Scene::default();
        for name in ["hip", "knee"] {
            let mut node = Node::new(name);
            node.transform = Transform {
                ops: vec![
                    TransformOp::Translate(DVec3::ZERO),
                    TransformOp::Rotate { axis: DVec3::Z, angle: 0.0 },
                    TransformOp::Matrix(DMat4::IDENTITY),
                ],
            };
            scene.graph.add(None, node);
        }
        scene
    }

    fn channel(node: u32, op: u32, lane: Components, keys: Keys) -> Channel {
        Channel { target: ChannelTarget::Transform { node: NodeId(node), op, components: lane }, curve: Arc::new(Curve::new(keys)) }
    }

    fn keys(times: &[f64], dimension: usize, values: Vec<f64>) -> Keys {
        Keys { times: times.to_vec(), dimension, values, ..Keys::default() }
    }

    #[test]
    fn one_row_for_each_target_with_the_keys_of_all_its_channels() {
        let clip = Clip {
            name: "walk".into(),
            start: 0.0,
            end: 2.0,
            channels: vec![
                channel(1, 0, Components::Component(1), keys(&[0.0, 2.0], 1, vec![0.0, 1.0])),
                channel(0, 1, Components::Component(3), keys(&[0.0, 1.0, 5.0], 1, vec![0.0, 90.0, 0.0])),
                channel(1, 1, Components::Component(3), keys(&[0.0, 1.0], 1, vec![0.0, 45.0])),
            ],
            ..Clip::default()
        };
        let (scene, rows) = (scene(), rows(&clip));
        let told: Vec<_> = rows.iter().map(|row| (label(&scene, row.item), row.keys.as_slice())).collect();
        let name = |name| Some(Label::Name(name));
        assert_eq!(told, [(name("knee"), [0.0, 1.0, 2.0].as_slice()), (name("hip"), [0.0, 1.0].as_slice())]);
        assert_eq!(label(&scene, AnimatedItem::Light(LightId(0))), None);
        let graphs = graphs(&scene, &clip, rows[0].item);
        let told: Vec<_> = graphs.iter().map(|graph| (graph.kind, graph.lines.len(), graph.lines[0].name.as_str())).collect();
        assert_eq!(told, [(GraphKind::Translation, 1, "Y"), (GraphKind::Rotation, 1, "Z")]);
        assert_eq!(graphs[1].lines[0].value(0.5), 22.5);
    }

    #[test]
    fn a_matrix_is_read_as_position_turn_and_size() {
        let matrix = |angle: f64, x: f64| {
            DMat4::from_scale_rotation_translation(DVec3::splat(2.0), glam::DQuat::from_rotation_z(angle), DVec3::new(x, 0.0, 0.0))
        };
        let values = [matrix(0.0, 0.0), matrix(1.0, 4.0)].iter().flat_map(|matrix| matrix.to_cols_array()).collect();
        let keys = Keys { matrix: true, ..keys(&[0.0, 1.0], 16, values) };
        let clip = Clip { end: 1.0, channels: vec![channel(0, 2, Components::Whole, keys)], ..Clip::default() };
        let graphs = graphs(&scene(), &clip, AnimatedItem::Node(NodeId(0)));
        let at = |kind, axis: usize| {
            graphs.iter().find(|graph| graph.kind == kind).map(|graph| graph.lines[axis].value(0.5)).expect("the graph is there")
        };
        assert!((at(GraphKind::Translation, 0) - 2.0).abs() < 1e-12);
        assert!((at(GraphKind::Rotation, 2) - 0.5f64.to_degrees()).abs() < 1e-9);
        assert!((at(GraphKind::Scale, 1) - 2.0).abs() < 1e-12);
    }

    #[test]
    fn tangents_stand_where_the_file_puts_them() {
        let tangents = |values: Vec<f64>| Tangents { stride: 2, values };
        let keys = Keys {
            modes: vec![Interpolation::Bezier; 2],
            out_tangents: tangents(vec![0.25, 3.0, 0.0, 0.0]),
            in_tangents: tangents(vec![0.0, 0.0, 0.5, 7.0]),
            ..keys(&[0.0, 1.0], 1, vec![1.0, 5.0])
        };
        let clip = Clip { end: 1.0, channels: vec![channel(0, 0, Components::Component(0), keys)], ..Clip::default() };
        let graphs = graphs(&scene(), &clip, AnimatedItem::Node(NodeId(0)));
        assert_eq!(graphs[0].lines[0].tangents(0), Some([(0.25, 3.0), (0.5, 7.0)]));
        assert_eq!(graphs[0].lines[0].tangents(1), None);
    }
}

//! Curves that the format says exactly as cubic splines: Bézier and Hermite segments whose inner control points stand at thirds of the time.

use glam::DVec3;

use super::animations::{AnimationRange, local, ops};
use sinew_scene::animation::{Channel, ChannelTarget, Components, Curve, Interpolation, Pose};
use sinew_scene::{MorphId, NodeId, TransformOp};

/// A cubic track: for each key the tangent that arrives, the value, the tangent that leaves.
pub(super) struct Spline {
    pub path: &'static str,
    pub times: Vec<f32>,
    pub rows: Vec<f32>,
}

/// A number over time: a component of a curve, or a constant.
#[derive(Clone, Copy)]
enum ComponentTrack<'a> {
    Curve(&'a Curve, usize),
    Still(f64),
}

impl ComponentTrack<'_> {
    fn value(&self, key: usize, times: &[f64]) -> f64 {
        match self {
            Self::Curve(curve, component) => curve.value(times[key], *component),
            Self::Still(value) => *value,
        }
    }

    /// Tangents at both ends of a segment, per second; `None` where it is no spline of the format.
    fn tangents(&self, segment: usize, times: &[f64]) -> Option<[f64; 2]> {
        let Self::Curve(curve, component) = self else { return Some([0.0; 2]) };
        let length = times[segment + 1] - times[segment];
        Some(curve.tangents_at_thirds(segment, *component)?.map(|tangent| tangent / length))
    }
}

/// The times that all of these channels have keys at, where a spline can be made of them: they rise, span the take, and one segment at least is curved.
fn shared_times<'a>(take: &AnimationRange, channels: &[&'a Channel]) -> Option<&'a [f64]> {
    let times = &channels.first()?.curve.times;
    let cubic = |mode: &Interpolation| matches!(mode, Interpolation::Bezier | Interpolation::Hermite);
    let is_curved = channels.iter().any(|channel| channel.curve.modes.iter().take(times.len().saturating_sub(1)).any(cubic));
    let same = channels.iter().all(|channel| channel.curve.times == *times);
    let rising = times.windows(2).all(|pair| ((pair[0] + take.shift) as f32) < (pair[1] + take.shift) as f32);
    (is_curved && same && rising && take.span == (*times.first()?, *times.last()?)).then_some(times)
}

impl Spline {
    /// The translation or scale of a node, where one `translate` alone moves, or one `scale` that nothing stands below.
    pub(super) fn of_node(take: &AnimationRange, node: NodeId, channels: &[&Channel], pose: &mut Pose) -> Option<Self> {
        let times = shared_times(take, channels)?;
        let mut lanes: [Option<(&Curve, usize)>; 3] = [None; 3];
        let mut moving = None;
        for channel in channels {
            let ChannelTarget::Transform { op, components: lane, .. } = channel.target else { return None };
            if *moving.get_or_insert(op) != op {
                return None;
            }
            match lane {
                Components::Whole if channel.curve.dimension == 3 => lanes = [0, 1, 2].map(|component| Some((&*channel.curve, component))),
                Components::Component(component) => *lanes.get_mut(usize::from(component))? = Some((&channel.curve, 0)),
                Components::Whole => return None,
            }
        }
        let at = moving? as usize;
        let op = *ops(pose, node).get(at)?;
        let leads = |rest: DVec3| {
            [0, 1, 2].map(|component| {
                lanes[component].map_or(ComponentTrack::Still(rest[component]), |(curve, lane)| ComponentTrack::Curve(curve, lane))
            })
        };
        match op {
            TransformOp::Translate(rest) => {
                // The translation of the node is an affine function of the animated vector.
                let place = pose.ranges.get(node.index())?.start as usize + at;
                let mut placed = |vector: DVec3| {
                    pose.ops[place] = TransformOp::Translate(vector);
                    local(pose, node).w_axis.truncate()
                };
                let origin = placed(DVec3::ZERO);
                let axes = DVec3::AXES.map(|axis| placed(axis) - origin);
                placed(rest);
                let turn = |v: DVec3| axes[0] * v.x + axes[1] * v.y + axes[2] * v.z;
                Self::make(
                    "translation",
                    take,
                    times,
                    &leads(rest),
                    |values| (origin + turn(values)).into(),
                    |tangents| turn(tangents).into(),
                )
            }
            TransformOp::Scale(rest) if at + 1 == ops(pose, node).len() => {
                // What stands above must not stretch, or it would shear.
                let rigid = |op: &TransformOp| matches!(op, TransformOp::Translate(_) | TransformOp::Rotate { .. });
                let leads = leads(rest);
                let positive =
                    rest.min_element() > 0.0 && (0..times.len()).all(|key| leads.iter().all(|lead| lead.value(key, times) > 0.0));
                if !ops(pose, node).iter().take(at).all(rigid) || !positive {
                    return None;
                }
                Self::make("scale", take, times, &leads, Into::into, Into::into)
            }
            _ => None,
        }
    }

    /// The weights of morph targets, in the order of `rest`, which names each with its weight at rest.
    pub(super) fn of_weights(take: &AnimationRange, channels: &[&Channel], rest: &[(MorphId, u32, f64)]) -> Option<Self> {
        let times = shared_times(take, channels)?;
        let lead = |&(morph, target, weight): &(MorphId, u32, f64)| {
            // Of two channels on one weight the later counts, as it does when they are sampled.
            let found = channels.iter().rev().find(|channel| channel.target == ChannelTarget::MorphWeight { morph, target });
            found.map_or(ComponentTrack::Still(weight), |channel| ComponentTrack::Curve(&channel.curve, 0))
        };
        let leads: Vec<ComponentTrack<'_>> = rest.iter().map(lead).collect();
        let width = leads.len();
        let mut rows = vec![0.0; times.len() * 3 * width];
        for (index, lead) in leads.iter().enumerate() {
            for key in 0..times.len() {
                rows[(key * 3 + 1) * width + index] = lead.value(key, times) as f32;
            }
            for segment in 0..times.len() - 1 {
                let [leaving, arriving] = lead.tangents(segment, times)?;
                rows[(segment * 3 + 2) * width + index] = leaving as f32;
                rows[(segment * 3 + 3) * width + index] = arriving as f32;
            }
        }
        Some(Self { path: "weights", times: written(take, times), rows })
    }

    fn make(
        path: &'static str,
        take: &AnimationRange,
        times: &[f64],
        leads: &[ComponentTrack<'_>; 3],
        value: impl Fn(DVec3) -> [f64; 3],
        tangent: impl Fn(DVec3) -> [f64; 3],
    ) -> Option<Self> {
        let mut rows = vec![0.0_f32; times.len() * 9];
        let mut put = |row: usize, vector: [f64; 3]| rows[row * 3..][..3].copy_from_slice(&vector.map(|number| number as f32));
        for key in 0..times.len() {
            put(key * 3 + 1, value(DVec3::from_array([0, 1, 2].map(|component| leads[component].value(key, times)))));
        }
        for segment in 0..times.len() - 1 {
            let (mut leaving, mut arriving) = (DVec3::ZERO, DVec3::ZERO);
            for (component, lead) in leads.iter().enumerate() {
                [leaving[component], arriving[component]] = lead.tangents(segment, times)?;
            }
            put(segment * 3 + 2, tangent(leaving));
            put(segment * 3 + 3, tangent(arriving));
        }
        Some(Self { path, times: written(take, times), rows })
    }
}

fn written(take: &AnimationRange, times: &[f64]) -> Vec<f32> {
    times.iter().map(|time| (time + take.shift) as f32).collect()
}

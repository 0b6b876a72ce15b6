//! `library_animations` and `library_animation_clips`: samplers to curves, channels to clips.

use std::sync::Arc;

use roxmltree::NodeId as ElementId;
use rustc_hash::FxHashMap;

use super::channel_target::{Aim, Aims, Miss};
use super::context::{Context, ReadResult, children, id_of, name_of, shortened};
use super::material::encoded;
use super::source::{Arrays, inputs, name_list};
use super::{El, Finding};
use sinew_scene::animation::{Channel, ChannelTarget, Clip, Curve, Interpolation, Keys, Tangents};

/// What a channel takes, roughly, for the budget.
const CHANNEL_BYTES: usize = 64;
/// What a key takes per number, roughly: value, control points, decomposition.
const KEY_BYTES: usize = 24;

/// A channel of the file with where it stands, so that clips can pick those inside an `animation`.
struct LocatedChannel {
    at: usize,
    channel: Channel,
}

/// Reads all animation into clips.
///
/// # Errors
/// Where commas separate numbers, or on cancel.
pub(super) fn read<'a>(context: &mut Context<'a>, aims: &Aims<'_, 'a>) -> ReadResult<Vec<Clip>> {
    let mut reader = Reader { arrays: Arrays::default(), curves: FxHashMap::default() };
    let mut placed = Vec::new();
    for library in context.libraries("library_animations") {
        // What stands under `extra` means something to one program only.
        let is_extra = |element: El<'a>| element.ancestors().any(|above| above.tag_name().name() == "extra");
        for element in library.descendants().filter(|element| element.tag_name().name() == "channel" && !is_extra(*element)) {
            // Each may move thousands of instances, which is looked up before it is known to be too much.
            if context.is_spent() {
                break;
            }
            reader.channel(context, aims, element, &mut placed)?;
        }
    }
    let clips = clips(context, &placed);
    if !clips.is_empty() || placed.is_empty() {
        return Ok(clips);
    }
    let channels: Vec<Channel> = placed.into_iter().map(|placed| placed.channel).collect();
    let (start, end) = span(&channels);
    Ok(vec![Clip { name: whole_name(context), start, end, channels, ..Clip::default() }])
}

/// First and last key of all channels.
fn span(channels: &[Channel]) -> (f64, f64) {
    let spans = channels.iter().filter_map(|channel| channel.curve.time_range());
    let (start, end) = spans.fold((f64::INFINITY, f64::NEG_INFINITY), |(start, end), (from, to)| (start.min(from), end.max(to)));
    if start <= end { (start, end) } else { (0.0, 0.0) }
}

/// The name of one clip over everything: that of the only animation, if there is one only.
fn whole_name(context: &Context<'_>) -> String {
    let mut animations = context.libraries("library_animations").into_iter().flat_map(|library| children(library, "animation"));
    match (animations.next(), animations.next()) {
        (Some(only), None) => name_of(only),
        _ => String::new(),
    }
}

/// The clips that the file names.
fn clips<'a>(context: &mut Context<'a>, placed: &[LocatedChannel]) -> Vec<Clip> {
    let mut clips = Vec::new();
    for element in context.libraries("library_animation_clips").into_iter().flat_map(|library| children(library, "animation_clip")) {
        let mut channels: Vec<Channel> = Vec::new();
        for instance in children(element, "instance_animation") {
            let Some(animation) = context.follow(instance, "url", &["animation"]) else { continue };
            let range = animation.range();
            let from = placed.partition_point(|channel| channel.at < range.start);
            let inside = placed.get(from..).unwrap_or_default();
            let inside = inside.get(..inside.partition_point(|channel| channel.at < range.end)).unwrap_or_default();
            if context.spend(instance, inside.len() * CHANNEL_BYTES) {
                channels.extend(inside.iter().map(|placed| placed.channel.clone()));
            }
        }
        let name = name_of(element);
        if channels.is_empty() {
            context.report.report(element, Finding::EmptyClip);
            continue;
        }
        let keys = span(&channels);
        // The format's own default for the start is 0, for the end the last key.
        let start = context.attribute(element, "start").unwrap_or(0.0);
        let end = context.attribute(element, "end").unwrap_or(keys.1).max(start);
        let place = u32::try_from(clips.len() + 1).ok();
        clips.push(Clip { name, id: id_of(element), place, start, end, channels });
    }
    clips
}

/// A curve read for one way of use: what is wrong with it is reported once.
type CachedCurve = Option<Arc<Curve>>;

struct Reader {
    arrays: Arrays<f64>,
    curves: FxHashMap<(ElementId, bool), CachedCurve>,
}

impl Reader {
    fn channel<'a>(
        &mut self,
        context: &mut Context<'a>,
        aims: &Aims<'_, 'a>,
        element: El<'a>,
        placed: &mut Vec<LocatedChannel>,
    ) -> ReadResult<()> {
        context.check_cancelled()?;
        let address = element.attribute("target").unwrap_or_default();
        let aim = match aims.find(context, element, address) {
            Ok(aim) => aim,
            // Of a document that others take parts from, whatever they leave is still.
            Err(_) if context.lookup.roots().iter().skip(1).any(|part| element.ancestors().any(|above| above == *part)) => return Ok(()),
            Err(Miss::Unknown) => {
                context.report.report(element, Finding::UnknownTarget(shortened(address)));
                return Ok(());
            }
            Err(Miss::Unsupported) => {
                context.report.report(element, Finding::UnsupportedTarget(shortened(address)));
                return Ok(());
            }
        };
        let Some(sampler) = context.follow(element, "source", &["sampler"]) else { return Ok(()) };
        let key = (sampler.id(), aim.matrix);
        let curve = match self.curves.get(&key) {
            Some(known) => known.clone(),
            None => {
                let curve = self.curve(context, sampler, aim.matrix)?.map(Arc::new);
                self.curves.insert(key, curve.clone());
                curve
            }
        };
        if let Some(curve) = curve {
            place(context, element, &aim, &curve, placed);
        }
        Ok(())
    }

    fn curve<'a>(&mut self, context: &mut Context<'a>, sampler: El<'a>, matrix: bool) -> ReadResult<Option<Curve>> {
        let (mut input, mut output, mut modes) = (None, None, None);
        let (mut arriving, mut leaving) = (None, None);
        for own in inputs(sampler) {
            let slot = match own.semantic {
                "INPUT" => &mut input,
                "OUTPUT" => &mut output,
                "INTERPOLATION" => &mut modes,
                "IN_TANGENT" => &mut arriving,
                "OUT_TANGENT" => &mut leaving,
                _ => continue,
            };
            *slot = context.follow(own.element, "source", &["source"]);
        }
        let times = match input {
            Some(source) => self.arrays.accessor(context, source, 1)?,
            None => None,
        };
        let values = match output {
            Some(source) => self.arrays.accessor(context, source, if matrix { 16 } else { 1 })?,
            None => None,
        };
        let (Some(times), Some(values)) = (times, values) else {
            context.report.report(sampler, Finding::BadSampler);
            return Ok(None);
        };
        // Where the two disagree, one of the counts is wrong: all that both have data for are keys.
        let count = if times.count == values.count {
            times.count
        } else {
            times.available.min(values.available).min(times.count.max(values.count))
        };
        if times.count != values.count {
            context.report.report(sampler, Finding::KeyCountMismatch { times: times.count, values: values.count });
        }
        let dimension = values.width();
        if count == 0 || (matrix && dimension != 16) {
            context.report.report(sampler, Finding::BadSampler);
            return Ok(None);
        }
        if !context.spend(sampler, count.saturating_mul(dimension).saturating_mul(KEY_BYTES) / 4) {
            return Ok(None);
        }
        let mut keys = Keys { dimension, matrix, ..Keys::default() };
        keys.times = (0..count).filter_map(|key| times.get(key, 0)).collect();
        keys.values = values.first_rows(count);
        if matrix {
            keys.values.as_chunks_mut::<16>().0.iter_mut().for_each(transpose);
        }
        self.arrays.release(values);
        keys.modes = match modes {
            Some(modes) => interpolation(context, modes, count),
            None => Vec::new(),
        };
        let curved = keys.modes.iter().any(|mode| matches!(mode, Interpolation::Bezier | Interpolation::Hermite));
        if curved {
            for (source, tangents) in [(arriving, &mut keys.in_tangents), (leaving, &mut keys.out_tangents)] {
                let Some(source) = source else { continue };
                if let Some(accessor) = self.arrays.accessor(context, source, dimension)? {
                    *tangents = read_tangents(&accessor, count, dimension, matrix);
                }
            }
            let fits = |tangents: &Tangents| [dimension, dimension + 1, 2 * dimension].contains(&tangents.stride);
            if !(fits(&keys.in_tangents) && fits(&keys.out_tangents)) {
                context.report.report(sampler, Finding::MissingTangents);
            }
        }
        if keys.times.iter().chain(&keys.values).any(|value| !value.is_finite()) {
            context.report.report(sampler, Finding::KeysNotFinite);
        }
        let curve = Curve::new(keys);
        if curve.is_sheared() {
            context.report.report(sampler, Finding::ShearedKeys);
        }
        Ok((!curve.times.is_empty()).then_some(curve))
    }
}

fn read_tangents(accessor: &super::source::Accessor<f64>, count: usize, dimension: usize, matrix: bool) -> Tangents {
    let mut tangents = Tangents { stride: accessor.width(), values: accessor.first_rows(count) };
    if matrix && tangents.stride == dimension {
        tangents.values.as_chunks_mut::<16>().0.iter_mut().for_each(transpose);
    }
    tangents
}

/// The file's matrices go row by row, ours column by column.
fn transpose(matrix: &mut [f64; 16]) {
    *matrix = glam::DMat4::from_cols_array(matrix).transpose().to_cols_array();
}

fn interpolation<'a>(context: &mut Context<'a>, source: El<'a>, count: usize) -> Vec<Interpolation> {
    let Some(list) = name_list(context, source) else { return Vec::new() };
    let mut unsupported = None;
    let modes = list
        .entries()
        .take(count)
        .map(|name| {
            let known = [
                ("LINEAR", Interpolation::Linear),
                ("STEP", Interpolation::Step),
                ("BEZIER", Interpolation::Bezier),
                ("HERMITE", Interpolation::Hermite),
            ];
            known.iter().find(|(known, _)| name.eq_ignore_ascii_case(known)).map_or_else(
                || {
                    unsupported.get_or_insert_with(|| name.to_owned());
                    Interpolation::Linear
                },
                |(_, mode)| *mode,
            )
        })
        .collect();
    if let Some(name) = unsupported {
        context.report.report(source, Finding::UnsupportedInterpolation(shortened(&name)));
    }
    modes
}

/// Puts a curve onto all that it moves.
fn place(context: &mut Context<'_>, element: El<'_>, aim: &Aim, curve: &Arc<Curve>, placed: &mut Vec<LocatedChannel>) {
    let weights =
        aim.wanted > 1 && aim.targets.len() == aim.wanted && matches!(aim.targets.first(), Some(ChannelTarget::MorphWeight { .. }));
    // A colour may be animated without its alpha.
    let color = aim.wanted == 4 && curve.dimension == 3;
    let lone = aim.lone.filter(|_| curve.dimension == 1);
    if curve.dimension < aim.wanted && !color && !weights && lone.is_none() {
        context.report.report(element, Finding::KeySize { found: curve.dimension, wanted: aim.wanted });
        return;
    }
    let size = CHANNEL_BYTES + if weights { curve.times.len() * 16 } else { 0 };
    if !context.spend(element, aim.targets.len().saturating_mul(size)) {
        return;
    }
    // Keys of the whole value where one number of it is moved: that number is meant.
    let part = aim.among.filter(|(index, of)| *of > 1 && curve.dimension == *of && index < of);
    if part.is_some() && !context.spend(element, curve.times.len().saturating_mul(KEY_BYTES)) {
        return;
    }
    let curve = &part.map_or_else(|| Arc::clone(curve), |(index, _)| Arc::new(curve.component(index)));
    let curve = match aim.line {
        Some((start, slope)) => Arc::new(curve.mapped(|value| start + slope * value)),
        None if aim.encode => Arc::new(curve.mapped(|value| f64::from(encoded(value as f32)))),
        None => Arc::clone(curve),
    };
    let at = element.range().start;
    for (index, target) in aim.targets.iter().enumerate() {
        let curve = if weights {
            if index >= curve.dimension {
                break;
            }
            Arc::new(curve.component(index))
        } else {
            Arc::clone(&curve)
        };
        let target = match (*target, lone) {
            (ChannelTarget::Transform { node, op, .. }, Some(lane)) => ChannelTarget::Transform { node, op, components: lane },
            (target, _) => target,
        };
        placed.push(LocatedChannel { at, channel: Channel { target, curve } });
    }
}

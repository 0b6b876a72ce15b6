//! Samples moving surfaces as closely as their movement asks for and makes shapes of them; two surfaces are worked on at a time where there are two cores.
//!
//! All surfaces are posed together, moment after moment, and go into their [`ShapeBasisBuilder`]s at once, so that memory grows with the shapes and not with the
//! moments. The result has the same bits for any number of threads.

use std::num::NonZero;
use std::sync::{Mutex, PoisonError};
use std::thread;

use glam::Vec3;

use super::keyframe_reduction::{KeyTime, thin};
use super::shape_basis::{ShapeBasis, ShapeBasisBuilder, ShapeTolerance};

/// Most shapes of a muscle.
pub(super) const MAX_SHAPES: usize = 64;
/// Most moments of all ranges together.
const MAX_MOMENTS: usize = 4_096;
/// Intervals shorter than this are not halved, seconds: over a shorter one only what leaps goes further than the error allows, and no number of samples
/// would follow that.
const SHORTEST: f64 = 1.0 / 120.0;
/// An interval between keys of the file is looked at in its quarters too if it is longer than this, seconds: an S-shaped way crosses the straight one in
/// the middle.
const LONG: f64 = 0.05;
/// What the surfaces of the moments posed together take at most, bytes.
const POSED_BYTES: usize = 64 << 20;
/// Most threads.
const MAX_THREADS: usize = 8;

/// Parts of the largest error that projecting, leaving out vertices, and leaving out keys may take, and how far a sampled middle may be from the straight way
/// before its halves are sampled too. The middle becomes a key, so that half of that is left at most, beside a bend, and a quarter where movement is smooth.
const PROJECTION: f32 = 0.3;
const OMISSION: f32 = 0.35;
const SAMPLING: f32 = 0.4;
const THINNING: f32 = 0.1;
/// What leaving vertices out of shapes may add to the error of a normal, a part of its length: about 1°.
const NORMAL: f32 = 0.02;

/// A surface at a moment as displacements from its rest.
#[derive(Debug, Clone, Default)]
pub(super) struct Displacements {
    pub positions: Vec<Vec3>,
    /// Differences of unit normals.
    pub normals: Vec<Vec3>,
    /// Metres a unit of `positions`, in the direction in which they are longest.
    pub scale: f32,
}

/// Surfaces that move over ranges of time.
pub(super) trait MovingSurfaces: Sync {
    /// What posing needs again and again, one for each thread.
    type Scratch: Default + Send;

    /// The number of vertices of each surface.
    fn vertices(&self) -> Vec<usize>;

    /// All surfaces at the time `at` of a range, the same whatever was posed before.
    fn pose(&self, range: usize, at: f64, scratch: &mut Self::Scratch) -> Vec<Displacements>;
}

/// Shapes of a surface and its keys.
#[derive(Debug)]
pub(super) struct AnimatedShapes {
    pub basis: ShapeBasis,
    /// For each range the written times, each with its row of [`ShapeBasis::weights`].
    pub keys: Vec<Vec<(f32, usize)>>,
}

/// A moment that was sampled: when, and its number in the builders.
#[derive(Debug, Clone, Copy)]
struct Sample {
    time: KeyTime,
    moment: usize,
}

/// An interval that may have to be halved.
#[derive(Debug, Clone, Copy)]
struct Interval {
    range: usize,
    from: Sample,
    to: Sample,
    /// Whether it is halved in any case.
    long: bool,
}

impl Interval {
    fn length(&self) -> f64 {
        self.to.time.at - self.from.time.at
    }

    fn middle(&self) -> Option<KeyTime> {
        let written = self.from.time.written + (self.to.time.written - self.from.time.written) * 0.5;
        let inside = written > self.from.time.written && written < self.to.time.written;
        inside.then_some(KeyTime { at: self.from.time.at + (self.to.time.at - self.from.time.at) * 0.5, written })
    }
}

/// Surfaces whose movement was sampled.
pub(super) struct SampledSurfaces {
    builders: Vec<ShapeBasisBuilder>,
    /// Moments of each range, rising.
    samples: Vec<Vec<Sample>>,
    error: f32,
    threads: usize,
    /// Whether there were more moments to sample than allowed.
    pub exceeded: bool,
}

/// Samples the surfaces at the moments of each range and wherever between two of them a vertex is further from the straight way than a part of `error`, metres.
/// No surface gets more than `most` shapes.
pub(super) fn sample<S: MovingSurfaces>(surfaces: &S, ranges: &[Vec<KeyTime>], error: f32, most: usize, threads: usize) -> SampledSurfaces {
    let tolerance = ShapeTolerance { projection: error * PROJECTION, omission: error * OMISSION, normal: NORMAL };
    let vertices = surfaces.vertices();
    let builders = vertices.iter().map(|count| ShapeBasisBuilder::new(*count, tolerance, most)).collect();
    let mut sampled = SampledSurfaces { builders, samples: vec![Vec::new(); ranges.len()], error, threads, exceeded: false };
    if sampled.builders.is_empty() {
        return sampled;
    }
    let mut poser = Poser { surfaces, pool: Mutex::new(Vec::new()), count: 0, together: 1 };
    let bytes = vertices.iter().sum::<usize>() * 2 * size_of::<Vec3>();
    poser.together = (POSED_BYTES / bytes.max(1)).clamp(1, 4 * threads.max(1));
    let mut open = sampled.at_keys(&mut poser, ranges);
    while !open.is_empty() {
        open = sampled.between(&mut poser, open);
    }
    for samples in &mut sampled.samples {
        samples.sort_by(|a, b| a.time.written.total_cmp(&b.time.written));
    }
    sampled
}

impl SampledSurfaces {
    /// Samples the given moments, or evenly many of them if there are too many; returns the intervals between them.
    fn at_keys<S: MovingSurfaces>(&mut self, poser: &mut Poser<'_, S>, ranges: &[Vec<KeyTime>]) -> Vec<Interval> {
        let keys: usize = ranges.iter().map(Vec::len).sum();
        let step = (2 * keys).div_ceil(MAX_MOMENTS).max(1);
        self.exceeded = step > 1;
        let mut wanted: Vec<(usize, KeyTime)> = Vec::new();
        for (range, moments) in ranges.iter().enumerate() {
            let kept = moments.iter().enumerate().filter(|(number, _)| number % step == 0 || number + 1 == moments.len());
            wanted.extend(kept.map(|(_, time)| (range, *time)));
        }
        // From coarse to fine, so that the first shapes hold what lies furthest apart.
        let bits = usize::BITS - wanted.len().leading_zeros();
        let scattered = (0..1_usize << bits).map(|number| number.reverse_bits() >> (usize::BITS - bits).min(usize::BITS - 1));
        let order: Vec<(usize, KeyTime)> = scattered.filter_map(|number| wanted.get(number).copied()).collect();
        self.pose(poser, &order);
        for samples in &mut self.samples {
            samples.sort_by(|a, b| a.time.written.total_cmp(&b.time.written));
        }
        let of_range = |(range, samples): (usize, &Vec<Sample>)| -> Vec<Interval> {
            let interval = |pair: &[Sample]| match pair {
                &[from, to] => Some(Interval { range, from, to, long: to.time.at - from.time.at > LONG }),
                _ => None,
            };
            samples.windows(2).filter_map(interval).collect()
        };
        self.samples.iter().enumerate().flat_map(of_range).collect()
    }

    /// Samples the middles of intervals; returns the halves of those that have to be halved further.
    fn between<S: MovingSurfaces>(&mut self, poser: &mut Poser<'_, S>, open: Vec<Interval>) -> Vec<Interval> {
        let mut middles: Vec<(Interval, KeyTime)> = open.iter().filter_map(|interval| Some((*interval, interval.middle()?))).collect();
        let room = MAX_MOMENTS.saturating_sub(poser.count);
        self.exceeded |= middles.len() > room;
        middles.truncate(room);
        let first = poser.count;
        self.pose(poser, &middles.iter().map(|(interval, middle)| (interval.range, *middle)).collect::<Vec<_>>());
        let most = self.error * SAMPLING;
        let bent: Mutex<Vec<bool>> = Mutex::new(vec![false; middles.len()]);
        in_parallel(&mut self.builders, self.threads, |builder| {
            let is_bent = |(number, (interval, _)): (usize, &(Interval, KeyTime))| {
                !builder.is_straight([interval.from.moment, first + number, interval.to.moment], most)
            };
            let found: Vec<bool> = middles.iter().enumerate().map(is_bent).collect();
            let mut bent = bent.lock().unwrap_or_else(PoisonError::into_inner);
            bent.iter_mut().zip(found).for_each(|(bent, found)| *bent |= found);
        });
        let bent = bent.into_inner().unwrap_or_else(PoisonError::into_inner);
        let halves = middles
            .iter()
            .enumerate()
            .zip(bent)
            .filter(|((_, (interval, _)), bent)| interval.length() > SHORTEST && (*bent || interval.long));
        halves
            .flat_map(|((number, (interval, time)), _)| {
                let middle = Sample { time: *time, moment: first + number };
                let half = Interval { long: false, ..*interval };
                [Interval { to: middle, ..half }, Interval { from: middle, ..half }]
            })
            .collect()
    }

    fn pose<S: MovingSurfaces>(&mut self, poser: &mut Poser<'_, S>, wanted: &[(usize, KeyTime)]) {
        for (range, time) in wanted {
            if let Some(samples) = self.samples.get_mut(*range) {
                samples.push(Sample { time: *time, moment: poser.count });
            }
            poser.count += 1;
        }
        for wanted in wanted.chunks(poser.together) {
            let mut posed: Vec<(usize, f64, Vec<Displacements>)> =
                wanted.iter().map(|(range, time)| (*range, time.at, Vec::new())).collect();
            in_parallel(&mut posed, self.threads, |(range, at, posed)| *posed = poser.at(*range, *at));
            let mut builders: Vec<(usize, &mut ShapeBasisBuilder)> = self.builders.iter_mut().enumerate().collect();
            in_parallel(&mut builders, self.threads, |(number, builder)| {
                for (_, _, posed) in &posed {
                    match posed.get(*number) {
                        Some(surface) => builder.add(&surface.positions, &surface.normals, surface.scale),
                        None => builder.add(&[], &[], 0.0),
                    }
                }
            });
        }
    }

    /// Makes the shapes and keys of the surfaces, a few at a time, and hands them over in order with the number of each.
    pub(super) fn finish(self, mut take: impl FnMut(usize, AnimatedShapes)) {
        let (threads, samples, error) = (self.threads, &self.samples, self.error);
        let mut builders = self.builders.into_iter().enumerate().peekable();
        while builders.peek().is_some() {
            let mut some: Vec<(usize, Option<ShapeBasisBuilder>, Option<AnimatedShapes>)> =
                builders.by_ref().take(4 * threads.max(1)).map(|(number, builder)| (number, Some(builder), None)).collect();
            in_parallel(&mut some, threads, |(_, builder, made)| {
                *made = builder.take().map(|builder| animated(builder, samples, error));
            });
            some.into_iter().for_each(|(number, _, made)| made.into_iter().for_each(|made| take(number, made)));
        }
    }
}

fn animated(builder: ShapeBasisBuilder, samples: &[Vec<Sample>], error: f32) -> AnimatedShapes {
    let basis = builder.finish();
    let row = |moment: usize| basis.weights.get(moment).map_or(&[][..], Vec::as_slice);
    let keys = samples.iter().map(|samples| {
        let times: Vec<f32> = samples.iter().map(|sample| sample.time.written).collect();
        // No vertex is further off than the sum of what each shape moves it at most.
        let off = |from: usize, to: usize, between: usize| {
            let part = (times[between] - times[from]) / (times[to] - times[from]);
            let [from, to, between] = [from, to, between].map(|at| row(samples[at].moment));
            let weights = from.iter().zip(to).zip(between).zip(&basis.shapes);
            weights.map(|(((from, to), between), shape)| (from + (to - from) * part - between).abs() * shape.peak).sum::<f32>()
        };
        thin(times.len(), error * THINNING, &off).into_iter().map(|at| (times[at], samples[at].moment)).collect()
    });
    let keys = keys.collect();
    AnimatedShapes { basis, keys }
}

/// Poses surfaces, each thread with buffers of its own.
struct Poser<'a, S: MovingSurfaces> {
    surfaces: &'a S,
    pool: Mutex<Vec<S::Scratch>>,
    /// Moments posed so far.
    count: usize,
    /// How many are posed before they go into the builders.
    together: usize,
}

impl<S: MovingSurfaces> Poser<'_, S> {
    fn at(&self, range: usize, at: f64) -> Vec<Displacements> {
        let known = self.pool.lock().unwrap_or_else(PoisonError::into_inner).pop();
        let mut scratch = known.unwrap_or_default();
        let posed = self.surfaces.pose(range, at, &mut scratch);
        self.pool.lock().unwrap_or_else(PoisonError::into_inner).push(scratch);
        posed
    }
}

/// How many threads to use here.
pub(super) fn thread_count() -> usize {
    thread::available_parallelism().map_or(1, NonZero::get).min(MAX_THREADS)
}

/// Does the work for each item, on so many threads or on fewer where the system gives none.
fn in_parallel<T: Send>(items: &mut [T], threads: usize, work: impl Fn(&mut T) + Sync) {
    let helpers = threads.min(items.len()).saturating_sub(1);
    let open = Mutex::new(items.iter_mut());
    let run = || {
        loop {
            let next = open.lock().unwrap_or_else(PoisonError::into_inner).next();
            match next {
                Some(item) => work(item),
                None => return,
            }
        }
    };
    thread::scope(|scope| {
        for _ in 0..helpers {
            // Without a helper this thread does its work as well.
            drop(thread::Builder::new().spawn_scoped(scope, run));
        }
        run();
    });
}

#[cfg(test)]
mod tests;

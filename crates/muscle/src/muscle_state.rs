//! Contraction and elbow angle: one state seen two ways, each the exact inverse of the other.

use super::MuscleState;
use super::profile::SHORTEST;

/// Longest and shortest length of a muscle that no arm drives, as shares of its length at rest.
pub(super) const FREE: [f64; 2] = [2.5, SHORTEST];

/// How an arm drives its first muscle: angles and the lengths at both ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct LengthRange {
    /// Least and greatest flexion, degrees.
    pub flexion: [f64; 2],
    /// Length of the line of action at these two.
    pub lengths: [f64; 2],
    /// Whether the length changes in one direction only over the range. Where it doesn't, contraction follows the angle itself.
    pub monotone: bool,
}

impl LengthRange {
    /// Looks at `length` over a range of angles.
    pub(super) fn new(flexion: [f64; 2], length: impl Fn(f64) -> f64) -> Self {
        const STEPS: usize = 64;
        let at = |step: usize| length(flexion[0] + (flexion[1] - flexion[0]) * step as f64 / STEPS as f64);
        let lengths = [at(0), at(STEPS)];
        let falling = lengths[1] < lengths[0];
        let all: Vec<f64> = (0..=STEPS).map(at).collect();
        let monotone = lengths[0] != lengths[1] && all.windows(2).all(|pair| (pair[1] < pair[0]) == falling && pair[0] != pair[1]);
        Self { flexion, lengths, monotone }
    }

    /// The state at this flexion, held within the range.
    pub(super) fn at_flexion(&self, degrees: f64, length: impl Fn(f64) -> f64) -> MuscleState {
        let [low, high] = self.flexion;
        let flexion = if degrees.is_nan() { low } else { degrees.clamp(low, high) };
        MuscleState { flexion, contraction: 100.0 * self.share(flexion, &length) }
    }

    /// The state at this contraction, held within 0 to 100.
    pub(super) fn at_contraction(&self, per_cent: f64, length: impl Fn(f64) -> f64) -> MuscleState {
        let contraction = if per_cent.is_nan() { 0.0 } else { per_cent.clamp(0.0, 100.0) };
        let wanted = contraction / 100.0;
        let [low, high] = self.flexion;
        let (first, last) = (self.share(low, &length), self.share(high, &length));
        // Whole per cents at the ends give the ends of the range, not a rounding beside them.
        if wanted == first {
            return MuscleState { flexion: low, contraction };
        }
        if wanted == last {
            return MuscleState { flexion: high, contraction };
        }
        // The share is monotone: halve the range until the numbers have no middle.
        let rising = last > first;
        let (mut below, mut above) = if rising { (low, high) } else { (high, low) };
        for _ in 0..200 {
            let middle = 0.5 * (below + above);
            if middle == below || middle == above {
                break;
            }
            if self.share(middle, &length) < wanted { below = middle } else { above = middle }
        }
        let miss = |angle: f64| (self.share(angle, &length) - wanted).abs();
        MuscleState { flexion: if miss(below) < miss(above) { below } else { above }, contraction }
    }

    /// Contraction from 0 to 1.
    fn share(&self, flexion: f64, length: &impl Fn(f64) -> f64) -> f64 {
        let (from, to, value) = if self.monotone {
            (self.lengths[0].max(self.lengths[1]), self.lengths[0].min(self.lengths[1]), length(flexion))
        } else {
            (self.flexion[0], self.flexion[1], flexion)
        };
        if from == to { 0.0 } else { ((value - from) / (to - from)).clamp(0.0, 1.0) }
    }
}

/// The first stretch of `range` (degrees) in which `fits` holds, its limits found by halving; all of it where it holds nowhere.
pub(super) fn valid_part(range: [f64; 2], fits: impl Fn(f64) -> bool) -> [f64; 2] {
    const STEPS: usize = 300;
    let angle = |step: usize| range[0] + (range[1] - range[0]) * step as f64 / STEPS as f64;
    let all: Vec<bool> = (0..=STEPS).map(|step| fits(angle(step))).collect();
    let Some(first) = all.iter().position(|fits| *fits) else { return range };
    let last = all.iter().skip(first).position(|fits| !fits).map_or(STEPS, |count| first + count - 1);
    // Between a step that fits and its neighbour that doesn't.
    let limit = |mut inside: f64, mut outside: f64| {
        for _ in 0..60 {
            let middle = 0.5 * (inside + outside);
            if fits(middle) { inside = middle } else { outside = middle }
        }
        inside
    };
    let low = if first == 0 { range[0] } else { limit(angle(first), angle(first - 1)) };
    let high = if last == STEPS { range[1] } else { limit(angle(last), angle(last + 1)) };
    [low, high]
}

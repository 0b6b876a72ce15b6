//! The volume-conserving profile: radii along a muscle, and the quadratic that says how they grow when it shortens.
//!
//! Nodes `i = 1..n` stand at equal spacing `Δx = L / (n − 1)`, each with a radius `rᵢ` and a growth multiplier `mᵢ`; between neighbours lies a
//! truncated cone. The volume is `V = π Δx F(r)` with
//!
//! ```text
//! F(r) = Σ (rᵢ² + rᵢ rᵢ₊₁ + rᵢ₊₁²) / 3
//! ```
//!
//! When the length goes from `L` to `L′`, every radius goes to `r′ᵢ = rᵢ + mᵢ δ`. Equal volumes make a quadratic in `δ`:
//!
//! ```text
//! A δ² + B δ + C = 0
//! A = Σ (mᵢ² + mᵢ mᵢ₊₁ + mᵢ₊₁²) / 3
//! B = Σ (2 rᵢ mᵢ + rᵢ mᵢ₊₁ + rᵢ₊₁ mᵢ + 2 rᵢ₊₁ mᵢ₊₁) / 3
//! C = F(r) (1 − L / L′)
//! ```
//!
//! Of its roots the one that goes to 0 as `L′ → L` is taken, in the form that does not cancel: `δ = −2C / (B ± √(B² − 4AC))` with the sign of
//! `B`. A profile is always solved from its rest shape, so the result depends on `L′` alone and never on the way there.

use std::f64::consts::PI;
use std::ops::RangeInclusive;

use super::Solved;
use super::measured_shapes::{Pose, Poses};
use sinew_scene::limits;
use sinew_scene::message;
use sinew_scene::message::{Message, ToMessage};

/// How far from rest a length may grow at all, as a factor; profiles that could go on for ever stop here.
const REACH: f64 = 100.0;
/// The shortest that a belly gets, as a share of its length at rest: no muscle contracts further, and what keeps its volume would become a pancake.
pub(super) const SHORTEST: f64 = 0.4;
/// What is left of a radius, as a share of itself, where it would reach zero.
const SLIVER: f64 = 1e-9;

/// Why numbers make no muscle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("{}", self.message())]
pub enum ProfileError {
    /// Fewer than two nodes.
    TooFewNodes(usize),
    /// More nodes than [`limits::MUSCLE_NODES`].
    TooManyNodes(usize),
    /// Another number of radii than of growth multipliers.
    LengthsDiffer {
        /// Number of radii.
        radii: usize,
        /// Number of growth multipliers.
        growth: usize,
    },
    /// A radius (index from 0) that is negative or no number.
    BadRadius(usize),
    /// A growth multiplier (index from 0) that is no number.
    BadGrowth(usize),
    /// A rest length that is not above zero.
    BadLength,
    /// All radii zero: there is no volume to keep.
    NoRadius,
    /// All growth multipliers zero: the volume cannot be kept.
    NoGrowth,
    /// More poses than [`limits::MUSCLE_POSES`].
    TooManyPoses(usize),
    /// A pose (index from 0) with another number of radii than the first.
    PoseNodes {
        /// The pose, from 0.
        pose: usize,
        /// Number of its radii.
        nodes: usize,
        /// Number of the first one's.
        wanted: usize,
    },
    /// A pose (index from 0) at a length that is not above zero.
    PoseLength(usize),
    /// Two poses, this and the next in the order of the lengths, at one length.
    PosesCoincide(usize),
}

impl ToMessage for ProfileError {
    fn message(&self) -> Message {
        match self {
            Self::TooFewNodes(count) => message!("muscle-too-few-nodes", count = count),
            Self::TooManyNodes(count) => message!("muscle-too-many-nodes", count = count, limit = limits::MUSCLE_NODES),
            Self::LengthsDiffer { radii, growth } => message!("muscle-lengths-differ", radii = radii, growth = growth),
            Self::BadRadius(node) => message!("muscle-bad-radius", node = node + 1),
            Self::BadGrowth(node) => message!("muscle-bad-growth", node = node + 1),
            Self::BadLength => message!("muscle-bad-length"),
            Self::NoRadius => message!("muscle-no-radius"),
            Self::NoGrowth => message!("muscle-no-growth"),
            Self::TooManyPoses(count) => message!("muscle-too-many-poses", count = count, limit = limits::MUSCLE_POSES),
            Self::PoseNodes { pose, nodes, wanted } => message!("muscle-pose-nodes", pose = pose + 1, nodes = nodes, wanted = wanted),
            Self::PoseLength(pose) => message!("muscle-pose-length", pose = pose + 1),
            Self::PosesCoincide(_) => message!("muscle-poses-coincide"),
        }
    }
}

/// What sets a limit of the length.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LimitCause {
    /// The discriminant reaches 0: beyond it no radii have the volume.
    Discriminant,
    /// The radius of this node, counted from 0, reaches 0.
    Radius(usize),
    /// Neither, up to a hundred times longer than at rest, where this program stops.
    Reach,
    /// It is 40 % of the length at rest, and no belly gets shorter.
    Shortest,
}

/// A limit of the length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limit {
    /// The length.
    pub length: f64,
    /// What sets it.
    pub cause: LimitCause,
}

/// Largest magnitude of a radius, growth or length: beyond it squares would leave the range of `f64`.
pub(super) const LARGEST: f64 = 1e12;

/// A muscle's shape at rest, checked, with everything about the quadratic that does not change with the length.
///
/// Nodes `i = 1..n` stand at equal spacing `Δx = L / (n − 1)`, each with a radius `rᵢ` and a growth multiplier `mᵢ`; between neighbours lies a
/// truncated cone. The volume is `V = π Δx F(r)` with
///
/// ```text
/// F(r) = Σ (rᵢ² + rᵢ rᵢ₊₁ + rᵢ₊₁²) / 3
/// ```
///
/// When the length goes from `L` to `L′`, every radius goes to `r′ᵢ = rᵢ + mᵢ δ`. Equal volumes make a quadratic in `δ`:
///
/// ```text
/// A δ² + B δ + C = 0
/// A = Σ (mᵢ² + mᵢ mᵢ₊₁ + mᵢ₊₁²) / 3
/// B = Σ (2 rᵢ mᵢ + rᵢ mᵢ₊₁ + rᵢ₊₁ mᵢ + 2 rᵢ₊₁ mᵢ₊₁) / 3
/// C = F(r) (1 − L / L′)
/// ```
///
/// Of its roots the one that goes to 0 as `L′ → L` is taken, in the form that does not cancel: `δ = −2C / (B ± √(B² − 4AC))` with the sign of
/// `B`. A profile is always solved from its rest shape, so the result depends on `L′` alone and never on the way there.
#[derive(Debug, Clone, PartialEq)]
pub struct Profile {
    radii: Vec<f64>,
    growth: Vec<f64>,
    length: f64,
    /// A, B and F(r) at rest.
    a: f64,
    b: f64,
    f: f64,
    /// The shortest and the longest valid length.
    limits: [Limit; 2],
    /// Radii at several lengths, which take the place of growth multipliers.
    poses: Option<Box<Poses>>,
}

impl Profile {
    /// A profile of these radii (≥ 0), growth multipliers (any sign) and rest length (> 0), all in one unit.
    ///
    /// # Errors
    /// [`ProfileError`] where the numbers make no muscle that can keep its volume.
    pub fn new(radii: Vec<f64>, growth: Vec<f64>, length: f64) -> Result<Self, ProfileError> {
        if radii.len() != growth.len() {
            return Err(ProfileError::LengthsDiffer { radii: radii.len(), growth: growth.len() });
        }
        if radii.len() < 2 {
            return Err(ProfileError::TooFewNodes(radii.len()));
        }
        if radii.len() > limits::MUSCLE_NODES {
            return Err(ProfileError::TooManyNodes(radii.len()));
        }
        if let Some(node) = radii.iter().position(|r| !(0.0..=LARGEST).contains(r)) {
            return Err(ProfileError::BadRadius(node));
        }
        if let Some(node) = growth.iter().position(|m| m.is_nan() || m.abs() > LARGEST) {
            return Err(ProfileError::BadGrowth(node));
        }
        if !(length > 0.0 && length <= LARGEST) {
            return Err(ProfileError::BadLength);
        }
        let (a, b, f) = (cone_sum(&growth), mixed_sum(&radii, &growth), cone_sum(&radii));
        if f < f64::MIN_POSITIVE {
            return Err(ProfileError::NoRadius);
        }
        if a < f64::MIN_POSITIVE {
            return Err(ProfileError::NoGrowth);
        }
        let mut profile = Self { radii, growth, length, a, b, f, limits: [Limit { length, cause: LimitCause::Reach }; 2], poses: None };
        profile.limits = profile.find_limits();
        Ok(profile)
    }

    /// A profile of measured poses (see `muscle::poses`) with this rest length; its volume is that of the blended radii there.
    ///
    /// # Errors
    /// [`ProfileError`] where the numbers make no muscle.
    pub fn of_poses(poses: Vec<Pose>, length: f64) -> Result<Self, ProfileError> {
        let poses = Poses::new(poses)?;
        let mut radii = Vec::new();
        poses.shape_into(length, &mut radii);
        // Blended radii scale as a whole: each is its own multiplier.
        let mut profile = Self::new(radii.clone(), radii, length)?;
        let limit = |length, cause| Limit { length, cause };
        profile.limits = [limit(length * SHORTEST, LimitCause::Shortest), limit(length * REACH, LimitCause::Reach)];
        profile.poses = Some(Box::new(poses));
        Ok(profile)
    }

    /// The same muscle with all lengths multiplied by `scale`.
    pub(super) fn scaled(&self, scale: f64) -> Self {
        let times = |values: &[f64]| values.iter().map(|value| value * scale).collect::<Vec<_>>();
        // Multipliers that stand for radii are lengths as well.
        let growth = if self.is_posed() { scale } else { 1.0 };
        Self {
            radii: times(&self.radii),
            growth: self.growth.iter().map(|value| value * growth).collect(),
            length: self.length * scale,
            a: self.a * growth * growth,
            b: self.b * growth * scale,
            f: self.f * scale * scale,
            limits: self.limits.map(|limit| Limit { length: limit.length * scale, ..limit }),
            poses: self.poses.as_ref().map(|poses| Box::new(poses.scaled(scale))),
        }
    }

    /// Whether the radii come from measured poses, not from growth multipliers.
    pub fn is_posed(&self) -> bool {
        self.poses.is_some()
    }

    /// Radii at rest.
    pub fn radii(&self) -> &[f64] {
        &self.radii
    }

    /// Growth multipliers; of a profile of poses, the radii at rest.
    pub fn growth(&self) -> &[f64] {
        &self.growth
    }

    /// Length at rest.
    pub fn rest_length(&self) -> f64 {
        self.length
    }

    /// Volume at rest, which is the volume at every valid length.
    pub fn volume(&self) -> f64 {
        PI * self.spacing(self.length) * self.f
    }

    /// The lengths at which the discriminant is not negative and every radius stays above zero, from 40 % of the rest length on; that lies within. A node
    /// whose radius is zero at rest may stay at zero.
    pub fn length_range(&self) -> RangeInclusive<f64> {
        self.limits[0].length..=self.limits[1].length
    }

    /// The ends of [`Profile::length_range`], the shortest length first, and what sets each.
    pub fn limits(&self) -> [Limit; 2] {
        self.limits
    }

    /// Solves for `length`, held within [`Profile::length_range`]; a length that is no number counts as the rest length, held.
    pub fn solve(&self, length: f64) -> Solved {
        let mut solved = Solved::default();
        self.solve_into(length, &mut solved);
        solved
    }

    /// [`Profile::solve`] into a value whose buffer is kept.
    pub fn solve_into(&self, asked: f64, solved: &mut Solved) {
        let length = if asked.is_nan() { self.length } else { asked.clamp(self.limits[0].length, self.limits[1].length) };
        let (a, b, c) = match &self.poses {
            None => (self.a, self.b, self.f * ((length - self.length) / length)),
            Some(poses) => {
                poses.shape_into(length, &mut solved.radii);
                let f = cone_sum(&solved.radii);
                (f, 2.0 * f, f - self.f * (self.length / length))
            }
        };
        // The limit of the range is where it vanishes; rounding must not push it below.
        let discriminant = (b * b - 4.0 * a * c).max(0.0);
        let root = discriminant.sqrt();
        let (near, far) = if b >= 0.0 { (b + root, (-b - root) / (2.0 * a)) } else { (b - root, (-b + root) / (2.0 * a)) };
        let mut delta = if near == 0.0 { 0.0 } else { -2.0 * c / near };
        // One Newton step takes away what the square root rounded off; at the double root there is no slope to follow.
        let slope = 2.0 * a * delta + b;
        if slope.abs() > 1e-6 * b.abs().max(root) {
            delta -= ((a * delta + b) * delta + c) / slope;
        }
        if self.poses.is_some() {
            solved.radii.iter_mut().for_each(|r| *r += *r * delta);
        } else {
            solved.radii.clear();
            // A radius that a limit of the range brings to zero must not round to below it.
            solved.radii.extend(self.radii.iter().zip(&self.growth).map(|(r, m)| (r + m * delta).max(SLIVER * 0.5 * r)));
        }
        solved.length = length;
        solved.path_length = length;
        solved.held = length != asked;
        solved.delta = delta;
        solved.quadratic = [a, b, c];
        solved.discriminant = discriminant;
        solved.roots = [delta, far];
        solved.volume = PI * self.spacing(length) * cone_sum(&solved.radii);
        solved.volume_error = solved.volume / self.volume() - 1.0;
    }

    fn spacing(&self, length: f64) -> f64 {
        length / (self.radii.len() - 1) as f64
    }

    /// The length at which the radii have changed by `delta`: `L F(r) / F(r + m δ)`.
    fn length_at(&self, delta: f64) -> f64 {
        self.length * self.f / ((self.a * delta + self.b) * delta + self.f)
    }

    /// Along the branch of the root through δ = 0 the length is monotone in δ, so the limits on δ (the double root at −B / 2A, and each radius's
    /// zero at −rᵢ / mᵢ) give the limits on the length.
    fn find_limits(&self) -> [Limit; 2] {
        let none = LimitCause::Reach;
        let (mut low, mut high) = ((f64::NEG_INFINITY, none), (f64::INFINITY, none));
        for (node, (&r, &m)) in self.radii.iter().zip(&self.growth).enumerate() {
            let zero = -r * (1.0 - SLIVER) / m;
            if m > 0.0 && zero > low.0 {
                low = (zero, LimitCause::Radius(node));
            } else if m < 0.0 && zero < high.0 {
                high = (zero, LimitCause::Radius(node));
            }
        }
        let double = -self.b / (2.0 * self.a);
        if self.b >= 0.0 && double > low.0 {
            low = (double, LimitCause::Discriminant);
        } else if self.b < 0.0 && double < high.0 {
            high = (double, LimitCause::Discriminant);
        }
        // Zero lies between the two, so the rest length lies between their lengths.
        let ends = [low, high].map(|(delta, cause)| (if delta.is_finite() { self.length_at(delta) } else { 0.0 }, cause));
        let (short, long) = if self.b >= 0.0 { (ends[1], ends[0]) } else { (ends[0], ends[1]) };
        let limit = |length: f64, cause, least: f64, most: f64, beyond| {
            let held = length.clamp(least, most);
            Limit { length: held, cause: if held == length { cause } else { beyond } }
        };
        let short_length = if short.0.is_finite() { short.0 } else { 0.0 };
        let long_length = if long.0.is_nan() { self.length } else { long.0 };
        [
            limit(short_length, short.1, self.length * SHORTEST, self.length, LimitCause::Shortest),
            limit(long_length, long.1, self.length, self.length * REACH, none),
        ]
    }
}

/// `F` of a list: Σ (xᵢ² + xᵢ xᵢ₊₁ + xᵢ₊₁²) / 3.
pub(super) fn cone_sum(values: &[f64]) -> f64 {
    values.windows(2).map(|pair| pair[0] * pair[0] + pair[0] * pair[1] + pair[1] * pair[1]).sum::<f64>() / 3.0
}

/// `B`: Σ (2 rᵢ mᵢ + rᵢ mᵢ₊₁ + rᵢ₊₁ mᵢ + 2 rᵢ₊₁ mᵢ₊₁) / 3.
pub(super) fn mixed_sum(r: &[f64], m: &[f64]) -> f64 {
    let pairs = r.windows(2).zip(m.windows(2));
    pairs.map(|(r, m)| 2.0 * r[0] * m[0] + r[0] * m[1] + r[1] * m[0] + 2.0 * r[1] * m[1]).sum::<f64>() / 3.0
}

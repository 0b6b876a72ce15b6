//! The numbers behind one solution, laid open: what the quadratic was, which of its roots was taken and why, and what limits the length.

use super::Solved;
use super::profile::{Limit, Profile};

/// Which of the two roots was taken. It is always the one that goes to 0 as the length goes to that at rest; which of the two that is, the sign of B
/// decides.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Root {
    /// The larger: B is not negative.
    Larger,
    /// The smaller: B is negative, as with mostly negative growth. The larger one is another shape.
    Smaller,
    /// Both are the same: the discriminant is 0, and the length is at a limit.
    Double,
}

/// Everything that a student needs to see why a muscle bulges. Lengths are in the file's unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SolverReport {
    /// L, after holding it within the limits; tendons left out.
    pub length: f64,
    /// L₀.
    pub rest_length: f64,
    /// From origin to insertion, tendons counted, before any holding.
    pub path_length: f64,
    /// V.
    pub volume: f64,
    /// V₀.
    pub rest_volume: f64,
    /// V / V₀ − 1.
    pub volume_error: f64,
    /// δ.
    pub delta: f64,
    /// A, B and C.
    pub quadratic: [f64; 3],
    /// B² − 4 A C.
    pub discriminant: f64,
    /// Both roots; the first was taken.
    pub roots: [f64; 2],
    /// Which of the two that is.
    pub taken: Root,
    /// The shortest and the longest valid length, with what sets each.
    pub limits: [Limit; 2],
    /// The limit that holds the length: 0 = shortest, 1 = longest.
    pub held_at: Option<usize>,
    /// Largest radius.
    pub largest_radius: f64,
    /// Node that has it, from 0.
    pub largest_node: usize,
    /// −dL/dφ in the pose; `None` where no joint turns the muscle.
    pub moment_arm: Option<f64>,
}

impl SolverReport {
    /// For a solution of `profile`.
    pub fn new(profile: &Profile, solved: &Solved, moment_arm: Option<f64>) -> Self {
        let limits = profile.limits();
        let (largest_node, largest_radius) =
            solved.radii.iter().enumerate().fold((0, 0.0), |most, (node, radius)| if *radius > most.1 { (node, *radius) } else { most });
        // Negative zero says nothing that zero does not.
        let plain = |value: f64| value + 0.0;
        Self {
            length: solved.length,
            rest_length: profile.rest_length(),
            path_length: solved.path_length,
            volume: solved.volume,
            rest_volume: profile.volume(),
            volume_error: plain(solved.volume_error),
            delta: plain(solved.delta),
            quadratic: solved.quadratic.map(plain),
            discriminant: plain(solved.discriminant),
            roots: solved.roots.map(plain),
            taken: match solved.roots {
                [near, far] if near == far => Root::Double,
                [near, far] if near > far => Root::Larger,
                _ => Root::Smaller,
            },
            limits,
            held_at: solved.held.then(|| usize::from(solved.length >= profile.rest_length())),
            largest_radius,
            largest_node,
            moment_arm: moment_arm.map(plain),
        }
    }
}

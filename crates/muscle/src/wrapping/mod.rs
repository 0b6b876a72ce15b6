//! Shortest paths over wrap surfaces.
mod banded;
mod cylinder;
mod dual;
mod ellipsoid;
mod geodesic;
mod guess;
mod newton;
mod path;
mod shape;
mod solution;
mod sphere;
mod stretch;
mod surface;
#[cfg(test)]
mod tests;
mod torus;
mod yielding;

pub use path::PathSolver;
pub use solution::{Arc, InsidePoint, Segment, Solution, Status, Stretch};
pub use surface::{PathPoint, Side, Surface, WrapSurface};

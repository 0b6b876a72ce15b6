//! Shortest paths over several wrap surfaces: their lengths, how these change with the pose, and what there is to draw.
//!
//! Pure geometry in `f64`, in any unit of length. A path runs through points, each on a body, and round surfaces, each on a body; the caller places them in
//! the world for every pose, and a [`PathSolver`] finds the path.
//!
//! ```
//! use glam::{DQuat, DVec3};
//! use sinew_muscle::wrapping::{PathPoint, PathSolver, Side, Surface, WrapSurface};
//!
//! let points = [
//!     PathPoint { body: 0, position: DVec3::new(-3.0, 0.0, 0.0) },
//!     PathPoint { body: 1, position: DVec3::new(3.0, 0.0, 0.0) },
//! ];
//! let sphere = WrapSurface {
//!     surface: Surface::Sphere { radius: 1.0 },
//!     body: 0,
//!     rotation: DQuat::IDENTITY,
//!     center: DVec3::ZERO,
//!     side: Side::PlusY,
//!     stretches: 0..1,
//! };
//! let mut solver = PathSolver::new();
//! let solution = solver.solve(&points, &[sphere]);
//! // Two tangents, and between them the arc that they leave of half a circle.
//! let exact = 2.0 * 8.0_f64.sqrt() + 2.0 * (1.0_f64 / 3.0).asin();
//! assert!((solution.length - exact).abs() < 1e-12);
//!
//! // Body 1 turns about the centre: the moment arm is the radius.
//! let turning = |body: usize, point: DVec3| if body == 1 { DVec3::Z.cross(point) } else { DVec3::ZERO };
//! assert!((-solution.length_rate(turning) - 1.0).abs() < 1e-12);
//! # Ok::<(), ()>(())
//! ```
//!
//! # How a path is found
//!
//! A shortest path is straight in the air and a geodesic on a surface, and where the two meet it has no corner. On one sphere that is a great circle between two
//! tangents, on one cylinder a helix: closed forms. For all else Newton's method looks for it, for all surfaces of a stretch at once, after
//! U. Scholz, M. Sherman, I. Stavness, S. Delp and A. Kecskeméthy, *A fast multi-obstacle muscle wrapping method using natural geodesic variations*,
//! Multibody System Dynamics 36 (2016).
//!
//! 1. Each surface *yields* to the two points of the stretch where it could not hold the path: see below.
//! 2. *Estimates* of the arcs by closed forms follow one another along the stretch until they settle; a surface that the straight line clears has none. Their
//!    plane sections of an ellipsoid touch it exactly when the path does.
//! 3. Every surface that acts has a *geodesic*, given by where it starts, in which direction, and how long it is: four unknowns. It is integrated as an ordinary
//!    differential equation of order 8, together with its two Jacobi fields, which say how its end moves when its start is shifted or turned. The *path error* is
//!    what the straight segments, as directions, have along normal and binormal at both contact points: four equations. A step of Newton's method solves
//!    the block-tridiagonal system; a step that makes the error larger is halved.
//! 4. A geodesic whose length has become negative belongs to a surface that has *lifted off*; one that a straight segment runs into has been *touched down* on.
//!    Either changes who acts, and Newton's method runs again. At the change itself the geodesic is a point, so that length and moment arm go on without a
//!    jump.
//! 5. Where that fails, all surfaces grow from a fifth of their size to the whole, each solution the start of the next. The number of geodesics that are tried is
//!    bounded (a tenth of a second or two at the very most); what has not converged then is a path round the surfaces all the same, marked [`Status::NotConverged`].
//!
//! Without a side there is a choice of ways, and step 3 finds one of the locally shortest. A single ellipsoid is tried on four sides of the straight line.
//! Several surfaces are tried on six sides of it, and each the other way; the shortest wins. That takes its time (give a side where one is known), and
//! of several elongated ellipsoids it may still miss the shortest path, so that the length can jump where another way becomes the shorter.
//!
//! Surfaces with *opposite* sides on one stretch, which the path passes in bends, are solved too, but how far they yield is judged by the straight line
//! from end to end, and not by the bends. Where that line leaves their sides, spheres and ellipsoids may let the length jump, or not converge. A via point
//! between two such surfaces makes two stretches of them, and each is judged by itself.
//!
//! # What a surface does to a path that it cannot hold
//!
//! With a [`Side`] a path stays on that side of the surface when the straight line passes on the other. A sphere or an ellipsoid would let it slip off
//! sideways; so the surface is drawn out, as far as a cylinder, along the direction in which the path would slip. How far it is depends on the straight line
//! from one point of the stretch to the next alone, and continuously; while that line passes on the surface's side (of an ellipsoid, not more than 45° off it),
//! the surface is what was given and the path the shortest. A point inside of a surface makes it smaller for that stretch, so that the point lies on it; it is reported
//! ([`Solution::inside`]). The file `yielding.rs` has the formulas.
//!
//! Three things no rule can make continuous: an end that crosses the half-plane behind a cylinder with a side, where the path leaves on one hand or the other
//! (near it the surface gives way, over half its radius); an end of a torus' stretch that crosses the plane of its ring outside of the hole; and the order of
//! surfaces, if they are moved past one another.
//!
//! # The derivative
//!
//! As a shortest path does not change its length, to first order, when contact points slide on their surfaces, dL/dt = Σ e·(v_end − v_start) over the straight
//! segments, each contact point moving with its surface's body; a surface that yields adds ∫ κ v ds, its normal curvature along the path times the speed at which
//! it moves along its normal. [`Solution::length_rate`] computes both. A moment arm about any joint is its negative for the velocities of a turn by 1 rad/s.
//!
//! # Where what is
//!
//! | file | what it holds |
//! |---|---|
//! | `surface` | surfaces, sides and path points as a caller gives them |
//! | `path` | the solver of a path |
//! | `solution` | lengths, segments, arcs, the derivative |
//! | `stretch` | which surfaces act on a stretch, and which way round |
//! | `newton`, `banded` | path error, Jacobian, steps; the linear equations |
//! | `geodesic` | geodesics and Jacobi fields as an initial value problem |
//! | `shape` | normals, curvatures and geodesics of all shapes |
//! | `sphere`, `cylinder`, `ellipsoid`, `torus` | the formulas of each |
//! | `touch` | an arc as closed forms give it |
//! | `yielding`, `dual` | surfaces that give way, and numbers with derivatives |

mod banded;
mod cylinder;
mod dual;
mod ellipsoid;
mod geodesic;
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
mod touch;
mod yielding;

pub use path::PathSolver;
pub use solution::{Arc, InsidePoint, Segment, Solution, Status, Stretch};
pub use surface::{PathPoint, Side, Surface, WrapSurface};

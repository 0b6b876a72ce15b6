//! Keeps a belly off the rods of the arm: where the drawn centre line begins and ends, and how far the elbow bends before flesh meets bone.

use glam::DVec3;

use super::arm::{Arm, ELBOW, FULL_FLEXION};
use super::centerline::Centerline;
use super::line_of_action::{CenterlineOffset, Frames, Line, Point};
use super::profile::Profile;
use super::revolute_joint::RevoluteJoint;
use super::{Solved, Tendon};

/// Flexion that a muscle never stops short of, degrees, however thick it is.
const FREE_FLEXION: f64 = 120.0;
/// Slides of the ends towards the elbow that are tried, as shares of the length at rest, both ends together.
const SLIDES: [f64; 9] = [0.0, 0.005, 0.01, 0.015, 0.02, 0.03, 0.04, 0.05, 0.07];
/// How deep an end may lie in its own rod, as a share of its radius.
const TOUCH: f64 = 0.08;

/// What was found for one muscle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ClearanceResult {
    /// Ends and side of the drawn centre line.
    pub drawn: CenterlineOffset,
    /// The greatest flexion at which it stays clear of the rods, degrees.
    pub flexion: f64,
}

/// Finds the drawn ends of a muscle on the arm that bends through `range` (degrees).
///
/// The ends lie beside the line of action's own, out on the rods' surfaces by the thickness of rod and muscle, and slid towards the elbow. Without
/// a slide the straight arm would leave no length for an arch; with more than needed the belly stands off when the arm is bent. So the smallest
/// slide is taken that keeps clear up to the greatest angle.
pub(super) fn fit(arm: &Arm, line: &Line, profile: &Profile, tendons: &[Tendon; 2], range: [f64; 2]) -> ClearanceResult {
    let revolute = RevoluteJoint::elbow(arm, range);
    let side = flexor_side(&revolute, line);
    let end_radius = |end: usize, radius: Option<&f64>| {
        if tendons[end].length > 0.0 { tendons[end].radius } else { radius.copied().unwrap_or(0.0) }
    };
    let lift = [end_radius(0, profile.radii().first()), end_radius(1, profile.radii().last())].map(|radius| radius + arm.thickness);
    // The line of action is the same for all ends that are tried.
    let angles = (0..).map(|step| range[0] + 5.0 * f64::from(step)).take_while(|angle| *angle <= range[1] + 1e-9);
    let lengths: Vec<(f64, f64)> = angles.map(|angle| (angle, line.length(&revolute.at(angle)))).collect();
    let mut best: Option<(f64, CenterlineOffset)> = None;
    let mut solved = Solved::default();
    // At the insertion, near the elbow, a slide brings the end to the other rod sooner, so it is tried second.
    for (slide, share) in SLIDES.into_iter().flat_map(|slide| [(slide, [1.0, 0.0]), (slide, [0.5, 0.5])]) {
        let slides = share.map(|share| share * slide * profile.rest_length());
        let ends = [(line.origin, lift[0], slides[0]), (line.insertion, lift[1], slides[1])].map(|(point, lift, slide)| {
            let slid = slid_towards_elbow(arm, point, slide);
            let out = DVec3::new(slid.local.x, 0.0, slid.local.z);
            if out.length() >= lift { point } else { Point { local: DVec3::new(side * lift, slid.local.y, 0.0), ..slid } }
        });
        let drawn = CenterlineOffset { ends, side: DVec3::X * side };
        let mut clear = f64::NEG_INFINITY;
        for (angle, length) in &lengths {
            if gap(arm, &revolute.at(*angle), *length, profile, tendons, &drawn, &mut solved) < 0.0 {
                break;
            }
            clear = *angle;
        }
        if best.is_none_or(|(reach, _)| clear > reach) {
            best = Some((clear, drawn));
        }
        if clear > range[1] - 5.0 {
            break;
        }
    }
    // `SLIDES` is not empty, so there is a best one.
    let (clear, drawn) = best.unwrap_or((range[1], CenterlineOffset { ends: [line.origin, line.insertion], side: DVec3::X * side }));
    let flexion = if clear > range[1] - 5.0 { range[1] } else { clear.max(FREE_FLEXION).min(range[1]) };
    ClearanceResult { drawn, flexion }
}

/// +1 for a muscle that shortens when the elbow bends, −1 for one that lengthens.
fn flexor_side(revolute: &RevoluteJoint, line: &Line) -> f64 {
    let middle = 0.5 * (revolute.range[0] + revolute.range[1]).min(FULL_FLEXION);
    if line.length(&revolute.at(middle + 30.0)) > line.length(&revolute.at(middle - 30.0)) { -1.0 } else { 1.0 }
}

/// Bone 0 hangs from the shoulder, bone 1 from the elbow; both point down.
fn slid_towards_elbow(arm: &Arm, point: Point, by: f64) -> Point {
    let mut local = point.local;
    if point.bone == 0 {
        let room = (arm.upper + local.y).max(0.0);
        local.y -= by.min(0.4 * room);
    } else {
        local.y += by.min(0.4 * (-local.y).max(0.0));
    }
    Point { local, ..point }
}

/// Least distance between the belly's surface and the rods; negative where it goes in.
fn gap(
    arm: &Arm,
    frames: &impl Frames,
    length: f64,
    profile: &Profile,
    tendons: &[Tendon; 2],
    drawn: &CenterlineOffset,
    solved: &mut Solved,
) -> f64 {
    let fixed = tendons[0].length + tendons[1].length;
    profile.solve_into(length - fixed, solved);
    let [start, end] = drawn.ends.map(|point| frames.place(point));
    if start.distance(end) > solved.length + fixed {
        return f64::NEG_INFINITY;
    }
    let mut path = Centerline::default();
    drawn.draw(frames, solved.length + fixed, &mut path);
    let elbow = arm.elbow();
    let [shoulder, wrist] = [frames.frame(0).w_axis.truncate(), frames.frame(1).transform_point3(DVec3::NEG_Y * arm.lower)];
    let rods = [(shoulder, elbow), (elbow, wrist)];
    let steps = (2 * solved.radii.len()).clamp(48, 96);
    let mut cursor = path.cursor();
    let mut least = f64::INFINITY;
    for step in 0..=steps {
        let at = path.length() * step as f64 / steps as f64;
        let radius = radius_along(solved, tendons, at);
        let centre = cursor.frame_at(at).position;
        for (bone, (from, to)) in rods.into_iter().enumerate() {
            // An end touches the rod that it is attached to: there a little is let pass, or rounding would decide.
            let attached = |end: usize, away: f64| drawn.ends[end].bone == bone && away < 2.5 * radius;
            let allowed = if attached(0, at) || attached(1, path.length() - at) { TOUCH * radius } else { 0.0 };
            least = least.min(distance(centre, from, to) - arm.thickness - radius + allowed);
        }
        least = least.min(centre.distance(elbow) - ELBOW * arm.thickness - radius);
    }
    least
}

/// Radius of the tendon or the belly at a length from the origin.
fn radius_along(solved: &Solved, tendons: &[Tendon; 2], at: f64) -> f64 {
    let inside = at - tendons[0].length;
    if inside < 0.0 {
        tendons[0].radius
    } else if inside > solved.length && tendons[1].length > 0.0 {
        tendons[1].radius
    } else {
        radius_at(&solved.radii, inside / solved.length)
    }
}

/// Radius at a share of the length between the nodes.
pub(super) fn radius_at(radii: &[f64], share: f64) -> f64 {
    let place = share.clamp(0.0, 1.0) * radii.len().saturating_sub(1) as f64;
    let node = (place as usize).min(radii.len().saturating_sub(2));
    let (a, b) = (radii.get(node).copied().unwrap_or(0.0), radii.get(node + 1).copied().unwrap_or(0.0));
    a + (b - a) * (place - node as f64)
}

fn distance(point: DVec3, from: DVec3, to: DVec3) -> f64 {
    let along = to - from;
    let share = ((point - from).dot(along) / along.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    point.distance(from + along * share)
}

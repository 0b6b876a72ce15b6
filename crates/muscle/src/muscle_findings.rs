//! What is wrong with a muscle over the range of its joint, or over a clip: found on the line of action and the profile, without any surface.

use glam::{DMat4, DVec3};

use super::bone_shape::BoneShape;
use super::centerline::Centerline;
use super::line_of_action::{Frames, Line, LineSolver};
use super::measure::{LineAtAngle, at_angle};
use super::muscle_rig::{Muscle, MuscleRig};
use super::profile::SHORTEST;
use super::revolute_joint::RevoluteJoint;
use super::wrapping::Status;
use super::{Finding, FoundAt, LinePoint, MomentArmAt, Solved};
use sinew_scene::diagnostics::Diagnostic;
use sinew_scene::{Graph, NodeId, NodeKind, OwnedLabel};

/// Angles at which all muscles of a file together are looked at, and the most and the fewest for one: so opening stays quick however many there are.
const ANGLES: usize = 2400;
const STEPS_PER_MUSCLE: std::ops::RangeInclusive<usize> = 12..=72;
/// A moment arm or a jump of the length below this share of the rest length is none.
const SMALL: f64 = 1e-3;
/// A belly in which more than this share of a bone's length lies goes through it, or is too thick.
const DEEP: f64 = 0.25;
/// Where a line passes a bone's axis nearer than this share of the belly's radius, and at so many of the places that are looked at, it goes through the bone
/// itself; else the belly is too thick.
const NEAR_AXIS: (f64, usize) = (0.25, 2);
/// A belly whose radius is above this share of the bone's length is too thick wherever it lies.
const THICK: f64 = 0.15;
/// A muscle on a clip that begins nearer than this share of its rest length to the axis of its bone is a scheme that tells no side.
const SCHEMATIC: f64 = 0.02;
/// A belly that comes further from the bone than at rest by more than this bow-strings, millimetres.
const BOW_STRING: f64 = 15.0;
/// Steps between two angles that are looked at for a jump, those in which most is missed.
const JUMPS: usize = 4;
/// A point that lies less deep in a wrap surface than this share of the rest length lies on it.
const INSIDE: f64 = 1e-7;
/// Least range of the joint in which a ball that is not touched is one that does nothing, degrees.
const LEAST_RANGE: f64 = 1.0;
/// Places along a bone, and along the belly, that are looked at.
const PLACES: usize = 24;

/// A muscle at one angle.
#[derive(Clone, Copy)]
struct AngleSample {
    angle: f64,
    length: f64,
    arm: f64,
}

/// What happens to a line at the wrap surfaces over all angles that are looked at.
struct WrapUse {
    /// For each surface whether the line lies on it.
    touched: Vec<bool>,
    /// For each the point that lies deepest in it, how deep, and at which angle.
    deepest: Vec<Option<(usize, f64, f64)>>,
    /// For each the angle at which the line lies beyond the end of a cylinder.
    beyond: Vec<Option<f64>>,
    /// The angle at which no shortest path was found.
    lost: Option<f64>,
}

impl WrapUse {
    fn new(line: &Line) -> Self {
        let count = line.wraps.len();
        Self { touched: vec![false; count], deepest: vec![None; count], beyond: vec![None; count], lost: None }
    }

    fn touch(&mut self, solver: &LineSolver) {
        for arc in solver.solution().arcs() {
            if let Some(touched) = self.touched.get_mut(arc.surface) {
                *touched = true;
            }
        }
    }

    fn see(&mut self, angle: f64, solver: &LineSolver) {
        let solution = solver.solution();
        if solution.status != Status::Converged {
            self.lost.get_or_insert(angle);
        }
        self.touch(solver);
        for arc in solution.arcs() {
            if let Some(beyond) = self.beyond.get_mut(arc.surface).filter(|_| arc.beyond_end) {
                beyond.get_or_insert(angle);
            }
        }
        for inside in solution.inside() {
            let Some(point) = solver.number_of(inside.point) else { continue };
            let Some(deepest) = self.deepest.get_mut(inside.surface) else { continue };
            if deepest.is_none_or(|(_, depth, _)| inside.depth > depth) {
                *deepest = Some((point, inside.depth, angle));
            }
        }
    }
}

/// How much of a bone lies inside a belly.
#[derive(Clone, Copy)]
struct BonePenetration {
    share: f64,
    bone: usize,
    /// Radius of the belly where the bone lies deepest in it.
    radius: f64,
    through: bool,
}

impl MuscleRig {
    /// Looks at all muscles over the range of the joint that measurements turn.
    pub(super) fn check_joint_range(&mut self, graph: &Graph) {
        let all: Vec<usize> = (0..self.muscles.len()).collect();
        self.check_over_joint(&all, graph);
    }

    /// Looks at all muscles at some moments of a clip: seconds, and one matrix a node.
    pub fn check_clip(&mut self, moments: &[(f64, Vec<DMat4>)]) {
        let all: Vec<usize> = (0..self.muscles.len()).collect();
        self.check_at_moments(&all, moments);
    }

    /// Looks again at muscles whose shape has changed, and puts what is found in place of what was found before.
    pub(super) fn check_again(&mut self, changed: &[usize], graph: &Graph, moments: &[(f64, Vec<DMat4>)]) {
        let muscles = &self.muscles;
        self.findings.retain(|found| !changed.iter().any(|index| found.element.as_label() == muscles[*index].label()));
        self.check_over_joint(changed, graph);
        self.check_at_moments(changed, moments);
    }

    fn check_over_joint(&mut self, muscles: &[usize], graph: &Graph) {
        let Some(revolute) = self.main_joint() else { return };
        let names: Vec<OwnedLabel> = self.bones.iter().map(|bone| graph.label(*bone).to_owned()).collect();
        let limbs = self.limbs(graph, revolute);
        let steps = (ANGLES / self.muscles.len().max(1)).clamp(*STEPS_PER_MUSCLE.start(), *STEPS_PER_MUSCLE.end());
        // What the file asks for, although the belly does not let the joint go so far.
        let asked = self.arm.as_ref().and_then(|(arm, _)| arm.flexion).unwrap_or(revolute.range);
        let mut findings = Vec::new();
        for muscle in muscles.iter().filter_map(|index| self.muscles.get(*index)) {
            let Some(line) = &muscle.line else { continue };
            let steps = if line.has_choices() { *STEPS_PER_MUSCLE.start() } else { steps };
            let (mut solver, mut wraps) = (LineSolver::default(), WrapUse::new(line));
            let mut sample = |angle: f64| {
                let sample = sample_at(revolute, line, angle, &mut solver);
                wraps.see(angle, &solver);
                sample
            };
            let samples: Vec<AngleSample> = (0..=steps).map(|step| sample(between(revolute.range, step, steps))).collect();
            let mut collector = FindingCollector {
                muscle,
                millimetres: 1e3 * self.unit,
                on_arm: self.arm.is_some(),
                is_lost: false,
                findings: &mut findings,
            };
            collector.is_lost = wraps.lost.is_some();
            self.touch_over_other_joints(line, &mut wraps);
            find_inert_wraps(&mut collector, revolute, line, &samples, &wraps);
            if !self.is_schematic(muscle, line) {
                find_bow_string(&mut collector, revolute, line, &samples, &self.bone_shapes);
            }
            check(collector, revolute, line, &samples, asked, &limbs, &names);
        }
        self.findings.append(&mut findings);
    }

    /// Notes the wrap surfaces that a line touches while another joint than the main one turns: surfaces at the shoulder say nothing at the elbow.
    fn touch_over_other_joints(&self, line: &Line, wraps: &mut WrapUse) {
        let mut solver = LineSolver::default();
        for joint in self.joints.iter().skip(1) {
            if wraps.touched.iter().all(|touched| *touched) {
                return;
            }
            let steps = *STEPS_PER_MUSCLE.start();
            for step in 0..=steps {
                sample_at(&joint.revolute, line, between(joint.revolute.range, step, steps), &mut solver);
                wraps.touch(&solver);
            }
        }
    }

    fn check_at_moments(&mut self, muscles: &[usize], moments: &[(f64, Vec<DMat4>)]) {
        let mut findings = Vec::new();
        for muscle in muscles.iter().filter_map(|index| self.muscles.get(*index)) {
            let Some(line) = &muscle.line else { continue };
            if self.findings.iter().any(|found| found.element.as_label() == muscle.label() && is_about_length(&found.finding)) {
                continue;
            }
            let lengths = moments.iter().map(|(time, world)| (*time, line.length(&self.frames(world))));
            let Some((time, length)) = lengths.min_by(|a, b| a.1.total_cmp(&b.1)) else { continue };
            let mut collector =
                FindingCollector { muscle, millimetres: 1e3 * self.unit, on_arm: false, is_lost: false, findings: &mut findings };
            collector.check_length(length, FoundAt::Time(time));
        }
        self.findings.append(&mut findings);
    }

    /// For each bone of the muscles the other end of its limb, in the axes that offsets on it are in; `None` where nothing follows it.
    fn limbs(&self, graph: &Graph, revolute: &RevoluteJoint) -> Vec<Option<DVec3>> {
        if let Some((arm, _)) = &self.arm {
            return vec![Some(DVec3::NEG_Y * arm.upper), Some(DVec3::NEG_Y * arm.lower)];
        }
        let mut rest = Vec::new();
        graph.world_from_local(&graph.rest_locals(), &mut rest);
        let from_world = self.frames(&rest).from_world;
        let place = |node: NodeId| rest.get(node.index()).map(|world| from_world.transform_point3(world.w_axis.truncate()));
        let tip = |(index, bone): (usize, &NodeId)| {
            let (about, here) = (graph.node(*bone), place(*bone)?);
            let follows = |node: &&NodeId| about.kind != NodeKind::Joint || graph.node(**node).kind == NodeKind::Joint;
            let tips = about.children().iter().filter(follows).filter_map(|child| place(*child));
            let far = tips.max_by(|a, b| a.distance(here).total_cmp(&b.distance(here)))?;
            let frame = revolute.at(revolute.at_rest).frame(index);
            let inside = (frame.determinant().abs() > f64::MIN_POSITIVE).then(|| frame.inverse().transform_point3(far))?;
            (inside.length() > 0.0 && inside.is_finite()).then_some(inside)
        };
        self.bones.iter().enumerate().map(tip).collect()
    }
}

fn is_about_length(finding: &Finding) -> bool {
    matches!(finding, Finding::EndsCoincide | Finding::ShorterThanTendons | Finding::TooShort { .. })
}

fn sample_at(revolute: &RevoluteJoint, line: &Line, angle: f64, solver: &mut LineSolver) -> AngleSample {
    let LineAtAngle { length, moment_arm } = at_angle(revolute, line, angle, solver);
    AngleSample { angle, length, arm: moment_arm }
}

fn between(range: [f64; 2], step: usize, steps: usize) -> f64 {
    range[0] + (range[1] - range[0]) * step as f64 / steps as f64
}

/// Findings about one muscle.
struct FindingCollector<'a> {
    muscle: &'a Muscle,
    /// In a unit of the file.
    millimetres: f64,
    on_arm: bool,
    /// Whether no shortest path was found at some angle, so that the length may jump there.
    is_lost: bool,
    findings: &'a mut Vec<Diagnostic<Finding>>,
}

impl FindingCollector<'_> {
    fn push(&mut self, finding: Finding) {
        self.findings.push(Diagnostic::new(finding, None, self.muscle.label().to_owned()));
    }

    fn to_millimetres(&self, length: f64) -> f64 {
        length * self.millimetres
    }

    /// Says that a line of this length, the shortest of all, leaves too little for the belly.
    fn check_length(&mut self, length: f64, at: FoundAt) {
        let (rest, fixed) = (self.muscle.shape.rest_length(), self.muscle.fixed());
        if length <= 1e-9 * rest {
            self.push(Finding::EndsCoincide);
        } else if length <= fixed {
            self.push(Finding::ShorterThanTendons);
        } else if length - fixed < SHORTEST * rest * (1.0 - 1e-9) {
            self.push(Finding::TooShort { share: (length - fixed) / rest, at });
        }
    }
}

fn check(
    mut collector: FindingCollector<'_>,
    revolute: &RevoluteJoint,
    line: &Line,
    samples: &[AngleSample],
    asked: [f64; 2],
    limbs: &[Option<DVec3>],
    names: &[OwnedLabel],
) {
    let beyond = asked.map(|angle| (angle, line.length(&revolute.at(angle))));
    let all = samples.iter().map(|sample| (sample.angle, sample.length)).chain(beyond);
    if let Some((angle, length)) = all.min_by(|a, b| a.1.total_cmp(&b.1)) {
        collector.check_length(length, FoundAt::Angle(angle));
    }
    find_tight_bends(&mut collector, revolute, line, samples);
    find_sign_change(&mut collector, samples);
    if !collector.is_lost {
        find_jumps(&mut collector, revolute, line, samples);
    }
    // The bones are looked at at fewer angles: what lies in a belly does so over many degrees.
    let every = samples.len().div_ceil(13).max(1);
    let worst = samples
        .iter()
        .step_by(every)
        .filter_map(|sample| Some((sample.angle, deepest_penetration(&collector, revolute, line, *sample, limbs)?)));
    if let Some((angle, found)) = worst.max_by(|a, b| a.1.share.total_cmp(&b.1.share)).filter(|(_, found)| found.share > DEEP)
        && let Some(bone) = names.get(found.bone).cloned()
    {
        let share = found.share;
        collector.push(if found.through {
            Finding::ThroughBone { bone, share, angle }
        } else {
            Finding::TooThick { bone, share, angle, radius: collector.to_millimetres(found.radius) }
        });
    }
}

/// Solves the muscle, and gives the centreline that is drawn for it.
fn drawn(muscle: &Muscle, line: &Line, frames: &impl Frames, solved: &mut Solved) -> Centerline {
    let (mut solver, mut centerline) = (LineSolver::default(), Centerline::default());
    muscle.solve_along(line.solve(frames, &mut solver).length, solved);
    line.draw(frames, &mut solver, muscle.drawn_length(solved), &mut centerline);
    centerline
}

/// Says where the belly is bent tighter than it is thick: there the surface would fold into itself.
fn find_tight_bends(collector: &mut FindingCollector<'_>, revolute: &RevoluteJoint, line: &Line, samples: &[AngleSample]) {
    let (muscle, mut solved) = (collector.muscle, Solved::default());
    let every = samples.len().div_ceil(13).max(1);
    let mut folds = |sample: &AngleSample| {
        let path = drawn(muscle, line, &revolute.at(sample.angle), &mut solved);
        let spacing = solved.length / solved.radii.len().saturating_sub(1).max(1) as f64;
        let start = muscle.tendons[0].length;
        solved.radii.windows(2).enumerate().any(|(node, pair)| {
            let from = start + node as f64 * spacing;
            path.sharpest(from, from + spacing) * pair.iter().copied().fold(0.0, f64::max) > 1.0
        })
    };
    if samples.iter().step_by(every).any(&mut folds) {
        collector.push(Finding::BentTooTight);
    }
}

/// Says where a wrap does nothing, or only as far as a point inside it lets it, and where no path was found round all.
fn find_inert_wraps(collector: &mut FindingCollector<'_>, revolute: &RevoluteJoint, line: &Line, samples: &[AngleSample], wraps: &WrapUse) {
    // A joint that does not move the muscle says nothing about its wraps.
    let moves = samples.iter().any(|sample| sample.arm != 0.0);
    let turns = moves && revolute.range[1] - revolute.range[0] >= LEAST_RANGE;
    for wrap in 0..line.wraps.len() {
        let deepest = wraps.deepest.get(wrap).copied().flatten();
        if let Some((number, depth, angle)) = deepest.filter(|(_, depth, _)| *depth > INSIDE * collector.muscle.shape.rest_length()) {
            let point = match number.checked_sub(1) {
                None => LinePoint::Origin,
                Some(via) if via < line.via.len() => LinePoint::Via(via),
                Some(_) => LinePoint::Insertion,
            };
            collector.push(Finding::InsideWrap { wrap, point, depth: collector.to_millimetres(depth), angle });
        } else if turns && wraps.touched.get(wrap) == Some(&false) {
            collector.push(Finding::WrapNotTouched { wrap, range: revolute.range });
        } else if let Some(angle) = wraps.beyond.get(wrap).copied().flatten() {
            collector.push(Finding::BeyondCylinder { wrap, angle });
        }
    }
    if let Some(angle) = wraps.lost {
        collector.push(Finding::PathNotFound { angle });
    }
}

/// Says where the middle of the belly leaves the bone.
fn find_bow_string(
    collector: &mut FindingCollector<'_>,
    revolute: &RevoluteJoint,
    line: &Line,
    samples: &[AngleSample],
    shapes: &[Option<BoneShape>],
) {
    let mut solved = Solved::default();
    let mut away = |angle: f64| {
        let frames = revolute.at(angle);
        let path = drawn(collector.muscle, line, &frames, &mut solved);
        let fixed = collector.muscle.fixed();
        let start = 0.5 * (path.length() - solved.length - fixed).max(0.0) + collector.muscle.tendons[0].length;
        let middle = path.frame_at(start + 0.5 * solved.length).position;
        let distance = |bone: usize| {
            let (shape, frame) = (shapes.get(bone)?.as_ref()?, frames.frame(bone));
            let inside = shape.beside(frame.inverse().transform_point3(middle))?;
            Some(frame.transform_vector3(inside.outward * inside.distance).length())
        };
        line.bones().filter_map(distance).min_by(f64::total_cmp)
    };
    let Some(rest) = away(revolute.at_rest.clamp(revolute.range[0], revolute.range[1])) else { return };
    let every = samples.len().div_ceil(13).max(1);
    let all = samples.iter().step_by(every).filter_map(|sample| Some((sample.angle, away(sample.angle)?)));
    let Some((angle, most)) = all.max_by(|a, b| a.1.total_cmp(&b.1)) else { return };
    if collector.to_millimetres(most - rest) > BOW_STRING {
        collector.push(Finding::BowStrings { rest: collector.to_millimetres(rest), most: collector.to_millimetres(most), angle });
    }
}

/// Says where the moment arm has one sign and where the other.
fn find_sign_change(collector: &mut FindingCollector<'_>, samples: &[AngleSample]) {
    let order = |a: &&AngleSample, b: &&AngleSample| a.arm.total_cmp(&b.arm);
    let (Some(least), Some(most)) = (samples.iter().min_by(order), samples.iter().max_by(order)) else { return };
    let small = SMALL * collector.muscle.shape.rest_length();
    if least.arm < -small && most.arm > small {
        let (first, second) = if least.angle < most.angle { (least, most) } else { (most, least) };
        let [first, second] =
            [first, second].map(|sample| MomentArmAt { angle: sample.angle, moment_arm: collector.to_millimetres(sample.arm) });
        collector.push(Finding::MomentArmChangesSign { first, second });
    }
}

/// Says where the length changes by more than the moment arm does between two angles, and goes on doing so however near they are.
fn find_jumps(collector: &mut FindingCollector<'_>, revolute: &RevoluteJoint, line: &Line, samples: &[AngleSample]) {
    let small = SMALL * collector.muscle.shape.rest_length();
    let missed = |a: &AngleSample, b: &AngleSample| (b.length - a.length + 0.5 * (a.arm + b.arm) * (b.angle - a.angle).to_radians()).abs();
    let mut solver = LineSolver::default();
    let mut sample = |angle: f64| sample_at(revolute, line, angle, &mut solver);
    // Where most is missed; no file may ask for more work than that.
    let mut pairs: Vec<[AngleSample; 2]> = samples.windows(2).filter_map(|pair| <[AngleSample; 2]>::try_from(pair).ok()).collect();
    pairs.sort_by(|a, b| missed(&b[0], &b[1]).total_cmp(&missed(&a[0], &a[1])));
    pairs.truncate(JUMPS);
    let found = pairs.into_iter().filter_map(|[mut from, mut to]| {
        for _ in 0..20 {
            if missed(&from, &to) <= 0.5 * small {
                return None;
            }
            let middle = sample(0.5 * (from.angle + to.angle));
            if missed(&from, &middle) > missed(&middle, &to) { to = middle } else { from = middle }
        }
        Some((to.angle, (to.length - from.length).abs()))
    });
    if let Some((angle, jump)) = found.max_by(|a, b| a.1.total_cmp(&b.1)) {
        collector.push(Finding::PathJumps { jump: collector.to_millimetres(jump), angle });
    }
}

/// The bone of the muscle that lies deepest in its belly at one angle.
fn deepest_penetration(
    collector: &FindingCollector<'_>,
    revolute: &RevoluteJoint,
    line: &Line,
    sample: AngleSample,
    limbs: &[Option<DVec3>],
) -> Option<BonePenetration> {
    let (muscle, frames) = (collector.muscle, revolute.at(sample.angle));
    let own = (*limbs.get(line.origin.bone)?)?.normalize_or_zero();
    if !collector.on_arm && line.origin.local.reject_from_normalized(own).length() < SCHEMATIC * muscle.spec.profile.rest_length() {
        return None;
    }
    let mut solved = Solved::default();
    let path = drawn(muscle, line, &frames, &mut solved);
    let start = 0.5 * (path.length() - solved.length - muscle.fixed()).max(0.0) + muscle.tendons[0].length;
    let mut cursor = path.cursor();
    let mut belly = [(DVec3::ZERO, 0.0); PLACES];
    for (place, slot) in belly.iter_mut().enumerate() {
        let share = (place as f64 + 0.5) / PLACES as f64;
        *slot = (cursor.frame_at(start + share * solved.length).position, super::bone_clearance::radius_at(&solved.radii, share));
    }
    let mut bones: Vec<usize> = line.bones().collect();
    bones.sort_unstable();
    bones.dedup();
    let inside = |bone: usize| {
        let (frame, tip) = (frames.frame(bone), (*limbs.get(bone)?)?);
        let (mut count, mut deepest, mut radius, mut through) = (0, 0.0_f64, 0.0, 0);
        for step in 0..PLACES {
            let place = frame.transform_point3(tip * ((step as f64 + 0.5) / PLACES as f64));
            let nearest = belly.iter().min_by(|a, b| a.0.distance_squared(place).total_cmp(&b.0.distance_squared(place)))?;
            let depth = nearest.1 - nearest.0.distance(place);
            count += usize::from(depth > 0.0);
            through += usize::from(nearest.0.distance(place) < NEAR_AXIS.0 * nearest.1);
            if depth > deepest {
                (deepest, radius) = (depth, nearest.1);
            }
        }
        Some(BonePenetration {
            share: count as f64 / PLACES as f64,
            bone,
            radius,
            through: through >= NEAR_AXIS.1 && radius < THICK * frame.transform_vector3(tip).length(),
        })
    };
    bones.into_iter().filter_map(inside).max_by(|a, b| a.share.total_cmp(&b.share))
}

//! The belly beside the bones: its centreline bent away from them, its cross-sections flattened against them.
//!
//! A line of action may come so near to a bone that the flesh round it would lie in the bone. Then the flesh is drawn along another line: each place of it that
//! would be inside moves outward from the bone's axis, and what lies beside it follows, so that the line stays smooth. Where that is not enough, or would be too
//! much, cross-sections become ellipses: half a radius √a times as long along the bone's surface, and √a times as short towards the bone. Their area is that of
//! the circle, so that the volume is the same in every slice.
//!
//! The line of action, the lengths and the moment arms are not changed by it. Every step is a smooth function of the pose.

use std::f64::consts::FRAC_PI_2;

use glam::{DMat4, DVec3};

use super::Solved;
use super::bone_shape::BoneShape;
use super::centerline::Centerline;
use super::config::Tendon;

/// Places along the line.
const PLACES: usize = 40;
/// How many places to either side follow one that moves.
const FOLLOW: usize = 8;
/// Exponent of the mean that takes the largest of what neighbours ask for.
const LARGEST: i32 = 16;
/// a at most.
const FLATTEST: f64 = 2.0;
/// Flesh stays this share of its radius away from a bone, whose shape is known by its largest radius in each of some sectors.
const APART: f64 = 0.07;
/// A place moves from this share of the radius before it touches, and by less than it lacks up to as much after.
const SOFT: f64 = 0.1;
/// Places at either end that are left where the muscle is attached, by and by.
const ATTACHED: f64 = 4.0;
/// Over so many of its radii from where the muscle is attached a bone counts by and by.
const COMES: f64 = 3.0;
/// Of directions that neighbours are pushed to, so much is left of their sum where they do not agree at all, and where they agree: a line that passes through a
/// bone from side to side is not pushed where it does.
const AGREE: [f64; 2] = [0.1, 0.5];

/// How the flesh lies.
#[derive(Debug, Clone, Default)]
pub(super) struct Flesh {
    /// The centreline, where it is not the muscle's own.
    centerline: Centerline,
    /// Of each place a, and the direction towards the bone.
    sections: Vec<FlatSection>,
    pushed: bool,
    places: Vec<Place>,
    bones: Vec<PosedBone>,
}

/// A flattened cross-section: a circle where `flatness` is 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct FlatSection {
    /// a: the square of how many times a half axis along the bone is as long as the radius.
    pub flatness: f64,
    /// Towards the bone, of length 1; of no meaning where it is a circle.
    pub toward: DVec3,
}

#[derive(Debug, Clone, Copy, Default)]
struct Place {
    position: DVec3,
    tangent: DVec3,
    radius: f64,
    /// Whether a round section would touch a bone, or nearly.
    is_near: bool,
    /// How far it lacks to be outside, and outward.
    lacks: f64,
    outward: DVec3,
    moved: DVec3,
}

/// A point beside a bone in a pose.
#[derive(Debug, Clone, Copy)]
struct Clearance {
    /// How far it is outside of the bone; negative inside.
    outside: f64,
    /// How far the bone's surface is from its axis there.
    radius: f64,
    /// Outward, of length 1.
    outward: DVec3,
}

/// A bone in a pose.
#[derive(Debug, Clone, Copy)]
struct PosedBone {
    /// Its number among the shapes.
    bone: usize,
    frame: DMat4,
    back: DMat4,
    /// Lengths in the space of the frames for one of the bone.
    scale: f64,
    /// Whether the muscle begins and ends on it.
    ends: [bool; 2],
}

impl PosedBone {
    /// `None` where the frame is flat.
    fn new(bone: usize, frame: DMat4) -> Option<Self> {
        let back = frame.inverse();
        let scale = frame.determinant().abs().cbrt();
        (back.is_finite() && scale > 0.0).then_some(Self { bone, frame, back, scale, ends: [false; 2] })
    }

    fn clearance(&self, shapes: &[Option<BoneShape>], point: DVec3) -> Option<Clearance> {
        let beside = shapes.get(self.bone)?.as_ref()?.beside(self.back.transform_point3(point))?;
        let outward = self.frame.transform_vector3(beside.outward).try_normalize()?;
        Some(Clearance { outside: (beside.distance - beside.radius) * self.scale, radius: beside.radius * self.scale, outward })
    }

    /// The same with what flesh of this radius stays apart taken off.
    fn room(&self, shapes: &[Option<BoneShape>], place: DVec3, radius: f64) -> Option<Clearance> {
        self.clearance(shapes, place).map(|clear| Clearance { outside: clear.outside - APART * radius, ..clear })
    }

    /// How much this bone counts at a place so far from each end of the line: a muscle that is attached to it comes to it there.
    fn counts(&self, away: [f64; 2], radius: f64) -> f64 {
        let of_end = |(end, away): (usize, f64)| if self.ends[end] { smooth(away / (COMES * radius)) } else { 1.0 };
        away.into_iter().enumerate().map(of_end).product()
    }
}

impl Flesh {
    /// The muscle lies along its own centreline, with round cross-sections.
    pub(super) fn leave(&mut self) {
        self.pushed = false;
        self.sections.clear();
    }

    /// The centreline where the flesh is pushed aside.
    pub(super) fn centerline(&self) -> Option<&Centerline> {
        self.pushed.then_some(&self.centerline)
    }

    /// The cross-section at a share of the centreline's length.
    pub(super) fn section(&self, share: f64) -> Option<FlatSection> {
        let place = share.clamp(0.0, 1.0) * PLACES as f64;
        let index = (place as usize).min(PLACES - 1);
        let (a, b) = (self.sections.get(index)?, self.sections.get(index + 1)?);
        let part = place - index as f64;
        let flatness = a.flatness + (b.flatness - a.flatness) * part;
        let toward = (a.toward * (1.0 - part) * (a.flatness - 1.0) + b.toward * part * (b.flatness - 1.0)).try_normalize()?;
        Some(FlatSection { flatness, toward })
    }

    /// Lays a muscle with this centreline beside the bones of its points, from origin to insertion: their numbers among the shapes, and their frames.
    pub(super) fn lay(
        &mut self,
        line: &Centerline,
        solved: &Solved,
        tendons: &[Tendon; 2],
        shapes: &[Option<BoneShape>],
        bones: impl Iterator<Item = (usize, DMat4)>,
    ) {
        self.leave();
        self.bones.clear();
        // A later pose may push what this one leaves alone.
        self.sections.reserve(PLACES + 1);
        self.centerline.begin(DVec3::X);
        let (mut first, mut last) = (None, None);
        for (bone, frame) in bones {
            first.get_or_insert(bone);
            last = Some(bone);
            if matches!(shapes.get(bone), Some(Some(_))) && self.bones.iter().all(|known| known.bone != bone) {
                self.bones.extend(PosedBone::new(bone, frame));
            }
        }
        for bone in &mut self.bones {
            bone.ends = [first == Some(bone.bone), last == Some(bone.bone)];
        }
        if self.bones.is_empty() || line.length() <= 0.0 || solved.radii.is_empty() {
            return;
        }
        self.look(line, solved, tendons, shapes);
        if self.places.iter().any(|place| place.lacks > 0.0) {
            self.bend();
            self.centerline.begin(line.frame_at(0.0).u);
            let Self { places, centerline, .. } = self;
            let spacing = line.length() / PLACES as f64;
            let moved = |index: usize| places.get(index.min(PLACES)).map_or(DVec3::ZERO, |place| place.moved);
            centerline.through(places.len(), |index| {
                let Some(place) = places.get(index) else { return (DVec3::ZERO, DVec3::X) };
                let bend = (moved(index + 1) - moved(index.saturating_sub(1))) / (2.0 * spacing);
                (place.position + place.moved, place.tangent + bend)
            });
            self.pushed = true;
        }
        if self.places.iter().any(|place| place.is_near) {
            self.flatten(shapes, line.length());
        }
    }

    /// Looks at the places of the line: what each lacks to be outside of the bones.
    fn look(&mut self, line: &Centerline, solved: &Solved, tendons: &[Tendon; 2], shapes: &[Option<BoneShape>]) {
        let slack = (line.length() - solved.length - tendons[0].length - tendons[1].length).max(0.0);
        let start = tendons[0].length + 0.5 * slack;
        let radius_at = |at: f64| match at - start {
            before if before < 0.0 => tendons[0].radius,
            inside if inside <= solved.length => super::bone_clearance::radius_at(&solved.radii, inside / solved.length),
            _ => tendons[1].radius,
        };
        let mut cursor = line.cursor();
        self.places.clear();
        for index in 0..=PLACES {
            let at = line.length() * index as f64 / PLACES as f64;
            let frame = cursor.frame_at(at);
            let mut place = Place { position: frame.position, tangent: frame.tangent, radius: radius_at(at), ..Place::default() };
            let needed = place.radius / FLATTEST.sqrt();
            for bone in &self.bones {
                let Some(clear) = bone.room(shapes, place.position, place.radius) else { continue };
                let counts = free(index) * bone.counts([at, line.length() - at], clear.radius);
                let lacks = positive(needed - clear.outside, SOFT * place.radius) * counts;
                place.outward += clear.outward * lacks;
                place.lacks = place.lacks.max(lacks);
                place.is_near |= clear.outside < (1.0 + SOFT) * place.radius;
            }
            self.places.push(place);
        }
    }

    /// Moves each place by the largest of what its neighbours ask for, the less the further they are, and the less they agree on where to.
    fn bend(&mut self) {
        for index in 0..=PLACES {
            let (mut sum, mut direction, mut weights) = (0.0, DVec3::ZERO, 0.0);
            for (other, place) in self.places.iter().enumerate().skip(index.saturating_sub(FOLLOW)).take(2 * FOLLOW + 1) {
                let away = other.abs_diff(index);
                if away > FOLLOW || place.lacks <= 0.0 {
                    continue;
                }
                let share = (FRAC_PI_2 * away as f64 / (FOLLOW + 1) as f64).cos().powi(2);
                sum += (place.lacks * share).powi(LARGEST);
                direction += place.outward * share;
                weights += place.outward.length() * share;
            }
            let Some(place) = self.places.get_mut(index) else { break };
            place.moved = DVec3::ZERO;
            if sum > 0.0 {
                let agree = smooth((direction.length() / weights - AGREE[0]) / (AGREE[1] - AGREE[0]));
                // Along the line nothing can be moved.
                let outward = direction.normalize_or_zero().reject_from_normalized(place.tangent);
                place.moved = outward * (sum.powf(1.0 / f64::from(LARGEST)) * agree * free(index));
            }
        }
    }

    /// Flattens the cross-sections where bones leave less than the radius, each as much as it does.
    fn flatten(&mut self, shapes: &[Option<BoneShape>], length: f64) {
        for (index, place) in self.places.iter().enumerate() {
            let at = length * index as f64 / PLACES as f64;
            let (mut toward, mut most) = (DVec3::ZERO, 0.0_f64);
            for bone in &self.bones {
                let Some(clear) = bone.room(shapes, place.position + place.moved, place.radius) else { continue };
                let wanted = (place.radius / clear.outside.max(place.radius / FLATTEST.sqrt())).powi(2) - 1.0;
                let flatter = positive(wanted, SOFT) * bone.counts([at, length - at], clear.radius);
                toward -= clear.outward * flatter;
                most = most.max(flatter);
            }
            let toward = toward.reject_from_normalized(place.tangent);
            // Bones on both sides leave no side to be flattened from.
            let agree = if most > 0.0 { (toward.length() / most).min(1.0) } else { 0.0 };
            let flatness = 1.0 + most.min(FLATTEST - 1.0) * agree * free(index);
            self.sections.push(FlatSection { flatness, toward: toward.normalize_or_zero() });
        }
    }
}

/// x where it is above `width`, 0 below −`width`, and between them a parabola: without a jump in the slope.
fn positive(x: f64, width: f64) -> f64 {
    if x <= -width {
        0.0
    } else if x >= width {
        x
    } else {
        (x + width).powi(2) / (4.0 * width)
    }
}

/// 0 where the muscle is attached, 1 away from its ends.
fn free(index: usize) -> f64 {
    smooth(index.min(PLACES - index) as f64 / ATTACHED)
}

/// 0 below 0, 1 above 1, and between them without a jump in the slope.
fn smooth(x: f64) -> f64 {
    let x = x.clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn straight(height: f64) -> Centerline {
        let mut line = Centerline::new(DVec3::X);
        line.line(DVec3::new(height, 0.0, 0.0), DVec3::new(height, 200.0, 0.0));
        line
    }

    fn belly() -> Solved {
        Solved { length: 200.0, radii: vec![4.0, 12.0, 16.0, 12.0, 4.0], path_length: 200.0, ..Solved::default() }
    }

    const NO_TENDONS: [Tendon; 2] = [Tendon { length: 0.0, radius: 0.0 }; 2];

    #[test]
    fn flesh_beside_a_bone_is_outside_of_it_and_flesh_away_from_it_stays() {
        let shapes = [BoneShape::capsule(DVec3::Y * 200.0, 10.0)];
        let mut flesh = Flesh::default();
        flesh.lay(&straight(40.0), &belly(), &NO_TENDONS, &shapes, [(0, DMat4::IDENTITY)].into_iter());
        assert!(flesh.centerline().is_none());
        for height in [2.0, 8.0, 14.0, 20.0, 25.0] {
            flesh.lay(&straight(height), &belly(), &NO_TENDONS, &shapes, [(0, DMat4::IDENTITY)].into_iter());
            let line = flesh.centerline().cloned().unwrap_or(straight(height));
            for step in 8..=32 {
                let share = f64::from(step) / 40.0;
                let frame = line.frame_at(share * line.length());
                let radius = super::super::bone_clearance::radius_at(&belly().radii, share);
                let section = flesh.section(share);
                let flatness = section.map_or(1.0, |section| section.flatness);
                assert!((1.0..=FLATTEST).contains(&flatness));
                // Half the section towards the bone.
                let deep = frame.position.x - radius / flatness.sqrt();
                assert!(deep > 9.6, "{height} {share}: {deep} {section:?}");
                assert!(section.is_none_or(|section| section.toward.distance(DVec3::NEG_X) < 1e-9));
            }
        }
    }

    #[test]
    fn flesh_moves_smoothly_as_the_bone_comes_nearer() {
        let shapes = [BoneShape::capsule(DVec3::Y * 200.0, 10.0)];
        let mut flesh = Flesh::default();
        let mut before: Option<(f64, f64)> = None;
        for step in 0..400 {
            flesh.lay(&straight(45.0 - 0.1 * f64::from(step)), &belly(), &NO_TENDONS, &shapes, [(0, DMat4::IDENTITY)].into_iter());
            let middle = flesh.centerline().map_or(45.0 - 0.1 * f64::from(step), |line| line.frame_at(0.5 * line.length()).position.x);
            let flatness = flesh.section(0.5).map_or(1.0, |section| section.flatness);
            if let Some((x, a)) = before {
                assert!((middle - x).abs() < 0.2 && (flatness - a).abs() < 0.05, "{step}: {x} {middle}, {a} {flatness}");
            }
            before = Some((middle, flatness));
        }
    }

    #[test]
    fn a_line_from_one_side_of_a_bone_to_the_other_stays_where_it_passes_through() {
        let shapes = [BoneShape::capsule(DVec3::Y * 200.0, 10.0)];
        let mut line = Centerline::new(DVec3::X);
        line.line(DVec3::new(-15.0, 0.0, 0.0), DVec3::new(15.0, 200.0, 0.0));
        let mut flesh = Flesh::default();
        flesh.lay(&line, &belly(), &NO_TENDONS, &shapes, [(0, DMat4::IDENTITY)].into_iter());
        let drawn = flesh.centerline().unwrap();
        assert!(drawn.frame_at(0.5 * drawn.length()).position.distance(DVec3::new(0.0, 100.0, 0.0)) < 1.0);
        assert!(drawn.length() < 1.25 * line.length(), "{}", drawn.length());
    }
}

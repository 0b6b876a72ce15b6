//! One stretch of a path: which surfaces act on it, and where.
//!
//! A surface acts when the straight line between its neighbours' contact points runs into it, and stops acting when its geodesic has no length left. At the
//! moment of either, the geodesic is a point and the straight parts are one line, so that length and direction go on without a jump.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::{DQuat, DVec3};

use super::geodesic::GeodesicStart;
use super::newton::{Contact, Newton, Placed};
use super::shape::Shape;
use super::touch::Touch;

/// A surface that may act on the stretch.
#[derive(Debug, Clone, Copy)]
pub(super) struct Slot {
    /// Index of the surface in the caller's list.
    pub surface: usize,
    /// The surface as it yields to the stretch's ends; smaller while it grows.
    pub placed: Placed,
    /// Its shape when it has grown.
    whole: Shape,
    /// The side of the path, in the surface's frame.
    pub side: Option<DVec3>,
    /// Whether the path may go round it by more than half a turn.
    around: bool,
    /// Where the geodesic started on the same surface of a smaller size.
    grown_from: Option<GeodesicStart>,
    /// The geodesic, where the surface acts.
    pub contact: Option<Contact>,
    /// The estimate of the arc by the closed forms.
    touch: Option<Touch>,
    /// The way round that is being tried, in place of the side.
    way: Option<DVec3>,
    /// How often it stopped acting in one run.
    dropped: usize,
}

impl Slot {
    pub(super) fn new(surface: usize, placed: Placed, side: Option<DVec3>, around: bool) -> Self {
        Self { surface, placed, whole: placed.shape, side, around, grown_from: None, contact: None, touch: None, way: None, dropped: 0 }
    }

    /// Whether the path may go round either way.
    fn has_ways(&self) -> bool {
        self.side.is_none() && !matches!(self.placed.shape, Shape::Torus(_))
    }

    fn touch(&self, from: DVec3, to: DVec3) -> Option<Touch> {
        let (from, to) = (self.placed.to_local(from), self.placed.to_local(to));
        match (self.placed.shape, self.way) {
            (Shape::Ellipsoid(ellipsoid), Some(way)) => ellipsoid.touch_on(from, to, way),
            (shape, way) => shape.touch(from, to, way.or(self.side), self.around),
        }
    }
}

/// How a stretch was solved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Outcome {
    /// Whether what is left in the slots is a shortest path.
    pub converged: bool,
    /// The largest sine between a straight part and a geodesic that it meets.
    pub error: f64,
    /// Newton steps of the last run.
    pub steps: usize,
}

impl Outcome {
    /// Of a closed form.
    const EXACT: Self = Self { converged: true, error: 0.0, steps: 0 };
}

/// Rounds of Gauss and Seidel in which estimates of the arcs follow one another, beyond two a surface.
const ROUNDS: usize = 4;
/// Estimates that move by less than this share of the surface's size are good enough.
const SETTLED: f64 = 1e-2;
/// A geodesic on a smaller surface further than this from the estimate, in radii, or turned by more than 60° from it, is of another path.
const NEAR: f64 = 0.8;
/// A solution further than this from the estimate, in radii and as a share of its length, is none.
const SOUND: f64 = 1.2;
/// Of a surface that the estimate says is cleared, the longest arc in radii.
const ALMOST: f64 = 0.3;
/// A straight line that passes nearer to the centre than this share of the radius may have a shorter way round.
const CENTRAL: f64 = 0.9;
/// Sides of the straight line that are tried.
const SIDES: u32 = 6;
/// Another way is taken where it is shorter by more than this share: rounding decides nothing.
const SHORTER: f64 = 1e-13;
/// Reversals of straight parts that run back, and the path error from which they are worth it.
const REVERSALS: usize = 2;
const REVERSED: f64 = 1e-3;
/// Geodesics that may be tried for a stretch, and again for its choice of ways: a plain solution takes a few for each surface, a choice some hundreds.
const GEODESICS: usize = 250;
/// Runs of Newton's method on surfaces that grow from small ones.
const GROWTHS: usize = 32;
/// A surface that stopped acting so often in one run stays so.
const DROPS: usize = 2;

/// Buffers of a stretch.
#[derive(Debug, Clone, Default)]
pub(super) struct StretchSolver {
    newton: Newton,
    /// The surfaces that may act, in the order in which the path meets them.
    pub slots: Vec<Slot>,
    /// Those that act now.
    active: Vec<usize>,
    /// The slots of the shortest path so far, while another is tried.
    saved: Vec<Slot>,
    surfaces: Vec<Placed>,
    contacts: Vec<Contact>,
}

impl StretchSolver {
    /// Solves the path over `slots` from `from` to `to`.
    pub(super) fn solve(&mut self, from: DVec3, to: DVec3) -> Outcome {
        self.newton.budget = GEODESICS;
        if let [slot] = self.slots.as_mut_slice() {
            slot.touch = slot.touch(from, to);
            let Some(touch) = slot.touch else { return Outcome::EXACT };
            if slot.placed.shape.is_exact() {
                slot.contact = Some(Contact::new(&slot.placed.shape, touch.start));
                return Outcome::EXACT;
            }
            if let (Shape::Ellipsoid(_), None) = (slot.placed.shape, slot.side) {
                return self.shortest_of_four(from, to).unwrap_or_else(|| self.grow(from, to));
            }
        } else {
            self.estimate(from, to);
        }
        if self.slots.iter().all(|slot| slot.touch.is_none()) {
            return Outcome::EXACT;
        }
        self.start(false);
        let mut outcome = self.settle(from, to);
        if !outcome.converged {
            outcome = self.grow(from, to);
        }
        if self.slots.len() > 1 { self.shortest_way(from, to, outcome) } else { outcome }
    }

    /// Of several surfaces each estimate takes the way round that is nearer for its own neighbours, which need not be the shorter one for the whole. Where the
    /// path has a choice, the opposite way is tried too.
    fn shortest_way(&mut self, from: DVec3, to: DVec3, outcome: Outcome) -> Outcome {
        let mut best = outcome;
        let mut shortest = if outcome.converged { self.length(from, to) } else { f64::INFINITY };
        if !self.slots.iter().any(Slot::has_ways) {
            return best;
        }
        self.newton.budget = GEODESICS;
        // All on the same side of the straight line, for sides round it; then one after the other.
        let along = (to - from).normalize_or(DVec3::X);
        let across = along.any_orthonormal_vector();
        for turn in 0..SIDES {
            let side = DQuat::from_axis_angle(along, f64::from(turn) * TAU / f64::from(SIDES)) * across;
            self.try_ways(from, to, &mut best, &mut shortest, |_, slot| slot.has_ways().then(|| slot.placed.rotation.transpose() * side));
        }
        let count = self.slots.len();
        for index in (0..2 * count).map(|turn| turn % count) {
            if let Some(way) = self.other_way(from, to, index) {
                self.try_ways(from, to, &mut best, &mut shortest, |place, slot| if place == index { Some(way) } else { slot.way });
            }
        }
        best
    }

    /// Solves with other ways round, and keeps the path if it is shorter.
    fn try_ways(&mut self, from: DVec3, to: DVec3, best: &mut Outcome, shortest: &mut f64, way: impl Fn(usize, &Slot) -> Option<DVec3>) {
        self.saved.clone_from(&self.slots);
        for (index, slot) in self.slots.iter_mut().enumerate() {
            slot.way = way(index, slot);
        }
        self.estimate(from, to);
        self.start(false);
        let mut outcome = self.settle(from, to);
        if !outcome.converged && !best.converged {
            outcome = self.grow(from, to);
        }
        let length = self.length(from, to);
        if outcome.converged && length < *shortest * (1.0 - SHORTER) {
            (*best, *shortest) = (outcome, length);
        } else {
            std::mem::swap(&mut self.slots, &mut self.saved);
        }
    }

    /// A direction in a surface's frame that the other way over it passes on; `None` where there is none that may be shorter.
    fn other_way(&self, from: DVec3, to: DVec3, index: usize) -> Option<DVec3> {
        let slot = self.slots.get(index).filter(|slot| slot.side.is_none())?;
        let contact = slot.contact?;
        let placed = slot.placed;
        let [before, after] = self.beside(index, from, to);
        let passes = placed.shape.passes(placed.to_local(before), placed.to_local(after))?;
        let up = placed.shape.normal(contact.start.point) + placed.shape.normal(contact.end.point);
        (passes < CENTRAL).then_some(-up)
    }

    /// The length of the path.
    fn length(&self, from: DVec3, to: DVec3) -> f64 {
        let (mut length, mut before) = (0.0, from);
        for slot in &self.slots {
            if let Some(contact) = slot.contact {
                length += before.distance(slot.placed.to_world(contact.start.point)) + contact.start.length;
                before = slot.placed.to_world(contact.end.point);
            }
        }
        length + before.distance(to)
    }

    /// Estimates all arcs, each from those beside it, until they no longer change.
    fn estimate(&mut self, from: DVec3, to: DVec3) {
        for slot in &mut self.slots {
            slot.touch = None;
        }
        for _ in 0..ROUNDS + 2 * self.slots.len() {
            let mut settled = true;
            let mut before = from;
            for index in 0..self.slots.len() {
                let later = self.slots.iter().skip(index + 1);
                let after = later.filter_map(|slot| slot.touch.map(|touch| slot.placed.to_world(touch.start.point))).next().unwrap_or(to);
                let Some(slot) = self.slots.get_mut(index) else { break };
                let touch = slot.touch(before, after);
                settled &= match (slot.touch, touch) {
                    (None, None) => true,
                    (Some(old), Some(new)) => {
                        let moved = old.start.point.distance(new.start.point).max(old.end.distance(new.end));
                        moved < SETTLED * slot.placed.shape.size()
                    }
                    _ => false,
                };
                slot.touch = touch;
                if let Some(touch) = touch {
                    before = slot.placed.to_world(touch.end);
                }
            }
            if settled {
                break;
            }
        }
    }

    /// Begins geodesics where the estimates say, or where those on the smaller surfaces were if that is near.
    fn start(&mut self, grows: bool) {
        for slot in &mut self.slots {
            let shape = slot.placed.shape;
            slot.contact = slot.touch.map(|touch| {
                let last = slot.grown_from.filter(|last| grows && is_near(&shape, last, &touch.start));
                Contact::new(&shape, last.map_or(touch.start, |last| brought(&shape, &last)))
            });
        }
    }

    /// Solves for the surfaces that act, lets go those whose geodesic has no length, and takes up those that the straight parts run into.
    fn settle(&mut self, from: DVec3, to: DVec3) -> Outcome {
        for slot in &mut self.slots {
            slot.dropped = 0;
        }
        let mut outcome = Outcome::EXACT;
        for _ in 0..6 * self.slots.len() + 2 {
            outcome = self.run(from, to);
            if !outcome.converged {
                return outcome;
            }
            if !(self.let_go() || self.take_up(from, to)) {
                return Outcome { converged: self.is_sound(from, to), ..outcome };
            }
        }
        // Surfaces that take turns in acting: what acts now is a path, if not one that clears all.
        Outcome { converged: false, ..outcome }
    }

    /// Newton's method for the surfaces that act.
    fn run(&mut self, from: DVec3, to: DVec3) -> Outcome {
        self.active.clear();
        self.surfaces.clear();
        self.contacts.clear();
        for (index, slot) in self.slots.iter().enumerate() {
            if let Some(contact) = slot.contact {
                self.active.push(index);
                self.surfaces.push(slot.placed);
                self.contacts.push(contact);
            }
        }
        let mut convergence = self.newton.solve(from, to, &self.surfaces, &mut self.contacts);
        for _ in 0..REVERSALS {
            if convergence.converged || convergence.error() > REVERSED || !turn_forwards(from, to, &self.surfaces, &mut self.contacts) {
                break;
            }
            convergence = self.newton.solve(from, to, &self.surfaces, &mut self.contacts);
        }
        for (index, contact) in self.active.iter().zip(&self.contacts) {
            if let Some(slot) = self.slots.get_mut(*index) {
                slot.contact = Some(*contact);
            }
        }
        Outcome { converged: convergence.converged, error: convergence.error(), steps: convergence.steps }
    }

    /// Surfaces whose geodesic has no length left act no longer.
    fn let_go(&mut self) -> bool {
        let mut any = false;
        for slot in &mut self.slots {
            if slot.contact.is_some_and(|contact| contact.start.length <= 0.0) {
                slot.contact = None;
                slot.dropped += 1;
                any = true;
            }
        }
        any
    }

    /// The first surface that a straight part runs into acts from now on.
    fn take_up(&mut self, from: DVec3, to: DVec3) -> bool {
        for index in 0..self.slots.len() {
            let [before, after] = self.beside(index, from, to);
            if let Some(slot) = self.slots.get_mut(index).filter(|slot| slot.contact.is_none() && slot.dropped < DROPS) {
                slot.contact = slot.touch(before, after).map(|touch| Contact::new(&slot.placed.shape, touch.start));
                if slot.contact.is_some() {
                    return true;
                }
            }
        }
        false
    }

    /// Where the path lifts off last before a surface, and where it touches down next after it.
    fn beside(&self, index: usize, from: DVec3, to: DVec3) -> [DVec3; 2] {
        let before = self.slots.iter().take(index).rev();
        let after = self.slots.iter().skip(index + 1);
        [
            before.filter_map(|slot| slot.contact.map(|contact| slot.placed.to_world(contact.end.point))).next().unwrap_or(from),
            after.filter_map(|slot| slot.contact.map(|contact| slot.placed.to_world(contact.start.point))).next().unwrap_or(to),
        ]
    }

    /// Whether all geodesics are near what the closed forms estimate from the points beside them: Newton's method may come to one that goes round once more.
    fn is_sound(&self, from: DVec3, to: DVec3) -> bool {
        self.slots.iter().enumerate().all(|(index, slot)| {
            let Some(contact) = slot.contact else { return true };
            let [before, after] = self.beside(index, from, to);
            let touch = slot.touch(before, after);
            let shape = &slot.placed.shape;
            // Without an estimate the surface is all but cleared.
            touch.map_or(contact.start.length < ALMOST * shape.size(), |touch| {
                let longer = (contact.start.length - touch.start.length).abs();
                apart(shape, contact.start.point, touch.start.point) < SOUND
                    && apart(shape, contact.end.point, touch.end) < SOUND
                    && longer < SOUND * (touch.start.length + shape.size())
            })
        })
    }

    /// An ellipsoid without a side, alone: the shortest of the paths that start from estimates a quarter turn apart round the straight line.
    fn shortest_of_four(&mut self, from: DVec3, to: DVec3) -> Option<Outcome> {
        let (placed, ellipsoid) = match self.slots.first() {
            Some(Slot { placed, .. }) => match placed.shape {
                Shape::Ellipsoid(ellipsoid) => (*placed, ellipsoid),
                _ => return None,
            },
            None => return None,
        };
        let mut best: Option<(f64, Outcome, Option<Contact>)> = None;
        for turn in [0.0, PI, FRAC_PI_2, -FRAC_PI_2] {
            let Some(touch) = ellipsoid.touch_turned(placed.to_local(from), placed.to_local(to), turn) else { continue };
            if let Some(slot) = self.slots.first_mut() {
                slot.contact = Some(Contact::new(&placed.shape, touch.start));
            }
            let outcome = self.run(from, to);
            let Some(contact) = self.slots.first().and_then(|slot| slot.contact) else { continue };
            if !outcome.converged {
                continue;
            }
            let (length, contact) =
                if contact.start.length <= 0.0 { (from.distance(to), None) } else { (self.length(from, to), Some(contact)) };
            if best.is_none_or(|(least, ..)| length < least) {
                best = Some((length, outcome, contact));
            }
        }
        let (_, outcome, contact) = best?;
        if let Some(slot) = self.slots.first_mut() {
            slot.contact = contact;
        }
        Some(outcome)
    }

    /// What is left when Newton's method finds no way from the estimates: all surfaces grow from a fraction of their size, each solution the start of the next.
    fn grow(&mut self, from: DVec3, to: DVec3) -> Outcome {
        /// Where the growth begins, and its first step.
        const FIRST: f64 = 0.2;
        let resize = |slots: &mut [Slot], size: f64| {
            for slot in slots {
                slot.placed.shape = if size < 1.0 { slot.whole.scaled(size) } else { slot.whole };
            }
        };
        let (mut reached, mut step, mut size) = (0.0, FIRST, 1.0);
        let mut outcome = Outcome { converged: false, error: f64::INFINITY, steps: 0 };
        for _ in 0..GROWTHS {
            if self.newton.budget == 0 {
                break;
            }
            let next = f64::min(reached + step, 1.0);
            resize(&mut self.slots, next);
            size = next;
            self.estimate(from, to);
            self.start(true);
            outcome = self.settle(from, to);
            if outcome.converged {
                if next >= 1.0 {
                    break;
                }
                for slot in &mut self.slots {
                    slot.grown_from = slot.contact.map(|contact| contact.start);
                }
                reached = next;
                step *= 1.5;
            } else {
                step *= 0.4;
            }
        }
        resize(&mut self.slots, 1.0);
        if !outcome.converged || size < 1.0 {
            // The estimates are a path outside of each surface by itself, if not the shortest.
            outcome.converged = false;
            self.estimate(from, to);
            self.start(false);
        }
        outcome
    }
}

/// Newton's method may come to the wrong one of two tangents from a point close by, with a straight part that runs back against the geodesic. Takes such
/// geodesics back by twice the straight part, near to where the right one touches. Tells whether there were any.
fn turn_forwards(from: DVec3, to: DVec3, surfaces: &[Placed], contacts: &mut [Contact]) -> bool {
    let mut any = false;
    let mut before = from;
    for index in 0..contacts.len() {
        let after = surfaces.get(index + 1).zip(contacts.get(index + 1)).map_or(to, |(placed, next)| placed.to_world(next.start.point));
        let (Some(placed), Some(contact)) = (surfaces.get(index), contacts.get_mut(index)) else { break };
        let turned = |vector: DVec3| placed.rotation.transpose() * vector;
        let (first, last) = (placed.to_world(contact.start.point), placed.to_world(contact.end.point));
        let (into, out) = (turned(first - before), turned(after - last));
        before = last;
        let mut start = contact.start;
        if out.dot(contact.end.tangent) < 0.0 {
            start.length -= 2.0 * out.length();
        }
        if into.dot(contact.start.tangent) < 0.0 {
            let on = placed.shape.shoot(&GeodesicStart { length: 2.0 * into.length(), ..start });
            start = GeodesicStart { point: on.point, tangent: on.tangent, length: start.length - 2.0 * into.length() };
        }
        if start != contact.start {
            *contact = Contact::new(&placed.shape, start);
            any = true;
        }
    }
    any
}

/// A start on a surface that has changed its size.
fn brought(shape: &Shape, last: &GeodesicStart) -> GeodesicStart {
    let point = shape.project(last.point);
    let tangent = last.tangent.reject_from_normalized(shape.normal(point)).normalize_or(last.tangent);
    GeodesicStart { point, tangent, length: last.length }
}

fn is_near(shape: &Shape, last: &GeodesicStart, start: &GeodesicStart) -> bool {
    apart(shape, brought(shape, last).point, start.point) < NEAR && last.tangent.dot(start.tangent) > 0.5
}

/// The distance of two points in radii of the surface.
fn apart(shape: &Shape, one: DVec3, other: DVec3) -> f64 {
    match shape {
        Shape::Ellipsoid(ellipsoid) => ((one - other) / ellipsoid.radii).length(),
        _ => one.distance(other) / shape.size(),
    }
}

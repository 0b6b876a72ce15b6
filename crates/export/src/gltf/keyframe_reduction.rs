//! Keyframes of one track: those of the file, and as many more as the tolerance needs.

use super::trs::Placing;

/// Largest rotation error between keys, radians; see also [`Tolerance`].
const TURN: f64 = 2e-5;
/// How often a stretch between two keys may be halved.
const HALVINGS: u32 = 10;
/// Most keys of one track.
const KEYS: usize = 200_000;

/// Largest deviation of the written track.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tolerance {
    /// Length in the node's own unit.
    pub length: f64,
}

impl Tolerance {
    fn holds(&self, a: &Placing, b: &Placing) -> bool {
        // The half angle's sine is the length of the difference of the quaternions, to first order.
        let turn = 2.0 * (2.0 * (1.0 - a.rotation.dot(b.rotation).abs().min(1.0))).sqrt();
        turn <= TURN
            && (a.translation - b.translation).length() <= self.length
            && (a.scale - b.scale).abs().max_element() <= TURN * (1.0 + a.scale.abs().max_element())
    }
}

/// A moment to take a key at: where it is taken and the time that is written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct KeyTime {
    /// Seconds on the file's axis.
    pub at: f64,
    /// Seconds in the written file.
    pub written: f32,
}

/// The moments of `times` (ascending), with one just before each of `jumps` (ascending too), where the value leaps. `shift` is added to what is written.
pub(super) fn moments(times: &[f64], jumps: &[f64], shift: f64) -> Vec<KeyTime> {
    let mut found: Vec<KeyTime> = Vec::new();
    for &at in times {
        let written = (at + shift) as f32;
        let leaps = jumps.binary_search_by(|jump| jump.partial_cmp(&at).unwrap_or(std::cmp::Ordering::Less)).is_ok();
        if leaps && !found.is_empty() {
            let before = KeyTime { at: at.next_down(), written: written.next_down() };
            if found.last().is_some_and(|last| last.written < before.written) {
                found.push(before);
            }
        }
        match found.last_mut() {
            // Keys closer than the format's times can tell: the later one stays.
            Some(last) if last.written >= written => last.at = at,
            _ => found.push(KeyTime { at, written }),
        }
    }
    found
}

/// Places keys at `moments` and wherever interpolation between them deviates by more than the tolerance.
pub(super) fn track(moments: &[KeyTime], tolerance: Tolerance, take: &mut dyn FnMut(f64) -> Placing) -> Vec<(f32, Placing)> {
    let fits = |from: &Placing, to: &Placing, part: f64, found: &Placing| tolerance.holds(&from.between(to, part), found);
    let mut keys = walk(moments, &fits, take);
    smooth(&mut keys);
    keys
}

/// The same for a row of plain numbers, none of which may be off by more than `most`.
pub(super) fn numbers(moments: &[KeyTime], most: f64, take: &mut dyn FnMut(f64) -> Vec<f32>) -> Vec<(f32, Vec<f32>)> {
    let fits = |from: &Vec<f32>, to: &Vec<f32>, part: f64, found: &Vec<f32>| {
        from.iter().zip(to).zip(found).all(|((from, to), found)| {
            let [from, to, found] = [*from, *to, *found].map(f64::from);
            // What single precision cannot tell apart is no error.
            (from + (to - from) * part - found).abs() <= most + 1e-6 * found.abs()
        })
    };
    walk(moments, &fits, take)
}

/// Leaves out the keys that linear interpolation between those that stay makes within `most`, after Douglas and Peucker: `off(from, to, between)` is how far
/// it is off at key `between`. Of `count` keys the numbers of those that stay, rising; the first and the last are among them.
pub(super) fn thin(count: usize, most: f32, off: &dyn Fn(usize, usize, usize) -> f32) -> Vec<usize> {
    let Some(last) = count.checked_sub(1) else { return Vec::new() };
    let mut kept = vec![0, last];
    let mut open = vec![(0, last)];
    while let Some((from, to)) = open.pop() {
        let worst = (from + 1..to).map(|between| (off(from, to, between), between)).max_by(|a, b| a.0.total_cmp(&b.0));
        // What is no number stays.
        if let Some((_, at)) = worst.filter(|(worst, _)| *worst > most || worst.is_nan()) {
            kept.push(at);
            open.extend([(from, at), (at, to)]);
        }
    }
    kept.sort_unstable();
    kept.dedup();
    kept
}

/// Whether a value sampled between two keys equals their linear interpolation within the tolerance.
type FitsFn<'a, V> = &'a dyn Fn(&V, &V, f64, &V) -> bool;

fn walk<V: Clone>(moments: &[KeyTime], fits: FitsFn<'_, V>, take: &mut dyn FnMut(f64) -> V) -> Vec<(f32, V)> {
    let mut keys: Vec<(f32, V)> = Vec::new();
    let mut last: Option<(KeyTime, V)> = None;
    for moment in moments {
        let here = take(moment.at);
        if let Some((before, start)) = &last {
            // A leap is over before there is room for a key.
            if moment.written > before.written.next_up() {
                refine((*before, start), (*moment, &here), HALVINGS, fits, take, &mut keys);
            }
        }
        keys.push((moment.written, here.clone()));
        last = Some((*moment, here));
    }
    keys
}

fn refine<V: Clone>(
    from: (KeyTime, &V),
    to: (KeyTime, &V),
    halvings: u32,
    fits: FitsFn<'_, V>,
    take: &mut dyn FnMut(f64) -> V,
    keys: &mut Vec<(f32, V)>,
) {
    let at = |part: f64| from.0.at + (to.0.at - from.0.at) * part;
    let middle = take(at(0.5));
    // The quarters too: an S-shaped way crosses the straight one in the middle.
    let mut straight = |part: f64| fits(from.1, to.1, part, &take(at(part)));
    if fits(from.1, to.1, 0.5, &middle) && straight(0.25) && straight(0.75) {
        return;
    }
    let written = from.0.written + (to.0.written - from.0.written) * 0.5;
    if halvings == 0 || keys.len() >= KEYS || written <= from.0.written || written >= to.0.written {
        return;
    }
    let half = KeyTime { at: at(0.5), written };
    refine(from, (half, &middle), halvings - 1, fits, take, keys);
    keys.push((written, middle.clone()));
    refine((half, &middle), to, halvings - 1, fits, take, keys);
}

/// Chooses of the two quaternions of each rotation the one nearer to the last, so that players that only mix numbers go the same way.
fn smooth(keys: &mut [(f32, Placing)]) {
    for at in 1..keys.len() {
        if keys[at - 1].1.rotation.dot(keys[at].1.rotation) < 0.0 {
            keys[at].1.rotation = -keys[at].1.rotation;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DQuat, DVec3};

    fn turned(angle: f64) -> Placing {
        Placing { translation: DVec3::ZERO, rotation: DQuat::from_rotation_y(angle), scale: DVec3::ONE }
    }

    #[test]
    fn a_steady_turn_over_less_than_half_a_circle_needs_no_more_keys() {
        let keys = track(&moments(&[0.0, 1.0], &[], 0.0), Tolerance { length: 1e-5 }, &mut |t| turned(3.0 * t));
        assert_eq!(keys.len(), 2);
    }

    #[test]
    fn full_turns_get_keys_enough_that_the_shorter_arc_is_the_right_one() {
        let keys = track(&moments(&[0.0, 1.0], &[], 0.0), Tolerance { length: 1e-5 }, &mut |t| turned(4.0 * std::f64::consts::PI * t));
        assert!(keys.len() >= 5, "{}", keys.len());
        for pair in keys.windows(2) {
            let middle = f64::from(pair[0].0 + pair[1].0) / 2.0;
            let way = pair[0].1.between(&pair[1].1, 0.5);
            assert!(way.rotation.dot(turned(4.0 * std::f64::consts::PI * middle).rotation).abs() > 1.0 - 1e-9);
        }
    }

    #[test]
    fn a_leap_is_two_keys_side_by_side() {
        let found = moments(&[0.0, 1.0, 2.0], &[1.0], 0.0);
        assert_eq!(found.len(), 4);
        assert_eq!(found[1].written, 1.0_f32.next_down());
        assert!(found[1].at < 1.0 && found[2].at == 1.0);
    }

    #[test]
    fn keys_that_others_make_are_left_out() {
        let off = |values: &'static [f32]| {
            move |from: usize, to: usize, between: usize| {
                let part = (between - from) as f32 / (to - from) as f32;
                (values[from] + (values[to] - values[from]) * part - values[between]).abs()
            }
        };
        assert_eq!(thin(5, 0.01, &off(&[0.0, 1.0, 2.0, 1.0, 0.0])), [0, 2, 4]);
        assert_eq!(thin(5, 0.01, &off(&[0.0, 1.0, 2.0, 3.0, 4.0])), [0, 4]);
        assert_eq!(thin(4, 0.01, &off(&[0.0, f32::NAN, 0.0, 0.0])), [0, 1, 2, 3]);
        assert_eq!(
            (thin(0, 0.01, &off(&[])), thin(1, 0.01, &off(&[2.0])), thin(2, 0.01, &off(&[2.0, 3.0]))),
            (vec![], vec![0], vec![0, 1])
        );
    }

    #[test]
    fn written_times_rise_also_where_keys_are_too_close_to_tell_apart() {
        let found = moments(&[1_000.0, 1_000.000_000_1, 1_000.000_000_2, 1_001.0], &[], 0.0);
        assert!(found.windows(2).all(|pair| pair[0].written < pair[1].written));
        assert_eq!(found[0].at, 1_000.000_000_2);
    }
}

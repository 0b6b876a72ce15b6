//! Ghosts: the moments before and after the present one, drawn with it, and the path of the selected node over the clip.

use glam::{DVec3, Vec3};

use super::{Changes, Session};
use crate::document::{Companion, PoseState};
use crate::scene::{Ghost, Mark};
use crate::stage::Ghosts;

/// Most pieces of a path, and most dots on it.
const PIECES: usize = 600;
/// What was is blue, what will be is green; told apart by more than colour: each fades with its distance in time.
const BEFORE: u32 = 0x53_9BF5;
const AFTER: u32 = 0x57_AB5A;
/// Thousandths of its distance by which a ghost stands back.
const BEHIND: f32 = 15.0;
/// Opacity of the nearest ghost.
const NEAREST: f32 = 0.42;

/// A moment drawn with the present one.
#[derive(Debug, Default)]
pub struct Onion {
    companion: Companion,
}

/// Where the selected node goes over the clip, the model where the file has it.
#[derive(Debug, Default)]
pub struct Path {
    places: Vec<DVec3>,
    keys: Vec<DVec3>,
}

/// `0xRRGGBB` as numbers from 0 to 1.
pub(super) fn color(value: u32) -> Vec3 {
    let part = |shift: u32| (value >> shift & 255) as f32 / 255.0;
    Vec3::new(part(16), part(8), part(0))
}

impl Session {
    /// Which ghosts are drawn.
    pub fn ghosts(&self) -> Ghosts {
        self.ghosts
    }

    /// Changes which ghosts are drawn.
    pub fn change_ghosts(&mut self, change: impl FnOnce(&mut Ghosts)) {
        let before = self.ghosts;
        change(&mut self.ghosts);
        self.ghosts = self.ghosts.sane();
        if before != self.ghosts {
            self.changed(Changes::GHOSTS);
        }
    }

    /// The moments of the ghosts, each with its share of the way to the farthest one (above 0, to 1) and whether it is past; seconds. Those that
    /// the clip does not have are left out.
    fn ghost_moments(&self) -> Vec<(f64, f32, bool)> {
        let Ghosts { shown, before, after, step, .. } = self.ghosts;
        let Some(clip) = self.clip().filter(|clip| shown && clip.duration() > 0.0) else { return Vec::new() };
        let (start, end, now) = (clip.start, clip.end, self.playback.time);
        let apart = f64::from(step) / self.frame_rate;
        let side = |count: u32, past: bool| {
            (1..=count).map(move |k| {
                let way = if past { -f64::from(k) } else { f64::from(k) };
                (now + way * apart, k as f32 / count as f32, past)
            })
        };
        // A thousandth of a frame may be lost in the sums.
        let slack = 1e-3 / self.frame_rate;
        side(before, true).chain(side(after, false)).filter(|(time, ..)| *time >= start - slack && *time <= end + slack).collect()
    }

    /// Takes surfaces back from the frame, before it is posed.
    pub(super) fn recall_company(&mut self) {
        if let Some(comparison) = &mut self.comparison {
            comparison.recall(&mut self.frame);
        }
        for onion in self.onion.iter_mut().rev() {
            onion.companion.take_back(&mut self.frame);
        }
        self.frame.marks.clear();
    }

    /// Poses what accompanies the scene and puts it into the frame, which has just been posed.
    pub(super) fn invite_company(&mut self) {
        let state = self.state();
        self.measure_comparison(&state);
        let moments = self.ghost_moments();
        self.onion.resize_with(moments.len(), Onion::default);
        let bones = self.display.bones || !self.document.shows_surface();
        for ((time, part, past), onion) in moments.into_iter().zip(&mut self.onion) {
            let tint = color(if past { BEFORE } else { AFTER });
            let opacity = NEAREST * (1.0 - 0.75 * (part - 0.1).max(0.0));
            onion.companion.pose(&self.document, &PoseState { time, ..state });
            if bones {
                onion.companion.sketch_bones(&self.document.scene, tint, opacity * 1.6, &mut self.frame.marks);
            }
            onion.companion.lend(&mut self.frame, Ghost { tint, share: 0.65, opacity, materials: false, behind: BEHIND });
        }
        self.draw_path(&state);
        self.lend_comparison(bones);
    }

    fn draw_path(&mut self, state: &PoseState) {
        let Some(node) = self.display.selected.filter(|_| self.ghosts.path) else { return };
        let Some(duration) = self.clip().map(crate::animation::Clip::duration).filter(|duration| *duration > 0.0) else { return };
        let at_home = PoseState { model: glam::DMat4::IDENTITY, ..*state };
        let pieces = ((duration * self.frame_rate).ceil() as usize).clamp(1, PIECES) + 1;
        let path = self.path.get_or_insert_with(|| Path {
            places: self.document.node_path(&at_home, node, pieces).into_iter().map(|(_, place)| place).collect(),
            keys: self.document.node_places(&at_home, node, self.own_keys.get(..PIECES).unwrap_or(&self.own_keys)),
        });
        let paint = color(self.display.palette.selected);
        let place = |place: &DVec3| state.model.transform_point3(*place).as_vec3();
        let mark = |from: Vec3, to: Vec3, width: f32, opacity: f32| Mark { from, to, color: paint, opacity, width };
        let marks = &mut self.frame.marks;
        let ends = path.places.iter().zip(path.places.iter().skip(1));
        marks.extend(ends.map(|(from, to)| (place(from), place(to))).filter(|(from, to)| from != to).map(|(a, b)| mark(a, b, 1.8, 0.9)));
        marks.extend(path.keys.iter().map(place).map(|key| mark(key, key, 5.5, 1.0)));
        let now = self.frame.position(node);
        self.frame.marks.push(mark(now, now, 9.0, 1.0));
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::swinging;
    use super::*;
    use crate::scene::NodeId;

    #[test]
    fn ghosts_are_the_moments_round_the_present_one() {
        let mut session = Session::new(swinging());
        let own = session.frame().surfaces.len();
        assert!(own > 0);
        session.choose_rate(Some(10.0));
        session.change_ghosts(|ghosts| *ghosts = Ghosts { shown: true, before: 3, after: 2, step: 2, path: false });
        session.time(|time| time.seek(0.5));
        // Before: 0.3, 0.1; −0.1 is not in the clip. After: 0.7, 0.9.
        let times: Vec<i32> = session.ghost_moments().iter().map(|(time, ..)| (time * 10.0).round() as i32).collect();
        assert_eq!(times, [3, 1, 7, 9]);
        let frame = session.frame();
        assert_eq!(frame.surfaces.len(), own * 5);
        assert!(frame.surfaces.iter().skip(own).all(|surface| surface.ghost.is_some()));
        // Each ghost is where the thing itself is at that moment.
        let ghost = frame.surfaces[own * 3].position(0);
        session.change_ghosts(|ghosts| ghosts.shown = false);
        session.time(|time| time.seek(0.7));
        let frame = session.frame();
        assert_eq!(frame.surfaces.len(), own);
        assert!((frame.surfaces[0].position(0) - ghost).length() < 1e-5);
    }

    #[test]
    fn the_path_goes_through_the_keys() {
        let mut session = Session::new(swinging());
        session.select(session.document().scene.graph.find("arm"));
        session.change_ghosts(|ghosts| ghosts.path = true);
        let keys = session.own_keys().len();
        assert!(keys >= 2);
        let node = session.selected().expect("selected");
        let first = {
            session.time(|time| time.seek(0.0));
            session.frame().position(node)
        };
        let dots: Vec<Mark> = session.frame().marks.iter().filter(|mark| mark.from == mark.to).copied().collect();
        assert_eq!(dots.len(), keys + 1);
        assert!((dots[0].from - first).length() < 1e-6);
        session.select(Some(NodeId(0)));
        session.select(None);
        assert!(session.frame().marks.is_empty());
    }
}

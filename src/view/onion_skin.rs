//! Onion skins: the poses before and after the present one, drawn with it.

use super::onion_skin_settings::Ghosts;
use super::overlays::{PoseContext, color};
use crate::animation::Clip;
use crate::document::{Companion, PoseState};
use crate::scene::{Frame, Ghost};

/// What was is blue, what will be is green; told apart by more than colour: each fades with its distance in time.
const BEFORE: u32 = 0x53_9BF5;
const AFTER: u32 = 0x57_AB5A;
/// Thousandths of its distance by which a ghost stands back.
const BEHIND: f32 = 15.0;
/// Opacity of the nearest ghost.
const NEAREST: f32 = 0.42;

/// The moments that are drawn with the present one.
#[derive(Debug, Default)]
pub(super) struct OnionSkin {
    skins: Vec<Companion>,
}

impl OnionSkin {
    /// Takes surfaces back from the frame.
    pub(super) fn recall(&mut self, frame: &mut Frame) {
        for skin in self.skins.iter_mut().rev() {
            skin.take_back(frame);
        }
    }

    /// Poses the moments and puts them into the frame.
    pub(super) fn invite(&mut self, host: &PoseContext<'_>, ghosts: Ghosts, frame: &mut Frame) {
        let clip = host.state.clip.and_then(|clip| host.document.clips.get(clip));
        let moments = moments(clip, host.state.time, host.rate, ghosts);
        self.skins.resize_with(moments.len(), Companion::default);
        for ((time, part, past), skin) in moments.into_iter().zip(&mut self.skins) {
            let tint = color(if past { BEFORE } else { AFTER });
            let opacity = NEAREST * (1.0 - 0.75 * (part - 0.1).max(0.0));
            skin.pose(host.document, &PoseState { time, ..host.state });
            if host.bones {
                skin.sketch_bones(&host.document.scene, tint, opacity * 1.6, &mut frame.marks);
            }
            skin.lend(frame, Ghost { tint, share: 0.65, opacity, materials: false, behind: BEHIND });
        }
    }
}

/// The moments of the ghosts, each with its share of the way to the farthest one (above 0, to 1) and whether it is past; seconds. Those that
/// the clip does not have are left out.
fn moments(clip: Option<&Clip>, now: f64, rate: f64, ghosts: Ghosts) -> Vec<(f64, f32, bool)> {
    let Ghosts { shown, before, after, step, .. } = ghosts;
    let Some(clip) = clip.filter(|clip| shown && clip.duration() > 0.0) else { return Vec::new() };
    let apart = f64::from(step) / rate;
    let side = |count: u32, past: bool| {
        (1..=count).map(move |k| {
            let way = if past { -f64::from(k) } else { f64::from(k) };
            (now + way * apart, k as f32 / count as f32, past)
        })
    };
    // A thousandth of a frame may be lost in the sums.
    let slack = 1e-3 / rate;
    side(before, true).chain(side(after, false)).filter(|(time, ..)| *time >= clip.start - slack && *time <= clip.end + slack).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ghosts_are_the_moments_that_the_clip_has() {
        let clip = Clip { name: "swing".into(), end: 1.0, ..Clip::default() };
        let ghosts = Ghosts { shown: true, before: 3, after: 2, step: 2, path: false };
        let times =
            |clip, ghosts| moments(clip, 0.5, 10.0, ghosts).iter().map(|(time, ..)| (time * 10.0).round() as i32).collect::<Vec<_>>();
        // Before: 0.3, 0.1; −0.1 is not in the clip. After: 0.7, 0.9.
        assert_eq!(times(Some(&clip), ghosts), [3, 1, 7, 9]);
        assert!(times(Some(&clip), Ghosts { shown: false, ..ghosts }).is_empty() && times(None, ghosts).is_empty());
    }
}

//! Onion skins: the poses before and after the present one, drawn with it.

use super::onion_skin_settings::OnionSkinSettings;
use super::pose_context::{PoseContext, color};
use crate::document::PosedCopy;
use sinew_scene::animation::Clip;
use sinew_scene::{Frame, Ghost};

/// Past poses are blue, future ones green; both fade with their distance in time, so that colour is not the only cue.
const PAST_TINT: u32 = 0x53_9BF5;
const FUTURE_TINT: u32 = 0x57_AB5A;
/// Depth offset of an onion skin, thousandths of its distance from the camera.
const DEPTH_OFFSET: f32 = 15.0;
/// Opacity of the nearest onion skin.
const NEAREST_OPACITY: f32 = 0.42;

/// The poses that are drawn with the present one.
#[derive(Debug, Default)]
pub(super) struct OnionSkins {
    skins: Vec<PosedCopy>,
}

impl OnionSkins {
    /// Moves the surfaces out of the frame, back into the buffers.
    pub(super) fn remove_from(&mut self, frame: &mut Frame) {
        for skin in self.skins.iter_mut().rev() {
            skin.remove_from(frame);
        }
    }

    /// Poses the onion skins and appends them to the frame.
    pub(super) fn append_to(&mut self, context: &PoseContext<'_>, settings: OnionSkinSettings, frame: &mut Frame) {
        let clip = context.state.clip.and_then(|clip| context.document.clips.get(clip));
        let moments = moments(clip, context.state.time, context.frame_rate, settings);
        self.skins.resize_with(moments.len(), PosedCopy::default);
        for ((time, share, past), skin) in moments.into_iter().zip(&mut self.skins) {
            let tint = color(if past { PAST_TINT } else { FUTURE_TINT });
            let opacity = NEAREST_OPACITY * (1.0 - 0.75 * (share - 0.1).max(0.0));
            skin.pose(context.document, &context.state.at_time(time));
            if context.bones {
                skin.append_bone_lines(&context.document.scene, tint, opacity * 1.6, &mut frame.overlay_lines);
            }
            skin.append_to(frame, Ghost { tint, tint_share: 0.65, opacity, materials: false, depth_offset: DEPTH_OFFSET });
        }
    }
}

/// Times of the onion skins, seconds, each with its fraction of the distance to the farthest one (above 0, to 1) and whether it is past. Times that
/// lie outside of the clip are dropped.
fn moments(clip: Option<&Clip>, now: f64, rate: f64, settings: OnionSkinSettings) -> Vec<(f64, f32, bool)> {
    let OnionSkinSettings { shown, before, after, step, .. } = settings;
    let Some(clip) = clip.filter(|clip| shown && clip.duration() > 0.0) else { return Vec::new() };
    let seconds_apart = f64::from(step) / rate;
    let side = |count: u32, past: bool| {
        (1..=count).map(move |k| {
            let steps = if past { -f64::from(k) } else { f64::from(k) };
            (now + steps * seconds_apart, k as f32 / count as f32, past)
        })
    };
    // A thousandth of a frame may be lost in the sums.
    let tolerance = 1e-3 / rate;
    side(before, true)
        .chain(side(after, false))
        .filter(|(time, ..)| *time >= clip.start - tolerance && *time <= clip.end + tolerance)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn onion_skins_stay_within_the_clip() {
        let clip = Clip { name: "swing".into(), end: 1.0, ..Clip::default() };
        let settings = OnionSkinSettings { shown: true, before: 3, after: 2, step: 2, path: false };
        let times =
            |clip, settings| moments(clip, 0.5, 10.0, settings).iter().map(|(time, ..)| (time * 10.0).round() as i32).collect::<Vec<_>>();
        // Before: 0.3, 0.1; −0.1 is not in the clip. After: 0.7, 0.9.
        assert_eq!(times(Some(&clip), settings), [3, 1, 7, 9]);
        assert!(times(Some(&clip), OnionSkinSettings { shown: false, ..settings }).is_empty() && times(None, settings).is_empty());
    }
}

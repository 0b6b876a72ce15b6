//! Time of a session: clip, cursor, keys and the playback clock.

use std::sync::Arc;

use super::{AnimatedItem, ChangeSet, CurveGraph, Session, SheetRow, dope_sheet};
use crate::view::infer_frame_rate;
use sinew_scene::Label;
use sinew_scene::animation::{Clip, LoopMode, Playback};

/// One of the marks that bound what plays.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RangeMark {
    /// Where playing starts.
    A,
    /// Where it ends.
    B,
}

impl Session {
    /// The clip that plays.
    pub fn clip(&self) -> Option<&Clip> {
        self.state.clip.and_then(|index| self.document.clips.get(index))
    }

    /// Its index.
    pub fn clip_index(&self) -> Option<usize> {
        self.state.clip
    }

    /// The time cursor.
    pub fn playback(&self) -> &Playback {
        &self.playback
    }

    /// Frames a second of the frame numbers.
    pub fn frame_rate(&self) -> f64 {
        self.frame_rate
    }

    /// The frame rate that was chosen; `None` = the one that the keys tell.
    pub fn chosen_rate(&self) -> Option<f64> {
        self.view.frame_rate
    }

    /// The frame rate that the keys of the clip tell.
    pub fn own_rate(&self) -> f64 {
        infer_frame_rate(&self.keys)
    }

    /// Chooses the frame rate, above 0; `None` = the one that the keys tell.
    pub fn choose_rate(&mut self, rate: Option<f64>) {
        self.view.frame_rate = rate.filter(|rate| rate.is_finite() && *rate > 0.0);
        self.frame_rate = self.view.frame_rate.unwrap_or_else(|| self.own_rate());
        self.changed(ChangeSet::PLAYBACK);
    }

    /// The rows of the dope sheet: one for each thing that the clip moves.
    pub fn sheet_rows(&self) -> Arc<Vec<SheetRow>> {
        let make = || self.clip().map_or_else(Vec::new, dope_sheet::rows);
        self.sheet_rows.get_or_init(|| Arc::new(make())).clone()
    }

    /// What a row is called; `None` where the scene lacks what it stands for.
    pub fn sheet_label(&self, item: AnimatedItem) -> Option<Label<'_>> {
        dope_sheet::label(&self.document.scene, item)
    }

    /// The curves of a row, by kind.
    pub fn sheet_graphs(&self, moved: AnimatedItem) -> Vec<CurveGraph> {
        self.clip().map_or_else(Vec::new, |clip| dope_sheet::graphs(&self.document.scene, clip, moved))
    }

    /// Puts a mark at the frame nearest to a moment, at least one frame from the other.
    pub fn set_mark(&mut self, mark: RangeMark, time: f64) {
        if !time.is_finite() {
            return;
        }
        let rate = self.frame_rate;
        self.time(|cursor| {
            let frame = 1.0 / rate;
            let (start, end) = (cursor.start, cursor.end);
            let time = ((time * rate).round() / rate).clamp(start, end);
            match mark {
                RangeMark::A => cursor.mark_a = Some(time.min(cursor.mark_b.unwrap_or(end) - frame).max(start)),
                RangeMark::B => cursor.mark_b = Some(time.max(cursor.mark_a.unwrap_or(start) + frame).min(end)),
            }
        });
    }

    /// Bounds what plays by two moments, in any order.
    pub fn set_marks(&mut self, one: f64, other: f64) {
        self.time(|cursor| (cursor.mark_a, cursor.mark_b) = (None, None));
        self.set_mark(RangeMark::A, one.min(other));
        self.set_mark(RangeMark::B, one.max(other));
    }

    /// Key times of everything that the clip moves; seconds, ascending.
    pub fn all_keys(&self) -> &[f64] {
        &self.keys
    }

    /// Key times of the selected node; empty where it has none.
    pub fn own_keys(&self) -> &[f64] {
        &self.own_keys
    }

    /// Chooses the clip; the cursor goes to its start.
    pub fn set_clip(&mut self, index: Option<usize>) {
        if index != self.state.clip && index.is_none_or(|index| index < self.document.clips.len()) {
            let playing = self.playback.playing;
            self.take_clip(index);
            if playing {
                self.playback.play();
            }
            self.changed(ChangeSet::TIME | ChangeSet::PLAYBACK);
        }
    }

    /// The clip `by` places further on, round the end.
    pub fn next_clip(&mut self, by: isize) {
        let count = self.document.clips.len() as isize;
        if count > 0 {
            let now = self.state.clip.map_or(0, |index| index as isize);
            self.set_clip(Some((now + by).rem_euclid(count) as usize));
        }
    }

    pub(super) fn take_clip(&mut self, index: Option<usize>) {
        self.state.clip = index;
        let (start, end) = self.clip().map_or((0.0, 0.0), |clip| (clip.start, clip.end));
        let Playback { speed, mode, .. } = self.playback;
        self.playback = Playback { speed: speed.abs(), mode, ..Playback::new(start, end) };
        self.find_keys();
        self.frame_rate = self.view.frame_rate.unwrap_or_else(|| self.own_rate());
        self.needs_posing = true;
    }

    pub(super) fn find_keys(&mut self) {
        self.keys = self.clip().map_or_else(Vec::new, |clip| clip.key_times(None));
        self.sheet_rows.take();
        self.find_own_keys();
    }

    pub(super) fn find_own_keys(&mut self) {
        let own = self.clip().zip(self.view.display.highlight.selected).map(|(clip, node)| clip.key_times(Some(node)));
        self.own_keys = own.unwrap_or_default();
    }

    /// Changes the cursor and notices what came of it.
    pub fn time(&mut self, change: impl FnOnce(&mut Playback)) {
        let before = self.playback;
        change(&mut self.playback);
        let after = self.playback;
        if after.time != before.time {
            self.changed(ChangeSet::TIME);
        }
        if (Playback { time: before.time, ..after }) != before {
            self.changed(ChangeSet::PLAYBACK);
        }
    }

    /// Plays, or stops.
    pub fn toggle_playing(&mut self) {
        // If a drag ended with its destroyed widget, playback must not stay held.
        self.time_held = false;
        self.time(|time| if time.playing { time.pause() } else { time.play() });
    }

    /// Goes whole frames on or back, and stops.
    pub fn step_frames(&mut self, frames: i32) {
        let rate = self.frame_rate;
        self.time(|time| {
            time.pause();
            time.step(frames, rate);
        });
    }

    /// Goes to the next key (or the previous one) of the selection, or of everything where it has none, and stops.
    pub fn step_key(&mut self, forward: bool) {
        let keys = if self.own_keys.is_empty() { &self.keys } else { &self.own_keys };
        let key = if forward { self.playback.next_key(keys) } else { self.playback.previous_key(keys) };
        if let Some(key) = key {
            self.time(|time| {
                time.pause();
                time.seek(key);
            });
        }
    }

    /// Loop, once, ping-pong, loop …
    pub fn next_loop_mode(&mut self) {
        self.time(|time| {
            time.mode = match time.mode {
                LoopMode::Loop => LoopMode::Once,
                LoopMode::Once => LoopMode::PingPong,
                LoopMode::PingPong => LoopMode::Loop,
            };
        });
    }

    /// Holds the cursor during a drag, or releases it: while it is held, playback does not move it.
    pub fn hold_time(&mut self, held: bool) {
        self.time_held = held;
    }

    /// Lets `seconds` of the display's clock go by.
    pub fn advance(&mut self, seconds: f64) {
        if !self.time_held {
            self.time(|time| {
                time.advance(seconds);
            });
        }
        if self.view.camera.advance(seconds) {
            self.changed(ChangeSet::CAMERA);
        }
    }

    /// Whether something moves by itself, so that another frame is wanted.
    pub fn is_moving(&self) -> bool {
        self.playback.playing || self.view.camera.is_animating()
    }
}

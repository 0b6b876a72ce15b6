//! The pose that the options describe: clip, time, elbow angle or contraction.

use std::path::Path;

use clap::ArgMatches;

use super::arg_parsers::plain;
use super::output::{Failure, display_name, print_notice};
use super::value;
use crate::animation::Clip;
use crate::document::{Document, PoseState, SkinMotion};
use crate::i18n;
use crate::muscle::MuscleRig;
use crate::scene::NodeKind;
use crate::tr;

/// Seconds: a time that lies farther outside a clip than this is reported as a mistake; one that lies nearer is clamped without a message.
const MAX_TIME_OUTSIDE: f64 = 3600.0;

/// What the options say.
#[derive(Debug, Clone, Default)]
pub(super) struct PoseOptions {
    /// Seconds on the file's own time axis.
    pub time: Option<f64>,
    clip: Option<String>,
    angle: Option<f64>,
    contraction: Option<f64>,
    on_top: bool,
    skin_by_skeleton: bool,
}

impl PoseOptions {
    /// Takes the options from the command line.
    pub(super) fn given(given: &ArgMatches) -> Self {
        Self {
            time: value(given, "time"),
            clip: value(given, "clip"),
            angle: value(given, "angle"),
            contraction: value(given, "contraction"),
            on_top: given.get_flag("on-top"),
            skin_by_skeleton: given.get_flag("no-skin-follow"),
        }
    }

    /// Whether the elbow angle or the contraction is fixed.
    pub(super) fn fixes_muscles(&self) -> bool {
        self.angle.is_some() || self.contraction.is_some()
    }

    /// The state that poses `document` so. A time without a clip means the first clip that holds it, else the nearest; there the ends are held.
    ///
    /// # Errors
    /// [`Failure::Usage`] for a clip that the document has not, or an angle where nothing follows it.
    pub(super) fn state(&self, document: &Document, file: &Path) -> Result<PoseState, Failure> {
        self.over(document.start_state(), document, file)
    }

    /// [`PoseOptions::state`] on top of another one than the document's start.
    ///
    /// # Errors
    /// As there.
    pub(super) fn over(&self, mut state: PoseState, document: &Document, file: &Path) -> Result<PoseState, Failure> {
        if self.skin_by_skeleton {
            state.skin = SkinMotion::Skeleton;
        }
        if let Some(name) = &self.clip {
            let found = document.clip_named(name).ok_or_else(|| unknown_clip(document, file, name))?;
            state.clip = Some(found);
        } else if let (Some(time), Some(_)) = (self.time, state.clip) {
            state.clip = clip_at(&document.clips, time).or(state.clip);
        }
        if let Some(clip) = state.clip.and_then(|index| document.clips.get(index)) {
            let kept = if self.clip.is_some() { clip.start } else { state.time };
            state.time = self.time.unwrap_or(kept).max(clip.start).min(clip.end.max(clip.start));
            if self.time.is_some_and(|time| (time - state.time).abs() > MAX_TIME_OUTSIDE) {
                let (start, end) = (plain(clip.start), plain(clip.end));
                print_notice(&tr!("cli-measure-time-held", file = display_name(file), start = start, end = end));
            }
        }
        if let Some(angle) = self.angle {
            match document.driven_rig().filter(|rig| rig.flexion_range().is_some()) {
                Some(rig) => state.joints.drive = rig.at_flexion(angle),
                None => {
                    let joint = document.joint().ok_or_else(|| no_joint_failure(document, file))?;
                    state.joints.rotation = Some(if self.on_top { joint.relative(angle) } else { joint.absolute(angle) });
                }
            }
            let range =
                document.driven_rig().and_then(MuscleRig::flexion_range).or_else(|| document.joint().map(|j| j.range[0]..=j.range[1]));
            if let Some(range) = range.filter(|range| !self.on_top && !range.contains(&angle)) {
                print_notice(&tr!(
                    "cli-angle-held",
                    file = display_name(file),
                    angle = plain(angle),
                    low = plain(*range.start()),
                    high = plain(*range.end())
                ));
            }
        }
        if let Some(contraction) = self.contraction {
            let rig = document.driven_rig().ok_or_else(|| Failure::usage(tr!("cli-no-muscle-to-drive", file = display_name(file))))?;
            if rig.is_drivable() {
                state.joints.drive = rig.at_contraction(contraction);
            } else {
                let turn = document.joint_rotation_for_contraction(&state, contraction);
                let turn = turn.ok_or_else(|| Failure::usage(tr!("cli-nothing-to-contract", file = display_name(file))))?;
                state.joints.rotation = Some(turn);
            }
        }
        Ok(state)
    }
}

/// The first of the clips that are nearest to `time`, seconds: those of a file share one time axis.
fn clip_at(clips: &[Clip], time: f64) -> Option<usize> {
    // Far away from all of them the differences would round to the same.
    let end = clips.iter().map(|clip| clip.end).fold(f64::NEG_INFINITY, f64::max);
    let start = clips.iter().map(|clip| clip.start).fold(f64::INFINITY, f64::min);
    let time = time.min(end).max(start);
    let away = |clip: &Clip| (clip.start - time).max(time - clip.end).max(0.0);
    (0..clips.len()).min_by(|a, b| {
        let away = |index: &usize| clips.get(*index).map_or(f64::INFINITY, away);
        away(a).total_cmp(&away(b))
    })
}

fn no_joint_failure(document: &Document, file: &Path) -> Failure {
    let file = display_name(file);
    Failure::usage(if document.muscle_count() > 0 && document.scene.graph.iter().all(|(_, node)| node.kind != NodeKind::Joint) {
        tr!("cli-no-arm-to-bend", file = file)
    } else {
        tr!("cli-no-elbow-to-bend", file = file)
    })
}

/// No clip has the name that was given.
pub(super) fn unknown_clip(document: &Document, file: &Path, name: &str) -> Failure {
    /// A sentence with more names than this is no sentence.
    const NAMED: usize = 20;
    let file = display_name(file);
    if document.clips.is_empty() {
        return Failure::usage(tr!("cli-no-clips", file = file, name = name));
    }
    let mut names = document.clips.iter().take(NAMED).map(|clip| i18n::label(clip.label())).collect::<Vec<_>>().join(", ");
    if document.clips.len() > NAMED {
        names.push_str(", …");
    }
    Failure::usage(tr!("cli-no-such-clip", file = file, name = name, names = names))
}

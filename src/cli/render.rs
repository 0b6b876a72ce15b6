//! `sinew render`: pictures without a window.

use std::path::{Path, PathBuf};

use clap::ArgMatches;
use glam::Vec3;

use super::arg_parsers::{BackgroundArg, ValueRange, plain};
use super::export::allow_overwriting;
use super::output::{Failure, display_name, output_name, print_error, print_verbose, refuse_number_pattern, wrong_extension};
use super::pose_options::PoseOptions;
use super::{files, progress, value};
use crate::document::{Document, OpenOptions, PoseState};
use crate::export::gif;
use crate::formats::SCENE_READERS;
use crate::i18n;
use crate::limits;
use crate::muscle::MuscleRig;
use crate::output::OverwriteGuard;
use crate::progress::Progress;
use crate::render::{Background, Display, Samples, Shading};
use crate::scene::ViewDirection;
use crate::sequence::{
    self, Direction, FittedOrbit, FrameSpec, FrameTimes, Motion, OutputTarget, Sequence, SequenceError, SequenceOptions, SequenceRenderer,
    posed_bounds,
};
use crate::tr;
use crate::view::{self, Opened, SceneOverlays, ViewState};

/// Columns and rows where the call does not say.
const SIZE: (u32, u32) = (1280, 720);

/// Runs the subcommand.
pub(super) fn run(given: &ArgMatches) -> Result<(), Failure> {
    let files = files(given);
    // Both are required by the parser.
    let (Some(first), Some(out)) = (files.first(), value::<PathBuf>(given, "output")) else {
        return Err(Failure::usage(tr!("cli-usage-error")));
    };
    let target = OutputTarget::of(&out).ok_or_else(|| wrong_extension(&out, "cli-render-ending"))?;
    match &target {
        OutputTarget::Pictures(pattern) if pattern.has_second() => {
            return Err(Failure::usage(tr!("cli-pattern-twice", out = output_name(&out))));
        }
        OutputTarget::Pictures(_) => {}
        _ => refuse_number_pattern(&out)?,
    }
    let (size, scale) = size(given)?;
    let guard = OverwriteGuard::of_files(&files);
    guard.output(&out)?;
    let opened = view::open(&files, OpenOptions::new(SCENE_READERS), &Progress::default())?;
    let guard = guard.and_of(&opened.guard(first.parent().unwrap_or(Path::new(""))));
    let Opened { document, session: saved, compared } = opened;
    print_verbose(document.diagnostics.iter().map(i18n::finding_line));
    let pose_state = PoseOptions::given(given);
    let start = saved.as_ref().map_or_else(|| document.start_state(), |saved| saved.pose_state(&document));
    let state = pose_state.over(start.clone(), &document, first)?;
    let sequence = match target {
        OutputTarget::Picture(_) => single(given, state.clone())?,
        _ => sequence(given, &pose_state, &document, state.clone()).map_err(|refusal| refused(refusal, given, &display_name(first)))?,
    };
    if matches!(target, OutputTarget::Gif(_)) && sequence.fps > gif::MOST_FPS {
        return Err(Failure::usage(tr!("cli-gif-fps", limit = gif::MOST_FPS)));
    }
    target.files(&sequence).try_for_each(|file| guard.output(&file).map(drop))?;
    allow_overwriting(given, target.files(&sequence))?;
    let aspect = size.0 as f32 / size.1 as f32;
    let bounds = if sequence.is_turntable_only() { posed_bounds(&document, &state) } else { document.motion_bounds(&state) };
    let other = compared.map(|(path, other)| (path.display().to_string(), other));
    let (overlays, rate) = saved.as_ref().map_or_else(Default::default, |saved| SceneOverlays::from_session(saved, &document, other));
    let mut wide = bounds;
    if let Some(other) = overlays.motion_bounds(&document, &state) {
        wide.merge(&other);
    }
    let mut view = match saved.as_deref() {
        Some(saved) => saved.view_state(&document, &start, &wide, &bounds),
        // What is only a help on the screen, such as the ground grid, stays away unless it is asked for or a session shows it.
        None => ViewState { display: Display { grid: false, ..Display::default() }, ..ViewState::default() },
    };
    if chooses_direction(given) || !saved.as_ref().is_some_and(|saved| saved.has_camera(&document)) {
        let fitted = FittedOrbit::fit(direction(given), &wide, aspect, sequence.has_turntable());
        view.camera.change(|orbit| *orbit = fitted.orbit());
        view.follow = None;
    }
    // In a sequence the ground lies still.
    let ground = (sequence.count > 1).then_some(bounds);
    view.display = Display { scale, ground, ..display(given, view.display, !document.shows_surface()) };
    let count = sequence.count;
    let mut renderer = SequenceRenderer::new(&document, sequence, view, value(given, "threads")).with_overlays(overlays, rate);
    let call = call_note(given, &files, size, scale);
    let note = |spec: &FrameSpec| format!("{call}{}", frame_note(&document, spec));
    progress::run_with_progress(count, |work| sequence::save(&mut renderer, size, (&target, &guard), &note, work))?;
    print_verbose([tr!(
        "cli-written",
        out = output_name(&out),
        count = count,
        width = plain(size.0.into()),
        height = plain(size.1.into())
    )]);
    if given.get_flag("stats") {
        report(&renderer.take_times());
    }
    Ok(())
}

/// The picture's columns and rows, and how many times larger than usual everything in it is.
fn size(given: &ArgMatches) -> Result<((u32, u32), f32), Failure> {
    let (width, height) = value::<(u32, u32)>(given, "size").unwrap_or(SIZE);
    let scale = value::<f64>(given, "scale").unwrap_or(1.0);
    let side = |side: u32| (f64::from(side) * scale).round().max(1.0) as u32;
    let size = (side(width), side(height));
    if size.0.max(size.1) > limits::PICTURE_SIDE {
        return Err(Failure::usage(tr!("cli-scale-too-large", limit = plain(limits::PICTURE_SIDE.into()))));
    }
    Ok((size, scale as f32))
}

/// One picture; options that speak of several are refused.
fn single(given: &ArgMatches, state: PoseState) -> Result<Sequence, Failure> {
    let values = ["from", "to", "duration", "fps", "sweep-angle", "sweep-contraction"].into_iter().find(|id| given.contains_id(id));
    let flag = given.get_flag("turntable").then_some("turntable");
    match values.or(flag) {
        Some(option) => Err(Failure::usage(tr!("cli-needs-sequence", option = format!("--{option}")))),
        None => Ok(Sequence::single(state)),
    }
}

fn sequence(given: &ArgMatches, pose_state: &PoseOptions, document: &Document, state: PoseState) -> Result<Sequence, SequenceError> {
    let sweep = |id| value::<ValueRange>(given, id);
    let has_clip = state.clip.is_some();
    let motion = match (sweep("sweep-angle"), sweep("sweep-contraction")) {
        (Some(ValueRange(from, to)), _) => Motion::Angle(from, to),
        (None, Some(ValueRange(from, to))) => Motion::Contraction(from, to),
        (None, None) if has_clip && pose_state.time.is_some() => Motion::Still,
        (None, None) if !has_clip && pose_state.fixes_muscles() => Motion::Still,
        (None, None) => Motion::Play,
    };
    let turning = given.get_flag("turntable");
    let seconds = |id| value::<f64>(given, id);
    let options = SequenceOptions {
        motion,
        from: seconds("from"),
        to: seconds("to"),
        duration: seconds("duration"),
        fps: seconds("fps"),
        turntable: turning,
    };
    Sequence::new(&options, document, state)
}

fn refused(refusal: SequenceError, given: &ArgMatches, file: &str) -> Failure {
    Failure::usage(match refusal {
        // Of an end that was not given, the movement's own is meant.
        SequenceError::Empty { from, to } if !given.contains_id("to") => {
            tr!("cli-range-late", file = file, from = plain(from), end = plain(to))
        }
        SequenceError::Empty { from, to } if !given.contains_id("from") => {
            tr!("cli-range-early", file = file, start = plain(from), to = plain(to))
        }
        SequenceError::Empty { from, to } => tr!("cli-range-empty", from = plain(from), to = plain(to)),
        SequenceError::TooMany => tr!("cli-too-many-frames", limit = plain(sequence::MAX_FRAMES as f64)),
        SequenceError::NoElbow => tr!("cli-no-elbow-to-bend", file = file),
        SequenceError::NoMuscle => tr!("cli-no-muscle-to-drive", file = file),
    })
}

/// Takes `--camera`, `--yaw`, `--pitch` and `--zoom`. The named cameras but `orbit` have parallel rays; yaw and pitch replace their angles.
fn direction(given: &ArgMatches) -> Direction {
    let (view, parallel) = match value::<String>(given, "camera").as_deref() {
        Some("front") => (ViewDirection::Front, true),
        Some("right") => (ViewDirection::Right, true),
        Some("top") => (ViewDirection::Top, true),
        Some("iso") => (ViewDirection::Iso, true),
        _ => (ViewDirection::Start, false),
    };
    let (yaw, pitch) = view.angles();
    Direction {
        // Whole turns go first: in `f32` a large angle would have no degrees left.
        yaw: value::<f64>(given, "yaw").map_or(yaw, |yaw| (yaw % 360.0) as f32),
        pitch: value::<f64>(given, "pitch").map_or(pitch, |pitch| pitch as f32),
        parallel,
        zoom: value::<f64>(given, "zoom").map_or(1.0, |zoom| zoom as f32),
    }
}

/// Whether the options say where to look from.
fn chooses_direction(given: &ArgMatches) -> bool {
    ["camera", "yaw", "pitch", "zoom"].into_iter().any(|id| given.contains_id(id))
}

/// Options without a value that set a display flag: the option, the flag, and what it becomes.
const LOOK_FLAGS: [(&str, &str, bool); 9] = [
    ("bones", "bones", true),
    ("wireframe", "wireframe", true),
    ("grid", "grid", true),
    ("axes", "axes", true),
    ("bounding-box", "bounding-box", true),
    ("lines-of-action", "lines-of-action", true),
    ("no-materials", "materials", false),
    ("no-normals", "smooth-normals", false),
    ("no-see-through", "see-through", false),
];

/// Display options: those of the command line over `defaults`. The bones of a file without surfaces are always drawn.
fn display(given: &ArgMatches, defaults: Display, only_bones: bool) -> Display {
    let mut display = Display {
        shading: match value::<String>(given, "shading").as_deref() {
            Some("flat") => Shading::Flat,
            Some("phong") => Shading::Phong,
            Some(_) => Shading::Gouraud,
            None => defaults.shading,
        },
        samples: match value::<String>(given, "samples").as_deref() {
            Some("1") => Samples::One,
            Some(_) => Samples::Four,
            None => defaults.samples,
        },
        bones: defaults.bones || only_bones,
        background: match value::<BackgroundArg>(given, "background") {
            Some(BackgroundArg::None) => Background::Transparent,
            Some(BackgroundArg::Color(color)) => Background::Solid(color),
            None => defaults.background,
        },
        light: value::<Vec3>(given, "light").or(defaults.light),
        ..defaults
    };
    for (option, name, on) in LOOK_FLAGS {
        if let Some((_, flag)) = view::DISPLAY_FLAGS.iter().find(|(known, _)| *known == name && given.get_flag(option)) {
            *flag(&mut display) = on;
        }
    }
    display
}

/// The part of the note that changes from picture to picture.
fn frame_note(document: &Document, spec: &FrameSpec) -> String {
    let mut note = String::new();
    if let Some(clip) = spec.state.clip.and_then(|index| document.clips.get(index)) {
        note.push_str(&format!(" --clip {} --time {}", quoted(&clip.label().plain()), spec.state.time));
    }
    if document.driven_rig().is_some_and(MuscleRig::is_drivable) {
        // `+ 0.0` turns a negative zero into zero.
        note.push_str(&format!(" --contraction {}", spec.state.joints.drive.contraction + 0.0));
    }
    if let (Some(turn), Some(joint)) = (spec.state.joints.rotation, document.joint()) {
        let (angle, option) = if turn.on_top { (turn.degrees, " --on-top") } else { (turn.degrees + joint.at_rest, "") };
        note.push_str(&format!(" --angle {}{option}", angle + 0.0));
    }
    if spec.turntable != 0.0 {
        note.push_str(&format!(" (turned by {}°)", spec.turntable));
    }
    note
}

/// The call without what names its output: files and options of the look, as they were given.
fn call_note(given: &ArgMatches, files: &[PathBuf], size: (u32, u32), scale: f32) -> String {
    let mut note = String::from("sinew render");
    for file in files {
        note.push_str(&format!(" {}", quoted(&display_name(file))));
    }
    let (width, height) = value::<(u32, u32)>(given, "size").unwrap_or(if scale == 1.0 { size } else { SIZE });
    note.push_str(&format!(" --size {width}x{height}"));
    for id in ["scale", "camera", "yaw", "pitch", "zoom", "light", "shading", "samples", "background"] {
        if let Some(text) = given.get_raw(id).and_then(|mut values| values.next()) {
            note.push_str(&format!(" --{id} {}", quoted(&text.to_string_lossy())));
        }
    }
    for option in LOOK_FLAGS.iter().map(|(option, ..)| *option).chain(["no-skin-follow"]) {
        if given.get_flag(option) {
            note.push_str(&format!(" --{option}"));
        }
    }
    note
}

/// A word as a shell takes it.
fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_alphanumeric() || "-_./,:%+=@".contains(c);
    if !word.is_empty() && word.chars().all(plain) { word.to_owned() } else { format!("'{}'", word.replace('\'', r"'\''")) }
}

/// Prints the median of each stage to standard error.
fn report(times: &[FrameTimes]) {
    for (name, stage) in ["pose", "deform", "vertex", "raster", "resolve"].iter().zip(0..) {
        let medians = median(times.iter().filter_map(|times| times.get(stage).copied()).collect());
        print_error(&format!("{name} {medians:.3} ms"));
    }
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let middle = values.len() / 2;
    match (values.get(middle), middle.checked_sub(1).and_then(|below| values.get(below))) {
        (Some(upper), Some(lower)) if values.len().is_multiple_of(2) => (upper + lower) / 2.0,
        (Some(value), _) => *value,
        (None, _) => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_flag_of_the_look_is_one_of_the_display() {
        assert!(LOOK_FLAGS.iter().all(|(_, name, _)| view::DISPLAY_FLAGS.iter().any(|(known, _)| known == name)));
    }

    #[test]
    fn medians_lie_in_the_middle() {
        assert_eq!(median(vec![3.0, 1.0, 2.0]), 2.0);
        assert_eq!(median(vec![4.0, 1.0]), 2.5);
        assert_eq!(median(vec![7.0]), 7.0);
        assert_eq!(median(Vec::new()), 0.0);
    }

    #[test]
    fn words_are_quoted_for_a_shell() {
        assert_eq!(quoted("walk.dae"), "walk.dae");
        assert_eq!(quoted("it's here"), r"'it'\''s here'");
        assert_eq!(quoted("#fff"), "'#fff'");
        assert_eq!(quoted(""), "''");
    }
}

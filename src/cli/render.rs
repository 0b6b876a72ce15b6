//! `sinew render`: pictures without a window.

use std::path::{Path, PathBuf};

use clap::ArgMatches;
use glam::Vec3;

use super::export::{ending, refuse_overwriting};
use super::failure::{Failure, complain, display_name};
use super::framing::{Direction, Eye, posed_bounds};
use super::moment::Moment;
use super::sequence::{Pattern, Sequence, Shot};
use super::values::Backdrop;
use super::{files, value};
use crate::collada::Progress;
use crate::document::{Document, PoseBuffers};
use crate::export::palette::Sampler;
use crate::export::{gif, png};
use crate::muscle::Rig;
use crate::render::{Background, Display, Framebuffer, Renderer, Samples, Shading};
use crate::scene::Frame;
use crate::tr;

/// Columns and rows where the call does not say.
const SIZE: (u32, u32) = (1280, 720);

/// Frames that the palette of an animation is made from.
const PALETTE_FRAMES: usize = 12;

/// Runs the subcommand.
pub fn run(given: &ArgMatches) -> Result<(), Failure> {
    let files = files(given);
    // Both are required by the parser.
    let (Some(first), Some(out)) = (files.first(), value::<PathBuf>(given, "output")) else {
        return Err(Failure::usage(tr!("cli-call-wrong")));
    };
    let target = Target::of(&out)?;
    refuse_overwriting(&files, &out)?;
    let document = Document::open(&files, &Progress::default())?;
    let moment = Moment::given(given);
    let state = moment.state(&document, first)?;
    let sequence = match target {
        Target::Picture => Sequence::single(given, state)?,
        Target::Pictures(_) | Target::Animation => Sequence::given(given, &moment, &document, state)?,
    };
    if matches!(target, Target::Animation) && sequence.fps > gif::MOST_FPS {
        return Err(Failure::usage(tr!("cli-gif-fps", limit = gif::MOST_FPS)));
    }
    let size = value::<(u32, u32)>(given, "size").unwrap_or(SIZE);
    let aspect = size.0 as f32 / size.1 as f32;
    let bounds = if sequence.only_turns() { posed_bounds(&document, &state) } else { document.reach(&state) };
    let eye = Eye::fit(Direction::given(given), &bounds, aspect, sequence.turning());
    let (width, height) = size;
    let images = document.scene.images.iter().filter_map(|image| image.path.clone());
    let mut studio = Studio {
        document: &document,
        sequence,
        eye,
        display: display(given, !document.shows_surface()),
        renderer: Renderer::new(value(given, "threads")),
        buffers: PoseBuffers::default(),
        frame: Frame::default(),
        picture: Framebuffer { width, height, pixels: vec![0; width as usize * height as usize] },
        note: call_note(given, &files, size),
        times: Vec::new(),
        protected: files.iter().cloned().chain(images).collect(),
    };
    match target {
        Target::Picture => studio.save_picture(0, &out)?,
        Target::Pictures(pattern) => (0..sequence.count).try_for_each(|index| studio.save_picture(index, &pattern.file(index)))?,
        Target::Animation => studio.save_animation(&out)?,
    }
    if given.get_flag("stats") {
        report(&studio.times);
    }
    Ok(())
}

/// What is to be written.
enum Target {
    /// One PNG.
    Picture,
    /// A PNG a frame.
    Pictures(Pattern),
    /// A GIF.
    Animation,
}

impl Target {
    fn of(out: &Path) -> Result<Self, Failure> {
        match ending(out).as_str() {
            "png" => Ok(out.to_str().and_then(Pattern::of).map_or(Self::Picture, Self::Pictures)),
            "gif" => Ok(Self::Animation),
            _ => Err(Failure::usage(tr!("cli-render-ending", out = display_name(out)))),
        }
    }
}

/// How things look, from the options. What is only a help on the screen, such as the ground grid, stays away; the bones of a file that has
/// nothing else are drawn without being asked for.
fn display(given: &ArgMatches, only_bones: bool) -> Display {
    let usual = Display::default();
    Display {
        shading: match value::<String>(given, "shading").as_deref() {
            Some("flat") => Shading::Flat,
            Some("phong") => Shading::Phong,
            _ => Shading::Gouraud,
        },
        samples: if value::<String>(given, "samples").as_deref() == Some("1") { Samples::One } else { Samples::Four },
        materials: !given.get_flag("no-materials"),
        smooth_normals: !given.get_flag("no-normals"),
        wireframe: given.get_flag("wireframe"),
        bones: only_bones || given.get_flag("bones"),
        grid: false,
        background: match value::<Backdrop>(given, "background") {
            Some(Backdrop::None) => Background::Transparent,
            Some(Backdrop::Color(color)) => Background::Solid(color),
            None => usual.background,
        },
        light: value::<Vec3>(given, "light"),
        ..usual
    }
}

/// Milliseconds of one frame's stages: pose, deform, vertex, raster, resolve.
type Times = [f64; 5];

/// Everything that is used again from picture to picture.
struct Studio<'a> {
    document: &'a Document,
    sequence: Sequence,
    eye: Eye,
    display: Display,
    renderer: Renderer,
    buffers: PoseBuffers,
    frame: Frame,
    picture: Framebuffer,
    /// What made the picture, as a call that makes it again.
    note: String,
    times: Vec<Times>,
    /// Files that no picture may replace.
    protected: Vec<PathBuf>,
}

impl Studio<'_> {
    /// Poses and draws picture `index` into `self.picture`.
    fn draw(&mut self, index: usize) -> Shot {
        let shot = self.sequence.shot(self.document, index);
        self.document.pose(&shot.state, &mut self.buffers, &mut self.frame);
        let camera = self.eye.camera(shot.turn);
        let Framebuffer { width, height, pixels } = &mut self.picture;
        let target = bytemuck::cast_slice_mut(pixels);
        let stride = *width as usize * 4;
        self.renderer.draw_into(&self.document.scene, &self.frame, &camera, &self.display, *width, *height, target, stride);
        let (posed, drawn) = (self.buffers.times(), self.renderer.stats());
        self.times.push([posed.pose_ms, posed.deform_ms, drawn.vertex_ms, drawn.raster_ms, drawn.resolve_ms]);
        shot
    }

    fn transparent(&self) -> bool {
        self.display.background == Background::Transparent
    }

    fn save_picture(&mut self, index: usize, out: &Path) -> Result<(), Failure> {
        refuse_overwriting(&self.protected, out)?;
        let shot = self.draw(index);
        let note = format!("{}{}", self.note, shot_note(self.document, &shot));
        let software = concat!("Sinew ", env!("CARGO_PKG_VERSION"));
        png::save(out, &self.picture, self.transparent(), &[("Software", software), ("Comment", &note)])?;
        Ok(())
    }

    fn save_animation(&mut self, out: &Path) -> Result<(), Failure> {
        refuse_overwriting(&self.protected, out)?;
        let count = self.sequence.count;
        let tries = count.min(PALETTE_FRAMES);
        let mut sampler = Sampler::new(tries);
        for i in 0..tries {
            self.draw(i * count / tries);
            sampler.add(&self.picture);
        }
        self.times.clear();
        let settings = gif::Settings {
            size: (self.picture.width, self.picture.height),
            fps: self.sequence.fps,
            alpha: self.transparent(),
            palette: sampler.palette(),
        };
        gif::save(out, settings, |sink| {
            (0..count).try_for_each(|index| {
                self.draw(index);
                sink.frame(&self.picture)
            })
        })?;
        Ok(())
    }
}

/// The part of the note that changes from picture to picture.
fn shot_note(document: &Document, shot: &Shot) -> String {
    let mut note = String::new();
    if let Some(clip) = shot.state.clip.and_then(|index| document.clips.get(index)) {
        note.push_str(&format!(" --clip {} --time {}", quoted(&clip.name), shot.state.time));
    }
    if document.driven_rig().is_some_and(Rig::is_drivable) {
        // `+ 0.0` turns a negative zero into zero.
        note.push_str(&format!(" --contraction {}", shot.state.drive.contraction + 0.0));
    }
    if let (Some(turn), Some(joint)) = (shot.state.turn, document.joint()) {
        let (angle, option) = if turn.on_top { (turn.degrees, " --on-top") } else { (turn.degrees + joint.at_rest, "") };
        note.push_str(&format!(" --angle {}{option}", angle + 0.0));
    }
    if shot.turn != 0.0 {
        note.push_str(&format!(" (turned by {}°)", shot.turn));
    }
    note
}

/// The call without what names its output: files and options of the look, as they were given.
fn call_note(given: &ArgMatches, files: &[PathBuf], size: (u32, u32)) -> String {
    let mut note = String::from("sinew render");
    for file in files {
        note.push_str(&format!(" {}", quoted(&display_name(file))));
    }
    note.push_str(&format!(" --size {}x{}", size.0, size.1));
    for id in ["camera", "yaw", "pitch", "zoom", "light", "shading", "samples", "background"] {
        if let Some(text) = given.get_raw(id).and_then(|mut values| values.next()) {
            note.push_str(&format!(" --{id} {}", quoted(&text.to_string_lossy())));
        }
    }
    for id in ["bones", "wireframe", "no-materials", "no-normals"] {
        if given.get_flag(id) {
            note.push_str(&format!(" --{id}"));
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
fn report(times: &[Times]) {
    for (name, stage) in ["pose", "deform", "vertex", "raster", "resolve"].iter().zip(0..) {
        let medians = median(times.iter().filter_map(|times| times.get(stage).copied()).collect());
        complain(&format!("{name} {medians:.3} ms"));
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

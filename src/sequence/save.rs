//! From a sequence to files: a picture, numbered pictures, GIF, APNG, MP4, WebM. All or nothing: old files stay until everything is drawn.

use std::path::PathBuf;
use std::thread;

use super::{FrameSpec, Pattern, Sequence, SequenceRenderer};
use crate::export::atomic_file::{prepare, write_whole};
use crate::export::color_quantizer::Sampler;
use crate::export::guard::{Guard, Output};
use crate::export::pipeline::{self, Work};
use crate::export::png::{Compression, SOFTWARE};
use crate::export::video::{self, Kind};
use crate::export::{ExportError, apng, gif, png};
use crate::render::Framebuffer;

/// Frames that the palette of a GIF is made from.
const PALETTE_FRAMES: usize = 12;

/// What is written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Target {
    /// One PNG.
    Picture(PathBuf),
    /// A PNG a frame.
    Pictures(Pattern),
    /// A GIF.
    Gif(PathBuf),
    /// An APNG.
    Apng(PathBuf),
    /// A film made by the user's `ffmpeg`.
    Video(PathBuf, Kind),
}

impl Target {
    /// What a file name asks for by its ending; `None` for one that is not known.
    pub fn of(out: &std::path::Path) -> Option<Self> {
        let ending = out.extension().map(|ending| ending.to_string_lossy().to_lowercase()).unwrap_or_default();
        Some(match ending.as_str() {
            "png" => Pattern::of(out).map_or_else(|| Self::Picture(out.to_owned()), Self::Pictures),
            "gif" => Self::Gif(out.to_owned()),
            "apng" => Self::Apng(out.to_owned()),
            "mp4" => Self::Video(out.to_owned(), Kind::Mp4),
            "webm" => Self::Video(out.to_owned(), Kind::Webm),
            _ => return None,
        })
    }

    /// The files that a sequence would be written to.
    pub fn files<'a>(&'a self, sequence: &Sequence) -> Box<dyn Iterator<Item = PathBuf> + 'a> {
        match self {
            Self::Picture(file) | Self::Gif(file) | Self::Apng(file) | Self::Video(file, _) => Box::new(std::iter::once(file.clone())),
            Self::Pictures(pattern) => Box::new((0..sequence.count).map(|index| pattern.file(index))),
        }
    }
}

/// Draws the studio's sequence in `size` and writes it to `target`, but over none of the files that `guard` holds. `note` says how a picture was made; it is kept in the file. Drawing and
/// writing go on at the same time, the frames are in order, and each is to the bit what it is as a single picture.
///
/// # Errors
/// [`ExportError`] where something cannot be written, [`ExportError::Cancelled`] where `work` said so; then nothing is left and what was
/// there before still is.
pub fn save(
    studio: &mut SequenceRenderer<'_>,
    size: (u32, u32),
    (target, guard): (&Target, &Guard),
    note: &(dyn Fn(&FrameSpec) -> String + Sync),
    work: &Work,
) -> Result<(), ExportError> {
    let result = write(studio, size, (target, guard), note, work);
    // Whatever broke off then broke off for that reason.
    if result.is_err() && work.is_cancelled() { Err(ExportError::Cancelled) } else { result }
}

fn write(
    studio: &mut SequenceRenderer<'_>,
    size: (u32, u32),
    (target, guard): (&Target, &Guard),
    note: &(dyn Fn(&FrameSpec) -> String + Sync),
    work: &Work,
) -> Result<(), ExportError> {
    match target {
        Target::Picture(file) => {
            let mut picture = Framebuffer::new(size.0, size.1).map_err(|error| ExportError::io(file, error))?;
            let shot = studio.draw(0, &mut picture);
            let (alpha, comment) = (studio.is_transparent(), note(&shot));
            let notes = [("Software", SOFTWARE), ("Comment", comment.as_str())];
            write_whole(&guard.output(file)?, |out| png::encode(work.guard(out), &picture, alpha, &notes, Compression::Small))?;
            work.done.store(1, std::sync::atomic::Ordering::Relaxed);
            Ok(())
        }
        Target::Pictures(pattern) => save_pictures(studio, size, (pattern, guard), note, work),
        Target::Gif(file) => save_gif(studio, size, &guard.output(file)?, work),
        Target::Apng(file) => {
            let (alpha, fps, count) = (studio.is_transparent(), studio.sequence.fps, studio.sequence.count);
            let comment = note(&studio.sequence.shot(studio.document(), 0));
            write_whole(&guard.output(file)?, |out| {
                let mut sink = apng::Sink::begin(out, size, count, fps, alpha, &[("Software", SOFTWARE), ("Comment", &comment)])?;
                roll(studio, size, work, || (), |(), _, picture| Ok(apng::rows(picture, alpha)), |rows| sink.frame(rows))?;
                sink.finish()
            })
        }
        Target::Video(file, kind) => {
            let (alpha, fps) = (studio.is_transparent(), studio.sequence.fps);
            let comment = note(&studio.sequence.shot(studio.document(), 0));
            let mut sink = video::Sink::begin(&guard.output(file)?, *kind, size, fps, alpha, &comment)?;
            roll(studio, size, work, || (), |(), _, picture| Ok(apng::rows(picture, alpha)), |rows| sink.frame(&rows))
                .map_err(|error| ExportError::io(file, error))?;
            sink.finish()
        }
    }
}

fn save_pictures(
    studio: &mut SequenceRenderer<'_>,
    size: (u32, u32),
    (pattern, guard): (&Pattern, &Guard),
    note: &(dyn Fn(&FrameSpec) -> String + Sync),
    work: &Work,
) -> Result<(), ExportError> {
    let (alpha, sequence, document) = (studio.is_transparent(), studio.sequence, studio.document());
    let mut pending = Vec::new();
    let convert = |(): &mut (), index: usize, picture: &Framebuffer| {
        let comment = note(&sequence.shot(document, index));
        let notes = [("Software", SOFTWARE), ("Comment", comment.as_str())];
        let file = pattern.file(index);
        let prepared = guard
            .output(&file)
            .and_then(|file| prepare(&file, |out| png::encode(work.guard(out), picture, alpha, &notes, Compression::Quick)));
        prepared.map_err(std::io::Error::other)
    };
    roll(
        studio,
        size,
        work,
        || (),
        convert,
        |file| {
            pending.push(file);
            Ok(())
        },
    )
    .map_err(|error| ExportError::io(&pattern.file(0), error))?;
    pending.into_iter().try_for_each(|file| file.put_in_place())
}

fn save_gif(studio: &mut SequenceRenderer<'_>, size: (u32, u32), file: &Output, work: &Work) -> Result<(), ExportError> {
    let count = studio.sequence.count;
    let tries = count.min(PALETTE_FRAMES);
    let mut sampler = Sampler::new(tries);
    let mut picture = Framebuffer::new(size.0, size.1).map_err(|error| ExportError::io(file.file(), error))?;
    for i in 0..tries {
        if work.is_cancelled() {
            return Err(ExportError::Cancelled);
        }
        studio.draw(i * count / tries, &mut picture);
        sampler.add(&picture);
    }
    drop(picture);
    studio.take_times();
    let (palette, alpha) = (sampler.palette(), studio.is_transparent());
    let settings = gif::Settings { size, fps: studio.sequence.fps, alpha, palette: palette.clone() };
    gif::save(file, settings, |sink| {
        let convert = |palette: &mut _, _, picture: &Framebuffer| Ok(gif::indices(palette, picture, alpha));
        roll(studio, size, work, || palette.clone(), convert, |indices| sink.frame(indices))
    })
}

/// Sends every picture of the sequence through the pipeline.
fn roll<C, T: Send>(
    studio: &mut SequenceRenderer<'_>,
    size: (u32, u32),
    work: &Work,
    converter: impl Fn() -> C + Sync,
    convert: impl Fn(&mut C, usize, &Framebuffer) -> std::io::Result<T> + Sync,
    write: impl FnMut(T) -> std::io::Result<()> + Send,
) -> std::io::Result<()> {
    let threads = thread::available_parallelism().map_or(2, usize::from);
    let count = studio.sequence.count;
    let draw = |index: usize, picture: &mut Framebuffer| {
        studio.draw(index, picture);
    };
    pipeline::run((count, size, threads), work, draw, converter, convert, write)
}

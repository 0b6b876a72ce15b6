//! Writes a sequence: one picture, numbered pictures, GIF, APNG, MP4, WebM. All or nothing: old files stay until every frame is drawn.

use std::path::PathBuf;
use std::thread;

use super::{FilePattern, FrameSpec, Sequence, SequenceRenderer};
use crate::color_quantizer::ColorSampler;
use crate::png::{Compression, SOFTWARE};
use crate::video::{self, VideoFormat};
use crate::{ExportError, apng, gif, pipeline, png};
use sinew_engine::output::{Output, OverwriteGuard};
use sinew_engine::output::{PendingFile, prepare, write_atomic};
use sinew_render::{Framebuffer, RenderError};
use sinew_scene::progress::Progress;

/// Number of frames from which the palette of a GIF is computed.
const PALETTE_SAMPLES: usize = 12;

/// The kind and name of the output.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum OutputTarget {
    /// One PNG.
    Picture(PathBuf),
    /// One PNG per frame.
    Pictures(FilePattern),
    /// A GIF.
    Gif(PathBuf),
    /// An APNG.
    Apng(PathBuf),
    /// A video, encoded by the user's `ffmpeg`.
    Video(PathBuf, VideoFormat),
}

impl OutputTarget {
    /// The output that a file name's extension asks for; `None` for an unknown one.
    pub fn of(out: &std::path::Path) -> Option<Self> {
        let ending = out.extension().map(|ending| ending.to_string_lossy().to_lowercase()).unwrap_or_default();
        Some(match ending.as_str() {
            "png" => FilePattern::of(out).map_or_else(|| Self::Picture(out.to_owned()), Self::Pictures),
            "gif" => Self::Gif(out.to_owned()),
            "apng" => Self::Apng(out.to_owned()),
            "mp4" => Self::Video(out.to_owned(), VideoFormat::Mp4),
            "webm" => Self::Video(out.to_owned(), VideoFormat::Webm),
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

/// Draws the renderer's sequence in `size` and writes it to `target`, except over files that `guard` protects. `note` describes how a frame was made and is stored in the file. Drawing and
/// writing overlap, the frames are in order, and each equals the single picture of its state to the bit.
///
/// # Errors
/// [`ExportError`] where something cannot be written, [`ExportError::CANCELLED`] where `progress` was cancelled; then no output is left and the files that were
/// there before stay.
pub fn save(
    renderer: &mut SequenceRenderer<'_>,
    size: (u32, u32),
    (target, guard): (&OutputTarget, &OverwriteGuard),
    note: &(dyn Fn(&FrameSpec) -> String + Sync),
    progress: &Progress,
) -> Result<(), ExportError> {
    let result = write(renderer, size, (target, guard), note, progress);
    // Any error after a cancellation is its consequence.
    if result.is_err() && progress.is_cancelled() { Err(ExportError::CANCELLED) } else { result }
}

fn write(
    renderer: &mut SequenceRenderer<'_>,
    size: (u32, u32),
    (target, guard): (&OutputTarget, &OverwriteGuard),
    note: &(dyn Fn(&FrameSpec) -> String + Sync),
    progress: &Progress,
) -> Result<(), ExportError> {
    match target {
        OutputTarget::Picture(file) => {
            let refused = |error: RenderError| ExportError::io(file, error.into());
            let mut picture = Framebuffer::new(size.0, size.1).map_err(refused)?;
            let spec = renderer.draw(0, &mut picture).map_err(refused)?;
            let (alpha, comment) = (renderer.is_transparent(), note(&spec));
            let notes = [("Software", SOFTWARE), ("Comment", comment.as_str())];
            write_atomic(&guard.output(file)?, |out| {
                png::encode(pipeline::cancellable(out, progress), &picture, alpha, &notes, Compression::Small)
            })?;
            progress.step();
            Ok(())
        }
        OutputTarget::Pictures(pattern) => save_pictures(renderer, size, (pattern, guard), note, progress),
        OutputTarget::Gif(file) => save_gif(renderer, size, &guard.output(file)?, progress),
        OutputTarget::Apng(file) => {
            let (alpha, fps, count) = (renderer.is_transparent(), renderer.sequence.fps, renderer.sequence.count);
            let comment = note(&renderer.sequence.frame_spec(renderer.document(), 0));
            Ok(write_atomic(&guard.output(file)?, |out| {
                let mut sink = apng::ApngWriter::begin(out, size, count, fps, alpha, &[("Software", SOFTWARE), ("Comment", &comment)])?;
                run_pipeline(renderer, size, progress, |_, picture: &Framebuffer| apng::rows(picture, alpha), |rows| sink.frame(rows))?;
                sink.finish()
            })?)
        }
        OutputTarget::Video(file, kind) => {
            let (alpha, fps) = (renderer.is_transparent(), renderer.sequence.fps);
            let comment = note(&renderer.sequence.frame_spec(renderer.document(), 0));
            let mut sink = video::VideoWriter::begin(&guard.output(file)?, *kind, size, fps, alpha, &comment)?;
            run_pipeline(renderer, size, progress, |_, picture: &Framebuffer| apng::rows(picture, alpha), |rows| sink.frame(&rows))
                .map_err(|error| ExportError::io(file, error))?;
            sink.finish()
        }
    }
}

fn save_pictures(
    renderer: &mut SequenceRenderer<'_>,
    size: (u32, u32),
    (pattern, guard): (&FilePattern, &OverwriteGuard),
    note: &(dyn Fn(&FrameSpec) -> String + Sync),
    progress: &Progress,
) -> Result<(), ExportError> {
    let (alpha, sequence, document) = (renderer.is_transparent(), renderer.sequence.clone(), renderer.document());
    let mut pending = Vec::new();
    let convert = |index: usize, picture: &Framebuffer| {
        let comment = note(&sequence.frame_spec(document, index));
        let notes = [("Software", SOFTWARE), ("Comment", comment.as_str())];
        let file = pattern.file(index);
        let prepared = guard.output(&file).and_then(|file| {
            prepare(&file, |out| png::encode(pipeline::cancellable(out, progress), picture, alpha, &notes, Compression::Quick))
        });
        prepared.map_err(std::io::Error::other)
    };
    run_pipeline(renderer, size, progress, convert, |file| {
        pending.push(file);
        Ok(())
    })
    .map_err(|error| ExportError::io(&pattern.file(0), error))?;
    Ok(pending.into_iter().try_for_each(PendingFile::commit)?)
}

fn save_gif(renderer: &mut SequenceRenderer<'_>, size: (u32, u32), file: &Output, progress: &Progress) -> Result<(), ExportError> {
    let count = renderer.sequence.count;
    let tries = count.min(PALETTE_SAMPLES);
    let mut sampler = ColorSampler::new(tries);
    let refused = |error: RenderError| ExportError::io(file.file(), error.into());
    let mut picture = Framebuffer::new(size.0, size.1).map_err(refused)?;
    for i in 0..tries {
        if progress.is_cancelled() {
            return Err(ExportError::CANCELLED);
        }
        renderer.draw(i * count / tries, &mut picture).map_err(refused)?;
        sampler.add(&picture);
    }
    drop(picture);
    renderer.take_times();
    let (palette, alpha) = (sampler.color_table().map_err(refused)?, renderer.is_transparent());
    let settings = gif::GifSettings { size, fps: renderer.sequence.fps, alpha, palette: &palette };
    gif::save(file, settings, |sink| {
        let convert = |_, picture: &Framebuffer| gif::indices(&palette, picture, alpha);
        run_pipeline(renderer, size, progress, convert, |indices| sink.frame(indices))
    })
}

/// Sends every frame of the sequence through the export pipeline.
fn run_pipeline<T: Send>(
    renderer: &mut SequenceRenderer<'_>,
    size: (u32, u32),
    progress: &Progress,
    convert: impl Fn(usize, &Framebuffer) -> std::io::Result<T> + Sync,
    write: impl FnMut(T) -> std::io::Result<()> + Send,
) -> std::io::Result<()> {
    let threads = thread::available_parallelism().map_or(2, usize::from);
    let count = renderer.sequence.count;
    let draw = |index: usize, picture: &mut Framebuffer| Ok(renderer.draw(index, picture).map(drop)?);
    pipeline::run((count, size, threads), progress, draw, convert, write)
}

//! Animations as GIF: one palette for all frames, endless loop, and only what changed from frame to frame.

use std::borrow::Cow;
use std::fs::File;
use std::io::{self, BufWriter, Write};

use ::gif::{DisposalMethod, Encoder, Frame, Repeat};

use super::color_quantizer::{COLORS, ColorTable, is_solid};
use super::png::{check_room, reserved, unpremultiply};
use sinew_engine::output::Output;
use sinew_engine::output::write_atomic;

use super::ExportError;
use sinew_render::Framebuffer;

/// The index that stands for nothing; palettes end before it.
const CLEAR: u8 = COLORS as u8;

/// Most frames a second that viewers show as they are meant: the shortest delay that browsers honour is 0.02 s.
pub const MOST_FPS: f64 = 50.0;

/// How an animation is written.
#[derive(Debug)]
pub struct GifSettings<'a> {
    /// Columns and rows, at most 65535.
    pub size: (u32, u32),
    /// Frames a second.
    pub fps: f64,
    /// Whether pixels may be transparent (all or nothing: the format has no more).
    pub alpha: bool,
    /// The colours.
    pub palette: &'a ColorTable,
}

/// Writes an animation to `file`. `draw` is called once and gives the frames to the [`GifWriter`], one after the other.
///
/// # Errors
/// [`ExportError`] where the file cannot be written or the size does not fit the format; what `draw` returns.
pub fn save(
    file: &Output,
    settings: GifSettings<'_>,
    draw: impl FnOnce(&mut GifWriter<'_, BufWriter<&mut File>>) -> io::Result<()>,
) -> Result<(), ExportError> {
    let (width, height) = settings.size;
    let (Ok(width), Ok(height)) = (u16::try_from(width), u16::try_from(height)) else {
        return Err(ExportError::TooLarge { file: file.file().to_owned(), limit: u16::MAX.into() });
    };
    Ok(write_atomic(file, |out| draw(&mut GifWriter::begin(out, width, height, settings)?))?)
}

/// The palette's index for each pixel of a frame.
///
/// # Errors
/// [`io::ErrorKind::OutOfMemory`].
pub fn indices(palette: &ColorTable, picture: &Framebuffer, alpha: bool) -> io::Result<Vec<u8>> {
    let mut indices = reserved(picture.pixels.len())?;
    for (y, row) in picture.pixels.chunks_exact((picture.width as usize).max(1)).enumerate() {
        indices.extend(row.iter().enumerate().map(|(x, &pixel)| {
            if alpha && !is_solid(pixel) {
                return CLEAR;
            }
            let [r, g, b, _] = if alpha { unpremultiply(pixel) } else { unpremultiply(pixel | 0xFF00_0000) };
            palette.index([r, g, b], x, y)
        }));
    }
    Ok(indices)
}

/// Takes the frames of an animation.
pub struct GifWriter<'a, W: Write> {
    encoder: Encoder<&'a mut W>,
    settings: GifSettings<'a>,
    width: u16,
    height: u16,
    frames: u64,
    /// Palette indices of the frame before, empty at first.
    shown: Vec<u8>,
}

impl<'a, W: Write> GifWriter<'a, W> {
    fn begin(out: &'a mut W, width: u16, height: u16, settings: GifSettings<'a>) -> io::Result<Self> {
        let mut colors = settings.palette.bytes();
        // The table is as long as the index for nothing asks.
        colors.resize((COLORS + 1) * 3, 0);
        let mut encoder = Encoder::new(out, width, height, &colors).map_err(to_io)?;
        encoder.set_repeat(Repeat::Infinite).map_err(to_io)?;
        Ok(Self { encoder, settings, width, height, frames: 0, shown: Vec::new() })
    }

    /// Adds a frame: its [`indices`].
    ///
    /// # Errors
    /// What the file returns; [`io::ErrorKind::OutOfMemory`].
    pub fn frame(&mut self, indices: Vec<u8>) -> io::Result<()> {
        check_room()?;
        let mut next = indices;
        next.resize(usize::from(self.width) * usize::from(self.height), CLEAR);
        let whole = Frame {
            delay: self.delay(),
            dispose: DisposalMethod::Background,
            transparent: Some(CLEAR),
            width: self.width,
            height: self.height,
            buffer: Cow::Borrowed(&next),
            ..Frame::default()
        };
        let frame = match (self.settings.alpha, self.shown.len() == next.len()) {
            // Wiped away before the next: what is transparent must not show the frame before.
            (true, _) => whole,
            (false, false) => Frame { dispose: DisposalMethod::Keep, transparent: None, ..whole },
            (false, true) => changed(&self.shown, whole)?,
        };
        self.encoder.write_frame(&frame).map_err(to_io)?;
        drop(frame);
        self.shown = next;
        self.frames += 1;
        Ok(())
    }

    /// Delay of the present frame in hundredths of a second. The sums are rounded, not the delays, so that a long animation keeps its length.
    fn delay(&self) -> u16 {
        let moment = |frame: u64| (frame as f64 * 100.0 / self.settings.fps).round();
        (moment(self.frames + 1) - moment(self.frames)).clamp(1.0, f64::from(u16::MAX)) as u16
    }
}

/// The box round what differs from the frame before, what is the same in it left transparent.
fn changed<'a>(shown: &[u8], whole: Frame<'a>) -> io::Result<Frame<'a>> {
    let columns = usize::from(whole.width).max(1);
    let (mut left, mut right, mut top, mut bottom) = (columns, 0, usize::MAX, 0);
    for (y, (old, new)) in shown.chunks_exact(columns).zip(whole.buffer.chunks_exact(columns)).enumerate() {
        if let Some(first) = old.iter().zip(new).position(|(a, b)| a != b) {
            let last = old.iter().zip(new).rposition(|(a, b)| a != b).unwrap_or(first);
            (left, right) = (left.min(first), right.max(last));
            (top, bottom) = (top.min(y), y);
        }
    }
    if left > right {
        // Nothing changed; a frame must have a pixel.
        (left, right, top, bottom) = (0, 0, 0, 0);
    }
    let mut buffer = reserved((right - left + 1) * (bottom - top + 1))?;
    for (old, new) in shown.chunks_exact(columns).zip(whole.buffer.chunks_exact(columns)).take(bottom + 1).skip(top) {
        let pairs = old.iter().zip(new).take(right + 1).skip(left);
        buffer.extend(pairs.map(|(old, new)| if old == new { CLEAR } else { *new }));
    }
    // All four are within a frame whose sides are u16.
    let [left, top, width, height] = [left, top, right - left + 1, bottom - top + 1].map(|n| n as u16);
    Ok(Frame { dispose: DisposalMethod::Keep, left, top, width, height, buffer: Cow::Owned(buffer), ..whole })
}

fn to_io(error: ::gif::EncodingError) -> io::Error {
    match error {
        ::gif::EncodingError::Io(error) => error,
        other => io::Error::new(io::ErrorKind::InvalidInput, other.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color_quantizer::ColorSampler;

    const RED: u32 = 0xFFFF_0000;
    const BLUE: u32 = 0xFF00_00FF;

    fn picture(pixels: [u32; 6]) -> Framebuffer {
        Framebuffer { width: 3, height: 2, pixels: pixels.to_vec() }
    }

    fn encoded(frames: &[Framebuffer], fps: f64, alpha: bool) -> Vec<u8> {
        let mut sampler = ColorSampler::new(frames.len());
        frames.iter().for_each(|frame| sampler.add(frame));
        let mut file = Vec::new();
        let palette = sampler.color_table().expect("there is memory");
        let settings = GifSettings { size: (3, 2), fps, alpha, palette: &palette };
        let mut sink = GifWriter::begin(&mut file, 3, 2, settings).expect("memory is writable");
        for frame in frames {
            sink.frame(indices(&palette, frame, alpha).expect("there is memory")).expect("memory is writable");
        }
        drop(sink);
        file
    }

    /// A frame as a viewer shows it, the box that the file holds of it, and its delay.
    type Shown = (Vec<u32>, (u16, u16, u16, u16), u16);

    fn played(file: &[u8]) -> Vec<Shown> {
        let mut options = ::gif::DecodeOptions::new();
        options.set_color_output(::gif::ColorOutput::RGBA);
        let mut decoder = options.read_info(file).expect("a GIF");
        let mut screen = vec![0; 6];
        let mut shown = Vec::new();
        while let Some(frame) = decoder.read_next_frame().expect("complete") {
            for (i, pixel) in frame.buffer.chunks_exact(4).enumerate() {
                let (x, y) = (i % usize::from(frame.width), i / usize::from(frame.width));
                if pixel[3] == 255 {
                    screen[(y + usize::from(frame.top)) * 3 + x + usize::from(frame.left)] =
                        u32::from_be_bytes([255, pixel[0], pixel[1], pixel[2]]);
                }
            }
            shown.push((screen.clone(), (frame.left, frame.top, frame.width, frame.height), frame.delay));
            if frame.dispose == DisposalMethod::Background {
                screen.fill(0);
            }
        }
        assert_eq!(decoder.repeat(), Repeat::Infinite);
        shown
    }

    #[test]
    fn frames_come_back_and_hold_only_what_changed() {
        let frames = [
            picture([RED, RED, RED, BLUE, BLUE, BLUE]),
            picture([RED, RED, RED, BLUE, RED, RED]),
            picture([RED, RED, RED, BLUE, RED, RED]),
        ];
        let shown = played(&encoded(&frames, 25.0, false));
        assert_eq!(shown.iter().map(|(pixels, ..)| pixels.clone()).collect::<Vec<_>>(), frames.map(|frame| frame.pixels));
        assert_eq!(shown.iter().map(|(_, covered, _)| *covered).collect::<Vec<_>>(), [(0, 0, 3, 2), (1, 1, 2, 1), (0, 0, 1, 1)]);
    }

    #[test]
    fn transparent_frames_do_not_show_the_one_before() {
        let frames = [picture([RED, 0, 0, 0, 0, BLUE]), picture([0, RED, 0, 0, BLUE, 0])];
        let shown = played(&encoded(&frames, 10.0, true));
        assert_eq!(shown.into_iter().map(|(pixels, ..)| pixels).collect::<Vec<_>>(), frames.map(|frame| frame.pixels));
    }

    #[test]
    fn delays_add_up_to_the_length() {
        let frames = vec![picture([RED; 6]); 30];
        let delays: Vec<u16> = played(&encoded(&frames, 30.0, false)).into_iter().map(|(.., delay)| delay).collect();
        assert_eq!(delays.iter().map(|delay| u32::from(*delay)).sum::<u32>(), 100);
        assert!(delays.iter().all(|delay| (3..=4).contains(delay)));
    }

    #[test]
    fn a_side_beyond_the_format_is_refused() {
        let palette = ColorSampler::new(1).color_table().expect("there is memory");
        let settings = GifSettings { size: (65_536, 1), fps: 10.0, alpha: false, palette: &palette };
        assert!(matches!(
            save(&Output::of_program(std::path::Path::new("never.gif")), settings, |_| Ok(())),
            Err(ExportError::TooLarge { .. })
        ));
    }
}

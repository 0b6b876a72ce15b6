//! Sequences as APNG: every pixel as it was drawn, endless loop, and only the box that changed from frame to frame.

use std::io::{self, Write};

use super::png::{check_room, reserved, rgb, to_io, unpremultiply};
use sinew_render::Framebuffer;

/// The pixels of a frame as the file takes them: red, green, blue, and alpha where the sequence has it.
///
/// # Errors
/// [`io::ErrorKind::OutOfMemory`].
pub fn rows(picture: &Framebuffer, alpha: bool) -> io::Result<Vec<u8>> {
    let mut rows = reserved(picture.pixels.len() * if alpha { 4 } else { 3 })?;
    match alpha {
        true => rows.extend(picture.pixels.iter().flat_map(|&pixel| unpremultiply(pixel))),
        false => rows.extend(picture.pixels.iter().flat_map(|&pixel| rgb(pixel))),
    }
    Ok(rows)
}

/// Writes the frames of an APNG.
pub struct ApngWriter<W: Write> {
    writer: ::png::Writer<W>,
    width: usize,
    height: usize,
    channels: usize,
    fps: f64,
    frames: u64,
    shown: Vec<u8>,
}

impl<W: Write> ApngWriter<W> {
    /// Begins an APNG of `count` frames of `size`, `fps` a second, with `notes` as in [`super::png::save`].
    ///
    /// # Errors
    /// What `out` returns; [`io::ErrorKind::InvalidInput`] for no frames or no pixels.
    pub fn begin(out: W, (width, height): (u32, u32), count: usize, fps: f64, alpha: bool, notes: &[(&str, &str)]) -> io::Result<Self> {
        let mut encoder = ::png::Encoder::new(out, width, height);
        encoder.set_color(if alpha { ::png::ColorType::Rgba } else { ::png::ColorType::Rgb });
        encoder.set_depth(::png::BitDepth::Eight);
        encoder.set_compression(::png::Compression::Fast);
        encoder.set_source_srgb(::png::SrgbRenderingIntent::Perceptual);
        encoder.set_animated(u32::try_from(count).unwrap_or(u32::MAX), 0).map_err(to_io)?;
        for (keyword, text) in notes {
            encoder.add_itxt_chunk((*keyword).to_owned(), (*text).to_owned()).map_err(to_io)?;
        }
        let writer = encoder.write_header().map_err(to_io)?;
        let channels = if alpha { 4 } else { 3 };
        Ok(Self { writer, width: width as usize, height: height as usize, channels, fps, frames: 0, shown: Vec::new() })
    }

    /// Adds a frame, its [`rows`].
    ///
    /// # Errors
    /// What the file returns.
    pub fn frame(&mut self, rows: Vec<u8>) -> io::Result<()> {
        check_room()?;
        let (numerator, denominator) = delay(self.frames, self.fps);
        self.writer.set_frame_delay(numerator, denominator).map_err(to_io)?;
        if self.frames == 0 {
            self.writer.set_blend_op(::png::BlendOp::Source).map_err(to_io)?;
            self.writer.set_dispose_op(::png::DisposeOp::None).map_err(to_io)?;
            self.writer.write_image_data(&rows).map_err(to_io)?;
        } else {
            let [left, top, width, height] = self.changed(&rows);
            // The place goes back to the corner first: the new size must fit at either place.
            self.writer.reset_frame_position().map_err(to_io)?;
            self.writer.set_frame_dimension(width as u32, height as u32).map_err(to_io)?;
            self.writer.set_frame_position(left as u32, top as u32).map_err(to_io)?;
            let stride = self.width * self.channels;
            let part = (left * self.channels)..((left + width) * self.channels);
            let boxed = rows.chunks_exact(stride.max(1)).skip(top).take(height);
            let mut changed = reserved(width * height * self.channels)?;
            boxed.for_each(|row| changed.extend_from_slice(row.get(part.clone()).unwrap_or_default()));
            self.writer.write_image_data(&changed).map_err(to_io)?;
        }
        self.frames += 1;
        self.shown = rows;
        Ok(())
    }

    /// Ends the file.
    ///
    /// # Errors
    /// What the file returns.
    pub fn finish(self) -> io::Result<()> {
        self.writer.finish().map_err(to_io)
    }

    /// The box round what differs from the frame before: left, top, width, height; one pixel where nothing does.
    fn changed(&self, rows: &[u8]) -> [usize; 4] {
        let (stride, channels) = ((self.width * self.channels).max(1), self.channels);
        let (mut left, mut right, mut top, mut bottom) = (self.width, 0, self.height, 0);
        for (y, (old, new)) in self.shown.chunks_exact(stride).zip(rows.chunks_exact(stride)).enumerate() {
            if old == new {
                continue;
            }
            let first = old.iter().zip(new).position(|(a, b)| a != b).unwrap_or(0) / channels;
            let last = old.iter().zip(new).rposition(|(a, b)| a != b).unwrap_or(0) / channels;
            (left, right) = (left.min(first), right.max(last));
            (top, bottom) = (top.min(y), y);
        }
        if left > right { [0, 0, 1, 1] } else { [left, top, right - left + 1, bottom - top + 1] }
    }
}

/// The delay of frame `index` as a fraction of a second: exact for whole rates and those of television (1001 in the numerator); otherwise in
/// ten-thousandths, the sums rounded and not the delays, so that the sequence keeps its duration.
fn delay(index: u64, fps: f64) -> (u16, u16) {
    for numerator in [1, 2, 5, 10, 100, 1001, 1000] {
        let denominator = fps * f64::from(numerator);
        if (denominator - denominator.round()).abs() < 1e-9 && (1.0..=65_535.0).contains(&denominator) {
            return (numerator, denominator.round() as u16);
        }
    }
    let moment = |frame: u64| (frame as f64 * 10_000.0 / fps).round();
    let delay = moment(index + 1) - moment(index);
    // Beyond 6.5 s the finer unit has no room.
    if delay <= 65_535.0 { (delay.max(1.0) as u16, 10_000) } else { ((1.0 / fps).round().clamp(1.0, 65_535.0) as u16, 1) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(pixels: [u32; 6]) -> Framebuffer {
        Framebuffer { width: 3, height: 2, pixels: pixels.to_vec() }
    }

    #[test]
    fn frames_come_back_exactly_with_their_boxes() {
        let (r, b, t) = (0xFFFF_0000, 0xFF00_00FF, 0);
        let frames = [picture([r, r, r, b, b, t]), picture([r, r, r, b, r, r]), picture([r, r, r, b, r, r]), picture([b, r, r, b, r, t])];
        for alpha in [false, true] {
            let mut file = Vec::new();
            let mut sink = ApngWriter::begin(&mut file, (3, 2), frames.len(), 30.0, alpha, &[("Comment", "x")]).expect("memory");
            frames.iter().for_each(|frame| sink.frame(rows(frame, alpha).expect("memory")).expect("memory"));
            sink.finish().expect("memory");
            let mut reader = ::png::Decoder::new(io::Cursor::new(&file)).read_info().expect("a PNG");
            let control = *reader.info().animation_control().expect("an animation");
            assert_eq!((control.num_frames, control.num_plays), (4, 0));
            let channels = if alpha { 4 } else { 3 };
            let mut screen = vec![0; 6 * channels];
            let mut boxes = Vec::new();
            for frame in &frames {
                let mut buffer = vec![0; 6 * channels];
                reader.next_frame(&mut buffer).expect("complete");
                let info = *reader.info().frame_control().expect("a frame");
                assert_eq!((info.delay_num, info.delay_den), (1, 30));
                let row = info.width as usize * channels;
                for y in 0..info.height as usize {
                    let to = ((info.y_offset as usize + y) * 3 + info.x_offset as usize) * channels;
                    screen[to..to + row].copy_from_slice(&buffer[y * row..(y + 1) * row]);
                }
                boxes.push((info.x_offset, info.y_offset, info.width, info.height));
                assert!(screen == rows(frame, alpha).expect("memory"));
            }
            assert_eq!(boxes[1..3], [(1, 1, 2, 1), (0, 0, 1, 1)]);
        }
    }

    #[test]
    fn delays_are_exact_or_add_up() {
        assert_eq!(delay(7, 24.0), (1, 24));
        assert_eq!(delay(7, 12.5), (2, 25));
        assert_eq!(delay(7, 30_000.0 / 1001.0), (1001, 30_000));
        let odd = 17.123_456;
        let sum: u64 = (0..120).map(|frame| u64::from(delay(frame, odd).0)).sum();
        assert_eq!(sum, (120.0 * 10_000.0 / odd).round() as u64);
        assert_eq!(delay(0, 0.01), (100, 1));
    }
}

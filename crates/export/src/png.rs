//! Pictures as PNG, with the parameters that made them.

use std::io::{self, Write};

use sinew_engine::output::Output;
use sinew_engine::output::write_atomic;

use super::ExportError;
use sinew_render::Framebuffer;
use sinew_scene::limits;

/// What names the program in a picture, under the keyword `Software`.
pub const SOFTWARE: &str = concat!("Sinew ", env!("CARGO_PKG_VERSION"));

/// What the encoder takes while it packs rows, with some to spare, bytes. It ends the program where it is refused them.
const ENCODER_BYTES: u64 = 2 << 20;

/// How much time goes into a small file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Compression {
    /// As small as is sensible, for one picture.
    #[default]
    Small,
    /// Several times quicker and somewhat larger, for the many pictures of a sequence.
    Quick,
}

/// Writes `picture` to `file`. With `alpha` the file has an alpha channel, not premultiplied as PNG wants it; without, the pixels are taken as
/// solid. `notes` are pairs of keyword (Latin-1, 1 to 79 characters) and text, kept in the file as `iTXt`.
///
/// # Errors
/// [`ExportError`] where the file cannot be written.
pub fn save(file: &Output, picture: &Framebuffer, alpha: bool, notes: &[(&str, &str)]) -> Result<(), ExportError> {
    Ok(write_atomic(file, |out| encode(out, picture, alpha, notes, Compression::Small))?)
}

/// Writes `picture` as PNG to `out`; see [`save`].
///
/// # Errors
/// What `out` returns; [`io::ErrorKind::InvalidInput`] for a picture without pixels or a keyword that PNG does not allow;
/// [`io::ErrorKind::OutOfMemory`] where the system gives no memory for packing.
pub fn encode(out: impl Write, picture: &Framebuffer, alpha: bool, notes: &[(&str, &str)], compression: Compression) -> io::Result<()> {
    let mut refused = None;
    let result = encode_into(ErrorKeepingWriter { out, refused: &mut refused }, picture, alpha, notes, compression);
    // The encoder hands on what the system said as words alone; a full disk is to be known as one.
    result.map_err(|error| refused.unwrap_or(error))
}

/// Keeps the first error that the system returned.
struct ErrorKeepingWriter<'a, W> {
    out: W,
    refused: &'a mut Option<io::Error>,
}

impl<W: Write> ErrorKeepingWriter<'_, W> {
    fn keep_error<T>(&mut self, result: io::Result<T>) -> io::Result<T> {
        result.inspect_err(|error| {
            let again = error.raw_os_error().map_or_else(|| io::Error::from(error.kind()), io::Error::from_raw_os_error);
            self.refused.get_or_insert(again);
        })
    }
}

impl<W: Write> Write for ErrorKeepingWriter<'_, W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let result = self.out.write(bytes);
        self.keep_error(result)
    }

    fn flush(&mut self) -> io::Result<()> {
        let result = self.out.flush();
        self.keep_error(result)
    }
}

/// Whether the encoders of this folder have the memory that they take without asking.
///
/// # Errors
/// [`io::ErrorKind::OutOfMemory`].
pub(super) fn check_room() -> io::Result<()> {
    if limits::is_room(ENCODER_BYTES) { Ok(()) } else { Err(io::ErrorKind::OutOfMemory.into()) }
}

/// An empty list with room for so many bytes.
///
/// # Errors
/// [`io::ErrorKind::OutOfMemory`].
pub(super) fn reserved(bytes: usize) -> io::Result<Vec<u8>> {
    let mut list = Vec::new();
    list.try_reserve_exact(bytes).map_err(|_| io::ErrorKind::OutOfMemory)?;
    Ok(list)
}

fn encode_into(out: impl Write, picture: &Framebuffer, alpha: bool, notes: &[(&str, &str)], compression: Compression) -> io::Result<()> {
    check_room()?;
    let mut encoder = ::png::Encoder::new(out, picture.width, picture.height);
    encoder.set_color(if alpha { ::png::ColorType::Rgba } else { ::png::ColorType::Rgb });
    encoder.set_depth(::png::BitDepth::Eight);
    if compression == Compression::Quick {
        encoder.set_compression(::png::Compression::Fast);
    }
    encoder.set_source_srgb(::png::SrgbRenderingIntent::Perceptual);
    for (keyword, text) in notes {
        encoder.add_itxt_chunk((*keyword).to_owned(), (*text).to_owned()).map_err(to_io)?;
    }
    let mut writer = encoder.write_header().map_err(to_io)?;
    // The header refuses a picture without columns, so a chunk is never empty. Row by row: a second copy of a large picture would take as much memory as the first.
    let mut stream = writer.stream_writer_with_size(1 << 16).map_err(to_io)?;
    let columns = picture.width as usize;
    let mut row = Vec::with_capacity(columns * 4);
    for pixels in picture.pixels.chunks_exact(columns).take(picture.height as usize) {
        row.clear();
        match alpha {
            true => row.extend(pixels.iter().flat_map(|&pixel| unpremultiply(pixel))),
            false => row.extend(pixels.iter().flat_map(|&pixel| rgb(pixel))),
        }
        stream.write_all(&row)?;
    }
    stream.finish().map_err(to_io)?;
    writer.finish().map_err(to_io)
}

/// Red, green, blue of a pixel `0xAARRGGBB`.
pub(super) fn rgb(pixel: u32) -> [u8; 3] {
    let [_, red, green, blue] = pixel.to_be_bytes();
    [red, green, blue]
}

/// Red, green, blue, alpha of a premultiplied pixel, no longer premultiplied.
pub(super) fn unpremultiply(pixel: u32) -> [u8; 4] {
    let [alpha, red, green, blue] = pixel.to_be_bytes();
    match alpha {
        0 => [0; 4],
        255 => [red, green, blue, 255],
        _ => {
            let part = |channel: u8| ((u32::from(channel) * 255 + u32::from(alpha) / 2) / u32::from(alpha)).min(255) as u8;
            [part(red), part(green), part(blue), alpha]
        }
    }
}

pub(super) fn to_io(error: ::png::EncodingError) -> io::Error {
    match error {
        ::png::EncodingError::IoError(error) => error,
        other => io::Error::new(io::ErrorKind::InvalidInput, other.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn decode(file: &[u8]) -> (::png::ColorType, Vec<u8>, Vec<(String, String)>) {
        let mut reader = ::png::Decoder::new(io::Cursor::new(file)).read_info().expect("a PNG");
        let mut pixels = vec![0; reader.output_buffer_size().expect("small")];
        reader.next_frame(&mut pixels).expect("complete");
        let info = reader.info();
        let notes = info.utf8_text.iter().map(|t| (t.keyword.clone(), t.get_text().expect("text"))).collect();
        (info.color_type, pixels, notes)
    }

    #[test]
    fn pixels_come_back_in_reading_order() {
        let picture = Framebuffer { width: 2, height: 1, pixels: vec![0xFF010203, 0xFFFFFEFD] };
        let mut file = Vec::new();
        encode(&mut file, &picture, false, &[("Clip", "Gehen, шаг")], Compression::Small).expect("memory is writable");
        let (color, pixels, notes) = decode(&file);
        assert_eq!((color, pixels), (::png::ColorType::Rgb, vec![1, 2, 3, 255, 254, 253]));
        assert_eq!(notes, [("Clip".to_owned(), "Gehen, шаг".to_owned())]);
    }

    #[test]
    fn the_quick_way_has_the_same_pixels() {
        let picture = Framebuffer {
            width: 64,
            height: 48,
            pixels: (0..64 * 48).map(|i: u32| 0xFF00_0000 | i.wrapping_mul(2_654_435_761) >> 8).collect(),
        };
        let decoded = [Compression::Small, Compression::Quick].map(|compression| {
            let mut file = Vec::new();
            encode(&mut file, &picture, false, &[], compression).expect("memory is writable");
            decode(&file).1
        });
        assert!(decoded[0] == decoded[1]);
        assert_eq!(decoded[0][3..6], rgb(picture.pixels[1]));
    }

    #[test]
    fn alpha_is_no_longer_premultiplied() {
        let picture = Framebuffer { width: 3, height: 1, pixels: vec![0x80800000, 0, 0x40201000] };
        let mut file = Vec::new();
        encode(&mut file, &picture, true, &[], Compression::Small).expect("memory is writable");
        assert_eq!(decode(&file).1, [255, 0, 0, 128, 0, 0, 0, 0, 128, 64, 0, 64]);
    }

    #[test]
    fn a_picture_without_pixels_is_refused() {
        assert!(encode(Vec::new(), &Framebuffer::default(), false, &[], Compression::Quick).is_err());
    }
}

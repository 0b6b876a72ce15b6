//! One image file: what its head says, and its picture, made smaller while it is read where it has to be.

use std::io::{self, BufRead, Cursor, Seek};
use std::path::Path;

use image::error::LimitErrorKind;
use image::{ColorType, ImageDecoder, ImageError, ImageFormat, ImageReader, Limits};

use super::image_scaler::{BitDepth, PixelFormat, ScaledImage};
use crate::system::{Doing, plain, reason};
use sinew_scene::Pixels;
use sinew_scene::limits;
use sinew_scene::message;
use sinew_scene::message::Message;

/// What an image is read from.
pub(super) trait ImageStream: BufRead + Seek {}
impl<T: BufRead + Seek> ImageStream for T {}

/// What is known of an image before it is decoded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct ImageHeader {
    /// Columns and rows.
    pub size: [u32; 2],
    /// What decoding takes beside the picture that comes out, bytes.
    pub decoding: u64,
}

/// Why there is no picture.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum ImageReadError {
    /// The file is none, or a broken one: what the decoder said.
    Broken(Message),
    /// The system gave no memory for it.
    Memory,
}

impl From<ImageError> for ImageReadError {
    fn from(error: ImageError) -> Self {
        match error {
            ImageError::Limits(limit) if limit.kind() == LimitErrorKind::InsufficientMemory => Self::Memory,
            ImageError::IoError(error) => error.into(),
            error => Self::Broken(Message::verbatim(plain(&error.to_string()))),
        }
    }
}

impl From<io::Error> for ImageReadError {
    fn from(error: io::Error) -> Self {
        if error.kind() == io::ErrorKind::OutOfMemory { Self::Memory } else { Self::Broken(reason(&error, Doing::Reading)) }
    }
}

impl From<png::DecodingError> for ImageReadError {
    fn from(error: png::DecodingError) -> Self {
        match error {
            png::DecodingError::LimitsExceeded => Self::Memory,
            png::DecodingError::IoError(error) => error.into(),
            error => Self::Broken(Message::verbatim(plain(&error.to_string()))),
        }
    }
}

/// A reader of the format that the content shows, else that the file's ending names (TGA has no mark), within the limits.
fn reader<'a>(stream: Box<dyn ImageStream + 'a>, path: &Path) -> Result<ImageReader<Box<dyn ImageStream + 'a>>, ImageReadError> {
    let mut reader = ImageReader::new(stream).with_guessed_format()?;
    if reader.format().is_none() {
        reader.set_format(ImageFormat::from_path(path)?);
    }
    let mut bounds = Limits::default();
    bounds.max_image_width = Some(limits::IMAGE_SIDE);
    bounds.max_image_height = Some(limits::IMAGE_SIDE);
    bounds.max_alloc = Some(limits::IMAGE_DECODING_BYTES);
    reader.limits(bounds);
    Ok(reader)
}

fn png_decoder<'a>(stream: Box<dyn ImageStream + 'a>) -> png::Decoder<Box<dyn ImageStream + 'a>> {
    let mut decoder = png::Decoder::new_with_limits(stream, png::Limits { bytes: limits::IMAGE_DECODING_BYTES as usize });
    decoder.set_ignore_text_chunk(true);
    decoder.set_ignore_iccp_chunk(true);
    // Fewer bits than 8 and palettes become 8 bits a channel; 16 stay 16.
    decoder.set_transformations(png::Transformations::EXPAND);
    decoder
}

/// Reads the head of an image alone: whether it is one, and how large.
pub(super) fn read_header(stream: Box<dyn ImageStream + '_>, path: &Path) -> Result<ImageHeader, ImageReadError> {
    let reader = reader(stream, path)?;
    let header = match reader.format() {
        Some(ImageFormat::Png) => {
            let mut decoder = png_decoder(reader.into_inner());
            let info = decoder.read_header_info()?;
            let area = u64::from(info.width) * u64::from(info.height);
            // Row by row, but for one whose rows come in seven passes.
            let rows = if info.interlaced { area } else { u64::from(info.width) * 4 };
            ImageHeader { size: [info.width, info.height], decoding: rows * 8 }
        }
        Some(ImageFormat::Jpeg) => jpeg_head(reader.into_inner())?,
        _ => {
            let decoder = reader.into_decoder()?;
            // Some decoders unpack into room of their own first.
            ImageHeader { size: decoder.dimensions().into(), decoding: decoder.total_bytes().saturating_mul(2) }
        }
    };
    let side = header.size[0].max(header.size[1]);
    if side > limits::IMAGE_SIDE {
        return Err(ImageReadError::Broken(message!("document-image-side", limit = limits::IMAGE_SIDE)));
    }
    if header.size.contains(&0) {
        return Err(ImageReadError::Broken(message!("document-image-no-pixels")));
    }
    Ok(header)
}

/// The size in the frame header of a JPEG file (ITU-T T.81, B.2.2). The decoder itself would take the whole file in to tell it.
fn jpeg_head(mut stream: Box<dyn ImageStream + '_>) -> Result<ImageHeader, ImageReadError> {
    let length = stream.seek(io::SeekFrom::End(0))?;
    stream.seek(io::SeekFrom::Start(2))?;
    loop {
        while bytes(&mut stream)? != [0xFF] {}
        let mut marker = 0xFF;
        // Any number of these may stand before a marker.
        while marker == 0xFF {
            [marker] = bytes(&mut stream)?;
        }
        if matches!(marker, 0x00 | 0x01 | 0xD0..=0xD8) {
            continue;
        }
        let size = u16::from_be_bytes(bytes(&mut stream)?);
        if !matches!(marker, 0xC0..=0xCF) || matches!(marker, 0xC4 | 0xC8 | 0xCC) {
            stream.seek_relative(i64::from(size.saturating_sub(2)))?;
            continue;
        }
        let [_, high, low, wide, narrow, channels] = bytes(&mut stream)?;
        let (height, width) = (u16::from_be_bytes([high, low]), u16::from_be_bytes([wide, narrow]));
        let values = u64::from(width) * u64::from(height) * u64::from(channels.clamp(3, 4));
        // What comes in several scans is kept as coefficients of two bytes until the last of them.
        let scans = if marker == 0xC0 || marker == 0xC1 { 1 } else { 3 };
        return Ok(ImageHeader { size: [width.into(), height.into()], decoding: values * scans + length });
    }
}

fn bytes<const N: usize>(stream: &mut dyn ImageStream) -> io::Result<[u8; N]> {
    let mut bytes = [0; N];
    stream.read_exact(&mut bytes)?;
    Ok(bytes)
}

/// Decodes an image whose head was read, to a picture of size `to`, which is no larger: each of its pixels is the mean of those that it stands for.
pub(super) fn decode(stream: Box<dyn ImageStream + '_>, path: &Path, header: &ImageHeader, to: [u32; 2]) -> Result<Pixels, ImageReadError> {
    let reader = reader(stream, path)?;
    let mut scaled = ScaledImage::new(header.size, to).ok_or(ImageReadError::Memory)?;
    if !limits::is_room(header.decoding) {
        return Err(ImageReadError::Memory);
    }
    if reader.format() == Some(ImageFormat::Png) {
        png_rows(reader.into_inner(), header, &mut scaled)?;
    } else {
        let decoder = reader.into_decoder()?;
        let pixel_format = pixel_format(decoder.color_type()).ok_or_else(|| ImageReadError::Broken(message!("document-image-colours")))?;
        if decoder.dimensions() != header.size.into() {
            return Err(ImageReadError::Broken(message!("document-image-no-pixels")));
        }
        let mut bytes = try_allocate(usize::try_from(decoder.total_bytes()).map_err(|_| ImageReadError::Memory)?)?;
        decoder.read_image(&mut bytes)?;
        scaled.rows(&bytes, pixel_format);
    }
    scaled.finish().ok_or_else(|| ImageReadError::Broken(message!("document-image-no-pixels")))
}

fn try_allocate(bytes: usize) -> Result<Vec<u8>, ImageReadError> {
    let mut room = Vec::new();
    room.try_reserve_exact(bytes).map_err(|_| ImageReadError::Memory)?;
    room.resize(bytes, 0);
    Ok(room)
}

fn png_rows(stream: Box<dyn ImageStream + '_>, header: &ImageHeader, scaled: &mut ScaledImage) -> Result<(), ImageReadError> {
    let mut reader = png_decoder(stream).read_info()?;
    if [reader.info().width, reader.info().height] != header.size {
        return Err(ImageReadError::Broken(message!("document-image-no-pixels")));
    }
    let (color, depth) = reader.output_color_type();
    let channels = match color {
        png::ColorType::Grayscale => 1,
        png::ColorType::GrayscaleAlpha => 2,
        png::ColorType::Rgb => 3,
        png::ColorType::Rgba => 4,
        png::ColorType::Indexed => return Err(ImageReadError::Broken(message!("document-image-colours"))),
    };
    let depth = if depth == png::BitDepth::Sixteen { BitDepth::Big } else { BitDepth::Byte };
    let pixel_format = PixelFormat { channels, depth };
    if reader.info().interlaced {
        let mut bytes = try_allocate(reader.output_buffer_size().ok_or(ImageReadError::Memory)?)?;
        reader.next_frame(&mut bytes)?;
        scaled.rows(&bytes, pixel_format);
        return Ok(());
    }
    while let Some(row) = reader.next_row()? {
        scaled.rows(row.data(), pixel_format);
    }
    Ok(())
}

/// How the decoders lay out pixels; `None` for what none of them gives today.
fn pixel_format(color: ColorType) -> Option<PixelFormat> {
    let (channels, depth) = match color {
        ColorType::L8 => (1, BitDepth::Byte),
        ColorType::La8 => (2, BitDepth::Byte),
        ColorType::Rgb8 => (3, BitDepth::Byte),
        ColorType::Rgba8 => (4, BitDepth::Byte),
        ColorType::L16 => (1, BitDepth::Native),
        ColorType::La16 => (2, BitDepth::Native),
        ColorType::Rgb16 => (3, BitDepth::Native),
        ColorType::Rgba16 => (4, BitDepth::Native),
        ColorType::Rgb32F => (3, BitDepth::Float),
        ColorType::Rgba32F => (4, BitDepth::Float),
        _ => return None,
    };
    Some(PixelFormat { channels, depth })
}

/// The bytes of an image in memory as a stream.
pub(super) fn in_memory(bytes: &[u8]) -> Box<dyn ImageStream + '_> {
    Box::new(Cursor::new(bytes))
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::{DynamicImage, ImageBuffer, Rgba};

    /// A picture of 24 × 10 pixels that all differ, in every format that is read.
    fn pictures() -> Vec<(ImageFormat, &'static str, Vec<u8>)> {
        let picture = ImageBuffer::from_fn(24, 10, |x, y| Rgba([x as u8 * 10, y as u8 * 25, 128, 255]));
        let rgb = DynamicImage::ImageRgb8(DynamicImage::ImageRgba8(picture).into_rgb8());
        [
            (ImageFormat::Png, "a.png"),
            (ImageFormat::Jpeg, "a.jpg"),
            (ImageFormat::Tga, "a.tga"),
            (ImageFormat::Bmp, "a.bmp"),
            (ImageFormat::Tiff, "a.tif"),
            (ImageFormat::Gif, "a.gif"),
        ]
        .into_iter()
        .map(|(format, name)| {
            let mut bytes = Cursor::new(Vec::new());
            let picture = if format == ImageFormat::Gif { DynamicImage::ImageRgba8(rgb.to_rgba8()) } else { rgb.clone() };
            picture.write_to(&mut bytes, format).expect("encodes");
            (format, name, bytes.into_inner())
        })
        .collect()
    }

    #[test]
    fn every_format_is_read_whole_as_its_decoder_gives_it() {
        for (format, name, bytes) in pictures() {
            let path = Path::new(name);
            let header = read_header(in_memory(&bytes), path).expect(name);
            assert_eq!(header.size, [24, 10], "{name}");
            let ours = decode(in_memory(&bytes), path, &header, header.size).expect(name);
            let theirs = image::load_from_memory_with_format(&bytes, format).expect(name).into_rgba8();
            assert!(ours.rgba == theirs.into_raw(), "{name}");
        }
    }

    #[test]
    fn every_format_is_read_smaller() {
        for (_, name, bytes) in pictures() {
            let path = Path::new(name);
            let header = read_header(in_memory(&bytes), path).expect(name);
            let small = decode(in_memory(&bytes), path, &header, [6, 2]).expect(name);
            assert_eq!((small.width, small.height, small.rgba.len()), (6, 2, 48), "{name}");
            // Means of 0, 10, 20, 30 and of 0, 25 … 100, taken of the light; lossy formats are near.
            let [red, green, blue, alpha] = [small.rgba[0], small.rgba[1], small.rgba[2], small.rgba[3]];
            assert!(red.abs_diff(19) <= 6 && green.abs_diff(63) <= 8 && blue.abs_diff(128) <= 8, "{name}: {:?}", &small.rgba[..4]);
            assert_eq!(alpha, 255, "{name}");
        }
    }

    #[test]
    fn sixteen_bits_are_rounded_as_the_decoder_does() {
        let picture = ImageBuffer::from_fn(9, 7, |x, y| Rgba([x as u16 * 7000, y as u16 * 9000, 300, 65535 - x as u16 * 5000]));
        let mut bytes = Cursor::new(Vec::new());
        DynamicImage::ImageRgba16(picture).write_to(&mut bytes, ImageFormat::Png).expect("encodes");
        let bytes = bytes.into_inner();
        let path = Path::new("a.png");
        let header = read_header(in_memory(&bytes), path).expect("a head");
        let ours = decode(in_memory(&bytes), path, &header, header.size).expect("a picture");
        assert_eq!(ours.rgba, image::load_from_memory(&bytes).expect("a picture").into_rgba8().into_raw());
    }

    /// A chunk of a PNG file with its checksum (ISO/IEC 15948, annex D).
    fn chunk(name: &[u8; 4], data: &[u8]) -> Vec<u8> {
        let body = [name.as_slice(), data].concat();
        let step = |crc: u32, _| if crc & 1 == 1 { 0xEDB8_8320 ^ (crc >> 1) } else { crc >> 1 };
        let crc = !body.iter().fold(!0_u32, |crc, byte| (0..8).fold(crc ^ u32::from(*byte), step));
        [&(data.len() as u32).to_be_bytes(), body.as_slice(), &crc.to_be_bytes()].concat()
    }

    #[test]
    fn rows_that_come_in_passes_are_put_together() {
        // Two by two grey pixels, interlaced, in a stored block: the passes 1, 6 and 7 hold something.
        let rows = [0, 10, 0, 20, 0, 30, 40];
        let (low, high) = rows.iter().fold((1_u32, 0_u32), |(low, high), byte| (low + byte, high + low + byte));
        let adler = (high << 16 | low).to_be_bytes();
        let stored = [&[0x78, 1, 1, 7, 0, 0xF8, 0xFF][..], &rows.map(|byte| byte as u8), &adler].concat();
        let header = chunk(b"IHDR", &[0, 0, 0, 2, 0, 0, 0, 2, 8, 0, 0, 0, 1]);
        let bytes = [b"\x89PNG\r\n\x1a\n".as_slice(), &header, &chunk(b"IDAT", &stored), &chunk(b"IEND", &[])].concat();
        let path = Path::new("a.png");
        let header = read_header(in_memory(&bytes), path).expect("a head");
        let picture = decode(in_memory(&bytes), path, &header, [2, 2]).expect("a picture");
        assert_eq!(picture.rgba.chunks(4).map(|pixel| pixel[0]).collect::<Vec<_>>(), [10, 20, 30, 40]);
    }

    #[test]
    fn cut_and_foreign_files_are_refused_with_a_reason() {
        for (_, name, bytes) in pictures() {
            for end in [0, 3, 9, 20, bytes.len() / 2] {
                let part = &bytes[..end];
                let path = Path::new(name);
                // A head may be whole; what follows must not panic.
                if let Ok(header) = read_header(in_memory(part), path) {
                    let _ = decode(in_memory(part), path, &header, [2, 2]);
                }
            }
        }
        assert!(matches!(read_header(in_memory(b"none of them"), Path::new("a.png")), Err(ImageReadError::Broken(_))));
    }

    #[test]
    fn a_jpeg_of_several_scans_is_known_to_take_more() {
        let header = |marker: u8| {
            let bytes = [&[0xFF, 0xD8, 0xFF, 0xE0, 0, 4, 1, 2, 0xFF, marker, 0, 17, 8, 0, 100, 1, 0, 3][..], &[0; 9]].concat();
            jpeg_head(in_memory(&bytes)).expect("a head")
        };
        assert_eq!(header(0xC0).size, [256, 100]);
        assert!(header(0xC2).decoding > 2 * header(0xC0).decoding);
    }
}

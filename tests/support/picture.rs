//! Reads the pictures that the program writes.

use std::fs::File;
use std::io::BufReader;
use std::path::Path;

/// A decoded picture.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Picture {
    /// Columns and rows.
    pub size: (u32, u32),
    /// Channels: 3 or 4.
    pub channels: usize,
    /// Bytes, rows from the top.
    pub bytes: Vec<u8>,
    /// Keywords and texts.
    pub notes: Vec<(String, String)>,
}

/// Reads a PNG.
pub(crate) fn read(path: &Path) -> Picture {
    let file = BufReader::new(File::open(path).unwrap_or_else(|error| panic!("{}: {error}", path.display())));
    let mut reader = png::Decoder::new(file).read_info().expect("a PNG");
    let mut bytes = vec![0; reader.output_buffer_size().expect("small")];
    reader.next_frame(&mut bytes).expect("a complete PNG");
    let info = reader.info();
    let channels = match info.color_type {
        png::ColorType::Rgb => 3,
        png::ColorType::Rgba => 4,
        other => panic!("unexpected colour type {other:?}"),
    };
    let notes = info.utf8_text.iter().map(|note| (note.keyword.clone(), note.get_text().expect("text"))).collect();
    Picture { size: (info.width, info.height), channels, bytes, notes }
}

impl Picture {
    /// The channels of a pixel.
    pub(crate) fn pixel(&self, x: u32, y: u32) -> &[u8] {
        let at = (y as usize * self.size.0 as usize + x as usize) * self.channels;
        &self.bytes[at..at + self.channels]
    }

    /// How many pixels differ from `color`.
    pub(crate) fn unlike(&self, color: &[u8]) -> usize {
        self.bytes.chunks_exact(self.channels).filter(|pixel| *pixel != color).count()
    }

    /// First and last column and row of what differs from `color`.
    pub(crate) fn extent(&self, color: &[u8]) -> Option<[u32; 4]> {
        let mut found: Option<[u32; 4]> = None;
        for (i, _) in self.bytes.chunks_exact(self.channels).enumerate().filter(|(_, pixel)| *pixel != color) {
            let (x, y) = (i as u32 % self.size.0, i as u32 / self.size.0);
            let [left, right, top, bottom] = found.unwrap_or([x, x, y, y]);
            found = Some([left.min(x), right.max(x), top.min(y), bottom.max(y)]);
        }
        found
    }
}

/// A frame of an animation as a viewer shows it, with its delay in hundredths of a second.
pub(crate) struct GifFrame {
    /// Red, green, blue, alpha.
    pub rgba: Vec<u8>,
    /// Hundredths of a second.
    pub delay: u16,
}

/// Plays a GIF: its size, and all frames.
pub(crate) fn play(path: &Path) -> ((u32, u32), Vec<GifFrame>) {
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::RGBA);
    let mut decoder = options.read_info(BufReader::new(File::open(path).expect("a GIF file"))).expect("a GIF");
    let (width, height) = (u32::from(decoder.width()), u32::from(decoder.height()));
    let mut screen = vec![0; (width * height * 4) as usize];
    let mut frames = Vec::new();
    while let Some(frame) = decoder.read_next_frame().expect("a complete GIF") {
        for (i, pixel) in frame.buffer.chunks_exact(4).enumerate() {
            let x = u32::from(frame.left) + i as u32 % u32::from(frame.width);
            let y = u32::from(frame.top) + i as u32 / u32::from(frame.width);
            if pixel[3] != 0 {
                let at = ((y * width + x) * 4) as usize;
                screen[at..at + 4].copy_from_slice(pixel);
            }
        }
        frames.push(GifFrame { rgba: screen.clone(), delay: frame.delay });
        if frame.dispose == gif::DisposalMethod::Background {
            screen.fill(0);
        }
    }
    assert_eq!(decoder.repeat(), gif::Repeat::Infinite);
    ((width, height), frames)
}

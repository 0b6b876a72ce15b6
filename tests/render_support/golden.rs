//! Golden pictures: stored PNGs that a drawing must match, with a picture of the difference where it does not.
//!
//! `SINEW_BLESS=1 cargo test --test render_golden` writes them anew; look at every one before committing it.

use std::fs::File;
use std::io::{BufReader, BufWriter};
use std::path::{Path, PathBuf};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden/render")
}

/// Compares a picture of `width` columns with the golden one of that name. Colours are compared as they are stored: not premultiplied.
pub(crate) fn check(name: &str, pixels: &[u32], width: u32) {
    let rgba: Vec<u8> = pixels.iter().flat_map(|p| straight(*p)).collect();
    let height = pixels.len() as u32 / width;
    let path = folder().join(format!("{name}.png"));
    if std::env::var_os("SINEW_BLESS").is_some() {
        write(&path, &rgba, width, height);
        return;
    }
    let Some((golden, golden_width)) = read(&path) else {
        panic!("{} is missing; SINEW_BLESS=1 writes it", path.display());
    };
    if golden == rgba && golden_width == width {
        return;
    }
    let panels = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}-difference.png"));
    let differing = rgba.chunks(4).zip(golden.chunks(4)).filter(|(a, b)| a != b).count();
    three_panels(&panels, &golden, &rgba, width, height);
    panic!("{name}: {differing} pixels differ from the golden picture; expected, found and difference are in {}", panels.display());
}

/// Un-premultiplies `0xAARRGGBB` to R, G, B, A.
pub(crate) fn straight(pixel: u32) -> [u8; 4] {
    let [a, r, g, b] = pixel.to_be_bytes();
    let part = |c: u8| if a == 0 { 0 } else { ((u32::from(c) * 255 + u32::from(a) / 2) / u32::from(a)).min(255) as u8 };
    [part(r), part(g), part(b), a]
}

/// Writes `0xAARRGGBB` pixels, to be looked at.
pub(crate) fn write_pixels(path: &Path, pixels: &[u32], width: u32) {
    let rgba: Vec<u8> = pixels.iter().flat_map(|p| straight(*p)).collect();
    write(path, &rgba, width, pixels.len() as u32 / width);
}

fn write(path: &Path, rgba: &[u8], width: u32, height: u32) {
    let mut encoder = png::Encoder::new(BufWriter::new(File::create(path).expect("the folder is there")), width, height);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::High);
    encoder.write_header().and_then(|mut writer| writer.write_image_data(rgba)).expect("the disk is not full");
}

fn read(path: &Path) -> Option<(Vec<u8>, u32)> {
    let mut reader = png::Decoder::new(BufReader::new(File::open(path).ok()?)).read_info().ok()?;
    let mut bytes = vec![0; reader.output_buffer_size()?];
    let info = reader.next_frame(&mut bytes).ok()?;
    bytes.truncate(info.buffer_size());
    Some((bytes, info.width))
}

/// Expected, found, and where they differ (the brighter, the more), side by side.
fn three_panels(path: &Path, golden: &[u8], found: &[u8], width: u32, height: u32) {
    let row = width as usize * 4;
    let mut out = Vec::new();
    for y in 0..height as usize {
        let of = |picture: &[u8]| picture.get(y * row..(y + 1) * row).map_or_else(|| vec![0; row], <[u8]>::to_vec);
        let (a, b) = (of(golden), of(found));
        out.extend(&a);
        out.extend(&b);
        for (p, q) in a.chunks(4).zip(b.chunks(4)) {
            let most = p.iter().zip(q).map(|(x, y)| x.abs_diff(*y)).max().unwrap_or(0);
            let shown = if most == 0 { 0 } else { most.saturating_mul(4).saturating_add(60) };
            out.extend([shown, shown, shown / 2, 255]);
        }
    }
    write(path, &out, width * 3, height);
}

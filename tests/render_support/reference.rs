//! A rasterizer that is slow, plain and in `f64`, written from the rules alone: sub-pixel snapping, exact edge functions, the top-left rule, the nearest
//! wins, what is seen from behind a hair farther off, perspective-correct colours. It sees only triangles whose corners are already on the picture.

use super::rng::Rng;

/// A corner on the picture: whole sub-pixels (1/256) from the top left, distance, colour from 0 to 255.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Corner {
    pub x: i64,
    pub y: i64,
    pub distance: f64,
    pub color: [f64; 3],
}

/// The samples of a pixel, from its centre, in sub-pixels.
pub(crate) const GRID: [[i64; 2]; 4] = [[-32, -96], [96, -32], [-96, 32], [32, 96]];

/// Which side of the line p → q the point is on, doubled area in square sub-pixels.
fn side(p: &Corner, q: &Corner, x: i64, y: i64) -> i128 {
    i128::from(q.x - p.x) * i128::from(y - p.y) - i128::from(q.y - p.y) * i128::from(x - p.x)
}

/// Whether a point is in the triangle by the top-left rule, and the corners' shares of the area.
pub(crate) fn inside(triangle: &[Corner; 3], x: i64, y: i64) -> Option<[f64; 3]> {
    let [a, b, c] = triangle;
    let area = side(a, b, c.x, c.y);
    if area == 0 {
        return None;
    }
    // Clockwise as seen (y runs downward) has a positive area; the others are turned round.
    let (b, c) = if area > 0 { (b, c) } else { (c, b) };
    let mut shares = [0.0; 3];
    for (share, (p, q)) in shares.iter_mut().zip([(b, c), (c, a), (a, b)]) {
        let value = side(p, q, x, y);
        // Clockwise, a top edge runs to the right and a left edge runs upward.
        let top_left = (p.y == q.y && q.x > p.x) || q.y < p.y;
        if value < 0 || (value == 0 && !top_left) {
            return None;
        }
        *share = value as f64 / area.abs() as f64;
    }
    if area < 0 {
        shares.swap(1, 2);
    }
    Some(shares)
}

/// How far a triangle that is seen from behind, clockwise, is moved back: what its nearness changes over 1¼ sub-pixels to the right and downward,
/// and a few times what a float rounds by.
fn retreat(triangle: &[Corner; 3]) -> f64 {
    let [a, b, c] = triangle;
    let area = side(a, b, c.x, c.y) as f64;
    if area <= 0.0 {
        return 0.0;
    }
    let [p, q, r] = [a, b, c].map(|corner| 1.0 / corner.distance);
    let [x1, y1, x2, y2] = [b.x - a.x, b.y - a.y, c.x - a.x, c.y - a.y].map(|d| d as f64);
    let right = ((q - p) * y2 - (r - p) * y1) / area;
    let down = ((r - p) * x1 - (q - p) * x2) / area;
    let (near, far) = (p.max(q).max(r), p.min(q).min(r));
    ((right.abs() + down.abs()) * 1.25).min(near - far) + near / f64::from(1 << 21)
}

/// Colours 0 to 255 of a picture of these triangles before black, one sample a pixel; `None` where nothing is drawn.
pub(crate) fn draw(triangles: &[[Corner; 3]], width: u32, height: u32) -> Vec<Option<[f64; 3]>> {
    let mut picture = vec![None; (width * height) as usize];
    let mut nearest = vec![0.0; picture.len()];
    for triangle in triangles {
        for y in 0..height {
            for x in 0..width {
                let at = (y * width + x) as usize;
                let Some(shares) = inside(triangle, i64::from(x) * 256 + 128, i64::from(y) * 256 + 128) else { continue };
                let nearness: f64 = (0..3).map(|k| shares[k] / triangle[k].distance).sum();
                let depth = nearness - retreat(triangle);
                if depth > nearest[at] {
                    nearest[at] = depth;
                    let mix = |i: usize| (0..3).map(|k| shares[k] / triangle[k].distance * triangle[k].color[i]).sum::<f64>() / nearness;
                    picture[at] = Some([mix(0), mix(1), mix(2)]);
                }
            }
        }
    }
    picture
}

/// A triangle somewhere on and around a picture.
pub(crate) fn random(rng: &mut Rng, width: u32, height: u32) -> [Corner; 3] {
    std::array::from_fn(|_| Corner {
        x: rng.between(-60.0, f64::from(width) + 60.0).floor() as i64 * 256 + rng.between(0.0, 256.0) as i64,
        y: rng.between(-60.0, f64::from(height) + 60.0).floor() as i64 * 256 + rng.between(0.0, 256.0) as i64,
        distance: rng.between(1.0, 9.0),
        color: std::array::from_fn(|_| rng.between(0.0, 255.0).round()),
    })
}

/// The light of a byte of colour, 0 to 1 (IEC 61966-2-1), and back.
pub(crate) fn light(byte: f64) -> f64 {
    let c = byte / 255.0;
    if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
}

/// See [`light`].
pub(crate) fn byte(light: f64) -> f64 {
    (if light <= 0.003_130_8 { light * 12.92 } else { 1.055 * light.powf(1.0 / 2.4) - 0.055 }) * 255.0
}

/// Colours 0 to 255 of a picture of glass before black: every triangle is laid over all that is farther, once a sample, its colour that of its first corner.
/// The samples of a pixel are averaged as light.
pub(crate) fn draw_glass(triangles: &[[Corner; 3]], opacity: f64, samples: usize, [width, height]: [u32; 2]) -> Vec<[f64; 3]> {
    let nearness = |triangle: &&[Corner; 3]| triangle.iter().map(|corner| 1.0 / corner.distance).sum::<f64>();
    let mut order: Vec<&[Corner; 3]> = triangles.iter().collect();
    order.sort_by(|a, b| nearness(a).total_cmp(&nearness(b)));
    let grid = if samples == 1 { &[[0, 0]][..] } else { &GRID[..] };
    let mut pixels = vec![[[0.0; 3]; 4]; (width * height) as usize];
    for triangle in order {
        let [left, right] = [i64::min, i64::max].map(|pick| triangle.iter().map(|corner| corner.x / 256).reduce(pick).unwrap_or(0));
        for (y, x) in (0..i64::from(height)).flat_map(|y| (left - 1..right + 2).map(move |x| (y, x))) {
            if !(0..i64::from(width)).contains(&x) {
                continue;
            }
            for (pixel, [dx, dy]) in pixels[(y * i64::from(width) + x) as usize].iter_mut().zip(grid) {
                if inside(triangle, x * 256 + 128 + dx, y * 256 + 128 + dy).is_some() {
                    for (channel, color) in pixel.iter_mut().zip(triangle[0].color) {
                        *channel += (color - *channel) * opacity;
                    }
                }
            }
        }
    }
    let together = |pixel: &[[f64; 3]; 4]| -> [f64; 3] {
        std::array::from_fn(|k| match samples {
            1 => pixel[0][k],
            _ => byte(pixel.iter().map(|sample| light(sample[k])).sum::<f64>() / 4.0),
        })
    };
    pixels.iter().map(together).collect()
}

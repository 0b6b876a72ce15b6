//! Which pixels a triangle covers: no gap along a shared edge, no pixel twice.

use crate::render_support::models::soup;
use crate::render_support::rng::Rng;
use crate::render_support::{World, pixel_camera, plain};
use glam::{Mat4, Vec3};
use sinew::render::{Display, Renderer, Samples};
use sinew::scene::{Material, Paint, ShadingModel};

/// Draws triangles given in pixels (y downward) half transparent, so that a pixel tells how often it was drawn: `.` never, `1`, `2`, …
fn art(triangles: &[[[f32; 2]; 3]], size: [u32; 2]) -> String {
    let counts = counts(triangles, size);
    let line = |row: &[u32]| row.iter().map(|n| if *n == 0 { '.' } else { char::from_digit(*n, 10).unwrap_or('#') }).collect::<String>();
    counts.chunks(size[0] as usize).map(line).collect::<Vec<_>>().join("\n")
}

fn counts(triangles: &[[[f32; 2]; 3]], size: [u32; 2]) -> Vec<u32> {
    let mut world = World::default();
    let emission = Paint::color(1.0, 1.0, 1.0);
    let glass = Material { model: ShadingModel::Constant, emission, opacity: 0.5, ..Material::default() };
    let glass = world.material(glass);
    let positions: Vec<Vec3> = triangles.iter().flatten().map(|[x, y]| Vec3::new(*x, size[1] as f32 - y, 0.0)).collect();
    let indices = (0..triangles.len() as u32).map(|t| [t * 3, t * 3 + 1, t * 3 + 2]).collect();
    world.place(soup(positions, indices, Vec::new()), Mat4::IDENTITY, Some(glass));
    let mut renderer = Renderer::new(Some(1));
    let pixels = world.draw(&mut renderer, &pixel_camera(size), &plain(), size);
    // 0, 128, 192, 224, … each time half of what is missing.
    pixels
        .iter()
        .map(|p| [0u32, 128, 192, 224, 240].iter().position(|level| level.abs_diff(p & 255) <= 2).map_or(9, |n| n as u32))
        .collect()
}

#[test]
fn pixel_centres_decide() {
    // The right and lower edges run through pixel centres: these belong to the neighbour.
    let square = [[1.5, 1.5], [6.5, 1.5], [6.5, 4.5], [1.5, 4.5]];
    let [a, b, c, d] = square;
    assert_eq!(
        art(&[[a, b, c], [a, c, d]], [8, 6]),
        "........\n\
         .11111..\n\
         .11111..\n\
         .11111..\n\
         ........\n\
         ........"
    );
}

#[test]
fn both_windings_cover_the_same() {
    let (a, b, c) = ([0.7, 0.3], [7.2, 2.9], [2.1, 7.6]);
    let clockwise = art(&[[a, b, c]], [8, 8]);
    assert_eq!(clockwise, art(&[[c, b, a]], [8, 8]));
    assert_eq!(
        clockwise,
        "........\n\
         .111....\n\
         .11111..\n\
         .111111.\n\
         ..111...\n\
         ..11....\n\
         ..1.....\n\
         ........"
    );
}

#[test]
fn a_fan_round_a_centre_covers_each_pixel_once() {
    let center = [8.5, 8.5];
    let rim = |k: usize| {
        let angle = k as f32 / 9.0 * std::f32::consts::TAU;
        [8.5 + angle.cos() * 7.9, 8.5 + angle.sin() * 7.9]
    };
    let fan: Vec<_> = (0..9).map(|k| [center, rim(k), rim(k + 1)]).collect();
    let picture = art(&fan, [17, 17]);
    assert!(!picture.contains('2') && !picture.contains('#'), "{picture}");
    assert_eq!(picture.lines().nth(8), Some(".111111111111111."), "{picture}");
}

#[test]
fn meshes_have_neither_gaps_nor_overlaps() {
    // A grid of random points, triangulated, that fills the picture: every pixel exactly once, whatever the triangles.
    let mut rng = Rng(1);
    for round in 0..20 {
        let cells = 2 + round as usize;
        let size = [64u32, 48];
        let point: Vec<[f32; 2]> = (0..=cells)
            .flat_map(|j| (0..=cells).map(move |i| (i, j)))
            .map(|(i, j)| {
                let inner = |k: usize| k > 0 && k < cells;
                let shift = |rng: &mut Rng, k| if inner(k) { rng.between(-0.2, 0.2) as f32 } else { 0.0 };
                let [w, h] = [66.0, 50.0];
                let (dx, dy) = (shift(&mut rng, i), shift(&mut rng, j));
                [(i as f32 + dx) / cells as f32 * w - 1.0, (j as f32 + dy) / cells as f32 * h - 1.0]
            })
            .collect();
        let at = |i: usize, j: usize| point[j * (cells + 1) + i];
        let mut triangles = Vec::new();
        for (i, j) in (0..cells).flat_map(|j| (0..cells).map(move |i| (i, j))) {
            let (a, b, c, d) = (at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
            triangles.extend([[a, b, c], [a, c, d]]);
        }
        let counts = counts(&triangles, size);
        assert!(counts.iter().all(|n| *n == 1), "round {round}: {:?}", counts.iter().position(|n| *n != 1));
    }
}

#[test]
fn tiny_triangles_cover_a_pixel_or_none() {
    // 0.1 pixels wide: drawn where it holds a centre, nowhere else.
    assert_eq!(art(&[[[2.45, 1.45], [2.6, 1.5], [2.45, 1.6]]], [4, 3]), "....\n..1.\n....");
    assert_eq!(art(&[[[2.55, 1.45], [2.7, 1.5], [2.55, 1.6]]], [4, 3]), "....\n....\n....");
    // Without area.
    assert_eq!(art(&[[[0.0, 0.0], [4.0, 3.0], [2.0, 1.5]]], [4, 3]), "....\n....\n....");
}

#[test]
fn triangles_far_beyond_the_guard_band_cover_what_they_should() {
    // Two halves of a square a million pixels wide, split by the diagonal of the picture.
    let far = 1e6;
    let (a, b, c, d) = ([-far, -far], [far, -far], [far, far], [-far, far]);
    let both = counts(&[[a, b, c], [a, c, d]], [32, 32]);
    assert!(both.iter().all(|n| *n == 1), "{both:?}");
    let upper = counts(&[[a, b, c]], [32, 32]);
    for (i, n) in upper.iter().enumerate() {
        let (x, y) = (i % 32, i / 32);
        // The diagonal runs through centres; clipping may put those on either side.
        assert!(x == y || *n == u32::from(x > y), "({x}, {y})");
    }
}

#[test]
fn four_samples_count_quarters() {
    let size = [6, 4];
    let mut world = World::default();
    let white = world.material(Material { model: ShadingModel::Constant, emission: Paint::color(1.0, 1.0, 1.0), ..Material::default() });
    // Covers the left half of column 2: the two samples left of its middle.
    let positions = [[1.0, 1.0], [2.5, 1.0], [2.5, 3.0], [1.0, 3.0]].map(|[x, y]| Vec3::new(x, y, 0.0)).to_vec();
    world.place(soup(positions, vec![[0, 1, 2], [0, 2, 3]], Vec::new()), Mat4::IDENTITY, Some(white));
    let display = Display { samples: Samples::Four, ..plain() };
    let pixels = world.draw(&mut Renderer::new(Some(1)), &pixel_camera(size), &display, size);
    let row: Vec<u32> = pixels[6..12].iter().map(|p| p & 255).collect();
    // Half of white's light.
    assert_eq!(row, [0, 255, 188, 0, 0, 0]);
}

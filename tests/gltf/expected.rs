//! What three.js found, kept in `three.json`, for machines without Node.
//!
//! `SINEW_BLESS=1 cargo test --test gltf` writes it anew, where Node is installed.

use std::path::{Path, PathBuf};

use glam::DVec3;
use serde::{Deserialize, Serialize};

/// How far three.js' surface of a demo goes at one moment.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Expected {
    /// The file in `configs/`.
    pub file: String,
    /// Which of the moments.
    pub moment: usize,
    /// Metres from the origin, one a direction.
    pub reach: Vec<f64>,
}

fn kept() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/gltf/three.json")
}

/// What is kept.
pub(crate) fn read() -> Vec<Expected> {
    serde_json::from_slice(&std::fs::read(kept()).expect("tests/gltf/three.json")).expect("JSON")
}

/// Keeps these where that is asked for.
pub(crate) fn bless(found: &[Expected]) {
    if std::env::var_os("SINEW_BLESS").is_some() {
        let lines: Vec<String> = found.iter().map(|row| serde_json::to_string(row).expect("JSON")).collect();
        std::fs::write(kept(), format!("[\n{}\n]\n", lines.join(",\n"))).expect("writable");
    }
}

/// Along the axes, the diagonals of their planes, and those of space, each both ways; in the order of `readback.mjs`.
pub(crate) fn directions() -> Vec<DVec3> {
    let steps = || [-1.0, 0.0, 1.0].into_iter();
    let all = steps().flat_map(|x| steps().flat_map(move |y| steps().map(move |z| DVec3::new(x, y, z))));
    all.filter_map(DVec3::try_normalize).collect()
}

/// How far points go in each direction.
pub(crate) fn reach(points: &[DVec3]) -> Vec<f64> {
    let far = |direction: DVec3| points.iter().map(|point| point.dot(direction)).fold(f64::NEG_INFINITY, f64::max);
    directions().into_iter().map(far).filter(|far| far.is_finite()).collect()
}

/// Largest difference of two surfaces' reach; infinite where one has no points.
pub(crate) fn apart(a: &[f64], b: &[f64]) -> f64 {
    if a.len() != b.len() { f64::INFINITY } else { a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) }
}

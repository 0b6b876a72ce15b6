//! `sinew bench`: how fast the rasterizer is on this machine.

use std::fmt::Write as _;
use std::time::Duration;

use clap::ArgMatches;
use serde::Serialize;

use super::failure::{Failure, answer, answer_json};
use super::measure::columns;
use super::value;
use crate::i18n::decimal;
use crate::render::bench;
use crate::tr;

/// What was measured, for a program.
#[derive(Debug, Serialize)]
struct Report {
    simd: &'static str,
    threads: usize,
    scenes: Vec<Scene>,
}

#[derive(Debug, Serialize)]
struct Scene {
    name: &'static str,
    min_ms: f64,
    median_ms: f64,
}

/// Runs the subcommand.
pub fn run(given: &ArgMatches) -> Result<(), Failure> {
    let seconds = value::<f64>(given, "seconds").unwrap_or(1.0);
    let found = bench::run(value(given, "threads"), None, Duration::from_secs_f64(seconds));
    let scenes = found.rows.iter().map(|row| Scene { name: row.name, min_ms: row.min_ms, median_ms: row.median_ms });
    let report = Report { simd: found.simd, threads: found.threads, scenes: scenes.collect() };
    if given.get_flag("json") { answer_json(&report) } else { answer(&report.text()) }
}

impl Report {
    fn text(&self) -> String {
        let mut rows = vec![vec![tr!("cli-bench-scene"), tr!("cli-bench-median"), tr!("cli-bench-min")]];
        rows.extend(self.scenes.iter().map(|scene| vec![scene.name.to_owned(), decimal(scene.median_ms, 3), decimal(scene.min_ms, 3)]));
        let mut text = columns(&rows);
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{}", tr!("cli-bench-made", simd = self.simd, threads = self.threads));
        text
    }
}

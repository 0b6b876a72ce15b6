//! The command line, called as a program.

#[path = "../support/mod.rs"]
mod support;

mod attach;
mod bench;
mod export;
mod guard;
mod help;
mod info;
mod input;
mod measure;
mod render;
mod sequence;
mod simd;
mod tables;
mod terminal;
mod whole;
mod wrong;
mod yaml;

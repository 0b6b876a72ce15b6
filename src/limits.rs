//! Every bound on what a file may ask for. A message about a limit names the number it broke.

/// Largest file that is read, bytes.
pub const FILE_BYTES: u64 = 1 << 30;
/// Largest YAML file that is read, bytes.
pub const YAML_BYTES: u64 = 4 << 20;
/// Largest image file that is read, bytes.
pub const IMAGE_BYTES: u64 = 256 << 20;
/// Largest side of an image, pixels.
pub const IMAGE_SIDE: u32 = 16_384;
/// Deepest nesting of elements or nodes.
pub const DEPTH: usize = 1_000;
/// Most nodes in a scene, instances counted.
pub const NODES: usize = 1_000_000;
/// Most nodes of one muscle.
pub const MUSCLE_NODES: usize = 10_000;
/// Most muscles in one file.
pub const MUSCLES: usize = 1_000;
/// Largest side of a picture, pixels.
pub const PICTURE_SIDE: u32 = 16_384;
/// Most worker threads of the renderer.
pub const THREADS: usize = 256;

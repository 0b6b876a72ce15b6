//! Asking what lies under a pixel.

use glam::Vec3;

use sinew_scene::NodeId;

use super::RenderJob;

/// Asks what lies under one pixel of a picture that need not be drawn.
#[derive(Debug, Clone, Copy)]
pub struct PickJob<'a> {
    /// The picture.
    pub picture: RenderJob<'a>,
    /// Pixels from its left edge; the pixel that holds this point is asked about.
    pub x: f32,
    /// Pixels from its upper edge.
    pub y: f32,
}

/// What lies under a pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PickHit {
    /// The node that the surface or bone hangs on.
    pub node: NodeId,
    /// Index in [`Frame::surfaces`](sinew_scene::Frame::surfaces); `None` for a bone.
    pub surface: Option<u32>,
    /// Index in the surface's mesh triangles; 0 for a bone.
    pub triangle: u32,
    /// Weights of the triangle's corners; they add up to 1.
    pub barycentric: Vec3,
    /// The point in the world, metres.
    pub point: Vec3,
}

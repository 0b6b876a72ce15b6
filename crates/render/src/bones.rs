//! Bones as shaded octahedra, joints as dots that keep their size on the picture.

use glam::{Vec3, Vec4};

use super::debug_lines::LineBuilder;
use super::draw_data::GeneratedMesh;
use super::draw_list::rgb;
use super::line::{LinePass, LineStyle};
use super::{Display, RenderError};
use sinew_scene::{Frame, NodeId, Scene};

/// Triangles of an octahedron.
pub(super) const FACES: usize = 8;
/// Radius of a joint's dot in logical pixels.
pub(super) const DOT_RADIUS: f32 = 3.2;

/// How far dots and axes are brought forward, so that a bone does not hide the joint in it; see [`super::projection::ViewTransform::depth_bias`].
pub(super) const DEPTH_BIAS: f32 = 20.0;

/// Where along a bone its girdle is, and how thick it is there, as shares of its length.
const RING_POSITION: f32 = 0.14;
const THICKNESS: f32 = 0.075;

/// A bone: the joint that moves it, its head and its tip.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bone {
    pub owner: NodeId,
    pub head: Vec3,
    pub tip: Vec3,
}

/// The bones of the frame: one from each joint to each joint below it.
pub(super) fn bones<'a>(scene: &'a Scene, frame: &'a Frame) -> impl Iterator<Item = Bone> + 'a {
    frame.joints.iter().filter_map(move |joint| {
        let owner = joint.parent?;
        let bone = Bone { owner, head: frame.position(owner), tip: frame.position(joint.node) };
        let shown = joint.node.index() < scene.graph.len() && scene.graph.is_shown(joint.node);
        let length = (bone.tip - bone.head).length();
        (shown && length.is_finite() && length > 1e-9).then_some(bone)
    })
}

/// The four corners of an octahedron between head and tip.
fn ring(frame: &Frame, bone: &Bone) -> [Vec3; 4] {
    let along = bone.tip - bone.head;
    let length = along.length();
    let axis = along / length;
    // The girdle turns with the bone's own x axis.
    let own = frame.world.get(bone.owner.index()).map_or(Vec3::X, |matrix| matrix.x_axis.truncate().as_vec3());
    let side = (own - axis * own.dot(axis)).try_normalize().unwrap_or_else(|| axis.any_orthonormal_vector());
    let other = axis.cross(side);
    let middle = bone.head + along * RING_POSITION;
    [side, other, -side, -other].map(|out| middle + out * (length * THICKNESS))
}

/// The palette's colour for what hangs on `node`.
pub(super) fn color(display: &Display, node: NodeId) -> [f32; 3] {
    let palette = &display.palette;
    rgb(if display.highlight.selected == Some(node) {
        palette.selected
    } else if display.highlight.hovered == Some(node) {
        palette.hovered
    } else {
        palette.bone
    })
}

impl GeneratedMesh {
    /// Makes the octahedra of all bones.
    pub(super) fn bones(&mut self, scene: &Scene, frame: &Frame, display: &Display) -> Result<(), RenderError> {
        self.positions.clear();
        self.normals.clear();
        self.colors.clear();
        self.triangles.clear();
        let faces = bones(scene, frame).count() * FACES;
        self.positions.try_reserve(faces * 3)?;
        self.normals.try_reserve(faces * 3)?;
        self.colors.try_reserve(faces * 3)?;
        self.triangles.try_reserve(faces)?;
        for bone in bones(scene, frame) {
            let paint = color(display, bone.owner);
            self.octahedron(frame, &bone, Vec4::new(paint[0], paint[1], paint[2], 1.0));
        }
        Ok(())
    }

    fn octahedron(&mut self, frame: &Frame, bone: &Bone, paint: Vec4) {
        let ring = ring(frame, bone);
        for k in 0..4 {
            let (a, b) = (ring[k], ring[(k + 1) % 4]);
            self.face([a, b, bone.tip], paint);
            self.face([b, a, bone.head], paint);
        }
    }

    fn face(&mut self, corners: [Vec3; 3], paint: Vec4) {
        let [a, b, c] = corners;
        let normal = (b - a).cross(c - a).try_normalize().unwrap_or(Vec3::Y);
        let first = self.positions.len() as u32;
        self.positions.extend(corners);
        self.normals.extend([normal; 3]);
        self.colors.extend([paint; 3]);
        self.triangles.push([first, first + 1, first + 2]);
    }
}

impl LineBuilder<'_> {
    /// Outlines the bones of the selected joint; where bones are not shown, its own place is marked too.
    pub(super) fn selected_bones(&mut self, scene: &Scene, frame: &Frame) {
        let Some(selected) = self.display.highlight.selected.filter(|node| frame.joints.iter().any(|joint| joint.node == *node)) else {
            return;
        };
        if selected.index() >= scene.graph.len() || !scene.graph.is_shown(selected) {
            return;
        }
        let (palette, shown) = (&self.display.palette, self.display.bones);
        // On the selected bone's own colour a line of that colour would not be seen.
        let line = if shown { palette.grid.0 } else { palette.selected };
        let line_style = LineStyle { pass: LinePass::Overlay, depth_bias: DEPTH_BIAS, ..self.line_style(rgb(line), 1.0, 1.4) };
        for bone in bones(scene, frame).filter(|bone| bone.owner == selected) {
            let ring = ring(frame, &bone);
            let faces = |a: Vec3, b: Vec3, c: Vec3| {
                let towards = if self.view.perspective { self.view.eye - a } else { self.view.back };
                (b - a).cross(c - a).dot(towards) > 0.0
            };
            let next = |k: usize| ring[(k + 1) % 4];
            let upper: [bool; 4] = std::array::from_fn(|k| faces(ring[k], next(k), bone.tip));
            let lower: [bool; 4] = std::array::from_fn(|k| faces(next(k), ring[k], bone.head));
            // The outline is where a face that is seen meets one that is not.
            for k in 0..4 {
                let before = (k + 3) % 4;
                let edges =
                    [(upper[k] != lower[k], next(k)), (upper[k] != upper[before], bone.tip), (lower[k] != lower[before], bone.head)];
                for (_, other) in edges.into_iter().filter(|(outer, _)| *outer) {
                    self.line(ring[k], other, &line_style);
                }
            }
        }
        if shown {
            return;
        }
        let at = frame.position(selected);
        self.line(at, at, &LineStyle { width: (2.0 * DOT_RADIUS + 3.0) * self.scale(), depth_bias: DEPTH_BIAS + 2.0, ..line_style });
    }

    /// Joints as dots with a dark rim, and their axes where they are asked for.
    pub(super) fn joints(&mut self, scene: &Scene, frame: &Frame) {
        let radius = DOT_RADIUS * self.scale();
        for joint in &frame.joints {
            if joint.node.index() >= scene.graph.len() || !scene.graph.is_shown(joint.node) {
                continue;
            }
            let at = frame.position(joint.node);
            let paint = color(self.display, joint.node);
            if self.display.bones {
                let plain = LineStyle { pass: LinePass::Overlay, depth_test: true, ..self.line_style(paint, 1.0, 1.0) };
                let rim = paint.map(|c| c * 0.25);
                self.line(at, at, &LineStyle { color: rim, width: 2.0 * radius + 2.5, depth_bias: DEPTH_BIAS, ..plain });
                let dot = LineStyle { width: 2.0 * radius, depth_bias: DEPTH_BIAS + 1.0, ..plain };
                self.line(at, at, &dot);
            }
            if self.display.bone_axes {
                let length = frame.bounds.diagonal() * 0.03;
                self.node_axes(frame, joint.node, length);
            }
        }
    }
}

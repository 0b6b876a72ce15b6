//! Picking: the surface under a pixel, from the same vertices, edges and depths as in the picture.

use glam::{DVec3, Vec3};

use super::bones::{DEPTH_BIAS, DOT_RADIUS, FACES, bones};
use super::clip::clip;
use super::draw_data::{DrawCall, FrameData, GeometrySource};
use super::frame_stages::{Buffers, TargetLayout};
use super::material_state::RenderPass;
use super::pool::Pool;
use super::projection::{BAD, ScreenVertex};
use super::setup::{AttributePlanes, Edges, Rect, area};
use super::{Display, PickHit, PickJob, RenderError, RenderJob};
use sinew_scene::{NodeId, Scene};
use sinew_simd::SimdLevel;

/// The nearest thing so far.
#[derive(Clone, Copy)]
struct Hit {
    q: f32,
    pick: PickHit,
}

impl Buffers {
    /// What lies under the pixel that holds (`x`, `y`).
    pub(super) fn pick(&mut self, pool: &Pool, level: SimdLevel, job: &PickJob<'_>) -> Result<Option<PickHit>, RenderError> {
        let PickJob { picture, x, y } = *job;
        let RenderJob { scene, frame, display, width, height, .. } = picture;
        if !(x >= 0.0 && y >= 0.0 && x < width as f32 && y < height as f32) {
            return Ok(None);
        }
        let (px, py) = (x as i32, y as i32);
        let layout = TargetLayout::new(display, width, height);
        let (view, lights) = self.list.build(&picture, &layout, true)?;
        self.vertices.fill((pool, level), &self.list, frame, &view, &lights)?;
        let frame_data = self.list.frame_data(&self.vertices, frame, view, lights);
        let (mut surface, mut overlay) = (None, None);
        let mut owners: Vec<NodeId> = Vec::new();
        if display.bones {
            owners.try_reserve(bones(scene, frame).count())?;
            owners.extend(bones(scene, frame).map(|bone| bone.owner));
        }
        for item in frame_data.draw_calls {
            let best = if item.material.pass == RenderPass::Overlay { &mut overlay } else { &mut surface };
            look(&frame_data, item, &owners, (px, py), best);
        }
        if display.bones {
            dots(&frame_data, scene, display, [x, y], &mut overlay);
        }
        let in_front = |bone: &Hit| display.xray || !display.depth_test || surface.is_none_or(|surface: Hit| bone.q >= surface.q);
        Ok(overlay.filter(in_front).or(surface).map(|hit| hit.pick))
    }
}

/// Looks through the triangles of an item.
fn look(frame_data: &FrameData<'_>, item: &DrawCall, owners: &[NodeId], at: (i32, i32), best: &mut Option<Hit>) {
    let reader = frame_data.reader(item);
    for t in 0..item.triangles.len() {
        let Some(screen) = reader.screen_vertices(t) else { continue };
        let codes = screen.map(|corner| corner.code);
        let (any, all) = (codes[0] | codes[1] | codes[2], codes[0] & codes[1] & codes[2]);
        let identity = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let mut one = |screen: [ScreenVertex; 3], mixture: [[f32; 3]; 3]| {
            let Some((q, shares)) = touch(frame_data, item, t, screen, at) else { return };
            // The picture keeps the first of two that are equally near; without a depth test the last.
            if !item.material.depth_test || best.is_none_or(|best| q > best.q) {
                *best = Some(Hit { q, pick: describe(frame_data, item, owners, t, shares, mixture) });
            }
        };
        if any == 0 {
            one(screen, identity);
        } else if all == 0 && any & BAD == 0 {
            let corners = reader.geometry.triangles[t].map(|v| reader.geometry.world(v as usize));
            clip(&frame_data.view, corners, &screen, 0, |piece| one(piece.screen, piece.barycentric));
        }
    }
}

/// Whether the pixel is drawn by this triangle: its nearness there, and the corners' shares in the point.
fn touch(
    frame_data: &FrameData<'_>,
    item: &DrawCall,
    t: usize,
    mut screen: [ScreenVertex; 3],
    (px, py): (i32, i32),
) -> Option<(f32, DVec3)> {
    let mut size = area(&screen);
    let away = (size > 0) != item.material.mirrored;
    if item.culls(t, size) {
        return None;
    }
    let swapped = size < 0;
    if swapped {
        screen.swap(1, 2);
        size = -size;
    }
    // The box of the picture, since planes are set up from its corner.
    let rect = Rect::of(&screen, false, frame_data.view.size);
    if px < rect.x0 || px > rect.x1 || py < rect.y0 || py > rect.y1 || !Edges::new(&screen, px, py).covers(0, 0, [0, 0]) {
        return None;
    }
    let planes = AttributePlanes::new(&screen, size, &screen.map(|corner| [corner.q]), rect.x0, rect.y0);
    let retreat = if away { planes.retreat(screen.map(|corner| corner.q)) } else { 0.0 };
    let q = planes.row(py - rect.y0)[0] + planes.right[0] * (px - rect.x0) as f32 - retreat;
    let (cx, cy) = (f64::from(px) * 256.0 + 128.0, f64::from(py) * 256.0 + 128.0);
    let side = |i: usize| {
        let (p, q) = (&screen[(i + 1) % 3], &screen[(i + 2) % 3]);
        f64::from(p.y - q.y) * (cx - f64::from(p.x)) + f64::from(q.x - p.x) * (cy - f64::from(p.y))
    };
    let mut shares = DVec3::new(side(0), side(1), side(2)) / size as f64;
    if frame_data.view.perspective {
        shares *= DVec3::new(f64::from(screen[0].q), f64::from(screen[1].q), f64::from(screen[2].q));
    }
    shares /= shares.x + shares.y + shares.z;
    if swapped {
        shares = DVec3::new(shares.x, shares.z, shares.y);
    }
    Some((q, shares))
}

fn describe(frame_data: &FrameData<'_>, item: &DrawCall, owners: &[NodeId], t: usize, shares: DVec3, mixture: [[f32; 3]; 3]) -> PickHit {
    let column = |i: usize| shares.x * f64::from(mixture[0][i]) + shares.y * f64::from(mixture[1][i]) + shares.z * f64::from(mixture[2][i]);
    let barycentric = DVec3::new(column(0), column(1), column(2)).as_vec3();
    let geometry = frame_data.reader(item).geometry;
    let [a, b, c] = geometry.triangles[t].map(|v| geometry.world(v as usize));
    let point = a * barycentric.x + b * barycentric.y + c * barycentric.z;
    match &item.source {
        GeometrySource::Surface { index, triangles } => {
            let node = frame_data.frame.surfaces[*index as usize].node;
            PickHit { node, surface: Some(*index), triangle: triangles.start + t as u32, barycentric, point }
        }
        GeometrySource::Bones => {
            let node = owners.get(t / FACES).copied().unwrap_or(NodeId(0));
            PickHit { node, surface: None, triangle: 0, barycentric, point }
        }
    }
}

/// The dots of the joints.
fn dots(frame_data: &FrameData<'_>, scene: &Scene, display: &Display, at: [f32; 2], best: &mut Option<Hit>) {
    let radius = f64::from(DOT_RADIUS * if display.scale.is_finite() { display.scale.clamp(0.25, 8.0) } else { 1.0 }) + 1.0;
    for joint in &frame_data.frame.joints {
        let point: Vec3 = frame_data.frame.position(joint.node);
        let clip = frame_data.view.clip(point);
        if joint.node.index() >= scene.graph.len()
            || !scene.graph.is_shown(joint.node)
            || clip[3].is_nan()
            || clip[3] < f64::from(frame_data.view.near)
        {
            continue;
        }
        let [x, y, q] = frame_data.view.project(clip);
        let near = (x - f64::from(at[0])).hypot(y - f64::from(at[1])) <= radius;
        let [factor, summand] = frame_data.view.depth_bias(DEPTH_BIAS + 1.0);
        let q = q as f32 * factor + summand;
        if near && best.is_none_or(|best| q > best.q) {
            let pick = PickHit { node: joint.node, surface: None, triangle: 0, barycentric: Vec3::X, point };
            *best = Some(Hit { q, pick });
        }
    }
}

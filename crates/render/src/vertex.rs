//! The vertex stage: every vertex is transformed, projected and lit once, into flat arrays.

use glam::{Mat3, Mat4, Vec3, Vec4};

use super::light::{LightingTerms, Lights, V3, lighting_terms, normalize, shading_point};
use super::material_state::{ResolvedMaterial, VertexOutput};
use super::projection::{BAD, NEAR, SIDES, ScreenVertex, ViewTransform};
use sinew_simd::{Simd, always, kernel, map};

/// Four floats of a vertex: what they mean depends on [`VertexOutput`].
pub(super) type Quad = [f32; 4];

/// Vertices handed to a worker at a time; a multiple of every lane count.
pub(super) const CHUNK: usize = 512;

/// The geometry of a surface or of generated things, as the stages read it.
#[derive(Clone, Copy)]
pub(super) struct VertexSource<'a> {
    pub positions: &'a [Vec3],
    pub normals: &'a [Vec3],
    /// Into the world; `None` where it is there already.
    pub transform: Option<(Mat4, Mat3)>,
    /// The triangles of the item.
    pub triangles: &'a [[u32; 3]],
    /// One a vertex, or empty.
    pub colors: &'a [Vec4],
    /// One a vertex, or empty: colours that stand in for those of the mesh.
    pub computed_colors: &'a [Vec4],
    /// Which mesh vertex is vertex 0 of the item; not used where `expanded`.
    pub first: u32,
    /// Vertex `3t + k` of the item is corner `k` of triangle `t`: used where a part picks few vertices out of many.
    pub expanded: bool,
}

impl VertexSource<'_> {
    /// The mesh vertex that vertex `i` of the item is.
    #[inline(always)]
    pub(super) fn mesh_vertex(&self, i: usize) -> usize {
        if self.expanded { self.triangles[i / 3][i % 3] as usize } else { self.first as usize + i }
    }

    /// The vertex of the item that corner `k` of triangle `t` is; beyond the end where the mesh names one that isn't there.
    #[inline(always)]
    pub(super) fn item_vertex(&self, t: usize, k: usize) -> usize {
        if self.expanded { t * 3 + k } else { self.triangles[t][k].wrapping_sub(self.first) as usize }
    }

    /// Position in the world; NaN where there is none.
    pub(super) fn world(&self, v: usize) -> Vec3 {
        let p = self.positions.get(v).copied().unwrap_or(Vec3::NAN);
        self.transform.map_or(p, |(matrix, _)| matrix.transform_point3(p))
    }

    /// The colour that multiplies the material at mesh vertex `v`.
    pub(super) fn tint(&self, v: usize) -> Vec4 {
        self.computed_colors.get(v).or_else(|| self.colors.get(v)).copied().unwrap_or(Vec4::ONE)
    }
}

/// The part of the output arrays that one chunk fills.
pub(super) struct VertexBuffers<'a> {
    pub screen: &'a mut [ScreenVertex],
    pub front: &'a mut [Quad],
    pub back: &'a mut [Quad],
}

kernel! {
    /// Transforms, projects and lights the vertices of an item from `start` on, as many as `out` has room for.
    pub(super) fn vertices<'a>(view: &ViewTransform, lights: &Lights, style: &ResolvedMaterial, geometry: &VertexSource<'a>, start: usize, out: VertexBuffers<'a>) = chunk
}

#[inline(always)]
fn chunk<L: Simd>(
    l: L,
    view: &ViewTransform,
    lights: &Lights,
    style: &ResolvedMaterial,
    geometry: &VertexSource<'_>,
    start: usize,
    out: VertexBuffers<'_>,
) {
    let count = out.screen.len();
    let mut done = 0;
    while done < count {
        let n = (count - done).min(L::N);
        let here = start + done;
        let mut gathered = VertexBatch::default();
        gathered.fill(geometry, here, n, style.tinted);
        let mut p = map(gathered.position, always!(|lane: [f32; 16]| l.load(&lane)));
        let mut normal = map(gathered.normal, always!(|lane: [f32; 16]| l.load(&lane)));
        if let Some((matrix, turn)) = &geometry.transform {
            p = transform(l, matrix, p);
            normal = rotate(l, turn, normal);
        }
        normal = normalize(l, normal);
        project(l, view, p, &mut out.screen[done..done + n]);
        match style.vertex_output {
            VertexOutput::Geometry => {
                let zero = l.splat(0.0);
                scatter(l, [p[0], p[1], p[2], zero], &mut out.front[done..done + n]);
                scatter(l, [normal[0], normal[1], normal[2], zero], &mut out.back[done..done + n]);
            }
            VertexOutput::Light | VertexOutput::Color => {
                let seen = shading_point(l, lights, p, normal);
                let tint = map(gathered.tint, always!(|lane: [f32; 16]| l.load(&lane)));
                let front = vertex_color(l, style, lighting_terms(l, lights, style.highlight, seen, false), tint);
                scatter(l, front, &mut out.front[done..done + n]);
                if style.both_sides {
                    let back = vertex_color(l, style, lighting_terms(l, lights, style.highlight, seen, true), tint);
                    scatter(l, back, &mut out.back[done..done + n]);
                }
            }
        }
        done += n;
    }
}

/// Vertices brought from "xyz xyz xyz" to "xxx yyy zzz".
struct VertexBatch {
    position: [[f32; 16]; 3],
    normal: [[f32; 16]; 3],
    tint: [[f32; 16]; 4],
}

impl Default for VertexBatch {
    #[inline(always)]
    fn default() -> Self {
        Self { position: [[0.0; 16]; 3], normal: [[0.0; 16]; 3], tint: [[1.0; 16]; 4] }
    }
}

impl VertexBatch {
    #[inline(always)]
    fn fill(&mut self, geometry: &VertexSource<'_>, start: usize, n: usize, tinted: bool) {
        let first = geometry.first as usize + start;
        let straight = geometry.positions.get(first..first + n).zip(geometry.normals.get(first..first + n));
        if let (Some((positions, normals)), false, false) = (straight, geometry.expanded, tinted) {
            for k in 0..n {
                (self.position[0][k], self.position[1][k], self.position[2][k]) = positions[k].into();
                (self.normal[0][k], self.normal[1][k], self.normal[2][k]) = normals[k].into();
            }
            return;
        }
        for k in 0..n {
            let v = geometry.mesh_vertex(start + k);
            let position = geometry.positions.get(v).copied().unwrap_or(Vec3::NAN);
            let normal = geometry.normals.get(v).copied().unwrap_or(Vec3::Y);
            (self.position[0][k], self.position[1][k], self.position[2][k]) = position.into();
            (self.normal[0][k], self.normal[1][k], self.normal[2][k]) = normal.into();
            let tint = geometry.tint(v).to_array();
            for (lane, value) in self.tint.iter_mut().zip(tint) {
                lane[k] = value;
            }
        }
    }
}

#[inline(always)]
fn transform<L: Simd>(l: L, m: &Mat4, p: V3<L>) -> V3<L> {
    let row = always!(|i: usize| {
        let r = [m.x_axis[i], m.y_axis[i], m.z_axis[i], m.w_axis[i]];
        let r = map(r, always!(|x| l.splat(x)));
        r[0] * p[0] + r[1] * p[1] + r[2] * p[2] + r[3]
    });
    [row(0), row(1), row(2)]
}

#[inline(always)]
fn rotate<L: Simd>(l: L, m: &Mat3, p: V3<L>) -> V3<L> {
    let row = always!(|i: usize| {
        let r = [m.x_axis[i], m.y_axis[i], m.z_axis[i]];
        let r = map(r, always!(|x| l.splat(x)));
        r[0] * p[0] + r[1] * p[1] + r[2] * p[2]
    });
    [row(0), row(1), row(2)]
}

#[inline(always)]
fn project<L: Simd>(l: L, view: &ViewTransform, p: V3<L>, out: &mut [ScreenVertex]) {
    let row = always!(|r: Vec4| {
        let r = map(r.to_array(), always!(|x| l.splat(x)));
        r[0] * p[0] + r[1] * p[1] + r[2] * p[2] + r[3]
    });
    let (x, y, distance) = (row(view.x), row(view.y), row(view.distance));
    let one = l.splat(1.0);
    let w = if view.perspective { distance } else { one };
    let inverse = one / w;
    let q = if view.perspective { inverse } else { row(view.nearness) };
    let [half_x, half_y] = map(view.half, always!(|half| l.splat(half)));
    let snap = always!(|pixels: L::F| l.trunc(l.floor(pixels * l.splat(256.0) + l.splat(0.5))));
    let (sx, sy) = (snap((x * inverse + one) * half_x), snap((one - y * inverse) * half_y));
    // Everything is asked so that NaN answers "no".
    let [gx, gy] = map(view.guard(), always!(|g| l.splat(g) * w));
    let zero = l.splat(0.0);
    let flag = always!(|ok: L::M, code: u32| l.iselect(ok, l.isplat(0), l.isplat(code as i32)));
    let largest = l.max(l.max(l.abs(x), l.abs(y)), l.abs(distance));
    // A sum is not a number, or infinite, if one of its terms is.
    let finite = l.lt(l.abs(x) + l.abs(y) + l.abs(distance) + largest, l.splat(f32::MAX));
    let code = flag(l.lt(zero - distance, l.splat(-view.near)), NEAR)
        | flag(l.lt(zero - gx, x), SIDES[0])
        | flag(l.lt(x, gx), SIDES[1])
        | flag(l.lt(y, gy), SIDES[2])
        | flag(l.lt(zero - gy, y), SIDES[3])
        | flag(finite, BAD);
    let mut lanes = [[0u32; 16]; 4];
    l.istore(sx, &mut lanes[0]);
    l.istore(sy, &mut lanes[1]);
    l.istore(l.bits(q), &mut lanes[2]);
    l.istore(code, &mut lanes[3]);
    for (k, screen) in out.iter_mut().enumerate() {
        *screen = ScreenVertex { x: lanes[0][k] as i32, y: lanes[1][k] as i32, q: f32::from_bits(lanes[2][k]), code: lanes[3][k] };
    }
}

/// What a vertex hands on: its finished colour and opacity, or the light and highlight that a texture waits for. 0 to 255.
#[inline(always)]
fn vertex_color<L: Simd>(l: L, style: &ResolvedMaterial, lighting: LightingTerms<L>, tint: [L::F; 4]) -> [L::F; 4] {
    let full = l.splat(255.0);
    match style.vertex_output {
        VertexOutput::Color => {
            let color = combine_lighting(l, style, lighting, [tint[0], tint[1], tint[2]], map(style.emission, always!(|e| l.splat(e))));
            // Held within 0 to 255, which the kernels count on.
            let all = [color[0] * full, color[1] * full, color[2] * full, tint[3] * l.splat(style.opacity * 255.0)];
            map(all, always!(|c: L::F| l.clamp(c, 0.0, 255.0)))
        }
        _ => {
            let light = if style.unlit { [l.splat(1.0); 3] } else { lighting.light };
            let c = always!(|i: usize| light[i] * tint[i] * l.splat(style.albedo[i]) * full);
            [c(0), c(1), c(2), lighting.highlight]
        }
    }
}

/// Light on a material: `base` multiplies its colour. 0 to 1.
#[inline(always)]
pub(super) fn combine_lighting<L: Simd>(l: L, style: &ResolvedMaterial, lighting: LightingTerms<L>, base: V3<L>, emission: V3<L>) -> V3<L> {
    let one = l.splat(1.0);
    let channel = always!(|i: usize| {
        let albedo = base[i] * l.splat(style.albedo[i]);
        let lit = if style.unlit { albedo } else { albedo * lighting.light[i] };
        // Screen on the highlight and the emission.
        let dark = (one - lit) * (one - lighting.highlight * l.splat(style.specular[i])) * (one - emission[i]);
        let out = one - dark;
        out + (l.splat(style.mark[i]) - out) * l.splat(style.mark_share)
    });
    [channel(0), channel(1), channel(2)]
}

#[inline(always)]
fn scatter<L: Simd>(l: L, x: [L::F; 4], out: &mut [Quad]) {
    let mut lanes = [[0.0f32; 16]; 4];
    for (lane, x) in lanes.iter_mut().zip(x) {
        l.store(x, lane);
    }
    for (k, quad) in out.iter_mut().enumerate() {
        *quad = [lanes[0][k], lanes[1][k], lanes[2][k], lanes[3][k]];
    }
}

//! Lighting: one key light, hemispheric ambient light, and a specular highlight where the material has one.
//!
//! Colours are worked on as the files write them (sRGB-encoded), so 50 % grey in full light is 50 % grey. No term can reach beyond white:
//! the diffuse weights add up to at most 1, and highlights and emission are *screened* on, `1 − (1 − a)(1 − b)`.

use glam::Vec3;

use super::projection::ViewTransform;
use sinew_simd::{Simd, always, map};

/// Ambient light from straight above and straight below, and from the direction of the viewer: what keeps form readable in the shade.
const SKY: [f32; 3] = [0.70, 0.74, 0.80];
const GROUND: [f32; 3] = [0.50, 0.46, 0.44];
const VIEWER: [f32; 3] = [0.26, 0.25, 0.24];
/// The key light's colour, a little warm.
const KEY: [f32; 3] = [1.0, 0.985, 0.96];

/// Everything about light that is the same for the whole picture.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lights {
    /// Position of the key light.
    pub position: Vec3,
    /// Position of the camera, or the direction to the viewer in orthographic projection.
    pub eye: Vec3,
    pub perspective: bool,
    /// Ambient colour on a level surface, its change towards the sky, and what comes from the viewer.
    middle: [f32; 3],
    slope: [f32; 3],
    viewer: [f32; 3],
    key: [f32; 3],
}

impl Lights {
    /// `ambient` from 0 to 1 sets the share of the ambient light, the key light has the rest. The eye judges light by ratios, so the share
    /// rises fast from 0: a quarter of the way gives two fifths of the light to the shade.
    pub(super) fn new(position: Vec3, ambient: f32, view: &ViewTransform) -> Self {
        let ambient = if ambient.is_finite() { ambient.clamp(0.0, 1.0) } else { 0.25 };
        let ambient = ambient * (1.75 - 0.75 * ambient);
        let each = |f: fn(usize) -> f32| -> [f32; 3] { std::array::from_fn(f) };
        let scaled = |colour: [f32; 3], by: f32| colour.map(|c| c * by);
        Self {
            position,
            eye: if view.perspective { view.eye } else { view.back },
            perspective: view.perspective,
            middle: scaled(each(|i| (SKY[i] + GROUND[i]) * 0.5), ambient),
            slope: scaled(each(|i| (SKY[i] - GROUND[i]) * 0.5), ambient),
            viewer: scaled(VIEWER, ambient),
            key: scaled(KEY, 1.0 - ambient),
        }
    }
}

/// The highlight of a material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Specular {
    /// Exponent; 0 = no highlight at all.
    pub exponent: f32,
    /// Mirrored ray (Phong) instead of half vector (Blinn).
    pub mirrored: bool,
}

/// A vector of lanes.
pub(super) type V3<L> = [<L as Simd>::F; 3];

#[inline(always)]
pub(super) fn dot<L: Simd>(_: L, a: V3<L>, b: V3<L>) -> L::F {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// A vector of length 1; what is too short to have a direction becomes very short.
#[inline(always)]
pub(super) fn normalize<L: Simd>(l: L, a: V3<L>) -> V3<L> {
    let length = l.sqrt(dot(l, a, a));
    let inverse = l.splat(1.0) / l.max(length, l.splat(1e-20));
    map(a, always!(|x| x * inverse))
}

/// Light that falls on a point, before it meets the material.
#[derive(Clone, Copy)]
pub(super) struct LightingTerms<L: Simd> {
    /// Diffuse light, 0 to 1.
    pub light: V3<L>,
    /// Strength of the highlight, 0 to 1.
    pub highlight: L::F,
}

/// What a point sees: enough to light either of its sides.
#[derive(Clone, Copy)]
pub(super) struct ShadingPoint<L: Simd> {
    light: L::F,
    viewer: L::F,
    up: L::F,
    between: L::F,
}

/// Light and viewer as seen from `p` with the unit normal `n`.
#[inline(always)]
pub(super) fn shading_point<L: Simd>(l: L, lights: &Lights, p: V3<L>, n: V3<L>) -> ShadingPoint<L> {
    let splat = always!(|v: Vec3| [l.splat(v.x), l.splat(v.y), l.splat(v.z)]);
    let towards = always!(|v: Vec3| {
        let v = splat(v);
        normalize(l, [v[0] - p[0], v[1] - p[1], v[2] - p[2]])
    });
    let to_light = towards(lights.position);
    let to_eye = if lights.perspective { towards(lights.eye) } else { splat(lights.eye) };
    ShadingPoint { light: dot(l, n, to_light), viewer: dot(l, n, to_eye), up: n[1], between: dot(l, to_light, to_eye) }
}

/// Lights the side of a surface that the normal is on, or with `other` the other one.
#[inline(always)]
pub(super) fn lighting_terms<L: Simd>(l: L, lights: &Lights, specular: Specular, point: ShadingPoint<L>, other: bool) -> LightingTerms<L> {
    let (zero, one) = (l.splat(0.0), l.splat(1.0));
    let turn = always!(|x: L::F| if other { zero - x } else { x });
    let (ndl, ndv, up) = (turn(point.light), turn(point.viewer), turn(point.up));
    let (direct, facing) = (l.max(ndl, zero), l.max(ndv, zero));
    let mut light = [zero; 3];
    for (i, out) in light.iter_mut().enumerate() {
        *out = l.splat(lights.middle[i])
            + l.splat(lights.slope[i]) * up
            + l.splat(lights.viewer[i]) * facing
            + l.splat(lights.key[i]) * direct;
    }
    let highlight = if specular.exponent > 0.0 {
        let cosine = if specular.mirrored {
            // r·v with r the light mirrored at the normal; turning the normal round changes nothing.
            l.splat(2.0) * point.light * point.viewer - point.between
        } else {
            (ndl + ndv) / l.max(l.sqrt(l.max(l.splat(2.0) + l.splat(2.0) * point.between, zero)), l.splat(1e-6))
        };
        let strength = pow(l, l.min(l.max(cosine, l.splat(1e-6)), one), specular.exponent);
        l.select(l.lt(zero, ndl), strength, zero)
    } else {
        zero
    };
    LightingTerms { light, highlight }
}

/// `x` to the power `exponent`, for x from 1e-6 to 1 and exponents ≥ 0; relative error below 1e-4 at exponent 1000.
#[inline(always)]
pub(super) fn pow<L: Simd>(l: L, x: L::F, exponent: f32) -> L::F {
    // log2 x = e + log2 m with m in [√½, √2), and log2 m = 2/ln 2 · atanh((m − 1)/(m + 1)).
    let one = l.splat(1.0);
    let bits = l.bits(x);
    let shifted = bits - l.isplat(0x3F35_04F3);
    // An arithmetic shift by 23, made of a logical one: the exponent is never below −20 here.
    let exponent_bits = l.shr::<23>(shifted + l.isplat(64 << 23)) - l.isplat(64);
    let mantissa = l.float_bits(bits - l.shl::<23>(exponent_bits));
    let f = (mantissa - one) / (mantissa + one);
    let ff = f * f;
    let series = one + ff * (l.splat(1.0 / 3.0) + ff * (l.splat(1.0 / 5.0) + ff * l.splat(1.0 / 7.0)));
    let log2 = l.float(exponent_bits) + f * series * l.splat(2.0 * std::f32::consts::LOG2_E);
    // 2^y for y in [−125, 0]: whole part into the exponent, the rest by its Taylor series.
    let y = l.max(log2 * l.splat(exponent), l.splat(-125.0));
    let whole = l.floor(y);
    let t = (y - whole) * l.splat(std::f32::consts::LN_2);
    let mut sum = one;
    for n in [7.0, 6.0, 5.0, 4.0, 3.0, 2.0, 1.0] {
        sum = one + sum * t * l.splat(1.0 / n);
    }
    l.float_bits(l.bits(sum) + l.shl::<23>(l.trunc(whole)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use sinew_simd::Scalar;

    #[test]
    fn powers_are_powers() {
        for exponent in [0.5_f32, 1.0, 5.0, 20.0, 128.0, 1000.0] {
            for i in 1..=1000 {
                let x = i as f32 / 1000.0;
                let exact = f64::from(x).powf(f64::from(exponent));
                let found = f64::from(pow(Scalar, x, exponent));
                assert!((found - exact).abs() <= 1e-4 * exact + 1e-30, "{x}^{exponent} = {exact}, not {found}");
            }
        }
    }
}

//! A wrap surface in the world, and the lines that show its shape.

use std::f64::consts::TAU;

use glam::{DMat3, DVec3};

use super::config::WrapShape;

/// Straight pieces of a full circle of an outline.
const PIECES: usize = 48;
/// Rings of a torus' tube that are drawn.
const TUBES: usize = 12;

/// A surface that a muscle goes round, in the world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WrapPlacement {
    /// Its shape; lengths in metres.
    pub shape: WrapShape,
    /// Its centre, metres.
    pub center: DVec3,
    /// Its axes, of length 1.
    pub axes: DMat3,
    /// The side on which the muscle passes, of length 1; `None` = the shorter way.
    pub side: Option<DVec3>,
}

impl WrapPlacement {
    /// Lines in the world that show the shape: three circles or ellipses; ends and sides of a cylinder; rings of a torus. Each is a row of points.
    #[must_use]
    pub fn outline(&self) -> Vec<Vec<DVec3>> {
        let Self { center, axes, .. } = *self;
        let ellipse = |middle: DVec3, u: DVec3, v: DVec3| -> Vec<DVec3> {
            let point = |step: usize| {
                let (sin, cos) = (step as f64 / PIECES as f64 * TAU).sin_cos();
                center + axes * (middle + u * cos + v * sin)
            };
            (0..=PIECES).map(point).collect()
        };
        let (x, y, z) = (DVec3::X, DVec3::Y, DVec3::Z);
        let three = |radii: DVec3| {
            [(x * radii.x, y * radii.y), (y * radii.y, z * radii.z), (z * radii.z, x * radii.x)]
                .map(|(u, v)| ellipse(DVec3::ZERO, u, v))
                .to_vec()
        };
        match self.shape {
            WrapShape::Sphere { radius } => three(DVec3::splat(radius)),
            WrapShape::Ellipsoid { radii } => three(radii),
            WrapShape::Cylinder { radius, length } => {
                let end = z * (0.5 * length);
                let side = |direction: DVec3| [-1.0, 1.0].map(|sign| center + axes * (direction * radius + end * sign)).to_vec();
                let rings = [-1.0, 0.0, 1.0].map(|sign| ellipse(end * sign, x * radius, y * radius));
                rings.into_iter().chain([x, y, -x, -y].map(side)).collect()
            }
            WrapShape::Torus { radius, tube } => {
                let round = |radius: f64, height: f64| ellipse(z * height, x * radius, y * radius);
                let across = |number: usize| {
                    let (sin, cos) = (number as f64 / TUBES as f64 * TAU).sin_cos();
                    let out = x * cos + y * sin;
                    ellipse(out * radius, out * tube, z * tube)
                };
                let along = [round(radius - tube, 0.0), round(radius + tube, 0.0), round(radius, tube), round(radius, -tube)];
                along.into_iter().chain((0..TUBES).map(across)).collect()
            }
        }
    }

    /// The point of the surface on the side on which the muscle passes; `None` where it passes on the shorter way.
    #[must_use]
    pub fn top(&self) -> Option<DVec3> {
        let side = self.side?;
        let local = self.axes.transpose() * side;
        let reach = match self.shape {
            WrapShape::Sphere { radius } => radius,
            WrapShape::Cylinder { radius, .. } => radius / local.truncate().length(),
            WrapShape::Ellipsoid { radii } => (local / radii).length().recip(),
            WrapShape::Torus { .. } => return None,
        };
        reach.is_finite().then(|| self.center + side * reach)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn outlines_lie_on_their_surfaces() {
        let axes = DMat3::from_rotation_x(0.4) * DMat3::from_rotation_y(1.1);
        let center = DVec3::new(1.0, 2.0, 3.0);
        for shape in [
            WrapShape::Sphere { radius: 2.0 },
            WrapShape::Cylinder { radius: 2.0, length: 5.0 },
            WrapShape::Ellipsoid { radii: DVec3::new(1.0, 2.0, 3.0) },
            WrapShape::Torus { radius: 3.0, tube: 1.0 },
        ] {
            let placed = WrapPlacement { shape, center, axes, side: Some(axes * DVec3::Y) };
            let off = |point: DVec3| {
                let p = axes.transpose() * (point - center);
                match shape {
                    WrapShape::Sphere { radius } => p.length() - radius,
                    WrapShape::Cylinder { radius, length } => (p.truncate().length() - radius).abs().max(p.z.abs() - 0.5 * length),
                    WrapShape::Ellipsoid { radii } => (p / radii).length() - 1.0,
                    WrapShape::Torus { radius, tube } => (p.truncate().length() - radius).hypot(p.z) - tube,
                }
            };
            let outline = placed.outline();
            assert!(outline.len() >= 3 && outline.iter().flatten().all(|point| off(*point) < 1e-12), "{shape:?}");
            if let Some(top) = placed.top() {
                assert!(off(top).abs() < 1e-12);
            }
        }
    }
}

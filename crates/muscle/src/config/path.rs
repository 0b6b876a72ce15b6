//! What a muscle passes and goes round, read from the richer form.

use glam::DVec3;

use super::decode::{At, nearest};
use super::error::{ConfigErrorKind, DecodeError};
use super::full_format::{Names, bone, direction, offset, range};
use super::spec::{ActiveRange, Anchor, PointMotion, ViaPoint, Wrap, WrapRange, WrapShape};
use crate::arm::ELBOW_JOINT;
use crate::edit::MOTION_POINTS;

/// Names of shapes.
const SHAPES: [&str; 4] = ["sphere", "cylinder", "ellipsoid", "torus"];
/// The value of `between` that means the stretch from one bone to another.
pub(super) const AT_JOINT: &str = "joint";
/// Farthest angle that a via point may depend on, degrees.
const AROUND: f64 = 360.0;

pub(super) fn via_point(at: &At<'_>, names: &Names<'_>) -> Result<ViaPoint, DecodeError> {
    let map = at.map(&["bone", "offset", "active", "moves"])?;
    let moves = map.get("moves").map(|at| motion(&at, names)).transpose()?;
    let active = map.get("active").map(|at| active_range(&at, names)).transpose()?;
    let place = match (&moves, map.get("offset")) {
        (Some(_), Some(at)) => return Err(at.error(ConfigErrorKind::OffsetAndMoves)),
        (Some(moves), None) => {
            let offset = moves.offsets.first().copied().unwrap_or(DVec3::ZERO);
            Anchor { bone: bone(&map.need("bone")?, names.on_arm)?, offset }
        }
        (None, offset_at) => Anchor { bone: bone(&map.need("bone")?, names.on_arm)?, offset: offset(offset_at)? },
    };
    Ok(ViaPoint { place, active, moves })
}

fn active_range(at: &At<'_>, names: &Names<'_>) -> Result<ActiveRange, DecodeError> {
    let map = at.map(&["joint", "range"])?;
    Ok(ActiveRange { joint: joint(&map.need("joint")?, names)?, range: range(&map.need("range")?, -AROUND, AROUND)? })
}

fn motion(at: &At<'_>, names: &Names<'_>) -> Result<PointMotion, DecodeError> {
    let map = at.map(&["joint", "angles", "offsets"])?;
    let angles_at = map.need("angles")?;
    let angles = angles_at.numbers()?;
    if !(2..=MOTION_POINTS).contains(&angles.len()) || !angles.is_sorted_by(|a, b| a < b) || angles.iter().any(|angle| angle.abs() > AROUND)
    {
        return Err(angles_at.error(ConfigErrorKind::MotionAngles));
    }
    let offsets_at = map.need("offsets")?;
    let offsets = offsets_at.items()?.iter().map(|item| item.some_numbers::<3>().map(DVec3::from_array)).collect::<Result<Vec<_>, _>>()?;
    if offsets.len() != angles.len() {
        return Err(offsets_at.error(ConfigErrorKind::WrongCount { name: offsets_at.name(), wanted: angles.len(), found: offsets.len() }));
    }
    Ok(PointMotion { joint: joint(&map.need("joint")?, names)?, angles, offsets })
}

/// The name of one of the file's joints.
fn joint(at: &At<'_>, names: &Names<'_>) -> Result<String, DecodeError> {
    let name = at.text()?;
    let known = |known: &str| known == name;
    if names.on_arm && known(ELBOW_JOINT) || names.joints.iter().any(|joint| known(joint.label())) {
        return Ok(name.to_owned());
    }
    let all: Vec<String> =
        if names.on_arm { vec![ELBOW_JOINT.to_owned()] } else { names.joints.iter().map(|joint| joint.label().to_owned()).collect() };
    Err(at.error(ConfigErrorKind::UnknownJoint { joint: name.to_owned(), known: all }))
}

/// The key `wrap`: a sphere where the muscle leads from one bone to another.
pub(super) fn sphere(at: &At<'_>, on_arm: bool) -> Result<Wrap, DecodeError> {
    let map = at.map(&["bone", "offset", "radius", "side"])?;
    let center = Anchor { bone: bone(&map.need("bone")?, on_arm)?, offset: offset(map.get("offset"))? };
    Ok(Wrap::sphere(center, map.need("radius")?.positive(false)?, direction(&map.need("side")?)?))
}

/// An item of `wraps`; `via` is the number of via points.
pub(super) fn wrap(at: &At<'_>, on_arm: bool, via: usize) -> Result<Wrap, DecodeError> {
    const COMMON: [&str; 6] = ["shape", "bone", "offset", "rotation", "side", "between"];
    let map = at.map(&["shape", "bone", "offset", "rotation", "side", "between", "radius", "length", "radii", "tube"])?;
    let shape_at = map.need("shape")?;
    let name = shape_at.text()?;
    let sizes: &[&str] = match name {
        "sphere" => &["radius"],
        "cylinder" => &["radius", "length"],
        "ellipsoid" => &["radii"],
        "torus" => &["radius", "tube"],
        _ => return Err(shape_at.error(ConfigErrorKind::UnknownShape { shape: name.to_owned(), near: nearest(name, &SHAPES) })),
    };
    for key in ["radius", "length", "radii", "tube"] {
        if let Some(at) = map.get(key).filter(|_| !sizes.contains(&key) && !COMMON.contains(&key)) {
            return Err(at.error(ConfigErrorKind::NotOfShape {
                key,
                shape: SHAPES.iter().find(|shape| **shape == name).copied().unwrap_or_default(),
            }));
        }
    }
    let size = |key| map.need(key)?.positive(false);
    let shape = match name {
        "sphere" => WrapShape::Sphere { radius: size("radius")? },
        "cylinder" => WrapShape::Cylinder { radius: size("radius")?, length: size("length")? },
        "ellipsoid" => {
            let radii_at = map.need("radii")?;
            radii_at.items()?.iter().try_for_each(|item| item.positive(false).map(|_| ()))?;
            WrapShape::Ellipsoid { radii: DVec3::from_array(radii_at.some_numbers::<3>()?) }
        }
        _ => {
            let (radius, tube_at) = (size("radius")?, map.need("tube")?);
            let tube = tube_at.positive(false)?;
            if tube >= radius {
                return Err(tube_at.error(ConfigErrorKind::TorusWithoutHole { radius, tube }));
            }
            WrapShape::Torus { radius, tube }
        }
    };
    let side = match map.get("side") {
        Some(at) if matches!(shape, WrapShape::Torus { .. }) => {
            return Err(at.error(ConfigErrorKind::NotOfShape { key: "side", shape: "torus" }));
        }
        Some(at) => Some(side(&at, &shape)?),
        None => None,
    };
    let range = match map.get("between") {
        Some(at) => between(&at, via)?,
        None => WrapRange::Whole,
    };
    let center = Anchor { bone: bone(&map.need("bone")?, on_arm)?, offset: offset(map.get("offset"))? };
    Ok(Wrap { shape, center, rotation: offset(map.get("rotation"))?, side, range })
}

/// A direction, or a half axis by name: `+x`, `-z`.
fn side(at: &At<'_>, shape: &WrapShape) -> Result<DVec3, DecodeError> {
    let side = match at.text() {
        Ok(text) => {
            let (sign, axis) = match text.strip_prefix('-') {
                Some(axis) => (-1.0, axis),
                None => (1.0, text.strip_prefix('+').unwrap_or(text)),
            };
            let axis = match axis {
                "x" => DVec3::X,
                "y" => DVec3::Y,
                "z" => DVec3::Z,
                _ => return Err(at.error(ConfigErrorKind::UnknownSide(text.to_owned()))),
            };
            axis * sign
        }
        Err(_) => direction(at)?,
    };
    if matches!(shape, WrapShape::Cylinder { .. }) && side.with_z(0.0).try_normalize().is_none() {
        return Err(at.error(ConfigErrorKind::SideAlongCylinder));
    }
    Ok(side)
}

fn between(at: &At<'_>, via: usize) -> Result<WrapRange, DecodeError> {
    if let Ok(text) = at.text() {
        return if text == AT_JOINT { Ok(WrapRange::AtJoint) } else { Err(at.error(ConfigErrorKind::BadBetween { last: via + 1 })) };
    }
    let [from, to] = at.some_numbers::<2>()?;
    let whole = |number: f64| (number.fract() == 0.0 && (0.0..=(via + 1) as f64).contains(&number)).then_some(number as usize);
    match (whole(from), whole(to)) {
        (Some(from), Some(to)) if from < to => Ok(WrapRange::Between([from, to])),
        _ => Err(at.error(ConfigErrorKind::BadBetween { last: via + 1 })),
    }
}

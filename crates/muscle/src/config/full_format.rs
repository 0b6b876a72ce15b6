//! The richer form: any number of muscles, on the arm or on the bones of a clip.

use glam::DVec3;

use super::decode::{At, nearest};
use super::error::{ConfigErrorKind, DecodeError};
use super::path;
use super::spec::{Anchor, Form, JointSpec, MuscleFile, MuscleSpec, PoseAt, PoseSpec, SkinSpec, Tendon};
use crate::arm::{Arm, FOREARM, UPPER_ARM};
use crate::edit::{VIA, WRAPS};
use crate::pennation::is_pennation;
use crate::profile::{Profile, ProfileError};
use sinew_scene::limits;

/// Keys at the top of the richer form; one of them makes a file a richer one.
pub(super) const KEYS: &[&str] = &["unit", "clip", "arm", "joint", "joints", "scale", "skin", "muscles"];
/// The value of `scale` that lets muscles scale with the bones.
pub(super) const WITH_BONES: &str = "with bones";
/// Ids of the bones of the arm.
pub(super) const ARM_BONES: &[&str] = &[UPPER_ARM, FOREARM];
/// Units by name, in metres.
pub(super) const UNITS: [(&str, f64); 4] = [("mm", 0.001), ("cm", 0.01), ("m", 1.0), ("in", 0.0254)];

pub(super) fn decode(root: &At<'_>) -> Result<MuscleFile, DecodeError> {
    let map = root.map(KEYS)?;
    let mut file = MuscleFile { form: Form::Rich, ..MuscleFile::default() };
    if let Some(at) = map.get("unit") {
        file.unit_metres = unit(&at)?;
    }
    if let Some(at) = map.get("clip") {
        file.clip = Some(at.text()?.to_owned());
    }
    if let Some(at) = map.get("arm") {
        if file.clip.is_some() {
            return Err(at.error(ConfigErrorKind::ArmAndClip));
        }
        file.arm = Some(arm(&at)?);
    }
    if let Some(at) = map.get("joint") {
        if file.arm.is_some() {
            return Err(at.error(ConfigErrorKind::ArmAndJoint));
        }
        file.joints = vec![joint(&at)?];
    }
    if let Some(at) = map.get("joints") {
        if file.arm.is_some() {
            return Err(at.error(ConfigErrorKind::ArmAndJoint));
        }
        if !file.joints.is_empty() {
            return Err(at.error(ConfigErrorKind::JointAndJoints));
        }
        file.joints = joints(&at)?;
    }
    if let Some(at) = map.get("scale") {
        if file.arm.is_some() {
            return Err(at.error(ConfigErrorKind::ArmAndScale));
        }
        file.scale = Some(scale(&at)?);
    }
    if let Some(at) = map.get("skin") {
        file.skin = Some(skin(&at, file.unit_metres)?);
    }
    let list = map.need("muscles")?;
    let items = list.items()?;
    if items.is_empty() {
        return Err(list.error(ConfigErrorKind::NoMuscles));
    }
    if items.len() > limits::MUSCLES {
        return Err(list.error(ConfigErrorKind::TooManyMuscles(items.len())));
    }
    let mut vertices = 0_usize;
    for at in &items {
        let muscle = muscle(at, &Names { on_arm: file.arm.is_some(), joints: &file.joints })?;
        vertices = vertices.saturating_add(muscle.vertices());
        if vertices > limits::MUSCLE_VERTICES {
            return Err(at.error(ConfigErrorKind::TooMuchSurface));
        }
        file.muscles.push(muscle);
    }
    Ok(file)
}

fn unit(at: &At<'_>) -> Result<f64, DecodeError> {
    match at.text() {
        Ok(text) => {
            let found = UNITS.iter().find(|(name, _)| *name == text);
            found.map(|(_, metres)| *metres).ok_or_else(|| at.error(ConfigErrorKind::UnknownUnit(text.to_owned())))
        }
        Err(_) => at.positive(false),
    }
}

fn scale(at: &At<'_>) -> Result<f64, DecodeError> {
    match at.text() {
        Ok(WITH_BONES) => Ok(1.0),
        Ok(_) => Err(at.error(ConfigErrorKind::BadScale)),
        Err(_) => at.positive(false),
    }
}

fn skin(at: &At<'_>, unit_metres: f64) -> Result<SkinSpec, DecodeError> {
    let map = at.map(&["fat", "reach", "elasticity"])?;
    let mut skin = SkinSpec::in_unit(unit_metres);
    let most = SkinSpec::MOST / unit_metres;
    for (key, value, most) in [("fat", &mut skin.fat, most), ("reach", &mut skin.reach, most), ("elasticity", &mut skin.elasticity, 1.0)] {
        let Some(at) = map.get(key) else { continue };
        *value = at.positive(true)?;
        if *value > most {
            return Err(at.error(ConfigErrorKind::TooLarge { name: at.name(), most }));
        }
    }
    Ok(skin)
}

fn arm(at: &At<'_>) -> Result<Arm, DecodeError> {
    let map = at.map(&["upper", "forearm", "thickness", "flexion"])?;
    let flexion = match map.get("flexion") {
        Some(at) => Some(range(&at, 0.0, 180.0)?),
        None => None,
    };
    Ok(Arm {
        upper: map.need("upper")?.positive(false)?,
        lower: map.need("forearm")?.positive(false)?,
        thickness: map.need("thickness")?.positive(false)?,
        flexion,
    })
}

fn joint(at: &At<'_>) -> Result<JointSpec, DecodeError> {
    let map = at.map(&["name", "bone", "axis", "range"])?;
    let name = map.get("name").map_or(Ok(""), |at| at.text())?.to_owned();
    let range = match map.get("range") {
        Some(at) => range(&at, -360.0, 360.0)?,
        None => [0.0, 150.0],
    };
    Ok(JointSpec { name, bone: map.need("bone")?.text()?.to_owned(), axis: direction(&map.need("axis")?)?, range })
}

fn joints(at: &At<'_>) -> Result<Vec<JointSpec>, DecodeError> {
    let items = at.items()?;
    if items.is_empty() || items.len() > limits::JOINTS {
        return Err(at.error(ConfigErrorKind::JointCount(items.len())));
    }
    let mut joints: Vec<JointSpec> = Vec::new();
    for at in &items {
        let joint = joint(at)?;
        if joints.iter().any(|other| other.label() == joint.label()) {
            return Err(at.error(ConfigErrorKind::RepeatedJoint(joint.label().to_owned())));
        }
        joints.push(joint);
    }
    Ok(joints)
}

pub(super) fn range(at: &At<'_>, least: f64, most: f64) -> Result<[f64; 2], DecodeError> {
    let [low, high] = at.some_numbers::<2>()?;
    if least <= low && low < high && high <= most {
        return Ok([low, high]);
    }
    Err(at.error(ConfigErrorKind::BadRange { name: at.name(), least, most }))
}

pub(super) fn direction(at: &At<'_>) -> Result<DVec3, DecodeError> {
    let direction = DVec3::from_array(at.some_numbers::<3>()?);
    if direction.try_normalize().is_none() {
        return Err(at.error(ConfigErrorKind::NoDirection(at.name())));
    }
    Ok(direction)
}

/// What a muscle may name.
pub(super) struct Names<'a> {
    /// Whether the bones are those of the arm.
    pub on_arm: bool,
    /// The joints of the file.
    pub joints: &'a [JointSpec],
}

fn muscle(at: &At<'_>, names: &Names<'_>) -> Result<MuscleSpec, DecodeError> {
    let on_arm = names.on_arm;
    let map = at.map(&[
        "name",
        "color",
        "source",
        "length",
        "radii",
        "growth",
        "poses",
        "origin",
        "via",
        "wrap",
        "wraps",
        "insertion",
        "tendons",
        "pennation",
    ])?;
    let length = map.need("length")?;
    let mut spec = match map.get("poses") {
        Some(poses) => {
            if let Some(at) = map.get("radii").or_else(|| map.get("growth")) {
                return Err(at.error(ConfigErrorKind::PosesAndRadii));
            }
            posed(&poses, &length)?
        }
        None => MuscleSpec::new(grown(&map.need("radii")?, &map.need("growth")?, &length)?),
    };
    if let Some(at) = map.get("name") {
        spec.name = at.text()?.to_owned();
    }
    if let Some(at) = map.get("color") {
        spec.color = Some(color(&at)?);
    }
    if let Some(at) = map.get("pennation") {
        spec.pennation = at.number()?;
        if !is_pennation(spec.pennation) {
            return Err(at.error(ConfigErrorKind::BadPennation(spec.pennation)));
        }
    }
    if let Some(at) = map.get("source") {
        spec.source = at.text()?.to_owned();
    }
    for (end, key) in ["origin", "insertion"].into_iter().enumerate() {
        let Some(at) = map.get(key) else { continue };
        let anchor = Some(anchor(&at, on_arm)?);
        if end == 0 { spec.origin = anchor } else { spec.insertion = anchor }
    }
    if spec.origin.is_some() != spec.insertion.is_some() {
        return Err(at.error(ConfigErrorKind::OneEnd(at.name())));
    }
    for key in ["via", "wrap", "wraps"] {
        if let (Some(at), None) = (map.get(key), &spec.origin) {
            return Err(at.error(ConfigErrorKind::WithoutEnds(key)));
        }
    }
    if let Some(at) = map.get("via") {
        let points = at.items()?;
        if points.len() > VIA {
            return Err(at.error(ConfigErrorKind::TooManyViaPoints(points.len())));
        }
        spec.via = points.iter().map(|point| path::via_point(point, names)).collect::<Result<_, _>>()?;
    }
    if let Some(at) = map.get("wrap") {
        spec.wraps = vec![path::sphere(&at, on_arm)?];
    }
    if let Some(at) = map.get("wraps") {
        if !spec.wraps.is_empty() {
            return Err(at.error(ConfigErrorKind::WrapAndWraps));
        }
        let items = at.items()?;
        if items.len() > WRAPS {
            return Err(at.error(ConfigErrorKind::TooManyWraps(items.len())));
        }
        spec.wraps = items.iter().map(|item| path::wrap(item, on_arm, spec.via.len())).collect::<Result<_, _>>()?;
    }
    if let Some(at) = map.get("tendons") {
        let tendons = at.map(&["origin", "insertion"])?;
        for (tendon, key) in spec.tendons.iter_mut().zip(["origin", "insertion"]) {
            if let Some(at) = tendons.get(key) {
                let map = at.map(&["length", "radius"])?;
                *tendon = Tendon { length: map.need("length")?.positive(true)?, radius: map.need("radius")?.positive(false)? };
            }
        }
    }
    Ok(spec)
}

fn radii(at: &At<'_>) -> Result<Vec<f64>, DecodeError> {
    at.items()?.iter().map(|item| item.positive(true)).collect()
}

fn grown(radii_at: &At<'_>, growth: &At<'_>, length: &At<'_>) -> Result<Profile, DecodeError> {
    Profile::new(radii(radii_at)?, growth.numbers()?, length.positive(false)?).map_err(|error| {
        let at = match error {
            ProfileError::LengthsDiffer { .. } | ProfileError::NoGrowth | ProfileError::BadGrowth(_) => growth,
            ProfileError::BadLength => length,
            _ => radii_at,
        };
        at.error(ConfigErrorKind::Profile(error))
    })
}

fn posed(at: &At<'_>, length: &At<'_>) -> Result<MuscleSpec, DecodeError> {
    let items = at.items()?;
    if items.is_empty() {
        return Err(at.error(ConfigErrorKind::NoPoses));
    }
    let pose = |at: &At<'_>| {
        let map = at.map(&["angle", "length", "radii"])?;
        let place = match (map.get("angle"), map.get("length")) {
            (Some(angle), None) => PoseAt::Angle(angle.number()?),
            (None, Some(length)) => PoseAt::Length(length.positive(false)?),
            _ => return Err(at.error(ConfigErrorKind::PosePlace)),
        };
        Ok(PoseSpec { at: place, radii: radii(&map.need("radii")?)? })
    };
    let poses = items.iter().map(pose).collect::<Result<Vec<_>, _>>()?;
    let profile = MuscleSpec::posed(&poses, length.positive(false)?, |_| None).map_err(|error| {
        let at = match error {
            ProfileError::BadLength => length,
            ProfileError::PoseNodes { pose, .. } | ProfileError::PoseLength(pose) => items.get(pose).unwrap_or(at),
            _ => at,
        };
        at.error(ConfigErrorKind::Profile(error))
    })?;
    Ok(MuscleSpec { poses, ..MuscleSpec::new(profile) })
}

fn anchor(at: &At<'_>, on_arm: bool) -> Result<Anchor, DecodeError> {
    let map = at.map(&["bone", "offset"])?;
    Ok(Anchor { bone: bone(&map.need("bone")?, on_arm)?, offset: offset(map.get("offset"))? })
}

pub(super) fn offset(at: Option<At<'_>>) -> Result<DVec3, DecodeError> {
    at.map_or(Ok(DVec3::ZERO), |at| at.some_numbers::<3>().map(DVec3::from_array))
}

pub(super) fn bone(at: &At<'_>, on_arm: bool) -> Result<String, DecodeError> {
    let name = at.text()?;
    if on_arm && !ARM_BONES.contains(&name) {
        let near = nearest(name, ARM_BONES).unwrap_or(UPPER_ARM);
        return Err(at.error(ConfigErrorKind::UnknownArmBone { bone: name.to_owned(), near }));
    }
    Ok(name.to_owned())
}

fn color(at: &At<'_>) -> Result<[u8; 3], DecodeError> {
    let text = at.text()?;
    let parsed = text.strip_prefix('#').filter(|digits| digits.len() == 6 && digits.bytes().all(|byte| byte.is_ascii_hexdigit()));
    match parsed.and_then(|digits| u32::from_str_radix(digits, 16).ok()) {
        Some(number) => Ok([(number >> 16) as u8, (number >> 8) as u8, number as u8]),
        None => Err(at.error(ConfigErrorKind::BadColor(text.to_owned()))),
    }
}

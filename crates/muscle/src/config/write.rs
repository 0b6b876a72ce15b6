//! Muscle files as YAML: the same values, read back bit for bit. [`super::lossless_save`] keeps the comments of a text that is there already.

use std::fmt::Write;

use glam::DVec3;

use super::full_format::{UNITS, WITH_BONES};
use super::path::AT_JOINT;
use super::spec::{Anchor, Form, JointSpec, MuscleFile, MuscleSpec, PoseAt, SkinSpec, ViaPoint, Wrap, WrapRange, WrapShape};
use super::yaml::Yaml;
use crate::arm::{Arm, FOREARM, UPPER_ARM};
use sinew_yaml::quoted;

impl MuscleFile {
    /// The file as YAML, in the report's form where it was written in that and can be still, else in the richer one. Reading it again gives an
    /// equal file.
    pub fn to_yaml(&self) -> String {
        let report = if self.form == Form::Report { report(self) } else { None };
        report.unwrap_or_else(|| rich(self))
    }
}

/// `None` where the report's form cannot say everything.
fn report(file: &MuscleFile) -> Option<String> {
    let [muscle] = file.muscles.as_slice() else { return None };
    let plain =
        MuscleSpec { origin: muscle.origin.clone(), insertion: muscle.insertion.clone(), ..MuscleSpec::new(muscle.profile.clone()) };
    if *muscle != plain
        || file.unit_metres != 0.001
        || file.clip.is_some()
        || !file.joints.is_empty()
        || file.scale.is_some()
        || file.skin.is_some()
    {
        return None;
    }
    let mut text = String::from("muscle_config:\n");
    line(&mut text, 2, "radiuses", &numbers(muscle.profile.radii()));
    line(&mut text, 2, "grow_mults", &numbers(muscle.profile.growth()));
    line(&mut text, 2, "len", &number(muscle.profile.rest_length()));
    let Some(arm) = &file.arm else {
        return (muscle.origin.is_none() && muscle.insertion.is_none()).then_some(text);
    };
    let (upper, lower) = (depth(muscle.origin.as_ref()?, UPPER_ARM)?, depth(muscle.insertion.as_ref()?, FOREARM)?);
    let (above, rest) = (rest_of(arm.upper, upper, |above| above > 0.0)?, rest_of(arm.lower, lower, |rest| rest >= 0.0)?);
    if arm.flexion.is_some() || lower <= 0.0 {
        return None;
    }
    text.push_str("\ncarcass_config:\n");
    line(&mut text, 2, "data", &format!("[{}, {}]", numbers(&[upper, above]), numbers(&[lower, rest])));
    line(&mut text, 2, "thickness", &number(arm.thickness));
    Some(text)
}

/// How far down the axis of `bone` an attachment lies; `None` where it lies elsewhere.
fn depth(anchor: &Anchor, bone: &str) -> Option<f64> {
    let DVec3 { x, y, z } = anchor.offset;
    (anchor.bone == bone && x == 0.0 && z == 0.0 && y <= 0.0).then_some(-y + 0.0)
}

/// The number that is `allowed` and, added to `part`, gives exactly `whole`: of those the roundest, else one that vanishes beside `part`.
fn rest_of(whole: f64, part: f64, allowed: impl Fn(f64) -> bool) -> Option<f64> {
    let plain = whole - part;
    let rounded = (0..=12).filter_map(|digits| format!("{plain:.digits$}").parse::<f64>().ok());
    let exact = [plain, plain.next_up(), plain.next_down(), part * f64::EPSILON / 4.0];
    rounded.chain(exact).find(|rest| allowed(*rest) && part + rest == whole)
}

fn rich(file: &MuscleFile) -> String {
    let mut text = String::new();
    let unit = UNITS.iter().find(|(_, metres)| *metres == file.unit_metres);
    line(&mut text, 0, "unit", &unit.map_or_else(|| number(file.unit_metres), |(name, _)| (*name).to_owned()));
    if let Some(clip) = &file.clip {
        line(&mut text, 0, "clip", &quoted(clip));
    }
    if let Some(Arm { upper, lower, thickness, flexion }) = file.arm {
        text.push_str("arm:\n");
        for (key, value) in [("upper", upper), ("forearm", lower), ("thickness", thickness)] {
            line(&mut text, 2, key, &number(value));
        }
        if let Some(range) = flexion {
            line(&mut text, 2, "flexion", &numbers(&range));
        }
    }
    match file.joints.as_slice() {
        [] => {}
        [joint] if joint.name.is_empty() => {
            text.push_str("joint:\n");
            text.push_str(&joint_lines(joint, 2));
        }
        joints => {
            text.push_str("joints:\n");
            for joint in joints {
                text.push_str("  - ");
                text.push_str(joint_lines(joint, 4).trim_start());
            }
        }
    }
    if let Some(scale) = file.scale {
        line(&mut text, 0, "scale", &if scale == 1.0 { WITH_BONES.to_owned() } else { number(scale) });
    }
    if let Some(SkinSpec { fat, reach, elasticity }) = file.skin {
        let value = format!("{{fat: {}, reach: {}, elasticity: {}}}", number(fat), number(reach), number(elasticity));
        line(&mut text, 0, "skin", &value);
    }
    text.push_str("muscles:\n");
    for muscle in &file.muscles {
        let lines = muscle_lines(muscle, 4);
        text.push_str("  - ");
        text.push_str(lines.trim_start());
    }
    text
}

fn joint_lines(joint: &JointSpec, indent: usize) -> String {
    let mut text = String::new();
    if !joint.name.is_empty() {
        line(&mut text, indent, "name", &quoted(&joint.name));
    }
    line(&mut text, indent, "bone", &quoted(&joint.bone));
    line(&mut text, indent, "axis", &numbers(&joint.axis.to_array()));
    line(&mut text, indent, "range", &numbers(&joint.range));
    text
}

/// The keys of one muscle, a line each, all with this indent.
pub(super) fn muscle_lines(muscle: &MuscleSpec, indent: usize) -> String {
    let mut text = String::new();
    write_muscle(&mut text, muscle, indent);
    text
}

/// A list of whole numbers on one line; any other value as it is.
fn counts(value: &Yaml) -> String {
    let Yaml::List(items) = value else { return flow(value) };
    let count = |item: &Yaml| match item {
        Yaml::Number(number) => number.to_string(),
        other => flow(other),
    };
    format!("[{}]", items.iter().map(count).collect::<Vec<_>>().join(", "))
}

/// A value on one line.
pub(super) fn flow(value: &Yaml) -> String {
    match value {
        Yaml::Number(value) => number(*value),
        Yaml::Text(text) => quoted(text),
        Yaml::List(items) => format!("[{}]", items.iter().map(flow).collect::<Vec<_>>().join(", ")),
        Yaml::Map(entries) => {
            let entry = |(key, value): &(Option<String>, Yaml)| {
                let key = key.as_deref().unwrap_or_default();
                // Points of the path have numbers, not measures.
                let value = if key == "between" { counts(value) } else { flow(value) };
                format!("{key}: {value}")
            };
            format!("{{{}}}", entries.iter().map(entry).collect::<Vec<_>>().join(", "))
        }
        // The canonical form has none of these.
        Yaml::Null | Yaml::Bool | Yaml::Tagged => "null".to_owned(),
    }
}

fn write_muscle(text: &mut String, muscle: &MuscleSpec, indent: usize) {
    let inner = indent + 2;
    if !muscle.name.is_empty() {
        line(text, indent, "name", &quoted(&muscle.name));
    }
    if let Some([red, green, blue]) = muscle.color {
        line(text, indent, "color", &format!("\"#{red:02X}{green:02X}{blue:02X}\""));
    }
    if !muscle.source.is_empty() {
        line(text, indent, "source", &quoted(&muscle.source));
    }
    line(text, indent, "length", &number(muscle.profile.rest_length()));
    if muscle.poses.is_empty() {
        line(text, indent, "radii", &numbers(muscle.profile.radii()));
        line(text, indent, "growth", &numbers(muscle.profile.growth()));
    } else {
        let _ = writeln!(text, "{:indent$}poses:", "");
    }
    for pose in &muscle.poses {
        let (key, value) = match pose.at {
            PoseAt::Angle(angle) => ("angle", angle),
            PoseAt::Length(length) => ("length", length),
        };
        let _ = writeln!(text, "{:inner$}- {{{key}: {}, radii: {}}}", "", number(value), numbers(&pose.radii));
    }
    if let Some(origin) = &muscle.origin {
        line(text, indent, "origin", &anchor(origin));
    }
    if !muscle.via.is_empty() {
        let _ = writeln!(text, "{:indent$}via:", "");
        for point in &muscle.via {
            let _ = writeln!(text, "{:inner$}- {}", "", via_point(point));
        }
    }
    match muscle.wraps.as_slice() {
        [] => {}
        // The key `wrap`, which older versions read too.
        [Wrap { shape: WrapShape::Sphere { radius }, center, rotation: DVec3::ZERO, side: Some(side), range: WrapRange::AtJoint }] => {
            let _ = writeln!(text, "{:indent$}wrap:", "");
            line(text, inner, "bone", &quoted(&center.bone));
            line(text, inner, "offset", &numbers(&center.offset.to_array()));
            line(text, inner, "radius", &number(*radius));
            line(text, inner, "side", &numbers(&side.to_array()));
        }
        wraps => {
            let _ = writeln!(text, "{:indent$}wraps:", "");
            for surface in wraps {
                let _ = writeln!(text, "{:inner$}- {}", "", wrap(surface));
            }
        }
    }
    if let Some(insertion) = &muscle.insertion {
        line(text, indent, "insertion", &anchor(insertion));
    }
    if muscle.pennation != 0.0 {
        line(text, indent, "pennation", &number(muscle.pennation));
    }
    if muscle.tendons.iter().any(|tendon| tendon.length != 0.0 || tendon.radius != 0.0) {
        let _ = writeln!(text, "{:indent$}tendons:", "");
        for (tendon, key) in muscle.tendons.iter().zip(["origin", "insertion"]) {
            if tendon.length != 0.0 || tendon.radius != 0.0 {
                line(text, inner, key, &format!("{{length: {}, radius: {}}}", number(tendon.length), number(tendon.radius)));
            }
        }
    }
}

fn via_point(point: &ViaPoint) -> String {
    let mut text = format!("{{bone: {}", quoted(&point.place.bone));
    match &point.moves {
        None => {
            let _ = write!(text, ", offset: {}", numbers(&point.place.offset.to_array()));
        }
        Some(moves) => {
            let offsets: Vec<String> = moves.offsets.iter().map(|offset| numbers(&offset.to_array())).collect();
            let (joint, angles) = (quoted(&moves.joint), numbers(&moves.angles));
            let _ = write!(text, ", moves: {{joint: {joint}, angles: {angles}, offsets: [{}]}}", offsets.join(", "));
        }
    }
    if let Some(active) = &point.active {
        let _ = write!(text, ", active: {{joint: {}, range: {}}}", quoted(&active.joint), numbers(&active.range));
    }
    text.push('}');
    text
}

fn wrap(wrap: &Wrap) -> String {
    let mut text = format!("{{shape: {}", wrap.shape.id());
    let _ = match wrap.shape {
        WrapShape::Sphere { radius } => write!(text, ", radius: {}", number(radius)),
        WrapShape::Cylinder { radius, length } => write!(text, ", radius: {}, length: {}", number(radius), number(length)),
        WrapShape::Ellipsoid { radii } => write!(text, ", radii: {}", numbers(&radii.to_array())),
        WrapShape::Torus { radius, tube } => write!(text, ", radius: {}, tube: {}", number(radius), number(tube)),
    };
    let _ = write!(text, ", bone: {}, offset: {}", quoted(&wrap.center.bone), numbers(&wrap.center.offset.to_array()));
    if wrap.rotation != DVec3::ZERO {
        let _ = write!(text, ", rotation: {}", numbers(&wrap.rotation.to_array()));
    }
    if let Some(side) = wrap.side {
        let _ = write!(text, ", side: {}", numbers(&side.to_array()));
    }
    let _ = match wrap.range {
        WrapRange::Whole => Ok(()),
        WrapRange::AtJoint => write!(text, ", between: {AT_JOINT}"),
        WrapRange::Between([from, to]) => write!(text, ", between: [{from}, {to}]"),
    };
    text.push('}');
    text
}

fn anchor(anchor: &Anchor) -> String {
    format!("{{bone: {}, offset: {}}}", quoted(&anchor.bone), numbers(&anchor.offset.to_array()))
}

fn line(text: &mut String, indent: usize, key: &str, value: &str) {
    // Writing to a string cannot fail.
    let _ = writeln!(text, "{:indent$}{key}: {value}", "");
}

fn numbers(values: &[f64]) -> String {
    let list: Vec<String> = values.iter().map(|value| number(*value)).collect();
    format!("[{}]", list.join(", "))
}

/// The shortest digits that read back as the same number.
fn number(value: f64) -> String {
    format!("{value:?}")
}

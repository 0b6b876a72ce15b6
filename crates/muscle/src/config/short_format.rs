//! The report's own form: `muscle_config` and, where there is an arm, `carcass_config`.

use glam::DVec3;

use super::decode::At;
use super::error::{ConfigErrorKind, DecodeError};
use super::spec::{Anchor, Form, MuscleFile, MuscleSpec};
use crate::arm::{Arm, FOREARM, UPPER_ARM};
use crate::profile::{Profile, ProfileError};

/// Keys at the top of the report's form.
pub(super) const KEYS: &[&str] = &["muscle_config", "carcass_config"];

pub(super) fn decode(root: &At<'_>) -> Result<MuscleFile, DecodeError> {
    let map = root.map(KEYS)?;
    let mut muscle = muscle(&map.need("muscle_config")?)?;
    let arm = match map.get("carcass_config") {
        Some(carcass) => Some(arm(&carcass, &mut muscle)?),
        None => None,
    };
    Ok(MuscleFile { form: Form::Report, arm, muscles: vec![muscle], ..MuscleFile::default() })
}

fn muscle(at: &At<'_>) -> Result<MuscleSpec, DecodeError> {
    let map = at.map(&["radiuses", "grow_mults", "len"])?;
    let radii_at = map.need("radiuses")?;
    let radii = radii_at.items()?.iter().map(|item| item.positive(true)).collect::<Result<Vec<f64>, _>>()?;
    let growth_at = map.need("grow_mults")?;
    let growth = growth_at.numbers()?;
    let length = map.need("len")?;
    let profile = Profile::new(radii, growth, length.positive(false)?).map_err(|error| {
        let at = match error {
            ProfileError::LengthsDiffer { .. } | ProfileError::NoGrowth | ProfileError::BadGrowth(_) => &growth_at,
            ProfileError::BadLength => &length,
            _ => &radii_at,
        };
        at.error(ConfigErrorKind::Profile(error))
    })?;
    Ok(MuscleSpec::new(profile))
}

fn arm(at: &At<'_>, muscle: &mut MuscleSpec) -> Result<Arm, DecodeError> {
    let map = at.map(&["data", "thickness"])?;
    let data = map.need("data")?;
    let rods = data.items()?;
    let [first, second] = rods.as_slice() else { return Err(data.error(ConfigErrorKind::NotTwoRods(rods.len()))) };
    let rod = |at: &At<'_>| -> Result<[f64; 2], DecodeError> {
        let [a, b] = at.some_numbers::<2>()?;
        let items = at.items()?;
        for (item, or_zero) in items.iter().zip([true, true]) {
            item.positive(or_zero)?;
        }
        if a + b > 0.0 { Ok([a, b]) } else { Err(at.error(ConfigErrorKind::RodWithoutLength(at.name()))) }
    };
    let ([free, above], [below, rest]) = (rod(first)?, rod(second)?);
    for (length, at) in [(above, first), (below, second)] {
        if length == 0.0 {
            return Err(at.error(ConfigErrorKind::AttachedAtElbow(at.name())));
        }
    }
    let thickness = map.need("thickness")?.positive(false)?;
    muscle.origin = Some(Anchor { bone: UPPER_ARM.to_owned(), offset: DVec3::new(0.0, -free, 0.0) });
    muscle.insertion = Some(Anchor { bone: FOREARM.to_owned(), offset: DVec3::new(0.0, -below, 0.0) });
    Ok(Arm { upper: free + above, lower: below + rest, thickness, flexion: None })
}

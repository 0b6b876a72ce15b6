//! Cross-sections with the direction in which skin clears them, and the volume of muscle along each bone.

use glam::{DVec3, Vec3};

use crate::section::{CrossSection, MuscleTissue, Segment};
use crate::soft::{held_within_unit, smooth_step};
use crate::splines::{SPLINES, splines_at};

/// Distance below which bones are no more told apart by distance, metres.
const NEAR: f64 = 0.005;
/// Over this share of a bone's length its ends are rounded: the foot of a perpendicular stops there without a jump in the slope.
const ROUNDED: f64 = 0.15;
/// Where the mean of the directions away from the bones is shorter than this, they do not agree: a tendon lies between two bones, or along one.
const AGREED: f64 = 0.5;
/// By how much less skin has to clear a cross-section where they do not agree at all, metres.
const DOUBT: f64 = 0.06;
/// Outward directions are averaged over so many neighbours to either side.
const NEIGHBOURS: usize = 2;

/// A cross-section as skin meets it, single precision, in the world.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Station {
    pub(crate) center: Vec3,
    /// Direction of the muscle's line.
    pub(crate) along: Vec3,
    /// The direction in which skin moves to clear it: square to the line, away from the bones.
    pub(crate) outward: Vec3,
    /// Half axes along `outward` and square to it, metres.
    pub(crate) height: f32,
    pub(crate) across: f32,
    /// Half of the length that it stands for, metres.
    pub(crate) half: f32,
    /// How far the bones' axes are, metres.
    pub(crate) depth: f32,
    pub(crate) belly: bool,
    /// By how much less skin has to clear it because the bones beside it do not agree on what is outward, metres.
    pub(crate) doubt: f32,
}

/// All stations of a moment, and the volume of muscle along the bones.
#[derive(Debug, Clone, Default)]
pub struct Stations {
    pub(crate) list: Vec<Station>,
    /// Volume of muscle by bone and spline, m³.
    pub(crate) volumes: Vec<[f64; SPLINES]>,
    /// Lengths of the pose for one at rest.
    pub(crate) scale: f64,
    outward: Vec<DVec3>,
    bones: Vec<Segment>,
}

/// How near bones are to a point: the mean direction from them, the mean distance, and the share of each bone in it.
struct Nearness {
    outward: DVec3,
    depth: f64,
}

/// `1 / (distance² + NEAR²)²`, the weight of a bone, with the offset from the bone to the point.
fn weight(bone: &Segment, point: DVec3, near: f64) -> (f64, DVec3) {
    let foot = bone.start + (bone.end - bone.start) * held_within_unit(bone.share(point), ROUNDED);
    let offset = point - foot;
    (1.0 / (offset.length_squared() + near * near).powi(2), offset)
}

/// What shares several bones have in a point: 1 together. `bones` are numbers among `segments`; what is not there has none.
pub(crate) fn bone_shares<'a>(
    bones: &'a [usize],
    segments: &'a [Segment],
    point: DVec3,
    scale: f64,
) -> impl Iterator<Item = (usize, f64)> + 'a {
    let known = move || bones.iter().filter_map(move |bone| Some((*bone, segments.get(*bone)?)));
    let sum: f64 = known().map(|(_, segment)| weight(segment, point, NEAR * scale).0).sum();
    known().map(move |(bone, segment)| (bone, weight(segment, point, NEAR * scale).0 / sum))
}

impl Stations {
    /// Computes the stations of a moment.
    ///
    /// `bones` are the posed bones that [`MuscleTissue::bones`] number, `scale` is how many times as large as at rest the whole model is.
    pub fn place(&mut self, muscles: &[MuscleTissue], sections: &[CrossSection], bones: &[Segment], scale: f64) {
        self.list.clear();
        self.bones.clear();
        self.bones.extend_from_slice(bones);
        self.volumes.clear();
        self.volumes.resize(bones.len(), [0.0; SPLINES]);
        self.scale = scale;
        for muscle in muscles {
            let Some(own) = sections.get(muscle.sections.clone()) else { continue };
            self.place_muscle(muscle, own, bones);
        }
    }

    /// Bones as they were given.
    pub(crate) fn bones(&self) -> &[Segment] {
        &self.bones
    }

    /// Whether every number is finite.
    pub(crate) fn is_finite(&self) -> bool {
        let sound = |s: &Station| {
            s.center.is_finite() && s.along.is_finite() && s.outward.is_finite() && (s.height + s.across + s.half + s.depth).is_finite()
        };
        self.list.iter().all(sound) && self.volumes.iter().flatten().all(|volume| volume.is_finite())
    }

    fn place_muscle(&mut self, muscle: &MuscleTissue, sections: &[CrossSection], bones: &[Segment]) {
        let first = self.list.len();
        self.outward.clear();
        for section in sections {
            let near = self.nearness(muscle, section.center, bones);
            self.outward.push(near.outward.reject_from_normalized(section.tangent));
            for (bone, share) in bone_shares(&muscle.bones, bones, section.center, self.scale) {
                let (Some(segment), Some(volumes)) = (bones.get(bone), self.volumes.get_mut(bone)) else { continue };
                for (volume, spline) in volumes.iter_mut().zip(splines_at(segment.share(section.center))) {
                    *volume += section.volume * share * spline;
                }
            }
            self.list.push(Station {
                center: section.center.as_vec3(),
                along: section.tangent.as_vec3(),
                half: section.half_length as f32,
                depth: near.depth as f32,
                belly: section.belly,
                ..Station::default()
            });
        }
        for (index, section) in sections.iter().enumerate() {
            let (outward, agreed) = self.mean_outward(index, section.tangent);
            let doubt = DOUBT * self.scale * (1.0 - f64::from(smooth_step((agreed / AGREED) as f32)));
            let Some(station) = self.list.get_mut(first + index) else { break };
            (station.outward, station.doubt) = (outward.as_vec3(), doubt as f32);
            let [height, across] = half_axes(section, outward);
            (station.height, station.across) = (height as f32, across as f32);
        }
    }

    fn nearness(&self, muscle: &MuscleTissue, point: DVec3, bones: &[Segment]) -> Nearness {
        let near = NEAR * self.scale;
        let (mut sum, mut outward, mut depth) = (0.0, DVec3::ZERO, 0.0);
        for bone in muscle.bones.iter().filter_map(|bone| bones.get(*bone)) {
            let (weight, offset) = weight(bone, point, near);
            sum += weight;
            outward += offset * (weight / (offset.length_squared() + near * near).sqrt());
            depth += offset.length() * weight;
        }
        if sum > 0.0 { Nearness { outward: outward / sum, depth: depth / sum } } else { Nearness { outward: DVec3::ZERO, depth: 0.0 } }
    }

    /// The mean direction of a station and its neighbours, square to its line, and how far they agree, 0 to 1.
    fn mean_outward(&self, index: usize, tangent: DVec3) -> (DVec3, f64) {
        let (mut sum, mut weights) = (DVec3::ZERO, 0.0);
        for (other, outward) in self.outward.iter().enumerate().skip(index.saturating_sub(NEIGHBOURS)).take(2 * NEIGHBOURS + 1) {
            let away = other.abs_diff(index);
            if away <= NEIGHBOURS {
                let weight = (NEIGHBOURS + 1 - away) as f64;
                sum += *outward * weight;
                weights += weight;
            }
        }
        let outward = sum.reject_from_normalized(tangent);
        let agreed = outward.length() / weights.max(f64::MIN_POSITIVE);
        (outward.try_normalize().unwrap_or_else(|| tangent.any_orthonormal_vector()), agreed)
    }
}

/// Half axes of the rectangle along `outward` and square to it that just holds the cross-section.
fn half_axes(section: &CrossSection, outward: DVec3) -> [f64; 2] {
    let flatness = if section.flatness > 1.0 { section.flatness } else { 1.0 };
    let (short, long) = (section.radius / flatness.sqrt(), section.radius * flatness.sqrt());
    let cos = if flatness > 1.0 { outward.dot(section.flattened_along).clamp(-1.0, 1.0) } else { 1.0 };
    let (cos, sin) = (cos * cos, 1.0 - cos * cos);
    [(short * short * cos + long * long * sin).sqrt(), (short * short * sin + long * long * cos).sqrt()]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::section::SkinLayer;

    fn section(center: DVec3) -> CrossSection {
        CrossSection {
            center,
            tangent: DVec3::Y,
            radius: 0.01,
            flatness: 1.0,
            flattened_along: DVec3::X,
            half_length: 0.005,
            volume: 3e-6,
            belly: true,
        }
    }

    fn placed(sections: &[CrossSection], bones: &[Segment]) -> Stations {
        let muscle = MuscleTissue { sections: 0..sections.len(), bones: (0..bones.len()).collect(), layer: SkinLayer::default() };
        let mut stations = Stations::default();
        stations.place(&[muscle], sections, bones, 1.0);
        stations
    }

    #[test]
    fn outward_is_away_from_the_bone_and_square_to_the_line() {
        let bone = Segment { start: DVec3::ZERO, end: DVec3::Y * 0.3 };
        let stations = placed(&[section(DVec3::new(0.0, 0.15, 0.02))], &[bone]);
        let station = stations.list[0];
        assert!(station.outward.distance(Vec3::Z) < 1e-6 && (station.depth - 0.02).abs() < 1e-6);
        assert_eq!((station.height, station.across), (0.01, 0.01));
    }

    #[test]
    fn in_the_crook_outward_lies_between_both_bones() {
        // A right angle: one bone up from the elbow, the other forward; the muscle inside of the bend.
        let bones = [Segment { start: DVec3::Y * 0.3, end: DVec3::ZERO }, Segment { start: DVec3::ZERO, end: DVec3::X * 0.25 }];
        let mut inside = section(DVec3::new(0.03, 0.03, 0.0));
        inside.tangent = DVec3::new(-1.0, 1.0, 0.0).normalize();
        let outward = placed(&[inside], &bones).list[0].outward;
        assert!(outward.distance(Vec3::new(1.0, 1.0, 0.0).normalize()) < 1e-3, "{outward}");
    }

    #[test]
    fn volume_is_counted_where_the_muscle_lies() {
        let bone = Segment { start: DVec3::ZERO, end: DVec3::Y * 0.3 };
        let stations = placed(&[section(DVec3::new(0.0, 0.15, 0.02))], &[bone]);
        let volumes = stations.volumes[0];
        assert!((volumes.iter().sum::<f64>() - 3e-6).abs() < 1e-15);
        assert!(volumes[0] == 0.0 && volumes[7] == 0.0 && volumes[3] > 1e-6);
    }

    #[test]
    fn a_flattened_section_is_low_and_wide() {
        let flat = CrossSection { flatness: 1.44, flattened_along: DVec3::NEG_Z, ..section(DVec3::new(0.0, 0.15, 0.02)) };
        let [height, across] = half_axes(&flat, DVec3::Z);
        assert!((height - 0.01 / 1.2).abs() < 1e-12 && (across - 0.012).abs() < 1e-12);
    }
}

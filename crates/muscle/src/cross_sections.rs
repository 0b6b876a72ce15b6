//! A muscle in a pose as a row of cross-sections, for whoever has to keep clear of it.

use std::f64::consts::PI;

use glam::{DMat4, DVec3};

use super::bone_clearance::radius_at;
use super::muscle_rig::MuscleRig;
use super::solved_muscle::SolvedMuscle;
use super::tessellation::Laid;

/// Cross-sections of a belly.
const BELLY: usize = 20;
/// Cross-sections of a tendon.
const TENDON: usize = 6;

/// A cross-section of a muscle or tendon in the world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CrossSection {
    /// Its centre, metres.
    pub center: DVec3,
    /// Direction of the line through the centres, of length 1.
    pub tangent: DVec3,
    /// Radius of the circle of the same area, metres.
    pub radius: f64,
    /// The square of how many times the half axis square to [`CrossSection::toward`] is as long as the radius; 1 = a circle.
    pub flatness: f64,
    /// Towards the bone that it is flattened against, of length 1; of no meaning where it is a circle.
    pub toward: DVec3,
    /// Half of the length that it stands for, metres.
    pub half_length: f64,
    /// Volume of that length, m³.
    pub volume: f64,
    /// Whether it belongs to the belly; else to a tendon.
    pub belly: bool,
}

impl MuscleRig {
    /// Number of cross-sections that [`MuscleRig::cross_sections`] gives for muscle `index`: the same in all poses.
    pub fn cross_section_count(&self, index: usize) -> usize {
        let tendons = |muscle: &super::muscle_rig::Muscle| muscle.tendons.iter().filter(|tendon| tendon.length > 0.0).count();
        self.muscles.get(index).map_or(0, |muscle| BELLY + TENDON * tendons(muscle))
    }

    /// Adds the cross-sections of muscle `index` in a pose, from origin to insertion: those of the first tendon, of the belly, of the second tendon, each
    /// evenly spaced. The volumes of the belly's add up to the muscle's.
    pub fn cross_sections(&self, index: usize, solved: &SolvedMuscle, world: &[DMat4], into: &mut Vec<CrossSection>) {
        let Some(muscle) = self.muscles.get(index) else { return };
        let laid = Laid::of(solved, &muscle.tendons);
        let extent = laid.extent();
        let matrix = self.root_matrix(world);
        let scale = matrix.determinant().abs().cbrt();
        let mut add = |from: f64, length: f64, count: usize, belly: bool, radius: &dyn Fn(f64) -> f64| {
            let mut cursor = extent.path.cursor();
            let step = length / count as f64;
            for number in 0..count {
                let share = (number as f64 + 0.5) / count as f64;
                let at = from + share * length;
                let (frame, radius) = (cursor.frame_at(at), radius(share));
                let flat = laid.flesh.section(at / extent.path.length());
                into.push(CrossSection {
                    center: matrix.transform_point3(frame.position),
                    tangent: matrix.transform_vector3(frame.tangent).normalize_or(DVec3::Y),
                    radius: radius * scale,
                    flatness: flat.map_or(1.0, |flat| flat.flatness),
                    toward: matrix.transform_vector3(flat.map_or(frame.u, |flat| flat.toward)).normalize_or(DVec3::X),
                    half_length: 0.5 * step * scale,
                    volume: PI * radius * radius * step * scale.powi(3),
                    belly,
                });
            }
        };
        let [first, last] = extent.tendons;
        let (start, end) = (extent.start, extent.start + solved.shape.length);
        let radii = &solved.shape.radii;
        let ends = [radii.first(), radii.last()].map(|radius| radius.copied().unwrap_or(0.0));
        let tapered = |from: f64, to: f64| move |share: f64| from + (to - from) * share;
        if muscle.tendons[0].length > 0.0 {
            let length = first.length + 0.5 * extent.detour;
            add(start - length, length, TENDON, false, &tapered(first.radius, first.radius.min(ends[0])));
        }
        add(start, solved.shape.length, BELLY, true, &|share| radius_at(radii, share));
        if muscle.tendons[1].length > 0.0 {
            add(end, last.length + 0.5 * extent.detour, TENDON, false, &tapered(last.radius.min(ends[1]), last.radius));
        }
        let added = into.len().saturating_sub(self.cross_section_count(index));
        let belly = || into.iter().skip(added).filter(|section| section.belly);
        let whole: f64 = belly().map(|section| section.volume).sum();
        let share = if whole > 0.0 { solved.shape.volume * scale.powi(3) / whole } else { 1.0 };
        for section in into.iter_mut().skip(added).filter(|section| section.belly) {
            section.volume *= share;
        }
    }
}

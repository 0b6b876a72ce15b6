//! Another shape for a muscle that is in a scene already: its radii, its growth and the sizes of its tendons change while everything round it stays.

use glam::DMat4;
use sinew_scene::Graph;

use super::build::rounding;
use super::config::{MuscleFile, MuscleSpec};
use super::muscle_rig::{Muscle, MuscleRig};
use super::tessellation::MuscleTopology;

impl MuscleRig {
    /// Whether `new` differs from `old`, the file that the rig was built of, in shapes alone, so that [`MuscleRig::reshape`] does what building would.
    pub fn can_reshape(&self, old: &MuscleFile, new: &MuscleFile) -> bool {
        let MuscleFile { unit_metres, form, clip, arm, joints, scale, skin, muscles } = old;
        let rest_is_same = *unit_metres == new.unit_metres
            && *form == new.form
            && *clip == new.clip
            && *arm == new.arm
            && *joints == new.joints
            && *scale == new.scale
            && *skin == new.skin
            && muscles.len() == new.muscles.len();
        // On an arm of its own the shape decides where the muscle is drawn and how far the elbow goes; one that nothing holds makes room for the next.
        rest_is_same
            && self.arm.is_none()
            && muscles.len() == self.muscles.len()
            && self
                .muscles
                .iter()
                .zip(muscles.iter().zip(&new.muscles))
                .all(|(muscle, (old, new))| old == new || self.fits(muscle, old, new))
    }

    /// Takes over the shapes of `new`, where [`MuscleRig::can_reshape`] says yes: scene, line of action and joint stay as they are, and only the muscles that
    /// changed are looked at again, over their joint and at the `moments` of a clip (seconds, one matrix a node).
    pub fn reshape(&mut self, old: &MuscleFile, new: &MuscleFile, graph: &Graph, moments: &[(f64, Vec<DMat4>)]) {
        let mut changed = Vec::new();
        for (index, (muscle, (old, new))) in self.muscles.iter_mut().zip(old.muscles.iter().zip(&new.muscles)).enumerate() {
            if old != new {
                muscle.take_shape(new);
                changed.push(index);
            }
        }
        self.check_again(&changed, graph, moments);
    }

    /// Whether a muscle stays where it is with the same surface when its shape becomes that of `new`.
    fn fits(&self, muscle: &Muscle, old: &MuscleSpec, new: &MuscleSpec) -> bool {
        let shaped = MuscleSpec { profile: old.profile.clone(), tendons: old.tendons, ..new.clone() };
        // Findings are told apart by the muscle's name.
        let is_alone = || self.muscles.iter().filter(|other| other.label() == muscle.label()).count() == 1;
        shaped == *old
            && old.poses.is_empty()
            && muscle.line.is_some()
            && MuscleTopology::new(new.profile.radii().len(), &new.tendons) == muscle.layout
            && is_alone()
    }
}

impl Muscle {
    fn take_shape(&mut self, new: &MuscleSpec) {
        (self.spec.profile, self.spec.tendons) = (new.profile.clone(), new.tendons);
        self.rescale(self.scale);
        if let Some(line) = &mut self.line {
            line.rounding = rounding(&self.spec.profile) * self.scale;
        }
    }
}

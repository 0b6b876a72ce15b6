//! Another shape for a muscle that is in a scene already: its radii, its growth and the sizes of its tendons change while everything round it stays.

use glam::DMat4;
use sinew_scene::Graph;

use super::build::rounding;
use super::config::{MuscleFile, MuscleSpec};
use super::muscle_rig::MuscleRig;
use super::tessellation::MuscleTopology;

impl MuscleRig {
    /// Takes over the shapes of `new`, where it differs from `old`, the file that the rig was built of, in shapes alone: then scene, line of action and joint
    /// stay as they are, and only the muscles that changed are looked at again, over their joint and at the `moments` of a clip (seconds, one matrix a node).
    /// Says no, and changes nothing, where the rig has to be built anew.
    pub fn reshape(&mut self, old: &MuscleFile, new: &MuscleFile, graph: &Graph, moments: &[(f64, Vec<DMat4>)]) -> bool {
        let rest = |file: &MuscleFile| MuscleFile { muscles: Vec::new(), ..file.clone() };
        // On an arm of its own the shape decides where the muscle is drawn and how far the elbow goes; one that nothing holds makes room for the next.
        if self.arm.is_some() || old.muscles.len() != new.muscles.len() || old.muscles.len() != self.muscles.len() || rest(old) != rest(new)
        {
            return false;
        }
        let changed: Vec<usize> = (0..old.muscles.len()).filter(|index| old.muscles[*index] != new.muscles[*index]).collect();
        if !changed.iter().all(|index| self.can_reshape(*index, &old.muscles[*index], &new.muscles[*index])) {
            return false;
        }
        for index in &changed {
            self.take_shape(*index, &new.muscles[*index]);
        }
        self.check_again(&changed, graph, moments);
        true
    }

    fn can_reshape(&self, index: usize, old: &MuscleSpec, new: &MuscleSpec) -> bool {
        let muscle = &self.muscles[index];
        let shaped = MuscleSpec { profile: old.profile.clone(), tendons: old.tendons, ..new.clone() };
        let alone = || self.muscles.iter().filter(|other| other.label() == muscle.label()).count() == 1;
        shaped == *old
            && old.poses.is_empty()
            && muscle.line.is_some()
            && MuscleTopology::new(new.profile.radii().len(), &new.tendons) == muscle.layout
            && alone()
    }

    fn take_shape(&mut self, index: usize, new: &MuscleSpec) {
        let muscle = &mut self.muscles[index];
        (muscle.spec.profile, muscle.spec.tendons) = (new.profile.clone(), new.tendons);
        muscle.rescale(muscle.scale);
        if let Some(line) = &mut muscle.line {
            line.rounding = rounding(&muscle.spec.profile) * muscle.scale;
        }
    }
}

//! A joint of a clip's skeleton that changes a muscle's length: its angle and the muscle's contraction are one state, as on the two-rod arm.

use glam::DMat4;

use super::MuscleState;
use super::joint_dof::JointDof;
use super::line_of_action::Line;
use super::muscle_rig::MuscleRig;
use super::muscle_state::LengthRange;
use super::revolute_joint::RevoluteJoint;
use sinew_scene::Scene;

/// A change of length below this share of the rest length is none.
const NONE: f64 = 1e-6;

/// How a joint drives one muscle while all other bones stay as a pose has them.
#[derive(Debug, Clone)]
pub struct Driving<'a> {
    revolute: RevoluteJoint,
    line: &'a Line,
    span: LengthRange,
}

impl MuscleRig {
    /// How `joint` drives muscle `index` in a pose of `scene` (`world`: one matrix a node); `None` where nothing holds the muscle, or the joint does not
    /// change its length.
    pub fn driven_by(&self, index: usize, joint: &JointDof, scene: &Scene, world: &[DMat4]) -> Option<Driving<'_>> {
        let muscle = self.muscles.get(index)?;
        let line = muscle.line.as_ref()?;
        // The bones stand turned as the pose has them: that is where the joint's angle counts from.
        let revolute = RevoluteJoint { at_rest: joint.angle(scene, world)?, ..self.revolute_of(joint, scene, world) };
        let lengths =
            (0..=8).map(|step| line.length(&revolute.at(joint.range[0] + (joint.range[1] - joint.range[0]) * f64::from(step) / 8.0)));
        let (least, most) = lengths.fold((f64::INFINITY, 0.0), |(least, most): (f64, f64), length| (least.min(length), most.max(length)));
        if most - least <= NONE * muscle.shape.rest_length() {
            return None;
        }
        let span = LengthRange::new(joint.range, |angle| line.length(&revolute.at(angle)));
        Some(Driving { revolute, line, span })
    }
}

impl Driving<'_> {
    /// The state with the joint at this angle, degrees, held within its range.
    pub fn at_angle(&self, degrees: f64) -> MuscleState {
        self.span.at_flexion(degrees, |angle| self.line.length(&self.revolute.at(angle)))
    }

    /// The state with this contraction, 0 to 100 per cent of the way from the greatest length in the joint's range to the least.
    pub fn at_contraction(&self, per_cent: f64) -> MuscleState {
        self.span.at_contraction(per_cent, |angle| self.line.length(&self.revolute.at(angle)))
    }
}

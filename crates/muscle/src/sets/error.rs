//! Why a set of muscles cannot be attached to a scene.

use super::super::humanoid::BodySide;
use crate::profile::ProfileError;
use sinew_scene::OwnedLabel;
use sinew_scene::message;
use sinew_scene::message::{Message, ToMessage};

/// A joint of a body, as people call it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BodyJoint {
    /// What arms hang on: a clavicle or the chest.
    Chest,
    /// Shoulder.
    Shoulder,
    /// Elbow.
    Elbow,
    /// Wrist.
    Wrist,
    /// What legs hang on.
    Pelvis,
    /// Hip.
    Hip,
    /// Knee.
    Knee,
    /// Ankle.
    Ankle,
}

/// A joint of one side of a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SidedJoint {
    /// The joint.
    pub joint: BodyJoint,
    /// Its side; `None` of the pelvis, of which a body has one.
    pub side: Option<BodySide>,
}

/// Why a set of muscles cannot be attached.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{}", self.message())]
pub enum SetError {
    /// No figure of human build is in the scene.
    NoFigure,
    /// The figure lacks these joints.
    MissingJoints(Vec<SidedJoint>),
    /// A bone that no name tells from the others.
    NamelessBone(OwnedLabel),
    /// A bone that has none to match it on the other side of the figure.
    NoCounterpart(OwnedLabel),
    /// The sizes of this muscle make none on this figure.
    NoMuscle {
        /// The muscle.
        muscle: String,
        /// Why.
        error: ProfileError,
    },
}

impl ToMessage for SidedJoint {
    fn message(&self) -> Message {
        let joint = match self.joint {
            BodyJoint::Chest => message!("muscle-joint-chest"),
            BodyJoint::Shoulder => message!("muscle-joint-shoulder"),
            BodyJoint::Elbow => message!("muscle-joint-elbow"),
            BodyJoint::Wrist => message!("muscle-joint-wrist"),
            BodyJoint::Pelvis => message!("muscle-joint-pelvis"),
            BodyJoint::Hip => message!("muscle-joint-hip"),
            BodyJoint::Knee => message!("muscle-joint-knee"),
            BodyJoint::Ankle => message!("muscle-joint-ankle"),
        };
        match self.side {
            None => joint,
            Some(BodySide::Left) => message!("muscle-joint-left", joint = joint),
            Some(BodySide::Right) => message!("muscle-joint-right", joint = joint),
        }
    }
}

impl ToMessage for SetError {
    fn message(&self) -> Message {
        match self {
            Self::NoFigure => message!("muscle-set-no-figure"),
            Self::MissingJoints(joints) => {
                let list =
                    joints.iter().map(SidedJoint::message).reduce(|list, joint| message!("muscle-set-list", list = list, last = joint));
                message!("muscle-set-missing-joints", joints = list.unwrap_or_else(|| message!("muscle-joint-pelvis")))
            }
            Self::NamelessBone(bone) => message!("muscle-set-nameless-bone", bone = bone.as_label()),
            Self::NoCounterpart(bone) => message!("muscle-set-no-counterpart", bone = bone.as_label()),
            Self::NoMuscle { muscle, error } => message!("muscle-set-no-muscle", muscle = muscle, error = error.message()),
        }
    }
}

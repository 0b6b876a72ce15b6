//! What is found about a muscle, and how it is said.

use super::profile::{ProfileError, SHORTEST};
use sinew_scene::OwnedLabel;
use sinew_scene::diagnostics::{DiagnosticKind, Severity};
use sinew_scene::message;
use sinew_scene::message::{Message, ToMessage, decimal};

/// What was found about a muscle. Angles are degrees of the joint, lengths millimetres.
#[derive(Debug, Clone, PartialEq)]
pub enum Finding {
    /// Origin and insertion come to lie on one point.
    EndsCoincide,
    /// The tendons are longer than the line from origin to insertion.
    ShorterThanTendons,
    /// The ends come so near to each other that the belly is shorter than it can be.
    TooShort {
        /// What is left of the belly's rest length, as a share of it.
        share: f64,
        /// Where.
        at: FoundAt,
    },
    /// The surface folds into itself, since the belly is bent tighter than it is thick.
    BentTooTight,
    /// A point of the line of action lies inside a wrap surface.
    InsideWrap {
        /// The surface, counted from 0.
        wrap: usize,
        /// The point.
        point: LinePoint,
        /// How far inside.
        depth: f64,
        /// The angle at which it lies deepest.
        angle: f64,
    },
    /// The line of action touches a wrap surface at no angle of this range.
    WrapNotTouched {
        /// The surface, counted from 0.
        wrap: usize,
        /// The least and the greatest angle.
        range: [f64; 2],
    },
    /// The moment arm has one sign at one angle and the other at another.
    MomentArmChangesSign {
        /// The smaller of the two angles at which it is largest to either side, and the moment arm there.
        first: MomentArmAt,
        /// The larger of the two angles, and the moment arm there.
        second: MomentArmAt,
    },
    /// The length of the line of action jumps.
    PathJumps {
        /// By how much.
        jump: f64,
        /// Where.
        angle: f64,
    },
    /// No shortest path was found: what is drawn goes round each wrap surface, but may be longer.
    PathNotFound {
        /// Where.
        angle: f64,
    },
    /// The line of action lies on a cylinder beyond its end.
    BeyondCylinder {
        /// The surface, counted from 0.
        wrap: usize,
        /// Where.
        angle: f64,
    },
    /// The middle of the belly comes further away from the bone than it is at rest, like the string of a bow.
    BowStrings {
        /// How far it is from the bone's axis at rest.
        rest: f64,
        /// How far it comes at most.
        most: f64,
        /// The angle at which it does.
        angle: f64,
    },
    /// The muscle goes through a bone.
    ThroughBone {
        /// What the bone is called.
        bone: OwnedLabel,
        /// The share of the bone's length that lies inside the belly.
        share: f64,
        /// The angle at which that is the most.
        angle: f64,
    },
    /// The belly is so thick that a bone lies inside it.
    TooThick {
        /// What the bone is called.
        bone: OwnedLabel,
        /// The share of the bone's length that lies inside the belly.
        share: f64,
        /// The angle at which that is the most.
        angle: f64,
        /// Radius of the belly where the bone lies deepest.
        radius: f64,
    },
    /// There is no bone of this name.
    BoneNotFound {
        /// The name.
        bone: String,
    },
    /// There is no joint of this name.
    JointNotFound {
        /// The name.
        bone: String,
    },
    /// Measured poses are at angles, but no joint turns the muscle.
    PosesWithoutJoint,
    /// The lengths that the muscle has at the angles of its measured poses make no muscle.
    PosesDoNotFit(ProfileError),
}

/// Where something was found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FoundAt {
    /// At this angle of the joint, degrees.
    Angle(f64),
    /// At this time of the clip, seconds.
    Time(f64),
}

/// A point of a line of action.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LinePoint {
    /// The origin.
    Origin,
    /// A via point, counted from 0.
    Via(usize),
    /// The insertion.
    Insertion,
}

/// The moment arm at an angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MomentArmAt {
    /// Degrees.
    pub angle: f64,
    /// Millimetres.
    pub moment_arm: f64,
}

impl ToMessage for FoundAt {
    fn message(&self) -> Message {
        match *self {
            Self::Angle(angle) => message!("muscle-at-angle", angle = decimal(angle, 1)),
            Self::Time(time) => message!("muscle-at-time", time = decimal(time, 2)),
        }
    }
}

impl ToMessage for Finding {
    fn message(&self) -> Message {
        let per_cent = |share: f64| decimal(100.0 * share, 0);
        let millimetres = |length: f64| decimal(length, 1);
        let degrees = |angle: f64| decimal(angle, 1);
        let at = |angle: f64| FoundAt::Angle(angle).message();
        match self {
            Self::EndsCoincide => message!("muscle-ends-coincide"),
            Self::ShorterThanTendons => message!("muscle-shorter-than-tendons"),
            Self::TooShort { share, at } => {
                message!("muscle-too-short", share = per_cent(*share), place = at.message(), least = per_cent(SHORTEST))
            }
            Self::BentTooTight => message!("muscle-bent-too-tight"),
            Self::InsideWrap { wrap, point, depth, angle } => {
                let (wrap, depth, place) = (wrap + 1, millimetres(*depth), at(*angle));
                match point {
                    LinePoint::Origin => message!("muscle-wrap-inside-origin", wrap = wrap, depth = depth, place = place),
                    LinePoint::Insertion => message!("muscle-wrap-inside-insertion", wrap = wrap, depth = depth, place = place),
                    LinePoint::Via(number) => {
                        message!("muscle-wrap-inside-via", wrap = wrap, number = number + 1, depth = depth, place = place)
                    }
                }
            }
            Self::WrapNotTouched { wrap, range: [low, high] } => {
                message!("muscle-wrap-never", wrap = wrap + 1, low = degrees(*low), high = degrees(*high))
            }
            Self::PathNotFound { angle } => message!("muscle-path-not-found", place = at(*angle)),
            Self::BeyondCylinder { wrap, angle } => message!("muscle-wrap-beyond-end", wrap = wrap + 1, place = at(*angle)),
            Self::MomentArmChangesSign { first, second } => message!(
                "muscle-arm-changes-sign",
                first = millimetres(first.moment_arm),
                from = degrees(first.angle),
                second = millimetres(second.moment_arm),
                to = degrees(second.angle)
            ),
            Self::PathJumps { jump, angle } => message!("muscle-path-jumps", jump = millimetres(*jump), place = at(*angle)),
            Self::BowStrings { rest, most, angle } => {
                message!("muscle-bow-strings", rest = millimetres(*rest), most = millimetres(*most), place = at(*angle))
            }
            Self::ThroughBone { bone, share, angle } => {
                message!("muscle-through-bone", bone = bone.as_label(), share = per_cent(*share), place = at(*angle))
            }
            Self::TooThick { bone, share, angle, radius } => {
                message!(
                    "muscle-too-thick",
                    bone = bone.as_label(),
                    share = per_cent(*share),
                    place = at(*angle),
                    radius = millimetres(*radius)
                )
            }
            Self::BoneNotFound { bone } => message!("muscle-bone-not-found", bone = bone),
            Self::JointNotFound { bone } => message!("muscle-joint-not-found", bone = bone),
            Self::PosesWithoutJoint => message!("muscle-poses-no-joint"),
            Self::PosesDoNotFit(error) => message!("muscle-poses-do-not-fit", error = error.message()),
        }
    }
}

impl DiagnosticKind for Finding {
    fn code(&self) -> &'static str {
        match self {
            Self::EndsCoincide => "muscle-ends-coincide",
            Self::ShorterThanTendons => "muscle-shorter-than-tendons",
            Self::TooShort { .. } => "muscle-too-short",
            Self::BentTooTight => "muscle-bent-too-tight",
            Self::InsideWrap { .. } | Self::WrapNotTouched { .. } => "muscle-wrap-inert",
            Self::PathNotFound { .. } => "muscle-path-not-found",
            Self::BeyondCylinder { .. } => "muscle-wrap-beyond-end",
            Self::MomentArmChangesSign { .. } => "moment-arm-changes-sign",
            Self::PathJumps { .. } => "muscle-path-jumps",
            Self::BowStrings { .. } => "muscle-bow-strings",
            Self::ThroughBone { .. } => "muscle-through-bone",
            Self::TooThick { .. } => "muscle-too-thick",
            Self::BoneNotFound { .. } => "muscle-bone-not-found",
            Self::JointNotFound { .. } => "muscle-joint-not-found",
            Self::PosesWithoutJoint | Self::PosesDoNotFit(_) => "muscle-poses-not-placed",
        }
    }

    fn severity(&self) -> Severity {
        Severity::Warning
    }
}

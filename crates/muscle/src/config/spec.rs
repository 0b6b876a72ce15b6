//! What a muscle file says, as values.

use glam::DVec3;

use crate::arm::Arm;
use crate::measured_shapes::Pose;
use crate::profile::{Profile, ProfileError};
use crate::tessellation::MuscleTopology;
use sinew_scene::limits;

/// Which of the two forms a file is written in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Form {
    /// `muscle_config` and `carcass_config`: one muscle, millimetres.
    #[default]
    Report,
    /// The richer form.
    Rich,
}

/// What a YAML file describes: muscles, and the arm they are on if there is one.
#[derive(Debug, Clone, PartialEq)]
pub struct MuscleFile {
    /// Metres a unit of the file.
    pub unit_metres: f64,
    /// The form it was written in, which it is saved in again where that form can say everything.
    pub form: Form,
    /// A clip to attach to: a path relative to the YAML file.
    pub clip: Option<String>,
    /// The two-rod arm.
    pub arm: Option<Arm>,
    /// The joint that measurements turn; on the two-rod arm it is the elbow and this is `None`.
    pub joint: Option<JointSpec>,
    /// Where muscles scale with the bones that they are on: the bones' scale at which the lengths of this file hold, 1 unless it names another. `None` =
    /// lengths are in the unit whatever the bones' scale.
    pub scale: Option<f64>,
    /// The muscles.
    pub muscles: Vec<MuscleSpec>,
}

impl MuscleFile {
    /// Number of vertices that the surfaces of its muscles have together; known before any is made.
    pub fn vertices(&self) -> usize {
        self.muscles.iter().map(MuscleSpec::vertices).fold(0, usize::saturating_add)
    }

    /// Whether the surfaces of all muscles of these files together stay below [`limits::MUSCLE_VERTICES`].
    pub fn can_be_drawn<'a>(files: impl IntoIterator<Item = &'a Self>) -> bool {
        files.into_iter().map(Self::vertices).fold(0, usize::saturating_add) <= limits::MUSCLE_VERTICES
    }
}

impl Default for MuscleFile {
    fn default() -> Self {
        Self { unit_metres: 0.001, form: Form::Report, clip: None, arm: None, joint: None, scale: None, muscles: Vec::new() }
    }
}

/// A joint with one axis.
#[derive(Debug, Clone, PartialEq)]
pub struct JointSpec {
    /// Id or name of the bone that turns, with everything below it.
    pub bone: String,
    /// Axis through the bone's node, along the bone's own axes.
    pub axis: DVec3,
    /// Least and greatest angle from the rest pose, degrees.
    pub range: [f64; 2],
}

/// A muscle as its file describes it.
#[derive(Debug, Clone, PartialEq)]
pub struct MuscleSpec {
    /// What a person calls it; empty where the file gives no name.
    pub name: String,
    /// Colour, sRGB; `None` = the palette's.
    pub color: Option<[u8; 3]>,
    /// Where the numbers come from, for a person to read.
    pub source: String,
    /// Shape at rest. Of poses at angles it is only complete once the muscle is on its joint, which says how long it is there.
    pub profile: Profile,
    /// Measured radii that the profile is made of, instead of growth multipliers; empty for most muscles.
    pub poses: Vec<PoseSpec>,
    /// Where it begins.
    pub origin: Option<Anchor>,
    /// Points that it passes, in order.
    pub via: Vec<Anchor>,
    /// What it goes round.
    pub wrap: Option<Wrap>,
    /// Where it ends.
    pub insertion: Option<Anchor>,
    /// Tendons at the origin and at the insertion.
    pub tendons: [Tendon; 2],
}

impl MuscleSpec {
    /// Number of vertices of its surface.
    pub fn vertices(&self) -> usize {
        MuscleTopology::new(self.profile.radii().len(), &self.tendons).vertices()
    }

    /// A muscle of this shape, attached to nothing.
    pub fn new(profile: Profile) -> Self {
        Self {
            name: String::new(),
            color: None,
            source: String::new(),
            profile,
            poses: Vec::new(),
            origin: None,
            via: Vec::new(),
            wrap: None,
            insertion: None,
            tendons: [Tendon::default(); 2],
        }
    }
}

/// Where a measured pose was taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PoseAt {
    /// At an angle of the joint, degrees.
    Angle(f64),
    /// At a length of the belly.
    Length(f64),
}

/// Measured radii of all nodes.
#[derive(Debug, Clone, PartialEq)]
pub struct PoseSpec {
    /// Where they were measured.
    pub at: PoseAt,
    /// One a node.
    pub radii: Vec<f64>,
}

impl MuscleSpec {
    /// The profile that poses make at this rest length: whole where all are at lengths or `length_at` knows that of an angle, else the first pose's
    /// shape, which swells evenly.
    ///
    /// # Errors
    /// [`ProfileError`] where they make no muscle.
    pub fn posed(poses: &[PoseSpec], length: f64, length_at: impl Fn(f64) -> Option<f64>) -> Result<Profile, ProfileError> {
        let place = |pose: &PoseSpec| {
            let length = match pose.at {
                PoseAt::Length(length) => Some(length),
                PoseAt::Angle(angle) => length_at(angle),
            };
            length.map(|length| Pose { length, radii: pose.radii.clone() })
        };
        match poses.iter().map(place).collect::<Option<Vec<_>>>() {
            Some(poses) => Profile::of_poses(poses, length),
            None => {
                // Checks all, at lengths that are as good as any.
                let stand_in = poses.iter().enumerate().map(|(index, pose)| Pose { length: 1.0 + index as f64, radii: pose.radii.clone() });
                Profile::of_poses(stand_in.collect(), length)?;
                let first: Vec<f64> = poses.first().map(|pose| pose.radii.clone()).unwrap_or_default();
                Profile::new(first.clone(), first, length)
            }
        }
    }
}

/// A point on a bone.
#[derive(Debug, Clone, PartialEq)]
pub struct Anchor {
    /// Id or name of the bone's node.
    pub bone: String,
    /// From the bone's node, along the bone's own axes, in the file's unit: whatever the bone's scale, or scaled with it where the file says so.
    pub offset: DVec3,
}

/// A ball, fixed to a bone, that a muscle goes round like a rope round a pulley.
#[derive(Debug, Clone, PartialEq)]
pub struct Wrap {
    /// Its centre.
    pub center: Anchor,
    /// Its radius.
    pub radius: f64,
    /// The side on which the muscle passes: a direction along the bone's own axes.
    pub side: DVec3,
}

/// A tendon: it goes on from the muscle's end and does not change its length.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Tendon {
    /// Length; 0 = no tendon.
    pub length: f64,
    /// Radius.
    pub radius: f64,
}

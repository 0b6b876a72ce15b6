//! What a muscle file says, as values.

use glam::DVec3;

use crate::arm::Arm;
use crate::measured_shapes::Pose;
use crate::profile::{Profile, ProfileError};
use crate::retarget::neat;
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
    /// The joints that measurements turn and that via points depend on, the first one above all; on the two-rod arm it is the elbow alone and this is empty.
    pub joints: Vec<JointSpec>,
    /// Where muscles scale with the bones that they are on: the bones' scale at which the lengths of this file hold, 1 unless it names another. `None` =
    /// lengths are in the unit whatever the bones' scale.
    pub scale: Option<f64>,
    /// How skin lies over the muscles; `None` = as [`SkinSpec::in_unit`] has it.
    pub skin: Option<SkinSpec>,
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
        Self {
            unit_metres: 0.001,
            form: Form::Report,
            clip: None,
            arm: None,
            joints: Vec::new(),
            scale: None,
            skin: None,
            muscles: Vec::new(),
        }
    }
}

/// How skin lies over muscles and follows them. Lengths are in the file's unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SkinSpec {
    /// Thickness of the tissue between muscle and skin.
    pub fat: f64,
    /// How far from a muscle's surface skin follows it.
    pub reach: f64,
    /// How much skin round a bulge is drawn along with it, 0 to 1.
    pub elasticity: f64,
}

impl SkinSpec {
    /// The largest thickness and reach, metres.
    pub const MOST: f64 = 1.0;

    /// What holds where a file says nothing: 3 mm, 40 mm and 0.5, in a unit of so many metres.
    pub fn in_unit(unit_metres: f64) -> Self {
        Self { fat: 0.003 / unit_metres, reach: 0.04 / unit_metres, elasticity: 0.5 }
    }

    /// Whether all three are within their limits, in a unit of so many metres.
    pub fn is_valid(&self, unit_metres: f64) -> bool {
        let length = |value: f64| (0.0..=Self::MOST).contains(&(value * unit_metres));
        length(self.fat) && length(self.reach) && (0.0..=1.0).contains(&self.elasticity)
    }
}

/// A joint with one axis.
#[derive(Debug, Clone, PartialEq)]
pub struct JointSpec {
    /// What via points and measurements call it; empty: by its bone.
    pub name: String,
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
    pub via: Vec<ViaPoint>,
    /// Surfaces that it goes round.
    pub wraps: Vec<Wrap>,
    /// Where it ends.
    pub insertion: Option<Anchor>,
    /// Tendons at the origin and at the insertion.
    pub tendons: [Tendon; 2],
    /// The angle of its fibres to the line of action at its rest length, degrees: from 0 to below [`LIMIT`](crate::pennation::LIMIT).
    pub pennation: f64,
}

impl JointSpec {
    /// What via points and measurements call it.
    #[must_use]
    pub fn label(&self) -> &str {
        if self.name.is_empty() { &self.bone } else { &self.name }
    }
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
            wraps: Vec::new(),
            insertion: None,
            tendons: [Tendon::default(); 2],
            pennation: 0.0,
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

/// A point that a muscle passes.
#[derive(Debug, Clone, PartialEq)]
pub struct ViaPoint {
    /// Where it is; of a point that moves, where it is while its joint is not known.
    pub place: Anchor,
    /// Where it is passed only while a joint's angle lies in a range.
    pub active: Option<ActiveRange>,
    /// Where its place depends on a joint's angle.
    pub moves: Option<PointMotion>,
}

impl From<Anchor> for ViaPoint {
    fn from(place: Anchor) -> Self {
        Self { place, active: None, moves: None }
    }
}

/// While a joint's angle lies in this range a via point is passed.
#[derive(Debug, Clone, PartialEq)]
pub struct ActiveRange {
    /// What the file calls the joint.
    pub joint: String,
    /// Least and greatest angle, degrees; both belong to the range.
    pub range: [f64; 2],
}

/// How the place of a via point depends on a joint's angle: natural cubic splines through these places, straight on beyond them.
#[derive(Debug, Clone, PartialEq)]
pub struct PointMotion {
    /// What the file calls the joint.
    pub joint: String,
    /// Angles in rising order, degrees; two at least.
    pub angles: Vec<f64>,
    /// The offset on the bone at each.
    pub offsets: Vec<DVec3>,
}

/// A surface, fixed to a bone, that a muscle goes round like a rope round a pulley.
#[derive(Debug, Clone, PartialEq)]
pub struct Wrap {
    /// Its shape and its size.
    pub shape: WrapShape,
    /// Its centre.
    pub center: Anchor,
    /// How its frame is turned from the bone's axes, degrees: about x, then about y and about z as the turns before have left them.
    pub rotation: DVec3,
    /// The side on which the muscle passes: a direction in its frame; `None` = the shorter way.
    pub side: Option<DVec3>,
    /// The part of the way on which it acts.
    pub range: WrapRange,
}

/// The shape of a wrap surface in its frame. Lengths are in the file's unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum WrapShape {
    /// A sphere.
    Sphere {
        /// Its radius.
        radius: f64,
    },
    /// A cylinder about the z axis.
    Cylinder {
        /// Its radius.
        radius: f64,
        /// Its length.
        length: f64,
    },
    /// An ellipsoid along the axes.
    Ellipsoid {
        /// Half its length along x, y and z.
        radii: DVec3,
    },
    /// A ring about the z axis, which the muscle goes through.
    Torus {
        /// From the centre to the middle of the tube.
        radius: f64,
        /// Radius of the tube.
        tube: f64,
    },
}

/// The part of a muscle's way on which a wrap surface acts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WrapRange {
    /// The first stretch that leads from one bone to another.
    AtJoint,
    /// All of it.
    Whole,
    /// From one point of the way to another; 0 is the origin, 1 the first via point.
    Between([usize; 2]),
}

impl WrapShape {
    /// What files call it.
    #[must_use]
    pub fn id(&self) -> &'static str {
        match self {
            Self::Sphere { .. } => "sphere",
            Self::Cylinder { .. } => "cylinder",
            Self::Ellipsoid { .. } => "ellipsoid",
            Self::Torus { .. } => "torus",
        }
    }

    /// The shape with all lengths multiplied.
    #[must_use]
    pub fn scaled(self, scale: f64) -> Self {
        match self {
            Self::Sphere { radius } => Self::Sphere { radius: radius * scale },
            Self::Cylinder { radius, length } => Self::Cylinder { radius: radius * scale, length: length * scale },
            Self::Ellipsoid { radii } => Self::Ellipsoid { radii: radii * scale },
            Self::Torus { radius, tube } => Self::Torus { radius: radius * scale, tube: tube * scale },
        }
    }

    /// The shape with lengths that a person can read.
    #[must_use]
    pub(crate) fn neat(self) -> Self {
        match self {
            Self::Sphere { radius } => Self::Sphere { radius: neat(radius) },
            Self::Cylinder { radius, length } => Self::Cylinder { radius: neat(radius), length: neat(length) },
            Self::Ellipsoid { radii } => Self::Ellipsoid { radii: radii.map(neat) },
            Self::Torus { radius, tube } => Self::Torus { radius: neat(radius), tube: neat(tube) },
        }
    }

    /// Its lengths: radius; radius and length; three radii; radius of ring and tube.
    pub fn sizes(&self) -> impl Iterator<Item = f64> + use<> {
        let (sizes, count) = match *self {
            Self::Sphere { radius } => ([radius, 0.0, 0.0], 1),
            Self::Cylinder { radius, length } => ([radius, length, 0.0], 2),
            Self::Ellipsoid { radii } => (radii.to_array(), 3),
            Self::Torus { radius, tube } => ([radius, tube, 0.0], 2),
        };
        sizes.into_iter().take(count)
    }
}

impl Wrap {
    /// A sphere on the stretch that leads from one bone to another, with its side along the bone's own axes.
    #[must_use]
    pub fn sphere(center: Anchor, radius: f64, side: DVec3) -> Self {
        Self { shape: WrapShape::Sphere { radius }, center, rotation: DVec3::ZERO, side: Some(side), range: WrapRange::AtJoint }
    }
}

/// A tendon: it goes on from the muscle's end and does not change its length.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Tendon {
    /// Length; 0 = no tendon.
    pub length: f64,
    /// Radius.
    pub radius: f64,
}

//! Muscles of constant volume: the profile that conserves it, the path from bone to bone, the surface, and the YAML that describes them.
//!
//! # How a muscle keeps its volume
//!
//! A muscle at rest is a row of nodes at equal spacing, each with a radius; between neighbours lies a truncated cone. When the muscle shortens, every radius
//! grows by its own multiplier times one number `δ`: the belly more than the ends. The volume of the cones is a quadratic in the radii, so that *equal
//! volume* is a quadratic equation in `δ`, with coefficients that follow from the shape at rest and the new length alone. Of its two roots the one is taken
//! that goes to 0 as the length goes back to rest. The equations stand at [`Profile`].
//!
//! ```
//! use sinew_muscle::Profile;
//!
//! let profile = Profile::new(vec![5.0, 18.0, 5.0], vec![0.0, 1.0, 0.0], 250.0)?;
//! for length in [180.0, 220.0, 250.0, 260.0] {
//!     let solved = profile.solve(length);
//!     assert!((solved.volume / profile.volume() - 1.0).abs() < 1e-12);
//! }
//! # Ok::<(), sinew_muscle::ProfileError>(())
//! ```
//!
//! A muscle is always solved from rest, so that its shape depends on the length alone and never on the way there. Where the discriminant reaches 0, a radius
//! reaches 0, or the belly gets shorter than 40 % of its rest length, the length is held ([`Profile::limits`] says which it was). Measured radii at several
//! lengths take the place of multipliers where there are such ([`Profile::of_poses`]); one factor then brings the blended radii to the volume.
//!
//! The volume is kept along a bent line too. The length is that of the **line of action**: the shortest path from origin to insertion, through via points and
//! round wrap surfaces, exact and without jumps. What is drawn is another line of *exactly the same length*, rounded at its corners; where radius times
//! curvature stays below 1, Pappus' theorem makes the volume round a bent line that round a straight one. Cross-sections are turned by frames that do not twist.
//! On the bones of a clip the flesh lies beside the bones: bent away from them, and flattened into ellipses of the same area.
//!
//! # From a file to a surface
//!
//! [`MuscleFile::parse`] reads the YAML, [`MuscleRig::build`] puts the muscles into a scene, on an arm of two rods or on the bones of a clip. In each frame
//! [`MuscleRig::solve_into`] solves one and [`MuscleRig::deform`] moves the vertices of its mesh. See `examples/solve_muscle.rs`.
//!
//! # Where what is
//!
//! | file | what it holds |
//! |---|---|
//! | `profile` | radii and growth, the quadratic, the valid lengths |
//! | `measured_shapes` | a profile given by radii at several lengths |
//! | `arm` | the two rods and the elbow as nodes of the scene |
//! | `primitive_meshes`, `materials` | the arm's solid shapes, and the colours of all |
//! | `line_of_action` | the line of action: its length, and the centreline that is drawn for it |
//! | `via_point`, `wrap_object` | what a line of action passes and goes round, on the bones |
//! | `wrap_placement` | a wrap surface in the world, and its outline |
//! | [`wrapping`] | shortest paths over several spheres, cylinders, ellipsoids and tori |
//! | `rounded_centerline` | the line that is drawn, rounded at its corners |
//! | `centerline` | centrelines of straight segments, arcs and geodesics, exact in length, with rotation-minimising frames |
//! | `solved_muscle` | a muscle in one pose, and its buffers |
//! | `bone_clearance` | distance between the belly and the rods |
//! | `bone_shape`, `bone_shapes` | how thick bones are round their axes, from their meshes |
//! | `flesh` | the belly bent away from bones and flattened against them |
//! | `cross_sections`, `bone_chain` | a muscle in a pose as a row of cross-sections, and the bones that it runs along |
//! | `tessellation` | rings, hemispheres and tendons as triangles |
//! | `muscle_state` | contraction and elbow angle of an arm, each computed from the other |
//! | `driving` | the same for a joint of a clip's skeleton |
//! | `bones` | bones by name, and the points of a muscle on them in the world |
//! | `retarget` | preset muscles fitted to the bones of a skeleton |
//! | [`sets`] | whole sets of muscles of published models on the bones of a figure |
//! | `revolute_joint` | the joint that measurements turn |
//! | `joint_dof` | the elbow of any skeleton, or the joint that a file names |
//! | `bone_name_heuristics` | which part of a body a bone's name means |
//! | `humanoid` | shoulders, elbows, wrists, hips, knees and ankles of figures of human build |
//! | `measure`, `muscle_sample` | moment arms; a muscle as it was measured once |
//! | `solver_report` | the figures behind a solution: coefficients, roots, limits |
//! | `edit` | changes of a file by hand, each checked |
//! | `presets` | ready muscles by name |
//! | `literature_data` | published figures, with their sources |
//! | `csv_table` | measured radii as comma-separated text |
//! | `validation` | models compared with measured radii |
//! | `parameter_fit` | growth parameters fitted to measured radii |
//! | `build` | puts a file into a scene, attaches muscles to the bones of a clip |
//! | `reshape` | another shape for a muscle that is in a scene already |
//! | `scaling` | muscles that scale with their bones |
//! | `pennation` | the angle of the fibres, and how they are drawn at it |
//! | `muscle_findings`, `finding` | diagnostics of a muscle over the range of its joint; what they are and how they are said |
//! | `muscle_rig` | muscles in a scene: solving, centrelines, surfaces, measuring |
//! | `config` | YAML |

mod arm;
mod bone_chain;
mod bone_clearance;
mod bone_name_heuristics;
mod bone_shape;
mod bone_shapes;
mod bones;
mod build;
mod centerline;
pub mod config;
mod cross_sections;
mod csv_table;
mod driving;
pub mod edit;
mod finding;
mod flesh;
mod humanoid;
mod joint_dof;
mod line_of_action;
pub mod literature_data;
mod materials;
mod measure;
mod measured_shapes;
mod muscle_findings;
mod muscle_rig;
mod muscle_sample;
mod muscle_state;
pub mod parameter_fit;
mod path_editing;
pub mod pennation;
pub mod presets;
mod primitive_meshes;
mod profile;
mod reshape;
mod retarget;
mod revolute_joint;
mod rounded_centerline;
mod scaling;
pub mod sets;
mod solved_muscle;
pub mod solver_report;
mod tessellation;
pub mod validation;
mod via_point;
mod wrap_object;
mod wrap_placement;
pub mod wrapping;

pub use arm::{Arm, ArmNodes, FOREARM, FULL_FLEXION, UPPER_ARM};
pub use bone_chain::BoneAxis;
pub use bones::{AttachmentPoint, bone_name};
pub use centerline::{Centerline, CrossSectionFrame, Cursor};
pub use config::{ActiveRange, PointMotion, ViaPoint, WrapRange, WrapShape};
pub use config::{Anchor, ConfigError, Form, JointSpec, MuscleFile, MuscleSpec, PoseAt, PoseSpec, SaveResult, SkinSpec, Tendon, Wrap};
pub use cross_sections::CrossSection;
pub use driving::Driving;
pub use edit::{Edit, EditError};
pub use finding::{Finding, FoundAt, LinePoint, MomentArmAt};
pub use humanoid::BodySide;
pub use joint_dof::rotation;
pub use joint_dof::{FoundBy, JointDof, JointRotation};
pub use materials::fibers;
pub use measured_shapes::Pose;
pub use muscle_rig::MuscleRig;
pub use muscle_sample::MuscleSample;
pub use profile::{Limit, LimitCause, Profile, ProfileError};
pub use scaling::of_bone as bone_scale;
pub use solved_muscle::SolvedMuscle;
pub use solver_report::{Root, SolverReport};
pub use tessellation::{MeshQuality, SEGMENTS};
pub use wrap_placement::WrapPlacement;

/// The state that the two sliders share; each follows the other.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MuscleState {
    /// Elbow angle, degrees; 0 = straight arm.
    pub flexion: f64,
    /// Contraction, per cent of the way from the longest to the shortest length.
    pub contraction: f64,
}

/// One solved muscle at one moment: what the ledger, `measure` and the surface read. Lengths are in the file's unit.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Solved {
    /// Length after holding it within its limits, tendons left out.
    pub length: f64,
    /// Length from origin to insertion, tendons counted, before any holding.
    pub path_length: f64,
    /// Whether the length asked for was outside the limits.
    pub held: bool,
    /// Radius of each node.
    pub radii: Vec<f64>,
    /// The change of radius for a growth of 1.
    pub delta: f64,
    /// Coefficients A, B, C of the quadratic.
    pub quadratic: [f64; 3],
    /// B² − 4AC.
    pub discriminant: f64,
    /// Both roots; the first is the one taken.
    pub roots: [f64; 2],
    /// Volume.
    pub volume: f64,
    /// Volume over rest volume, minus 1.
    pub volume_error: f64,
}

impl Solved {
    /// The largest radius of all nodes; 0 where there are none.
    pub fn largest_radius(&self) -> f64 {
        self.radii.iter().copied().fold(0.0, f64::max)
    }
}

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

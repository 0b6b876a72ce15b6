//! Whole sets of muscles from published models, carried to the bones of a figure.
//!
//! A model has paths on the segments of one body. Each segment is laid on the figure by a similarity (`frames`), so that joints come to lie on joints;
//! volumes go with the cube of the scale (`belly`), wrap surfaces are as large as their segment, or smaller where a point of the muscle would lie inside.
//! Joints of the file are the model's coordinates, with its names and signs; their angles count from the figure's rest pose, as those of all joints of muscle
//! files do.
//!
//! The models are `arm26` and `gait2392`, both licensed CC BY 3.0: their credit stands in each muscle that is made, and in [`MuscleSet::credits`].

mod arm26;
mod belly;
mod bone_space;
mod carry;
mod data;
mod error;
mod frames;
mod gait2392;
mod mirror;
mod wraps;

pub use belly::SPECIFIC_TENSION;
pub use error::{BodyJoint, SetError, SidedJoint};
pub use mirror::mirrored;

use super::humanoid::{BodySide, Humanoid, Limb};
use crate::config::{Form, MuscleFile, MuscleSpec};
use crate::{Finding, MuscleRig};
use bone_space::{Bones, UNIT};
use data::Model;
use frames::{Figure, missing};
use sinew_scene::animation::Clip;
use sinew_scene::diagnostics::Diagnostic;
use sinew_scene::{Graph, Label, MuscleId, NodeId, Scene};

/// A set of muscles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MuscleSet {
    /// Biceps, triceps and brachialis.
    Arm,
    /// Hip, thigh and lower leg.
    Leg,
    /// Arms and legs.
    Body,
}

/// Which sides of a body get muscles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sides {
    /// One.
    One(BodySide),
    /// Both; of a figure with one arm that has no side, that one.
    Both,
}

/// Muscles on a figure.
#[derive(Debug, Clone, PartialEq)]
pub struct AttachedSet {
    /// The muscles and the joints that they cross, in millimetres, scaled with the bones.
    pub file: MuscleFile,
    /// How many figures the scene has; the first one has got the muscles.
    pub figures: usize,
}

impl MuscleSet {
    /// All sets.
    pub const ALL: [Self; 3] = [Self::Arm, Self::Leg, Self::Body];

    /// What commands call it.
    #[must_use]
    pub fn id(self) -> &'static str {
        match self {
            Self::Arm => "arm",
            Self::Leg => "leg",
            Self::Body => "body",
        }
    }

    /// The set with this id.
    #[must_use]
    pub fn by_id(id: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|set| set.id() == id)
    }

    fn models(self) -> &'static [&'static Model] {
        match self {
            Self::Arm => &[&arm26::ARM],
            Self::Leg => &[&gait2392::LEG],
            Self::Body => &[&gait2392::LEG, &arm26::ARM],
        }
    }

    /// The models that its muscles are from: name, authors and licence.
    pub fn credits(self) -> impl Iterator<Item = (&'static str, &'static str)> {
        self.models().iter().map(|model| (model.name, model.credit))
    }

    /// Puts the muscles of this set on the first figure of a scene at rest. Nodes at and below `skip` are none of it; `clips` tell which way an arm bends that
    /// has no body.
    ///
    /// # Errors
    /// [`SetError`] where there is no figure, or it lacks joints.
    pub fn attach(self, scene: &Scene, clips: &[Clip], skip: &[NodeId], sides: Sides) -> Result<AttachedSet, SetError> {
        let figures = Humanoid::find(scene, skip);
        let humanoid = figures.first().ok_or(SetError::NoFigure)?;
        let limbs = self.limbs(humanoid, sides);
        let lacks: Vec<SidedJoint> = limbs.iter().flat_map(|limb| missing(limb.bones, limb.is_leg, limb.side_named(humanoid))).collect();
        if !lacks.is_empty() {
            let mut once: Vec<SidedJoint> = Vec::new();
            lacks.into_iter().for_each(|joint| {
                if !once.contains(&joint) {
                    once.push(joint)
                }
            });
            return Err(SetError::MissingJoints(once));
        }
        let mut world = Vec::new();
        scene.graph.world_from_local(&scene.graph.rest_locals(), &mut world);
        let figure = Figure { scene, clips, humanoid, world: &world };
        let first = limbs.iter().find_map(|limb| limb.bones.girdle).ok_or(SetError::NoFigure)?;
        let bones = Bones::new(&scene.graph, &world, first);
        let mut file = MuscleFile { unit_metres: UNIT, form: Form::Rich, scale: Some(bones.scale), ..MuscleFile::default() };
        for limb in &limbs {
            let frames = figure.frames(limb.model, limb.side)?;
            let suffix = limb.side_named(humanoid).map_or("", |side| if side == BodySide::Left { "_l" } else { "_r" });
            let joints = carry::joints(limb.model, &frames, &bones, suffix)?;
            for data in limb.model.muscles {
                file.muscles.push(carry::muscle(data, limb.model, &frames, &bones, &joints, suffix)?);
            }
            file.joints.extend(joints);
        }
        drop_idle_wraps(&mut file, &scene.graph);
        Ok(AttachedSet { file, figures: figures.len() })
    }

    /// The limbs that get muscles, right before left.
    fn limbs<'a>(self, humanoid: &'a Humanoid, sides: Sides) -> Vec<MuscledLimb<'a>> {
        let mut limbs = Vec::new();
        for model in self.models() {
            let is_leg = model.segments.iter().any(|data| data.segment == data::Segment::Femur);
            let pair = if is_leg { &humanoid.legs } else { &humanoid.arms };
            for side in [BodySide::Right, BodySide::Left] {
                let wanted = match sides {
                    Sides::One(one) => side == one,
                    Sides::Both => is_leg || !humanoid.has_one_arm || side == BodySide::Right,
                };
                if wanted {
                    limbs.push(MuscledLimb { model, is_leg, side, bones: &pair[side as usize] });
                }
            }
        }
        limbs
    }
}

/// Takes off the wrap surfaces that a muscle touches at no angle of any joint: where a figure rests with its arms raised, those at the back of the shoulder.
fn drop_idle_wraps(file: &mut MuscleFile, graph: &Graph) {
    let mut scene = Scene { graph: graph.clone(), ..Scene::default() };
    let mut rig = MuscleRig::build(file, "", &mut scene, MuscleId(0));
    let findings = rig.attach(&scene);
    let idle = |muscle: &MuscleSpec, wrap: usize| {
        let is_it = |found: &Diagnostic<Finding>| {
            matches!(&found.finding, Finding::WrapNotTouched { wrap: other, .. } if *other == wrap)
                && matches!(found.element.as_label(), Label::Name(name) if name == muscle.name)
        };
        findings.iter().any(is_it)
    };
    for muscle in &mut file.muscles {
        let used: Vec<bool> = (0..muscle.wraps.len()).map(|wrap| !idle(muscle, wrap)).collect();
        let mut used = used.into_iter();
        muscle.wraps.retain(|_| used.next().unwrap_or(true));
    }
}

/// A limb that gets the muscles of a model.
struct MuscledLimb<'a> {
    model: &'static Model,
    is_leg: bool,
    side: BodySide,
    bones: &'a Limb,
}

impl MuscledLimb<'_> {
    /// The side that its muscles name; `None` of an only arm that has none.
    fn side_named(&self, humanoid: &Humanoid) -> Option<BodySide> {
        (self.is_leg || !humanoid.has_one_arm).then_some(self.side)
    }
}

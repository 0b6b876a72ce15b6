//! Changes of a muscle file by hand. Each makes a new file or an error that says why it cannot; the old one stays as it is.

use glam::DVec3;

use super::arm::{FOREARM, UPPER_ARM};
use super::bones::AttachmentPoint;
use super::config::{ActiveRange, Anchor, MuscleFile, MuscleSpec, PoseSpec, SkinSpec, Tendon, ViaPoint, Wrap, WrapRange, WrapShape};
use super::pennation;
use super::profile::{LARGEST, Profile, ProfileError};
use sinew_scene::limits;
use sinew_scene::message;
use sinew_scene::message::{Message, ToMessage};

/// Most via points of one muscle.
pub const VIA: usize = 24;
/// Most wrap surfaces of one muscle.
pub const WRAPS: usize = 12;
/// Most places between which a via point moves.
pub const MOTION_POINTS: usize = 64;

/// A change of one muscle. Nodes and ends count from 0; lengths are in the file's unit.
#[derive(Debug, Clone, PartialEq)]
pub enum Edit {
    /// What a person calls it.
    Name(String),
    /// Where the numbers come from.
    Source(String),
    /// Colour, sRGB; `None` = the palette's.
    Color(Option<[u8; 3]>),
    /// Length at rest.
    RestLength(f64),
    /// Radius of a node.
    Radius(usize, f64),
    /// Growth multiplier of a node.
    Growth(usize, f64),
    /// All radii and growth multipliers at once: presets, fits, pasted tables.
    Nodes(Vec<f64>, Vec<f64>),
    /// Measured poses instead of radii and growth multipliers.
    Poses(Vec<PoseSpec>),
    /// A new node behind this one, half-way to the next in radius and growth; behind the last, a copy of it. The length stays, the nodes stand closer.
    AddNode(usize),
    /// One node less. The length stays, the nodes stand wider.
    DeleteNode(usize),
    /// How skin lies over the muscles of the file; `None` = as usual.
    Skin(Option<SkinSpec>),
    /// The tendon at the origin (0) or the insertion (1).
    Tendon(usize, Tendon),
    /// The angle of the fibres at the rest length, degrees.
    Pennation(f64),
    /// Origin and insertion; `None` = the muscle lies on its own, without via points and wrap.
    Ends(Option<[Anchor; 2]>),
    /// One end: origin (0) or insertion (1).
    End(usize, Anchor),
    /// The place of one of the points that it passes, from 0.
    Via(usize, Anchor),
    /// While which angles it passes one of the points, from 0; `None` = always.
    ViaRange(usize, Option<ActiveRange>),
    /// A new point to pass before this one; at the end where there is no such point.
    AddVia(usize, Anchor),
    /// A point to pass less.
    DeleteVia(usize),
    /// This point to pass and the one after it change places.
    SwapVia(usize),
    /// One of the surfaces that it goes round, from 0.
    Wrap(usize, Wrap),
    /// A new surface to go round, after all others.
    AddWrap(Wrap),
    /// A surface to go round less.
    DeleteWrap(usize),
    /// This surface and the one after it change places.
    SwapWrap(usize),
}

/// Why a change cannot be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{}", self.message())]
pub enum EditError {
    /// The shape would be no muscle.
    Profile(#[from] ProfileError),
    /// There is no such muscle.
    NoMuscle(usize),
    /// The muscle has no such node.
    NoNode(usize),
    /// The file would have more muscles than [`limits::MUSCLES`], or none.
    Count,
    /// The surfaces of the file's muscles would have more vertices than [`limits::MUSCLE_VERTICES`] together.
    TooMuchSurface,
    /// A tendon with a negative length, or a length without a radius.
    Tendon,
    /// A pennation angle below 0, not below [`pennation::LIMIT`], or no number.
    Pennation,
    /// Origin and insertion are the same point of one bone.
    EndsCoincide,
    /// The muscle has no ends for via points or a wrap to lie between.
    NoEnds,
    /// An offset that is no number or too large.
    Offset,
    /// The arm has no bone of this name.
    ArmBone(String),
    /// The muscle has no such via point.
    NoVia(usize),
    /// More than [`VIA`] via points.
    TooManyVia(usize),
    /// A bone that a file could not find again.
    NoName,
    /// The radii come from measured poses, so that one cannot be set.
    Posed,
    /// A wrap surface without a size, a torus without a hole, a side or a part of the way that is none.
    Wrap,
    /// The muscle has no such wrap surface.
    NoWrap(usize),
    /// More than [`WRAPS`] wrap surfaces.
    TooManyWraps(usize),
    /// A range of angles that is empty or of no joint of the file.
    ViaRange,
    /// A thickness, reach or elasticity of skin that is negative or too large.
    Skin,
}

impl ToMessage for EditError {
    fn message(&self) -> Message {
        match self {
            Self::Profile(error) => error.message(),
            Self::NoMuscle(index) => message!("muscle-edit-no-muscle", number = index + 1),
            Self::NoNode(node) => message!("muscle-edit-no-node", number = node + 1),
            Self::Count => message!("muscle-edit-count", limit = limits::MUSCLES),
            Self::TooMuchSurface => message!("muscle-too-much-surface", limit = limits::MUSCLE_VERTICES),
            Self::Tendon => message!("muscle-edit-tendon"),
            Self::Pennation => message!("muscle-edit-pennation-bad", limit = pennation::LIMIT),
            Self::EndsCoincide => message!("muscle-edit-ends-coincide"),
            Self::NoEnds => message!("muscle-edit-no-ends"),
            Self::Offset => message!("muscle-edit-offset"),
            Self::ArmBone(bone) => message!("muscle-edit-arm-bone", bone = bone),
            Self::NoVia(number) => message!("muscle-edit-no-via", number = number + 1),
            Self::TooManyVia(count) => message!("muscle-too-many-via", limit = VIA, count = count),
            Self::NoName => message!("muscle-edit-no-name"),
            Self::Posed => message!("muscle-edit-posed"),
            Self::Wrap => message!("muscle-edit-wrap"),
            Self::NoWrap(number) => message!("muscle-edit-no-wrap", number = number + 1),
            Self::TooManyWraps(count) => message!("muscle-too-many-wraps", limit = WRAPS, count = count),
            Self::ViaRange => message!("muscle-edit-via-range-bad"),
            Self::Skin => message!("muscle-edit-skin-bad"),
        }
    }
}

/// What undo calls it.
impl ToMessage for Edit {
    fn message(&self) -> Message {
        match self {
            Self::Name(_) => message!("muscle-edit-name"),
            Self::Source(_) => message!("muscle-edit-source"),
            Self::Color(_) => message!("muscle-edit-color"),
            Self::RestLength(_) => message!("muscle-edit-rest-length"),
            Self::Radius(node, _) => message!("muscle-edit-radius", node = node + 1),
            Self::Growth(node, _) => message!("muscle-edit-growth", node = node + 1),
            Self::Nodes(..) => message!("muscle-edit-nodes"),
            Self::Poses(_) => message!("muscle-edit-poses"),
            Self::AddNode(_) => message!("muscle-edit-add-node"),
            Self::DeleteNode(node) => message!("muscle-edit-delete-node", node = node + 1),
            Self::Skin(_) => message!("muscle-edit-skin"),
            Self::Tendon(0, _) => message!("muscle-edit-tendon-origin"),
            Self::Tendon(..) => message!("muscle-edit-tendon-insertion"),
            Self::Pennation(_) => message!("muscle-edit-pennation"),
            Self::Ends(_) => message!("muscle-edit-attach"),
            Self::End(0, _) => message!("muscle-edit-origin"),
            Self::End(..) => message!("muscle-edit-insertion"),
            Self::Via(number, _) => message!("muscle-edit-via", number = number + 1),
            Self::AddVia(..) => message!("muscle-edit-via-add"),
            Self::DeleteVia(number) => message!("muscle-edit-via-delete", number = number + 1),
            Self::SwapVia(_) => message!("muscle-edit-via-order"),
            Self::ViaRange(number, _) => message!("muscle-edit-via-range", number = number + 1),
            Self::Wrap(..) => message!("muscle-edit-wrapping"),
            Self::AddWrap(_) => message!("muscle-edit-wrap-add"),
            Self::DeleteWrap(_) => message!("muscle-edit-wrap-delete"),
            Self::SwapWrap(_) => message!("muscle-edit-wrap-order"),
        }
    }
}

impl Edit {
    /// Puts the point `hold` of the muscle `spec` on `anchor`; `None` where it goes round nothing, whose middle could be put anywhere.
    pub fn place(spec: &MuscleSpec, hold: AttachmentPoint, anchor: Anchor) -> Option<Self> {
        Some(match hold {
            AttachmentPoint::End(end) => Self::End(end, anchor),
            AttachmentPoint::Via(number) => Self::Via(number, anchor),
            AttachmentPoint::Wrap(number) => Self::Wrap(number, Wrap { center: anchor, ..spec.wraps.get(number)?.clone() }),
        })
    }
}

impl MuscleFile {
    /// The file with muscle `index` changed.
    ///
    /// # Errors
    /// [`EditError`] where the change would make no muscle.
    pub fn edited(&self, index: usize, edit: &Edit) -> Result<Self, EditError> {
        let mut file = self.clone();
        let on_arm = self.arm.is_some();
        let muscle = file.muscles.get_mut(index).ok_or(EditError::NoMuscle(index))?;
        if let Edit::Skin(skin) = edit {
            if skin.is_some_and(|skin| !skin.is_valid(self.unit_metres)) {
                return Err(EditError::Skin);
            }
            file.skin = *skin;
            return Ok(file);
        }
        muscle.apply(edit)?;
        muscle.check_places(on_arm)?;
        file.drawable()
    }

    fn drawable(self) -> Result<Self, EditError> {
        if Self::can_be_drawn([&self]) { Ok(self) } else { Err(EditError::TooMuchSurface) }
    }

    /// The file with one muscle more, at the end.
    ///
    /// # Errors
    /// [`EditError`] where there are too many, or the muscle names bones that the arm has not.
    pub fn with_muscle(&self, muscle: MuscleSpec) -> Result<Self, EditError> {
        muscle.check_places(self.arm.is_some())?;
        let mut file = self.clone();
        file.muscles.push(muscle);
        if file.muscles.len() > limits::MUSCLES { Err(EditError::Count) } else { file.drawable() }
    }

    /// The file without muscle `index`, which must not be its last one.
    ///
    /// # Errors
    /// [`EditError`] where there is no such muscle, or no other.
    pub fn without_muscle(&self, index: usize) -> Result<Self, EditError> {
        if index >= self.muscles.len() {
            return Err(EditError::NoMuscle(index));
        }
        let mut file = self.clone();
        file.muscles.remove(index);
        if file.muscles.is_empty() { Err(EditError::Count) } else { Ok(file) }
    }
}

impl MuscleSpec {
    /// Where the point `hold` is; `None` where there is no such point.
    pub fn place(&self, hold: AttachmentPoint) -> Option<&Anchor> {
        match hold {
            AttachmentPoint::End(0) => self.origin.as_ref(),
            AttachmentPoint::End(_) => self.insertion.as_ref(),
            AttachmentPoint::Via(number) => self.via.get(number).map(|via| &via.place),
            AttachmentPoint::Wrap(number) => self.wraps.get(number).map(|wrap| &wrap.center),
        }
    }

    fn apply(&mut self, edit: &Edit) -> Result<(), EditError> {
        if !self.poses.is_empty() && self.apply_to_poses(edit)? {
            return Ok(());
        }
        let (radii, growth) = (|| self.profile.radii().to_vec(), || self.profile.growth().to_vec());
        let length = self.profile.rest_length();
        let set = |mut list: Vec<f64>, node: usize, value: f64| {
            *list.get_mut(node).ok_or(EditError::NoNode(node))? = value;
            Ok::<_, EditError>(list)
        };
        match edit {
            // The file's, not the muscle's.
            Edit::Skin(_) => {}
            Edit::Name(name) => self.name.clone_from(name),
            Edit::Source(source) => self.source.clone_from(source),
            Edit::Color(color) => self.color = *color,
            Edit::RestLength(length) => self.profile = Profile::new(radii(), growth(), *length)?,
            Edit::Radius(node, value) => self.profile = Profile::new(set(radii(), *node, *value)?, growth(), length)?,
            Edit::Growth(node, value) => self.profile = Profile::new(radii(), set(growth(), *node, *value)?, length)?,
            Edit::Nodes(radii, growth) => {
                self.profile = Profile::new(radii.clone(), growth.clone(), length)?;
                self.poses.clear();
            }
            Edit::Poses(poses) => {
                self.profile = Self::posed(poses, length, |_| None)?;
                self.poses.clone_from(poses);
            }
            Edit::AddNode(node) => self.profile = Profile::new(with_node(&radii(), *node)?, with_node(&growth(), *node)?, length)?,
            Edit::DeleteNode(node) => self.profile = Profile::new(without_node(&radii(), *node)?, without_node(&growth(), *node)?, length)?,
            Edit::Tendon(end, tendon) => {
                let fits = (0.0..=LARGEST).contains(&tendon.length) && (0.0..=LARGEST).contains(&tendon.radius);
                if !fits || (tendon.length > 0.0 && tendon.radius == 0.0) {
                    return Err(EditError::Tendon);
                }
                if let Some(slot) = self.tendons.get_mut(*end) {
                    *slot = *tendon;
                }
            }
            Edit::Pennation(degrees) if pennation::is_pennation(*degrees) => self.pennation = *degrees,
            Edit::Pennation(_) => return Err(EditError::Pennation),
            Edit::Ends(Some([origin, insertion])) => {
                (self.origin, self.insertion) = (Some(origin.clone()), Some(insertion.clone()));
            }
            Edit::Ends(None) => (self.origin, self.insertion, self.via, self.wraps) = (None, None, Vec::new(), Vec::new()),
            Edit::End(end, anchor) => {
                if self.origin.is_none() {
                    return Err(EditError::NoEnds);
                }
                let slot = if *end == 0 { &mut self.origin } else { &mut self.insertion };
                *slot = Some(anchor.clone());
            }
            Edit::Via(number, anchor) => {
                let via = self.via.get_mut(*number).ok_or(EditError::NoVia(*number))?;
                via.put_on(anchor);
            }
            Edit::ViaRange(number, range) => {
                self.via.get_mut(*number).ok_or(EditError::NoVia(*number))?.active.clone_from(range);
            }
            Edit::AddVia(before, anchor) => {
                let before = (*before).min(self.via.len());
                self.via.insert(before, anchor.clone().into());
                self.renumber(|point| if point > before { point + 1 } else { point });
            }
            Edit::DeleteVia(number) if *number < self.via.len() => {
                self.via.remove(*number);
                // Its point of the way, counted from the origin, is the one after its number.
                self.renumber(|point| if point > *number + 1 { point - 1 } else { point });
            }
            Edit::SwapVia(number) if number + 1 < self.via.len() => self.via.swap(*number, number + 1),
            Edit::DeleteVia(number) | Edit::SwapVia(number) => return Err(EditError::NoVia(*number)),
            Edit::Wrap(number, wrap) => self.wraps.get_mut(*number).ok_or(EditError::NoWrap(*number))?.clone_from(wrap),
            Edit::AddWrap(wrap) => self.wraps.push(wrap.clone()),
            Edit::DeleteWrap(number) if *number < self.wraps.len() => {
                self.wraps.remove(*number);
            }
            Edit::SwapWrap(number) if number + 1 < self.wraps.len() => self.wraps.swap(*number, number + 1),
            Edit::DeleteWrap(number) | Edit::SwapWrap(number) => return Err(EditError::NoWrap(*number)),
        }
        Ok(())
    }

    /// Of a muscle made of poses: makes the change where it concerns them, and says whether it did.
    fn apply_to_poses(&mut self, edit: &Edit) -> Result<bool, EditError> {
        let (mut poses, mut length) = (self.poses.clone(), self.profile.rest_length());
        match edit {
            Edit::Radius(..) | Edit::Growth(..) => return Err(EditError::Posed),
            Edit::RestLength(asked) => length = *asked,
            Edit::AddNode(node) => poses.iter_mut().try_for_each(|pose| with_node(&pose.radii, *node).map(|radii| pose.radii = radii))?,
            Edit::DeleteNode(node) => {
                poses.iter_mut().try_for_each(|pose| without_node(&pose.radii, *node).map(|radii| pose.radii = radii))?
            }
            _ => return Ok(false),
        }
        self.profile = Self::posed(&poses, length, |_| None)?;
        self.poses = poses;
        Ok(true)
    }

    /// Whether ends, via points and wrap are what a file may say.
    fn check_places(&self, on_arm: bool) -> Result<(), EditError> {
        if self.origin.is_none() && (!self.via.is_empty() || !self.wraps.is_empty()) {
            return Err(EditError::NoEnds);
        }
        if let (Some(origin), Some(insertion)) = (&self.origin, &self.insertion)
            && origin == insertion
        {
            return Err(EditError::EndsCoincide);
        }
        if self.via.len() > VIA {
            return Err(EditError::TooManyVia(self.via.len()));
        }
        if self.wraps.len() > WRAPS {
            return Err(EditError::TooManyWraps(self.wraps.len()));
        }
        if !self.wraps.iter().all(|wrap| wrap.is_sound(self.via.len())) {
            return Err(EditError::Wrap);
        }
        let ranges = self.via.iter().filter_map(|via| via.active.as_ref()).map(|active| active.range);
        if ranges.into_iter().any(|[low, high]| !(low.is_finite() && high.is_finite() && low < high)) {
            return Err(EditError::ViaRange);
        }
        let ends = self.origin.iter().chain(&self.insertion);
        let places = ends.chain(self.via.iter().map(|via| &via.place)).chain(self.wraps.iter().map(|wrap| &wrap.center));
        for place in places {
            if !usable(place.offset) {
                return Err(EditError::Offset);
            }
            if on_arm && place.bone != UPPER_ARM && place.bone != FOREARM {
                return Err(EditError::ArmBone(place.bone.clone()));
            }
        }
        Ok(())
    }
}

impl MuscleSpec {
    /// Changes the numbers of the points between which wrap surfaces act.
    fn renumber(&mut self, number: impl Fn(usize) -> usize) {
        for wrap in &mut self.wraps {
            if let WrapRange::Between([from, to]) = wrap.range {
                let (from, to) = (number(from), number(to));
                wrap.range = if from < to { WrapRange::Between([from, to]) } else { WrapRange::Whole };
            }
        }
    }
}

impl ViaPoint {
    /// Puts the point somewhere else. A point that moves on the same bone keeps its motion.
    fn put_on(&mut self, anchor: &Anchor) {
        let by = anchor.offset - self.place.offset;
        match &mut self.moves {
            Some(moves) if anchor.bone == self.place.bone => moves.offsets.iter_mut().for_each(|offset| *offset += by),
            moves => *moves = None,
        }
        self.place.clone_from(anchor);
    }
}

impl Wrap {
    /// Whether sizes, side and range are what a file may say of a muscle with so many via points.
    fn is_sound(&self, via: usize) -> bool {
        let sizes = self.shape.sizes().all(|size| size > 0.0 && size <= LARGEST);
        let hole = !matches!(self.shape, WrapShape::Torus { radius, tube } if tube >= radius);
        let side = match (self.side, self.shape) {
            (None, _) => true,
            (Some(_), WrapShape::Torus { .. }) => false,
            (Some(side), WrapShape::Cylinder { .. }) => usable(side) && side.with_z(0.0).try_normalize().is_some(),
            (Some(side), _) => usable(side) && side.try_normalize().is_some(),
        };
        let range = !matches!(self.range, WrapRange::Between([from, to]) if from >= to || to > via + 1);
        sizes && hole && side && range && usable(self.rotation)
    }
}

fn usable(vector: DVec3) -> bool {
    vector.is_finite() && vector.abs().max_element() <= LARGEST
}

/// The list with one value more behind `node`, half-way to the next.
fn with_node(list: &[f64], node: usize) -> Result<Vec<f64>, EditError> {
    let here = *list.get(node).ok_or(EditError::NoNode(node))?;
    let next = list.get(node + 1).copied().unwrap_or(here);
    let mut list = list.to_vec();
    list.insert(node + 1, 0.5 * (here + next));
    Ok(list)
}

fn without_node(list: &[f64], node: usize) -> Result<Vec<f64>, EditError> {
    let mut list = list.to_vec();
    if node >= list.len() {
        return Err(EditError::NoNode(node));
    }
    list.remove(node);
    Ok(list)
}

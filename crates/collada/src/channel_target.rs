//! What an animation channel moves: addresses such as `node/sid.X`, `node/sid(3)(0)`, `morph-weights(2)`.

use std::cell::RefCell;

use roxmltree::NodeId as ElementId;
use rustc_hash::FxHashMap;

use super::context::Context;
use super::controller::Controllers;
use super::light_camera::LightsAndCameras;
use super::material::Materials;
use super::nodes::{Tree, is_transform};
use super::{El, asset};
use sinew_scene::MorphId;
use sinew_scene::animation::{ChannelTarget, Components, MaterialSlot};

/// Most slashes that an id in an address may have.
const MOST_SLASHES: usize = 16;

/// What a channel moves, and what its keys have to be like.
#[derive(Debug)]
pub(super) struct Aim {
    /// All that it moves: a node may stand in the scene several times.
    pub targets: Vec<ChannelTarget>,
    /// Numbers a key.
    pub wanted: usize,
    /// Whether the keys are whole matrices.
    pub matrix: bool,
    /// The value as a line over that of the file: at 0, and what 1 adds.
    pub line: Option<(f64, f64)>,
    /// Whether the values are scene-linear colours and are to be encoded as sRGB.
    pub encode: bool,
    /// What keys of one number mean where more are asked for: the angle of a rotation.
    pub lone: Option<Components>,
    /// Where one number is moved: which of how many it is, for keys that hold the whole value all the same.
    pub among: Option<(usize, usize)>,
}

impl Aim {
    fn new(targets: Vec<ChannelTarget>, wanted: usize) -> Self {
        Self { targets, wanted, matrix: false, line: None, encode: false, lone: None, among: None }
    }
}

/// Why a channel moves nothing.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Miss {
    /// The address leads nowhere in the scene.
    Unknown,
    /// It leads to something that isn't shown moving.
    Unsupported,
}

/// Which part of a value the end of an address names.
#[derive(Debug, Clone, PartialEq, Eq)]
enum Member {
    All,
    Name(String),
    Index(usize),
    Cell(usize, usize),
}

/// Resolves addresses.
pub(super) struct Aims<'s, 'a> {
    tree: &'s Tree<'a>,
    materials: &'s Materials<'a>,
    lights: &'s LightsAndCameras,
    controllers: &'s Controllers<'a>,
    /// Morphs by every element that an address may name them by.
    morphs: FxHashMap<ElementId, MorphId>,
    /// The place of each transform of the nodes that were looked at.
    places: RefCell<FxHashMap<ElementId, u32>>,
}

impl<'s, 'a> Aims<'s, 'a> {
    /// A resolver for what was read.
    pub(super) fn new(
        tree: &'s Tree<'a>,
        materials: &'s Materials<'a>,
        lights: &'s LightsAndCameras,
        controllers: &'s Controllers<'a>,
    ) -> Self {
        let mut morphs = FxHashMap::default();
        for (index, morph) in controllers.morph_targets.iter().enumerate() {
            let id = MorphId(index as u32);
            let arrays = morph.weights.iter().flat_map(|weights| weights.children().filter(El::is_element));
            for element in [Some(morph.controller), Some(morph.morph), morph.weights, morph.named].into_iter().flatten().chain(arrays) {
                morphs.entry(element.id()).or_insert(id);
            }
        }
        Self { tree, materials, lights, controllers, morphs, places: RefCell::default() }
    }

    /// What `address` names in the document of `from`.
    pub(super) fn find(&self, context: &mut Context<'a>, from: El<'a>, address: &str) -> Result<Aim, Miss> {
        let (element, member, rest_is_weights) =
            self.element(context, from, address.trim().trim_start_matches('#')).ok_or(Miss::Unknown)?;
        if let Some(morph) = self.morphs.get(&element.id()) {
            return self.weights(*morph, &member);
        }
        if rest_is_weights {
            return Err(Miss::Unknown);
        }
        let parent = element.parent().filter(El::is_element).ok_or(Miss::Unknown)?;
        if parent.tag_name().name() == "node" && is_transform(element.tag_name().name()) {
            return self.transform(parent, element, &member);
        }
        if element.ancestors().any(|above| above.tag_name().name() == "extra") {
            return Err(Miss::Unsupported);
        }
        if let Some(effect) = element.ancestors().find(|above| above.tag_name().name() == "effect") {
            return self.material(effect, element, &member);
        }
        if let Some(light) = element.ancestors().find(|above| above.tag_name().name() == "light")
            && element.tag_name().name() == "color"
        {
            let light = self.lights.light_of(light).ok_or(Miss::Unsupported)?;
            let (lane, wanted) = lane(&member, 3).ok_or(Miss::Unknown)?;
            return Ok(Aim {
                among: among(lane, wanted, 3),
                ..Aim::new(vec![ChannelTarget::LightColor { light, components: lane }], wanted)
            });
        }
        Err(Miss::Unsupported)
    }

    /// The element that an address names, what part of it, and whether a last step was skipped that only morph weights may have.
    fn element(&self, context: &mut Context<'a>, from: El<'a>, address: &str) -> Option<(El<'a>, Member, bool)> {
        let mut steps = address.split('/');
        let first = steps.next()?;
        let steps: Vec<&str> = steps.take(sinew_scene::limits::DEPTH).collect();
        let Some((last, middle)) = steps.split_last() else {
            return match context.lookup.by_id(from, first, &[]) {
                Some(element) => Some((element, Member::All, false)),
                None => {
                    let (id, member) = split_member(first);
                    Some((context.lookup.by_id(from, id, &[])?, member, false))
                }
            };
        };
        // Exporters give one id to a node and to what hangs on it; what is animated is the node, mostly.
        for tags in [&["node"][..], &["controller", "source", "effect", "material", "light", "camera"], &[]] {
            if let Some(start) = context.lookup.by_id(from, first, tags)
                && let Some(found) = self.below(context, self.tree.shown(start), middle, last)
            {
                return Some(found);
            }
        }
        // An id with slashes in it.
        let mut id = first.to_owned();
        for (taken, step) in middle.iter().enumerate().take(MOST_SLASHES) {
            id.push('/');
            id.push_str(step);
            if let Some(start) = context.lookup.by_id(from, &id, &["node"])
                && let Some(found) = self.below(context, start, middle.get(taken + 1..).unwrap_or_default(), last)
            {
                return Some(found);
            }
        }
        // A node that the file calls by its sid or its name, where only one goes by it.
        let start = self.tree.only_element(first)?;
        self.below(context, start, middle, last)
    }

    fn below(&self, context: &mut Context<'a>, start: El<'a>, middle: &[&str], last: &str) -> Option<(El<'a>, Member, bool)> {
        let mut element = middle.iter().try_fold(start, |element, sid| context.lookup.by_sid(element, sid))?;
        if element.tag_name().name() == "material" {
            let instance = super::context::child(element, "instance_effect")?;
            element = context.follow(instance, "url", &["effect"])?;
        }
        if let Some(found) = context.lookup.by_sid(element, last) {
            return Some((found, Member::All, false));
        }
        let (sid, member) = split_member(last);
        if let Some(found) = context.lookup.by_sid(element, sid) {
            return Some((found, member, false));
        }
        if self.morphs.contains_key(&element.id()) {
            return Some((element, member, true));
        }
        // Without a sid the tag of the only transform of its kind will do, and `transform`, as most exporters call it, for the only matrix.
        let tag = if sid == "transform" { "matrix" } else { sid };
        let mut same = element.children().filter(|child| is_transform(tag) && child.tag_name().name() == tag);
        match (same.next(), same.next()) {
            (Some(only), None) => Some((only, member, false)),
            _ => None,
        }
    }

    fn weights(&self, morph: MorphId, member: &Member) -> Result<Aim, Miss> {
        let count = self.controllers.morph_targets.get(morph.index()).map_or(0, |targets| targets.count);
        let (targets, wanted) = match member {
            Member::Index(target) if *target < count => (vec![ChannelTarget::MorphWeight { morph, target: *target as u32 }], 1),
            Member::All if count > 0 => ((0..count as u32).map(|target| ChannelTarget::MorphWeight { morph, target }).collect(), count),
            _ => return Err(Miss::Unknown),
        };
        let among = if let Member::Index(index) = member { Some((*index, count)) } else { None };
        Ok(Aim { among, ..Aim::new(targets, wanted) })
    }

    fn transform(&self, node: El<'a>, element: El<'a>, member: &Member) -> Result<Aim, Miss> {
        let known = self.places.borrow().get(&element.id()).copied();
        let place = known.or_else(|| {
            let mut places = self.places.borrow_mut();
            let transforms = node.children().filter(|child| is_transform(child.tag_name().name()));
            places.extend(transforms.map(|child| child.id()).zip(0..));
            places.get(&element.id()).copied()
        });
        let place = place.ok_or(Miss::Unknown)?;
        let tag = element.tag_name().name();
        let size = match tag {
            "matrix" => 16,
            "rotate" => 4,
            "lookat" => 9,
            "skew" => 7,
            _ => 3,
        };
        let (lane, wanted) = match (tag, member) {
            // Column, then row: `matrix(3)(0)` is x translation.
            ("matrix", Member::Cell(column, row)) if *column < 4 && *row < 4 => (Components::Component((column * 4 + row) as u8), 1),
            // One index counts along the text, which goes row by row.
            ("matrix", Member::Index(index)) if *index < 16 => (Components::Component((index % 4 * 4 + index / 4) as u8), 1),
            ("matrix", Member::All) => (Components::Whole, 16),
            ("matrix", _) => return Err(Miss::Unknown),
            _ => lane(member, size).ok_or(Miss::Unknown)?,
        };
        let nodes = self.tree.nodes_of(node);
        if nodes.is_empty() {
            return Err(Miss::Unknown);
        }
        let lone = (tag == "rotate" && wanted == 4).then_some(Components::Component(3));
        let target =
            |node: &sinew_scene::NodeId| ChannelTarget::Transform { node: *node, op: place + self.tree.lead(*node), components: lane };
        let among = match lane {
            // Keys that hold whole matrices go row by row, as the text does.
            Components::Component(cell) if tag == "matrix" => Some((usize::from(cell % 4 * 4 + cell / 4), 16)),
            lane => among(lane, wanted, size),
        };
        Ok(Aim { matrix: wanted == 16, lone, among, ..Aim::new(nodes.iter().map(target).collect(), wanted) })
    }

    fn material(&self, effect: El<'a>, element: El<'a>, member: &Member) -> Result<Aim, Miss> {
        let made = self.materials.made_by(effect);
        let owner = element.ancestors().find(|above| above.tag_name().name() == "newparam");
        let (mut targets, mut wanted, mut line, mut part, mut encode) = (Vec::new(), 0, None, None, false);
        for made in made {
            let slot = match owner {
                Some(param) => param.attribute("sid").and_then(|sid| made.effect.slot_of_param(sid)),
                None => element.ancestors().map(|above| above.tag_name().name()).find(|tag| slot_of(tag).is_some()),
            };
            let Some(mut slot) = slot.and_then(slot_of) else { continue };
            let size = if matches!(slot, MaterialSlot::Shininess | MaterialSlot::Opacity) { 1 } else { 4 };
            // The alpha of a colour is read and dropped.
            let (lane, numbers) = lane(member, size).ok_or(Miss::Unknown)?;
            (wanted, part) = (numbers, among(lane, numbers, size));
            encode = size == 4 && asset::is_scene_linear(effect);
            if slot == MaterialSlot::Opacity {
                slot = made.opacity.slot;
                line = Some(made.opacity.line);
            }
            targets.push(ChannelTarget::Material { material: made.material, slot, components: lane });
        }
        if targets.is_empty() { Err(Miss::Unsupported) } else { Ok(Aim { line, encode, among: part, ..Aim::new(targets, wanted) }) }
    }
}

fn slot_of(tag: &str) -> Option<MaterialSlot> {
    Some(match tag {
        "diffuse" => MaterialSlot::Diffuse,
        "emission" => MaterialSlot::Emission,
        "ambient" => MaterialSlot::Ambient,
        "specular" => MaterialSlot::Specular,
        "shininess" => MaterialSlot::Shininess,
        "transparency" => MaterialSlot::Opacity,
        _ => return None,
    })
}

/// [`Aim::among`] for one number of a value of `size`.
fn among(lane: Components, wanted: usize, size: usize) -> Option<(usize, usize)> {
    match lane {
        Components::Component(index) if wanted == 1 && size > 1 => Some((usize::from(index), size)),
        _ => None,
    }
}

/// The lane of a member in a value of `size` numbers, and how many numbers its keys have.
fn lane(member: &Member, size: usize) -> Option<(Components, usize)> {
    let index = match member {
        Member::All => return Some((Components::Whole, size)),
        Member::Index(index) => *index,
        Member::Cell(..) => return None,
        Member::Name(name) => match name.to_ascii_uppercase().as_str() {
            "X" | "R" | "U" | "S" => 0,
            "Y" | "G" | "V" | "T" => 1,
            "Z" | "B" | "P" => 2,
            "ANGLE" | "A" | "W" | "Q" => 3,
            _ => return None,
        },
    };
    (index < size).then_some((Components::Component(index as u8), 1))
}

/// Cuts `.X`, `(i)` or `(i)(j)` from the end of a step.
fn split_member(step: &str) -> (&str, Member) {
    if let Some(open) = step.find('(') {
        let (name, tail) = step.split_at(open);
        let mut indices = tail.split(['(', ')']).map(str::trim).filter(|part| !part.is_empty()).map(|part| part.parse::<usize>());
        match (indices.next(), indices.next(), indices.next()) {
            (Some(Ok(index)), None, None) => return (name, Member::Index(index)),
            (Some(Ok(column)), Some(Ok(row)), None) => return (name, Member::Cell(column, row)),
            _ => return (step, Member::All),
        }
    }
    match step.rsplit_once('.') {
        Some((name, member)) => (name, Member::Name(member.to_owned())),
        None => (step, Member::All),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn members_are_cut_from_the_end() {
        assert_eq!(split_member("rotateX.ANGLE"), ("rotateX", Member::Name("ANGLE".into())));
        assert_eq!(split_member("matrix(3)(0)"), ("matrix", Member::Cell(3, 0)));
        assert_eq!(split_member("weights( 2 )"), ("weights", Member::Index(2)));
        assert_eq!(split_member("transform"), ("transform", Member::All));
        assert_eq!(split_member("odd(x)"), ("odd(x)", Member::All));
        assert_eq!(split_member("a(1)(2)(3)"), ("a(1)(2)(3)", Member::All));
    }

    #[test]
    fn lanes_follow_the_names_of_the_format() {
        for (name, size, index) in [("X", 3, 0), ("Z", 3, 2), ("ANGLE", 4, 3), ("A", 4, 3), ("V", 3, 1), ("g", 3, 1)] {
            assert_eq!(lane(&Member::Name(name.into()), size), Some((Components::Component(index), 1)), "{name}");
        }
        assert_eq!(lane(&Member::Name("ANGLE".into()), 3), None);
        assert_eq!(lane(&Member::Index(9), 9), None);
        assert_eq!(lane(&Member::All, 9), Some((Components::Whole, 9)));
    }
}

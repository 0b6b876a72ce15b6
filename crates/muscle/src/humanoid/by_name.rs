//! Limbs by the names of their bones.
//!
//! The bone below elbow or knee is named most plainly, so it is sought first; the joints above and below it follow along the chain, by name where names tell,
//! else as the nearest bones that begin elsewhere.

use super::super::bone_name_heuristics::{BodyPart, BoneNameMatch, Side, names};
use super::tree::{BoneTree, are_apart};
use super::{FoundLimbs, Limb};
use sinew_scene::{NodeId, NodeKind};

/// A side of a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BodySide {
    /// The figure's left.
    Left,
    /// The figure's right.
    Right,
}

impl BodySide {
    /// Both, in the order of pairs.
    pub const BOTH: [Self; 2] = [Self::Left, Self::Right];
}

/// What a limb's bones are called, from the trunk outward.
struct LimbNames {
    upper: BodyPart,
    lower: BodyPart,
    end: BodyPart,
    tip: Option<BodyPart>,
}

const ARM: LimbNames = LimbNames { upper: BodyPart::UpperArm, lower: BodyPart::Forearm, end: BodyPart::Hand, tip: None };
const LEG: LimbNames = LimbNames { upper: BodyPart::Thigh, lower: BodyPart::Shin, end: BodyPart::Foot, tip: Some(BodyPart::Toes) };

/// The rank of a bare “leg” among the words of a shin.
const BARE_LEG: usize = 2;

pub(super) fn find(tree: &BoneTree<'_>, bones: &[NodeId]) -> FoundLimbs {
    let sides = [Some(Side::Left), Some(Side::Right)];
    let mut arms = sides.map(|side| limb(tree, bones, &ARM, side));
    let mut legs = sides.map(|side| limb(tree, bones, &LEG, side));
    let one_arm = limb(tree, bones, &ARM, None);
    let has_one_arm = arms.iter().all(Limb::is_empty) && !one_arm.is_empty();
    if has_one_arm {
        arms[1] = one_arm;
    }
    without_trunk(tree, &mut arms);
    without_trunk(tree, &mut legs);
    // Both legs are on one pelvis, whatever bones lie between.
    if let [Some(left), Some(right)] = legs.map(|leg| leg.bones[0]) {
        let pelvis = tree.common(left, right).filter(|id| tree.is_bone(*id));
        legs.iter_mut().for_each(|leg| leg.girdle = pelvis);
    }
    FoundLimbs { arms, legs, has_one_arm }
}

/// Takes away the root of a limb that carries the other limb too: that is the trunk, and the limb's own root is not there.
fn without_trunk(tree: &BoneTree<'_>, pair: &mut [Limb; 2]) {
    let lower = pair.map(|limb| limb.bones[1]);
    for (limb, other) in pair.iter_mut().zip([lower[1], lower[0]]) {
        if let (Some(root), Some(other)) = (limb.bones[0], other)
            && tree.ancestors(other).any(|above| above == root)
        {
            (limb.girdle, limb.bones[0]) = (None, None);
        }
    }
}

/// What the names of a node say about a part.
fn named(tree: &BoneTree<'_>, id: NodeId, part: BodyPart) -> Option<BoneNameMatch> {
    let node = tree.graph.node(id);
    [&node.name, &node.id, &node.sid].into_iter().filter_map(|name| names(name, part)).min_by_key(|found| found.rank)
}

fn limb(tree: &BoneTree<'_>, bones: &[NodeId], of: &LimbNames, side: Option<Side>) -> Limb {
    let is = |id: NodeId, part: BodyPart| named(tree, id, part).filter(|found| !found.helper && found.side == side);
    // Whether a bone is below one that is named as the upper part; parents come before their children.
    let mut below_upper = vec![false; tree.graph.len()];
    if of.lower == BodyPart::Shin {
        for id in bones {
            let parent = tree.graph.node(*id).parent();
            let below = parent.is_some_and(|parent| below_upper.get(parent.index()) == Some(&true) || is(parent, of.upper).is_some());
            if let Some(slot) = below_upper.get_mut(id.index()) {
                *slot = below;
            }
        }
    }
    let rank_of = |id: NodeId| {
        let rank = is(id, of.lower)?.rank;
        (of.lower != BodyPart::Shin || rank < BARE_LEG || below_upper.get(id.index()) == Some(&true)).then_some(rank)
    };
    let leads_on = |id: NodeId| tree.longest_way(id).any(|below| are_apart(tree.place(below), tree.place(id)));
    let lower = bones
        .iter()
        .filter_map(|id| Some((rank_of(*id)?, *id)))
        .min_by_key(|(rank, id)| (!leads_on(*id), *rank, is_original(tree, *id), tree.depth(*id), id.0))
        .map(|(_, id)| id);
    let Some(lower) = lower else {
        // What is there is told apart from what is not.
        let uppers = bones.iter().filter_map(|id| Some((is(*id, of.upper)?.rank, tree.depth(*id), *id)));
        let upper = uppers.min().map(|(.., id)| id);
        return Limb { girdle: upper.and_then(|upper| girdle_of(tree, upper)), bones: [upper, None, None, None] };
    };
    let upper = upper_of(tree, lower, |id| is(id, of.upper)).or_else(|| tree.bone_above_apart(lower));
    let below = tree.bones_below(lower);
    let begins_elsewhere = |id: &NodeId| are_apart(tree.place(*id), tree.place(lower));
    let end = below.iter().copied().filter(begins_elsewhere).find(|id| is(*id, of.end).is_some()).or_else(|| {
        let far = |id: &NodeId| tree.place(*id).distance(tree.place(lower));
        let next = tree.graph.node(lower).children().iter().copied().filter(|id| tree.is_bone(*id) && begins_elsewhere(id));
        next.max_by(|a, b| far(a).total_cmp(&far(b)))
    });
    let tip = end.zip(of.tip).and_then(|(end, tip)| {
        let there = |id: &NodeId| is(*id, tip).is_some() && are_apart(tree.place(*id), tree.place(end));
        tree.bones_below(end).into_iter().find(there)
    });
    Limb { girdle: upper.and_then(|upper| girdle_of(tree, upper)), bones: [upper, Some(lower), end, tip] }
}

/// Whether a bone is the original that others copy, which carries no skin: Rigify's `ORG-` bones.
fn is_original(tree: &BoneTree<'_>, id: NodeId) -> bool {
    tree.graph.node(id).name.contains("ORG-")
}

/// Of the bones above that are named so, the surest, and of several of these the one that begins the limb.
fn upper_of(tree: &BoneTree<'_>, lower: NodeId, is: impl Fn(NodeId) -> Option<BoneNameMatch>) -> Option<NodeId> {
    let named = tree.bones_above(lower).filter(|id| are_apart(tree.place(*id), tree.place(lower)));
    let ranked = named.filter_map(|id| Some((is(id)?.rank, id)));
    // The first of equals is the nearest; the last is wanted.
    ranked.reduce(|best, next| if next.0 <= best.0 { next } else { best }).map(|(_, id)| id)
}

/// What carries the root of a limb: the bone above it; where there is none the node above it that has a name.
fn girdle_of(tree: &BoneTree<'_>, upper: NodeId) -> Option<NodeId> {
    let parent = tree.bones_above(upper).next();
    let node = || tree.ancestors(upper).find(|id| tree.graph.node(*id).kind == NodeKind::Node && !tree.graph.node(*id).name.is_empty());
    parent.or_else(node)
}

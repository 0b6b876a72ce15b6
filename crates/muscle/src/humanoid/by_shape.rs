//! Limbs by the shape of the tree of bones in the rest pose, for rigs whose names tell nothing.
//!
//! A pair of limbs is two chains that leave the trunk at one bone, or at two neighbours, and are as long as each other. The longest two pairs are legs and arms:
//! the legs are those whose ends are farther from the head's end of the trunk. In a chain the joints are where its two longest segments in a row begin and end.

use glam::DVec3;

use super::body_axes::front_told;
use super::tree::{BoneTree, are_apart};
use super::{FoundLimbs, Limb, middle};
use sinew_scene::NodeId;

/// Two limbs of a pair differ in length by less than this share.
const ALIKE: f64 = 0.03;
/// A segment of a limb is at least this share of the one beside it.
const LEAST_SEGMENT: f64 = 0.4;

/// A chain of bones that begin at different places.
type Chain = Vec<NodeId>;

struct Pair {
    /// The bone of the trunk.
    trunk: NodeId,
    chains: [Chain; 2],
    length: f64,
}

pub(super) fn find(tree: &BoneTree<'_>, bones: &[NodeId]) -> Option<FoundLimbs> {
    let mut pairs: Vec<Pair> = bones.iter().filter_map(|id| pair_at(tree, *id)).collect();
    pairs.sort_by(|a, b| b.length.total_cmp(&a.length).then(a.trunk.cmp(&b.trunk)));
    let mut limbs: Vec<(NodeId, [Limb; 2])> = Vec::new();
    for pair in &pairs {
        let inside = |id: &NodeId| limbs.iter().any(|(_, known)| known.iter().any(|limb| holds(tree, limb, *id)));
        if inside(&pair.trunk) {
            continue;
        }
        if let [Some(one), Some(other)] = [0, 1].map(|side| limb_of(tree, pair.trunk, pair.chains.get(side)?)) {
            limbs.push((pair.trunk, [one, other]));
        }
    }
    let [(trunk_a, a), (trunk_b, b)] = <[_; 2]>::try_from(limbs.into_iter().take(2).collect::<Vec<_>>()).ok()?;
    // The trunk leads from the pelvis up; where neither is above the other, legs reach lower.
    let low = |pair: &[Limb; 2]| pair.iter().filter_map(|limb| limb.bones[2]).map(|id| tree.place(id).y).fold(f64::INFINITY, f64::min);
    let above = tree.common(trunk_a, trunk_b).filter(|_| trunk_a != trunk_b);
    let a_is_legs = above == Some(trunk_a) || above != Some(trunk_b) && low(&a) < low(&b);
    let (mut legs, arms, pelvis) = if a_is_legs { (a, b, trunk_a) } else { (b, a, trunk_b) };
    legs.iter_mut().for_each(|leg| leg.girdle = Some(pelvis));
    let right = right_of(tree, &legs, &arms)?;
    Some(FoundLimbs { arms: sided(tree, arms, right), legs: sided(tree, legs, right), has_one_arm: false })
}

/// Whether a node is part of a limb.
fn holds(tree: &BoneTree<'_>, limb: &Limb, id: NodeId) -> bool {
    limb.bones[0].is_some_and(|root| root == id || tree.ancestors(id).any(|above| above == root))
}

/// The two longest chains of equal length that leave the trunk at a bone.
fn pair_at(tree: &BoneTree<'_>, trunk: NodeId) -> Option<Pair> {
    let children = tree.graph.node(trunk).children().iter().copied().filter(|id| tree.is_bone(*id));
    let mut children: Vec<(f64, NodeId)> = children.map(|child| (tree.longest_below(child), child)).collect();
    children.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    children.windows(2).find_map(|two| {
        let [(length, one), (other_length, other)] = *<&[(f64, NodeId); 2]>::try_from(two).ok()?;
        if length - other_length > ALIKE * length {
            return None;
        }
        let chains = [one, other].map(|child| chain_below(tree, child));
        let [a, b] = &chains;
        let differ = |first: Option<&NodeId>, second: Option<&NodeId>| {
            first.zip(second).is_some_and(|(first, second)| are_apart(tree.place(*first), tree.place(*second)))
        };
        let is_pair = a.len() == b.len() && a.len() > 2 && (differ(a.first(), b.first()) || differ(a.last(), b.last()));
        is_pair.then_some(Pair { trunk, chains, length })
    })
}

/// The longest way down from a bone; bones that begin at one place count once.
fn chain_below(tree: &BoneTree<'_>, from: NodeId) -> Chain {
    let mut chain: Chain = tree.longest_way(from).collect();
    chain.dedup_by(|later, earlier| !are_apart(tree.place(*later), tree.place(*earlier)));
    chain
}

/// The joints of a chain: its two longest segments in a row that are alike.
fn limb_of(tree: &BoneTree<'_>, trunk: NodeId, chain: &Chain) -> Option<Limb> {
    let length = |a: NodeId, b: NodeId| tree.place(a).distance(tree.place(b));
    let best = chain
        .windows(3)
        .enumerate()
        .filter_map(|(at, three)| {
            let [a, b, c] = *<&[NodeId; 3]>::try_from(three).ok()?;
            let (upper, lower) = (length(a, b), length(b, c));
            (upper.min(lower) >= LEAST_SEGMENT * upper.max(lower)).then_some((upper + lower, at))
        })
        .max_by(|a, b| a.0.total_cmp(&b.0))?
        .1;
    let bone = |number: usize| chain.get(best + number).copied();
    let girdle = if best == 0 { Some(trunk) } else { chain.get(best - 1).copied() };
    Some(Limb { girdle, bones: [bone(0), bone(1), bone(2), bone(3)] })
}

/// Where the right is, from the way that the feet point, else from the way that knees bend; toward −X, as figures look along +Z, where neither tells.
fn right_of(tree: &BoneTree<'_>, legs: &[Limb; 2], arms: &[Limb; 2]) -> Option<DVec3> {
    let roots = |pair: &[Limb; 2]| -> Option<[DVec3; 2]> { Some([tree.place(pair[0].bones[0]?), tree.place(pair[1].bones[0]?)]) };
    let (hips, shoulders) = (roots(legs)?, roots(arms)?);
    let up = (middle(shoulders) - middle(hips)).try_normalize().unwrap_or(DVec3::Y);
    let across = (hips[1] - hips[0]).try_normalize()?;
    let front = across.cross(up).try_normalize()?;
    let told = front_told(tree, legs, front).unwrap_or(front.z);
    // x to the front, y up, z to the right.
    let right = front.cross(up);
    Some(if told >= 0.0 { right } else { -right })
}

/// The pair with the left limb first.
fn sided(tree: &BoneTree<'_>, pair: [Limb; 2], right: DVec3) -> [Limb; 2] {
    let along = |limb: &Limb| limb.bones[0].map_or(0.0, |id| tree.place(id).dot(right));
    let [a, b] = pair;
    if along(&a) <= along(&b) { [a, b] } else { [b, a] }
}

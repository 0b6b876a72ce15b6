//! `skin`: joints, inverse bind matrices, weights.

use std::collections::HashMap;

use glam::DMat4;

use super::context::{Context, ReadResult, child, ends_upright, from_rows, name_of};
use super::nodes::{Key, Tree};
use super::source::{Arrays, Input, NameKind, inputs, name_list};
use super::{El, Finding};
use sinew_scene::{Graph, Influence, NodeId, Skin, SkinJoint};

/// What the joints of a skin are called.
pub(super) struct JointNames {
    /// How the names are looked up.
    pub kind: NameKind,
    /// Which of the joints any point is weighted to.
    pub used: Vec<bool>,
}

/// How far the weights of a point may be from 1 in sum without a word: six printed digits and a handful of influences stay well below.
const SUM_TOLERANCE: f64 = 1e-3;

/// Reads a `skin` element over a mesh of `points` points.
///
/// # Errors
/// Where commas separate its numbers.
pub(super) fn read<'a>(
    context: &mut Context<'a>,
    arrays: &mut Arrays<f64>,
    tree: &Tree<'a>,
    element: El<'a>,
    points: usize,
) -> ReadResult<Option<(Skin, JointNames)>> {
    let controller = element.parent().filter(El::is_element).unwrap_or(element);
    let mut skin = Skin {
        name: name_of(controller),
        id: controller.attribute("id").unwrap_or_default().to_owned(),
        bind_shape: DMat4::IDENTITY,
        ..Skin::default()
    };
    if let Some(matrix) = child(element, "bind_shape_matrix") {
        skin.bind_shape = context.matrix(matrix)?.unwrap_or(DMat4::IDENTITY);
    }
    let Some(weights) = child(element, "vertex_weights") else {
        context.report.report(element, Finding::SkinWithout("vertex_weights".to_owned()));
        return Ok(None);
    };
    let Some(kind) = joints(context, arrays, tree, element, weights, &mut skin)? else { return Ok(None) };
    let order = own_order(context, element, weights, &skin);
    influences(context, arrays, weights, points, order.as_deref(), &mut skin)?;
    let mut used = vec![false; skin.joints.len()];
    for influence in &skin.influences {
        if let Some(used) = usize::try_from(influence.joint).ok().and_then(|joint| used.get_mut(joint)) {
            *used = true;
        }
    }
    Ok(Some((skin, JointNames { kind, used })))
}

/// Reads the joints; `None`, reported, where there are none.
fn joints<'a>(
    context: &mut Context<'a>,
    arrays: &mut Arrays<f64>,
    tree: &Tree<'a>,
    element: El<'a>,
    weights: El<'a>,
    skin: &mut Skin,
) -> ReadResult<Option<NameKind>> {
    let (mut names, mut matrices) = (None, None);
    let own = child(element, "joints").map(inputs).unwrap_or_default();
    for input in own.iter().chain(&inputs(weights)) {
        match input.semantic {
            "JOINT" if names.is_none() => names = context.follow(input.element, "source", &["source"]),
            "INV_BIND_MATRIX" => matrices = context.follow(input.element, "source", &["source"]),
            _ => {}
        }
    }
    let list = match names {
        Some(source) => name_list(context, source),
        None => None,
    };
    let Some(list) = list else {
        context.report.report(element, Finding::SkinWithout("JOINT".to_owned()));
        return Ok(None);
    };
    let matrices = match matrices {
        Some(source) => arrays.accessor(context, source, 16)?.filter(|matrices| matrices.width() == 16),
        None => None,
    };
    let mut names: Vec<String> = list.entries().map(ToOwned::to_owned).collect();
    // Without matrices the accessor tells where names have blanks in them.
    let said = list.said.filter(|said| *said < names.len());
    // An array may hold the matrices of several skins, and its own count may lie; the accessor's is believed where the names agree with it.
    let count = match &matrices {
        Some(matrices) if matrices.said == Some(names.len()) && matrices.available >= names.len() => names.len(),
        Some(matrices) if matrices.count == names.len() => matrices.count,
        Some(matrices) => matrices.available,
        None => said.unwrap_or(names.len()),
    };
    if matrices.is_none() {
        context.report.report(element, Finding::SkinWithoutInverseBind);
    }
    if names.len() > count
        && let Some(joined) = rejoin(&names, count, |name| tree.knows(name))
    {
        names = joined;
        context.report.report(element, Finding::JointNamesRejoined);
    }
    if names.len() != count {
        context.report.report(element, Finding::JointCountMismatch { names: names.len(), matrices: count });
        // A matrix that has no name moves nothing.
        names.truncate(count);
    }
    let (mut bad, mut tilted) = (false, false);
    for (i, name) in names.into_iter().enumerate() {
        let rows = matrices.as_ref().map(|matrices| matrices.row(i, [0.0; 16]));
        let inverse_bind = match rows {
            Some(rows) if rows.iter().all(|value| value.is_finite()) => {
                tilted |= !ends_upright(&rows);
                from_rows(&rows)
            }
            Some(_) => {
                bad = true;
                DMat4::IDENTITY
            }
            None => DMat4::IDENTITY,
        };
        skin.joints.push(SkinJoint { name, inverse_bind });
    }
    if bad {
        context.report.report(element, Finding::NotFinite);
    }
    if tilted {
        context.report.report(element, Finding::BottomRow);
    }
    Ok(Some(list.kind))
}

/// The joints of the skin in the order in which the weights count them, where they name a source of their own that has another order.
fn own_order<'a>(context: &mut Context<'a>, element: El<'a>, weights: El<'a>, skin: &Skin) -> Option<Vec<i32>> {
    let source = |inputs: &[Input<'a>]| {
        let joint = inputs.iter().find(|input| input.semantic == "JOINT")?;
        Some((joint.element, joint.element.attribute("source")?))
    };
    let (_, first) = source(&inputs(child(element, "joints")?))?;
    let (from, own) = source(&inputs(weights)).filter(|(_, own)| *own != first)?;
    let own = context.resolve(from, own, &["source"])?;
    let list = name_list(context, own)?;
    let mut places: HashMap<&str, i32> = HashMap::new();
    for (place, joint) in (0..).zip(&skin.joints) {
        places.entry(&joint.name).or_insert(place);
    }
    let names: Vec<String> = list.entries().map(ToOwned::to_owned).collect();
    let names = match rejoin(&names, skin.joints.len(), |name| places.contains_key(name)) {
        Some(joined) => joined,
        None => names,
    };
    // A list that names others than the skin has is of no use: then the places are those of the skin.
    names.iter().map(|name| places.get(name.as_str()).copied()).collect()
}

/// Names with blanks in them were cut at the blanks: puts `parts` together into `count` names so that as many as possible are known.
///
/// Dynamic programming over (parts used, names made); the cost of a name is 0 where it is known, 1 for a single unknown part, and more than all of
/// these for a run of parts that nobody knows. `None` where no way gives `count` names.
fn rejoin(parts: &[String], count: usize, known: impl Fn(&str) -> bool) -> Option<Vec<String>> {
    /// Most blanks that are expected in one name, plus one.
    const LONGEST: usize = 8;
    let extra = parts.len().checked_sub(count)?;
    if count == 0 || parts.len().checked_mul(extra + 1)? > 4_000_000 {
        return None;
    }
    let unknown_run = parts.len() as u32 + 1;
    // Indexed by parts used, and by how many of the extra blanks were taken into names.
    let width = extra + 1;
    let mut best = vec![(u32::MAX, 0usize); (parts.len() + 1) * width];
    if let Some(start) = best.first_mut() {
        start.0 = 0;
    }
    let mut name = String::new();
    for from in 0..parts.len() {
        name.clear();
        for length in 1..=LONGEST.min(parts.len() - from).min(width) {
            if length > 1 {
                name.push(' ');
            }
            name.push_str(parts.get(from + length - 1)?);
            let cost = match (known(&name), length) {
                (true, _) => 0,
                (false, 1) => 1,
                (false, _) if known(&name.replace(' ', "_")) => 0,
                // Names that all stand for themselves were not cut out of one.
                (false, length) if parts.get(from..from + length)?.iter().all(|part| known(part)) => continue,
                (false, length) => unknown_run * length as u32,
            };
            for taken in 0..width - (length - 1) {
                let so_far = best.get(from * width + taken)?.0;
                let slot = best.get_mut((from + length) * width + taken + length - 1)?;
                if so_far != u32::MAX && so_far.saturating_add(cost) < slot.0 {
                    *slot = (so_far.saturating_add(cost), length);
                }
            }
        }
    }
    let (mut at, mut taken) = (parts.len(), extra);
    let mut names = Vec::with_capacity(count);
    while at > 0 {
        let (cost, length) = *best.get(at * width + taken)?;
        if cost == u32::MAX {
            return None;
        }
        let spaced = parts.get(at - length..at)?.join(" ");
        let scored = spaced.replace(' ', "_");
        names.push(if !known(&spaced) && known(&scored) { scored } else { spaced });
        at -= length;
        taken -= length - 1;
    }
    names.reverse();
    Some(names)
}

/// Reads the weights of all points.
///
/// With `order`, joint i of the weights is joint `order[i]` of the skin.
fn influences<'a>(
    context: &mut Context<'a>,
    arrays: &mut Arrays<f64>,
    element: El<'a>,
    points: usize,
    order: Option<&[i32]>,
    skin: &mut Skin,
) -> ReadResult<()> {
    let inputs = inputs(element);
    let find = |semantic| inputs.iter().find(|input| input.semantic == semantic);
    let (joint_at, weight_at) = (find("JOINT").map(|input| input.offset), find("WEIGHT").map(|input| input.offset));
    let weight_source = match find("WEIGHT") {
        Some(input) => context.follow(input.element, "source", &["source"]),
        None => None,
    };
    let weights = match weight_source {
        Some(source) => arrays.accessor(context, source, 1)?,
        None => None,
    };
    let (Some(joint_at), Some(weight_at), Some(weights)) = (joint_at, weight_at, weights) else {
        context.report.report(element, Finding::SkinWithoutWeights);
        skin.offsets = vec![0; points + 1];
        return Ok(());
    };
    let stride = inputs.iter().map(|input| input.offset.saturating_add(1)).max().unwrap_or(2);
    let counts = match child(element, "vcount") {
        Some(counts) => context.integers(counts)?,
        None => Vec::new(),
    };
    let pairs = match child(element, "v") {
        Some(pairs) => context.integers(pairs)?,
        None => Vec::new(),
    };
    if counts.len() != points {
        context.report.report(element, Finding::SkinPointsMismatch { found: counts.len(), wanted: points });
    }
    let mut pairs = pairs.chunks_exact(stride);
    let (mut out_of_range, mut not_finite, mut unnormalised, mut missing) = (0, 0, 0, 0usize);
    skin.offsets.push(0);
    for count in counts.iter().take(points) {
        let start = skin.influences.len();
        let mut sum = 0.0;
        let count = usize::try_from(*count).unwrap_or(0);
        for taken in 0..count {
            let Some(pair) = pairs.next() else {
                missing = missing.saturating_add(count - taken);
                break;
            };
            let joint = pair.get(joint_at).copied().unwrap_or(i32::MIN);
            let weight = pair.get(weight_at).and_then(|index| usize::try_from(*index).ok()).and_then(|index| weights.get(index, 0));
            let joint = match (order, usize::try_from(joint)) {
                (Some(order), Ok(place)) => order.get(place).copied().unwrap_or(i32::MIN),
                _ => joint,
            };
            let known = joint == -1 || usize::try_from(joint).is_ok_and(|joint| joint < skin.joints.len());
            match weight {
                Some(weight) if known && weight.is_finite() => {
                    sum += weight;
                    skin.influences.push(Influence { joint, weight: weight as f32 });
                }
                Some(_) if known => not_finite += 1,
                _ => out_of_range += 1,
            }
        }
        let own = skin.influences.len() - start;
        if own > 0 && (sum - 1.0).abs() > SUM_TOLERANCE {
            unnormalised += 1;
        }
        if sum.abs() < 1e-9 {
            // Weights of nothing move nothing: as if there were none.
            skin.influences.truncate(start);
        } else if let Some(own) = skin.influences.get_mut(start..) {
            for influence in own {
                influence.weight = (f64::from(influence.weight) / sum) as f32;
            }
        }
        skin.offsets.push(u32::try_from(skin.influences.len()).unwrap_or(u32::MAX));
    }
    let last = skin.offsets.last().copied().unwrap_or(0);
    skin.offsets.resize(points + 1, last);
    if out_of_range > 0 {
        context.report.report(element, Finding::InfluencesOutOfRange(out_of_range));
    }
    if not_finite > 0 {
        context.report.report(element, Finding::WeightsNotFinite(not_finite));
    }
    if missing > 0 {
        context.report.report(element, Finding::InfluencesMissing(missing));
    }
    if unnormalised > 0 {
        context.report.report(element, Finding::WeightsNotNormalised(unnormalised));
    }
    Ok(())
}

/// Finds the nodes of a skin's joints for one instance.
pub(super) struct JointFinder<'f, 'a> {
    /// The nodes.
    pub tree: &'f Tree<'a>,
    /// The graph.
    pub graph: &'f Graph,
    /// The node that holds the instance.
    pub instance: NodeId,
    /// The nodes that the instance's `skeleton` elements name.
    pub roots: &'f [NodeId],
}

impl JointFinder<'_, '_> {
    /// Where a search of the whole scene starts: at the skeleton, else at the instance.
    fn near(&self) -> NodeId {
        self.roots.first().copied().unwrap_or(self.instance)
    }

    /// The node of each joint.
    pub(super) fn find_all(&self, skin: &Skin, kind: NameKind) -> Vec<Option<NodeId>> {
        let mut found: HashMap<&str, Option<NodeId>> = HashMap::new();
        skin.joints.iter().map(|joint| *found.entry(&joint.name).or_insert_with(|| self.find(&joint.name, kind))).collect()
    }

    fn find(&self, name: &str, kind: NameKind) -> Option<NodeId> {
        let by_sid = || self.roots.iter().find_map(|root| self.tree.sid_below(*root, name));
        let by_id = || self.roots.iter().find_map(|root| self.tree.id_below(*root, name));
        // Meshes are called as bones are ("Head"): a bone comes first, and the mesh that it moves last.
        let skin = Some(self.instance).filter(|node| kind == NameKind::Name && !self.tree.is_joint(*node));
        let anywhere = |key| self.tree.anywhere(self.graph, self.near(), key, name, skin);
        let itself = || [Key::Sid, Key::Id, Key::Name].iter().find_map(|key| self.tree.anywhere(self.graph, self.near(), *key, name, None));
        match kind {
            _ if name.is_empty() => None,
            NameKind::Name => by_sid().or_else(|| anywhere(Key::Sid)).or_else(by_id).or_else(|| anywhere(Key::Id)),
            NameKind::IdRef => by_id().or_else(|| anywhere(Key::Id)).or_else(by_sid).or_else(|| anywhere(Key::Sid)),
            NameKind::SidRef => self.path(name),
        }
        .or_else(|| anywhere(Key::Name))
        .or_else(itself)
        // Some write references as urls.
        .or_else(|| name.strip_prefix('#').map(|id| id.trim_start_matches('#')).and_then(|id| self.find(id, NameKind::IdRef)))
    }

    /// `id/sid/sid`, or a lone sid.
    fn path(&self, path: &str) -> Option<NodeId> {
        let mut segments = path.split('/');
        let first = segments.next().unwrap_or_default();
        let start = self.tree.anywhere(self.graph, self.near(), Key::Id, first, None).or_else(|| self.find(first, NameKind::Name));
        segments.try_fold(start?, |node, sid| self.tree.sid_below(node, sid))
    }
}

#[cfg(test)]
mod tests {
    use super::rejoin;

    fn joined(parts: &str, count: usize, known: &[&str]) -> Option<Vec<String>> {
        let parts: Vec<String> = parts.split(' ').map(ToOwned::to_owned).collect();
        rejoin(&parts, count, |name| known.contains(&name))
    }

    #[test]
    fn names_cut_at_blanks_are_put_together_as_the_nodes_know_them() {
        let known = ["Bip01", "Bip01 Head", "Bip01 L Hand", "Tail"];
        assert_eq!(
            joined("Bip01 Bip01 Head Tail Bip01 L Hand", 4, &known).unwrap_or_default(),
            ["Bip01", "Bip01 Head", "Tail", "Bip01 L Hand"]
        );
        assert_eq!(joined("Bip01 Head Bip01", 2, &known).unwrap_or_default(), ["Bip01 Head", "Bip01"]);
        assert_eq!(joined("Bip01 Head Bip01", 2, &["Bip01_Head", "Bip01"]).unwrap_or_default(), ["Bip01_Head", "Bip01"]);
        assert_eq!(joined("Bip01 Tail", 1, &known), None);
        assert_eq!(joined("a b c", 4, &known), None);
        assert_eq!(joined("a b c", 0, &known), None);
    }
}

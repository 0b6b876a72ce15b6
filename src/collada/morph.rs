//! `morph`: shapes that a mesh is drawn towards.

use glam::Vec3;

use super::context::{Context, Step, child, name_of, shortened};
use super::controller::{Sources, geometry_below};
use super::geometry::Geometry;
use super::source::{Arrays, NameKind, inputs, name_list};
use super::{El, codes};
use crate::scene::{Morph, MorphMethod, MorphTarget};
use crate::tr;

/// Where a morph stands in the file, for animation of its weights.
pub struct MorphTargets<'a> {
    /// The `controller` element.
    pub controller: El<'a>,
    /// The `morph` element.
    pub morph: El<'a>,
    /// The source of its weights.
    pub weights: Option<El<'a>>,
    /// Number of targets.
    pub count: usize,
}

/// Reads a `morph` element over `base`.
///
/// # Errors
/// Where decimal commas stand in its numbers, or on cancel.
pub fn read<'a>(
    context: &mut Context<'a>,
    arrays: &mut Arrays<f64>,
    sources: &mut Sources<'_, 'a>,
    element: El<'a>,
    base: &Geometry,
) -> Step<Option<(Morph, MorphTargets<'a>)>> {
    let controller = element.parent().filter(El::is_element).unwrap_or(element);
    let (mut targets, mut weights) = (None, None);
    // 1.3 put the inputs into the morph itself.
    for input in inputs(child(element, "targets").unwrap_or(element)) {
        match input.semantic {
            "MORPH_TARGET" => targets = context.follow(input.element, "source", &["source"]),
            "MORPH_WEIGHT" => weights = context.follow(input.element, "source", &["source"]),
            _ => {}
        }
    }
    let names = match targets {
        Some(targets) => name_list(context, targets),
        None => None,
    };
    let Some(names) = names else {
        context.report.warn(element, codes::BAD_MORPH, tr!("collada-bad-morph"));
        return Ok(None);
    };
    let method = match element.attribute("method") {
        Some("RELATIVE") => MorphMethod::Relative,
        _ => MorphMethod::Normalized,
    };
    let mut morph = Morph {
        name: name_of(controller, || tr!("collada-unnamed-morph")),
        id: controller.attribute("id").unwrap_or_default().to_owned(),
        method,
        ..Morph::default()
    };
    let values = match weights {
        Some(weights) => arrays.accessor(context, weights, 1)?,
        None => None,
    };
    // An array may hold the targets of several morphs; a count is believed where the weights agree with it.
    let all = names.said.filter(|said| values.as_ref().is_some_and(|values| values.count == *said)).unwrap_or(usize::MAX);
    for name in names.entries().take(all) {
        context.check_cancelled()?;
        let id = if names.kind == NameKind::Name { name.trim_start_matches('#') } else { name };
        let target = match context.lookup.by_id(id, &["geometry", "controller"]) {
            Some(target) => {
                // Each target costs as much as the whole base, however short its name.
                if !context.spend(element, (base.mesh.positions.len() * 2 + 4) * size_of::<Vec3>()) {
                    break;
                }
                let name = name_of(target, || id.to_owned());
                let shape = match geometry_below(context, target) {
                    Some(geometry) => sources.geometries.target(context, sources.asset, geometry)?,
                    None => None,
                };
                MorphTarget { name, ..shape.map(|shape| deltas(context, element, base, &shape, method)).unwrap_or_default() }
            }
            None => {
                context.report.warn(element, codes::BROKEN_REFERENCE, tr!("collada-broken-reference", target = shortened(id)));
                MorphTarget { name: id.to_owned(), ..MorphTarget::default() }
            }
        };
        morph.targets.push(target);
    }
    // A target that could not be used keeps its place, so that the weights of the others stay theirs.
    for target in &mut morph.targets {
        target.position_deltas.resize(base.mesh.positions.len(), Vec3::ZERO);
    }
    if values.as_ref().is_none_or(|values| values.available < morph.targets.len()) {
        context.report.warn(element, codes::BAD_MORPH, tr!("collada-morph-weights"));
    }
    let weight = |i| values.as_ref().and_then(|values| values.get(i, 0)).filter(|weight| weight.is_finite()).unwrap_or(0.0) as f32;
    morph.weights = (0..morph.targets.len()).map(weight).collect();
    let count = morph.targets.len();
    Ok(Some((morph, MorphTargets { controller, morph: element, weights, count })))
}

/// What weight 1 of a target adds to each vertex of the base.
fn deltas(context: &mut Context<'_>, element: El<'_>, base: &Geometry, shape: &Geometry, method: MorphMethod) -> MorphTarget {
    if shape.points.len() != base.points.len() {
        let message =
            tr!("collada-morph-target", target = shape.mesh.name.as_str(), found = shape.points.len(), wanted = base.points.len());
        context.report.warn(element, codes::MORPH_TARGET_MISMATCH, message);
        return MorphTarget::default();
    }
    let relative = method == MorphMethod::Relative;
    let point = |points: &[Vec3], source: u32| points.get(source as usize).copied().unwrap_or(Vec3::ZERO);
    let position_deltas = base
        .mesh
        .source_vertex
        .iter()
        .zip(&base.mesh.positions)
        .map(|(source, own)| point(&shape.points, *source) - if relative { Vec3::ZERO } else { *own })
        .collect();
    let mut normal_deltas = Vec::new();
    // The target may split its points into other vertices; corners are what both have in the same order.
    if !relative && shape.corners.len() == base.corners.len() && !base.corners.is_empty() {
        normal_deltas = vec![Vec3::ZERO; base.mesh.normals.len()];
        for (own, other) in base.corners.iter().zip(&shape.corners) {
            if let (Some(delta), Some(from), Some(to)) =
                (normal_deltas.get_mut(*own as usize), base.mesh.normals.get(*own as usize), shape.mesh.normals.get(*other as usize))
            {
                *delta = *to - *from;
            }
        }
    }
    MorphTarget { name: String::new(), position_deltas, normal_deltas }
}

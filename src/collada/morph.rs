//! `morph`: shapes that a mesh is drawn towards.

use glam::Vec3;

use super::context::{Context, Step, child, name_of, shortened};
use super::controller::Sources;
use super::geometry::Geometry;
use super::morph_shape::Shape;
use super::source::{Accessor, Arrays, NameKind, NameList, inputs, name_list};
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
    let Some(lists) = Lists::read(context, arrays, element)? else { return Ok(None) };
    let mut morph = Morph {
        name: name_of(controller, || tr!("collada-unnamed-morph")),
        id: controller.attribute("id").unwrap_or_default().to_owned(),
        method: lists.method,
        ..Morph::default()
    };
    for name in lists.targets() {
        context.check_cancelled()?;
        let target = match lists.element(context, element, name) {
            Some(target) => {
                // Each target costs as much as the whole base, however short its name.
                if !context.spend(element, (base.mesh.positions.len() * 2 + 4) * size_of::<Vec3>()) {
                    break;
                }
                let shape = Shape::read(context, arrays, sources, target, 0)?;
                let deltas = shape.map(|shape| deltas(context, element, base, &shape, lists.method)).unwrap_or_default();
                MorphTarget { name: name_of(target, || lists.id(name).to_owned()), ..deltas }
            }
            None => MorphTarget { name: lists.id(name).to_owned(), ..MorphTarget::default() },
        };
        morph.targets.push(target);
    }
    // A target that could not be used keeps its place, so that the weights of the others stay theirs.
    for target in &mut morph.targets {
        target.position_deltas.resize(base.mesh.positions.len(), Vec3::ZERO);
    }
    if lists.values.as_ref().is_none_or(|values| values.available < morph.targets.len()) {
        context.report.warn(element, codes::BAD_MORPH, tr!("collada-morph-weights"));
    }
    morph.weights = (0..morph.targets.len()).map(|place| lists.weight(place)).collect();
    let count = morph.targets.len();
    Ok(Some((morph, MorphTargets { controller, morph: element, weights: lists.weights, count })))
}

/// The targets and weights of a `morph` element.
pub struct Lists<'a> {
    names: NameList<'a>,
    values: Option<Accessor<f64>>,
    weights: Option<El<'a>>,
    /// How the targets add up.
    pub method: MorphMethod,
}

impl<'a> Lists<'a> {
    /// Finds them; `None`, reported, where there are no targets.
    ///
    /// # Errors
    /// Where decimal commas stand in the weights.
    pub fn read(context: &mut Context<'a>, arrays: &mut Arrays<f64>, element: El<'a>) -> Step<Option<Self>> {
        let (mut targets, mut weights) = (None, None);
        // 1.3 put the inputs into the morph itself.
        for input in inputs(child(element, "targets").unwrap_or(element)) {
            match input.semantic {
                "MORPH_TARGET" => targets = context.follow(input.element, "source", &["source"]),
                "MORPH_WEIGHT" => weights = context.follow(input.element, "source", &["source"]),
                _ => {}
            }
        }
        let Some(names) = targets.and_then(|targets| name_list(context, targets)) else {
            context.report.warn(element, codes::BAD_MORPH, tr!("collada-bad-morph"));
            return Ok(None);
        };
        let method = match element.attribute("method") {
            Some(method) if method.trim().eq_ignore_ascii_case("RELATIVE") => MorphMethod::Relative,
            _ => MorphMethod::Normalized,
        };
        let values = match weights {
            Some(weights) => arrays.accessor(context, weights, 1)?,
            None => None,
        };
        Ok(Some(Self { names, values, weights, method }))
    }

    /// The targets as they are named.
    pub fn targets(&self) -> impl Iterator<Item = &str> {
        // An array may hold the targets of several morphs; a count is believed where the weights agree with it.
        let agrees = |said: &usize| self.values.as_ref().is_some_and(|values| values.count == *said);
        self.names.entries().take(self.names.said.filter(agrees).unwrap_or(usize::MAX))
    }

    /// The weight of a target at rest.
    pub fn weight(&self, place: usize) -> f32 {
        self.values.as_ref().and_then(|values| values.get(place, 0)).filter(|weight| weight.is_finite()).unwrap_or(0.0) as f32
    }

    /// The id in a target's name.
    fn id<'n>(&self, name: &'n str) -> &'n str {
        if self.names.kind == NameKind::Name { name.trim_start_matches('#') } else { name }
    }

    /// The target with this name; `None`, reported at `element`, where it isn't in the file.
    pub fn element(&self, context: &mut Context<'a>, element: El<'a>, name: &str) -> Option<El<'a>> {
        let id = self.id(name);
        let target = context.lookup.by_id(id, &["geometry", "controller"]);
        if target.is_none() {
            context.report.warn(element, codes::BROKEN_REFERENCE, tr!("collada-broken-reference", target = shortened(id)));
        }
        target
    }
}

/// What weight 1 of a target adds to each vertex of the base.
fn deltas(context: &mut Context<'_>, element: El<'_>, base: &Geometry, shape: &Shape, method: MorphMethod) -> MorphTarget {
    if shape.points().len() != base.points.len() {
        let message = tr!(
            "collada-morph-target",
            target = shape.geometry.mesh.name.as_str(),
            found = shape.points().len(),
            wanted = base.points.len()
        );
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
        .map(|(source, own)| point(shape.points(), *source) - if relative { Vec3::ZERO } else { *own })
        .collect();
    let mut normal_deltas = Vec::new();
    // The target may split its points into other vertices; corners are what both have in the same order.
    let other = &shape.geometry;
    if !relative && shape.has_normals() && other.corners.len() == base.corners.len() && !base.corners.is_empty() {
        normal_deltas = vec![Vec3::ZERO; base.mesh.normals.len()];
        for (own, theirs) in base.corners.iter().zip(&other.corners) {
            if let (Some(delta), Some(from), Some(to)) =
                (normal_deltas.get_mut(*own as usize), base.mesh.normals.get(*own as usize), other.mesh.normals.get(*theirs as usize))
            {
                *delta = *to - *from;
            }
        }
    }
    MorphTarget { name: String::new(), position_deltas, normal_deltas }
}

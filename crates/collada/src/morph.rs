//! `morph`: shapes that a mesh is drawn towards.

use std::borrow::Cow;

use glam::Vec3;

use super::context::{Context, ReadResult, child, name_of};
use super::controller::Sources;
use super::geometry::Geometry;
use super::morph_target::TargetShape;
use super::source::{Accessor, Arrays, NameList, inputs, name_list};
use super::{El, Finding};
use sinew_scene::{Morph, MorphMethod, MorphTarget};

/// Where a morph stands in the file, for animation of its weights.
pub(super) struct MorphTargets<'a> {
    /// The `controller` element.
    pub controller: El<'a>,
    /// The `morph` element.
    pub morph: El<'a>,
    /// The source of its weights.
    pub weights: Option<El<'a>>,
    /// The `morph_weights` element that Khronos' exporters write beside them, which their animations name.
    pub named: Option<El<'a>>,
    /// Number of targets.
    pub count: usize,
    /// Targets that have skins of their own.
    pub skinned: Vec<SkinnedShape<'a>>,
}

/// A morph target that a skin of its own places.
pub(super) struct SkinnedShape<'a> {
    /// Its place among the targets.
    pub target: u32,
    /// The `skin` element.
    pub skin: El<'a>,
    /// For each vertex of the base where the target has it before its skin.
    pub positions: Vec<Vec3>,
}

/// Reads a `morph` element over `base`.
///
/// # Errors
/// Where commas separate its numbers, or on cancel.
pub(super) fn read<'a>(
    context: &mut Context<'a>,
    arrays: &mut Arrays<f64>,
    sources: &mut Sources<'_, 'a>,
    element: El<'a>,
    base: &Geometry,
) -> ReadResult<Option<(Morph, MorphTargets<'a>)>> {
    let controller = element.parent().filter(El::is_element).unwrap_or(element);
    let Some(lists) = Lists::read(context, arrays, element)? else { return Ok(None) };
    let mut morph = Morph {
        name: name_of(controller),
        id: controller.attribute("id").unwrap_or_default().to_owned(),
        method: lists.method,
        ..Morph::default()
    };
    let mut skinned = Vec::new();
    for name in lists.targets() {
        context.check_cancelled()?;
        let target = match lists.element(context, element, name) {
            Some(target) => {
                // Each target costs as much as the whole base, however short its name.
                if !context.spend(element, (base.mesh.positions.len() * 2 + 4) * size_of::<Vec3>()) {
                    break;
                }
                let shape = TargetShape::read(context, arrays, sources, target, 0)?;
                if let Some((skin, bare)) = TargetShape::before_its_skin(context, arrays, sources, target)?
                    && bare.points().len() == base.points.len()
                    && context.spend(element, base.mesh.positions.len() * size_of::<Vec3>())
                {
                    let point = |source: &u32| bare.points().get(*source as usize).copied().unwrap_or(Vec3::ZERO);
                    let positions = base.mesh.source_vertex.iter().map(point).collect();
                    skinned.push(SkinnedShape { target: morph.targets.len() as u32, skin, positions });
                }
                let deltas = shape.map(|shape| deltas(context, element, base, &shape, lists.method)).unwrap_or_default();
                MorphTarget { name: Some(name_of(target)).filter(|own| !own.is_empty()).unwrap_or_else(|| name.to_owned()), ..deltas }
            }
            None => MorphTarget { name: name.trim_start_matches('#').to_owned(), ..MorphTarget::default() },
        };
        morph.targets.push(target);
    }
    // A target that could not be used keeps its place, so that the weights of the others stay theirs.
    for target in &mut morph.targets {
        target.position_deltas.resize(base.mesh.positions.len(), Vec3::ZERO);
    }
    let count = morph.targets.len();
    let weights: Vec<Option<f64>> = (0..count).map(|place| lists.written(place)).collect();
    if weights.contains(&None) {
        context.report.report(element, Finding::MorphWeightsMissing);
    }
    context.finite(element, weights.iter().flatten().all(|weight| weight.is_finite()));
    morph.weights = (0..count).map(|place| lists.weight(place)).collect();
    let (weights, named) = (lists.weights, lists.named);
    Ok(Some((morph, MorphTargets { controller, morph: element, weights, named, count, skinned })))
}

/// The targets and weights of a `morph` element.
pub(super) struct Lists<'a> {
    names: NameList<'a>,
    values: Option<Accessor<f64>>,
    weights: Option<El<'a>>,
    named: Option<El<'a>>,
    /// The numbers in `named`.
    stated: Vec<f64>,
    /// How the targets add up.
    pub method: MorphMethod,
}

impl<'a> Lists<'a> {
    /// Finds them; `None`, reported, where there are no targets.
    ///
    /// # Errors
    /// Where commas separate the weights.
    pub(super) fn read(context: &mut Context<'a>, arrays: &mut Arrays<f64>, element: El<'a>) -> ReadResult<Option<Self>> {
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
            context.report.report(element, Finding::MorphWithoutTargets);
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
        let named = extra_weights(element);
        let stated = match named {
            Some(named) => context.reals(named, 0)?,
            None => Vec::new(),
        };
        Ok(Some(Self { names, values, weights, named, stated, method }))
    }

    /// The targets as they are named.
    pub(super) fn targets(&self) -> impl Iterator<Item = &str> {
        // An array may hold the targets of several morphs; a count is believed where the weights agree with it.
        let agrees = |said: &usize| self.values.as_ref().is_some_and(|values| values.count == *said);
        self.names.entries().take(self.names.said.filter(agrees).unwrap_or(usize::MAX))
    }

    /// The weight of a target as the file has it, if it has one.
    fn written(&self, place: usize) -> Option<f64> {
        self.values.as_ref().and_then(|values| values.get(place, 0)).or_else(|| self.stated.get(place).copied())
    }

    /// The weight of a target at rest.
    pub(super) fn weight(&self, place: usize) -> f32 {
        self.written(place).filter(|weight| weight.is_finite()).unwrap_or(0.0) as f32
    }

    /// The target with this name; `None`, reported at `element`, where it isn't in the file.
    pub(super) fn element(&self, context: &mut Context<'a>, element: El<'a>, name: &str) -> Option<El<'a>> {
        const TAGS: [&str; 2] = ["geometry", "controller"];
        // By the letter it is an id, and many write the url of it.
        context.lookup.by_id_near(element, name, &TAGS).or_else(|| {
            let url = if name.contains('#') { Cow::Borrowed(name) } else { Cow::Owned(format!("#{name}")) };
            context.resolve(element, &url, &TAGS)
        })
    }
}

/// The `morph_weights` of a `morph` element, in its own `extra` or in that of the controller that it stands in.
fn extra_weights(element: El<'_>) -> Option<El<'_>> {
    let around = element.parent().filter(|above| above.tag_name().name() == "controller").unwrap_or(element);
    let in_extra = |found: &El<'_>| found.ancestors().take_while(|above| *above != around).any(|above| above.tag_name().name() == "extra");
    around.descendants().filter(|found| found.tag_name().name() == "morph_weights").find(in_extra)
}

/// What weight 1 of a target adds to each vertex of the base.
fn deltas(context: &mut Context<'_>, element: El<'_>, base: &Geometry, shape: &TargetShape, method: MorphMethod) -> MorphTarget {
    if shape.points().len() != base.points.len() {
        let finding = Finding::MorphTargetMismatch {
            target: shape.geometry.mesh.name.clone(),
            found: shape.points().len(),
            wanted: base.points.len(),
        };
        context.report.report(element, finding);
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

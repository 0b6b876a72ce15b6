//! What a morph target looks like: a mesh, or a mesh after its own controllers.

use std::rc::Rc;

use glam::{DMat4, Vec3};

use super::context::{Context, ReadResult, child};
use super::controller::{Sources, layers};
use super::geometry::Geometry;
use super::morph::Lists;
use super::source::Arrays;
use super::{El, Finding};
use sinew_scene::MorphMethod;
use sinew_scene::limits;

/// The shape of a morph target.
#[derive(Clone)]
pub(super) struct TargetShape {
    /// The mesh.
    pub geometry: Rc<Geometry>,
    /// The mesh's points as its controllers leave them; `None` where there are none, or where they change nothing.
    moved: Option<Rc<Vec<Vec3>>>,
}

/// What is known of a controller's shape.
pub(super) enum CachedTarget {
    /// Who meets it now has gone in a circle.
    BeingRead,
    /// What came out.
    Shape(Option<TargetShape>),
}

impl TargetShape {
    /// The points of the file.
    pub(super) fn points(&self) -> &[Vec3] {
        self.moved.as_ref().map_or(&self.geometry.points, |moved| moved)
    }

    /// Whether the mesh's own normals are still its normals.
    pub(super) fn has_normals(&self) -> bool {
        self.moved.is_none()
    }

    /// The shape of a `geometry` or `controller`: morphs with their weights at rest, skins in their bind shape. `None`, reported, where it
    /// leads to no mesh. `depth` counts the controllers that are being read as targets of each other.
    ///
    /// # Errors
    /// Where commas separate its numbers, or on cancel.
    pub(super) fn read<'a>(
        context: &mut Context<'a>,
        arrays: &mut Arrays<f64>,
        sources: &mut Sources<'_, 'a>,
        target: El<'a>,
        depth: usize,
    ) -> ReadResult<Option<Self>> {
        if target.tag_name().name() == "geometry" {
            let geometry = sources.geometries.target(context, sources.asset, target)?;
            return Ok(geometry.map(|geometry| Self { geometry, moved: None }));
        }
        match sources.geometries.shapes.get(&target.id()) {
            Some(CachedTarget::Shape(known)) => return Ok(known.clone()),
            Some(CachedTarget::BeingRead) => {
                context.report.report(target, Finding::ReferenceCycle);
                return Ok(None);
            }
            None => {}
        }
        if depth >= limits::MORPH_DEPTH {
            context.report.report(target, Finding::MorphsTooDeep);
            return Ok(None);
        }
        sources.geometries.shapes.insert(target.id(), CachedTarget::BeingRead);
        let shape = Self::controlled(context, arrays, sources, target, depth + 1)?;
        sources.geometries.shapes.insert(target.id(), CachedTarget::Shape(shape.clone()));
        Ok(shape)
    }

    /// The outermost skin of a `controller` and the shape below it; `None` where its outermost layer is none.
    ///
    /// # Errors
    /// As [`TargetShape::read`].
    pub(super) fn before_its_skin<'a>(
        context: &mut Context<'a>,
        arrays: &mut Arrays<f64>,
        sources: &mut Sources<'_, 'a>,
        target: El<'a>,
    ) -> ReadResult<Option<(El<'a>, Self)>> {
        let Some(skin) = child(target, "skin") else { return Ok(None) };
        let Some(below) = context.follow(skin, "source", &["geometry", "controller"]) else { return Ok(None) };
        Ok(Self::read(context, arrays, sources, below, 1)?.map(|shape| (skin, shape)))
    }

    fn controlled<'a>(
        context: &mut Context<'a>,
        arrays: &mut Arrays<f64>,
        sources: &mut Sources<'_, 'a>,
        target: El<'a>,
        depth: usize,
    ) -> ReadResult<Option<Self>> {
        let Some((geometry, layers)) = layers(context, target) else { return Ok(None) };
        let Some(geometry) = sources.geometries.target(context, sources.asset, geometry)? else { return Ok(None) };
        let mut moved: Option<Vec<Vec3>> = None;
        for layer in layers.into_iter().rev() {
            if layer.tag_name().name() == "skin" {
                let Some(matrix) = child(layer, "bind_shape_matrix") else { continue };
                let Some(rows) = context.exactly(matrix)? else { continue };
                let matrix = DMat4::from_cols_array(&rows).transpose().as_mat4();
                if matrix != glam::Mat4::IDENTITY {
                    let points = moved.get_or_insert_with(|| geometry.points.clone());
                    points.iter_mut().for_each(|point| *point = matrix.transform_point3(*point));
                }
                continue;
            }
            let Some(lists) = Lists::read(context, arrays, layer)? else { continue };
            let before = moved.clone().unwrap_or_else(|| geometry.points.clone());
            for (place, name) in lists.targets().enumerate() {
                let weight = lists.weight(place);
                if weight == 0.0 {
                    continue;
                }
                if !context.spend(layer, size_of_val(before.as_slice())) {
                    break;
                }
                let Some(target) = lists.element(context, layer, name) else { continue };
                let Some(shape) = Self::read(context, arrays, sources, target, depth)? else { continue };
                if shape.points().len() != before.len() {
                    let finding = Finding::MorphTargetMismatch {
                        target: shape.geometry.mesh.name.clone(),
                        found: shape.points().len(),
                        wanted: before.len(),
                    };
                    context.report.report(layer, finding);
                    continue;
                }
                let relative = lists.method == MorphMethod::Relative;
                let points = moved.get_or_insert_with(|| before.clone());
                for ((point, own), to) in points.iter_mut().zip(&before).zip(shape.points()) {
                    *point += (*to - if relative { Vec3::ZERO } else { *own }) * weight;
                }
            }
        }
        Ok(Some(Self { geometry, moved: moved.map(Rc::new) }))
    }
}

//! A document with and without skin that follows.

use glam::DVec3;
use sinew::document::{Document, PoseBuffers, PoseState, SkinMotion};
use sinew::scene::{Frame, SurfaceGeometry};

use crate::figures::Shape;

/// Poses a document again and again, as it is drawn and with its skin bent by the skeleton alone.
pub(crate) struct Posed<'a> {
    document: &'a Document,
    buffers: [PoseBuffers; 2],
    /// As it is drawn.
    pub(crate) frame: Frame,
    /// By the skeleton alone.
    pub(crate) plain: Frame,
}

impl<'a> Posed<'a> {
    pub(crate) fn new(document: &'a Document) -> Self {
        Self { document, buffers: Default::default(), frame: Frame::default(), plain: Frame::default() }
    }

    /// At this moment.
    pub(crate) fn at(&mut self, state: &PoseState) -> &mut Self {
        self.document.pose(&PoseState { skin: SkinMotion::FollowsMuscles, ..state.clone() }, &mut self.buffers[0], &mut self.frame);
        self.document.pose(&PoseState { skin: SkinMotion::Skeleton, ..state.clone() }, &mut self.buffers[1], &mut self.plain);
        self
    }

    /// The surfaces that muscles may move.
    pub(crate) fn skins(&self) -> Vec<usize> {
        let bent = |index: &usize| {
            let surface = &self.frame.surfaces[*index];
            surface.muscle.is_none() && matches!(surface.geometry, SurfaceGeometry::Deformed { .. })
        };
        (0..self.frame.surfaces.len()).filter(bent).collect()
    }

    /// By how much each vertex of a surface is moved.
    pub(crate) fn moves(&self, index: usize) -> Vec<DVec3> {
        let (skin, plain) = (Shape::of(&self.frame.surfaces[index]), Shape::of(&self.plain.surfaces[index]));
        skin.points.iter().zip(&plain.points).map(|(a, b)| *a - *b).collect()
    }

    /// The share of the vertices of bellies outside of surface `index`, and that of the tendons'; every `step`th is looked at.
    pub(crate) fn outside(&self, index: usize, step: usize) -> [f64; 2] {
        let skin = Shape::of(&self.frame.surfaces[index]);
        let mut most = [0.0_f64; 2];
        for surface in self.frame.surfaces.iter().filter(|surface| surface.muscle.is_some()) {
            let belly: Vec<DVec3> = Shape::of_part(surface, 0).used().into_iter().step_by(step).collect();
            let tendons: Vec<DVec3> =
                (1..surface.mesh.parts.len()).flat_map(|part| Shape::of_part(surface, part).used()).step_by(step).collect();
            most = [most[0].max(skin.share_outside(&belly)), most[1].max(skin.share_outside(&tendons))];
        }
        most
    }
}

/// A pose of the joint that the document's muscles cross, the clip at rest.
pub(crate) fn bent(document: &Document, degrees: f64) -> PoseState {
    PoseState::default().with_rotation(document.joint().map(|joint| joint.absolute(degrees)))
}

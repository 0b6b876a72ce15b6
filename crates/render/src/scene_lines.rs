//! All lines of a picture: the ground's, helpers', those of meshes, bones and overlays.

use glam::Vec3;

use super::binning::BandLayout;
use super::debug_lines::LineBuilder;
use super::draw_list::{DrawList, is_shown, rgb};
use super::line::{LinePass, LineSegments, LineStyle};
use super::projection::ViewTransform;
use super::{Display, RenderError, RenderJob};
use sinew_scene::{Frame, Material, Surface};

impl DrawList {
    /// Makes the lines of a picture; those of the ground only where they are not the same as before.
    pub(super) fn lines(
        &mut self,
        job: &RenderJob<'_>,
        view: &ViewTransform,
        bands: &BandLayout,
        light: Vec3,
        ground_is_new: bool,
        segments: &mut LineSegments,
    ) -> Result<(), RenderError> {
        if view.is_somewhere() {
            self.add_lines(job, LineBuilder { view, bands, display: job.display, segments }, light, ground_is_new)?;
        } else {
            [LinePass::Under, LinePass::Over, LinePass::Overlay].into_iter().for_each(|stage| segments.reset(stage, bands));
        }
        if segments.is_incomplete() { Err(RenderError::OutOfMemory) } else { Ok(()) }
    }

    fn add_lines(
        &mut self,
        job: &RenderJob<'_>,
        mut builder: LineBuilder<'_>,
        light: Vec3,
        ground_is_new: bool,
    ) -> Result<(), RenderError> {
        let RenderJob { scene, frame, display, .. } = *job;
        let bands = builder.bands;
        builder.segments.reset(LinePass::Over, bands);
        builder.segments.reset(LinePass::Overlay, bands);
        if ground_is_new {
            builder.segments.reset(LinePass::Under, bands);
            if display.grid {
                builder.grid(&display.ground.unwrap_or(frame.bounds));
            }
        }
        builder.helpers(frame, light);
        for surface in frame.surfaces.iter().filter(|surface| is_shown(display, surface)) {
            let selected = display.highlight.selected == Some(surface.node) && surface.ghost.is_none();
            let wireframe = display.wireframe && surface.ghost.is_none_or(|ghost| ghost.opacity >= 1.0);
            if wireframe || selected {
                let edges = self.meshes.of(&surface.mesh)?.edges(&surface.mesh)?;
                if wireframe {
                    builder.wireframe(surface, edges);
                }
                if selected {
                    builder.outline(surface, edges, display.palette.selected, &mut self.facing)?;
                }
            }
            // The lines of a surface of fibres show how it is made, of interest while it is selected.
            if !surface.is_fibrous() || selected {
                let color = match surface.ghost {
                    Some(ghost) => ghost.tint.to_array(),
                    None if selected => rgb(display.palette.selected),
                    None => default_color(frame, display, surface),
                };
                builder.mesh_lines(surface, color);
            }
        }
        if display.bones || display.bone_axes {
            builder.joints(scene, frame);
        }
        builder.selected_bones(scene, frame);
        for mark in &frame.overlay_lines {
            let line_style = builder.line_style(mark.color.to_array(), mark.opacity, mark.width);
            builder.line(mark.from, mark.to, &LineStyle { pass: LinePass::Overlay, ..line_style });
        }
        Ok(())
    }
}

/// The colour of the lines that a mesh brings along: its material's.
fn default_color(frame: &Frame, display: &Display, surface: &Surface) -> [f32; 3] {
    let material = surface.materials.iter().flatten().next().and_then(|binding| frame.materials.get(binding.material.index()));
    let neutral = Material::default();
    material.filter(|_| display.materials).unwrap_or(&neutral).diffuse.color.to_array()
}

//! The muscle panel with its editors: shape, attachments, path, contraction.

pub(crate) mod attach_muscles;
mod attachment_field;
mod attachments_editor;
mod contraction_controls;
pub(crate) mod muscle_editor;
pub(crate) mod muscle_panel;
mod profile_plot;
mod profile_table;
mod skin_editor;
mod via_points_editor;
mod via_range;
mod wrap_surface_row;
mod wrap_surfaces_editor;

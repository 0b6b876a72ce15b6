//! The boolean options of a display and its kinds of shading, by the names that files and actions use.

use sinew_render::{Display, Shading};

/// A boolean display option: its name in files and actions, and its field.
pub type DisplayFlag = (&'static str, fn(&mut Display) -> &mut bool);

/// All boolean display options.
pub const DISPLAY_FLAGS: [DisplayFlag; 16] = [
    ("mesh", |d| &mut d.mesh),
    ("muscle", |d| &mut d.muscle),
    ("see-through", |d| &mut d.see_through),
    ("lines-of-action", |d| &mut d.lines_of_action),
    ("materials", |d| &mut d.materials),
    ("smooth-normals", |d| &mut d.smooth_normals),
    ("normal-glyphs", |d| &mut d.normal_glyphs),
    ("wireframe", |d| &mut d.wireframe),
    ("bones", |d| &mut d.bones),
    ("bone-axes", |d| &mut d.bone_axes),
    ("xray", |d| &mut d.xray),
    ("grid", |d| &mut d.grid),
    ("axes", |d| &mut d.axes),
    ("bounding-box", |d| &mut d.bounding_box),
    ("depth-test", |d| &mut d.depth_test),
    ("cull-back-faces", |d| &mut d.cull_back_faces),
];

/// Shading by the name that the file and the actions use.
pub const SHADINGS: [(&str, Shading); 3] = [("flat", Shading::Flat), ("gouraud", Shading::Gouraud), ("phong", Shading::Phong)];

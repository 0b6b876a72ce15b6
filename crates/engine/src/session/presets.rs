//! Display presets: several display options in one choice.

use super::{BackgroundPreset, Session};
use sinew_render::{Display, Highlight, Samples, Shading};

/// A display preset.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DisplayPreset {
    /// The model as its author sees it.
    Clean,
    /// The bones alone, named.
    Skeleton,
    /// Edges, bones, axes and box: for finding what is wrong.
    Inspection,
    /// For paper: white ground, no helpers, the best lighting.
    Print,
}

impl Session {
    /// Applies a display preset. Line widths, the grid's cell and the colours of the window stay.
    pub fn take_preset(&mut self, preset: DisplayPreset) {
        use DisplayPreset as P;
        let (skeleton, inspection, print) = (preset == P::Skeleton, preset == P::Inspection, preset == P::Print);
        self.change_display(|display| {
            let before = display.clone();
            *display = Display {
                shading: if print { Shading::Phong } else { Shading::Gouraud },
                samples: Samples::Four,
                mesh: !skeleton,
                materials: !inspection,
                wireframe: inspection,
                bones: skeleton || inspection,
                bone_axes: inspection,
                axes: inspection,
                bounding_box: inspection,
                grid: !print,
                background: before.background,
                light: before.light,
                light_marker: before.light_marker,
                highlight: Highlight { weights: None, ..before.highlight },
                ground: before.ground,
                palette: before.palette,
                scale: before.scale,
                grid_cell: before.grid_cell,
                line_width: before.line_width,
                ..Display::default()
            };
        });
        self.set_bone_names(skeleton);
        self.set_backdrop(if print { BackgroundPreset::White } else { BackgroundPreset::Theme });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sinew_render::{Background, Theme};

    #[test]
    fn a_preset_sets_what_it_is_for_and_nothing_else() {
        let mut session = Session::default();
        session.set_theme(Theme::Light);
        session.change_display(|display| (display.line_width, display.cull_back_faces) = (2.0, true));
        let theme = session.display().background;
        session.take_preset(DisplayPreset::Skeleton);
        assert!(session.display().bones && session.bone_names() && !session.display().mesh && !session.display().cull_back_faces);
        session.take_preset(DisplayPreset::Print);
        assert_eq!((session.display().background, session.display().grid), (Background::Solid(0xFF_FFFF), false));
        session.take_preset(DisplayPreset::Inspection);
        assert!(session.display().wireframe && session.display().bounding_box && !session.bone_names());
        session.take_preset(DisplayPreset::Clean);
        assert_eq!((session.display().background, session.display().line_width), (theme, 2.0));
        assert!(session.display().mesh && session.display().materials && !session.display().bones);
    }
}

//! Small icons that the icon themes lack: SVG files of `resources/icons`, drawn in the text's colour.
//!
//! They are drawn here and not by GTK, which needs a loader for SVG that a system may lack. So the files say no more than this reads: paths on a square of
//! 16 units, stroked with round ends in `currentColor`, or filled with it where `fill` says so.

use std::sync::LazyLock;

use gtk::cairo::{Context, LineCap, LineJoin};
use gtk::prelude::*;
use gtk4 as gtk;
use kurbo::{BezPath, PathEl};

use super::drawing_area::{PaintWidget, cairo, set_color};

/// One path of an icon.
struct IconPath {
    path: BezPath,
    /// Width of its stroke, units of the icon; `None` where it is filled.
    stroke: Option<f64>,
}

macro_rules! icons {
    ($($(#[$doc:meta])* $name:ident = $file:literal),+ $(,)?) => {
        /// What an icon shows.
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub(crate) enum Icon {
            $($(#[$doc])* $name,)+
        }

        impl Icon {
            #[cfg(test)]
            const ALL: &[Self] = &[$(Self::$name,)+];

            /// The paths of its file.
            fn paths(self) -> &'static [IconPath] {
                match self {
                    $(Self::$name => {
                        static PATHS: LazyLock<Vec<IconPath>> =
                            LazyLock::new(|| parse(include_str!(concat!("../../../resources/icons/", $file, ".svg"))));
                        &PATHS
                    })+
                }
            }
        }
    };
}
icons! {
    /// A file.
    File = "file",
    /// An ordinary node.
    Node = "node",
    /// A bone.
    Bone = "bone",
    /// A mesh.
    Mesh = "mesh",
    /// A muscle.
    Muscle = "muscle",
    /// A camera.
    Camera = "camera",
    /// A light.
    Light = "light",
    /// The tool that moves the camera.
    Navigate = "navigate",
    /// The tool that moves the model.
    Move = "move",
    /// The tool that turns the model.
    Rotate = "rotate",
    /// The tool that scales the model.
    Scale = "scale",
    /// To the previous key.
    PreviousKey = "previous-key",
    /// To the next key.
    NextKey = "next-key",
    /// One frame back.
    FrameBack = "frame-back",
    /// One frame on.
    FrameForward = "frame-forward",
    /// The dope sheet.
    DopeSheet = "dope-sheet",
}

/// A canvas of 16 × 16 that shows an icon.
pub(crate) fn image(icon: Icon) -> PaintWidget {
    let canvas = PaintWidget::new(16, 16);
    set(&canvas, icon);
    canvas.set_valign(gtk::Align::Center);
    canvas.set_halign(gtk::Align::Center);
    canvas
}

/// Makes a canvas show an icon.
pub(crate) fn set(canvas: &PaintWidget, icon: Icon) {
    canvas.set_painter(move |canvas, snapshot, width, height| {
        let context = cairo(snapshot, width, height);
        let side = width.min(height);
        context.translate((width - side) / 2.0, (height - side) / 2.0);
        context.scale(side / 16.0, side / 16.0);
        set_color(&context, &canvas.text_color(), 1.0);
        context.set_line_cap(LineCap::Round);
        context.set_line_join(LineJoin::Round);
        for part in icon.paths() {
            // Cairo fails only where memory is gone; an icon is not worth more than the attempt.
            let _ = draw(&context, part);
        }
    });
}

fn draw(context: &Context, part: &IconPath) -> Result<(), cairo::Error> {
    let mut here = kurbo::Point::ZERO;
    for element in part.path.elements() {
        match *element {
            PathEl::MoveTo(to) => context.move_to(to.x, to.y),
            PathEl::LineTo(to) => context.line_to(to.x, to.y),
            PathEl::QuadTo(middle, to) => {
                let curve = kurbo::QuadBez::new(here, middle, to).raise();
                context.curve_to(curve.p1.x, curve.p1.y, curve.p2.x, curve.p2.y, to.x, to.y);
            }
            PathEl::CurveTo(first, second, to) => context.curve_to(first.x, first.y, second.x, second.y, to.x, to.y),
            PathEl::ClosePath => context.close_path(),
        }
        here = element.end_point().unwrap_or(here);
    }
    match part.stroke {
        Some(width) => {
            context.set_line_width(width);
            context.stroke()
        }
        None => context.fill(),
    }
}

/// The paths of an icon's file; what cannot be read is left out, which a test of all files would tell.
fn parse(text: &str) -> Vec<IconPath> {
    let Ok(document) = roxmltree::Document::parse(text) else { return Vec::new() };
    let width = |node: &roxmltree::Node<'_, '_>| node.ancestors().find_map(|node| node.attribute("stroke-width")?.parse().ok());
    let part = |node: roxmltree::Node<'_, '_>| {
        let path = BezPath::from_svg(node.attribute("d")?).ok()?;
        let filled = node.attribute("fill") == Some("currentColor");
        Some(IconPath { path, stroke: if filled { None } else { Some(width(&node)?) } })
    };
    document.descendants().filter(|node| node.tag_name().name() == "path").filter_map(part).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use kurbo::Shape;

    #[test]
    fn every_icon_is_read_whole_and_stays_within_its_square() {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("resources/icons");
        let files = std::fs::read_dir(folder).unwrap().flatten().filter(|file| !file.file_name().to_string_lossy().starts_with("io."));
        assert_eq!(files.count(), Icon::ALL.len(), "each file is an icon");
        for icon in Icon::ALL {
            let paths = icon.paths();
            assert!(!paths.is_empty(), "{icon:?}");
            for part in paths {
                let reach = part.path.bounding_box().inflate(part.stroke.unwrap_or(0.0) / 2.0, part.stroke.unwrap_or(0.0) / 2.0);
                assert!(reach.x0 >= 0.0 && reach.y0 >= 0.0 && reach.x1 <= 16.0 && reach.y1 <= 16.0, "{icon:?}: {reach:?}");
            }
        }
    }

    #[test]
    fn what_a_file_says_is_read() {
        let paths = parse(
            "<svg xmlns='http://www.w3.org/2000/svg' stroke-width='1.3'><path d='M1 2H3'/><path d='M0 0L1 1Z' fill='currentColor'/><path d='broken'/></svg>",
        );
        assert_eq!(paths.iter().map(|part| part.stroke).collect::<Vec<_>>(), [Some(1.3), None]);
        assert_eq!(paths[0].path.elements().len(), 2);
    }
}

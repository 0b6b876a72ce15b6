//! The one table of everything that can be done: ids, keys and groups. Actions, menus' shortcuts, tooltips and the shortcuts window come from it.

use crate::tr;

/// The groups of the shortcuts window.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Group {
    /// Files and the program.
    Files,
    /// Pictures, films, surfaces.
    Pictures,
    /// Playing.
    Playback,
    /// Going to a moment.
    Time,
    /// Camera and light.
    Camera,
    /// The model: tools, muscle, undo.
    Model,
    /// What is shown.
    Display,
    /// The selection, looked at closely.
    Inspection,
    /// Panels, help.
    Window,
}

impl Group {
    /// All groups, in the order of the shortcuts window.
    pub const ALL: [Self; 9] =
        [Self::Files, Self::Pictures, Self::Playback, Self::Time, Self::Camera, Self::Model, Self::Display, Self::Inspection, Self::Window];

    /// The key of its name in the catalogue.
    pub fn label(self) -> String {
        tr!(match self {
            Self::Files => "app-group-files",
            Self::Pictures => "app-group-pictures",
            Self::Playback => "app-group-playback",
            Self::Time => "app-group-time",
            Self::Camera => "app-group-camera",
            Self::Model => "app-group-model",
            Self::Display => "app-group-display",
            Self::Inspection => "app-group-inspection",
            Self::Window => "app-group-window",
        })
    }
}

macro_rules! commands {
    ($($group:ident { $($(#[$doc:meta])* $name:ident = $id:literal $keys:tt),+ $(,)? })+) => {
        /// Something that can be done. Its id is also the name of its action in the window (`win.id`).
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        pub enum Command {
            $($($(#[$doc])* $name,)+)+
        }

        impl Command {
            /// All commands, in the order of the table.
            pub const ALL: &[Self] = &[$($(Self::$name,)+)+];

            /// The name of its action.
            pub fn id(self) -> &'static str {
                match self {
                    $($(Self::$name => $id,)+)+
                }
            }

            /// Its keys, in GTK's notation, the one to show first. Letters and digits mean the place on the keyboard.
            pub fn keys(self) -> &'static [&'static str] {
                match self {
                    $($(Self::$name => &$keys,)+)+
                }
            }

            /// Its group in the shortcuts window.
            pub fn group(self) -> Group {
                match self {
                    $($(Self::$name => Group::$group,)+)+
                }
            }
        }
    };
}

commands! {
    Files {
        /// Choose files to open.
        Open = "open" ["<Control>o"],
        /// Compare with another file.
        CompareFile = "compare-file" ["<Control><Shift>o"],
        /// Read the open files again.
        Reload = "reload" ["F5"],
        /// Save the muscles.
        Save = "save" ["<Control>s"],
        /// Save the muscles under another name.
        SaveAs = "save-as" ["<Control><Shift>s"],
        /// Back to what is saved.
        Revert = "revert" [],
        /// The file before this one in its folder.
        PreviousFile = "previous-file" ["<Control>Page_Up"],
        /// The file after this one in its folder.
        NextFile = "next-file" ["<Control>Page_Down"],
        /// Save what is open and how it is looked at.
        SaveSession = "save-session" ["<Control><Alt>s"],
        /// The page with demos and recent files.
        StartPage = "start-page" ["<Alt>Home"],
        /// Close the files.
        Close = "close" ["<Control>w"],
        /// Leave.
        Quit = "quit" ["<Control>q"],
    }
    Pictures {
        /// Save the picture.
        Picture = "picture" ["F12"],
        /// Save the picture without background.
        PictureTransparent = "picture-transparent" ["<Control>F12"],
        /// Copy the picture.
        CopyPicture = "copy-picture" ["<Control>c"],
        /// Save pictures, films, surfaces.
        Export = "export" ["<Control>e"],
    }
    Playback {
        /// Play or pause.
        Play = "play" ["space"],
        /// Play backwards or forwards.
        Reverse = "reverse" ["<Control><Shift>space"],
        /// Slower.
        Slower = "slower" ["bracketleft"],
        /// Faster.
        Faster = "faster" ["bracketright"],
        /// Normal speed.
        NormalSpeed = "normal-speed" ["backslash"],
        /// Next loop mode.
        LoopMode = "loop-mode" ["l"],
        /// Mark A here.
        MarkA = "mark-a" ["i"],
        /// Mark B here.
        MarkB = "mark-b" ["o"],
        /// No marks.
        ClearMarks = "clear-marks" [],
        /// Previous clip.
        PreviousClip = "previous-clip" ["Page_Up"],
        /// Next clip.
        NextClip = "next-clip" ["Page_Down"],
        /// The dope sheet.
        Sheet = "sheet" ["k"],
        /// The curve view.
        Curves = "curves" ["<Shift>k"],
    }
    Time {
        /// One frame back.
        FrameBack = "frame-back" ["Left"],
        /// One frame on.
        FrameForward = "frame-forward" ["Right"],
        /// One second back.
        SecondBack = "second-back" ["<Control>Left"],
        /// One second on.
        SecondForward = "second-forward" ["<Control>Right"],
        /// First moment.
        First = "first" ["<Shift>Left"],
        /// Last moment.
        Last = "last" ["<Shift>Right"],
        /// Previous key.
        PreviousKey = "previous-key" ["Up"],
        /// Next key.
        NextKey = "next-key" ["Down"],
        /// Zooms the timeline in.
        TimeCloser = "timeline-zoom-in" ["<Control>plus"],
        /// Zooms the timeline out.
        TimeWider = "timeline-zoom-out" ["<Control>minus"],
        /// All of the timeline.
        TimeWhole = "timeline-zoom-all" ["<Control>0"],
    }
    Camera {
        /// Fit everything into the picture.
        Fit = "fit" ["Home"],
        /// Start view.
        ResetCamera = "reset-camera" ["Return"],
        /// Centre on the selection.
        Centre = "centre" ["period"],
        /// From the front.
        Front = "view-front" ["1"],
        /// From behind.
        Back = "view-back" ["<Control>1"],
        /// From the right.
        Right = "view-right" ["3"],
        /// From the left.
        Left = "view-left" ["<Control>3"],
        /// From above.
        Top = "view-top" ["7"],
        /// From below.
        Bottom = "view-bottom" ["<Control>7"],
        /// From the upper right front.
        Iso = "view-iso" ["9"],
        /// From the lower left behind.
        IsoOpposite = "view-iso-opposite" ["<Control>9"],
        /// Parallel rays.
        Orthographic = "orthographic" ["5"],
        /// Fly.
        Fly = "fly" ["f", "<Shift>grave"],
        /// Eased jumps of the camera.
        SmoothCamera = "smooth-camera" [],
        /// The light back to its place.
        ResetLight = "reset-light" [],
    }
    Model {
        /// Drags move the camera.
        ToolNavigate = "tool-navigate" ["v"],
        /// Drags move the model.
        ToolMove = "tool-move" ["g"],
        /// Drags turn the model.
        ToolRotate = "tool-rotate" ["r"],
        /// Drags scale the model.
        ToolScale = "tool-scale" ["s"],
        /// The model back to where the file has it.
        ResetModel = "reset-model" [],
        /// More contraction.
        ContractMore = "contract-more" ["<Alt>Up"],
        /// Less contraction.
        ContractLess = "contract-less" ["<Alt>Down"],
        /// Bend the elbow.
        ElbowMore = "elbow-more" ["<Alt>Right"],
        /// Straighten the elbow.
        ElbowLess = "elbow-less" ["<Alt>Left"],
        /// A new muscle.
        NewMuscle = "new-muscle" [],
        /// A copy of the muscle that is shown.
        DuplicateMuscle = "duplicate-muscle" [],
        /// Take the muscle that is shown away.
        DeleteMuscle = "delete-muscle" [],
        /// Pick the bone that the muscle comes from.
        PickOrigin = "pick-origin" [],
        /// Pick the bone that the muscle goes to.
        PickInsertion = "pick-insertion" [],
        /// Undo.
        Undo = "undo" ["<Control>z"],
        /// Redo.
        Redo = "redo" ["<Control><Shift>z", "<Control>y"],
    }
    Display {
        /// Bones.
        Bones = "bones" ["b"],
        /// Names of bones.
        BoneNames = "bone-names" ["j"],
        /// Axes of bones.
        BoneAxes = "bone-axes" [],
        /// Bones through surfaces.
        Xray = "xray" [],
        /// Meshes.
        Mesh = "mesh" [],
        /// Muscles.
        Muscle = "muscle" ["m"],
        /// Muscles through the skin.
        SeeThrough = "see-through" [],
        /// Materials and textures.
        Materials = "materials" ["t"],
        /// Normals in lighting.
        SmoothNormals = "smooth-normals" ["n"],
        /// Lines along normals.
        NormalGlyphs = "normal-glyphs" ["<Shift>n"],
        /// Edges of triangles.
        Wireframe = "wireframe" ["e"],
        /// Ground grid.
        Grid = "grid" ["c"],
        /// World axes.
        Axes = "axes" ["x"],
        /// Box round everything.
        BoundingBox = "bounding-box" [],
        /// Depth test.
        DepthTest = "depth-test" [],
        /// No back faces.
        CullBackFaces = "cull-back-faces" [],
        /// Anti-aliasing.
        SmoothEdges = "anti-aliasing" [],
        /// The display preset "clean".
        PresetClean = "preset-clean" [],
        /// The display preset "skeleton".
        PresetSkeleton = "preset-skeleton" [],
        /// The display preset "inspection".
        PresetInspection = "preset-inspection" [],
        /// The display preset "print".
        PresetPrint = "preset-print" [],
        /// Flat shading.
        Flat = "flat" [],
        /// Gouraud shading.
        Gouraud = "gouraud" [],
        /// Phong shading.
        Phong = "phong" [],
    }
    Inspection {
        /// Weights of the selected bone.
        Weights = "weights" ["w"],
        /// The moments before and after this one.
        Ghosts = "onion-skins" ["h"],
        /// Go along with the selection while a clip plays.
        Follow = "follow" ["<Shift>f"],
        /// The path of the selection.
        BonePath = "bone-path" ["p"],
        /// Both ways to bend a skin.
        CompareSkinning = "compare-skinning" ["d"],
        /// No comparison any more.
        StopComparing = "stop-comparing" [],
        /// The selection alone.
        Isolate = "isolate" ["slash"],
        /// Hide the selection.
        Hide = "hide" ["<Shift>h"],
        /// Show everything.
        ShowAll = "show-all" ["<Alt>h"],
    }
    Window {
        /// Both side panels.
        Sidebars = "sidebars" ["F9"],
        /// The scene tree.
        Tree = "tree" [],
        /// The right panel.
        Panel = "panel" [],
        /// The whole screen.
        Fullscreen = "fullscreen" ["F11"],
        /// Frame times over the picture.
        FrameTimes = "frame-times" [],
        /// As the desktop.
        ColoursSystem = "colours-system" [],
        /// Light.
        ColoursLight = "colours-light" [],
        /// Dark.
        ColoursDark = "colours-dark" [],
        /// The main menu.
        Menu = "menu" ["F10"],
        /// What one can do and how.
        Help = "help" ["F1"],
        /// This list.
        Shortcuts = "shortcuts" ["<Control>question"],
        /// About.
        About = "about" [],
    }
}

impl Command {
    /// The command with this id.
    pub fn from_id(id: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|command| command.id() == id)
    }

    /// What a person calls it.
    pub fn label(self) -> String {
        tr!(&format!("app-do-{}", self.id()))
    }

    /// Its first key as GTK shows it; empty without one. GTK must have started.
    pub fn key_label(self) -> String {
        self.keys()
            .first()
            .and_then(|key| gtk4::accelerator_parse(*key))
            .map_or_else(String::new, |(key, modifiers)| gtk4::accelerator_get_label(key, modifiers).into())
    }

    /// Its label with its key: `Play (Space)`.
    pub fn tooltip(self) -> String {
        let (label, key) = (self.label(), self.key_label());
        if key.is_empty() { label } else { format!("{label} ({key})") }
    }

    /// A text with the keys of the commands that do the same: `Clip (Page Up, Page Down)`.
    pub fn with_keys(text: &str, commands: &[Self]) -> String {
        let keys = commands.iter().map(|command| command.key_label()).filter(|key| !key.is_empty()).collect::<Vec<_>>().join(", ");
        if keys.is_empty() { text.to_owned() } else { format!("{text} ({keys})") }
    }

    /// The switch of the display that it turns, if it is one.
    pub fn display_flag(self) -> Option<fn(&mut crate::render::Display) -> &mut bool> {
        super::settings::DISPLAY_FLAGS.iter().find(|(name, _)| *name == self.id()).map(|(_, switch)| *switch)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    #[test]
    fn every_command_has_its_own_id_and_a_name() {
        let mut ids = HashSet::new();
        for command in Command::ALL {
            assert!(ids.insert(command.id()), "{command:?}");
            assert_eq!(Command::from_id(command.id()), Some(*command));
            assert!(!command.label().starts_with("app-do-"), "{command:?} has no name in the catalogue");
        }
        for group in Group::ALL {
            assert!(!group.label().starts_with("app-group"));
            assert!(Command::ALL.iter().any(|command| command.group() == group));
        }
    }

    #[test]
    fn every_switch_of_the_display_is_a_command() {
        for (name, _) in crate::app::settings::DISPLAY_FLAGS {
            assert!(Command::from_id(name).is_some_and(|command| command.display_flag().is_some()), "{name}");
        }
    }
}

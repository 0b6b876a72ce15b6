//! The one table of everything that can be done: ids, keys, groups, what each command does and when it is possible. Actions, menus' shortcuts, tooltips and
//! the shortcuts window come from it.
//!
//! A row is `Name = "id" [keys] action, if condition;`. The title is the message `app-do-id` of the catalogue. A command without an action does not
//! compile; one without a condition is always possible.
//!
//! Beside it: what the rows name (`command_action`, `command_conditions`, `session_commands`), keys (`shortcuts`, `key_controller`), and the performing of
//! commands (`command_dispatch` on a `command_context`).

mod command_action;
mod command_conditions;
pub(crate) mod command_context;
pub(crate) mod command_dispatch;
pub(crate) mod key_controller;
mod session_commands;
mod shortcuts;

use self::command_action::Action::*;
use self::command_action::{Action, AppCommand as A, AppSwitch as S};
use self::command_conditions::*;
use self::session_commands::*;
use crate::app::settings::{ColorScheme, SheetPage};
use crate::muscle::sets::MuscleSet;
use crate::render::Shading;
use crate::scene::ViewDirection as V;
use crate::session::{DisplayPreset as P, Session, Tool as T};
use crate::tr;

/// The groups of the shortcuts window.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Group {
    /// Files and the program.
    Files,
    /// Pictures, videos, surfaces.
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
    ($($group:ident { $($(#[$doc:meta])* $name:ident = $id:literal $keys:tt $action:expr $(, if $condition:expr)?;)+ })+) => {
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

            /// What it does.
            pub(crate) fn action(self) -> Action {
                match self {
                    $($(Self::$name => $action,)+)+
                }
            }

            /// Whether it is possible.
            pub(crate) fn is_possible(self, conditions: &Conditions) -> bool {
                match self {
                    $($(Self::$name => true $(&& $condition(conditions))?,)+)+
                }
            }
        }
    };
}

commands! {
    Files {
        /// Choose files to open.
        Open = "open" ["<Control>o"] Run(A::Open);
        /// Compare with another file.
        CompareFile = "compare-file" ["<Control><Shift>o"] Run(A::CompareFile), if is_open;
        /// Read the open files again.
        Reload = "reload" ["F5"] Run(A::Reload), if has_files;
        /// Save the muscles.
        Save = "save" ["<Control>s"] Run(A::Save), if has_muscles;
        /// Save the muscles under another name.
        SaveAs = "save-as" ["<Control><Shift>s"] Run(A::SaveAs), if has_muscles;
        /// Back to what is saved.
        Revert = "revert" [] Edit(Session::revert), if is_unsaved;
        /// The file before this one in its folder.
        PreviousFile = "previous-file" ["<Control>Page_Up"] Run(A::Neighbour(-1)), if has_files;
        /// The file after this one in its folder.
        NextFile = "next-file" ["<Control>Page_Down"] Run(A::Neighbour(1)), if has_files;
        /// Save what is open and how it is looked at.
        SaveSession = "save-session" ["<Control><Alt>s"] Run(A::SaveSession), if is_open;
        /// The page with demos and recent files.
        StartPage = "start-page" ["<Alt>Home"] Run(A::StartPage);
        /// Close the files.
        Close = "close" ["<Control>w"] Run(A::Close);
        /// Leave.
        Quit = "quit" ["<Control>q"] Run(A::Quit);
    }
    Pictures {
        /// Save the picture.
        Picture = "picture" ["F12"] Run(A::Picture), if is_open;
        /// Save the picture without background.
        PictureTransparent = "picture-transparent" ["<Control>F12"] Run(A::PictureTransparent), if is_open;
        /// Copy the picture.
        CopyPicture = "copy-picture" ["<Control>c"] Run(A::CopyPicture), if is_open;
        /// Save pictures, videos, surfaces.
        Export = "export" ["<Control>e"] Run(A::Export), if is_open;
    }
    Playback {
        /// Play or pause.
        Play = "play" ["space"] Toggle(is_playing, Session::toggle_playing), if has_time;
        /// Play backwards or forwards.
        Reverse = "reverse" ["<Control><Shift>space"] Toggle(is_reversed, reverse), if has_time;
        /// Slower.
        Slower = "slower" ["bracketleft"] Change(|session| change_speed(session, 1.0 / 1.25));
        /// Faster.
        Faster = "faster" ["bracketright"] Change(|session| change_speed(session, 1.25));
        /// Normal speed.
        NormalSpeed = "normal-speed" ["backslash"] Change(|session| session.time(|time| time.speed = 1.0));
        /// Next loop mode.
        LoopMode = "loop-mode" ["l"] Change(Session::next_loop_mode);
        /// Mark A here.
        MarkA = "mark-a" ["i"] Change(mark_a), if has_time;
        /// Mark B here.
        MarkB = "mark-b" ["o"] Change(mark_b), if has_time;
        /// No marks.
        ClearMarks = "clear-marks" [] Change(clear_marks), if has_marks;
        /// Previous clip.
        PreviousClip = "previous-clip" ["Page_Up"] Change(|session| session.next_clip(-1)), if has_clips;
        /// Next clip.
        NextClip = "next-clip" ["Page_Down"] Change(|session| session.next_clip(1)), if has_clips;
        /// The dope sheet.
        Sheet = "sheet" ["k"] Switch(S::Sheet(SheetPage::Keys));
        /// The curve view.
        Curves = "curves" ["<Shift>k"] Switch(S::Sheet(SheetPage::Curves));
    }
    Time {
        /// One frame back.
        FrameBack = "frame-back" ["Left"] Change(|session| session.step_frames(-1)), if has_time;
        /// One frame on.
        FrameForward = "frame-forward" ["Right"] Change(|session| session.step_frames(1)), if has_time;
        /// One second back.
        SecondBack = "second-back" ["<Control>Left"] Change(|session| seek_by(session, -1.0)), if has_time;
        /// One second on.
        SecondForward = "second-forward" ["<Control>Right"] Change(|session| seek_by(session, 1.0)), if has_time;
        /// First moment.
        First = "first" ["<Shift>Left"] Change(seek_start), if has_time;
        /// Last moment.
        Last = "last" ["<Shift>Right"] Change(seek_end), if has_time;
        /// Previous key.
        PreviousKey = "previous-key" ["Up"] Change(|session| session.step_key(false)), if has_time;
        /// Next key.
        NextKey = "next-key" ["Down"] Change(|session| session.step_key(true)), if has_time;
        /// Zooms the timeline in.
        TimeCloser = "timeline-zoom-in" ["<Control>plus"] Run(A::ZoomTime(1.5)), if has_time;
        /// Zooms the timeline out.
        TimeWider = "timeline-zoom-out" ["<Control>minus"] Run(A::ZoomTime(1.0 / 1.5)), if has_time;
        /// All of the timeline.
        TimeWhole = "timeline-zoom-all" ["<Control>0"] Run(A::WholeTime), if has_time;
    }
    Camera {
        /// Fit everything into the picture.
        Fit = "fit" ["Home"] Change(Session::fit);
        /// Start view.
        ResetCamera = "reset-camera" ["Return"] Change(Session::reset_camera);
        /// Centre on the selection.
        Centre = "centre" ["period"] Change(centre), if has_selection;
        /// From the front.
        Front = "view-front" ["1"] LookFrom(V::Front);
        /// From behind.
        Back = "view-back" ["<Control>1"] LookFrom(V::Back);
        /// From the right.
        Right = "view-right" ["3"] LookFrom(V::Right);
        /// From the left.
        Left = "view-left" ["<Control>3"] LookFrom(V::Left);
        /// From above.
        Top = "view-top" ["7"] LookFrom(V::Top);
        /// From below.
        Bottom = "view-bottom" ["<Control>7"] LookFrom(V::Bottom);
        /// From the upper right front.
        Iso = "view-iso" ["9"] LookFrom(V::Iso);
        /// From the lower left behind.
        IsoOpposite = "view-iso-opposite" ["<Control>9"] Change(look_from_below);
        /// Parallel rays.
        Orthographic = "orthographic" ["5"] Toggle(is_orthographic, toggle_orthographic);
        /// Fly.
        Fly = "fly" ["f", "<Shift>grave"] Run(A::Fly);
        /// Eased jumps of the camera.
        SmoothCamera = "smooth-camera" [] Switch(S::SmoothCamera), if animates;
        /// The light back to its place.
        ResetLight = "reset-light" [] Edit(Session::reset_light), if has_own_light;
    }
    Model {
        /// Drags move the camera.
        ToolNavigate = "tool-navigate" ["v"] TakeTool(T::Navigate);
        /// Drags move the model.
        ToolMove = "tool-move" ["g"] TakeTool(T::Move);
        /// Drags turn the model.
        ToolRotate = "tool-rotate" ["r"] TakeTool(T::Rotate);
        /// Drags scale the model.
        ToolScale = "tool-scale" ["s"] TakeTool(T::Scale);
        /// The model back to where the file has it.
        ResetModel = "reset-model" [] Edit(reset_model), if is_model_moved;
        /// More contraction.
        ContractMore = "contract-more" ["<Alt>Up"] Edit(|session| contract(session, 5.0)), if has_muscles;
        /// Less contraction.
        ContractLess = "contract-less" ["<Alt>Down"] Edit(|session| contract(session, -5.0)), if has_muscles;
        /// Bend the elbow.
        ElbowMore = "elbow-more" ["<Alt>Right"] Edit(|session| bend(session, 5.0)), if can_bend;
        /// Straighten the elbow.
        ElbowLess = "elbow-less" ["<Alt>Left"] Edit(|session| bend(session, -5.0)), if can_bend;
        /// A new muscle.
        NewMuscle = "new-muscle" [] Run(A::NewMuscle);
        /// A copy of the muscle that is shown.
        DuplicateMuscle = "duplicate-muscle" [] Run(A::DuplicateMuscle), if has_muscles;
        /// The muscle that is shown, on the other side of its figure.
        MirrorMuscle = "mirror-muscle" [] Run(A::MirrorMuscle), if has_muscles;
        /// Muscles of both arms.
        AttachArms = "attach-arms" [] Run(A::AttachSet(MuscleSet::Arm)), if is_open;
        /// Muscles of both legs.
        AttachLegs = "attach-legs" [] Run(A::AttachSet(MuscleSet::Leg)), if is_open;
        /// Muscles of arms and legs.
        AttachBody = "attach-body" [] Run(A::AttachSet(MuscleSet::Body)), if is_open;
        /// Take the muscle that is shown away.
        DeleteMuscle = "delete-muscle" [] Run(A::DeleteMuscle), if has_muscles;
        /// Pick the bone that the muscle comes from.
        PickOrigin = "pick-origin" [] Change(|session| pick_end(session, 0)), if has_bones;
        /// Pick the bone that the muscle goes to.
        PickInsertion = "pick-insertion" [] Change(|session| pick_end(session, 1)), if has_bones;
        /// Undo.
        Undo = "undo" ["<Control>z"] Change(Session::undo), if can_undo;
        /// Redo.
        Redo = "redo" ["<Control><Shift>z", "<Control>y"] Change(Session::redo), if can_redo;
    }
    Display {
        /// Bones.
        Bones = "bones" ["b"] Flag(|display| &mut display.bones);
        /// Names of bones.
        BoneNames = "bone-names" ["j"] Toggle(Session::bone_names, |session| session.set_bone_names(!session.bone_names()));
        /// Axes of bones.
        BoneAxes = "bone-axes" [] Flag(|display| &mut display.bone_axes);
        /// Bones through surfaces.
        Xray = "xray" [] Flag(|display| &mut display.xray);
        /// Meshes.
        Mesh = "mesh" [] Flag(|display| &mut display.mesh);
        /// Muscles.
        Muscle = "muscle" ["m"] Flag(|display| &mut display.muscle);
        /// Muscles through the skin.
        SeeThrough = "see-through" [] Flag(|display| &mut display.see_through), if has_skins;
        /// Muscles move the skin over them.
        SkinFollowsMuscles = "skin-follows-muscles" []
            Toggle(Session::skin_follows_muscles, |session| session.set_skin_follows_muscles(!session.skin_follows_muscles())),
            if has_muscles_under_skin;
        /// Lines of action of muscles.
        LinesOfAction = "lines-of-action" [] Flag(|display| &mut display.lines_of_action), if has_muscles;
        /// Materials and textures.
        Materials = "materials" ["t"] Flag(|display| &mut display.materials);
        /// Normals in lighting.
        SmoothNormals = "smooth-normals" ["n"] Flag(|display| &mut display.smooth_normals);
        /// Lines along normals.
        NormalGlyphs = "normal-glyphs" ["<Shift>n"] Flag(|display| &mut display.normal_glyphs);
        /// Edges of triangles.
        Wireframe = "wireframe" ["e"] Flag(|display| &mut display.wireframe);
        /// Ground grid.
        Grid = "grid" ["c"] Flag(|display| &mut display.grid);
        /// World axes.
        Axes = "axes" ["x"] Flag(|display| &mut display.axes);
        /// Box round everything.
        BoundingBox = "bounding-box" [] Flag(|display| &mut display.bounding_box);
        /// Depth test.
        DepthTest = "depth-test" [] Flag(|display| &mut display.depth_test);
        /// No back faces.
        CullBackFaces = "cull-back-faces" [] Flag(|display| &mut display.cull_back_faces);
        /// Anti-aliasing.
        SmoothEdges = "anti-aliasing" [] Toggle(is_antialiased, toggle_antialiasing);
        /// The display preset "clean".
        PresetClean = "preset-clean" [] TakePreset(P::Clean);
        /// The display preset "skeleton".
        PresetSkeleton = "preset-skeleton" [] TakePreset(P::Skeleton);
        /// The display preset "inspection".
        PresetInspection = "preset-inspection" [] TakePreset(P::Inspection);
        /// The display preset "print".
        PresetPrint = "preset-print" [] TakePreset(P::Print);
        /// Flat shading.
        Flat = "flat" [] Shade(Shading::Flat);
        /// Gouraud shading.
        Gouraud = "gouraud" [] Shade(Shading::Gouraud);
        /// Phong shading.
        Phong = "phong" [] Shade(Shading::Phong);
    }
    Inspection {
        /// Weights of the selected bone.
        Weights = "weights" ["w"] Toggle(shows_weights, |session| session.set_weights(!shows_weights(session))), if can_show_weights;
        /// The moments before and after this one.
        OnionSkins = "onion-skins" ["h"] Toggle(shows_onion_skins, toggle_onion_skins), if can_show_onion_skins;
        /// Go along with the selection while a clip plays.
        Follow = "follow" ["<Shift>f"] Toggle(is_following, Session::toggle_follow), if can_follow;
        /// The path of the selection.
        BonePath = "bone-path" ["p"] Toggle(shows_motion_path, toggle_motion_path), if can_show_motion_path;
        /// Both ways to bend a skin.
        CompareSkinning = "compare-skinning" ["d"] Toggle(compares_skinning, toggle_skinning_comparison), if can_compare_skinning;
        /// No comparison any more.
        StopComparing = "stop-comparing" [] Change(|session| session.compare(None)), if is_comparing;
        /// The selection alone.
        Isolate = "isolate" ["slash"] EditToggle(Session::is_isolated, Session::toggle_isolated), if can_isolate;
        /// Hide the selection.
        Hide = "hide" ["<Shift>h"] Edit(Session::hide_selected), if has_selection;
        /// Show everything.
        ShowAll = "show-all" ["<Alt>h"] Edit(Session::show_all), if hides_something;
    }
    Window {
        /// Both side panels.
        Sidebars = "sidebars" ["F9"] Run(A::Sidebars);
        /// The scene tree.
        Tree = "tree" [] Switch(S::Tree);
        /// The right panel.
        Panel = "panel" [] Switch(S::Panel);
        /// The whole screen.
        Fullscreen = "fullscreen" ["F11"] Switch(S::Fullscreen);
        /// Frame times over the picture.
        FrameTimes = "frame-times" [] Switch(S::FrameTimes);
        /// As the desktop.
        ColoursSystem = "colours-system" [] Colors(ColorScheme::System);
        /// Light.
        ColoursLight = "colours-light" [] Colors(ColorScheme::Light);
        /// Dark.
        ColoursDark = "colours-dark" [] Colors(ColorScheme::Dark);
        /// The main menu.
        Menu = "menu" ["F10"] Run(A::Menu);
        /// What one can do and how.
        Help = "help" ["F1"] Run(A::Help);
        /// This list.
        Shortcuts = "shortcuts" ["<Control>question"] Run(A::Shortcuts);
        /// About.
        About = "about" [] Run(A::About);
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
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::Document;
    use crate::render::Display;
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
    fn every_switch_of_the_display_is_a_command_that_turns_it() {
        for (name, switch) in crate::app::settings::DISPLAY_FLAGS {
            let Some(Flag(flag)) = Command::from_id(name).map(Command::action) else { panic!("{name} is no switch of the display") };
            let [mut own, mut others] = [Display::default(), Display::default()];
            for on in [flag(&mut own), switch(&mut others)] {
                *on = !*on;
            }
            assert_eq!(own, others, "{name}");
        }
    }

    #[test]
    fn a_command_says_truly_whether_it_can_be_undone() {
        let mut undone = 0;
        for command in Command::ALL {
            let mut session = Session::new(Document::built_in());
            session.change_model(|model| model.set_scale(2.0));
            session.rotate_light(10.0, 5.0);
            session.set_contraction(50.0);
            session.select(session.document().scene.graph.iter().map(|(node, _)| node).last());
            if !command.is_possible(&Conditions { session: &session, can_retry: false, animates: true }) {
                continue;
            }
            let (change, is_edit) = match command.action() {
                Change(change) | Toggle(_, change) => (change, false),
                Edit(change) | EditToggle(_, change) => (change, true),
                _ => continue,
            };
            let before = session.undo_counts();
            change(&mut session);
            assert_eq!(session.undo_counts() != before, is_edit, "{command:?}");
            undone += usize::from(is_edit);
        }
        assert!(undone >= 5, "{undone}");
    }

    #[test]
    fn a_toggle_shows_what_it_did() {
        for command in Command::ALL {
            let mut session = Session::new(Document::built_in());
            if let Toggle(is_on, change) | EditToggle(is_on, change) = command.action()
                && command.is_possible(&Conditions { session: &session, can_retry: false, animates: true })
            {
                let before = is_on(&session);
                change(&mut session);
                assert_ne!(is_on(&session), before, "{command:?}");
            }
        }
    }
}

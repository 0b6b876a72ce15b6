//! What a command does, in the words of the table: a change of the session, or something that the window does.

use crate::app::settings::{ColorScheme, SheetPage};
use crate::muscle::sets::MuscleSet;
use crate::render::{Display, Shading};
use crate::scene::ViewDirection;
use crate::session::{DisplayPreset, Session, Tool};

/// What a command does.
pub(crate) enum Action {
    /// Changes the session in a way that undo does not take back.
    Change(fn(&mut Session)),
    /// Changes the session in a step of its own, which can be undone.
    Edit(fn(&mut Session)),
    /// Turns something of the session on or off, which undo does not take back; whether it is on, and the change.
    Toggle(fn(&Session) -> bool, fn(&mut Session)),
    /// Turns something of the session on or off in a step of its own, which can be undone.
    EditToggle(fn(&Session) -> bool, fn(&mut Session)),
    /// Turns a switch of the display.
    Flag(fn(&mut Display) -> &mut bool),
    /// Takes a tool in hand.
    TakeTool(Tool),
    /// Shades surfaces so.
    Shade(Shading),
    /// Looks from there.
    LookFrom(ViewDirection),
    /// Takes a display preset.
    TakePreset(DisplayPreset),
    /// Takes light or dark colours.
    Colors(ColorScheme),
    /// Turns something of the window on or off.
    Switch(AppSwitch),
    /// Has the window do something.
    Run(AppCommand),
}

/// What the window does on a command.
#[derive(Clone, Copy)]
pub(crate) enum AppCommand {
    /// Lets the user choose files to open.
    Open,
    /// Lets the user choose a file to compare with.
    CompareFile,
    /// Reads the open files again.
    Reload,
    /// Saves the muscles.
    Save,
    /// Saves the muscles under another name.
    SaveAs,
    /// Opens the file that is so many places on in its folder.
    Neighbour(isize),
    /// Closes the files.
    Close,
    /// Closes the window.
    Quit,
    /// Saves what is open and how it is looked at.
    SaveSession,
    /// Brings up the start page.
    StartPage,
    /// Saves the picture.
    Picture,
    /// Saves the picture without background.
    PictureTransparent,
    /// Copies the picture.
    CopyPicture,
    /// Opens the export dialog.
    Export,
    /// Zooms the timeline in by this factor.
    ZoomTime(f64),
    /// Shows all of the timeline.
    WholeTime,
    /// Flies, or lands.
    Fly,
    /// Adds a muscle.
    NewMuscle,
    /// Copies the muscle that is shown.
    DuplicateMuscle,
    /// Copies the muscle that is shown to the other side of its figure.
    MirrorMuscle,
    /// Puts a set of muscles on the figure of the clip.
    AttachSet(MuscleSet),
    /// Takes the muscle that is shown away.
    DeleteMuscle,
    /// Shows or folds away both side panels.
    Sidebars,
    /// Opens the main menu.
    Menu,
    /// Shows the help.
    Help,
    /// Shows all keys.
    Shortcuts,
    /// Shows what the program is.
    About,
}

/// What is on or off in the window.
#[derive(Clone, Copy)]
pub(crate) enum AppSwitch {
    /// The scene tree.
    Tree,
    /// The right panel.
    Panel,
    /// The whole screen.
    Fullscreen,
    /// Frame times over the picture.
    FrameTimes,
    /// A page below the track.
    Sheet(SheetPage),
    /// Eased jumps of the camera.
    SmoothCamera,
}

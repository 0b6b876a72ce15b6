//! What is remembered from one start to the next: a small YAML file in the user's config folder.

use std::io::Write;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::app::session::{Session, Tool};
use crate::export::atomic::write_whole;
use crate::export::guard::Output;
use crate::render::{Display, Samples, Shading};
use crate::stage::Backdrop;
pub use crate::stage::{SHADINGS, SWITCHES};
use crate::tr;

/// Light or dark, or what the desktop says.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Colours {
    /// As the desktop has it.
    #[default]
    System,
    /// Light.
    Light,
    /// Dark.
    Dark,
}

impl Colours {
    /// All choices, in the order of the menu.
    pub const ALL: [Self; 3] = [Self::System, Self::Light, Self::Dark];

    /// The name that actions and the file use.
    pub fn id(self) -> &'static str {
        match self {
            Self::System => "system",
            Self::Light => "light",
            Self::Dark => "dark",
        }
    }
}

/// What is unfolded below the track.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SheetPage {
    /// Nothing.
    #[default]
    None,
    /// The dope sheet.
    Keys,
    /// The curve view.
    Curves,
}

/// Everything that is remembered. A key that is missing has its default; one that is unknown (from a newer version) is passed over.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, rename_all = "kebab-case")]
pub struct Settings {
    /// Width of the window, logical pixels.
    pub width: i32,
    /// Height of the window.
    pub height: i32,
    /// Whether it fills the screen.
    pub maximised: bool,
    /// Whether the scene tree is shown.
    pub tree_shown: bool,
    /// Whether the right panel is shown.
    pub panel_shown: bool,
    /// The page of the right panel.
    pub page: String,
    /// The folder of the file that was opened last.
    pub folder: Option<PathBuf>,
    /// Light or dark.
    pub colours: Colours,
    /// What is unfolded below the track.
    pub sheet: SheetPage,
    /// Frames a second of the frame numbers; none = what the keys tell.
    pub frame_rate: Option<f64>,
    /// Whether jumps of the camera are eased, where the desktop wants animation.
    pub smooth_camera: bool,
    /// Whether the names of bones are written.
    pub bone_names: bool,
    /// What stands behind the scene.
    pub backdrop: Backdrop,
    /// Side of a cell of the ground grid, metres; none = after the size of the scene.
    pub grid_cell: Option<f32>,
    /// How many times as wide as usual lines are.
    pub line_width: f32,
    /// Ambient light, 0 to 1.
    pub ambient: f32,
    /// Whether frame times are shown over the picture.
    pub frame_times: bool,
    /// `flat`, `gouraud` or `phong`.
    pub shading: String,
    /// Anti-aliasing.
    pub smooth_edges: bool,
    /// Switches of the display that are on.
    pub shown: Vec<String>,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            width: 1280,
            height: 800,
            maximised: false,
            tree_shown: true,
            panel_shown: true,
            page: "muscle".into(),
            folder: None,
            colours: Colours::System,
            sheet: SheetPage::None,
            frame_rate: None,
            smooth_camera: true,
            bone_names: false,
            backdrop: Backdrop::Theme,
            grid_cell: None,
            line_width: 1.0,
            ambient: Display::default().ambient,
            frame_times: false,
            shading: "gouraud".into(),
            smooth_edges: true,
            shown: ["mesh", "muscle", "see-through", "materials", "smooth-normals", "xray", "grid", "depth-test"]
                .map(String::from)
                .to_vec(),
        }
    }
}

impl Settings {
    /// The file: `sinew/settings.yaml` in the user's config folder.
    pub fn path() -> PathBuf {
        gtk4::glib::user_config_dir().join("sinew").join("settings.yaml")
    }

    /// Reads the file. A missing one is the defaults; a broken one too, with a sentence for the user.
    pub fn load(path: &Path) -> (Self, Option<String>) {
        let text = match std::fs::read_to_string(path) {
            Ok(text) => text,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return (Self::default(), None),
            Err(error) => return (Self::default(), Some(broken(path, &error.to_string()))),
        };
        match serde_yaml::from_str::<Option<Self>>(&text) {
            Ok(settings) => (settings.unwrap_or_default().sane(), None),
            Err(error) => (Self::default(), Some(broken(path, &error.to_string()))),
        }
    }

    /// Writes the file by way of a temporary one.
    ///
    /// # Errors
    /// Whatever the file system says; the old file stays then.
    pub fn save(&self, path: &Path) -> std::io::Result<()> {
        let folder = path.parent().unwrap_or(Path::new("."));
        std::fs::create_dir_all(folder)?;
        let text = serde_yaml::to_string(self).map_err(std::io::Error::other)?;
        write_whole(&Output::of_program(path), |file| file.write_all(text.as_bytes())).map_err(std::io::Error::other)
    }

    fn sane(mut self) -> Self {
        self.width = self.width.clamp(640, 16_384);
        self.height = self.height.clamp(480, 16_384);
        let default = Self::default();
        self.line_width = if self.line_width.is_finite() { self.line_width.clamp(0.5, 4.0) } else { default.line_width };
        self.ambient = if self.ambient.is_finite() { self.ambient.clamp(0.0, 1.0) } else { default.ambient };
        self.grid_cell = self.grid_cell.filter(|cell| cell.is_finite() && *cell > 0.0);
        self.frame_rate = self.frame_rate.filter(|rate| rate.is_finite() && (1.0..=1000.0).contains(rate));
        self
    }

    /// Puts the remembered looks into a session.
    pub fn apply(&self, session: &mut Session) {
        let shading = SHADINGS.iter().find(|(name, _)| *name == self.shading).map_or(Shading::Gouraud, |(_, shading)| *shading);
        let samples = if self.smooth_edges { Samples::Four } else { Samples::One };
        session.change_display(|display| {
            (display.shading, display.samples) = (shading, samples);
            (display.grid_cell, display.line_width, display.ambient) = (self.grid_cell, self.line_width, self.ambient);
            for (name, switch) in SWITCHES {
                *switch(display) = self.shown.iter().any(|shown| shown == name);
            }
        });
        session.set_bone_names(self.bone_names);
        session.set_backdrop(self.backdrop);
        session.choose_rate(self.frame_rate);
        session.set_tool(Tool::Navigate);
    }

    /// Takes the looks of a session over.
    pub fn take(&mut self, session: &Session) {
        let mut display = session.display().clone();
        self.shading = SHADINGS.iter().find(|(_, shading)| *shading == display.shading).map_or("gouraud", |(name, _)| name).into();
        self.smooth_edges = display.samples == Samples::Four;
        (self.grid_cell, self.line_width, self.ambient) = (display.grid_cell, display.line_width, display.ambient);
        (self.bone_names, self.backdrop, self.frame_rate) = (session.bone_names(), session.backdrop(), session.chosen_rate());
        self.shown = SWITCHES.iter().filter(|(_, switch)| *switch(&mut display)).map(|(name, _)| (*name).to_owned()).collect();
    }
}

/// What a user's own looks are while a session file's are shown.
#[derive(Debug, Clone, PartialEq)]
pub struct OwnLooks {
    own: Settings,
    file: Settings,
}

impl OwnLooks {
    /// The looks before the session file came and those that it brought.
    pub fn new(own: Settings, file: Settings) -> Self {
        Self { own, file }
    }

    /// The user's own looks where `now` is shown: what the file brought is not theirs, what they changed since is.
    pub fn among(&self, now: &Settings) -> Settings {
        fn own<T: PartialEq + Clone>(now: &T, file: &T, own: &T) -> T {
            if now == file { own.clone() } else { now.clone() }
        }
        let (mine, file) = (&self.own, &self.file);
        let shown = SWITCHES.iter().map(|(name, _)| *name).filter(|name| {
            let on = |settings: &Settings| settings.shown.iter().any(|shown| shown == name);
            own(&on(now), &on(file), &on(mine))
        });
        Settings {
            frame_rate: own(&now.frame_rate, &file.frame_rate, &mine.frame_rate),
            bone_names: own(&now.bone_names, &file.bone_names, &mine.bone_names),
            backdrop: own(&now.backdrop, &file.backdrop, &mine.backdrop),
            grid_cell: own(&now.grid_cell, &file.grid_cell, &mine.grid_cell),
            line_width: own(&now.line_width, &file.line_width, &mine.line_width),
            ambient: own(&now.ambient, &file.ambient, &mine.ambient),
            shading: own(&now.shading, &file.shading, &mine.shading),
            smooth_edges: own(&now.smooth_edges, &file.smooth_edges, &mine.smooth_edges),
            shown: shown.map(String::from).collect(),
            ..now.clone()
        }
    }
}

fn broken(path: &Path, reason: &str) -> String {
    tr!("app-settings-broken", file = path.display().to_string(), reason = reason.lines().next().unwrap_or_default().to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_saved_comes_back() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("new").join("settings.yaml");
        let mut session = Session::default();
        session.change_display(|display| {
            display.bones = true;
            display.grid = false;
            display.shading = Shading::Phong;
            display.samples = Samples::One;
        });
        let mut settings = Settings { width: 1000, colours: Colours::Dark, folder: Some("/tmp/ü".into()), ..Settings::default() };
        settings.take(&session);
        settings.save(&path).expect("saved");
        let (loaded, notice) = Settings::load(&path);
        assert_eq!((&loaded, notice), (&settings, None));
        let mut other = Session::default();
        loaded.apply(&mut other);
        assert_eq!(other.display(), session.display());
    }

    #[test]
    fn looks_of_a_file_are_not_the_users_but_changes_to_them_are() {
        let own = Settings { line_width: 2.0, shown: vec!["grid".into(), "mesh".into()], ..Settings::default() };
        let file = Settings { line_width: 1.0, shading: "flat".into(), shown: vec!["bones".into(), "mesh".into()], ..own.clone() };
        let held = OwnLooks::new(own.clone(), file.clone());
        let back = held.among(&file);
        assert_eq!((back.line_width, back.shading.as_str()), (2.0, "gouraud"));
        assert!(back.shown.contains(&"grid".into()) && back.shown.contains(&"mesh".into()) && back.shown.len() == 2, "{:?}", back.shown);
        let touched = Settings { shading: "phong".into(), shown: vec!["bones".into(), "axes".into()], ..file };
        let back = held.among(&touched);
        assert_eq!(back.shading, "phong");
        let has = |name: &str| back.shown.iter().any(|shown| shown == name);
        assert!(has("grid") && has("axes") && !has("mesh") && !has("bones"), "{:?}", back.shown);
    }

    #[test]
    fn defaults_are_the_defaults_of_the_display() {
        let mut session = Session::default();
        let before = session.display().clone();
        Settings::default().apply(&mut session);
        assert_eq!(session.display(), &before);
    }

    #[test]
    fn a_broken_file_is_ignored_with_a_notice() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("settings.yaml");
        assert_eq!(Settings::load(&path), (Settings::default(), None));
        for (text, good) in [("", true), ("width: 900\nfuture: 1\n", true), ("width: wide", false), ("[1", false), ("\u{0}", false)] {
            std::fs::write(&path, text).expect("written");
            let (settings, notice) = Settings::load(&path);
            assert_eq!(notice.is_none(), good, "{text:?}");
            assert!(good || settings == Settings::default());
        }
        std::fs::write(&path, "width: -5\nheight: 2000000000").expect("written");
        let (settings, _) = Settings::load(&path);
        assert!(settings.width >= 640 && settings.height <= 16_384);
    }
}

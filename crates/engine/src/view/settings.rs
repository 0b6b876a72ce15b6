//! Settings that are kept between starts: a small YAML file in the user's config folder. This module holds the data; the window's `settings` says where the
//! file is and applies it to a session.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::DisplayOptions;
use super::save_error::{self, SaveError};
use crate::input;
use sinew_scene::limits;
use sinew_scene::message;
use sinew_scene::message::{Message, ToMessage};
use sinew_yaml::YamlError;

/// Colour scheme of the window.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ColorScheme {
    /// As the desktop has it.
    #[default]
    System,
    /// Light.
    Light,
    /// Dark.
    Dark,
}

impl ColorScheme {
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

/// The page that is open below the timeline.
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

/// All settings. A missing key has its default; an unknown one (from a newer version) is ignored.
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
    pub colours: ColorScheme,
    /// The page that is open below the timeline.
    pub sheet: SheetPage,
    /// Whether jumps of the camera are eased, where the desktop wants animation.
    pub smooth_camera: bool,
    /// Whether frame times are shown over the picture.
    pub frame_times: bool,
    /// What is drawn and how.
    #[serde(flatten, skip_deserializing)]
    pub display: DisplayOptions,
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
            colours: ColorScheme::System,
            sheet: SheetPage::None,
            smooth_camera: true,
            frame_times: false,
            display: DisplayOptions::default(),
        }
    }
}

impl Settings {
    /// Reads the file. A missing one is the defaults; a broken one too, with a message for the user.
    pub fn load(path: &Path) -> (Self, Option<Message>) {
        let text = match input::read_text(path, limits::YAML_BYTES) {
            Ok(text) => text,
            Err(refused) if refused.is_missing() => return (Self::default(), None),
            Err(refused) => return (Self::default(), Some(broken(path, refused.message()))),
        };
        match Self::parse(&text) {
            Ok(settings) => (settings, None),
            Err(error) => (Self::default(), Some(broken(path, error.message()))),
        }
    }

    /// Reads the file's text; numbers out of range are held at the limit.
    ///
    /// # Errors
    /// [`YamlError`].
    pub fn parse(text: &str) -> Result<Self, YamlError> {
        let own = sinew_yaml::from_text::<Self>(text, limits::YAML_BYTES)?;
        // Read apart, so that an error in either has its line.
        let display = sinew_yaml::from_text::<DisplayOptions>(text, limits::YAML_BYTES)?;
        Ok(Self { display, ..own }.clamped())
    }

    /// As YAML.
    ///
    /// # Errors
    /// [`YamlError`]; settings can always be written.
    pub fn to_yaml(&self) -> Result<String, YamlError> {
        sinew_yaml::to_text(self)
    }

    /// Writes the file by way of a temporary one.
    ///
    /// # Errors
    /// [`SaveError`]; the old file stays then.
    pub fn save(&self, path: &Path) -> Result<(), SaveError> {
        save_error::write(path, &self.to_yaml()?)
    }

    fn clamped(mut self) -> Self {
        self.width = self.width.clamp(640, 16_384);
        self.height = self.height.clamp(480, 16_384);
        self.display = self.display.clamped();
        self
    }
}

fn broken(path: &Path, reason: Message) -> Message {
    message!("app-settings-broken", file = path, reason = reason)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_broken_file_is_ignored_with_a_notice() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("settings.yaml");
        assert_eq!(Settings::load(&path), (Settings::default(), None));
        for (text, good) in
            [("", true), ("width: 900\nfuture: 1\n", true), ("width: wide", false), ("[1", false), ("\u{0}", false), ("[]", false)]
        {
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

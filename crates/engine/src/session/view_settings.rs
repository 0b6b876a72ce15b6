//! The view settings that are copied to and from a session.

use super::{ChangeSet, Session, Tool};
use crate::view::{DisplayOptions, Settings};

impl Session {
    /// What is drawn and how.
    pub fn display_options(&self) -> DisplayOptions {
        self.view.options()
    }

    /// Changes what is drawn and how.
    pub fn set_display_options(&mut self, options: &DisplayOptions) {
        if *options != self.display_options() {
            self.view.set_options(options);
            self.choose_rate(options.frame_rate);
            self.changed(ChangeSet::DISPLAY);
        }
    }
}

impl Settings {
    /// Applies the view settings to a session.
    pub fn apply(&self, session: &mut Session) {
        session.set_display_options(&self.display);
        session.set_tool(Tool::Navigate);
    }

    /// Captures the view settings of a session.
    pub fn capture(&mut self, session: &Session) {
        self.display = session.display_options();
    }
}

/// The user's view settings while a session file's are shown.
#[derive(Debug, Clone, PartialEq)]
pub struct SavedViewSettings {
    own: DisplayOptions,
    file: DisplayOptions,
}

impl SavedViewSettings {
    /// The view settings before the session file was opened, and those of the file.
    pub fn new(own: Settings, file: Settings) -> Self {
        Self { own: own.display, file: file.display }
    }

    /// The user's view settings, where `now` is shown: values of the file are not the user's, later changes are.
    pub fn merged_into(&self, now: &Settings) -> Settings {
        Settings { display: self.file.give_back(&self.own, &now.display), ..now.clone() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::view::ColorScheme;
    use sinew_render::{Samples, Shading};

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
        let mut settings = Settings { width: 1000, colours: ColorScheme::Dark, folder: Some("/tmp/ü".into()), ..Settings::default() };
        settings.capture(&session);
        settings.save(&path).expect("saved");
        let (loaded, notice) = Settings::load(&path);
        assert_eq!((&loaded, notice), (&settings, None));
        let mut other = Session::default();
        loaded.apply(&mut other);
        assert_eq!(other.display(), session.display());
    }

    #[test]
    fn defaults_are_the_defaults_of_the_display() {
        let mut session = Session::default();
        let before = session.display().clone();
        Settings::default().apply(&mut session);
        assert_eq!(session.display(), &before);
    }
}

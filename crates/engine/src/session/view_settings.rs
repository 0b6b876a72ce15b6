//! The view settings that are copied to and from a session.

use super::{Session, Tool};
use crate::view::{DISPLAY_FLAGS, SHADINGS, Settings};
use sinew_render::{Samples, Shading};

impl Settings {
    /// Applies the view settings to a session.
    pub fn apply(&self, session: &mut Session) {
        let shading = SHADINGS.iter().find(|(name, _)| *name == self.shading).map_or(Shading::Gouraud, |(_, shading)| *shading);
        let samples = if self.smooth_edges { Samples::Four } else { Samples::One };
        session.change_display(|display| {
            (display.shading, display.samples) = (shading, samples);
            (display.grid_cell, display.line_width, display.ambient) = (self.grid_cell, self.line_width, self.ambient);
            for (name, switch) in DISPLAY_FLAGS {
                *switch(display) = self.shown.iter().any(|shown| shown == name);
            }
        });
        session.set_bone_names(self.bone_names);
        session.set_backdrop(self.backdrop);
        session.choose_rate(self.frame_rate);
        session.set_tool(Tool::Navigate);
    }

    /// Captures the view settings of a session.
    pub fn capture(&mut self, session: &Session) {
        let mut display = session.display().clone();
        self.shading = SHADINGS.iter().find(|(_, shading)| *shading == display.shading).map_or("gouraud", |(name, _)| name).into();
        self.smooth_edges = display.samples == Samples::Four;
        (self.grid_cell, self.line_width, self.ambient) = (display.grid_cell, display.line_width, display.ambient);
        (self.bone_names, self.backdrop, self.frame_rate) = (session.bone_names(), session.backdrop(), session.chosen_rate());
        self.shown = DISPLAY_FLAGS.iter().filter(|(_, switch)| *switch(&mut display)).map(|(name, _)| (*name).to_owned()).collect();
    }
}

/// The user's view settings while a session file's are shown.
#[derive(Debug, Clone, PartialEq)]
pub struct SavedViewSettings {
    own: Settings,
    file: Settings,
}

impl SavedViewSettings {
    /// The view settings before the session file was opened, and those of the file.
    pub fn new(own: Settings, file: Settings) -> Self {
        Self { own, file }
    }

    /// The user's view settings, where `now` is shown: values of the file are not the user's, later changes are.
    pub fn merged_into(&self, now: &Settings) -> Settings {
        fn own<T: PartialEq + Clone>(now: &T, file: &T, own: &T) -> T {
            if now == file { own.clone() } else { now.clone() }
        }
        let (mine, file) = (&self.own, &self.file);
        let shown = DISPLAY_FLAGS.iter().map(|(name, _)| *name).filter(|name| {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::view::ColorScheme;

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
    fn looks_of_a_file_are_not_the_users_but_changes_to_them_are() {
        let own = Settings { line_width: 2.0, shown: vec!["grid".into(), "mesh".into()], ..Settings::default() };
        let file = Settings { line_width: 1.0, shading: "flat".into(), shown: vec!["bones".into(), "mesh".into()], ..own.clone() };
        let held = SavedViewSettings::new(own.clone(), file.clone());
        let back = held.merged_into(&file);
        assert_eq!((back.line_width, back.shading.as_str()), (2.0, "gouraud"));
        assert!(back.shown.contains(&"grid".into()) && back.shown.contains(&"mesh".into()) && back.shown.len() == 2, "{:?}", back.shown);
        let touched = Settings { shading: "phong".into(), shown: vec!["bones".into(), "axes".into()], ..file };
        let back = held.merged_into(&touched);
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
}

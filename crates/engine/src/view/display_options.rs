//! What is drawn and how, as the settings and session files keep it: the one list of these keys.

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::{BackgroundPreset, DISPLAY_FLAGS, SHADINGS};
use sinew_render::{Display, Samples, Shading};

/// What is drawn and how. A missing key has its value of a fresh start.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, rename_all = "kebab-case")]
pub struct DisplayOptions {
    /// Frames a second of the frame numbers; `None` = what the keys tell.
    pub frame_rate: Option<f64>,
    /// Whether the names of bones are written beside them.
    pub bone_names: bool,
    /// Background of the viewport.
    pub backdrop: BackgroundPreset,
    /// Side of a cell of the ground grid, metres; `None` = after the size of the scene.
    pub grid_cell: Option<f32>,
    /// How many times as wide as usual lines are, 0.5 to 4.
    #[serde(deserialize_with = "line_width")]
    pub line_width: f32,
    /// Ambient light, 0 to 1.
    #[serde(deserialize_with = "ambient")]
    pub ambient: f32,
    /// Where lighting is computed.
    #[serde(serialize_with = "shading_name", deserialize_with = "shading")]
    pub shading: Shading,
    /// Anti-aliasing.
    pub smooth_edges: bool,
    /// Names of the display flags that are on.
    pub shown: Vec<String>,
}

impl Default for DisplayOptions {
    fn default() -> Self {
        Self::of(&Display::default(), BackgroundPreset::default(), false, None)
    }
}

impl DisplayOptions {
    /// The options of a display, with what a display does not hold.
    pub fn of(display: &Display, backdrop: BackgroundPreset, bone_names: bool, frame_rate: Option<f64>) -> Self {
        let mut display = display.clone();
        Self {
            frame_rate,
            bone_names,
            backdrop,
            grid_cell: display.grid_cell,
            line_width: display.line_width,
            ambient: display.ambient,
            shading: display.shading,
            smooth_edges: display.samples == Samples::Four,
            shown: DISPLAY_FLAGS.iter().filter(|(_, flag)| *flag(&mut display)).map(|(name, _)| (*name).to_owned()).collect(),
        }
    }

    /// Sets flags, shading and numbers of a display.
    pub fn apply_to(&self, display: &mut Display) {
        display.shading = self.shading;
        display.samples = if self.smooth_edges { Samples::Four } else { Samples::One };
        (display.grid_cell, display.line_width, display.ambient) = (self.grid_cell, self.line_width, self.ambient);
        for (name, flag) in DISPLAY_FLAGS {
            *flag(display) = self.is_shown(name);
        }
    }

    /// The same with numbers out of range held at the limit, and those that are none as at a fresh start.
    pub fn clamped(self) -> Self {
        let usual = Self::default();
        let held = |number: f32, low: f32, high: f32, usual: f32| if number.is_finite() { number.clamp(low, high) } else { usual };
        Self {
            frame_rate: self.frame_rate.filter(|rate| (1.0..=1000.0).contains(rate)),
            grid_cell: self.grid_cell.filter(|cell| cell.is_finite() && *cell > 0.0),
            line_width: held(self.line_width, 0.5, 4.0, usual.line_width),
            ambient: held(self.ambient, 0.0, 1.0, usual.ambient),
            ..self
        }
    }

    /// `now`, where these options are shown in place of the user's own: what is still as these have it is as in `own`, what was changed since stays.
    pub fn give_back(&self, own: &Self, now: &Self) -> Self {
        fn back<T: PartialEq + Clone>(now: &T, shown: &T, own: &T) -> T {
            if now == shown { own.clone() } else { now.clone() }
        }
        let flag = |name: &&str| back(&now.is_shown(name), &self.is_shown(name), &own.is_shown(name));
        Self {
            frame_rate: back(&now.frame_rate, &self.frame_rate, &own.frame_rate),
            bone_names: back(&now.bone_names, &self.bone_names, &own.bone_names),
            backdrop: back(&now.backdrop, &self.backdrop, &own.backdrop),
            grid_cell: back(&now.grid_cell, &self.grid_cell, &own.grid_cell),
            line_width: back(&now.line_width, &self.line_width, &own.line_width),
            ambient: back(&now.ambient, &self.ambient, &own.ambient),
            shading: back(&now.shading, &self.shading, &own.shading),
            smooth_edges: back(&now.smooth_edges, &self.smooth_edges, &own.smooth_edges),
            shown: DISPLAY_FLAGS.iter().map(|(name, _)| *name).filter(flag).map(String::from).collect(),
        }
    }

    fn is_shown(&self, name: &str) -> bool {
        self.shown.iter().any(|shown| shown == name)
    }
}

fn shading_name<S: Serializer>(shading: &Shading, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(SHADINGS.iter().find(|(_, known)| known == shading).map_or("gouraud", |(name, _)| name))
}

/// A name that is not known is the usual shading: a newer version may know more.
fn shading<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Shading, D::Error> {
    let name = String::deserialize(deserializer)?;
    Ok(SHADINGS.iter().find(|(known, _)| *known == name).map_or(Shading::Gouraud, |(_, shading)| *shading))
}

/// Session files of older versions say `null` where a number is as usual.
fn line_width<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f32, D::Error> {
    Ok(Option::deserialize(deserializer)?.unwrap_or(Display::default().line_width))
}

fn ambient<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f32, D::Error> {
    Ok(Option::deserialize(deserializer)?.unwrap_or(Display::default().ambient))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> DisplayOptions {
        sinew_yaml::from_text(text, 1000).expect("sound YAML")
    }

    #[test]
    fn a_key_that_is_missing_means_a_fresh_start() {
        let (mut display, default) = (Display { wireframe: true, mesh: false, ..Display::default() }, Display::default());
        parse("time: 1").apply_to(&mut display);
        assert_eq!(display, default);
        parse("{shown: [], smooth-edges: false, shading: newest, line-width: null, ambient: null}").apply_to(&mut display);
        assert!(!display.mesh && display.samples == Samples::One && display.shading == Shading::Gouraud);
        assert_eq!((display.line_width, display.ambient), (default.line_width, default.ambient));
    }

    #[test]
    fn what_is_written_is_read_and_senseless_numbers_are_not_kept() {
        let display = Display { bones: true, grid: false, shading: Shading::Phong, grid_cell: Some(0.5), ..Display::default() };
        let options = DisplayOptions::of(&display, BackgroundPreset::White, true, Some(25.0));
        assert_eq!(parse(&sinew_yaml::to_text(&options).expect("written")), options);
        let bad = parse("{line-width: .nan, ambient: 7, grid-cell: -1, frame-rate: .inf}").clamped();
        assert_eq!(bad, DisplayOptions { ambient: 1.0, ..DisplayOptions::default() });
    }

    #[test]
    fn what_a_file_shows_is_not_the_users_but_what_is_changed_then_is() {
        let flags = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect();
        let own = DisplayOptions { line_width: 2.0, shown: flags(&["grid", "mesh"]), ..DisplayOptions::default() };
        let file = DisplayOptions { line_width: 1.0, shading: Shading::Flat, shown: flags(&["bones", "mesh"]), ..own.clone() };
        let back = file.give_back(&own, &file);
        assert_eq!((back.line_width, back.shading), (2.0, Shading::Gouraud));
        assert!(back.is_shown("grid") && back.is_shown("mesh") && back.shown.len() == 2, "{:?}", back.shown);
        let touched = DisplayOptions { shading: Shading::Phong, shown: flags(&["bones", "axes"]), ..file.clone() };
        let back = file.give_back(&own, &touched);
        assert_eq!(back.shading, Shading::Phong);
        assert!(["grid", "axes"].iter().all(|name| back.is_shown(name)) && !["mesh", "bones"].iter().any(|name| back.is_shown(name)));
    }
}

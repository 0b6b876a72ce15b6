//! Editor of how skin lies over the muscles of a file: fat layer, reach and elasticity.

use gtk::prelude::*;
use gtk4 as gtk;

use super::muscle_editor::{Editor, connect_entry, show_text};
use crate::app::format;
use crate::app::widgets::ui;
use crate::muscle::{Edit, MuscleFile, SkinSpec};
use crate::scene::MuscleId;
use crate::session::{Session, UndoStep};

ui::widgets! {
    /// The widgets of the muscle panel for the skin over the muscles.
    struct SkinWidgets in "muscle_panel.ui" {
        skin: gtk::Box,
        skin_fat: gtk::Entry,
        skin_fat_unit: gtk::Label,
        skin_reach: gtk::Entry,
        skin_reach_unit: gtk::Label,
        skin_elasticity: gtk::Entry,
        skin_refused: gtk::Label,
    }
}

/// A number that says how skin lies over muscles.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Field {
    Fat,
    Reach,
    Elasticity,
}

impl Field {
    fn of(self, skin: &mut SkinSpec) -> &mut f64 {
        match self {
            Self::Fat => &mut skin.fat,
            Self::Reach => &mut skin.reach,
            Self::Elasticity => &mut skin.elasticity,
        }
    }

    /// The number of a file as its entry shows it: a length in the file's unit to a hundredth of a millimetre or finer.
    fn text(self, file: &MuscleFile) -> String {
        let digits = match self {
            Self::Fat | Self::Reach => 2.0 + (file.unit_metres / 0.001).log10().ceil().clamp(0.0, 6.0),
            Self::Elasticity => 2.0,
        };
        format::number(*self.of(&mut skin_of(file)), digits as usize)
    }

    /// How skin lies over the muscles of a file once `text` was typed into the entry; what is no number becomes NaN, which every edit refuses.
    fn typed(self, text: &str, file: &MuscleFile) -> SkinSpec {
        let mut skin = skin_of(file);
        *self.of(&mut skin) = format::parse_number(text).unwrap_or(f64::NAN);
        skin
    }
}

/// How skin lies over the muscles of a file, lengths in its unit: what the file says, or what holds where it says nothing.
fn skin_of(file: &MuscleFile) -> SkinSpec {
    file.skin.unwrap_or_else(|| SkinSpec::in_unit(file.unit_metres))
}

/// The whole.
pub(crate) struct SkinEditor(SkinWidgets);

impl SkinEditor {
    /// That of a panel.
    pub(crate) fn new(builder: &gtk::Builder) -> Self {
        Self(SkinWidgets::of(builder))
    }

    /// Connects the input of the widgets. A rejected change is reported below them.
    pub(crate) fn connect(&self, editor: &Editor) {
        let editor = editor.refusing_in(self.0.skin_refused.clone());
        for (field, entry) in self.entries() {
            let own = editor.clone();
            connect_entry(entry, move |entry| take(&own, field, entry));
        }
    }

    /// What was refused is no longer of interest.
    pub(crate) fn forget_refusals(&self) {
        self.0.skin_refused.set_visible(false);
    }

    /// Shows how skin lies over the muscles of the file that muscle `id` is in. Where no skin follows a muscle there is nothing to show, unless
    /// the file itself says that it reaches too little for that.
    pub(crate) fn show(&self, session: &Session, id: MuscleId, unit: &str, anew: bool) {
        let document = session.document();
        let Some(file) = document.file_of_muscle(id).and_then(|(place, _)| document.muscle_files().nth(place)) else { return };
        let has_skin = document.has_muscles_under_skin() || file.skin.is_some() && !document.scene.skins.is_empty();
        self.0.skin.set_visible(has_skin);
        if !has_skin {
            return;
        }
        for label in [&self.0.skin_fat_unit, &self.0.skin_reach_unit] {
            label.set_text(unit);
        }
        for (field, entry) in self.entries() {
            show_text(entry, &field.text(file), anew);
        }
    }

    fn entries(&self) -> [(Field, &gtk::Entry); 3] {
        [(Field::Fat, &self.0.skin_fat), (Field::Reach, &self.0.skin_reach), (Field::Elasticity, &self.0.skin_elasticity)]
    }
}

/// Takes what was typed into an entry.
fn take(editor: &Editor, field: Field, entry: &gtk::Entry) {
    let Some(file) = editor.file() else { return };
    if entry.text() == field.text(&file) {
        return entry.remove_css_class("error");
    }
    let skin = field.typed(&entry.text(), &file);
    if !editor.edit(&Edit::Skin(Some(skin)), UndoStep::New) {
        return entry.add_css_class("error");
    }
    entry.remove_css_class("error");
    if let Some(file) = editor.file() {
        entry.set_text(&field.text(&file));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Field; 3] = [Field::Fat, Field::Reach, Field::Elasticity];

    fn file(unit_metres: f64, skin: Option<SkinSpec>) -> MuscleFile {
        MuscleFile { unit_metres, skin, ..MuscleFile::default() }
    }

    #[test]
    fn the_usual_layer_is_shown_in_the_unit_of_the_file() {
        let texts = |unit_metres: f64| ALL.map(|field| field.text(&file(unit_metres, None)));
        assert_eq!(texts(0.001), ["3.00", "40.00", "0.50"]);
        assert_eq!(texts(0.01), ["0.300", "4.000", "0.50"]);
        assert_eq!(texts(1.0), ["0.00300", "0.04000", "0.50"]);
        assert_eq!(texts(0.0254), ["0.1181", "1.5748", "0.50"]);
    }

    #[test]
    fn what_is_typed_changes_one_number_and_is_shown_again() {
        let mut file = file(0.001, Some(SkinSpec { fat: 2.0, reach: 30.0, elasticity: 0.25 }));
        for (field, typed, shown) in [(ALL[0], "12", "12.00"), (ALL[1], "55.5", "55.50"), (ALL[2], "1", "1.00")] {
            let before = ALL.map(|field| field.text(&file));
            file.skin = Some(field.typed(typed, &file));
            assert_eq!(field.text(&file), shown);
            for (other, before) in ALL.into_iter().zip(before).filter(|(other, _)| *other != field) {
                assert_eq!(other.text(&file), before);
            }
        }
        assert_eq!(file.skin, Some(SkinSpec { fat: 12.0, reach: 55.5, elasticity: 1.0 }));
    }

    #[test]
    fn what_cannot_be_is_refused() {
        let file = file(0.001, None);
        for (field, typed) in
            [(Field::Fat, "-1"), (Field::Fat, "soft"), (Field::Reach, "1000.5"), (Field::Elasticity, "1.1"), (Field::Reach, "")]
        {
            assert!(!field.typed(typed, &file).is_valid(file.unit_metres), "{field:?} {typed}");
        }
        assert!(Field::Reach.typed("1000", &file).is_valid(file.unit_metres));
    }
}

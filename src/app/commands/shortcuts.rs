//! Keys to commands. A Latin letter, a sign, a digit and a named key are themselves, whatever their keycode: keyboards on a screen, remote and virtual ones
//! send any. Only a letter that is not Latin means its place on the keyboard, so that the same keys work on ЙЦУКЕН.

use std::collections::HashMap;

use gtk4::gdk;

use super::Command;

/// Keycodes of X11 and Wayland (evdev + 8) that are letters, digits and brackets on a US keyboard.
const ROWS: [(u32, &str); 5] = [(10, "1234567890"), (24, "qwertyuiop[]"), (38, "asdfghjkl"), (51, "\\zxcvbnm,./"), (49, "`")];

/// A key with what is held down.
type Chord = (String, u8);

const SHIFT: u8 = 1;
const CONTROL: u8 = 2;
const ALT: u8 = 4;
const SUPER: u8 = 8;

/// Finds commands by keys.
pub(crate) struct KeyChords {
    commands: HashMap<Chord, Command>,
}

impl Default for KeyChords {
    fn default() -> Self {
        let all = Command::ALL.iter().flat_map(|command| command.keys().iter().map(|key| (parse(key), *command)));
        Self { commands: all.collect() }
    }
}

impl KeyChords {
    /// The command of a key press; `hardware` is its keycode where keycodes are those of X11 and Wayland.
    pub(crate) fn command(&self, key: gdk::Key, hardware: Option<u32>, modifiers: gdk::ModifierType) -> Option<Command> {
        chords(key, hardware, modifiers).iter().find_map(|chord| self.commands.get(chord)).copied()
    }
}

/// The letter or sign at a place of the keyboard, as on a US one.
pub(crate) fn at_place(hardware: u32) -> Option<char> {
    ROWS.iter().find_map(|(first, row)| hardware.checked_sub(*first).and_then(|place| row.chars().nth(place as usize)))
}

fn parse(accelerator: &str) -> Chord {
    let mut held = 0;
    let mut rest = accelerator;
    for (word, bit) in [("<Control>", CONTROL), ("<Shift>", SHIFT), ("<Alt>", ALT)] {
        if let Some(tail) = rest.strip_prefix(word) {
            held |= bit;
            rest = tail;
        }
    }
    (rest.to_owned(), held)
}

fn held(modifiers: gdk::ModifierType) -> u8 {
    use gdk::ModifierType as M;
    [(M::SHIFT_MASK, SHIFT), (M::CONTROL_MASK, CONTROL), (M::ALT_MASK, ALT), (M::SUPER_MASK, SUPER)]
        .iter()
        .filter(|(mask, _)| modifiers.contains(*mask))
        .fold(0, |sum, (_, bit)| sum | bit)
}

fn name(key: gdk::Key) -> String {
    let name = key.to_lower().name().map(String::from).unwrap_or_default();
    // The tilde is the shifted grave of most keyboards.
    if name == "asciitilde" {
        return "grave".into();
    }
    // Plus needs Shift on many keyboards, and stands on the number block too.
    if ["equal", "KP_Add"].contains(&name.as_str()) {
        return "plus".into();
    }
    match name.strip_prefix("KP_") {
        Some("Subtract") => "minus".into(),
        Some("Enter") => "Return".into(),
        Some(digit) if digit.len() == 1 => digit.into(),
        _ => name,
    }
}

/// The chords that a key press may mean, the likeliest first.
fn chords(key: gdk::Key, hardware: Option<u32>, modifiers: gdk::ModifierType) -> Vec<Chord> {
    let held = held(modifiers);
    let by_value = name(key);
    let sign = key.to_unicode().filter(|c| !c.is_whitespace() && !c.is_control());
    if sign.is_some_and(|c| c.is_alphabetic() && !is_latin(c)) {
        let by_place = hardware.and_then(at_place).and_then(|sign| gdk::Key::from_name(sign_name(sign))).map(name);
        return by_place.into_iter().map(|place| (place, held)).collect();
    }
    let mut found = vec![(by_value.clone(), held)];
    // A sign or a digit that needs Shift on this keyboard is meant without it.
    if sign.is_some_and(|c| !c.is_alphabetic()) {
        found.push((by_value, held & !SHIFT));
    }
    found
}

/// Whether a letter is of the Latin script, with whatever marks.
fn is_latin(letter: char) -> bool {
    matches!(letter, 'A'..='Z' | 'a'..='z' | '\u{AA}' | '\u{BA}' | '\u{C0}'..='\u{24F}' | '\u{1E00}'..='\u{1EFF}')
}

fn sign_name(sign: char) -> String {
    match sign {
        '[' => "bracketleft".into(),
        ']' => "bracketright".into(),
        '\\' => "backslash".into(),
        ',' => "comma".into(),
        '.' => "period".into(),
        '/' => "slash".into(),
        '`' => "grave".into(),
        letter => letter.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gdk::{Key, ModifierType as M};

    #[test]
    fn no_key_has_two_meanings() {
        let all = Command::ALL.iter().map(|command| command.keys().len()).sum::<usize>();
        assert_eq!(KeyChords::default().commands.len(), all);
    }

    #[test]
    fn every_key_is_one_that_gdk_knows() {
        for key in Command::ALL.iter().flat_map(|command| command.keys()) {
            let (name, _) = parse(key);
            assert!(Key::from_name(&name).is_some(), "{key}");
        }
    }

    #[test]
    fn what_is_latin_a_sign_or_named_is_itself_wherever_it_comes_from() {
        let keys = KeyChords::default();
        let command = |key: Key, code: Option<u32>| keys.command(key, code, M::empty());
        // Whatever the keycode: that of another letter, of a digit, of a named key, of nothing.
        for code in [None, Some(9), Some(10), Some(24), Some(25), Some(56), Some(65), Some(255)] {
            assert_eq!(command(Key::b, code), Some(Command::Bones), "{code:?}");
            assert_eq!(command(Key::w, code), Some(Command::Weights), "{code:?}");
            assert_eq!(command(Key::_1, code), Some(Command::Front), "{code:?}");
            assert_eq!(command(Key::bracketleft, code), Some(Command::Slower), "{code:?}");
            assert_eq!(command(Key::F1, code), Some(Command::Help), "{code:?}");
            assert_eq!(command(Key::space, code), Some(Command::Play), "{code:?}");
            assert_eq!(command(Key::Left, code), Some(Command::FrameBack), "{code:?}");
            // Signs and Latin letters of other keyboards that are no command's are none's.
            assert_eq!(command(Key::ampersand, code), None, "{code:?}");
            assert_eq!(command(Key::eacute, code), None, "{code:?}");
            assert_eq!(command(Key::z, code), None, "{code:?}");
        }
        // A digit for which a French keyboard needs Shift.
        assert_eq!(keys.command(Key::_1, Some(10), M::SHIFT_MASK), Some(Command::Front));
    }

    #[test]
    fn a_letter_that_is_not_latin_means_its_place() {
        let keys = KeyChords::default();
        assert_eq!(keys.command(Key::Cyrillic_i, Some(56), M::empty()), Some(Command::Bones));
        assert_eq!(keys.command(Key::Greek_beta, Some(56), M::empty()), Some(Command::Bones));
        assert_eq!(keys.command(Key::Cyrillic_ha, Some(34), M::empty()), Some(Command::Slower));
        assert_eq!(keys.command(Key::Cyrillic_i, None, M::empty()), None);
        assert_eq!(keys.command(Key::Cyrillic_TE, Some(57), M::SHIFT_MASK), Some(Command::NormalGlyphs));
    }

    #[test]
    fn so_it_is_with_control() {
        let keys = KeyChords::default();
        // Ctrl+Z on a French keyboard, where Z is at W's place, must not close the file.
        assert_eq!(keys.command(Key::z, Some(25), M::CONTROL_MASK), Some(Command::Undo));
        assert_eq!(keys.command(Key::Cyrillic_ya, Some(52), M::CONTROL_MASK), Some(Command::Undo));
        assert_eq!(keys.command(Key::Z, Some(52), M::CONTROL_MASK | M::SHIFT_MASK), Some(Command::Redo));
    }

    #[test]
    fn signs_numpad_and_named_keys() {
        let keys = KeyChords::default();
        assert_eq!(keys.command(Key::question, Some(61), M::CONTROL_MASK | M::SHIFT_MASK), Some(Command::Shortcuts));
        assert_eq!(keys.command(Key::KP_7, Some(79), M::empty()), Some(Command::Top));
        assert_eq!(keys.command(Key::KP_1, Some(87), M::CONTROL_MASK), Some(Command::Back));
        assert_eq!(keys.command(Key::Left, Some(113), M::SHIFT_MASK), Some(Command::First));
        assert_eq!(keys.command(Key::space, Some(65), M::empty()), Some(Command::Play));
        assert_eq!(keys.command(Key::asciitilde, Some(49), M::SHIFT_MASK), Some(Command::Fly));
        assert_eq!(keys.command(Key::N, Some(57), M::SHIFT_MASK), Some(Command::NormalGlyphs));
        assert_eq!(keys.command(Key::space, Some(65), M::SUPER_MASK), None);
        for (plus, code, shift) in [(Key::plus, 21, M::SHIFT_MASK), (Key::equal, 21, M::empty()), (Key::KP_Add, 86, M::empty())] {
            assert_eq!(keys.command(plus, Some(code), M::CONTROL_MASK | shift), Some(Command::TimeCloser));
        }
        // Minus stands where the six is elsewhere on a French keyboard.
        for (minus, code) in [(Key::minus, 20), (Key::minus, 15), (Key::KP_Subtract, 82)] {
            assert_eq!(keys.command(minus, Some(code), M::CONTROL_MASK), Some(Command::TimeWider));
        }
        assert_eq!(keys.command(Key::F9, Some(75), M::LOCK_MASK), Some(Command::Sidebars));
    }
}

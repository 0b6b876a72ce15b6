//! The shortcuts window, made from the table of commands, and the about window.

use std::fmt::Write;

use gtk::glib::markup_escape_text;
use gtk::prelude::*;
use gtk4 as gtk;

use crate::app::APPLICATION_ID;
use crate::app::commands::{Command, Group};
use crate::app::widgets::ui::object;
use crate::tr;

/// What the mouse does: the keys of its names and of its gestures in the catalogue.
const MOUSE: [(&str, &str); 9] = [
    ("app-mouse-orbit", "app-mouse-orbit-how"),
    ("app-mouse-pan", "app-mouse-pan-how"),
    ("app-mouse-zoom", "app-mouse-zoom-how"),
    ("app-mouse-zoom-pointer", "app-mouse-zoom-pointer-how"),
    ("app-mouse-light", "app-mouse-light-how"),
    ("app-mouse-pick", "app-mouse-pick-how"),
    ("app-mouse-centre", "app-mouse-centre-how"),
    ("app-mouse-fly", "app-mouse-fly-how"),
    ("app-mouse-time", "app-mouse-time-how"),
];

/// The sections of the shortcuts window, each short enough for one page: GTK puts the groups of several pages into an order of its own. The one with the
/// camera tells what the mouse does too.
const SECTIONS: [&[Group]; 4] = [
    &[Group::Files, Group::Pictures, Group::Window],
    &[Group::Playback, Group::Time],
    &[Group::Camera],
    &[Group::Model, Group::Display, Group::Inspection],
];

/// Shows all keys and what the mouse does.
pub(crate) fn shortcuts(parent: &gtk::ApplicationWindow) {
    let shortcuts: gtk::ShortcutsWindow = object(&gtk::Builder::from_string(&shortcuts_ui()), "shortcuts");
    shortcuts.set_transient_for(Some(parent));
    shortcuts.present();
}

/// The window as a `.ui` text.
fn shortcuts_ui() -> String {
    let mut text = String::from("<interface><object class=\"GtkShortcutsWindow\" id=\"shortcuts\"><property name=\"modal\">1</property>");
    let open_group = |text: &mut String, title: &str| {
        let title = markup_escape_text(title);
        // Writing to a string cannot fail.
        let _ = write!(text, "<child><object class=\"GtkShortcutsGroup\"><property name=\"title\">{title}</property>");
    };
    for (number, groups) in SECTIONS.iter().enumerate() {
        let mouse = groups.contains(&Group::Camera);
        let mut names: Vec<String> = groups.iter().map(|group| group.label()).collect();
        if mouse {
            names.push(tr!("app-group-mouse"));
        }
        let _ = write!(
            text,
            "<child><object class=\"GtkShortcutsSection\"><property name=\"section-name\">section-{number}</property>\
             <property name=\"max-height\">16</property><property name=\"title\">{}</property>",
            markup_escape_text(&names.join(" · "))
        );
        for group in *groups {
            let commands: Vec<Command> =
                Command::ALL.iter().copied().filter(|command| command.group() == *group && !command.keys().is_empty()).collect();
            open_group(&mut text, &group.label());
            for command in commands {
                let (label, keys) = (command.label(), command.keys().join(" "));
                let _ = write!(
                    text,
                    "<child><object class=\"GtkShortcutsShortcut\"><property name=\"title\">{}</property>\
                     <property name=\"accelerator\">{}</property></object></child>",
                    markup_escape_text(&label),
                    markup_escape_text(&keys)
                );
            }
            text.push_str("</object></child>");
        }
        if mouse {
            write_mouse(&mut text, &open_group);
        }
        text.push_str("</object></child>");
    }
    text.push_str("</object></interface>");
    text
}

/// The group of what the mouse does.
fn write_mouse(text: &mut String, open_group: &dyn Fn(&mut String, &str)) {
    open_group(text, &tr!("app-group-mouse"));
    for (name, how) in MOUSE {
        let _ = write!(
            text,
            "<child><object class=\"GtkShortcutsShortcut\"><property name=\"title\">{}</property><property name=\"subtitle\">{}</property>\
             <property name=\"shortcut-type\">gesture</property></object></child>",
            markup_escape_text(&tr!(name)),
            markup_escape_text(&tr!(how))
        );
    }
    text.push_str("</object></child>");
}

/// Shows what the program is.
pub(crate) fn about(parent: &gtk::ApplicationWindow) {
    let about = gtk::AboutDialog::builder()
        .transient_for(parent)
        .modal(true)
        .program_name("Sinew")
        .version(env!("CARGO_PKG_VERSION"))
        .comments(tr!("app-about"))
        .logo_icon_name(APPLICATION_ID)
        .license_type(gtk::License::MitX11)
        .build();
    about.present();
}

#[cfg(test)]
mod tests {
    use super::*;

    /// GTK breaks the page between groups only, and does not scroll: one that is too long would reach beyond the screen.
    #[test]
    fn no_group_is_longer_than_a_page() {
        for group in Group::ALL {
            let keys = Command::ALL.iter().filter(|command| command.group() == group && !command.keys().is_empty()).count();
            assert!((1..=13).contains(&keys), "{group:?}: {keys}");
        }
        let shown: Vec<Group> = SECTIONS.concat();
        assert!(Group::ALL.iter().all(|group| shown.contains(group)));
    }

    #[test]
    fn the_shortcuts_are_sound_xml_and_name_every_key() {
        let text = shortcuts_ui();
        let document = roxmltree::Document::parse(&text).expect("sound XML");
        let keys: Vec<_> =
            document.descendants().filter(|node| node.attribute("name") == Some("accelerator")).filter_map(|node| node.text()).collect();
        for command in Command::ALL.iter().filter(|command| !command.keys().is_empty()) {
            assert!(keys.contains(&command.keys().join(" ").as_str()), "{command:?}");
        }
        assert!(!text.contains("app-mouse"), "a gesture has no words");
    }
}

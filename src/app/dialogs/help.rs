//! The help window: what one can do, in a few paragraphs, with the keys of the table of commands.

use gtk::prelude::*;
use gtk::{gdk, glib};
use gtk4 as gtk;

use crate::app::commands::Command;
use crate::i18n::{FluentValue, message};
use crate::tr;

/// What tells the window from others.
const NAME: &str = "help";

/// The paragraphs: the names of their headings and of their texts in the catalogue.
const PARAGRAPHS: [(&str, &str); 7] = [
    ("app-help-open", "app-help-open-text"),
    ("app-help-navigate", "app-help-navigate-text"),
    ("app-help-time", "app-help-time-text"),
    ("app-help-inspect", "app-help-inspect-text"),
    ("app-help-muscle", "app-help-muscle-text"),
    ("app-help-export", "app-help-export-text"),
    ("app-help-trouble", "app-help-trouble-text"),
];

/// A text of the catalogue, in which `$id` stands for the key of the command with that id.
fn text(key: &str, key_of: impl Fn(Command) -> String) -> String {
    let keys: Vec<_> = Command::ALL.iter().map(|command| (command.id(), FluentValue::from(key_of(*command)))).collect();
    message(key, &keys)
}

/// Shows the help beside the window, so that it can be read while doing what it says.
pub(crate) fn show(parent: &gtk::ApplicationWindow) {
    if let Some(open) = gtk::Window::list_toplevels().into_iter().find(|open| open.widget_name() == NAME) {
        // A second one would hide the first.
        return open.downcast::<gtk::Window>().map_or((), |open| open.present());
    }
    let body = gtk::Box::new(gtk::Orientation::Vertical, 18);
    for set in [gtk::Box::set_margin_start, gtk::Box::set_margin_end, gtk::Box::set_margin_top, gtk::Box::set_margin_bottom] {
        set(&body, 18);
    }
    let label = |text: &str| gtk::Label::builder().label(text).xalign(0.0).wrap(true).max_width_chars(56);
    for (heading, key) in PARAGRAPHS {
        let paragraph = gtk::Box::new(gtk::Orientation::Vertical, 6);
        paragraph.append(&label(&tr!(heading)).css_classes(["heading"]).build());
        paragraph.append(&label(&text(key, Command::key_label)).build());
        body.append(&paragraph);
    }
    let scrolled = gtk::ScrolledWindow::builder().hscrollbar_policy(gtk::PolicyType::Never).child(&body).build();
    let help = gtk::Window::builder()
        .title(tr!("app-help-title"))
        .name(NAME)
        .transient_for(parent)
        .destroy_with_parent(true)
        .default_width(480)
        .default_height(600)
        .titlebar(&gtk::HeaderBar::new())
        .child(&scrolled)
        .build();
    let keys = gtk::EventControllerKey::new();
    keys.connect_key_pressed(glib::clone!(
        #[weak]
        help,
        #[upgrade_or]
        glib::Propagation::Proceed,
        move |_, key, _, _| {
            if matches!(key, gdk::Key::Escape | gdk::Key::F1) {
                help.close();
                return glib::Propagation::Stop;
            }
            glib::Propagation::Proceed
        }
    ));
    help.add_controller(keys);
    help.present();
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_key_in_the_help_is_one_of_the_table() {
        let mut named = 0;
        for (heading, key) in PARAGRAPHS {
            assert_ne!(tr!(heading), heading);
            // A name that is no command's would stay as it is.
            let shown = text(key, |command| format!("‹{}›", command.keys().first().copied().unwrap_or_default()));
            assert!(shown != key && !shown.contains('$'), "{shown}");
            named += shown.matches('‹').count();
        }
        assert!(named > 10);
    }
}

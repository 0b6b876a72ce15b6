//! What the header bar and the status line say.

use gtk::prelude::*;
use gtk4 as gtk;

use super::actions::Command;
use super::session::Session;
use super::window::part;
use super::{format, memory};
use crate::document::Missing;
use crate::tr;

/// Names what is open in the header bar and in the title of the window, with what it lacks.
pub fn name(builder: &gtk::Builder, window: &gtk::ApplicationWindow, session: &Session) {
    let sources = session.document().sources.iter();
    let names = sources.map(|source| match &source.path {
        Some(path) => path.file_name().map_or_else(|| source.name.clone(), |name| name.to_string_lossy().into_owned()),
        None => source.name.clone(),
    });
    let mut title = names.collect::<Vec<_>>().join(" + ");
    if title.is_empty() {
        title = tr!("app-name");
    }
    if let Some(clip) = session.clip().filter(|_| !session.is_empty()) {
        title = format!("{title} / {}", clip.name);
    }
    if session.is_unsaved() {
        title = format!("• {title}");
    }
    let missing = session.document().missing();
    let lacks = |what| missing.contains(&what);
    let subtitle = if session.is_empty() || missing.is_empty() {
        String::new()
    } else {
        let words = [
            (Missing::Mesh, "app-missing-mesh"),
            (Missing::Skeleton, "app-missing-skeleton"),
            (Missing::Animation, "app-missing-animation"),
        ];
        let what = words.iter().filter(|(what, _)| lacks(*what)).map(|(_, key)| tr!(key)).collect::<Vec<_>>().join(", ");
        if lacks(Missing::Animation) { tr!("app-missing-still", what = what) } else { tr!("app-missing", what = what) }
    };
    part::<gtk::Label>(builder, "title").set_text(&title);
    window.set_title(Some(&title));
    let label = part::<gtk::Label>(builder, "subtitle");
    label.set_text(&subtitle);
    label.set_tooltip_text(Some(&subtitle));
    label.set_visible(!subtitle.is_empty());
}

/// Says at the buttons what undo and redo would do.
pub fn name_steps(builder: &gtk::Builder, session: &Session) {
    let (back, forward) = session.step_names();
    for (id, command, step) in [("undo", Command::Undo, back), ("redo", Command::Redo, forward)] {
        let text = match step {
            Some(step) => tr!("app-step", what = command.label(), step = step, key = command.key_label()),
            None => command.tooltip(),
        };
        part::<gtk::Button>(builder, id).set_tooltip_text(Some(&text));
    }
}

/// Says in the status line how many triangles are drawn and how much memory the program takes.
pub fn tell_size(builder: &gtk::Builder, triangles: u64) {
    let text = tr!("app-status-triangles", count = triangles, shown = format::count(triangles));
    part::<gtk::Label>(builder, "status_triangles").set_text(&text);
    if let Some(megabytes) = memory::resident() {
        part::<gtk::Label>(builder, "status_memory").set_text(&tr!("app-status-memory", size = format::number(megabytes, 0)));
    }
}

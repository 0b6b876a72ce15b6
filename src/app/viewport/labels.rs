//! Labels of the two compared files, over the viewport.

use glam::Vec2;
use gtk4 as gtk;

use crate::app::format;
use crate::app::loading::named_sources;
use crate::app::panels::onion_skin_panel::file_name;
use crate::app::widgets::drawing_area::{PaintWidget, rgb, write_with_background};
use crate::document::Skinning;
use crate::i18n;
use crate::session::{COMPARED_TINT, CompareTarget, Session, top_of};
use crate::tr;

/// Names the two that are compared: over each where they stand side by side, else one below the other at the upper edge.
pub(super) fn draw(session: &mut Session, canvas: &PaintWidget, snapshot: &gtk::Snapshot, width: f64, height: f64) {
    let Some(compared) = session.compared() else { return };
    let Some(names) = names(session) else { return };
    let palette = &session.display().palette;
    let ground = rgb(palette.background.0).with_alpha(0.8);
    let text = canvas.text_color();
    let second = if matches!(session.compare_target(), Some(CompareTarget::Skinning)) { text } else { rgb(COMPARED_TINT) };
    let size = Vec2::new(width as f32, height as f32);
    let (_, _, camera, _) = session.picture();
    let mut highest = Vec::new();
    if compared.offset != 0.0 {
        highest.extend(compared.boxes.iter().filter_map(|bounds| camera.project(top_of(bounds), size)));
        highest.retain(|place| (0.0..=1.0).contains(&place.z));
    }
    for (row, (name, color)) in names.iter().zip([text, second]).enumerate() {
        // Some letters are wider than others; half of the usual width is near enough to the middle.
        let half = name.chars().count() as f64 * 3.7;
        let (x, y) = match highest.get(row).filter(|_| highest.len() == 2) {
            Some(place) => (f64::from(place.x), (f64::from(place.y) - 26.0).clamp(6.0, (height - 30.0).max(6.0))),
            None => (width / 2.0, 12.0 + row as f64 * 22.0),
        };
        write_with_background(canvas, snapshot, name, (x - half, y), 1.0, &color, &ground);
    }
}

fn names(session: &Session) -> Option<[String; 2]> {
    let own_path = || named_sources::sources(session.document()).first().map(|source| i18n::source_name(&source.name));
    let own = || own_path().map_or_else(|| tr!("app-name"), |path| file_name(&path));
    let ahead = |name: String, later: f64| {
        if later == 0.0 { name } else { tr!("app-compare-ahead", name = name, seconds = format::number(later, 2)) }
    };
    let later = session.compare_time_offset();
    Some(match session.compare_target()? {
        CompareTarget::File(_, name) => {
            // Two exports of one name are told apart by their folders.
            let (one, other) = own_path().map_or_else(|| (own(), file_name(name)), |path| told_apart(&path, name));
            [one, ahead(other, later)]
        }
        CompareTarget::Clip(clip) => {
            let now = session.clip().map_or_else(own, |clip| i18n::label(clip.label()).into_owned());
            [now, ahead(i18n::label(session.document().clips.get(*clip)?.label()).into_owned(), later)]
        }
        CompareTarget::Skinning => {
            let (linear, dual) = (tr!("app-skinning-linear"), tr!("app-skinning-dual"));
            if session.state().skinning == Skinning::Linear { [linear, dual] } else { [dual, linear] }
        }
    })
}

/// The names of two files, with as many of their folders as it takes to tell them apart.
fn told_apart(one: &str, other: &str) -> (String, String) {
    let parts = |path: &str| {
        let whole = std::path::absolute(path).unwrap_or_else(|_| path.into());
        whole.components().rev().map(|part| part.as_os_str().to_string_lossy().into_owned()).collect::<Vec<_>>()
    };
    let (one, other) = (parts(one), parts(other));
    let differ = one.iter().zip(&other).position(|(a, b)| a != b).unwrap_or(0) + 1;
    let name = |parts: &[String]| {
        let mut taken: Vec<&str> = parts.iter().take(differ).map(String::as_str).collect();
        taken.reverse();
        taken.join("/")
    };
    (name(&one), name(&other))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_of_one_name_are_told_apart_by_their_folders() {
        let named = |one: &str, other: &str| {
            let (one, other) = told_apart(one, other);
            format!("{one} {other}")
        };
        assert_eq!(named("/a/walk.dae", "/b/run.dae"), "walk.dae run.dae");
        assert_eq!(named("/a/old/walk.dae", "/a/new/walk.dae"), "old/walk.dae new/walk.dae");
        assert_eq!(named("/x/clips/walk.dae", "/y/clips/walk.dae"), "x/clips/walk.dae y/clips/walk.dae");
        assert_eq!(named("/a/walk.dae", "/a/walk.dae"), "walk.dae walk.dae");
    }
}

//! The window. GTK appears here and nowhere else.
//!
//! | module | what it holds |
//! |---|---|
//! | [`commands`], `command_action`, `command_conditions`, `session_commands` | the one table of commands: keys, what each does, when it is possible |
//! | `session_handle`, `settings_handle`, `toasts`, `error_bar`, … | small handles that widgets are given; `app_context` holds those of a window |
//! | `viewport`, `timeline`, `scene_tree`, `muscle_panel`, … | one widget each, beside `resources/ui/` of the same name |
//! | `panel`, `pages` | what a page of the right-hand panel is, and the list of them |
//! | `document_loader`, `background_reader`, `file_watcher`, `file_chooser`, `drop_target` | opening off the interface thread, watching, choosing, drops |
//! | `command_dispatch`, `key_controller`, `shortcuts` | performs commands, by actions and keys |
//! | `window` | assembles the panels and lets them hear of changes; nothing imports it but this module |
//!
//! Changes flow in one direction: a widget calls `SessionHandle::update` with a change of the session; the session records what changed; the
//! subscribers refresh the widgets that show it. While they do, signals of the widgets are not taken for user input.

mod about;
mod app_context;
mod appearance;
mod attach_muscles;
mod attachment_field;
mod attachments_editor;
mod autosave;
mod background_reader;
mod bone_names;
mod command_action;
mod command_conditions;
mod command_context;
mod command_dispatch;
pub mod commands;
mod compare_file;
mod contraction_controls;
mod curve_editor;
mod curve_plot;
mod display_panel;
mod document_loader;
mod drawing_area;
mod drop_target;
mod empty_state;
mod error_bar;
mod experiment;
mod export_dialog;
mod export_job;
mod file_chooser;
mod file_watcher;
mod frame_clock;
mod health_panel;
mod held_joint_banner;
mod help;
mod icons;
mod inspector;
mod inspector_text;
mod key_controller;
mod loading_bar;
mod material_preview;
mod measure_panel;
mod memory_usage;
mod menus;
mod muscle_editor;
mod muscle_panel;
mod named_sources;
mod onion_skin_panel;
mod open_buttons;
mod open_error;
mod open_files;
mod pages;
mod panel;
mod picture_focus;
mod plot_view;
mod profile_plot;
mod profile_table;
mod recent;
mod reload_summary;
mod renderer;
mod samples;
mod save_as;
mod save_session;
mod saving;
mod scene_tree;
mod screenshot;
mod session_commands;
mod session_handle;
pub mod settings;
mod settings_handle;
mod shortcuts;
mod side_panels;
mod start_page;
mod status_line;
mod time_axis;
mod timeline;
mod timeline_ruler;
mod title_bar;
mod toasts;
mod tree_model;
mod ui;
mod via_points_editor;
mod viewport;
mod window;

use std::cell::RefCell;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};

use gtk::prelude::*;
use gtk::{gio, glib};
use gtk4 as gtk;

/// How numbers are written in the window.
use crate::i18n::quantity as format;
use crate::output::cleanup_temp_files;
use crate::tr;

/// The one id for the application, its icon, its desktop file and its metainfo.
pub const APPLICATION_ID: &str = "io.github.sinew.Sinew";

/// Whether the program was ended from outside.
static TERMINATED: AtomicBool = AtomicBool::new(false);

/// The exit code of a program that was ended from outside, as shells have it.
const EXIT_TERMINATED: u8 = 130;

/// Opens the window with these files; none = the built-in biceps. Returns when the window is closed: 1 where there is no display.
pub fn run(files: Vec<PathBuf>) -> ExitCode {
    renderer::choose();
    if gtk::init().is_err() {
        eprintln!("{}", tr!("app-no-display"));
        return ExitCode::FAILURE;
    }
    restart();
    if !has_fonts() {
        eprintln!("{}", tr!("app-no-fonts"));
        return ExitCode::FAILURE;
    }
    glib::set_application_name("Sinew");
    glib::set_prgname(Some("sinew"));
    let flags = gio::ApplicationFlags::HANDLES_OPEN | gio::ApplicationFlags::NON_UNIQUE;
    let application = gtk::Application::new(Some(APPLICATION_ID), flags);
    // The files of the command line keep the names that the user gave them; those that the desktop sends come by way of `open`.
    let given = RefCell::new(files.into_iter().map(local).collect::<Vec<_>>());
    application.connect_activate(move |application| window::Window::open(application, given.take()));
    application.connect_open(|application, files, _| {
        let path = |file: &gio::File| file.path().unwrap_or_else(|| file.uri().as_str().into());
        window::Window::open(application, files.iter().map(path).collect());
    });
    end_on_signals();
    let code = application.run_with_args(&["sinew"]).get();
    // An export that is still running on another thread ends with the program; it leaves no half file.
    cleanup_temp_files();
    match code {
        _ if TERMINATED.load(Ordering::Relaxed) => ExitCode::from(EXIT_TERMINATED),
        0 => ExitCode::SUCCESS,
        _ => ExitCode::FAILURE,
    }
}

/// Ends the program in order on a termination signal.
fn end_on_signals() {
    // Where the system has no such thing the program just ends.
    let _ = ctrlc::set_handler(|| {
        TERMINATED.store(true, Ordering::Relaxed);
        // Before the frame clock: while frames take longer than the display's interval, an idle call would wait for ever.
        glib::MainContext::default().invoke_with_priority(glib::Priority::HIGH, || {
            if let Some(application) = gio::Application::default() {
                application.quit();
            }
        });
    });
}

/// A file that a desktop names by its URI as a path; anything else as it is.
fn local(file: PathBuf) -> PathBuf {
    let uri = file.to_str().filter(|text| text.starts_with("file://"));
    uri.and_then(|uri| gio::File::for_uri(uri).path()).unwrap_or(file)
}

/// Whether anything can be written at all; without a font a window is full of boxes, and as wide as they are.
fn has_fonts() -> bool {
    let context = gtk::Label::new(None).pango_context();
    context.load_font(&gtk::pango::FontDescription::from_string("Sans 10")).is_some()
}

/// Restarts the program where GTK would draw in software; returns where that is impossible or unnecessary.
fn restart() {
    #[cfg(unix)]
    if let Some(mut command) = renderer::command().filter(|_| renderer::is_wrong()) {
        use std::os::unix::process::CommandExt;
        // Should it fail, the window is as slow as GTK would have it.
        let _ = command.exec();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::{BTreeMap, BTreeSet};
    use std::path::Path;

    #[test]
    fn files_named_by_a_desktop_become_paths() {
        assert_eq!(local("file:///tmp/a%20b.dae".into()), PathBuf::from("/tmp/a b.dae"));
        assert_eq!(local("-".into()), PathBuf::from("-"));
        assert_eq!(local("walks/file:x.dae".into()), PathBuf::from("walks/file:x.dae"));
    }

    /// The sources of the modules of this folder, without their tests; `viewport` is one of them.
    fn sources() -> BTreeMap<String, String> {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/app");
        let mut sources = BTreeMap::<String, String>::new();
        for folder in [folder.clone(), folder.join("viewport")] {
            for entry in std::fs::read_dir(&folder).expect("the sources are there").flatten() {
                let (path, is_own) = (entry.path(), folder.ends_with("app"));
                let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
                if path.extension().is_some_and(|ending| ending == "rs") && !(is_own && ["main", "mod"].contains(&stem.as_str())) {
                    let text = std::fs::read_to_string(&path).expect("a source is text");
                    let text = text.split("#[cfg(test)]\nmod tests").next().unwrap_or_default();
                    sources.entry(if is_own { stem } else { "viewport".to_owned() }).or_default().push_str(text);
                }
            }
        }
        sources
    }

    /// The words that follow `super::` or `crate::app::` in a source, those in braces too.
    fn imports(text: &str) -> BTreeSet<&str> {
        let follow = text.match_indices("super::").map(|(at, word)| at + word.len());
        let follow = follow.chain(text.match_indices("crate::app::").map(|(at, word)| at + word.len()));
        let words = follow.flat_map(|at| {
            let rest = &text[at..];
            let end = if rest.starts_with('{') { rest.find('}') } else { rest.find(|c: char| !c.is_alphanumeric() && c != '_') };
            rest[..end.unwrap_or(rest.len())].split(|c: char| !c.is_alphanumeric() && c != '_')
        });
        words.collect()
    }

    #[test]
    fn modules_do_not_import_one_another_in_circles_and_none_imports_the_window() {
        let sources = sources();
        assert!(sources.len() > 50 && sources.contains_key("viewport") && sources.contains_key("window"));
        let mut left: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
        for (module, text) in &sources {
            let known = imports(text).into_iter().filter(|word| sources.contains_key(*word) && word != module).collect();
            left.insert(module, known);
        }
        assert!(!left.values().any(|imports| imports.contains("window")));
        // Whatever imports nothing that is left is in no circle.
        while let Some(free) =
            left.iter().find(|(_, imports)| imports.iter().all(|import| !left.contains_key(import))).map(|(module, _)| *module)
        {
            left.remove(free);
        }
        assert!(left.is_empty(), "{left:#?}");
    }
}

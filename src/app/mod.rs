//! The window. GTK appears here and nowhere else.
//!
//! | module | what it holds |
//! |---|---|
//! | `window`, `notices` | the main window and what frames the picture; what is said over the picture |
//! | `viewport`, `timeline`, `scene_tree`, `inspector` | one part of the window each |
//! | `panels` | the pages of the right-hand panel, and the list of them |
//! | `dialogs`, `loading` | dialogs, saving, exporting; opening off the interface thread, watching, drops |
//! | [`commands`] | the one table of commands: keys, what each does, when it is possible; performs them, by actions and keys |
//! | `handles` | small handles that widgets are given; `app_context` holds those of a window |
//! | `widgets` | what all widgets are made with; the list of the `.ui` files, each of which lies beside its module |
//! | `appearance`, `renderer`, [`settings`] | what holds for the whole program: light and dark, GTK's renderer, where the settings are |
//!
//! `window::main_window` assembles the panels and lets them hear of changes; nothing imports it but this module.
//!
//! Changes flow in one direction: a widget calls `SessionHandle::update` with a change of the session; the session records what changed; the
//! subscribers refresh the widgets that show it. While they do, signals of the widgets are not taken for user input.

mod appearance;
pub mod commands;
mod dialogs;
mod handles;
mod inspector;
mod loading;
mod notices;
mod panels;
mod renderer;
mod scene_tree;
pub mod settings;
mod timeline;
mod viewport;
mod widgets;
mod window;

use std::cell::RefCell;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};

use gtk::prelude::*;
use gtk::{gio, glib};
use gtk4 as gtk;

use self::window::main_window;
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
    application.connect_activate(move |application| main_window::Window::open(application, given.take()));
    application.connect_open(|application, files, _| {
        let path = |file: &gio::File| file.path().unwrap_or_else(|| file.uri().as_str().into());
        main_window::Window::open(application, files.iter().map(path).collect());
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

    /// The sources of the modules of this folder and of those in it, without their tests, each with the path of its module.
    fn sources() -> BTreeMap<String, String> {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/app");
        let mut sources = BTreeMap::new();
        let mut folders = vec![root.clone()];
        while let Some(folder) = folders.pop() {
            for entry in std::fs::read_dir(&folder).expect("the sources are there").flatten() {
                let path = entry.path();
                let place = path.strip_prefix(&root).expect("it is in the folder").with_extension("");
                let module = if place.ends_with("mod") { place.parent().unwrap_or(&place) } else { &place };
                let module = module.iter().map(|name| name.to_string_lossy()).collect::<Vec<_>>().join("::");
                if path.is_dir() {
                    folders.push(path);
                } else if path.extension().is_some_and(|ending| ending == "rs") && !["", "main"].contains(&module.as_str()) {
                    let text = std::fs::read_to_string(&path).expect("a source is text");
                    let text = text.split("#[cfg(test)]\nmod tests").next().unwrap_or_default();
                    sources.insert(module, text.to_owned());
                }
            }
        }
        sources
    }

    /// Reads the path at the start of a text, or the paths where it branches in braces: `a::{b, c::d}` is `a::b` and `a::c::d`.
    fn read_paths<'a>(rest: &mut &'a str, start: &[&'a str], paths: &mut Vec<Vec<&'a str>>) {
        *rest = rest.trim_start();
        if let Some(branches) = rest.strip_prefix('{') {
            *rest = branches;
            loop {
                read_paths(rest, start, paths);
                // A new name of what is imported does not matter here.
                *rest = &rest[rest.find([',', '}']).unwrap_or(rest.len())..];
                match rest.strip_prefix(',') {
                    Some(next) => *rest = next,
                    None => break *rest = rest.strip_prefix('}').unwrap_or(rest),
                }
            }
        } else {
            let (word, tail) = rest.split_at(rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len()));
            let path = [start, &[word]].concat();
            *rest = tail.strip_prefix("::").unwrap_or(tail);
            if rest.len() < tail.len() { read_paths(rest, &path, paths) } else { paths.push(path) }
        }
    }

    /// The modules of `known` that the source of a module names after `crate::app::` and `super::`, and those in its folder that it names at all.
    fn imports(module: &str, text: &str, known: &BTreeSet<&str>) -> BTreeSet<String> {
        let own: Vec<_> = module.split("::").collect();
        // An item is one of the longest beginning of its path that is a module.
        let home = |path: &[&str]| (1..=path.len()).rev().map(|end| path[..end].join("::")).find(|path| known.contains(path.as_str()));
        let follow = |word: &str| {
            let mut paths = Vec::new();
            text.match_indices(word).for_each(|(at, _)| read_paths(&mut &text[at + word.len()..], &[], &mut paths));
            paths
        };
        let mut found: BTreeSet<_> = follow("crate::app::").iter().filter_map(|path| home(path)).collect();
        for path in follow("super::").iter().filter(|path| path[0] != "super") {
            // `super` may stand more than once, or in a module within the file: any folder around may be meant.
            let within = |folder: &[&str]| home(&[folder, path.as_slice()].concat()).filter(|home| home.len() > folder.join("::").len());
            let homes: Vec<_> = (0..own.len()).map(|end| &own[..end]).filter_map(within).collect();
            // What is in none of them is an item of the folder.
            if homes.is_empty() { found.extend(home(&own[..own.len() - 1])) } else { found.extend(homes) }
        }
        let children = known.iter().filter(|child| child.rsplit_once("::").is_some_and(|(folder, _)| folder == module));
        found.extend(children.filter(|child| text.contains(&format!("{}::", &child[module.len() + 2..]))).map(|child| (*child).to_owned()));
        found
    }

    #[test]
    fn imports_are_found_in_all_their_forms() {
        let known = BTreeSet::from(["a", "a::b", "a::c", "a::d::e", "f"]);
        let found = |module, text| imports(module, text, &known).into_iter().collect::<Vec<_>>().join(" ");
        assert_eq!(found("f", "use crate::app::a::b::Item;"), "a::b");
        assert_eq!(found("f", "use crate::app::{\n    a::{Item, c as x, d::e::{self, *}},\n    y,\n};"), "a a::c a::d::e");
        assert_eq!(found("f", "use super::a;"), "a");
        assert_eq!(found("a::b", "super::c::call(); super::item(); super::super::f::call()"), "a a::c f");
        assert_eq!(found("a::d::e", "mod inner { use super::super::super::b::Item; }"), "a::b");
        assert_eq!(found("a", "use self::b::Item; fn g() { c::call() }"), "a::b a::c");
    }

    #[test]
    fn modules_do_not_import_one_another_in_circles_and_none_imports_the_window() {
        let sources = sources();
        // The parts of the picture belong together.
        let known: BTreeSet<_> = sources.keys().map(String::as_str).filter(|module| !module.starts_with("viewport::")).collect();
        assert!(known.len() > 50 && known.contains("viewport") && known.contains("window::main_window"));
        let mut left: BTreeMap<&str, BTreeSet<String>> = BTreeMap::new();
        for (module, text) in &sources {
            let unit = if module.starts_with("viewport::") { "viewport" } else { module };
            left.entry(unit).or_default().extend(imports(module, text, &known).into_iter().filter(|import| import != unit));
        }
        assert!(!left.values().any(|imports| imports.contains("window::main_window")));
        // Whatever imports nothing that is left is in no circle.
        while let Some(free) =
            left.iter().find(|(_, imports)| imports.iter().all(|import| !left.contains_key(import.as_str()))).map(|(module, _)| *module)
        {
            left.remove(free);
        }
        assert!(left.is_empty(), "{left:#?}");
    }
}

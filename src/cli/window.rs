//! `sinew [FILE…]`: the window, or a sentence that says what to do without one.
//!
//! The window is a separate program, `sinew-window`, which replaces this process. Loading GTK with the sixty libraries that it brings takes longer
//! than reading most files, and `info`, `check`, `render` and the rest never need it.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use super::output::Failure;
use crate::i18n::Sentence;
use crate::system::{Doing, reason};
use crate::tr;

/// What opens the window with these files.
pub type WindowOpener = fn(Vec<PathBuf>) -> ExitCode;

/// Opens the window with these files.
pub(super) fn open(files: Vec<PathBuf>, opener: WindowOpener) -> ExitCode {
    if cfg!(not(feature = "gui")) {
        return Failure::Files(vec![tr!("cli-no-window")]).report();
    }
    if !has_display() {
        return Failure::Files(vec![tr!("cli-no-display")]).report();
    }
    opener(files)
}

/// Replaces this process by the window's program, which lies beside this one; without `exec` it is started and waited for.
pub fn launch_gui(files: Vec<PathBuf>) -> ExitCode {
    let name = format!("sinew-window{}", std::env::consts::EXE_SUFFIX);
    let program = std::env::current_exe().ok().and_then(|own| own.parent().map(|folder| folder.join(&name))).unwrap_or_else(|| name.into());
    let mut command = std::process::Command::new(&program);
    if !files.is_empty() {
        // A file may be called like a command.
        command.arg("--").args(files);
    }
    run_program(command, &program)
}

#[cfg(unix)]
fn run_program(mut command: std::process::Command, program: &Path) -> ExitCode {
    use std::os::unix::process::CommandExt;
    // Returns only where it fails.
    let error = command.exec();
    Failure::Files(vec![tr!(
        "cli-window-not-started",
        program = program.display().to_string(),
        reason = reason(&error, Doing::Reading).sentence()
    )])
    .report()
}

#[cfg(not(unix))]
fn run_program(mut command: std::process::Command, program: &Path) -> ExitCode {
    match command.status() {
        Ok(status) => u8::try_from(status.code().unwrap_or(1)).map_or(ExitCode::FAILURE, ExitCode::from),
        Err(error) => Failure::Files(vec![tr!(
            "cli-window-not-started",
            program = program.display().to_string(),
            reason = reason(&error, Doing::Reading).sentence()
        )])
        .report(),
    }
}

/// Whether there is a screen to open a window on. GTK would say so too, but its message does not tell the user what to do.
fn has_display() -> bool {
    !cfg!(all(unix, not(target_os = "macos")))
        || ["WAYLAND_DISPLAY", "DISPLAY"].iter().any(|name| std::env::var_os(name).is_some_and(|value| !value.is_empty()))
}

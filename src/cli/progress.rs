//! Progress of long exports on a terminal, and their cancellation by Ctrl+C.

use std::io::{self, IsTerminal, Write};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use super::output::{EXIT_CANCELLED, Failure, is_quiet};
use crate::export::ExportError;
use crate::output::cleanup_temp_files;
use crate::progress::Progress;
use crate::tr;

/// Interval between updates of the progress line.
const PRINT_INTERVAL: Duration = Duration::from_millis(100);

/// The export that Ctrl+C cancels.
static CURRENT: Mutex<Option<Arc<Progress>>> = Mutex::new(None);

/// Runs an export of `count` frames. A terminal shows the progress; Ctrl+C or a termination signal cancels it without leaving partial files.
///
/// # Errors
/// What the work returns.
pub(super) fn run_with_progress(count: usize, run: impl FnOnce(&Progress) -> Result<(), ExportError>) -> Result<(), Failure> {
    let progress = Arc::new(Progress::default());
    *CURRENT.lock().unwrap_or_else(PoisonError::into_inner) = Some(Arc::clone(&progress));
    install_interrupt_handler();
    let shown = count > 1 && !is_quiet() && io::stderr().is_terminal();
    let finished = AtomicBool::new(false);
    let result = std::thread::scope(|scope| {
        let printer =
            shown.then(|| std::thread::Builder::new().spawn_scoped(scope, || print_progress(&progress, count, &finished)).ok()).flatten();
        let result = run(&progress);
        finished.store(true, Ordering::Relaxed);
        if let Some(printer) = printer {
            printer.thread().unpark();
        }
        result
    });
    Ok(result?)
}

/// From now on Ctrl+C and termination signals leave no partial files: an export of [`run_with_progress`] is cancelled, other temporary files are deleted.
pub(super) fn install_interrupt_handler() {
    // Where the system has no such thing the program just ends.
    let _ = ctrlc::set_handler(|| match &*CURRENT.lock().unwrap_or_else(PoisonError::into_inner) {
        Some(progress) => progress.cancel(),
        None => {
            cleanup_temp_files();
            Failure::Cancelled.report();
            #[expect(clippy::exit, reason = "a signal handler cannot return an exit code")]
            std::process::exit(i32::from(EXIT_CANCELLED));
        }
    });
}

fn print_progress(progress: &Progress, count: usize, finished: &AtomicBool) {
    let mut out = io::stderr();
    while !finished.load(Ordering::Relaxed) {
        let line = tr!("cli-progress", done = progress.steps(), count = count);
        // A terminal that is gone is nothing to stop for.
        let _ = write!(out, "\r\x1b[K{line}").and_then(|()| out.flush());
        std::thread::park_timeout(PRINT_INTERVAL);
    }
    let _ = write!(out, "\r\x1b[K").and_then(|()| out.flush());
}

//! Long work on a terminal: how far it is, and Ctrl+C that leaves nothing behind.

use std::io::{self, IsTerminal, Write};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use super::failure::{Failure, STOPPED, is_quiet};
use crate::export::ExportError;
use crate::export::atomic_file::sweep;
use crate::export::pipeline::ExportProgress;
use crate::tr;

/// How often the line on the terminal is written anew.
const PULSE: Duration = Duration::from_millis(100);

/// The work that Ctrl+C stops.
static CURRENT: Mutex<Option<Arc<ExportProgress>>> = Mutex::new(None);

/// Does work of `count` frames. A terminal shows how many are done; Ctrl+C, or whoever ends the program, stops it so that no half file is left.
///
/// # Errors
/// What the work returns.
pub(super) fn watched(count: usize, run: impl FnOnce(&ExportProgress) -> Result<(), ExportError>) -> Result<(), Failure> {
    let work = Arc::new(ExportProgress::default());
    *CURRENT.lock().unwrap_or_else(PoisonError::into_inner) = Some(Arc::clone(&work));
    leave_nothing();
    let shown = count > 1 && !is_quiet() && io::stderr().is_terminal();
    let over = AtomicBool::new(false);
    let result = std::thread::scope(|scope| {
        let teller = shown.then(|| std::thread::Builder::new().spawn_scoped(scope, || tell(&work, count, &over)).ok()).flatten();
        let result = run(&work);
        over.store(true, Ordering::Relaxed);
        if let Some(teller) = teller {
            teller.thread().unpark();
        }
        result
    });
    Ok(result?)
}

/// From now on Ctrl+C, or whoever ends the program, leaves no half file behind: work that is [`watched`] is stopped, anything else is swept away.
pub(super) fn leave_nothing() {
    // Where the system has no such thing the program just ends.
    let _ = ctrlc::set_handler(|| match &*CURRENT.lock().unwrap_or_else(PoisonError::into_inner) {
        Some(work) => work.cancelled.store(true, Ordering::Relaxed),
        None => {
            sweep();
            Failure::Stopped.report();
            #[expect(clippy::exit, reason = "a signal handler has nobody to return to")]
            std::process::exit(i32::from(STOPPED));
        }
    });
}

fn tell(work: &ExportProgress, count: usize, over: &AtomicBool) {
    let mut out = io::stderr();
    while !over.load(Ordering::Relaxed) {
        let line = tr!("cli-progress", done = work.done.load(Ordering::Relaxed), count = count);
        // A terminal that is gone is nothing to stop for.
        let _ = write!(out, "\r\x1b[K{line}").and_then(|()| out.flush());
        std::thread::park_timeout(PULSE);
    }
    let _ = write!(out, "\r\x1b[K").and_then(|()| out.flush());
}

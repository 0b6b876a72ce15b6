//! How far a long task is, and a way to stop it, shared between the thread that works and the one that shows it.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// Parts of a task that tells a share of itself instead of a number of steps.
const PARTS: f32 = 1000.0;

/// How far a task is: reading counts thousandths, exporting counts frames.
#[derive(Debug, Default)]
pub struct Progress {
    done: AtomicUsize,
    cancelled: AtomicBool,
}

impl Progress {
    /// Asks the task to stop; it ends with an error of its own and leaves no files.
    pub fn cancel(&self) {
        self.cancelled.store(true, Ordering::Relaxed);
    }

    /// Whether the task is asked to stop.
    pub fn is_cancelled(&self) -> bool {
        self.cancelled.load(Ordering::Relaxed)
    }

    /// Tells that one more step is done.
    pub fn step(&self) {
        self.done.fetch_add(1, Ordering::Relaxed);
    }

    /// How many steps are done.
    pub fn steps(&self) -> usize {
        self.done.load(Ordering::Relaxed)
    }

    /// Tells which share of the task is done, 0 to 1.
    pub fn set_share(&self, share: f32) {
        self.done.store((share.clamp(0.0, 1.0) * PARTS) as usize, Ordering::Relaxed);
    }

    /// The share that is done, 0 to 1.
    pub fn share(&self) -> f32 {
        self.steps() as f32 / PARTS
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_and_shares_are_told_and_a_task_is_stopped() {
        let progress = Progress::default();
        progress.step();
        progress.step();
        assert_eq!((progress.steps(), progress.is_cancelled()), (2, false));
        for (told, share) in [(0.0, 0.0), (0.25, 0.25), (2.0, 1.0), (f32::NAN, 0.0)] {
            progress.set_share(told);
            assert_eq!(progress.share(), share);
        }
        progress.cancel();
        assert!(progress.is_cancelled());
    }
}

//! Worker threads that are kept between frames and parked while there is nothing to do.
//!
//! Spawning two threads a frame costs as much as clearing the picture. A worker that comes late finds the job closed and goes back to sleep,
//! so a frame never waits for the scheduler; the caller works too, and work is handed out piece by piece by the job itself.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;

/// What the threads run: the argument is the worker's number.
type Job = dyn Fn(usize) + Sync;

/// A job whose lifetime was erased; see the reason in [`Pool::run`].
#[derive(Clone, Copy)]
struct JobPointer(*const Job);
// SAFETY: the pointee is `Sync`, so calling it from another thread is allowed while it lives, which `Pool::run` sees to.
unsafe impl Send for JobPointer {}

#[derive(Default)]
struct PoolState {
    job: Option<JobPointer>,
    active: usize,
    /// Threads that are running; they start on their own time.
    started: usize,
    sleeping: usize,
    stopping: bool,
    panicked: bool,
}

#[derive(Default)]
struct Shared {
    state: Mutex<PoolState>,
    /// Counts jobs; looked at without the lock while spinning.
    epoch: AtomicU64,
    work: Condvar,
    done: Condvar,
}

impl Shared {
    fn lock(&self) -> MutexGuard<'_, PoolState> {
        // The lock is never held while a job runs, so poison says nothing.
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The worker threads of one renderer.
pub(super) struct Pool {
    shared: Arc<Shared>,
    threads: Vec<JoinHandle<()>>,
}

impl std::fmt::Debug for Pool {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Pool({})", self.workers())
    }
}

/// The next part of the work, each part once: workers take parts until none is left.
pub(super) fn take<T>(from: &Mutex<impl Iterator<Item = T>>) -> Option<T> {
    from.lock().unwrap_or_else(PoisonError::into_inner).next()
}

/// How often a worker looks for a new job before it goes to sleep: the stages of one frame follow each other faster than a wake-up.
const SPINS: u32 = 4_000;

impl Pool {
    /// A pool of `workers`, the caller counted. Where the system refuses a thread there are fewer.
    pub(super) fn new(workers: usize) -> Self {
        let shared = Arc::<Shared>::default();
        let threads = (1..workers)
            .map_while(|index| {
                let shared = Arc::clone(&shared);
                std::thread::Builder::new().name(format!("draw-{index}")).spawn(move || worker(&shared, index)).ok()
            })
            .collect();
        Self { shared, threads }
    }

    /// Number of workers, the caller counted.
    pub(super) fn workers(&self) -> usize {
        self.threads.len() + 1
    }

    /// Runs `job` on the caller as worker 0 and on every worker that is awake in time. Returns when none is in it any more.
    pub(super) fn run(&self, job: &(dyn Fn(usize) + Sync)) {
        if self.threads.is_empty() {
            return job(0);
        }
        /// Closes the job and waits, also when the caller's part panics.
        struct Closing<'a>(&'a Shared, usize);
        impl Drop for Closing<'_> {
            fn drop(&mut self) {
                let mut state = self.0.lock();
                state.job = None;
                // A thread allocates while it starts, so the first job waits for those that still do.
                while state.active > 0 || state.started < self.1 {
                    state = self.0.done.wait(state).unwrap_or_else(PoisonError::into_inner);
                }
            }
        }
        // SAFETY: only the lifetime changes. Workers take the pointer under the lock while the job is open and count themselves as
        // active; `Closing` withdraws the pointer and waits until no worker is active before `run` returns, so none uses it after that.
        let pointer = JobPointer(unsafe { std::mem::transmute::<*const (dyn Fn(usize) + Sync), *const Job>(std::ptr::from_ref(job)) });
        {
            let mut state = self.shared.lock();
            state.job = Some(pointer);
            self.shared.epoch.fetch_add(1, Ordering::Release);
            if state.sleeping > 0 {
                self.shared.work.notify_all();
            }
        }
        {
            let _closing = Closing(&self.shared, self.threads.len());
            job(0);
        }
        // A panic in a worker is a bug of the renderer; it must not leave a half-drawn picture unnoticed.
        assert!(!std::mem::take(&mut self.shared.lock().panicked), "a drawing thread panicked");
    }
}

impl Drop for Pool {
    fn drop(&mut self) {
        self.shared.lock().stopping = true;
        self.shared.epoch.fetch_add(1, Ordering::Release);
        self.shared.work.notify_all();
        for thread in self.threads.drain(..) {
            // A worker catches its panics, so there is nothing to learn here.
            let _ = thread.join();
        }
    }
}

fn worker(shared: &Shared, index: usize) {
    let mut seen = 0;
    shared.lock().started += 1;
    shared.done.notify_one();
    loop {
        for _ in 0..SPINS {
            if shared.epoch.load(Ordering::Acquire) != seen {
                break;
            }
            std::hint::spin_loop();
        }
        let mut state = shared.lock();
        while shared.epoch.load(Ordering::Acquire) == seen && !state.stopping {
            state.sleeping += 1;
            state = shared.work.wait(state).unwrap_or_else(PoisonError::into_inner);
            state.sleeping -= 1;
        }
        if state.stopping {
            return;
        }
        seen = shared.epoch.load(Ordering::Acquire);
        let Some(JobPointer(job)) = state.job else { continue };
        state.active += 1;
        drop(state);
        // SAFETY: taken while the job was open, and this worker is counted as active: `Pool::run` waits for it.
        let outcome = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| unsafe { (*job)(index) }));
        let mut state = shared.lock();
        state.active -= 1;
        state.panicked |= outcome.is_err();
        if state.active == 0 {
            shared.done.notify_one();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::AtomicUsize;

    #[test]
    fn every_piece_is_done_once() {
        for workers in [1, 2, 5] {
            let pool = Pool::new(workers);
            for _ in 0..200 {
                let (next, sum) = (AtomicUsize::new(0), AtomicUsize::new(0));
                pool.run(&|_| {
                    loop {
                        let piece = next.fetch_add(1, Ordering::Relaxed);
                        if piece >= 100 {
                            break;
                        }
                        sum.fetch_add(piece, Ordering::Relaxed);
                    }
                });
                assert_eq!(sum.into_inner(), 4950);
            }
        }
    }
}

//! Frames drawn, converted and written at the same time: one thread draws, several convert, one writes in order.
//!
//! A few pictures are reused in turn: a picture that was written is drawn into again, so the memory is bounded, and a slow disk slows down
//! the drawing instead of filling the memory.

use std::collections::BTreeMap;
use std::io::{self, Write};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, channel};
use std::sync::{Mutex, PoisonError};
use std::thread;

use super::ExportError;
use sinew_render::Framebuffer;
use sinew_scene::limits;
use sinew_scene::progress::Progress;

/// What a thread takes from the system as it starts, beside its stack, with some to spare, bytes. The C library ends the program where it is refused that.
const THREAD_BYTES: u64 = 1 << 20;

/// Most memory of all pictures together, bytes.
const MEMORY_LIMIT: usize = 256 << 20;

/// A writer to `out` that fails with [`ExportError::CANCELLED`] inside once `progress` is cancelled.
pub fn cancellable<W: Write>(out: W, progress: &Progress) -> impl Write {
    CancellableWriter { out, progress }
}

struct CancellableWriter<'a, W> {
    out: W,
    progress: &'a Progress,
}

impl<W: Write> Write for CancellableWriter<'_, W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.progress.is_cancelled() { Err(cancelled_error()) } else { self.out.write(bytes) }
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

/// Draws `count` pictures of `size` with `draw`, one after the other on the calling thread, converts each with `convert` on `threads`
/// other threads, and passes the results to `write` in order, on one more thread.
///
/// # Errors
/// The first that `draw`, `convert` or `write` returns; [`ExportError::CANCELLED`] (inside the [`io::Error`]) when `progress` was cancelled.
pub fn run<T: Send>(
    (count, size, threads): (usize, (u32, u32), usize),
    progress: &Progress,
    mut draw: impl FnMut(usize, &mut Framebuffer) -> io::Result<()>,
    convert: impl Fn(usize, &Framebuffer) -> io::Result<T> + Sync,
    mut write: impl FnMut(T) -> io::Result<()> + Send,
) -> io::Result<()> {
    let pixels = size.0 as usize * size.1 as usize;
    let threads = threads.max(1);
    if !limits::is_room(THREAD_BYTES * threads as u64) {
        return Err(io::ErrorKind::OutOfMemory.into());
    }
    let pictures = (MEMORY_LIMIT / (pixels * 4).max(1)).clamp(1, threads + 2).min(count.max(1));
    let (free_sender, free) = channel();
    for made in 0..pictures {
        match Framebuffer::new(size.0, size.1) {
            // The receiver is there, so sending cannot fail.
            Ok(picture) => drop(free_sender.send(picture)),
            Err(error) if made == 0 => return Err(error.into()),
            // With fewer pictures the export only takes longer.
            Err(_) => break,
        }
    }
    let (drawn_sender, drawn) = channel::<(usize, Framebuffer)>();
    let drawn = Mutex::new(drawn);
    let (converted_sender, converted) = channel::<(usize, io::Result<T>, Framebuffer)>();
    let failed = AtomicBool::new(false);
    let (convert, failed_flag, drawn) = (&convert, &failed, &drawn);
    thread::scope(|scope| {
        for started in 0..threads.min(pictures) {
            let finish = converted_sender.clone();
            let spawned = thread::Builder::new().spawn_scoped(scope, move || {
                while let Some((index, picture)) = next(drawn) {
                    let made = if failed_flag.load(Ordering::Relaxed) { Err(cancelled_error()) } else { convert(index, &picture) };
                    if finish.send((index, made, picture)).is_err() {
                        return;
                    }
                }
            });
            match spawned {
                Err(error) if started == 0 => return Err(error),
                Err(_) => break,
                Ok(_) => {}
            }
        }
        drop(converted_sender);
        let writer = thread::Builder::new().spawn_scoped(scope, move || {
            let mut waiting = BTreeMap::new();
            let (mut expected, mut result) = (0, Ok(()));
            for (index, made, picture) in converted {
                waiting.insert(index, (made, picture));
                while let Some((made, picture)) = waiting.remove(&expected) {
                    if result.is_ok() {
                        result = made.and_then(&mut write);
                        match &result {
                            Ok(()) => {
                                progress.step();
                            }
                            Err(_) => failed_flag.store(true, Ordering::Relaxed),
                        }
                    }
                    expected += 1;
                    // The drawing thread may have ended.
                    let _ = free_sender.send(picture);
                }
            }
            result
        })?;
        let mut not_drawn = Ok(());
        for index in 0..count {
            if failed.load(Ordering::Relaxed) || progress.is_cancelled() {
                break;
            }
            let Ok(mut picture) = free.recv() else { break };
            if let Err(error) = draw(index, &mut picture) {
                not_drawn = Err(error);
                break;
            }
            if drawn_sender.send((index, picture)).is_err() {
                break;
            }
        }
        drop(drawn_sender);
        match writer.join() {
            Ok(Ok(())) if progress.is_cancelled() => Err(cancelled_error()),
            // Frames before the one that could not be drawn may have failed too, and were first.
            Ok(result) => result.and(not_drawn),
            Err(panic) => std::panic::resume_unwind(panic),
        }
    })
}

fn next<T>(queue: &Mutex<Receiver<T>>) -> Option<T> {
    queue.lock().unwrap_or_else(PoisonError::into_inner).recv().ok()
}

fn cancelled_error() -> io::Error {
    io::Error::other(ExportError::CANCELLED)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbered(count: usize, threads: usize, mut write: impl FnMut(u32) -> io::Result<()> + Send) -> io::Result<()> {
        let draw = |index: usize, picture: &mut Framebuffer| {
            picture.pixels.fill(index as u32);
            Ok(())
        };
        let convert = |index: usize, picture: &Framebuffer| {
            // Later frames are ready earlier.
            thread::sleep(std::time::Duration::from_micros(if index.is_multiple_of(3) { 600 } else { 50 }));
            Ok(picture.pixels[0])
        };
        run((count, (2, 2), threads), &Progress::default(), draw, convert, &mut write)
    }

    #[test]
    fn frames_are_written_in_order_each_once() {
        for threads in [1, 2, 5] {
            let mut written = Vec::new();
            numbered(40, threads, |frame| {
                written.push(frame);
                Ok(())
            })
            .expect("nothing fails");
            assert_eq!(written, (0..40).collect::<Vec<_>>());
        }
    }

    #[test]
    fn a_failure_ends_it_and_is_handed_on() {
        let mut written = 0;
        let result = numbered(1000, 3, |frame| {
            written += 1;
            if frame == 5 { Err(io::ErrorKind::StorageFull.into()) } else { Ok(()) }
        });
        assert_eq!(result.map_err(|error| error.kind()), Err(io::ErrorKind::StorageFull));
        assert_eq!(written, 6);
    }

    #[test]
    fn a_frame_that_cannot_be_drawn_ends_it() {
        let draw = |index: usize, _: &mut Framebuffer| if index == 4 { Err(io::ErrorKind::OutOfMemory.into()) } else { Ok(()) };
        let mut written = 0;
        let write = |()| {
            written += 1;
            Ok(())
        };
        let result = run((1000, (2, 2), 2), &Progress::default(), draw, |_, _| Ok(()), write);
        assert_eq!(result.map_err(|error| error.kind()), Err(io::ErrorKind::OutOfMemory));
        assert_eq!(written, 4);
    }

    #[test]
    fn nothing_is_written_after_a_cancellation() {
        let (progress, mut out) = (Progress::default(), Vec::new());
        let mut guarded = cancellable(&mut out, &progress);
        guarded.write_all(b"one").expect("memory is writable");
        progress.cancel();
        let error = guarded.write_all(b"two").expect_err("stopped");
        assert!(ExportError::io(std::path::Path::new("x"), error).is_cancelled());
        drop(guarded);
        assert_eq!(out, b"one");
    }

    #[test]
    fn it_stops_when_asked() {
        let progress = Progress::default();
        let draw = |index: usize, _: &mut Framebuffer| {
            if index >= 3 {
                progress.cancel();
            }
            Ok(())
        };
        let result = run((1000, (1, 1), 2), &progress, draw, |_, _| Ok(()), |()| Ok(()));
        assert!(ExportError::io(std::path::Path::new("x"), result.expect_err("stopped")).is_cancelled());
        assert!(progress.steps() < 10);
    }
}

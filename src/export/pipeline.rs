//! Frames drawn, converted and written at the same time: one thread draws, several convert, one writes in order.
//!
//! A few pictures go round and round: a picture that was written is drawn into again, so the memory is bounded, and a slow disk slows down
//! the drawing instead of filling the memory.

use std::collections::BTreeMap;
use std::io::{self, Write};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, channel};
use std::sync::{Mutex, PoisonError};
use std::thread;

use super::ExportError;
use crate::render::Framebuffer;

/// What the pictures that go round may take together, bytes.
const MEMORY: usize = 256 << 20;

/// A hand on work that takes a while: how far it is, and a way to stop it.
#[derive(Debug, Default)]
pub struct Work {
    /// Frames that are written.
    pub done: AtomicUsize,
    /// Set to stop: the work ends with [`ExportError::Cancelled`] and leaves nothing behind.
    pub cancelled: AtomicBool,
}

impl Work {
    /// Whether somebody asked to stop.
    pub fn is_cancelled(&self) -> bool {
        self.cancelled.load(Ordering::Relaxed)
    }

    /// Passes everything on to `out` until somebody asks to stop; from then on writing fails with [`ExportError::Cancelled`] inside.
    pub fn guard<W: Write>(&self, out: W) -> impl Write {
        Guarded { out, work: self }
    }
}

struct Guarded<'a, W> {
    out: W,
    work: &'a Work,
}

impl<W: Write> Write for Guarded<'_, W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.work.is_cancelled() { Err(stopped()) } else { self.out.write(bytes) }
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

/// Draws `count` pictures of `size` with `draw`, one after the other on the calling thread, has `convert` make something of each on `threads`
/// other threads, and hands that to `write` in order, on one thread more. `converter` makes what each converting thread keeps for itself.
///
/// # Errors
/// The first that `convert` or `write` returns; [`ExportError::Cancelled`] (inside the [`io::Error`]) when `work` says so.
pub fn run<C, T: Send>(
    (count, size, threads): (usize, (u32, u32), usize),
    work: &Work,
    mut draw: impl FnMut(usize, &mut Framebuffer),
    converter: impl Fn() -> C + Sync,
    convert: impl Fn(&mut C, usize, &Framebuffer) -> io::Result<T> + Sync,
    mut write: impl FnMut(T) -> io::Result<()> + Send,
) -> io::Result<()> {
    let pixels = size.0 as usize * size.1 as usize;
    let threads = threads.max(1);
    let pictures = (MEMORY / (pixels * 4).max(1)).clamp(1, threads + 2).min(count.max(1));
    let (give_back, free) = channel();
    for made in 0..pictures {
        match Framebuffer::new(size.0, size.1) {
            // The receiver is there, so sending cannot fail.
            Ok(picture) => drop(give_back.send(picture)),
            Err(error) if made == 0 => return Err(error),
            // Fewer pictures on their way take longer, no more.
            Err(_) => break,
        }
    }
    let (hand_over, drawn) = channel::<(usize, Framebuffer)>();
    let drawn = Mutex::new(drawn);
    let (finish, finished) = channel::<(usize, io::Result<T>, Framebuffer)>();
    let failed = AtomicBool::new(false);
    let (convert, converter, failed_hand, drawn) = (&convert, &converter, &failed, &drawn);
    thread::scope(|scope| {
        for started in 0..threads.min(pictures) {
            let finish = finish.clone();
            let spawned = thread::Builder::new().spawn_scoped(scope, move || {
                let mut own = converter();
                while let Some((index, picture)) = next(drawn) {
                    let made = if failed_hand.load(Ordering::Relaxed) { Err(stopped()) } else { convert(&mut own, index, &picture) };
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
        drop(finish);
        let writer = thread::Builder::new().spawn_scoped(scope, move || {
            let mut waiting = BTreeMap::new();
            let (mut expected, mut result) = (0, Ok(()));
            for (index, made, picture) in finished {
                waiting.insert(index, (made, picture));
                while let Some((made, picture)) = waiting.remove(&expected) {
                    if result.is_ok() {
                        result = made.and_then(&mut write);
                        match &result {
                            Ok(()) => {
                                work.done.fetch_add(1, Ordering::Relaxed);
                            }
                            Err(_) => failed_hand.store(true, Ordering::Relaxed),
                        }
                    }
                    expected += 1;
                    // Whoever draws may have stopped.
                    let _ = give_back.send(picture);
                }
            }
            result
        })?;
        for index in 0..count {
            if failed.load(Ordering::Relaxed) || work.is_cancelled() {
                break;
            }
            let Ok(mut picture) = free.recv() else { break };
            draw(index, &mut picture);
            if hand_over.send((index, picture)).is_err() {
                break;
            }
        }
        drop(hand_over);
        match writer.join() {
            Ok(Ok(())) if work.is_cancelled() => Err(stopped()),
            Ok(result) => result,
            Err(panic) => std::panic::resume_unwind(panic),
        }
    })
}

fn next<T>(queue: &Mutex<Receiver<T>>) -> Option<T> {
    queue.lock().unwrap_or_else(PoisonError::into_inner).recv().ok()
}

fn stopped() -> io::Error {
    io::Error::other(ExportError::Cancelled)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbered(count: usize, threads: usize, mut write: impl FnMut(u32) -> io::Result<()> + Send) -> io::Result<()> {
        let draw = |index: usize, picture: &mut Framebuffer| picture.pixels.fill(index as u32);
        let convert = |made: &mut u32, index: usize, picture: &Framebuffer| {
            // Later frames are ready earlier.
            thread::sleep(std::time::Duration::from_micros(if index.is_multiple_of(3) { 600 } else { 50 }));
            *made += 1;
            Ok(picture.pixels[0])
        };
        run((count, (2, 2), threads), &Work::default(), draw, || 0, convert, &mut write)
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
    fn nothing_more_is_written_once_somebody_asked_to_stop() {
        let (work, mut out) = (Work::default(), Vec::new());
        let mut guarded = work.guard(&mut out);
        guarded.write_all(b"one").expect("memory is writable");
        work.cancelled.store(true, Ordering::Relaxed);
        let error = guarded.write_all(b"two").expect_err("stopped");
        assert!(matches!(ExportError::io(std::path::Path::new("x"), error), ExportError::Cancelled));
        drop(guarded);
        assert_eq!(out, b"one");
    }

    #[test]
    fn it_stops_when_asked() {
        let work = Work::default();
        let draw = |index: usize, _: &mut Framebuffer| work.cancelled.store(index >= 3, Ordering::Relaxed);
        let result = run((1000, (1, 1), 2), &work, draw, || (), |_, _, _| Ok(()), |()| Ok(()));
        assert!(matches!(ExportError::io(std::path::Path::new("x"), result.expect_err("stopped")), ExportError::Cancelled));
        assert!(work.done.load(Ordering::Relaxed) < 10);
    }
}

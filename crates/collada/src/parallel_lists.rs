//! Long lists of numbers that a second thread reads while the first is busy with other parts of the document.
//!
//! What a list holds follows from its text alone, so it makes no difference who reads it: who comes first does, and the other takes what is there.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};

use roxmltree::NodeId;
use rustc_hash::FxHashMap;

use super::El;
use super::context::children;
use super::list_extraction::Shortened;
use super::numbers::{Comma, ParsedNumbers, reals};
use super::source::number_attribute;

/// What has been read and not been asked for yet may take this many bytes; beyond it nothing is read ahead.
const MOST_HELD: usize = 8 << 20;
/// Less text than this is not worth a thread, bytes.
const WORTH_IT: usize = 256 << 10;

/// A list as [`reals`] gives it.
type ListResult = Result<ParsedNumbers<f64>, Comma>;

#[derive(Default)]
enum ListState {
    /// Nobody has begun.
    #[default]
    Waiting,
    /// The second thread is at it.
    Begun,
    /// It is there.
    Done(ListResult),
    /// It was taken; the next reader reads it anew.
    Taken,
}

struct ListJob<'a> {
    text: &'a str,
    expected: usize,
    state: Mutex<ListState>,
    done: Condvar,
}

impl ListJob<'_> {
    fn state(&self) -> MutexGuard<'_, ListState> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn bytes(list: &ListResult) -> usize {
        list.as_ref().map_or(0, |parsed| parsed.values.capacity() * size_of::<f64>())
    }
}

/// Gives a job back that was begun and not done, so that nobody waits for it in vain.
struct Begun<'j, 'a>(&'j ListJob<'a>);

impl Drop for Begun<'_, '_> {
    fn drop(&mut self) {
        let mut state = self.0.state();
        if matches!(*state, ListState::Begun) {
            *state = ListState::Waiting;
        }
        self.0.done.notify_all();
    }
}

/// The lists that may be read ahead.
#[derive(Default)]
pub(super) struct Ahead<'a> {
    jobs: Vec<ListJob<'a>>,
    places: FxHashMap<NodeId, usize>,
    held: AtomicUsize,
    stopped: AtomicBool,
}

impl<'a> Ahead<'a> {
    /// The long lists of geometries, controllers and animations; none where there is little to read.
    ///
    /// Those of geometries come first, from the last to the first: they are needed at once, and the other thread begins with the first. The rest is in the
    /// order in which it is needed.
    pub(super) fn of(root: El<'a>, lists: &'a Shortened<'a>) -> Self {
        let mut ahead = Self::default();
        let arrays_in = |tag| {
            let inside = children(root, tag).flat_map(|library| library.descendants());
            inside.filter(|element| element.tag_name().name() == "float_array").collect::<Vec<_>>()
        };
        let later = ["library_controllers", "library_animations"].into_iter().flat_map(arrays_in);
        for array in arrays_in("library_geometries").into_iter().rev().chain(later) {
            if let Some(text) = array.first_child().and_then(|text| lists.list_at(text.range().start)) {
                ahead.places.insert(array.id(), ahead.jobs.len());
                let expected = number_attribute(array, "count").unwrap_or(0);
                ahead.jobs.push(ListJob { text, expected, state: Mutex::default(), done: Condvar::new() });
            }
        }
        if ahead.jobs.iter().map(|job| job.text.len()).sum::<usize>() < WORTH_IT {
            return Self::default();
        }
        ahead
    }

    /// Does `work` on this thread while another reads ahead, if there is anything to read.
    pub(super) fn while_doing<R>(&self, work: impl FnOnce() -> R) -> R {
        if self.jobs.is_empty() {
            return work();
        }
        std::thread::scope(|scope| {
            // Without a second thread all is read where it is needed.
            let _ = std::thread::Builder::new().name("ahead".into()).spawn_scoped(scope, || self.read_all());
            let stop = Stop(&self.stopped);
            let result = work();
            drop(stop);
            result
        })
    }

    fn read_all(&self) {
        for job in &self.jobs {
            if self.stopped.load(Ordering::Relaxed) {
                break;
            }
            // Four bytes a number and more, mostly: twice the text is what it takes.
            if self.held.load(Ordering::Relaxed).saturating_add(job.text.len() * 2) > MOST_HELD {
                continue;
            }
            {
                let mut state = job.state();
                if !matches!(*state, ListState::Waiting) {
                    continue;
                }
                *state = ListState::Begun;
            }
            let begun = Begun(job);
            let list = reals(job.text, job.expected);
            self.held.fetch_add(ListJob::bytes(&list), Ordering::Relaxed);
            *job.state() = ListState::Done(list);
            drop(begun);
        }
    }

    /// The list in `array`, if another thread has read it or is about to; `None` where the caller has to.
    pub(super) fn take(&self, array: NodeId) -> Option<ListResult> {
        let job = self.jobs.get(*self.places.get(&array)?)?;
        let mut state = job.state();
        while matches!(*state, ListState::Begun) {
            state = job.done.wait(state).unwrap_or_else(PoisonError::into_inner);
        }
        match std::mem::replace(&mut *state, ListState::Taken) {
            ListState::Done(list) => {
                self.held.fetch_sub(ListJob::bytes(&list), Ordering::Relaxed);
                Some(list)
            }
            _ => None,
        }
    }
}

/// Stops the second thread, also where the work of the first ends in a panic.
struct Stop<'s>(&'s AtomicBool);

impl Drop for Stop<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

#[cfg(test)]
mod tests {
    use super::super::xml;
    use super::*;

    /// A document of `count` long lists; list i holds i over and over, the last of them commas between numbers.
    fn text(count: usize) -> String {
        let list = |i: usize| {
            let numbers = if i + 1 == count { "1,5,2 ".repeat(9000) } else { format!("{i}.25 ").repeat(9000) };
            format!("<float_array id='a{i}' count='9000'>{numbers}</float_array>")
        };
        let lists: String = (0..count).map(list).collect();
        format!("<COLLADA><library_animations><animation><source>{lists}</source></animation></library_animations></COLLADA>")
    }

    fn with<R>(text: &str, check: impl FnOnce(&Ahead<'_>, &[NodeId]) -> R) -> R {
        let surveyed = xml::look_at(text, None).unwrap_or_else(|error| unreachable!("{error}"));
        let parsed = xml::parse(&surveyed).unwrap_or_else(|error| unreachable!("{error}"));
        let root = parsed.document.root_element();
        let arrays: Vec<NodeId> = root.descendants().filter(|node| node.has_tag_name("float_array")).map(|node| node.id()).collect();
        check(&Ahead::of(root, parsed.lists), &arrays)
    }

    #[test]
    fn what_is_read_ahead_is_what_the_text_holds_and_is_given_once() {
        with(&text(20), |ahead, arrays| {
            ahead.read_all();
            for (i, array) in arrays.iter().enumerate().take(19) {
                let list = ahead.take(*array).and_then(Result::ok).map(|parsed| (parsed.values, parsed.bad));
                assert_eq!(list, Some((vec![i as f64 + 0.25; 9000], 0)));
                assert!(ahead.take(*array).is_none());
            }
            assert!(matches!(arrays.last().and_then(|last| ahead.take(*last)), Some(Err(_))), "the comma is told by whoever asks");
            assert_eq!(ahead.held.load(Ordering::Relaxed), 0);
        });
    }

    #[test]
    fn both_threads_together_read_each_list_once() {
        with(&text(40), |ahead, arrays| {
            for _ in 0..20 {
                let given = ahead.while_doing(|| arrays.iter().filter(|array| ahead.take(**array).is_some()).count());
                // What was not given was left to this thread; nothing is given twice.
                assert!(given <= arrays.len());
                assert!(arrays.iter().all(|array| ahead.take(*array).is_none()));
                for job in &ahead.jobs {
                    *job.state() = ListState::Waiting;
                }
                ahead.stopped.store(false, Ordering::Relaxed);
            }
        });
    }

    #[test]
    fn little_is_not_worth_it_and_much_is_not_held() {
        with(&text(2), |ahead, _| assert!(ahead.jobs.is_empty()));
        with(&text(400), |ahead, arrays| {
            ahead.read_all();
            assert!(ahead.held.load(Ordering::Relaxed) <= MOST_HELD);
            let given = arrays.iter().filter(|array| ahead.take(**array).is_some()).count();
            assert!((2..arrays.len()).contains(&given), "{given}");
        });
    }
}

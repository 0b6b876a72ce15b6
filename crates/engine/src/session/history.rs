//! Undo and redo: snapshots of the editable state, taken before each edit.

use std::time::{Duration, Instant};

use super::joint_control::JointSlider;
use crate::document::JointControl;
use crate::view::{LightDirection, ModelTransform};
use sinew_muscle::MuscleFile;
use sinew_scene::NodeId;
use sinew_scene::message::Message;

/// What an undo brings back.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Snapshot {
    /// The model's transform.
    pub model: ModelTransform,
    /// The light; `None` = the default one.
    pub light: Option<LightDirection>,
    /// The nodes that are hidden, ascending.
    pub hidden: Vec<NodeId>,
    /// What the muscle files say.
    pub files: Vec<MuscleFile>,
    /// How joints are turned by hand.
    pub joints: JointControl,
    /// Which joint the slider turns, and whether on top of the clip.
    pub slider: JointSlider,
}

/// Whether a change begins a step of its own or goes on with the last one. After an undo or a redo, whatever is changed begins one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UndoStep {
    /// A step that undo takes back alone.
    New,
    /// Goes on with the last one, where that did the same: a drag goes on.
    Same,
    /// Goes on with the last one, where that did the same to the same thing a moment ago: a slider that is turned, a key that is pressed again.
    Near {
        /// What is changed: the number of a node, an axis …
        of: u32,
        /// The present.
        now: Instant,
    },
}

impl UndoStep {
    /// Goes on with a change of `of` that was made just now.
    pub fn near(of: u32) -> Self {
        Self::Near { of, now: Instant::now() }
    }
}

/// A step that was taken: what it did, and how things were on its other side.
#[derive(Debug)]
struct UndoEntry {
    what: Message,
    snapshot: Snapshot,
}

/// The steps taken and taken back.
#[derive(Debug, Default)]
pub(super) struct History {
    done: Vec<UndoEntry>,
    undone: Vec<UndoEntry>,
    /// How the last change came, while the next may go on with its step: until an undo or a redo.
    open: Option<UndoStep>,
    /// Something is being done that is one step, of whatever steps it is made.
    pub inside: bool,
}

impl History {
    /// Most steps that are kept.
    const DEPTH: usize = 200;

    /// Changes of the same thing that follow each other this closely are one step.
    pub(super) const GESTURE: Duration = Duration::from_millis(800);

    /// Notes a change that was made: how things were before it, and what it did.
    pub(super) fn push_undo(&mut self, before: Snapshot, what: Message, step: UndoStep) {
        let goes_on = match (self.open, step) {
            (Some(_), UndoStep::Same) => true,
            (Some(UndoStep::Near { of: last, now: then }), UndoStep::Near { of, now }) => {
                last == of && now.duration_since(then) < Self::GESTURE
            }
            _ => false,
        };
        let same = self.done.last().is_some_and(|last| last.what == what);
        self.open = Some(step);
        self.undone.clear();
        if !(goes_on && same) {
            self.done.push(UndoEntry { what, snapshot: before });
        }
        if self.done.len() > Self::DEPTH {
            self.done.remove(0);
        }
    }

    /// Goes back one step from `now`. A step in which nothing changed is passed over.
    pub(super) fn undo(&mut self, now: Snapshot) -> Option<Snapshot> {
        self.open = None;
        let back = std::iter::from_fn(|| self.done.pop()).find(|step| step.snapshot != now)?;
        self.undone.push(UndoEntry { what: back.what, snapshot: now });
        Some(back.snapshot)
    }

    /// Goes forward one step from `now`.
    pub(super) fn redo(&mut self, now: Snapshot) -> Option<Snapshot> {
        self.open = None;
        let next = std::iter::from_fn(|| self.undone.pop()).find(|step| step.snapshot != now)?;
        self.done.push(UndoEntry { what: next.what, snapshot: now });
        Some(next.snapshot)
    }

    /// What the step back and the step forward did.
    pub(super) fn names(&self) -> (Option<&Message>, Option<&Message>) {
        (self.done.last().map(|step| &step.what), self.undone.last().map(|step| &step.what))
    }

    /// Whether there is a step back.
    pub(super) fn can_undo(&self) -> bool {
        !self.done.is_empty()
    }

    /// Whether there is a step forward.
    pub(super) fn can_redo(&self) -> bool {
        !self.undone.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scaled(scale: f64) -> Snapshot {
        let model = ModelTransform { scale, ..ModelTransform::default() };
        Snapshot {
            model,
            light: None,
            hidden: Vec::new(),
            files: Vec::new(),
            joints: JointControl::default(),
            slider: JointSlider::default(),
        }
    }

    fn note(history: &mut History, before: f64, what: &'static str, step: UndoStep) {
        history.push_undo(scaled(before), Message::new(what, Vec::new()), step);
    }

    fn names(history: &History) -> (Option<&str>, Option<&str>) {
        let (back, forward) = history.names();
        (back.map(|what| what.key), forward.map(|what| what.key))
    }

    #[test]
    fn steps_go_back_and_forth() {
        let mut history = History::default();
        note(&mut history, 1.0, "scale", UndoStep::New);
        note(&mut history, 2.0, "scale", UndoStep::New);
        assert_eq!(history.undo(scaled(3.0)), Some(scaled(2.0)));
        assert_eq!(history.undo(scaled(2.0)), Some(scaled(1.0)));
        assert_eq!(history.undo(scaled(1.0)), None);
        assert_eq!(history.redo(scaled(1.0)), Some(scaled(2.0)));
        assert_eq!(names(&history), (Some("scale"), Some("scale")));
        note(&mut history, 2.0, "move", UndoStep::New);
        assert_eq!(names(&history), (Some("move"), None));
        assert!(!history.can_redo() && history.can_undo());
    }

    #[test]
    fn what_follows_at_once_goes_on_but_not_across_an_undo() {
        let now = Instant::now();
        let near = |milliseconds: u64, of: u32| UndoStep::Near { of, now: now + Duration::from_millis(milliseconds) };
        let mut history = History::default();
        note(&mut history, 1.0, "turn", near(0, 7));
        note(&mut history, 2.0, "turn", near(500, 7));
        note(&mut history, 3.0, "turn", near(1200, 7));
        assert_eq!(history.done.len(), 1, "each came within a moment of the last");
        note(&mut history, 4.0, "turn", near(2100, 7));
        note(&mut history, 5.0, "turn", near(2200, 8));
        note(&mut history, 6.0, "move", near(2300, 8));
        assert_eq!(history.done.len(), 4, "later, another thing, another deed");
        assert_eq!(history.undo(scaled(7.0)), Some(scaled(6.0)));
        note(&mut history, 6.0, "turn", near(2301, 8));
        assert_eq!((history.done.len(), history.can_redo()), (4, false));
        assert_eq!(history.undo(scaled(7.0)), Some(scaled(6.0)));
        for _ in 0..2 {
            note(&mut history, 6.0, "drag", UndoStep::Same);
        }
        assert_eq!(history.done.len(), 4, "a drag over an undo begins a step of its own, and goes on with it");
    }

    #[test]
    fn a_step_that_changed_nothing_is_passed_over() {
        let mut history = History::default();
        note(&mut history, 1.0, "scale", UndoStep::New);
        note(&mut history, 2.0, "scale", UndoStep::New);
        assert_eq!(history.undo(scaled(2.0)), Some(scaled(1.0)));
    }

    #[test]
    fn the_depth_is_bounded() {
        let mut history = History::default();
        for step in 0..1000 {
            note(&mut history, f64::from(step) + 1.0, "scale", UndoStep::New);
        }
        assert_eq!(history.done.len(), History::DEPTH);
    }
}

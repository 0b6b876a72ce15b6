//! Undo and redo: snapshots of what a hand can change, taken before the change.

use crate::document::HandTurn;
use crate::muscle::MuscleFile;
use crate::scene::NodeId;
use crate::stage::{LightAim, ModelTransform};

/// What an undo brings back.
#[derive(Debug, Clone, PartialEq)]
pub struct Snapshot {
    /// The model's transform.
    pub model: ModelTransform,
    /// The light; `None` = the default one.
    pub light: Option<LightAim>,
    /// The nodes that are hidden, ascending.
    pub hidden: Vec<NodeId>,
    /// What the muscle files say.
    pub files: Vec<MuscleFile>,
    /// Joints turned by hand.
    pub turned: Vec<HandTurn>,
}

/// A step: what it did, and how things were on its other side.
#[derive(Debug)]
struct Step {
    what: String,
    other_side: Snapshot,
}

/// The steps taken and taken back.
#[derive(Debug, Default)]
pub struct History {
    done: Vec<Step>,
    undone: Vec<Step>,
}

impl History {
    /// Most steps that are kept.
    const DEPTH: usize = 200;

    /// Remembers how things were before a change, and what is changed.
    pub fn remember(&mut self, before: Snapshot, what: impl Into<String>) {
        let what = what.into();
        match self.done.last_mut().filter(|step| step.other_side == before) {
            Some(step) => step.what = what,
            None => self.done.push(Step { what, other_side: before }),
        }
        if self.done.len() > Self::DEPTH {
            self.done.remove(0);
        }
        self.undone.clear();
    }

    /// Goes back one step from `now`. A step in which nothing changed is passed over.
    pub fn undo(&mut self, now: Snapshot) -> Option<Snapshot> {
        let back = std::iter::from_fn(|| self.done.pop()).find(|step| step.other_side != now)?;
        self.undone.push(Step { what: back.what, other_side: now });
        Some(back.other_side)
    }

    /// Goes forward one step from `now`.
    pub fn redo(&mut self, now: Snapshot) -> Option<Snapshot> {
        let next = std::iter::from_fn(|| self.undone.pop()).find(|step| step.other_side != now)?;
        self.done.push(Step { what: next.what, other_side: now });
        Some(next.other_side)
    }

    /// What the step back and the step forward did.
    pub fn names(&self) -> (Option<&str>, Option<&str>) {
        (self.done.last().map(|step| step.what.as_str()), self.undone.last().map(|step| step.what.as_str()))
    }

    /// Whether there is a step back.
    pub fn can_undo(&self) -> bool {
        !self.done.is_empty()
    }

    /// Whether there is a step forward.
    pub fn can_redo(&self) -> bool {
        !self.undone.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scaled(scale: f64) -> Snapshot {
        let model = ModelTransform { scale, ..ModelTransform::default() };
        Snapshot { model, light: None, hidden: Vec::new(), files: Vec::new(), turned: Vec::new() }
    }

    #[test]
    fn steps_go_back_and_forth() {
        let mut history = History::default();
        history.remember(scaled(1.0), "app-edit-scale");
        history.remember(scaled(2.0), "app-edit-scale");
        assert_eq!(history.undo(scaled(3.0)), Some(scaled(2.0)));
        assert_eq!(history.undo(scaled(2.0)), Some(scaled(1.0)));
        assert_eq!(history.undo(scaled(1.0)), None);
        assert_eq!(history.redo(scaled(1.0)), Some(scaled(2.0)));
        assert_eq!(history.names(), (Some("app-edit-scale"), Some("app-edit-scale")));
        history.remember(scaled(2.0), "app-edit-move");
        assert_eq!(history.names(), (Some("app-edit-move"), None));
        assert!(!history.can_redo() && history.can_undo());
    }

    #[test]
    fn a_step_that_changed_nothing_is_passed_over() {
        let mut history = History::default();
        history.remember(scaled(1.0), "app-edit-scale");
        history.remember(scaled(2.0), "app-edit-scale");
        assert_eq!(history.undo(scaled(2.0)), Some(scaled(1.0)));
    }

    #[test]
    fn the_depth_is_bounded() {
        let mut history = History::default();
        for step in 0..1000 {
            history.remember(scaled(f64::from(step) + 1.0), "app-edit-scale");
        }
        assert_eq!(history.done.len(), History::DEPTH);
    }
}

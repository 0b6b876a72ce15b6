//! Undo and redo: snapshots of what a hand can change, taken before the change.

use super::light::LightAim;
use super::model::ModelTransform;
use crate::scene::NodeId;

/// What an undo brings back.
#[derive(Debug, Clone, PartialEq)]
pub struct Snapshot {
    /// The model's transform.
    pub model: ModelTransform,
    /// The light; `None` = the default one.
    pub light: Option<LightAim>,
    /// The nodes that are hidden, ascending.
    pub hidden: Vec<NodeId>,
}

/// The steps taken and taken back.
#[derive(Debug, Default)]
pub struct History {
    done: Vec<Snapshot>,
    undone: Vec<Snapshot>,
}

impl History {
    /// Most steps that are kept.
    const DEPTH: usize = 200;

    /// Remembers how things were before a change.
    pub fn remember(&mut self, before: Snapshot) {
        if self.done.last() != Some(&before) {
            self.done.push(before);
        }
        if self.done.len() > Self::DEPTH {
            self.done.remove(0);
        }
        self.undone.clear();
    }

    /// Goes back one step from `now`. A step in which nothing changed is passed over.
    pub fn undo(&mut self, now: Snapshot) -> Option<Snapshot> {
        let back = std::iter::from_fn(|| self.done.pop()).find(|step| *step != now)?;
        self.undone.push(now);
        Some(back)
    }

    /// Goes forward one step from `now`.
    pub fn redo(&mut self, now: Snapshot) -> Option<Snapshot> {
        let next = std::iter::from_fn(|| self.undone.pop()).find(|step| *step != now)?;
        self.done.push(now);
        Some(next)
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
        Snapshot { model: ModelTransform { scale, ..ModelTransform::default() }, light: None, hidden: Vec::new() }
    }

    #[test]
    fn steps_go_back_and_forth() {
        let mut history = History::default();
        history.remember(scaled(1.0));
        history.remember(scaled(2.0));
        assert_eq!(history.undo(scaled(3.0)), Some(scaled(2.0)));
        assert_eq!(history.undo(scaled(2.0)), Some(scaled(1.0)));
        assert_eq!(history.undo(scaled(1.0)), None);
        assert_eq!(history.redo(scaled(1.0)), Some(scaled(2.0)));
        history.remember(scaled(2.0));
        assert!(!history.can_redo() && history.can_undo());
    }

    #[test]
    fn a_step_that_changed_nothing_is_passed_over() {
        let mut history = History::default();
        history.remember(scaled(1.0));
        history.remember(scaled(2.0));
        assert_eq!(history.undo(scaled(2.0)), Some(scaled(1.0)));
    }

    #[test]
    fn the_depth_is_bounded() {
        let mut history = History::default();
        for step in 0..1000 {
            history.remember(scaled(f64::from(step) + 1.0));
        }
        assert_eq!(history.done.len(), History::DEPTH);
    }
}

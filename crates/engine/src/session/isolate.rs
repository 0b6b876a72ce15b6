//! Showing the selection alone, hiding it, and showing everything again.

use super::{ChangeSet, Session, UndoStep};
use sinew_scene::NodeId;
use sinew_scene::message;

impl Session {
    /// Whether the selection is shown alone.
    pub fn is_isolated(&self) -> bool {
        self.isolated.is_some()
    }

    /// Whether anything is hidden.
    pub fn hides_something(&self) -> bool {
        self.document.scene.graph.iter().any(|(_, node)| !node.visible)
    }

    /// Shows the selected node with what is below it alone; the second time everything that was shown before comes back.
    pub fn toggle_isolated(&mut self) {
        if let Some(hidden) = self.isolated.take() {
            return self.undoable(message!("app-edit-isolate"), UndoStep::New, |session| session.hide_exactly(&hidden));
        }
        let Some(selected) = self.view.display.highlight.selected else { return };
        let graph = &self.document.scene.graph;
        let hidden: Vec<NodeId> = graph.iter().filter(|(_, node)| !node.visible).map(|(id, _)| id).collect();
        let above: Vec<NodeId> = std::iter::successors(Some(selected), |id| graph.node(*id).parent()).collect();
        // Hiding a node hides what is below it, so the brothers and sisters of the way down are enough.
        let beside =
            |id: NodeId| !above.contains(&id) && graph.node(id).parent().is_none_or(|parent| parent != selected && above.contains(&parent));
        let others = graph.iter().map(|(id, _)| id).filter(|id| beside(*id));
        let below = hidden.iter().copied().filter(|id| !above.contains(id) && !beside(*id));
        let mut alone: Vec<NodeId> = others.chain(below).collect();
        alone.sort_unstable();
        self.undoable(message!("app-edit-isolate"), UndoStep::New, |session| session.hide_exactly(&alone));
        self.isolated = Some(hidden);
        // A bone without its skin is seen as a bone.
        let hidden = !self.frame().surfaces.iter().any(|surface| surface.visible && surface.ghost.is_none());
        if hidden && !self.view.display.bones {
            self.change_display(|display| display.bones = true);
        }
    }

    /// Hides the selected node with what is below it.
    pub fn hide_selected(&mut self) {
        if let Some(selected) = self.view.display.highlight.selected {
            self.set_visible(selected, false);
        }
    }

    /// Shows everything.
    pub fn show_all(&mut self) {
        if self.hides_something() {
            self.isolated = None;
            self.undoable(message!("app-edit-visible"), UndoStep::New, |session| session.hide_exactly(&[]));
        }
    }

    /// Hides these nodes, ascending, and no others.
    fn hide_exactly(&mut self, hidden: &[NodeId]) {
        for index in 0..self.document.scene.graph.len() as u32 {
            let id = NodeId(index);
            self.document.scene.graph.node_mut(id).visible = hidden.binary_search(&id).is_err();
        }
        self.needs_posing = true;
        self.changed(ChangeSet::DISPLAY);
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::swinging;
    use super::*;

    #[test]
    fn the_selection_alone_and_back() {
        let mut session = Session::new(swinging());
        let root = session.document().scene.graph.find("root").expect("a root");
        let arm = session.document().scene.graph.find("arm").expect("an arm");
        let hand = session.document().scene.graph.find("hand").expect("a hand");
        let other = session.document().scene.graph.find("other").expect("another");
        let shown = |session: &Session| [root, arm, hand, other].map(|id| session.document().scene.graph.is_shown(id));
        session.set_visible(hand, false);
        session.select(Some(arm));
        session.toggle_isolated();
        assert!(session.is_isolated());
        assert_eq!(shown(&session), [true, true, false, false]);
        session.toggle_isolated();
        assert_eq!(shown(&session), [true, true, false, true]);
        session.undo();
        assert_eq!(shown(&session), [true, true, false, false]);
        session.show_all();
        assert_eq!((shown(&session), session.is_isolated()), ([true; 4], false));
        session.select(Some(other));
        session.toggle_isolated();
        assert_eq!(shown(&session), [true, false, false, true]);
        assert!(session.display().bones, "nothing else would be seen");
        session.select(Some(root));
        session.hide_selected();
        assert_eq!(shown(&session), [false; 4]);
    }
}

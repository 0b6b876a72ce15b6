//! Camera that follows a node that the clip moves.

use super::{ChangeSet, Session};
use crate::view::CameraFollow;
use sinew_scene::{NodeId, NodeKind};

impl Session {
    /// The node that the camera follows.
    pub fn followed(&self) -> Option<NodeId> {
        self.view.follow.map(|follow| follow.node)
    }

    /// Whether there is something to go along with.
    pub fn can_follow(&self) -> bool {
        self.clip().is_some() && self.to_follow().is_some()
    }

    /// The selection, else the first joint.
    fn to_follow(&self) -> Option<NodeId> {
        let first = || self.document.scene.graph.iter().find(|(_, node)| node.kind == NodeKind::Joint).map(|(id, _)| id);
        self.selected().or_else(first)
    }

    /// Goes along with the selection, or with the skeleton where nothing is selected; or stays behind again.
    pub fn toggle_follow(&mut self) {
        let node = if self.view.follow.is_some() { None } else { self.to_follow() };
        self.follow_node(node);
    }

    /// Goes along with a node from here on; `None` = with nothing.
    pub(super) fn follow_node(&mut self, node: Option<NodeId>) {
        self.followed_at = self.playback.time;
        self.view.follow = node
            .filter(|node| node.index() < self.document.scene.graph.len())
            .map(|node| CameraFollow { node, reference: self.frame().position(node) });
        self.changed(ChangeSet::CAMERA);
    }

    /// Moves the camera by the displacement of the followed node after time has changed.
    pub(super) fn update_follow(&mut self) {
        let Some(follow) = &mut self.view.follow else { return };
        let (time, offset) = (self.playback.time, follow.offset(&self.frame));
        follow.reference += offset;
        if std::mem::replace(&mut self.followed_at, time) != time {
            self.view.camera.move_by(offset);
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::super::tests::swinging;
    use super::*;
    use crate::session::LoadMode;

    fn place(session: &mut Session) -> Vec3 {
        let hand = session.document().scene.graph.find("hand").expect("a hand");
        session.frame().position(hand)
    }

    #[test]
    fn what_is_followed_stays_where_it_is_in_the_picture() {
        let mut session = Session::new(swinging());
        session.select(session.document().scene.graph.find("hand"));
        let off = |session: &mut Session| place(session) - session.picture().2.eye;
        let (before, there) = (off(&mut session), place(&mut session));
        session.toggle_follow();
        for time in [0.25, 0.75, 0.5] {
            session.time(|cursor| cursor.seek(time));
            assert!((off(&mut session) - before).length() < 1e-4, "at {time}");
        }
        assert!((place(&mut session) - there).length() > 0.1, "it swings");
        // Moving the model does not advance time.
        let eye = session.picture().2.eye;
        session.change_model(|model| model.translate(glam::DVec3::X));
        assert_eq!(session.picture().2.eye, eye);
        session.toggle_follow();
        session.time(|cursor| cursor.seek(0.9));
        assert_eq!((session.picture().2.eye, session.followed()), (eye, None));
    }

    #[test]
    fn following_outlives_a_reload_and_ends_with_the_file() {
        let mut session = Session::new(swinging());
        assert!(session.can_follow());
        session.toggle_follow();
        let followed = session.followed();
        assert!(followed.is_some(), "the skeleton where nothing is selected");
        session.show(swinging(), LoadMode::Again);
        assert_eq!(session.followed(), followed);
        session.show(swinging(), LoadMode::New);
        assert_eq!(session.followed(), None);
    }
}

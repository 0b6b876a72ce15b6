//! Onion skins and the motion path of the selected node.

use super::{ChangeSet, Session};
use crate::view::{OnionSkinSettings, PoseContext, SceneOverlays};

impl Session {
    /// Which onion skins are drawn.
    pub fn onion_skin_settings(&self) -> OnionSkinSettings {
        self.overlays.onion_skin_settings()
    }

    /// Changes which onion skins are drawn.
    pub fn change_onion_skin_settings(&mut self, change: impl FnOnce(&mut OnionSkinSettings)) {
        let mut skins = self.onion_skin_settings();
        change(&mut skins);
        if self.overlays.set_onion_skin_settings(skins) {
            self.changed(ChangeSet::OVERLAYS);
        }
    }

    /// What accompanies the scene, for pictures of it that are made elsewhere.
    pub fn overlays(&self) -> SceneOverlays {
        self.overlays.clone_for_frame()
    }

    /// Takes surfaces back from the frame, before it is posed.
    pub(super) fn remove_overlays(&mut self) {
        self.overlays.remove_from(&mut self.frame);
    }

    /// Poses what accompanies the scene and puts it into the frame, which has just been posed.
    pub(super) fn append_overlays(&mut self) {
        let host = PoseContext::new(&self.document, self.state(), self.frame_rate, &self.view.display);
        self.overlays.append_to(&host, &mut self.frame);
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::swinging;
    use super::*;
    use sinew_scene::{NodeId, OverlayLine};

    #[test]
    fn onion_skins_are_the_moments_round_the_present_one() {
        let mut session = Session::new(swinging());
        let own = session.frame().surfaces.len();
        assert!(own > 0);
        session.choose_rate(Some(10.0));
        session.change_onion_skin_settings(|skins| *skins = OnionSkinSettings { shown: true, before: 3, after: 2, step: 2, path: false });
        session.time(|time| time.seek(0.5));
        let frame = session.frame();
        assert_eq!(frame.surfaces.len(), own * 5);
        assert!(frame.surfaces.iter().skip(own).all(|surface| surface.ghost.is_some()));
        // Each onion skin is where the thing itself is at that moment.
        let skin = frame.surfaces[own * 3].position(0);
        session.change_onion_skin_settings(|skins| skins.shown = false);
        session.time(|time| time.seek(0.7));
        let frame = session.frame();
        assert_eq!(frame.surfaces.len(), own);
        assert!((frame.surfaces[0].position(0) - skin).length() < 1e-5);
    }

    #[test]
    fn the_path_goes_through_the_keys() {
        let mut session = Session::new(swinging());
        session.select(session.document().scene.graph.find("arm"));
        session.change_onion_skin_settings(|skins| skins.path = true);
        let keys = session.own_keys().len();
        assert!(keys >= 2);
        let node = session.selected().expect("selected");
        let first = {
            session.time(|time| time.seek(0.0));
            session.frame().position(node)
        };
        let key_dots: Vec<OverlayLine> = session.frame().overlay_lines.iter().filter(|mark| mark.from == mark.to).copied().collect();
        assert_eq!(key_dots.len(), keys + 1);
        assert!((key_dots[0].from - first).length() < 1e-6);
        session.select(Some(NodeId(0)));
        session.select(None);
        assert!(session.frame().overlay_lines.is_empty());
    }
}

//! Conversion between a session and the contents of a session file.

use std::path::{Path, PathBuf};

use super::{CompareTarget, LoadMode, Session, Viewpoint};
use crate::document::{Document, Skinning};
use crate::view::{RecoveryFile, SavedCamera, SavedComparison, SavedModel, SavedRotation, SessionState, saved_node};
use sinew_muscle::MuscleFile;
use sinew_scene::animation::LoopMode;

/// Loop modes by the names that the file uses.
const MODES: [(&str, LoopMode); 3] = [("loop", LoopMode::Loop), ("once", LoopMode::Once), ("ping-pong", LoopMode::PingPong)];

impl Session {
    /// What is not saved, for the recovery file; `None` where all is.
    pub fn recovery_file(&self) -> Option<RecoveryFile> {
        self.is_unsaved().then(|| RecoveryFile {
            files: self.files().into_iter().map(|path| std::path::absolute(&path).unwrap_or(path)).collect(),
            muscles: self.document().muscle_files().map(MuscleFile::to_yaml).collect(),
        })
    }

    /// What a session file in `folder` keeps of this.
    pub fn session_state(&self, folder: &Path) -> SessionState {
        let beside = |path: PathBuf| {
            let whole = std::path::absolute(&path).unwrap_or(path);
            std::path::absolute(folder).ok().and_then(|folder| whole.strip_prefix(folder).ok().map(Path::to_path_buf)).unwrap_or(whole)
        };
        let document = self.document();
        let orbit = self.camera_controller().orbit();
        let model = self.model();
        SessionState {
            files: self.files().into_iter().map(beside).collect(),
            clip: self.clip_index().and_then(|index| document.clip_key(index)),
            time: self.playback().time,
            flexion: document.driven_rig().map(|_| self.drive().flexion),
            camera: Some(SavedCamera {
                target: orbit.target.to_array(),
                yaw: orbit.yaw,
                pitch: orbit.pitch,
                distance: orbit.distance,
                orthographic: orbit.orthographic,
            }),
            light: self.light().map(|aim| [aim.yaw, aim.pitch]),
            model: (!model.is_identity()).then(|| SavedModel {
                translation: model.translation.to_array(),
                rotation: model.degrees().to_array(),
                scale: model.scale,
            }),
            dual_quaternions: self.state().skinning == Skinning::DualQuaternion,
            skin_follows_muscles: (!self.skin_follows_muscles()).then_some(false),
            display: self.display_options(),
            hidden: document.scene.graph.iter().filter(|(_, node)| !node.visible).map(|(id, _)| saved_node(document, id)).collect(),
            selected: self.selected().map(|node| saved_node(document, node)),
            weights: self.display().highlight.weights.is_some(),
            onion_skins: self.onion_skin_settings(),
            speed: Some(self.playback().speed),
            loop_mode: MODES.iter().find(|(_, mode)| *mode == self.playback().mode).map_or("loop", |(name, _)| name).into(),
            marks: [self.playback().mark_a, self.playback().mark_b],
            file_camera: match self.camera_controller().viewpoint() {
                Viewpoint::File(node, _) => Some(saved_node(document, node)),
                Viewpoint::Orbit | Viewpoint::Fly(_) => None,
            },
            follow: self.followed().map(|node| saved_node(document, node)),
            compared: self.saved_comparison(&beside),
            turned: self
                .joint_control()
                .overrides()
                .iter()
                .map(|turn| SavedRotation { joint: saved_node(document, turn.node), degrees: turn.degrees.to_array() })
                .collect(),
        }
    }

    fn saved_comparison(&self, beside: &dyn Fn(PathBuf) -> PathBuf) -> Option<SavedComparison> {
        let (later, aside) = self.compare_offset()?;
        let toward = self.overlays.comparison().map(|comparison| comparison.direction().to_array());
        let blank = SavedComparison { later, aside, toward, ..SavedComparison::default() };
        Some(match self.compare_target()? {
            CompareTarget::File(_, name) => SavedComparison { file: Some(beside(name.into())), ..blank },
            CompareTarget::Clip(clip) => SavedComparison { clip: self.document().clip_key(*clip), ..blank },
            CompareTarget::Skinning => SavedComparison { skinning: true, ..blank },
        })
    }

    /// Shows a document as a session file says. What no longer exists is passed over; numbers that are none are too.
    pub fn show_session(&mut self, mut document: Document, saved: &SessionState) {
        saved.apply_to_document(&mut document);
        let selected = saved.selected.as_ref().and_then(|node| node.find(&document));
        self.show(document, LoadMode::New);
        saved.apply_to_joints(&self.document, &mut self.state.joints);
        self.set_display_options(&saved.display);
        let clip = saved.clip.as_ref().and_then(|name| self.document().clip_named(name));
        if clip.is_some() {
            self.set_clip(clip);
        }
        self.set_skinning(if saved.dual_quaternions { Skinning::DualQuaternion } else { Skinning::Linear });
        self.set_skin_follows_muscles(saved.skin_follows_muscles != Some(false));
        let mode = MODES.iter().find(|(name, _)| *name == saved.loop_mode).map_or(LoopMode::Loop, |(_, mode)| *mode);
        self.time(|cursor| {
            cursor.mode = mode;
            if let Some(speed) = saved.speed.filter(|speed| speed.is_finite() && *speed != 0.0) {
                cursor.set_speed(speed.abs());
                cursor.speed = cursor.speed.abs() * speed.signum();
            }
            let within = |mark: Option<f64>| mark.filter(|mark| *mark >= cursor.start && *mark <= cursor.end);
            (cursor.mark_a, cursor.mark_b) = (within(saved.marks[0]), within(saved.marks[1]));
            if saved.time.is_finite() {
                cursor.seek(saved.time);
            }
        });
        if let Some(degrees) = saved.flexion {
            self.set_flexion(degrees);
        }
        self.view.light = saved.light_direction();
        if let Some(model) = saved.model {
            self.change_model(|ours| model.apply_to(ours));
        }
        self.restore_camera(saved);
        if let Some(compared) = &saved.compared {
            let with = compared.target_within(self.document());
            if with.is_some() {
                // The offset points to the right of the view; the camera is fitted to both poses.
                self.set_comparison(with);
                self.apply_saved_comparison(compared);
                match saved.camera {
                    Some(_) => self.restore_camera(saved),
                    None => self.fit(),
                }
            }
        }
        if let Some((node, camera)) = saved.found_file_camera(self.document()) {
            self.change_camera(|eye| eye.look_through(node, camera));
        }
        self.follow_node(saved.follow.as_ref().and_then(|node| node.find(self.document())));
        self.select(selected);
        self.set_weights(saved.weights);
        self.change_onion_skin_settings(|skins| *skins = saved.onion_skins);
    }

    /// The orbit stands where a session file says.
    fn restore_camera(&mut self, saved: &SessionState) {
        let reach = self.motion_bounds();
        if let Some(orbit) = saved.camera.and_then(|camera| camera.orbit(&reach)) {
            self.change_camera(|eye| eye.change(|ours| *ours = orbit));
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::super::OnionSkinSettings;
    use super::super::tests::swinging;
    use super::*;
    use crate::document::PoseBuffers;
    use crate::view::{BackgroundPreset, PoseContext, SceneOverlays};
    use sinew_render::Display;
    use sinew_scene::{Bounds, Frame, NodeId};

    #[test]
    fn a_session_comes_back_as_it_was_saved() {
        let mut session = Session::new(Document::built_in());
        session.set_flexion(40.0);
        session.set_visible(NodeId(1), false);
        session.select(Some(NodeId(2)));
        session.rotate_light(20.0, 10.0);
        session.change_model(|model| model.scale_by(2.0));
        session.change_camera(|eye| eye.change(|orbit| orbit.orbit(33.0, -4.0)));
        session.change_display(|display| (display.bones, display.line_width) = (true, 2.5));
        session.set_backdrop(BackgroundPreset::Grey);
        session.set_bone_names(true);
        session.set_skinning(Skinning::DualQuaternion);
        session.set_skin_follows_muscles(false);
        session.override_joint(NodeId(2), DVec3::new(1.0, 2.5, -3.0));
        let saved = session.session_state(Path::new("/somewhere"));
        let read = SessionState::parse(&saved.to_yaml().expect("written")).expect("a session file").expect("sound");
        assert_eq!(read, saved);
        let mut other = Session::default();
        other.show_session(Document::built_in(), &read);
        assert_eq!(other.session_state(Path::new("/somewhere")), saved);
        assert_eq!((other.display_options(), other.display().highlight), (session.display_options(), session.display().highlight));
    }

    #[test]
    fn time_onion_skins_and_comparison_come_back() {
        let mut session = Session::new(swinging());
        session.time(|time| (time.mode, time.speed, time.mark_a, time.mark_b) = (LoopMode::PingPong, -0.5, Some(0.25), Some(0.75)));
        session.time(|time| time.seek(0.5));
        session.choose_rate(Some(50.0));
        session.select(session.document().scene.graph.find("arm"));
        session.change_onion_skin_settings(|skins| *skins = OnionSkinSettings { shown: true, before: 1, after: 4, step: 3, path: true });
        session.compare(Some(CompareTarget::Clip(0)));
        session.set_compare_offsets(0.125, 2.0);
        session.toggle_follow();
        let saved = session.session_state(Path::new("/somewhere"));
        let read = SessionState::parse(&saved.to_yaml().expect("written")).expect("a session file").expect("sound");
        let mut other = Session::default();
        other.show_session(swinging(), &read);
        assert_eq!(other.session_state(Path::new("/somewhere")), saved);
        assert_eq!((other.onion_skin_settings(), other.compare_offset()), (session.onion_skin_settings(), Some((0.125, 2.0))));
    }

    #[test]
    fn a_picture_of_the_file_has_the_company_of_the_window() {
        let mut session = Session::new(swinging());
        session.time(|time| time.seek(0.5));
        session.choose_rate(Some(50.0));
        session.select(session.document().scene.graph.find("arm"));
        session.change_onion_skin_settings(|skins| *skins = OnionSkinSettings { shown: true, before: 1, after: 4, step: 3, path: true });
        session.compare(Some(CompareTarget::Skinning));
        session.set_compare_offsets(0.0, 2.0);
        session.fit();
        session.change_camera(|eye| eye.change(|orbit| orbit.orbit(77.0, -4.0)));
        let saved = session.session_state(Path::new("/somewhere"));

        let mut other = Session::default();
        other.show_session(swinging(), &saved);
        assert_eq!(other.camera_controller().orbit(), session.camera_controller().orbit());

        let document = swinging();
        let (mut overlays, rate) = SceneOverlays::from_session(&saved, &document, None);
        let (mut frame, state) = (Frame::default(), saved.pose_state(&document));
        let display =
            Display { palette: other.display().palette, ..saved.view_state(&document, &state, &Bounds::EMPTY, &Bounds::EMPTY).display };
        for _ in 0..2 {
            overlays.remove_from(&mut frame);
            document.pose(&state, &mut PoseBuffers::default(), &mut frame);
            overlays.append_to(&PoseContext::new(&document, state.clone(), rate, &display), &mut frame);
        }
        let shown = other.frame();
        assert!(shown.overlay_lines.len() > 10 && frame.overlay_lines == shown.overlay_lines);
        assert_eq!(frame.surfaces.len(), shown.surfaces.len());
        for (a, b) in frame.surfaces.iter().zip(&shown.surfaces) {
            assert_eq!((a.ghost, a.position(0), a.position(2)), (b.ghost, b.position(0), b.position(2)));
        }
    }

    #[test]
    fn senseless_numbers_are_passed_over() {
        let bad = "sinew_session:\n  time: .nan\n  camera: {target: [.inf, 0, 0], yaw: 1, pitch: 2, distance: -1}\n  model: {translation: [.nan, 0, 0], rotation: [0, 0, 0], scale: -1}\n  hidden: [{node: 9999, name: gone}]\n  line-width: .nan\n  speed: .inf\n  marks: [.nan, 1e9]\n  ghosts: {before: 4000000000, step: 0}\n";
        let saved = SessionState::parse(bad).expect("a session file").expect("sound YAML");
        let mut session = Session::default();
        session.show_session(Document::built_in(), &saved);
        assert!(session.model().is_identity() && session.camera_controller().orbit().distance > 0.0 && session.playback().time.is_finite());
        assert!(
            session.onion_skin_settings().before <= 10 && session.onion_skin_settings().step >= 1 && session.display().line_width == 1.0
        );
        assert!(session.playback().speed.is_finite() && session.playback().mark_a.is_none());
    }
}

//! Session files: what is open and how it is looked at, as YAML under a key of its own.

use std::path::{Path, PathBuf};

use glam::{DVec3, Vec3};
use serde::{Deserialize, Serialize};

use super::{Arrival, LightAim, Session};
use crate::app::settings::Settings;
use crate::document::{Document, Skinning};
use crate::limits;
use crate::scene::NodeId;

/// The key that tells a session file from a muscle file.
const KEY: &str = "sinew_session";

/// A whole session file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SessionFile {
    /// The session.
    pub sinew_session: Saved,
}

/// What a session file keeps. A key that is missing means what a fresh start has.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, rename_all = "kebab-case")]
pub struct Saved {
    /// The open files, relative to the session file where they lie beside or below it; none = the built-in scene.
    pub files: Vec<PathBuf>,
    /// The name of the clip.
    pub clip: Option<String>,
    /// Seconds on the file's own time axis.
    pub time: f64,
    /// Elbow angle of a driven arm, degrees.
    pub flexion: Option<f64>,
    /// The orbiting camera.
    pub camera: Option<SavedCamera>,
    /// Yaw and pitch of the light, degrees; none = with the camera.
    pub light: Option<[f32; 2]>,
    /// The model's own transform: metres, degrees about X, Y, Z, scale.
    pub model: Option<SavedModel>,
    /// Whether dual quaternions are blended.
    pub dual_quaternions: bool,
    /// Whether the names of bones are written.
    pub bone_names: bool,
    /// `flat`, `gouraud` or `phong`.
    pub shading: String,
    /// Anti-aliasing.
    pub smooth_edges: bool,
    /// Switches of the display that are on, as in the settings.
    pub shown: Vec<String>,
    /// Numbers of the hidden nodes, in the order of the tree, with their names.
    pub hidden: Vec<SavedNode>,
    /// The selected node.
    pub selected: Option<SavedNode>,
    /// Joints turned by hand.
    pub turned: Vec<SavedTurn>,
}

/// A camera on its turntable.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SavedCamera {
    /// The point it looks at, metres.
    pub target: [f32; 3],
    /// Degrees.
    pub yaw: f32,
    /// Degrees.
    pub pitch: f32,
    /// Metres.
    pub distance: f32,
    /// Parallel rays.
    #[serde(default)]
    pub orthographic: bool,
}

/// The model's transform.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SavedModel {
    /// Metres.
    pub translation: [f64; 3],
    /// Degrees about X, Y, Z.
    pub rotation: [f64; 3],
    /// Above 0.
    pub scale: f64,
}

/// A node, by its place in the tree and its name: both must fit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SavedNode {
    /// Place in the tree, parents before children.
    pub node: u32,
    /// Its name.
    pub name: String,
}

/// A joint turned by hand.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SavedTurn {
    /// The joint.
    #[serde(flatten)]
    pub joint: SavedNode,
    /// Degrees about its own axes.
    pub degrees: [f64; 3],
}

/// Why a session file cannot be used.
#[derive(Debug, Clone, PartialEq)]
pub struct SessionError {
    /// Line from 1, where it is known.
    pub line: Option<u32>,
    /// What is wrong.
    pub message: String,
}

impl Saved {
    /// Reads a session file; `None` where the file is none (another kind, or not readable: the document's reader says what is wrong with it).
    pub fn read(path: &Path) -> Option<Result<Self, SessionError>> {
        let about = std::fs::metadata(path).ok().filter(|about| about.is_file() && about.len() <= limits::YAML_BYTES)?;
        let ending = path.extension()?.to_str()?;
        if about.len() == 0 || !["yaml", "yml"].iter().any(|ours| ending.eq_ignore_ascii_case(ours)) {
            return None;
        }
        Self::parse(&std::fs::read_to_string(path).ok()?)
    }

    /// Reads a session file's text; `None` where it has not the key of one.
    pub fn parse(text: &str) -> Option<Result<Self, SessionError>> {
        text.lines().any(|line| line.trim_end().strip_prefix(KEY).is_some_and(|rest| rest.trim_start().starts_with(':'))).then(|| {
            let read = serde_yaml::from_str::<SessionFile>(text).map(|file| file.sinew_session);
            read.map_err(|error| SessionError {
                line: error.location().map(|place| place.line() as u32),
                message: error.to_string().lines().next().unwrap_or_default().to_owned(),
            })
        })
    }

    /// As YAML.
    ///
    /// # Errors
    /// What the writer says; numbers and names of a session can always be written.
    pub fn text(&self) -> std::io::Result<String> {
        serde_yaml::to_string(&SessionFile { sinew_session: self.clone() }).map_err(std::io::Error::other)
    }

    /// The files, seen from where the program runs; `folder` is that of the session file.
    pub fn paths(&self, folder: &Path) -> Vec<PathBuf> {
        self.files.iter().map(|file| folder.join(file)).collect()
    }
}

fn name(document: &Document, node: NodeId) -> SavedNode {
    SavedNode { node: node.0, name: document.scene.graph.node(node).name.clone() }
}

/// The node that was meant: at its place if the name is still the same, else the first one of that name.
fn find(document: &Document, saved: &SavedNode) -> Option<NodeId> {
    let there = NodeId(saved.node);
    let graph = &document.scene.graph;
    let same = there.index() < graph.len() && graph.node(there).name == saved.name;
    if same { Some(there) } else { graph.find(&saved.name) }
}

impl Session {
    /// What a session file in `folder` keeps of this.
    pub fn to_saved(&self, folder: &Path) -> Saved {
        let beside = |path: PathBuf| {
            let whole = std::path::absolute(&path).unwrap_or(path);
            std::path::absolute(folder).ok().and_then(|folder| whole.strip_prefix(folder).ok().map(Path::to_path_buf)).unwrap_or(whole)
        };
        let document = self.document();
        let mut looks = Settings::default();
        looks.take(self);
        let orbit = self.eye().orbit();
        let model = self.model();
        Saved {
            files: self.files().into_iter().map(beside).collect(),
            clip: self.clip().map(|clip| clip.name.clone()),
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
            bone_names: self.bone_names(),
            shading: looks.shading,
            smooth_edges: looks.smooth_edges,
            shown: looks.shown,
            hidden: document.scene.graph.iter().filter(|(_, node)| !node.visible).map(|(id, _)| name(document, id)).collect(),
            selected: self.selected().map(|node| name(document, node)),
            turned: document
                .hand_turns()
                .iter()
                .map(|turn| SavedTurn { joint: name(document, turn.node), degrees: turn.degrees.to_array() })
                .collect(),
        }
    }

    /// Shows a document as a session file says. What no longer exists is passed over; numbers that are none are too.
    pub fn show_saved(&mut self, mut document: Document, saved: &Saved) {
        for node in &saved.hidden {
            if let Some(id) = find(&document, node) {
                document.scene.graph.node_mut(id).visible = false;
            }
        }
        for turn in &saved.turned {
            if let Some(node) = find(&document, &turn.joint) {
                document.set_hand_turn(node, DVec3::from_array(turn.degrees));
            }
        }
        let selected = saved.selected.as_ref().and_then(|node| find(&document, node));
        self.show(document, Arrival::New);
        let looks = Settings {
            shading: saved.shading.clone(),
            smooth_edges: saved.smooth_edges,
            shown: saved.shown.clone(),
            ..Settings::default()
        };
        looks.apply(self);
        self.set_bone_names(saved.bone_names);
        self.set_skinning(if saved.dual_quaternions { Skinning::DualQuaternion } else { Skinning::Linear });
        let clip = saved.clip.as_ref().and_then(|name| self.document().clips.iter().position(|clip| clip.name == *name));
        if clip.is_some() {
            self.set_clip(clip);
        }
        let time = saved.time;
        self.time(|cursor| {
            if time.is_finite() {
                cursor.seek(time);
            }
        });
        if let Some(degrees) = saved.flexion {
            self.set_flexion(degrees);
        }
        self.light = saved.light.map(|[yaw, pitch]| {
            let mut aim = LightAim { yaw: 0.0, pitch: 0.0 };
            aim.turn(yaw, pitch);
            aim
        });
        if let Some(model) = saved.model {
            self.change_model(|ours| {
                ours.shift(DVec3::from_array(model.translation));
                ours.set_degrees(DVec3::from_array(model.rotation));
                ours.set_scale(model.scale);
            });
        }
        if let Some(camera) = saved.camera {
            let numbers = [camera.yaw, camera.pitch, camera.distance];
            let target = Vec3::from_array(camera.target);
            if target.is_finite() && numbers.iter().all(|number| number.is_finite()) && camera.distance > 0.0 {
                self.change_eye(|eye| {
                    eye.handle(|orbit| {
                        (orbit.target, orbit.yaw, orbit.distance) = (target, camera.yaw, camera.distance);
                        orbit.pitch = camera.pitch.clamp(-90.0, 90.0);
                        orbit.orthographic = camera.orthographic;
                    });
                });
            }
        }
        self.select(selected);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_session_comes_back_as_it_was_saved() {
        let mut session = Session::new(Document::built_in());
        session.set_flexion(40.0);
        session.set_visible(NodeId(1), false);
        session.select(Some(NodeId(2)));
        session.turn_light(20.0, 10.0);
        session.change_model(|model| model.grow(2.0));
        session.change_eye(|eye| eye.handle(|orbit| orbit.orbit(33.0, -4.0)));
        session.change_display(|display| display.bones = true);
        session.set_bone_names(true);
        session.set_skinning(Skinning::DualQuaternion);
        session.turn_by_hand(NodeId(2), DVec3::new(1.0, 2.5, -3.0));
        let saved = session.to_saved(Path::new("/somewhere"));
        let read = Saved::parse(&saved.text().expect("written")).expect("a session file").expect("sound");
        assert_eq!(read, saved);
        let mut other = Session::default();
        other.show_saved(Document::built_in(), &read);
        assert_eq!(other.to_saved(Path::new("/somewhere")), saved);
        assert_eq!((other.display(), other.selected()), (session.display(), session.selected()));
    }

    #[test]
    fn files_beside_the_session_are_named_without_their_folder() {
        let saved = Saved { files: vec!["a/walk.dae".into(), "/else/arm.yaml".into()], ..Saved::default() };
        assert_eq!(saved.paths(Path::new("/home/me")), [PathBuf::from("/home/me/a/walk.dae"), "/else/arm.yaml".into()]);
    }

    #[test]
    fn other_files_are_none_and_broken_ones_say_where() {
        assert!(Saved::parse("muscle_config:\n  length: 1\n").is_none());
        let error = Saved::parse("sinew_session:\n  time: soon\n").expect("a session file").expect_err("broken");
        assert_eq!(error.line, Some(2), "{error:?}");
        let bad = "sinew_session:\n  time: .nan\n  camera: {target: [.inf, 0, 0], yaw: 1, pitch: 2, distance: -1}\n  model: {translation: [.nan, 0, 0], rotation: [0, 0, 0], scale: -1}\n  hidden: [{node: 9999, name: gone}]\n";
        let saved = Saved::parse(bad).expect("a session file").expect("sound YAML");
        let mut session = Session::default();
        session.show_saved(Document::built_in(), &saved);
        assert!(session.model().is_identity() && session.eye().orbit().distance > 0.0 && session.playback().time.is_finite());
    }
}

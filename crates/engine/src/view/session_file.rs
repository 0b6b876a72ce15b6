//! Session files: what is open and how it is looked at, as YAML under a key of its own.

use std::path::{Path, PathBuf};

use glam::{DVec3, Vec3};
use rustc_hash::FxHashMap;
use serde::{Deserialize, Serialize};

use super::{CameraFollow, DisplayOptions, LightDirection, ModelTransform, OnionSkinSettings, ViewState, file_cameras};
use crate::document::{Document, JointControl, OpenErrorKind, PoseBuffers, PoseState, SkinMotion, Skinning};
use crate::input;
use sinew_render::Highlight;
use sinew_scene::limits;
use sinew_scene::{Bounds, CameraId, Frame, Label, NodeId, OrbitCamera, Unnamed};
use sinew_yaml::{Node, Value, YamlError};

/// The key that tells a session file from a muscle file.
const KEY: &str = "sinew_session";

/// A whole session file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct SessionFile<T> {
    /// The session, or a part of its keys.
    pub sinew_session: T,
}

/// Contents of a session file. A missing key has its value of a fresh start.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, rename_all = "kebab-case")]
pub struct SessionState {
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
    /// Whether muscles move the skin over them; none = they do.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub skin_follows_muscles: Option<bool>,
    /// What is drawn and how.
    #[serde(flatten, skip_deserializing)]
    pub display: DisplayOptions,
    /// The hidden nodes.
    pub hidden: Vec<SavedNode>,
    /// The selected node.
    pub selected: Option<SavedNode>,
    /// Joints with an overridden rotation.
    pub turned: Vec<SavedRotation>,
    /// Whether the weights of the selected bone are painted.
    pub weights: bool,
    /// Onion skins and motion path.
    #[serde(rename = "ghosts")]
    pub onion_skins: OnionSkinSettings,
    /// Playback speed; negative = backwards; none = 1.
    pub speed: Option<f64>,
    /// `loop`, `once` or `ping-pong`.
    pub loop_mode: String,
    /// Start and end of the playback range, seconds.
    pub marks: [Option<f64>; 2],
    /// The node of the file camera that is looked through.
    pub file_camera: Option<SavedNode>,
    /// The node that the camera follows.
    pub follow: Option<SavedNode>,
    /// The comparison.
    pub compared: Option<SavedComparison>,
}

/// A comparison: one of file, clip and skinning.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, rename_all = "kebab-case")]
pub struct SavedComparison {
    /// A file, named as the open ones are.
    pub file: Option<PathBuf>,
    /// A clip of the open files, by name.
    pub clip: Option<String>,
    /// The other skinning method.
    pub skinning: bool,
    /// Time offset, seconds ahead.
    pub later: f64,
    /// Spatial offset, metres.
    pub aside: f64,
    /// Direction of the spatial offset; none = to the right of the view.
    pub toward: Option<[f64; 3]>,
}

/// An orbit camera.
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

/// A node, by its index in the tree and its name.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SavedNode {
    /// Index in the tree, parents before children.
    pub node: u32,
    /// Its name.
    pub name: String,
}

/// A joint with an overridden rotation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SavedRotation {
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
    pub kind: OpenErrorKind,
}

impl From<YamlError> for SessionError {
    fn from(error: YamlError) -> Self {
        Self { line: error.place.map(|place| place.line), kind: OpenErrorKind::Session(Box::new(error.kind)) }
    }
}

/// Whether a text has the key of a session at its top: in block style at the beginning of a line, which is told even where the rest is broken, else,
/// as in the JSON that names with control letters are written in, wherever YAML allows a key.
fn is_session(text: &str) -> bool {
    let begins = |line: &str| line.trim_end().strip_prefix(KEY).is_some_and(|rest| rest.trim_start().starts_with(':'));
    text.lines().any(begins)
        || text.contains(KEY)
            && matches!(sinew_yaml::read(text, limits::YAML_BYTES), Ok(Node { value: Value::Map(entries), .. }) if entries.iter().any(|(key, _)| {
                matches!(&key.value, Value::Plain(word) | Value::Text(word) if **word == *KEY)
            }))
}

impl SessionState {
    /// Reads a session file; `None` where the file is none (another kind, or not readable: the document's reader says what is wrong with it).
    pub fn read(path: &Path) -> Option<Result<Self, SessionError>> {
        let ending = path.extension()?.to_str()?;
        if !["yaml", "yml"].iter().any(|known| ending.eq_ignore_ascii_case(known)) {
            return None;
        }
        Self::parse(&input::read_text(path, limits::YAML_BYTES).ok()?)
    }

    /// Reads a session file's text; `None` where it has not the key of one.
    pub fn parse(text: &str) -> Option<Result<Self, SessionError>> {
        is_session(text).then(|| {
            let saved = sinew_yaml::from_text::<SessionFile<Self>>(text, limits::YAML_BYTES)?.sinew_session;
            // Read apart, so that an error in either has its line.
            let display = sinew_yaml::from_text::<SessionFile<DisplayOptions>>(text, limits::YAML_BYTES)?.sinew_session;
            let saved = Self { display: display.clamped(), ..saved };
            let files = saved.files.len();
            if files > limits::SESSION_FILES {
                return Err(SessionError { line: None, kind: OpenErrorKind::TooManyFiles(files) });
            }
            Ok(saved)
        })
    }

    /// As YAML.
    ///
    /// # Errors
    /// [`YamlError`]; numbers and names of a session can always be written.
    pub fn to_yaml(&self) -> Result<String, YamlError> {
        sinew_yaml::to_text(&SessionFile { sinew_session: self.clone() })
    }

    /// The files, seen from where the program runs; `folder` is that of the session file.
    pub fn paths(&self, folder: &Path) -> Vec<PathBuf> {
        self.files.iter().map(|file| input::named_in(folder, file)).collect()
    }

    /// The files and the one that is compared with, whether they can be opened or not; `folder` as in [`SessionState::paths`].
    pub fn all_files(&self, folder: &Path) -> Vec<PathBuf> {
        let compared = self.compared.as_ref().and_then(|compared| compared.file.as_ref());
        self.files.iter().chain(compared).map(|file| folder.join(file)).collect()
    }
}

/// A node as a session file names it.
pub fn saved_node(document: &Document, node: NodeId) -> SavedNode {
    SavedNode { node: node.0, name: document.scene.graph.label(node).plain().into_owned() }
}

impl SavedNode {
    /// The node that is meant: at its place if the name is still the same, else the first one of that name. The name of a node that the file gives none is
    /// known in any language.
    pub fn find(&self, document: &Document) -> Option<NodeId> {
        self.find_by(document, |name| document.scene.graph.find(name))
    }

    /// [`SavedNode::find`], with the first node of a name found by `first`.
    fn find_by(&self, document: &Document, first: impl FnOnce(&str) -> Option<NodeId>) -> Option<NodeId> {
        let at_index = NodeId(self.node);
        let graph = &document.scene.graph;
        let same = at_index.index() < graph.len() && graph.label(at_index).is(&self.name);
        if same { Some(at_index) } else { first(&self.name) }
    }
}

/// The nodes that are meant, in the same order.
fn find_nodes<'a>(document: &Document, wanted: impl Iterator<Item = &'a SavedNode>) -> Vec<Option<NodeId>> {
    let known = nodes_by_label(document);
    let unnamed = |name: &str| known.get(&Label::Unnamed(Unnamed::parse(name)?)).copied();
    let first = |name: &str| known.get(&Label::Name(name)).copied().or_else(|| unnamed(name));
    wanted.map(|node| node.find_by(document, first)).collect()
}

/// The first node that is called so: a session may name many.
fn nodes_by_label(document: &Document) -> FxHashMap<Label<'_>, NodeId> {
    let graph = &document.scene.graph;
    let mut first = FxHashMap::default();
    for (id, _) in graph.iter() {
        first.entry(graph.label(id)).or_insert(id);
    }
    first
}

impl SavedCamera {
    /// The camera, for a scene of this size; `None` where its numbers make none.
    pub fn orbit(&self, bounds: &Bounds) -> Option<OrbitCamera> {
        let numbers = [self.yaw, self.pitch, self.distance];
        let target = Vec3::from_array(self.target);
        let is_valid = target.is_finite() && numbers.iter().all(|number| number.is_finite()) && self.distance > 0.0;
        let mut orbit = OrbitCamera::default();
        orbit.fit(bounds, 1.0);
        (orbit.target, orbit.yaw, orbit.distance) = (target, self.yaw, self.distance);
        (orbit.pitch, orbit.orthographic) = (self.pitch.clamp(-90.0, 90.0), self.orthographic);
        is_valid.then_some(orbit)
    }
}

impl SavedModel {
    /// Sets translation, rotation and scale, keeping the pivot; numbers that are not finite change nothing.
    pub fn apply_to(&self, model: &mut ModelTransform) {
        model.translate(DVec3::from_array(self.translation));
        model.set_degrees(DVec3::from_array(self.rotation));
        model.set_scale(self.scale);
    }
}

impl SessionState {
    /// Hides nodes of a document that has just been opened. Nodes that no longer exist are skipped.
    pub fn apply_to_document(&self, document: &mut Document) {
        for id in find_nodes(document, self.hidden.iter()).into_iter().flatten() {
            document.scene.graph.node_mut(id).visible = false;
        }
    }

    /// Turns the joints that a file of the session has turned. Nodes that no longer exist are skipped.
    pub fn apply_to_joints(&self, document: &Document, joints: &mut JointControl) {
        let nodes = find_nodes(document, self.turned.iter().map(|turn| &turn.joint));
        for (turn, node) in self.turned.iter().zip(nodes) {
            if let Some(node) = node {
                joints.set_override(node, DVec3::from_array(turn.degrees));
            }
        }
    }

    /// The pose state of a document, after [`SessionState::apply_to_document`].
    pub fn pose_state(&self, document: &Document) -> PoseState {
        let mut state = document.start_state();
        let clip = self.clip.as_ref().and_then(|name| document.clip_named(name));
        state.clip = clip.or(state.clip);
        if let Some(clip) = state.clip.and_then(|index| document.clips.get(index)) {
            let time = if self.time.is_finite() { self.time } else { clip.start };
            state.time = time.clamp(clip.start, clip.end.max(clip.start));
        }
        if let (Some(degrees), Some(rig)) = (self.flexion.filter(|degrees| degrees.is_finite()), document.driven_rig()) {
            state.joints.drive = rig.at_flexion(degrees);
        }
        self.apply_to_joints(document, &mut state.joints);
        state.skinning = if self.dual_quaternions { Skinning::DualQuaternion } else { Skinning::Linear };
        state.skin = if self.skin_follows_muscles == Some(false) { SkinMotion::Skeleton } else { SkinMotion::FollowsMuscles };
        if let Some(saved) = &self.model {
            let mut frame = Frame::default();
            document.pose(&document.start_state(), &mut PoseBuffers::default(), &mut frame);
            let mut model = ModelTransform { pivot: frame.bounds.center().as_dvec3(), ..ModelTransform::default() };
            saved.apply_to(&mut model);
            state.model = model.matrix();
        }
        state
    }

    /// How a document is looked at without a window, in the dark theme. `state` is the pose that the file stores; the orbit camera is made for a scene that
    /// reaches as far as `reach`, the light stands round `lit`. Whether the file has a camera of its own is for [`SessionState::has_camera`] to say.
    pub fn view_state(&self, document: &Document, state: &PoseState, reach: &Bounds, lit: &Bounds) -> ViewState {
        let orbit = self.camera.and_then(|camera| camera.orbit(reach)).unwrap_or_default();
        let mut view = ViewState {
            light: self.light_direction(),
            follow: CameraFollow::from_session(self, document, state),
            ..ViewState::orbiting(orbit)
        };
        if let Some((node, camera)) = self.found_file_camera(document) {
            view.camera.look_through(node, camera);
        }
        view.set_options(&self.display);
        view.place_light(lit);
        let selected = self.selected.as_ref().and_then(|node| node.find(document));
        view.display.highlight = Highlight { selected, weights: selected.filter(|_| self.weights), hovered: None };
        view
    }

    /// Whether the file says from where to look.
    pub fn has_camera(&self, document: &Document) -> bool {
        self.camera.is_some_and(|camera| camera.orbit(&Bounds::EMPTY).is_some()) || self.found_file_camera(document).is_some()
    }

    /// The camera of the document that is looked through.
    pub fn found_file_camera(&self, document: &Document) -> Option<(NodeId, CameraId)> {
        let node = self.file_camera.as_ref()?.find(document)?;
        file_cameras(&document.scene).into_iter().find(|(carrier, _)| *carrier == node)
    }

    /// Direction to the light; `None` = the light is at the camera.
    pub fn light_direction(&self) -> Option<LightDirection> {
        self.light.map(|[yaw, pitch]| {
            let mut direction = LightDirection { yaw: 0.0, pitch: 0.0 };
            direction.rotate(yaw, pitch);
            direction
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sinew_scene::Node;

    #[test]
    fn a_node_without_a_name_is_found_by_its_place_and_by_what_any_language_calls_it() {
        let mut document = Document::default();
        let root = document.scene.graph.add(None, Node::new("a.dae"));
        let nodes = [0, 1].map(|_| document.scene.graph.add(Some(root), Node::new("")));
        for node in nodes {
            assert_eq!(saved_node(&document, node).find(&document), Some(node));
        }
        for name in ["Node 2", "Узел 2"] {
            assert_eq!(SavedNode { node: 7, name: name.into() }.find(&document), Some(nodes[1]), "{name}");
        }
        assert_eq!(SavedNode { node: 1, name: "arm".into() }.find(&document), None);
    }

    #[test]
    fn parts_of_the_arm_and_muscles_without_a_name_are_found_by_what_any_language_calls_them() {
        let mut document = Document::default();
        let root = document.scene.graph.add(None, Node::new("arm"));
        let mut elbow = Node::new("");
        elbow.id = "elbow".into();
        let elbow = document.scene.graph.add(Some(root), elbow);
        let muscles = [0, 1].map(|number| {
            let mut node = Node::new("");
            node.contents.push(sinew_scene::Content::Muscle(sinew_scene::MuscleId(number)));
            document.scene.graph.add(Some(root), node)
        });
        assert_eq!([elbow, muscles[0], muscles[1]].map(|node| saved_node(&document, node).name), ["Elbow", "Muscle 1", "Muscle 2"]);
        let turned = |name: &str| SavedRotation { joint: SavedNode { node: 9, name: name.into() }, degrees: [1.0; 3] };
        for (names, node) in [(["Elbow", "Локоть"], elbow), (["Muscle 2", "Мышца 2"], muscles[1])] {
            for name in names {
                assert_eq!(SavedNode { node: 9, name: name.into() }.find(&document), Some(node), "{name}");
                let state = SessionState { turned: vec![turned(name)], ..SessionState::default() }.pose_state(&document);
                assert_eq!(state.joints.overrides().iter().map(|turn| turn.node).collect::<Vec<_>>(), [node], "{name}");
            }
        }
    }

    #[test]
    fn files_beside_the_session_are_named_without_their_folder() {
        let saved = SessionState { files: vec!["a/walk.dae".into(), "/else/arm.yaml".into()], ..SessionState::default() };
        assert_eq!(saved.paths(Path::new("/home/me")), [PathBuf::from("/home/me/a/walk.dae"), "/else/arm.yaml".into()]);
    }

    #[test]
    fn other_files_are_none_and_broken_ones_say_where() {
        assert!(SessionState::parse("muscle_config:\n  length: 1\n").is_none());
        let error = SessionState::parse("sinew_session:\n  time: soon\n").expect("a session file").expect_err("broken");
        assert_eq!(error.line, Some(2), "{error:?}");
    }

    #[test]
    fn names_of_any_letters_come_back_from_a_session_file() {
        for name in [
            "plain.dae",
            "line\u{2028}end.dae",
            "turned\u{202e}round.dae",
            "bell\u{7}.dae",
            "c1\u{9b}.dae",
            "a: b # c.dae",
            "- x",
            "\"",
            "\n",
        ] {
            let compared = SavedComparison { file: Some(name.into()), ..SavedComparison::default() };
            let saved =
                SessionState { files: vec![name.into()], clip: Some(name.into()), compared: Some(compared), ..SessionState::default() };
            let text = saved.to_yaml().expect("written");
            let again = SessionState::parse(&text)
                .unwrap_or_else(|| panic!("no session: {text}"))
                .unwrap_or_else(|error| panic!("{error:?}: {text}"));
            assert_eq!((again.files, again.clip.as_deref()), (vec![PathBuf::from(name)], Some(name)));
        }
        for text in [
            "{sinew_session: {time: 1}}",
            "{\"sinew_session\": {\"time\": 1}}",
            "'sinew_session':\n  time: 1\n",
            "? sinew_session\n: {time: 1}\n",
        ] {
            assert_eq!(SessionState::parse(text).map(|read| read.map(|saved| saved.time).ok()), Some(Some(1.0)), "{text}");
        }
        for text in
            ["muscle_config: {sinew_session: 1}", "# sinew_session", "[sinew_session: 1]", "name: 'sinew_session:'", "{sinew_session"]
        {
            assert!(SessionState::parse(text).is_none(), "{text}");
        }
    }

    #[test]
    fn a_moment_is_found_without_a_window() {
        let mut document = Document::built_in();
        let saved = SessionState { flexion: Some(50.0), hidden: vec![saved_node(&document, NodeId(1))], ..SessionState::default() };
        saved.apply_to_document(&mut document);
        assert!(!document.scene.graph.node(NodeId(1)).visible);
        assert!((saved.pose_state(&document).joints.drive.flexion - 50.0).abs() < 1e-9);
    }
}

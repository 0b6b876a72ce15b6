//! Secondary poses drawn with the scene: onion skins, motion path, comparison.

use glam::Vec3;

use super::comparison::{Comparison, With};
use super::frames::guess_rate;
use super::motion_path::Trail;
use super::onion_skin::OnionSkin;
use super::{Ghosts, Saved};
use crate::document::{Document, PoseState};
use crate::render::Display;
use crate::scene::{Bounds, Frame, NodeId};

/// The scene that company joins, at one moment.
#[derive(Debug, Clone, Copy)]
pub struct PoseContext<'a> {
    /// The document.
    pub document: &'a Document,
    /// What it is posed as.
    pub state: PoseState,
    /// Frames a second of its frame numbers, above 0.
    pub rate: f64,
    /// The selected node, whose path is drawn.
    pub selected: Option<NodeId>,
    /// `0xRRGGBB` of the selection.
    pub paint: u32,
    /// Whether bones are drawn.
    pub bones: bool,
}

impl<'a> PoseContext<'a> {
    /// A document in a state, looked at through `display`.
    pub fn new(document: &'a Document, state: PoseState, rate: f64, display: &Display) -> Self {
        let bones = display.bones || !document.shows_surface();
        Self { document, state, rate, selected: display.selected, paint: display.palette.selected, bones }
    }
}

/// What accompanies a scene. Its surfaces are lent to the scene's frame between [`SceneOverlays::invite`] and [`SceneOverlays::recall`].
#[derive(Debug, Default)]
pub struct SceneOverlays {
    ghosts: Ghosts,
    onion: OnionSkin,
    trail: Option<Trail>,
    comparison: Option<Box<Comparison>>,
}

impl SceneOverlays {
    /// What a session file says that accompanies `document`; `other` is the file that it compares with. With the frame rate.
    pub fn of_saved(saved: &Saved, document: &Document, other: Option<(String, Document)>) -> (Self, f64) {
        let clip = saved.state(document).clip.and_then(|clip| document.clips.get(clip));
        let chosen = saved.frame_rate.filter(|rate| (1.0..=1000.0).contains(rate));
        let rate = chosen.unwrap_or_else(|| guess_rate(&clip.map_or_else(Vec::new, |clip| clip.key_times(None))));
        let with = match other {
            Some((name, other)) => Some(With::File(Box::new(other), name)),
            None => saved.compared.as_ref().and_then(|compared| compared.within(document)),
        };
        let yaw = saved.camera.map_or(crate::scene::View::Start.angles().0, |camera| camera.yaw);
        let mut comparison = with.and_then(|with| Comparison::new(with, document, yaw));
        if let (Some(comparison), Some(compared)) = (&mut comparison, &saved.compared) {
            comparison.shift_as(compared);
        }
        (Self { ghosts: saved.ghosts.sane(), comparison: comparison.map(Box::new), ..Self::default() }, rate)
    }

    /// The same company for another frame, such as one that is drawn beside the window.
    pub fn anew(&self) -> Self {
        let comparison = self.comparison.as_ref().map(|comparison| Box::new(comparison.anew()));
        Self { ghosts: self.ghosts, comparison, ..Self::default() }
    }

    /// Whether there is any.
    pub fn is_any(&self) -> bool {
        self.ghosts.shown || self.ghosts.path || self.comparison.is_some()
    }

    /// Which other moments are drawn.
    pub fn ghosts(&self) -> Ghosts {
        self.ghosts
    }

    /// Chooses which other moments are drawn; whether that is something else than before.
    pub fn set_ghosts(&mut self, ghosts: Ghosts) -> bool {
        let ghosts = ghosts.sane();
        std::mem::replace(&mut self.ghosts, ghosts) != ghosts
    }

    /// What the scene is compared with.
    pub fn comparison(&self) -> Option<&Comparison> {
        self.comparison.as_deref()
    }

    /// The same, to move it.
    pub fn comparison_mut(&mut self) -> Option<&mut Comparison> {
        self.comparison.as_deref_mut()
    }

    /// Compares with something else, or with nothing. What was lent must have been taken back.
    pub fn compare(&mut self, comparison: Option<Comparison>) {
        self.comparison = comparison.map(Box::new);
    }

    /// Another document came: what was made for the old one goes, but the comparison where `stays`.
    pub fn renew(&mut self, document: &Document, stays: bool) {
        self.onion = OnionSkin::default();
        self.trail = None;
        self.comparison = self.comparison.take().filter(|_| stays).and_then(|comparison| comparison.renewed(document).map(Box::new));
    }

    /// The path of the selection is another one.
    pub fn forget_path(&mut self) {
        self.trail = None;
    }

    /// The box round everything that the compared one covers.
    pub fn reach(&self, host: &Document, state: &PoseState) -> Option<Bounds> {
        self.comparison.as_ref().map(|comparison| comparison.reach(host, state))
    }

    /// Takes surfaces back from a frame, before it is posed.
    pub fn recall(&mut self, frame: &mut Frame) {
        if let Some(comparison) = &mut self.comparison {
            comparison.recall(frame);
        }
        self.onion.recall(frame);
        frame.marks.clear();
    }

    /// Poses company and puts it into the frame, which has just been posed as the host says.
    pub fn invite(&mut self, host: &PoseContext<'_>, frame: &mut Frame) {
        if let Some(comparison) = &mut self.comparison {
            comparison.pose(host, frame);
        }
        self.onion.invite(host, self.ghosts, frame);
        if let Some(node) = host.selected.filter(|_| self.ghosts.path) {
            Trail::draw(&mut self.trail, host, node, frame);
        }
        if let Some(comparison) = &mut self.comparison {
            comparison.lend(host, frame);
        }
    }
}

/// `0xRRGGBB` as numbers from 0 to 1.
pub(super) fn color(value: u32) -> Vec3 {
    let part = |shift: u32| (value >> shift & 255) as f32 / 255.0;
    Vec3::new(part(16), part(8), part(0))
}

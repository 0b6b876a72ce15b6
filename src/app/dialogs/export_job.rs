//! What the export dialog makes: the same as the command line makes, from what the session shows. No widgets here; a job runs on another thread.

use std::path::{Path, PathBuf};

use crate::document::{Document, PoseBuffers, PoseState};
use crate::export::file_extension::with_extension;
use crate::export::gltf::{self, GltfContainer};
use crate::export::surface::SurfaceFormat;
use crate::export::tables::{self, MeasureTable, TableError, TableSubject};
use crate::export::{ExportError, gif, mtl, video};
use crate::i18n::{self, Sentence};
use crate::output::OverwriteGuard;
use crate::progress::Progress;
use crate::render::{Background, Highlight};
use crate::scene::Frame;
use crate::sequence::{self, FilePattern, FrameSpec, Motion, OutputTarget, Sequence, SequenceError, SequenceOptions, SequenceRenderer};
use crate::session::Session;
use crate::tr;
use crate::view::{CameraController, SceneOverlays, ViewState};

/// The kinds of file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ExportKind {
    /// One PNG.
    Picture,
    /// GIF.
    Gif,
    /// APNG.
    Apng,
    /// Numbered PNGs.
    Pictures,
    /// By `ffmpeg`.
    Mp4,
    /// By `ffmpeg`.
    Webm,
    /// The posed surface.
    Obj,
    /// The posed surface.
    Ply,
    /// The posed surface.
    Stl,
    /// The whole document.
    Glb,
    /// The whole document.
    Gltf,
    /// Muscles over the clip, or over their arm's angles.
    Muscles(tables::TableFormat),
    /// Joints over the clip.
    Joints(tables::TableFormat),
}

impl ExportKind {
    /// All kinds, in the order of the list.
    pub(crate) const ALL: [Self; 19] = [
        Self::Picture,
        Self::Gif,
        Self::Apng,
        Self::Pictures,
        Self::Mp4,
        Self::Webm,
        Self::Obj,
        Self::Ply,
        Self::Stl,
        Self::Glb,
        Self::Gltf,
        Self::Muscles(tables::TableFormat::Csv),
        Self::Muscles(tables::TableFormat::Json),
        Self::Muscles(tables::TableFormat::Png),
        Self::Muscles(tables::TableFormat::Svg),
        Self::Joints(tables::TableFormat::Csv),
        Self::Joints(tables::TableFormat::Json),
        Self::Joints(tables::TableFormat::Png),
        Self::Joints(tables::TableFormat::Svg),
    ];

    /// What a person calls it.
    pub(crate) fn label(self) -> String {
        tr!(match self {
            Self::Picture => "app-export-picture",
            Self::Gif => "app-export-gif",
            Self::Apng => "app-export-apng",
            Self::Pictures => "app-export-pictures",
            Self::Mp4 => "app-export-mp4",
            Self::Webm => "app-export-webm",
            Self::Obj => "app-export-obj",
            Self::Ply => "app-export-ply",
            Self::Stl => "app-export-stl",
            Self::Glb => "app-export-glb",
            Self::Gltf => "app-export-gltf",
            Self::Muscles(tables::TableFormat::Csv) => "app-export-muscles-csv",
            Self::Muscles(tables::TableFormat::Json) => "app-export-muscles-json",
            Self::Joints(tables::TableFormat::Csv) => "app-export-joints-csv",
            Self::Joints(tables::TableFormat::Json) => "app-export-joints-json",
            Self::Muscles(tables::TableFormat::Png) => "app-export-muscles-png",
            Self::Muscles(tables::TableFormat::Svg) => "app-export-muscles-svg",
            Self::Joints(tables::TableFormat::Png) => "app-export-joints-png",
            Self::Joints(tables::TableFormat::Svg) => "app-export-joints-svg",
        })
    }

    /// The ending of its files.
    pub(crate) fn ending(self) -> &'static str {
        match self {
            Self::Picture | Self::Pictures => "png",
            Self::Gif => "gif",
            Self::Apng => "apng",
            Self::Mp4 => "mp4",
            Self::Webm => "webm",
            Self::Obj => "obj",
            Self::Ply => "ply",
            Self::Stl => "stl",
            Self::Glb => "glb",
            Self::Gltf => "gltf",
            Self::Muscles(tables::TableFormat::Csv) | Self::Joints(tables::TableFormat::Csv) => "csv",
            Self::Muscles(tables::TableFormat::Json) | Self::Joints(tables::TableFormat::Json) => "json",
            Self::Muscles(tables::TableFormat::Png) | Self::Joints(tables::TableFormat::Png) => "png",
            Self::Muscles(tables::TableFormat::Svg) | Self::Joints(tables::TableFormat::Svg) => "svg",
        }
    }

    /// A chosen name with what it lacks: the ending, and the place for the number in the names of numbered pictures.
    pub(crate) fn completed(self, chosen: &Path) -> PathBuf {
        let file = with_extension(chosen, &[self.ending()]);
        if self == Self::Pictures { with_number(&file) } else { file }
    }

    /// The first file that is written under a completed name, with what lies beside it.
    pub(crate) fn first_files(self, file: &Path) -> Vec<PathBuf> {
        match self {
            Self::Pictures => vec![numbered(file).map_or_else(|| file.to_owned(), |pattern| pattern.file(0))],
            Self::Obj => vec![file.to_owned(), mtl::library(file)],
            _ => vec![file.to_owned()],
        }
    }

    /// Whether it is drawn.
    pub(crate) fn is_drawn(self) -> bool {
        self == Self::Picture || self.is_sequence()
    }

    /// Whether the whole scene goes into another format, which may not hold all of it.
    pub(crate) fn is_scene(self) -> bool {
        matches!(self, Self::Glb | Self::Gltf)
    }

    /// Whether `ffmpeg` makes it.
    pub(crate) fn is_made_by_ffmpeg(self) -> bool {
        matches!(self, Self::Mp4 | Self::Webm)
    }

    /// What it is a table of.
    pub(crate) fn table(self) -> Option<(TableSubject, tables::TableFormat)> {
        match self {
            Self::Muscles(form) => Some((TableSubject::Muscles, form)),
            Self::Joints(form) => Some((TableSubject::Joints, form)),
            _ => None,
        }
    }

    /// Whether it has several pictures.
    pub(crate) fn is_sequence(self) -> bool {
        matches!(self, Self::Gif | Self::Apng | Self::Pictures | Self::Mp4 | Self::Webm)
    }
}

/// What moves in a sequence.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum MotionSource {
    /// The whole clip, or an arm's swing.
    Whole,
    /// Between the marks A and B.
    Marks,
    /// The elbow bends.
    Elbow,
    /// The muscle contracts.
    Contraction,
    /// The model turns, at the present moment.
    Turntable,
}

impl MotionSource {
    /// All courses, in the order of the list.
    pub(crate) const ALL: [Self; 5] = [Self::Whole, Self::Marks, Self::Elbow, Self::Contraction, Self::Turntable];

    /// What a person calls it.
    pub(crate) fn label(self) -> String {
        tr!(match self {
            Self::Whole => "app-export-whole",
            Self::Marks => "app-export-marks",
            Self::Elbow => "app-export-elbow",
            Self::Contraction => "app-export-contraction",
            Self::Turntable => "app-export-turntable",
        })
    }

    /// Whether it goes from one value to another.
    pub(crate) fn is_sweep(self) -> bool {
        matches!(self, Self::Elbow | Self::Contraction)
    }

    /// Whether it lasts as long as one likes.
    pub(crate) fn has_duration(self) -> bool {
        self.is_sweep() || self == Self::Turntable
    }
}

/// What is set in the dialog.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ExportOptions {
    /// The kind of file.
    pub kind: ExportKind,
    /// What moves.
    pub motion: MotionSource,
    /// Ends of a sweep.
    pub sweep: (f64, f64),
    /// Columns and rows.
    pub size: (u32, u32),
    /// Times larger than on the screen: lines grow with the picture.
    pub scale: f32,
    /// Frames a second.
    pub fps: f64,
    /// Seconds of a sweep or a turn.
    pub duration: f64,
    /// No background.
    pub transparent: bool,
    /// With bones, grid and other helps, as on the screen.
    pub helps: bool,
}

/// Why the dialog cannot make what is set in it. Displays as one sentence.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum ExportRefusal {
    /// There is no such sequence.
    Sequence(SequenceError),
    /// There is no such table.
    Table(TableError),
    /// More frames a second than a GIF can show.
    GifRate,
}

impl std::fmt::Display for ExportRefusal {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&match self {
            Self::Sequence(SequenceError::Empty { .. }) => tr!("app-export-empty"),
            Self::Sequence(SequenceError::TooMany) => tr!("app-export-too-many", limit = sequence::MAX_FRAMES),
            Self::Sequence(SequenceError::NoElbow) => tr!("app-export-no-elbow"),
            Self::Sequence(SequenceError::NoMuscle) => tr!("app-export-no-muscle"),
            Self::Table(why) => why.sentence(),
            Self::GifRate => tr!("app-export-gif-fps", limit = gif::MOST_FPS),
        })
    }
}

impl ExportOptions {
    /// The pictures that it makes, one where it makes none.
    ///
    /// # Errors
    /// [`ExportRefusal`], where it cannot be made.
    pub(crate) fn check(&self, session: &Session) -> Result<Sequence, ExportRefusal> {
        if let Some((of, _)) = self.kind.table() {
            TableError::check(of, session.document(), &session.state(), self.fps).map_err(ExportRefusal::Table)?;
        }
        if self.kind == ExportKind::Gif && self.fps > gif::MOST_FPS {
            return Err(ExportRefusal::GifRate);
        }
        self.sequence(session).map_err(ExportRefusal::Sequence)
    }

    /// The pictures that a session gives.
    ///
    /// # Errors
    /// [`SequenceError`] where there are none.
    pub(crate) fn sequence(&self, session: &Session) -> Result<Sequence, SequenceError> {
        let state = session.state();
        if !self.kind.is_sequence() {
            return Ok(Sequence::single(state));
        }
        let marks = session.playback().play_range();
        let mut options = SequenceOptions {
            fps: Some(self.fps),
            duration: self.motion.has_duration().then_some(self.duration),
            ..SequenceOptions::default()
        };
        match self.motion {
            MotionSource::Whole => {}
            MotionSource::Marks => (options.from, options.to) = (Some(marks.0), Some(marks.1)),
            MotionSource::Elbow => options.motion = Motion::Angle(self.sweep.0, self.sweep.1),
            MotionSource::Contraction => options.motion = Motion::Contraction(self.sweep.0, self.sweep.1),
            MotionSource::Turntable => (options.motion, options.turntable) = (Motion::Still, true),
        }
        Sequence::new(&options, session.document(), state)
    }
}

/// One export, independent of the window.
pub(crate) struct ExportJob {
    document: Document,
    /// What accompanies it, with its frame rate.
    overlays: (SceneOverlays, f64),
    state: PoseState,
    sequence: Sequence,
    view: ViewState,
    options: ExportOptions,
    guard: OverwriteGuard,
}

impl ExportJob {
    /// Takes what the session shows. None of the files that `guard` holds is replaced.
    ///
    /// # Errors
    /// As [`ExportOptions::check`].
    pub(crate) fn new(session: &mut Session, options: ExportOptions, guard: OverwriteGuard) -> Result<Self, ExportRefusal> {
        let sequence = options.check(session)?;
        let mut view = session.view_state();
        let display = &mut view.display;
        display.scale = options.scale;
        let selected = display.highlight.selected.filter(|_| options.helps);
        display.highlight = Highlight { hovered: None, selected, ..display.highlight };
        if options.transparent {
            display.background = Background::Transparent;
        }
        if !options.helps {
            for switch in [
                &mut display.grid,
                &mut display.axes,
                &mut display.bounding_box,
                &mut display.normal_glyphs,
                &mut display.bones,
                &mut display.bone_axes,
            ] {
                *switch = false;
            }
        }
        let overlays = (session.overlays(), session.frame_rate());
        let (document, state) = (session.document().clone(), session.state());
        Ok(Self { document, overlays, state, sequence, view, options, guard })
    }

    /// How many frames it has.
    pub(crate) fn count(&self) -> usize {
        self.sequence.count
    }

    /// The files that would be written to `file`, a completed name, and beside it.
    pub(crate) fn files(&self, file: &Path) -> Vec<PathBuf> {
        match numbered(file).filter(|_| self.options.kind == ExportKind::Pictures) {
            Some(pattern) => OutputTarget::Pictures(pattern).files(&self.sequence).collect(),
            None => self.options.kind.first_files(file),
        }
    }

    /// Makes the files; `file` is a completed name.
    ///
    /// # Errors
    /// [`ExportError`]; then everything is as it was.
    pub(crate) fn run(self, file: &Path, work: &Progress) -> Result<(), ExportError> {
        let target = match self.options.kind {
            ExportKind::Picture => OutputTarget::Picture(file.to_owned()),
            ExportKind::Gif => OutputTarget::Gif(file.to_owned()),
            ExportKind::Apng => OutputTarget::Apng(file.to_owned()),
            ExportKind::Mp4 => OutputTarget::Video(file.to_owned(), video::VideoFormat::Mp4),
            ExportKind::Webm => OutputTarget::Video(file.to_owned(), video::VideoFormat::Webm),
            ExportKind::Pictures => numbered(file).map_or_else(|| OutputTarget::Picture(file.to_owned()), OutputTarget::Pictures),
            ExportKind::Obj => return self.surface(SurfaceFormat::Obj, file),
            ExportKind::Ply => return self.surface(SurfaceFormat::Ply, file),
            ExportKind::Stl => return self.surface(SurfaceFormat::Stl, file),
            ExportKind::Glb => return self.scene(GltfContainer::Binary, file, work),
            ExportKind::Gltf => return self.scene(GltfContainer::Text, file, work),
            ExportKind::Muscles(form) => return self.table(TableSubject::Muscles, form, file, work),
            ExportKind::Joints(form) => return self.table(TableSubject::Joints, form, file, work),
        };
        let Self { document, overlays: (overlays, rate), sequence, view, options, guard, .. } = self;
        let note = note(&document, &view.camera);
        let mut renderer = SequenceRenderer::new(&document, sequence, view, None).with_overlays(overlays, rate);
        sequence::save(&mut renderer, options.size, (&target, &guard), &note, work)
    }

    fn scene(&self, form: GltfContainer, file: &Path, work: &Progress) -> Result<(), ExportError> {
        let (pending, _) = gltf::prepare(&self.guard.output(file)?, form, &self.document)?;
        if work.is_cancelled() { Err(ExportError::CANCELLED) } else { Ok(pending.commit()?) }
    }

    fn table(&self, of: TableSubject, form: tables::TableFormat, file: &Path, work: &Progress) -> Result<(), ExportError> {
        // The document is the one that was checked, so nothing is refused now.
        match MeasureTable::measure(of, &self.document, &self.state, self.options.fps) {
            Ok(table) if !work.is_cancelled() => table.save(&self.guard.output(file)?, form, tables::PLOT_SCALE, i18n::sentence),
            _ => Err(ExportError::CANCELLED),
        }
    }

    fn surface(&self, format: SurfaceFormat, file: &Path) -> Result<(), ExportError> {
        let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
        self.document.pose(&self.state, &mut buffers, &mut frame);
        format.save(&self.guard.output(file)?, &self.document.scene, &frame)
    }
}

/// Where the number stands in the completed names of numbered pictures.
const NUMBER: &str = "-%04d";

/// The row of files that a completed name stands for.
fn numbered(file: &Path) -> Option<FilePattern> {
    let is_completed = file.file_stem()?.to_str()?.ends_with(NUMBER);
    FilePattern::of(file).filter(|pattern| is_completed && !pattern.has_second())
}

/// `name-%04d.png` for `name.png`, whatever percent signs the name has; a completed name is one already.
fn with_number(file: &Path) -> PathBuf {
    match file.file_stem().and_then(|stem| stem.to_str()).filter(|_| numbered(file).is_none()) {
        Some(stem) => file.with_file_name(format!("{}{NUMBER}.png", stem.replace('%', "%%"))),
        None => file.to_owned(),
    }
}

/// What stands in a picture about how it was made.
pub(crate) fn note<'a>(document: &'a Document, controller: &CameraController) -> impl Fn(&FrameSpec) -> String + Sync + use<'a> {
    let orbit = *controller.orbit();
    move |spec| {
        let files: Vec<String> = document.sources.iter().map(|source| source.name.to_string()).collect();
        let mut text = format!("File: {}", files.join(", "));
        if let Some(clip) = spec.state.clip.and_then(|index| document.clips.get(index)) {
            text.push_str(&format!("; clip: {}; time: {} s", clip.label().plain(), spec.state.time));
        }
        if document.driven_rig().is_some() {
            text.push_str(&format!(
                "; contraction: {} %; elbow: {}°",
                spec.state.joints.drive.contraction + 0.0,
                spec.state.joints.drive.flexion + 0.0
            ));
        }
        text.push_str(&format!("; camera: yaw {}°, pitch {}°", orbit.yaw + spec.turntable, orbit.pitch));
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    fn options(kind: ExportKind, motion: MotionSource) -> ExportOptions {
        ExportOptions {
            kind,
            motion,
            sweep: (0.0, 90.0),
            size: (48, 32),
            scale: 1.0,
            fps: 4.0,
            duration: 1.0,
            transparent: false,
            helps: false,
        }
    }

    #[test]
    fn every_kind_makes_its_file_from_what_is_shown() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let mut session = Session::new(Document::built_in());
        for kind in ExportKind::ALL.into_iter().filter(|kind| !matches!(kind, ExportKind::Mp4 | ExportKind::Webm | ExportKind::Joints(_))) {
            assert!(!kind.label().starts_with("app-export"), "{kind:?} has no name");
            let file = kind.completed(&folder.path().join(format!("50%d.{}", kind.ending())));
            assert_eq!(kind.completed(&file), file);
            let job = ExportJob::new(&mut session, options(kind, MotionSource::Elbow), OverwriteGuard::default()).expect("the arm bends");
            assert_eq!(job.count(), if kind.is_sequence() { 5 } else { 1 });
            job.run(&file, &Progress::default()).expect("written");
            let first = kind.first_files(&file).remove(0);
            assert!(fs::metadata(&first).is_ok_and(|found| found.len() > 100), "{}", first.display());
        }
        assert!(folder.path().join("50%d-0004.png").is_file());
    }

    #[test]
    fn what_does_not_move_is_refused() {
        let session = Session::new(Document::default());
        assert_eq!(options(ExportKind::Gif, MotionSource::Contraction).sequence(&session), Err(SequenceError::NoMuscle));
        assert_eq!(options(ExportKind::Gif, MotionSource::Elbow).sequence(&session), Err(SequenceError::NoElbow));
        let table = |kind| options(kind, MotionSource::Whole).check(&session);
        assert_eq!(table(ExportKind::Joints(tables::TableFormat::Csv)), Err(ExportRefusal::Table(TableError::NoJoint)));
        assert_eq!(table(ExportKind::Muscles(tables::TableFormat::Json)), Err(ExportRefusal::Table(TableError::NoMuscle)));
        assert_eq!(
            ExportOptions { fps: 60.0, ..options(ExportKind::Gif, MotionSource::Whole) }.check(&session),
            Err(ExportRefusal::GifRate)
        );
        for motion in MotionSource::ALL {
            assert!(!motion.label().starts_with("app-export"), "{motion:?} has no name");
        }
    }
}

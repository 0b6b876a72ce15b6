//! What the export dialog makes: the same as the command line makes, from what the session shows. No widgets here; a job runs on another thread.

use std::path::{Path, PathBuf};

use super::session::{Eye, Session, Viewpoint};
use crate::document::{Document, PoseBuffers, PoseState};
use crate::export::ExportError;
use crate::export::gltf::{self, Form};
use crate::export::pipeline::Work;
use crate::export::surface::SurfaceFormat;
use crate::export::video;
use crate::film::{self, Motion, Pattern, Refusal, Sequence, Shot, Studio, Target, Wish};
use crate::render::{Background, Display};
use crate::scene::{Frame, OrbitCamera};
use crate::tr;

/// The kinds of file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
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
}

impl Kind {
    /// All kinds, in the order of the list.
    pub const ALL: [Self; 11] = [
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
    ];

    /// What a person calls it.
    pub fn label(self) -> String {
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
        })
    }

    /// The ending of its files.
    pub fn ending(self) -> &'static str {
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
        }
    }

    /// Whether it is drawn.
    pub fn is_drawn(self) -> bool {
        self == Self::Picture || self.is_film()
    }

    /// Whether it has several pictures.
    pub fn is_film(self) -> bool {
        matches!(self, Self::Gif | Self::Apng | Self::Pictures | Self::Mp4 | Self::Webm)
    }
}

/// What moves in a film.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Course {
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

impl Course {
    /// All courses, in the order of the list.
    pub const ALL: [Self; 5] = [Self::Whole, Self::Marks, Self::Elbow, Self::Contraction, Self::Turntable];

    /// What a person calls it.
    pub fn label(self) -> String {
        tr!(match self {
            Self::Whole => "app-export-whole",
            Self::Marks => "app-export-marks",
            Self::Elbow => "app-export-elbow",
            Self::Contraction => "app-export-contraction",
            Self::Turntable => "app-export-turntable",
        })
    }

    /// Whether it goes from one value to another.
    pub fn is_sweep(self) -> bool {
        matches!(self, Self::Elbow | Self::Contraction)
    }

    /// Whether it lasts as long as one likes.
    pub fn has_duration(self) -> bool {
        self.is_sweep() || self == Self::Turntable
    }
}

/// What is set in the dialog.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options {
    /// The kind of file.
    pub kind: Kind,
    /// What moves.
    pub course: Course,
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

impl Options {
    /// The pictures that a session gives.
    ///
    /// # Errors
    /// [`Refusal`] where there are none.
    pub fn sequence(&self, session: &Session) -> Result<Sequence, Refusal> {
        let state = session.state();
        if !self.kind.is_film() {
            return Ok(Sequence::single(state));
        }
        let marks = session.playback().span();
        let mut wish = Wish { fps: Some(self.fps), duration: self.course.has_duration().then_some(self.duration), ..Wish::default() };
        match self.course {
            Course::Whole => {}
            Course::Marks => (wish.from, wish.to) = (Some(marks.0), Some(marks.1)),
            Course::Elbow => wish.motion = Motion::Angle(self.sweep.0, self.sweep.1),
            Course::Contraction => wish.motion = Motion::Contraction(self.sweep.0, self.sweep.1),
            Course::Turntable => (wish.motion, wish.turning) = (Motion::Still, true),
        }
        Sequence::new(&wish, session.document(), state)
    }
}

/// One export, independent of the window.
pub struct Job {
    document: Document,
    state: PoseState,
    sequence: Sequence,
    eye: Eye,
    display: Display,
    options: Options,
}

impl Job {
    /// Takes what the session shows.
    ///
    /// # Errors
    /// As [`Options::sequence`].
    pub fn new(session: &mut Session, options: Options) -> Result<Self, Refusal> {
        let sequence = options.sequence(session)?;
        let (_, _, _, mut display) = session.picture();
        display.scale = options.scale;
        (display.hovered, display.selected) = (None, display.selected.filter(|_| options.helps));
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
        Ok(Self { document: session.document().clone(), state: session.state(), sequence, eye: session.eye().clone(), display, options })
    }

    /// How many frames it has.
    pub fn count(&self) -> usize {
        self.sequence.count
    }

    /// Makes the files; numbered pictures get their numbers between name and ending.
    ///
    /// # Errors
    /// [`ExportError`]; then everything is as it was.
    pub fn run(self, file: &Path, work: &Work) -> Result<(), ExportError> {
        let target = match self.options.kind {
            Kind::Picture => Target::Picture(file.to_owned()),
            Kind::Gif => Target::Gif(file.to_owned()),
            Kind::Apng => Target::Apng(file.to_owned()),
            Kind::Mp4 => Target::Video(file.to_owned(), video::Kind::Mp4),
            Kind::Webm => Target::Video(file.to_owned(), video::Kind::Webm),
            Kind::Pictures => numbered(file).map_or_else(|| Target::Picture(file.to_owned()), Target::Pictures),
            Kind::Obj => return self.surface(SurfaceFormat::Obj, file),
            Kind::Ply => return self.surface(SurfaceFormat::Ply, file),
            Kind::Stl => return self.surface(SurfaceFormat::Stl, file),
            Kind::Glb => return gltf::save(file, Form::Binary, &self.document).map(|_| ()),
            Kind::Gltf => return gltf::save(file, Form::Text, &self.document).map(|_| ()),
        };
        let Self { document, sequence, eye, display, options, .. } = self;
        let note = note(&document, &eye);
        let look = move |scene: &_, frame: &_, turn: f32| match eye.viewpoint() {
            Viewpoint::Orbit => OrbitCamera { yaw: eye.orbit().yaw + turn, ..*eye.orbit() }.camera(),
            Viewpoint::Fly(_) | Viewpoint::File(..) => eye.camera(scene, frame),
        };
        let mut studio = Studio::new(&document, sequence, display, None, Box::new(look));
        film::save(&mut studio, options.size, &target, &note, work)
    }

    fn surface(&self, format: SurfaceFormat, file: &Path) -> Result<(), ExportError> {
        let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
        self.document.pose(&self.state, &mut buffers, &mut frame);
        format.save(file, &self.document.scene, &frame)
    }
}

/// `name-%04d.png` for `name.png`, whatever percent signs the name has.
fn numbered(file: &Path) -> Option<Pattern> {
    let plain = file.with_extension("").to_str()?.replace('%', "%%");
    Pattern::of(&format!("{plain}-%04d.png"))
}

/// The first file that numbered pictures are written to.
pub fn first_numbered(file: &Path) -> Option<PathBuf> {
    numbered(file).map(|pattern| pattern.file(0))
}

/// What stands in a picture about how it was made.
fn note<'a>(document: &'a Document, eye: &Eye) -> impl Fn(&Shot) -> String + Sync + use<'a> {
    let orbit = *eye.orbit();
    move |shot| {
        let files: Vec<&str> = document.sources.iter().map(|source| source.name.as_str()).collect();
        let mut text = format!("File: {}", files.join(", "));
        if let Some(clip) = shot.state.clip.and_then(|index| document.clips.get(index)) {
            text.push_str(&format!("; clip: {}; time: {} s", clip.name, shot.state.time));
        }
        if document.driven_rig().is_some() {
            text.push_str(&format!("; contraction: {} %; elbow: {}°", shot.state.drive.contraction + 0.0, shot.state.drive.flexion + 0.0));
        }
        text.push_str(&format!("; camera: yaw {}°, pitch {}°", orbit.yaw + shot.turn, orbit.pitch));
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    fn options(kind: Kind, course: Course) -> Options {
        Options { kind, course, sweep: (0.0, 90.0), size: (48, 32), scale: 1.0, fps: 4.0, duration: 1.0, transparent: false, helps: false }
    }

    #[test]
    fn every_kind_makes_its_file_from_what_is_shown() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let mut session = Session::new(Document::built_in());
        for kind in Kind::ALL.into_iter().filter(|kind| !matches!(kind, Kind::Mp4 | Kind::Webm)) {
            assert!(!kind.label().starts_with("app-export"), "{kind:?} has no name");
            let file = folder.path().join(format!("50%d.{}", kind.ending()));
            let job = Job::new(&mut session, options(kind, Course::Elbow)).expect("the arm bends");
            assert_eq!(job.count(), if kind.is_film() { 5 } else { 1 });
            job.run(&file, &Work::default()).expect("written");
            let first = if kind == Kind::Pictures { first_numbered(&file).expect("a name") } else { file };
            assert!(fs::metadata(&first).is_ok_and(|found| found.len() > 100), "{}", first.display());
        }
        assert!(folder.path().join("50%d-0004.png").is_file());
    }

    #[test]
    fn what_does_not_move_is_refused() {
        let session = Session::new(Document::default());
        assert_eq!(options(Kind::Gif, Course::Contraction).sequence(&session), Err(Refusal::NoMuscle));
        assert_eq!(options(Kind::Gif, Course::Elbow).sequence(&session), Err(Refusal::NoElbow));
        for course in Course::ALL {
            assert!(!course.label().starts_with("app-export"), "{course:?} has no name");
        }
    }
}

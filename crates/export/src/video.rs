//! Videos as MP4 and WebM, encoded by the user's `ffmpeg`: a separate program that receives the frames through a pipe; nothing is linked.

use std::io::{self, Read, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, Command, Stdio};
use std::thread::JoinHandle;

use super::ExportError;
use sinew_engine::output::Output;
use sinew_engine::output::PendingFile;
use sinew_engine::system::{Doing, reason};
use sinew_scene::message::Message;

/// The video formats.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum VideoFormat {
    /// H.264, which plays everywhere; MPEG-4 where the user's `ffmpeg` has no H.264.
    Mp4,
    /// VP9 (VP8 where there is none), which can be transparent.
    Webm,
}

impl VideoFormat {
    /// The encoders that would do, the best first.
    fn encoders(self) -> &'static [&'static str] {
        match self {
            Self::Mp4 => &["libx264", "libopenh264", "mpeg4"],
            Self::Webm => &["libvpx-vp9", "libvpx"],
        }
    }

    fn container(self) -> &'static str {
        match self {
            Self::Mp4 => "mp4",
            Self::Webm => "webm",
        }
    }
}

/// Whether `ffmpeg` can be started.
pub fn ffmpeg_available() -> bool {
    ffmpeg().arg("-version").stdout(Stdio::null()).stderr(Stdio::null()).status().is_ok_and(|status| status.success())
}

/// What `ffmpeg` says of a full disk somewhere before its last words, in the C library's English.
const FULL: [&str; 2] = ["No space left on device", "Disk quota exceeded"];

/// Messages of `ffmpeg` where the end of a video could not be written.
const SPOILED: [&str; 2] = ["Error writing trailer", "Error closing file"];

/// Quiet, without questions, in plain C messages.
fn ffmpeg() -> Command {
    let mut command = Command::new("ffmpeg");
    command.args(["-hide_banner", "-nostats", "-loglevel", "error"]).env("AV_LOG_FORCE_NOCOLOR", "1").stdin(Stdio::null());
    // Ctrl+C on a terminal reaches every program of its group. Whether this one ends is for its caller to say.
    #[cfg(unix)]
    std::os::unix::process::CommandExt::process_group(&mut command, 0);
    command
}

/// Sends the frames of a video to `ffmpeg`.
pub struct VideoWriter {
    child: Child,
    pipe: Option<ChildStdin>,
    stderr_thread: Option<JoinHandle<String>>,
    stderr_text: String,
    pending: Option<PendingFile>,
    target: std::path::PathBuf,
}

impl VideoWriter {
    /// Starts `ffmpeg` on a video of frames of `size`, `fps` a second. With `alpha` its pictures have an alpha channel, which only WebM keeps.
    ///
    /// # Errors
    /// [`ExportError`] where there is no `ffmpeg`, it has no encoder for this kind, or the folder cannot be written.
    pub fn begin(
        target: &Output,
        kind: VideoFormat,
        (width, height): (u32, u32),
        fps: f64,
        alpha: bool,
        note: &str,
    ) -> Result<Self, ExportError> {
        let encoder = encoder(target.file(), kind)?;
        let pending = PendingFile::begin(target)?;
        let mut command = ffmpeg();
        let pixels = if alpha { "rgba" } else { "rgb24" };
        command.args(["-f", "rawvideo", "-pixel_format", pixels, "-video_size", &format!("{width}x{height}")]);
        command.args(["-framerate", &format!("{fps}"), "-i", "pipe:0", "-an", "-c:v", encoder]);
        // Half the columns and rows carry the colour, so both must be even; a last line is doubled where they are not.
        let transparent = alpha && kind == VideoFormat::Webm;
        let format = if transparent { "yuva420p" } else { "yuv420p" };
        let filter = format!(
            "pad=ceil(iw/2)*2:ceil(ih/2)*2:0:0:{},scale=out_color_matrix=bt709:out_range=tv,format={format}",
            if transparent { "black@0" } else { "black" }
        );
        command.args([
            "-vf",
            &filter,
            "-colorspace",
            "bt709",
            "-color_primaries",
            "bt709",
            "-color_trc",
            "iec61966-2-1",
            "-color_range",
            "tv",
        ]);
        match encoder {
            "libx264" => command.args(["-preset", "medium", "-crf", "17", "-tune", "animation"]),
            "libvpx-vp9" => command.args(["-crf", "22", "-b:v", "0", "-row-mt", "1", "-deadline", "good", "-cpu-used", "4"]),
            "libvpx" => command.args(["-crf", "8", "-b:v", "8M", "-auto-alt-ref", "0"]),
            _ => command.args(["-q:v", "2", "-b:v", "12M"]),
        };
        if kind == VideoFormat::Mp4 {
            command.args(["-movflags", "+faststart"]);
        }
        command.args(["-metadata", &format!("comment={note}"), "-f", kind.container(), "-y"]).arg(pending.file());
        command.stdin(Stdio::piped()).stdout(Stdio::null()).stderr(Stdio::piped());
        let mut child = command.spawn().map_err(|_| ExportError::NoEncoder { file: target.file().to_owned() })?;
        let stderr = child.stderr.take().and_then(|mut stderr| {
            let listening = std::thread::Builder::new().spawn(move || {
                let mut text = Vec::new();
                // What was read before it broke off is still worth showing.
                let _ = stderr.by_ref().take(1 << 16).read_to_end(&mut text);
                let _ = io::copy(&mut stderr, &mut io::sink());
                String::from_utf8_lossy(&text).into_owned()
            });
            listening.ok()
        });
        let pipe = child.stdin.take();
        Ok(Self {
            child,
            pipe,
            stderr_thread: stderr,
            stderr_text: String::new(),
            pending: Some(pending),
            target: target.file().to_owned(),
        })
    }

    /// Adds a frame, rows of bytes as [`super::apng::rows`] makes them.
    ///
    /// # Errors
    /// [`ExportError::EncoderFailed`], inside the [`io::Error`], where `ffmpeg` no longer listens.
    pub fn frame(&mut self, rows: &[u8]) -> io::Result<()> {
        let Some(pipe) = &mut self.pipe else { return Err(io::ErrorKind::BrokenPipe.into()) };
        pipe.write_all(rows).map_err(|_| io::Error::other(self.encoder_error()))
    }

    /// Lets `ffmpeg` finish and commits the video.
    ///
    /// # Errors
    /// [`ExportError`] where `ffmpeg` failed.
    pub fn finish(mut self) -> Result<(), ExportError> {
        self.pipe = None;
        let ended = self.child.wait().is_ok_and(|status| status.success());
        self.join_stderr();
        // Some versions tell of a full disk and end well all the same, with a part of the video or nothing.
        let spoiled = FULL.iter().chain(&SPOILED).any(|stderr| self.stderr_text.contains(stderr));
        match self.pending.take() {
            Some(pending) if ended && !spoiled && std::fs::metadata(pending.file()).is_ok_and(|found| found.len() > 0) => {
                Ok(pending.commit()?)
            }
            _ => Err(self.encoder_error()),
        }
    }

    /// Takes what `ffmpeg` said, once it has ended.
    fn join_stderr(&mut self) {
        if let Some(stderr) = self.stderr_thread.take() {
            self.stderr_text = stderr.join().unwrap_or_default();
        }
    }

    fn encoder_error(&mut self) -> ExportError {
        self.pipe = None;
        // The process was killed; it is not waited for, in case it hangs.
        let _ = self.child.kill();
        let status = self.child.wait();
        self.join_stderr();
        let said = &self.stderr_text;
        if FULL.iter().any(|stderr| said.contains(stderr)) {
            return ExportError::io(&self.target, io::ErrorKind::StorageFull.into());
        }
        let last = said.lines().rev().find(|line| !line.trim().is_empty()).map(|line| line.trim().to_owned());
        let reason = last
            .map(Message::verbatim)
            .unwrap_or_else(|| status.map_or_else(|error| reason(&error, Doing::Reading), |status| Message::verbatim(status.to_string())));
        ExportError::EncoderFailed { file: self.target.clone(), reason }
    }
}

impl Drop for VideoWriter {
    fn drop(&mut self) {
        self.pipe = None;
        if self.pending.is_some() {
            // Given up half-way. The temporary file goes once no process writes it.
            let _ = self.child.kill();
        }
        let _ = self.child.wait();
    }
}

/// The best encoder that the user's `ffmpeg` has.
fn encoder(target: &Path, kind: VideoFormat) -> Result<&'static str, ExportError> {
    let listed = ffmpeg().arg("-encoders").output().map_err(|_| ExportError::NoEncoder { file: target.to_owned() })?;
    let listed = String::from_utf8_lossy(&listed.stdout).into_owned();
    let has = |name: &str| listed.lines().any(|line| line.split_whitespace().nth(1) == Some(name));
    let found = kind.encoders().iter().copied().find(|name| has(name));
    found.ok_or_else(|| ExportError::NoCodec { file: target.to_owned(), names: kind.encoders().join(", ") })
}

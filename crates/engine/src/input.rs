//! The one door for files from outside: regular files only, and never more than so many bytes.

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use crate::system::{Doing, SystemError};
use sinew_scene::message;
use sinew_scene::message::{Message, ToMessage};

/// Why a file is not read.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{}", self.message())]
pub enum Refused {
    /// The operating system refused.
    Io(SystemError),
    /// It is a folder.
    Folder,
    /// It is a pipe, a device or a socket: to read it might wait or never end.
    NotRegular,
    /// It has more than so many bytes.
    TooLarge(u64),
    /// It is not UTF-8; the first line that is not, from 1.
    NotText(u32),
}

impl ToMessage for Refused {
    fn message(&self) -> Message {
        match self {
            Self::Io(error) => match error.kind {
                io::ErrorKind::NotFound => message!("document-not-found"),
                io::ErrorKind::PermissionDenied => message!("document-permission"),
                io::ErrorKind::IsADirectory => message!("document-folder"),
                _ => message!("document-io", reason = error.message()),
            },
            Self::Folder => message!("document-folder"),
            Self::NotRegular => message!("document-not-regular"),
            Self::TooLarge(limit) => message!("document-too-large", limit = limit >> 20),
            Self::NotText(_) => message!("document-not-text"),
        }
    }
}

impl From<io::Error> for Refused {
    fn from(error: io::Error) -> Self {
        Self::Io(SystemError::new(&error, Doing::Reading))
    }
}

impl Refused {
    /// Whether there is no such file.
    pub fn is_missing(&self) -> bool {
        matches!(self, Self::Io(error) if error.kind == io::ErrorKind::NotFound)
    }
}

/// Reads a regular file of at most `limit` bytes, also behind links. Anything else is refused without being opened, so that nothing waits.
///
/// # Errors
/// [`Refused`].
pub fn read(path: &Path, limit: u64) -> Result<Vec<u8>, Refused> {
    // Asked before opening: to open a named pipe would wait for its writer.
    let about = fs::metadata(path)?;
    if about.is_dir() {
        return Err(Refused::Folder);
    }
    if !about.is_file() {
        return Err(Refused::NotRegular);
    }
    if about.len() > limit {
        return Err(Refused::TooLarge(limit));
    }
    let mut bytes = Vec::new();
    let size = usize::try_from(about.len()).unwrap_or(0).saturating_add(1);
    bytes.try_reserve(size).map_err(|_| io::Error::from(io::ErrorKind::OutOfMemory))?;
    // Files of the system that tell no size, such as those in /proc, are held to the limit too.
    File::open(path)?.take(limit.saturating_add(1)).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > limit { Err(Refused::TooLarge(limit)) } else { Ok(bytes) }
}

/// [`read`] for a path of the command line, where `-` is standard input.
///
/// # Errors
/// [`Refused`].
pub fn read_argument(path: &Path, limit: u64) -> Result<Vec<u8>, Refused> {
    if path.as_os_str() != "-" {
        return read(path, limit);
    }
    let mut bytes = Vec::new();
    io::stdin().lock().take(limit.saturating_add(1)).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > limit { Err(Refused::TooLarge(limit)) } else { Ok(bytes) }
}

/// [`read`], as UTF-8 text.
///
/// # Errors
/// [`Refused`].
pub fn read_text(path: &Path, limit: u64) -> Result<String, Refused> {
    text(read(path, limit)?)
}

/// Bytes as UTF-8 text.
///
/// # Errors
/// [`Refused::NotText`].
pub fn text(bytes: Vec<u8>) -> Result<String, Refused> {
    String::from_utf8(bytes).map_err(|error| {
        let before = error.as_bytes().get(..error.utf8_error().valid_up_to()).unwrap_or_default();
        Refused::NotText(line_after(before))
    })
}

/// The path of a file that another file names, seen from that one's folder. It is never `-`, which means standard input on the command line only.
pub fn named_in(folder: &Path, name: &Path) -> PathBuf {
    let path = folder.join(name);
    if path.as_os_str() == "-" { Path::new(".").join(path) } else { path }
}

/// The name by which a file in `folder` names `file`: the way there, with slashes, whether anything is there or not; [`named_in`] is the way back.
/// Links to folders are followed, since `..` leads back from where they lead to; a link to the file keeps its own name.
pub fn named_from(folder: &Path, file: &Path) -> String {
    let (folder, file) =
        (true_folder(folder), true_folder(file.parent().unwrap_or(Path::new(""))).join(file.file_name().unwrap_or_default()));
    let common = folder.components().zip(file.components()).take_while(|(a, b)| a == b).count();
    if common == 0 {
        // On another disk.
        return file.to_string_lossy().into_owned();
    }
    let up = folder.components().skip(common).map(|_| "..".into());
    let down = file.components().skip(common).map(|part| part.as_os_str().to_string_lossy());
    up.chain(down).collect::<Vec<_>>().join("/")
}

fn true_folder(folder: &Path) -> PathBuf {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    folder.canonicalize().or_else(|_| std::path::absolute(folder)).unwrap_or_else(|_| folder.to_owned())
}

/// The line that the byte after `before` is in, from 1.
pub fn line_after(before: &[u8]) -> u32 {
    u32::try_from(memchr::memchr_iter(b'\n', before).count()).unwrap_or(u32::MAX).saturating_add(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_regular_files_within_the_limit_are_read() {
        let folder = tempfile::tempdir().expect("a folder");
        assert!(matches!(read(folder.path(), 10), Err(Refused::Folder)));
        assert!(read(&folder.path().join("none"), 10).is_err_and(|refused| refused.is_missing()));
        let file = folder.path().join("long");
        fs::write(&file, "0123456789abc").expect("written");
        assert!(matches!(read(&file, 12), Err(Refused::TooLarge(12))));
        assert_eq!(read(&file, 13).expect("fits"), b"0123456789abc");
        fs::write(&file, b"a\nb\xff").expect("written");
        assert!(matches!(read_text(&file, 13), Err(Refused::NotText(2))));
    }

    #[test]
    fn a_name_in_a_file_is_never_standard_input() {
        assert_eq!(named_in(Path::new(""), Path::new("-")).as_os_str(), "./-");
        assert_eq!(named_in(Path::new("a"), Path::new("-")), Path::new("a/-"));
        assert_eq!(named_in(Path::new(""), Path::new("walk.dae")), Path::new("walk.dae"));
    }

    #[test]
    fn the_way_to_a_file_is_named_from_where_it_is_named() {
        let folder = tempfile::tempdir().expect("a folder");
        let at = |name: &str| folder.path().join(name);
        fs::create_dir_all(at("a/b")).expect("made");
        fs::create_dir_all(at("c")).expect("made");
        for (from, file, way) in [
            ("a", "a/x.dae", "x.dae"),
            ("a/b", "a/x.dae", "../x.dae"),
            ("c", "a/b/x.dae", "../a/b/x.dae"),
            ("", "a/x.dae", "a/x.dae"),
            ("a/b", "a/../c/./x.dae", "../../c/x.dae"),
            // Folders that are not there.
            ("new", "a/x.dae", "../a/x.dae"),
        ] {
            assert_eq!(named_from(&at(from), &at(file)), way, "{from} {file}");
        }
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink(at("a/b"), at("deep")).expect("links work");
            fs::write(at("a/x.dae"), "x").expect("written");
            std::os::unix::fs::symlink("a/x.dae", at("y.dae")).expect("links work");
            assert_eq!(named_from(&at("deep"), &at("y.dae")), "../../y.dae");
            assert!(named_in(&at("deep"), Path::new(&named_from(&at("deep"), &at("y.dae")))).exists());
        }
    }

    #[cfg(unix)]
    #[test]
    fn pipes_devices_and_sockets_are_refused_without_waiting_also_behind_links() {
        let folder = tempfile::tempdir().expect("a folder");
        let at = |name: &str| folder.path().join(name);
        assert!(std::process::Command::new("mkfifo").arg(at("pipe")).status().expect("mkfifo").success());
        let _socket = std::os::unix::net::UnixListener::bind(at("socket")).expect("a socket");
        for (name, target) in [("to-pipe", "pipe"), ("to-socket", "socket"), ("to-zero", "/dev/zero"), ("to-tty", "/dev/tty")] {
            std::os::unix::fs::symlink(target, at(name)).expect("a link");
        }
        for name in ["pipe", "socket", "to-pipe", "to-socket", "to-zero", "to-tty"] {
            assert!(matches!(read(&at(name), 10), Err(Refused::NotRegular)), "{name}");
        }
    }
}

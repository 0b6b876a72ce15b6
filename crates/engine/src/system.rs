//! Errors of the operating system as messages: the one place where they get their words.

use std::io;

use sinew_scene::message;
use sinew_scene::message::{Message, ToMessage};

/// What is being done with a file: the same refusal means something else where it is read than where it is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Doing {
    /// It is looked at, read or started.
    Reading,
    /// It is made, beside what it may replace.
    Writing,
}

/// An error of the operating system that can be kept and compared.
#[derive(Debug, Clone, PartialEq)]
pub struct SystemError {
    /// Its kind.
    pub kind: io::ErrorKind,
    reason: Message,
}

impl SystemError {
    /// An error that came while a file was read or written.
    pub fn new(error: &io::Error, doing: Doing) -> Self {
        Self { kind: error.kind(), reason: reason(error, doing) }
    }
}

impl ToMessage for SystemError {
    /// As [`reason`].
    fn message(&self) -> Message {
        self.reason.clone()
    }
}

/// Why the operating system refused: a message of the catalogue for the kinds that people meet, else the system's own words. It is the end of a sentence,
/// without a full stop.
pub fn reason(error: &io::Error, doing: Doing) -> Message {
    let key = match error.kind() {
        // A message of our own or of a library, inside an error of the system's.
        _ if error.get_ref().is_some() => None,
        io::ErrorKind::NotFound if doing == Doing::Writing => Some("io-no-folder"),
        io::ErrorKind::NotFound => Some("io-not-found"),
        io::ErrorKind::PermissionDenied if doing == Doing::Writing => Some("io-no-writing"),
        io::ErrorKind::PermissionDenied => Some("io-denied"),
        io::ErrorKind::NotADirectory => Some("io-not-a-folder"),
        io::ErrorKind::IsADirectory => Some("io-a-folder"),
        io::ErrorKind::ReadOnlyFilesystem => Some("io-read-only"),
        io::ErrorKind::StorageFull => Some("io-full"),
        io::ErrorKind::QuotaExceeded => Some("io-quota"),
        io::ErrorKind::OutOfMemory => Some("io-memory"),
        io::ErrorKind::InvalidFilename => Some("io-name"),
        io::ErrorKind::FileTooLarge => Some("io-too-large"),
        io::ErrorKind::ResourceBusy | io::ErrorKind::ExecutableFileBusy => Some("io-busy"),
        io::ErrorKind::AlreadyExists => Some("io-there-already"),
        io::ErrorKind::BrokenPipe => Some("io-gone"),
        io::ErrorKind::UnexpectedEof => Some("io-cut-short"),
        io::ErrorKind::Unsupported => Some("io-not-supported"),
        io::ErrorKind::TimedOut => Some("io-slow"),
        _ => error.raw_os_error().and_then(by_number),
    };
    key.map_or_else(|| Message::verbatim(plain(&error.to_string())), |key| message!(key))
}

/// The kinds that the standard library has no name for.
#[cfg(unix)]
fn by_number(number: i32) -> Option<&'static str> {
    match number {
        // EIO, ENXIO, ENODEV: the same on all of these systems.
        5 | 6 | 19 => Some("io-device"),
        // ENFILE, EMFILE.
        23 | 24 => Some("io-too-many-open"),
        // ELOOP.
        40 if cfg!(any(target_os = "linux", target_os = "android")) => Some("io-link-loop"),
        62 if !cfg!(any(target_os = "linux", target_os = "android")) => Some("io-link-loop"),
        _ => None,
    }
}

/// The kinds that the standard library has no name for.
#[cfg(not(unix))]
fn by_number(number: i32) -> Option<&'static str> {
    // ERROR_TOO_MANY_OPEN_FILES, ERROR_SHARING_VIOLATION.
    match number {
        4 => Some("io-too-many-open"),
        32 => Some("io-busy"),
        _ => None,
    }
}

/// The words of an error of the system, of a library or of our own, without the number that the standard library adds and without a full stop.
pub fn plain(words: &str) -> String {
    const NUMBER: &str = " (os error ";
    let mut text = words.to_owned();
    while let Some(start) = text.find(NUMBER) {
        let Some(end) = text.get(start..).and_then(|rest| rest.find(')')) else { break };
        text.replace_range(start..=start + end, "");
    }
    let trimmed = text.trim_end();
    trimmed.strip_suffix('.').filter(|rest| !rest.ends_with('.')).unwrap_or(trimmed).to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use sinew_i18n::Sentence;

    #[test]
    fn no_refusal_comes_with_its_number() {
        for number in 0..=140 {
            for doing in [Doing::Reading, Doing::Writing] {
                let said = reason(&io::Error::from_raw_os_error(number), doing).sentence();
                assert!(
                    !said.is_empty() && !said.contains("os error") && !said.ends_with('.') && !said.contains("io-"),
                    "{number}: {said}"
                );
            }
        }
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn the_usual_refusals_are_told_apart() {
        // ENOENT, EACCES, ENOTDIR, EISDIR, EROFS, ENOSPC, EDQUOT, ENOMEM, ENAMETOOLONG, EFBIG, EMFILE, ELOOP, ETXTBSY, EEXIST, EIO, EPIPE, ETIMEDOUT.
        let numbers = [2, 13, 20, 21, 30, 28, 122, 12, 36, 27, 24, 40, 26, 17, 5, 32, 110];
        let said: std::collections::BTreeSet<String> =
            numbers.iter().map(|number| reason(&io::Error::from_raw_os_error(*number), Doing::Reading).sentence()).collect();
        assert_eq!(said.len(), numbers.len(), "{said:?}");
        // Not the system's own words, which know one language.
        for number in numbers {
            let error = io::Error::from_raw_os_error(number);
            assert_ne!(reason(&error, Doing::Reading), Message::verbatim(plain(&error.to_string())));
        }
        assert_ne!(reason(&io::ErrorKind::NotFound.into(), Doing::Writing), reason(&io::ErrorKind::NotFound.into(), Doing::Reading));
    }

    #[test]
    fn words_of_others_keep_all_but_the_number() {
        assert_eq!(plain("while reading: Not a directory (os error 20); given up."), "while reading: Not a directory; given up");
        assert_eq!(plain("odd (os error "), "odd (os error");
        assert_eq!(plain("and so on..."), "and so on...");
        assert_eq!(reason(&io::Error::other("our own words."), Doing::Reading), Message::verbatim("our own words"));
    }
}

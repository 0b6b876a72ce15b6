//! How a command ends other than well, and how that is said.

use std::io::{self, Write};
use std::path::Path;
use std::process::ExitCode;
use std::sync::atomic::{AtomicU8, Ordering};

use clap::ArgMatches;

use crate::document::OpenError;
use crate::export::ExportError;
use crate::i18n;
use crate::sequence::FilePattern;
use crate::system::{Doing, reason};

/// The exit code of a program that Ctrl+C stopped, as shells have it.
pub(super) const STOPPED: u8 = 130;

/// Why a command stopped.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Failure {
    /// The call was wrong: exit code 2.
    Usage(String),
    /// Files could not be used, one line each: exit code 1.
    Files(Vec<String>),
    /// Stopped by the user's hand: exit code [`STOPPED`].
    Stopped,
    /// Whoever read the output has gone: nothing more to say, exit code 0.
    ReaderGone,
}

impl Failure {
    /// A call that was wrong.
    pub(super) fn usage(sentence: impl Into<String>) -> Self {
        Self::Usage(sentence.into())
    }

    /// One file that could not be used: `file: what`.
    pub(super) fn file(file: &Path, what: impl std::fmt::Display) -> Self {
        Self::Files(vec![format!("{}: {what}", display_name(file))])
    }

    /// Says what happened on standard error and returns the exit code.
    pub(super) fn report(&self) -> ExitCode {
        match self {
            Self::Usage(sentence) => {
                complain(&format!("sinew: {sentence}"));
                ExitCode::from(2)
            }
            Self::Files(lines) => {
                lines.iter().for_each(|line| complain(line));
                ExitCode::from(1)
            }
            Self::Stopped => {
                complain(&crate::tr!("export-cancelled"));
                ExitCode::from(STOPPED)
            }
            Self::ReaderGone => ExitCode::SUCCESS,
        }
    }
}

impl From<OpenError> for Failure {
    fn from(error: OpenError) -> Self {
        Self::Files(vec![one_line(&error.to_string())])
    }
}

impl From<ExportError> for Failure {
    fn from(error: ExportError) -> Self {
        if matches!(error, ExportError::Cancelled) {
            return Self::Stopped;
        }
        if let ExportError::Held { file } = &error {
            return Self::Usage(crate::tr!("cli-out-is-input", out = output_name(file)));
        }
        Self::Files(vec![one_line(&error.to_string())])
    }
}

/// The name of a file in messages: as given, in words for standard input.
pub(super) fn display_name(file: &Path) -> String {
    if file.as_os_str() == "-" {
        return crate::tr!("document-standard-input");
    }
    output_name(file)
}

/// The name of a file that is written: `-` has no other meaning there.
pub(super) fn output_name(file: &Path) -> String {
    one_line(&file.to_string_lossy())
}

/// A result whose name has not one of the endings that it may have: `key` is the sentence that lists them.
pub(super) fn wrong_ending(out: &Path, key: &str) -> Failure {
    let has_name = out.file_name().is_none_or(|name| out.extension().is_some() || !name.as_encoded_bytes().starts_with(b"."));
    Failure::usage(if has_name { crate::tr!(key, out = output_name(out)) } else { crate::tr!("cli-ending-alone", out = output_name(out)) })
}

/// Refuses a place for a number in the name of a result that is one file: else the file would be called so to the letter.
///
/// # Errors
/// [`Failure::Usage`].
pub(super) fn one_file(out: &Path) -> Result<(), Failure> {
    match FilePattern::of(out) {
        Some(_) => Err(Failure::usage(crate::tr!("cli-pattern-one-file", out = output_name(out)))),
        None => Ok(()),
    }
}

/// Writes one line to standard error; a closed one is nothing to stop for.
pub(super) fn complain(line: &str) {
    let _ = writeln!(io::stderr(), "{}", one_line(line));
}

/// Writes a question to standard error; the answer stands behind it.
pub(super) fn complain_part(question: &str) {
    let _ = write!(io::stderr(), "{} ", one_line(question));
    let _ = io::stderr().flush();
}

/// How much is said: 0 = results and problems, 1 = notices too, 2 = everything.
static LOUDNESS: AtomicU8 = AtomicU8::new(1);

/// Takes `--quiet` and `--verbose`.
pub(super) fn set_loudness(given: &ArgMatches) {
    let flag = |id| given.try_get_one::<bool>(id).ok().flatten().copied().unwrap_or(false);
    LOUDNESS.store(if flag("quiet") { 0 } else { 1 + u8::from(flag("verbose")) }, Ordering::Relaxed);
}

/// Whether nothing but problems is to be said.
pub(super) fn is_quiet() -> bool {
    LOUDNESS.load(Ordering::Relaxed) == 0
}

/// Writes a notice to standard error, unless the call is quiet.
pub(super) fn notice(line: &str) {
    if !is_quiet() {
        complain(line);
    }
}

/// Writes to standard error what only `--verbose` wants to know.
pub(super) fn remark(lines: impl IntoIterator<Item = impl std::fmt::Display>) {
    if LOUDNESS.load(Ordering::Relaxed) > 1 {
        lines.into_iter().for_each(|line| complain(&line.to_string()));
    }
}

/// One problem, one line, whatever file names and documents hold.
fn one_line(text: &str) -> String {
    i18n::shown(text).into_owned()
}

/// Writes a result to standard output in one go, with nothing in it that a terminal would obey.
///
/// # Errors
/// [`Failure::ReaderGone`] where the reader closed the pipe, [`Failure::Files`] where the output cannot be written, such as a full disk.
pub(super) fn answer(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    out.write_all(i18n::shown_lines(text).as_bytes()).and_then(|()| out.flush()).map_err(|error| match error.kind() {
        io::ErrorKind::BrokenPipe => Failure::ReaderGone,
        _ => Failure::Files(vec![crate::tr!("cli-stdout-failed", reason = reason(&error, Doing::Writing))]),
    })
}

/// Writes `value` to standard output as indented JSON. Numbers that are not finite become `null`; letters that a terminal would obey are escaped.
///
/// # Errors
/// As [`answer`].
pub(super) fn answer_json(value: &impl serde::Serialize) -> Result<(), Failure> {
    let mut text = serde_json::to_string_pretty(value).map_err(|error| Failure::Files(vec![error.to_string()]))?;
    text.push('\n');
    answer(&i18n::visible_json(&text))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_problem_is_one_line_whatever_the_file_is_called() {
        let failure = Failure::file(Path::new("a\nb.dae"), "broken");
        assert_eq!(failure, Failure::Files(vec!["a b.dae: broken".to_owned()]));
    }
}

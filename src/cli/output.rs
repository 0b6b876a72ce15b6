//! Output of the commands: results, notices, errors and exit codes.

use std::io::{self, Write};
use std::path::Path;
use std::process::ExitCode;
use std::sync::atomic::{AtomicU8, Ordering};

use clap::ArgMatches;

use crate::document::OpenError;
use crate::export::ExportError;
use crate::i18n::{self, Sentence};
use crate::output::OutputError;
use crate::render::RenderError;
use crate::sequence::FilePattern;
use crate::system::{Doing, reason};

/// The exit code of a program that Ctrl+C stopped, as shells have it.
pub(super) const EXIT_CANCELLED: u8 = 130;

/// Why a command failed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Failure {
    /// The call was wrong: exit code 2.
    Usage(String),
    /// Files could not be used, one line each: exit code 1.
    Files(Vec<String>),
    /// Cancelled by the user: exit code [`EXIT_CANCELLED`].
    Cancelled,
    /// The reader of standard output closed it: no message, exit code 0.
    BrokenPipe,
}

impl Failure {
    /// A call that was wrong.
    pub(super) fn usage(sentence: impl Into<String>) -> Self {
        Self::Usage(sentence.into())
    }

    /// One file that could not be used: `file: what`.
    pub(super) fn file(file: &Path, sentence: impl Into<String>) -> Self {
        Self::Files(vec![format!("{}: {}", display_name(file), sentence.into())])
    }

    /// Prints the failure to standard error and returns the exit code.
    pub(super) fn report(&self) -> ExitCode {
        match self {
            Self::Usage(sentence) => {
                print_error(&format!("sinew: {sentence}"));
                ExitCode::from(2)
            }
            Self::Files(lines) => {
                lines.iter().for_each(|line| print_error(line));
                ExitCode::from(1)
            }
            Self::Cancelled => {
                print_error(&crate::tr!("export-cancelled"));
                ExitCode::from(EXIT_CANCELLED)
            }
            Self::BrokenPipe => ExitCode::SUCCESS,
        }
    }
}

impl From<OpenError> for Failure {
    fn from(error: OpenError) -> Self {
        Self::Files(vec![one_line(&error.sentence())])
    }
}

impl From<RenderError> for Failure {
    fn from(error: RenderError) -> Self {
        Self::Files(vec![one_line(&error.sentence())])
    }
}

impl From<ExportError> for Failure {
    fn from(error: ExportError) -> Self {
        match error {
            ExportError::Output(error) => error.into(),
            other => Self::Files(vec![one_line(&other.sentence())]),
        }
    }
}

impl From<OutputError> for Failure {
    fn from(error: OutputError) -> Self {
        match error {
            OutputError::Cancelled => Self::Cancelled,
            OutputError::Held { file } => Self::Usage(crate::tr!("cli-out-is-input", out = output_name(&file))),
            other => Self::Files(vec![one_line(&other.sentence())]),
        }
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
pub(super) fn wrong_extension(out: &Path, key: &str) -> Failure {
    let has_name = out.file_name().is_none_or(|name| out.extension().is_some() || !name.as_encoded_bytes().starts_with(b"."));
    Failure::usage(if has_name { crate::tr!(key, out = output_name(out)) } else { crate::tr!("cli-ending-alone", out = output_name(out)) })
}

/// Refuses a place for a number in the name of a result that is one file: else the file would be called so to the letter.
///
/// # Errors
/// [`Failure::Usage`].
pub(super) fn refuse_number_pattern(out: &Path) -> Result<(), Failure> {
    match FilePattern::of(out) {
        Some(_) => Err(Failure::usage(crate::tr!("cli-pattern-one-file", out = output_name(out)))),
        None => Ok(()),
    }
}

/// Writes one line to standard error; a closed standard error is ignored.
pub(super) fn print_error(line: &str) {
    let _ = writeln!(io::stderr(), "{}", one_line(line));
}

/// Writes a question to standard error; the answer stands behind it.
pub(super) fn print_prompt(question: &str) {
    let _ = write!(io::stderr(), "{} ", one_line(question));
    let _ = io::stderr().flush();
}

/// Verbosity: 0 = results and errors, 1 = notices too, 2 = everything.
static VERBOSITY: AtomicU8 = AtomicU8::new(1);

/// Takes `--quiet` and `--verbose`.
pub(super) fn set_verbosity(given: &ArgMatches) {
    let flag = |id| given.try_get_one::<bool>(id).ok().flatten().copied().unwrap_or(false);
    VERBOSITY.store(if flag("quiet") { 0 } else { 1 + u8::from(flag("verbose")) }, Ordering::Relaxed);
}

/// Whether only errors are printed.
pub(super) fn is_quiet() -> bool {
    VERBOSITY.load(Ordering::Relaxed) == 0
}

/// Writes a notice to standard error, unless the call is quiet.
pub(super) fn print_notice(line: &str) {
    if !is_quiet() {
        print_error(line);
    }
}

/// Writes lines to standard error with `--verbose`.
pub(super) fn print_verbose(lines: impl IntoIterator<Item = impl std::fmt::Display>) {
    if VERBOSITY.load(Ordering::Relaxed) > 1 {
        lines.into_iter().for_each(|line| print_error(&line.to_string()));
    }
}

/// One problem, one line, whatever file names and documents hold.
fn one_line(text: &str) -> String {
    i18n::shown(text).into_owned()
}

/// Writes a result to standard output in one go, with nothing in it that a terminal would obey.
///
/// # Errors
/// [`Failure::BrokenPipe`] where the reader closed the pipe, [`Failure::Files`] where the output cannot be written, such as a full disk.
pub(super) fn print_result(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    out.write_all(i18n::shown_lines(text).as_bytes()).and_then(|()| out.flush()).map_err(|error| match error.kind() {
        io::ErrorKind::BrokenPipe => Failure::BrokenPipe,
        _ => Failure::Files(vec![crate::tr!("cli-stdout-failed", reason = reason(&error, Doing::Writing).sentence())]),
    })
}

/// Writes `value` to standard output as indented JSON. Numbers that are not finite become `null`; letters that a terminal would obey are escaped.
///
/// # Errors
/// As [`print_result`].
pub(super) fn print_json(value: &impl serde::Serialize) -> Result<(), Failure> {
    let mut text = serde_json::to_string_pretty(value).map_err(|error| Failure::Files(vec![error.to_string()]))?;
    text.push('\n');
    print_result(&i18n::visible_json(&text))
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

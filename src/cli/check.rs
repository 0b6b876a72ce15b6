//! `sinew check`: the diagnostics of the readers.

use std::path::Path;

use clap::ArgMatches;
use serde::Serialize;

use super::files;
use super::output::{Failure, display_name, print_json, print_result};
use crate::diagnostics::{Diagnostic, Severity};
use crate::document::{Document, Finding, ImageLoading, OpenError, OpenOptions};
use crate::formats::SCENE_READERS;
use crate::i18n::{self, Sentence, shown};
use crate::progress::Progress;
use crate::tr;

/// One file's report.
#[derive(Debug, Serialize)]
struct FileReport {
    file: String,
    usable: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<OpenFailure>,
    findings: Vec<FindingReport>,
}

/// Why a file could not be used.
#[derive(Debug, Serialize)]
struct OpenFailure {
    line: Option<u32>,
    column: Option<u32>,
    message: String,
}

/// One finding.
#[derive(Debug, Serialize)]
pub(super) struct FindingReport {
    code: &'static str,
    severity: &'static str,
    line: Option<u32>,
    element: String,
    message: String,
}

impl From<&Diagnostic<Finding>> for FindingReport {
    fn from(found: &Diagnostic<Finding>) -> Self {
        Self {
            code: found.code(),
            severity: match found.severity() {
                Severity::Info => "note",
                Severity::Warning => "warning",
            },
            line: found.line,
            element: i18n::label(found.element.as_label()).into_owned(),
            message: i18n::finding(found),
        }
    }
}

/// What was found in a file, or why it could not be used.
type CheckResult = Result<Vec<Diagnostic<Finding>>, OpenError>;

/// Runs the subcommand.
pub(super) fn run(given: &ArgMatches) -> Result<(), Failure> {
    let opened: Vec<_> = files(given).into_iter().map(|file| (display_name(&file), open(&file))).collect();
    if given.get_flag("json") {
        let reports: Vec<_> = opened.iter().map(|(name, result)| report(name, result)).collect();
        print_json(&serde_json::json!({ "files": reports }))?;
    } else {
        print_result(&listing(&opened))?;
    }
    let refused: Vec<_> = opened.iter().filter_map(|(_, result)| result.as_ref().err().map(Sentence::sentence)).collect();
    if refused.is_empty() { Ok(()) } else { Err(Failure::Files(refused)) }
}

fn open(file: &Path) -> CheckResult {
    Document::open_with(&[file], OpenOptions { images: ImageLoading::Test, ..OpenOptions::new(SCENE_READERS) }, &Progress::default())
        .map(|document| document.diagnostics)
}

fn report(name: &str, result: &CheckResult) -> FileReport {
    FileReport {
        file: name.to_owned(),
        usable: result.is_ok(),
        error: result.as_ref().err().map(|error| OpenFailure {
            line: error.location.line,
            column: error.location.column,
            message: error.kind.sentence(),
        }),
        findings: result.iter().flatten().map(FindingReport::from).collect(),
    }
}

/// The findings of the usable files, one a line; a refused file's line goes to standard error.
fn listing(opened: &[(String, CheckResult)]) -> String {
    let mut text = String::new();
    for (name, result) in opened {
        match result {
            Ok(findings) if findings.is_empty() => text.push_str(&format!("{name}: {}\n", tr!("cli-check-clean"))),
            Ok(findings) => findings.iter().for_each(|finding| text.push_str(&format!("{}\n", shown(&i18n::finding_line(finding))))),
            Err(_) => {}
        }
    }
    text
}

//! The command line: one file a subcommand.
//!
//! Results go to standard output, problems to standard error, one line each. The exit code is 0 = done, 1 = a file could not be used,
//! 2 = the call was wrong.

mod arg_parsers;
mod attach;
mod bench;
mod check;
mod command;
mod compare;
mod completions;
mod convert;
mod export;
mod fit;
mod info;
mod joints;
mod measure;
mod measured;
mod mistyped;
mod output;
mod pose_options;
mod progress;
mod render;
mod text_table;
mod usage;
mod window;

use std::ffi::OsString;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::ArgMatches;
use clap::error::ErrorKind;

use crate::render::{Renderer, SimdError};
use crate::tr;
use output::{Failure, print_result};

pub use command::command;
pub use window::{WindowOpener, launch_gui};

/// Runs the program and returns its exit code: 0 = done, 1 = a file could not be used, 2 = the call was wrong. `opener` opens the window:
/// [`launch_gui`] in a program that has none itself.
pub fn main(opener: WindowOpener) -> ExitCode {
    run(std::env::args_os(), opener)
}

/// Runs the program with these arguments, the first of which is its own name.
pub fn run(arguments: impl IntoIterator<Item = OsString>, opener: WindowOpener) -> ExitCode {
    let arguments: Vec<OsString> = arguments.into_iter().collect();
    if let Some(sentence) = mistyped::first_word(&arguments, &command()) {
        return Failure::Usage(sentence).report();
    }
    let matches = match command().try_get_matches_from(arguments) {
        Ok(matches) => matches,
        Err(error) if matches!(error.kind(), ErrorKind::DisplayHelp | ErrorKind::DisplayVersion) => {
            return finish(print_result(&error.render().to_string()));
        }
        Err(error) => return Failure::Usage(usage::sentence(&error)).report(),
    };
    if let Some((_, given)) = matches.subcommand() {
        output::set_verbosity(given);
        if inputs(given).filter(|file| file.as_os_str() == "-").count() > 1 {
            return Failure::Usage(tr!("cli-stdin-twice")).report();
        }
    }
    if !matches!(matches.subcommand_name(), Some("completions" | "help"))
        && let Err(error) = Renderer::asked_simd()
    {
        return Failure::usage(simd(error)).report();
    }
    match matches.subcommand() {
        Some(("info", given)) => finish(info::run(given)),
        Some(("check", given)) => finish(check::run(given)),
        Some(("render", given)) => finish(render::run(given)),
        Some(("export", given)) => finish(export::run(given)),
        Some(("convert", given)) => finish(convert::run(given)),
        Some(("measure", given)) => finish(measure::run(given)),
        Some(("fit", given)) => finish(fit::run(given)),
        Some(("attach", given)) => finish(attach::run(given)),
        Some(("bench", given)) => finish(bench::run(given)),
        Some(("completions", given)) => finish(completions::run(given)),
        Some(("help", given)) => finish(help(given)),
        _ => window::open(files(&matches), opener),
    }
}

/// What is wrong with the environment variable that names an instruction set.
fn simd(error: SimdError) -> String {
    match error {
        SimdError::Empty => tr!("cli-simd-empty", names = Renderer::known_simd().join(", ")),
        SimdError::Unknown(name) => tr!("cli-simd-unknown", name = name, names = Renderer::known_simd().join(", ")),
        SimdError::Missing(name) => tr!("cli-simd-missing", name = name, names = Renderer::simd_names().join(", ")),
    }
}

fn finish(result: Result<(), Failure>) -> ExitCode {
    result.map_or_else(|failure| failure.report(), |()| ExitCode::SUCCESS)
}

/// `sinew help [COMMAND]`.
fn help(given: &ArgMatches) -> Result<(), Failure> {
    let mut all = command();
    // Fills in the names of the subcommands as they are called.
    all.build();
    let page = match given.get_one::<String>("command") {
        None => all.render_help(),
        Some(name) => match all.find_subcommand_mut(name) {
            Some(found) => found.render_help(),
            None => {
                let like = mistyped::like(name, &command()).map(str::to_owned);
                return Err(Failure::usage(match like {
                    Some(like) => tr!("cli-no-such-command-similar", name = name.clone(), similar = like),
                    None => tr!("cli-no-such-command", name = name.clone()),
                }));
            }
        },
    };
    print_result(&page.to_string())
}

/// The value of `--option`, where it was given.
fn value<T: Clone + Send + Sync + 'static>(given: &ArgMatches, id: &str) -> Option<T> {
    given.get_one::<T>(id).cloned()
}

/// Every file that a call is to read.
fn inputs(given: &ArgMatches) -> impl Iterator<Item = &PathBuf> {
    let of = |id| given.try_get_many::<PathBuf>(id).ok().flatten().into_iter().flatten();
    ["file", "like", "compare"].into_iter().flat_map(of)
}

/// All files that were given.
fn files(given: &ArgMatches) -> Vec<PathBuf> {
    given.get_many::<PathBuf>("file").into_iter().flatten().cloned().collect()
}

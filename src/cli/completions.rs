//! `sinew completions`: what a shell needs to complete calls of the program.

use clap::ArgMatches;
use clap_complete::{Shell, generate};

use super::command::command;
use super::output::{Failure, print_result};
use super::value;
use crate::tr;

/// Runs the subcommand.
pub(super) fn run(given: &ArgMatches) -> Result<(), Failure> {
    let shell = match value::<String>(given, "shell").as_deref() {
        Some("zsh") => Shell::Zsh,
        Some("fish") => Shell::Fish,
        Some("bash") => Shell::Bash,
        // The parser lets nothing else through.
        _ => return Err(Failure::usage(tr!("cli-usage-error"))),
    };
    let mut script = Vec::new();
    generate(shell, &mut command(), "sinew", &mut script);
    print_result(&String::from_utf8_lossy(&script))
}

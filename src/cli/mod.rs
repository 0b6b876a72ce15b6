//! The command line: one file a subcommand.

use std::process::ExitCode;

/// Runs the program and returns its exit code: 0 = done, 1 = a file could not be used, 2 = the call was wrong.
pub fn main() -> ExitCode {
    ExitCode::SUCCESS
}

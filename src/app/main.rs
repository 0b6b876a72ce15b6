//! The program with the window in it; the command line is the same.

fn main() -> std::process::ExitCode {
    sinew::cli::main(sinew::app::run)
}

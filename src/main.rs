//! Arguments, then the command line or the window: nothing else.

fn main() -> std::process::ExitCode {
    sinew::cli::main()
}

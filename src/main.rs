//! The command line. The window is a program of its own, which this one becomes: see [`sinew::cli::hand_over`].

fn main() -> std::process::ExitCode {
    sinew::cli::main(sinew::cli::launch_gui)
}

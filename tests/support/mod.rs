//! What the tests share: running the program, models that the tests make themselves, and readers of what the program writes.
//!
//! Each test file includes this module and uses a part of it.
#![allow(dead_code, reason = "each test target uses a part of it")]

pub(crate) mod humanoid;
pub(crate) mod models;
pub(crate) mod obj;
pub(crate) mod picture;

use std::ffi::OsStr;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

/// No call of a test may take longer.
const PATIENCE: Duration = Duration::from_secs(120);

/// The folder of real-world models, where it is there: beside the checkout, or where `SINEW_SHARED` says. Tests that want it say loudly that
/// they skip when it is not.
pub(crate) fn shared() -> Option<PathBuf> {
    let folder = std::env::var_os("SINEW_SHARED").map_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared"), PathBuf::from);
    folder.join("models").is_dir().then_some(folder)
}

/// Says that something is not tested here, for want of what a person may well do without.
pub(crate) fn left_out(why: &str) {
    eprintln!("SKIPPED: {why}");
}

/// Says that something is not tested here, for want of what `resources/setup.sh` installs. Where `CI` is set it must not be wanting.
#[track_caller]
pub(crate) fn left_out_by_hand(why: &str) {
    left_out(why);
    assert!(std::env::var_os("CI").is_none_or(|ci| ci.is_empty()), "left out, which no check by machine may do: {why}");
}

/// A file of `configs/`.
pub(crate) fn config(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("configs").join(name)
}

/// A folder for one test, gone when the test is over.
pub(crate) fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

/// How a call of the program ended.
#[derive(Debug)]
pub(crate) struct Ended {
    /// The exit code; −1 for a signal.
    pub code: i32,
    /// Standard output.
    pub out: String,
    /// Standard error.
    pub err: String,
}

impl Ended {
    /// Checks that the call went well and said nothing on standard error.
    #[track_caller]
    pub(crate) fn well(self) -> String {
        assert_eq!((self.code, self.err.as_str()), (0, ""), "{}", self.out);
        self.out
    }

    /// Checks that the call failed with `code`, with one line on standard error and nothing on standard output, and returns the line.
    #[track_caller]
    pub(crate) fn refused(self, code: i32) -> String {
        assert_eq!((self.code, self.out.as_str()), (code, ""), "{}", self.err);
        assert_eq!(self.err.lines().count(), 1, "{}", self.err);
        assert!(!self.err.contains("panicked"), "{}", self.err);
        self.err.trim_end().to_owned()
    }

    /// Standard output as JSON, of a call that went well.
    #[track_caller]
    pub(crate) fn json(self) -> serde_json::Value {
        serde_json::from_str(&self.well()).expect("JSON")
    }
}

/// A call of the program in English.
pub(crate) fn call<I: IntoIterator<Item = S>, S: AsRef<OsStr>>(arguments: I) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_sinew"));
    command.args(arguments).env_remove("LC_ALL").env_remove("LC_MESSAGES").env("LANG", "C.UTF-8").env("COLUMNS", "200");
    command.env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY");
    command
}

/// Runs the program in English without input.
#[track_caller]
pub(crate) fn sinew<I: IntoIterator<Item = S>, S: AsRef<OsStr>>(arguments: I) -> Ended {
    run(call(arguments), b"")
}

/// Runs the program in Russian without input.
#[track_caller]
pub(crate) fn sinew_ru<I: IntoIterator<Item = S>, S: AsRef<OsStr>>(arguments: I) -> Ended {
    let mut command = call(arguments);
    command.env("LANG", "ru_RU.UTF-8");
    run(command, b"")
}

/// Runs a call with `input` on standard input, and ends it where it hangs.
#[track_caller]
pub(crate) fn run(mut command: Command, input: &[u8]) -> Ended {
    let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("the program starts");
    let mut stdin = child.stdin.take().expect("piped");
    let input = input.to_owned();
    // A program that does not read its input closes the pipe, which is no failure of the test.
    let feeder = thread::spawn(move || stdin.write_all(&input).is_ok());
    let (out, err) = (gather(child.stdout.take().expect("piped")), gather(child.stderr.take().expect("piped")));
    let code = wait(&mut child);
    let _ = feeder.join();
    let text = |bytes: thread::JoinHandle<Vec<u8>>| String::from_utf8(bytes.join().expect("read")).expect("UTF-8");
    Ended { code, out: text(out), err: text(err) }
}

fn gather(mut from: impl Read + Send + 'static) -> thread::JoinHandle<Vec<u8>> {
    thread::spawn(move || {
        let mut bytes = Vec::new();
        from.read_to_end(&mut bytes).expect("a readable pipe");
        bytes
    })
}

#[track_caller]
fn wait(child: &mut Child) -> i32 {
    let begun = Instant::now();
    loop {
        if let Some(status) = child.try_wait().expect("a child of ours") {
            return status.code().unwrap_or(-1);
        }
        if begun.elapsed() > PATIENCE {
            child.kill().expect("a child of ours");
            panic!("the program hangs");
        }
        thread::sleep(Duration::from_millis(2));
    }
}

/// A path as an argument.
pub(crate) fn arg(path: &Path) -> &str {
    path.to_str().expect("a temporary path is text")
}

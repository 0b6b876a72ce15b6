//! What `make run` and `make test` install, on machines of all kinds: programs that stand in for the system's write down how they are called.
#![cfg(unix)]

use std::fs;
use std::os::unix::fs::{PermissionsExt, symlink};
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::support::folder;

/// Programs that the script uses as they are.
const REAL: [&str; 14] = ["bash", "sh", "cat", "dirname", "env", "grep", "head", "mktemp", "rm", "sed", "sort", "chmod", "mkdir", "cp"];

/// A cargo of this version. Its file is called so that it can be installed by another one.
fn cargo(version: &str) -> String {
    format!("echo 'cargo {version}.0 (0123abc 2026-01-01)'")
}

/// A machine whose only programs are these.
struct Machine {
    folder: tempfile::TempDir,
}

/// How a run ended.
struct Ended {
    code: i32,
    said: String,
    /// The calls that change something, one a line.
    calls: String,
}

impl Machine {
    /// With root's rights and all system packages, but without Rust.
    fn new() -> Self {
        let machine = Self { folder: folder() };
        for name in ["bin", "home", "store"] {
            fs::create_dir(machine.at(name)).expect("made");
        }
        for name in REAL {
            let found = ["/usr/bin", "/bin"].iter().map(|folder| Path::new(folder).join(name)).find(|file| file.exists());
            symlink(found.expect("every system has it"), machine.at("bin").join(name)).expect("links work");
        }
        machine.put("id", "echo 0").put("dpkg-query", "echo installed").put("pkg-config", "exit 0")
    }

    fn at(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Puts a script among the programs, or into another folder.
    fn put_into(self, folder: &str, name: &str, body: &str) -> Self {
        fs::create_dir_all(self.at(folder)).expect("made");
        let file = self.at(folder).join(name);
        fs::write(&file, format!("#!/bin/sh\n{body}\n")).expect("written");
        fs::set_permissions(&file, fs::Permissions::from_mode(0o755)).expect("ours");
        self
    }

    fn put(self, name: &str, body: &str) -> Self {
        self.put_into("bin", name, body)
    }

    /// apt-get and what it knows; installing rustup brings a rustup.
    fn apt(self, offers: &[&str]) -> Self {
        let known = offers.join(" ");
        // In another language it says another word.
        self.put("apt-cache", &format!("[ \"$LC_ALL\" = C ] || exit 0; case ' {known} ' in *\" $2 \"*) echo '  Candidate: 1.0';; *) echo '  Candidate: (none)';; esac"))
            .put(
                "apt-get",
                "echo apt-get \"$@\" >>\"$CALLS\"
case \"$*\" in *install*rustup*) cp \"$STORE/rustup\" \"$BIN/rustup\";; *install*curl*) cp \"$STORE/curl\" \"$BIN/curl\";; esac",
            )
    }

    /// A rustup, in use or in store, that brings this version of cargo.
    fn rustup(self, folder: &str, version: &str) -> Self {
        self.put_into("store", "cargo", &cargo(version)).put_into(
            folder,
            "rustup",
            "echo rustup \"$@\" >>\"$CALLS\"\ncase \"$*\" in 'toolchain install'*) cp \"$STORE/cargo\" \"$BIN/cargo\";; esac",
        )
    }

    /// curl or wget, in use or in store, that fetches an installer of this version of cargo.
    fn fetches(self, folder: &str, name: &str, version: &str) -> Self {
        let install = "echo installer \"$@\" >>\"$CALLS\"; mkdir -p \"$HOME/.cargo/bin\"; cp \"$STORE/cargo\" \"$HOME/.cargo/bin/cargo\"";
        self.put_into("store", "cargo", &cargo(version)).put_into("store", "installer", install).put_into(
            folder,
            name,
            &format!(
                "echo {name} \"$@\" >>\"$CALLS\"\nwhile [ $# -gt 0 ]; do case \"$1\" in -o|-O) cp \"$STORE/installer\" \"$2\";; esac; shift; done"
            ),
        )
    }

    /// Neither root nor anybody who may become root.
    fn nobody(self) -> Self {
        self.put("id", "echo 1000")
    }

    fn lacking_packages(self) -> Self {
        self.put("dpkg-query", "exit 1")
    }

    fn command(&self, program: &str) -> Command {
        let mut command = Command::new(program);
        command.current_dir(env!("CARGO_MANIFEST_DIR")).env_clear().env("PATH", self.at("bin")).env("HOME", self.at("home"));
        command.env("CALLS", self.at("calls")).env("STORE", self.at("store")).env("BIN", self.at("bin"));
        command
    }

    fn ended(&self, mut command: Command) -> Ended {
        let output = command.output().expect("runs");
        let said = String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr);
        let calls = fs::read_to_string(self.at("calls")).unwrap_or_default();
        let left = fs::read_dir(self.at("home")).expect("there").flatten().filter(|entry| entry.file_name() != ".cargo").count();
        assert_eq!(left, 0, "temporary files");
        Ended { code: output.status.code().unwrap_or(-1), said, calls }
    }

    /// `setup.sh build` without a terminal.
    fn setup(&self, more: &[(&str, &str)]) -> Ended {
        let mut command = self.command("resources/setup.sh");
        command.arg("build").stdin(std::process::Stdio::null()).env("TMPDIR", self.at("home")).envs(more.iter().copied());
        self.ended(command)
    }

    /// `setup.sh build` at a terminal, at which this is typed.
    fn at_a_terminal(&self, typed: &str) -> Ended {
        let mut command = self.command("/bin/sh");
        let script = "printf '%s\\n' \"$TYPED\" | /usr/bin/script -qec 'resources/setup.sh build' /dev/null";
        command.args(["-c", script]).env("TYPED", typed).env("TMPDIR", self.at("home")).env("SHELL", "/bin/sh");
        self.ended(command)
    }
}

impl Ended {
    #[track_caller]
    fn well(self, calls: &[&str]) -> String {
        assert_eq!(self.code, 0, "{}\n{}", self.said, self.calls);
        let expected: Vec<&str> = calls.to_vec();
        assert_eq!(self.calls.lines().collect::<Vec<_>>(), expected, "{}", self.said);
        self.said
    }

    #[track_caller]
    fn refused(self) -> String {
        assert_eq!((self.code, self.calls.as_str()), (1, ""), "{}", self.said);
        self.said
    }
}

const UPDATE: &str = "apt-get update -qq";
const RUSTUP: &str = "apt-get install -y -qq --no-install-recommends --no-remove rustup";
const TOOLCHAIN: &str = "rustup toolchain install stable --profile minimal --component rustfmt --component clippy";
const INSTALLER: &str = "installer -y --no-modify-path --profile minimal --component rustfmt --component clippy";

fn fetched(call: &str, starts: &str) -> bool {
    call.starts_with(starts) && call.ends_with("https://sh.rustup.rs")
}

#[test]
fn a_rust_that_is_new_enough_is_left_alone() {
    for version in ["1.92", "1.100", "2.0"] {
        assert_eq!(Machine::new().apt(&[]).put("cargo", &cargo(version)).setup(&[]).well(&[]), "");
    }
    // Also where only rustup's folder has it, and an older one stands before it.
    let machine = Machine::new().apt(&[]).put("cargo", &cargo("1.63")).put_into("home/.cargo/bin", "cargo", &cargo("1.95"));
    assert_eq!(machine.setup(&[]).well(&[]), "");
}

#[test]
fn the_systems_rustup_is_taken_where_there_is_one() {
    for old in [None, Some("1.85")] {
        let machine = Machine::new().apt(&["rustup"]).rustup("store", "1.95");
        let machine = match old {
            Some(version) => machine.put("cargo", &cargo(version)),
            None => machine,
        };
        let said = machine.setup(&[]).well(&[UPDATE, RUSTUP, TOOLCHAIN]);
        let have = old.map_or_else(|| "there is none here".to_owned(), |version| format!("this is {version}"));
        assert!(said.contains(&format!("Sinew needs Rust 1.92 or newer, and {have}.")), "{said}");
        assert!(said.contains("the package rustup") && said.contains("SINEW_NO_INSTALL=1"), "{said}");
    }
}

#[test]
fn a_rustup_that_is_there_brings_a_newer_rust() {
    for folder in ["bin", "home/.cargo/bin"] {
        let machine = Machine::new().apt(&["rustup"]).put("cargo", &cargo("1.80")).rustup(folder, "1.95");
        machine.setup(&[]).well(&[TOOLCHAIN]);
    }
    // Without any toolchain yet, rustup's cargo says nothing of a version.
    let machine = Machine::new().apt(&[]).put("cargo", "echo 'no toolchain' >&2; exit 1").rustup("bin", "1.95");
    machine.setup(&[]).well(&[TOOLCHAIN]);
}

#[test]
fn another_default_of_the_users_stays_one() {
    let bring = "case \"$*\" in 'override set stable') cp \"$STORE/cargo\" \"$BIN/cargo\";; esac";
    let machine = Machine::new().put("cargo", &cargo("1.80")).put_into("store", "cargo", &cargo("1.95"));
    let machine = machine.put("rustup", &format!("echo rustup \"$@\" >>\"$CALLS\"\n{bring}"));
    machine.setup(&[]).well(&[TOOLCHAIN, "rustup override set stable"]);
    let bring = "case \"$*\" in 'default stable') cp \"$STORE/cargo\" \"$BIN/cargo\";; esac";
    let machine =
        Machine::new().put_into("store", "cargo", &cargo("1.95")).put("rustup", &format!("echo rustup \"$@\" >>\"$CALLS\"\n{bring}"));
    machine.setup(&[]).well(&[TOOLCHAIN, "rustup default stable"]);
}

#[test]
fn else_its_makers_installer_is_taken() {
    for (name, starts) in [("curl", "curl --proto =https --tlsv1.2 -sSf -o "), ("wget", "wget -q -O ")] {
        for old in [None, Some("1.63")] {
            let machine = Machine::new().apt(&["curl"]).fetches("bin", name, "1.95");
            let machine = match old {
                Some(version) => machine.put("cargo", &cargo(version)),
                None => machine,
            };
            let ended = machine.setup(&[]);
            let calls: Vec<&str> = ended.calls.lines().collect();
            assert!(ended.code == 0 && fetched(calls[0], starts) && calls[1..] == [INSTALLER], "{} {calls:?}", ended.said);
            assert!(ended.said.contains("https://sh.rustup.rs"), "{}", ended.said);
            // The same run of make goes on with it.
            let mut command = machine.command("resources/cargo.sh");
            command.arg("--version");
            assert_eq!(machine.ended(command).said, "cargo 1.95.0 (0123abc 2026-01-01)\n");
        }
    }
    // Without apt-get too, and without root's rights also where the system has a rustup.
    let machine = Machine::new().fetches("bin", "curl", "1.95");
    assert!(machine.setup(&[]).calls.ends_with(&format!("{INSTALLER}\n")));
    let machine = Machine::new().nobody().apt(&["rustup"]).fetches("bin", "curl", "1.95");
    assert!(machine.setup(&[]).calls.ends_with(&format!("{INSTALLER}\n")));
}

#[test]
fn what_fetches_it_is_installed_first() {
    let machine = Machine::new().apt(&["curl"]).fetches("store", "curl", "1.95");
    let ended = machine.setup(&[]);
    let calls: Vec<&str> = ended.calls.lines().collect();
    assert_eq!(calls[..2], [UPDATE, "apt-get install -y -qq --no-install-recommends curl ca-certificates"]);
    assert!(ended.code == 0 && calls.last() == Some(&INSTALLER), "{} {calls:?}", ended.said);
    for machine in [Machine::new(), Machine::new().nobody().apt(&["curl"])] {
        assert!(machine.setup(&[]).refused().contains("there is neither"));
    }
}

#[test]
fn a_package_that_would_push_others_out_is_left_alone() {
    let machine = Machine::new().apt(&["rustup"]).fetches("bin", "curl", "1.95");
    let machine =
        machine.put("apt-get", "echo apt-get \"$@\" >>\"$CALLS\"; case \"$1\" in install) echo 'E: needs to remove'; exit 100;; esac");
    let ended = machine.setup(&[]);
    assert!(ended.code == 0 && ended.calls.ends_with(&format!("{INSTALLER}\n")), "{}", ended.said);
    assert!(ended.said.contains("E: needs to remove") && ended.said.contains("is taken instead"), "{}", ended.said);
}

#[test]
fn what_fails_is_said() {
    let machine = Machine::new().put("curl", "exit 6");
    let ended = machine.setup(&[]);
    assert!(ended.code == 1 && ended.said.contains("could not be fetched"), "{}", ended.said);
    let machine = Machine::new().fetches("bin", "curl", "1.95").put_into("store", "installer", "exit 1");
    let ended = machine.setup(&[]);
    assert!(ended.code == 1 && ended.said.contains("rustup's installer failed"), "{}", ended.said);
    let machine = Machine::new().put("rustup", "exit 1");
    let ended = machine.setup(&[]);
    assert!(ended.code == 1 && ended.said.contains("rustup could not install Rust"), "{}", ended.said);
    let machine = Machine::new().fetches("bin", "curl", "1.70");
    let ended = machine.setup(&[]);
    assert!(ended.code == 1 && ended.said.contains("cargo is still 1.70"), "{}", ended.said);
}

#[test]
fn who_wants_nothing_installed_gets_nothing() {
    let no = [("SINEW_NO_INSTALL", "1")];
    for machine in [Machine::new().apt(&["rustup"]), Machine::new().fetches("bin", "curl", "1.95"), Machine::new().rustup("bin", "1.95")] {
        let said = machine.setup(&no).refused();
        assert!(said.contains("SINEW_NO_INSTALL is set") && said.contains("https://rustup.rs"), "{said}");
    }
    let said = Machine::new().apt(&[]).put("cargo", &cargo("1.95")).lacking_packages().setup(&no).refused();
    assert!(said.contains("SINEW_NO_INSTALL is set") && said.contains("libgtk-4-dev"), "{said}");
    // Nothing is missing, so nothing is refused.
    Machine::new().apt(&[]).put("cargo", &cargo("1.95")).setup(&no).well(&[]);
}

#[test]
fn at_a_terminal_it_is_asked() {
    let machine = || Machine::new().apt(&["rustup"]).rustup("store", "1.95");
    for no in ["n", "no", "x", "нет"] {
        let ended = machine().at_a_terminal(no);
        assert!(ended.calls.is_empty() && ended.code == 1, "{no}: {} {}", ended.code, ended.said);
        assert!(ended.said.contains("[Y/n]") && ended.said.contains("Nothing was installed"), "{}", ended.said);
    }
    for yes in ["", "y", "Yes", "да"] {
        let ended = machine().at_a_terminal(yes);
        assert_eq!(ended.calls.lines().collect::<Vec<_>>(), [UPDATE, RUSTUP, TOOLCHAIN], "{yes}: {}", ended.said);
    }
}

#[test]
fn system_packages_are_installed_by_root_or_sudo() {
    let machine = || Machine::new().apt(&[]).put("cargo", &cargo("1.95")).lacking_packages();
    let ended = machine().setup(&[]);
    assert!(ended.code == 0 && ended.calls.contains("libgtk-4-dev") && ended.said.contains("libgtk-4-dev"), "{}", ended.said);
    let ended = machine().nobody().put("sudo", "echo sudo >>\"$CALLS\"; exec \"$@\"").setup(&[]);
    assert!(ended.code == 0 && ended.calls.starts_with("sudo\napt-get update"), "{} {}", ended.said, ended.calls);
    assert!(machine().nobody().setup(&[]).refused().contains("only root can install them: apt-get install build-essential"));
    let machine = Machine::new().put("cargo", &cargo("1.95"));
    machine.setup(&[]).well(&[]);
    let machine = Machine::new().put("cargo", &cargo("1.95")).put("pkg-config", "exit 1");
    assert!(machine.setup(&[]).refused().contains("no apt-get"));
}

#[test]
fn the_version_asked_for_is_that_of_the_crate() {
    let read = |name: &str| fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(name)).expect("there");
    let least = read("resources/rust.sh").lines().find_map(|line| Some(line.strip_prefix("least=")?.to_owned())).expect("a version");
    assert!(read("Cargo.toml").contains(&format!("rust-version = \"{least}\"")), "{least}");
}

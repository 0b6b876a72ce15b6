//! Which of GTK's renderers shows the window: cairo wherever no hardware draws for GL or Vulkan. There GTK would let the processor play a graphics card,
//! which takes three times as much of it as cairo does for the same picture.
//!
//! What there is of hardware is known for sure only once GTK has asked for it. Where there is no device to draw with at all, that is needless; else the
//! program looks which devices it holds open after GTK has made itself ready for GL. A driver that draws in software holds none.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use gtk::gdk;
use gtk::prelude::*;
use gtk4 as gtk;

/// GTK's own variable; where the user sets it, it is respected.
const VARIABLE: &str = "GSK_RENDERER";
/// GTK before this version always let GL go before cairo, however slow.
const CHOOSES: (u32, u32) = (4, 14);
/// Devices with which drivers draw, other than the nodes of the kernel's own graphics (`/dev/dri/renderD128` …): closed drivers, phones, Windows beneath.
const OTHERS: [&str; 6] = ["nvidia", "dxg", "kgsl", "mali", "pvr", "nvhost"];

/// Chooses cairo where it is known beforehand that nothing better will come. To be called before GTK starts.
pub(crate) fn choose() {
    let old = (gtk::major_version(), gtk::minor_version()) < CHOOSES;
    let none = cfg!(target_os = "linux") && !has_device(Path::new("/dev"));
    if std::env::var_os(VARIABLE).is_none() && (old || none) {
        // SAFETY: nothing else runs yet: this is the first thing that the window's thread does, before GTK starts any other.
        unsafe { std::env::set_var(VARIABLE, "cairo") };
    }
}

/// Whether GTK, which has started, would draw in software where cairo does better. Then the program is to be restarted with [`command`].
pub(crate) fn is_wrong() -> bool {
    if std::env::var_os(VARIABLE).is_some() || !cfg!(target_os = "linux") {
        return false;
    }
    let Some(display) = gdk::Display::default() else { return false };
    // Holds the devices open, where there are any for it.
    let context = display.create_gl_context().ok().filter(|context| context.realize().is_ok());
    !(context.is_some() && holds_device(&open_files(Path::new("/proc/self/fd"))))
}

/// This very program again, with cairo.
pub(crate) fn command() -> Option<std::process::Command> {
    let mut command = std::process::Command::new(std::env::current_exe().ok()?);
    command.args(std::env::args_os().skip(1)).env(VARIABLE, "cairo");
    Some(command)
}

/// Whether there is any device to draw with.
fn has_device(devices: &Path) -> bool {
    let listed = |folder: PathBuf| std::fs::read_dir(folder).into_iter().flatten().flatten();
    let node = |name: &OsStr| name.to_str().is_some_and(|name| name.starts_with("renderD"));
    listed(devices.join("dri")).any(|entry| node(&entry.file_name())) || listed(devices.to_path_buf()).any(|entry| draws(&entry.path()))
}

/// Whether one of the files that are open is a device to draw with.
fn holds_device(open: &[PathBuf]) -> bool {
    open.iter().any(|path| draws(path) || path.starts_with("/dev/dri"))
}

/// Whether a path is that of one of the [`OTHERS`].
fn draws(path: &Path) -> bool {
    let own = path.file_name().and_then(OsStr::to_str).filter(|_| path.parent().is_some_and(|folder| folder.ends_with("dev")));
    own.is_some_and(|name| OTHERS.iter().any(|other| name.starts_with(other)))
}

/// What is open, by the folder in which the system lists it.
fn open_files(folder: &Path) -> Vec<PathBuf> {
    let listed = std::fs::read_dir(folder).into_iter().flatten().flatten();
    listed.filter_map(|entry| std::fs::read_link(entry.path()).ok()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_machine_has_a_device_or_none() {
        let folder = tempfile::tempdir().unwrap();
        let devices = folder.path().join("dev");
        let has = || has_device(&devices);
        assert!(!has(), "not even a folder");
        std::fs::create_dir_all(devices.join("dri")).unwrap();
        for name in ["null", "tty0", "random", "dri/card0"] {
            std::fs::write(devices.join(name), "").unwrap();
            assert!(!has(), "{name} shows a picture, or nothing, and draws none");
        }
        for name in ["dri/renderD128", "nvidia0", "dxg", "kgsl-3d0", "mali0"] {
            let path = devices.join(name);
            std::fs::write(&path, "").unwrap();
            assert!(has(), "{name}");
            std::fs::remove_file(path).unwrap();
        }
    }

    #[test]
    fn a_driver_that_draws_in_software_holds_no_device() {
        let open = |paths: &[&str]| holds_device(&paths.iter().map(PathBuf::from).collect::<Vec<_>>());
        assert!(!open(&["/dev/null", "socket:[1]", "/dev/shm/x", "/home/nvidia/a.dae", "/usr/lib/dri/swrast_dri.so"]));
        for device in ["/dev/dri/renderD129", "/dev/dri/card0", "/dev/nvidiactl", "/dev/dxg"] {
            assert!(open(&["/dev/null", device]), "{device}");
        }
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn what_is_open_is_listed() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().canonicalize().unwrap().join("open");
        let file = std::fs::File::create(&path).unwrap();
        assert!(open_files(Path::new("/proc/self/fd")).contains(&path));
        drop(file);
        assert!(!open_files(Path::new("/proc/self/fd")).contains(&path));
    }
}

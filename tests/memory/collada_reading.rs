//! Reading takes at most ten times the file and 64 MB, whatever the file is made of.
//!
//! The peak is that of the whole process, which Linux lets a process reset; elsewhere there is nothing to measure with.

use crate::build::*;
use sinew::collada::read;
use sinew::i18n::Sentence;
use sinew::progress::Progress;

/// Peak and present size of this process, bytes.
fn sizes() -> Option<(usize, usize)> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let field = |name: &str| {
        let line = status.lines().find(|line| line.starts_with(name))?;
        line.split_whitespace().nth(1)?.parse::<usize>().ok().map(|kilobytes| kilobytes * 1024)
    };
    Some((field("VmHWM:")?, field("VmRSS:")?))
}

/// A `.zae` with `text` in it.
fn packed(text: &str) -> Vec<u8> {
    let mut zip = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    zip.start_file("scene.dae", zip::write::SimpleFileOptions::default()).expect("a name");
    std::io::Write::write_all(&mut zip, text.as_bytes()).expect("memory");
    zip.finish().expect("memory").into_inner()
}

fn check(what: &str, text: &str) {
    check_bytes(what, text.as_bytes());
}

fn check_bytes(what: &str, bytes: &[u8]) {
    if std::fs::write("/proc/self/clear_refs", "5").is_err() {
        eprintln!("skipped: the peak cannot be reset here");
        return;
    }
    let Some((_, before)) = sizes() else { return };
    let result = read(bytes, "big.dae", &Progress::default());
    let Some((peak, _)) = sizes() else { return };
    let (taken, allowed) = (peak.saturating_sub(before), bytes.len() * 10 + (64 << 20));
    println!(
        "{what}: {} MB of file, {} MB taken, {:?}",
        bytes.len() >> 20,
        taken >> 20,
        result.as_ref().map(|loaded| codes(loaded)).map_err(|e| e.sentence())
    );
    assert!(taken <= allowed, "{what}: {} MB of file took {} MB", bytes.len() >> 20, taken >> 20);
}

pub(crate) fn memory_stays_within_ten_times_the_file() {
    let n = 1_000_000;
    check("empty elements", &document(&format!("<extra>{}</extra>", "<a/>".repeat(3 * n))));
    check("nodes", &document(&scene(&"<node/>".repeat(n))));
    check("transforms", &document(&scene(&format!("<node>{}</node>", "<scale>1 1 1</scale>".repeat(n / 4)))));
    check("signs", &document(&format!("<!--{}-->", "<=".repeat(5 * n))));
    check("attributes", &document(&"<a b=\"\" c=\"\" d=\"\"/>".repeat(n / 2)));
    let used = scene("<node><instance_geometry url=\"#g\"/></node>");
    check("instances", &document(&(triangle() + &scene(&format!("<node>{}</node>", "<instance_geometry url=\"#g\"/>".repeat(n / 4))))));
    let zeros = "0 ".repeat(6 * n);
    check("points", &document(&(geometries(&geometry("g", &zeros, &triangles("g", "0 1 2"))) + &used)));
    check("indices", &document(&(geometries(&geometry("g", "0 0 0 1 0 0 0 1 0", &triangles("g", &zeros))) + &used)));
    let distinct: Vec<String> = (0..n).map(|i| i.to_string()).collect();
    let points = "0 0 0 ".repeat(n);
    check("distinct corners", &document(&(geometries(&geometry("g", &points, &triangles("g", &distinct.join(" ")))) + &used)));
    let polygons =
        format!("<polygons><input semantic=\"VERTEX\" source=\"#g-v\" offset=\"0\"/>{}</polygons>", "<p>0 1 2 1</p>".repeat(n / 4));
    check("polygons", &document(&(geometries(&geometry("g", "0 0 0 1 0 0 0 1 0", &polygons)) + &used)));
    let keys: Vec<String> = (0..n / 4).map(|i| i.to_string()).collect();
    let modes = "LINEAR ".repeat(n / 4);
    let moving =
        scene("<node id=\"n\"><translate sid=\"t\">0 0 0</translate><matrix sid=\"m\">1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix></node>");
    check("keys", &document(&(animations(&animation("a", "n/t.X", &keys.join(" "), "X", &keys.join(" "), &modes)) + &moving)));
    let identity = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 ".repeat(n / 16);
    let matrix = animation("a", "n/m", &keys[..n / 16].join(" "), &["M"; 16].join(" "), &identity, "LINEAR");
    check("matrix keys", &document(&(animations(&matrix) + &moving)));
    let channels = "<animation><channel source=\"#a-s\" target=\"n/t.Y\"/></animation>".repeat(n / 8);
    check("channels", &document(&(animations(&(animation("a", "n/t.X", "0 1", "X", "0 1", "LINEAR LINEAR") + &channels)) + &moving)));
    // The same from archives, where a small file can hold much: of any size that is just let in.
    for share in [n / 8, n / 2, 2 * n] {
        let elements = document(&format!("<extra>{}</extra>", "<a/>".repeat(2 * share)));
        check_bytes("packed elements", &packed(&elements));
        check_bytes("packed nodes", &packed(&document(&scene(&"<node/>".repeat(share)))));
        let points = geometries(&geometry("g", &"0 ".repeat(3 * share), &triangles("g", &"0 1 2 ".repeat(share))));
        check_bytes("packed mesh", &packed(&document(&(points + &used))));
        // Digits that don't pack well, as in a real model.
        let noise: String = (0..share as u64).map(|i| format!("{} ", i.wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 44)).collect();
        let rough = geometries(&geometry("g", &noise, &triangles("g", "0 1 2")));
        check_bytes("packed noise", &packed(&document(&(rough + &used))));
    }
}

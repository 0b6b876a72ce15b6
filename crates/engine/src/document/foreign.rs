//! Recognition of unsupported formats, so that the message names the format of the file.

use std::path::Path;

use super::SceneReaders;
use sinew_scene::import::starts_as_xml;
use sinew_scene::message;
use sinew_scene::message::{Message, ToMessage};

/// How much of a file is looked at.
const HEADER_BYTES: usize = 4096;

/// What a file begins with, and what such a file is.
const MAGIC_BYTES: &[(&[u8], &str)] = &[
    (b"glTF", "glTF (.glb)"),
    (b"Kaydara FBX Binary", "FBX"),
    (b"; FBX", "FBX"),
    (b"BLENDER", "Blender (.blend)"),
    (b"HIERARCHY", "BVH"),
    (b"PXR-USDC", "USD"),
    (b"#usda", "USD"),
    (b"Ogawa", "Alembic"),
    (b"\x89HDF", "HDF5"),
    (b"\x89PNG", "PNG"),
    (b"\xFF\xD8\xFF", "JPEG"),
    (b"GIF8", "GIF"),
    (b"II*\0", "TIFF"),
    (b"MM\0*", "TIFF"),
    (b"8BPS", "Photoshop (.psd)"),
    (b"%PDF", "PDF"),
    (b"%!PS", "PostScript"),
    (b"ply\n", "PLY"),
    (b"ply\r", "PLY"),
    (b"#VRML", "VRML"),
    (b"xof ", "DirectX (.x)"),
    (b"PathFileType", "TRC"),
    (b"IDP2", "MD2"),
    (b"IDP3", "MD3"),
    (b"MD5Version", "MD5"),
    (b"INTERQUAKEMODEL", "IQM"),
    (b"Vocaloid Motion Data", "VMD"),
    (b"PMX ", "PMX"),
    (b"//Maya ASCII", "Maya (.ma)"),
    (b"FOR4", "Maya (.mb)"),
    (b"FOR8", "Maya (.mb)"),
    (b"\xD0\xCF\x11\xE0", "3ds Max (.max)"),
    (b"QC4DC4D6", "Cinema 4D (.c4d)"),
    (b"\x1F\x8B", "gzip"),
    (b"7z\xBC\xAF\x27\x1C", "7z"),
    (b"Rar!", "RAR"),
    (b"\x28\xB5\x2F\xFD", "Zstandard"),
    (b"\x1A\x45\xDF\xA3", "WebM"),
    (b"\x7FELF", "ELF"),
];

/// Endings of such files whose content has no mark of its own, or none that tells it apart from text.
const EXTENSIONS: &[(&str, &str)] = &[
    ("3ds", "3DS"),
    ("3mf", "3MF"),
    ("abc", "Alembic"),
    ("amc", "AMC"),
    ("asf", "ASF"),
    ("avi", "AVI"),
    ("blend", "Blender (.blend)"),
    ("bmp", "BMP"),
    ("bvh", "BVH"),
    ("c3d", "C3D"),
    ("c4d", "Cinema 4D (.c4d)"),
    ("dxf", "DXF"),
    ("fbx", "FBX"),
    ("gif", "GIF"),
    ("glb", "glTF (.glb)"),
    ("gltf", "glTF"),
    ("htm", "HTML"),
    ("html", "HTML"),
    ("igs", "IGES"),
    ("iqm", "IQM"),
    ("jpeg", "JPEG"),
    ("jpg", "JPEG"),
    ("lwo", "LightWave (.lwo)"),
    ("ma", "Maya (.ma)"),
    ("max", "3ds Max (.max)"),
    ("mb", "Maya (.mb)"),
    ("mp4", "MP4"),
    ("mot", "MOT"),
    ("mtl", "MTL"),
    ("obj", "OBJ"),
    ("osim", "OpenSim (.osim)"),
    ("pdf", "PDF"),
    ("ply", "PLY"),
    ("pmd", "PMD"),
    ("pmx", "PMX"),
    ("png", "PNG"),
    ("smd", "SMD"),
    ("step", "STEP"),
    ("stl", "STL"),
    ("sto", "STO"),
    ("stp", "STEP"),
    ("svg", "SVG"),
    ("tga", "TGA"),
    ("tif", "TIFF"),
    ("tiff", "TIFF"),
    ("trc", "TRC"),
    ("urdf", "URDF"),
    ("usd", "USD"),
    ("usda", "USD"),
    ("usdc", "USD"),
    ("usdz", "USD"),
    ("vmd", "VMD"),
    ("vrm", "glTF (.vrm)"),
    ("vtp", "VTP"),
    ("webm", "WebM"),
    ("webp", "WebP"),
    ("wrl", "VRML"),
    ("x", "DirectX (.x)"),
    ("x3d", "X3D"),
];

/// Root elements of XML documents that are no COLLADA.
const ROOT_ELEMENTS: &[(&str, &str)] = &[
    ("OpenSimDocument", "OpenSim (.osim)"),
    ("X3D", "X3D"),
    ("robot", "URDF"),
    ("sdf", "SDF"),
    ("mujoco", "MuJoCo"),
    ("svg", "SVG"),
    ("html", "HTML"),
    ("VTKFile", "VTK"),
];

/// What a file is that is not read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UnsupportedFormat {
    /// A format with a name.
    Named(&'static str),
    /// A table of numbers, which other commands take.
    Table,
    /// A session, which only some commands open.
    Session,
    /// Nothing that is known: bytes, or a text that is not even like YAML.
    Unknown,
}

impl UnsupportedFormat {
    /// What a file is that is not read, by its content and its ending; `None` for what one of `readers` or the reader of muscles is to look at.
    pub(super) fn of(path: &Path, bytes: &[u8], readers: SceneReaders) -> Option<Self> {
        let head = bytes.get(..HEADER_BYTES).unwrap_or(bytes);
        let text = head.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(head).trim_ascii_start();
        let ending = path.extension().and_then(|ending| ending.to_str()).map(str::to_ascii_lowercase).unwrap_or_default();
        let marked = MAGIC_BYTES.iter().find(|(mark, _)| head.starts_with(mark) || text.starts_with(mark)).map(|(_, name)| *name);
        if let Some(name) = marked.or_else(|| within(head)) {
            // Blender packs its files.
            let by_ending = || EXTENSIONS.iter().find(|(known, _)| *known == ending).map(|(_, name)| *name);
            return Some(Self::Named(if matches!(name, "gzip" | "Zstandard" | "glTF (.glb)") {
                by_ending().unwrap_or(name)
            } else {
                name
            }));
        }
        if starts_as_xml(bytes) {
            return root(text).and_then(|root| ROOT_ELEMENTS.iter().find(|(known, _)| *known == root)).map(|(_, name)| Self::Named(name));
        }
        if text.split(|byte| *byte == b'\n').any(|line| line.starts_with(b"sinew_session:")) {
            return Some(Self::Session);
        }
        if ending == "xml" || readers.extensions().any(|known| known == ending) {
            return None;
        }
        if let Some((_, name)) = EXTENSIONS.iter().find(|(known, _)| *known == ending) {
            return Some(Self::Named(name));
        }
        if readers.know(bytes) {
            return None;
        }
        let lines = std::str::from_utf8(bytes).ok().filter(|text| !text.contains('\0'));
        match lines {
            Some(_) if ending == "csv" => Some(Self::Table),
            Some(text) if looks_like_gltf(text) => Some(Self::Named("glTF")),
            Some(text) if looks_like_obj(text) => Some(Self::Named("OBJ")),
            Some(text) if looks_like_yaml(text) => None,
            _ => Some(Self::Unknown),
        }
    }
}

impl ToMessage for UnsupportedFormat {
    fn message(&self) -> Message {
        match self {
            Self::Named(format) => message!("document-foreign", format = *format),
            Self::Table => message!("document-table"),
            Self::Session => message!("document-session"),
            Self::Unknown => message!("document-unknown"),
        }
    }
}

/// Formats whose mark does not stand at the very start.
fn within(head: &[u8]) -> Option<&'static str> {
    let at = |place: usize, mark: &[u8]| head.get(place..).is_some_and(|rest| rest.starts_with(mark));
    if at(0, b"RIFF") {
        return Some(if at(8, b"WEBP") { "WebP" } else { "AVI" });
    }
    if at(4, b"ftyp") {
        return Some("MP4");
    }
    at(8, b"LWO").then_some("LightWave (.lwo)")
}

/// The name of the first element, without what stands before it; `None` where it does not stand in the head.
fn root(head: &[u8]) -> Option<&str> {
    let mut rest = head;
    loop {
        let start = rest.iter().position(|byte| *byte == b'<')?;
        rest = rest.get(start + 1..)?;
        let skipped: &[u8] = match rest {
            [b'!', b'-', b'-', ..] => b"-->",
            [b'?' | b'!', ..] => b">",
            _ => break,
        };
        let end = rest.windows(skipped.len()).position(|window| window == skipped)?;
        rest = rest.get(end + skipped.len()..)?;
    }
    let length = rest.iter().position(|byte| !byte.is_ascii_alphanumeric() && !b"_-.:".contains(byte))?;
    let name = std::str::from_utf8(rest.get(..length)?).ok()?;
    Some(name.rsplit(':').next().unwrap_or(name))
}

fn looks_like_gltf(text: &str) -> bool {
    text.trim_start().starts_with('{') && text.contains("\"asset\"") && text.contains("\"version\"")
}

/// Whether the first line that says anything is a vertex or what stands before one.
fn looks_like_obj(text: &str) -> bool {
    let mut lines = text.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#'));
    let Some(first) = lines.next() else { return false };
    let mut words = first.split_whitespace();
    matches!(words.next(), Some("v" | "vn" | "vt" | "mtllib" | "o" | "g" | "usemtl")) && words.next().is_some() && !first.contains(':')
}

/// Whether a line begins with a key, or the text with a bracket or what begins a document.
fn looks_like_yaml(text: &str) -> bool {
    let is_key = |line: &str| {
        line.split_once(':').is_some_and(|(key, rest)| {
            let key = key.trim_matches(['"', '\'']);
            !key.is_empty()
                && key.chars().all(|c| c.is_alphanumeric() || "_- ".contains(c))
                && (rest.is_empty() || rest.starts_with([' ', '\t']))
        })
    };
    text.trim_start().starts_with(['{', '[', '%'])
        || text.lines().any(|line| is_key(line) || line.starts_with("---") || line.starts_with("- "))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn named(path: &str, bytes: &[u8]) -> Option<&'static str> {
        match UnsupportedFormat::of(Path::new(path), bytes, SceneReaders::TESTED) {
            Some(UnsupportedFormat::Named(name)) => Some(name),
            Some(UnsupportedFormat::Table) => Some("table"),
            Some(UnsupportedFormat::Session) => Some("session"),
            Some(UnsupportedFormat::Unknown) => Some("unknown"),
            None => None,
        }
    }

    #[test]
    fn what_is_read_is_not_foreign() {
        for ending in SceneReaders::TESTED.extensions() {
            assert!(EXTENSIONS.iter().all(|(foreign, _)| *foreign != ending), "{ending} is read and called foreign");
        }
    }

    #[test]
    fn what_is_not_read_is_named_by_content() {
        for (bytes, name) in [
            (&b"glTF\x02\0\0\0"[..], "glTF (.glb)"),
            (b"# mine\nsinew_session:\n  files: []\n", "session"),
            (b"Kaydara FBX Binary  \0\x1A\0", "FBX"),
            (b"; FBX 7.4.0 project file\n", "FBX"),
            (b"BLENDER-v300", "Blender (.blend)"),
            (b"\xEF\xBB\xBF\nHIERARCHY\nROOT Hips\n", "BVH"),
            (b"#usda 1.0\n", "USD"),
            (b"\x89PNG\r\n\x1A\n\0", "PNG"),
            (b"RIFF\x10\0\0\0WEBPVP8 ", "WebP"),
            (b"\0\0\0\x20ftypisom", "MP4"),
            (b"{\"asset\": {\"version\": \"2.0\"}}", "glTF"),
            (b"# made by hand\nmtllib a.mtl\nv 0 0 0\n", "OBJ"),
            (b"<?xml version=\"1.0\"?>\n<!-- <COLLADA> -->\n<OpenSimDocument Version=\"30000\">", "OpenSim (.osim)"),
            (b"<svg:svg xmlns=", "SVG"),
            (b"\x01\x50\0\0\xFF", "unknown"),
            (b"hello world\n", "unknown"),
        ] {
            assert_eq!(named("-", bytes), Some(name));
        }
        // What it is called does not make it another thing.
        assert_eq!(named("a.dae", b"glTF\x02\0\0\0"), Some("glTF (.glb)"));
        assert_eq!(named("a.vrm", b"glTF\x02\0\0\0"), Some("glTF (.vrm)"));
        assert_eq!(named("a.yaml", b"\x89PNG\r\n\x1A\n\0"), Some("PNG"));
    }

    #[test]
    fn what_is_not_read_is_named_by_its_ending() {
        for (path, bytes, name) in [
            ("a.obj", &b"v 0 0 0\n"[..], "OBJ"),
            ("a.C3D", b"\x02\x50\0\0", "C3D"),
            ("a.stl", b"solid\n", "STL"),
            ("a.usdz", b"PK\x03\x04", "USD"),
            ("a.blend", b"\x28\xB5\x2F\xFD\0\0", "Blender (.blend)"),
            ("a.mot", b"name\nendheader\n", "MOT"),
            ("a.csv", b"node,deg0\n1,2\n", "table"),
            ("a.dat", b"\0\x01\x02", "unknown"),
        ] {
            assert_eq!(named(path, bytes), Some(name), "{path}");
        }
    }

    #[test]
    fn what_is_read_is_left_to_its_reader() {
        for (path, bytes) in [
            ("a.dae", &b"<COLLADA"[..]),
            ("a.fbx", b"<?xml version=\"1.0\"?><COLLADA xmlns=\"x\">"),
            ("a.dae", b"no XML at all"),
            ("a.xml", b"<unheard-of/>"),
            ("a.zae", b"PK\x03\x04"),
            ("-", b"PK\x03\x04"),
            ("-", b"\xFF\xFE<\0C\0"),
            ("a.yaml", b"hello"),
            ("a.yml", b"v 1"),
            ("-", b"muscle_config: {radiuses: [1"),
            ("a", b"# a comment\nmuscles:\n  - name: x\n"),
            ("a.txt", b"{muscles: []}"),
            ("a.json", b"{\"muscles\": []}"),
        ] {
            assert_eq!(named(path, bytes), None, "{path} {}", String::from_utf8_lossy(bytes));
        }
    }
}

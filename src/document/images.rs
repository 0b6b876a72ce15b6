//! Finds and decodes the images that a document names: only by paths relative to it, only regular files, never from a network.

use std::fs;
use std::io::Cursor;
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;

use image::{ImageFormat, ImageReader, Limits};

use super::Images;
use crate::collada::{Loaded, Progress};
use crate::health::Finding;
use crate::scene::Pixels;
use crate::{limits, tr};

/// Code of the finding that an image isn't there.
pub const MISSING: &str = "image-missing";
/// Code of the finding that an image could not be decoded.
pub const BROKEN: &str = "image-broken";

/// Finds the images of `loaded` beside the document in `folder`, or in its archive, and decodes them if asked to.
pub(super) fn load(loaded: &mut Loaded, folder: &Path, what: Images, progress: &Progress) {
    let Loaded { scene, archived, findings, .. } = loaded;
    for image in &mut scene.images {
        if progress.is_cancelled() {
            return;
        }
        let element = format!("<image> {:?}", if image.id.is_empty() { &image.name } else { &image.id });
        let found = match in_archive(archived, &image.uri) {
            Some((path, bytes)) => Some((path.clone(), Some(bytes.as_slice()))),
            None => on_disk(folder, &image.uri).map(|path| (path, None)),
        };
        let Some((path, archived_bytes)) = found else {
            findings.push(Finding::warning(MISSING, image.line, element, tr!("document-image-missing", uri = image.uri.as_str())));
            continue;
        };
        let looked_at = |bytes: &[u8]| match what {
            Images::Decode => decode(bytes, &path).map(Some),
            Images::Locate => look_at(bytes, &path).map(|()| None),
        };
        let seen = match archived_bytes {
            Some(bytes) => looked_at(bytes),
            None => read(&path).and_then(|bytes| looked_at(&bytes)),
        };
        match seen {
            Ok(pixels) => image.pixels = pixels.map(Arc::new),
            Err(reason) => {
                let message = tr!("document-image-broken", uri = image.uri.as_str(), reason = reason);
                findings.push(Finding::warning(BROKEN, image.line, element, message));
            }
        }
        image.archived = archived_bytes.is_some();
        image.path = (!image.archived).then_some(path);
    }
    findings.sort_by_key(|finding| finding.line);
}

fn in_archive<'a>(archived: &'a [(PathBuf, Vec<u8>)], uri: &str) -> Option<&'a (PathBuf, Vec<u8>)> {
    let wanted = Path::new(uri).components().filter(|part| matches!(part, Component::Normal(_))).collect::<PathBuf>();
    archived.iter().find(|(path, _)| *path == wanted).or_else(|| archived.iter().find(|(path, _)| path.file_name() == wanted.file_name()))
}

/// The file that `uri` means: relative to the folder, else by its file name in the folder, whatever its case.
fn on_disk(folder: &Path, uri: &str) -> Option<PathBuf> {
    let uri = Path::new(uri);
    let name = uri.file_name()?;
    let relative = uri.is_relative().then(|| folder.join(uri));
    [relative, Some(folder.join(name))].into_iter().flatten().find(|path| is_image_file(path)).or_else(|| {
        let wanted = name.to_string_lossy().to_lowercase();
        let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        // A folder of many thousands of files is not searched to its end.
        let entries = fs::read_dir(folder).ok()?.take(10_000).flatten();
        let same = |path: &PathBuf| path.file_name().is_some_and(|name| name.to_string_lossy().to_lowercase() == wanted);
        entries.map(|entry| entry.path()).filter(same).find(|path| is_image_file(path))
    })
}

fn is_image_file(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|about| about.is_file())
}

fn read(path: &Path) -> Result<Vec<u8>, String> {
    let length = fs::metadata(path).map_err(|error| error.to_string())?.len();
    if length > limits::IMAGE_BYTES {
        return Err(tr!("document-too-large", limit = limits::IMAGE_BYTES >> 20));
    }
    fs::read(path).map_err(|error| error.to_string())
}

/// A reader of the format that the content shows, else that the file's ending names (TGA has no mark), within the limits.
fn reader<'a>(bytes: &'a [u8], path: &Path) -> Result<ImageReader<Cursor<&'a [u8]>>, String> {
    let mut reader = ImageReader::new(Cursor::new(bytes)).with_guessed_format().map_err(|error| error.to_string())?;
    if reader.format().is_none() {
        let format = ImageFormat::from_path(path).map_err(|error| error.to_string())?;
        reader.set_format(format);
    }
    let mut bounds = Limits::default();
    bounds.max_image_width = Some(limits::IMAGE_SIDE);
    bounds.max_image_height = Some(limits::IMAGE_SIDE);
    bounds.max_alloc = Some(limits::IMAGE_BYTES * 2);
    reader.limits(bounds);
    Ok(reader)
}

/// Reads the head of an image alone: whether it is one.
fn look_at(bytes: &[u8], path: &Path) -> Result<(), String> {
    reader(bytes, path)?.into_dimensions().map(|_| ()).map_err(|error| error.to_string())
}

fn decode(bytes: &[u8], path: &Path) -> Result<Pixels, String> {
    let rgba = reader(bytes, path)?.decode().map_err(|error| error.to_string())?.into_rgba8();
    Ok(Pixels { width: rgba.width(), height: rgba.height(), rgba: rgba.into_raw() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Image, Scene};

    fn png() -> Vec<u8> {
        let mut bytes = Cursor::new(Vec::new());
        image::RgbaImage::from_pixel(2, 1, image::Rgba([10, 20, 30, 255])).write_to(&mut bytes, ImageFormat::Png).expect("encodes");
        bytes.into_inner()
    }

    fn loaded(uri: &str) -> Loaded {
        let image = Image { uri: uri.into(), id: "skin".into(), line: Some(7), ..Image::default() };
        Loaded { scene: Scene { images: vec![image], ..Scene::default() }, ..Loaded::default() }
    }

    #[test]
    fn an_image_is_found_by_its_relative_path_its_name_or_its_name_in_another_case() {
        let folder = tempfile::tempdir().expect("a folder");
        fs::create_dir(folder.path().join("maps")).expect("made");
        fs::write(folder.path().join("maps/Skin.png"), png()).expect("written");
        fs::write(folder.path().join("Other.PNG"), png()).expect("written");
        for uri in ["maps/Skin.png", "/home/artist/Other.PNG", "textures/other.png"] {
            let mut loaded = loaded(uri);
            load(&mut loaded, folder.path(), Images::Decode, &Progress::default());
            let pixels = loaded.scene.images[0].pixels.as_ref().expect(uri);
            assert_eq!((pixels.width, pixels.height, &pixels.rgba[..4]), (2, 1, [10, 20, 30, 255].as_slice()));
            assert!(loaded.findings.is_empty());
        }
    }

    #[test]
    fn a_missing_and_a_broken_image_are_findings_with_their_line() {
        let folder = tempfile::tempdir().expect("a folder");
        fs::write(folder.path().join("bad.png"), b"\x89PNG\r\n\x1a\nxx").expect("written");
        for (uri, code) in [("none.png", MISSING), ("bad.png", BROKEN)] {
            let mut loaded = loaded(uri);
            load(&mut loaded, folder.path(), Images::Decode, &Progress::default());
            assert_eq!(loaded.findings.len(), 1);
            assert_eq!((loaded.findings[0].code, loaded.findings[0].line), (code, Some(7)));
            assert!(loaded.scene.images[0].pixels.is_none());
        }
    }

    #[test]
    fn an_image_in_the_archive_is_used() {
        let mut loaded = loaded("./maps/a.png");
        loaded.archived.push((PathBuf::from("maps/a.png"), png()));
        load(&mut loaded, Path::new("nowhere"), Images::Decode, &Progress::default());
        assert!(loaded.scene.images[0].pixels.is_some());
    }
}

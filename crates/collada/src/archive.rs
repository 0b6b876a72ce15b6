//! `.zae` archives: a zip file with a manifest, documents and images (COLLADA 1.5.0, "The .zae archive").

use std::collections::BTreeMap;
use std::io::{Cursor, Read, Write};
use std::path::PathBuf;

use zip::ZipArchive;

use super::bundle::{Bundle, normal};
use super::lookup::percent_decoded;
use super::{ColladaScene, ReadError, ReadErrorKind, read_document};
use sinew_scene::limits;
use sinew_scene::progress::Progress;

/// Endings of files that textures may use.
const IMAGES: [&str; 9] = ["png", "jpg", "jpeg", "tga", "bmp", "tif", "tiff", "gif", "jpe"];

/// The file that names the root document.
const MANIFEST: &str = "manifest.xml";

type Archive<'a> = ZipArchive<Cursor<&'a [u8]>>;

/// Whether the bytes start like a zip file.
pub(super) fn is_archive(bytes: &[u8]) -> bool {
    bytes.starts_with(b"PK\x03\x04") || bytes.starts_with(b"PK\x05\x06")
}

/// Reads the document that the archive's manifest names, with the documents that it refers to and the images beside it.
///
/// # Errors
/// [`ReadError`] where the archive is broken, unpacks to more than the limit, or has no document.
pub(super) fn read(bytes: &[u8], name: &str, progress: &Progress) -> Result<ColladaScene, ReadError> {
    let mut archive = ZipArchive::new(Cursor::new(bytes)).map_err(|_| ReadErrorKind::ArchiveBroken)?;
    if archive.len() > limits::ARCHIVE_FILES {
        return Err(ReadErrorKind::ArchiveFiles.into());
    }
    // By name without a leading `./`, so that references find them.
    let mut entries = BTreeMap::new();
    for index in 0..archive.len() {
        if let Some(Ok(entry)) = archive.name_for_index(index) {
            entries.entry(normal(&entry)).or_insert(index);
        }
    }
    let mut room = (bytes.len() * (limits::ARCHIVE_BYTES_PER_BYTE - 1) + limits::ARCHIVE_BYTES) as u64;
    let (path, index) = match named_root(&mut archive, &entries, &mut room)? {
        Some(found) => found,
        None => first_document(&entries).ok_or(ReadErrorKind::ArchiveEmpty)?,
    };
    let document = unpack(&mut archive, index, &mut room)?;
    let mut archived = Vec::new();
    for (path, index) in &entries {
        if is_image(path) {
            archived.push((PathBuf::from(path), unpack(&mut archive, *index, &mut room)?));
        }
    }
    let mut bundle = Bundle { path, files: entries, ..Bundle::default() };
    if bundle.files.keys().any(|other| *other != bundle.path && other != MANIFEST && !is_image(other)) {
        let first = super::decode_text::decode(&document);
        let beside = usize::try_from(room).unwrap_or(usize::MAX);
        // Unpacked once here and held once more in the whole.
        bundle.gather(&first.text, beside, |index| {
            let bytes = unpack(&mut archive, index, &mut room)?;
            room = room.checked_sub(bytes.len() as u64).ok_or(ReadErrorKind::ArchiveTooLarge)?;
            Ok(bytes)
        })?;
    }
    let mut loaded = read_document(&document, name, bundle, progress, Some(usize::try_from(room).unwrap_or(usize::MAX)))?;
    loaded.archived.extend(archived);
    Ok(loaded)
}

fn is_image(path: &str) -> bool {
    let ending = path.rsplit('.').next().unwrap_or_default().to_ascii_lowercase();
    IMAGES.contains(&ending.as_str())
}

/// The document that the manifest names, if there is one and it is there.
fn named_root(archive: &mut Archive<'_>, entries: &BTreeMap<String, usize>, room: &mut u64) -> Result<Option<(String, usize)>, ReadError> {
    let Some(manifest) = entries.get(MANIFEST) else { return Ok(None) };
    let bytes = unpack(archive, *manifest, room)?;
    let text = super::decode_text::decode(&bytes);
    let surveyed = super::xml::look_at(&text.text, None)?;
    let parsed = super::xml::parse(&surveyed)?;
    let root = parsed.document.descendants().find(|element| element.tag_name().name() == "dae_root");
    let url = root.and_then(|root| root.text()).unwrap_or_default().trim();
    let path = url.split('#').next().unwrap_or_default();
    let found = [normal(path), normal(&percent_decoded(path))].into_iter().find_map(|path| Some((path.clone(), *entries.get(&path)?)));
    match found {
        None if !path.is_empty() => Err(ReadErrorKind::ArchiveRootMissing(super::context::shortened(path)).into()),
        found => Ok(found),
    }
}

/// Without a manifest: the document nearest to the top.
fn first_document(entries: &BTreeMap<String, usize>) -> Option<(String, usize)> {
    let documents = entries.iter().filter(|(path, _)| path.to_ascii_lowercase().ends_with(".dae"));
    documents.min_by_key(|(path, _)| path.matches('/').count()).map(|(path, index)| (path.clone(), *index))
}

fn unpack(archive: &mut Archive<'_>, index: usize, room: &mut u64) -> Result<Vec<u8>, ReadError> {
    let broken = |_| ReadErrorKind::ArchiveBroken;
    let open = |archive: &mut Archive<'_>, sink: &mut dyn Write| {
        let file = archive.by_index(index).map_err(|_| ReadErrorKind::ArchiveBroken)?;
        std::io::copy(&mut file.take(*room + 1), sink).map_err(broken)
    };
    // What the archive says about sizes may be a lie: only what comes out counts, and it is counted before anything is kept.
    let length = open(archive, &mut std::io::sink())?;
    let left = room.checked_sub(length).ok_or(ReadErrorKind::ArchiveTooLarge)?;
    let mut bytes = Vec::new();
    bytes.try_reserve_exact(usize::try_from(length).unwrap_or(usize::MAX)).map_err(|_| ReadErrorKind::ArchiveTooLarge)?;
    open(archive, &mut bytes)?;
    *room = left;
    Ok(bytes)
}

//! Images of a document: found only by paths relative to a file, only regular files, never from a network, and decoded together
//! within one budget.

use std::cmp::Reverse;
use std::ops::Range;
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;

use rustc_hash::{FxHashMap, FxHashSet};

use super::image_budget::{self, ImageDemand};
use super::image_decoder::{self, ImageHeader, ImageReadError};
use super::image_finding::ImageFinding;
use super::image_paths::{FileImages, ImageLocation, ImageLocator, SharedImages};
use super::{Document, Finding, ImageLoading};
use sinew_scene::diagnostics::Diagnostic;
use sinew_scene::limits;
use sinew_scene::message::SourceName;
use sinew_scene::progress::Progress;
use sinew_scene::{Image, Pixels, Scene, TextureRef};

/// The images of the files that were read so far, which are looked for when all files are there.
#[derive(Debug, Default)]
pub(super) struct PendingImages {
    files: Vec<FileImages>,
}

/// An image file, and the images of the scene that it stands for.
struct FoundImage<'f> {
    place: ImageLocation<'f>,
    head: ImageHeader,
    /// Place of the file in [`PendingImages::files`], and of the image in the scene.
    images: Vec<(usize, usize)>,
}

impl FoundImage<'_> {
    fn decode(&self, size: [u32; 2]) -> Result<Pixels, ImageReadError> {
        image_decoder::decode(self.place.stream()?, self.place.path(), &self.head, size)
    }
}

impl PendingImages {
    /// Keeps for later what a file has: its images in the scene, and image files inside of it.
    pub(super) fn add(&mut self, name: &SourceName, folder: &Path, archived: Vec<(PathBuf, Vec<u8>)>, images: Range<usize>) {
        self.files.push(FileImages { name: name.clone(), folder: folder.to_owned(), archived, images });
    }

    /// Finds the images beside their files, or in them, and decodes them if asked to. What is odd becomes a finding of its file.
    pub(super) fn load(&self, document: &mut Document, what: ImageLoading, progress: &Progress) {
        let mut diagnostics =
            ImageDiagnostics { files: &self.files, findings: vec![Vec::new(); self.files.len()], memory: AffectedImages::default() };
        let scene = &mut document.scene;
        let mut pictures = self.find(scene, &mut diagnostics, progress);
        // What needs most on the way comes first, while nothing else is there.
        pictures.sort_by_key(|picture| Reverse(picture.head.decoding));
        let demands = demands(scene, &pictures);
        let budget = if what == ImageLoading::Decode { memory_budget(&demands) } else { limits::IMAGES_BYTES };
        let (mut tested, mut reduced, mut left_out) = (0, AffectedImages::default(), AffectedImages::default());
        for (picture, size) in pictures.iter().zip(image_budget::sizes(&demands, budget)) {
            if progress.is_cancelled() {
                return;
            }
            let Some(size) = size else {
                left_out.add(&picture.images, [0, 0]);
                continue;
            };
            if picture.head.decoding > limits::IMAGE_DECODING_BYTES {
                diagnostics.about(scene, picture, |uri, size| ImageFinding::DecodingTooLarge { uri, size });
                continue;
            }
            let readable = match what {
                ImageLoading::Decode => decode(scene, picture, size, &mut diagnostics),
                ImageLoading::Test => test(scene, picture, &mut tested, &mut diagnostics),
                ImageLoading::Locate => true,
            };
            if !readable {
                continue;
            }
            if size != picture.head.size {
                reduced.add(&picture.images, size);
            }
        }
        diagnostics.tally(scene, &left_out, |uri, size, _, count| ImageFinding::NoRoom { uri, size, count, budget });
        diagnostics.tally(scene, &reduced, |uri, size, drawn, count| ImageFinding::Reduced { uri, size, drawn, count, budget });
        let memory = std::mem::take(&mut diagnostics.memory);
        diagnostics.tally(scene, &memory, |uri, _, _, count| ImageFinding::NoMemory { uri, count });
        diagnostics.into(document);
    }

    /// Finds the files of all images and reads their heads; each file once, whatever it is called.
    fn find<'f>(&'f self, scene: &mut Scene, diagnostics: &mut ImageDiagnostics<'_>, progress: &Progress) -> Vec<FoundImage<'f>> {
        let mut sharing = SharedImages::default();
        for (number, file) in self.files.iter().enumerate() {
            let mut locator = ImageLocator::of(file);
            let mut missing = Grouped::default();
            for index in file.images.clone() {
                let Some(image) = scene.images.get_mut(index).filter(|_| !progress.is_cancelled()) else { break };
                match locator.find(&image.uri) {
                    Some(place) => {
                        image.archived = place.is_archived();
                        image.path = (!image.archived).then(|| place.path().to_owned());
                        sharing.add(place, (number, index));
                    }
                    None => missing.add(number, index, &image.uri),
                }
            }
            diagnostics.each(scene, missing, |uri, count| ImageFinding::Missing { uri, count });
        }
        let mut pictures = Vec::new();
        for (place, images) in sharing.shared() {
            let header = place.stream().and_then(|stream| image_decoder::read_header(stream, place.path()));
            let refusal = match header {
                Ok(head) => {
                    pictures.push(FoundImage { place, head, images });
                    continue;
                }
                Err(refusal) => refusal,
            };
            diagnostics.refused(scene, &images, &refusal);
        }
        for picture in &pictures {
            for (_, index) in &picture.images {
                if let Some(image) = scene.images.get_mut(*index) {
                    image.size = Some(picture.head.size);
                }
            }
        }
        pictures
    }
}

/// Decodes a picture for all its images; what is wrong with it is told.
fn decode(scene: &mut Scene, picture: &FoundImage<'_>, size: [u32; 2], diagnostics: &mut ImageDiagnostics<'_>) -> bool {
    match picture.decode(size).map(Arc::new) {
        Ok(pixels) => {
            for (_, index) in &picture.images {
                if let Some(image) = scene.images.get_mut(*index) {
                    image.pixels = Some(Arc::clone(&pixels));
                }
            }
            true
        }
        Err(refusal) => {
            diagnostics.refused(scene, &picture.images, &refusal);
            false
        }
    }
}

/// Reads a picture through where it is small enough for that; what is wrong with it is told. `tested` counts the pixels.
fn test(scene: &Scene, picture: &FoundImage<'_>, tested: &mut u64, diagnostics: &mut ImageDiagnostics<'_>) -> bool {
    let [width, height] = picture.head.size.map(u64::from);
    if picture.head.decoding > limits::IMAGE_TESTING_BYTES || *tested + width * height > limits::IMAGES_TESTED {
        return true;
    }
    *tested += width * height;
    match picture.decode([1, 1]) {
        Ok(_) => true,
        Err(refusal) => {
            diagnostics.refused(scene, &picture.images, &refusal);
            false
        }
    }
}

/// What each picture asks for: its size, and the different textures that the materials make of it.
fn demands(scene: &Scene, pictures: &[FoundImage<'_>]) -> Vec<ImageDemand> {
    let mut of_image: Vec<Option<u32>> = vec![None; scene.images.len()];
    for (number, picture) in (0..).zip(pictures) {
        for (_, index) in &picture.images {
            if let Some(of_image) = of_image.get_mut(*index) {
                *of_image = Some(number);
            }
        }
    }
    let mut demands: Vec<ImageDemand> = pictures.iter().map(|picture| ImageDemand { size: picture.head.size, textures: 0 }).collect();
    let mut known = FxHashSet::default();
    let mut count = |texture: &TextureRef, alpha: Option<u8>| {
        let Some(Some(number)) = of_image.get(texture.image.index()) else { return };
        if known.insert((*number, texture.wrap_s as u8, texture.wrap_t as u8, alpha))
            && let Some(wish) = demands.get_mut(*number as usize)
        {
            wish.textures += 1;
        }
    };
    for material in &scene.materials {
        for paint in [&material.diffuse, &material.emission] {
            paint.texture.iter().for_each(|texture| count(texture, None));
        }
        material.opacity_texture.iter().for_each(|(texture, source)| count(texture, Some(*source as u8)));
    }
    demands
}

/// The budget, or as large a part of it as the system would give now.
fn memory_budget(demands: &[ImageDemand]) -> u64 {
    let mut budget = limits::IMAGES_BYTES;
    while budget > 1 << 20 && !limits::is_room(budget.min(image_budget::total(demands))) {
        budget /= 2;
    }
    budget
}

/// Images of the scene by the file that each document calls the same, in the order in which they come.
#[derive(Default)]
struct Grouped {
    /// Place of the document in [`PendingImages::files`], and its images in the scene.
    groups: Vec<(usize, Vec<usize>)>,
    known: FxHashMap<(usize, PathBuf), usize>,
}

impl Grouped {
    /// Adds image `index` of document `file`, which calls it `uri`.
    fn add(&mut self, file: usize, index: usize, uri: &str) {
        let plain = Path::new(uri).components().filter(|part| *part != Component::CurDir).collect();
        let group = *self.known.entry((file, plain)).or_insert(self.groups.len());
        match self.groups.get_mut(group) {
            Some((_, images)) => images.push(index),
            None => self.groups.push((file, vec![index])),
        }
    }
}

/// How many pictures one and the same limit concerns, and the first of them in the order of the files.
#[derive(Default)]
struct AffectedImages {
    count: usize,
    /// Its image, as in [`FoundImage::images`], and the size that it is given.
    first: Option<((usize, usize), [u32; 2])>,
}

impl AffectedImages {
    /// Counts a picture of these images.
    fn add(&mut self, images: &[(usize, usize)], size: [u32; 2]) {
        self.count += 1;
        if let Some(place) = images.iter().min()
            && self.first.is_none_or(|(first, _)| *place < first)
        {
            self.first = Some((*place, size));
        }
    }
}

/// Findings about images, by file. One cause is told once, however many images it concerns.
struct ImageDiagnostics<'f> {
    files: &'f [FileImages],
    findings: Vec<Vec<Diagnostic<Finding>>>,
    /// Pictures that the system gave no memory for.
    memory: AffectedImages,
}

impl ImageDiagnostics<'_> {
    fn of(&mut self, file: usize, image: &Image, finding: ImageFinding) {
        let element = format!("<image> {:?}", if image.id.is_empty() { image.label().plain() } else { image.id.as_str().into() });
        if let (Some(of_file), Some(findings)) = (self.files.get(file), self.findings.get_mut(file)) {
            findings.push(Diagnostic::new(Finding::Image(finding), image.line, element).in_file(of_file.name.clone()));
        }
    }

    /// Tells of each file that images name, with how many do, where the first of them stands.
    fn each(&mut self, scene: &Scene, named: Grouped, finding: impl Fn(String, usize) -> ImageFinding) {
        for (file, images) in named.groups {
            if let Some(image) = images.first().and_then(|first| scene.images.get(*first)) {
                self.of(file, image, finding(image.uri.clone(), images.len()));
            }
        }
    }

    /// Tells why there is none of a picture with these images.
    fn refused(&mut self, scene: &Scene, images: &[(usize, usize)], refusal: &ImageReadError) {
        let reason = match refusal {
            ImageReadError::Memory => return self.memory.add(images, [0, 0]),
            ImageReadError::Broken(reason) => reason,
        };
        let mut named = Grouped::default();
        for (file, index) in images {
            if let Some(image) = scene.images.get(*index) {
                named.add(*file, *index, &image.uri);
            }
        }
        self.each(scene, named, |uri, count| ImageFinding::Broken { uri, count, reason: reason.clone() });
    }

    /// Tells what a limit did to all pictures together, where the first one stands; `finding` gets its name, its size and the one that it is given.
    fn tally(&mut self, scene: &Scene, tally: &AffectedImages, finding: impl Fn(String, [u32; 2], [u32; 2], usize) -> ImageFinding) {
        if let Some(((file, index), given)) = tally.first
            && let Some(image) = scene.images.get(index)
        {
            self.of(file, image, finding(image.uri.clone(), image.size.unwrap_or_default(), given, tally.count));
        }
    }

    /// Tells it once of a picture, where its first image stands.
    fn about(&mut self, scene: &Scene, picture: &FoundImage<'_>, finding: impl Fn(String, [u32; 2]) -> ImageFinding) {
        if let Some((file, index)) = picture.images.first()
            && let Some(image) = scene.images.get(*index)
        {
            self.of(*file, image, finding(image.uri.clone(), picture.head.size));
        }
    }

    /// Puts all among the findings of the document, those of each file together and by line.
    fn into(self, document: &mut Document) {
        if self.findings.iter().all(Vec::is_empty) {
            return;
        }
        for mut findings in self.findings {
            let more = findings.len().saturating_sub(limits::FINDINGS);
            findings.sort_by_key(|finding| finding.line);
            findings.truncate(limits::FINDINGS);
            if let Some(last) = findings.last().filter(|_| more > 0) {
                findings.push(Diagnostic::new(Finding::Image(ImageFinding::More(more)), last.line, "").in_file(last.file.clone()));
            }
            document.diagnostics.extend(findings);
        }
        let sources = &document.sources;
        let place = |finding: &Diagnostic<Finding>| (sources.iter().position(|source| source.name == finding.file), finding.line);
        document.diagnostics.sort_by_cached_key(place);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::{Source, SourceKind};
    use sinew_collada::diagnostic_codes;
    use sinew_i18n as i18n;
    use sinew_scene::{ImageId, Material, Paint, WrapMode};
    use std::fs;
    use std::io::Cursor;

    const MISSING: &str = "image-missing";
    const BROKEN: &str = "image-broken";

    fn png_of(width: u32, height: u32, color: [u8; 4]) -> Vec<u8> {
        let mut bytes = Cursor::new(Vec::new());
        image::RgbaImage::from_pixel(width, height, image::Rgba(color)).write_to(&mut bytes, image::ImageFormat::Png).expect("encodes");
        bytes.into_inner()
    }

    fn png() -> Vec<u8> {
        png_of(2, 1, [10, 20, 30, 255])
    }

    /// A document with an image for each uri, each on the skin of one material.
    fn document(uris: &[&str]) -> Document {
        let mut document = Document::default();
        for (index, uri) in uris.iter().enumerate() {
            let id = format!("skin{index}");
            document.scene.images.push(Image { uri: (*uri).into(), id, line: Some(7), ..Image::default() });
            let texture = TextureRef {
                image: ImageId(index as u32),
                semantic: String::new(),
                wrap_s: WrapMode::Repeat,
                wrap_t: WrapMode::Repeat,
                transform: None,
            };
            let diffuse = Paint { texture: Some(texture), ..Paint::default() };
            document.scene.materials.push(Material { diffuse, ..Material::default() });
        }
        let kind = SourceKind::Scene(sinew_scene::import::Asset::default());
        document.sources.push(Source { name: "a.dae".into(), path: None, root: None, kind });
        document
    }

    fn load(document: &mut Document, folder: &Path, archived: Vec<(PathBuf, Vec<u8>)>) {
        let mut pending = PendingImages::default();
        pending.add(&"a.dae".into(), folder, archived, 0..document.scene.images.len());
        pending.load(document, ImageLoading::Decode, &Progress::default());
    }

    #[test]
    fn an_image_is_found_by_its_relative_path_its_name_or_its_name_in_another_case() {
        let folder = tempfile::tempdir().expect("a folder");
        fs::create_dir(folder.path().join("maps")).expect("made");
        fs::write(folder.path().join("maps/Skin.png"), png()).expect("written");
        fs::write(folder.path().join("Other.PNG"), png()).expect("written");
        for uri in ["maps/Skin.png", "/home/artist/Other.PNG", "textures/other.png"] {
            let mut document = document(&[uri]);
            load(&mut document, folder.path(), Vec::new());
            let pixels = document.scene.images[0].pixels.as_ref().expect(uri);
            assert_eq!((pixels.width, pixels.height, &pixels.rgba[..4]), (2, 1, [10, 20, 30, 255].as_slice()));
            assert!(document.diagnostics.is_empty());
        }
    }

    #[test]
    fn a_missing_and_a_broken_image_are_findings_with_their_line() {
        let folder = tempfile::tempdir().expect("a folder");
        fs::write(folder.path().join("bad.png"), b"\x89PNG\r\n\x1a\nxx").expect("written");
        for (uri, code) in [("none.png", MISSING), ("bad.png", BROKEN)] {
            let mut document = document(&[uri]);
            load(&mut document, folder.path(), Vec::new());
            assert_eq!(document.diagnostics.len(), 1);
            assert_eq!((document.diagnostics[0].code(), document.diagnostics[0].line), (code, Some(7)));
            assert!(document.scene.images[0].pixels.is_none());
        }
    }

    #[test]
    fn an_image_that_breaks_behind_its_head_is_found_by_a_test() {
        let folder = tempfile::tempdir().expect("a folder");
        let whole = png_of(64, 64, [1, 2, 3, 255]);
        fs::write(folder.path().join("whole.png"), &whole).expect("written");
        fs::write(folder.path().join("cut.png"), &whole[..whole.len() - 30]).expect("written");
        let broken = |what: ImageLoading| {
            let mut document = document(&["whole.png", "cut.png", "cut.png"]);
            let mut pending = PendingImages::default();
            pending.add(&"a.dae".into(), folder.path(), Vec::new(), 0..3);
            pending.load(&mut document, what, &Progress::default());
            let kept = document.scene.images.iter().filter(|image| image.pixels.is_some()).count();
            assert_eq!(kept, usize::from(what == ImageLoading::Decode));
            assert!(document.diagnostics.iter().all(|finding| finding.code() == BROKEN && finding.element.to_string().contains("skin")));
            document.diagnostics.len()
        };
        assert_eq!([ImageLoading::Locate, ImageLoading::Test, ImageLoading::Decode].map(broken), [0, 1, 1]);
    }

    #[test]
    fn one_cause_is_told_once_however_many_images_it_concerns() {
        let folder = tempfile::tempdir().expect("a folder");
        fs::write(folder.path().join("bad.png"), b"\x89PNG\r\n\x1a\nxx").expect("written");
        let uris = ["none.png", "bad.png", "./none.png", "other.png", "none.png", "bad.png", "none.png", "none.png"];
        let mut document = document(&uris);
        let mut second = document.sources[0].clone();
        second.name = "b.dae".into();
        document.sources.push(second);
        let mut pending = PendingImages::default();
        pending.add(&"a.dae".into(), folder.path(), Vec::new(), 0..6);
        // Another file names it for itself.
        pending.add(&"b.dae".into(), folder.path(), Vec::new(), 6..8);
        pending.load(&mut document, ImageLoading::Decode, &Progress::default());
        let diagnostics: Vec<_> =
            document.diagnostics.iter().map(|finding| (finding.file.to_string(), finding.code(), i18n::finding(finding))).collect();
        for (file, code, parts) in [
            ("a.dae", MISSING, &["“none.png”", "3 <image>"][..]),
            ("a.dae", MISSING, &["“other.png” was"]),
            ("a.dae", BROKEN, &["“bad.png”", "2 <image>"]),
            ("b.dae", MISSING, &["“none.png”", "2 <image>"]),
        ] {
            let is_it =
                |(of, what, text): &&(String, &str, String)| *of == file && *what == code && parts.iter().all(|part| text.contains(part));
            assert_eq!(diagnostics.iter().filter(is_it).count(), 1, "{file} {code} {parts:?}: {diagnostics:?}");
        }
        assert_eq!(diagnostics.len(), 4, "{diagnostics:?}");
    }

    #[test]
    fn an_image_in_the_archive_is_used() {
        let mut document = document(&["./maps/a.png"]);
        load(&mut document, Path::new("nowhere"), vec![(PathBuf::from("maps/a.png"), png())]);
        assert!(document.scene.images[0].pixels.is_some());
    }

    #[test]
    fn one_file_under_many_names_is_decoded_once() {
        let folder = tempfile::tempdir().expect("a folder");
        for name in ["a.png", "b.png", "c.png"] {
            fs::write(folder.path().join(name), png()).expect("written");
        }
        // As long, but another picture.
        fs::write(folder.path().join("d.png"), png_of(2, 1, [10, 20, 31, 255])).expect("written");
        let mut document = document(&["a.png", "b.png", "./c.png", "d.png", "a.png"]);
        load(&mut document, folder.path(), vec![(PathBuf::from("b.png"), png())]);
        let pixels: Vec<_> = document.scene.images.iter().map(|image| image.pixels.as_ref().expect("decoded")).collect();
        assert!([0, 1, 2, 4].iter().all(|index| Arc::ptr_eq(pixels[0], pixels[*index])));
        assert_eq!(pixels[3].rgba[2], 31);
    }

    #[test]
    fn all_images_of_all_files_share_one_budget_and_what_is_made_smaller_is_told() {
        let folder = tempfile::tempdir().expect("a folder");
        let names: Vec<String> = (0..4_u8).map(|i| format!("k{i}.png")).collect();
        for (name, red) in names.iter().zip(0..) {
            fs::write(folder.path().join(name), png_of(4096, 4096, [red, 0, 0, 255])).expect("written");
        }
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let mut document = document(&names);
        let mut second = document.sources[0].clone();
        second.name = "b.dae".into();
        document.sources.push(second);
        let mut pending = PendingImages::default();
        pending.add(&"a.dae".into(), folder.path(), Vec::new(), 0..2);
        pending.add(&"b.dae".into(), folder.path(), Vec::new(), 2..4);
        pending.load(&mut document, ImageLoading::Decode, &Progress::default());
        let taken: usize = document.scene.images.iter().map(|image| image.pixels.as_ref().map_or(0, |pixels| pixels.rgba.len())).sum();
        assert!((taken + taken * 4 / 3) as u64 <= limits::IMAGES_BYTES);
        for (image, red) in document.scene.images.iter().zip(0..) {
            let pixels = image.pixels.as_ref().expect("smaller, but there");
            assert_eq!((pixels.width, pixels.rgba[0], image.size), (2048, red, Some([4096, 4096])));
        }
        // One limit is told once.
        let [diagnostics] = &document.diagnostics[..] else { panic!("{:?}", document.diagnostics) };
        assert_eq!((diagnostics.code(), diagnostics.file.path()), (diagnostic_codes::LIMIT_REACHED, Some("a.dae")));
        assert!(
            ["4 images", "k0.png", "4096 × 4096", "2048 × 2048"].iter().all(|part| i18n::finding(diagnostics).contains(part)),
            "{}",
            i18n::finding(diagnostics)
        );
        // Looking at the heads alone tells the same.
        let diagnostics = std::mem::take(&mut document.diagnostics);
        document.scene.images.iter_mut().for_each(|image| image.pixels = None);
        pending.load(&mut document, ImageLoading::Locate, &Progress::default());
        assert_eq!(document.diagnostics, diagnostics);
        assert!(document.scene.images.iter().all(|image| image.pixels.is_none()));
    }
}

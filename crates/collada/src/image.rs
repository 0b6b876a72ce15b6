//! `library_images`: what textures refer to.

use std::path::PathBuf;

use roxmltree::NodeId;
use rustc_hash::FxHashMap;

use super::El;
use super::context::{Context, child, id_of, name_of, text_of};
use super::lookup::percent_decoded;
use sinew_scene::{Image, ImageId, Scene};

/// The images that were read.
#[derive(Default)]
pub(super) struct Images {
    by_element: FxHashMap<NodeId, ImageId>,
    by_uri: FxHashMap<String, ImageId>,
    /// Images whose bytes stand in the document itself, under the name that their uri has.
    pub embedded: Vec<(PathBuf, Vec<u8>)>,
}

impl Images {
    /// Reads all images of the libraries.
    pub(super) fn read(context: &mut Context<'_>, scene: &mut Scene) -> Self {
        let mut images = Self::default();
        for element in context
            .libraries("library_images")
            .into_iter()
            .flat_map(|library| library.children())
            .filter(|child| child.tag_name().name() == "image")
        {
            images.place(context, scene, element);
        }
        images
    }

    /// The image of an `image` element.
    pub(super) fn place<'a>(&mut self, context: &mut Context<'a>, scene: &mut Scene, element: El<'a>) -> ImageId {
        if let Some(known) = self.by_element.get(&element.id()) {
            return *known;
        }
        let id = ImageId(scene.images.len() as u32);
        let reference = child(element, "init_from");
        let mut uri = reference.map(|from| plain_uri(&child(from, "ref").map_or_else(|| text_of(from), text_of))).unwrap_or_default();
        uri = context.in_archive(element, uri);
        let bytes = reference.and_then(|from| child(from, "hex")).or_else(|| child(element, "data"));
        if let Some(bytes) = bytes {
            let format = bytes.attribute("format").or_else(|| element.attribute("format")).unwrap_or("png").to_ascii_lowercase();
            uri = format!("image-{}.{format}", id.0);
            self.embedded.push((PathBuf::from(&uri), from_hex(&text_of(bytes))));
        }
        let line = Some(context.report.line(reference.unwrap_or(element)));
        let name = name_of(element);
        scene.images.push(Image { name, id: id_of(element), uri, line, ..Image::default() });
        self.by_element.insert(element.id(), id);
        id
    }

    /// The image that a file name stands for, where a texture names a file instead of an image.
    pub(super) fn place_uri<'a>(&mut self, context: &mut Context<'a>, scene: &mut Scene, element: El<'a>, text: &str) -> ImageId {
        let uri = context.in_archive(element, plain_uri(text));
        if let Some(known) = self.by_uri.get(&uri) {
            return *known;
        }
        let id = ImageId(scene.images.len() as u32);
        let line = Some(context.report.line(element));
        scene.images.push(Image { name: uri.clone(), uri: uri.clone(), line, ..Image::default() });
        self.by_uri.insert(uri, id);
        id
    }
}

/// A reference to a file as a plain path with slashes: blanks round it, `file://`, percent escapes and backslashes resolved.
pub(super) fn plain_uri(text: &str) -> String {
    let text = text.trim();
    let (scheme, path) = match text.get(..5) {
        Some(scheme) if scheme.eq_ignore_ascii_case("file:") => (true, text.get(5..).unwrap_or_default()),
        _ => (false, text),
    };
    let path = percent_decoded(path).replace('\\', "/");
    if !scheme {
        return path;
    }
    // file://host/path, file:///path, file:/path, and file:///C:/path on Windows.
    let local = match path.strip_prefix("//") {
        Some(rest) if rest.starts_with('/') || rest.get(1..2) == Some(":") => rest,
        Some(rest) => rest.find('/').and_then(|at| rest.get(at..)).unwrap_or(rest),
        None => &path,
    };
    match local.strip_prefix('/') {
        Some(drive) if drive.get(1..2) == Some(":") => drive.to_owned(),
        _ => local.to_owned(),
    }
}

fn from_hex(text: &str) -> Vec<u8> {
    let mut digits = text.chars().filter_map(|c| c.to_digit(16)).map(|digit| digit as u8);
    let mut bytes = Vec::with_capacity(text.len() / 2);
    while let (Some(high), Some(low)) = (digits.next(), digits.next()) {
        bytes.push(high << 4 | low);
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::plain_uri;

    #[test]
    fn references_become_plain_paths() {
        for (given, wanted) in [
            (" ./duck.tga\n", "./duck.tga"),
            ("character%20Texture.png", "character Texture.png"),
            ("..\\maps\\a b.png", "../maps/a b.png"),
            ("file:///C:/maps/a%20b.png", "C:/maps/a b.png"),
            ("file://C:/maps/a.png", "C:/maps/a.png"),
            ("FILE:///home/a.png", "/home/a.png"),
            ("file:/home/a.png", "/home/a.png"),
            ("file://host/maps/a.png", "/maps/a.png"),
            ("file:a.png", "a.png"),
            ("100%.png", "100%.png"),
            ("", ""),
        ] {
            assert_eq!(plain_uri(given), wanted, "{given}");
        }
    }
}

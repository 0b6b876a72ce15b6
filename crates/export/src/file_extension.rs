//! File extensions.

use std::path::{Path, PathBuf};

/// The extension of a file name in lower case, empty where it has none.
pub fn extension(file: &Path) -> String {
    file.extension().map(|extension| extension.to_string_lossy().to_lowercase()).unwrap_or_default()
}

/// The name with one of the extensions `endings`: the first is appended where it has none of them. The name itself is kept,
/// since `walk.v2` is a name and a picture called `walk.dae` would be taken for a clip.
pub fn with_extension(file: &Path, endings: &[&str]) -> PathBuf {
    let known = endings.contains(&extension(file).as_str());
    match endings.first() {
        Some(first) if !known => {
            let mut name = file.as_os_str().to_owned();
            // A name that ends in a point has its point already.
            name.push(if name.as_encoded_bytes().ends_with(b".") { "" } else { "." });
            name.push(first);
            name.into()
        }
        _ => file.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_get_the_ending_of_what_they_hold() {
        for (name, endings, expected) in [
            ("pic", &["png"][..], "pic.png"),
            ("a/pic.PNG", &["png"], "a/pic.PNG"),
            ("pic.dae", &["png"], "pic.dae.png"),
            ("pic.", &["png"], "pic.png"),
            ("walk.v2", &["yaml", "yml"], "walk.v2.yaml"),
            ("b.YML", &["yaml", "yml"], "b.YML"),
            (".hidden", &["yaml", "yml"], ".hidden.yaml"),
            ("plain", &[], "plain"),
        ] {
            assert_eq!(with_extension(Path::new(name), endings), PathBuf::from(expected), "{name}");
        }
        assert_eq!((extension(Path::new("a.PnG")), extension(Path::new("a"))), ("png".into(), String::new()));
    }
}

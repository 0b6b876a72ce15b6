//! Names of numbered files.

use std::path::{Path, PathBuf};

/// File names with a number: `frame-%04d.png`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FilePattern {
    folder: PathBuf,
    before: String,
    digits: usize,
    after: String,
    second: bool,
}

impl FilePattern {
    /// Finds the first `%d` or `%04d` in the name of a file, `%%` being a plain `%` beside it; `None` where there is none, and then `%` is an ordinary
    /// character, as it is in the names of folders.
    pub fn of(file: &Path) -> Option<Self> {
        let folder = file.parent().unwrap_or(Path::new("")).to_owned();
        let (before, digits, after) = find_number(file.file_name()?.to_str()?)?;
        Some(Self { folder, before, digits, second: find_number(after).is_some(), after: after.replace("%%", "%") })
    }

    /// Whether the pattern has a second number, which cannot be filled.
    pub fn has_second(&self) -> bool {
        self.second
    }

    /// The name of file `number`.
    pub fn file(&self, number: usize) -> PathBuf {
        self.folder.join(format!("{}{number:0digits$}{}", self.before, self.after, digits = self.digits))
    }
}

/// The text before the first number, its digits, and the text after it.
fn find_number(name: &str) -> Option<(String, usize, &str)> {
    let mut before = String::new();
    let mut rest = name;
    loop {
        let (plain, found) = rest.split_once('%')?;
        before.push_str(plain);
        let after = found.trim_start_matches(|c: char| c.is_ascii_digit());
        let digits = found.strip_suffix(after).unwrap_or_default();
        if let Some(after) = after.strip_prefix('d')
            && digits.len() <= 2
        {
            return Some((before, digits.parse().unwrap_or(0), after));
        }
        before.push('%');
        rest = found.strip_prefix('%').unwrap_or(found);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patterns_are_filled_with_the_number() {
        let file = |name: &str, number| FilePattern::of(Path::new(name)).map(|pattern| pattern.file(number));
        assert_eq!(file("frame-%04d.png", 7), Some(PathBuf::from("frame-0007.png")));
        assert_eq!(file("%d.png", 12), Some(PathBuf::from("12.png")));
        assert_eq!(file("50%%-%02d.png", 3), Some(PathBuf::from("50%-03.png")));
        assert_eq!(file("%03d.png", 12345), Some(PathBuf::from("12345.png")));
        assert_eq!(file("/a/100%done/f-%d.png", 1), Some(PathBuf::from("/a/100%done/f-1.png")));
        for plain in ["picture.png", "50%.png", "%s.png", "%%04d.png", "%999d.png", "%", "%d%", "100%done/f.png"] {
            let expected = (plain == "%d%").then(|| PathBuf::from("0%"));
            assert_eq!(file(plain, 0), expected, "{plain}");
        }
    }

    #[test]
    fn a_second_number_is_seen() {
        for (name, second) in [
            ("%d-%d.png", true),
            ("a%04d%2dx.png", true),
            ("%d-%%d.png", false),
            ("%d%.png", false),
            ("%d/%d.png", false),
            ("%d.png", false),
        ] {
            assert_eq!(FilePattern::of(Path::new(name)).map(|pattern| pattern.has_second()), Some(second), "{name}");
        }
    }
}

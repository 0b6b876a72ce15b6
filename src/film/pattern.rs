//! The names of numbered files.

use std::path::PathBuf;

/// The names of a row of files: `frame-%04d.png`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Pattern {
    before: String,
    digits: usize,
    after: String,
}

impl Pattern {
    /// Finds the first `%d` or `%04d` in a name, `%%` being a plain `%` beside it; `None` where there is none, and then `%` is an ordinary
    /// character.
    pub fn of(name: &str) -> Option<Self> {
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
                return Some(Self { before, digits: digits.parse().unwrap_or(0), after: after.replace("%%", "%") });
            }
            before.push('%');
            rest = found.strip_prefix('%').unwrap_or(found);
        }
    }

    /// The name of file `number`.
    pub fn file(&self, number: usize) -> PathBuf {
        PathBuf::from(format!("{}{number:0digits$}{}", self.before, self.after, digits = self.digits))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patterns_are_filled_with_the_number() {
        let file = |name: &str, number| Pattern::of(name).map(|pattern| pattern.file(number));
        assert_eq!(file("frame-%04d.png", 7), Some(PathBuf::from("frame-0007.png")));
        assert_eq!(file("%d.png", 12), Some(PathBuf::from("12.png")));
        assert_eq!(file("50%%-%02d.png", 3), Some(PathBuf::from("50%-03.png")));
        assert_eq!(file("%03d.png", 12345), Some(PathBuf::from("12345.png")));
        for plain in ["picture.png", "50%.png", "%s.png", "%%04d.png", "%999d.png", "%", "%d%"] {
            let expected = (plain == "%d%").then(|| PathBuf::from("0%"));
            assert_eq!(file(plain, 0), expected, "{plain}");
        }
    }
}

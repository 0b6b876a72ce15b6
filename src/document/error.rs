//! Why a file could not be opened.

use std::fmt::Write;

/// Why a file could not be used. Displays as one line: `file:line:column: what`.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{}", self.sentence())]
pub struct OpenError {
    /// The file, as the user named it.
    pub file: String,
    /// Line from 1.
    pub line: Option<u32>,
    /// Column from 1.
    pub column: Option<u32>,
    /// What is wrong and what would be right, in the user's language.
    pub message: String,
}

impl OpenError {
    /// An error about the file as a whole.
    pub fn whole(file: &str, message: String) -> Self {
        Self { file: file.to_owned(), line: None, column: None, message }
    }

    fn sentence(&self) -> String {
        let mut text = self.file.clone();
        for number in [self.line, self.column].into_iter().flatten() {
            // Writing to a string cannot fail.
            let _ = write!(text, ":{number}");
        }
        let _ = write!(text, ": {}", self.message);
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_stands_before_the_sentence() {
        let error = OpenError { file: "arm.yaml".into(), line: Some(3), column: Some(7), message: "Too short.".into() };
        assert_eq!(error.to_string(), "arm.yaml:3:7: Too short.");
        assert_eq!(OpenError::whole("a.dae", "Empty.".into()).to_string(), "a.dae: Empty.");
    }
}

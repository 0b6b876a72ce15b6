//! Tables of text for the terminal.

use std::fmt::Write as _;

use crate::i18n;

/// Right-aligned columns.
pub(super) fn columns(rows: &[Vec<String>]) -> String {
    let count = rows.iter().map(Vec::len).max().unwrap_or(0);
    let widths: Vec<usize> =
        (0..count).map(|i| rows.iter().filter_map(|row| row.get(i)).map(|cell| cell.chars().count()).max().unwrap_or(0)).collect();
    let mut text = String::new();
    for row in rows {
        for (cell, width) in row.iter().zip(&widths) {
            let _ = write!(text, "  {:>width$}", i18n::shown(cell));
        }
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_line_up() {
        let rows = [vec!["°".to_owned(), "мм".to_owned()], vec!["10".to_owned(), "3".to_owned()]];
        assert_eq!(columns(&rows), "   °  мм\n  10   3\n");
    }
}

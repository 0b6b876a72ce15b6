//! Measured radii: a CSV with a column `node` and one column an angle, `deg0`, `deg30` …

use std::fs::{self, File};
use std::io::Read;
use std::path::Path;

use super::failure::{Failure, display_name};
use crate::{limits, tr};

/// Radii by node and angle.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// Elbow angles, degrees, as the columns stand.
    pub angles: Vec<f64>,
    /// One row a node, one radius an angle.
    pub radii: Vec<Vec<f64>>,
}

/// What is wrong with a table, and where.
#[derive(Debug, PartialEq)]
struct Complaint {
    line: usize,
    /// From 1, in characters.
    column: usize,
    message: String,
}

/// Reads a table from a regular file.
///
/// # Errors
/// [`Failure::Files`] with `file:line:column: what`.
pub fn read(file: &Path) -> Result<Table, Failure> {
    let text = text(file)?;
    parse(&text).map_err(|complaint| {
        Failure::Files(vec![format!("{}:{}:{}: {}", display_name(file), complaint.line, complaint.column, complaint.message)])
    })
}

fn text(file: &Path) -> Result<String, Failure> {
    let io = |error: std::io::Error| {
        let sentence = match error.kind() {
            std::io::ErrorKind::NotFound => tr!("document-not-found"),
            std::io::ErrorKind::PermissionDenied => tr!("document-permission"),
            _ => tr!("document-io", reason = error.to_string()),
        };
        Failure::file(file, sentence)
    };
    // Asked before opening: to open a named pipe would wait for its writer.
    let about = fs::metadata(file).map_err(io)?;
    if !about.is_file() {
        return Err(Failure::file(file, if about.is_dir() { tr!("document-folder") } else { tr!("document-not-regular") }));
    }
    let mut bytes = Vec::new();
    File::open(file).and_then(|open| open.take(limits::YAML_BYTES + 1).read_to_end(&mut bytes)).map_err(io)?;
    if bytes.len() as u64 > limits::YAML_BYTES {
        return Err(Failure::file(file, tr!("document-too-large", limit = limits::YAML_BYTES >> 20)));
    }
    String::from_utf8(bytes).map_err(|_| Failure::file(file, tr!("cli-table-not-text")))
}

/// Reads a table; lines that start with `#` and empty ones are left out.
fn parse(text: &str) -> Result<Table, Complaint> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut lines = text.lines().zip(1..).filter(|(line, _)| !line.trim().is_empty() && !line.trim_start().starts_with('#'));
    let (header, line) = lines.next().ok_or_else(|| Complaint { line: 1, column: 1, message: tr!("cli-table-empty") })?;
    let mut head = cells(header);
    let about_header = |column| Complaint { line, column, message: tr!("cli-table-header") };
    let first = head.next().ok_or_else(|| about_header(1))?;
    if !first.text.eq_ignore_ascii_case("node") {
        return Err(about_header(first.column));
    }
    let angle = |cell: Cell<'_>| {
        let degrees = cell.text.strip_prefix("deg").and_then(|degrees| degrees.parse().ok()).filter(|degrees: &f64| degrees.is_finite());
        degrees.ok_or_else(|| about_header(cell.column))
    };
    let angles = head.map(angle).collect::<Result<Vec<_>, _>>()?;
    if angles.is_empty() {
        return Err(about_header(header.chars().count() + 1));
    }
    let mut radii = Vec::new();
    for (text, line) in lines {
        if radii.len() == limits::MUSCLE_NODES {
            let message = tr!("cli-table-too-long", limit = limits::MUSCLE_NODES as f64);
            return Err(Complaint { line, column: 1, message });
        }
        radii.push(row(text, line, radii.len() + 1, angles.len())?);
    }
    if radii.is_empty() { Err(Complaint { line, column: 1, message: tr!("cli-table-empty") }) } else { Ok(Table { angles, radii }) }
}

/// The radii of one row, which must be that of node `number`.
fn row(text: &str, line: usize, number: usize, count: usize) -> Result<Vec<f64>, Complaint> {
    let mut row = cells(text);
    let node = row.next().and_then(|cell| cell.text.parse::<usize>().ok());
    if node != Some(number) {
        return Err(Complaint { line, column: 1, message: tr!("cli-table-node", number = number) });
    }
    let radius = |cell: Cell<'_>| {
        let value = cell.text.parse().ok().filter(|radius: &f64| radius.is_finite() && *radius > 0.0);
        value.ok_or_else(|| Complaint { line, column: cell.column, message: tr!("cli-table-radius", text = cell.text.to_owned()) })
    };
    let radii = row.map(radius).collect::<Result<Vec<_>, _>>()?;
    if radii.len() == count {
        Ok(radii)
    } else {
        Err(Complaint { line, column: text.chars().count() + 1, message: tr!("cli-table-width", found = radii.len(), wanted = count) })
    }
}

struct Cell<'a> {
    text: &'a str,
    column: usize,
}

fn cells(line: &str) -> impl Iterator<Item = Cell<'_>> {
    let mut column = 1;
    line.split(',').map(move |cell| {
        let blanks = cell.chars().take_while(|c| c.is_whitespace()).count();
        let found = Cell { text: cell.trim(), column: column + blanks };
        column += cell.chars().count() + 1;
        found
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_blanks_and_windows_line_ends_are_fine() {
        let table = parse("\u{feff}# measured\r\nnode, deg0,deg22.5\r\n\r\n1, 7.6,8\r\n2,18.2, 19\r\n");
        assert_eq!(table, Ok(Table { angles: vec![0.0, 22.5], radii: vec![vec![7.6, 8.0], vec![18.2, 19.0]] }));
    }

    #[test]
    fn mistakes_have_their_place() {
        for (text, line, column) in [
            ("", 1, 1),
            ("radius,deg0\n1,2\n", 1, 1),
            ("node\n1\n", 1, 5),
            ("node,0\n1,2\n", 1, 6),
            ("node,deg0\n", 1, 1),
            ("node,deg0,degx\n1,2,3\n", 1, 11),
            ("node,deg0\n2,5\n", 2, 1),
            ("node,deg0\n1,5\n2, -5\n", 3, 4),
            ("node,deg0\n1,nan\n", 2, 3),
            ("node,deg0,deg5\n1,5\n", 2, 4),
            ("node;deg0\n1;5\n", 1, 1),
        ] {
            let complaint = parse(text).expect_err(text);
            assert_eq!((complaint.line, complaint.column), (line, column), "{text:?}: {}", complaint.message);
        }
    }
}

//! Tables of measured radii: comma-separated text with a row a node and a column an angle.

use sinew_scene::limits;
use sinew_scene::message;
use sinew_scene::message::{Message, ToMessage};

/// Radii of a muscle's nodes at several angles.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Table {
    /// Angles, degrees, rising.
    pub angles: Vec<f64>,
    /// One row a node, one radius an angle.
    pub radii: Vec<Vec<f64>>,
}

/// Why text is no table of radii, and where.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{}", self.message())]
pub struct TableError {
    /// Line from 1.
    pub line: u32,
    /// Column from 1, in characters.
    pub column: u32,
    /// What is wrong.
    pub kind: TableErrorKind,
}

/// What is wrong with a table of radii.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum TableErrorKind {
    /// It has no rows.
    Empty,
    /// The heading does not name rising angles.
    Heading,
    /// It has more rows than [`limits::MUSCLE_NODES`].
    TooLong,
    /// A row does not begin with this number of a node.
    NodeNumber(usize),
    /// A cell that is no radius.
    Radius(String),
    /// A row has another number of radii than the heading has angles.
    Width {
        /// Radii of the row.
        found: usize,
        /// Angles of the heading.
        wanted: usize,
    },
}

impl ToMessage for TableError {
    fn message(&self) -> Message {
        self.kind.message()
    }
}

impl ToMessage for TableErrorKind {
    fn message(&self) -> Message {
        match self {
            Self::Empty => message!("muscle-table-empty"),
            Self::Heading => message!("muscle-table-heading"),
            Self::TooLong => message!("muscle-table-too-long", limit = limits::MUSCLE_NODES),
            Self::NodeNumber(number) => message!("muscle-table-node", number = number),
            Self::Radius(text) => message!("muscle-table-radius", text = text),
            Self::Width { found, wanted } => message!("muscle-table-width", found = found, wanted = wanted),
        }
    }
}

impl Table {
    /// Reads comma-separated text: a heading `node,deg0,deg30,…`, a row a node in order, `#` before remarks.
    ///
    /// # Errors
    /// [`TableError`] with line and column.
    pub fn parse(text: &str) -> Result<Self, TableError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let mut lines = text.lines().zip(1..).filter(|(line, _)| !line.trim().is_empty() && !line.trim_start().starts_with('#'));
        let (header, line) = lines.next().ok_or_else(|| error(1, 1, TableErrorKind::Empty))?;
        let angles = heading(header, line)?;
        let mut radii: Vec<Vec<f64>> = Vec::new();
        let mut first = None;
        for (text, line) in lines {
            if radii.len() == limits::MUSCLE_NODES {
                return Err(error(line, 1, TableErrorKind::TooLong));
            }
            // Rows are numbered from 1, or from 0 by those who count so.
            let number = cells(text).next().and_then(|cell| cell.text.parse::<usize>().ok());
            let start = *first.get_or_insert(number.filter(|number| *number == 0).unwrap_or(1));
            if number != Some(start + radii.len()) {
                return Err(error(line, 1, TableErrorKind::NodeNumber(start + radii.len())));
            }
            radii.push(row(text, line, angles.len())?);
        }
        if radii.is_empty() { Err(error(line, 1, TableErrorKind::Empty)) } else { Ok(Self { angles, radii }) }
    }

    /// Radii of all nodes at angle number `angle`.
    pub(super) fn column(&self, angle: usize) -> Vec<f64> {
        self.radii.iter().filter_map(|row| row.get(angle).copied()).collect()
    }
}

fn error(line: usize, column: usize, kind: TableErrorKind) -> TableError {
    let number = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
    TableError { line: number(line), column: number(column), kind }
}

fn heading(text: &str, line: usize) -> Result<Vec<f64>, TableError> {
    let wrong = |column| error(line, column, TableErrorKind::Heading);
    let mut head = cells(text);
    let first = head.next().ok_or_else(|| wrong(1))?;
    if !first.text.eq_ignore_ascii_case("node") {
        return Err(wrong(first.column));
    }
    let mut angles: Vec<f64> = Vec::new();
    for cell in head {
        let degrees = cell.text.strip_prefix("deg").and_then(|degrees| degrees.parse().ok()).filter(|degrees: &f64| degrees.is_finite());
        let degrees = degrees.filter(|degrees| angles.last().is_none_or(|last| last < degrees));
        angles.push(degrees.ok_or_else(|| wrong(cell.column))?);
    }
    if angles.is_empty() { Err(wrong(text.chars().count() + 1)) } else { Ok(angles) }
}

fn row(text: &str, line: usize, count: usize) -> Result<Vec<f64>, TableError> {
    let radius = |cell: Cell<'_>| {
        let value = cell.text.parse().ok().filter(|radius: &f64| *radius > 0.0 && *radius <= 1e9);
        value.ok_or_else(|| error(line, cell.column, TableErrorKind::Radius(cell.text.to_owned())))
    };
    let radii = cells(text).skip(1).map(radius).collect::<Result<Vec<f64>, _>>()?;
    if radii.len() == count {
        return Ok(radii);
    }
    Err(error(line, text.chars().count() + 1, TableErrorKind::Width { found: radii.len(), wanted: count }))
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
        let table = Table::parse("\u{feff}# measured\r\nnode, deg0,deg22.5\r\n\r\n1, 7.6,8\r\n2,18.2, 19\r\n");
        assert_eq!(table, Ok(Table { angles: vec![0.0, 22.5], radii: vec![vec![7.6, 8.0], vec![18.2, 19.0]] }));
        assert_eq!(Table::parse("node,deg0\n0,1\n1,2\n").map(|table| table.radii.len()), Ok(2));
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
            ("node,deg0,deg0\n1,2,3\n", 1, 11),
            ("node,deg0\n2,5\n", 2, 1),
            ("node,deg0\n0,5\n2,5\n", 3, 1),
            ("node,deg0\n1,5\n2, -5\n", 3, 4),
            ("node,deg0\n1,nan\n", 2, 3),
            ("node,deg0,deg5\n1,5\n", 2, 4),
            ("node;deg0\n1;5\n", 1, 1),
        ] {
            let error = Table::parse(text).expect_err(text);
            assert_eq!((error.line, error.column), (line, column), "{text:?}: {error}");
        }
    }
}

//! Measured radii from a file.

use std::path::Path;

use super::output::{Failure, display_name};
use crate::i18n::Sentence;
use crate::input::{self, Refused};
use crate::muscle::validation::Table;
use crate::{limits, tr};

/// Reads a table from a regular file, or from standard input for `-`.
///
/// # Errors
/// [`Failure::Files`] with `file:line:column: what`.
pub(super) fn read(file: &Path) -> Result<Table, Failure> {
    let text = text(file)?;
    Table::parse(&text)
        .map_err(|error| Failure::Files(vec![format!("{}:{}:{}: {}", display_name(file), error.line, error.column, error.sentence())]))
}

fn text(file: &Path) -> Result<String, Failure> {
    input::read_argument(file, limits::YAML_BYTES).and_then(input::text).map_err(|refused| match refused {
        Refused::NotText(_) => Failure::file(file, tr!("cli-table-not-text")),
        refused => Failure::file(file, refused.sentence()),
    })
}

//! Measured radii from a file.

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;

use super::failure::{Failure, display_name};
use crate::muscle::experiment::Table;
use crate::{limits, tr};

/// Reads a table from a regular file, or from standard input for `-`.
///
/// # Errors
/// [`Failure::Files`] with `file:line:column: what`.
pub fn read(file: &Path) -> Result<Table, Failure> {
    let text = text(file)?;
    Table::parse(&text)
        .map_err(|error| Failure::Files(vec![format!("{}:{}:{}: {}", display_name(file), error.line, error.column, error.message)]))
}

fn text(file: &Path) -> Result<String, Failure> {
    let io = |error: io::Error| {
        let sentence = match error.kind() {
            io::ErrorKind::NotFound => tr!("document-not-found"),
            io::ErrorKind::PermissionDenied => tr!("document-permission"),
            _ => tr!("document-io", reason = error.to_string()),
        };
        Failure::file(file, sentence)
    };
    let mut bytes = Vec::new();
    if file.as_os_str() == "-" {
        io::stdin().lock().take(limits::YAML_BYTES + 1).read_to_end(&mut bytes).map_err(io)?;
    } else {
        // Asked before opening: to open a named pipe would wait for its writer.
        let about = fs::metadata(file).map_err(io)?;
        if !about.is_file() {
            return Err(Failure::file(file, if about.is_dir() { tr!("document-folder") } else { tr!("document-not-regular") }));
        }
        File::open(file).and_then(|open| open.take(limits::YAML_BYTES + 1).read_to_end(&mut bytes)).map_err(io)?;
    }
    if bytes.len() as u64 > limits::YAML_BYTES {
        return Err(Failure::file(file, tr!("document-too-large", limit = limits::YAML_BYTES >> 20)));
    }
    String::from_utf8(bytes).map_err(|_| Failure::file(file, tr!("cli-table-not-text")))
}

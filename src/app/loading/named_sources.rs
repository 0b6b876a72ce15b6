//! The open files in the order in which a person names them.

use crate::document::{Document, Source, SourceKind};

/// The open files, the one that the others belong to first: clips before muscles, else as they were named.
pub(crate) fn sources(document: &Document) -> Vec<&Source> {
    let mut sources: Vec<&Source> = document.sources.iter().collect();
    sources.sort_by_key(|source| !matches!(source.kind, SourceKind::Scene(_)));
    sources
}

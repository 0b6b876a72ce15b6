//! What was found about the images of a document.

use sinew_scene::diagnostics::{DiagnosticKind, Severity};
use sinew_scene::limits;
use sinew_scene::message;
use sinew_scene::message::{Message, ToMessage};

/// What was found about an image, or about `count` of them of which `uri` is the first.
#[derive(Debug, Clone, PartialEq)]
pub enum ImageFinding {
    /// There is no such file; the plain colour is drawn instead.
    Missing {
        /// As the file names it.
        uri: String,
        /// How many elements name it.
        count: usize,
    },
    /// The file could not be decoded; the plain colour is drawn instead.
    Broken {
        /// As the file names it.
        uri: String,
        /// How many elements name it.
        count: usize,
        /// What the decoder said.
        reason: Message,
    },
    /// Decoding it would take more than [`limits::IMAGE_DECODING_BYTES`]; it is ignored.
    DecodingTooLarge {
        /// As the file names it.
        uri: String,
        /// Columns and rows.
        size: [u32; 2],
    },
    /// The budget of all images has no room for it; it is ignored.
    NoRoom {
        /// As the file names it.
        uri: String,
        /// Columns and rows.
        size: [u32; 2],
        /// How many images are ignored.
        count: usize,
        /// The budget, bytes.
        budget: u64,
    },
    /// It is drawn smaller, so that all images fit into their budget.
    Reduced {
        /// As the file names it.
        uri: String,
        /// Columns and rows.
        size: [u32; 2],
        /// Columns and rows that are drawn.
        drawn: [u32; 2],
        /// How many images are drawn smaller.
        count: usize,
        /// The budget, bytes.
        budget: u64,
    },
    /// The system gave no memory for it; the plain colour is drawn instead.
    NoMemory {
        /// As the file names it.
        uri: String,
        /// How many images are concerned.
        count: usize,
    },
    /// So many more findings about images are not kept.
    More(usize),
}

impl ToMessage for ImageFinding {
    fn message(&self) -> Message {
        match self {
            Self::Missing { uri, count } => message!("document-image-missing", uri = uri, count = count),
            Self::Broken { uri, count, reason } => message!("document-image-broken", uri = uri, reason = reason.clone(), count = count),
            Self::DecodingTooLarge { uri, size: [width, height] } => {
                message!("document-image-decoding", uri = uri, width = width, height = height, limit = limits::IMAGE_DECODING_BYTES >> 20)
            }
            Self::NoRoom { uri, size: [width, height], count, budget } => {
                message!("document-image-no-room", uri = uri, width = width, height = height, limit = budget >> 20, count = count)
            }
            Self::Reduced { uri, size: [width, height], drawn: [columns, rows], count, budget } => message!(
                "document-image-reduced",
                uri = uri,
                width = width,
                height = height,
                columns = columns,
                rows = rows,
                limit = budget >> 20,
                count = count
            ),
            Self::NoMemory { uri, count } => message!("document-image-memory", uri = uri, count = count),
            Self::More(count) => message!("collada-more-findings", count = count, limit = limits::FINDINGS),
        }
    }
}

impl DiagnosticKind for ImageFinding {
    fn code(&self) -> &'static str {
        match self {
            Self::Missing { .. } => "image-missing",
            Self::Broken { .. } => "image-broken",
            Self::DecodingTooLarge { .. } | Self::NoRoom { .. } | Self::Reduced { .. } | Self::NoMemory { .. } => "limit-reached",
            Self::More(_) => "more-findings",
        }
    }

    fn severity(&self) -> Severity {
        if matches!(self, Self::More(_)) { Severity::Info } else { Severity::Warning }
    }
}

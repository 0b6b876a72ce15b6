//! What the parser says of the slips that people make, and the key of how a person would say it.

use crate::tr;

/// Beginnings or parts of the parser's sentences, the particular ones first.
const REASONS: [(&str, &str); 27] = [
    ("mapping values are not allowed", "document-yaml-reason-colon"),
    ("illegal placement of ':'", "document-yaml-reason-colon"),
    ("simple key expect", "document-yaml-reason-no-colon"),
    ("did not find expected key", "document-yaml-reason-key"),
    ("mapping keys are not allowed", "document-yaml-reason-key"),
    ("parsing a flow sequence", "document-yaml-reason-list"),
    ("parsing a flow mapping", "document-yaml-reason-map"),
    ("misplaced bracket", "document-yaml-reason-bracket"),
    ("did not find expected '-'", "document-yaml-reason-dash"),
    ("block sequence entries are not allowed", "document-yaml-reason-dash-here"),
    ("is only valid inside a block", "document-yaml-reason-dash-here"),
    ("tab", "document-yaml-reason-character"),
    ("unexpected character", "document-yaml-reason-character"),
    ("cannot start with '-'", "document-yaml-reason-character"),
    ("unprintable character", "document-yaml-reason-control"),
    ("byte order mark", "document-yaml-reason-control"),
    ("found unexpected end of stream", "document-yaml-reason-end"),
    ("unexpected eof", "document-yaml-reason-end"),
    ("escape", "document-yaml-reason-escape"),
    ("hexadecimal", "document-yaml-reason-escape"),
    ("unknown anchor", "document-yaml-reason-anchor"),
    ("anchor", "document-yaml-reason-anchor-here"),
    ("indentation", "document-yaml-reason-indentation"),
    ("indented", "document-yaml-reason-indentation"),
    ("directive", "document-yaml-reason-directive"),
    ("tag", "document-yaml-reason-tag"),
    ("expected <document", "document-yaml-reason-after"),
];

/// The sentence for what the parser says.
pub(super) fn sentence(info: &str) -> String {
    let known = REASONS.iter().find(|(theirs, _)| info.contains(theirs));
    tr!("document-yaml-syntax", reason = tr!(known.map_or("document-yaml-reason-content", |(_, key)| key)))
}

/// Whether the parser speaks of a colon that is out of place.
pub(super) fn is_about_colon(info: &str) -> bool {
    REASONS.iter().find(|(theirs, _)| info.contains(theirs)).is_some_and(|(_, key)| *key == "document-yaml-reason-colon")
}

//! From the parser's English sentences to [`SyntaxReason`].

use super::SyntaxReason::{self, *};

/// Beginnings or parts of the parser's sentences, the particular ones first.
const REASONS: [(&str, SyntaxReason); 27] = [
    ("mapping values are not allowed", Colon),
    ("illegal placement of ':'", Colon),
    ("simple key expect", NoColon),
    ("did not find expected key", Key),
    ("mapping keys are not allowed", Key),
    ("parsing a flow sequence", List),
    ("parsing a flow mapping", Map),
    ("misplaced bracket", Bracket),
    ("did not find expected '-'", NoDash),
    ("block sequence entries are not allowed", Dash),
    ("is only valid inside a block", Dash),
    ("tab", Character),
    ("unexpected character", Character),
    ("cannot start with '-'", Character),
    ("unprintable character", Control),
    ("byte order mark", Control),
    ("found unexpected end of stream", End),
    ("unexpected eof", End),
    ("escape", Escape),
    ("hexadecimal", Escape),
    ("unknown anchor", UnknownAnchor),
    ("anchor", Anchor),
    ("indentation", Indentation),
    ("indented", Indentation),
    ("directive", Directive),
    ("tag", Tag),
    ("expected <document", AfterEnd),
];

/// What the parser means by its sentence `info`.
pub(super) fn reason(info: &str) -> SyntaxReason {
    REASONS.iter().find(|(theirs, _)| info.contains(theirs)).map_or(Value, |(_, reason)| *reason)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{YamlErrorKind, read};

    #[test]
    fn slips_of_the_hand_have_their_reasons() {
        for (text, reason) in [
            ("a: b: c", Colon),
            ("a: 1\nb\nc: 2", NoColon),
            ("a: 1\n b: 2\n  - c", Colon),
            ("a:\n  - 1\n  b: 2", NoDash),
            ("a: [1, 2\nb: 3", List),
            ("a: {b: 1\nc: [", Map),
            ("a: - 1", Dash),
            ("a:\n\t- 1", Character),
            ("a: \"b", End),
            ("a: 1\n- c", Key),
            ("a: [", Value),
        ] {
            assert_eq!(read(text, 100).expect_err(text).kind, YamlErrorKind::Syntax(reason), "{text:?}");
        }
    }
}

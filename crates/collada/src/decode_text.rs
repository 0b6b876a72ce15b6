//! Bytes to text: byte order marks, UTF-16, named encodings, line ends.

use std::borrow::Cow;

use encoding_rs::{Encoding, UTF_8, UTF_16BE, UTF_16LE, WINDOWS_1252};

/// A document as text with `\n` line ends.
pub(super) struct Decoded<'a> {
    /// The text; starts at the XML declaration or the first tag.
    pub text: Cow<'a, str>,
    /// Blank lines that were dropped before the XML declaration.
    pub lines_before: u32,
    /// The encoding that the bytes did not fit, if so; they were read as Windows-1252.
    pub misfit: Option<String>,
}

/// Decodes a document. Never fails: bytes that fit no encoding become replacement characters.
pub(super) fn decode(bytes: &[u8]) -> Decoded<'_> {
    let (text, misfit) = to_text(bytes);
    // Some exporters write the zero that ends their strings.
    let text = match unix_lines(text) {
        Cow::Borrowed(text) => Cow::Borrowed(text.trim_end_matches('\0')),
        Cow::Owned(mut text) => {
            text.truncate(text.trim_end_matches('\0').len());
            Cow::Owned(text)
        }
    };
    let start = text.len() - text.trim_start().len();
    let lines_before = text.get(..start).map_or(0, |blank| blank.bytes().filter(|b| *b == b'\n').count() as u32);
    let text = match text {
        Cow::Borrowed(text) => Cow::Borrowed(text.get(start..).unwrap_or_default()),
        Cow::Owned(mut text) => {
            text.drain(..start);
            Cow::Owned(text)
        }
    };
    Decoded { text, lines_before, misfit }
}

fn to_text(bytes: &[u8]) -> (Cow<'_, str>, Option<String>) {
    if let Some((encoding, mark)) = Encoding::for_bom(bytes) {
        let body = bytes.get(mark..).unwrap_or_default();
        if encoding != UTF_8 {
            return (encoding.decode_without_bom_handling(body).0, None);
        }
        return utf8_or_windows(body, "UTF-8");
    }
    match bytes {
        // A tag in UTF-16 without a mark.
        [b'<', 0, ..] => return (UTF_16LE.decode_without_bom_handling(bytes).0, None),
        [0, b'<', ..] => return (UTF_16BE.decode_without_bom_handling(bytes).0, None),
        _ => {}
    }
    match declared_encoding(bytes) {
        Some(name) => match Encoding::for_label(name.as_bytes()) {
            // A declaration that can be read byte by byte cannot be UTF-16, whatever it says.
            Some(encoding) if encoding != UTF_8 && encoding != UTF_16LE && encoding != UTF_16BE => {
                (encoding.decode_without_bom_handling(bytes).0, None)
            }
            _ => utf8_or_windows(bytes, &name),
        },
        None => utf8_or_windows(bytes, "UTF-8"),
    }
}

fn utf8_or_windows<'a>(bytes: &'a [u8], named: &str) -> (Cow<'a, str>, Option<String>) {
    match std::str::from_utf8(bytes) {
        Ok(text) => (Cow::Borrowed(text), None),
        Err(_) => (WINDOWS_1252.decode_without_bom_handling(bytes).0, Some(named.to_owned())),
    }
}

/// The encoding that the XML declaration names.
fn declared_encoding(bytes: &[u8]) -> Option<String> {
    let head = bytes.get(..bytes.len().min(256))?;
    let head: String = head.iter().map(|b| if b.is_ascii() { char::from(*b) } else { '?' }).collect();
    let declaration = head.trim_start().strip_prefix("<?xml")?;
    let declaration = declaration.get(..declaration.find("?>")?)?;
    let (_, value) = declaration.split_once("encoding")?;
    let value = value.trim_start().strip_prefix('=')?.trim_start();
    let quote = value.chars().next().filter(|c| *c == '"' || *c == '\'')?;
    value.get(1..)?.split(quote).next().map(|name| name.trim().to_owned())
}

/// `\r\n` and lone `\r` to `\n`, as XML asks; done here because the parser's own way is slow.
fn unix_lines(text: Cow<'_, str>) -> Cow<'_, str> {
    if memchr::memchr(b'\r', text.as_bytes()).is_none() {
        return text;
    }
    let mut clean = String::with_capacity(text.len());
    let mut rest = text.as_ref();
    while let Some(at) = memchr::memchr(b'\r', rest.as_bytes()) {
        let (before, after) = rest.split_at(at);
        clean.push_str(before);
        clean.push('\n');
        let after = after.strip_prefix('\r').unwrap_or(after);
        rest = after.strip_prefix('\n').unwrap_or(after);
    }
    clean.push_str(rest);
    Cow::Owned(clean)
}

#[cfg(test)]
mod tests {
    use super::decode;

    #[test]
    fn marks_utf16_and_named_encodings_are_decoded() {
        let wide: Vec<u8> = "<é/>".encode_utf16().flat_map(u16::to_le_bytes).collect();
        assert_eq!(decode(&wide).text, "<é/>");
        let mut marked = vec![0xFE, 0xFF];
        marked.extend("<é/>".encode_utf16().flat_map(u16::to_be_bytes));
        assert_eq!(decode(&marked).text, "<é/>");
        assert_eq!(decode(b"\xEF\xBB\xBF<a/>").text, "<a/>");
        let latin = decode(b"<?xml version='1.0' encoding='ISO-8859-1'?><a n='\xE9'/>");
        assert!(latin.text.ends_with("<a n='é'/>") && latin.misfit.is_none());
    }

    #[test]
    fn bytes_that_are_not_utf8_are_read_as_windows_1252_and_said_so() {
        let decoded = decode(b"<a n='\xE9'/>");
        assert_eq!(decoded.text, "<a n='é'/>");
        assert_eq!(decoded.misfit.as_deref(), Some("UTF-8"));
    }

    #[test]
    fn line_ends_become_unix_ones_and_leading_blank_lines_are_counted() {
        let decoded = decode(b"\r\n\r\n<a>\r\n\r</a>\r");
        assert_eq!(decoded.text, "<a>\n\n</a>\n");
        assert_eq!(decoded.lines_before, 2);
    }
}

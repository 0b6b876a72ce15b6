//! The two forms of a file: `.glb`, one binary; `.gltf`, JSON with the binary inside as base64.

use std::io::{self, Write};

use base64::Engine;
use serde_json::Value;

/// Writes the binary form (glTF 2.0, section 4.4): a header, the JSON, the buffer.
pub(super) fn binary(out: &mut impl Write, root: &Value, bytes: &[u8]) -> io::Result<()> {
    let mut text = serde_json::to_vec(root)?;
    text.resize(text.len().next_multiple_of(4), b' ');
    let padding = bytes.len().next_multiple_of(4) - bytes.len();
    let has_buffer = !bytes.is_empty();
    let total = 12 + 8 + text.len() + if has_buffer { 8 + bytes.len() + padding } else { 0 };
    let length = |length: usize| u32::try_from(length).map(u32::to_le_bytes).map_err(|_| io::Error::from(io::ErrorKind::FileTooLarge));
    out.write_all(b"glTF")?;
    out.write_all(&2_u32.to_le_bytes())?;
    out.write_all(&length(total)?)?;
    out.write_all(&length(text.len())?)?;
    out.write_all(b"JSON")?;
    out.write_all(&text)?;
    if has_buffer {
        out.write_all(&length(bytes.len() + padding)?)?;
        out.write_all(b"BIN\0")?;
        out.write_all(bytes)?;
        out.write_all(&[0; 3][..padding])?;
    }
    Ok(())
}

/// Writes the text form, whole in one file.
pub(super) fn text(out: &mut impl Write, root: &mut Value, bytes: &[u8]) -> io::Result<()> {
    if !bytes.is_empty() {
        let inside = base64::engine::general_purpose::STANDARD.encode(bytes);
        root["buffers"][0]["uri"] = format!("data:application/octet-stream;base64,{inside}").into();
    }
    serde_json::to_writer_pretty(&mut *out, root)?;
    out.write_all(b"\n")
}

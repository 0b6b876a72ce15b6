//! Any text at all is a session or is refused; what was read is written and read back the same, and shows any document.
#![no_main]

use std::path::Path;

use libfuzzer_sys::fuzz_target;
use sinew::document::{Document, PoseBuffers};
use sinew::scene::Frame;
use sinew::view::SessionState;

fuzz_target!(|text: &str| {
    let Some(Ok(saved)) = SessionState::parse(text) else { return };
    let written = saved.to_yaml().expect("a session can be written");
    let again = SessionState::parse(&written).and_then(Result::ok).unwrap_or_else(|| panic!("what was written is refused:\n{written}"));
    // As text, since no number that is none equals itself.
    assert_eq!(again.to_yaml().ok().as_deref(), Some(written.as_str()));
    assert!(saved.paths(Path::new("")).iter().all(|path| path.as_os_str() != "-"));
    let mut document = Document::built_in();
    saved.apply_to_document(&mut document);
    let state = saved.pose_state(&document);
    let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
    document.pose(&state, &mut buffers, &mut frame);
    let _ = saved.view_state(&document, &state, &frame.bounds, &frame.bounds);
    let _ = saved.camera.and_then(|camera| camera.orbit(&frame.bounds));
});

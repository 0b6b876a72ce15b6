//! Any text at all is read as settings and as muscles kept for recovery, or is refused; what was read is written and read back the same.
#![no_main]

use libfuzzer_sys::fuzz_target;
use sinew::view::{Settings, RecoveryFile};

fuzz_target!(|text: &str| {
    if let Ok(settings) = Settings::parse(text) {
        let written = settings.to_yaml().expect("settings can be written");
        assert_eq!(Settings::parse(&written).as_ref(), Ok(&settings), "written:\n{written}");
    }
    if let Ok(unsaved) = RecoveryFile::parse(text) {
        let written = unsaved.to_yaml().expect("what is kept can be written");
        assert_eq!(RecoveryFile::parse(&written).as_ref(), Ok(&unsaved), "written:\n{written}");
        let _ = unsaved.muscle_files();
    }
});

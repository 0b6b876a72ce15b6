//! The formats of scene files that the program reads: a new one is the crate of its reader and one line here.

use crate::collada::ColladaReader;
use crate::document::SceneReaders;

/// The readers of scene files.
pub const SCENE_READERS: SceneReaders = SceneReaders::new(&[&ColladaReader]);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_readers_want_the_same_ending() {
        let mut all: Vec<&str> = SCENE_READERS.extensions().collect();
        let count = all.len();
        all.sort_unstable();
        all.dedup();
        assert_eq!(all.len(), count);
    }
}

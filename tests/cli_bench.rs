//! `sinew bench`: that it runs and reports; the figures are the machine's.

mod support;

use support::sinew;

#[test]
fn every_scene_is_timed() {
    let report = sinew(["bench", "--seconds", "0.01", "--threads", "1", "--json"]).json();
    assert_eq!(report["threads"], 1);
    assert!(report["simd"].as_str().is_some_and(|name| !name.is_empty()));
    let scenes = report["scenes"].as_array().expect("a list");
    assert!(scenes.len() > 3);
    for scene in scenes {
        let (least, median) = (scene["min_ms"].as_f64().expect("a number"), scene["median_ms"].as_f64().expect("a number"));
        assert!(0.0 < least && least <= median, "{scene}");
    }
    let text = sinew(["bench", "--seconds", "0.01"]).well();
    for scene in scenes {
        assert!(text.contains(scene["name"].as_str().expect("a name")), "{text}");
    }
}

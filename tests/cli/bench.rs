//! `sinew bench`: that it runs and reports; the figures are the machine's.

use crate::support::sinew;

#[test]
fn every_scene_is_timed() {
    let report = sinew(["bench", "configs/lamp.dae", "--seconds", "0.01", "--threads", "1", "--json"]).json();
    assert_eq!(report["threads"], 1);
    assert!(report["simd"].as_str().is_some_and(|name| !name.is_empty()));
    for part in ["clear_ms", "z_pass_ms", "memcpy_ms"] {
        assert!(report["floor"][part].as_f64().is_some_and(|ms| ms > 0.0), "{part}");
    }
    let scenes = report["scenes"].as_array().expect("a list");
    for name in ["sphere-10k", "sphere-100k", "sphere-1m", "biceps", "lamp.dae"] {
        assert!(scenes.iter().any(|scene| scene["scene"] == name), "{name}");
    }
    for scene in scenes {
        let number = |name: &str| scene[name].as_f64().unwrap_or_else(|| panic!("{name} of {scene}"));
        assert!(0.0 < number("min_ms") && number("min_ms") <= number("median_ms"), "{scene}");
        assert!(number("triangles") > 0.0 && (1.0..=number("width") * number("height")).contains(&number("lit_pixels")), "{scene}");
        for stage in ["pose_ms", "vertex_ms", "raster_ms", "resolve_ms"] {
            assert!(scene["stages"][stage].as_f64().is_some_and(|ms| ms >= 0.0), "{stage} of {scene}");
        }
        assert!(scene["view"].is_string() && scene["shading"].is_string());
    }
}

#[test]
fn scenes_can_be_chosen() {
    let text = sinew(["bench", "--seconds", "0.01", "--scene", "10k fill phong"]).well();
    assert!(text.contains("sphere-10k fill phong") && !text.contains("100k") && !text.contains("biceps"), "{text}");
}

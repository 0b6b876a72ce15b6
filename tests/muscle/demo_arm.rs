//! The demo arm: at rest its muscles and bones lie inside its skin, and it has the measures of a human arm.

use glam::DVec3;
use sinew::document::PoseBuffers;
use sinew::scene::{Frame, Surface};

use crate::flesh::{Solid, demo, positions};

/// Tissue between the muscles and the skin, metres.
const TISSUE: f64 = 0.003;

/// The surfaces of a demo at rest: of the skin, of everything beneath it.
fn at_rest(name: &str, check: impl Fn(&Surface, &[&Surface])) {
    let document = demo(name);
    let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
    document.pose(&document.start_state(), &mut buffers, &mut frame);
    let (skin, beneath): (Vec<&Surface>, Vec<&Surface>) = frame.surfaces.iter().partition(|surface| surface.mesh.name.contains("arm"));
    assert_eq!(skin.len(), 1, "{name} has one skin");
    check(skin[0], &beneath);
}

#[test]
fn muscles_and_bones_lie_inside_the_skin() {
    for (name, count) in [("curl-muscles.yaml", 2), ("atlas-muscles.yaml", 3)] {
        at_rest(name, |skin, beneath| {
            assert_eq!(beneath.len(), count);
            let skin = Solid::of(skin);
            for surface in beneath {
                let reach = if surface.muscle.is_some() { TISSUE } else { 0.0 };
                let around = [DVec3::X, DVec3::Y, DVec3::Z].into_iter().flat_map(|axis| [axis * reach, axis * -reach]);
                for point in positions(surface).into_iter().step_by(5) {
                    let inside = around.clone().all(|shift| skin.contains(point + shift));
                    assert!(inside, "{name}: {} comes nearer to the skin than {reach} m at {point}", surface.mesh.name);
                }
            }
        });
    }
}

/// Length of the outline in which a plane at this height cuts a surface, metres.
fn girth(surface: &Surface, height: f64) -> f64 {
    let corners = positions(surface);
    let cuts = surface.mesh.triangles.iter().map(|triangle| {
        let sides = [(0, 1), (1, 2), (2, 0)].map(|(a, b)| [triangle[a], triangle[b]].map(|corner| corners[corner as usize]));
        let crossed: Vec<DVec3> = sides
            .into_iter()
            .filter(|[a, b]| (a.y < height) != (b.y < height))
            .map(|[a, b]| a.lerp(b, (height - a.y) / (b.y - a.y)))
            .collect();
        if let [a, b] = crossed[..] { a.distance(b) } else { 0.0 }
    });
    cuts.sum()
}

#[test]
fn its_girths_are_those_of_an_adult() {
    // Height of the cut, the least and the greatest girth, metres: middle of the upper arm, elbow, thickest of the forearm, wrist.
    let measures = [(0.600, 0.27, 0.32), (0.450, 0.25, 0.28), (0.395, 0.25, 0.285), (0.205, 0.15, 0.18)];
    at_rest("curl.dae", |skin, _| {
        for (height, least, greatest) in measures {
            let found = girth(skin, height);
            assert!((least..greatest).contains(&found), "{found} m round at {height} m");
        }
        let tops = positions(skin).iter().map(|point| point.y).fold(f64::NEG_INFINITY, f64::max);
        assert!((0.33..0.37).contains(&(tops - 0.450)), "from the elbow to the top of the shoulder");
    });
}

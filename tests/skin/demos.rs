//! The demos that have muscles under a skin.

use glam::DVec3;
use sinew::document::{Document, PoseBuffers, PoseState, SkinMotion};
use sinew::formats::SCENE_READERS;
use sinew::progress::Progress;
use sinew::scene::{Frame, NodeId, SurfaceGeometry};

use crate::figures::{Shape, crossing_pairs, skins};
use crate::support::config;

fn demo(name: &str) -> Document {
    Document::open(&[config(name)], SCENE_READERS, &Progress::default()).unwrap()
}

#[test]
#[ignore = "prints figures"]
fn figures() {
    for name in std::env::var("DEMOS").unwrap_or("curl-muscles.yaml,atlas-muscles.yaml".into()).split(',') {
        let document = demo(name);
        println!("== {name}: under skin {:?} of {}", document.muscles_under_skin(), document.muscle_count());
        let joint = document.joint().unwrap();
        let start = document.start_state();
        let clip = &document.clips[0];
        let times = (0..=((clip.end - clip.start) / 0.5) as usize)
            .map(|step| (format!("t {:.1}", 0.5 * step as f64), start.at_time(clip.start + 0.5 * step as f64)));
        let steps = ((joint.range[1] - joint.range[0]) / 7.5) as usize;
        let angles = (0..=steps).map(|step| joint.range[0] + 7.5 * step as f64);
        let angles = angles.map(|angle| (format!("{angle} deg"), PoseState::default().with_rotation(Some(joint.absolute(angle)))));
        let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
        let (mut plain_buffers, mut plain) = (PoseBuffers::default(), Frame::default());
        let (mut rest_buffers, mut rest) = (PoseBuffers::default(), Frame::default());
        document.pose(&PoseState::default(), &mut rest_buffers, &mut rest);
        for (label, state) in times.chain(angles) {
            let timer = std::time::Instant::now();
            document.pose(&state, &mut buffers, &mut frame);
            let took = timer.elapsed().as_secs_f64() * 1e3;
            let timer = std::time::Instant::now();
            document.pose(&PoseState { skin: SkinMotion::Skeleton, ..state.clone() }, &mut plain_buffers, &mut plain);
            let took_plain = timer.elapsed().as_secs_f64() * 1e3;
            for index in skins(&rest) {
                let (skin, bare) = (Shape::of(&frame.surfaces[index]), Shape::of(&plain.surfaces[index]));
                let moves: Vec<f64> = skin.points.iter().zip(&bare.points).map(|(a, b)| a.distance(*b)).collect();
                let most = moves.iter().copied().fold(0.0, f64::max);
                let normal = |v: usize| match &plain.surfaces[index].geometry {
                    SurfaceGeometry::Deformed { normals, .. } => normals[v].as_dvec3(),
                    _ => DVec3::ZERO,
                };
                let sink = (0..moves.len()).map(|v| (skin.points[v] - bare.points[v]).dot(normal(v))).fold(0.0, f64::min);
                let turned = |other: &Shape| {
                    other
                        .triangles
                        .iter()
                        .zip(&bare.triangles)
                        .filter(|(a, b)| {
                            let n = |s: &Shape, t: &[u32; 3]| {
                                let [a, b, c] = t.map(|p| s.points[p as usize]);
                                (b - a).cross(c - a)
                            };
                            n(other, a).dot(n(&bare, b)) < 0.0
                        })
                        .count()
                };
                let mut outside = String::new();
                for surface in frame.surfaces.iter().filter(|surface| surface.muscle.is_some()) {
                    let belly = Shape::of_part(surface, 0).used();
                    let belly: Vec<DVec3> = belly.into_iter().step_by(7).collect();
                    let tendons: Vec<DVec3> =
                        (1..surface.mesh.parts.len()).flat_map(|part| Shape::of_part(surface, part).used()).step_by(7).collect();
                    outside += &format!(
                        " {:.1}({:.1})/{:.1}({:.1})",
                        100.0 * skin.share_outside(&belly),
                        100.0 * bare.share_outside(&belly),
                        100.0 * skin.share_outside(&tendons),
                        100.0 * bare.share_outside(&tendons)
                    );
                }
                // A stretch of the upper arm clear of the joint.
                let upper = document.scene.graph.node(joint.node).parent().unwrap();
                let at = |frame: &Frame, node: NodeId| frame.world[node.index()].w_axis.truncate();
                let at_rest = Shape::of(&rest.surfaces[index]);
                let (a, b) = (at(&rest, upper), at(&rest, joint.node));
                let own = |s: &Shape| Shape {
                    points: s.points.clone(),
                    triangles: s
                        .triangles
                        .iter()
                        .filter(|t| {
                            t.iter().all(|v| at_rest.points.get(*v as usize).is_none_or(|p| (*p - a).dot(b - a) < (b - a).length_squared()))
                        })
                        .copied()
                        .collect(),
                };
                let volume = |frame: &Frame, s: &Shape| s.volume_between(at(frame, upper), at(frame, joint.node), [0.25, 0.75]);
                let muscles =
                    |frame: &Frame| frame.surfaces.iter().filter(|s| s.muscle.is_some()).map(|s| volume(frame, &Shape::of(s))).sum::<f64>();
                let rest_volume = volume(&rest, &own(&at_rest));
                let (dv, dm) = (volume(&frame, &own(&skin)) - rest_volume, muscles(&frame) - muscles(&rest));
                println!(
                    "{label:10} outside belly/tendon %{outside}; most {:.1} mm sink {:.1}; turned {}; crossing {} ({}); dV {:.2} % dM {:.2} % diff {:.2} %; {took:.2} ms ({took_plain:.2})",
                    1e3 * most,
                    1e3 * sink,
                    turned(&skin),
                    crossing_pairs(&skin),
                    crossing_pairs(&bare),
                    100.0 * dv / rest_volume,
                    100.0 * dm / rest_volume,
                    100.0 * (dv - dm) / rest_volume
                );
            }
        }
    }
}

#[test]
#[ignore = "prints figures"]
fn turned() {
    let document = demo(&std::env::var("DEMOS").unwrap());
    let joint = document.joint().unwrap();
    let angle: f64 = std::env::var("ANGLE").unwrap().parse().unwrap();
    let state = PoseState::default().with_rotation(Some(joint.absolute(angle)));
    let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
    let (mut plain_buffers, mut plain) = (PoseBuffers::default(), Frame::default());
    let (mut rest_buffers, mut rest) = (PoseBuffers::default(), Frame::default());
    document.pose(&PoseState::default(), &mut rest_buffers, &mut rest);
    document.pose(&state, &mut buffers, &mut frame);
    document.pose(&PoseState { skin: SkinMotion::Skeleton, ..state }, &mut plain_buffers, &mut plain);
    let upper = document.scene.graph.node(joint.node).parent().unwrap();
    for index in skins(&rest) {
        let (skin, bare, still) = (Shape::of(&frame.surfaces[index]), Shape::of(&plain.surfaces[index]), Shape::of(&rest.surfaces[index]));
        let inside = rest.world[upper.index()].inverse();
        let here = frame.world[upper.index()].inverse();
        for (number, t) in skin.triangles.iter().enumerate() {
            let n = |s: &Shape| {
                let [a, b, c] = t.map(|p| s.points[p as usize]);
                (b - a).cross(c - a)
            };
            if n(&skin).dot(n(&bare)) < 0.0 {
                println!("triangle {number}");
                for v in t {
                    let v = *v as usize;
                    let mm = |p: DVec3| (p * 1e4).round() / 10.0;
                    println!(
                        "   v{v} rest {} bare {} move {}",
                        mm(inside.transform_point3(still.points[v])),
                        mm(here.transform_point3(bare.points[v])),
                        mm(here.transform_vector3(skin.points[v] - bare.points[v]))
                    );
                }
            }
        }
    }
}

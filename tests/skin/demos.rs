//! The demos that have muscles under a skin, over their clips and over the range of their joint.

use glam::DVec3;
use sinew::document::{Document, PoseState};
use sinew::formats::SCENE_READERS;
use sinew::muscle::presets::PRESETS;
use sinew::progress::Progress;
use sinew::scene::{Frame, NodeId, Surface};
use sinew::session::{LoadMode, Session};

use crate::figures::{Shape, crossing_pairs};
use crate::posed::{Posed, bent};
use crate::support::{config, left_out, shared};

const ARMS: [&str; 2] = ["curl-muscles.yaml", "atlas-muscles.yaml"];

fn demo(name: &str) -> Document {
    Document::open(&[config(name)], SCENE_READERS, &Progress::default()).unwrap()
}

/// The skin of an arm: the largest of the surfaces that bones bend.
fn skin_of(posed: &Posed<'_>) -> usize {
    let moved = |index: &usize| posed.moves(*index).iter().any(|by| *by != DVec3::ZERO);
    posed.skins().into_iter().find(moved).unwrap()
}

/// Poses at every so many degrees, each with its angle.
fn angles(document: &Document, step: f64) -> Vec<(f64, PoseState)> {
    let range = document.joint().unwrap().range;
    let count = ((range[1] - range[0]) / step) as u32;
    (0..=count).map(|number| range[0] + step * f64::from(number)).map(|angle| (angle, bent(document, angle))).collect()
}

#[test]
fn no_belly_comes_out_of_the_skin_at_any_angle_or_moment() {
    for name in ARMS {
        let document = demo(name);
        assert_eq!(document.muscles_under_skin().len(), document.muscle_count());
        let mut posed = Posed::new(&document);
        posed.at(&bent(&document, 60.0));
        let skin = skin_of(&posed);
        let clip = &document.clips[0];
        let times = (0..=(clip.duration() / 0.2) as u32).map(|step| document.start_state().at_time(clip.start + 0.2 * f64::from(step)));
        let states: Vec<PoseState> = angles(&document, 5.0).into_iter().map(|(_, state)| state).chain(times).collect();
        let mut plain = 0.0_f64;
        for state in states {
            posed.at(&state);
            let [belly, tendons] = posed.outside(skin, 5);
            assert!(belly == 0.0 && tendons <= 0.015, "{name}: {belly} {tendons} at {state:?}");
            std::mem::swap(&mut posed.frame, &mut posed.plain);
            plain = plain.max(posed.outside(skin, 25)[1]);
            std::mem::swap(&mut posed.frame, &mut posed.plain);
        }
        // By the skeleton alone tendons do come out.
        assert!(plain > 0.1, "{name}: {plain}");
    }
}

/// The part of a surface whose triangles lie beside the upper arm at rest, between these shares of its length.
fn stretch(frame: &Frame, rest: &Frame, index: usize, ends: [NodeId; 2]) -> f64 {
    let place = |frame: &Frame, node: NodeId| frame.world[node.index()].w_axis.truncate();
    let at_rest = Shape::of(&rest.surfaces[index]);
    let (from, to) = (place(rest, ends[0]), place(rest, ends[1]));
    let beside = |vertex: &u32| (at_rest.points[*vertex as usize] - from).dot(to - from) < (to - from).length_squared();
    let mut shape = Shape::of(&frame.surfaces[index]);
    shape.triangles.retain(|triangle| triangle.iter().all(beside));
    shape.volume_between(place(frame, ends[0]), place(frame, ends[1]), [0.25, 0.75])
}

#[test]
fn the_upper_arm_changes_its_volume_by_what_its_muscles_change() {
    for name in ARMS {
        let document = demo(name);
        let joint = document.joint().unwrap().node;
        let ends = [document.scene.graph.node(joint).parent().unwrap(), joint];
        let (mut rest, mut posed) = (Posed::new(&document), Posed::new(&document));
        rest.at(&PoseState::default());
        posed.at(&bent(&document, 60.0));
        let skin = skin_of(&posed);
        let muscles: Vec<usize> = (0..rest.frame.surfaces.len()).filter(|index| rest.frame.surfaces[*index].muscle.is_some()).collect();
        let volumes = |frame: &Frame| {
            let place = |node: NodeId| frame.world[node.index()].w_axis.truncate();
            let muscle = |index: &usize| Shape::of(&frame.surfaces[*index]).volume_between(place(ends[0]), place(ends[1]), [0.25, 0.75]);
            (stretch(frame, &rest.frame, skin, ends), muscles.iter().map(muscle).sum::<f64>())
        };
        let (whole, in_muscles) = volumes(&rest.frame);
        for (angle, state) in angles(&document, 7.5) {
            posed.at(&state);
            let (skin, muscles) = volumes(&posed.frame);
            let apart = ((skin - whole) - (muscles - in_muscles)) / whole;
            assert!(apart.abs() < 0.005, "{name} at {angle}°: {apart}");
        }
    }
}

/// The normal of each triangle, as long as twice its area.
fn normals(surface: &Surface) -> Vec<DVec3> {
    let shape = Shape::of(surface);
    let normal = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(|vertex| shape.points[vertex as usize]);
        (b - a).cross(c - a)
    };
    shape.triangles.iter().map(normal).collect()
}

#[test]
fn skin_that_follows_is_hardly_more_folded_than_by_the_skeleton_alone() {
    for name in ARMS {
        let document = demo(name);
        let mut posed = Posed::new(&document);
        posed.at(&bent(&document, 60.0));
        let skin = skin_of(&posed);
        for (angle, state) in angles(&document, 7.5) {
            posed.at(&state);
            let most = posed.moves(skin).iter().map(|by| by.length()).fold(0.0, f64::max);
            assert!(most < 0.032, "{name} at {angle}°: {most}");
            let (with, without) = (&posed.frame.surfaces[skin], &posed.plain.surfaces[skin]);
            let turned = normals(with).iter().zip(normals(without)).filter(|(a, b)| a.dot(*b) < 0.0).count();
            // Of 9,620; where it crushes triangles to slivers, next to no difference of moves turns them over.
            assert!(angle >= 90.0 || turned <= 14, "{name} at {angle}°: {turned} turned over");
            let (crossing, plain) = (crossing_pairs(&Shape::of(with)), crossing_pairs(&Shape::of(without)));
            assert!(crossing <= plain + 70, "{name} at {angle}°: {crossing} crossing, {plain} by the skeleton");
        }
    }
}

#[test]
fn skin_moves_without_a_jump_in_its_speed() {
    let document = demo("curl-muscles.yaml");
    let (mut posed, mut skin) = (Posed::new(&document), None);
    // The largest second difference of a vertex's moves over this step, by place of the step.
    let mut bends = |step: f64| {
        let mut rows: Vec<Vec<DVec3>> = Vec::new();
        let (mut most, mut fastest) = (Vec::new(), 0.0_f64);
        for number in 0..=(120.0 / step) as u32 {
            posed.at(&bent(&document, step * f64::from(number)));
            if number == 0 {
                let mut bulging = Posed::new(&document);
                bulging.at(&bent(&document, 60.0));
                skin = Some(skin_of(&bulging));
            }
            rows.push(posed.moves(skin.unwrap()));
            if let [.., a, b] = rows.as_slice() {
                fastest = fastest.max(a.iter().zip(b).map(|(a, b)| a.distance(*b) / step).fold(0.0, f64::max));
            }
            if let [a, b, c] = rows.as_slice() {
                most.push(a.iter().zip(b).zip(c).map(|((a, b), c)| (*a - *b * 2.0 + *c).length()).fold(0.0, f64::max));
                rows.remove(0);
            }
        }
        (most.into_iter().fold(0.0, f64::max), fastest)
    };
    let ((coarse, _), (fine, fastest)) = (bends(0.5), bends(0.25));
    // Of a jump in the speed the second difference halves with the step; of a smooth function it is a quarter.
    assert!(fine < 0.4 * coarse, "{fine} {coarse}");
    assert!(fastest < 0.0025, "{fastest} m a degree");
}

#[test]
fn presets_on_a_figure_with_straight_arms_throw_no_skin_out() {
    let Some(shared) = shared() else { return left_out("real figures are not there") };
    let document = Document::open(&[shared.join("models/walk.dae")], SCENE_READERS, &Progress::default()).unwrap();
    let mut session = Session::default();
    session.show(document, LoadMode::New);
    for preset in PRESETS.iter().take(3) {
        session.new_muscle(*preset).unwrap();
    }
    let document = session.document();
    assert_eq!(document.muscles_under_skin().len(), 3);
    let mut posed = Posed::new(document);
    for (angle, state) in angles(document, 5.0) {
        posed.at(&state);
        for skin in posed.skins() {
            let most = posed.moves(skin).iter().map(|by| by.length()).fold(0.0, f64::max);
            assert!(most < 0.036, "{angle}°: {most}");
        }
    }
}

//! Limbs that the tests make: random ones, scaled and mirrored ones, and such as are not as they should be.

use glam::DVec3;
use proptest::prelude::*;
use sinew::document::{PoseState, Skinning};

use crate::limb::Limb;
use crate::posed::{Posed, bent};

/// The largest move of all vertices, metres.
fn largest(moves: &[DVec3]) -> f64 {
    moves.iter().map(|by| by.length()).fold(0.0, f64::max)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, ..ProptestConfig::default() })]
    #[test]
    fn no_random_muscle_comes_out_of_a_random_limb(
        radius in 40.0..60.0f64, thick in 0.22..0.36f64, gap in 4.0..14.0f64, side in -0.25..0.25f64, growth in 0.5..2.0f64,
        coarse in 0..3usize,
    ) {
        let (thick, side) = (thick * radius, side * radius);
        let front = ((radius - gap - thick).powi(2) - side * side).max(0.0).sqrt();
        let edge = [8.0, 11.0, 16.0][coarse];
        let document = Limb { radius, edge, front, side, thick, growth, ..Limb::default() }.open();
        prop_assert!(document.has_muscles_under_skin());
        let mut posed = Posed::new(&document);
        posed.at(&PoseState::default());
        let skin = posed.skins()[0];
        let [belly, _] = posed.outside(skin, 5);
        prop_assert_eq!(belly, 0.0, "at rest");
        for angle in [15.0, 40.0, 65.0, 90.0, 115.0] {
            posed.at(&bent(&document, angle));
            let [belly, _] = posed.outside(skin, 5);
            prop_assert!(belly == 0.0, "{angle}°: {belly}");
            let moves = posed.moves(skin);
            prop_assert!(moves.iter().all(|by| by.is_finite()));
            prop_assert!(largest(&moves) < 0.06, "{angle}°: {}", largest(&moves));
        }
    }
}

#[test]
fn at_rest_nothing_moves_and_out_of_reach_nothing_ever_does() {
    let document = Limb::default().open();
    let mut posed = Posed::new(&document);
    posed.at(&PoseState::default());
    let skin = posed.skins()[0];
    assert!(largest(&posed.moves(skin)) < 1e-9, "{}", largest(&posed.moves(skin)));
    // The tip of the limb is 24 cm beyond the insertion.
    let at_rest = crate::figures::Shape::of(&posed.plain.surfaces[skin]);
    let far: Vec<usize> = (0..at_rest.points.len()).filter(|vertex| at_rest.points[*vertex].y > 0.43).collect();
    assert!(far.len() > 500);
    for angle in [30.0, 90.0, 120.0] {
        posed.at(&bent(&document, angle));
        let moves = posed.moves(skin);
        assert!(largest(&moves) > 1e-4);
        assert!(far.iter().all(|vertex| moves[*vertex] == DVec3::ZERO));
    }
}

#[test]
fn the_skeleton_alone_gives_the_same_bits_as_a_limb_without_muscles() {
    let folder = crate::support::folder();
    let document = Limb::default().open_in(folder.path());
    let files = [folder.path().join("limb.dae")];
    let bare = sinew::document::Document::open(&files, sinew::formats::SCENE_READERS, &Default::default()).unwrap();
    let (mut with, mut without) = (Posed::new(&document), Posed::new(&bare));
    let turn = bent(&document, 80.0);
    with.at(&turn);
    without.at(&turn);
    let points = |frame: &sinew::scene::Frame| crate::figures::Shape::of(&frame.surfaces[0]).points;
    assert_eq!(points(&with.plain), points(&without.frame));
    assert_ne!(points(&with.frame), points(&without.frame));
}

#[test]
fn a_mirrored_limb_moves_as_its_twin_does_and_a_limb_in_centimetres_too() {
    let one = Limb { side: 9.0, ..Limb::default() };
    let twins = [Limb { mirrored: true, ..one.clone() }, Limb { unit: 0.01, ..one.clone() }];
    let document = one.open();
    for (number, twin) in twins.iter().enumerate() {
        let other = twin.open();
        let (mut posed, mut twin) = (Posed::new(&document), Posed::new(&other));
        for angle in [20.0, 60.0, 110.0] {
            posed.at(&bent(&document, angle));
            twin.at(&bent(&other, angle));
            let turned = if number == 0 { DVec3::new(1.0, 1.0, -1.0) } else { DVec3::ONE };
            let skin = posed.skins()[0];
            let apart = posed.moves(skin).iter().zip(twin.moves(skin)).map(|(a, b)| (*a * turned - b).length()).fold(0.0, f64::max);
            assert!(apart < 3e-6, "twin {number} at {angle}°: {apart}");
        }
    }
}

#[test]
fn every_one_of_several_skins_follows_and_so_does_one_with_open_ends() {
    for (limb, skins) in [(Limb { skins: 2, ..Limb::default() }, 2), (Limb { open: true, ..Limb::default() }, 1)] {
        let document = limb.open();
        let mut posed = Posed::new(&document);
        posed.at(&bent(&document, 90.0));
        let skin = posed.skins()[0];
        let moves = posed.moves(skin);
        let each = moves.len() / skins;
        for moves in moves.chunks(each) {
            assert!(largest(moves) > 0.004, "{}", largest(moves));
        }
        assert!(moves.iter().all(|by| by.is_finite()));
    }
}

#[test]
fn a_muscle_outside_of_the_skin_moves_nothing_and_is_told() {
    let document = Limb { front: 90.0, ..Limb::default() }.open();
    assert!(!document.has_muscles_under_skin());
    let mut posed = Posed::new(&document);
    posed.at(&bent(&document, 90.0));
    let skin = posed.skins()[0];
    assert_eq!(largest(&posed.moves(skin)), 0.0);
    let told: Vec<&str> = document.diagnostics.iter().map(|found| sinew::diagnostics::DiagnosticKind::code(&found.finding)).collect();
    assert!(told.contains(&"muscle-outside-skin"), "{told:?}");
    let within = Limb::default().open();
    assert!(within.diagnostics.is_empty(), "{:?}", within.diagnostics);
}

#[test]
fn fat_lies_between_muscle_and_skin_and_a_short_reach_moves_less() {
    let height = |more: &str| {
        let document = Limb { more: more.to_owned(), ..Limb::default() }.open();
        let mut posed = Posed::new(&document);
        posed.at(&bent(&document, 90.0));
        let moves = posed.moves(posed.skins()[0]);
        (largest(&moves), moves.iter().filter(|by| by.length() > 1e-4).count())
    };
    let (usual, thin, fat) = (height(""), height("skin: {fat: 0}"), height("skin: {fat: 6}"));
    assert!((fat.0 - usual.0 - 0.003).abs() < 0.0012 && (usual.0 - thin.0 - 0.003).abs() < 0.0012, "{thin:?} {usual:?} {fat:?}");
    let (near, stiff) = (height("skin: {reach: 15}"), height("skin: {elasticity: 0}"));
    assert!(near.1 < usual.1 && stiff.1 <= usual.1, "{near:?} {stiff:?} {usual:?}");
}

#[test]
fn dual_quaternions_bend_a_skin_that_follows_too() {
    let document = Limb::default().open();
    let mut posed = Posed::new(&document);
    for angle in [45.0, 90.0] {
        posed.at(&PoseState { skinning: Skinning::DualQuaternion, ..bent(&document, angle) });
        let skin = posed.skins()[0];
        assert_eq!(posed.outside(skin, 5)[0], 0.0);
        assert!(largest(&posed.moves(skin)) > 2e-4);
    }
}

#[test]
fn a_muscle_along_the_axis_of_its_bones_makes_no_spikes() {
    for (front, end) in [(1.0, 1.0), (2.0, -2.0), (4.0, 2.0), (8.0, -6.0), (24.0, -3.0)] {
        let document = Limb { front, end, thick: 14.0, edge: 30.0, ..Limb::default() }.open();
        let mut posed = Posed::new(&document);
        let mut before = 0.0;
        for angle in 0..=30 {
            posed.at(&bent(&document, f64::from(angle)));
            let most = largest(&posed.moves(posed.skins()[0]));
            assert!((most - before).abs() < 0.008 && most < 0.03, "{front} mm in front of the bone at {angle}°: {before} {most}");
            before = most;
        }
    }
}

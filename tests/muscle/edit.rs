//! Editing a muscle file by hand: each change checked, the last good file left alone; presets; the ledger's reasons.

use glam::DVec3;
use proptest::prelude::*;
use sinew::i18n::Sentence;
use sinew::muscle::edit::{VIA, WRAPS};
use sinew::muscle::presets::{PRESETS, Preset};
use sinew::muscle::{
    Anchor, Edit, EditError, LimitCause, MuscleFile, MuscleRig, Profile, ProfileError, Root, SolverReport, Tendon, Wrap, WrapRange,
    WrapShape, literature_data,
};
use sinew::scene::{MuscleId, Scene};

use crate::in_each_language;

fn file() -> MuscleFile {
    MuscleFile::parse(include_str!("../../configs/example.yaml")).unwrap()
}

fn anchor(bone: &str, y: f64) -> Anchor {
    Anchor { bone: bone.to_owned(), offset: DVec3::Y * y }
}

#[test]
fn a_node_added_lies_half_way_and_the_length_stays() {
    let file = file();
    let (radii, growth) = (file.muscles[0].profile.radii(), file.muscles[0].profile.growth());
    let more = file.edited(0, &Edit::AddNode(2)).unwrap();
    let profile = &more.muscles[0].profile;
    assert_eq!((profile.radii().len(), profile.rest_length()), (radii.len() + 1, 267.0));
    assert_eq!((profile.radii()[3], profile.growth()[3]), (0.5 * (radii[2] + radii[3]), 0.5 * (growth[2] + growth[3])));
    assert_eq!(more.edited(0, &Edit::DeleteNode(3)).unwrap(), file);
    let at_end = file.edited(0, &Edit::AddNode(8)).unwrap();
    assert_eq!(at_end.muscles[0].profile.radii()[8..], [3.5, 3.5]);
}

#[test]
fn what_makes_no_muscle_is_refused_and_the_file_stays() {
    let file = file();
    let before = file.clone();
    let refused = |edit: Edit| file.edited(0, &edit).unwrap_err();
    assert_eq!(refused(Edit::Radius(1, -1.0)), EditError::Profile(ProfileError::BadRadius(1)));
    assert_eq!(refused(Edit::Radius(1, f64::NAN)), EditError::Profile(ProfileError::BadRadius(1)));
    assert_eq!(refused(Edit::Radius(9, 1.0)), EditError::NoNode(9));
    assert_eq!(refused(Edit::Growth(0, f64::INFINITY)), EditError::Profile(ProfileError::BadGrowth(0)));
    assert_eq!(refused(Edit::RestLength(0.0)), EditError::Profile(ProfileError::BadLength));
    assert_eq!(refused(Edit::Nodes(vec![1.0, 2.0], vec![0.0, 0.0])), EditError::Profile(ProfileError::NoGrowth));
    assert_eq!(refused(Edit::AddNode(9)), EditError::NoNode(9));
    assert_eq!(refused(Edit::DeleteNode(9)), EditError::NoNode(9));
    assert_eq!(refused(Edit::Tendon(0, Tendon { length: 5.0, radius: 0.0 })), EditError::Tendon);
    assert_eq!(refused(Edit::Tendon(0, Tendon { length: f64::NAN, radius: 1.0 })), EditError::Tendon);
    let here = anchor("forearm", -47.0);
    assert_eq!(refused(Edit::Ends(Some([here.clone(), here.clone()]))), EditError::EndsCoincide);
    assert_eq!(refused(Edit::End(0, here)), EditError::EndsCoincide);
    assert_eq!(refused(Edit::End(0, anchor("hand", 0.0))), EditError::ArmBone("hand".to_owned()));
    assert_eq!(refused(Edit::End(1, anchor("forearm", f64::NAN))), EditError::Offset);
    let mut full = file.clone();
    full.muscles[0].via = vec![anchor("forearm", 0.0).into(); VIA];
    assert_eq!(full.edited(0, &Edit::AddVia(3, anchor("forearm", 0.0))).unwrap_err(), EditError::TooManyVia(VIA + 1));
    for edit in [Edit::Via(0, anchor("forearm", 0.0)), Edit::DeleteVia(0), Edit::SwapVia(0)] {
        assert_eq!(refused(edit), EditError::NoVia(0));
    }
    assert_eq!(full.edited(0, &Edit::SwapVia(VIA - 1)).unwrap_err(), EditError::NoVia(VIA - 1));
    assert_eq!(refused(Edit::AddVia(0, anchor("hand", 0.0))), EditError::ArmBone("hand".to_owned()));
    let sphere = Wrap::sphere(anchor("upper arm", -330.0), 14.0, DVec3::X);
    let cylinder = WrapShape::Cylinder { radius: 5.0, length: 20.0 };
    for bad in [
        Wrap { shape: WrapShape::Sphere { radius: 0.0 }, ..sphere.clone() },
        Wrap { shape: WrapShape::Ellipsoid { radii: DVec3::new(1.0, f64::NAN, 1.0) }, ..sphere.clone() },
        Wrap { shape: WrapShape::Torus { radius: 3.0, tube: 3.0 }, side: None, ..sphere.clone() },
        Wrap { side: Some(DVec3::ZERO), ..sphere.clone() },
        Wrap { shape: cylinder, side: Some(DVec3::Z), ..sphere.clone() },
        Wrap { range: WrapRange::Between([1, 1]), ..sphere.clone() },
        Wrap { range: WrapRange::Between([0, 2]), ..sphere.clone() },
        Wrap { rotation: DVec3::INFINITY, ..sphere.clone() },
    ] {
        assert_eq!(refused(Edit::AddWrap(bad.clone())), EditError::Wrap, "{bad:?}");
    }
    assert_eq!(refused(Edit::AddWrap(Wrap::sphere(anchor("hand", 0.0), 14.0, DVec3::X))), EditError::ArmBone("hand".to_owned()));
    let own = file.muscles[0].wraps.len();
    for edit in [Edit::Wrap(own, sphere.clone()), Edit::DeleteWrap(own), Edit::SwapWrap(own)] {
        assert_eq!(refused(edit), EditError::NoWrap(own));
    }
    let mut full_of_wraps = file.clone();
    full_of_wraps.muscles[0].wraps = vec![sphere.clone(); WRAPS];
    assert_eq!(full_of_wraps.edited(0, &Edit::AddWrap(sphere)).unwrap_err(), EditError::TooManyWraps(WRAPS + 1));
    assert_eq!(file.edited(2, &Edit::DeleteNode(0)).unwrap_err(), EditError::NoMuscle(2));
    let alone = file.edited(0, &Edit::Ends(None)).unwrap();
    assert!(alone.muscles[0].wraps.is_empty());
    assert_eq!(alone.edited(0, &Edit::AddVia(0, anchor("forearm", 0.0))).unwrap_err(), EditError::NoEnds);
    assert_eq!(alone.edited(0, &Edit::End(0, anchor("forearm", 0.0))).unwrap_err(), EditError::NoEnds);
    let one = file.without_muscle(0).unwrap();
    assert_eq!((one.without_muscle(0).unwrap_err(), one.without_muscle(1).unwrap_err()), (EditError::Count, EditError::NoMuscle(1)));
    assert_eq!(file, before);
    let mut two = Profile::new(vec![1.0, 2.0], vec![1.0, 1.0], 5.0).map(sinew::muscle::MuscleSpec::new).unwrap();
    two.name = "Two".to_owned();
    let more = file.with_muscle(two).unwrap();
    assert_eq!(more.edited(2, &Edit::DeleteNode(0)).unwrap_err(), EditError::Profile(ProfileError::TooFewNodes(1)));
}

#[test]
fn changes_have_names_in_both_languages() {
    in_each_language(|_| {
        let edits = [
            Edit::AddNode(0),
            Edit::Radius(4, 1.0),
            Edit::Tendon(0, Tendon::default()),
            Edit::Ends(None),
            Edit::DeleteWrap(0),
            Edit::ViaRange(0, None),
        ];
        let names = PRESETS.iter().flat_map(|preset| [preset.name().sentence(), preset.muscle_name().sentence()]);
        for text in edits.iter().map(Edit::sentence).chain(names).chain([EditError::NoNode(6).sentence()]) {
            assert!(!text.contains("muscle-") && !text.contains('{'), "{text}");
        }
        assert!(Edit::Radius(4, 1.0).sentence().ends_with('5'));
    });
}

/// Volumes in cm³, from the sources that the files name, a fifth either way.
#[test]
fn presets_are_muscles_in_human_proportions() {
    for (preset, volume, arm) in
        PRESETS.iter().zip([(0.0, 0.0), (0.0, 0.0), (143.7, 4.9), (372.1, 2.2), (143.7, 2.6)]).map(|(p, (v, a))| (p, v, a))
    {
        let file = preset.file();
        assert_eq!(Preset::by_id(preset.id), Some(*preset));
        assert!(!file.muscles.is_empty(), "{}", preset.id);
        let rig = MuscleRig::build(&file, preset.id, &mut Scene::default(), MuscleId(0));
        assert!(rig.findings().is_empty(), "{}: {:?}", preset.id, rig.findings());
        if volume == 0.0 {
            continue;
        }
        let rows = rig.measure(0, &(0..=130).map(f64::from).collect::<Vec<_>>());
        assert!(rows.iter().all(|row| !row.solved.held), "{} is held somewhere", preset.id);
        let cm3 = rows[0].solved.volume / 1000.0;
        assert!((cm3 / volume - 1.0).abs() < 0.2, "{}: {cm3} cm³ is not about {volume}", preset.id);
        let peak = rows.iter().map(|row| row.moment_arm.unwrap().abs()).fold(0.0, f64::max) / 10.0;
        assert!((peak / arm - 1.0).abs() < 0.15, "{}: a moment arm of {peak} cm is not about {arm}", preset.id);
    }
}

#[test]
fn the_ledger_says_which_root_and_what_limits_the_length() {
    let ledger = |radii: &[f64], growth: &[f64], length: f64| {
        let profile = Profile::new(radii.to_vec(), growth.to_vec(), 100.0).unwrap();
        SolverReport::new(&profile, &profile.solve(length), None)
    };
    let swells = ledger(&[5.0, 10.0, 5.0], &[0.0, 1.0, 0.0], 80.0);
    assert_eq!((swells.taken, swells.limits[0].cause, swells.limits[1].cause), (Root::Larger, LimitCause::Shortest, LimitCause::Radius(1)));
    assert_eq!((swells.largest_node, swells.held_at, swells.limits[0].length), (1, None, 40.0));
    assert!(swells.roots[0] > swells.roots[1] && swells.delta == swells.roots[0]);
    let [a, b, c] = swells.quadratic;
    assert!((swells.discriminant - (b * b - 4.0 * a * c)).abs() < 1e-9);
    // Shrinking everywhere: the larger root would be another shape.
    let shrinks = ledger(&[5.0, 10.0, 5.0], &[-1.0, -1.0, -1.0], 80.0);
    assert_eq!((shrinks.taken, shrinks.limits[1].cause), (Root::Smaller, LimitCause::Radius(0)));
    assert!(shrinks.delta < 0.0);
    // A thin middle that grows while its thick neighbours shrink runs out of roots before any radius vanishes.
    let runs_out = ledger(&[10.0, 1.0, 10.0], &[-1.0, 5.0, -1.0], 1e9);
    let cause = runs_out.limits[1].cause;
    assert!(matches!(cause, LimitCause::Discriminant | LimitCause::Radius(_)));
    assert_eq!(runs_out.held_at, Some(1));
    let double = ledger(&[10.0, 10.0], &[1.0, -0.5], 1e9);
    assert_eq!(double.held_at, Some(1));
    if double.limits[1].cause == LimitCause::Discriminant {
        assert!(double.discriminant.abs() < 1e-9);
    }
    assert_eq!(ledger(&[5.0, 10.0], &[1.0, 1.0], 1.0e-9).held_at, Some(0));
}

#[test]
fn published_points_are_compared_within_a_range() {
    assert_eq!(literature_data::ARM26_BICEPS.rms([55.0, 105.0], |_| 4.0).map(|rms| (rms * 1e6).round()), {
        let misfit = [4.05_f64, 4.41, 4.69, 4.88, 4.94].map(|value| (value - 4.0).powi(2));
        Some(((misfit.iter().sum::<f64>() / 5.0).sqrt() * 1e6).round())
    });
    assert_eq!(literature_data::MURRAY_2000.rms([0.0, 10.0], |_| 1.0), None);
}

#[test]
fn presets_have_the_moment_arms_of_arm26() {
    use literature_data::{ARM26_BICEPS, ARM26_BRACHIALIS, ARM26_TRICEPS};
    for (id, published) in [("biceps", ARM26_BICEPS), ("triceps", ARM26_TRICEPS), ("brachialis", ARM26_BRACHIALIS)] {
        let preset = Preset::by_id(id).unwrap();
        assert!(preset.yaml.contains("Murray"), "{id} says where its numbers come from");
        let rig = MuscleRig::build(&preset.file(), id, &mut Scene::default(), MuscleId(0));
        let arm = |angle: f64| rig.measure(0, &[angle])[0].moment_arm.unwrap() / 10.0;
        let rms = published.rms([0.0, 130.0], arm).unwrap();
        assert!(rms < 0.5, "{id} is {rms} cm off Arm26");
        assert!((0..=130).all(|angle| arm(f64::from(angle)) * published.points[0][1] > 0.0), "{id} changes its sign");
    }
}

proptest! {
    #[test]
    fn limits_are_where_their_cause_says(
        nodes in prop::collection::vec((0.01..50.0_f64, -10.0..20.0_f64), 2..16),
        length in 1.0..1000.0_f64,
    ) {
        let (radii, growth): (Vec<f64>, Vec<f64>) = nodes.into_iter().unzip();
        let profile = Profile::new(radii.clone(), growth, length).unwrap();
        for limit in profile.limits() {
            let solved = profile.solve(limit.length);
            match limit.cause {
                LimitCause::Radius(node) => prop_assert!(solved.radii[node] < 1e-4 * radii[node], "{limit:?} {:?}", solved.radii),
                LimitCause::Discriminant => prop_assert!(solved.discriminant <= 1e-9 * solved.quadratic[1].powi(2) + 1e-9),
                LimitCause::Shortest => prop_assert!((limit.length / length - 0.4).abs() < 1e-12),
                LimitCause::Reach => prop_assert!(limit.length >= length * 99.9999),
            }
        }
    }

    #[test]
    fn no_edit_breaks_a_file(node in 0..12_usize, value in prop::num::f64::ANY, which in 0..7_usize) {
        let file = file();
        let edit = match which {
            0 => Edit::Radius(node, value),
            1 => Edit::Growth(node, value),
            2 => Edit::RestLength(value),
            3 => Edit::AddNode(node),
            4 => Edit::DeleteNode(node),
            5 => Edit::Pennation(value),
            _ => Edit::Tendon(node % 2, Tendon { length: value, radius: 2.0 }),
        };
        if let Ok(edited) = file.edited(0, &edit) {
            prop_assert_eq!(&MuscleFile::parse(&edited.to_yaml()).unwrap().muscles, &edited.muscles);
            let rig = MuscleRig::build(&edited, "edited", &mut Scene::default(), MuscleId(0));
            let rows = rig.measure(0, &[0.0, 60.0, 120.0]);
            prop_assert!(rows.iter().all(|row| row.solved.radii.iter().all(|radius| radius.is_finite())));
        }
    }
}

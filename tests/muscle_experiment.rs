//! The report's experiment: the model beside measured radii, and why the two differ.

use sinew::muscle::experiment::{CompareError, Table, compare};
use sinew::muscle::fit::{ScaledPoses, fit};
use sinew::muscle::{MuscleFile, Rig};
use sinew::scene::{MuscleId, Scene};

/// Table 4.1 of the biceps report (2020): radii at nine inner nodes, millimetres.
const MEASURED: &str = "# measured\nnode,deg0,deg30,deg60,deg90\n1,7.6,16.2,7.8,9.5\n2,18.2,18.7,16.2,15.2\n3,20.7,22.5,24.9,23.4\n4,21.2,26.2,32.4,27.7\n\
                        5,21.7,27.5,32.4,35.2\n6,24.3,31.3,32.0,35.8\n7,25.7,28.7,29.8,36.6\n8,20.7,26.6,22.0,24.2\n9,13.2,20.8,12.7,16.7\n";

fn rig(yaml: &str) -> Rig {
    Rig::build(&MuscleFile::parse(yaml).unwrap(), "experiment", &mut Scene::default(), MuscleId(0))
}

fn biceps() -> Rig {
    rig(include_str!("../configs/biceps-measured.yaml"))
}

fn cones(radii: &[f64], length: f64) -> f64 {
    let height = length / (radii.len() - 1) as f64;
    radii.windows(2).map(|r| std::f64::consts::PI * height / 3.0 * (r[0] * r[0] + r[0] * r[1] + r[1] * r[1])).sum()
}

#[test]
fn the_measured_radii_do_not_keep_their_volume() {
    let comparison = compare(&biceps(), 0, &Table::parse(MEASURED).unwrap()).unwrap();
    let millilitres: Vec<f64> = comparison.implied_volumes.iter().map(|volume| (volume / 1000.0).round()).collect();
    assert_eq!(millilitres, [280.0, 422.0, 413.0, 439.0]);
    assert!((5.0..=6.0).contains(&comparison.growth_ratio), "measured growth is {} times the model's", comparison.growth_ratio);
    assert_eq!(comparison.growth.len(), 9);
    assert!((comparison.growth[1][1] - (15.2 - 18.2)).abs() < 1e-12);
    // The model itself keeps the volume of the first angle.
    for (angle, length) in comparison.lengths.iter().enumerate() {
        let mut radii = vec![5.0];
        radii.extend(comparison.model.iter().map(|row| row[angle]));
        radii.push(5.0);
        assert!((cones(&radii, *length) / comparison.implied_volumes[0] - 1.0).abs() < 1e-12);
    }
    let squares: f64 = comparison.model.iter().flatten().zip(comparison.measured.iter().flatten()).map(|(a, b)| (a - b).powi(2)).sum();
    assert!((comparison.rms - (squares / 36.0).sqrt()).abs() < 1e-12);
}

#[test]
fn fitted_growth_is_the_best_there_is() {
    let (rig, table) = (biceps(), Table::parse(MEASURED).unwrap());
    let fits = fit(&rig, 0, &table).unwrap();
    assert!(fits.fitted <= fits.own && fits.poses < fits.own, "{fits:?}");
    // No multiplier changed by a little does better.
    let profile = rig.profile(0).unwrap();
    let lengths: Vec<f64> = rig.measure(0, &table.angles).iter().map(|sample| sample.solved.length).collect();
    let rms = |growth: &[f64]| {
        let profile = sinew::muscle::Profile::new(profile.radii().to_vec(), growth.to_vec(), 250.0).unwrap();
        let misfit = |(angle, length): (usize, &f64)| -> f64 {
            let radii = profile.solve(*length).radii;
            table.radii.iter().enumerate().map(|(node, row)| (radii[node + 1] - row[angle]).powi(2)).sum()
        };
        (lengths.iter().enumerate().map(misfit).sum::<f64>() / 36.0).sqrt()
    };
    assert!((rms(&fits.growth) - fits.fitted).abs() < 1e-9);
    for node in 1..10 {
        for by in [0.01, -0.01] {
            let mut changed = fits.growth.clone();
            changed[node] += by;
            assert!(rms(&changed) > fits.fitted - 1e-6, "node {node} by {by}: {} against {}", rms(&changed), fits.fitted);
        }
    }
}

#[test]
fn a_model_is_found_again_from_its_own_radii() {
    let rig = biceps();
    let angles = [0.0, 40.0, 80.0, 115.0];
    let rows = rig.measure(0, &angles);
    let mut text = String::from("node,deg0,deg40,deg80,deg115\n");
    for node in 0..11 {
        let radii: Vec<String> = rows.iter().map(|row| row.solved.radii[node].to_string()).collect();
        text += &format!("{node},{}\n", radii.join(","));
    }
    let table = Table::parse(&text).unwrap();
    let fits = fit(&rig, 0, &table).unwrap();
    assert!(fits.own < 1e-12 && fits.fitted < 1e-3 && fits.poses < 1e-9, "{fits:?}");
    let wanted = rig.profile(0).unwrap().growth();
    for (found, wanted) in fits.growth.iter().zip(wanted) {
        assert!((found - wanted / 13.5).abs() < 1e-2, "{found} is not {wanted} over the largest");
    }
}

#[test]
fn scaled_poses_keep_the_volume_at_every_length() {
    let poses = ScaledPoses::new(&biceps(), 0, &Table::parse(MEASURED).unwrap()).unwrap();
    let volume = cones(&poses.radii(250.0), 250.0);
    for length in [100.0, 200.0, 222.0, 230.0, 240.0, 249.0, 260.0] {
        assert!((cones(&poses.radii(length), length) / volume - 1.0).abs() < 1e-12);
    }
}

#[test]
fn tables_that_do_not_fit_are_refused() {
    sinew::i18n::set_language(sinew::i18n::Language::English);
    for (text, line) in [
        ("", 1),
        ("# x\n1,2\n", 2),
        ("node,deg0,deg0\n", 1),
        ("node,deg0\n1,x\n", 2),
        ("node,deg0\n1,2,3\n", 2),
        ("node,deg0\n1,-2\n", 2),
        ("node,deg0\n", 1),
    ] {
        assert_eq!(Table::parse(text).expect_err(text).line, line, "{text}");
    }
    let two = Table::parse("node,deg0\n1,2\n2,3\n").unwrap();
    assert_eq!(compare(&biceps(), 0, &two).unwrap_err(), CompareError::Nodes { rows: 2, nodes: 11 });
    let free = rig("muscle_config: {radiuses: [1, 2], grow_mults: [1, 1], len: 9}");
    assert_eq!(compare(&free, 0, &two).unwrap_err(), CompareError::NoJoint);
    assert!(fit(&free, 0, &two).is_err() && compare(&biceps(), 7, &two).is_err());
}

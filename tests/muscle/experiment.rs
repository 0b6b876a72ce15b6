//! The model compared with measured radii (OpenArm 2.0), and why the two differ.

use sinew::muscle::parameter_fit::{Model, fit, fitted_file};
use sinew::muscle::validation::{CompareError, Table, TableErrorKind, compare};
use sinew::muscle::{MuscleFile, MuscleRig};
use sinew::scene::{MuscleId, Scene};

/// Table 4.1 of Perestoronin (2020), from OpenArm 2.0: radii at nine inner nodes, millimetres.
const MEASURED: &str = sinew::muscle::literature_data::MEASURED_RADII;

fn rig(yaml: &str) -> MuscleRig {
    MuscleRig::build(&MuscleFile::parse(yaml).unwrap(), "experiment", &mut Scene::default(), MuscleId(0))
}

fn biceps() -> MuscleRig {
    rig(include_str!("../../configs/biceps-measured.yaml"))
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
fn tables_that_do_not_fit_are_refused() {
    use TableErrorKind::{Empty, Heading, Radius, Width};
    for (text, line, kind) in [
        ("", 1, Empty),
        ("# x\n1,2\n", 2, Heading),
        ("node,deg0,deg0\n", 1, Heading),
        ("node,deg0\n1,x\n", 2, Radius("x".to_owned())),
        ("node,deg0\n1,2,3\n", 2, Width { found: 2, wanted: 1 }),
        ("node,deg0\n1,-2\n", 2, Radius("-2".to_owned())),
        ("node,deg0\n", 1, Empty),
    ] {
        let error = Table::parse(text).expect_err(text);
        assert_eq!((error.line, error.kind), (line, kind), "{text}");
    }
    let two = Table::parse("node,deg0\n1,2\n2,3\n").unwrap();
    assert_eq!(compare(&biceps(), 0, &two).unwrap_err(), CompareError::Nodes { rows: 2, nodes: 11 });
    let free = rig("muscle_config: {radiuses: [1, 2], grow_mults: [1, 1], len: 9}");
    assert_eq!(compare(&free, 0, &two).unwrap_err(), CompareError::NoJoint);
    assert!(fit(&free, 0, &two).is_err() && compare(&biceps(), 7, &two).is_err());
}

#[test]
fn measured_poses_keep_the_volume_and_grow_and_shrink_again() {
    let (rig, table) = (biceps(), Table::parse(MEASURED).unwrap());
    let file = MuscleFile::parse(include_str!("../../configs/biceps-measured.yaml")).unwrap();
    let fitted = fitted_file(&file, &rig, 0, &table, Model::Poses).unwrap();
    // Written, read and put on its arm again, it is what the fit promised.
    let again = MuscleFile::parse(&fitted.file.to_yaml()).unwrap();
    assert_eq!(again.muscles, fitted.file.muscles);
    let rig = MuscleRig::build(&again, "poses", &mut Scene::default(), MuscleId(0));
    assert!(rig.findings().is_empty() && rig.profile(0).unwrap().is_posed());
    let rows = rig.measure(0, &table.angles);
    let squares = |row: usize| -> f64 { (0..9).map(|node| (rows[row].solved.radii[node + 1] - table.radii[node][row]).powi(2)).sum() };
    let rms = ((0..4).map(squares).sum::<f64>() / 36.0).sqrt();
    assert!((rms - fitted.poses).abs() < 1e-9, "{rms} is not {}", fitted.poses);
    assert!(fitted.poses < fitted.own.unwrap() && squares(0) < 1e-12);
    // Node 1 was measured at 7.6, 16.2, 7.8 and 9.5 mm: it grows and shrinks again.
    let node = |row: usize| rows[row].solved.radii[1];
    assert!(node(1) > node(0) && node(2) < node(1) && node(3) > node(2));
    for row in rig.measure(0, &(0..=120).map(f64::from).collect::<Vec<_>>()) {
        let rest = cones(&rows[0].solved.radii, rows[0].solved.length);
        assert!((cones(&row.solved.radii, row.solved.length) / rest - 1.0).abs() < 1e-12, "at {}°", row.angle.unwrap());
        let [a, b, c] = row.solved.quadratic;
        assert!((a * row.solved.delta * row.solved.delta + b * row.solved.delta + c).abs() < 1e-9 * a);
    }
}

#[test]
fn a_fit_makes_a_muscle_of_any_number_of_nodes() {
    let table = Table::parse("node,deg10,deg50,deg100\n1,5,6,7\n2,10,12,15\n3,6,7,8\n").unwrap();
    let file = MuscleFile::parse(include_str!("../../configs/biceps-measured.yaml")).unwrap();
    let fitted = fitted_file(&file, &biceps(), 0, &table, Model::Growth).unwrap();
    assert_eq!(fitted.own, None);
    let profile = &fitted.file.muscles[0].profile;
    assert_eq!(profile.radii(), [5.0, 5.0, 10.0, 6.0, 5.0]);
    assert_eq!((profile.growth()[0], profile.growth()[4]), (0.0, 0.0));
    let rig = MuscleRig::build(&fitted.file, "fitted", &mut Scene::default(), MuscleId(0));
    let length = rig.measure(0, &[10.0])[0].solved.length;
    assert!((profile.rest_length() - length).abs() < 1e-9 && fitted.growth >= 0.0);
}

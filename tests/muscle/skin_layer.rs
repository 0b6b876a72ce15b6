//! How skin lies over the muscles of a file: read, written, edited, and in metres on the rig.

use sinew::muscle::config::{ConfigErrorKind, ValueName};
use sinew::muscle::{Edit, EditError, MuscleFile, MuscleRig, SkinSpec};
use sinew::scene::{MuscleId, Scene};

const MUSCLES: &str =
    "muscles:\n  - {length: 30, radii: [1, 2, 1], growth: [0, 1, 0]}\n  - {length: 20, radii: [1, 1, 1], growth: [0, 1, 0]}\n";

fn read(head: &str) -> MuscleFile {
    MuscleFile::parse(&format!("{head}{MUSCLES}")).unwrap()
}

fn in_metres(file: &MuscleFile) -> [f64; 3] {
    let SkinSpec { fat, reach, elasticity } = MuscleRig::build(file, "", &mut Scene::default(), MuscleId(0)).skin();
    [fat, reach, elasticity]
}

#[test]
fn lengths_are_in_the_unit_of_the_file_and_the_usual_ones_in_millimetres() {
    let near = |head: &str, expected: [f64; 3]| {
        let found = in_metres(&read(head));
        assert!(found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-12), "{head:?}: {found:?}");
    };
    for unit in ["", "unit: cm\n", "unit: in\n", "unit: m\n", "unit: 0.5\n"] {
        near(unit, [0.003, 0.04, 0.5]);
    }
    near("skin: {fat: 5, reach: 25, elasticity: 1}\n", [0.005, 0.025, 1.0]);
    near("unit: cm\nskin: {fat: 0.5}\n", [0.005, 0.04, 0.5]);
    near("unit: cm\nskin: {elasticity: 0, reach: 100}\n", [0.003, 1.0, 0.0]);
}

#[test]
fn the_key_is_read_written_and_refused_in_place() {
    let file = read("skin: {fat: 5, reach: 25.5, elasticity: 0.25}\n");
    assert_eq!(file.skin, Some(SkinSpec { fat: 5.0, reach: 25.5, elasticity: 0.25 }));
    assert_eq!(MuscleFile::parse(&file.to_yaml()).unwrap(), file);
    assert!(read("").skin.is_none() && !read("").to_yaml().contains("skin"));
    let refused = |skin: &str| {
        let error = MuscleFile::parse(&format!("skin: {{{skin}}}\n{MUSCLES}")).unwrap_err();
        assert_eq!(error.line, Some(1), "{skin}");
        (error.column, error.kind)
    };
    let too_large = |key, most| ConfigErrorKind::TooLarge { name: ValueName { key: Some(key), items: Vec::new() }, most };
    assert_eq!(refused("fat: 1000.5"), (Some(13), too_large("fat", 1000.0)));
    assert_eq!(refused("fat: 3, reach: 1001"), (Some(23), too_large("reach", 1000.0)));
    assert_eq!(refused("elasticity: 1.5"), (Some(20), too_large("elasticity", 1.0)));
    for wrong in ["fat: -1", "reach: x", "elasticity: .nan", "thickness: 3"] {
        refused(wrong);
    }
}

#[test]
fn an_edit_through_any_muscle_changes_it_for_the_file() {
    let text = format!("skin: {{fat: 5}}   # thick\n{MUSCLES}");
    let file = MuscleFile::parse(&text).unwrap();
    let skin = SkinSpec { fat: 12.0, reach: 40.0, elasticity: 0.5 };
    let edited = [0, 1].map(|index| file.edited(index, &Edit::Skin(Some(skin))).unwrap());
    assert_eq!(edited[0], edited[1]);
    assert_eq!((edited[0].skin, &edited[0].muscles), (Some(skin), &file.muscles));
    let saved = edited[0].to_yaml_keeping(&text);
    assert_eq!(MuscleFile::parse(&saved.text).unwrap(), edited[0]);
    assert!(!saved.comments_lost && saved.text.contains("# thick"), "{}", saved.text);
    assert_eq!(file.edited(1, &Edit::Skin(None)).unwrap().skin, None);
    for wrong in [-0.1, 1000.5, f64::NAN, f64::INFINITY] {
        let refused = |skin: SkinSpec| assert_eq!(file.edited(0, &Edit::Skin(Some(skin))).unwrap_err(), EditError::Skin, "{skin:?}");
        refused(SkinSpec { fat: wrong, ..skin });
        refused(SkinSpec { reach: wrong, ..skin });
        refused(SkinSpec { elasticity: wrong, ..skin });
    }
    assert_eq!(file.edited(2, &Edit::Skin(Some(skin))).unwrap_err(), EditError::NoMuscle(2));
}

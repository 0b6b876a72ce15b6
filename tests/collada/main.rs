//! The COLLADA reader, point by point, on documents that the tests compose themselves.

#[path = "../collada_support/mod.rs"]
mod build;

mod animate;
mod archives;
mod controllers;
mod documents;
mod hostile;
mod materials;
mod meshes;
mod scenes;
mod skins;

/// README.md says which test shows which point of the format: every name in it is that of a test.
#[test]
fn the_table_of_points_names_tests_that_are_there() {
    let table = include_str!("README.md");
    let tests = [
        include_str!("animate.rs"),
        include_str!("archives.rs"),
        include_str!("controllers.rs"),
        include_str!("documents.rs"),
        include_str!("hostile.rs"),
        include_str!("materials.rs"),
        include_str!("meshes.rs"),
        include_str!("scenes.rs"),
        include_str!("skins.rs"),
    ];
    let cells =
        table.lines().filter(|line| line.starts_with("| ")).filter_map(|line| line.trim_end_matches(" |").rsplit(" | ").next()).skip(1);
    let mut named = 0;
    for name in cells.flat_map(|cell| cell.split('`').skip(1).step_by(2)) {
        let test = format!("#[test]\nfn {name}()");
        assert!(tests.iter().any(|file| file.contains(&test)), "{name} is no test");
        named += 1;
    }
    assert!(named > 80, "{named} tests are named");
}

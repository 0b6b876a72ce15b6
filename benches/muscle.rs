//! Muscles a frame: solved, laid and tessellated. `cargo bench --no-default-features --bench muscle`

use criterion::{Criterion, criterion_group, criterion_main};
use glam::DMat4;
use sinew::animation::Pose;
use sinew::muscle::{MuscleFile, MuscleRig, SolvedMuscle};
use sinew::scene::{MuscleId, Scene};

struct Stage {
    rig: MuscleRig,
    world: Vec<DMat4>,
    solved: Vec<SolvedMuscle>,
    positions: Vec<Vec<glam::Vec3>>,
    normals: Vec<Vec<glam::Vec3>>,
}

impl Stage {
    fn new(yaml: &str) -> Self {
        let mut scene = Scene::default();
        let rig = MuscleRig::build(&MuscleFile::parse(yaml).expect("the bench's own file"), "bench", &mut scene, MuscleId(0));
        let mut pose = Pose::rest(&scene);
        rig.apply(rig.at_flexion(70.0), &mut pose);
        let (mut local, mut world) = (Vec::new(), Vec::new());
        pose.locals(&mut local);
        scene.graph.world_from_local(&local, &mut world);
        let count = rig.len();
        Self {
            rig,
            world,
            solved: vec![SolvedMuscle::default(); count],
            positions: vec![Vec::new(); count],
            normals: vec![Vec::new(); count],
        }
    }

    fn frame(&mut self) {
        let drive = self.rig.at_flexion(70.0);
        for index in 0..self.rig.len() {
            self.rig.solve_into(index, drive, &self.world, &mut self.solved[index]);
            self.rig.deform(index, &self.solved[index], &self.world, &mut self.positions[index], &mut self.normals[index]);
        }
    }
}

fn muscles(criterion: &mut Criterion) {
    let mut biceps = Stage::new(include_str!("../configs/biceps.yaml"));
    criterion.bench_function("one biceps", |bencher| bencher.iter(|| biceps.frame()));
    let radii: Vec<f64> = (0..24).map(|node| 4.0 + 14.0 * (f64::from(node) / 23.0 * std::f64::consts::PI).sin()).collect();
    let growth: Vec<f64> = (0..24).map(|node| (f64::from(node) / 23.0 * std::f64::consts::PI).sin()).collect();
    let hundred = |more: &str| {
        let muscle = format!(
            "  - {{length: 347, radii: {radii:?}, growth: {growth:?}, origin: {{bone: upper arm, offset: [0, -30, 0]}}, insertion: {{bone: forearm, offset: [0, -47, 0]}}{more}}}\n"
        );
        Stage::new(&format!("arm: {{upper: 330, forearm: 260, thickness: 8}}\nmuscles:\n{}", muscle.repeat(100)))
    };
    let cylinder = |between: &str| {
        format!("{{shape: cylinder, bone: upper arm, offset: [0, -330, 0], radius: 20, length: 80, side: +x, between: {between}}}")
    };
    let ellipsoid = "{shape: ellipsoid, bone: upper arm, offset: [4, -120, 0], radii: [30, 60, 40], side: +x, between: [0, 1]}";
    let via = "via: [{bone: upper arm, offset: [30, -240, 0]}]";
    for (name, more) in [
        ("100 muscles of 24 nodes", String::new()),
        ("100 muscles of 24 nodes over two cylinders", format!(", {via}, wraps: [{}, {}]", cylinder("[0, 1]"), cylinder("[1, 2]"))),
        ("100 muscles of 24 nodes over an ellipsoid and a cylinder", format!(", {via}, wraps: [{ellipsoid}, {}]", cylinder("[1, 2]"))),
    ] {
        let mut stage = hundred(&more);
        criterion.bench_function(name, |bencher| bencher.iter(|| stage.frame()));
    }
}

criterion_group!(benches, muscles);
criterion_main!(benches);

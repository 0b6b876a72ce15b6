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
    let mut yaml = String::from("arm: {upper: 330, forearm: 260, thickness: 8}\nmuscles:\n");
    for _ in 0..100 {
        yaml += &format!(
            "  - {{length: 347, radii: {radii:?}, growth: {growth:?}, origin: {{bone: upper arm, offset: [0, -30, 0]}}, insertion: {{bone: forearm, offset: [0, -47, 0]}}}}\n"
        );
    }
    let mut hundred = Stage::new(&yaml);
    criterion.bench_function("100 muscles of 24 nodes", |bencher| bencher.iter(|| hundred.frame()));
}

criterion_group!(benches, muscles);
criterion_main!(benches);

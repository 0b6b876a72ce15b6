//! Muscles over elbow angles, contractions, or the time of a clip.

use std::fmt::Write as _;

use serde::{Serialize, Serializer};

use super::{TableError, csv_cell, csv_number};
use sinew_engine::document::{Document, PoseBuffers, PoseState, SourceKind};
use sinew_muscle::{MuscleRig, MuscleSample, Solved};
use sinew_scene::{Frame, Graph, MuscleId, OwnedLabel};

/// Default elbow angles.
const ANGLES: [f64; 4] = [0.0, 30.0, 60.0, 90.0];

/// Contractions, per cent, of a muscle that is on no arm.
const CONTRACTIONS: [f64; 5] = [0.0, 25.0, 50.0, 75.0, 100.0];

/// All muscles of a file. The names and their order are a contract; lengths are in `unit`.
#[derive(Debug, Clone, Serialize)]
pub struct MuscleTable {
    /// The file it was measured in.
    pub file: String,
    /// The unit of lengths.
    pub unit: String,
    /// The joint whose angle was varied, where the file names joints or one was asked for by name.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint: Option<String>,
    /// One entry a muscle.
    pub muscles: Vec<MuscleRows>,
}

/// One muscle.
#[derive(Debug, Clone, Serialize)]
pub struct MuscleRows {
    /// Its name.
    pub name: OwnedLabel,
    /// One row an angle or time.
    pub samples: Vec<MuscleRow>,
}

/// One row of a measurement; lengths are in the file's unit.
#[derive(Debug, Clone, Default, Serialize)]
pub struct MuscleRow {
    /// Seconds on the clip's axis, where the measurement is one over time.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub time: Option<f64>,
    /// Degrees; none for a muscle that is on no arm.
    pub angle: Option<f64>,
    /// Length of the belly, without its tendons; `belly_length` is the same.
    pub length: f64,
    /// Length of the belly.
    pub belly_length: f64,
    /// Length of the muscle-tendon unit: of the line of action; `path_length` is the same.
    pub unit_length: f64,
    /// −dL/dφ about the joint that was turned, or the first one over time; φ in radians.
    pub moment_arm: Option<f64>,
    /// The same about each joint of the muscle's file, by name.
    #[serde(serialize_with = "by_name")]
    pub moment_arms: Vec<(String, f64)>,
    /// Volume of the cones.
    pub volume: f64,
    /// Its difference from the volume at rest, relative.
    pub volume_error: f64,
    /// What the radii grew by, in multiples of their growth.
    pub delta: f64,
    /// Radius of each node.
    pub radii: Vec<f64>,
    /// The largest of them.
    pub largest_radius: f64,
    /// Length from origin to insertion, tendons counted.
    pub path_length: f64,
    /// Whether the length asked for was outside what the muscle can do and was held at the limit.
    pub held: bool,
}

impl MuscleTable {
    /// Measures at angles of a joint, at four of them where none are given; a muscle that no joint turns at five contractions. The joint is the one of this name,
    /// without one the first of each muscle's file; the others are at rest. `None` where angles are given but no joint turns a muscle.
    ///
    /// # Errors
    /// [`UnknownJoint`] where no muscle's file has a joint of that name.
    pub fn over_joint(
        document: &Document,
        file: String,
        joint: Option<&str>,
        angles: Option<&[f64]>,
    ) -> Result<Option<Self>, UnknownJoint> {
        let Some(name) = joint else { return Ok(Self::over_angles(document, file, angles)) };
        let graph = &document.scene.graph;
        let number = |rig: &MuscleRig| joint_names(rig, graph).iter().position(|known| known == name);
        if document.rigs().all(|(rig, _)| number(rig).is_none()) {
            let known = document.rigs().flat_map(|(rig, _)| joint_names(rig, graph)).collect();
            return Err(UnknownJoint { name: name.to_owned(), known });
        }
        let all = document.rigs().filter_map(|(rig, _)| Some((rig, number(rig)?)));
        let muscles = all.flat_map(|(rig, joint)| (0..rig.len()).map(move |index| (rig, joint, index)));
        let rows = |(rig, joint, index): (&MuscleRig, usize, usize)| {
            let names = joint_names(rig, graph);
            let samples = rig.measure_over(index, joint, angles.unwrap_or(&ANGLES));
            MuscleRows { name: rig.label(index).to_owned(), samples: samples.iter().map(|sample| MuscleRow::of(sample, &names)).collect() }
        };
        Ok(Some(Self { file, unit: unit(document), joint: Some(name.to_owned()), muscles: muscles.map(rows).collect() }))
    }

    /// [`MuscleTable::over_joint`] over the first joint of each muscle's file.
    pub fn over_angles(document: &Document, file: String, angles: Option<&[f64]>) -> Option<Self> {
        let muscles = document
            .rigs()
            .flat_map(|(rig, first)| (0..rig.len()).map(move |index| (rig, first, index)))
            .map(|(rig, first, index)| {
                let samples = samples(document, rig, first, index, angles)?;
                Some(MuscleRows { name: rig.label(index).to_owned(), samples })
            })
            .collect::<Option<_>>()?;
        let named = |(rig, _): (&MuscleRig, MuscleId)| rig.joints().next().map(|(name, _)| name.to_owned()).filter(|name| !name.is_empty());
        let joint = document.rigs().next().and_then(named);
        Some(Self { file, unit: unit(document), joint, muscles })
    }

    /// Measures at times of the clip that `state` names, which moves the muscles' bones.
    ///
    /// # Errors
    /// [`TableError`] where there is no clip or no muscle, or there would be too many rows.
    pub fn over_time(document: &Document, file: String, state: &PoseState, times: &[f64]) -> Result<Self, TableError> {
        if state.clip.and_then(|clip| document.clips.get(clip)).is_none() {
            return Err(TableError::NoClip);
        }
        TableError::hold(document.muscle_count(), times.len(), TableError::NoMuscle)?;
        let of_rig = |(rig, _): (&MuscleRig, MuscleId)| {
            let joints = joint_names(rig, &document.scene.graph);
            (0..rig.len()).map(|index| (rig.label(index).to_owned(), joints.clone())).collect::<Vec<_>>()
        };
        let names = document.rigs().flat_map(of_rig);
        let rows = document.measure_times(state, times);
        let muscles = names.zip(&rows).map(|((name, joints), samples)| MuscleRows {
            name,
            samples: samples.iter().map(|sample| MuscleRow::of(sample, &joints)).collect(),
        });
        Ok(Self { file, unit: unit(document), joint: None, muscles: muscles.collect() })
    }

    /// Whether the rows are those of times.
    pub fn is_over_time(&self) -> bool {
        self.muscles.iter().flat_map(|muscle| &muscle.samples).any(|row| row.time.is_some())
    }

    /// A line a sample. Numbers have a point and every digit.
    pub fn csv(&self) -> String {
        let nodes = self.muscles.iter().flat_map(|muscle| &muscle.samples).map(|row| row.radii.len()).max().unwrap_or(0);
        let timed = self.is_over_time();
        let mut text = String::from(if timed { "muscle,time," } else { "muscle," });
        text.push_str("angle,length,moment_arm,volume,volume_error,delta,largest_radius,path_length,held");
        (1..=nodes).for_each(|node| text.push_str(&format!(",r{node}")));
        // One joint is the column `moment_arm` alone.
        let mut joints: Vec<&str> = Vec::new();
        for (joint, _) in self.muscles.iter().flat_map(|muscle| &muscle.samples).flat_map(|row| &row.moment_arms) {
            if !joints.contains(&joint.as_str()) {
                joints.push(joint);
            }
        }
        if joints.len() < 2 {
            joints.clear();
        }
        joints.iter().for_each(|joint| text.push_str(&format!(",{}", csv_cell(&format!("moment_arm {joint}")))));
        text.push('\n');
        for muscle in &self.muscles {
            for row in &muscle.samples {
                let cells = [row.length, row.volume, row.volume_error, row.delta, row.largest_radius, row.path_length]
                    .map(|value| value.to_string());
                let [length, volume, error, delta, largest, path] = cells;
                let (angle, arm) = (csv_number(row.angle), csv_number(row.moment_arm));
                let time = if timed { csv_number(row.time) + "," } else { String::new() };
                // Writing to a string cannot fail.
                let _ = write!(
                    text,
                    "{},{time}{angle},{length},{arm},{volume},{error},{delta},{largest},{path},{}",
                    csv_cell(&muscle.name.to_string()),
                    row.held
                );
                row.radii.iter().for_each(|radius| text.push_str(&format!(",{radius}")));
                if !joints.is_empty() {
                    (row.radii.len()..nodes).for_each(|_| text.push(','));
                }
                for joint in &joints {
                    let arm = row.moment_arms.iter().find(|(name, _)| name == joint).map(|(_, arm)| *arm);
                    text.push_str(&format!(",{}", csv_number(arm)));
                }
                text.push('\n');
            }
        }
        text
    }
}

fn samples(document: &Document, rig: &MuscleRig, first: MuscleId, index: usize, angles: Option<&[f64]>) -> Option<Vec<MuscleRow>> {
    if rig.measured_range().is_some() {
        let joints = joint_names(rig, &document.scene.graph);
        return Some(rig.measure(index, angles.unwrap_or(&ANGLES)).iter().map(|sample| MuscleRow::of(sample, &joints)).collect());
    }
    if angles.is_some() {
        return None;
    }
    let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
    let rows = CONTRACTIONS.iter().filter_map(|contraction| {
        let state = document.start_state().with_drive(rig.at_contraction(*contraction));
        document.pose(&state, &mut buffers, &mut frame);
        buffers.solved().get(first.index() + index).map(|solved| MuscleRow::alone(solved))
    });
    Some(rows.collect())
}

impl MuscleRow {
    /// The row of a sample of a muscle whose file has these joints.
    pub fn of(sample: &MuscleSample, joints: &[String]) -> Self {
        // `+ 0.0` turns a negative zero into zero.
        let plain = |value: Option<f64>| value.map(|value| value + 0.0);
        let moment_arms = joints.iter().cloned().zip(sample.moment_arms.iter().map(|arm| arm + 0.0)).collect();
        let (angle, moment_arm) = (plain(sample.angle), plain(sample.moment_arm));
        Self { time: sample.time, angle, moment_arm, moment_arms, ..Self::alone(&sample.solved) }
    }

    fn alone(solved: &Solved) -> Self {
        Self {
            time: None,
            angle: None,
            length: solved.length,
            belly_length: solved.length,
            unit_length: solved.path_length,
            moment_arm: None,
            moment_arms: Vec::new(),
            volume: solved.volume,
            volume_error: solved.volume_error + 0.0,
            delta: solved.delta + 0.0,
            radii: solved.radii.clone(),
            largest_radius: solved.largest_radius(),
            path_length: solved.path_length,
            held: solved.held,
        }
    }
}

/// What the joints of a muscle file are called.
pub fn joint_names(rig: &MuscleRig, graph: &Graph) -> Vec<String> {
    (0..rig.joints().len()).filter_map(|joint| Some(rig.joint_label(joint, graph)?.to_string())).collect()
}

/// Writes pairs as an object.
fn by_name<S: Serializer>(pairs: &[(String, f64)], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(pairs.iter().map(|(name, value)| (name, value)))
}

/// No muscle's file has a joint of this name.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("no joint “{name}”")]
pub struct UnknownJoint {
    /// The name.
    pub name: String,
    /// The joints that there are.
    pub known: Vec<String>,
}

/// The name of the unit of the muscles' lengths.
pub fn unit(document: &Document) -> String {
    let metres = document.sources.iter().find_map(|source| match &source.kind {
        SourceKind::Muscles(file, _) => Some(file.unit_metres),
        SourceKind::Scene(_) => None,
    });
    unit_name(metres.unwrap_or(1.0))
}

/// The name of a unit that is this many metres long.
pub fn unit_name(metres: f64) -> String {
    let known = [(1e-3, "mm"), (1e-2, "cm"), (1.0, "m"), (0.0254, "in")];
    let found = known.iter().find(|(value, _)| (value - metres).abs() <= 1e-9 * value);
    found.map_or_else(|| format!("{metres} m"), |(_, name)| (*name).to_owned())
}

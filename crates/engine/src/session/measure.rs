//! Measurements of a muscle over the joint angle or over the time of the clip.

use std::fmt::Write as _;
use std::ops::RangeInclusive;

use super::{Session, UndoStep};
use sinew_muscle::parameter_fit::{Model, fitted_file};
use sinew_muscle::validation::{CompareError, Table};
use sinew_muscle::{MuscleFile, MuscleSample};
use sinew_scene::message;
use sinew_scene::{MuscleId, OwnedLabel};

/// Moments and angles of a curve.
const ANGLE_STEPS: u32 = 90;
const TIME_STEPS: u32 = 120;

/// What goes right in a plot.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum MeasureAxis {
    /// The angle of the joint that the muscle crosses.
    #[default]
    Angle,
    /// The time of the clip.
    Time,
}

impl MeasureAxis {
    /// Where a sample stands on the axis.
    pub fn of(self, sample: &MuscleSample) -> f64 {
        match self {
            Self::Angle => sample.angle,
            Self::Time => sample.time,
        }
        .unwrap_or(f64::NAN)
    }
}

impl Session {
    /// The joints of the muscle's file, by what they are called.
    pub fn measured_joints(&self, muscle: MuscleId) -> Vec<OwnedLabel> {
        let Some((rig, _)) = self.document.muscle(muscle) else { return Vec::new() };
        (0..rig.joints().len()).filter_map(|joint| rig.joint_label(joint, &self.document.scene.graph)).collect()
    }

    /// The angles of a joint of its file, degrees, or the seconds that a muscle can be measured over; `None` where there is no joint, or no clip that moves it.
    pub fn measurable(&self, muscle: MuscleId, axis: MeasureAxis, joint: usize) -> Option<RangeInclusive<f64>> {
        let (rig, index) = self.document.muscle(muscle)?;
        match axis {
            MeasureAxis::Angle => rig.flexion_range().or_else(|| rig.range_of(joint)),
            MeasureAxis::Time => {
                // A muscle on an arm of its own is moved by no clip.
                let moved = rig.is_attached(index) && rig.flexion_range().is_none();
                self.clip().filter(|clip| moved && clip.end > clip.start).map(|clip| clip.start..=clip.end)
            }
        }
    }

    /// Measures a muscle over the whole range of a joint of its file, the others at rest, or over the clip; empty where there is no range.
    pub fn measure(&self, muscle: MuscleId, axis: MeasureAxis, joint: usize) -> Vec<MuscleSample> {
        let Some((range, (rig, index))) = self.measurable(muscle, axis, joint).zip(self.document.muscle(muscle)) else { return Vec::new() };
        match axis {
            MeasureAxis::Angle => rig.measure_over(index, joint, &steps(&range, ANGLE_STEPS)),
            MeasureAxis::Time => {
                let mut rows = self.document.measure_times(&self.state(), &steps(&range, TIME_STEPS));
                if muscle.index() < rows.len() { rows.swap_remove(muscle.index()) } else { Vec::new() }
            }
        }
    }

    /// `wanted`, where a joint turns it; else the first muscle that one turns.
    pub fn muscle_on_joint(&self, wanted: MuscleId) -> Option<MuscleId> {
        let turned =
            |id: &MuscleId| self.document.muscle(*id).is_some_and(|(rig, index)| rig.is_attached(index) && rig.measured_range().is_some());
        let count = u32::try_from(self.document.muscle_count()).unwrap_or(u32::MAX);
        std::iter::once(wanted).chain((0..count).map(MuscleId)).find(turned)
    }

    /// Fits muscle `id` to measured radii (see [`fitted_file`]); undo takes that back.
    ///
    /// # Errors
    /// [`CompareError`] where the table does not fit the muscle; nothing is changed then.
    pub fn fit_muscle(&mut self, id: MuscleId, table: &Table, model: Model) -> Result<(), CompareError> {
        let place = self.document.file_of_muscle(id).zip(self.document.muscle(id));
        let Some(((place, index), (rig, _))) = place else { return Err(CompareError::NoJoint) };
        let mut files: Vec<MuscleFile> = self.document.muscle_files().cloned().collect();
        let Some(file) = files.get_mut(place) else { return Err(CompareError::NoJoint) };
        *file = fitted_file(file, rig, index, table, model)?.file;
        self.change_files(&files, message!("app-do-fit-radii"), UndoStep::New);
        Ok(())
    }

    /// Where the present pose stands on that axis.
    pub fn current_value(&self, muscle: MuscleId, axis: MeasureAxis, joint: usize) -> Option<f64> {
        let (rig, _) = self.document.muscle(muscle)?;
        match axis {
            MeasureAxis::Time => Some(self.playback.time),
            MeasureAxis::Angle if rig.flexion_range().is_some() => Some(self.state.joints.drive.flexion),
            MeasureAxis::Angle => rig.joints().nth(joint)?.1.angle(&self.document.scene, &self.posed().world),
        }
    }
}

fn steps(range: &RangeInclusive<f64>, count: u32) -> Vec<f64> {
    let step = (range.end() - range.start()) / f64::from(count);
    (0..=count).map(|index| range.start() + f64::from(index) * step).collect()
}

/// One row a sample, with decimal points; lengths in the file's unit. Where there are several joints, the last columns are the moment arms about each.
pub fn csv(samples: &[MuscleSample], joints: &[OwnedLabel]) -> String {
    let nodes = samples.first().map_or(0, |sample| sample.solved.radii.len());
    let timed = samples.iter().any(|sample| sample.time.is_some());
    let mut text = String::from(if timed { "time,angle" } else { "angle" });
    text.push_str(",length,moment_arm,volume,volume_error,delta,unit_length");
    for node in 1..=nodes {
        // Writing to a string cannot fail.
        let _ = write!(text, ",r{node}");
    }
    let joints = if joints.len() > 1 { joints } else { &[] };
    for joint in joints {
        let _ = write!(text, ",\"moment_arm {}\"", joint.to_string().replace('"', "\"\""));
    }
    text.push('\n');
    // `+ 0.0` turns a negative zero into zero.
    let cell = |value: Option<f64>| value.map(|value| (value + 0.0).to_string()).unwrap_or_default();
    for sample in samples {
        let solved = &sample.solved;
        if timed {
            let _ = write!(text, "{},", cell(sample.time));
        }
        let numbers = [solved.length, solved.volume, solved.volume_error, solved.delta].map(|value| cell(Some(value)));
        let [length, volume, error, delta] = numbers;
        let (angle, unit, arm) = (cell(sample.angle), cell(Some(solved.path_length)), cell(sample.moment_arm));
        let _ = write!(text, "{angle},{length},{arm},{volume},{error},{delta},{unit}");
        for radius in &solved.radii {
            let _ = write!(text, ",{radius}");
        }
        for joint in 0..joints.len() {
            let _ = write!(text, ",{}", cell(sample.moment_arms.get(joint).copied()));
        }
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use sinew_muscle::Solved;

    #[test]
    fn the_table_has_a_column_a_radius_and_one_for_time_where_there_is_any() {
        let solved = Solved { length: 2.5, path_length: 3.0, radii: vec![1.0, 2.0], delta: -0.0, ..Solved::default() };
        let bent = MuscleSample { time: None, angle: Some(30.0), moment_arm: Some(0.5), moment_arms: vec![0.5], solved };
        let moving = MuscleSample { time: Some(0.25), angle: None, ..bent.clone() };
        let joint = |name: &str| OwnedLabel::from(name);
        assert_eq!(
            csv(std::slice::from_ref(&bent), &[joint("elbow")]),
            "angle,length,moment_arm,volume,volume_error,delta,unit_length,r1,r2\n30,2.5,0.5,0,0,0,3,1,2\n"
        );
        assert_eq!(
            csv(&[moving], &[]),
            "time,angle,length,moment_arm,volume,volume_error,delta,unit_length,r1,r2\n0.25,,2.5,0.5,0,0,0,3,1,2\n"
        );
        // A column a joint where there are several.
        let over = MuscleSample { moment_arms: vec![0.5, -0.0], ..bent };
        assert_eq!(
            csv(&[over], &[joint("elbow"), joint("the \"other\"")]),
            "angle,length,moment_arm,volume,volume_error,delta,unit_length,r1,r2,\"moment_arm elbow\",\"moment_arm the \"\"other\"\"\"\n30,2.5,0.5,0,0,0,3,1,2,0.5,0\n"
        );
    }
}

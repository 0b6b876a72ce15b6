//! Joints over the time of a clip.

use serde::Serialize;

use super::{TableError, csv_cell, csv_number};
use sinew_engine::document::{Document, JointSample, PoseState};
use sinew_scene::NodeKind;

/// All joints of a document at times of a clip. The names and their order are a contract.
#[derive(Debug, Clone, Serialize)]
pub struct JointTable {
    /// The file it was measured in.
    pub file: String,
    /// The clip.
    pub clip: String,
    /// One entry a joint, those above first.
    pub joints: Vec<JointRows>,
}

/// One joint.
#[derive(Debug, Clone, Serialize)]
pub struct JointRows {
    /// Its name.
    pub name: String,
    /// One row a time.
    pub samples: Vec<JointRow>,
}

/// One joint at one time; angles in degrees.
#[derive(Debug, Clone, Serialize)]
pub struct JointRow {
    /// Seconds on the clip's axis.
    pub time: f64,
    /// See [`JointSample::flexion`].
    pub flexion: Option<f64>,
    /// How far the joint is turned from its rest pose, 0 to 180.
    pub turn: Option<f64>,
    /// The turn's axis times its angle, in the axes of the node above.
    pub turn_x: Option<f64>,
    /// See [`JointRow::turn_x`].
    pub turn_y: Option<f64>,
    /// See [`JointRow::turn_x`].
    pub turn_z: Option<f64>,
}

impl JointTable {
    /// Measures at these times of the clip that `state` names.
    ///
    /// # Errors
    /// [`TableError`] where there is no clip or no joint, or there would be too many rows.
    pub fn over_time(document: &Document, file: String, state: &PoseState, times: &[f64]) -> Result<Self, TableError> {
        let clip = state.clip.and_then(|clip| document.clips.get(clip)).ok_or(TableError::NoClip)?.label().plain().into_owned();
        TableError::hold(count(document), times.len(), TableError::NoJoint)?;
        let joints = document.joint_angles(state, times).into_iter().map(|track| JointRows {
            name: document.scene.graph.label(track.node).plain().into_owned(),
            samples: track.samples.iter().map(JointRow::of).collect(),
        });
        Ok(Self { file, clip, joints: joints.collect() })
    }

    /// A line a joint and time. Numbers have a point and every digit.
    pub fn csv(&self) -> String {
        let mut text = String::from("joint,time,flexion,turn,turn_x,turn_y,turn_z\n");
        for joint in &self.joints {
            let name = csv_cell(&joint.name);
            for row in &joint.samples {
                let cells = [row.flexion, row.turn, row.turn_x, row.turn_y, row.turn_z].map(csv_number);
                text.push_str(&format!("{name},{},{}\n", row.time, cells.join(",")));
            }
        }
        text
    }
}

/// How many joints a document has.
pub(super) fn count(document: &Document) -> usize {
    document.scene.graph.iter().filter(|(_, node)| node.kind == NodeKind::Joint).count()
}

impl JointRow {
    fn of(sample: &JointSample) -> Self {
        // `+ 0.0` turns a negative zero into zero.
        let part = |index: usize| sample.turn.map(|turn| turn[index] + 0.0);
        Self {
            time: sample.time,
            flexion: sample.flexion,
            turn: sample.turn.map(|turn| turn.length()),
            turn_x: part(0),
            turn_y: part(1),
            turn_z: part(2),
        }
    }
}

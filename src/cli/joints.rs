//! `sinew measure --joints`: what each joint does over a clip.

use super::text_table::columns;
use crate::export::tables::{JointRow, JointTable};
use crate::i18n::decimal;
use crate::tr;

/// A line a joint, for people: from where to where it goes. All rows are for programs.
pub(super) fn text(table: &JointTable) -> String {
    let mut rows = vec![vec![
        tr!("cli-joints-name"),
        tr!("cli-joints-flexion-least"),
        tr!("cli-joints-flexion-most"),
        tr!("cli-joints-rotation-least"),
        tr!("cli-joints-rotation-most"),
    ]];
    for joint in &table.joints {
        let ends = |pick: fn(&JointRow) -> Option<f64>| {
            let values = || joint.samples.iter().filter_map(pick);
            // Infinite where there is no value at all.
            [values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max)]
                .map(|value| if value.is_finite() { decimal(value, 1) } else { "–".to_owned() })
        };
        let [flexion, turn] = [ends(|row| row.flexion), ends(|row| row.turn)];
        rows.push([vec![joint.name.clone()], flexion.into(), turn.into()].concat());
    }
    columns(&rows)
}

//! Tables as plots.

use super::{JointRow, JointTable, MeasureTable, MuscleRow, MuscleRows, MuscleTable};
use crate::plot::{Page, Plot, PlotCurve, Series};
use sinew_muscle::literature_data::{self, Published};
use sinew_scene::OwnedLabel;
use sinew_scene::message;
use sinew_scene::message::{Message, ToMessage};

/// Makes a sentence of a message, in the user's language.
pub type Translate = fn(&Message) -> String;

/// Colours that people with any colour vision tell apart (M. Okabe, K. Ito: Color Universal Design, 2008), without the light yellow.
const COLORS: [u32; 7] = [0x0072B2, 0xD55E00, 0x009E73, 0xCC79A7, 0xE69F00, 0x56B4E9, 0x000000];

/// A volume is drawn in at least this part of itself, so that rounding errors stay a level line.
const LEVEL: f64 = 0.02;

impl MeasureTable {
    /// The table as curves, at most seven to a plot: more could not be told apart.
    pub fn page(&self, say: Translate) -> Page {
        match self {
            Self::Muscles(table) => table.page(say),
            Self::Joints(table) => table.page(say),
        }
    }
}

/// One plot of several things.
fn plot(up: String, across: String, curves: Vec<(String, Vec<(f64, f64)>)>, least_span: f64) -> Plot {
    let several = curves.len() > 1;
    let mut curves = curves.into_iter().zip(COLORS).map(|((name, mut points), color)| {
        points.retain(|(x, _)| x.is_finite());
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        PlotCurve { name, color, points }
    });
    let PlotCurve { name, color, points } = curves.next().unwrap_or_default();
    let name = if several { name } else { String::new() };
    Plot { x_label: across, y_label: up, points, name, color, more_curves: curves.collect(), min_y_span: least_span, ..Plot::default() }
}

impl MuscleTable {
    /// Length, moment arm, largest radius and volume of each muscle: over the angle or the time, or, for a muscle on no arm, over its length.
    fn page(&self, say: Translate) -> Page {
        type Column = fn(&MuscleRow) -> Option<f64>;
        let shown: Vec<&MuscleRows> = self.muscles.iter().take(COLORS.len()).collect();
        let unit = unit_label(&self.unit);
        let rows = || shown.iter().flat_map(|muscle| &muscle.samples);
        let any = |pick: Column| rows().any(|row| pick(row).is_some());
        let (across, at): (String, Column) = if self.is_over_time() {
            (say(&message!("cli-measure-time")), |row| row.time)
        } else if any(|row| row.angle) {
            (say(&message!("cli-measure-angle")), |row| row.angle)
        } else {
            (say(&message!("cli-measure-length", unit = unit.clone())), |row| Some(row.length))
        };
        let panel = |up: String, pick: Column, least_span: f64| {
            let point = |row: &MuscleRow| (at(row).unwrap_or(f64::NAN), pick(row).unwrap_or(f64::NAN));
            let name = |label: &OwnedLabel| match label {
                OwnedLabel::Name(name) => name.clone(),
                OwnedLabel::Unnamed(unnamed) => say(&unnamed.message()),
            };
            let curves = shown.iter().map(|muscle| (name(&muscle.name), muscle.samples.iter().map(point).collect()));
            plot(up, across.clone(), curves.collect(), least_span)
        };
        let mut plots = Vec::new();
        if self.is_over_time() || any(|row| row.angle) {
            plots.push(panel(say(&message!("cli-measure-length", unit = unit.clone())), |row| Some(row.length), 0.0));
        }
        if any(|row| row.moment_arm) {
            plots.push(panel(say(&message!("cli-measure-moment-arm", unit = unit.clone())), |row| row.moment_arm, 0.0));
        }
        plots.push(panel(say(&message!("cli-measure-largest", unit = unit.clone())), |row| Some(row.largest_radius), 0.0));
        let most = rows().map(|row| row.volume).fold(0.0, f64::max);
        plots.push(panel(say(&message!("cli-measure-volume", unit = unit)), |row| Some(row.volume), most * LEVEL));
        Page { sections: vec![(title(&self.file, shown.len(), self.muscles.len(), say), plots)] }
    }
}

impl MuscleTable {
    /// The moment arm of each muscle over the angle of its joint, with what was published of a muscle of its name on the same axes; `None` where that is
    /// nothing, or there is no angle. `metres` is the length of the table's unit.
    pub fn published_page(&self, metres: f64, say: Translate) -> Option<Page> {
        // Centimetres to the table's unit.
        let scale = 0.01 / metres;
        let of_muscle = |muscle: &MuscleRows| {
            let name = muscle.name.to_string();
            let series = |published: &Published| Series {
                name: published.name.to_owned(),
                points: published.points.iter().map(|[angle, arm]| (*angle, arm * scale)).collect(),
            };
            let reference_series: Vec<Series> = literature_data::moment_arms(&name).iter().map(series).collect();
            let point = |row: &MuscleRow| Some((row.angle?, row.moment_arm?));
            let points: Vec<(f64, f64)> = muscle.samples.iter().filter_map(point).collect();
            let (up, across) = (message!("cli-measure-moment-arm", unit = unit_label(&self.unit)), message!("cli-measure-angle"));
            let curves = vec![(String::new(), points)];
            (!reference_series.is_empty() && curves.iter().any(|(_, points)| points.len() > 1)).then(|| Plot {
                name,
                reference_series,
                reference_color: COLORS[1],
                ..plot(say(&up), say(&across), curves, 0.0)
            })
        };
        let plots: Vec<Plot> = self.muscles.iter().filter_map(of_muscle).collect();
        (!plots.is_empty()).then(|| Page { sections: vec![(self.file.clone(), plots)] })
    }
}

impl JointTable {
    /// Flexion and turn over time, of the joints that move most where there are many.
    fn page(&self, say: Translate) -> Page {
        let span = |samples: &[JointRow], pick: fn(&JointRow) -> Option<f64>| {
            let values = || samples.iter().filter_map(pick);
            (values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min)).max(0.0)
        };
        let moved = |samples: &[JointRow]| span(samples, |row| row.flexion).max(span(samples, |row| row.turn));
        let mut order: Vec<(f64, usize)> = self.joints.iter().zip(0..).map(|(joint, index)| (moved(&joint.samples), index)).collect();
        order.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let mut shown: Vec<usize> = order.into_iter().take(COLORS.len()).map(|(_, index)| index).collect();
        shown.sort_unstable();
        let shown: Vec<_> = shown.into_iter().filter_map(|index| self.joints.get(index)).collect();
        let panel = |up: String, pick: fn(&JointRow) -> Option<f64>| {
            let point = |row: &JointRow| (row.time, pick(row).unwrap_or(f64::NAN));
            let curves = shown.iter().map(|joint| (joint.name.clone(), joint.samples.iter().map(point).collect()));
            plot(up, say(&message!("cli-measure-time")), curves.collect(), 0.0)
        };
        let plots = vec![panel(say(&message!("plot-flexion")), |row| row.flexion), panel(say(&message!("plot-rotation")), |row| row.turn)];
        Page { sections: vec![(title(&format!("{}: {}", self.file, self.clip), shown.len(), self.joints.len(), say), plots)] }
    }
}

fn title(what: &str, shown: usize, all: usize, say: Translate) -> String {
    if shown < all { say(&message!("plot-some", what = what, shown = shown, all = all)) } else { what.to_owned() }
}

/// A unit as people write it.
pub fn unit_label(unit: &str) -> Message {
    match unit {
        "mm" => message!("cli-unit-mm"),
        "cm" => message!("cli-unit-cm"),
        "m" => message!("cli-unit-m"),
        "in" => message!("cli-unit-in"),
        other => Message::verbatim(other),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tables::{JointRows, TableSubject};
    use sinew_engine::document::Document;

    #[test]
    fn an_arm_is_plotted_over_its_angle() {
        let document = Document::built_in();
        let table = MeasureTable::measure(TableSubject::Muscles, &document, &document.start_state(), 25.0).expect("a muscle on an arm");
        let page = table.page(sinew_i18n::sentence);
        let [(_, plots)] = &page.sections[..] else { panic!("one section") };
        assert_eq!(plots.len(), 4);
        for plot in plots {
            assert!(plot.points.len() > 80 && plot.points.windows(2).all(|pair| pair[0].0 < pair[1].0), "{}", plot.y_label);
            assert!(plot.more_curves.is_empty() && plot.name.is_empty());
        }
        let volumes = &plots[3].points;
        assert!(volumes.iter().all(|(_, volume)| (volume - volumes[0].1).abs() < 1e-9 * volumes[0].1));
    }

    #[test]
    fn published_moment_arms_stand_behind_those_of_a_muscle_of_their_name() {
        let row = |angle: f64, arm: f64| MuscleRow { angle: Some(angle), moment_arm: Some(arm), ..MuscleRow::default() };
        let muscle = |name: &str| MuscleRows { name: OwnedLabel::Name(name.into()), samples: vec![row(0.0, 9.0), row(130.0, 40.0)] };
        let table = |names: &[&str]| MuscleTable {
            file: "f".into(),
            unit: "mm".into(),
            joint: None,
            muscles: names.iter().map(|name| muscle(name)).collect(),
        };
        let page = table(&["Biceps", "Deltoid", "Triceps"]).published_page(0.001, sinew_i18n::sentence).expect("a page");
        let [(_, plots)] = &page.sections[..] else { panic!("one section") };
        let names: Vec<&str> = plots.iter().map(|plot| plot.name.as_str()).collect();
        assert_eq!(names, ["Biceps", "Triceps"]);
        assert_eq!(plots[0].points, [(0.0, 9.0), (130.0, 40.0)]);
        let first = &plots[0].reference_series[0];
        // 0.94 cm at 0° in Arm26, in millimetres.
        assert!(first.points[0].0 == 0.0 && (first.points[0].1 - 9.4).abs() < 1e-12 && first.points.len() == 14);
        assert!(table(&["Deltoid"]).published_page(0.001, sinew_i18n::sentence).is_none());
    }

    #[test]
    fn of_many_joints_those_that_move_most_are_shown_in_their_order() {
        let joint = |index: usize| JointRows {
            name: index.to_string(),
            samples: [0.0, 1.0]
                .map(|time| JointRow { time, flexion: None, turn: Some(time * index as f64), turn_x: None, turn_y: None, turn_z: None })
                .into(),
        };
        let table = JointTable { file: "f".into(), clip: "c".into(), joints: (0..20).map(joint).collect() };
        let page = table.page(sinew_i18n::sentence);
        let (title, plots) = &page.sections[0];
        let names: Vec<&str> =
            std::iter::once(&plots[1].name).chain(plots[1].more_curves.iter().map(|curve| &curve.name)).map(String::as_str).collect();
        assert_eq!(names, ["13", "14", "15", "16", "17", "18", "19"]);
        assert_eq!(plots[1].more_curves[5].points, [(0.0, 0.0), (1.0, 19.0)]);
        assert!(title.contains("20"));
    }
}

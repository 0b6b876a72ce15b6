//! Comparison of a muscle with measured radii: the differences, and a fit of the growth.

use std::cell::RefCell;
use std::path::Path;
use std::rc::Rc;

use gtk::glib;
use gtk::prelude::*;
use gtk4 as gtk;

use crate::app::format;
use crate::app::handles::app_context::AppContext;
use crate::app::notices::error_bar::ErrorMessage;
use crate::app::panels::muscle::muscle_panel::Unit;
use crate::app::widgets::ui;
use crate::i18n::{self, Sentence};
use crate::input;
use crate::limits;
use crate::muscle::literature_data;
use crate::muscle::parameter_fit::{Fits, Model, fit};
use crate::muscle::validation::{Comparison, Table, compare};
use crate::scene::MuscleId;
use crate::tr;

/// Millilitres of a cubic metre.
const MILLILITRES: f64 = 1e6;

ui::widgets! {
    /// The widgets of the window.
    struct MeasurementComparisonWidgets from "measurement_comparison.ui" {
        root: gtk::Window,
        title: gtk::Label,
        open: gtk::Button,
        fit: gtk::Button,
        poses: gtk::Button,
        trouble: gtk::Label,
        tables: gtk::Box,
        radii_title: gtk::Label,
        radii: gtk::Grid,
        growth_title: gtk::Label,
        growth: gtk::Grid,
        why: gtk::Label,
        rms_title: gtk::Label,
        rms: gtk::Grid,
    }
}

/// The window, and what it shows.
struct MeasurementComparison {
    widgets: MeasurementComparisonWidgets,
    muscle: MuscleId,
    /// What was measured, and where that stands.
    data: RefCell<(Table, String)>,
}

/// Opens the comparison of a muscle with measured radii.
pub(crate) fn show(app: &Rc<AppContext>, muscle: MuscleId) {
    // The table that comes with the program is parsed by a test.
    let Ok(table) = Table::parse(literature_data::MEASURED_RADII) else { return };
    let data = RefCell::new((table, "biceps-radii.csv".to_owned()));
    let comparison = Rc::new(MeasurementComparison { widgets: MeasurementComparisonWidgets::build(), muscle, data });
    let root = comparison.root().clone();
    root.set_transient_for(Some(&app.widget));
    comparison.connect(app);
    comparison.refresh(app);
    root.present();
}

impl MeasurementComparison {
    fn root(&self) -> &gtk::Window {
        &self.widgets.root
    }

    fn connect(self: &Rc<Self>, app: &Rc<AppContext>) {
        for (button, model) in [(&self.widgets.fit, Model::Growth), (&self.widgets.poses, Model::Poses)] {
            button.connect_clicked(glib::clone!(
                #[strong(rename_to = comparison)]
                self,
                #[weak]
                app,
                move |_| {
                    let table = comparison.data.borrow().0.clone();
                    let mut result = Ok(());
                    app.session.update(|session| result = session.fit_muscle(comparison.muscle, &table, model));
                    match result {
                        Ok(()) => comparison.refresh(&app),
                        Err(error) => comparison.say(&error.sentence()),
                    }
                }
            ));
        }
        self.widgets.open.connect_clicked(glib::clone!(
            #[strong(rename_to = comparison)]
            self,
            #[weak]
            app,
            move |_| comparison.choose(&app)
        ));
        self.root().connect_close_request(glib::clone!(
            #[weak]
            app,
            #[upgrade_or]
            glib::Propagation::Proceed,
            move |_| {
                app.open_files.compares_table(None);
                glib::Propagation::Proceed
            }
        ));
        let keys = gtk::EventControllerKey::new();
        let root = self.root().downgrade();
        keys.connect_key_pressed(move |_, key, _, _| {
            if key == gtk::gdk::Key::Escape
                && let Some(root) = root.upgrade()
            {
                root.close();
                return glib::Propagation::Stop;
            }
            glib::Propagation::Proceed
        });
        self.root().add_controller(keys);
    }

    /// Asks for another table.
    fn choose(self: &Rc<Self>, app: &Rc<AppContext>) {
        let dialog = gtk::FileChooserNative::new(
            Some(&tr!("app-validation-choose")),
            Some(self.root()),
            gtk::FileChooserAction::Open,
            Some(&tr!("app-open")),
            Some(&tr!("app-cancel")),
        );
        let keep = RefCell::new(Some(dialog.clone()));
        dialog.connect_response(glib::clone!(
            #[strong(rename_to = comparison)]
            self,
            #[weak]
            app,
            move |dialog, response| {
                keep.take();
                let Some(path) = dialog.file().and_then(|file| file.path()).filter(|_| response == gtk::ResponseType::Accept) else {
                    return;
                };
                match read(&path) {
                    Ok(data) => {
                        comparison.data.replace(data);
                        app.open_files.compares_table(Some(path));
                        comparison.refresh(&app);
                    }
                    Err(message) => app.error_bar.show(ErrorMessage {
                        headline: tr!("app-validation-unread"),
                        message,
                        details: path.display().to_string(),
                        again: None,
                    }),
                }
            }
        ));
        dialog.show();
    }

    /// Says why there are no tables.
    fn say(&self, why: &str) {
        ui::set_label(&self.widgets.trouble, why);
        self.widgets.trouble.set_visible(!why.is_empty());
        self.widgets.tables.set_visible(why.is_empty());
    }

    fn refresh(&self, app: &Rc<AppContext>) {
        let data = self.data.borrow();
        let (table, name) = &*data;
        let told = app.session.read(|session| {
            let document = session.document();
            let (rig, index) = document.muscle(self.muscle)?;
            let found = compare(rig, index, table).and_then(|comparison| Ok((comparison, fit(rig, index, table)?)));
            Some((i18n::label(rig.label(index)).into_owned(), Unit::of_rig(document, rig), found))
        });
        let Some((muscle, unit, found)) = told else { return self.root().close() };
        self.widgets.title.set_text(&tr!("app-validation-title", muscle = muscle, file = name.as_str()));
        match found {
            Ok((comparison, fits)) => {
                self.say("");
                self.show_tables(&comparison, &fits, &unit);
            }
            Err(error) => self.say(&error.sentence()),
        }
    }

    fn show_tables(&self, found: &Comparison, fits: &Fits, unit: &Unit) {
        let length = unit.length.as_str();
        self.widgets.radii_title.set_text(&tr!("app-validation-radii", unit = length));
        fill(&self.widgets.radii, &radii(found, unit));
        let (from, to) = (found.angles.first().copied().unwrap_or(0.0), found.angles.last().copied().unwrap_or(0.0));
        let (from, to) = (format::number(from, 0), format::number(to, 0));
        let title = tr!("cli-compare-growth", from = from.clone(), to = to.clone(), unit = length);
        self.widgets.growth_title.set_text(&title);
        fill(&self.widgets.growth, &growth(found));
        let mut why = Vec::new();
        if found.growth_ratio.is_finite() {
            why.push(tr!("cli-compare-ratio", from = from, to = to, ratio = format::number(found.growth_ratio, 1)));
        }
        let volumes = || found.implied_volumes.iter().copied();
        let (least, most) = (volumes().fold(f64::INFINITY, f64::min), volumes().fold(0.0, f64::max));
        if least > 0.0 && most > least * 1.01 {
            why.push(tr!("cli-compare-explained", spread = format::number((most / least - 1.0) * 100.0, 0)));
        }
        self.widgets.why.set_text(&why.join("\n"));
        self.widgets.rms_title.set_text(&tr!("cli-rms-title", unit = length));
        let rows = [("cli-rms-own", fits.own), ("cli-rms-fitted", fits.fitted), ("cli-rms-poses", fits.poses)];
        fill(&self.widgets.rms, &rows.map(|(key, rms)| vec![tr!(key), format::number(rms, 2)]));
    }
}

/// A table of measured radii and its name.
fn read(path: &Path) -> Result<(Table, String), String> {
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let text = input::read_text(path, limits::YAML_BYTES).map_err(|refused| refused.sentence())?;
    let table = Table::parse(&text).map_err(|error| format!("{name}:{}:{}: {}", error.line, error.column, error.sentence()))?;
    Ok((table, name))
}

/// A row a node, model and measurement of each angle side by side, then the difference and the volume that the measurement implies.
fn radii(found: &Comparison, unit: &Unit) -> Vec<Vec<String>> {
    let mut head = vec![tr!("cli-compare-node")];
    for angle in &found.angles {
        head.extend([tr!("cli-compare-model", angle = format::number(*angle, 0)), tr!("cli-compare-measured")]);
    }
    let mut rows = vec![head];
    for (node, (model, measured)) in found.nodes.clone().zip(found.model.iter().zip(&found.measured)) {
        let pairs = model.iter().zip(measured).flat_map(|(model, measured)| [format::number(*model, 1), format::number(*measured, 1)]);
        rows.push(std::iter::once((node + 1).to_string()).chain(pairs).collect());
    }
    let last = |name: String, values: Vec<String>| {
        std::iter::once(name).chain(values.into_iter().flat_map(|value| [String::new(), value])).collect::<Vec<_>>()
    };
    rows.push(last(tr!("cli-compare-rms"), found.rms_at.iter().map(|rms| format::number(*rms, 2)).collect()));
    let scale = unit.metres.powi(3) * MILLILITRES;
    let modelled = found.samples.iter().map(|sample| sample.solved.volume * scale);
    let volumes =
        modelled.zip(&found.implied_volumes).flat_map(|(model, implied)| [format::number(model, 0), format::number(implied * scale, 0)]);
    rows.push(std::iter::once(tr!("cli-compare-volume", unit = tr!("cli-unit-ml"))).chain(volumes).collect());
    rows
}

/// A row a node: how much it grows in the model, how much in the measurement, and how many times that is.
fn growth(found: &Comparison) -> Vec<Vec<String>> {
    let mut rows =
        vec![vec![tr!("cli-compare-node"), tr!("cli-compare-grown-model"), tr!("cli-compare-measured"), tr!("cli-compare-times")]];
    for (node, [model, measured]) in found.nodes.clone().zip(&found.growth) {
        let times = if *model == 0.0 { f64::NAN } else { measured / model };
        rows.push(vec![(node + 1).to_string(), format::number(*model, 2), format::number(*measured, 2), format::number(times, 1)]);
    }
    rows
}

/// Puts a table into a grid: numbers to the right, the first row and column as headings.
fn fill(grid: &gtk::Grid, rows: &[Vec<String>]) {
    while let Some(child) = grid.first_child() {
        grid.remove(&child);
    }
    for (row, cells) in rows.iter().enumerate() {
        for (column, cell) in cells.iter().enumerate() {
            let label = gtk::Label::builder().label(cell).xalign(if column == 0 { 0.0 } else { 1.0 }).build();
            label.add_css_class(if row == 0 || column == 0 { "dim-label" } else { "numeric" });
            grid.attach(&label, column as i32, row as i32, 1, 1);
        }
    }
}

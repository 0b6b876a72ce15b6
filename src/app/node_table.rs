//! The table of a muscle's nodes: radius at rest, growth, radius now.

use std::cell::RefCell;
use std::rc::Rc;

use gtk::prelude::*;
use gtk::{gio, glib};
use gtk4 as gtk;

use super::format;
use crate::muscle::Profile;
use crate::tr;

/// What the cells show.
#[derive(Default)]
struct Values {
    columns: [Vec<f64>; 3],
    /// Labels on screen with their row and column.
    shown: Vec<(gtk::Label, u32, usize)>,
}

/// The table.
pub struct NodeTable {
    view: gtk::ColumnView,
    values: Rc<RefCell<Values>>,
    store: gio::ListStore,
}

impl NodeTable {
    /// Puts the columns into a view.
    pub fn new(view: &gtk::ColumnView) -> Self {
        let store = gio::ListStore::new::<glib::BoxedAnyObject>();
        view.set_model(Some(&gtk::NoSelection::new(Some(store.clone()))));
        let table = Self { view: view.clone(), values: Rc::default(), store };
        for column in 0..4 {
            let column = gtk::ColumnViewColumn::new(None, Some(table.factory(column)));
            column.set_expand(true);
            view.append_column(&column);
        }
        table
    }

    fn factory(&self, column: usize) -> gtk::SignalListItemFactory {
        let factory = gtk::SignalListItemFactory::new();
        factory.connect_setup(|_, item| {
            if let Some(item) = item.downcast_ref::<gtk::ListItem>() {
                let label = gtk::Label::builder().xalign(1.0).hexpand(true).css_classes(["numeric"]).build();
                item.set_child(Some(&label));
            }
        });
        let values = self.values.clone();
        factory.connect_bind(move |_, item| {
            let Some(item) = item.downcast_ref::<gtk::ListItem>() else { return };
            if let Some(label) = item.child().and_downcast::<gtk::Label>() {
                let row = item.position();
                let mut values = values.borrow_mut();
                label.set_text(&values.text(row, column));
                values.shown.push((label, row, column));
            }
        });
        let values = self.values.clone();
        factory.connect_unbind(move |_, item| {
            let label = item.downcast_ref::<gtk::ListItem>().and_then(gtk::ListItem::child).and_downcast::<gtk::Label>();
            values.borrow_mut().shown.retain(|(shown, _, _)| Some(shown) != label.as_ref());
        });
        factory
    }

    /// Shows a muscle; `anew` where it is another one.
    pub fn show(&self, profile: &Profile, radii: &[f64], unit: &str, anew: bool) {
        {
            let mut values = self.values.borrow_mut();
            values.columns = [profile.radii().to_vec(), profile.growth().to_vec(), radii.to_vec()];
            for (label, row, column) in &values.shown {
                label.set_text(&values.text(*row, *column));
            }
        }
        if anew || self.store.n_items() as usize != radii.len() {
            let items: Vec<_> = (0..radii.len() as u32).map(glib::BoxedAnyObject::new).collect();
            self.store.splice(0, self.store.n_items(), &items);
            let titles =
                [tr!("app-node-number"), tr!("app-node-rest", unit = unit), tr!("app-node-growth"), tr!("app-node-now", unit = unit)];
            for (column, title) in self.view.columns().iter::<gtk::ColumnViewColumn>().flatten().zip(titles) {
                column.set_title(Some(&title));
            }
        }
    }
}

impl Values {
    fn text(&self, row: u32, column: usize) -> String {
        match column.checked_sub(1).and_then(|column| self.columns.get(column)) {
            None => (row + 1).to_string(),
            Some(values) => {
                values.get(row as usize).map_or_else(String::new, |value| format::number(*value, if column == 2 { 3 } else { 2 }))
            }
        }
    }
}

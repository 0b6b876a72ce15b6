//! The table of a muscle's nodes: radius at rest and growth, which can be typed over, and the radius now.

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use gtk::prelude::*;
use gtk::{gio, glib};
use gtk4 as gtk;

use crate::app::format;
use crate::app::widgets::ui::{self, object};
use crate::muscle::{Edit, Profile};
use crate::tr;

/// Hears of a change that was typed; answers whether it was taken.
type Typed = Box<dyn Fn(Edit) -> bool>;
/// Receives the current node.
type Chosen = Box<dyn Fn(usize)>;

/// A cell on screen.
struct TableCell {
    widget: gtk::Widget,
    row: u32,
    column: usize,
    /// What it was given to show last.
    shown: String,
}

/// What the cells show, and whom they tell.
#[derive(Default)]
struct Values {
    columns: RefCell<[Vec<f64>; 3]>,
    cells: RefCell<Vec<TableCell>>,
    typed: RefCell<Option<Typed>>,
    chosen: RefCell<Option<Chosen>>,
    current: Cell<usize>,
}

/// The table.
pub(crate) struct ProfileTable {
    view: gtk::ColumnView,
    values: Rc<Values>,
    store: gio::ListStore,
}

impl ProfileTable {
    /// Puts the columns into a view.
    pub(crate) fn new(view: &gtk::ColumnView) -> Self {
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

    /// Sets the callbacks for edits and for the current node.
    pub(crate) fn connect(&self, typed: impl Fn(Edit) -> bool + 'static, chosen: impl Fn(usize) + 'static) {
        self.values.typed.replace(Some(Box::new(typed)));
        self.values.chosen.replace(Some(Box::new(chosen)));
    }

    /// The current node: the one whose cell was focused last.
    pub(crate) fn at_hand(&self) -> impl Fn() -> usize + 'static {
        let values = self.values.clone();
        move || values.current.get()
    }

    fn factory(&self, column: usize) -> gtk::SignalListItemFactory {
        let factory = gtk::SignalListItemFactory::new();
        let values = Rc::downgrade(&self.values);
        factory.connect_setup(move |_, item| {
            let Some((item, values)) = item.downcast_ref::<gtk::ListItem>().zip(values.upgrade()) else { return };
            item.set_child(Some(&values.cell(column)));
        });
        let values = Rc::downgrade(&self.values);
        factory.connect_bind(move |_, item| {
            let Some((item, values)) = item.downcast_ref::<gtk::ListItem>().zip(values.upgrade()) else { return };
            if let Some(widget) = item.child() {
                let (row, shown) = (item.position(), values.text(item.position(), column));
                show(&widget, &shown);
                explain(&widget, row, column);
                values.cells.borrow_mut().push(TableCell { widget, row, column, shown });
            }
        });
        let values = Rc::downgrade(&self.values);
        factory.connect_unbind(move |_, item| {
            let Some((item, values)) = item.downcast_ref::<gtk::ListItem>().zip(values.upgrade()) else { return };
            let widget = item.child();
            values.cells.borrow_mut().retain(|cell| Some(&cell.widget) != widget.as_ref());
        });
        factory
    }

    /// Shows a muscle; `anew` where it is another one.
    pub(crate) fn show(&self, profile: &Profile, radii: &[f64], unit: &str, anew: bool) {
        self.values.columns.replace([profile.radii().to_vec(), profile.growth().to_vec(), radii.to_vec()]);
        let mut cells = std::mem::take(&mut *self.values.cells.borrow_mut());
        for cell in &mut cells {
            let text = self.values.text(cell.row, cell.column);
            // Text that is being edited stays, unless the value changed meanwhile.
            if text != cell.shown {
                show(&cell.widget, &text);
                cell.shown = text;
            }
        }
        self.values.cells.borrow_mut().extend(cells);
        if anew || self.store.n_items() as usize != radii.len() {
            if self.store.n_items() as usize != radii.len() {
                let items: Vec<_> = (0..radii.len() as u32).map(glib::BoxedAnyObject::new).collect();
                self.store.splice(0, self.store.n_items(), &items);
            }
            self.values.current.set(self.values.current.get().min(radii.len().saturating_sub(1)));
            let titles =
                [tr!("app-node-number"), tr!("app-node-rest", unit = unit), tr!("app-node-growth"), tr!("app-node-now", unit = unit)];
            for (column, title) in self.view.columns().iter::<gtk::ColumnViewColumn>().flatten().zip(titles) {
                column.set_title(Some(&title));
            }
        }
    }
}

/// Says which number stands in a cell.
fn explain(widget: &gtk::Widget, row: u32, column: usize) {
    let key = match column {
        1 => "app-node-radius-tip",
        2 => "app-node-growth-tip",
        _ => return,
    };
    widget.set_tooltip_text(Some(&tr!(key, number = row + 1)));
}

fn show(widget: &gtk::Widget, text: &str) {
    if let Some(entry) = widget.downcast_ref::<gtk::Entry>() {
        entry.set_text(text);
        entry.remove_css_class("error");
    } else if let Some(label) = widget.downcast_ref::<gtk::Label>() {
        label.set_text(text);
    }
}

impl Values {
    fn text(&self, row: u32, column: usize) -> String {
        match column.checked_sub(1).and_then(|column| self.columns.borrow().get(column).cloned()) {
            None => (row + 1).to_string(),
            Some(values) => {
                values.get(row as usize).map_or_else(String::new, |value| format::number(*value, if column == 2 { 3 } else { 2 }))
            }
        }
    }

    fn cell(self: &Rc<Self>, column: usize) -> gtk::Widget {
        if column != 1 && column != 2 {
            let label = gtk::Label::builder().xalign(1.0).hexpand(true).css_classes(["numeric"]).build();
            return label.upcast();
        }
        let entry: gtk::Entry = object(&ui::builder(include_str!("node_cell.ui")), if column == 1 { "radius" } else { "growth" });
        let values = Rc::downgrade(self);
        entry.connect_activate(move |entry| {
            if let Some(values) = values.upgrade() {
                values.commit(entry);
            }
        });
        let focus = gtk::EventControllerFocus::new();
        let (values, own) = (Rc::downgrade(self), entry.downgrade());
        focus.connect_enter(move |_| {
            let Some((values, entry)) = values.upgrade().zip(own.upgrade()) else { return };
            let row = values.cells.borrow().iter().find(|cell| cell.widget == entry).map(|cell| cell.row as usize);
            if let Some(row) = row {
                values.current.set(row);
                if let Some(chosen) = &*values.chosen.borrow() {
                    chosen(row);
                }
            }
        });
        let (values, own) = (Rc::downgrade(self), entry.downgrade());
        focus.connect_leave(move |_| {
            if let Some((values, entry)) = values.upgrade().zip(own.upgrade()) {
                values.commit(&entry);
            }
        });
        entry.add_controller(focus);
        entry.upcast()
    }

    /// Takes what was typed into a cell, if it is something else than what was shown.
    fn commit(&self, entry: &gtk::Entry) {
        let found = self.cells.borrow().iter().find(|cell| cell.widget == *entry).map(|cell| (cell.row, cell.column, cell.shown.clone()));
        let Some((row, column, shown)) = found else { return };
        let text = entry.text();
        if text == shown {
            return entry.remove_css_class("error");
        }
        let value = format::parse_number(&text).unwrap_or(f64::NAN);
        let edit = if column == 1 { Edit::Radius(row as usize, value) } else { Edit::Growth(row as usize, value) };
        let taken = self.typed.borrow().as_ref().is_some_and(|typed| typed(edit));
        if taken {
            // Where the value was rounded away, or is what it was, the cell shows it again as it is.
            let text = self.text(row, column);
            if entry.text() != text {
                entry.set_text(&text);
            }
            entry.remove_css_class("error");
        } else {
            entry.add_css_class("error");
        }
    }
}

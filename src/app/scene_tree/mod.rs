//! The scene tree: nodes, bones, meshes and muscles, with search; selection goes both ways. Its rows are in [`tree_model`].

mod tree_model;

use std::cell::{Cell, RefCell};
use std::rc::Rc;
use std::time::Duration;

use gtk::prelude::*;
use gtk::{gio, glib};
use gtk4 as gtk;

use self::tree_model::{TreeRow, path_to, search, steps};
use crate::app::handles::picture_focus::PictureFocus;
use crate::app::handles::session_handle::SessionHandle;
use crate::app::panels::muscle::muscle_editor::Editor;
use crate::app::widgets::drawing_area::PaintWidget;
use crate::app::widgets::icons;
use crate::app::widgets::ui::{self, object};
use crate::i18n::shown;
use crate::scene::{NodeId, Scene};
use crate::session::{ChangeSet, Session};
use crate::tr;

/// Trees of at most this many nodes are shown unfolded.
const UNFOLDED: usize = 300;

/// After this time panels have their heights.
const SETTLED: Duration = Duration::from_millis(300);

ui::widgets! {
    /// The widgets of the tree.
    struct TreeWidgets from "scene_tree.ui" {
        root: gtk::Box,
        search: gtk::SearchEntry,
        scroller: gtk::ScrolledWindow,
        list: gtk::ListView,
        nothing: gtk::Label,
    }
}

/// The tree.
pub(crate) struct SceneTree {
    /// The whole.
    pub root: gtk::Box,
    widgets: TreeWidgets,
    selection: RefCell<gtk::SingleSelection>,
    rows: Rc<RefCell<Vec<TreeRow>>>,
    /// How far it is scrolled after the user has just selected the row at this position, until the list has another height.
    chosen: Rc<Cell<Option<(f64, u32)>>>,
    session: SessionHandle,
    editor: Editor,
}

impl SceneTree {
    /// The tree of a session; `editor` takes the bone that is picked for a muscle.
    pub(crate) fn new(session: &SessionHandle, editor: &Editor, focus: &PictureFocus) -> Self {
        let widgets = TreeWidgets::build();
        let tree = Self {
            root: widgets.root.clone(),
            widgets,
            selection: RefCell::new(gtk::SingleSelection::new(None::<gio::ListModel>)),
            rows: Rc::default(),
            chosen: Rc::default(),
            session: session.clone(),
            editor: editor.clone(),
        };
        tree.connect(session, focus);
        tree
    }

    fn connect(&self, session: &SessionHandle, focus: &PictureFocus) {
        self.widgets.list.set_factory(Some(&factory(session, &self.rows)));
        // The inspector comes up below with the first selection; the row stays under the pointer that chose it, for a second click.
        let (chosen, list) = (self.chosen.clone(), self.widgets.list.downgrade());
        self.widgets.scroller.vadjustment().connect_page_size_notify(move |scrolled| {
            let rows = list.upgrade().and_then(|list| list.model()).map_or(0, |model| model.n_items());
            if let Some((value, position)) = chosen.take().filter(|_| rows > 0) {
                let bottom = f64::from(position + 1) * scrolled.upper() / f64::from(rows);
                let (scrolled, value) = (scrolled.clone(), value.max(bottom - scrolled.page_size()));
                // The list is being laid out: it would not hear of another value now.
                glib::idle_add_local_once(move || scrolled.set_value(value));
            }
        });
        self.widgets.search.connect_search_changed(glib::clone!(
            #[weak]
            session,
            move |_| session.update(Session::refresh_tree)
        ));
        self.widgets.search.connect_stop_search(glib::clone!(
            #[strong]
            focus,
            move |entry| {
                entry.set_text("");
                focus.take();
            }
        ));
        self.widgets.list.connect_activate(glib::clone!(
            #[weak]
            session,
            move |list, position| {
                let node = list.model().and_then(|model| model.item(position)).and_then(|item| node_of(&item));
                if let Some(node) = node {
                    session.update(|session| session.centre_on(node));
                }
            }
        ));
    }

    /// Shows what changed.
    pub(crate) fn refresh(&self, session: &Session, changes: ChangeSet) {
        let scene = &session.document().scene;
        if changes.any(ChangeSet::DOCUMENT | ChangeSet::TREE) {
            *self.rows.borrow_mut() = scene.graph.iter().map(|(id, _)| TreeRow::of(scene, id)).collect();
            let wanted = self.widgets.search.text();
            let (roots, flat) =
                if wanted.trim().is_empty() { (scene.graph.roots().to_vec(), false) } else { (search(scene, &wanted), true) };
            self.widgets.nothing.set_text(&tr!(if scene.graph.is_empty() { "app-tree-nothing" } else { "app-search-nothing" }));
            self.widgets.nothing.set_visible(roots.is_empty());
            self.widgets.scroller.set_visible(!roots.is_empty());
            let unfolded = scene.graph.len() <= UNFOLDED;
            let steps = if flat { "" } else { steps(scene) };
            let classes = ["navigation-sidebar", "tree", steps];
            self.widgets.list.set_css_classes(if steps.is_empty() { &classes[..2] } else { &classes });
            self.set_model(&roots, flat, unfolded);
            if !unfolded && !flat {
                self.unfold_first();
            }
        }
        if changes.any(ChangeSet::DOCUMENT | ChangeSet::TREE | ChangeSet::SELECTION) {
            self.select(session);
        }
        if changes.any(ChangeSet::DISPLAY) {
            for row in self.rows.borrow_mut().iter_mut() {
                row.visible = scene.graph.node(row.node).visible;
            }
            self.show_eyes(scene);
        }
    }

    /// Opens and closes the eyes of the rows that are on the screen; those that come into it later are filled anew anyway.
    fn show_eyes(&self, scene: &Scene) {
        for widget in std::iter::successors(self.widgets.list.first_child(), gtk::Widget::next_sibling) {
            let Some(expander) = widget.first_child().and_downcast::<gtk::TreeExpander>() else { continue };
            let node = expander.list_row().and_then(|row| node_of(row.upcast_ref()));
            let eye = expander.child().and_then(|content| content.last_child()).and_downcast::<gtk::ToggleButton>();
            if let (Some(node), Some(eye)) = (node.filter(|node| node.index() < scene.graph.len()), eye) {
                let visible = scene.graph.node(node).visible;
                eye.set_active(!visible);
                show_eye(&eye, visible);
            }
        }
    }

    fn set_model(&self, roots: &[NodeId], flat: bool, unfolded: bool) {
        let rows = self.rows.clone();
        let model = gtk::TreeListModel::new(store(roots), false, unfolded, move |item| {
            let node = item.downcast_ref::<glib::BoxedAnyObject>().map(|boxed| *boxed.borrow::<NodeId>())?;
            let rows = rows.borrow();
            let row = rows.get(node.index()).filter(|row| !flat && !row.children.is_empty())?;
            Some(store(&row.children).upcast())
        });
        let selection = gtk::SingleSelection::new(Some(model));
        selection.set_autoselect(false);
        selection.set_can_unselect(true);
        selection.set_selected(gtk::INVALID_LIST_POSITION);
        selection.connect_selected_item_notify(glib::clone!(
            #[weak(rename_to = session)]
            self.session,
            #[strong(rename_to = editor)]
            self.editor,
            move |selection| {
                let node = selection.selected_item().and_then(|item| node_of(&item));
                match node.filter(|_| session.read_if_free(|session| session.picking().is_some())) {
                    Some(bone) => {
                        editor.tell(|session| session.pick_bone(bone));
                    }
                    None => session.update(|session| session.select(node)),
                }
            }
        ));
        self.widgets.list.set_model(Some(&selection));
        self.selection.replace(selection);
    }

    /// Unfolds the first two levels of a large tree.
    fn unfold_first(&self) {
        for _ in 0..2 {
            let rows: Vec<_> = self.tree_rows().take(64).collect();
            rows.iter().for_each(|row| row.set_expanded(true));
        }
    }

    fn tree_rows(&self) -> impl Iterator<Item = gtk::TreeListRow> {
        let selection = self.selection.borrow().clone();
        (0..selection.n_items()).filter_map(move |position| selection.item(position).and_downcast())
    }

    fn select(&self, session: &Session) {
        let selection = self.selection.borrow().clone();
        let Some(node) = session.selected() else {
            selection.set_selected(gtk::INVALID_LIST_POSITION);
            return;
        };
        if selection.selected_item().and_then(|item| node_of(&item)) == Some(node) {
            self.chosen.set(Some((self.widgets.scroller.vadjustment().value(), selection.selected())));
            let chosen = self.chosen.clone();
            glib::timeout_add_local_once(SETTLED, move || {
                chosen.take();
            });
            return;
        }
        self.chosen.take();
        // Unfolds everything above it; each row found lies below the one before.
        let mut position = None;
        for step in path_to(&session.document().scene, node) {
            let from = position.unwrap_or(0);
            let found = (from..selection.n_items()).find(|at| selection.item(*at).and_then(|item| node_of(&item)) == Some(step));
            let Some(at) = found else { continue };
            position = Some(at);
            if step != node
                && let Some(row) = selection.item(at).and_downcast::<gtk::TreeListRow>()
            {
                row.set_expanded(true);
            }
        }
        let there = position.filter(|at| selection.item(*at).and_then(|item| node_of(&item)) == Some(node));
        selection.set_selected(there.unwrap_or(gtk::INVALID_LIST_POSITION));
        if let Some(at) = there {
            ui::scroll_to(&self.widgets.list, at);
        }
    }
}

fn store(nodes: &[NodeId]) -> gio::ListStore {
    let store = gio::ListStore::new::<glib::BoxedAnyObject>();
    let items: Vec<_> = nodes.iter().map(|node| glib::BoxedAnyObject::new(*node)).collect();
    store.extend_from_slice(&items);
    store
}

fn node_of(item: &glib::Object) -> Option<NodeId> {
    let boxed = item.downcast_ref::<gtk::TreeListRow>()?.item().and_downcast::<glib::BoxedAnyObject>()?;
    let node = *boxed.borrow::<NodeId>();
    Some(node)
}

/// Makes and fills the rows: expander, icon, name, eye.
fn factory(session: &SessionHandle, rows: &Rc<RefCell<Vec<TreeRow>>>) -> gtk::SignalListItemFactory {
    let factory = gtk::SignalListItemFactory::new();
    let weak = session.downgrade();
    factory.connect_setup(move |_, item| {
        let Some(item) = item.downcast_ref::<gtk::ListItem>() else { return };
        let expander = gtk::TreeExpander::new();
        let content = gtk::Box::new(gtk::Orientation::Horizontal, 6);
        let icon = PaintWidget::new(16, 16);
        icon.set_valign(gtk::Align::Center);
        // Names of a skeleton begin alike and differ at their ends.
        let label = gtk::Label::builder().xalign(0.0).hexpand(true).ellipsize(gtk::pango::EllipsizeMode::Middle).build();
        let eye: gtk::ToggleButton = object(&ui::builder(include_str!("tree_eye.ui")), "eye");
        content.append(&icon);
        content.append(&label);
        content.append(&eye);
        expander.set_child(Some(&content));
        item.set_child(Some(&expander));
        let weak = weak.clone();
        let item = item.downgrade();
        eye.connect_clicked(move |eye| {
            let node = item.upgrade().and_then(|item| item.item()).and_then(|item| node_of(&item));
            if let (Some(session), Some(node)) = (weak.upgrade(), node) {
                let visible = !eye.is_active();
                show_eye(eye, visible);
                session.update(|session| session.set_visible(node, visible));
            }
        });
    });
    let rows = Rc::downgrade(rows);
    factory.connect_bind(move |_, item| {
        let Some(item) = item.downcast_ref::<gtk::ListItem>() else { return };
        let (Some(row), Some(expander)) =
            (item.item().and_downcast::<gtk::TreeListRow>(), item.child().and_downcast::<gtk::TreeExpander>())
        else {
            return;
        };
        expander.set_list_row(Some(&row));
        let Some(rows) = rows.upgrade() else { return };
        let Some(node) = node_of(row.upcast_ref()) else { return };
        let Some(row) = rows.borrow().get(node.index()).cloned() else { return };
        let Some(content) = expander.child() else { return };
        let (icon, eye) = (content.first_child().and_downcast::<PaintWidget>(), content.last_child().and_downcast::<gtk::ToggleButton>());
        let label = icon.as_ref().and_then(|icon| icon.next_sibling()).and_downcast::<gtk::Label>();
        if let (Some(icon), Some(label), Some(eye)) = (icon, label, eye) {
            icons::set(&icon, row.icon);
            let name = shown(&row.name);
            label.set_text(&name);
            label.set_tooltip_text(Some(&name));
            eye.set_active(!row.visible);
            show_eye(&eye, row.visible);
        }
    });
    factory
}

fn show_eye(eye: &gtk::ToggleButton, visible: bool) {
    eye.set_icon_name(if visible { "view-reveal-symbolic" } else { "view-conceal-symbolic" });
    if let Some(row) = eye.parent() {
        if visible { row.remove_css_class("hidden-node") } else { row.add_css_class("hidden-node") }
    }
}

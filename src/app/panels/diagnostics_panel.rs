//! The panel of diagnostics: diagnostics of reading, and the metadata of the file.

use gtk::prelude::*;
use gtk::{gio, glib};
use gtk4 as gtk;

use super::panel::Panel;
use crate::app::format;
use crate::app::handles::session_handle::SessionHandle;
use crate::app::notices::toasts::Toasts;
use crate::app::widgets::ui;
use crate::diagnostics::{Diagnostic, Severity};
use crate::document::{Document, Finding, SourceKind};
use crate::i18n;
use crate::scene::{Content, Deformer, Node, NodeId, Scene};
use crate::session::{ChangeSet, Session};
use crate::tr;

ui::widgets! {
    /// The widgets of the panel.
    struct HealthWidgets from "diagnostics_panel.ui" {
        root: gtk::Box,
        summary: gtk::Label,
        copy: gtk::Button,
        scroller: gtk::ScrolledWindow,
        list: gtk::ListView,
        facts: gtk::Label,
    }
}

/// The panel.
pub(crate) struct DiagnosticsPanel {
    widgets: HealthWidgets,
}

impl DiagnosticsPanel {
    /// The panel of a session.
    pub(crate) fn new(session: &SessionHandle, toasts: &Toasts) -> Self {
        let widgets = HealthWidgets::build();
        widgets.list.set_factory(Some(&factory()));
        let panel = Self { widgets };
        panel.connect(session, toasts);
        panel
    }

    /// Lets a click select what a finding speaks of.
    fn connect(&self, session: &SessionHandle, toasts: &Toasts) {
        self.widgets.list.connect_activate(glib::clone!(
            #[weak]
            session,
            move |list, position| {
                let item = list.model().and_then(|model| model.item(position)).and_downcast::<glib::BoxedAnyObject>();
                let Some(item) = item else { return };
                session.update(|session| {
                    let node = node_named(session.document(), &item.borrow::<Diagnostic<Finding>>().element.to_string());
                    if node.is_some() {
                        session.select(node);
                    }
                });
            }
        ));
        self.widgets.copy.connect_clicked(glib::clone!(
            #[weak]
            session,
            #[strong]
            toasts,
            move |button| {
                let text = session.read(|session| report(session.document()));
                button.clipboard().set_text(&text);
                toasts.toast(&tr!("app-copied"), None);
            }
        ));
    }
}

impl Panel for DiagnosticsPanel {
    fn id(&self) -> &'static str {
        // The name that settings have had from the start.
        "health"
    }

    fn title(&self) -> String {
        tr!("app-page-diagnostics")
    }

    fn widget(&self) -> gtk::Widget {
        self.widgets.root.clone().upcast()
    }

    fn refresh(&self, session: &mut Session, changes: ChangeSet) {
        if !changes.any(ChangeSet::DOCUMENT) {
            return;
        }
        let document = session.document();
        let store = gio::ListStore::new::<glib::BoxedAnyObject>();
        let items: Vec<_> = document.diagnostics.iter().cloned().map(glib::BoxedAnyObject::new).collect();
        store.extend_from_slice(&items);
        self.widgets.list.set_model(Some(&gtk::NoSelection::new(Some(store))));
        let count = |severity| document.diagnostics.iter().filter(|finding| finding.severity() == severity).count();
        let counts = [("app-diagnostics-warnings", count(Severity::Warning)), ("app-diagnostics-notes", count(Severity::Info))];
        let told: Vec<String> = counts.into_iter().filter(|(_, count)| *count > 0).map(|(key, count)| tr!(key, count = count)).collect();
        self.widgets.summary.set_text(&if told.is_empty() { tr!("app-diagnostics-none") } else { told.join(", ") });
        self.widgets.scroller.set_visible(!document.diagnostics.is_empty());
        self.widgets.copy.set_sensitive(!document.diagnostics.is_empty());
        ui::set_label(&self.widgets.facts, &facts(document));
    }
}

/// All findings, one a line.
fn report(document: &Document) -> String {
    document.diagnostics.iter().map(|finding| format!("{}\n", i18n::finding_line(finding))).collect()
}

/// What the files say of themselves.
fn facts(document: &Document) -> String {
    let mut lines = Vec::new();
    for source in &document.sources {
        lines.push(i18n::source_name(&source.name));
        match &source.kind {
            SourceKind::Scene(asset) => {
                let unit = format::trim_trailing_zeros(asset.unit_metres, 4);
                lines.push(tr!(
                    "app-facts-scene",
                    format = asset.format,
                    version = asset.version.as_str(),
                    axis = asset.up_axis.as_str(),
                    unit = unit
                ));
                if !asset.authoring_tool.is_empty() {
                    lines.push(asset.authoring_tool.clone());
                }
            }
            SourceKind::Muscles(_, rig) => lines.push(tr!("app-facts-muscles", count = rig.len())),
        }
    }
    lines.push(tr!(
        "app-facts-nodes",
        nodes = document.scene.graph.len(),
        meshes = document.scene.meshes.len(),
        clips = document.clips.len()
    ));
    lines.join("\n")
}

/// The node that a finding's element leads to: the node itself, or the first that carries what the element names (`<skin> "Body-skin"`).
fn node_named(document: &Document, element: &str) -> Option<NodeId> {
    let name = element.split('"').nth(1).filter(|name| !name.is_empty())?;
    let graph = &document.scene.graph;
    let own = |wanted: &dyn Fn(&Node) -> bool| graph.iter().find(|(_, node)| wanted(node)).map(|(id, _)| id);
    own(&|node| node.id == name)
        .or_else(|| own(&|node| node.name == name))
        .or_else(|| own(&|node| node.contents.iter().any(|content| carries(&document.scene, content, name))))
        .or_else(|| own(&|node| node.sid == name))
}

/// Whether a thing on a node, or a part of it, has this id or name.
fn carries(scene: &Scene, content: &Content, wanted: &str) -> bool {
    let is = |id: &str, name: &str| id == wanted || name == wanted;
    match content {
        Content::Mesh(instance) => {
            scene.meshes.get(instance.mesh.index()).is_some_and(|mesh| is(&mesh.id, &mesh.name))
                || instance.deformers.iter().any(|deformer| match deformer {
                    Deformer::Skin { skin, .. } => scene.skins.get(skin.index()).is_some_and(|skin| is(&skin.id, &skin.name)),
                    Deformer::Morph(morph) => scene.morphs.get(morph.index()).is_some_and(|morph| is(&morph.id, &morph.name)),
                })
                || instance.materials.iter().flatten().filter_map(|bound| scene.materials.get(bound.material.index())).any(|material| {
                    let paints = [&material.diffuse, &material.emission, &material.ambient, &material.specular];
                    let textures = paints.into_iter().filter_map(|paint| paint.texture.as_ref());
                    is(&material.id, &material.name)
                        || textures
                            .chain(material.opacity_texture.iter().map(|(texture, _)| texture))
                            .any(|texture| scene.images.get(texture.image.index()).is_some_and(|image| is(&image.id, &image.name)))
                })
        }
        Content::Light(light) => scene.lights.get(light.index()).is_some_and(|light| is(&light.id, &light.name)),
        Content::Camera(camera) => scene.cameras.get(camera.index()).is_some_and(|camera| is(&camera.id, &camera.name)),
        Content::Muscle(_) => false,
    }
}

fn factory() -> gtk::SignalListItemFactory {
    let factory = gtk::SignalListItemFactory::new();
    factory.connect_setup(|_, item| {
        let Some(item) = item.downcast_ref::<gtk::ListItem>() else { return };
        let row = gtk::Box::new(gtk::Orientation::Horizontal, 6);
        let icon = gtk::Image::builder().valign(gtk::Align::Start).build();
        let words = gtk::Box::new(gtk::Orientation::Vertical, 3);
        let wrapped = || gtk::Label::builder().xalign(0.0).wrap(true).wrap_mode(gtk::pango::WrapMode::WordChar).build();
        let (message, place) = (wrapped(), wrapped());
        place.add_css_class("dim-label");
        place.add_css_class("small");
        words.append(&message);
        words.append(&place);
        words.set_hexpand(true);
        row.append(&icon);
        row.append(&words);
        item.set_child(Some(&row));
    });
    factory.connect_bind(|_, item| {
        let Some(item) = item.downcast_ref::<gtk::ListItem>() else { return };
        let (Some(boxed), Some(row)) = (item.item().and_downcast::<glib::BoxedAnyObject>(), item.child()) else { return };
        let finding = boxed.borrow::<Diagnostic<Finding>>();
        let icon = row.first_child().and_downcast::<gtk::Image>();
        let words = row.last_child();
        let message = words.as_ref().and_then(|words| words.first_child()).and_downcast::<gtk::Label>();
        let place = words.as_ref().and_then(|words| words.last_child()).and_downcast::<gtk::Label>();
        if let (Some(icon), Some(message), Some(place)) = (icon, message, place) {
            let (name, tip) = match finding.severity() {
                Severity::Warning => ("dialog-warning-symbolic", tr!("app-warning")),
                Severity::Info => ("dialog-information-symbolic", tr!("app-note")),
            };
            icon.set_icon_name(Some(name));
            icon.set_tooltip_text(Some(&tip));
            ui::set_label(&message, &i18n::finding(&finding));
            let mut where_it_is: Vec<String> = Vec::new();
            if let Some(line) = finding.line {
                where_it_is.push(tr!("app-line", line = line.to_string()));
            }
            where_it_is.extend(
                [i18n::label(finding.element.as_label()).into_owned(), finding.code().to_owned()]
                    .into_iter()
                    .filter(|part| !part.is_empty()),
            );
            ui::set_label(&place, &where_it_is.join(" · "));
        }
    });
    factory
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_finding_leads_to_the_node_it_names() {
        let mut document = Document::default();
        let hip = document.scene.graph.add(None, Node::new("Hip"));
        document.scene.graph.node_mut(hip).id = "Hip_01".into();
        assert_eq!(node_named(&document, "<node> \"Hip_01\""), Some(NodeId(0)));
        assert_eq!(node_named(&document, "<node> \"Hip\""), Some(NodeId(0)));
        assert_eq!(node_named(&document, "<source>"), None);
        assert_eq!(node_named(&document, "<node> \"\""), None);
    }

    #[test]
    fn a_finding_about_what_hangs_on_a_node_leads_there() {
        let text = include_str!("../../../tests/fuzz/seeds/collada/everything.dae");
        let loaded = crate::collada::read(text.as_bytes(), "everything.dae", &crate::progress::Progress::default()).expect("it is read");
        let mut document = Document::default();
        document.scene = loaded.scene;
        let named = |element: &str| node_named(&document, element).map(|id| document.scene.graph.node(id).contents.len());
        for element in ["<skin> in <controller> \"c\"", "<morph> in <controller> \"m\"", "<polylist> in <geometry> \"g\"", "<image> \"i\""]
        {
            assert_eq!(named(element), Some(1), "{element}");
        }
        // The node with both.
        assert_eq!(named("<light> \"lamp\""), Some(2));
        assert_eq!(named("<camera> \"eye\""), Some(2));
        assert_eq!(named("<effect> \"nobody\""), None);
    }
}

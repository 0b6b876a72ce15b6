//! Model of the scene tree: one row a node, built without widgets.

use crate::app::widgets::icons::Icon;
use crate::i18n;
use crate::scene::{Content, Node, NodeId, NodeKind, Scene};

/// A row of the tree.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct TreeRow {
    /// The node.
    pub node: NodeId,
    /// What a person calls it.
    pub name: String,
    /// Its icon.
    pub icon: Icon,
    /// Whether it is drawn.
    pub visible: bool,
    /// The nodes below it.
    pub children: Vec<NodeId>,
}

impl TreeRow {
    /// The row of a node.
    pub(crate) fn of(scene: &Scene, id: NodeId) -> Self {
        let node = scene.graph.node(id);
        Self {
            node: id,
            name: i18n::label(scene.graph.label(id)).into_owned(),
            icon: icon(node),
            visible: node.visible,
            children: node.children().to_vec(),
        }
    }
}

fn icon(node: &Node) -> Icon {
    let of = |content: &Content| match content {
        Content::Muscle(_) => Icon::Muscle,
        Content::Mesh(_) => Icon::Mesh,
        Content::Camera(_) => Icon::Camera,
        Content::Light(_) => Icon::Light,
    };
    let muscle = node.contents.iter().find(|content| matches!(content, Content::Muscle(_)));
    match (node.kind, muscle.or(node.contents.first())) {
        (NodeKind::Joint, _) => Icon::Bone,
        (_, Some(content)) => of(content),
        (NodeKind::Asset, None) => Icon::File,
        (NodeKind::Node, None) => Icon::Node,
    }
}

/// How small the steps of a tree are: the class in `style.css` for one of so many levels, such that all its steps take about 100 pixels. Empty = the usual ones.
pub(crate) fn steps(scene: &Scene) -> &'static str {
    let mut levels: Vec<usize> = Vec::with_capacity(scene.graph.len());
    for (_, node) in scene.graph.iter() {
        // A parent stands before what is below it.
        let above = node.parent().and_then(|parent| levels.get(parent.index()).copied()).unwrap_or(0);
        levels.push(above + 1);
    }
    match levels.into_iter().max().unwrap_or(0) {
        0..=9 => "",
        10..=15 => "deep",
        16..=26 => "deeper",
        _ => "deepest",
    }
}

/// The nodes whose name or id holds `text`, letter case aside, in file order.
pub(crate) fn search(scene: &Scene, text: &str) -> Vec<NodeId> {
    let text = text.trim().to_lowercase();
    let holds = |name: &str| name.to_lowercase().contains(&text);
    scene.graph.iter().filter(|(id, node)| holds(&i18n::label(scene.graph.label(*id))) || holds(&node.id)).map(|(id, _)| id).collect()
}

/// A node with all nodes above it, from the root down.
pub(crate) fn path_to(scene: &Scene, id: NodeId) -> Vec<NodeId> {
    let mut path: Vec<NodeId> = std::iter::successors(Some(id), |id| scene.graph.node(*id).parent()).collect();
    path.reverse();
    path
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene() -> Scene {
        let mut scene = Scene::default();
        let mut add = |parent, name: &str, kind, id: &str| {
            let node = scene.graph.add(parent, Node::new(name));
            (scene.graph.node_mut(node).kind, scene.graph.node_mut(node).id) = (kind, id.to_owned());
            node
        };
        let root = add(None, "file.dae", NodeKind::Asset, "");
        let hip = add(Some(root), "Hip", NodeKind::Joint, "Armature_Hip");
        add(Some(hip), "Колено", NodeKind::Joint, "");
        scene
    }

    #[test]
    fn names_and_ids_are_found_in_any_case() {
        let scene = scene();
        assert_eq!(search(&scene, " hip"), [NodeId(1)]);
        assert_eq!(search(&scene, "ARMATURE"), [NodeId(1)]);
        assert_eq!(search(&scene, "КОЛЕНО"), [NodeId(2)]);
        assert!(search(&scene, "foot").is_empty());
    }

    #[test]
    fn steps_get_smaller_with_the_depth() {
        let mut scene = scene();
        assert_eq!(steps(&scene), "");
        let mut last = NodeId(1);
        for (levels, class) in [(9, ""), (10, "deep"), (15, "deep"), (16, "deeper"), (27, "deepest"), (90, "deepest")] {
            while path_to(&scene, last).len() < levels {
                last = scene.graph.add(Some(last), Node::new("bone"));
            }
            assert_eq!(steps(&scene), class, "{levels} levels");
        }
    }

    #[test]
    fn the_path_leads_from_the_root() {
        assert_eq!(path_to(&scene(), NodeId(2)), [NodeId(0), NodeId(1), NodeId(2)]);
    }

    #[test]
    fn icons_tell_kinds_apart() {
        let scene = scene();
        assert_eq!((TreeRow::of(&scene, NodeId(0)).icon, TreeRow::of(&scene, NodeId(1)).icon), (Icon::File, Icon::Bone));
    }
}

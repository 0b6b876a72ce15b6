//! A clip made by hand: a pendulum of one joint, sampled at a few moments.

use std::sync::Arc;

use glam::DVec3;
use sinew_scene::animation::{Channel, ChannelTarget, Clip, Components, Curve, Keys, Pose};
use sinew_scene::{Node, NodeId, NodeKind, Scene, Transform, TransformOp};

/// A joint that turns about z, with a bob one metre below it, and the clip that swings it from -30° to 30° within two seconds.
pub(crate) fn pendulum() -> (Scene, NodeId, Clip) {
    let mut scene = Scene::default();
    let turn = Transform { ops: vec![TransformOp::Rotate { axis: DVec3::Z, angle: 0.0 }] };
    let joint = scene.graph.add(None, Node::new("joint").with_kind(NodeKind::Joint).with_transform(turn));
    let hang = Transform { ops: vec![TransformOp::Translate(-DVec3::Y)] };
    let bob = scene.graph.add(Some(joint), Node::new("bob").with_transform(hang));
    let keys = Keys { times: vec![0.0, 2.0], dimension: 1, values: vec![-30.0, 30.0], ..Keys::default() };
    // The angle is the fourth number of a rotation, after its axis.
    let target = ChannelTarget::Transform { node: joint, op: 0, components: Components::Component(3) };
    let channels = vec![Channel { target, curve: Arc::new(Curve::new(keys)) }];
    (scene, bob, Clip { name: "swing".into(), end: 2.0, channels, ..Clip::default() })
}

/// Where a node is at a moment of a clip, metres in the world.
pub(crate) fn position(scene: &Scene, node: NodeId, clip: &Clip, time: f64) -> DVec3 {
    // Kept from moment to moment, these would be allocated once.
    let (mut pose, mut local, mut world) = (Pose::rest(scene), Vec::new(), Vec::new());
    clip.sample(time, &mut pose);
    pose.locals(&mut local);
    scene.graph.world_from_local(&local, &mut world);
    world[node.index()].w_axis.truncate()
}

fn main() {
    let (scene, bob, clip) = pendulum();
    for time in [0.0, 0.5, 1.0, 1.5, 2.0] {
        println!("{time} s: {:.3}", position(&scene, bob, &clip, time));
    }
}

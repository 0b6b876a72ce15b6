//! Summary of what changed when files were read again, in one sentence.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::animation::{Channel, ChannelTarget, Clip};
use crate::app::format;
use crate::document::Document;
use crate::i18n;
use crate::scene::Mesh;
use crate::tr;

/// How many names a list of them says.
const NAMED: usize = 3;

/// What is different, by name where there are names: bones, clips, shapes, keys, findings.
pub(crate) fn what_changed(before: &Document, after: &Document) -> String {
    let nodes =
        |document: &Document| tally(document.scene.graph.iter().map(|(id, _)| i18n::label(document.scene.graph.label(id)).into_owned()));
    let clips = |document: &Document| tally(document.clips.iter().map(|clip| i18n::label(clip.label()).into_owned()));
    let mut changes = Vec::new();
    named(&mut changes, &nodes(before), &nodes(after), ["app-changed-gone", "app-changed-new"]);
    named(&mut changes, &clips(before), &clips(after), ["app-changed-clips-gone", "app-changed-clips-new"]);
    let counts = |document: &Document| {
        let triangles: usize = document.scene.meshes.iter().map(|mesh| mesh.triangles.len()).sum();
        let seconds: f64 = document.clips.iter().map(Clip::duration).sum();
        [
            (triangles as f64, "app-changed-triangles", 0),
            (seconds, "app-changed-seconds", 2),
            (document.diagnostics.len() as f64, "app-changed-findings", 0),
        ]
    };
    for ((old, key, digits), (new, ..)) in counts(before).into_iter().zip(counts(after)) {
        if (old - new).abs() > 1e-9 {
            changes.push(tr!(key, old = format::number(old, digits), new = format::number(new, digits)));
        }
    }
    for (key, count) in [("app-changed-shapes", shapes(before, after)), ("app-changed-curves", curves(before, after))] {
        if count > 0 {
            changes.push(tr!(key, count = count));
        }
    }
    if changes.is_empty() { tr!("app-reloaded") } else { tr!("app-reloaded-changes", changes = changes.join("; ")) }
}

/// How often each name occurs.
fn tally(names: impl Iterator<Item = String>) -> BTreeMap<String, usize> {
    let mut tally = BTreeMap::new();
    names.for_each(|name| *tally.entry(name).or_insert(0) += 1);
    tally
}

/// Says which names there are fewer of, and which more.
fn named(changes: &mut Vec<String>, before: &BTreeMap<String, usize>, after: &BTreeMap<String, usize>, keys: [&str; 2]) {
    let more = |here: &BTreeMap<String, usize>, there: &BTreeMap<String, usize>| -> Vec<String> {
        let fewer = |name: &String, count: usize| there.get(name).copied().unwrap_or(0) < count;
        here.iter().filter(|(name, count)| fewer(name, **count)).map(|(name, _)| name.clone()).collect()
    };
    for (names, key) in [more(before, after), more(after, before)].into_iter().zip(keys) {
        if let Some((first, rest)) = names.split_at_checked(NAMED.min(names.len())).filter(|(first, _)| !first.is_empty()) {
            let list = first.join(", ");
            changes.push(tr!(key, names = if rest.is_empty() { list } else { tr!("app-changed-more", names = list, count = rest.len()) }));
        }
    }
}

/// The number of meshes, by name, whose triangles are as many but stand elsewhere.
fn shapes(before: &Document, after: &Document) -> usize {
    let old: BTreeMap<(&str, &str), &Arc<Mesh>> =
        before.scene.meshes.iter().map(|mesh| ((mesh.name.as_str(), mesh.id.as_str()), mesh)).collect();
    let reshaped = |mesh: &&Arc<Mesh>| {
        old.get(&(mesh.name.as_str(), mesh.id.as_str()))
            .is_some_and(|old| old.triangles.len() == mesh.triangles.len() && old.positions != mesh.positions)
    };
    after.scene.meshes.iter().filter(reshaped).count()
}

/// The number of channels that move the same as before by other keys.
fn curves(before: &Document, after: &Document) -> usize {
    let old: BTreeMap<String, &Channel> = before.clips.iter().flat_map(|clip| keyed(before, clip)).collect();
    let differs = |(key, channel): &(String, &Channel)| {
        old.get(key).is_some_and(|old| {
            let (old, new) = (&*old.curve, &*channel.curve);
            (&old.times, &old.values, &old.modes) != (&new.times, &new.values, &new.modes)
        })
    };
    after.clips.iter().flat_map(|clip| keyed(after, clip)).filter(differs).count()
}

/// The channels of a clip, by what they move.
fn keyed<'a>(document: &Document, clip: &'a Clip) -> Vec<(String, &'a Channel)> {
    let clip_name = clip.label().plain();
    let key = |channel: &Channel| match channel.target {
        ChannelTarget::Transform { node, op, components: lane } => {
            let node = (node.index() < document.scene.graph.len()).then(|| document.scene.graph.label(node));
            format!("{clip_name}/{node:?}/{op}/{lane:?}")
        }
        other => format!("{clip_name}/{other:?}"),
    };
    clip.channels.iter().map(|channel| (key(channel), channel)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formats::SCENE_READERS;
    use crate::progress::Progress;
    use crate::scene::{Node, NodeId};
    use crate::session::Session;

    fn clip() -> Document {
        Document::open(&[concat!(env!("CARGO_MANIFEST_DIR"), "/configs/curl.dae")], SCENE_READERS, &Progress::default()).expect("the demo")
    }

    #[test]
    fn a_reload_says_what_changed() {
        let before = Document::default();
        let mut after = Document::default();
        assert_eq!(what_changed(&before, &after), tr!("app-reloaded"));
        after.scene.graph.add(None, Node::new("new bone"));
        let told = what_changed(&before, &after);
        assert!(told.contains("new bone") && told.contains(&tr!("app-changed-new", names = "new bone")), "{told}");
        assert!(what_changed(&after, &before).contains(&tr!("app-changed-gone", names = "new bone")));
    }

    #[test]
    fn many_names_are_counted() {
        let mut after = Document::default();
        for number in 0..9 {
            after.scene.graph.add(None, Node::new(format!("bone {number}")));
        }
        let told = what_changed(&Document::default(), &after);
        assert!(told.contains("bone 2") && !told.contains("bone 3") && told.contains('6'), "{told}");
    }

    #[test]
    fn another_name_shape_or_key_is_noticed() {
        let told = |change: fn(&mut Document)| {
            let mut after = clip();
            change(&mut after);
            what_changed(&clip(), &after)
        };
        assert_eq!(told(|_| ()), tr!("app-reloaded"));
        let renamed = told(|after| after.scene.graph.node_mut(NodeId(2)).name = "other".into());
        let old = Session::new(clip()).document().scene.graph.node(NodeId(2)).name.clone();
        assert!(renamed.contains(&old) && renamed.contains("other"), "{renamed}");
        assert!(
            told(|after| Arc::make_mut(&mut after.scene.meshes[0]).positions[0].x += 1.0).contains(&tr!("app-changed-shapes", count = 1))
        );
        let keys = told(|after| Arc::make_mut(&mut after.clips[0].channels[0].curve).values[0] += 1.0);
        assert!(keys.contains(&tr!("app-changed-curves", count = 1)), "{keys}");
        assert!(told(|after| after.clips.clear()).contains(&clip().clips[0].name));
    }
}

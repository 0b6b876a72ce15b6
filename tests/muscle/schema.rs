//! The published schema of muscle files against the reader: the same keys, the same types, the same bounds.

use std::collections::BTreeSet;

use serde_json::{Map, Value, json};
use sinew::muscle::config::ConfigErrorKind;
use sinew::muscle::{MuscleFile, ProfileError};

const SHIPPED: [&str; 10] = [
    include_str!("../../configs/atlas-muscles.yaml"),
    include_str!("../../configs/biceps-human-wrapped.yaml"),
    include_str!("../../configs/biceps-human.yaml"),
    include_str!("../../configs/biceps-measured.yaml"),
    include_str!("../../configs/biceps.yaml"),
    include_str!("../../configs/brachialis-human.yaml"),
    include_str!("../../configs/curl-muscles.yaml"),
    include_str!("../../configs/example.yaml"),
    include_str!("../../configs/triceps-human.yaml"),
    include_str!("../../configs/walker-muscles.yaml"),
];

fn schema() -> Value {
    serde_json::from_str(include_str!("../../resources/muscle.schema.json")).unwrap()
}

/// Whether a value keeps to a schema. Knows the words that this schema is written in, and fails at any other.
fn fits(root: &Value, schema: &Value, value: &Value) -> bool {
    let number = |bound: &Value, holds: fn(f64, f64) -> bool| value.as_f64().is_none_or(|value| holds(value, bound.as_f64().unwrap()));
    let count =
        |bound: &Value, holds: fn(u64, u64) -> bool| value.as_array().is_none_or(|list| holds(list.len() as u64, bound.as_u64().unwrap()));
    let has = |keys: &Value| value.as_object().is_none_or(|map| strings(keys).all(|key| map.contains_key(key)));
    let of = |rule: &'_ Value| rule.as_array().unwrap().iter().filter(|rule| fits(root, rule, value)).count();
    let rules = schema.as_object().unwrap();
    rules.iter().all(|(word, rule)| match word.as_str() {
        "$schema" | "$defs" | "title" | "description" | "default" => true,
        "$ref" => fits(root, root.pointer(rule.as_str().unwrap().trim_start_matches('#')).unwrap(), value),
        "type" => match rule.as_str().unwrap() {
            "object" => value.is_object(),
            "array" => value.is_array(),
            "string" => value.is_string(),
            "number" => value.is_number(),
            other => panic!("type {other}"),
        },
        "enum" => rule.as_array().unwrap().contains(value),
        "pattern" => {
            assert_eq!(rule, "^#[0-9A-Fa-f]{6}$");
            let is_color = |text: &str| text.len() == 7 && text.starts_with('#') && text[1..].bytes().all(|byte| byte.is_ascii_hexdigit());
            value.as_str().is_none_or(is_color)
        }
        "minimum" => number(rule, |value, bound| value >= bound),
        "maximum" => number(rule, |value, bound| value <= bound),
        "exclusiveMaximum" => number(rule, |value, bound| value < bound),
        "exclusiveMinimum" => number(rule, |value, bound| value > bound),
        "minItems" => count(rule, |count, bound| count >= bound),
        "maxItems" => count(rule, |count, bound| count <= bound),
        "items" => value.as_array().is_none_or(|list| list.iter().all(|item| fits(root, rule, item))),
        "properties" => {
            value.as_object().is_none_or(|map| map.iter().all(|(key, value)| rule.get(key).is_none_or(|rule| fits(root, rule, value))))
        }
        "additionalProperties" => {
            assert_eq!(rule, false);
            value.as_object().is_none_or(|map| map.keys().all(|key| rules["properties"].get(key).is_some()))
        }
        "required" => has(rule),
        "dependentRequired" => rule.as_object().unwrap().iter().all(|(key, needs)| value.get(key).is_none() || has(needs)),
        "oneOf" => of(rule) == 1,
        "anyOf" => of(rule) > 0,
        "not" => !fits(root, rule, value),
        other => panic!("the test does not know the word {other}"),
    })
}

fn strings(list: &Value) -> impl Iterator<Item = &str> {
    list.as_array().unwrap().iter().map(|item| item.as_str().unwrap())
}

/// Files that between them have every key.
fn complete() -> [Value; 4] {
    [
        json!({"muscle_config": {"radiuses": [1.0, 2.0, 1.0], "grow_mults": [0.0, 1.0, 0.0], "len": 30.0},
            "carcass_config": {"data": [[10.0, 200.0], [30.0, 100.0]], "thickness": 5.0}}),
        json!({"unit": "cm", "arm": {"upper": 33.0, "forearm": 26.0, "thickness": 1.0, "flexion": [0.0, 140.0]}, "muscles": [{
            "name": "A", "color": "#b0A030", "pennation": 12.5, "source": "none", "length": 25.0, "radii": [1.0, 2.0, 1.0], "growth": [0.0, 1.0, 0.0],
            "origin": {"bone": "upper arm", "offset": [0.0, -3.0, 0.0]}, "insertion": {"bone": "forearm", "offset": [0.0, -4.0, 0.0]},
            "via": [{"bone": "upper arm", "offset": [3.0, -15.0, 0.0]}],
            "wrap": {"bone": "upper arm", "offset": [0.0, -33.0, 0.0], "radius": 1.5, "side": [1.0, 0.0, 0.0]},
            "tendons": {"origin": {"length": 2.0, "radius": 0.3}, "insertion": {"length": 4.0, "radius": 0.3}}}]}),
        json!({"unit": 0.5, "clip": "clip.dae", "scale": "with bones", "skin": {"fat": 0.01, "reach": 0.1, "elasticity": 0.5},
            "joint": {"bone": "b", "axis": [1.0, 0.0, 0.0], "range": [-10.0, 90.0]}, "muscles": [
            {"length": 25.0, "poses": [{"angle": 0.0, "radii": [1.0, 2.0]}, {"angle": 60.0, "radii": [1.5, 2.0]}]},
            {"length": 25.0, "poses": [{"length": 20.0, "radii": [1.0, 2.0]}, {"length": 30.0, "radii": [1.5, 2.0]}]}]}),
        json!({"joints": [{"name": "elbow", "bone": "b", "axis": [1.0, 0.0, 0.0]}, {"bone": "a", "axis": [0.0, 1.0, 0.0]}], "muscles": [{
            "length": 25.0, "radii": [1.0, 2.0], "growth": [0.0, 1.0], "origin": {"bone": "a"}, "insertion": {"bone": "b"},
            "via": [
                {"bone": "a", "offset": [3.0, -15.0, 0.0], "active": {"joint": "elbow", "range": [10.0, 90.0]}},
                {"bone": "b", "moves": {"joint": "a", "angles": [0.0, 90.0], "offsets": [[1.0, 2.0, 3.0], [2.0, 2.0, 3.0]]}}],
            "wraps": [
                {"shape": "sphere", "bone": "a", "radius": 1.5, "side": [1.0, 0.0, 0.0], "between": "joint"},
                {"shape": "cylinder", "bone": "a", "offset": [0.0, 1.0, 0.0], "rotation": [0.0, 90.0, 0.0], "radius": 1.5, "length": 5.0,
                    "side": "-x", "between": [0, 2]},
                {"shape": "ellipsoid", "bone": "b", "radii": [1.0, 2.0, 3.0]},
                {"shape": "torus", "bone": "b", "radius": 3.0, "tube": 1.0}]}]}),
    ]
}

/// The places of all values in a file, the whole one first.
fn places(value: &Value, at: &str, found: &mut Vec<String>) {
    found.push(at.to_owned());
    match value {
        Value::Object(map) => map.iter().for_each(|(key, value)| places(value, &format!("{at}/{key}"), found)),
        Value::Array(list) => list.iter().enumerate().for_each(|(index, value)| places(value, &format!("{at}/{index}"), found)),
        _ => {}
    }
}

/// The file with the value at a place changed in every way that is tried, or taken away.
fn changed(file: &Value, place: &str) -> Vec<Value> {
    let others = [
        json!(true),
        json!("x"),
        json!("mm"),
        json!("with bones"),
        json!("#12345"),
        json!(-1.0),
        json!(0.0),
        json!(1),
        json!(400.0),
        json!([]),
        json!({}),
        json!([1.0]),
        json!([1.0, 2.0]),
        json!([0.0, 1.0, 0.0]),
        json!([-1.0, 2.0, 1.0]),
        json!(["x", "y", "z"]),
        json!([[1.0, 2.0], [3.0, 4.0]]),
        json!(vec![1.0; 12]),
    ];
    let mut all: Vec<Value> = Vec::new();
    for other in others {
        let mut file = file.clone();
        *file.pointer_mut(place).unwrap() = other;
        all.push(file);
    }
    let Some((above, last)) = place.rsplit_once('/') else { return all };
    let mut less = file.clone();
    match less.pointer_mut(above).unwrap() {
        Value::Object(map) => drop(map.remove(last)),
        Value::Array(list) => drop(list.remove(last.parse::<usize>().unwrap())),
        _ => unreachable!("{place}"),
    }
    all.push(less);
    all
}

fn read(file: &Value) -> Result<MuscleFile, ConfigErrorKind> {
    MuscleFile::parse(&file.to_string()).map_err(|error| error.kind)
}

#[test]
fn every_shipped_file_keeps_to_the_schema() {
    let schema = schema();
    for text in SHIPPED {
        let file: Value = sinew::yaml::from_text(text, 1 << 20).unwrap();
        assert!(fits(&schema, &schema, &file), "{text}");
    }
    let mut known: Vec<_> =
        std::fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/configs")).unwrap().flatten().map(|entry| entry.path()).collect();
    known.retain(|path| path.extension().is_some_and(|ending| ending == "yaml"));
    assert_eq!(known.len(), SHIPPED.len(), "a file of configs/ is not in the list above");
}

#[test]
fn the_files_of_the_test_have_every_key_of_the_schema() {
    fn keys<'a>(value: &'a Value, found: &mut BTreeSet<&'a str>) {
        match value {
            Value::Object(map) => map.iter().for_each(|(key, value)| {
                found.insert(key);
                keys(value, found);
            }),
            Value::Array(list) => list.iter().for_each(|value| keys(value, found)),
            _ => {}
        }
    }
    fn properties<'a>(value: &'a Value, found: &mut BTreeSet<&'a str>) {
        let Some(map) = value.as_object() else { return value.as_array().into_iter().flatten().for_each(|value| properties(value, found)) };
        if let Some(Value::Object(own)) = map.get("properties") {
            found.extend(own.keys().map(String::as_str));
        }
        map.values().for_each(|value| properties(value, found));
    }
    let (files, schema) = (complete(), schema());
    let (mut have, mut want) = (BTreeSet::new(), BTreeSet::new());
    files.iter().for_each(|file| keys(file, &mut have));
    properties(&schema, &mut want);
    assert_eq!(have, want);
    for file in &files {
        assert!(fits(&schema, &schema, file) && read(file).is_ok(), "{file}: {:?}", read(file).err());
    }
}

#[test]
fn objects_have_the_keys_that_the_reader_names() {
    // A key that is like no other is refused with the list of those that there are.
    let schema = schema();
    for file in complete() {
        let mut found = Vec::new();
        places(&file, "", &mut found);
        for place in found.iter().filter(|place| file.pointer(place).unwrap().is_object()) {
            let mut odd = file.clone();
            odd.pointer_mut(place).unwrap().as_object_mut().unwrap().insert("qqqqqqqqqqqqqqqq".to_owned(), json!(1));
            let error = read(&odd).unwrap_err();
            let ConfigErrorKind::UnknownKey { key, known, .. } = &error else { panic!("{place}: {error:?}") };
            assert!(!fits(&schema, &schema, &odd) && key == "qqqqqqqqqqqqqqqq", "{error:?}");
            let listed: BTreeSet<&str> = known.iter().copied().collect();
            // Each of these, and no other, may stand there by the schema.
            for key in listed.iter().copied().chain(["qqqqqqqqqqqqqqqq", "radiuses2"]) {
                assert_eq!(
                    knows(&schema, &schema, &place.split('/').skip(1).collect::<Vec<_>>(), key),
                    listed.contains(key),
                    "{place}/{key}: {error:?}"
                );
            }
            let own: &Map<String, Value> = file.pointer(place).unwrap().as_object().unwrap();
            assert!(own.keys().all(|key| listed.contains(key.as_str())), "{place}: {error:?}");
        }
    }
}

/// Whether a schema has the property `key` for the object at `place`.
fn knows(root: &Value, schema: &Value, place: &[&str], key: &str) -> bool {
    if let Some(to) = schema.get("$ref") {
        return knows(root, root.pointer(to.as_str().unwrap().trim_start_matches('#')).unwrap(), place, key);
    }
    let Some((first, rest)) = place.split_first() else {
        let choices = schema.get("oneOf").and_then(Value::as_array).filter(|_| schema.get("properties").is_none());
        return match choices {
            Some(choices) => choices.iter().any(|choice| knows(root, choice, place, key)),
            None => schema["properties"].get(key).is_some(),
        };
    };
    if let Some(items) = schema.get("items") {
        return knows(root, items, rest, key);
    }
    match schema.get("properties") {
        Some(properties) => properties.get(first).is_some_and(|schema| knows(root, schema, rest, key)),
        None => schema["oneOf"].as_array().unwrap().iter().any(|choice| knows(root, choice, place, key)),
    }
}

/// Whether an error is about values that belong together: numbers that make no muscle, bones that the arm has not, orders, directions. No schema can
/// say these.
fn is_about_several_values(error: &ConfigErrorKind) -> bool {
    use ConfigErrorKind as Kind;
    match error {
        Kind::AttachedAtElbow(_) | Kind::BadRange { .. } | Kind::NoDirection(_) | Kind::UnknownArmBone { .. } => true,
        Kind::RepeatedJoint(_) | Kind::UnknownJoint { .. } | Kind::MotionAngles | Kind::BadBetween { .. } => true,
        Kind::TorusWithoutHole { .. } | Kind::SideAlongCylinder => true,
        // A length of at most 1 m, in the unit of the file.
        Kind::TooLarge { name, .. } => name.key != Some("elasticity"),
        // As many offsets as angles.
        Kind::WrongCount { name, .. } => name.key == Some("offsets") && name.items.is_empty(),
        Kind::Profile(error) => {
            matches!(error, ProfileError::NoGrowth | ProfileError::PoseNodes { .. } | ProfileError::LengthsDiffer { .. })
        }
        _ => false,
    }
}

#[test]
fn the_reader_takes_what_the_schema_allows_and_nothing_else() {
    let schema = schema();
    let (mut seen, mut odd) = ([0, 0], Vec::new());
    for file in complete() {
        let mut found = Vec::new();
        places(&file, "", &mut found);
        for changed in found.iter().flat_map(|place| changed(&file, place)) {
            let (fits, read) = (fits(&schema, &schema, &changed), read(&changed));
            seen[usize::from(fits)] += 1;
            match read {
                Ok(_) => assert!(fits, "the schema refuses what the reader takes: {changed}"),
                Err(error) if fits && !is_about_several_values(&error) => odd.push((error, changed.to_string())),
                Err(_) => {}
            }
        }
    }
    assert!(odd.is_empty(), "the reader refuses what the schema allows: {odd:#?}");
    assert!(seen[0] > 300 && seen[1] > 100, "{seen:?}");
}

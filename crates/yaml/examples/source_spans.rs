//! Where each value of a YAML text stands.

use sinew_yaml::{Node, Value, YamlError, read};

/// Largest text that is read, bytes.
const LIMIT: u64 = 1 << 20;

/// `line:column path = word` for each single value.
pub(crate) fn source_spans(text: &str) -> Result<Vec<String>, YamlError> {
    let mut lines = Vec::new();
    walk(&read(text, LIMIT)?, "", &mut lines);
    Ok(lines)
}

fn walk(node: &Node, path: &str, lines: &mut Vec<String>) {
    match &node.value {
        Value::Plain(word) | Value::Text(word) => lines.push(format!("{}:{} {path} = {word}", node.place.line, node.place.column)),
        Value::List(values) => values.iter().enumerate().for_each(|(index, value)| walk(value, &format!("{path}[{index}]"), lines)),
        Value::Map(pairs) => {
            for (key, value) in pairs.iter() {
                let (Value::Plain(key) | Value::Text(key)) = &key.value else { continue };
                walk(value, &format!("{path}.{key}"), lines);
            }
        }
        Value::Tagged => {}
    }
}

fn main() -> Result<(), YamlError> {
    for line in source_spans("biceps:\n  radii: [5, 18]\n  growth: &g [0, 1]\ntriceps:\n  growth: *g\n")? {
        println!("{line}");
    }
    Ok(())
}

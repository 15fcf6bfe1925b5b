//! `docs/summary.schema.json` is made from the types of `summary.json`, and describes every key.

use crate::workbench::Workbench;
use ambulo_results::summary_schema;
use serde_json::{Value, json};
use std::fs;
use std::path::Path;

/// With AMBULO_WRITE=1 the file is written.
#[test]
fn the_schema_is_current() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/summary.schema.json");
    let schema = summary_schema().unwrap();
    if std::env::var_os("AMBULO_WRITE").is_some() {
        fs::write(&path, &schema).unwrap();
    }
    let found = fs::read(&path).unwrap_or_default();
    assert!(found == schema, "{} is out of date; run this test with AMBULO_WRITE=1", path.display());
}

/// A key that the schema does not describe, a key that is missing and a value of another type are all found.
fn assert_described(summary: &Value) {
    let schema: Value = serde_json::from_slice(&summary_schema().unwrap()).unwrap();
    assert_eq!(differences(&schema, &schema, summary, ""), Vec::<String>::new());
    for (key, value) in [("frames", json!("many")), ("findings", json!(null)), ("extra", json!(1))] {
        let mut wrong = summary.clone();
        wrong[key] = value;
        assert!(!differences(&schema, &schema, &wrong, "").is_empty(), "{key}");
    }
    let mut short = summary.clone();
    short.as_object_mut().unwrap().remove("version").unwrap();
    assert!(!differences(&schema, &schema, &short, "").is_empty());
}

#[test]
fn summaries_of_recordings_follow_the_schema() {
    let bench = Workbench::new("schema-forces");
    bench.forces(&[]).done();
    assert_described(&bench.json("out/summary.json"));
    bench.forces(&["--predict"]).done();
    assert_described(&bench.json("out/summary.json"));
}

#[test]
fn summaries_of_synthetic_walks_follow_the_schema() {
    let bench = Workbench::new("schema-walk");
    bench.run(&["walk", "--mode", "paper", "-o", "out", "--quiet"]).infeasible();
    assert_described(&bench.json("out/summary.json"));
}

#[test]
fn summaries_of_scenes_follow_the_schema() {
    let bench = Workbench::new("schema-scene");
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/pendulum.toml");
    bench.run(&["simulate", scene.to_str().unwrap(), "--duration", "0.2", "-o", "out", "--quiet"]).done();
    assert_described(&bench.json("out/summary.json"));
}

/// Where a value differs from the schema, as paths; a small checker of the parts of JSON Schema that the file uses.
fn differences(schema: &Value, root: &Value, value: &Value, path: &str) -> Vec<String> {
    if let Some(name) = schema["$ref"].as_str() {
        let place = name.strip_prefix("#/$defs/").unwrap();
        return differences(&root["$defs"][place], root, value, path);
    }
    for key in ["anyOf", "oneOf"] {
        if let Some(choices) = schema[key].as_array() {
            let each: Vec<Vec<String>> = choices.iter().map(|choice| differences(choice, root, value, path)).collect();
            if each.iter().any(Vec::is_empty) {
                return Vec::new();
            }
            return each.into_iter().min_by_key(Vec::len).unwrap();
        }
    }
    let kind = match value {
        Value::Null => "null",
        Value::Bool(_) => "boolean",
        Value::Number(_) => "number",
        Value::String(_) => "string",
        Value::Array(_) => "array",
        Value::Object(_) => "object",
    };
    let may_be = |name: &Value| name == kind || name == "integer" && value.is_u64();
    let allowed = match &schema["type"] {
        Value::Null => true,
        Value::Array(kinds) => kinds.iter().any(may_be),
        name => may_be(name),
    };
    let constant = schema.get("const").is_none_or(|constant| constant == value);
    let listed = schema["enum"].as_array().is_none_or(|listed| listed.contains(value));
    if !allowed || !constant || !listed {
        return vec![format!("{path}: {value}")];
    }
    inside(schema, root, value, path)
}

fn inside(schema: &Value, root: &Value, value: &Value, path: &str) -> Vec<String> {
    let mut found = Vec::new();
    if let Value::Object(keys) = value {
        for required in schema["required"].as_array().into_iter().flatten() {
            if !keys.contains_key(required.as_str().unwrap()) {
                found.push(format!("{path}: lacks {required}"));
            }
        }
        for (key, value) in keys {
            let path = format!("{path}/{key}");
            match (schema["properties"].get(key), schema.get("additionalProperties")) {
                (Some(schema), _) | (None, Some(schema)) => found.extend(differences(schema, root, value, &path)),
                (None, None) => found.push(format!("{path}: is not in the schema")),
            }
        }
    }
    if let Value::Array(values) = value {
        for (i, value) in values.iter().enumerate() {
            found.extend(differences(&schema["items"], root, value, &format!("{path}/{i}")));
        }
    }
    found
}

//! The JSON of requests for other languages: `docs/request.schema.json`, and `web/src/request.ts` for the page.
//!
//! Both are made from the types of requests, with their comments. With AMBULO_WRITE=1 the tests write them.

use ambulo_cli::internals::request_schema as schema;
use serde_json::{Map, Value};
use std::fs;
use std::path::Path;

/// A file is as expected, or is written.
fn assert_current(path: &str, expected: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(path);
    if std::env::var_os("AMBULO_WRITE").is_some() {
        fs::write(&path, expected).unwrap();
    }
    let found = fs::read_to_string(&path).unwrap_or_default();
    assert!(found == expected, "{} is out of date; run this test with AMBULO_WRITE=1", path.display());
}

#[test]
fn the_schema_of_requests_is_current() {
    let text = serde_json::to_string_pretty(&schema()).unwrap() + "\n";
    assert_current("docs/request.schema.json", &text);
}

#[test]
fn the_page_knows_the_requests() {
    let schema = schema();
    let mut text = String::from(
        "// Made from the types of requests by crates/ambulo-cli/tests/request_contract.rs; do not edit.\n",
    );
    text += &format!("\n{}export type Request = {};\n", comment(&schema, ""), of(&schema));
    for (name, definition) in schema["$defs"].as_object().unwrap() {
        let kind = match definition.get("properties") {
            Some(_) => format!("export interface {name} {}\n", of(definition)),
            None => format!("export type {name} = {};\n", of(definition)),
        };
        text += &format!("\n{}{kind}", comment(definition, ""));
    }
    assert_current("web/src/request.ts", &text);
}

/// The type of TypeScript that a schema describes.
fn of(schema: &Value) -> String {
    if let Some(name) = schema["$ref"].as_str() {
        return name.trim_start_matches("#/$defs/").to_owned();
    }
    if let Some(value) = schema.get("const") {
        return value.to_string();
    }
    let lists = ["oneOf", "anyOf", "enum"].map(|key| schema[key].as_array().map(|list| (key, list)));
    if let Some((key, list)) = lists.into_iter().flatten().next() {
        let kinds = list.iter().map(|one| if key == "enum" { one.to_string() } else { of(one) });
        return kinds.collect::<Vec<_>>().join(" | ");
    }
    match &schema["type"] {
        Value::Array(kinds) => {
            let each = |kind: &Value| {
                let mut one = schema.clone();
                one["type"] = kind.clone();
                of(&one)
            };
            kinds.iter().map(each).collect::<Vec<_>>().join(" | ")
        }
        kind => of_kind(kind.as_str().unwrap(), schema),
    }
}

fn of_kind(kind: &str, schema: &Value) -> String {
    match kind {
        "integer" | "number" => "number".to_owned(),
        "array" => format!("({})[]", of(&schema["items"])).replace("(string)", "string").replace("(number)", "number"),
        "object" => match schema["properties"].as_object() {
            Some(properties) => fields(schema, properties),
            None => format!("Record<string, {}>", of(&schema["additionalProperties"])),
        },
        other => other.to_owned(),
    }
}

fn fields(schema: &Value, properties: &Map<String, Value>) -> String {
    let required = |name: &str| schema["required"].as_array().is_some_and(|list| list.iter().any(|one| one == name));
    let field = |(name, property): (&String, &Value)| {
        let mark = if required(name) { "" } else { "?" };
        format!("{}  {name}{mark}: {};\n", comment(property, "  "), of(property))
    };
    format!("{{\n{}}}", properties.iter().map(field).collect::<String>())
}

fn comment(schema: &Value, indent: &str) -> String {
    let text = schema["description"].as_str().unwrap_or_default().replace('\n', " ");
    if text.is_empty() { text } else { format!("{indent}/** {text} */\n") }
}

//! What version 0.1 promises, recorded in `docs/surface/`: a change needs a line of the CHANGELOG.
//!
//! The record has the commands with their options, the fields of requests, the keys of `summary.json`, the files with
//! their columns, the codes of findings and the names of the Python package. `cargo xtask` records the Rust library
//! (`house::surface`). With AMBULO_WRITE=1 the tests write.

use crate::workbench::{RAW, Workbench};
use ambulo::findings::Code;
use ambulo_cli::internals;
use ambulo_results::summary_schema;
use serde_json::Value;
use sha2::{Digest, Sha256};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The record of a part is as expected, or is written.
fn assert_recorded(name: &str, lines: impl IntoIterator<Item = String>) {
    let expected: String = lines.into_iter().map(|line| line + "\n").collect();
    let path = root().join("docs/surface").join(name);
    if std::env::var_os("AMBULO_WRITE").is_some() {
        fs::write(&path, &expected).unwrap();
    }
    let found = fs::read_to_string(&path).unwrap_or_default();
    let differs = |a: &str, b: &str| {
        let others: BTreeSet<&str> = b.lines().collect();
        a.lines().filter(|line| !others.contains(line)).map(|line| format!("\n  {line}")).collect::<String>()
    };
    let (gone, new) = (differs(&found, &expected), differs(&expected, &found));
    assert!(
        found == expected,
        "docs/surface/{name} is not what the program has. Gone:{gone}\nNew:{new}\n\
         hint: run this test with AMBULO_WRITE=1, and write a line of the CHANGELOG"
    );
}

#[test]
fn the_commands_and_their_options_are_recorded() {
    let mut command = internals::command_line();
    command.build();
    let mut lines = Vec::new();
    for verb in command.get_subcommands().filter(|verb| !verb.is_hide_set()) {
        for arg in verb.get_arguments().filter(|arg| !arg.is_hide_set()) {
            let name = arg.get_long().map_or_else(|| arg.get_id().to_string(), |long| format!("--{long}"));
            let short = arg.get_short().map_or(String::new(), |short| format!(" -{short}"));
            let choices: Vec<String> =
                arg.get_possible_values().iter().map(|value| value.get_name().to_owned()).collect();
            let choices = if choices.is_empty() { String::new() } else { format!(" {}", choices.join("|")) };
            let value = arg.get_num_args().is_some_and(|count| count.takes_values());
            lines.push(format!("{} {name}{short}{}{choices}", verb.get_name(), if value { " VALUE" } else { "" }));
        }
    }
    lines.sort();
    let codes = ["0 results were written", "1 with --check: infeasible", "2 nothing could be computed"];
    assert_recorded("command.txt", lines.into_iter().chain(codes.map(|code| format!("exit code {code}"))));
}

/// One line per value of a schema: its path and its type.
fn values(schema: &Value, definitions: &Value, path: &str, seen: &[&str], lines: &mut BTreeSet<String>) {
    if let Some(name) = schema["$ref"].as_str().and_then(|name| name.strip_prefix("#/$defs/")) {
        if seen.contains(&name) {
            lines.insert(format!("{path}: {name}"));
        } else {
            values(&definitions[name], definitions, path, &[seen, &[name]].concat(), lines);
        }
        return;
    }
    for key in ["anyOf", "oneOf"] {
        for choice in schema[key].as_array().into_iter().flatten() {
            values(choice, definitions, path, seen, lines);
        }
    }
    if let Some(value) = schema.get("const") {
        lines.insert(format!("{path} = {value}"));
    }
    for value in schema["enum"].as_array().into_iter().flatten() {
        lines.insert(format!("{path} = {value}"));
    }
    if let Some(kind) = schema.get("type").filter(|_| schema["enum"].is_null()) {
        lines.insert(format!("{path}: {}", kind.to_string().replace('"', "")));
    }
    for (name, part) in schema["properties"].as_object().into_iter().flatten() {
        let needed = schema["required"].as_array().is_some_and(|list| list.iter().any(|one| one == name));
        values(part, definitions, &format!("{path}.{name}{}", if needed { "!" } else { "" }), seen, lines);
    }
    for (key, mark) in [("items", "[]"), ("additionalProperties", ".*")] {
        if schema[key].is_object() {
            values(&schema[key], definitions, &format!("{path}{mark}"), seen, lines);
        }
    }
}

fn schema_lines(root: &str, schema: &Value) -> BTreeSet<String> {
    let mut lines = BTreeSet::new();
    values(schema, &schema["$defs"], root, &[], &mut lines);
    lines
}

#[test]
fn the_fields_of_requests_are_recorded() {
    assert_recorded("requests.txt", schema_lines("request", &internals::request_schema()));
}

#[test]
fn the_keys_of_summaries_are_recorded() {
    let schema: Value = serde_json::from_slice(&summary_schema().unwrap()).unwrap();
    assert_recorded("summary.txt", schema_lines("summary", &schema));
}

#[test]
fn a_removed_key_and_another_type_change_the_record() {
    let schema: Value = serde_json::from_slice(&summary_schema().unwrap()).unwrap();
    let lines = schema_lines("summary", &schema);
    let mut other = schema.clone();
    let properties = other["$defs"]["Summary"]["properties"].as_object_mut().unwrap();
    assert!(properties.remove("mass_kg").is_some());
    let shorter = schema_lines("summary", &other);
    assert!(lines.difference(&shorter).all(|line| line.starts_with("summary.mass_kg")) && shorter != lines);
    let mut other = schema;
    other["$defs"]["Summary"]["properties"]["frames"] = serde_json::json!({ "type": "string" });
    assert_ne!(schema_lines("summary", &other), lines);
}

/// The first row with names of a table.
fn columns(bench: &Workbench, path: &str) -> Vec<String> {
    if path.ends_with(".csv") {
        let first = bench.text(path).lines().next().unwrap_or_default().to_owned();
        first.split(',').map(str::to_owned).collect()
    } else {
        bench.table(path).names().to_vec()
    }
}

#[test]
fn the_files_and_their_columns_are_recorded() {
    let bench = Workbench::new("surface");
    bench.forces(&[&RAW[..], &["--predict"]].concat()).done();
    let scene = root().join("examples/slope.toml");
    bench.run(&["simulate", scene.to_str().unwrap(), "--duration", "0.05", "-o", "scene", "--quiet"]).done();
    let loop_scene = root().join("examples/four-bar.toml");
    bench.run(&["simulate", loop_scene.to_str().unwrap(), "--duration", "0.05", "-o", "loop", "--quiet"]).done();
    let mut lines = Vec::new();
    for (verb, folder) in [("forces", "out"), ("simulate", "scene"), ("simulate", "loop")] {
        for name in bench.names(folder) {
            lines.push(format!("{verb} {name}"));
            if [".mot", ".sto", ".csv"].iter().any(|end| name.ends_with(end)) {
                let columns = columns(&bench, &format!("{folder}/{name}"));
                lines.extend(columns.into_iter().map(|column| format!("{verb} {name}: {column}")));
            }
        }
    }
    let mut seen = BTreeSet::new();
    assert_recorded("files.txt", lines.into_iter().filter(|line| seen.insert(line.clone())).collect::<Vec<_>>());
}

#[test]
fn the_codes_of_findings_are_recorded() {
    assert_recorded("findings.txt", Code::all().map(|code| code.name().to_owned()));
}

#[test]
fn the_names_of_the_python_package_are_recorded() {
    let script = root().join("web/documents/python_api.py");
    let Ok(output) = Command::new(if cfg!(windows) { "python" } else { "python3" }).arg(script).output() else {
        println!("skipped: no Python");
        return;
    };
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let api: Value = serde_json::from_slice(&output.stdout).unwrap();
    let line = |value: &Value, owner: &str| {
        let text = |key: &str| value[key].as_str().unwrap();
        format!("{} {owner}{}{}", text("kind"), text("name"), text("signature"))
    };
    let mut lines = Vec::new();
    for name in api["names"].as_array().unwrap() {
        lines.push(line(name, ""));
        let owner = format!("{}.", name["name"].as_str().unwrap());
        lines.extend(name["members"].as_array().into_iter().flatten().map(|member| line(member, &owner)));
    }
    assert_recorded("python.txt", lines);
}

/// The first twelve digits of a hash over all parts of the record.
fn hash_of(parts: &[(String, Vec<u8>)]) -> String {
    let mut hash = Sha256::new();
    for (name, bytes) in parts {
        hash.update(name.as_bytes());
        hash.update(bytes);
    }
    hash.finalize().iter().take(6).map(|byte| format!("{byte:02x}")).collect()
}

fn parts() -> Vec<(String, Vec<u8>)> {
    let mut parts: Vec<(String, Vec<u8>)> = fs::read_dir(root().join("docs/surface"))
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|end| end == "txt"))
        .map(|path| (path.file_name().unwrap().to_str().unwrap().to_owned(), fs::read(&path).unwrap()))
        .collect();
    parts.sort();
    parts
}

/// Whether the newest entry of a CHANGELOG names the record with this hash.
fn is_announced(changelog: &str, hash: &str) -> bool {
    let newest = changelog.split("\n## ").nth(1).unwrap_or_default();
    newest.contains(&format!("`{hash}`"))
}

#[test]
fn a_change_of_what_is_promised_has_a_line_in_the_changelog() {
    let changelog = fs::read_to_string(root().join("CHANGELOG.md")).unwrap();
    let parts = parts();
    assert_eq!(parts.len(), 7, "command, files, findings, python, requests, rust, summary");
    let hash = hash_of(&parts);
    assert!(
        is_announced(&changelog, &hash),
        "what is promised has changed (docs/surface), and the newest entry of CHANGELOG.md does not say so\n\
         hint: write there what changed, with **Breaking** if it may stop a script or code, and the new hash `{hash}`"
    );
    // A name that is gone, or one in an older entry of the CHANGELOG, is not enough.
    for part in 0..parts.len() {
        let mut changed = parts.clone();
        let bytes = &mut changed[part].1;
        let line = bytes.iter().position(|byte| *byte == b'\n').unwrap();
        bytes.drain(..=line);
        assert!(!is_announced(&changelog, &hash_of(&changed)), "{} may change", parts[part].0);
    }
    assert!(!is_announced(&changelog.replacen("\n## ", "\n## 0.1.1\n\nOther.\n\n## ", 1), &hash));
}

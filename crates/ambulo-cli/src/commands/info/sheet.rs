//! What is said of a file: keys and values for programs, lines for people.

use ambulo::findings::Findings;
use ambulo_formats::Remark;
use serde_json::{Map, Value};

/// Characters of a line of names.
const WIDTH: usize = 110;

/// What a file holds, in the order in which it is said.
#[derive(Debug)]
pub(crate) struct Sheet {
    rows: Vec<Row>,
}

#[derive(Debug)]
struct Row {
    key: &'static str,
    value: Value,
    lines: Vec<String>,
}

impl Sheet {
    /// A file of this kind.
    pub(super) fn of(kind: &str) -> Sheet {
        let mut sheet = Sheet { rows: Vec::new() };
        sheet.text("kind", kind);
        sheet
    }

    /// A value; people see it as programs do. `None` is said to programs only.
    pub(super) fn value(&mut self, key: &'static str, value: impl Into<Value>) {
        let value = value.into();
        let lines = match &value {
            Value::Null => vec![],
            Value::Number(number) if number.is_f64() => vec![short(number.as_f64().unwrap_or_default())],
            Value::String(text) => vec![text.clone()],
            Value::Array(items) => vec![items.iter().map(shown).collect::<Vec<_>>().join(", ")],
            other => vec![other.to_string()],
        };
        self.said(key, value, lines);
    }

    pub(super) fn text(&mut self, key: &'static str, text: &str) {
        self.value(key, text);
    }

    /// A value with its own lines for people; the first stands beside the key.
    pub(super) fn said(&mut self, key: &'static str, value: impl Into<Value>, lines: Vec<String>) {
        self.rows.push(Row { key, value: value.into(), lines });
    }

    /// Things of which each has a line.
    pub(super) fn list(&mut self, key: &'static str, items: Vec<String>) {
        let lines = std::iter::once(items.len().to_string()).chain(items.iter().cloned()).collect();
        self.said(key, items, lines);
    }

    /// Names, many on a line.
    pub(super) fn names(&mut self, key: &'static str, names: &[&str]) {
        let lines = std::iter::once(names.len().to_string()).chain(wrapped(names)).collect();
        self.said(key, names, lines);
    }

    /// What was odd in a file.
    pub(super) fn remarks(&mut self, remarks: &[Remark]) {
        if !remarks.is_empty() {
            self.list("remarks", remarks.iter().map(ToString::to_string).collect());
        }
    }

    /// What was odd in what was made of it.
    pub(super) fn findings(&mut self, findings: &Findings) {
        if !findings.as_slice().is_empty() {
            self.list("findings", findings.as_slice().iter().map(ToString::to_string).collect());
        }
    }

    /// The command to type next.
    pub(super) fn next(&mut self, command: String) {
        self.value("next", command);
    }

    /// For programs.
    pub(crate) fn json(&self) -> Value {
        Value::Object(self.rows.iter().map(|row| (row.key.to_owned(), row.value.clone())).collect::<Map<_, _>>())
    }

    /// For people.
    pub(crate) fn lines(&self) -> Vec<String> {
        let said = |row: &Row| {
            let label = row.key.replace('_', " ");
            let (first, others) = row.lines.split_first()?;
            let others = others.iter().map(|line| format!("  {line}"));
            Some(std::iter::once(format!("{label}: {first}")).chain(others).collect::<Vec<_>>())
        };
        self.rows.iter().filter_map(said).flatten().collect()
    }
}

/// Six digits for the eye; --json has them all.
pub(super) fn short(number: f64) -> String {
    let rounded = format!("{number:.6}");
    rounded.trim_end_matches('0').trim_end_matches('.').to_owned()
}

fn shown(value: &Value) -> String {
    match value {
        Value::Number(number) if number.is_f64() => short(number.as_f64().unwrap_or_default()),
        Value::String(text) => text.clone(),
        other => other.to_string(),
    }
}

/// Names with commas between them, in lines that are not too long.
pub(super) fn wrapped(names: &[&str]) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for (k, name) in names.iter().enumerate() {
        let word = if k + 1 < names.len() { format!("{name},") } else { (*name).to_owned() };
        match lines.last_mut() {
            Some(line) if line.len() + 1 + word.len() <= WIDTH => {
                line.push(' ');
                line.push_str(&word);
            }
            _ => lines.push(word),
        }
    }
    lines
}

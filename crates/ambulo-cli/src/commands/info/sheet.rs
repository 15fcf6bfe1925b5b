//! The description of a file: keys and values for JSON, lines of text for the terminal.

use ambulo::findings::Findings;
use ambulo_formats::Remark;
use serde_json::{Map, Value};

/// Longest line of names, in characters.
const WIDTH: usize = 110;

/// The description of a file, in the order in which it is printed.
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
    /// Begins the description of a file of this kind.
    pub(super) fn of(kind: &str) -> Sheet {
        let mut sheet = Sheet { rows: Vec::new() };
        sheet.text("kind", kind);
        sheet
    }

    /// Adds a value with the same content in JSON and in text; null is omitted from the text.
    pub(super) fn value(&mut self, key: &'static str, value: impl Into<Value>) {
        let value = value.into();
        let lines = match &value {
            Value::Null => vec![],
            Value::Number(number) if number.is_f64() => vec![short(number.as_f64().unwrap_or_default())],
            Value::String(text) => vec![text.clone()],
            Value::Array(items) => vec![items.iter().map(shown).collect::<Vec<_>>().join(", ")],
            other => vec![other.to_string()],
        };
        self.entry(key, value, lines);
    }

    pub(super) fn text(&mut self, key: &'static str, text: &str) {
        self.value(key, text);
    }

    /// Adds a value for JSON with its own lines of text; the first line follows the key.
    pub(super) fn entry(&mut self, key: &'static str, value: impl Into<Value>, lines: Vec<String>) {
        self.rows.push(Row { key, value: value.into(), lines });
    }

    /// Adds a list with one line per item.
    pub(super) fn list(&mut self, key: &'static str, items: Vec<String>) {
        let lines = std::iter::once(items.len().to_string()).chain(items.iter().cloned()).collect();
        self.entry(key, items, lines);
    }

    /// Adds a list of names, several per line.
    pub(super) fn names(&mut self, key: &'static str, names: &[&str]) {
        let lines = std::iter::once(names.len().to_string()).chain(wrapped(names)).collect();
        self.entry(key, names, lines);
    }

    /// Adds the remarks of the reader.
    pub(super) fn remarks(&mut self, remarks: &[Remark]) {
        if !remarks.is_empty() {
            self.list("remarks", remarks.iter().map(ToString::to_string).collect());
        }
    }

    /// Adds the warnings and notes about the content.
    pub(super) fn findings(&mut self, findings: &Findings) {
        if !findings.as_slice().is_empty() {
            self.list("findings", findings.as_slice().iter().map(ToString::to_string).collect());
        }
    }

    /// Adds the command to type next.
    pub(super) fn next(&mut self, command: String) {
        self.value("next", command);
    }

    pub(crate) fn json(&self) -> Value {
        Value::Object(self.rows.iter().map(|row| (row.key.to_owned(), row.value.clone())).collect::<Map<_, _>>())
    }

    /// The lines of text for the terminal.
    pub(crate) fn lines(&self) -> Vec<String> {
        let text = |row: &Row| {
            let label = row.key.replace('_', " ");
            let (first, others) = row.lines.split_first()?;
            let others = others.iter().map(|line| format!("  {line}"));
            Some(std::iter::once(format!("{label}: {first}")).chain(others).collect::<Vec<_>>())
        };
        self.rows.iter().filter_map(text).flatten().collect()
    }
}

/// A number with at most six decimals; --json has all digits.
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

/// Names separated by commas, in lines of at most [`WIDTH`] characters.
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

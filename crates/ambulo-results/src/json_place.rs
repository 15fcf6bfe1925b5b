//! Where in JSON text an error is: the keys that lead there.
//!
//! Readers that note the keys on their way are compiled once more for every type. Here the keys are looked for when
//! there is an error: the reader gets the text up to the end of one word after another, and the first word after which
//! it finds fault, not only an early end, is the wrong one. Bisection takes a dozen readings.
//!
//! Pinned by: tests/json_place.rs

use serde_json::Error;
use serde_json::error::Category;
use std::fmt::Write;

/// The entry of an open object or list that is being read.
enum Entry {
    /// Of an object; `None` before its key.
    Key(Option<String>),
    /// Of a list.
    Number(usize),
}

/// The beginning of a message about the first error in a text: the keys that lead there, as in
/// "`forces.trials[2].mass`: "; empty at the top. `read` is the reader of the text.
#[must_use]
pub fn json_place(text: &[u8], read: &dyn Fn(&[u8]) -> Option<Error>) -> String {
    let (ends, _) = scan(text);
    let is_refused = |end: usize| read(&text[..end]).is_some_and(|error| error.classify() != Category::Eof);
    let accepted = ends.partition_point(|end| !is_refused(*end));
    let Some(end) = ends.get(accepted) else { return String::new() };
    let (_, mut open) = scan(&text[..*end]);
    if matches!(text[end - 1], b'{' | b'[') {
        open.pop(); // the whole object or list is of the wrong type
    }
    let mut path = String::new();
    for entry in open {
        let dot = if path.is_empty() { "" } else { "." };
        let added = match entry {
            Entry::Key(Some(key)) => write!(path, "{dot}{key}"),
            Entry::Number(number) => write!(path, "[{number}]"),
            Entry::Key(None) => Ok(()),
        };
        debug_assert!(added.is_ok(), "a string takes all text");
    }
    if path.is_empty() { path } else { format!("`{path}`: ") }
}

/// The ends of all words of a text (strings, numbers, brackets), and the entries that are open at its end.
fn scan(text: &[u8]) -> (Vec<usize>, Vec<Entry>) {
    let (mut ends, mut open) = (Vec::new(), Vec::new());
    let mut at = 0;
    while let Some(byte) = text.get(at) {
        let start = at;
        at += 1;
        match (byte, open.last_mut()) {
            (b':', _) => continue,
            (b',', Some(Entry::Key(key))) => {
                *key = None;
                continue;
            }
            (b',', Some(Entry::Number(number))) => {
                *number += 1;
                continue;
            }
            (byte, _) if byte.is_ascii_whitespace() => continue,
            (b'{', _) => open.push(Entry::Key(None)),
            (b'[', _) => open.push(Entry::Number(0)),
            (b'}' | b']', _) => drop(open.pop()),
            (b'"', last) => {
                at = end_of_string(text, at);
                if let Some(Entry::Key(key @ None)) = last {
                    *key = serde_json::from_slice(&text[start..at]).ok();
                }
            }
            _ => at = end_of_number(text, at),
        }
        ends.push(at);
    }
    (ends, open)
}

/// Behind the quotation mark that ends a string, or the end of the text.
fn end_of_string(text: &[u8], start: usize) -> usize {
    let mut at = start;
    while let Some(byte) = text.get(at) {
        at += if *byte == b'\\' { 2 } else { 1 };
        if *byte == b'"' {
            break;
        }
    }
    at.min(text.len())
}

/// Behind a number, `true`, `false` or `null`.
fn end_of_number(text: &[u8], start: usize) -> usize {
    let is_inside = |byte: &u8| byte.is_ascii_alphanumeric() || b"+-.".contains(byte);
    start + text[start..].iter().take_while(|byte| is_inside(byte)).count()
}

//! One JSON object without nesting on one line: how the peers' programs hand over their results.
//!
//! Not handled, and refused: objects and arrays as values.

use std::collections::BTreeMap;
use std::iter::Peekable;
use std::str::Chars;

/// A value of the object.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Value {
    Number(f64),
    Text(String),
    Flag(bool),
    Null,
}

/// Reads one object. The error names the place, counted in characters from 1.
pub(super) fn parse(line: &str) -> Result<BTreeMap<String, Value>, String> {
    let mut reader = Reader { rest: line.chars().peekable(), read: 0 };
    let object = reader.object().and_then(|object| reader.end().map(|()| object));
    object.map_err(|expected| format!("character {}: expected {expected}", reader.read + 1))
}

/// `text` as a JSON string, with its quotes.
pub(super) fn quoted(text: &str) -> String {
    let mut out = String::from('"');
    for c in text.chars() {
        match c {
            '"' | '\\' => out.extend(['\\', c]),
            c if c.is_control() => out.push_str(&format!("\\u{:04x}", u32::from(c))),
            c => out.push(c),
        }
    }
    out.push('"');
    out
}

/// The text that is left, and how many characters were read. Errors say what was expected.
struct Reader<'a> {
    rest: Peekable<Chars<'a>>,
    read: usize,
}

impl Reader<'_> {
    fn object(&mut self) -> Result<BTreeMap<String, Value>, String> {
        let mut object = BTreeMap::new();
        self.expect('{')?;
        if self.skips('}') {
            return Ok(object);
        }
        loop {
            self.expect('"')?;
            let key = self.text()?;
            self.expect(':')?;
            object.insert(key, self.value()?);
            if !self.skips(',') {
                self.expect('}')?;
                return Ok(object);
            }
        }
    }

    fn value(&mut self) -> Result<Value, String> {
        if self.skips('"') {
            return self.text().map(Value::Text);
        }
        let mut word = String::new();
        while let Some(c) = self.rest.next_if(|c| c.is_ascii_alphanumeric() || "+-.".contains(*c)) {
            self.read += 1;
            word.push(c);
        }
        match word.as_str() {
            "true" => Ok(Value::Flag(true)),
            "false" => Ok(Value::Flag(false)),
            "null" => Ok(Value::Null),
            // `parse` takes `inf` and `NaN`, which JSON does not have.
            _ => match word.parse::<f64>() {
                Ok(number) if number.is_finite() => Ok(Value::Number(number)),
                _ => Err(format!("a number, text, true, false or null before this, found `{word}`")),
            },
        }
    }

    /// The rest of a string after its first quote.
    fn text(&mut self) -> Result<String, String> {
        let mut text = String::new();
        loop {
            match self.next()? {
                '"' => return Ok(text),
                '\\' => text.push(self.escaped()?),
                c => text.push(c),
            }
        }
    }

    fn escaped(&mut self) -> Result<char, String> {
        match self.next()? {
            'n' => Ok('\n'),
            't' => Ok('\t'),
            'r' => Ok('\r'),
            'u' => {
                let mut code = 0;
                for _ in 0..4 {
                    code = code * 16 + self.next()?.to_digit(16).ok_or("a hexadecimal digit before this")?;
                }
                // Half of a pair stands for a character we do not need to know.
                Ok(char::from_u32(code).unwrap_or(char::REPLACEMENT_CHARACTER))
            }
            c => Ok(c),
        }
    }

    fn end(&mut self) -> Result<(), String> {
        self.skip_blanks();
        if self.rest.peek().is_none() { Ok(()) } else { Err("nothing after the object".to_owned()) }
    }

    fn expect(&mut self, wanted: char) -> Result<(), String> {
        if self.skips(wanted) { Ok(()) } else { Err(format!("`{wanted}`")) }
    }

    /// Whether `wanted` comes next, blanks apart; if so it is read.
    fn skips(&mut self, wanted: char) -> bool {
        self.skip_blanks();
        let found = self.rest.next_if_eq(&wanted).is_some();
        self.read += usize::from(found);
        found
    }

    fn skip_blanks(&mut self) {
        while self.rest.next_if(|c| c.is_ascii_whitespace()).is_some() {
            self.read += 1;
        }
    }

    fn next(&mut self) -> Result<char, String> {
        let c = self.rest.next().ok_or("more text")?;
        self.read += 1;
        Ok(c)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_texts_flags_and_nothing_are_read() {
        let object = parse(r#" {"a": -1.5e-3, "b": "x \"y\"A", "c": true, "d": null} "#).unwrap();
        assert_eq!(object["a"], Value::Number(-0.0015));
        assert_eq!(object["b"], Value::Text("x \"y\"A".to_owned()));
        assert_eq!((&object["c"], &object["d"]), (&Value::Flag(true), &Value::Null));
        assert!(parse("{}").unwrap().is_empty());
    }

    #[test]
    fn what_is_quoted_reads_back() {
        let text = "a \"quoted\" back\\slash,\nnew line and µ";
        let line = format!("{{{}: {}}}", quoted("key"), quoted(text));
        assert_eq!(parse(&line).unwrap()["key"], Value::Text(text.to_owned()));
    }

    #[test]
    fn anything_else_is_refused_with_its_place() {
        assert_eq!(parse(r#"{"a" 1}"#).unwrap_err(), "character 6: expected `:`");
        for wrong in ["", "{", r#"{"a": NaN}"#, r#"{"a": [1]}"#, r#"{"a": {"b": 1}}"#, r#"{"a": 1,}"#, "{} x", r#"{"a"#]
        {
            assert!(parse(wrong).is_err(), "{wrong}");
        }
    }
}

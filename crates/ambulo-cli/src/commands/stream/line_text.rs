//! The text of a line from any program: byte order marks, UTF-16, words for not-a-number.

use std::borrow::Cow;

/// The byte order marks at the beginning of UTF-8 and UTF-16.
const MARKS: [&[u8]; 3] = [b"\xef\xbb\xbf", b"\xff\xfe", b"\xfe\xff"];

/// A line as UTF-8 without a byte order mark. A line of UTF-16, as pipes of PowerShell write it, has the two bytes of
/// its end cut apart, so it is recognised by the zeros between its letters; text of UTF-8 has no zeros.
#[must_use]
pub fn text(line: &[u8]) -> Cow<'_, [u8]> {
    let marked = MARKS.iter().find_map(|mark| line.strip_prefix(*mark)).unwrap_or(line);
    match is_wide(line) {
        true => marked
            .iter()
            .filter(|byte| **byte != 0)
            .map(|byte| char::from(*byte))
            .collect::<String>()
            .into_bytes()
            .into(),
        false => marked.into(),
    }
}

/// Whether a line is of UTF-16.
#[must_use]
pub fn is_wide(line: &[u8]) -> bool {
    MARKS[1..].iter().any(|mark| line.starts_with(mark)) || line.contains(&0)
}

/// A line with `null` for every number that is not one: `NaN`, as Python writes it, `nan` and `-nan`, as C does.
#[must_use]
pub fn without_nan(line: &[u8]) -> Cow<'_, [u8]> {
    let is_nan = |word: &[u8]| {
        let word = word.strip_prefix(b"-").unwrap_or(word);
        word.eq_ignore_ascii_case(b"nan") || word.eq_ignore_ascii_case(b"nan(ind)")
    };
    let (mut out, mut in_text, mut from) = (Vec::new(), false, 0);
    for (place, byte) in line.iter().enumerate() {
        match byte {
            b'"' if place == 0 || line[place - 1] != b'\\' => in_text = !in_text,
            b',' | b'[' | b']' | b':' | b'}' if !in_text => {
                let word = &line[from..place];
                out.extend_from_slice(if is_nan(word.trim_ascii()) { b"null" } else { word });
                out.push(*byte);
                from = place + 1;
            }
            _ => {}
        }
    }
    out.extend_from_slice(&line[from..]);
    out.into()
}

/// Whether a message is the first line of a request of HTTP. Every page in a browser can send one to this computer.
#[must_use]
pub fn is_http(message: &[u8]) -> bool {
    const METHODS: [&[u8]; 9] =
        [b"GET ", b"POST ", b"PUT ", b"HEAD ", b"OPTIONS ", b"DELETE ", b"PATCH ", b"CONNECT ", b"TRACE "];
    METHODS.iter().any(|method| message.starts_with(method)) || message.starts_with(b"PRI * HTTP/")
}

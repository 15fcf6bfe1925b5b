//! Access to XML documents for the readers, with errors that name line and element.

use crate::content;
use crate::error::{Error, quoted};
use crate::plain_text::decode;
use memchr::memchr;
use roxmltree::{Document, Node, ParsingOptions};

/// Largest number of nodes that is read; a full-body model has some 10,000. The limit bounds memory on
/// hostile input.
const NODE_LIMIT: u32 = 1_000_000;

/// Parses a document. Document type definitions are rejected, and with them entity bombs.
pub(crate) fn parse(text: &str) -> Result<Document<'_>, Error> {
    parse_up_to(text, NODE_LIMIT)
}

/// Parses a document of at most `nodes` nodes.
pub(crate) fn parse_up_to(text: &str, nodes: u32) -> Result<Document<'_>, Error> {
    parse_text(text, nodes).map_err(|error| error.or_other_content(text.as_bytes(), content::XML))
}

fn parse_text(text: &str, nodes: u32) -> Result<Document<'_>, Error> {
    if !text.trim_start().starts_with('<') {
        let found = quoted(text.trim_start().lines().next().unwrap_or_default());
        return Err(Error::Line { line: 1, found, expected: "an XML document, which begins with `<`".into() });
    }
    // The parser allocates memory by these counts before it checks its limit.
    for (mark, most) in [(b'<', 2 * nodes as usize), (b'=', nodes as usize)] {
        let found = if text.len() > most { count(text.as_bytes(), mark) } else { 0 };
        if found > most {
            let reason = format!("{found} times `{}`; expected at most {most}", char::from(mark));
            return Err(Error::Xml { reason });
        }
    }
    if may_have_many_attributes(text) {
        refuse_many_attributes(text)?;
    }
    let options = ParsingOptions { allow_dtd: false, nodes_limit: nodes, ..ParsingOptions::default() };
    Document::parse_with_options(text, options).map_err(|e| Error::Xml { reason: e.to_string() })
}

/// Largest number of attributes of an element. The parser compares each with all others.
const MAX_ATTRIBUTES: usize = 1000;

/// Whether an element may have very many attributes: `<` never occurs inside an element, so no part between two of them
/// has fewer bytes than its element has attributes.
fn may_have_many_attributes(text: &str) -> bool {
    let is_many = |part: &str| part.len() > MAX_ATTRIBUTES && count(part.as_bytes(), b'=') > MAX_ATTRIBUTES;
    let mut rest = text;
    while let Some(length) = memchr(b'<', rest.as_bytes()) {
        if is_many(&rest[..length]) {
            return true;
        }
        rest = &rest[length + 1..];
    }
    is_many(rest)
}

/// Refuses an element with very many attributes, in one pass: comments, sections of text and instructions are left out.
fn refuse_many_attributes(text: &str) -> Result<(), Error> {
    const OTHERS: [(&str, &str); 3] = [("<!--", "-->"), ("<![CDATA[", "]]>"), ("<?", "?>")];
    let mut rest = text;
    while let Some(start) = rest.find('<') {
        rest = &rest[start..];
        if let Some((begin, end)) = OTHERS.iter().find(|(begin, _)| rest.starts_with(begin)) {
            let after = &rest[begin.len()..];
            rest = after.find(end).map_or("", |at| &after[at + end.len()..]);
            continue;
        }
        let (mut quote, mut attributes, mut length) = (None, 0, rest.len());
        for (at, byte) in rest.bytes().enumerate() {
            match (byte, quote) {
                (b'"' | b'\'', None) => quote = Some(byte),
                (byte, Some(open)) if byte == open => quote = None,
                (b'=', None) => attributes += 1,
                (b'>', None) => {
                    length = at;
                    break;
                }
                _ => {}
            }
        }
        if attributes > MAX_ATTRIBUTES {
            let reason = format!("an element with {attributes} attributes; expected at most {MAX_ATTRIBUTES}");
            return Err(Error::Xml { reason });
        }
        rest = &rest[length..];
    }
    Ok(())
}

/// How often a byte occurs. Short sums of single bytes are computed side by side.
fn count(bytes: &[u8], byte: u8) -> usize {
    let in_chunk = |chunk: &[u8]| usize::from(chunk.iter().map(|b| u8::from(*b == byte)).sum::<u8>());
    bytes.chunks(usize::from(u8::MAX)).map(in_chunk).sum()
}

/// The text of a document: UTF-16 if it begins with its byte-order mark, otherwise as [`decode`].
pub(crate) fn document_text(bytes: &[u8]) -> String {
    let utf16 = |bytes: &[u8], unit: fn([u8; 2]) -> u16| {
        let units: Vec<u16> = bytes.chunks_exact(2).map(|pair| unit([pair[0], pair[1]])).collect();
        String::from_utf16_lossy(&units)
    };
    match bytes {
        [0xff, 0xfe, rest @ ..] => utf16(rest, u16::from_le_bytes),
        [0xfe, 0xff, rest @ ..] => utf16(rest, u16::from_be_bytes),
        _ => decode(bytes),
    }
}

/// First child element with this tag.
pub(crate) fn child<'a, 'i>(node: Node<'a, 'i>, tag: &str) -> Option<Node<'a, 'i>> {
    node.children().find(|c| c.has_tag_name(tag))
}

/// Child elements, without comments and text.
pub(crate) fn elements<'a, 'i>(node: Node<'a, 'i>) -> impl Iterator<Item = Node<'a, 'i>> {
    node.children().filter(Node::is_element)
}

/// Trimmed text of the child with this tag; `None` if the child is missing or empty.
pub(crate) fn text<'a>(node: Node<'a, '_>, tag: &str) -> Option<&'a str> {
    child(node, tag).and_then(|c| c.text()).map(str::trim).filter(|t| !t.is_empty())
}

/// Line of the element's opening tag, counted from 1.
pub(crate) fn line_of(node: Node<'_, '_>) -> usize {
    1 + count(&node.document().input_text().as_bytes()[..node.range().start], b'\n')
}

/// Lines of elements of one document, counted from 1. For elements in the order of the document each byte is counted
/// once.
pub(crate) struct LineCounter<'d> {
    text: &'d [u8],
    at: usize,
    line: usize,
}

impl<'d> LineCounter<'d> {
    pub(crate) fn new(text: &'d str) -> LineCounter<'d> {
        LineCounter { text: text.as_bytes(), at: 0, line: 1 }
    }

    /// Line of the element's opening tag.
    pub(crate) fn line_of(&mut self, node: Node<'_, '_>) -> usize {
        let start = node.range().start;
        if start < self.at {
            (self.at, self.line) = (0, 1);
        }
        self.line += count(&self.text[self.at..start], b'\n');
        self.at = start;
        self.line
    }
}

/// An error at this element.
pub(crate) fn error_at(node: Node<'_, '_>, found: String, expected: impl Into<String>) -> Error {
    let name = node.attribute("name").map(|n| format!(" name=\"{n}\"")).unwrap_or_default();
    Error::Element {
        line: line_of(node),
        element: format!("{}{name}", node.tag_name().name()),
        found,
        expected: expected.into(),
    }
}

/// The finite numbers in this element's text.
pub(crate) fn numbers_of(node: Node<'_, '_>) -> Result<Vec<f64>, Error> {
    node.text()
        .unwrap_or_default()
        .split_whitespace()
        .map(|word| match word.parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value),
            _ => Err(error_at(node, quoted(word), "finite numbers separated by spaces, with a point as decimal mark")),
        })
        .collect()
}

/// The numbers of the child with this tag, `None` if it is missing.
pub(crate) fn numbers(node: Node<'_, '_>, tag: &str) -> Result<Option<Vec<f64>>, Error> {
    child(node, tag).map(numbers_of).transpose()
}

/// One number of the child with this tag, `None` if it is missing or empty.
pub(crate) fn number(node: Node<'_, '_>, tag: &str) -> Result<Option<f64>, Error> {
    let Some(values) = numbers(node, tag)? else { return Ok(None) };
    match values[..] {
        [] => Ok(None),
        [value] => Ok(Some(value)),
        _ => Err(error_at(child(node, tag).unwrap_or(node), format!("{} numbers", values.len()), "one number")),
    }
}

/// Three numbers of the child with this tag, `None` if it is missing or empty.
pub(crate) fn triple(node: Node<'_, '_>, tag: &str) -> Result<Option<[f64; 3]>, Error> {
    let Some(values) = numbers(node, tag)? else { return Ok(None) };
    match values[..] {
        [] => Ok(None),
        [x, y, z] => Ok(Some([x, y, z])),
        _ => Err(error_at(child(node, tag).unwrap_or(node), format!("{} numbers", values.len()), "three numbers")),
    }
}

/// `true` or `false` of the child with this tag, `None` if it is missing or empty.
pub(crate) fn boolean(node: Node<'_, '_>, tag: &str) -> Result<Option<bool>, Error> {
    match text(node, tag) {
        None => Ok(None),
        Some(t) if t.eq_ignore_ascii_case("true") || t == "1" => Ok(Some(true)),
        Some(t) if t.eq_ignore_ascii_case("false") || t == "0" => Ok(Some(false)),
        Some(t) => Err(error_at(child(node, tag).unwrap_or(node), quoted(t), "`true` or `false`")),
    }
}

/// Text escaped for XML: the five special characters as entities, control characters removed.
pub(crate) fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&apos;"),
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => {}
            c => out.push(c),
        }
    }
    out
}

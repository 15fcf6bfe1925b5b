//! Writes HTML documents and tables, and escapes text in them.

use ambulo::study::validation::Section;
use std::fmt::Write;

/// An HTML document that needs no network.
pub(super) struct Document<'a> {
    /// Plain text.
    pub(super) title: &'a str,
    /// Content-Security-Policy.
    pub(super) policy: &'a str,
    /// CSS.
    pub(super) style: &'a str,
    /// HTML.
    pub(super) body: &'a str,
}

impl Document<'_> {
    /// The text of the file.
    pub(super) fn html(&self) -> String {
        let Document { policy, style, body, .. } = self;
        let title = escaped(self.title);
        format!(
            r#"<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="{policy}">
<title>{title} - Ambulo</title>
<style>{style}</style>
</head>
<body>
{body}
</body>
</html>
"#
        )
    }
}

/// Escapes text for content and for attributes in double quotes.
#[must_use]
pub fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            other => escaped.push(other),
        }
    }
    escaped
}

/// Text whose back quotes are code.
pub(super) fn code(text: &str) -> String {
    let parts = text.split('`').enumerate();
    parts.map(|(k, part)| if k % 2 == 1 { format!("<code>{}</code>", escaped(part)) } else { escaped(part) }).collect()
}

/// A table with its note; columns of numbers are set to the right.
pub(super) fn html_table(section: &Section) -> String {
    let Section { table, note, .. } = section;
    let is_number =
        |cell: &str| cell == "-" || cell.trim_start_matches(['+', '-']).starts_with(|c: char| c.is_ascii_digit());
    let numeric: Vec<bool> = (0..table.head().len())
        .map(|column| {
            let filled = || table.rows().iter().map(|row| row[column].as_str()).filter(|cell| !cell.is_empty());
            column > 0 && filled().next().is_some() && filled().all(is_number)
        })
        .collect();
    let class = |column: usize| if numeric[column] { " class=\"number\"" } else { "" };
    let mut html = String::from("<div class=\"scroll\"><table>\n<thead><tr>");
    for (column, name) in table.head().iter().enumerate() {
        let _ = write!(html, "<th scope=\"col\"{}>{}</th>", class(column), escaped(name));
    }
    html += "</tr></thead>\n<tbody>\n";
    for row in table.rows() {
        html += "<tr>";
        for (column, cell) in row.iter().enumerate() {
            let tag = if column == 0 { "th scope=\"row\"" } else { "td" };
            let end = if column == 0 { "th" } else { "td" };
            let _ = write!(html, "<{tag}{}>{}</{end}>", class(column), code(cell));
        }
        html += "</tr>\n";
    }
    html += "</tbody></table></div>\n";
    if !note.is_empty() {
        let _ = writeln!(html, "<p class=\"soft\">{}</p>", code(note));
    }
    html
}

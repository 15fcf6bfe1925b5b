//! Writes HTML documents and escapes text in them.

/// An HTML document that loads nothing from any network.
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
pub(super) fn escaped(text: &str) -> String {
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

#[cfg(test)]
mod tests {
    use super::escaped;

    #[test]
    fn no_text_becomes_markup() {
        assert_eq!(escaped(r#"<script>"a" & b</script>"#), "&lt;script&gt;&quot;a&quot; &amp; b&lt;/script&gt;");
    }
}

//! Rust source as tokens, without comments. Enough to count lines, find functions and follow paths; not a parser.

/// What a token is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    /// A name, a keyword or a number.
    Word,
    /// One sign, or `::`.
    Sign,
    /// A text, a character or a lifetime.
    Literal,
}

/// One token with the lines that it covers, from 1.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Token<'t> {
    pub(crate) kind: Kind,
    pub(crate) text: &'t str,
    pub(crate) line: usize,
    pub(crate) last_line: usize,
}

impl Token<'_> {
    /// Whether the token is this name, keyword or sign.
    pub(crate) fn is(&self, text: &str) -> bool {
        self.kind != Kind::Literal && self.text == text
    }
}

/// The tokens of a file.
pub(crate) fn tokens(source: &str) -> Vec<Token<'_>> {
    let (mut list, mut rest, mut line) = (Vec::new(), source, 1);
    while let Some(first) = rest.chars().next() {
        let (kind, length) = token(rest, first);
        let (text, after) = rest.split_at(length);
        let last_line = line + text.matches('\n').count();
        if let Some(kind) = kind {
            list.push(Token { kind, text, line, last_line });
        }
        (rest, line) = (after, last_line);
    }
    list
}

/// Kind (none: blank or comment) and bytes of the token that the text begins with.
fn token(rest: &str, first: char) -> (Option<Kind>, usize) {
    if first.is_whitespace() {
        return (None, first.len_utf8());
    }
    if let Some(length) = raw_text(rest) {
        return (Some(Kind::Literal), length);
    }
    if is_word(first) {
        return (Some(Kind::Word), rest.find(|c| !is_word(c)).unwrap_or(rest.len()));
    }
    match rest.as_bytes() {
        [b'/', b'/', ..] => (None, rest.find('\n').unwrap_or(rest.len())),
        [b'/', b'*', ..] => (None, block_comment(rest)),
        [b'"', ..] => (Some(Kind::Literal), quoted(rest, '"')),
        [b'\'', ..] => (Some(Kind::Literal), character(rest)),
        [b':', b':', ..] => (Some(Kind::Sign), 2),
        _ => (Some(Kind::Sign), first.len_utf8()),
    }
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// Bytes of a raw or byte text (`r"..."`, `r#"..."#`, `b"..."`, `br"..."`), if one begins here.
fn raw_text(rest: &str) -> Option<usize> {
    let after = rest.strip_prefix("br").or_else(|| rest.strip_prefix('r')).or_else(|| rest.strip_prefix('b'))?;
    let prefix = rest.len() - after.len();
    if rest[..prefix].ends_with('b') {
        return after.starts_with('"').then(|| prefix + quoted(after, '"'));
    }
    let opened = after.trim_start_matches('#').strip_prefix('"')?;
    let closing = format!("\"{}", "#".repeat(after.len() - opened.len() - 1));
    let closed = opened.find(&closing).map_or(opened.len(), |at| at + closing.len());
    Some(rest.len() - opened.len() + closed)
}

/// Bytes of a text in quotes; a backslash takes the next character with it.
fn quoted(rest: &str, quote: char) -> usize {
    let mut characters = rest.char_indices().skip(1);
    while let Some((at, c)) = characters.next() {
        if c == '\\' {
            characters.next();
        } else if c == quote {
            return at + 1;
        }
    }
    rest.len()
}

/// Bytes of a character such as `'x'`, or of a lifetime such as `'a`.
fn character(rest: &str) -> usize {
    let inside = rest.chars().nth(1).map_or(0, char::len_utf8);
    if rest[1..].starts_with('\\') || rest[1 + inside..].starts_with('\'') {
        return quoted(rest, '\'');
    }
    1 + rest[1..].find(|c| !is_word(c)).unwrap_or(rest.len() - 1)
}

/// Bytes of a block comment; these may be nested.
fn block_comment(rest: &str) -> usize {
    let (mut at, mut depth) = (2, 1);
    while depth > 0 {
        let Some(next) = rest[at..].find(['/', '*']) else { return rest.len() };
        at += next;
        match &rest.as_bytes()[at..] {
            [b'/', b'*', ..] => (at, depth) = (at + 2, depth + 1),
            [b'*', b'/', ..] => (at, depth) = (at + 2, depth - 1),
            _ => at += 1,
        }
    }
    at
}

/// Index of the bracket that closes the one at `open`; the last token if none does.
pub(crate) fn closing(tokens: &[Token<'_>], open: usize) -> usize {
    let mut depth = 0_usize;
    for (i, token) in tokens.iter().enumerate().skip(open).filter(|(_, token)| token.kind == Kind::Sign) {
        match token.text {
            "(" | "[" | "{" => depth += 1,
            ")" | "]" | "}" => depth = depth.saturating_sub(1),
            _ => {}
        }
        if depth == 0 {
            return i;
        }
    }
    tokens.len().saturating_sub(1)
}

/// Index of the `{` or `;` that ends the head of the item at `from`.
pub(crate) fn head_end(tokens: &[Token<'_>], from: usize) -> usize {
    let mut i = from;
    while i < tokens.len() && !tokens[i].is("{") && !tokens[i].is(";") {
        let is_bracket = tokens[i].is("(") || tokens[i].is("[");
        i = if is_bracket { closing(tokens, i) + 1 } else { i + 1 };
    }
    i
}

/// The tokens without items marked `#[cfg(test)]`.
pub(crate) fn without_tests<'t>(tokens: &[Token<'t>]) -> Vec<Token<'t>> {
    const MARK: [&str; 7] = ["#", "[", "cfg", "(", "test", ")", "]"];
    let (mut kept, mut i) = (Vec::with_capacity(tokens.len()), 0);
    while i < tokens.len() {
        let window = &tokens[i..tokens.len().min(i + MARK.len())];
        if window.len() == MARK.len() && window.iter().zip(MARK).all(|(token, word)| token.is(word)) {
            let end = head_end(tokens, i + MARK.len());
            i = if tokens.get(end).is_some_and(|token| token.is("{")) { closing(tokens, end) + 1 } else { end + 1 };
        } else {
            kept.push(tokens[i]);
            i += 1;
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_vanish_and_texts_stay_whole() {
        let source = "fn f<'a>() { // no { here\n let s = r#\"} \" }\"#; /* { /* } */ */ let c = '}'; b\"}\"; '\\'' }";
        let texts: Vec<&str> = tokens(source).iter().map(|token| token.text).collect();
        let expected = [
            "fn",
            "f",
            "<",
            "'a",
            ">",
            "(",
            ")",
            "{",
            "let",
            "s",
            "=",
            "r#\"} \" }\"#",
            ";",
            "let",
            "c",
            "=",
            "'}'",
            ";",
            "b\"}\"",
            ";",
            "'\\''",
            "}",
        ];
        assert_eq!(texts, expected);
    }

    #[test]
    fn items_for_tests_are_left_out() {
        let source = "fn a() {}\n#[cfg(test)]\nmod tests { fn b() {} }\n#[cfg(test)] use x::{y};\nfn c() {}";
        let kept = without_tests(&tokens(source));
        let text: String = kept.iter().map(|token| token.text).collect();
        // A `use` with braces ends at its brace; the `;` that remains does no harm.
        assert_eq!(text, "fna(){};fnc(){}");
        assert_eq!(kept.last().map(|token| token.line), Some(5));
    }
}

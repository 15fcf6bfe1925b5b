//! Lines over 120 columns in all Rust source: how many there are, and `cargo xtask house --wrap`, which breaks them.
//!
//! rustfmt breaks code, but neither comments nor texts. Here comments are wrapped as Markdown: lists keep their indent,
//! and code, tables, headings and equations stay. A long text is broken with a backslash at the end of the line, which
//! does not change its value. A comment behind code moves above it. Texts with line breaks of their own and raw texts
//! stay.

use super::tokens::{Kind, Token, tokens};

/// Most columns of a line, as in rustfmt.toml.
pub(super) const MOST_COLUMNS: usize = 120;
/// Columns from which a text is broken rather than the code before it.
const LONG_TEXT: usize = 50;
/// Most columns of the code behind a text that is broken because of them, such as `.into();`.
const LONGEST_END: usize = 8;

/// Numbers of the lines that are too long, from 1. These may be: tables, equations and code in comments, comments
/// without a blank to break at, and texts that have line breaks of their own, such as pages and files of tests.
pub(super) fn long_lines(source: &str) -> Vec<usize> {
    let tokens = tokens(source);
    let whole: Vec<&Token<'_>> = tokens.iter().filter(|token| is_raw(token) || has_own_breaks(token)).collect();
    let is_whole = |number: usize| whole.iter().any(|token| token.line <= number && number <= token.last_line);
    let within = lines_in_texts(source, &tokens);
    let lines = source.lines().zip(&within).enumerate().map(|(i, (line, within))| (i + 1, line, *within));
    let is_code = |line: &str, within: bool| within || Comment::of(line).is_none();
    let long = lines
        .filter(|(number, line, within)| columns(line) > MOST_COLUMNS && is_code(line, *within) && !is_whole(*number));
    let mut numbers: Vec<usize> = long.map(|(number, _, _)| number).chain(Paragraphs::of(source).broken).collect();
    numbers.sort_unstable();
    numbers.dedup();
    numbers
}

/// The source with long lines broken. An error if that would change more than the layout.
pub(super) fn wrapped(source: &str) -> Result<String, String> {
    let mut text = source.to_owned();
    // A text that is broken once may still be too long; a comment that has moved may be, too.
    for _ in 0..8 {
        let once = with_broken_texts(&with_broken_code(&with_wrapped_comments(&with_comments_above(&text))));
        if once == text {
            break;
        }
        text = once;
    }
    if values(source) == values(&text) { Ok(text) } else { Err("wrapping would change the code".to_owned()) }
}

/// The tokens of a source with the value of its texts, so that sources of the same meaning are equal.
fn values(source: &str) -> Vec<String> {
    let value = |token: &Token<'_>| {
        if is_raw(token) || !token.text.ends_with('"') {
            return token.text.to_owned();
        }
        let mut parts = token.text.split("\\\n");
        let first = parts.next().unwrap_or_default().to_owned();
        parts.fold(first, |value, part| value + part.trim_start())
    };
    tokens(source).iter().map(value).collect()
}

fn columns(line: &str) -> usize {
    line.chars().count()
}

fn is_raw(token: &Token<'_>) -> bool {
    token.kind == Kind::Literal && (token.text.starts_with('r') || token.text.starts_with("br"))
}

/// For each line, whether it begins inside a text.
fn lines_in_texts(source: &str, tokens: &[Token<'_>]) -> Vec<bool> {
    let mut within = vec![false; source.lines().count()];
    for token in tokens.iter().filter(|token| token.last_line > token.line) {
        within[token.line..token.last_line].fill(true);
    }
    within
}

/// Byte at which a token of the source begins.
fn start(source: &str, token: &Token<'_>) -> usize {
    token.text.as_ptr() as usize - source.as_ptr() as usize
}

/// Long lines of code with a comment behind it: the comment moves above the code.
fn with_comments_above(source: &str) -> String {
    let tokens = tokens(source);
    let mut text = String::new();
    let mut begin = 0;
    for (i, line) in source.split_inclusive('\n').enumerate() {
        let last = tokens.iter().rev().find(|token| token.last_line == i + 1);
        let behind = last.map(|token| start(source, token) + token.text.len());
        match behind.map(|at| (&source[begin..at], source[at..begin + line.len()].trim())) {
            Some((code, comment)) if columns(line.trim_end()) > MOST_COLUMNS && comment.starts_with("//") => {
                let indent = &code[..code.len() - code.trim_start().len()];
                text += &format!("{indent}{comment}\n{code}\n");
            }
            _ => text += line,
        }
        begin += line.len();
    }
    text
}

/// A line that is only a comment.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Comment<'t> {
    indent: &'t str,
    /// `//`, `///` or `//!`.
    mark: &'t str,
    text: &'t str,
}

impl<'t> Comment<'t> {
    fn of(line: &'t str) -> Option<Comment<'t>> {
        let body = line.trim_start();
        let indent = &line[..line.len() - body.len()];
        let mark = ["///", "//!", "//"].into_iter().find(|mark| body.starts_with(mark))?;
        let text = &body[mark.len()..];
        Some(Comment { indent, mark: &body[..mark.len()], text: text.trim_end() })
    }

    /// Columns that are left for the text.
    fn room(&self) -> usize {
        MOST_COLUMNS - columns(self.indent) - self.mark.len()
    }

    /// The text in two parts, of which the first fits; none if it has no blank to break at.
    fn broken(&self) -> Option<(&'t str, &'t str)> {
        let lead = self.text.len() - self.text.trim_start().len();
        let blanks = self.text.char_indices().enumerate().filter(|(_, (at, c))| *c == ' ' && *at > lead);
        let fitting = blanks.take_while(|(column, _)| *column <= self.room()).map(|(_, (at, _))| at);
        let parts = fitting.map(|at| (&self.text[..at], self.text[at..].trim_start()));
        let usable: Vec<_> = parts.filter(|(_, after)| !begins_item(after)).collect();
        let is_outside_of_code = |(before, _): &&(&str, &str)| before.matches('`').count() % 2 == 0;
        usable.iter().rev().find(is_outside_of_code).or(usable.last()).copied()
    }
}

/// Whether a line with this text would begin an item, a heading, a table or a quotation.
fn begins_item(text: &str) -> bool {
    let word = text.split(' ').next().unwrap_or_default();
    let number = word.strip_suffix(['.', ')']).unwrap_or("-");
    ["-", "*", "+", "="].contains(&word)
        || word.starts_with(['#', '|', '>'])
        || number.bytes().all(|b| b.is_ascii_digit())
}

/// Bytes of the sign of a list that the text begins with, with the blank after it.
fn list_sign(text: &str) -> usize {
    let sign = text.split(' ').next().unwrap_or_default();
    let is_number = sign.strip_suffix('.').is_some_and(|n| !n.is_empty() && n.bytes().all(|b| b.is_ascii_digit()));
    if ["-", "*", "+"].contains(&sign) || is_number { sign.len() + 1 } else { 0 }
}

fn with_wrapped_comments(source: &str) -> String {
    let mut text = Paragraphs::of(source).lines.join("\n");
    if source.ends_with('\n') {
        text.push('\n');
    }
    text
}

/// Comments that are being wrapped.
#[derive(Debug, Default)]
struct Paragraphs {
    lines: Vec<String>,
    /// Number of the line that is being added, from 1, and those that were broken.
    number: usize,
    broken: Vec<usize>,
    /// Indent, mark and words that did not fit into the line before.
    carried: Option<(String, String)>,
    /// Start and blanks of the paragraph's lines.
    open: Option<(String, usize)>,
    is_code: bool,
}

impl Paragraphs {
    fn of(source: &str) -> Paragraphs {
        let within = lines_in_texts(source, &tokens(source));
        let mut paragraphs = Paragraphs::default();
        for (i, (line, within)) in source.lines().zip(within).enumerate() {
            match Comment::of(line).filter(|_| !within) {
                Some(comment) => {
                    paragraphs.number = i + 1;
                    paragraphs.add(comment, line);
                }
                None => {
                    paragraphs.end();
                    paragraphs.lines.push(line.to_owned());
                }
            }
        }
        paragraphs.end();
        paragraphs
    }

    fn add(&mut self, comment: Comment<'_>, line: &str) {
        let start = format!("{}{}", comment.indent, comment.mark);
        let body = comment.text.trim_start();
        let lead = comment.text.len() - body.len();
        let sign = list_sign(body);
        let continues = sign == 0 && self.open.as_ref().is_some_and(|open| *open == (start.clone(), lead));
        let is_fence = body.starts_with("```");
        if is_fence || self.is_code || stays(body) || (lead > 1 && sign == 0 && !continues) {
            self.end();
            self.is_code ^= is_fence;
            self.lines.push(line.to_owned());
            return;
        }
        let text = match self.carried.take() {
            Some((_, words)) if continues => format!("{}{words} {body}", " ".repeat(lead)),
            carried => {
                self.carried = carried;
                self.flush();
                comment.text.to_owned()
            }
        };
        self.put(&start, text, lead + sign);
        self.open = Some((start, lead + sign));
    }

    /// Writes a line; what does not fit is carried on.
    fn put(&mut self, start: &str, text: String, hang: usize) {
        let line = format!("{start}{text}");
        let comment = Comment::of(&line).filter(|_| columns(&line) > MOST_COLUMNS);
        match comment.and_then(|comment| comment.broken()) {
            Some((fits, words)) => {
                self.broken.push(self.number);
                self.lines.push(format!("{start}{fits}"));
                self.carried = Some((format!("{start}{}", " ".repeat(hang)), words.to_owned()));
            }
            None => self.lines.push(line),
        }
    }

    /// Writes the words that are carried as lines of their own.
    fn flush(&mut self) {
        while let Some((start, words)) = self.carried.take() {
            let mark = start.trim_end().to_owned();
            let hang = start.len() - mark.len();
            self.put(&mark, format!("{}{words}", " ".repeat(hang)), hang);
        }
    }

    fn end(&mut self) {
        self.flush();
        self.open = None;
        self.is_code &= self.lines.last().is_some_and(|line| Comment::of(line).is_some());
    }
}

/// Whether a line of a comment is no prose: blank, a heading, a row of a table, a link's address, or words in columns.
fn stays(body: &str) -> bool {
    let is_address = body.split_once("]: ").is_some_and(|(_, address)| body.starts_with('[') && !address.contains(' '));
    body.is_empty() || body.starts_with(['|', '#', '<']) || is_address || body.contains("   ")
}

/// Breaks texts that exceed the width, each line once.
fn with_broken_texts(source: &str) -> String {
    let mut text = source.to_owned();
    // From the end, so that the places of the others stay.
    for token in tokens(source).iter().rev().filter(|token| is_breakable(token)) {
        let first = start(source, token);
        let end = first + token.text.len();
        let breaks = source[first..end].match_indices('\n').map(|(at, _)| first + at + 1);
        let ends: Vec<usize> = breaks.chain([end]).collect();
        let begins: Vec<(usize, usize)> = [first].iter().chain(&ends).copied().zip(ends.iter().copied()).collect();
        for (from, to) in begins.into_iter().rev() {
            if let Some((place, indent)) = break_in(source, first, from, to) {
                text.insert_str(place, &format!("\\\n{}", " ".repeat(indent)));
            }
        }
    }
    text
}

fn is_breakable(token: &Token<'_>) -> bool {
    token.kind == Kind::Literal && token.text.ends_with('"') && !is_raw(token) && !has_own_breaks(token)
}

/// Whether a text has line breaks that belong to its value.
fn has_own_breaks(token: &Token<'_>) -> bool {
    token.kind == Kind::Literal && token.text.replace("\\\n", "").contains('\n')
}

/// Where the part `from..to` of a text that begins at `first` is broken, and the indent of the next line; none if its
/// line fits.
fn break_in(source: &str, first: usize, from: usize, to: usize) -> Option<(usize, usize)> {
    let line_start = source[..from].rfind('\n').map_or(0, |at| at + 1);
    let line = source[line_start..].lines().next()?;
    // Only the text that crosses the border is broken, or ends shortly before it.
    if columns(line) <= MOST_COLUMNS || columns(source[line_start..to].trim_end()) <= MOST_COLUMNS - LONGEST_END {
        return None;
    }
    let own_indent = line.len() - line.trim_start().len();
    let indent = match (from == first, from == line_start + own_indent) {
        (true, true) => own_indent + 1,
        (true, false) => own_indent + 4,
        (false, _) => own_indent,
    };
    let opened = from.max(line_start + own_indent) + 1;
    let is_usable = |&(column, c, at): &(usize, char, usize)| {
        let inside = opened < at && at + 1 < to && column + 2 <= MOST_COLUMNS;
        let placeholders = |sign: char| source[from..at.max(from)].matches(sign).count();
        let is_before = source[at..].starts_with([' ', '\n', '"']) || source[at..].starts_with("\\\n");
        matches!(c, ' ' | ',' | '>')
            && inside
            && !is_before
            && (placeholders('{') == placeholders('}') || source[..at].ends_with(", "))
    };
    let ends = line.char_indices().enumerate().map(|(column, (at, c))| (column, c, line_start + at + c.len_utf8()));
    let usable: Vec<_> = ends.filter(is_usable).collect();
    let blank = usable.iter().rev().find(|(_, c, _)| *c == ' ');
    blank.or(usable.last()).map(|(_, _, at)| (*at, indent))
}

/// Breaks code behind a comma: macros, which rustfmt does not format.
fn with_broken_code(source: &str) -> String {
    let tokens = tokens(source);
    let mut text = source.to_owned();
    let mut end = source.len();
    for line in source.split_inclusive('\n').rev() {
        let begin = end - line.len();
        let fits = |at: usize| columns(&source[begin..at]) <= MOST_COLUMNS;
        let inside = |token: &&Token<'_>| begin < start(source, token) && start(source, token) < end && token.is(",");
        let commas = tokens.iter().filter(inside).map(|token| start(source, token) + 1);
        let place = commas.rev().find(|at| fits(*at) && source[*at..].starts_with(' '));
        let is_text = |token: &Token<'_>| {
            let (from, to) = (start(source, token), start(source, token) + token.text.len());
            let crosses = begin <= from && from < end && fits(from) && !fits(to);
            crosses && is_breakable(token) && columns(token.text) >= LONG_TEXT
        };
        let is_code = columns(line.trim_end()) > MOST_COLUMNS && !tokens.iter().any(is_text);
        if let Some(at) = place.filter(|_| is_code) {
            let indent = line.len() - line.trim_start().len() + 4;
            text.replace_range(at..=at, &format!("\n{}", " ".repeat(indent)));
        }
        end = begin;
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A line of words that ends at this column, after a start.
    fn words(start: &str, to: usize) -> String {
        let mut line = start.to_owned();
        while columns(&line) + 5 <= to {
            line += " word";
        }
        line
    }

    #[test]
    fn what_does_not_fit_goes_to_the_next_line_of_the_paragraph() {
        let source = format!("{}\n    /// and more.\n    ///\n    /// Next.\nfn f() {{}}\n", words("    ///", 130));
        let text = wrapped(&source).unwrap();
        assert_eq!(long_lines(&source), [1]);
        assert!(text.contains("word\n    /// word word and more.\n    ///\n    /// Next."), "{text}");
        assert_eq!(long_lines(&text), []);
    }

    #[test]
    fn items_keep_their_indent_and_other_blocks_stay() {
        let item = words("//! - item", 130);
        let table = words("//! | cell", 130);
        let code = words("//! code", 130);
        let equation = words("//!   u =", 130);
        let source = format!("{item}\n//!   goes on.\n//! - next\n{table}\n//! ```text\n{code}\n//! ```\n{equation}\n");
        let text = wrapped(&source).unwrap();
        assert!(text.contains("word\n//!   word word goes on.\n//! - next\n"), "{text}");
        for kept in [&table, &code, &equation] {
            assert!(text.contains(&format!("{kept}\n")), "{text}");
        }
        assert_eq!(long_lines(&text), []);
    }

    #[test]
    fn a_line_never_begins_with_the_sign_of_a_list() {
        let line = format!("{} - after it", words("/// abcde", 119));
        let text = wrapped(&format!("{line}\nfn f() {{}}\n")).unwrap();
        assert!(text.contains("word\n/// word - after it\n"), "{text}");
    }

    #[test]
    fn texts_are_broken_and_keep_their_value() {
        let source = format!("fn f() {{\n    g(1, \"{} {{a: b}}\");\n}}\n", words("text", 150));
        let text = wrapped(&source).unwrap();
        assert!(text.contains("word \\\n        word"), "{text}");
        assert_eq!(long_lines(&text), []);
        let raw = source.replace("g(1, \"", "g(r\"");
        assert_eq!(wrapped(&raw).unwrap(), raw);
    }

    #[test]
    fn code_is_broken_behind_a_comma() {
        let cells = vec!["(1, 2)"; 20].join(", ");
        let text = wrapped(&format!("    m!({cells});\n")).unwrap();
        assert!(text.contains("(1, 2),\n        (1, 2)"), "{text}");
        assert_eq!(long_lines(&text), []);
    }

    #[test]
    fn a_comment_behind_code_moves_above_it() {
        let text = wrapped(&format!("    let a = 1;{}\n", words(" //", 125))).unwrap();
        assert!(text.starts_with("    // word") && text.ends_with("\n    let a = 1;\n"), "{text}");
    }
}

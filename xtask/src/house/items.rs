//! Functions and types of a file, and how often a private function is called.

use super::tokens::{Kind, Token, closing, head_end};

/// One function with a body.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Function {
    pub(super) name: String,
    pub(super) line: usize,
    /// Lines from the signature to the closing brace.
    pub(super) lines: usize,
    pub(super) reach: Reach,
}

/// Who can call a function.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Reach {
    /// A free function without `pub`: its own module and the modules inside.
    PrivateFree,
    /// Methods, and everything with `pub`.
    Other,
}

/// The functions of a file, in order.
pub(super) fn functions(tokens: &[Token<'_>]) -> Vec<Function> {
    let methods = method_blocks(tokens);
    let mut list = Vec::new();
    for (i, token) in tokens.iter().enumerate().filter(|(_, token)| token.is("fn")) {
        let Some(name) = tokens.get(i + 1).filter(|next| next.kind == Kind::Word) else { continue };
        let open = head_end(tokens, i);
        if !tokens.get(open).is_some_and(|sign| sign.is("{")) {
            continue;
        }
        let lines = tokens[closing(tokens, open)].last_line - token.line + 1;
        let is_method = methods.iter().any(|&(from, to)| from < i && i < to);
        let reach = if is_method || is_public(tokens, i) { Reach::Other } else { Reach::PrivateFree };
        list.push(Function { name: name.text.to_owned(), line: token.line, lines, reach });
    }
    list
}

/// Token ranges of the bodies of `impl` and `trait`.
fn method_blocks(tokens: &[Token<'_>]) -> Vec<(usize, usize)> {
    let mut blocks = Vec::new();
    for i in 0..tokens.len() {
        let begins_item = i == 0 || ["}", ";", "]", "{", "unsafe"].iter().any(|before| tokens[i - 1].is(before));
        let is_block =
            (tokens[i].is("impl") && begins_item) || (tokens[i].is("trait") && tokens[i + 1].kind == Kind::Word);
        let open = head_end(tokens, i);
        if is_block && open < tokens.len() {
            blocks.push((open, closing(tokens, open)));
        }
    }
    blocks
}

/// Whether `pub` or `pub(...)` is before the keyword at `at`.
fn is_public(tokens: &[Token<'_>], at: usize) -> bool {
    let is_qualifier = |token: &Token<'_>| ["const", "async", "unsafe", "extern"].iter().any(|word| token.is(word));
    let before = tokens[..at].iter().rev().find(|token| !is_qualifier(token));
    before.is_some_and(|token| token.is("pub") || token.is(")"))
}

/// Names of the structs, enums, traits and unions of a file.
pub(super) fn types<'t>(tokens: &[Token<'t>]) -> Vec<&'t str> {
    let is_type = |token: &Token<'_>| ["struct", "enum", "trait", "union"].iter().any(|word| token.is(word));
    tokens.windows(2).filter(|pair| is_type(&pair[0]) && pair[1].kind == Kind::Word).map(|pair| pair[1].text).collect()
}

/// How often a function's name is called or passed on as a value.
pub(super) fn calls(tokens: &[Token<'_>], name: &str) -> usize {
    let is_call = |i: &usize| {
        let before = i.checked_sub(1).map(|before| tokens[before]);
        let after = |sign: &str| tokens.get(i + 1).is_some_and(|token| token.is(sign));
        let follows = |sign: &str| before.is_some_and(|token| token.is(sign));
        if !tokens[*i].is(name) || follows(".") || follows("fn") {
            return false;
        }
        let is_passed = (follows("(") || follows(",") || follows("::")) && (after(")") || after(","));
        after("(") || after("::") || is_passed
    };
    (0..tokens.len()).filter(is_call).count()
}

#[cfg(test)]
mod tests {
    use super::super::tokens::tokens;
    use super::*;

    const SOURCE: &str = "
pub fn shown(x: impl Fn(f64) -> f64) -> f64 {
    once(x(1.0)) + twice() + twice()
}
fn once(x: f64) -> f64 { [x; 3].map(passed)[0] }
fn twice() -> f64
{
    1.0
}
const fn passed(x: f64) -> f64 { x }
struct Body;
impl Body {
    fn method(&self) { self.once() }
}
enum Side { Left }
trait Named { fn name(&self) -> String; }
";

    #[test]
    fn functions_have_lines_and_reach() {
        let list = functions(&tokens(SOURCE));
        let found: Vec<_> = list.iter().map(|f| (f.name.as_str(), f.lines, f.reach)).collect();
        let expected = [
            ("shown", 3, Reach::Other),
            ("once", 1, Reach::PrivateFree),
            ("twice", 4, Reach::PrivateFree),
            ("passed", 1, Reach::PrivateFree),
            ("method", 1, Reach::Other),
        ];
        assert_eq!(found, expected);
    }

    #[test]
    fn calls_are_counted_and_methods_of_the_same_name_are_not() {
        let tokens = tokens(SOURCE);
        assert_eq!(["once", "twice", "passed"].map(|name| calls(&tokens, name)), [1, 2, 1]);
    }

    #[test]
    fn types_are_listed() {
        assert_eq!(types(&tokens(SOURCE)), ["Body", "Side", "Named"]);
    }
}

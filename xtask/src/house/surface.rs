//! Public types and functions, and which of them no other crate names.
//!
//! Public is what a user of a crate can reach: an item with `pub` in public modules, or re-exported from them, and the
//! methods with `pub` of such types. Nothing behind `#[doc(hidden)]` counts, so neither does a module `internals` for
//! tests. An item is named if its identifier occurs in the source of another product crate, in `xtask`, `fuzz` or
//! `examples`, or in Rust code of the documents; tests do not count. Identifiers are compared as words: a method shares
//! its name with all methods of that name.

use super::source::{Crate, File};
use super::tokens::{Kind, Token, closing, head_end, tokens, without_tests};
use std::collections::{BTreeMap, BTreeSet};

/// Largest part of the public functions that no other crate names [%].
pub(super) const MOST_UNNAMED_FUNCTIONS: usize = 10;
/// Largest part of the public types that no other crate names [%]. Those are errors and parts of results, which users
/// read without their names.
pub(super) const MOST_UNNAMED_TYPES: usize = 10;

/// Public items of one kind.
#[derive(Debug, Default, PartialEq, Eq)]
pub(super) struct Public {
    pub(super) count: usize,
    /// Those that no other crate names, with their place.
    pub(super) unnamed: Vec<String>,
}

impl Public {
    /// The part that no other crate names [%].
    pub(super) fn unnamed_percent(&self) -> usize {
        (100 * self.unnamed.len() + self.count / 2) / self.count.max(1)
    }

    /// An error if the part that no other crate names is above the limit.
    pub(super) fn judge(&self, what: &str, most_percent: usize) -> Result<(), String> {
        let unnamed = self.unnamed.len();
        if 100 * unnamed <= most_percent * self.count {
            return Ok(());
        }
        Err(format!(
            "no other crate names {unnamed} of {} public {what} (allowed: {most_percent} %)\n\
             hint: `cargo xtask house --list` names them; make them `pub(crate)`",
            self.count
        ))
    }
}

/// Public types and functions of all crates. `others` is Rust source outside of the crates.
pub(super) fn public(crates: &[Crate], others: &[String]) -> [Public; 2] {
    let all: Vec<Vec<Vec<Token<'_>>>> = crates.iter().map(product_tokens).collect();
    let words: Vec<BTreeSet<&str>> = all.iter().map(|files| words(files.iter().flatten())).collect();
    let others: Vec<Vec<Token<'_>>> = others.iter().map(|text| without_tests(&tokens(text))).collect();
    let words_of_others = self::words(others.iter().flatten());
    let mut found = [Public::default(), Public::default()];
    for (own, (one, files)) in crates.iter().zip(&all).enumerate() {
        let elsewhere = |name: &str| {
            let in_crates = words.iter().enumerate().any(|(i, words)| i != own && words.contains(name));
            in_crates || words_of_others.contains(name)
        };
        for item in public_items(&one.files, files) {
            let public = &mut found[usize::from(item.is_function)];
            public.count += 1;
            if !elsewhere(item.name) {
                let path = &one.files[item.file].path;
                public.unnamed.push(format!("crates/{}/src/{path}:{} {}", one.name, item.line, item.name));
            }
        }
    }
    found
}

fn product_tokens(one: &Crate) -> Vec<Vec<Token<'_>>> {
    one.files.iter().map(|file| without_tests(&tokens(&file.text))).collect()
}

fn words<'a, 't: 'a>(tokens: impl Iterator<Item = &'a Token<'t>>) -> BTreeSet<&'t str> {
    tokens.filter(|token| token.kind == Kind::Word).map(|token| token.text).collect()
}

/// A type, a function or a method with `pub`.
struct Item<'t> {
    name: &'t str,
    is_function: bool,
    /// The type of a method.
    owner: Option<&'t str>,
    file: usize,
    line: usize,
    /// The declaration with what users reach in its body, in one line.
    #[cfg(test)]
    head: String,
}

/// The front door of the library: crates, and modules of a crate, whose public items stay as they are in a version 0.1.
#[cfg(test)]
pub(super) const FRONT_DOOR: [(&str, &[&str]); 3] =
    [("ambulo", &["job", "study"]), ("ambulo-body", &["model", "motion", "dynamics"]), ("ambulo-formats", &[])];

/// Declarations of the public items of [`FRONT_DOOR`], one per line and sorted.
#[cfg(test)]
pub(super) fn front_door(crates: &[Crate]) -> String {
    let mut lines = BTreeSet::new();
    for (name, modules) in FRONT_DOOR {
        let Some(one) = crates.iter().find(|one| one.name == name) else { continue };
        let files = product_tokens(one);
        for item in public_items(&one.files, &files) {
            let module = *one.files[item.file].module().first().unwrap_or(&"");
            if modules.is_empty() || modules.contains(&module) {
                let owner = item.owner.map_or(String::new(), |owner| format!("{owner}::"));
                lines.insert(format!("{name} {module}: {owner}{} = {}\n", item.name, item.head));
            }
        }
    }
    lines.into_iter().collect()
}

/// The items of a crate that its users can reach.
fn public_items<'t>(files: &'t [File], tokens: &[Vec<Token<'t>>]) -> Vec<Item<'t>> {
    let (mut items, mut exported, mut children) = (Vec::new(), BTreeSet::new(), BTreeMap::new());
    for (i, tokens) in tokens.iter().enumerate() {
        let read = read(i, tokens);
        items.extend(read.items);
        exported.extend(read.exported);
        children.insert(files[i].module(), read.children);
    }
    let is_open: Vec<bool> = files
        .iter()
        .map(|file| {
            let path = file.module();
            let is_public = |k: usize| children.get(&path[..k]).is_some_and(|children| children.contains(path[k]));
            (0..path.len()).all(is_public)
        })
        .collect();
    let is_reached = |item: &Item<'t>| is_open[item.file] || exported.contains(item.name);
    let (free, methods): (Vec<_>, Vec<_>) = items.into_iter().partition(|item| item.owner.is_none());
    let free: Vec<Item<'t>> = free.into_iter().filter(is_reached).collect();
    let types: BTreeSet<&str> = free.iter().filter(|item| !item.is_function).map(|item| item.name).collect();
    let methods = methods.into_iter().filter(|method| method.owner.is_some_and(|owner| types.contains(owner)));
    methods.chain(free).collect()
}

/// What a file makes public.
#[derive(Default)]
struct Read<'t> {
    items: Vec<Item<'t>>,
    /// Names that `pub use` exports.
    exported: BTreeSet<&'t str>,
    /// Modules with `pub mod` or `pub use module::*`.
    children: BTreeSet<&'t str>,
}

/// Reads what a file makes public, without what is `#[doc(hidden)]`.
fn read<'t>(file: usize, tokens: &[Token<'t>]) -> Read<'t> {
    let mut read = Read::default();
    let owners = owners(tokens);
    let mut i = 0;
    while i < tokens.len() {
        let at = i;
        i += 1;
        if !tokens[at].is("pub") {
            continue;
        }
        let is_qualifier = |token: &Token<'_>| {
            token.kind == Kind::Literal || ["const", "async", "unsafe", "extern"].iter().any(|word| token.is(word))
        };
        let Some(keyword) = (at + 1..tokens.len()).find(|&k| !is_qualifier(&tokens[k])) else { break };
        let end = head_end(tokens, keyword);
        if is_hidden(tokens, at) {
            let is_module = tokens[keyword].is("mod") && tokens.get(end).is_some_and(|sign| sign.is("{"));
            i = if is_module { closing(tokens, end) } else { keyword };
            continue;
        }
        let Some(name) = tokens.get(keyword + 1) else { break };
        match tokens[keyword].text {
            "use" => read_use(&tokens[keyword + 1..], &mut read),
            "mod" => _ = read.children.insert(name.text),
            word @ ("fn" | "struct" | "enum" | "trait" | "union") => {
                let owner = owners.iter().find(|(from, to, _)| *from < at && at < *to).map(|(_, _, owner)| *owner);
                read.items.push(Item {
                    name: name.text,
                    is_function: word == "fn",
                    owner,
                    file,
                    line: name.line,
                    #[cfg(test)]
                    head: declaration(&tokens[at..end], &members(tokens, word, end)),
                });
            }
            _ => {}
        }
    }
    read
}

/// A head and what users reach in the body, in one line.
#[cfg(test)]
fn declaration(head: &[Token<'_>], members: &[Token<'_>]) -> String {
    let words: Vec<&str> = head.iter().chain(members).map(|token| token.text).collect();
    words.join(" ").replace("- >", "->")
}

/// What users reach in the body at `open`: public fields of a structure, variants of an enum.
#[cfg(test)]
fn members<'t>(tokens: &[Token<'t>], word: &str, open: usize) -> Vec<Token<'t>> {
    if !["struct", "enum"].contains(&word) || !tokens.get(open).is_some_and(|token| token.is("{")) {
        return Vec::new();
    }
    let (mut kept, mut begin, mut depth) = (Vec::new(), open + 1, 0_usize);
    for i in open + 1..=closing(tokens, open) {
        let is_last = i == closing(tokens, open);
        if is_last || depth == 0 && tokens[i].is(",") {
            while tokens[begin..i].first().is_some_and(|token| token.is("#")) {
                begin = closing(tokens, begin + 1) + 1;
            }
            if word == "enum" || tokens[begin].is("pub") && !tokens[begin + 1].is("(") {
                kept.extend(&tokens[begin..(i + 1).min(closing(tokens, open))]);
            }
            begin = i + 1;
        }
        match tokens[i].text {
            "(" | "[" | "{" | "<" => depth += 1,
            ")" | "]" | "}" | ">" => depth = depth.saturating_sub(1),
            _ => {}
        }
    }
    kept
}

/// Takes the names of a re-export that begins after its `use`.
fn read_use<'t>(tokens: &[Token<'t>], read: &mut Read<'t>) {
    let end = tokens.iter().position(|token| token.is(";")).unwrap_or(tokens.len());
    for (i, token) in tokens[..end].iter().enumerate() {
        let follows = |k: usize, sign: &str| tokens.get(i + k).is_some_and(|token| token.is(sign));
        if token.kind == Kind::Word && !follows(1, "::") {
            read.exported.insert(token.text);
        } else if follows(1, "::") && follows(2, "*") {
            read.children.insert(token.text);
        }
    }
}

/// Whether an attribute of the item at `at` is `#[doc(hidden)]`.
fn is_hidden(tokens: &[Token<'_>], at: usize) -> bool {
    let mut end = at;
    while end > 0 && tokens[end - 1].is("]") {
        let Some(open) = (0..end).rev().find(|&k| tokens[k].is("[") && closing(tokens, k) == end - 1) else { break };
        if tokens[open..end].iter().any(|token| token.is("hidden")) {
            return true;
        }
        end = open.saturating_sub(1);
    }
    false
}

/// Token ranges of the bodies of inherent `impl`, with the type.
fn owners<'t>(tokens: &[Token<'t>]) -> Vec<(usize, usize, &'t str)> {
    let mut blocks = Vec::new();
    for i in (0..tokens.len()).filter(|&i| tokens[i].is("impl")) {
        let begins_item = i == 0 || ["}", ";", "]", "{"].iter().any(|before| tokens[i - 1].is(before));
        let open = head_end(tokens, i);
        let mut depth = 0_usize;
        let owner = tokens[i + 1..open.max(i + 1)].iter().find(|token| {
            match token.text {
                "<" => depth += 1,
                ">" => depth = depth.saturating_sub(1),
                _ => return depth == 0 && token.kind == Kind::Word,
            }
            false
        });
        if let Some(owner) = owner.filter(|_| begins_item && open < tokens.len()) {
            blocks.push((open, closing(tokens, open), owner.text));
        }
    }
    blocks
}

#[cfg(test)]
mod tests {
    use super::super::source::rust_code;
    use super::*;

    fn file(path: &str, text: &str) -> File {
        File { path: path.to_owned(), text: text.to_owned() }
    }

    /// With AMBULO_WRITE=1 the record is written. `crates/ambulo-cli/tests/surface.rs` asks for a line of the
    /// CHANGELOG.
    #[test]
    fn the_front_door_of_the_library_is_recorded() {
        let path = crate::workspace::root().join("docs/surface/rust.txt");
        let found = front_door(&super::super::source::crates(&crate::workspace::root()).unwrap());
        if std::env::var_os("AMBULO_WRITE").is_some() {
            std::fs::write(&path, &found).unwrap();
        }
        let recorded = std::fs::read_to_string(&path).unwrap_or_default();
        assert!(found == recorded, "{} is out of date; run this test with AMBULO_WRITE=1", path.display());
    }

    #[test]
    fn another_argument_of_a_public_function_changes_the_front_door() {
        let door = |text: &str| {
            let files = vec![file("lib.rs", "pub mod job;"), file("job/mod.rs", text)];
            front_door(&[Crate { name: "ambulo".to_owned(), files }])
        };
        let before = "pub struct Job { #[serde] pub mass: Option<f64>, own: u8 } impl Job \
            { pub fn run(&self) -> u8 { 1 } } fn own() {} pub fn read(text: &str) {}";
        let expected = "ambulo job: Job = pub struct Job pub mass : Option < f64 > ,\n\
                        ambulo job: Job::run = pub fn run ( & self ) -> u8\n\
                        ambulo job: read = pub fn read ( text : & str )\n";
        assert_eq!(door(before), expected);
        assert_eq!(
            door(&before.replace("{ 1 }", "{ 2 }").replace("own", "mine")),
            expected,
            "bodies and private names do not count"
        );
        for (old, new) in [("&str", "&[u8]"), ("mass", "mass_kg"), ("pub mass", "mass"), ("-> u8", "-> u16")] {
            assert_ne!(door(&before.replace(old, new)), expected);
        }
        assert_ne!(door(&before.replace("pub fn read", "fn read")), expected);
    }

    #[test]
    fn public_is_what_users_reach_and_named_is_what_others_write() {
        let body = Crate {
            name: "body".to_owned(),
            files: vec![
                file(
                    "lib.rs",
                    "pub mod a; mod b; pub use b::{Leg, step}; \
                     #[doc(hidden)] pub mod internals { pub use crate::b::Toe; }",
                ),
                file(
                    "a.rs",
                    "pub struct Arm<T>(T); impl<T: Copy> Arm<T> { pub const fn bend(&self) {} \
                     pub(crate) fn raise(&self) {} #[doc(hidden)] #[must_use] pub fn turn(&self) {} }",
                ),
                file(
                    "b.rs",
                    "pub enum Leg { Left } pub struct Toe; impl Toe { pub fn bend(&self) {} } \
                     pub fn step() {} pub(crate) struct Heel;",
                ),
            ],
        };
        let walk = Crate { name: "walk".to_owned(), files: vec![file("lib.rs", "fn f(leg: Leg) { \"Arm\" } // bend")] };
        let [types, functions] = public(&[body, walk], &[rust_code("step\n```rust\nx.bend()\n```\nArm\n")]);
        assert_eq!((types.count, functions.count), (2, 2));
        assert_eq!(types.unnamed, ["crates/body/src/a.rs:1 Arm"]);
        assert_eq!(functions.unnamed, ["crates/body/src/b.rs:1 step"]);
        assert_eq!(types.unnamed_percent(), 50);
        assert!(types.judge("types", 50).is_ok());
        assert!(
            types
                .judge("types", 49)
                .is_err_and(|message| message.starts_with("no other crate names 1 of 2 public types"))
        );
    }
}

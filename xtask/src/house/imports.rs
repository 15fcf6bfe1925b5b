//! Which file of a crate uses which, and the circles among them.
//!
//! A path is followed to the file that defines its item, through `mod`, `use` and re-exports; so a `pub use` alone
//! makes no edge, and `super::Thing` leads past `mod.rs` to the file of `Thing`. A file that uses what an enclosing
//! module's file defines makes no edge: a module and its parts are read together. A circle is a strongly connected
//! component of more than one file. Not followed: paths made by macros, methods, and globs of enums.

use super::source::File;
use super::tokens::{Kind, Token, closing};
use std::collections::{BTreeMap, BTreeSet};

/// Longest chain of re-exports that is followed.
const LONGEST_CHAIN: usize = 16;

/// A path of names, `crate::spatial::Pose`.
type NamePath<'t> = Vec<&'t str>;

/// What a file defines, brings into its module and uses.
#[derive(Default)]
struct Module<'t> {
    children: BTreeSet<&'t str>,
    definitions: BTreeSet<&'t str>,
    /// Names made by `use`, with the path that each stands for.
    names: BTreeMap<&'t str, NamePath<'t>>,
    globs: Vec<NamePath<'t>>,
    /// Paths in the code, `use` apart.
    paths: BTreeSet<NamePath<'t>>,
}

/// Files that use each other, as indices of the crate's files.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Circle {
    /// Sorted.
    pub(super) files: Vec<usize>,
    /// User, used, and a name that is used, for each pair.
    pub(super) uses: Vec<(usize, usize, String)>,
}

/// The circles among the files of a crate.
pub(super) fn circles<'t>(files: &'t [File], tokens: &[Vec<Token<'t>>]) -> Vec<Circle> {
    let modules: Vec<Module<'t>> = tokens.iter().map(|tokens| read(tokens)).collect();
    let by_path = files.iter().enumerate().map(|(i, file)| (file.module(), i)).collect();
    let graph = Graph { modules, by_path };
    let encloses = |outer: usize, inner: &File| inner.module().starts_with(&files[outer].module());
    let uses = |file: &'t File| {
        let mut used = graph.uses(&file.module());
        used.retain(|&used, _| !encloses(used, file));
        used
    };
    let uses: Vec<BTreeMap<usize, &str>> = files.iter().map(uses).collect();
    let edges: Vec<BTreeSet<usize>> = uses.iter().map(|used| used.keys().copied().collect()).collect();
    let circle = |files: Vec<usize>| {
        let of_file = |&user: &usize| uses[user].iter().map(move |(&used, &name)| (user, used, name.to_owned()));
        let uses = files.iter().flat_map(of_file).filter(|(_, used, _)| files.contains(used)).collect();
        Circle { files, uses }
    };
    strong_components(&edges).into_iter().map(circle).collect()
}

/// All files with their module paths.
struct Graph<'t> {
    modules: Vec<Module<'t>>,
    by_path: BTreeMap<Vec<&'t str>, usize>,
}

impl<'t> Graph<'t> {
    /// The files that the file of a module uses, itself included, each with one name that is used.
    fn uses(&self, module: &[&'t str]) -> BTreeMap<usize, &'t str> {
        let Some(&own) = self.by_path.get(module) else { return BTreeMap::new() };
        let used = |path: &NamePath<'t>| Some((self.file_of(module, path, LONGEST_CHAIN)?, *path.last()?));
        self.modules[own].paths.iter().filter_map(used).collect()
    }

    /// The file that defines the item of a path as seen from a module; none for modules and for other crates.
    fn file_of(&self, module: &[&'t str], path: &[&'t str], chain: usize) -> Option<usize> {
        let chain = chain.checked_sub(1)?;
        let (first, rest) = path.split_first()?;
        match *first {
            "crate" => return self.file_of(&[], rest, chain),
            "self" => return self.file_of(module, rest, chain),
            "super" => return self.file_of(&module[..module.len().checked_sub(1)?], rest, chain),
            _ => {}
        }
        let file = *self.by_path.get(module)?;
        let here = &self.modules[file];
        if here.children.contains(first) {
            let child: Vec<&str> = module.iter().chain([first]).copied().collect();
            return self.file_of(&child, rest, chain);
        }
        if here.definitions.contains(first) {
            return Some(file);
        }
        if let Some(meant) = here.names.get(first) {
            // `use a::a` and `use {a}` of another crate stand for themselves.
            let onward: Vec<&str> = meant.iter().chain(rest).copied().collect();
            return if onward == path { None } else { self.file_of(module, &onward, chain) };
        }
        here.globs.iter().find_map(|glob| {
            let onward: Vec<&str> = glob.iter().chain(path).copied().collect();
            self.file_of(module, &onward, chain)
        })
    }
}

/// Reads one file.
fn read<'t>(tokens: &[Token<'t>]) -> Module<'t> {
    let mut module = Module::default();
    let (mut i, mut depth) = (0, 0_usize);
    while i < tokens.len() {
        let token = tokens[i];
        match token.text {
            "{" if token.kind == Kind::Sign => depth += 1,
            "}" if token.kind == Kind::Sign => depth = depth.saturating_sub(1),
            "use" if token.kind == Kind::Word => {
                let end = use_end(tokens, i);
                read_use(&tokens[i + 1..end], &mut Vec::new(), &mut module);
                i = end;
            }
            _ if token.kind == Kind::Word => {
                if depth == 0 {
                    define(tokens, i, &mut module);
                }
                i = read_path(tokens, i, &mut module);
            }
            _ => {}
        }
        i += 1;
    }
    module
}

/// Index of the `;` of a `use`.
fn use_end(tokens: &[Token<'_>], from: usize) -> usize {
    (from..tokens.len()).find(|&i| tokens[i].is(";")).unwrap_or(tokens.len())
}

/// Takes the definition whose keyword is at `at`, if it is one.
fn define<'t>(tokens: &[Token<'t>], at: usize, module: &mut Module<'t>) {
    const KEYWORDS: [&str; 9] = ["fn", "struct", "enum", "trait", "type", "const", "static", "union", "mod"];
    let Some(name) = tokens.get(at + 1).filter(|next| next.kind == Kind::Word) else { return };
    if tokens[at].text == "mod" && tokens.get(at + 2).is_some_and(|sign| sign.is(";")) {
        module.children.insert(name.text);
    } else if KEYWORDS.contains(&tokens[at].text) {
        module.definitions.insert(name.text);
    }
}

/// Takes the path that begins at `at`, of one name or more, and returns the index of its last token.
fn read_path<'t>(tokens: &[Token<'t>], at: usize, module: &mut Module<'t>) -> usize {
    let mut path = vec![tokens[at].text];
    let mut end = at;
    while tokens.get(end + 1).is_some_and(|sign| sign.is("::")) {
        let Some(next) = tokens.get(end + 2).filter(|next| next.kind == Kind::Word) else { break };
        path.push(next.text);
        end += 2;
    }
    let is_member = at > 0 && tokens[at - 1].is(".");
    let is_visibility = at > 1 && tokens[at - 1].is("(") && tokens[at - 2].is("pub")
        || at > 1 && tokens[at - 1].is("in") && tokens[at - 2].is("(");
    if !is_member && !is_visibility {
        module.paths.insert(path);
    }
    end
}

/// Takes one tree of a `use`: `a::b`, `a::b as c`, `a::*` or `a::{...}`.
fn read_use<'t>(tree: &[Token<'t>], before: &mut NamePath<'t>, module: &mut Module<'t>) {
    let kept = before.len();
    let mut i = 0;
    while i < tree.len() {
        match tree[i].text {
            "::" => {}
            "*" => module.globs.push(before.clone()),
            "as" => {
                if let Some(alias) = tree.get(i + 1) {
                    module.names.insert(alias.text, before.clone());
                }
                before.truncate(kept);
                return;
            }
            "{" => {
                let end = closing(tree, i);
                branches(&tree[i + 1..end]).into_iter().for_each(|branch| read_use(branch, before, module));
                before.truncate(kept);
                return;
            }
            name => before.push(name),
        }
        i += 1;
    }
    if tree.last().is_some_and(|token| token.kind == Kind::Word) {
        if before.last() == Some(&"self") {
            before.pop();
        }
        if let Some(name) = before.last() {
            module.names.insert(name, before.clone());
        }
    }
    before.truncate(kept);
}

/// The parts between commas outside of braces.
fn branches<'a, 't>(tokens: &'a [Token<'t>]) -> Vec<&'a [Token<'t>]> {
    let (mut parts, mut from, mut i) = (Vec::new(), 0, 0);
    while i < tokens.len() {
        if tokens[i].is("{") {
            i = closing(tokens, i);
        } else if tokens[i].is(",") {
            parts.push(&tokens[from..i]);
            from = i + 1;
        }
        i += 1;
    }
    parts.push(&tokens[from..]);
    parts.retain(|part| !part.is_empty());
    parts
}

/// Strongly connected components of more than one node, each sorted.
fn strong_components(edges: &[BTreeSet<usize>]) -> Vec<Vec<usize>> {
    let reach: Vec<BTreeSet<usize>> = (0..edges.len()).map(|node| reachable(edges, node)).collect();
    let mut components: Vec<Vec<usize>> = Vec::new();
    for node in 0..edges.len() {
        let together: Vec<usize> = reach[node].iter().copied().filter(|&other| reach[other].contains(&node)).collect();
        if together.len() > 1 && together.first() == Some(&node) {
            components.push(together);
        }
    }
    components
}

/// Every node that a node leads to.
fn reachable(edges: &[BTreeSet<usize>], from: usize) -> BTreeSet<usize> {
    let (mut seen, mut open) = (BTreeSet::new(), vec![from]);
    while let Some(node) = open.pop() {
        open.extend(edges[node].iter().copied().filter(|&next| seen.insert(next)));
    }
    seen
}

#[cfg(test)]
mod tests {
    use super::super::tokens::{tokens, without_tests};
    use super::*;

    fn circles_of(files: &[(&str, &str)]) -> Vec<Vec<String>> {
        let files: Vec<File> =
            files.iter().map(|&(path, text)| File { path: path.to_owned(), text: text.to_owned() }).collect();
        let tokens: Vec<Vec<Token<'_>>> = files.iter().map(|file| without_tests(&tokens(&file.text))).collect();
        let found = circles(&files, &tokens);
        found.iter().map(|circle| circle.files.iter().map(|&i| files[i].path.clone()).collect()).collect()
    }

    #[test]
    fn files_that_use_each_other_are_a_circle() {
        let found = circles_of(&[
            ("lib.rs", "pub mod a; mod d;"),
            ("a/mod.rs", "mod b; mod c; pub use b::B;"),
            ("a/b.rs", "use super::{c, super::d}; pub struct B; fn g() { c::f(d::h()) }"),
            ("a/c.rs", "use crate::a::B; pub fn f(b: B) {}"),
            ("d.rs", "pub fn h() {}"),
        ]);
        assert_eq!(found, [["a/b.rs", "a/c.rs"]]);
    }

    #[test]
    fn a_part_that_uses_its_enclosing_module_makes_no_circle() {
        let found = circles_of(&[
            ("lib.rs", "pub mod a;"),
            ("a/mod.rs", "mod b; pub struct A; pub fn f() { b::g() }"),
            ("a/b.rs", "use super::A; pub fn g() -> A { A }"),
        ]);
        assert!(found.is_empty(), "{found:?}");
    }

    #[test]
    fn re_exports_and_tests_make_no_circle() {
        let found = circles_of(&[
            ("lib.rs", "pub mod a;"),
            ("a/mod.rs", "mod b; mod c; pub use b::*; pub(crate) use c::C as D;"),
            ("a/b.rs", "use super::D; pub struct B(D);"),
            ("a/c.rs", "pub struct C; #[cfg(test)] mod tests { use super::super::B; fn f(b: B) {} }"),
        ]);
        assert!(found.is_empty(), "{found:?}");
    }
}

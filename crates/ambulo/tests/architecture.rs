//! The tables of ARCHITECTURE.md against the code: which crates and modules there are, and who may use whom.
//!
//! | table                                      | claim                                                                      |
//! |--------------------------------------------|----------------------------------------------------------------------------|
//! | `\| crate \| module \| duty \| may use \|` | these are the modules of the library's crates; within its crate, no module |
//! |                                            | uses another than these, which stand above it                              |
//! | `\| crate \| named only by \|`             | only these modules name this crate                                         |
//! | `\| crate \| duty \|`                      | these are the crates of the workspace                                      |
//!
//! Which crate uses which is in their `Cargo.toml`.
//!
//! Code is read as words: comments and texts are blanked first, then every path that begins with `crate` or climbs to
//! the crate's root with `super` is followed, through braces too. Code inside macros' arguments counts, test code as
//! well. Not handled: paths that a macro glues together.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

const MODULE_TABLE: [&str; 4] = ["crate", "module", "duty", "may use"];
const NAMING_TABLE: [&str; 2] = ["crate", "named only by"];
const CRATE_TABLE: [&str; 2] = ["crate", "duty"];
/// The crates whose modules stand in the module table.
const LIBRARY: [&str; 3] = ["ambulo-body", "ambulo-walk", "ambulo"];

// ---- the claims, each on the real tree ----

#[test]
fn the_code_keeps_to_the_module_table() {
    let found = complaints(&architecture(), &sources());
    assert!(found.is_empty(), "ARCHITECTURE.md and crates/*/src differ:\n{}", found.join("\n"));
}

#[test]
fn the_crate_table_lists_the_crates_of_the_workspace() {
    let found =
        crate_complaints(&architecture(), &crate_folders(), |name| root().join(name).join("Cargo.toml").is_file());
    assert!(found.is_empty(), "ARCHITECTURE.md and crates/ differ:\n{}", found.join("\n"));
}

/// The functions that a user of the library calls first.
const VERBS: [(&str, &str); 8] = [
    ("ambulo/src/study/run.rs", "pub fn run("),
    ("ambulo-body/src/model/import.rs", "pub fn from_osim(bytes"),
    ("ambulo/src/ground/predict/mod.rs", "pub fn predict("),
    ("ambulo/src/ground/stream/mod.rs", "pub fn push("),
    ("ambulo-body/src/kinematics/marker_fit/mod.rs", "pub fn fit_markers("),
    ("ambulo-walk/src/synthetic/modes.rs", "pub fn synthesise("),
    ("ambulo-walk/src/scene/build.rs", "pub fn build("),
    ("ambulo-body/src/dynamics/inverse.rs", "pub fn inverse("),
];

#[test]
fn every_main_function_has_an_example_that_runs() {
    let runs = |comment: &str| comment.lines().any(|line| line.trim() == "/// ```");
    for (file, function) in VERBS {
        let text = fs::read_to_string(root().join("crates").join(file)).unwrap();
        let (before, _) = text.split_once(function).unwrap_or_else(|| panic!("{file}: no `{function}`"));
        let documented = |line: &&str| line.trim().starts_with("///") || line.trim().starts_with("#[");
        let comment: Vec<&str> =
            before.lines().rev().skip_while(|line| line.trim().is_empty()).take_while(documented).collect();
        assert!(runs(&comment.join("\n")), "{file}: `{function}` has no example");
    }
    assert!(!runs("/// ```no_run\n/// let x = 1;\n"), "an example that does not run");
}

// ---- the checker ----

/// One file of a crate.
struct Source {
    crate_name: String,
    module: String,
    /// Path below src/, with `/`.
    file: String,
    text: String,
}

/// One row of the module table.
struct Row {
    crate_name: String,
    module: String,
    may_use: Vec<String>,
}

/// Everything that table and code disagree on, or that the table states against itself.
fn complaints(architecture: &str, sources: &[Source]) -> Vec<String> {
    let rows = match table(architecture, &MODULE_TABLE) {
        Ok(rows) => rows,
        Err(complaint) => return vec![complaint],
    };
    let name = |cell: &String| quoted(cell).join(" ");
    let row =
        |cells: &Vec<String>| Row { crate_name: name(&cells[0]), module: name(&cells[1]), may_use: quoted(&cells[3]) };
    let rows: Vec<Row> = rows.iter().map(row).collect();
    let mut found = unknown_modules(&rows, sources);
    found.extend(upward_arrows(&rows));
    for source in sources {
        // A module that the table lacks has been named already.
        if let Some(row) = rows.iter().find(|row| row.holds(source)) {
            found.extend(forbidden_arrows(row, &rows, source));
        }
    }
    match table(architecture, &NAMING_TABLE) {
        Ok(rows) => found.extend(sources.iter().flat_map(|source| forbidden_names(&rows, source))),
        Err(complaint) => found.push(complaint),
    }
    found
}

impl Row {
    fn holds(&self, source: &Source) -> bool {
        (&self.crate_name, &self.module) == (&source.crate_name, &source.module)
    }
}

/// Modules that only the table or only src/ has.
fn unknown_modules(rows: &[Row], sources: &[Source]) -> Vec<String> {
    let real: BTreeSet<_> = sources.iter().map(|s| (s.crate_name.as_str(), s.module.as_str())).collect();
    let listed: BTreeSet<_> = rows.iter().map(|r| (r.crate_name.as_str(), r.module.as_str())).collect();
    let mut found = Vec::new();
    for (name, module) in listed.difference(&real) {
        found.push(format!("`{module}` stands in the module table, but not in crates/{name}/src"));
    }
    for (name, module) in real.difference(&listed) {
        found.push(format!("`{module}` stands in crates/{name}/src, but not in the module table"));
    }
    found
}

/// Uses that the table allows of modules that do not stand above the user, in the same crate. Without them there is no
/// circle.
fn upward_arrows(rows: &[Row]) -> Vec<String> {
    let mut found = Vec::new();
    for (number, row) in rows.iter().enumerate() {
        let is_above = |used: &str| rows[..number].iter().any(|r| r.crate_name == row.crate_name && r.module == used);
        for used in row.may_use.iter().filter(|used| !is_above(used)) {
            found.push(format!("`{}` may use `{used}`, which has no row of its crate above it", row.module));
        }
    }
    found
}

/// Uses of other modules of the same crate. What a crate has from another one is a matter of `Cargo.toml`.
fn forbidden_arrows(row: &Row, rows: &[Row], source: &Source) -> Vec<String> {
    let is_own = |used: &str| rows.iter().any(|other| other.crate_name == row.crate_name && other.module == used);
    let allowed = |used: &str| used == row.module || row.may_use.iter().any(|m| m == used);
    let arrows = uses(source).into_iter().filter(|(_, used)| (used == "*" || is_own(used)) && !allowed(used));
    let may = if row.may_use.is_empty() { "nothing".to_owned() } else { row.may_use.join(", ") };
    let place = |line: usize| format!("{}/src/{}:{line}", source.crate_name, source.file);
    arrows.map(|(line, used)| format!("{}: `{}` uses `{used}`; it may use {may}", place(line), row.module)).collect()
}

fn forbidden_names(rows: &[Vec<String>], source: &Source) -> Vec<String> {
    let mut found = Vec::new();
    for word in words(&source.text) {
        let row = rows.iter().find(|row| quoted(&row[0]).iter().any(|name| name.replace('-', "_") == word.text));
        let Some(row) = row else { continue };
        let allowed = quoted(&row[1]);
        if !allowed.contains(&source.module) {
            let (file, line, module) = (&source.file, word.line, &source.module);
            let (own, name) = (&source.crate_name, &word.text);
            found.push(format!("{own}/src/{file}:{line}: `{module}` names `{name}`; only {} may", allowed.join(", ")));
        }
    }
    found
}

/// Folders of crates/ and rows of the crate table that have no partner; `exists` tells whether a path below the root
/// holds a crate.
fn crate_complaints(architecture: &str, folders: &[String], exists: impl Fn(&str) -> bool) -> Vec<String> {
    let rows = match table(architecture, &CRATE_TABLE) {
        Ok(rows) => rows,
        Err(complaint) => return vec![complaint],
    };
    let listed: Vec<String> = rows.iter().flat_map(|row| quoted(&row[0])).collect();
    let missing = folders.iter().filter(|name| !listed.contains(name));
    let mut found: Vec<String> =
        missing.map(|name| format!("`{name}` stands in crates/, but not in the crate table")).collect();
    let ghosts = listed.iter().filter(|name| !folders.contains(name) && !exists(name));
    found.extend(ghosts.map(|name| format!("`{name}` stands in the crate table, but is no crate of the workspace")));
    found
}

// ---- tables of a Markdown text ----

/// Cells of the rows below the header, of the first table with exactly this header.
fn table(text: &str, header: &[&str]) -> Result<Vec<Vec<String>>, String> {
    let mut lines = text.lines().map(cells).skip_while(|line| line.as_deref() != Some(header));
    if lines.next().is_none() {
        return Err(format!("no table with the header | {} |", header.join(" | ")));
    }
    let rows = lines.skip(1).map_while(|line| line).map(|row| row.iter().map(|&cell| cell.to_owned()).collect());
    let rows: Vec<Vec<String>> = rows.collect();
    match rows.iter().find(|row| row.len() != header.len()) {
        Some(row) => {
            Err(format!("the row | {} | has {} cells, its header {}", row.join(" | "), row.len(), header.len()))
        }
        None => Ok(rows),
    }
}

fn cells(line: &str) -> Option<Vec<&str>> {
    let inside = line.trim().strip_prefix('|')?.strip_suffix('|')?;
    Some(inside.split('|').map(str::trim).collect())
}

/// The words of a cell that stand in backticks.
fn quoted(cell: &str) -> Vec<String> {
    cell.split('`').skip(1).step_by(2).map(str::to_owned).collect()
}

// ---- who uses whom in a file ----

/// A name, or a sign that paths are made of.
struct Word {
    text: String,
    line: usize,
}

/// Line and name of everything that the file takes from the crate's root; `*` if it takes all.
fn uses(source: &Source) -> Vec<(usize, String)> {
    let words = words(&source.text);
    let mut found = Vec::new();
    let mut depth = depth_of_file(&source.file);
    // For each open brace, whether it opened a module.
    let mut braces = Vec::new();
    for (i, word) in words.iter().enumerate() {
        let before = |n: usize| i.checked_sub(n).map_or("", |j| words[j].text.as_str());
        match word.text.as_str() {
            "{" => {
                braces.push(before(2) == "mod");
                depth += usize::from(before(2) == "mod");
            }
            "}" => depth -= usize::from(braces.pop().unwrap_or(false)),
            "crate" if before(1) != "::" => follow(&words, i + 1, 0, &mut found),
            "super" if before(1) != "::" => follow(&words, i, depth, &mut found),
            _ => {}
        }
    }
    found
}

/// Follows a path from the word at `at`, `height` modules below the crate's root; returns nothing, notes what it takes
/// from the root.
fn follow(words: &[Word], at: usize, height: usize, found: &mut Vec<(usize, String)>) {
    let Some(word) = words.get(at) else { return };
    match word.text.as_str() {
        "::" => match words.get(at + 1) {
            Some(next) if next.text == "{" => {
                for start in branches(words, at + 1) {
                    follow(words, start, height, found);
                }
            }
            Some(next) if next.text == "super" => follow(words, at + 1, height, found),
            Some(next) if height == 0 => found.push((next.line, next.text.clone())),
            _ => {}
        },
        "super" => follow(words, at + 1, height.saturating_sub(1), found),
        // `crate` or `super` alone, as in `pub(crate)`.
        ")" | ";" | "," | "}" => {}
        // The beginning of a branch inside braces.
        _ if height == 0 && matches!(words[at - 1].text.as_str(), "{" | ",") => {
            found.push((word.line, word.text.clone()));
        }
        _ => {}
    }
}

/// Where the branches of a braced group begin that opens at `open`.
fn branches(words: &[Word], open: usize) -> Vec<usize> {
    let (mut nesting, mut starts) = (0_usize, Vec::new());
    for (i, word) in words.iter().enumerate().skip(open) {
        match word.text.as_str() {
            "{" => nesting += 1,
            "}" => nesting -= 1,
            _ => {}
        }
        if nesting == 0 {
            break;
        }
        if nesting == 1 && matches!(word.text.as_str(), "{" | ",") {
            starts.push(i + 1);
        }
    }
    starts
}

/// How many modules below the crate's root the file's code is: `model/mod.rs` 1, `model/joint.rs` 2.
fn depth_of_file(file: &str) -> usize {
    let path = file.strip_suffix(".rs").unwrap_or(file);
    path.strip_suffix("/mod").unwrap_or(path).split('/').count()
}

/// Names and signs of the code, without comments and texts.
fn words(text: &str) -> Vec<Word> {
    let code: Vec<char> = blank(text).chars().collect();
    let (mut list, mut i, mut line) = (Vec::new(), 0, 1);
    let is_name = |c: char| c.is_alphanumeric() || c == '_';
    while i < code.len() {
        let length = match code[i] {
            c if is_name(c) => code[i..].iter().take_while(|c| is_name(**c)).count(),
            ':' if code.get(i + 1) == Some(&':') => 2,
            _ => 1,
        };
        line += usize::from(code[i] == '\n');
        if !code[i].is_whitespace() {
            list.push(Word { text: code[i..i + length].iter().collect(), line });
        }
        i += length;
    }
    list
}

/// The code with a blank for each sign of comments, texts and characters; line ends stay.
fn blank(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let word_before = out.ends_with(|c: char| c.is_alphanumeric() || c == '_');
        let length = hidden(rest, word_before);
        if length == 0 {
            out.push(first);
            rest = &rest[first.len_utf8()..];
        } else {
            out.extend(rest[..length].chars().map(|c| if c == '\n' { c } else { ' ' }));
            rest = &rest[length..];
        }
    }
    out
}

/// Bytes of the comment, text or character that `code` begins with; 0 if it begins with none.
fn hidden(code: &str, word_before: bool) -> usize {
    let raw = code.strip_prefix('b').unwrap_or(code).strip_prefix('r');
    if let Some(raw) = raw.filter(|_| !word_before)
        && raw.trim_start_matches('#').starts_with('"')
    {
        let hashes = "#".repeat(raw.len() - raw.trim_start_matches('#').len());
        let inside = code.len() - raw.len() + hashes.len() + 1;
        return through(code, inside, &format!("\"{hashes}"));
    }
    match code.as_bytes() {
        [b'/', b'/', ..] => code.find('\n').unwrap_or(code.len()),
        [b'/', b'*', ..] => block_comment(code),
        [b'"', ..] => text_end(code, '"'),
        [b'\'', b'\\', ..] => text_end(code, '\''),
        // 'x' is a character, 'x alone a lifetime.
        [b'\'', ..] => {
            let second = code[1..].chars().next().map_or(0, char::len_utf8);
            if code[1 + second..].starts_with('\'') { second + 2 } else { 0 }
        }
        _ => 0,
    }
}

/// Bytes up to and with `end`, searched from `from`.
fn through(code: &str, from: usize, end: &str) -> usize {
    code[from..].find(end).map_or(code.len(), |found| from + found + end.len())
}

fn text_end(code: &str, quote: char) -> usize {
    let mut escaped = false;
    for (i, c) in code.char_indices().skip(1) {
        match c {
            _ if escaped => escaped = false,
            '\\' => escaped = true,
            _ if c == quote => return i + 1,
            _ => {}
        }
    }
    code.len()
}

/// Block comments may stand inside each other.
fn block_comment(code: &str) -> usize {
    let (mut at, mut open) = (2, 1);
    while open > 0 {
        let Some(next) = code[at..].find(['/', '*']) else { return code.len() };
        at += next;
        if code[at..].starts_with("/*") {
            (at, open) = (at + 2, open + 1);
        } else if code[at..].starts_with("*/") {
            (at, open) = (at + 2, open - 1);
        } else {
            at += 1;
        }
    }
    at
}

// ---- the real tree ----

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn architecture() -> String {
    let path = root().join("ARCHITECTURE.md");
    fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

fn crate_folders() -> Vec<String> {
    let folders = entries(&root().join("crates"));
    let crates = folders.iter().filter(|folder| folder.join("Cargo.toml").is_file());
    crates.map(|folder| folder.file_name().unwrap().to_string_lossy().into_owned()).collect()
}

/// All files of the library's crates but lib.rs, which only lists the modules.
fn sources() -> Vec<Source> {
    let mut list = Vec::new();
    for name in LIBRARY {
        let src = root().join("crates").join(name).join("src");
        collect(name, &src, &src, &mut list);
    }
    list.retain(|source| source.file != "lib.rs");
    list
}

fn collect(crate_name: &str, src: &Path, folder: &Path, list: &mut Vec<Source>) {
    for path in entries(folder) {
        if path.is_dir() {
            collect(crate_name, src, &path, list);
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            let file = path.strip_prefix(src).unwrap().to_string_lossy().replace('\\', "/");
            list.push(source(crate_name, &file, &fs::read_to_string(&path).unwrap()));
        }
    }
}

fn source(crate_name: &str, file: &str, text: &str) -> Source {
    let module = file.split(['/', '.']).next().unwrap_or_default().to_owned();
    Source { crate_name: crate_name.to_owned(), module, file: file.to_owned(), text: text.to_owned() }
}

fn entries(folder: &Path) -> Vec<PathBuf> {
    let listing = fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    let mut paths: Vec<PathBuf> = listing.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths
}

// ---- the checker on trees that are wrong ----

const TABLES: &str = "\
# A map

| crate | module | duty | may use |
|---|---|---|---|
| `base` | `spatial` | directions | - |
| `base` | `model` | the body | `spatial` |
| `base` | `report` | pages | `model` `spatial` |
| `top` | `study` | the road | - |

| crate | named only by |
|---|---|
| `ambulo-formats` | `model`, `report` |

| crate | duty |
|---|---|
| `ambulo` | science |
| `xtask` | automation |
";

/// A tree that agrees with [`TABLES`].
fn tree() -> Vec<Source> {
    vec![
        source("base", "spatial.rs", "pub type Vec3 = [f64; 3];\n"),
        source("base", "model/mod.rs", "mod joint;\nuse ambulo_formats::osim;\nuse crate::spatial::Vec3;\n"),
        source("base", "model/joint.rs", "use super::Body;\nuse super::super::spatial::Vec3;\n"),
        source("base", "report/mod.rs", "use crate::{model::{Body, Model}, spatial::Vec3};\n"),
        // The crate `base` belongs to its `Cargo.toml`.
        source("top", "study.rs", "use base::model::Body;\nuse crate::model::Model;\n"),
    ]
}

/// What the checker states of [`tree`] with one more file.
fn complaints_with(file: &str, text: &str) -> Vec<String> {
    let mut tree = tree();
    tree.push(source("base", file, text));
    complaints(TABLES, &tree)
}

#[test]
fn a_tree_that_agrees_with_its_table_gives_no_complaint() {
    assert!(complaints(TABLES, &tree()).is_empty());
}

#[test]
fn a_forbidden_arrow_is_named_with_its_place() {
    let expected = |place: &str| [format!("base/src/{place}: `model` uses `report`; it may use spatial")];
    assert_eq!(complaints_with("model/side.rs", "\nuse crate::report::Page;\n"), expected("model/side.rs:2"));
    assert_eq!(complaints_with("model/side.rs", "use super::super::report;\n"), expected("model/side.rs:1"));
    assert_eq!(
        complaints_with("model/side.rs", "fn f() {\n crate\n  ::report::page() }\n"),
        expected("model/side.rs:3")
    );
    let grouped = "use crate::{\n    spatial::{Vec3, Mat3},\n    report::Page,\n};\n";
    assert_eq!(complaints_with("model/side.rs", grouped), expected("model/side.rs:3"));
    let climbing = "use super::{Body, super::report::Page};\n";
    assert_eq!(complaints_with("model/side.rs", climbing), expected("model/side.rs:1"));
    let in_tests = "mod tests {\n    use super::*;\n    use super::super::super::report::Page;\n}\n";
    assert_eq!(complaints_with("model/side.rs", in_tests), expected("model/side.rs:3"));
    let after_tests = "mod tests { fn f() {} }\nuse super::super::report::Page;\n";
    assert_eq!(complaints_with("model/side.rs", after_tests), expected("model/side.rs:2"));
}

#[test]
fn a_module_without_arrows_may_use_nothing_not_even_everything() {
    let found = complaints_with("spatial/pose.rs", "use crate::*;\n");
    assert_eq!(found, ["base/src/spatial/pose.rs:1: `spatial` uses `*`; it may use nothing"]);
}

#[test]
fn comments_texts_and_own_parts_are_no_arrows() {
    let text = r##"
        //! See [`crate::report`]; crate::report /* not closed
        /* use crate::report; /* crate::report */ crate::report */
        const A: &str = "crate::report \" crate::report";
        const B: &str = r#"crate::report " crate::report"#;
        const C: [char; 3] = ['"', '\'', 'x'];
        const D: &[u8] = br"\";
        pub(crate) fn f<'a>(x: &'a str) -> super::Body { crate::model::g(x) }
        pub(in crate::model) struct Outer { inner: super::joint::report }
        mod deep { use super::super::report; }
    "##;
    assert!(complaints_with("model/side.rs", text).is_empty(), "{:?}", complaints_with("model/side.rs", text));
    let after = format!("{text}use crate::report;");
    assert_eq!(complaints_with("model/side.rs", &after).len(), 1);
}

#[test]
fn a_module_that_only_table_or_tree_has_is_named() {
    let mut tree = tree();
    tree.remove(0);
    assert_eq!(complaints(TABLES, &tree), ["`spatial` stands in the module table, but not in crates/base/src"]);
    let found = complaints_with("gait.rs", "use crate::model::Model;\n");
    assert_eq!(found, ["`gait` stands in crates/base/src, but not in the module table"]);
}

#[test]
fn an_arrow_upward_or_to_another_crate_has_no_place_in_the_table() {
    for (row, module, used) in [("`base` | `spatial`", "spatial", "report"), ("`top` | `study`", "study", "model")] {
        let (before, after) = TABLES.split_once(row).unwrap();
        let tables = format!("{before}{row}{}", after.replacen("| - |", &format!("| `{used}` |"), 1));
        let expected = format!("`{module}` may use `{used}`, which has no row of its crate above it");
        assert_eq!(complaints(&tables, &tree()), [expected]);
    }
}

#[test]
fn a_crate_named_by_the_wrong_module_is_shown() {
    let found = complaints_with("spatial/pose.rs", "// ambulo_formats\nuse ambulo_formats::table::Table;\n");
    assert_eq!(found, ["base/src/spatial/pose.rs:2: `spatial` names `ambulo_formats`; only model, report may"]);
}

#[test]
fn a_missing_table_and_a_torn_row_are_complaints() {
    let found = complaints("# Nothing\n", &tree());
    assert_eq!(found, ["no table with the header | crate | module | duty | may use |"]);
    let torn = TABLES.replace("| `model` | the body | `spatial` |", "| `model` | the body |");
    assert_eq!(complaints(&torn, &tree()), ["the row | `base` | `model` | the body | has 3 cells, its header 4"]);
    let unnamed = TABLES.replace("named only by", "by");
    assert_eq!(complaints(&unnamed, &tree()), ["no table with the header | crate | named only by |"]);
}

#[test]
fn crates_without_row_and_rows_without_crate_are_named() {
    let folders = |names: &[&str]| names.iter().map(|&name| name.to_owned()).collect::<Vec<_>>();
    let exists = |name: &str| name == "xtask";
    assert!(crate_complaints(TABLES, &folders(&["ambulo"]), exists).is_empty());
    assert_eq!(
        crate_complaints(TABLES, &folders(&["ambulo", "ambulo-cli"]), exists),
        ["`ambulo-cli` stands in crates/, but not in the crate table"]
    );
    assert_eq!(
        crate_complaints(TABLES, &folders(&[]), exists),
        ["`ambulo` stands in the crate table, but is no crate of the workspace"]
    );
}

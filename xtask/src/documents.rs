//! Tests of the documents: links, commands of `cargo xtask` that they name, and lists of examples.

use crate::{MEASUREMENTS, OWN, workspace};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Documents with a complete list of the examples, one table row each.
const WITH_EXAMPLES: [&str; 1] = ["docs/SCENES.md"];
const EXAMPLE_TABLE: &str = "| example | shows |";

#[test]
fn every_relative_link_leads_to_a_file() {
    let mut broken = Vec::new();
    for document in documents() {
        let text = read(&document);
        let folder = document.parent().unwrap();
        for link in links(&text) {
            let file = link.split('#').next().unwrap_or_default();
            if !file.is_empty() && !link.contains("://") && !folder.join(file).exists() {
                broken.push(format!("{}: ({link})", document.display()));
            }
        }
    }
    assert!(broken.is_empty(), "links to files that do not exist:\n{}", broken.join("\n"));
}

#[test]
fn links_are_found_outside_of_code() {
    let text = "[a](A.md) ![p](p.png) `[b](B.md)`\n```\n[c](C.md)\n```\n[d](D.md#part)\n";
    assert_eq!(links(text), ["A.md", "p.png", "D.md#part"]);
}

#[test]
fn every_command_that_a_document_names_exists() {
    for document in documents() {
        let text = read(&document);
        for part in text.split("cargo xtask ").skip(1) {
            let name: String = part.chars().take_while(|c| c.is_ascii_alphanumeric() || *c == '-').collect();
            let known = OWN.iter().chain(&MEASUREMENTS).chain(&["help", ""]).any(|known| name == *known);
            assert!(known, "{}: `cargo xtask {name}` does not exist", document.display());
        }
    }
}

#[test]
fn lists_of_examples_are_complete() {
    let examples: BTreeSet<String> = example_files().into_iter().collect();
    for name in WITH_EXAMPLES {
        let text = read(&workspace::root().join(name));
        let (_, table) = text.split_once(EXAMPLE_TABLE).unwrap_or_else(|| panic!("{name} lacks `{EXAMPLE_TABLE}`"));
        let rows = table.split("\n\n").next().unwrap_or_default().lines().filter(|line| line.starts_with("| `"));
        let listed: BTreeSet<String> = rows.map(|row| row.split('`').nth(1).unwrap_or_default().to_owned()).collect();
        assert_eq!(listed, examples, "{name}");
    }
}

/// `docs/METHODS.md` and `docs/PAPER.md` name files by the ends of their paths.
#[test]
fn every_file_of_the_methods_exists() {
    let sources = sources();
    for document in ["docs/METHODS.md", "docs/PAPER.md"] {
        let text = read(&workspace::root().join(document));
        let names = text.split('`').skip(1).step_by(2).filter(|name| name.ends_with(".rs"));
        let missing: Vec<&str> = names.filter(|name| !sources.iter().any(|path| path.ends_with(name))).collect();
        assert!(missing.is_empty(), "{document}: files that do not exist: {missing:?}");
    }
}

/// A row of `docs/PAPER.md` names a file, then its functions or types.
#[test]
fn every_function_of_the_paper_is_in_its_file() {
    let (sources, text) = (sources(), read(&workspace::root().join("docs/PAPER.md")));
    let mut seen = 0;
    for row in text.lines().filter(|line| line.starts_with("| ")) {
        let Some((before, names)) = row.split_once(".rs` | ") else { continue };
        let file = format!("{}.rs", before.rsplit('`').next().unwrap_or_default());
        let source = sources.iter().find(|path| path.ends_with(&file)).map(|path| read(path)).unwrap_or_default();
        for name in names.split('`').skip(1).step_by(2) {
            let heads = ["fn ", "struct ", "enum "].map(|head| format!("{head}{name}"));
            let is_whole = |rest: &str| !rest.starts_with(|c: char| c.is_alphanumeric() || c == '_');
            let found = heads.iter().any(|head| source.split(head.as_str()).skip(1).any(is_whole));
            assert!(found, "docs/PAPER.md: `{name}` is not in `{file}`");
            seen += 1;
        }
    }
    assert!(seen > 25, "only {seen} functions found");
}

/// All source files of the crates.
fn sources() -> Vec<PathBuf> {
    let crates = entries(&workspace::root().join("crates"));
    let folders = crates.iter().flat_map(|folder| ["src", "tests"].map(|part| folder.join(part)));
    folders.filter(|folder| folder.is_dir()).flat_map(|folder| below(&folder)).collect()
}

/// Scenes in `examples/` and those that the library contains, and programs in `crates/*/examples/`, as paths from the
/// root.
fn example_files() -> Vec<String> {
    let root = workspace::root();
    let mut folders = vec![root.join("examples"), root.join("crates/ambulo-paper/data/scenes")];
    folders.extend(entries(&root.join("crates")).into_iter().map(|folder| folder.join("examples")));
    let files = folders.iter().filter(|folder| folder.is_dir()).flat_map(|folder| entries(folder));
    files.map(|file| file.strip_prefix(&root).unwrap().to_string_lossy().replace('\\', "/")).collect()
}

/// All Markdown of the repository's root and of `docs/`.
fn documents() -> Vec<PathBuf> {
    let root = workspace::root();
    let folders = [root.clone(), root.join("docs"), root.join("docs/measured"), root.join("docs/tutorials")];
    let files = folders.iter().flat_map(|folder| entries(folder));
    files.filter(|file| file.extension().is_some_and(|ending| ending == "md")).collect()
}

fn entries(folder: &Path) -> Vec<PathBuf> {
    let listing = fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    listing.map(|entry| entry.unwrap().path()).collect()
}

/// All files of a folder and of those in it.
fn below(folder: &Path) -> Vec<PathBuf> {
    entries(folder).into_iter().flat_map(|path| if path.is_dir() { below(&path) } else { vec![path] }).collect()
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// The targets of Markdown links, code left out.
fn links(text: &str) -> Vec<String> {
    let prose: String = text.split("```").step_by(2).collect();
    let prose: String = prose.split('`').step_by(2).collect::<Vec<_>>().join(" ");
    let targets = prose.split("](").skip(1).filter_map(|part| part.split_once(')'));
    targets.map(|(target, _)| target.to_owned()).collect()
}

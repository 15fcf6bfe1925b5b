//! Product source of a tree: `crates/*/src`, one entry per file.

use std::fs;
use std::path::{Path, PathBuf};

/// The source of one crate.
pub(super) struct Crate {
    pub(super) name: String,
    pub(super) files: Vec<File>,
}

/// One file of Rust.
pub(super) struct File {
    /// Path below the crate's `src`, with `/`.
    pub(super) path: String,
    pub(super) text: String,
}

impl File {
    /// Module path below the crate's root: `dynamics/block.rs` and `dynamics/block/mod.rs` are `["dynamics", "block"]`.
    pub(super) fn module(&self) -> Vec<&str> {
        let stem = self.path.strip_suffix(".rs").unwrap_or(&self.path);
        let mut parts: Vec<&str> = stem.split('/').collect();
        let is_root = parts == ["lib"] || parts == ["main"];
        if is_root || parts.last() == Some(&"mod") {
            parts.pop();
        }
        parts
    }
}

/// The crates below `crates/` of a workspace, by name.
pub(super) fn crates(workspace: &Path) -> Result<Vec<Crate>, String> {
    let mut list = Vec::new();
    for folder in entries(&workspace.join("crates"))? {
        let source = folder.join("src");
        if !source.is_dir() {
            continue;
        }
        let mut files = Vec::new();
        collect(&source, &source, &mut files)?;
        list.push(Crate { name: folder.file_name().unwrap_or_default().to_string_lossy().into_owned(), files });
    }
    Ok(list)
}

/// All Rust source of crates, their tests and the automation; paths begin at the root of the workspace.
pub(super) fn all(workspace: &Path) -> Result<Vec<File>, String> {
    let mut files = Vec::new();
    for folder in ["crates", "xtask"] {
        collect(workspace, &workspace.join(folder), &mut files)?;
    }
    Ok(files)
}

/// Rust source that uses the crates: the automation, the fuzz targets, the examples, and code in the documents.
pub(super) fn users(workspace: &Path) -> Result<Vec<String>, String> {
    let mut files = Vec::new();
    for folder in ["xtask", "fuzz", "examples"] {
        collect(workspace, &workspace.join(folder), &mut files)?;
    }
    let mut texts: Vec<String> = files.into_iter().map(|file| file.text).collect();
    let mut documents = vec![workspace.join("README.md")];
    for folder in ["docs", "docs/tutorials"] {
        documents.extend(entries(&workspace.join(folder))?);
    }
    for document in documents.iter().filter(|path| path.extension().is_some_and(|ending| ending == "md")) {
        let text = fs::read_to_string(document).map_err(|e| format!("{}: cannot read: {e}", document.display()))?;
        texts.push(rust_code(&text));
    }
    Ok(texts)
}

/// Rust code of a document: its blocks marked `rust`.
pub(super) fn rust_code(document: &str) -> String {
    let mut is_rust = false;
    let mut code = String::new();
    for line in document.lines() {
        if let Some(language) = line.trim_start().strip_prefix("```") {
            is_rust = !is_rust && language.starts_with("rust");
        } else if is_rust {
            code.push_str(line);
            code.push('\n');
        }
    }
    code
}

/// Files of `crates/*/tests` that neither `Cargo.toml` nor a program that it names has as a module.
pub(super) fn forgotten_tests(workspace: &Path) -> Result<Vec<String>, String> {
    let mut forgotten = Vec::new();
    for folder in entries(&workspace.join("crates"))? {
        let tests = folder.join("tests");
        let Ok(mut programs) = fs::read_to_string(tests.join("main.rs")) else { continue };
        let manifest = fs::read_to_string(folder.join("Cargo.toml")).unwrap_or_default();
        let files = entries(&tests)?.into_iter().filter(|path| path.extension().is_some_and(|ending| ending == "rs"));
        let of_program = |path: &PathBuf| manifest.contains(&format!("tests/{}", file_name(path)));
        let (named, others): (Vec<PathBuf>, Vec<PathBuf>) = files.partition(of_program);
        programs.extend(named.iter().map(|path| fs::read_to_string(path).unwrap_or_default()));
        for path in &others {
            let module = format!("mod {};", file_name(path).trim_end_matches(".rs"));
            if *path != tests.join("main.rs") && !programs.lines().any(|line| line == module) {
                forgotten.push(path.strip_prefix(workspace).unwrap_or(path).display().to_string());
            }
        }
    }
    Ok(forgotten)
}

fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

fn collect(source: &Path, folder: &Path, files: &mut Vec<File>) -> Result<(), String> {
    for path in entries(folder)? {
        if path.is_dir() {
            collect(source, &path, files)?;
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            let text = fs::read_to_string(&path).map_err(|e| format!("{}: cannot read: {e}", path.display()))?;
            let below = path.strip_prefix(source).unwrap_or(&path);
            files.push(File { path: below.to_string_lossy().replace('\\', "/"), text });
        }
    }
    Ok(())
}

fn entries(folder: &Path) -> Result<Vec<PathBuf>, String> {
    let listing = fs::read_dir(folder).map_err(|e| format!("{}: cannot read: {e}", folder.display()))?;
    let mut paths: Vec<PathBuf> = listing.flatten().map(|entry| entry.path()).collect();
    paths.sort();
    Ok(paths)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_test_file_that_nothing_names_is_found() {
        let root = std::env::temp_dir().join(format!("ambulo-house-{}", std::process::id()));
        let tests = root.join("crates/gait/tests");
        fs::create_dir_all(&tests).unwrap();
        fs::write(root.join("crates/gait/Cargo.toml"), "path = \"tests/alone.rs\"").unwrap();
        fs::write(tests.join("main.rs"), "mod knee;\n\nmod main;\n// mod hip;\n").unwrap();
        for file in ["knee.rs", "hip.rs", "alone.rs"] {
            fs::write(tests.join(file), "").unwrap();
        }
        let found = forgotten_tests(&root).unwrap();
        fs::remove_dir_all(&root).unwrap();
        assert_eq!(found.len(), 1, "{found:?}");
        assert!(found[0].ends_with("hip.rs"), "{found:?}");
    }
}

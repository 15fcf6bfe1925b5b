//! Files that comments name after "Pinned by": the tests of an algorithm.
//!
//! A path begins at the crate's own folder, at `crates/ambulo` (whose tests are those of the crates of science too), at
//! `crates`, or at the workspace.

use super::source::File;
use std::path::Path;

const MARK: &str = "Pinned by";
const FRONT_DOOR: &str = "crates/ambulo";

/// Files that a comment names and that do not exist, each with the place of the comment.
pub(super) fn missing(workspace: &Path, files: &[File]) -> Vec<String> {
    let mut missing = Vec::new();
    for file in files {
        for (line, name) in named(&file.text) {
            let folders = [own_folder(&file.path), FRONT_DOOR.to_owned(), "crates".to_owned(), String::new()];
            if !folders.iter().any(|folder| workspace.join(folder).join(&name).is_file()) {
                missing.push(format!("{}:{line} {name}", file.path));
            }
        }
    }
    missing
}

/// The folder of a file's crate: `crates/ambulo-body` of `crates/ambulo-body/src/lib.rs`.
fn own_folder(path: &str) -> String {
    let before = path.split("/src/").next().and_then(|start| start.split("/tests/").next());
    before.unwrap_or_default().to_owned()
}

/// The paths of files of Rust in the sentences that begin with the mark, each with the line of the mark.
fn named(text: &str) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    let mut mark = None;
    for (index, line) in text.lines().enumerate() {
        let Some(comment) = comment(line) else {
            mark = None;
            continue;
        };
        if comment.starts_with(MARK) {
            mark = Some(index + 1);
        } else if comment.is_empty() {
            mark = None;
        }
        if let Some(mark) = mark {
            let is_path = |letter: char| letter.is_ascii_alphanumeric() || matches!(letter, '/' | '_' | '-' | '.');
            let words = comment.split(|letter| !is_path(letter)).map(|word| word.trim_end_matches('.'));
            found.extend(words.filter(|word| word.ends_with(".rs")).map(|word| (mark, word.to_owned())));
        }
    }
    found
}

/// What a line of comment says; `None` for a line of code.
fn comment(line: &str) -> Option<&str> {
    let rest = line.trim_start().strip_prefix("//")?;
    Some(rest.trim_start_matches(['/', '!']).trim())
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "//! Walks.\n//! Pinned by: tests/walk.rs, ambulo/tests/gait.rs\n//! and tests/run.rs.\n//!\n\
                        //! See other.rs.\nfn f() {}\n";

    #[test]
    fn the_files_of_a_sentence_are_named_by_it_over_lines() {
        let found: Vec<String> = named(TEXT).into_iter().map(|(line, name)| format!("{line} {name}")).collect();
        assert_eq!(found, ["2 tests/walk.rs", "2 ambulo/tests/gait.rs", "2 tests/run.rs"]);
    }

    #[test]
    fn a_file_that_does_not_exist_is_found() {
        let root = std::env::temp_dir().join(format!("ambulo-pinned-{}", std::process::id()));
        for (folder, file) in [("crates/gait/tests", "walk.rs"), ("crates/ambulo/tests", "gait.rs")] {
            std::fs::create_dir_all(root.join(folder)).unwrap();
            std::fs::write(root.join(folder).join(file), "").unwrap();
        }
        let file = File { path: "crates/gait/src/lib.rs".to_owned(), text: TEXT.to_owned() };
        let found = missing(&root, &[file]);
        std::fs::remove_dir_all(&root).unwrap();
        assert_eq!(found, ["crates/gait/src/lib.rs:2 tests/run.rs"]);
    }
}

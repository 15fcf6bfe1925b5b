//! Every command of docs/tutorials, typed in order into an empty folder.
//!
//! A command whose comment states `exits with N` must do so; every other must end with 0.

use crate::reproduce;
use crate::workbench::Workbench;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// A line of a tutorial: the words after `ambulo`, and the exit code that it announces.
fn commands(page: &str) -> Vec<(Vec<String>, i32)> {
    let mut inside = false;
    let mut commands = Vec::new();
    for line in page.lines() {
        match line {
            "```sh" => inside = true,
            "```" => inside = false,
            _ if inside => commands.push(command(line)),
            _ => {}
        }
    }
    commands
}

fn command(line: &str) -> (Vec<String>, i32) {
    let (typed, comment) = line.split_once(" # ").unwrap_or((line, ""));
    let mut words = typed.split_whitespace().map(str::to_owned);
    assert_eq!(words.next().as_deref(), Some("ambulo"), "only `ambulo` is run: {line}");
    let code = comment.strip_prefix("exits with ").map_or(0, |code| code.parse().unwrap());
    (words.collect(), code)
}

fn run(tutorial: &str) {
    let text = std::fs::read_to_string(root().join("docs/tutorials").join(tutorial)).unwrap();
    let commands = commands(&text);
    assert!(commands.len() >= 5, "{tutorial}: {} commands", commands.len());
    let bench = Workbench::empty(&format!("tutorial-{tutorial}"));
    copy_examples(&bench.folder);
    for (words, code) in commands {
        let words: Vec<&str> = words.iter().map(String::as_str).collect();
        if let ["reproduce", "--brief", "-o", folder] = words[..] {
            copy_folder(&reproduce::recomputed().0.folder.join("paper"), &bench.folder.join(folder));
            continue;
        }
        let run = bench.run(&words);
        assert_eq!(run.code, Some(code), "ambulo {}\n{}{}", words.join(" "), run.stdout, run.stderr);
    }
}

/// Copies a folder that another test has computed.
fn copy_folder(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).unwrap();
    for entry in std::fs::read_dir(from).unwrap() {
        let entry = entry.unwrap();
        let copy = to.join(entry.file_name());
        if entry.path().is_dir() {
            copy_folder(&entry.path(), &copy);
        } else {
            std::fs::copy(entry.path(), copy).unwrap();
        }
    }
}

fn copy_examples(folder: &Path) {
    let to = folder.join("examples");
    std::fs::create_dir_all(&to).unwrap();
    for file in std::fs::read_dir(root().join("examples")).unwrap() {
        let file = file.unwrap().path();
        if file.is_file() {
            std::fs::copy(&file, to.join(file.file_name().unwrap())).unwrap();
        }
    }
}

#[test]
fn laboratory() {
    run("LAB.md");
}

#[test]
fn animator() {
    run("ANIMATOR.md");
}

#[test]
fn engineer() {
    run("ENGINEER.md");
}

#[test]
fn knee_load() {
    run("KNEE_LOAD.md");
}

#[test]
fn teacher() {
    run("TEACHER.md");
}

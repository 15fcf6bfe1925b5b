//! Generated pages: `cargo xtask measured [PAGE...]`, `cargo xtask measured --check`.
//!
//! The pages of `docs/measured/` are written by commands of `xtask-measure`, and one by `cargo xtask mutants` from outcomes that it has
//! recorded. This command runs them and puts a first line on each page: version, commit and a hash of the page's inputs. A test
//! computes the hash again, so a page whose inputs have changed is found.
//!
//! Hash: 64-bit FNV-1a over path and content of every input file. Of Rust source, only the tokens count: comments, formatting,
//! items for tests and texts with a blank in them (messages) do not, so that a change of wording does not age a page.

use crate::house::tokens::{Kind, Token, tokens, without_tests};
use crate::workspace;
use std::fs;
use std::path::Path;
use std::process::Command;

/// Folder of the generated pages, relative to the workspace root.
const FOLDER: &str = "docs/measured";
/// Offset basis and prime of the hash (Fowler, Noll, Vo; unverified).
const BASIS: u64 = 0xcbf2_9ce4_8422_2325;
const PRIME: u64 = 0x0100_0000_01b3;

/// A generated page.
struct Page {
    /// File name without `.md`, as typed on the command line.
    name: &'static str,
    /// The command that writes it: `mutants`, or one of `xtask-measure` with `--write`.
    command: &'static str,
    /// Files and folders whose content the page depends on, relative to the workspace root.
    inputs: &'static [&'static str],
}

/// The code on the way from a recording to predicted forces.
const FORCES: &[&str] = &[
    "crates/ambulo-body/src/dynamics",
    "crates/ambulo-body/src/kinematics",
    "crates/ambulo-body/src/model",
    "crates/ambulo-body/src/motion",
    "crates/ambulo-body/src/numerics",
    "crates/ambulo-body/src/spatial",
    "crates/ambulo-formats/src",
    "crates/ambulo/data/ground",
    "crates/ambulo/src/analysis",
    "crates/ambulo/src/ground",
    "crates/ambulo/src/study",
    "xtask/measure/src/validate/recording.rs",
];

const PAGES: [Page; 11] = [
    Page { name: "VALIDATION", command: "validate", inputs: FORCES },
    Page { name: "GROUND_FIT", command: "fit-ground", inputs: FORCES },
    Page {
        name: "WALK_BANDS",
        command: "walk-bands",
        inputs: &[
            "crates/ambulo-body/src/contact",
            "crates/ambulo-body/src/dynamics",
            "crates/ambulo-body/src/kinematics",
            "crates/ambulo-body/src/model",
            "crates/ambulo-body/src/numerics",
            "crates/ambulo-body/src/spatial",
            "crates/ambulo-walk/data/gait",
            "crates/ambulo-walk/src/consistent_walk",
            "crates/ambulo-walk/src/engine",
            "crates/ambulo-walk/src/gait",
            "crates/ambulo-walk/src/synthetic",
            "crates/ambulo-walk/src/walking",
        ],
    },
    Page {
        name: "OPTIMAL_WALK",
        command: "optimal-walk",
        inputs: &[
            "crates/ambulo-body/src/contact",
            "crates/ambulo-body/src/dynamics",
            "crates/ambulo-body/src/model",
            "crates/ambulo-body/src/numerics",
            "crates/ambulo-body/src/spatial",
            "crates/ambulo-walk/data/gait",
            "crates/ambulo-walk/src/gait",
            "crates/ambulo-walk/src/optimal",
        ],
    },
    Page {
        name: "REPRODUCTION",
        command: "reproduction",
        inputs: &[
            "crates/ambulo-body/src/contact",
            "crates/ambulo-body/src/dynamics",
            "crates/ambulo-body/src/kinematics",
            "crates/ambulo-body/src/model",
            "crates/ambulo-body/src/numerics",
            "crates/ambulo-body/src/spatial",
            "crates/ambulo-paper/data",
            "crates/ambulo-paper/src",
            "crates/ambulo-walk/data/gait",
            "crates/ambulo-walk/src/consistent_walk",
            "crates/ambulo-walk/src/engine",
            "crates/ambulo-walk/src/gait",
            "crates/ambulo-walk/src/scene",
            "crates/ambulo-walk/src/walking",
        ],
    },
    Page {
        name: "PHYSICAL_WALK",
        command: "physical-walk",
        inputs: &[
            "crates/ambulo-body/src/contact",
            "crates/ambulo-body/src/dynamics",
            "crates/ambulo-body/src/kinematics",
            "crates/ambulo-body/src/model",
            "crates/ambulo-body/src/numerics",
            "crates/ambulo-body/src/spatial",
            "crates/ambulo-walk/data/gait",
            "crates/ambulo-walk/src/consistent_walk",
            "crates/ambulo-walk/src/control",
            "crates/ambulo-walk/src/engine",
            "crates/ambulo-walk/src/gait",
            "crates/ambulo-walk/src/optimal",
            "crates/ambulo-walk/src/walking",
        ],
    },
    Page {
        name: "BENCHMARKS",
        command: "bench-simulation",
        inputs: &["crates/ambulo-body/src/contact", "crates/ambulo-body/src/dynamics", "crates/ambulo-walk/src/engine"],
    },
    Page {
        name: "BENCHMARKS_MARKERS",
        command: "bench-markers",
        inputs: &["crates/ambulo-body/src/kinematics/marker_fit"],
    },
    // Recorded outcomes: a run takes up to an hour and needs other solvers.
    Page {
        name: "OPTIMAL_PEERS",
        command: "optimal-peers",
        inputs: &["xtask/measure/peers/optimal_outcomes.json", "xtask/measure/src/optimal_peers/page.rs"],
    },
    // Recorded outcomes: MuJoCo is not installed everywhere.
    Page {
        name: "PHYSICAL_PEERS",
        command: "physical-peers",
        inputs: &["xtask/measure/peers/physical_outcomes.json", "xtask/measure/src/physical_peers/page.rs"],
    },
    // Recorded outcomes instead of source: a run takes hours, and mutants are found by line and column, which any edit moves.
    Page { name: "MUTANTS", command: "mutants", inputs: &["xtask/mutants"] },
];

/// Runs the command.
#[expect(clippy::print_stdout, reason = "the list of pages is the command's result")]
pub(crate) fn run(words: &[String]) -> Result<(), String> {
    if words.iter().any(|word| word == "--check") {
        let old = out_of_date(&workspace::root());
        return if old.is_empty() { Ok(()) } else { Err(old.join("\n")) };
    }
    let known = |word: &String| PAGES.iter().any(|page| page.name == *word);
    if let Some(word) = words.iter().find(|word| !known(word)) {
        let names: Vec<&str> = PAGES.iter().map(|page| page.name).collect();
        return Err(format!("unknown page `{word}`, expected one of {}, or --check", names.join(", ")));
    }
    for page in PAGES.iter().filter(|page| words.is_empty() || words.iter().any(|word| word == page.name)) {
        match page.command {
            "mutants" => crate::mutants::write_page()?,
            command => crate::measure(&[command.to_owned(), "--write".to_owned()])?,
        }
        println!("written: {FOLDER}/{}.md", page.name);
    }
    Ok(())
}

/// Puts the first line on the page that a command of `xtask-measure` has written, if it has written one: a new page has none yet.
pub(crate) fn stamp(command: &str) -> Result<(), String> {
    let root = workspace::root();
    let Some(page) = PAGES.iter().find(|page| page.command == command) else { return Ok(()) };
    let path = page.path(&root);
    let text = fs::read_to_string(&path).map_err(|e| format!("{}: cannot read: {e}", path.display()))?;
    if is_stamped(&text) {
        return Ok(());
    }
    let text = format!("{}\n\n{text}", page.first_line(&commit(page), page.hash(&root)?));
    fs::write(&path, text).map_err(|e| format!("{}: cannot write: {e}", path.display()))
}

/// Whether a page has the first line from here.
fn is_stamped(text: &str) -> bool {
    text.starts_with("Generated by `cargo xtask measured")
}

impl Page {
    fn path(&self, root: &Path) -> std::path::PathBuf {
        root.join(FOLDER).join(self.name).with_extension("md")
    }

    fn first_line(&self, commit: &str, hash: u64) -> String {
        format!(
            "Generated by `cargo xtask measured {}`, Ambulo {commit}, inputs fnv1a64 {hash:016x}; do not edit.",
            self.name
        )
    }

    /// Hash of the inputs.
    fn hash(&self, root: &Path) -> Result<u64, String> {
        let mut files = Vec::new();
        for input in self.inputs {
            collect(root, input, &mut files)?;
        }
        files.sort();
        let mut state = BASIS;
        let mut feed = |bytes: &[u8]| {
            state = bytes.iter().chain(&[0]).fold(state, |state, &byte| (state ^ u64::from(byte)).wrapping_mul(PRIME));
        };
        for file in &files {
            let bytes = fs::read(root.join(file)).map_err(|e| format!("{file}: cannot read: {e}"))?;
            feed(file.as_bytes());
            match std::str::from_utf8(&bytes) {
                Ok(source) if file.ends_with(".rs") => {
                    significant(source).into_iter().for_each(|text| feed(text.as_bytes()))
                }
                _ => feed(&bytes),
            }
        }
        Ok(state)
    }
}

/// The tokens of Rust source that count.
fn significant(source: &str) -> Vec<&str> {
    let tokens = without_tests(&tokens(source));
    let is_message = |token: &Token<'_>| token.kind == Kind::Literal && token.text.trim().contains(' ');
    // rustfmt adds and removes commas before closing brackets.
    let closes = |token: &Token<'_>| [")", "]", "}", ">"].iter().any(|sign| token.is(sign));
    let is_trailing = |i: usize| tokens[i].is(",") && tokens.get(i + 1).is_none_or(closes);
    (0..tokens.len()).filter(|&i| !is_message(&tokens[i]) && !is_trailing(i)).map(|i| tokens[i].text).collect()
}

/// The files of an input, as paths from the workspace root with `/`.
fn collect(root: &Path, input: &str, files: &mut Vec<String>) -> Result<(), String> {
    let path = root.join(input);
    if path.is_file() {
        files.push(input.to_owned());
        return Ok(());
    }
    let missing =
        |e: std::io::Error| format!("{input}: {e}\nhint: PAGES in xtask/src/measured.rs lists the inputs of each page");
    for entry in fs::read_dir(&path).map_err(missing)?.flatten() {
        collect(root, &format!("{input}/{}", entry.file_name().to_string_lossy()), files)?;
    }
    Ok(())
}

/// Version and commit that a page measures.
fn commit(page: &Page) -> String {
    let version = env!("CARGO_PKG_VERSION");
    let git = |arguments: &[&str]| {
        let output = Command::new("git").current_dir(workspace::root()).args(arguments).output().ok()?;
        output.status.success().then(|| String::from_utf8_lossy(&output.stdout).trim().to_owned())
    };
    let Some(commit) = git(&["rev-parse", "--short=12", "HEAD"]) else {
        return format!("{version} at an unknown commit");
    };
    let arguments: Vec<&str> = ["status", "--porcelain", "--"].iter().chain(page.inputs).copied().collect();
    let changed = git(&arguments).is_none_or(|changes| !changes.is_empty());
    format!("{version} at commit {commit}{}", if changed { " with changes" } else { "" })
}

/// One message per page that was measured with other inputs than those of the tree.
fn out_of_date(root: &Path) -> Vec<String> {
    PAGES.iter().filter_map(|page| page.judge(root).err()).collect()
}

impl Page {
    fn judge(&self, root: &Path) -> Result<(), String> {
        let path = self.path(root);
        let text = fs::read_to_string(&path).map_err(|e| format!("{}: cannot read: {e}", path.display()))?;
        let first = text.lines().next().unwrap_or_default();
        let expected = format!("inputs fnv1a64 {:016x}; do not edit.", self.hash(root)?);
        if is_stamped(first) && first.ends_with(&expected) {
            return Ok(());
        }
        let name = self.name;
        Err(format!(
            "{FOLDER}/{name}.md is out of date\n  found:    {first}\n  expected: ... {expected}\n  hint: run `cargo xtask measured {name}`, then read and commit the page"
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn generated_pages_are_up_to_date() {
        let old = out_of_date(&workspace::root());
        assert!(old.is_empty(), "{}", old.join("\n"));
    }

    #[test]
    fn every_page_of_the_folder_is_generated() {
        let mut found: Vec<String> = Vec::new();
        collect(&workspace::root(), FOLDER, &mut found).unwrap();
        found.sort();
        let mut listed: Vec<String> = PAGES.iter().map(|page| format!("{FOLDER}/{}.md", page.name)).collect();
        listed.sort();
        assert_eq!(found, listed);
    }

    #[test]
    fn wording_and_formatting_do_not_count_and_code_does() {
        let source = "/// Length.\nfn f(a: f64) -> f64 { g(a, 1.0, \"calcn_r\").expect(\"a foot\") }";
        let reworded = "/// Leg length.\nfn f(\n    a: f64,\n) -> f64 {\n    g(a, 1.0, \"calcn_r\",).expect(\"no foot was found\")\n}\n#[cfg(test)]\nmod tests {}";
        assert_eq!(significant(source), significant(reworded));
        for changed in [source.replace("1.0", "2.0"), source.replace("calcn_r", "calcn_l")] {
            assert_ne!(significant(source), significant(&changed));
        }
    }

    #[test]
    fn a_changed_input_ages_the_page() {
        let root = std::env::temp_dir().join(format!("ambulo-measured-{}", std::process::id()));
        fs::create_dir_all(root.join(FOLDER)).unwrap();
        fs::create_dir_all(root.join("data")).unwrap();
        fs::write(root.join("data/knee.toml"), "1").unwrap();
        let page = Page { name: "KNEE", command: "knee", inputs: &["data"] };
        let write = |first: &str| fs::write(page.path(&root), format!("{first}\n\n# Knee\n")).unwrap();
        write(&page.first_line("0.1.0 at commit abc", page.hash(&root).unwrap()));
        assert_eq!(page.judge(&root), Ok(()));
        fs::write(root.join("data/knee.toml"), "2").unwrap();
        assert!(page.judge(&root).is_err_and(|message| message.starts_with("docs/measured/KNEE.md is out of date")));
        write("# Knee");
        assert!(page.judge(&root).is_err());
        fs::remove_dir_all(root).unwrap();
    }

    #[test]
    fn a_page_that_was_written_has_no_first_line_yet() {
        assert!(is_stamped("Generated by `cargo xtask measured A`, ...\n\n# A\n"));
        assert!(!is_stamped("# A\n\nText\n"));
    }
}

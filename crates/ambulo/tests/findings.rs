//! The list of findings: its names, its page in the documentation, its use; and that the library names no option of a
//! command.

use ambulo::findings::{Code, Finding, Findings, Severity};
use std::collections::BTreeSet;
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Sources of a folder and of the folders in it, with their text.
fn sources(folder: &Path) -> Vec<(PathBuf, String)> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(sources(&path));
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            let text = fs::read_to_string(&path).unwrap();
            found.push((path, text));
        }
    }
    found
}

/// Folders `src` of all crates.
fn crates() -> Vec<PathBuf> {
    let folders = fs::read_dir(root().join("crates")).unwrap().map(|entry| entry.unwrap().path().join("src"));
    folders.filter(|folder| folder.is_dir()).collect()
}

/// `markers.zero_is_gap` is `MarkersZeroIsGap`.
fn variant(name: &str) -> String {
    let words = name.split(['.', '_']);
    words.map(|word| word[..1].to_uppercase() + &word[1..]).collect()
}

#[test]
fn names_are_unique_and_those_of_the_variants() {
    let names: BTreeSet<&str> = Code::all().map(Code::name).collect();
    assert_eq!(names.len(), Code::all().count());
    for code in Code::all() {
        assert_eq!(format!("{code:?}"), variant(code.name()));
        assert_eq!(Code::from_name(code.name()), Some(code));
        for sentence in [code.meaning(), code.remedy()] {
            assert!(sentence.ends_with('.') && !sentence.contains("--"), "{code}: {sentence}");
        }
    }
}

#[test]
fn every_code_is_reported_somewhere() {
    let text: String = crates()
        .iter()
        .flat_map(|folder| sources(folder))
        .filter(|(path, _)| !path.ends_with("findings/code.rs"))
        .map(|(_, text)| text.split("#[cfg(test)]").next().unwrap_or_default().to_owned())
        .collect();
    let used = |code: &Code| {
        let word = format!("Code::{code:?}");
        text.match_indices(&word).any(|(i, _)| !text[i + word.len()..].starts_with(char::is_alphanumeric))
    };
    let unused: Vec<Code> = Code::all().filter(|code| !used(code)).collect();
    assert!(unused.is_empty(), "no product code reports {unused:?}");
}

#[test]
fn findings_are_counted_and_read_back() {
    let mut findings = Findings::default();
    findings.report(Code::MarkersSwap, "a and b");
    findings.report(Code::MarkersSwap, "a and b");
    findings.report(Code::MarkersSwap, "c and d");
    findings.report(Code::EventsNone, "none");
    let counts: Vec<usize> = findings.as_slice().iter().map(|finding| finding.count).collect();
    assert_eq!(counts, [2, 1, 1]);
    assert_eq!(findings.as_slice()[0].to_string(), "warning: a and b");
    assert_eq!(findings.as_slice()[2].severity(), Severity::Note);
    let written = serde_json::to_value(&findings).unwrap();
    assert_eq!(
        written[0],
        serde_json::json!({"code": "markers.swap", "severity": "warning", "message": "a and b", "count": 2})
    );
    assert_eq!(serde_json::from_value::<Findings>(written).unwrap(), findings);
    let unknown = serde_json::json!({"code": "markers.lost", "severity": "note", "message": "", "count": 1});
    let refused = serde_json::from_value::<Finding>(unknown).unwrap_err().to_string();
    assert!(refused.contains("`markers.lost`") && refused.contains("docs/FINDINGS.md"), "{refused}");
}

/// The page of all findings.
fn page() -> String {
    let mut page = "\
# Warnings and notes

Every command reports unusual input, assumptions and limits of its results. A **note** is for information; after a
**warning** results may be wrong and should be checked. Both appear on standard error, in `summary.json` (`findings`, with `code`,
`severity`, `message` and `count`) and on the report page. A message states the place and the value; this list has the meaning and the
remedy of each code.

This page is written from `crates/ambulo-body/src/findings/code.rs` by the test `findings`; do not edit.
"
    .to_owned();
    let mut subject = "";
    for code in Code::all() {
        let first = code.name().split('.').next().unwrap_or_default();
        if first != subject {
            subject = first;
            writeln!(page, "\n## {subject}\n\n| code | severity | meaning | remedy |\n|---|---|---|---|").unwrap();
        }
        let (meaning, remedy) = (code.meaning(), code.remedy());
        writeln!(page, "| `{code}` | {} | {meaning} | {remedy} |", code.severity()).unwrap();
    }
    page
}

/// With AMBULO_WRITE=1 the page is written.
#[test]
fn the_page_of_findings_is_current() {
    let path = root().join("docs/FINDINGS.md");
    if std::env::var_os("AMBULO_WRITE").is_some() {
        fs::write(&path, page()).unwrap();
    }
    let found = fs::read_to_string(&path).unwrap_or_default();
    assert!(found == page(), "{} is out of date; run this test with AMBULO_WRITE=1", path.display());
}

/// Where `--` is followed by a letter.
fn option(line: &str) -> bool {
    line.match_indices("--").any(|(i, _)| line[i + 2..].starts_with(|c: char| c.is_ascii_lowercase()))
}

/// Other shells (Python, a page in the browser) have no options: errors and findings carry data, and the command adds
/// the hint.
#[test]
fn the_library_names_no_option_of_the_command() {
    assert!(option("hint: --from and --to") && !option("// ---- up ----"));
    for folder in crates().iter().filter(|folder| !folder.ends_with("ambulo-cli/src")) {
        for (path, text) in sources(folder) {
            let product = text.split("#[cfg(test)]").next().unwrap_or_default();
            for (i, line) in product.lines().enumerate() {
                assert!(!option(line), "{}:{}: {line}", path.display(), i + 1);
            }
        }
    }
}

#[test]
fn the_word_of_a_variant_is_the_one_that_serde_writes() {
    use ambulo::analysis::MassSource;
    use ambulo::findings::{Severity, word};
    use ambulo::ground::plates::ContactQuality;
    use ambulo::simulation::Integrator;
    use ambulo::study::Measure;

    assert_eq!((MassSource::Plates.word(), Integrator::RungeKutta.word()), ("plates", "runge-kutta"));
    assert_eq!((ContactQuality::TwoFeet.word(), Severity::Warning.to_string()), ("two feet", "warning".to_owned()));
    for measure in Measure::ALL {
        assert_eq!(serde_json::to_string(&measure).unwrap(), format!("\"{}\"", measure.name()));
    }
    assert_eq!((word(&1.5), word(&"text"), word(&Some(Severity::Note))), ("", "", ""));
}

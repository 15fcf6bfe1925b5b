//! The test programs: which there are, their tests one after the other or shuffled, and the slowest tests.
//!
//! Cargo compiles the programs and lists them as lines of JSON. They are started here as cargo starts them, so that the
//! time of each test can be asked for and its place changed: the stable test harness has both options only for the
//! variable `RUSTC_BOOTSTRAP`.

use super::children::{Children, behind_others};
use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::Command;

/// A test program.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Program {
    pub(super) name: String,
    pub(super) file: PathBuf,
    /// The folder of its package, in which it runs.
    pub(super) folder: PathBuf,
}

impl Program {
    /// The programs of a list by cargo, largest first, because that one takes longest.
    pub(super) fn of_list(list: &str) -> Vec<Program> {
        let mut programs: Vec<Program> = list.lines().filter_map(Program::of_line).collect();
        let size = |program: &Program| std::fs::metadata(&program.file).map_or(0, |file| file.len());
        programs.sort_by_key(|program| (std::cmp::Reverse(size(program)), program.name.clone()));
        programs
    }

    /// The program of a line that describes one.
    fn of_line(line: &str) -> Option<Program> {
        // The profile is followed by the features; that a target can be tested is another field.
        let is_test = line.contains("\"reason\":\"compiler-artifact\"") && line.contains("\"test\":true},\"features\"");
        let file = PathBuf::from(text(line, "executable").filter(|_| is_test)?);
        let folder = PathBuf::from(text(line, "manifest_path")?).parent()?.to_path_buf();
        Some(Program { name: text(line.split_once("\"target\":")?.1, "name")?, file, folder })
    }

    /// The program with options of the test harness that need the variable.
    fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(&self.file);
        command.current_dir(&self.folder).env("CARGO_MANIFEST_DIR", &self.folder).env("RUSTC_BOOTSTRAP", "1");
        command.args(arguments).args(["-Z", "unstable-options"]);
        command
    }

    /// Names of its tests.
    pub(super) fn tests(&self) -> Result<Vec<String>, String> {
        let output = self.command(&["--list", "--format", "terse"]).output();
        let output = output.map_err(|e| format!("{}: cannot start: {e}", self.file.display()))?;
        let list = String::from_utf8_lossy(&output.stdout);
        Ok(list.lines().filter_map(|line| line.strip_suffix(": test")).map(str::to_owned).collect())
    }

    /// Runs these tests in an order that the seed decides; the output goes to the log. Whether they passed.
    pub(super) fn run_shuffled(
        &self,
        tests: &[String],
        seed: u64,
        children: &Children,
        log: &File,
    ) -> io::Result<bool> {
        let seed = seed.to_string();
        let names: Vec<&str> = tests.iter().map(String::as_str).collect();
        let mut command = self.command(&[&["--exact", "--shuffle-seed", &seed][..], &names].concat());
        Ok(children.run(command.stdout(log.try_clone()?).stderr(log.try_clone()?))?.status.success())
    }
}

/// Value of the first key of this name in a line of JSON, if it is a text.
fn text(line: &str, key: &str) -> Option<String> {
    let (_, rest) = line.split_once(&format!("\"{key}\":\""))?;
    let (mut value, mut characters) = (String::new(), rest.chars());
    loop {
        match characters.next()? {
            '"' => return Some(value),
            '\\' => value.push(characters.next()?),
            other => value.push(other),
        }
    }
}

/// Runs all programs, one after the other, up to the first that fails. Returns their processor time [s].
pub(super) fn run_all(list: &Path, children: &Children, log: &mut File) -> Result<Option<f64>, String> {
    let list = std::fs::read_to_string(list).map_err(|e| format!("{}: {e}", list.display()))?;
    let mut cpu_s = Some(0.0);
    // A test that waits for a program that it has started leaves its processor to one more.
    let threads = std::thread::available_parallelism().map_or(2, |processors| processors.get() + 1).to_string();
    for program in Program::of_list(&list) {
        let cannot = |e: io::Error| format!("{}: {e}", program.file.display());
        writeln!(log, "     Running {} ({})", program.name, program.file.display()).map_err(cannot)?;
        // The output of tests that pass has the values that they measured and the recordings that were missing.
        let options = ["--show-output", "--report-time", "--test-threads", &threads];
        let mut command = behind_others(&program.command(&options));
        command.stdout(log.try_clone().map_err(cannot)?).stderr(log.try_clone().map_err(cannot)?);
        let ended = children.run(&mut command).map_err(cannot)?;
        cpu_s = cpu_s.zip(ended.cpu_s).map(|(sum, more)| sum + more);
        if !ended.status.success() {
            return Err(format!("tests of `{}` failed ({})", program.name, ended.status));
        }
    }
    Ok(cpu_s)
}

/// The slowest tests in the output of test programs: time [s], program and test.
pub(super) fn slowest(output: &str, count: usize) -> Vec<(f64, String)> {
    let (mut program, mut times) = ("", Vec::new());
    for line in output.lines() {
        if let Some(rest) = line.strip_prefix("     Running ") {
            program = rest.split(' ').next().unwrap_or_default();
        } else if let Some((test, seconds)) = test_time(line) {
            times.push((seconds, format!("{program} {test}")));
        }
    }
    times.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    times.truncate(count);
    times
}

/// Name and time of `test gait::steps ... ok <1.234s>`.
fn test_time(line: &str) -> Option<(&str, f64)> {
    let (test, outcome) = line.strip_prefix("test ")?.rsplit_once(" ... ")?;
    Some((test, outcome.split_once('<')?.1.strip_suffix("s>")?.parse().ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIST: &str = r#"{"reason":"compiler-artifact","manifest_path":"/w/gait/Cargo.toml","target":{"kind":["test"],"name":"library","doctest":false,"test":true},"profile":{"opt_level":"1","test":true},"features":[],"filenames":["/t/library-1"],"executable":"/t/lib\"rary-1","fresh":false}
{"reason":"compiler-artifact","manifest_path":"/w/gait/Cargo.toml","target":{"kind":["bin"],"name":"walk","doctest":false,"test":true},"profile":{"opt_level":"1","test":false},"features":[],"executable":"/t/walk","fresh":false}
{"reason":"compiler-artifact","manifest_path":"/w/gait/Cargo.toml","target":{"kind":["lib"],"name":"gait","doctest":true,"test":true},"profile":{"opt_level":"1","test":true},"features":[],"executable":null,"fresh":false}
{"reason":"build-finished","success":true}"#;

    #[test]
    fn test_programs_are_found_in_cargos_list() {
        let library = Program { name: "library".into(), file: "/t/lib\"rary-1".into(), folder: "/w/gait".into() };
        assert_eq!(Program::of_list(LIST), [library]);
    }

    #[test]
    fn the_slowest_tests_come_first() {
        let output = "     Running library (/t/library-1)\ntest gait::steps ... ok <1.500s>\ntest knee - should panic \
            ... ok <0.001s>\n     Running command (/t/command-2)\ntest walk::all ... FAILED <12.000s>\ntest result: \
            ok. 3 passed; 0 failed; finished in 13.50s\n";
        let found = slowest(output, 2);
        assert_eq!(found, [(12.0, "command walk::all".to_owned()), (1.5, "library gait::steps".to_owned())]);
    }
}

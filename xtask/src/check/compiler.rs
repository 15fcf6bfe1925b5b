//! The compiler of the workspace's own crates: as cargo calls it, but for the code of test programs, which is linted
//! while it is compiled and not optimised, and for what is only compiled here, which is linted too.
//!
//! A profile applies to a package: what optimises a library optimises its tests too, although these only call it. For
//! the largest program that takes four times as long to compile, and it then runs no faster. And clippy is a compiler
//! with more lints: where it compiles the test programs, nothing reads them a second time. Cargo calls this program in
//! place of the compiler (`RUSTC_WORKSPACE_WRAPPER`), which changes the arguments and starts the compiler. What cargo
//! builds so is named otherwise than what it builds without, so no test program passes that was not linted.

use std::env::consts::EXE_SUFFIX;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

/// Set where this program is called in place of the compiler.
const VARIABLE: &str = "AMBULO_COMPILES_TESTS";
/// Crates that the step `lints` leaves out, or reads without a part of them.
const LINTED: [&str; 3] = ["_ambulo", "ambulo_cli", "three_steps"];
/// Test programs whose own code takes most of their time.
const OPTIMISED: [&str; 1] = ["dense"];

/// Lets cargo call this program in place of the compiler.
pub(super) fn stand_in(command: &mut Command) {
    if let Ok(this) = std::env::current_exe() {
        command.env("RUSTC_WORKSPACE_WRAPPER", this).env(VARIABLE, "1");
    }
}

/// Clippy's compiler, next to another program of the same toolchain.
pub(super) fn clippy(neighbour: &Path) -> PathBuf {
    neighbour.with_file_name(format!("clippy-driver{EXE_SUFFIX}"))
}

/// Runs the compiler, if cargo calls this program in its place.
pub(crate) fn in_place_of_compiler() -> Option<ExitCode> {
    std::env::var_os(VARIABLE)?;
    let mut words = std::env::args_os().skip(1);
    let compiler = PathBuf::from(words.next()?);
    let (program, words) = call(compiler, words.collect());
    let is_done = Command::new(program).args(words).status().is_ok_and(|status| status.success());
    Some(if is_done { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// The program to start and its arguments: clippy for a test program, without optimisation and with every warning an
/// error, and for the crates that are linted here.
fn call(compiler: PathBuf, words: Vec<OsString>) -> (PathBuf, Vec<OsString>) {
    let name = words.iter().skip_while(|word| *word != "--crate-name").nth(1);
    let is_of = |names: &[&str]| name.is_some_and(|name| names.iter().any(|known| name == known));
    let is_test = words.iter().any(|word| word == "--test");
    if !is_test && !is_of(&LINTED) {
        return (compiler, words);
    }
    let is_slow = is_test && !is_of(&OPTIMISED);
    let is_level = |word: &OsString| word.to_str().is_some_and(|word| word.starts_with("opt-level="));
    let level = |word: OsString| if is_level(&word) && is_slow { "opt-level=0".into() } else { word };
    let program = clippy(&compiler);
    let words = std::iter::once(compiler.into()).chain(words.into_iter().map(level));
    (program, words.chain(["-D".into(), "warnings".into()]).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn called(words: &[&str]) -> (PathBuf, Vec<OsString>) {
        call("/bin/rustc".into(), words.iter().map(OsString::from).collect())
    }

    #[test]
    fn test_programs_are_linted_and_not_optimised_and_other_libraries_are_compiled_as_cargo_says() {
        let clippy = clippy(Path::new("/bin/rustc"));
        for (name, level) in [("library", "opt-level=0"), ("dense", "opt-level=3")] {
            let (program, words) = called(&["--crate-name", name, "-C", "opt-level=3", "--test"]);
            assert_eq!(program, clippy);
            assert_eq!(words, ["/bin/rustc", "--crate-name", name, "-C", level, "--test", "-D", "warnings"]);
        }
        let (program, words) = called(&["--crate-name", "_ambulo", "-C", "opt-level=1"]);
        assert_eq!(program, clippy);
        assert_eq!(words[3..], ["-C", "opt-level=1", "-D", "warnings"]);
        let library = ["--crate-name", "ambulo", "-C", "opt-level=3", "-g"];
        assert_eq!(called(&library), ("/bin/rustc".into(), library.map(OsString::from).to_vec()));
    }
}

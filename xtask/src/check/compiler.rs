//! The compiler of the test programs: as cargo calls it, but for their own code, which is not optimised.
//!
//! A profile applies to a package: what optimises a library optimises its tests too, although these only call it. For
//! the largest program that takes four times as long to compile, and it then runs no faster. Cargo calls this
//! program in place of the compiler (`RUSTC_WRAPPER`), which changes the arguments and starts the compiler.

use std::ffi::OsString;
use std::process::{Command, ExitCode};

/// Set where this program is called in place of the compiler.
pub(super) const VARIABLE: &str = "AMBULO_COMPILES_TESTS";
/// Test programs whose own arithmetic takes most of their time.
const OPTIMISED: [&str; 1] = ["dense"];

/// Runs the compiler, if cargo calls this program in its place.
pub(crate) fn in_place_of_compiler() -> Option<ExitCode> {
    std::env::var_os(VARIABLE)?;
    let mut words = std::env::args_os().skip(1);
    let compiler = words.next()?;
    let status = Command::new(compiler).args(arguments(words.collect())).status();
    let is_done = status.is_ok_and(|status| status.success());
    Some(if is_done { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// The arguments of the compiler: for a test program without optimisation.
fn arguments(words: Vec<OsString>) -> Vec<OsString> {
    let is_test = words.iter().any(|word| word == "--test");
    let name = words.iter().skip_while(|word| *word != "--crate-name").nth(1);
    let is_optimised = name.is_some_and(|name| OPTIMISED.iter().any(|optimised| name == optimised));
    if !is_test || is_optimised {
        return words;
    }
    let is_level = |word: &OsString| word.to_str().is_some_and(|word| word.starts_with("opt-level="));
    words.into_iter().map(|word| if is_level(&word) { "opt-level=0".into() } else { word }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn changed(words: &[&str]) -> Vec<OsString> {
        arguments(words.iter().map(OsString::from).collect())
    }

    #[test]
    fn the_code_of_a_test_program_is_not_optimised_and_that_of_libraries_is() {
        let test = ["--crate-name", "library", "-C", "opt-level=3", "--test"];
        assert_eq!(changed(&test), ["--crate-name", "library", "-C", "opt-level=0", "--test"]);
        for words in [
            ["--crate-name", "ambulo", "-C", "opt-level=3", "-g"],
            ["--crate-name", "dense", "-C", "opt-level=3", "--test"],
        ] {
            assert_eq!(changed(&words), words);
        }
    }
}

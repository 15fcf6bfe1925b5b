//! A panic is reported as a bug, with exit code 2.

use ambulo_cli::internals::install_bug_report;
use std::process::Command;

/// Set for the child of the test below, which panics.
const CHILD: &str = "AMBULO_TEST_PANICS";

#[test]
fn a_panic_says_that_it_is_a_bug_and_where_to_report_it() {
    if std::env::var_os(CHILD).is_some() {
        install_bug_report();
        panic!("the knee has four ends");
    }
    let this_test = ["--exact", "panics::a_panic_says_that_it_is_a_bug_and_where_to_report_it", "--nocapture"];
    let child = Command::new(std::env::current_exe().unwrap()).args(this_test).env(CHILD, "1").output().unwrap();
    let text = String::from_utf8(child.stderr).unwrap();
    assert_eq!(child.status.code(), Some(2), "{text}");
    let start = concat!("error: this is a bug in ambulo ", env!("CARGO_PKG_VERSION"));
    for words in [start, "tests/panics.rs", "the knee has four ends", env!("CARGO_PKG_REPOSITORY"), "/issues", "hint: "]
    {
        assert!(text.contains(words), "`{words}` is missing in: {text}");
    }
}

/// Standard error that accepts nothing makes `eprintln!` panic in the program itself.
#[test]
#[cfg(target_os = "linux")]
fn a_panic_of_the_program_ends_with_exit_code_two() {
    let full = std::fs::File::create("/dev/full").unwrap();
    let run = Command::new(env!("CARGO_BIN_EXE_ambulo")).args(["info", "none.c3d"]).stderr(full).output().unwrap();
    assert_eq!(run.status.code(), Some(2));
}

//! Parts of the message of a failure.

use ambulo_cli::internals::refused;

#[test]
fn a_failure_has_the_file_and_the_line_of_its_message() {
    let message = "walk.mot: line 12: found `x`; expected a number";
    let failure = refused(message, &["walk", "walk.mot", ""]);
    assert_eq!((failure.file.as_deref(), failure.line), (Some("walk.mot"), Some(12)));
    let failure = refused(message, &["alk.mot"]);
    assert_eq!((failure.file, failure.line), (None, None));
}

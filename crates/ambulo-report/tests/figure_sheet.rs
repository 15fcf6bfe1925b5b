//! Texts of a figure in the lines of its sheet.

use ambulo_report::internals::{text_width, wrapped};

#[test]
fn a_text_is_wrapped_and_a_word_without_end_is_cut() {
    let lines = wrapped("one two three four", 10.0, text_width("one two", 10.0) + 0.1);
    assert_eq!(lines, ["one two", "three", "four"]);
    let long = wrapped(&"x".repeat(500), 6.0, 100.0);
    assert!(long.len() == 1 && long[0].ends_with('…') && text_width(&long[0], 6.0) <= 106.0, "{long:?}");
}

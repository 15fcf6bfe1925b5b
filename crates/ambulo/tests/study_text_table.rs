//! Tables that read as text and as Markdown.

use ambulo::study::validation::TextTable;

#[test]
fn cells_are_aligned_with_their_heads() {
    let mut table = TextTable::new(&["engine", "time"]);
    table.row(["ours".to_owned(), "1 us".to_owned()]);
    assert_eq!(table.text(), "| engine | time |\n|:-------|-----:|\n| ours   | 1 us |\n");
}

#[test]
fn no_cell_ends_a_cell_or_a_line() {
    let mut table = TextTable::new(&["a"]);
    table.row(["x|y\nz".to_owned()]);
    assert_eq!(table.text(), "| a      |\n|:-------|\n| x\\|y z |\n");
}

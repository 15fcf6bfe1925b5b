//! The types of the page, as the viewer knows them.

use std::path::Path;

/// `viewer/src/contract.ts` states what the types of the page say. With AMBULO_WRITE=1 it is written.
#[test]
fn the_viewer_knows_the_contract() {
    let expected = ambulo_report::internals::contract();
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../viewer/src/contract.ts");
    if std::env::var_os("AMBULO_WRITE").is_some() {
        std::fs::write(&path, &expected).unwrap();
    }
    let found = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(found == expected, "{} is out of date; run this test with AMBULO_WRITE=1", path.display());
}

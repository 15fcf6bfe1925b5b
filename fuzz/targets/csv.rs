//! Tables in CSV. What is read is written, and reads back with the same columns.
#![no_main]

use ambulo_formats::table::Table;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let Ok((table, _)) = Table::read_csv(bytes) else { return };
    let (again, _) = Table::read_csv(&table.write_csv()).expect("what was written reads back");
    assert!(again.columns().map(|(name, _)| name).eq(table.columns().map(|(name, _)| name)));
});

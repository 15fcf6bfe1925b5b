//! Fuzz target; the check is `ambulo_fuzz::external_loads`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| ambulo_fuzz::external_loads(bytes));

//! Fuzz target; the check is `ambulo_fuzz::marker_set`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| ambulo_fuzz::marker_set(bytes));

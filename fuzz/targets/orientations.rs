//! Fuzz target; the check is `ambulo_fuzz::orientations`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| ambulo_fuzz::orientations(bytes));

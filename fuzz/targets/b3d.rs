//! Fuzz target; the check is `ambulo_fuzz::b3d`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| ambulo_fuzz::b3d(bytes));

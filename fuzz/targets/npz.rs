//! Fuzz target; the check is `ambulo_fuzz::npz`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| ambulo_fuzz::npz(bytes));

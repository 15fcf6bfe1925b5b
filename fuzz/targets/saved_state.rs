//! Fuzz target; the check is `ambulo_fuzz::saved_state`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| ambulo_fuzz::saved_state(bytes));

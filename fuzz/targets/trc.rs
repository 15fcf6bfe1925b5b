//! Fuzz target; the check is `ambulo_fuzz::trc`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| ambulo_fuzz::trc(bytes));

//! Fuzz target; the check is `ambulo_fuzz::result_folder`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| ambulo_fuzz::result_folder(bytes));

//! Fuzz target; the check is `ambulo_fuzz::study_markers`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| ambulo_fuzz::study_markers(bytes));

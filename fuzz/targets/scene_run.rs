//! Fuzz target; the check is `ambulo_fuzz::scene_run`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| ambulo_fuzz::scene_run(bytes));

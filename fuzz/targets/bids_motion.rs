//! Fuzz target; the check is `ambulo_fuzz::bids_motion`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| ambulo_fuzz::bids_motion(bytes));

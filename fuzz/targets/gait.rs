//! Synthetic gaits.
#![no_main]

use ambulo::gait::Gait;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let _ = Gait::from_toml(text);
});

//! Marker sets.
#![no_main]

use ambulo::model::marker_set::MarkerSet;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let _ = MarkerSet::from_toml(text);
});

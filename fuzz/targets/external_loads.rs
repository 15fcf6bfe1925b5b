//! Lists of external loads. What is read is written, and reads back.
#![no_main]

use ambulo_formats::external_loads::ExternalLoads;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    if let Ok((loads, _)) = ExternalLoads::read(bytes) {
        let _ = ExternalLoads::read(&loads.write()).expect("what was written reads back");
    }
});

//! Skeletons with their motion. What is read is written, and reads back with the same numbers of everything.
#![no_main]

use ambulo_formats::bvh::Bvh;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let Ok((record, _)) = Bvh::read(bytes) else { return };
    let (again, _) = Bvh::read(&record.write()).expect("what was written reads back");
    assert_eq!(again.joints().len(), record.joints().len());
    assert_eq!(again.frames(), record.frames());
});

//! Marker trajectories. What is read is written, and reads back with the same numbers of everything.
#![no_main]

use ambulo_formats::trc::Trc;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let Ok((record, _)) = Trc::read(bytes) else { return };
    let (again, _) = Trc::read(&record.write()).expect("what was written reads back");
    assert_eq!(again.times().len(), record.times().len());
    assert_eq!(again.markers().len(), record.markers().len());
});

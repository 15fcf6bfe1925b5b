//! C3D files. What is read can be used; what can be written reads back with the same numbers of everything.
#![no_main]

use ambulo_formats::c3d::C3d;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let Ok((record, _)) = C3d::read(bytes) else { return };
    let _ = (record.platforms(), record.times(), record.analog_times(), record.metres_per_unit());
    if let Ok(written) = record.write() {
        let (again, _) = C3d::read(&written).expect("what was written reads back");
        assert_eq!(again.frames(), record.frames());
        assert_eq!(again.points.len(), record.points.len());
        assert_eq!(again.channels.len(), record.channels.len());
        assert_eq!(again.events.len(), record.events.len());
        assert_eq!(again.encoding.storage, record.encoding.storage);
    }
});

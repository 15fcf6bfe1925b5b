//! OpenSim models: the document, and the model that is made of it.
#![no_main]

use ambulo::findings::Findings;
use ambulo::model::from_osim;
use ambulo_formats::osim::OsimModel;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(document) = OsimModel::read(bytes) {
        let _ = from_osim(&document, &mut Findings::default());
    }
});

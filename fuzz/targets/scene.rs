//! Scenes of the simulator: the file alone, nothing is built.
#![no_main]

use ambulo::simulation::scene::SceneFile;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let _ = SceneFile::parse(text);
});

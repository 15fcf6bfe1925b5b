//! Checks every file of the corpus, and of `found/` where there is one, with a stable compiler and without the fuzzer:
//! `cargo run --manifest-path fuzz/Cargo.toml --no-default-features --example replay`.

use ambulo_fuzz::CHECKS;
use std::error::Error;
use std::fs;
use std::path::Path;

fn main() -> Result<(), Box<dyn Error>> {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut count = 0;
    for (name, check) in CHECKS {
        for folder in [here.join("corpus").join(name), here.join("found").join(name)] {
            if !folder.is_dir() {
                continue;
            }
            for entry in fs::read_dir(&folder)? {
                let path = entry?.path();
                // Printed before, so that a panic has its file.
                println!("{}", path.display());
                check(&fs::read(&path)?);
                count += 1;
            }
        }
    }
    println!("{count} files checked");
    Ok(())
}

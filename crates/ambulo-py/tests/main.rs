//! The tests of the package are in Python; `cargo xtask python` runs them with the module that this program's build has
//! compiled.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use std::env::consts::{DLL_PREFIX, DLL_SUFFIX};

#[test]
fn the_module_is_compiled_with_the_tests() {
    let folder = std::env::current_exe().unwrap();
    let module = folder.with_file_name(format!("{DLL_PREFIX}_ambulo{DLL_SUFFIX}"));
    assert!(module.is_file(), "{} does not exist", module.display());
}

//! The committed bundle of the report page belongs to its sources in `viewer/`.
//!
//! `viewer/build.mjs` writes a hash of all sources into the first line of `data/report/viewer.js`; here it is computed
//! again, without npm. That the same sources give the same bytes is checked by `npm run check` in `viewer/`.

use std::fs;
use std::path::{Path, PathBuf};

/// FNV-1a of 64 bits: offset basis and prime of the authors' page (Fowler, Noll, Vo; unverified).
const BASIS: u64 = 0xcbf2_9ce4_8422_2325;
const PRIME: u64 = 0x0100_0000_01b3;

fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Files below a folder, as paths from the repository's root with `/`.
fn files_below(folder: &str) -> Vec<String> {
    let mut files = Vec::new();
    for entry in fs::read_dir(repository().join(folder)).unwrap() {
        let entry = entry.unwrap();
        let path = format!("{folder}/{}", entry.file_name().to_string_lossy());
        match entry.file_type().unwrap().is_dir() {
            true => files.extend(files_below(&path)),
            false => files.push(path),
        }
    }
    files
}

fn sources() -> Vec<String> {
    let mut files = files_below("viewer/src");
    files.extend(["build.mjs", "package-lock.json", "tsconfig.json"].map(|name| format!("viewer/{name}")));
    files.push("crates/ambulo-report/data/report/style.json".to_owned());
    files.sort();
    files
}

fn hash(sources: &[String]) -> u64 {
    let mut state = BASIS;
    let mut feed = |bytes: &[u8]| bytes.iter().for_each(|&byte| state = (state ^ u64::from(byte)).wrapping_mul(PRIME));
    for path in sources {
        feed(path.as_bytes());
        feed(&[0]);
        feed(&fs::read(repository().join(path)).unwrap());
        feed(&[0]);
    }
    state
}

#[test]
fn the_bundle_is_built_from_these_sources() {
    let bundle = fs::read_to_string(repository().join("crates/ambulo-report/data/report/viewer.js")).unwrap();
    let expected = format!("fnv1a64 {:016x}", hash(&sources()));
    let first = bundle.lines().next().unwrap_or_default();
    assert!(
        first.ends_with(&expected),
        "crates/ambulo-report/data/report/viewer.js was not built from viewer/ as it is now\n  found:    {first}\n  \
         expected: ... {expected}\n  hint: in viewer/ run `npm ci` and `npm run build`, then commit viewer.js and \
         viewer.css"
    );
}

#[test]
fn another_source_is_another_hash() {
    let mut sources = sources();
    let all = hash(&sources);
    sources.pop();
    assert_ne!(all, hash(&sources));
}

/// The notices that the licences of bundled packages require.
#[test]
fn the_bundle_carries_its_licences() {
    let bundle = fs::read_to_string(repository().join("crates/ambulo-report/data/report/viewer.js")).unwrap();
    for words in ["three.js authors", "Leon Sorokin", "Permission is hereby granted"] {
        assert!(bundle.contains(words), "viewer.js lacks {words}");
    }
}

/// Neither part may end the element of the page that holds it.
#[test]
fn the_bundle_stays_inside_of_its_element() {
    for name in ["viewer.js", "viewer.css"] {
        let text = fs::read_to_string(repository().join("crates/ambulo-report/data/report").join(name))
            .unwrap()
            .to_lowercase();
        for words in ["</script", "</style", "<!--"] {
            assert!(!text.contains(words), "{name} contains {words}");
        }
    }
}

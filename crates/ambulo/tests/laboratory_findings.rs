//! Every word for what is odd in a laboratory's file stands in docs/LABORATORY.md, and no other.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use std::collections::BTreeSet;
use std::path::Path;

const DOCUMENT: &str = include_str!("../../../docs/LABORATORY.md");
const FAMILIES: [&str; 4] = ["events.", "laboratory.", "markers.", "plates."];

/// Words between two marks that belong to one of the families.
fn codes(text: &str, mark: char) -> BTreeSet<String> {
    let is_code = |word: &&str| {
        let family = FAMILIES.iter().any(|f| word.starts_with(f));
        family && word.chars().all(|c| c.is_ascii_lowercase() || c == '_' || c == '.')
    };
    text.split(mark).filter(is_code).map(str::to_owned).collect()
}

fn sources(folder: &Path, text: &mut String) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, text);
        } else {
            text.push_str(&std::fs::read_to_string(&path).unwrap());
        }
    }
}

#[test]
fn the_document_lists_the_codes_of_the_sources_and_no_others() {
    let mut text = String::new();
    let crate_folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let motion = crate_folder.join("motion");
    for part in
        [motion.join("force_plate"), crate_folder.join("ground/plates"), crate_folder.join("ground/foot_motion")]
    {
        sources(&part, &mut text);
    }
    for file in ["laboratory.rs", "marker_recording.rs", "real_points.rs", "gait_event.rs"] {
        text.push_str(&std::fs::read_to_string(motion.join(file)).unwrap());
    }
    let said = codes(&text, '"');
    let listed = codes(DOCUMENT, '`');
    assert!(said.len() > 20, "{said:?}");
    assert_eq!(said, listed);
}

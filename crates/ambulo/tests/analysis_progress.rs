//! How a caller watches a long computation and stops it.

use ambulo::analysis::Stage;
use ambulo::internals::Progress;
use std::collections::BTreeSet;
use std::ops::ControlFlow;

#[test]
fn whoever_stops_a_computation_is_told_after_which_stage() {
    let stages = [
        Stage::Axes,
        Stage::Body,
        Stage::Markers,
        Stage::Feet,
        Stage::Smoothing,
        Stage::Prediction,
        Stage::Plates,
        Stage::Ground,
        Stage::InverseDynamics,
        Stage::Analysis,
        Stage::Checks,
        Stage::Tracking,
        Stage::ResidualReduction,
        Stage::Feasibility,
    ];
    // A key of a file: small letters, another one for each stage.
    let is_key = |word: &str| !word.is_empty() && word.chars().all(|c| c.is_ascii_lowercase() || c == '_');
    let words: BTreeSet<&str> = stages.iter().map(|stage| stage.word()).collect();
    assert!(words.len() == stages.len() && words.iter().all(|word| is_key(word)), "{words:?}");
    for last in stages {
        let mut observer =
            |stage: Stage| if stage == last { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
        let mut progress = Progress::watched_by(&mut observer);
        let stopped = stages.iter().find_map(|stage| progress.end(*stage).err()).unwrap();
        assert_eq!(stopped.after, last);
        assert!(stopped.to_string().contains(last.word()), "{stopped}");
    }
    assert_eq!(Progress::default().end(Stage::Axes), Ok(()));
}

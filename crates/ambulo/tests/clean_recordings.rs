//! Recordings with nothing wrong in them are called good, and none of the faults is named that `cargo xtask twins`
//! puts into their copies: clean_recordings.txt lists both.

use crate::shared_data;
use ambulo::analysis::feasibility::VerdictState;
use ambulo::findings::Findings;
use ambulo::job::{FileError, Job};
use ambulo::study::QualityState;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

const LIST: &str = include_str!("clean_recordings.txt");

/// Of the recordings, the share that may show one of these codes [1].
const MOST_FALSE: f64 = 0.05;

/// The jobs of the list.
fn jobs(data: &Path) -> Vec<Job> {
    let lines = LIST.lines().filter(|line| !line.starts_with(['#', '!']));
    lines
        .flat_map(|line| {
            let mut words = line.split_whitespace();
            let folder = data.join(words.next().unwrap());
            let standing = words.next().filter(|name| *name != "-").map(|name| folder.join(name));
            words.map(move |trial| Job { standing: standing.clone(), ..Job::of(folder.join(trial)) })
        })
        .collect()
}

#[test]
fn clean_recordings_stay_good_and_show_no_fault() {
    let Some(data) = shared_data::data() else { return };
    let tested: Vec<&str> = LIST.lines().filter_map(|line| line.strip_prefix('!')).map(str::trim).collect();
    let jobs = jobs(&data);
    let mut shown = BTreeMap::new();
    for job in &jobs {
        let (name, mut findings) = (job.recording().display().to_string(), Findings::default());
        let read = job.read(&mut |path: &Path| fs::read(path).map_err(FileError::from), &mut findings).unwrap();
        let outcome = read.run(&mut findings).unwrap();
        assert_eq!(outcome.quality.state, QualityState::Good, "{name}: {:?}", outcome.quality.reasons);
        assert_eq!(outcome.verdict.state, VerdictState::Feasible, "{name}");
        for code in tested.iter().filter(|code| findings.as_slice().iter().any(|f| f.code.name() == **code)) {
            shown.entry(*code).or_insert_with(Vec::new).push(name.clone());
        }
    }
    println!("{} recordings, {} codes; shown: {shown:?}", jobs.len(), tested.len());
    assert!(jobs.len() >= 60 && !tested.is_empty());
    for (code, names) in shown {
        assert!((names.len() as f64) < MOST_FALSE * jobs.len() as f64 + 1.0, "{code}: {names:?}");
    }
}

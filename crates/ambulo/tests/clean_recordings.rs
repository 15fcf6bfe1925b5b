//! Recordings with nothing wrong in them are called good, and none of the faults is named that `cargo xtask twins`
//! puts into their copies: clean_recordings.txt lists both. The body follows at least 95 % of the markers of each of
//! them. Arms that have markers swing against the legs by the factor that is assumed where they have none.

use crate::shared_data;
use ambulo::analysis::feasibility::VerdictState;
use ambulo::findings::{Code, Findings};
use ambulo::job::{FileError, Job};
use ambulo::study::{Outcome, QualityState, Tracking};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

const LIST: &str = include_str!("clean_recordings.txt");

/// Of the recordings, the share that may show one of these codes [1].
const MOST_FALSE: f64 = 0.05;

/// Of the markers of a recording, the least share that the body follows [1].
const LEAST_USED: f64 = 0.95;
/// The factor that is assumed, and how far the median of people may be from it.
const SWING: f64 = 0.5;
const SWING_TOLERANCE: f64 = 0.1;

/// The number of markers that the body follows, and of those in the recording.
fn used(outcome: &Outcome) -> [usize; 2] {
    let Some(Tracking::Markers(tracked)) = &outcome.tracking else { panic!("no markers") };
    let errors = &tracked.body.fit.errors;
    [errors.iter().filter(|error| error.rms_m.is_finite()).count(), tracked.body.recorded_markers]
}

/// Flexion of the shoulders over half the difference of the hips' that flex with the other leg, by least squares: mean
/// of both sides. `None` where arms have no markers.
fn swing(outcome: &Outcome, findings: &Findings) -> Option<f64> {
    let trajectory = &outcome.complete().trajectory;
    let angle = |name: &str| {
        let id = outcome.body.coordinate(name)?;
        let values = trajectory.values(id);
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        Some(values.iter().map(|value| value - mean).collect::<Vec<f64>>())
    };
    if findings.has(Code::CalibrationArmsSwing) {
        return None;
    }
    let hips = angle("hip_flexion_l")?.into_iter().zip(angle("hip_flexion_r")?).map(|(l, r)| 0.5 * (l - r));
    let arms = angle("arm_flex_r")?.into_iter().zip(angle("arm_flex_l")?).map(|(r, l)| 0.5 * (r - l));
    let (mut both, mut legs) = (0.0, 0.0);
    for (hip, arm) in hips.zip(arms) {
        both += hip * arm;
        legs += hip * hip;
    }
    Some(both / legs)
}

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
    let mut swings: BTreeMap<PathBuf, Vec<f64>> = BTreeMap::new();
    for job in &jobs {
        let (name, mut findings) = (job.recording().display().to_string(), Findings::default());
        let read = job.read(&mut |path: &Path| fs::read(path).map_err(FileError::from), &mut findings).unwrap();
        let outcome = read.run(&mut findings).unwrap();
        assert_eq!(outcome.quality.state, QualityState::Good, "{name}: {:?}", outcome.quality.reasons);
        assert_eq!(outcome.verdict.state, VerdictState::Feasible, "{name}");
        let [used, recorded] = used(&outcome);
        assert!(used as f64 >= LEAST_USED * recorded as f64, "{name}: {used} of {recorded} markers");
        let of_person = swings.entry(job.recording().parent().unwrap().to_owned()).or_default();
        of_person.extend(swing(&outcome, &findings));
        for code in tested.iter().filter(|code| findings.as_slice().iter().any(|f| f.code.name() == **code)) {
            shown.entry(*code).or_insert_with(Vec::new).push(name.clone());
        }
    }
    println!("{} recordings, {} codes; shown: {shown:?}", jobs.len(), tested.len());
    let people = swings.into_values().filter(|own| !own.is_empty());
    let mut factors: Vec<f64> = people.map(|own| own.iter().sum::<f64>() / own.len() as f64).collect();
    factors.sort_by(f64::total_cmp);
    let [quarter, median, three] = [1, 2, 3].map(|k| factors[(factors.len() - 1) * k / 4]);
    println!("arms of {} people swing by {median:.2} (quartiles {quarter:.2}, {three:.2})", factors.len());
    assert!(factors.len() >= 30 && (median - SWING).abs() < SWING_TOLERANCE);
    assert!(jobs.len() >= 60 && !tested.is_empty());
    for (code, names) in shown {
        assert!((names.len() as f64) < MOST_FALSE * jobs.len() as f64 + 1.0, "{code}: {names:?}");
    }
}
